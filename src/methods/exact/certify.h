#pragma once

#include "methods/problem.h"

namespace medial::exact {

/// Makes sure that the combinatorics of an axis that compute() made in double precision are those
/// of the exact one: which sites each node touches and in which order, and which nodes each edge
/// joins. Where rounding has decided otherwise, nodes and edges are replaced. What is decided, and
/// how, is counted in the axis' statistics (docs/exact.md). Errors, with the place: unsupported
/// where arcs bound the shape, otherwise internal.
///
/// O(n) expected; the same result for any number of threads. Call it inside a task arena.
Status certify(const Problem& problem, MedialAxis& axis);

}  // namespace medial::exact
