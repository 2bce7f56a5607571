#pragma once

#include <string>

#include "medial/axis.h"
#include "medial/shape.h"

namespace medial::test {

/// How two axes of one shape differ in their combinatorics; empty where they are the same.
///
/// An edge is known by the sites on its two sides (nodes that only divide an edge between the same
/// two sites count as inside of it). Edges that both axes have correspond to each other, of several
/// with the same sites those that are nearest. Contracting all others must leave the same
/// graph, one-to-one on nodes and edges. And for each node of that graph, one disk must touch all
/// that the disks contracted to it touch, in both axes, to within `tolerance`: one of these disks
/// does.
std::string difference(const Shape& shape, const MedialAxis& a, const MedialAxis& b,
                       double tolerance);

}  // namespace medial::test
