#pragma once

#include <cstdint>
#include <vector>

#include "medial/centreline.h"

namespace medial::ops {

/// The parts of an edge where the radius is at least `clearance`, from node to node: at most two,
/// none of them a single point.
std::vector<PathPiece> wide_pieces(const MedialAxis& axis, std::uint32_t edge, double clearance);

}  // namespace medial::ops
