// Shapes, and contours of curves.

#include "binding.h"
#include "faces/axes.h"

namespace medial::python {
namespace {

Vec2 point_of(const std::array<double, 2>& p) { return {p[0], p[1]}; }

RingRole role_from(std::uint8_t role) {
  if (role > static_cast<std::uint8_t>(RingRole::winding))
    refuse(ErrorCode::invalid_option, "a ring's role is 0 any, 1 outer, 2 hole or 3 winding");
  return static_cast<RingRole>(role);
}

/// A shape and its contours, for methods that follow curves.
struct Loaded {
  ShapeOf shape;
  std::vector<Contour> contours;
  std::vector<std::string> notes;
};

Loaded load(std::vector<Ring> rings, std::vector<Contour> contours,
            const std::optional<std::string>& repair, double arc_tolerance, double fit,
            bool keep_contours, int threads) {
  std::size_t size = 0;
  for (const Ring& ring : rings) size += ring.points.size();
  LoadOptions options;
  options.repair = repair_from(repair);
  options.arcs.tolerance = arc_tolerance;
  options.fit = fit;
  options.keep_contours = keep_contours;
  options.threads = threads;
  Document<Feature> document;
  Feature& feature = document.items.emplace_back();
  feature.rings = std::move(rings);
  feature.contours = std::move(contours);
  auto loaded = value_of(run(size, [&](const std::atomic<bool>* cancel) {
    options.cancel = cancel;
    return load_shapes(std::move(document), options);
  }));
  ShapeItem& item = loaded.items.front();
  return {{std::make_shared<const Shape>(std::move(item.shape))},
          std::move(item.contours),
          std::move(loaded.notes)};
}

ShapeOf shape_of(const Coordinates& coordinates, const std::optional<Values<std::int64_t>>& begin,
                 const std::optional<Values<std::uint8_t>>& roles,
                 const std::optional<Values<double>>& bulges) {
  const std::vector<Ring> rings = rings_of(coordinates, begin, roles, bulges);
  auto shape = without_lock([&] { return build_shape(rings); });
  return {std::make_shared<const Shape>(value_of(std::move(shape)))};
}

/// Makes a shape from the arrays of a stored one. Does not run build_shape(): compute() and other
/// readers check the result as far as its arrays allow.
ShapeOf restored(const Coordinates& points, const Values<double>& bulges,
                 const Values<std::uint32_t>& sources, const Values<std::uint32_t>& begin,
                 const Values<std::uint32_t>& component, const Values<std::uint8_t>& hole) {
  Shape shape;
  const auto all = points_of(points);
  const std::size_t loops = component.shape(0);
  shape.points.assign(all.begin(), all.end());
  shape.bulges.assign(bulges.data(), bulges.data() + bulges.shape(0));
  shape.loop_begin.assign(begin.data(), begin.data() + begin.shape(0));
  shape.component.assign(component.data(), component.data() + loops);
  shape.hole.assign(hole.data(), hole.data() + hole.shape(0));
  const bool fits =
      sources.shape(0) == 2 * all.size() && hole.shape(0) == loops &&
      shape.loop_begin.size() == (loops == 0 ? shape.loop_begin.size() : loops + 1) &&
      (shape.bulges.empty() || shape.bulges.size() == all.size()) &&
      (loops == 0 ? all.empty()
                  : shape.loop_begin.front() == 0 && shape.loop_begin.back() == all.size() &&
                        std::ranges::is_sorted(shape.loop_begin));
  if (!fits) refuse(ErrorCode::malformed, "the arrays of the shape do not fit together");
  for (std::size_t i = 0; i < all.size(); ++i)
    shape.sources.push_back({sources.data()[2 * i], sources.data()[2 * i + 1]});
  return {std::make_shared<const Shape>(std::move(shape))};
}

/// The boundary as closed rings of points, with arcs as chords: points, and the first point of each
/// ring.
std::pair<Array<double, 2>, Array<std::int64_t>> outline(const Shape& shape, double chord) {
  positive_chord(chord);
  std::vector<Vec2> points;
  std::vector<std::int64_t> begin{0};
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    faces::add_outline(ring_of(shape, i), chord, points);
    begin.push_back(static_cast<std::int64_t>(points.size()));
  }
  return {rows_of<double>(std::move(points)), array_of(std::move(begin))};
}

/// Converts a contour to and from plain values.
using ContourState = std::tuple<std::vector<std::array<double, 2>>, std::vector<double>,
                                std::vector<std::pair<std::uint32_t, double>>, std::uint8_t>;

ContourState state_of(const Contour& contour) {
  ContourState state;
  auto& [points, weights, pieces, role] = state;
  for (const Vec2 p : contour.points) points.push_back({p.x, p.y});
  weights = contour.weights;
  for (const CurvePiece& piece : contour.pieces) pieces.emplace_back(piece.degree, piece.bulge);
  role = static_cast<std::uint8_t>(contour.role);
  return state;
}

Contour contour_of_state(const ContourState& state) {
  const auto& [points, weights, pieces, role] = state;
  Contour contour;
  for (const auto& p : points) contour.points.push_back(point_of(p));
  contour.weights = weights;
  std::uint64_t at = 0;
  for (const auto& [degree, bulge] : pieces) {
    contour.pieces.push_back({static_cast<std::uint32_t>(at), degree, bulge});
    at += degree;
  }
  contour.role = role_from(role);
  if (at + 1 != points.size() || (!weights.empty() && weights.size() != points.size()))
    refuse(ErrorCode::malformed, "the parts of the contour do not fit together");
  return contour;
}

void bind_contour(nb::module_& module) {
  using Weights = std::optional<std::vector<double>>;
  const auto points_from = [](const std::vector<std::array<double, 2>>& points) {
    std::vector<Vec2> result;
    for (const auto& p : points) result.push_back(point_of(p));
    return result;
  };
  const nb::lock_self lock;  // without the interpreter's lock, two threads may add pieces at once
  nb::class_<Contour>(module, "Contour")
      .def(nb::init<>())
      .def(
          "start_at", [](Contour& self, std::array<double, 2> p) { self.start_at(point_of(p)); },
          lock)
      .def(
          "line_to", [](Contour& self, std::array<double, 2> p) { self.line_to(point_of(p)); },
          lock)
      .def(
          "arc_to",
          [](Contour& self, std::array<double, 2> p, double bulge) {
            self.arc_to(point_of(p), bulge);
          },
          lock)
      .def(
          "bezier_to",
          [points_from](Contour& self, const std::vector<std::array<double, 2>>& control,
                        const Weights& weights) {
            self.bezier_to(points_from(control), weights.value_or(std::vector<double>{}));
          },
          lock)
      .def(
          "ellipse_to",
          [](Contour& self, std::array<double, 2> center, std::array<double, 2> u,
             std::array<double, 2> v, double begin, double end) {
            self.ellipse_to(point_of(center), point_of(u), point_of(v), begin, end);
          },
          lock)
      .def(
          "spline_to",
          [points_from](Contour& self, std::uint32_t degree, const std::vector<double>& knots,
                        const std::vector<std::array<double, 2>>& control, const Weights& weights) {
            value_of(self.spline_to(degree, knots, points_from(control),
                                    weights.value_or(std::vector<double>{})));
          },
          lock)
      .def("__getstate__", &state_of, lock)
      .def("__setstate__",
           [](Contour& self, const ContourState& state) {
             new (&self) Contour(contour_of_state(state));
           })
      .def_prop_ro("piece_count", [](const Contour& self) { return self.pieces.size(); })
      .def_prop_ro("end",
                   [](const Contour& self) {
                     if (self.points.empty())
                       refuse(ErrorCode::empty, "the contour has no point yet");
                     return std::array{self.points.back().x, self.points.back().y};
                   })
      .def(
          "set_role", [](Contour& self, std::uint8_t role) { self.role = role_from(role); }, lock);
}

}  // namespace

