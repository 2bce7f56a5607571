// Paths along an axis: main paths, widths, necks, pruning.

#include <cmath>

#include "binding.h"

namespace medial::python {
namespace {

using Point = std::array<double, 2>;
using Place = std::pair<std::uint32_t, double>;  ///< an edge, and the parameter on it

Vec2 vector_of(const Point& p) { return {p[0], p[1]}; }
std::array<double, 3> triple_of(const Disk& disk) {
  return {disk.center.x, disk.center.y, disk.radius};
}

EdgePlace place_of(const AxisOf& self, const Place& place) {
  if (place.first >= self.axis.edges.size()) throw nb::index_error("there is no such edge");
  return {place.first, place.second};
}

/// The pruned axis, and the threshold.
nb::tuple pruned(const AxisOf& self, const std::string& measure, std::optional<double> threshold,
                 std::optional<std::uint64_t> keep, bool tips) {
  PruneReport report;
  const PruneOptions options{measure_from(measure), threshold, keep, tips};
  auto axis = run(self.axis.edges.size(),
                  [&](const std::atomic<bool>*) { return prune(self.axis, options, &report); });
  return nb::make_tuple(share(self.shape, value_of(std::move(axis)), true), report.threshold);
}

Array<double> significance(const AxisOf& self, const std::string& measure) {
  std::vector<double> values;
  const PruneMeasure by = measure_from(measure);
  without_lock([&] {
    const PruneOrder order(self.axis, by);
    for (std::uint32_t e = 0; e < self.axis.edges.size(); ++e) values.push_back(order.of_edge(e));
    return 0;
  });
  return array_of(std::move(values));
}

std::vector<PathOf> paths_of(const AxisOf& self, double trim, const std::string& route) {
  const MainPathOptions options{length_as(trim, "trim"), route_from(route)};
  std::vector<PathOf> paths;
  for (AxisPath& path : without_lock([&] { return main_paths(self.axis, options); }))
    paths.push_back({std::move(path)});
  return paths;
}

/// Converts a path to and from plain values.
using PathState = std::tuple<std::vector<std::tuple<std::uint32_t, double, double>>, bool, double,
                             double, double>;

PathState state_of(const PathOf& of) {
  PathState state{{}, of.path.closed, of.path.length, of.path.narrowest, of.path.gap};
  for (const auto& [edge, from, to] : of.path.pieces)
    std::get<0>(state).emplace_back(edge, from, to);
  return state;
}
PathOf path_of_state(const PathState& state) {
  const auto& [pieces, closed, length, narrowest, gap] = state;
  PathOf of{{{}, closed, length, narrowest, gap}};
  for (const auto& [edge, from, to] : pieces) of.path.pieces.push_back({edge, from, to});
  return of;
}

PathOf path(const AxisOf& self, const Place& from, const Place& to, const std::string& route) {
  const EdgePlace a = place_of(self, from), b = place_of(self, to);
  const bool widest = route == "widest";
  const Route by = widest ? Route::shortest : route_from(route);
  auto found = without_lock(
      [&] { return widest ? widest_path(self.axis, a, b) : path_between(self.axis, a, b, by); });
  return {value_of(std::move(found))};
}

std::unique_ptr<AxisOf> line_of(const AxisOf& self, const PathOf& path, bool extend,
                                double smooth) {
  auto line = without_lock([&] {
    return centre_line(*self.shape, self.axis, path.path, {extend, smooth});
  });
  return share(self.shape, std::move(line), true);
}

/// The side channels of a path: ways around holes that leave it and come back.
std::unique_ptr<AxisOf> channels_of(const AxisOf& self, const PathOf& path) {
  auto part = without_lock([&] { return part_of(self.axis, side_channels(self.axis, path.path)); });
  return share(self.shape, std::move(part), true);
}

/// Rows of along, x, y, radius, left foot, right foot.
using WidthRow = std::array<double, 8>;
WidthRow row_of(const LocalWidth& width) {
  const auto& [along, disk, feet] = width;
  return {along,     disk.center.x, disk.center.y, disk.radius,
          feet[0].x, feet[0].y,     feet[1].x,     feet[1].y};
}

/// Rows at given lengths along a path: the feet of disks, or the ends of transects across the
/// course.
Array<double, 2> widths(const AxisOf& self, const PathOf& path, const Values<double>& lengths,
                        bool across) {
  const auto at = span_of(lengths);
  double before = 0;
  for (const double length : at) {
    if (!(length >= before && length <= path.path.length))
      refuse(ErrorCode::invalid_option, "lengths increase from 0 to the length of the path");
    before = length;
  }
  std::vector<WidthRow> rows;
  const auto found = without_lock([&] {
    return across ? transects_along(*self.shape, self.axis, path.path, at)
                  : widths_along(self.axis, path.path, at);
  });
  for (const LocalWidth& width : found) rows.push_back(row_of(width));
  return rows_of<double>(std::move(rows));
}

/// Rows of a width's numbers, then opens_to, around_hole, edge, t.
Array<double, 2> neck_rows(const AxisOf& self, double widening) {
  if (!(widening > 1)) refuse(ErrorCode::invalid_option, "widening must be above 1");
  std::vector<std::array<double, 12>> rows;
  for (const Neck& neck : without_lock([&] { return necks(self.axis, widening); })) {
    const WidthRow w = row_of(neck.width);
    rows.push_back({w[0], w[1], w[2], w[3], w[4], w[5], w[6], w[7], neck.opens_to,
                    neck.around_hole ? 1.0 : 0.0, double(neck.place.edge), neck.place.t});
  }
  return rows_of<double>(std::move(rows));
}

nb::dict mean_widths(const AxisOf& self, const PathOf& path) {
  const MeanWidth mean = without_lock([&] { return mean_width(self.axis, path.path); });
  nb::dict result;
  result["length"] = mean.length;
  result["area"] = mean.area;
  result["by_length"] = mean.by_length;
  result["by_area"] = mean.by_area;
  result["area_by_length"] = mean.area_by_length;
  return result;
}

Array<double, 2> disks(const ShapeOf& of, std::size_t count, double smallest) {
  return rows_of<double>(run(of.shape->points.size(), [&](const std::atomic<bool>*) {
    return largest_disjoint_disks(*of.shape, count, smallest);
  }));
}

nb::tuple collapsed(const AxisOf& self, double width, double trim, double corner_angle) {
  CollapsedShape result =
      value_of(without_lock([&] { return collapse_narrow(self.axis, width, trim, corner_angle); }));
  auto shape = std::make_shared<const Shape>(std::move(result.polygons));
  return nb::make_tuple(ShapeOf{shape}, share(shape, std::move(result.lines), true));
}

std::optional<Place> place_at(const AxisOf& self, const Point& p) {
  const auto place = without_lock([&] { return place_on_axis(self.axis, vector_of(p)); });
  if (!place) return std::nullopt;
  return Place{place->edge, place->t};
}

/// The middle of the side that begins at a vertex of an input ring, if the shape has it.
std::optional<Point> middle_of_side(const ShapeOf& of, std::uint32_t ring, std::uint32_t vertex) {
  const Shape& shape = *of.shape;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    for (std::uint32_t k = shape.loop_begin[i]; k < shape.loop_begin[i + 1]; ++k) {
      if (shape.sources[k].ring != ring || shape.sources[k].vertex != vertex) continue;
      const Vec2 start = shape.points[k];
      const Vec2 end = shape.points[k + 1 < shape.loop_begin[i + 1] ? k + 1 : shape.loop_begin[i]];
      const Vec2 p = midpoint(start, end) - (shape.bulge(k) / 2) * left_of(end - start);
      return Point{p.x, p.y};
    }
  }
  return std::nullopt;
}

}  // namespace

