#include "medial/choose.h"

#include <algorithm>
#include <cstddef>

namespace medial {

Method choose_method(const Shape& shape, const Options& options) {
  // Of the vertices of coasts and mazes about half are reflex, of smooth shapes less than a third.
  constexpr double most_reflex = 0.4;
  const std::size_t count = shape.points.size();
  const bool takes =
      shape.hole_count() == 0 && std::all_of(shape.bulges.begin(), shape.bulges.end(),
                                             [](double bulge) { return bulge == 0; });
  if (!takes || options.exterior || options.exact) return Method::disks;
  std::size_t reflex = 0;
  for (std::size_t l = 0; l < shape.loop_count(); ++l) {
    const std::span<const Vec2> loop = shape.loop(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 before = loop[i == 0 ? loop.size() - 1 : i - 1], at = loop[i],
                 after = loop[i + 1 == loop.size() ? 0 : i + 1];
      reflex += cross(at - before, after - at) <= 0 ? 1 : 0;  // rounding does not matter
    }
  }
  return static_cast<double>(reflex) <= most_reflex * static_cast<double>(count) ? Method::lee
                                                                                 : Method::disks;
}

}  // namespace medial
