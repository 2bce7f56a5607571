#include "shape/exterior.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/in_flight.h"
#include "base/tolerance.h"

namespace medial {
namespace {

/// Why build_shape() refuses the exterior of a valid shape, at the place in the input; where that
/// has another reason than its tolerance, that reason.
Error error_of_exterior(const Shape& shape, const Error& refused) {
  using enum ErrorCode;
  const ErrorCode code = refused.code;
  if (code != overlap && code != crossing && code != no_area && code != too_few_points)
    return refused;
  const Place& built = refused.place;
  Error error{unsupported,
              "edges lie nearer to each other than the exterior resolves, whose tolerance is a "
              "share of the enclosure's size: choose a smaller margin, or move them apart",
              {}};
  error.place.point = built.point;
  if (!built.ring || *built.ring == 0) return error;
  const std::size_t loop = *built.ring - 1;
  const std::size_t point = shape.loop_begin[loop] + built.vertex.value_or(0);
  error.place.ring = shape.sources[point].ring;
  if (built.vertex) error.place.vertex = shape.sources[point].vertex;
  return error;
}

}  // namespace

Result<Exterior> exterior_of(const Shape& shape, double margin) {
  const Box box = bounding_box(shape);
  const Vec2 low = box.low - Vec2{margin, margin}, high = box.high + Vec2{margin, margin};
  std::vector<Ring> rings{{{low, {high.x, low.y}, high, {low.x, high.y}}}};
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    rings.push_back(ring_of(shape, i));
    rings.back().role = RingRole::any;
  }
  auto built = build_shape(rings);
  if (!built) return error_of_exterior(shape, built.error());
  Exterior exterior{std::move(built).value(), {}, {}};
  for (VertexSource& source : exterior.shape.sources) {
    exterior.of_loop.push_back(source.ring - 1);
    exterior.of_enclosure.push_back(source.ring == 0);
    if (source.ring > 0) source = shape.sources[shape.loop_begin[source.ring - 1] + source.vertex];
  }
  return exterior;
}

double least_margin_for(const Box& box) {
  return std::max(1e-6 * diagonal(box), least_room * spacing_in(box));
}

double margin_for(const Box& box, double margin) {
  if (margin > 0) return margin;
  return std::max(0.5 * std::max(box.high.x - box.low.x, box.high.y - box.low.y),
                  least_margin_for(box));
}

Result<double> checked_margin_for(const Box& box, double margin) {
  const double chosen = margin_for(box, margin), least = least_margin_for(box);
  if (!(margin >= 0 && chosen >= least && chosen <= std::max(1e6 * diagonal(box), least)))
    return Error{ErrorCode::invalid_option,
                 "the margin must be in [1e-6, 1e6] of the shape's diagonal, and far above the "
                 "rounding of its coordinates",
                 {}};
  return chosen;
}

Result<Shape> surroundings(const Shape& shape, double margin) {
  if (shape.points.empty()) return Error{ErrorCode::empty, "the shape is empty", {}};
  const auto chosen = checked_margin_for(bounding_box(shape), margin);
  if (!chosen) return chosen.error();
  try {
    auto exterior = exterior_of(shape, *chosen);
    if (!exterior) return std::move(exterior).error();
    return std::move(exterior->shape);
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
