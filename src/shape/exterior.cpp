#include "shape/exterior.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace medial {

Result<Exterior> exterior_of(const Shape& shape, double margin) {
  const Box box = bounding_box(shape);
  const Vec2 low = box.low - Vec2{margin, margin}, high = box.high + Vec2{margin, margin};
  std::vector<Ring> rings{{{low, {high.x, low.y}, high, {low.x, high.y}}}};
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    Ring& ring = rings.emplace_back();
    ring.points.assign(loop.begin(), loop.end());
    if (shape.bulges.empty()) continue;
    const auto first = shape.bulges.begin() + shape.loop_begin[i];
    ring.bulges.assign(first, first + static_cast<std::ptrdiff_t>(loop.size()));
  }
  auto built = build_shape(rings);
  if (!built) return std::move(built).error();
  Exterior exterior{std::move(built).value(), {}, {}};
  for (VertexSource& source : exterior.shape.sources) {
    exterior.of_loop.push_back(source.ring - 1);
    exterior.of_frame.push_back(source.ring == 0);
    if (source.ring > 0) source = shape.sources[shape.loop_begin[source.ring - 1] + source.vertex];
  }
  return exterior;
}

double margin_for(const Box& box, double margin) {
  return margin > 0 ? margin : 0.5 * std::max(box.high.x - box.low.x, box.high.y - box.low.y);
}

}  // namespace medial
