// Results derived from an axis: parts of it, lines, widths, offsets, tool paths, checks.

#include <algorithm>
#include <cmath>

#include "binding.h"

namespace medial::js {
namespace {

PruneMeasure measure_from(const std::string& name) {
  if (const auto measure = prune_measure_from(name)) return *measure;
  refuse(ErrorCode::invalid_option,
         "there is no measure '" + name + "'; pruneMeasures() lists them");
}

Route route_from(const std::string& name) {
  if (name == "roomy") return Route::roomy;
  if (name == "shortest") return Route::shortest;
  refuse(ErrorCode::invalid_option, "route is 'roomy' or 'shortest'");
}

EdgePlace place_at(const MedialAxis& axis, Vec2 p) {
  const auto place = place_on_axis(axis, p);
  if (!place) refuse(ErrorCode::invalid_option, "the shape's axis is a single point");
  return *place;
}

void add_width(std::vector<double>& rows, const LocalWidth& width) {
  const auto& [along, disk, feet] = width;
  rows.insert(rows.end(), {along, disk.center.x, disk.center.y, disk.radius, feet[0].x, feet[0].y,
                           feet[1].x, feet[1].y});
}

PathOf* longest(std::vector<AxisPath> paths) {
  if (paths.empty()) refuse(ErrorCode::empty, "the axis has no edge");
  const auto best =
      std::max_element(paths.begin(), paths.end(),
                       [](const AxisPath& a, const AxisPath& b) { return a.length < b.length; });
  return new PathOf{std::move(*best)};
}

/// The rings of all regions: points, bulges, the first point of each ring; for each region its
/// first ring, its clearance, parent, area and length.
void answer_regions(const std::vector<OffsetRegion>& regions) {
  std::vector<Vec2> points;
  std::vector<double> bulges, begin{0}, rows;
  for (const OffsetRegion& region : regions) {
    const double parent = region.parent == no_region ? -1 : number(region.parent);
    rows.insert(rows.end(),
                {number(begin.size() - 1), region.clearance, parent, area(region), length(region)});
    for (const Ring& ring : region.rings) {
      points.insert(points.end(), ring.points.begin(), ring.points.end());
      bulges.insert(bulges.end(), ring.bulges.begin(), ring.bulges.end());
      bulges.resize(points.size());
      begin.push_back(number(points.size()));
    }
  }
  answer().tables = {table_of(points), std::move(bulges), std::move(begin), std::move(rows)};
}

PlanarGraph planar_graph_from(const double* coordinates, const std::uint32_t* begin,
                              std::size_t count, const std::uint8_t* closed, const double* bulges,
                              bool node_crossings) {
  std::vector<Ring> rings = rings_from(coordinates, begin, count, nullptr, bulges);
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < count; ++i)
    chains.push_back({std::move(rings[i].points), std::move(rings[i].bulges), closed[i] != 0});
  return value_of(build_planar_graph(chains, {node_crossings, 0}));
}

}  // namespace

MEDIAL_JS AxisOf* medial_prune(const AxisOf* of, const char* given) {
  return answered([&] {
    PruneOptions options;
    PruneReport report;
    Named named(given);
    std::string measure = name_of(options.measure);
    named.take("measure", measure).take("tips", options.tips);
    named.take("threshold", options.threshold).take("keep", options.keep);
    named.finish();
    options.measure = measure_from(measure);
    AxisOf* const pruned = new_axis(of->shape, value_of(prune(of->axis, options, &report)));
    answer().tables = {{report.threshold}};
    return pruned;
  });
}

/// For each edge, the largest threshold that keeps some of it.
MEDIAL_JS int medial_significance(const AxisOf* of, const char* measure) {
  return answered([&] {
    const PruneOrder order(of->axis, measure_from(measure));
    std::vector<double> values;
    for (std::uint32_t e = 0; e < of->axis.edges.size(); ++e) values.push_back(order.of_edge(e));
    answer().tables = {std::move(values)};
    return 1;
  });
}

