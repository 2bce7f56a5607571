// The axes of many features at once, as one struct of arrays.

#include <algorithm>
#include <numeric>

#include "binding.h"

namespace medial::python {
namespace {

/// The axes of features, one after another. Indices in nodes and edges are those of one feature.
struct AxesOf {
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  std::vector<Site> sites;
  std::vector<std::int64_t> node_begin{0}, edge_begin{0}, site_begin{0};
  std::vector<std::pair<std::int64_t, Error>> errors;  ///< feature and what went wrong
  std::string method;
  std::vector<double> tolerance, resolution;  ///< of each feature
  double exterior = 0;

  std::size_t size() const { return node_begin.size() - 1; }

  void reserve(double times) {
    const auto more = [times](auto& values) {
      values.reserve(static_cast<std::size_t>(times * static_cast<double>(values.size())));
    };
    more(nodes), more(edges), more(sites);
    more(node_begin), more(edge_begin), more(site_begin);
    more(tolerance), more(resolution);
  }
  void add(const MedialAxis& axis) {
    nodes.insert(nodes.end(), axis.nodes.begin(), axis.nodes.end());
    edges.insert(edges.end(), axis.edges.begin(), axis.edges.end());
    sites.insert(sites.end(), axis.sites.begin(), axis.sites.end());
    if (method.empty()) method = axis.method;
    end_feature(axis.tolerance, axis.resolution);
  }
  void end_feature(double own_tolerance, double own_resolution) {
    node_begin.push_back(static_cast<std::int64_t>(nodes.size()));
    edge_begin.push_back(static_cast<std::int64_t>(edges.size()));
    site_begin.push_back(static_cast<std::int64_t>(sites.size()));
    tolerance.push_back(own_tolerance);
    resolution.push_back(own_resolution);
  }
};

/// Features as rings of coordinates with offsets, as shapely.to_ragged_array() has them.
struct Features {
  std::span<const Vec2> points;
  std::span<const std::int64_t> ring, polygon, feature;  ///< feature: empty, a polygon each

  std::size_t count() const { return feature.empty() ? polygon.size() - 1 : feature.size() - 1; }
  std::pair<std::size_t, std::size_t> polygons(std::size_t i) const {
    if (feature.empty()) return {i, i + 1};
    return {static_cast<std::size_t>(feature[i]), static_cast<std::size_t>(feature[i + 1])};
  }
  double weight(std::size_t first, std::size_t last) const {
    const std::size_t from = polygons(first).first, to = polygons(last - 1).second;
    return static_cast<double>(ring[static_cast<std::size_t>(polygon[to])] -
                               ring[static_cast<std::size_t>(polygon[from])]);
  }
  /// The rings of a feature; the space of `rings` is used again.
  void rings(std::size_t i, std::vector<Ring>& rings) const {
    std::size_t used = 0;
    const auto [from, to] = polygons(i);
    for (std::size_t p = from; p < to; ++p) {
      for (auto r = static_cast<std::size_t>(polygon[p]);
           r < static_cast<std::size_t>(polygon[p + 1]); ++r) {
        if (used == rings.size()) rings.emplace_back();
        Ring& ring_to = rings[used++];
        const auto part = points.subspan(static_cast<std::size_t>(ring[r]),
                                         static_cast<std::size_t>(ring[r + 1] - ring[r]));
        ring_to.points.assign(part.begin(), part.end());
        ring_to.role =
            static_cast<std::int64_t>(r) == polygon[p] ? RingRole::outer : RingRole::hole;
      }
    }
    rings.resize(used);
  }
};

void check_offsets(std::span<const std::int64_t> offsets, std::size_t end) {
  if (offsets.empty() || offsets.front() != 0 || !std::ranges::is_sorted(offsets) ||
      static_cast<std::size_t>(offsets.back()) > end)
    refuse(ErrorCode::malformed,
           "offsets begin with 0 and increase up to the number of what they divide");
}

Features features_of(const Coordinates& coordinates, const Values<std::int64_t>& ring,
                     const Values<std::int64_t>& polygon,
                     const std::optional<Values<std::int64_t>>& feature) {
  Features all{points_of(coordinates), span_of(ring), span_of(polygon), {}};
  check_offsets(all.ring, all.points.size());
  check_offsets(all.polygon, all.ring.size() - 1);
  if (!feature) return all;
  check_offsets(span_of(*feature), all.polygon.size() - 1);
  all.feature = span_of(*feature);
  return all;
}

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
    result.end_feature(0, 0);
  }
}

template <class T>
void append(std::vector<T>& to, std::vector<T>& part) {
  to.insert(to.end(), part.begin(), part.end());
  std::vector<T>().swap(part);
}
void append_offsets(std::vector<std::int64_t>& to, const std::vector<std::int64_t>& part) {
  const std::int64_t shift = to.back();
  for (std::size_t i = 1; i < part.size(); ++i) to.push_back(part[i] + shift);
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
    std::ranges::move(part.errors, std::back_inserter(all.errors));
    if (all.method.empty()) all.method = part.method;
  }
  return all;
}

