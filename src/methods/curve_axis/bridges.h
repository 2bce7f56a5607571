#pragma once

#include <span>
#include <vector>

#include "methods/curve_axis/boundary.h"

namespace medial::curve_axis {

/// A loop and its holes as one cyclic boundary: what lies between the loops is cut open along one
/// bridge for each hole, a disk inside of the shape that touches the hole and another loop. Around
/// the boundary each bridge is passed twice, on one side and on the other, through a gap, and the
/// axis is a tree.
///
/// A hole's foot is its point farthest along `direction` (a unit vector): the disk there lies
/// beyond the hole and touches another loop, which reaches farther still. The other foot is sought
/// on all boundary, at `samples` places of a piece and by Newton's method on (14) from the nearest.
///
/// Requires loops as normalized() gives them, the first one around the others. Empty where a foot
/// is too close to a joint for the parts to be two pieces: another direction will do.
std::vector<Piece> bridged(std::span<const Contour> loops, Vec2 direction);

}  // namespace medial::curve_axis
