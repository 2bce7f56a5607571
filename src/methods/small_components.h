#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "medial/axis.h"
#include "methods/problem.h"

namespace medial {

// A tolerance is a share of a shape's size, and rounding in its frame leaves such a share open.
// Both are too coarse for a component that is far smaller than the shape. Components have axes that
// do not depend on each other, so each of those is a problem of its own, with a frame and a
// tolerance of its size: its axis is what it is where there is nothing else.

/// The loops of a shape, by how they are computed.
struct LoopsBySize {
  using Loops = std::vector<std::uint32_t>;
  Loops large;               ///< of all components that are computed together
  std::vector<Loops> small;  ///< of each one that is computed on its own
};

/// A component is small if its longer side is below 2^-10 of the shape's, its own tolerance is
/// finer, and it has at most 65,536 points. None where all is computed together: if there is no
/// such component; if the method samples, or the caller has chosen a tolerance, which is one of the
/// whole; and with arcs, since the whole's tolerance is in how the shape was built. O(n).
std::optional<LoopsBySize> small_components(const Problem& problem);

/// The axis of a problem that small_components() divides, by its method.
Result<Outcome> run_divided(const Problem& problem, const LoopsBySize& loops);

/// The same as disks::run_in_parts(), each small component a part of its own.
Result<std::optional<MedialAxis>> run_divided_in_parts(const Problem& problem,
                                                       const LoopsBySize& loops,
                                                       const AxisSink& sink);

}  // namespace medial