constexpr std::size_t block = 256;  ///< features that one thread computes at a time

std::unique_ptr<AxesOf> axes_of(const Coordinates& coordinates, const Values<std::int64_t>& ring,
                                const Values<std::int64_t>& polygon,
                                const std::optional<Values<std::int64_t>>& feature,
                                const Options& options, const nb::object& progress) {
  const Features features = features_of(coordinates, ring, polygon, feature);
  const std::size_t count = features.count(), blocks = (count + block - 1) / block;
  // One thread computes block after block, and needs no parts to be joined.
  const bool in_order = effective_threads(options.threads) == 1;
  std::vector<AxesOf> parts(in_order ? 1 : blocks);
  std::vector<double> weights;
  for (std::size_t b = 0; b < blocks; ++b)
    weights.push_back(features.weight(b * block, std::min(count, (b + 1) * block)) + 1);
  // What the first block needs, extrapolated to all; more than is used costs no memory.
  const double expected =
      blocks == 0 ? 0 : 1.05 * std::accumulate(weights.begin(), weights.end(), 0.0) / weights[0];
  const bool reports = !progress.is_none();
  auto done = run(features.points.size(), [&](const std::atomic<bool>* cancel) {
    const auto one_block = [&](std::size_t b, int threads) -> Status {
      Options own = options;
      own.threads = threads;
      own.cancel = cancel;
      const std::size_t last = std::min(count, (b + 1) * block);
      add_range(features, b * block, last, own, parts[in_order ? 0 : b]);
      if (in_order && b == 0) parts[0].reserve(expected);
      if (reports) {
        const nb::gil_scoped_acquire held;
        try {
          progress(last - b * block);
        } catch (nb::python_error& error) {
          error.discard_as_unraisable("progress of medial.axes()");
        }
      }
      return success();
    };
    return for_each_item(weights, options.threads, one_block, cancel);
  });
  value_of(std::move(done));
  return std::make_unique<AxesOf>(
      without_lock([&] { return parts.empty() ? AxesOf{} : joined(parts); }));
}

/// The nodes and edges of a feature, in the memory of the one before.
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
          all.exterior,
          part(all.sites, all.site_begin),
          part(all.nodes, all.node_begin),
          part(all.edges, all.edge_begin),
          {}};
}

/// Polylines along the branches of all features: rows of x, y, radius; where lines begin; where
/// features begin among the lines.
nb::tuple lines_of(const AxesOf& all, double chord, bool relative) {
  std::vector<Disk> disks;
  std::vector<std::int64_t> line_begin{0}, feature_begin{0};
  without_lock([&] {
    disks.reserve(all.edges.size() * 2);
    MedialAxis axis;
    for (std::size_t i = 0; i < all.size(); ++i) {
      take_graph(all, i, axis);
      Box box = Box::nothing();
      for (const Node& node : axis.nodes) box.add(node.disk.center);
      const double own = relative && !axis.nodes.empty() ? chord * diagonal(box) : chord;
      for (const Branch& branch : branches(axis)) {
        bool first = true;
        for (const Step& step : branch.steps) {
          const Edge& edge = axis.edges[step.edge];
          std::vector<Disk> samples = sample_by_chord(axis, edge, own > 0 ? own : 1);
          if (!step.forward) std::ranges::reverse(samples);
          disks.insert(disks.end(), samples.begin() + (first ? 0 : 1), samples.end());
          first = false;
        }
        line_begin.push_back(static_cast<std::int64_t>(disks.size()));
      }
      feature_begin.push_back(static_cast<std::int64_t>(line_begin.size()) - 1);
    }
    return 0;
  });
  return nb::make_tuple(rows_of<double>(std::move(disks)), array_of(std::move(line_begin)),
                        array_of(std::move(feature_begin)));
}

/// Rows of (length of the axis, largest radius, x, y of it) for each feature.
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

nb::list errors_of(const AxesOf& all) {
  nb::list list;
  const auto number = [](const auto& value) { return value ? nb::cast(*value) : nb::none(); };
  for (const auto& [feature, error] : all.errors) {
    nb::object point = nb::none();
    if (error.place.point) point = nb::make_tuple(error.place.point->x, error.place.point->y);
    list.append(nb::make_tuple(error.text, name_of(error.code), feature, number(error.place.ring),
                               number(error.place.vertex), point));
  }
  return list;
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
      .def("errors", &errors_of)
      .def("method", [](const AxesOf& self) { return self.method; })
      .def("lines", &lines_of, nb::arg("chord"), nb::arg("relative"))
      .def("summary", &summary)
      .def("axis", [](const AxesOf& self, std::size_t i, const ShapeOf& shape) {
        if (i >= self.size()) throw nb::index_error("there is no such feature");
        return share(shape.shape, axis_of(self, i));
      });
  module.def("axes_of", &axes_of, nb::arg("coordinates"), nb::arg("ring"), nb::arg("polygon"),
             nb::arg("feature").none(), nb::arg("options"), nb::arg("progress").none());
}

}  // namespace medial::python
