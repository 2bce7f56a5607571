// Planar graphs, their Voronoi diagrams, nearest sites, buffers; potential fields.

#include <cmath>

#include "binding.h"

namespace medial::python {
namespace {

/// A diagram and its input.
struct VoronoiOf {
  PlanarGraph planar_graph;
  VoronoiDiagram diagram;
};

/// Chains of coordinates: chain i is [begin[i], begin[i + 1]).
std::vector<Chain> chains_from(const Coordinates& coordinates, const Values<std::int64_t>& begin,
                               const Values<std::uint8_t>& closed,
                               const std::optional<Values<double>>& bulges) {
  std::vector<Ring> rings = rings_of(coordinates, begin, {}, bulges);
  if (closed.shape(0) != rings.size())
    refuse(ErrorCode::malformed, "one value of `closed` goes with each chain");
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < rings.size(); ++i)
    chains.push_back(
        {std::move(rings[i].points), std::move(rings[i].bulges), closed.data()[i] != 0});
  return chains;
}

std::optional<Box> box_from(const std::optional<std::array<double, 4>>& frame) {
  if (!frame) return std::nullopt;
  return Box{{(*frame)[0], (*frame)[1]}, {(*frame)[2], (*frame)[3]}};
}

std::unique_ptr<VoronoiOf> diagram_of(
    const Coordinates& coordinates, const Values<std::int64_t>& begin,
    const Values<std::uint8_t>& closed, const std::optional<Values<double>>& bulges,
    bool node_crossings, const std::optional<std::array<double, 4>>& frame, const Options& given) {
  const std::vector<Chain> chains = chains_from(coordinates, begin, closed, bulges);
  auto result = std::make_unique<VoronoiOf>();
  Status done = run(coordinates.shape(0), [&](const std::atomic<bool>* cancel) -> Status {
    Options options = given;
    options.cancel = cancel;
    auto planar_graph = build_planar_graph(chains, {node_crossings, 0});
    if (!planar_graph) return std::move(planar_graph).error();
    result->planar_graph = std::move(planar_graph).value();
    auto diagram = voronoi_diagram(result->planar_graph, options, box_from(frame));
    if (!diagram) return std::move(diagram).error();
    result->diagram = std::move(diagram).value();
    return success();
  });
  value_of(std::move(done));
  return result;
}

/// The diagram inside a polygon, by the method `lee` if double precision decides.
std::unique_ptr<VoronoiOf> diagram_inside(const ShapeOf& of, const Options& given) {
  auto diagram = run(of.shape->points.size(), [&](const std::atomic<bool>* cancel) {
    Options options = given;
    options.cancel = cancel;
    return voronoi_diagram(*of.shape, options);
  });
  return std::make_unique<VoronoiOf>(VoronoiOf{{}, value_of(std::move(diagram))});
}

/// The faces as rings: points, and the first point of each face (an empty face has none).
nb::tuple outlines(const VoronoiOf& self, double chord) {
  positive_chord(chord);
  std::vector<Vec2> points;
  std::vector<std::int64_t> begin{0};
  without_lock([&] {
    for (std::size_t site = 0; site < self.diagram.sites.size(); ++site) {
      const std::vector<Vec2> ring = face_outline(self.diagram, site, chord);
      points.insert(points.end(), ring.begin(), ring.end());
      begin.push_back(static_cast<std::int64_t>(points.size()));
    }
    return 0;
  });
  return nb::make_tuple(rows_of<double>(std::move(points)), array_of(std::move(begin)));
}

/// The edges as polylines of x, y, radius; and the first row of each.
nb::tuple edge_lines(const VoronoiOf& self, double chord) {
  positive_chord(chord);
  std::vector<Disk> disks;
  std::vector<std::int64_t> begin{0};
  for (const VoronoiEdge& edge : self.diagram.edges) {
    const std::vector<Disk> samples = sample_by_chord(self.diagram, edge, chord);
    disks.insert(disks.end(), samples.begin(), samples.end());
    begin.push_back(static_cast<std::int64_t>(disks.size()));
  }
  return nb::make_tuple(rows_of<double>(std::move(disks)), array_of(std::move(begin)));
}

/// Columns of the edges: ends, sites, spoke, frame.
nb::tuple edge_columns(const VoronoiOf& self) {
  std::vector<std::array<std::uint32_t, 2>> nodes, sites;
  std::vector<std::uint8_t> spoke, frame;
  for (const VoronoiEdge& edge : self.diagram.edges) {
    nodes.push_back(edge.node);
    sites.push_back(edge.site);
    spoke.push_back(edge.spoke ? 1 : 0);
    frame.push_back(edge.on_enclosure ? 1 : 0);
  }
  return nb::make_tuple(rows_of<std::uint32_t>(std::move(nodes)),
                        rows_of<std::uint32_t>(std::move(sites)), array_of(std::move(spoke)),
                        array_of(std::move(frame)));
}

/// For each point, the nearest site, its distance, and the foot on it.
nb::tuple nearest_sites(const SiteLocator& locator, const Coordinates& points) {
  std::vector<std::int64_t> sites;
  std::vector<double> distances;
  std::vector<Vec2> feet;
  without_lock([&] {
    for (const Vec2 p : points_of(points)) {
      const NearestSite found = locator.nearest(p);
      sites.push_back(found.site == no_site ? -1 : std::int64_t{found.site});
      distances.push_back(found.distance);
      feet.push_back(found.foot);
    }
    return 0;
  });
  return nb::make_tuple(array_of(std::move(sites)), array_of(std::move(distances)),
                        rows_of<double>(std::move(feet)));
}

nb::dict checked(const VoronoiOf& self) {
  const VoronoiCertificate from =
      without_lock([&] { return verify(self.planar_graph, self.diagram); });
  nb::dict result;
  result["passed"] = from.passed;
  result["failures"] = from.failures;
  result["tolerance"] = from.tolerance;
  result["largest_residual"] = from.largest_residual;
  result["largest_contact_gap"] = from.largest_contact_gap;
  result["faces"] = from.faces;
  result["frame_area"] = from.enclosure_area;
  result["faces_area"] = from.faces_area;
  return result;
}

nb::list buffers(const Coordinates& coordinates, const Values<std::int64_t>& begin,
                 const Values<std::uint8_t>& closed, const std::optional<Values<double>>& bulges,
                 bool node_crossings, const Values<double>& distances, int threads) {
  const std::vector<Chain> chains = chains_from(coordinates, begin, closed, bulges);
  Options options;
  options.threads = threads;
  const Offsets offsets =
      value_of(run(coordinates.shape(0), [&](const std::atomic<bool>* cancel) -> Result<Offsets> {
        options.cancel = cancel;
        auto planar_graph = build_planar_graph(chains, {node_crossings, 0});
        if (!planar_graph) return std::move(planar_graph).error();
        return offset_curves(*planar_graph, span_of(distances), options);
      }));
  nb::list list;
  for (const OffsetRegion& region : offsets.regions) {
    nb::list rings;
    for (const Ring& ring : region.rings) {
      std::vector<double> own = ring.bulges;
      own.resize(ring.points.size());
      rings.append(nb::make_tuple(rows_of<double>(ring.points), array_of(std::move(own))));
    }
    list.append(nb::make_tuple(-region.clearance, rings));
  }
  return list;
}

/// Rows of log potential, direction x and y, clearance; NaN outside of the field.
Array<double, 2> sampled(const PotentialField& field, const Coordinates& points) {
  std::vector<std::array<double, 4>> rows;
  without_lock([&] {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    for (const Vec2 p : points_of(points)) {
      const auto at = field.at(p);
      if (at)
        rows.push_back({at->log_potential, at->direction.x, at->direction.y, at->clearance});
      else
        rows.push_back({nothing, nothing, nothing, nothing});
    }
    return 0;
  });
  return rows_of<double>(std::move(rows));
}

struct FieldOf {
  SharedShape shape;
  PotentialField field;
};

}  // namespace

