#pragma once

#include <optional>
#include <span>

#include "medial/shape.h"
#include "shape/clean.h"

namespace medial {

/// The shape of one small ring without arcs whose edges meet only at vertices, equal to the result
/// of the sweep and the steps after it; nothing for other input. For a building footprint,
/// comparing all pairs of edges takes a fraction of the sweep's time. Moves the arrays out of
/// `cleaned`. O(n^2).
std::optional<Shape> simple_polygon(std::span<const Ring> rings, CleanRings& cleaned,
                                    ShapeReport& report);

}  // namespace medial
