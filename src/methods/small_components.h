#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "medial/axis.h"
#include "methods/problem.h"

namespace medial {

// The tolerance is a share of a shape's size, and so is the rounding error in its local frame. Both
// are too coarse for a component that is far smaller than the shape. The axes of components are
// independent, so each such component becomes a problem of its own, with a frame and a tolerance
// for its size. Its axis does not depend on the rest of the shape.

/// The loops of a shape, grouped by how they are computed.
struct LoopsBySize {
  using Loops = std::vector<std::uint32_t>;
  Loops large;               ///< of all components that are computed together
  std::vector<Loops> small;  ///< of each one that is computed on its own
};

/// A component is small if its longer side is below 2^-10 of the shape's, its own tolerance is
/// finer, and it has at most 65,536 points. Returns none if everything is computed together: there
/// is no such component; the method samples; the caller has chosen a tolerance, which applies to
/// the whole shape; or the shape has arcs, since build_shape() used its tolerance. O(n).
std::optional<LoopsBySize> small_components(const Problem& problem);

/// Computes the axis of a problem that small_components() divides, by the problem's method.
Result<Outcome> run_divided(const Problem& problem, const LoopsBySize& loops);

/// The same for disks::run_in_parts(); each small component is a part of its own.
Result<std::optional<MedialAxis>> run_divided_in_parts(const Problem& problem,
                                                       const LoopsBySize& loops,
                                                       const AxisSink& sink);

}  // namespace medial