void bind_voronoi(nb::module_& module) {
  const auto of = [](nb::handle self) -> const VoronoiDiagram& {
    return nb::cast<const VoronoiOf&>(self).diagram;
  };
  nb::class_<VoronoiOf>(module, "Voronoi")
      .def("nodes", [of](nb::handle_t<VoronoiOf> self) { return bytes_of(of(self).nodes, self); })
      .def("sites", [of](nb::handle_t<VoronoiOf> self) { return bytes_of(of(self).sites, self); })
      .def("edge_columns", &edge_columns)
      .def("edge_lines", &edge_lines)
      .def("outlines", &outlines)
      .def("verify", &checked)
      .def("locator", [](const VoronoiOf& self) { return SiteLocator(self.diagram.sites); })
      .def("frame", [](const VoronoiOf& self) {
        const Box box = self.diagram.enclosure.value_or(Box{});
        return std::array{box.low.x, box.low.y, box.high.x, box.high.y};
      });
  nb::class_<SiteLocator>(module, "SiteLocator").def("nearest", &nearest_sites);
  module.def("voronoi_of", &diagram_of, nb::arg("coordinates"), nb::arg("begin"), nb::arg("closed"),
             nb::arg("bulges").none(), nb::arg("node_crossings"), nb::arg("frame").none(),
             nb::arg("options"));
  module.def("voronoi_inside", &diagram_inside);
  module.def("buffers", &buffers, nb::arg("coordinates"), nb::arg("begin"), nb::arg("closed"),
             nb::arg("bulges").none(), nb::arg("node_crossings"), nb::arg("distances"),
             nb::arg("threads"));
  nb::class_<FieldOf>(module, "Field")
      .def("sample", [](const FieldOf& self,
                        const Coordinates& points) { return sampled(self.field, points); })
      .def("streamline",
           [](const FieldOf& self, std::array<double, 2> p, double step, std::size_t most) {
             return rows_of<double>(self.field.streamline({p[0], p[1]}, step, most));
           });
  module.def("field_of", [](const ShapeOf& shape, double order) {
    return FieldOf{shape.shape, value_of(PotentialField::make(*shape.shape, order))};
  });
}

}  // namespace medial::python
