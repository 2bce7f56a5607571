#pragma once

#include <optional>
#include <span>

#include "medial/shape.h"
#include "shape/splice.h"

namespace medial {

/// Checks at the leftmost vertex of each ring that the inside of an outer ring, or the outside of a
/// hole, is interior. (No ring crosses another, so this holds along the whole ring.) Any ring of a
/// polygon (an outer ring and the holes after it in the list) may be the actual outer ring. O(n).
/// Requires components, see nest(). Errors, of the first invalid ring: nested_outer, hole_outside.
std::optional<Error> check_roles(std::span<const Ring> rings, const Arrangement& arrangement,
                                 const SplicedLoops& loops);

/// Numbers the components of the interior by the lowest source of their outer loops, and assigns
/// every hole to its component. O(n + loops log loops), plus O(n) for each hole at whose leftmost
/// vertex dropped edges end. Error: internal (a hole in no component).
std::optional<Error> nest(const Arrangement& arrangement, SplicedLoops& loops);

/// The shape with its loops ordered by component, then the outer loop first, then by lowest source.
/// Error: crossing (arcs cross within the tolerance, and the area of a loop shows no interior).
Result<Shape> assemble(const Arrangement& arrangement, const SplicedLoops& loops);

}  // namespace medial
