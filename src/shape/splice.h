#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial/shape.h"
#include "shape/arc_sweep.h"
#include "shape/clean.h"
#include "shape/sweep.h"

namespace medial {

/// The rings, each with its own vertex wherever they touch. Edge v runs from vertex v to next[v].
struct Arrangement {
  std::vector<Vec2> points;
  std::vector<VertexSource> sources;
  std::vector<std::uint32_t> begin;  ///< ring i is the vertices [begin[i], begin[i + 1])
  std::vector<std::uint32_t> next;
  std::vector<bool> interior_left;  ///< of each edge
  std::vector<Touch> touches;       ///< by increasing place; all vertices there
  std::vector<LeftEnd> left_ends;   ///< in the order of the sweep; `below` is an edge
  std::uint32_t place_count = 0;    ///< of touching places
  // Of outlines with arcs only (see NodedRings, which `points` are those of then); else empty.
  std::vector<double> bulges;
  std::vector<double> edge_bulges;
  std::vector<Vec2> originals;
  std::vector<bool> passing;
  double tolerance = 0;  ///< in units of the input
  // Only if the winding rule dropped edges (see winding.h); else empty.
  std::vector<bool> dropped;
  std::vector<std::uint32_t> stands_for;  ///< of a dropped edge: a kept edge of the same face

  bool is_dropped(std::uint32_t edge) const { return !dropped.empty() && dropped[edge]; }
  /// In units of the input.
  Vec2 original(std::uint32_t vertex) const {
    return originals.empty() ? points[vertex] : originals[vertex];
  }
  std::uint32_t ring_of(std::uint32_t vertex) const;  ///< O(log of the number of rings)
  std::uint32_t previous(std::uint32_t vertex) const;
};

/// Inserts the splits into the rings. O(n + splits log splits).
Arrangement insert_splits(CleanRings cleaned, Sweep sweep);

/// The same for an outline with arcs, whose splits have been applied. O(n).
Arrangement arrange_arcs(SweptArcs swept);

/// An edge, seen from one of its ends.
struct Ray {
  Vec2 far;
  std::uint32_t edge = 0;
  double bulge = 0;         ///< when walked away from that end
  bool outgoing = false;    ///< when walked with the interior on the left
  bool from_start = false;  ///< the end is the edge's first vertex
};

/// The ray of an edge from its first vertex, or from its other one.
Ray ray_from_start(const Arrangement& arrangement, std::uint32_t edge);
Ray ray_from_end(const Arrangement& arrangement, std::uint32_t edge);

/// Whether b comes after a counter-clockwise around their common end. Both must be on the same side
/// of it (left or right, or straight below or above).
bool turns_left(Vec2 center, const Ray& a, const Ray& b);

/// A closed walk along edges with the interior on the left.
struct SplicedLoop {
  std::uint32_t first_edge = 0;  ///< begins at `first_vertex`
  /// The first vertex, in the order of the rings, at which the loop is not straight.
  std::uint32_t first_vertex = no_index;
  std::uint32_t size = 0;
  std::uint32_t leftmost = 0;  ///< the leftmost vertex
  bool hole = false;
  std::uint32_t component = no_index;
};

/// The edges joined into loops. An edge with the interior on its right is walked backwards.
struct SplicedLoops {
  std::vector<std::uint32_t> successor;  ///< of each edge, in its loop
  std::vector<std::uint32_t> loop_of;    ///< of each edge
  std::vector<SplicedLoop> loops;
};

/// The vertex that an edge begins with when walked with the interior on the left.
inline std::uint32_t tail(const Arrangement& arrangement, std::uint32_t edge) {
  return arrangement.interior_left[edge] ? edge : arrangement.next[edge];
}

/// The rays of all edges at one place, counter-clockwise from straight down. Requires all vertices
/// of the place. O(t log t).
void rays_around(const Arrangement& arrangement, std::span<const Touch> touches,
                 std::vector<Ray>& rays);

/// Joins the edges into loops. Where loops touch, each loop bounds one wedge of the interior, so
/// every loop bounds one component of the open interior, and two loops of one component have no
/// common point. O(n + t log t) for t touching vertices. Error: crossing (a ring with a role
/// crosses another ring at a vertex).
Result<SplicedLoops> splice(std::span<const Ring> rings, const Arrangement& arrangement);

}  // namespace medial
