// Shapes, and contours of curves.

#include <algorithm>
#include <cmath>

#include "binding.h"
#include "faces/axes.h"

namespace medial::js {
namespace {

/// Reads numbers one by one.
class Numbers {
 public:
  Numbers(const double* first, std::size_t count) : rest_(first, count) {}
  bool empty() const { return rest_.empty(); }
  double next() {
    if (rest_.empty()) refuse(ErrorCode::malformed, "a contour ends within a piece");
    const double value = rest_.front();
    rest_ = rest_.subspan(1);
    return value;
  }
  Vec2 point() {
    const double x = next();
    return {x, next()};
  }

 private:
  std::span<const double> rest_;
};

void add_bezier(Contour& contour, Numbers& numbers, bool rational) {
  const auto degree = static_cast<std::size_t>(numbers.next());
  std::vector<Vec2> control;
  std::vector<double> weights;
  for (std::size_t i = 0; i < degree; ++i) {
    control.push_back(numbers.point());
    if (rational) weights.push_back(numbers.next());
  }
  contour.bezier_to(control, weights);
}

/// Contours as a row of numbers: 0 begins a contour (role, x, y), 1 is a line (x, y), 2 an arc (x,
/// y, bulge), 3 a Bezier curve (degree, control points), 4 the same with a weight after each point,
/// 5 an elliptical arc (centre, both half axes, angles).
std::vector<Contour> contours_from(Numbers numbers) {
  std::vector<Contour> contours;
  while (!numbers.empty()) {
    const auto kind = static_cast<int>(numbers.next());
    if (kind == 0) {
      Contour& contour = contours.emplace_back();
      contour.role = static_cast<RingRole>(static_cast<int>(numbers.next()) & 3);
      contour.start_at(numbers.point());
      continue;
    }
    if (contours.empty()) refuse(ErrorCode::malformed, "a contour begins with a point");
    Contour& contour = contours.back();
    if (kind == 1) contour.line_to(numbers.point());
    if (kind == 2) {
      const Vec2 end = numbers.point();
      contour.arc_to(end, numbers.next());
    }
    if (kind == 3 || kind == 4) add_bezier(contour, numbers, kind == 4);
    if (kind == 5) {
      const Vec2 center = numbers.point(), u = numbers.point(), v = numbers.point();
      const double begin = numbers.next();
      contour.ellipse_to(center, u, v, begin, numbers.next());
    }
  }
  return contours;
}

ShapeOf* new_shape(Shape shape, std::vector<Contour> contours = {}) {
  return new ShapeOf{std::make_shared<const Shape>(std::move(shape)), std::move(contours)};
}

}  // namespace

/// Makes a shape from rings without changing them.
MEDIAL_JS ShapeOf* medial_shape(const double* coordinates, const std::uint32_t* begin,
                                std::size_t count, const std::uint8_t* roles,
                                const double* bulges) {
  return answered([&] {
    const std::vector<Ring> rings = rings_from(coordinates, begin, count, roles, bulges);
    return new_shape(value_of(build_shape(rings)));
  });
}

/// Makes a shape from rings and contours, which are first repaired, fitted or approximated. The
/// text has the notes.
MEDIAL_JS ShapeOf* medial_load(const double* coordinates, const std::uint32_t* begin,
                               std::size_t count, const std::uint8_t* roles, const double* bulges,
                               const double* contours, std::size_t contours_size,
                               const char* given) {
  return answered([&] {
    LoadOptions options;
    std::optional<std::string> repair;
    Named(given)
        .take("repair", repair)
        .take("arc_tolerance", options.arcs.tolerance)
        .take("fit", options.fit)
        .take("keep_contours", options.keep_contours)
        .finish();
    if (repair) options.repair = value_of(faces::repair_from(*repair));
    Document<Feature> document;
    Feature& feature = document.items.emplace_back();
    feature.rings = rings_from(coordinates, begin, count, roles, bulges);
    feature.contours = contours_from({contours, contours_size});
    auto loaded = value_of(load_shapes(std::move(document), options));
    ShapeItem& item = loaded.items.front();
    answer().text = Json().add("notes", loaded.notes).text();
    return new_shape(std::move(item.shape), std::move(item.contours));
  });
}

/// Makes a shape from the arrays of a stored one; compute() checks them.
MEDIAL_JS ShapeOf* medial_restored_shape(const double* points, std::size_t count,
                                         const double* bulges, const std::uint32_t* sources,
                                         const std::uint32_t* begin, const std::uint32_t* component,
                                         const std::uint8_t* hole, std::size_t loops) {
  return answered([&] {
    Shape shape;
    const auto all = points_at(points, count);
    shape.points.assign(all.begin(), all.end());
    if (bulges != nullptr) shape.bulges.assign(bulges, bulges + count);
    for (std::size_t i = 0; i < count; ++i)
      shape.sources.push_back({sources[2 * i], sources[2 * i + 1]});
    shape.loop_begin.assign(begin, begin + loops + 1);
    shape.component.assign(component, component + loops);
    shape.hole.assign(hole, hole + loops);
    const bool fits = shape.loop_begin.front() == 0 && shape.loop_begin.back() == count &&
                      std::is_sorted(shape.loop_begin.begin(), shape.loop_begin.end());
    if (!fits) refuse(ErrorCode::malformed, "the arrays of the shape do not fit together");
    return new_shape(std::move(shape));
  });
}

/// Points, bulges, sources, loop_begin, component, hole.
MEDIAL_JS int medial_shape_arrays(const ShapeOf* of) {
  return answered([&] {
    const Shape& shape = *of->shape;
    std::vector<double> sources;
    for (const VertexSource& source : shape.sources) {
      sources.push_back(source.ring);
      sources.push_back(source.vertex);
    }
    answer().tables = {table_of(shape.points),
                       shape.bulges,
                       std::move(sources),
                       {shape.loop_begin.begin(), shape.loop_begin.end()},
                       {shape.component.begin(), shape.component.end()},
                       {shape.hole.begin(), shape.hole.end()}};
    return 1;
  });
}

/// Low x, low y, high x, high y, area, points, components, holes.
MEDIAL_JS int medial_shape_numbers(const ShapeOf* of) {
  return answered([&] {
    const Shape& shape = *of->shape;
    const Box box = bounding_box(shape);
    answer().tables = {{box.low.x, box.low.y, box.high.x, box.high.y, area(shape),
                        number(shape.points.size()), number(shape.component_count()),
                        number(shape.hole_count())}};
    return 1;
  });
}

/// Closed rings with arcs as chords: points, and the first point of each ring.
MEDIAL_JS int medial_outline(const ShapeOf* of, double chord) {
  return answered([&] {
    std::vector<Vec2> points;
    std::vector<double> begin{0};
    for (std::size_t i = 0; i < of->shape->loop_count(); ++i) {
      faces::add_outline(ring_of(*of->shape, i), chord, points);
      begin.push_back(number(points.size()));
    }
    answer().tables = {table_of(points), std::move(begin)};
    return 1;
  });
}

/// The signed distance of each point.
MEDIAL_JS int medial_clearances(const ShapeOf* of, const double* points, std::size_t count) {
  return answered([&] {
    std::vector<double> values;
    for (const Vec2 p : points_at(points, count)) values.push_back(clearance(*of->shape, p));
    answer().tables = {std::move(values)};
    return 1;
  });
}

MEDIAL_JS void medial_free_shape(ShapeOf* of) { delete of; }

}  // namespace medial::js
