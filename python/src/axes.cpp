// Axes of single shapes: computation, arrays, queries.

#include "faces/axes.h"

#include <algorithm>
#include <cmath>

#include "binding.h"
#include "signed_distance.h"

namespace medial::python {
namespace {

/// Moves options by name into variables, and refuses unknown ones.
class Named {
 public:
  explicit Named(const nb::dict& from) : left_(nb::borrow<nb::dict>(from.attr("copy")())) {}

  template <class T>
  Named& take(const char* name, T& to) {
    if (!left_.contains(name)) return *this;
    to = option_as<T>(left_[name], name);
    nb::del(left_[name]);
    return *this;
  }
  void finish(const std::string& method) const {
    if (left_.size() == 0) return;
    const std::string name = nb::cast<std::string>(nb::str((*left_.begin()).first));
    throw nb::type_error(("the method '" + method + "' has no option '" + name + "'").c_str());
  }

 private:
  nb::dict left_;
};

std::unique_ptr<AxisOf> compute_axis(const ShapeOf& of, const Options& given,
                                     std::span<const Contour> contours) {
  Options options = given;
  if (options.threads == 0 && of.shape->points.size() < fine_work) options.threads = 1;
  auto axis = run(of.shape->points.size(), [&](const std::atomic<bool>* cancel) {
    options.cancel = cancel;
    return compute(*of.shape, options, contours);
  });
  return share(of.shape, value_of(std::move(axis)));
}

/// Makes an axis from the arrays of a stored one.
std::unique_ptr<AxisOf> restored(const ShapeOf& of, const std::string& method, double tolerance,
                                 double resolution, double exterior, bool part,
                                 const Values<std::uint8_t>& sites,
                                 const Values<std::uint8_t>& nodes,
                                 const Values<std::uint8_t>& edges) {
  MedialAxis axis{method,
                  tolerance,
                  resolution,
                  exterior,
                  records_from<Site>(sites),
                  records_from<Node>(nodes),
                  records_from<Edge>(edges),
                  {}};
  return share(of.shape, value_of(faces::sound(std::move(axis))), part);
}

/// Polylines along all branches, within a chord or with steps: rows of x, y, radius, and the first
/// row of each polyline.
std::pair<Array<double, 2>, Array<std::int64_t>> lines(const AxisOf& self, double chord,
                                                       double step) {
  positive_chord(chord);
  if (!(step >= 0)) refuse(ErrorCode::invalid_option, "step must be at least 0");
  std::vector<Disk> disks;
  std::vector<std::int64_t> begin{0};
  without_lock([&] {
    add_lines(self.axis, chord, step, disks, begin);
    return 0;
  });
  return {rows_of<double>(std::move(disks)), array_of(std::move(begin))};
}

/// The result of nearest() for a point.
struct Nearest {
  double x, y, radius, distance, t;
  std::int64_t edge;
};

Bytes nearest(const AxisOf& self, const Coordinates& points) {
  std::vector<Nearest> found;
  without_lock([&] {
    const AxisLocator& locator = self.locator();
    for (const Vec2 p : points_of(points)) {
      const AxisPoint at = locator.nearest(p);
      found.push_back({at.disk.center.x, at.disk.center.y, at.disk.radius, at.distance, at.t,
                       std::isfinite(at.distance) ? std::int64_t{at.edge} : -1});
    }
    return 0;
  });
  return records_of(std::move(found));
}

Array<double> clearances(const ShapeOf& of, const Coordinates& points) {
  std::vector<double> result;
  without_lock([&] {
    const SignedDistance distance(*of.shape);
    for (const Vec2 p : points_of(points)) result.push_back(distance.at(p));
    return 0;
  });
  return array_of(std::move(result));
}

Array<double> edge_lengths(const AxisOf& self) {
  std::vector<double> lengths;
  for (const Edge& edge : self.axis.edges) lengths.push_back(length(self.axis, edge));
  return array_of(std::move(lengths));
}

/// The steps of all branches (edge and direction), and the first step of each branch.
nb::tuple branch_steps(const AxisOf& self) {
  std::vector<std::uint32_t> edges;
  std::vector<std::uint8_t> forward;
  std::vector<std::int64_t> begin{0};
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (const Branch& branch : branches(self.axis)) {
    for (const Step& step : branch.steps) {
      edges.push_back(step.edge);
      forward.push_back(step.forward ? 1 : 0);
    }
    ends.push_back({branch.from, branch.to});
    begin.push_back(static_cast<std::int64_t>(edges.size()));
  }
  return nb::make_tuple(array_of(std::move(edges)), array_of(std::move(forward)),
                        array_of(std::move(begin)), rows_of<std::uint32_t>(std::move(ends)));
}

nb::dict statistics(const AxisOf& self) {
  const Statistics& from = self.axis.statistics;
  nb::dict result;
  result["queries"] = from.queries;
  result["apollonius"] = from.apollonius;
  result["brackets"] = from.brackets;
  result["precision_retries"] = from.precision_retries;
  result["bridges"] = from.bridges;
  result["largest_residual"] = from.largest_residual;
  result["seconds"] = from.seconds;
  result["threads"] = from.threads;
  return result;
}

void bind_compute(nb::module_& module) {
  nb::class_<Options>(module, "Options")
      .def("__init__",
           [](Options* self, const std::string& method, double tolerance, double corner_angle,
              bool exact, int threads, bool exterior, double margin, const nb::dict& own) {
             new (self) Options(options_of(method, tolerance, corner_angle, exact, threads,
                                           exterior, margin, own));
           });
  module.def("compute",
             [](const ShapeOf& of, const Options& options, const std::vector<Contour>& contours) {
               return compute_axis(of, options, contours);
             });
  // The fast path: one ring, no curves.
  module.def("axis_of_ring", [](const Coordinates& ring, const Options& options) {
    const Ring rings[1] = {rings_of(ring, {}, {}, {}).front()};
    auto shape = value_of(without_lock([&] { return build_shape(rings); }));
    return compute_axis({std::make_shared<const Shape>(std::move(shape))}, options, {});
  });
  module.def("restored_axis", &restored);
}

}  // namespace

Options options_of(const std::string& method, double tolerance, double corner_angle, bool exact,
                   int threads, bool exterior, double margin, const nb::dict& own) {
  const auto found = method_from(method);
  if (!found)
    throw Failure(Error{ErrorCode::invalid_option,
                        "there is no method '" + method + "'; medial.methods() lists them",
                        {}});
  if (threads < 0 || threads > most_threads)
    refuse(ErrorCode::invalid_option, "the number of threads must be in [0, 1024]");
  Options options;
  options.method = *found;
  options.tolerance = tolerance;
  options.corner_angle = corner_angle;
  options.exact = exact;
  options.threads = threads;
  options.exterior = exterior;
  options.margin = margin;
  if (own.size() > 0) {
    Named named(own);
    value_of(faces::take_own(named, options.method));
    named.finish(method);
  }
  return options;
}

void add_lines(const MedialAxis& axis, double chord, double step, std::vector<Disk>& disks,
               std::vector<std::int64_t>& begin) {
  faces::add_lines(axis, chord, step, disks, begin);
}

void bind_axes(nb::module_& module) {
  const auto of = [](nb::handle self) -> const MedialAxis& {
    return nb::cast<const AxisOf&>(self).axis;
  };
  nb::class_<AxisOf>(module, "Axis")
      .def("nodes", [of](nb::handle_t<AxisOf> self) { return bytes_of(of(self).nodes, self); })
      .def("edges", [of](nb::handle_t<AxisOf> self) { return bytes_of(of(self).edges, self); })
      .def("sites", [of](nb::handle_t<AxisOf> self) { return bytes_of(of(self).sites, self); })
      .def("shape", [](const AxisOf& self) { return ShapeOf{self.shape}; })
      .def("method", [](const AxisOf& self) { return self.axis.method; })
      .def("tolerance", [](const AxisOf& self) { return self.axis.tolerance; })
      .def("resolution", [](const AxisOf& self) { return self.axis.resolution; })
      .def("exterior", [](const AxisOf& self) { return self.axis.exterior; })
      .def("part", [](const AxisOf& self) { return self.part; })
      .def("statistics", &statistics)
      .def("lines", &lines, nb::arg("chord"), nb::arg("step"))
      .def("nearest", &nearest)
      .def("edge_lengths", &edge_lengths)
      .def("total_length", [](const AxisOf& self) { return total_length(self.axis); })
      .def("branch_count", [](const AxisOf& self) { return branch_count(self.axis); })
      .def("branch_steps", &branch_steps)
      .def("disk_at", [](const AxisOf& self, std::uint32_t edge, double t) {
        if (edge >= self.axis.edges.size()) throw nb::index_error("there is no such edge");
        const Disk disk = disk_at(self.axis, self.axis.edges[edge], t);
        return std::array{disk.center.x, disk.center.y, disk.radius};
      });
  module.def("clearances", &clearances);
  static_assert(sizeof(Node) == 32 && sizeof(Edge) == 48 && sizeof(Site) == 48);
  bind_compute(module);
}

}  // namespace medial::python
