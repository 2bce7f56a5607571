// The axes of many features at once, as a struct of arrays.

#include <algorithm>
#include <numeric>

#include "faces/axes.h"
#include "many.h"

namespace medial::python {
namespace {

/// The axes of features, concatenated. Indices in nodes and edges count within one feature.
struct AxesOf {
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  std::vector<Site> sites;
  std::vector<std::int64_t> node_begin{0}, edge_begin{0}, site_begin{0};
  FeatureErrors errors;
  std::string method;
  std::vector<double> tolerance, resolution, exterior;  ///< of each feature

  std::size_t size() const { return node_begin.size() - 1; }

  void reserve(double times) {
    const auto more = [times](auto& values) {
      values.reserve(static_cast<std::size_t>(times * static_cast<double>(values.size())));
    };
    more(nodes), more(edges), more(sites);
    more(node_begin), more(edge_begin), more(site_begin);
    more(tolerance), more(resolution), more(exterior);
  }
  void add(const MedialAxis& axis) {
    nodes.insert(nodes.end(), axis.nodes.begin(), axis.nodes.end());
    edges.insert(edges.end(), axis.edges.begin(), axis.edges.end());
    sites.insert(sites.end(), axis.sites.begin(), axis.sites.end());
    if (method.empty()) method = axis.method;
    end_feature(axis.tolerance, axis.resolution, axis.exterior);
  }
  void end_feature(double own_tolerance, double own_resolution, double own_exterior) {
    node_begin.push_back(static_cast<std::int64_t>(nodes.size()));
    edge_begin.push_back(static_cast<std::int64_t>(edges.size()));
    site_begin.push_back(static_cast<std::int64_t>(sites.size()));
    tolerance.push_back(own_tolerance);
    resolution.push_back(own_resolution);
    exterior.push_back(own_exterior);
  }
};

/// Appends the axes of features [first, last).
void add_range(const Features& features, std::size_t first, std::size_t last,
               const Options& options, AxesOf& result) {
  std::vector<Ring> rings;
  for (std::size_t i = first; i < last && !*options.cancel; ++i) {
    features.rings(i, rings);
    auto shape = build_shape(rings);
    auto axis = shape ? compute(*shape, options) : Result<MedialAxis>(std::move(shape).error());
    if (axis) {
      result.add(*axis);
      continue;
    }
    axis.error().place.feature = i;
    result.errors.emplace_back(static_cast<std::int64_t>(i), std::move(axis).error());
    result.end_feature(0, 0, 0);
  }
}

AxesOf joined(std::vector<AxesOf>& parts) {
  if (parts.size() == 1) return std::move(parts.front());
  AxesOf all;
  std::size_t nodes = 0, edges = 0, sites = 0;
  for (const AxesOf& part : parts) {
    nodes += part.nodes.size();
    edges += part.edges.size();
    sites += part.sites.size();
  }
  all.nodes.reserve(nodes);
  all.edges.reserve(edges);
  all.sites.reserve(sites);
  for (AxesOf& part : parts) {
    append(all.nodes, part.nodes);
    append(all.edges, part.edges);
    append(all.sites, part.sites);
    append_offsets(all.node_begin, part.node_begin);
    append_offsets(all.edge_begin, part.edge_begin);
    append_offsets(all.site_begin, part.site_begin);
    append(all.tolerance, part.tolerance);
    append(all.resolution, part.resolution);
    append(all.exterior, part.exterior);
    append(all.errors, part.errors);
    if (all.method.empty()) all.method = part.method;
  }
  return all;
}

std::unique_ptr<AxesOf> axes_of(const Coordinates& coordinates, const Values<std::int64_t>& ring,
                                const Values<std::int64_t>& polygon,
                                const std::optional<Values<std::int64_t>>& feature,
                                const std::optional<Values<double>>& bulges, const Options& options,
                                const nb::object& progress) {
  const Features features = features_of(coordinates, ring, polygon, feature, bulges);
  const std::size_t count = features.count();
  // One thread computes block after block into one part, so nothing needs to be joined.
  const bool in_order = effective_threads(options.threads) == 1;
  std::vector<AxesOf> parts(in_order ? 1 : (count + block - 1) / block);
  for_each_block(features, options, progress,
                 [&](std::size_t first, std::size_t last, const Options& own) {
                   add_range(features, first, last, own, parts[in_order ? 0 : first / block]);
                   if (!in_order || first > 0) return;
                   // Extrapolates the size of the first block; reserved memory that stays unused
                   // costs nothing.
                   parts[0].reserve(1.05 * features.weight(0, count) /
                                    std::max(features.weight(first, last), 1.0));
                 });
  return std::make_unique<AxesOf>(
      without_lock([&] { return parts.empty() ? AxesOf{} : joined(parts); }));
}

/// Gets the nodes and edges of a feature, and reuses the memory of the previous one.
void take_graph(const AxesOf& all, std::size_t i, MedialAxis& axis) {
  axis.nodes.assign(all.nodes.begin() + all.node_begin[i],
                    all.nodes.begin() + all.node_begin[i + 1]);
  axis.edges.assign(all.edges.begin() + all.edge_begin[i],
                    all.edges.begin() + all.edge_begin[i + 1]);
}

MedialAxis axis_of(const AxesOf& all, std::size_t i) {
  const auto part = [i](const auto& values, const std::vector<std::int64_t>& begin) {
    return std::vector(values.begin() + begin[i], values.begin() + begin[i + 1]);
  };
  return {all.method,
          all.tolerance[i],
          all.resolution[i],
          all.exterior[i],
          part(all.sites, all.site_begin),
          part(all.nodes, all.node_begin),
          part(all.edges, all.edge_begin),
          {}};
}

/// Converts to and from arrays of axes without errors.
nb::tuple state_of(const AxesOf& all) {
  return nb::make_tuple(
      all.method, records_of(all.nodes), records_of(all.edges), records_of(all.sites),
      nb::make_tuple(array_of(all.node_begin), array_of(all.edge_begin), array_of(all.site_begin)),
      nb::make_tuple(array_of(all.tolerance), array_of(all.resolution), array_of(all.exterior)));
}

std::unique_ptr<AxesOf> restored_axes(const std::string& method, const Values<std::uint8_t>& nodes,
                                      const Values<std::uint8_t>& edges,
                                      const Values<std::uint8_t>& sites,
                                      const std::array<Values<std::int64_t>, 3>& begin,
                                      const std::array<Values<double>, 3>& numbers) {
  const auto copied = [](const auto& values) {
    const auto all = span_of(values);
    return std::vector(all.begin(), all.end());
  };
  auto all = std::make_unique<AxesOf>();
  all->method = method;
  all->nodes = records_from<Node>(nodes);
  all->edges = records_from<Edge>(edges);
  all->sites = records_from<Site>(sites);
  all->node_begin = copied(begin[0]);
  all->edge_begin = copied(begin[1]);
  all->site_begin = copied(begin[2]);
  all->tolerance = copied(numbers[0]);
  all->resolution = copied(numbers[1]);
  all->exterior = copied(numbers[2]);
  check_offsets(all->node_begin, all->nodes.size());
  check_offsets(all->edge_begin, all->edges.size());
  check_offsets(all->site_begin, all->sites.size());
  for (const auto& values : numbers)
    if (values.shape(0) != all->size() || begin[1].shape(0) != begin[0].shape(0) ||
        begin[2].shape(0) != begin[0].shape(0))
      refuse(ErrorCode::malformed, "the arrays of the axes do not fit together");
  for (std::size_t i = 0; i < all->size(); ++i) value_of(faces::sound(axis_of(*all, i)));
  return all;
}

/// Polylines along the branches of features [first, last): rows of x, y, radius, or if `flat` of x,
/// y; the first row of each line; the first line of each feature.
nb::tuple lines_of(const AxesOf& all, double chord, bool relative, std::size_t first,
                   std::size_t last, bool flat) {
  positive_chord(chord);
  if (first > last || last > all.size()) throw nb::index_error("there are no such features");
  std::vector<Disk> disks;
  std::vector<Vec2> centers;
  std::vector<std::int64_t> line_begin{0}, feature_begin{0};
  without_lock([&] {
    disks.reserve(2 * static_cast<std::size_t>(all.edge_begin[last] - all.edge_begin[first]));
    MedialAxis axis;
    for (std::size_t i = first; i < last; ++i) {
      take_graph(all, i, axis);
      Box box = Box::nothing();
      for (const Node& node : axis.nodes) box.add(node.disk.center);
      const double own = relative && !axis.nodes.empty() ? chord * diagonal(box) : chord;
      add_lines(axis, own > 0 ? own : 1, 0, disks, line_begin);
      feature_begin.push_back(static_cast<std::int64_t>(line_begin.size()) - 1);
    }
    if (!flat) return 0;
    centers.reserve(disks.size());
    for (const Disk& disk : disks) centers.push_back(disk.center);
    return 0;
  });
  auto rows = flat ? rows_of<double>(std::move(centers)) : rows_of<double>(std::move(disks));
  return nb::make_tuple(std::move(rows), array_of(std::move(line_begin)),
                        array_of(std::move(feature_begin)));
}

/// One row per feature: length of the axis, largest radius, and its x, y.
Array<double, 2> summary(const AxesOf& all) {
  std::vector<std::array<double, 4>> rows;
  without_lock([&] {
    MedialAxis axis;
    for (std::size_t i = 0; i < all.size(); ++i) {
      take_graph(all, i, axis);
      if (axis.nodes.empty()) {
        rows.push_back({std::nan(""), std::nan(""), std::nan(""), std::nan("")});
        continue;
      }
      const Disk deepest = deepest_disk(axis);
      rows.push_back({total_length(axis), deepest.radius, deepest.center.x, deepest.center.y});
    }
    return 0;
  });
  return rows_of<double>(std::move(rows));
}

}  // namespace

void bind_collections(nb::module_& module) {
  const auto of = [](nb::handle self) -> const AxesOf& { return nb::cast<const AxesOf&>(self); };
  nb::class_<AxesOf>(module, "Axes")
      .def("__len__", &AxesOf::size)
      .def("nodes", [of](nb::handle_t<AxesOf> self) { return bytes_of(of(self).nodes, self); })
      .def("edges", [of](nb::handle_t<AxesOf> self) { return bytes_of(of(self).edges, self); })
      .def("sites", [of](nb::handle_t<AxesOf> self) { return bytes_of(of(self).sites, self); })
      .def("node_begin",
           [of](nb::handle_t<AxesOf> self) { return bytes_of(of(self).node_begin, self); })
      .def("edge_begin",
           [of](nb::handle_t<AxesOf> self) { return bytes_of(of(self).edge_begin, self); })
      .def("site_begin",
           [of](nb::handle_t<AxesOf> self) { return bytes_of(of(self).site_begin, self); })
      .def("errors", [](const AxesOf& self) { return list_of(self.errors); })
      .def("method", [](const AxesOf& self) { return self.method; })
      .def("state", &state_of)
      .def("lines", &lines_of, nb::arg("chord"), nb::arg("relative"), nb::arg("first"),
           nb::arg("last"), nb::arg("flat"))
      .def("summary", &summary)
      .def("axis", [](const AxesOf& self, std::size_t i, const ShapeOf& shape) {
        if (i >= self.size()) throw nb::index_error("there is no such feature");
        return share(shape.shape, axis_of(self, i));
      });
  module.def("restored_axes", &restored_axes);
  module.def("axes_of", &axes_of, nb::arg("coordinates"), nb::arg("ring"), nb::arg("polygon"),
             nb::arg("feature").none(), nb::arg("bulges").none(), nb::arg("options"),
             nb::arg("progress").none());
}

}  // namespace medial::python
