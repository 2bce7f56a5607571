// Certificates and features; Voronoi diagrams and potential fields.

#include <algorithm>
#include <cmath>
#include <limits>

#include "binding.h"

namespace medial::js {
namespace {

std::string text_of(const Certificate& from) {
  return Json()
      .add("passed", from.passed)
      .add("failures", from.failures)
      .add("tolerance", from.tolerance)
      .add("resolution", from.resolution)
      .add("largest_residual", from.largest_residual)
      .add("largest_intrusion", from.largest_intrusion)
      .add("largest_contact_gap", from.largest_contact_gap)
      .add("largest_uncovered", from.largest_uncovered)
      .add("shape_area", from.shape_area)
      .add("disks_area", from.disks_area)
      .add("worst_legality", from.worst_legality)
      .add("disks_checked", number(from.disks_checked))
      .add("components", number(from.components))
      .add("graph_parts", number(from.graph_parts))
      .add("holes", number(from.holes))
      .add("cycles", number(from.cycles))
      .add("convex_corners", number(from.convex_corners))
      .add("corners_without_leaf", number(from.corners_without_leaf))
      .add("reflex_vertices", number(from.reflex_vertices))
      .add("reflex_without_contact", number(from.reflex_without_contact))
      .add("worst", from.worst)
      .text();
}

/// One row per branch; JavaScript has the names of the columns.
std::vector<double> branch_rows(const AxisFeatures& from) {
  std::vector<double> rows;
  for (const BranchFeatures& r : from.branches)
    rows.insert(rows.end(), {number(r.branch), number(r.from), number(r.to), number(r.from_kind),
                             number(r.to_kind), r.closed ? 1.0 : 0.0, r.length, r.smallest_radius,
                             r.largest_radius, r.mean_width, r.turning, r.absolute_turning, r.area,
                             r.significance});
  return rows;
}
std::vector<double> run_rows(const AxisFeatures& from) {
  std::vector<double> rows;
  for (const PrimitiveRun& r : from.runs)
    rows.insert(rows.end(),
                {number(r.primitive), number(r.variation), r.length, r.mean_radius, r.slope, r.bend,
                 r.turning, r.from.disk.center.x, r.from.disk.center.y, r.from.disk.radius,
                 r.to.disk.center.x, r.to.disk.center.y, r.to.disk.radius});
  return rows;
}

std::string names_of_kinds() {
  std::vector<std::string> points, primitives, variations;
  for (int i = 0; i < 3; ++i) points.emplace_back(name_of(static_cast<PointKind>(i)));
  for (int i = 0; i < primitive_count; ++i)
    primitives.emplace_back(name_of(static_cast<Primitive>(i)));
  for (int i = 0; i < variation_count; ++i)
    variations.emplace_back(name_of(static_cast<Variation>(i)));
  return Json()
      .add("points", points)
      .add("primitives", primitives)
      .add("variations", variations)
      .text();
}

}  // namespace

MEDIAL_JS int medial_verify(const AxisOf* of, const ShapeOf* shape, const char* given) {
  return answered([&] {
    VerifyOptions options;
    Named(given)
        .take("tolerance", options.tolerance)
        .take("samples", options.samples_per_edge)
        .take("corner_angle", options.corner_angle)
        .take("part", options.part)
        .finish();
    const Shape& against = shape == nullptr ? *of->shape : *shape->shape;
    answer().text = text_of(verify(against, of->axis, options));
    return 1;
  });
}

/// Counts and sums as text; tables of branches and of their runs.
MEDIAL_JS int medial_features(const AxisOf* of) {
  return answered([&] {
    const AxisFeatures from = describe(of->axis);
    answer().tables = {branch_rows(from), run_rows(from)};
    answer().text = Json()
                        .add("ends", number(from.ends))
                        .add("branchings", number(from.branchings))
                        .add("closed_branches", number(from.closed_branches))
                        .add("components", number(from.components))
                        .add("cycles", number(from.cycles))
                        .add("length", from.length)
                        .add("area", from.area)
                        .add("boundary", from.boundary)
                        .add("largest_radius", from.largest_radius)
                        .add("mean_width", from.mean_width)
                        .text();
    return 1;
  });
}
MEDIAL_JS int medial_feature_names() {
  return answered([&] {
    answer().text = names_of_kinds();
    return 1;
  });
}

MEDIAL_JS int medial_distance(const ShapeOf* a, const ShapeOf* b, int samples) {
  return answered([&] {
    const ShapeDistance from = shape_distance(*a->shape, *b->shape, samples);
    answer().text = Json()
                        .add("area", from.area)
                        .add("other_area", from.other_area)
                        .add("from_first", from.from_first)
                        .add("from_second", from.from_second)
                        .add("hausdorff", from.hausdorff())
                        .add("worst", from.worst)
                        .text();
    return 1;
  });
}

/// One row per branch: steepness and bend.
MEDIAL_JS int medial_legality(const AxisOf* of, int samples) {
  return answered([&] {
    std::vector<double> rows;
    for (const Legality& one : legality(of->axis, samples))
      rows.insert(rows.end(), {one.steepness, one.bend});
    answer().tables = {std::move(rows)};
    return 1;
  });
}

/// The diagram of points and lines: rows of sites (kind, start, end, chain, vertex, bulge), nodes
/// (x, y, radius) and edges (nodes, sites, spoke, on the enclosure); the edges' polylines of x, y,
/// radius, and the first row of each; the faces' outlines, and the first point of each; low and
/// high corner of the enclosure.
MEDIAL_JS int medial_voronoi(const double* coordinates, const std::uint32_t* begin,
                             std::size_t count, const std::uint8_t* closed, const double* bulges,
                             bool node_crossings, double margin, double chord) {
  return answered([&] {
    std::vector<Ring> rings = rings_from(coordinates, begin, count, nullptr, bulges);
    std::vector<Chain> chains;
    for (std::size_t i = 0; i < count; ++i)
      chains.push_back({std::move(rings[i].points), std::move(rings[i].bulges), closed[i] != 0});
    const PlanarGraph graph = value_of(build_planar_graph(chains, {node_crossings, 0}));
    Options options;
    options.margin = margin;
    const VoronoiDiagram diagram = value_of(voronoi_diagram(graph, options));
    std::vector<double> sites, nodes, edges, line_begin{0}, face_begin{0};
    std::vector<Disk> lines;
    std::vector<Vec2> faces;
    for (const Site& s : diagram.sites) {
      sites.insert(sites.end(), {number(s.kind()), s.start.x, s.start.y, s.end.x, s.end.y,
                                 number(s.ring), number(s.vertex), s.bulge});
      const auto outline = face_outline(diagram, face_begin.size() - 1, chord);
      faces.insert(faces.end(), outline.begin(), outline.end());
      face_begin.push_back(number(faces.size()));
    }
    for (const Node& n : diagram.nodes)
      nodes.insert(nodes.end(), {n.disk.center.x, n.disk.center.y, n.disk.radius});
    for (const VoronoiEdge& e : diagram.edges) {
      edges.insert(edges.end(),
                   {number(e.node[0]), number(e.node[1]), number(e.site[0]), number(e.site[1]),
                    e.spoke ? 1.0 : 0.0, e.on_enclosure ? 1.0 : 0.0});
      const auto samples = sample_by_chord(diagram, e, chord);
      lines.insert(lines.end(), samples.begin(), samples.end());
      line_begin.push_back(number(lines.size()));
    }
    const Box box = diagram.enclosure.value_or(Box{});
    answer().tables = {std::move(sites),      std::move(nodes),
                       std::move(edges),      table_of(lines),
                       std::move(line_begin), table_of(faces),
                       std::move(face_begin), {box.low.x, box.low.y, box.high.x, box.high.y}};
    return 1;
  });
}

MEDIAL_JS PotentialField* medial_field(const ShapeOf* of, double order) {
  return answered(
      [&] { return new PotentialField(value_of(PotentialField::make(*of->shape, order))); });
}

/// Rows of log potential, direction x and y, clearance; NaN outside of the field.
MEDIAL_JS int medial_field_sample(const PotentialField* field, const double* points,
                                  std::size_t count) {
  return answered([&] {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> rows;
    for (const Vec2 p : points_at(points, count)) {
      const auto at = field->at(p);
      if (at)
        rows.insert(rows.end(),
                    {at->log_potential, at->direction.x, at->direction.y, at->clearance});
      else
        rows.insert(rows.end(), {nothing, nothing, nothing, nothing});
    }
    answer().tables = {std::move(rows)};
    return 1;
  });
}
MEDIAL_JS int medial_streamline(const PotentialField* field, double x, double y, double step,
                                std::size_t most) {
  return answered([&] {
    answer().tables = {table_of(field->streamline({x, y}, step, most))};
    return 1;
  });
}
MEDIAL_JS void medial_free_field(PotentialField* field) { delete field; }

}  // namespace medial::js
