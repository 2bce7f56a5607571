#pragma once

#include <cstddef>
#include <optional>

#include "methods/problem.h"

namespace medial::exact {

/// Two edges of a shape, by the points in which they begin, and where they cross.
struct Crossing {
  std::size_t first, second;
  Vec2 point;  ///< in units of the input
};

/// Two edges that cross inside both, as the doubles have them: proved in 256 bits. build_shape()
/// lets arcs pass that cross by less than its tolerance. None also where the boxes of very many
/// pairs of edges meet, as then not all pairs are asked. O(n log n) for small edges.
std::optional<Crossing> find_crossing(const Problem& problem);

}  // namespace medial::exact
