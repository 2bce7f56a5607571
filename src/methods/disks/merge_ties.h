#pragma once

#include "methods/disks/boundary.h"
#include "methods/disks/collect.h"
#include "site/boundary_tree.h"

namespace medial::disks {

/// Merges nodes that are one within the tolerance where one of them is a branching node.
///
/// The walk follows exact bisectors. Where many sites touch one disk but for the rounding of their
/// coordinates, the bisector of two that enclose a small angle passes beside that disk's centre by
/// the rounding over the angle, so no disk on it touches all others: the node falls apart into a
/// few, joined by short edges. Such an edge is contracted where one disk touches the sites of both
/// ends within half of the tolerance, no site reaches into it, and all other edges of the two nodes
/// keep their directions. Half, because coordinates rounded to doubles move a tie's contacts by at
/// most the square root of 1/2 of a spacing, and the tolerance is at least two spacings.
///
/// With arcs, nodes that branch no further fall off in the same way: places where a foot passes
/// from one site to the next, and the centres of arcs that the disk touches all along. Their edges
/// are contracted into a branching node where they are no longer than such a disk's play: the
/// rounding over the sine of half of the angle between the edge's contacts, or over 1 - cos of half
/// of the arc's angle.
///
/// Every contraction takes one edge and one node, and none closes a cycle: the graph keeps its
/// Euler number and its cycles. The result depends on the graph only. O(n),
/// and O(m log m) for the m edges that four of their ends' contacts do not rule out, with the edges
/// of their nodes.
void merge_ties(const Boundary& boundary, const site::BoundaryTree& tree, double tolerance,
                Graph& graph);

}  // namespace medial::disks