RepairRule repair_from(const std::optional<std::string>& name) {
  return name ? value_of(faces::repair_from(*name)) : RepairRule::none;
}

std::vector<Ring> rings_of(const Coordinates& coordinates,
                           const std::optional<Values<std::int64_t>>& begin,
                           const std::optional<Values<std::uint8_t>>& roles,
                           const std::optional<Values<double>>& bulges) {
  const auto points = points_of(coordinates);
  const std::size_t count = begin ? begin->shape(0) - 1 : 1;
  if (begin && begin->shape(0) == 0) refuse(ErrorCode::malformed, "offsets begin with 0");
  if ((roles && roles->shape(0) != count) || (bulges && bulges->shape(0) != points.size()))
    refuse(ErrorCode::malformed, "roles go with rings, and bulges with coordinates");
  std::vector<Ring> rings(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto from = begin ? static_cast<std::size_t>(begin->data()[i]) : 0;
    const auto to = begin ? static_cast<std::size_t>(begin->data()[i + 1]) : points.size();
    if (from > to || to > points.size())
      refuse(ErrorCode::malformed, "offsets increase up to the number of coordinates");
    rings[i].points.assign(points.begin() + static_cast<std::ptrdiff_t>(from),
                           points.begin() + static_cast<std::ptrdiff_t>(to));
    if (roles) rings[i].role = role_from(roles->data()[i]);
    if (bulges) rings[i].bulges.assign(bulges->data() + from, bulges->data() + to);
  }
  return rings;
}

