#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "medial/geometry.h"

namespace medial {

/// What an engine counted and how long it took.
struct Statistics {
  std::uint64_t queries = 0;            ///< nearest-site queries
  std::uint64_t apollonius = 0;         ///< disks computed from three sites
  std::uint64_t brackets = 0;           ///< nodes found by bracketing, where the closed form failed
  std::uint64_t precision_retries = 0;  ///< nodes recomputed in higher precision
  std::uint64_t bridges = 0;            ///< disks that connected a hole
  std::uint64_t exact_filtered = 0;     ///< Options::exact: decided in double with error bounds,
  std::uint64_t exact_precise = 0;      ///< in 256 bits with error bounds,
  std::uint64_t exact_rational = 0;     ///< in rational arithmetic with square roots
  std::uint64_t exact_ties = 0;         ///< sites beyond three that a node's disk touches exactly
  std::uint64_t exact_changes = 0;      ///< decisions in double precision that were wrong
  double largest_residual = 0;          ///< largest |distance - radius| over the nodes' contacts
  double seconds_sites = 0;
  double seconds_tree = 0;
  double seconds_connect = 0;
  double seconds_walk = 0;
  double seconds_collect = 0;
  double seconds_exact = 0;
  double seconds = 0;  ///< all of compute()
  int threads = 1;

  /// Adds the counts and times of another part of the work; `threads` stays.
  Statistics& operator+=(const Statistics& part);
};

enum class SiteKind : std::uint8_t {
  segment,  ///< a straight edge of the shape, both ends included
  vertex,   ///< a reflex vertex
  arc,      ///< a circular edge, both ends included
};

/// What a maximal disk can touch. Convex vertices and smooth joints are no sites.
struct Site {
  Vec2 start;                ///< of a vertex: == end
  Vec2 end;                  ///< the interior lies on the left of start -> end
  std::uint32_t ring = 0;    ///< ring of the input (for a segment: of its start)
  std::uint32_t vertex = 0;  ///< vertex in that ring
  SiteKind kind = SiteKind::segment;
  double bulge = 0;  ///< of an arc, see Ring
};

enum class NodeKind : std::uint8_t {
  leaf,         ///< one edge: a convex corner (radius 0) or the centre of an arc of locally largest
                ///< curvature
  site_change,  ///< two edges: the axis passes to another site
  branching,    ///< three edges or more
};

/// In place of a site, where a sampled axis does not record what its disks touch.
constexpr std::uint32_t no_site = 0xFFFFFFFF;

struct Node {
  Disk disk;
  std::uint32_t component = 0;  ///< of the shape, or of its exterior
  NodeKind kind = NodeKind::leaf;
};

/// A piece of the axis between two sites: the rational quadratic Bezier curve in (x, y, r) with
/// control points node[0], `control`, node[1] and weights 1, `weight`, 1. It is the exact bisector:
/// a line (two segments), a parabola (a segment and a vertex or an arc; weight 1), a line whose
/// radius is a hyperbola (two vertices; weight >= 1), or with an arc an ellipse, a hyperbola, a
/// line or a circle.
struct Edge {
  std::array<std::uint32_t, 2> node;  ///< from, to
  std::array<std::uint32_t, 2> site;  ///< on the left and on the right of from -> to; or no_site
  Disk control;                       ///< its radius may be negative
  double weight = 1;                  ///< positive
};

/// The medial axis transform: a graph of exact curves in (x, y, r).
///
/// A sampled axis has a `resolution` above 0. Of `potential` that is about the longest step along
/// the axis: each node's radius is its exact distance to the boundary, edges are straight and name
/// the nearest site on each side. On a grid of square pixels it is the side of a pixel: nodes,
/// ordered by y, then x, are centres of medial pixels (of `ridge`, points between them where there
/// is no room for pixels), with radii within half a pixel's diagonal of the distance to the
/// boundary; edges are straight, to one of eight neighbours, with the control point in the middle
/// and weight 1; their sites are two that the disk of the first node touches within a few pixels,
/// or both no_site. docs/ridge.md says which pixels are linked.
struct MedialAxis {
  std::string method;     ///< the engine's name: see name_of(Method)
  double tolerance = 0;   ///< bound of |distance - radius|, in units of the input
  double resolution = 0;  ///< 0: exact; otherwise the step of a sampled method
  /// 0: the axis of the interior. Otherwise of the exterior, in an enclosure this far from the
  /// shape's bounding box, without edges whose disks touch it; sites have the exterior on the left.
  double exterior = 0;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  Statistics statistics;
};

}  // namespace medial
