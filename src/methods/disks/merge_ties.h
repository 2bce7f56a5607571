#pragma once

#include "methods/disks/collect.h"
#include "methods/disks/exact_sites.h"
#include "site/boundary_tree.h"

namespace medial::disks {

/// Merges nodes that are one within the tolerance.
///
/// The walk follows exact bisectors. Where many sites touch one disk but for the rounding of their
/// coordinates, the bisector of two that enclose a small angle passes beside that disk's centre by
/// the rounding over the angle, so no disk on it touches all others: the node falls apart into a
/// few, joined by short edges. Such an edge is near if one disk touches the sites of both ends
/// within half of the tolerance, or if its ends are no further than a quarter of it apart. The
/// latter is a case of the former, whatever the sites are: the distance to a site changes by no
/// more than a centre moves, and so does the radius, so the disk of one end touches what the other
/// end does within half, but for what the nodes themselves are off. It is asked apart because a
/// foot that only passes on has no fourth contact, and because such edges, left alone, run backward
/// once their ends are rounded. What near edges connect becomes one node if one disk touches all
/// its sites (those of its edges, and those between one edge and the next, from which no edge
/// leads) within half of the tolerance, no site reaches into it, and all edges that leave keep
/// their directions. Where that is not so, the same is tried with edges that are nearer. Half,
/// because coordinates rounded to doubles move a tie's contacts by at most the square root of 1/2
/// of a spacing, and the tolerance is at least two spacings.
///
/// So the result depends on the graph only, and not on the order in which it was found; whether a
/// disk touches to a bound is decided in 256 bits where double leaves it open.
///
/// With arcs, longer edges to nodes that branch no further fall off in the same way: to places
/// where a foot passes from one site to the next, and the centres of arcs that the disk touches all
/// along. Their edges are near where they are no longer than such a disk's play: the rounding over
/// the sine of half of the angle between the edge's contacts, or over 1 - cos of half of the arc's
/// angle.
///
/// Every contraction takes one edge and one node, and none closes a cycle: the graph keeps its
/// Euler number and its cycles. O(n), and O(m log m) for the m edges that four of their ends'
/// contacts do not rule out, with the edges of their nodes.
void merge_ties(const site::BoundaryTree& tree, const ExactSites& exact, double tolerance,
                Graph& graph);

/// The edges of which merge_ties() may take some out of a graph.
std::vector<std::uint32_t> tie_candidates(const site::BoundaryTree& tree, const ExactSites& exact,
                                          double tolerance, Graph& graph);

}  // namespace medial::disks
