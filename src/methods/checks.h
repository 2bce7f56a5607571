#pragma once

#include <optional>
#include <span>
#include <vector>

#include "axis/sites.h"
#include "base/arc.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial {

struct Problem;

/// What compute() cannot take, if anything: options out of their range, shapes too large, beyond
/// the limits of coordinates or not made by build_shape(), and what the method leaves out. O(n).
std::optional<Error> refuse(const Shape& shape, const Options& options);

/// Whether an edge is an arc. O(n).
bool has_arcs(const Shape& shape);

/// Whether an edge is an arc that is so small that double does not know on which side of a joint or
/// a bridge a foot on it is: an angle of rounding over the radius. The foot of the same disk on
/// another site may then be off by as much, and the disk reaches over that by half the square.
bool is_tiny_arc(const BulgeArc& local);
/// Whether two edges, one of them an arc, meet almost smoothly, but not up to rounding: at an angle
/// so small that a disk of the arc's radius reaches over a straight edge there by at most the
/// tolerance, or that the shorter edge rises by no more. A blunt joint has no leaf, though disks
/// lead towards it, and rounding decides in which order disks touch a reflex vertex and its edges.
/// In local units.
bool is_almost_smooth(site::Joint joint, const BulgeArc& before, const BulgeArc& after,
                      double tolerance);
/// The points of a shape at which tiny arcs begin, and those at which edges meet almost smoothly:
/// next to these double may be wrong about what a disk touches. O(n).
std::vector<std::size_t> tiny_arcs(const Problem& problem);
std::vector<std::size_t> almost_smooth_joints(const Problem& problem,
                                              const site::SiteNumbers& numbers);

/// The options that every exact computation has: the tolerance and the number of threads.
std::optional<Error> refuse(const Options& options);

/// Whether a graph has one connected part for each component of the shape, with one independent
/// cycle for each of its holes. For Edge and VoronoiEdge. O(n), nearly.
template <class E>
bool has_right_topology(const Shape& shape, std::span<const Node> nodes, std::span<const E> edges);
template <class E>
bool has_right_topology(const Shape& shape, const std::vector<Node>& nodes,
                        const std::vector<E>& edges) {
  return has_right_topology(shape, std::span(nodes), std::span(edges));
}

}  // namespace medial
