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

/// Whether an edge of a shape with arcs is so small that double does not know on which side of a
/// joint or a bridge a foot on it or beside it is. On a tiny arc a foot is off by an angle of
/// rounding over the radius, and that of the same disk on another site may be off by as much; the
/// disk reaches over that by half the square. A disk that touches a longer arc within rounding has
/// its feet anywhere on a tiny edge beside that. In local units.
bool is_tiny_edge(const BulgeArc& local);
/// Whether an arc meets another edge almost smoothly, so that double may be wrong about what a disk
/// touches there that nearly is the arc's circle. In local units.
///
/// That is so if a disk of the arc's radius reaches over a straight edge there by at most the
/// tolerance, or if the shorter edge rises by no more: a blunt joint has no leaf, though disks lead
/// towards it, and rounding decides in which order disks touch a reflex vertex and its edges. A
/// reflex joint that counts as smooth, since an edge is short, is almost smooth as well: a disk
/// reaches over it by half the square of its angle over the difference of the curvatures.
bool is_almost_smooth(site::Joint joint, const BulgeArc& before, const BulgeArc& after,
                      double tolerance);
/// The points of a shape with arcs at which tiny edges begin: next to these double may be wrong
/// about what a disk touches. O(n).
std::vector<std::size_t> tiny_edges(const Problem& problem);
/// The points of a shape with arcs at which edges meet almost smoothly. O(n).
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
