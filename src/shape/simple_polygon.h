#pragma once

#include <optional>
#include <span>

#include "medial/shape.h"
#include "shape/clean.h"

namespace medial {

/// The shape of one small ring without arcs whose edges meet in its vertices only, as the sweep
/// and what follows it would return it; nothing of any other input. Comparing all edges
/// of a footprint takes a fraction of the sweep's time. Takes the arrays out of `cleaned`. O(n^2).
std::optional<Shape> simple_polygon(std::span<const Ring> rings, CleanRings& cleaned,
                                    ShapeReport& report);

}  // namespace medial