Route route_from(const std::string& name) {
  if (name == "roomy") return Route::roomy;
  if (name == "shortest") return Route::shortest;
  refuse(ErrorCode::invalid_option, "route is 'roomy' or 'shortest'");
}

PruneMeasure measure_from(const std::string& name) {
  if (const auto measure = prune_measure_from(name)) return *measure;
  throw Failure(Error{ErrorCode::invalid_option,
                      "there is no measure '" + name + "'; medial.prune_measures() lists them",
                      {}});
}

void bind_paths(nb::module_& module) {
  nb::class_<PathOf>(module, "Path")
      .def_prop_ro("length", [](const PathOf& self) { return self.path.length; })
      .def_prop_ro("narrowest", [](const PathOf& self) { return self.path.narrowest; })
      .def_prop_ro("closed", [](const PathOf& self) { return self.path.closed; })
      .def_prop_ro("gap", [](const PathOf& self) { return self.path.gap; })
      .def_prop_ro("pieces",
                   [](const PathOf& self) {
                     std::vector<std::tuple<std::uint32_t, double, double>> pieces;
                     for (const auto& [edge, from, to] : self.path.pieces)
                       pieces.emplace_back(edge, from, to);
                     return pieces;
                   })
      .def("__getstate__", &state_of)
      .def("__setstate__",
           [](PathOf& self, const PathState& state) { new (&self) PathOf(path_of_state(state)); });
  module.def("pruned", &pruned, nb::arg("axis"), nb::arg("measure"), nb::arg("threshold").none(),
             nb::arg("keep").none(), nb::arg("tips"));
  module.def("significance", &significance);
  module.def("prune_measures", [] {
    std::vector<std::pair<std::string, double>> list;
    for (const PruneMeasure measure : prune_measures())
      list.emplace_back(name_of(measure), default_threshold(measure));
    return list;
  });
  module.def("main_paths", &paths_of);
  module.def("path_between", &path);
  module.def("centre_line", &line_of);
  module.def("side_channels", &channels_of);
  module.def("middle_of_side", &middle_of_side);
  module.def("widths", &widths);
  module.def("necks", &neck_rows);
  module.def("mean_widths", &mean_widths);
  module.def("disjoint_disks", &disks);
  module.def("collapsed", &collapsed);
  module.def("place_at", &place_at);
  module.def("deepest_disk", [](const AxisOf& self) {
    if (self.axis.nodes.empty()) refuse(ErrorCode::empty, "the axis has no node");
    return triple_of(deepest_disk(self.axis));
  });
  module.def("clearance_part", [](const AxisOf& self, double clearance) {
    auto part = without_lock([&] { return clearance_part(self.axis, clearance); });
    return share(self.shape, std::move(part), true);
  });
}

}  // namespace medial::python