MEDIAL_JS AxisOf* medial_clearance_part(const AxisOf* of, double clearance) {
  return answered([&] { return new_axis(of->shape, clearance_part(of->axis, clearance)); });
}

MEDIAL_JS ShapeOf* medial_rebuild(const AxisOf* of, const char* given) {
  return answered([&] {
    RebuildOptions options;
    std::string by = "outline";
    Named(given)
        .take("by", by)
        .take("points", options.points)
        .take("chord", options.chord)
        .take("corner_angle", options.corner_angle)
        .finish();
    if (by == "tangents")
      options.by = RebuildBy::tangents;
    else if (by == "hulls")
      options.by = RebuildBy::hulls;
    else if (by != "outline")
      refuse(ErrorCode::invalid_option, "by is 'outline', 'tangents' or 'hulls'");
    return new ShapeOf{std::make_shared<const Shape>(value_of(rebuild(of->axis, options)))};
  });
}

/// The result is the polygons of the parts that are wide enough; the table has the address of the
/// axis of the others.
MEDIAL_JS ShapeOf* medial_collapse(const AxisOf* of, double width, double trim) {
  return answered([&] {
    CollapsedShape result = value_of(collapse_narrow(of->axis, width, trim));
    auto shape = std::make_shared<const Shape>(std::move(result.polygons));
    const AxisOf* const lines = new_axis(shape, std::move(result.lines));
    answer().tables = {{address_of(lines)}};
    return new ShapeOf{shape};
  });
}

// Lines.

/// The main path of each part, as addresses.
MEDIAL_JS int medial_main_paths(const AxisOf* of, const char* given) {
  return answered([&] {
    MainPathOptions options;
    std::string route = "roomy";
    bool only_longest = false;
    Named(given)
        .take("trim", options.trim)
        .take("route", route)
        .take("longest", only_longest)
        .finish();
    options.route = route_from(route);
    std::vector<double> addresses;
    const auto add = [&](const PathOf* path) { addresses.push_back(address_of(path)); };
    auto paths = main_paths(of->axis, options);
    if (only_longest)
      add(longest(std::move(paths)));
    else
      for (AxisPath& path : paths) add(new PathOf{std::move(path)});
    answer().tables = {std::move(addresses)};
    return 1;
  });
}

MEDIAL_JS PathOf* medial_path_between(const AxisOf* of, double x0, double y0, double x1, double y1,
                                      const char* route) {
  return answered([&] {
    const EdgePlace from = place_at(of->axis, {x0, y0}), to = place_at(of->axis, {x1, y1});
    return new PathOf{value_of(std::string_view(route) == "widest"
                                   ? widest_path(of->axis, from, to)
                                   : path_between(of->axis, from, to, route_from(route)))};
  });
}

/// The path as an axis of one chain; the table has its length, its narrowest radius, and whether it
/// is closed.
MEDIAL_JS AxisOf* medial_centre_line(const AxisOf* of, const PathOf* path, bool extend,
                                     double smooth) {
  return answered([&] {
    const auto& [pieces, closed, length, narrowest, gap] = path->path;
    MedialAxis line = centre_line(*of->shape, of->axis, path->path, {extend, smooth});
    answer().tables = {{length, narrowest, closed ? 1.0 : 0.0}};
    return new_axis(of->shape, std::move(line));
  });
}

/// Rows of along, x, y, radius, left foot, right foot.
MEDIAL_JS int medial_widths(const AxisOf* of, const PathOf* path, const double* lengths,
                            std::size_t count) {
  return answered([&] {
    const std::span<const double> at(lengths, count);
    double before = 0;
    for (const double length : at) {
      if (!(length >= before && length <= path->path.length))
        refuse(ErrorCode::invalid_option, "lengths increase from 0 to the length of the path");
      before = length;
    }
    std::vector<double> rows;
    for (const LocalWidth& width : widths_along(of->axis, path->path, at)) add_width(rows, width);
    answer().tables = {std::move(rows)};
    return 1;
  });
}

