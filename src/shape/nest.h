#pragma once

#include <optional>
#include <span>

#include "medial/shape.h"
#include "shape/splice.h"

namespace medial {

/// Checks that the inside of every outer ring, and the outside of every hole, is interior where the
/// ring begins on the left. (No ring crosses another, so it is all along the ring.) Of a polygon,
/// an outer ring and the holes behind it in the list, any one ring may turn out to be the outer
/// one. O(n). Requires components, see nest(). Errors: nested_outer, hole_outside, of the first
/// ring that has one.
std::optional<Error> check_roles(std::span<const Ring> rings, const Arrangement& arrangement,
                                 const SplicedLoops& loops);

/// Numbers the components of the interior by the lowest source of their outer loops, and gives
/// every hole to the component it lies in. O(n + loops log loops), and O(n) more for each hole at
/// whose leftmost vertex dropped edges end. Error: internal, should a hole lie in none.
std::optional<Error> nest(const Arrangement& arrangement, SplicedLoops& loops);

/// The shape with its loops in order: by component, the outer loop first, then by lowest source.
/// Error: crossing, where arcs cross within the tolerance and a loop has no inside by its area.
Result<Shape> assemble(const Arrangement& arrangement, const SplicedLoops& loops);

}  // namespace medial
