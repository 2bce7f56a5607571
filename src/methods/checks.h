#pragma once

#include <optional>

#include "medial/compute.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial {

/// What compute() cannot take, if anything: options out of their range, shapes too large, beyond
/// the limits of coordinates or not made by build_shape(), and what the method leaves out. O(n).
std::optional<Error> refuse(const Shape& shape, const Options& options);

/// Whether an edge is an arc. O(n).
bool has_arcs(const Shape& shape);

/// The options that every exact computation has: the tolerance and the number of threads.
std::optional<Error> refuse(const Options& options);

/// The Euler characteristic: one connected part for each component, one cycle for each hole.
bool has_right_topology(const Shape& shape, std::size_t nodes, std::size_t edges);

}  // namespace medial
