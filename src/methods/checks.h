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

/// The reason why compute() refuses a shape or options, if any: an option out of range, a shape
/// that is too large, exceeds the limits of coordinates or was not made by build_shape(), or
/// something that the method does not support. O(n).
std::optional<Error> refuse(const Shape& shape, const Options& options);

/// Whether a shape has arcs. O(n).
bool has_arcs(const Shape& shape);

/// Whether an edge of a shape with arcs is so small that double precision cannot tell on which side
/// of a joint or a bridge a foot near it is. On a tiny arc, the angle of a foot has an error of one
/// rounding over the radius, and the foot of the same disk on another site may have the same error;
/// the disk then reaches over that site by half the square of this angle. A disk that touches a
/// longer arc within rounding may have its feet anywhere on a tiny edge next to it. In local units.
bool is_tiny_edge(const BulgeArc& local);
/// Whether an arc meets another edge almost smoothly, so that double precision may be wrong about
/// what a disk that nearly is the arc's circle touches there. In local units.
///
/// This is so if a disk of the arc's radius reaches over a straight edge at the joint by at most
/// the tolerance, or if the shorter edge rises by at most the tolerance: a blunt joint has no leaf,
/// though disks lead towards it, and rounding decides in which order disks touch a reflex vertex
/// and its edges. A reflex joint that counts as smooth because an edge is short is almost smooth as
/// well: a disk reaches over it by half the square of its angle over the difference of the
/// curvatures.
bool is_almost_smooth(site::Joint joint, const BulgeArc& before, const BulgeArc& after,
                      double tolerance);
/// The points at which tiny edges of a shape with arcs begin: next to these, double precision may
/// be wrong about what a disk touches. O(n).
std::vector<std::size_t> tiny_edges(const Problem& problem);
/// The points of a shape with arcs at which edges meet almost smoothly. O(n).
std::vector<std::size_t> almost_smooth_joints(const Problem& problem,
                                              const site::SiteNumbers& numbers);

/// Checks the options that all exact computations share: the tolerance and the number of threads.
std::optional<Error> refuse(const Options& options);

/// Whether a graph has one connected part for each component of the shape, with one independent
/// cycle for each hole. For Edge and VoronoiEdge. Takes almost linear time.
template <class E>
bool has_right_topology(const Shape& shape, std::span<const Node> nodes, std::span<const E> edges);
template <class E>
bool has_right_topology(const Shape& shape, const std::vector<Node>& nodes,
                        const std::vector<E>& edges) {
  return has_right_topology(shape, std::span(nodes), std::span(edges));
}

}  // namespace medial