void bind_shapes(nb::module_& module) {
  bind_contour(module);
  nb::class_<ShapeOf>(module, "Shape")
      .def("points",
           [](nb::handle_t<ShapeOf> self) {
             return bytes_of(nb::cast<const ShapeOf&>(self).shape->points, self);
           })
      .def("sources",
           [](nb::handle_t<ShapeOf> self) {
             return bytes_of(nb::cast<const ShapeOf&>(self).shape->sources, self);
           })
      .def("bulges", [](const ShapeOf& self) { return array_of(self.shape->bulges); })
      .def("loop_begin", [](const ShapeOf& self) { return array_of(self.shape->loop_begin); })
      .def("component", [](const ShapeOf& self) { return array_of(self.shape->component); })
      .def("hole",
           [](const ShapeOf& self) {
             return array_of(
                 std::vector<std::uint8_t>(self.shape->hole.begin(), self.shape->hole.end()));
           })
      .def("area", [](const ShapeOf& self) { return area(*self.shape); })
      .def("bounds",
           [](const ShapeOf& self) {
             const Box box = bounding_box(*self.shape);
             return std::array{box.low.x, box.low.y, box.high.x, box.high.y};
           })
      .def("component_count", [](const ShapeOf& self) { return self.shape->component_count(); })
      .def("hole_count", [](const ShapeOf& self) { return self.shape->hole_count(); })
      .def("outline",
           [](const ShapeOf& self, double chord) { return outline(*self.shape, chord); });
  nb::class_<Loaded>(module, "Loaded")
      .def_ro("shape", &Loaded::shape)
      .def_ro("contours", &Loaded::contours)
      .def_ro("notes", &Loaded::notes);
  module.def("shape_of", &shape_of, nb::arg("coordinates"), nb::arg("begin").none(),
             nb::arg("roles").none(), nb::arg("bulges").none());
  module.def(
      "load",
      [](const std::optional<Coordinates>& coordinates,
         const std::optional<Values<std::int64_t>>& begin,
         const std::optional<Values<std::uint8_t>>& roles,
         const std::optional<Values<double>>& bulges, const std::vector<Contour>& contours,
         const std::optional<std::string>& repair, double arc_tolerance, double fit,
         bool keep_contours, int threads) {
        std::vector<Ring> rings;
        if (coordinates) rings = rings_of(*coordinates, begin, roles, bulges);
        return load(std::move(rings), contours, repair, arc_tolerance, fit, keep_contours, threads);
      },
      nb::arg("coordinates").none(), nb::arg("begin").none(), nb::arg("roles").none(),
      nb::arg("bulges").none(), nb::arg("contours"), nb::arg("repair").none(),
      nb::arg("arc_tolerance"), nb::arg("fit"), nb::arg("keep_contours"), nb::arg("threads"));
  module.def("restored_shape", &restored);
}

}  // namespace medial::python
