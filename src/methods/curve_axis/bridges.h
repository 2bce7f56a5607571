#pragma once

#include <span>
#include <vector>

#include "methods/curve_axis/boundary.h"

namespace medial::curve_axis {

/// Makes one cyclic boundary of a loop and its holes, by cutting the region between the loops along
/// one bridge per hole: a disk inside the shape that touches the hole and another loop. The
/// boundary passes each bridge twice, once on each side, through a gap, and the axis becomes a
/// tree.
///
/// A hole's foot is its furthest point along `direction` (a unit vector): the disk there is beyond
/// the hole and touches another loop, which extends further. The other foot is searched on the
/// whole boundary, at `samples` points of each piece and then by Newton's method on (14) from the
/// nearest.
///
/// Requires loops from normalized(), the outer one first. Returns nothing if a foot is too close to
/// a joint for the piece to be divided: try another direction.
std::vector<Piece> bridged(std::span<const Contour> loops, Vec2 direction);

}  // namespace medial::curve_axis