MEDIAL_JS int medial_mean_width(const AxisOf* of, const PathOf* path) {
  return answered([&] {
    const MeanWidth mean = mean_width(of->axis, path->path);
    answer().text = Json()
                        .add("length", mean.length)
                        .add("area", mean.area)
                        .add("by_length", mean.by_length)
                        .add("by_area", mean.by_area)
                        .add("area_by_length", mean.area_by_length)
                        .text();
    return 1;
  });
}

/// Rows of a width's numbers, then opens_to and around_hole.
MEDIAL_JS int medial_necks(const AxisOf* of, double widening) {
  return answered([&] {
    if (!(widening > 1)) refuse(ErrorCode::invalid_option, "widening is above 1");
    std::vector<double> rows;
    for (const Neck& neck : necks(of->axis, widening)) {
      add_width(rows, neck.width);
      rows.insert(rows.end(), {neck.opens_to, neck.around_hole ? 1.0 : 0.0});
    }
    answer().tables = {std::move(rows)};
    return 1;
  });
}

MEDIAL_JS int medial_deepest_disk(const AxisOf* of) {
  return answered([&] {
    if (of->axis.nodes.empty()) refuse(ErrorCode::empty, "the axis has no node");
    const Disk disk = deepest_disk(of->axis);
    answer().tables = {{disk.center.x, disk.center.y, disk.radius}};
    return 1;
  });
}

MEDIAL_JS int medial_disjoint_disks(const ShapeOf* of, std::size_t count, double smallest) {
  return answered([&] {
    answer().tables = {table_of(largest_disjoint_disks(*of->shape, count, smallest))};
    return 1;
  });
}

// Offsets.

MEDIAL_JS int medial_inward_offsets(const AxisOf* of, const double* distances, std::size_t count) {
  return answered([&] {
    answer_regions(value_of(inward_offsets(of->axis, {distances, count})).regions);
    return 1;
  });
}
MEDIAL_JS int medial_offsets(const ShapeOf* of, const double* distances, std::size_t count) {
  return answered([&] {
    answer_regions(value_of(offset_curves(*of->shape, {distances, count})).regions);
    return 1;
  });
}
MEDIAL_JS int medial_buffer(const double* coordinates, const std::uint32_t* begin,
                            std::size_t count, const std::uint8_t* closed, const double* bulges,
                            bool node_crossings, const double* distances,
                            std::size_t distance_count) {
  return answered([&] {
    const PlanarGraph planar_graph =
        planar_graph_from(coordinates, begin, count, closed, bulges, node_crossings);
    answer_regions(value_of(offset_curves(planar_graph, {distances, distance_count})).regions);
    return 1;
  });
}

// Tool paths.

/// Rows of x, y, z, bulge; the first row of each path; kinds and passes. The text has totals.
MEDIAL_JS int medial_carve(const AxisOf* of, const char* given) {
  return answered([&] {
    CarveOptions options;
    Named(given)
        .take("angle", options.angle)
        .take("depth", options.depth)
        .take("tool", options.tool)
        .take("tip", options.tip)
        .take("pass_depth", options.pass_depth)
        .take("step", options.step)
        .take("chord", options.chord)
        .take("ramp", options.ramp)
        .finish();
    const Carving carving = value_of(carve(of->axis, options));
    std::vector<double> rows, begin{0}, kinds;
    for (const ToolPath& path : carving.paths) {
      for (const ToolPoint& p : path.points)
        rows.insert(rows.end(), {p.point.x, p.point.y, p.z, p.bulge});
      begin.push_back(number(rows.size()) / 4);
      kinds.insert(kinds.end(), {number(path.kind), number(path.pass)});
    }
    answer().tables = {std::move(rows), std::move(begin), std::move(kinds)};
    answer().text = Json()
                        .add("deepest", carving.deepest)
                        .add("flat_from", carving.flat_from)
                        .add("tip_radius", carving.tip_radius)
                        .add("slope", carving.slope)
                        .add("step", carving.step)
                        .add("cut_length", carving.cut_length)
                        .add("travel_length", carving.travel_length)
                        .text();
    return 1;
  });
}

MEDIAL_JS void medial_free_path(PathOf* path) { delete path; }

}  // namespace medial::js
