#include "methods/automatic.h"

#include <algorithm>

#include "methods/checks.h"
#include "methods/disks/disks.h"
#include "methods/lee/lee.h"

namespace medial {
namespace {

/// As measured (docs/lee.md). Of the vertices of coasts and mazes about half are reflex, of smooth
/// shapes mostly fewer. O(n).
bool is_lee_faster(const Problem& problem) {
  constexpr double most_reflex = 0.4;
  const Shape& shape = problem.shape;
  if (shape.hole_count() > 0 || has_arcs(shape) || problem.options.exact) return false;
  std::size_t reflex = 0;
  for (std::size_t l = 0; l < shape.loop_count(); ++l) {
    const std::span<const Vec2> loop = shape.loop(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 before = loop[i == 0 ? loop.size() - 1 : i - 1], at = loop[i],
                 after = loop[i + 1 == loop.size() ? 0 : i + 1];
      reflex += cross(at - before, after - at) <= 0 ? 1 : 0;  // rounding does not matter
    }
  }
  return static_cast<double>(reflex) <= most_reflex * static_cast<double>(shape.points.size());
}

}  // namespace

Result<Outcome> run_automatic(const Problem& problem) {
  return outcome_of(is_lee_faster(problem) ? lee::run(problem) : disks::run(problem), false);
}

}  // namespace medial
