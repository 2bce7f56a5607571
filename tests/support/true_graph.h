#pragma once

#include <cstdint>
#include <span>

#include "medial/axis.h"
#include "medial/shape.h"
#include "support/same_graph.h"

namespace medial::test {

/// The true graph of the axis of a polygon, by brute force: of the disks that touch three sites the
/// ones that no site reaches into, and between two that follow each other on the bisector of two
/// sites an edge. O(n^4). Shares no code with the library.
///
/// Every decision is the sign of a number known to 500 bits. What is less than 2^-200 of the size
/// there is decided again with 1200 bits, in which less than 2^-500 is zero. (The numbers are
/// algebraic, of coordinates of 53 bits: a power of the products of their conjugates is a whole
/// multiple of a power of two. Only true ties come near to such bounds.)
///
/// `sites` are the axis' own, in whose order the result counts; they must be the polygon's edges
/// and its reflex vertices, else the result has a failure. So has one that violates Euler's
/// formula: that would be a mistake of this program.
SiteGraph true_graph(const Shape& shape, std::span<const Site> sites);

}  // namespace medial::test
