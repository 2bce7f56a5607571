#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "medial/planar_graph.h"
#include "voronoi/clip.h"

namespace medial::voronoi {

/// Computes the control point and weight of a part of the bisector of two points from its ends.
/// With half the distance d of the points, the position along the bisector is s = d sinh u and the
/// radius is d cosh u. In terms of e = r + s = d exp(u) at both ends, all formulas are closed and
/// free of cancellation. If the points are very close, rounding moves the ends off the bisector, so
/// the line between them need not pass between the points; the control point does, and its weight
/// is large in that case.
inline void take_control_of_points(Vec2 first, Vec2 second, ConicEdge& edge) {
  const Vec2 across = left_of(second - first);
  const double size = norm(across), squared = 0.25 * size * size, scale = 1 / size;
  const Vec2 middle = midpoint(first, second);
  const auto grown = [&](const Disk& disk) {
    const double s = scale * dot(disk.center - middle, across);
    // At least d, in spite of rounding of the radius.
    const double e = std::max(disk.radius + std::abs(s), 0.5 * size), other = squared / e;
    return s >= 0 ? e : other;
  };
  const double e0 = grown(edge.from), e1 = grown(edge.to), sum = e0 + e1, product = e0 * e1;
  edge.control = {middle + (scale * ((product - squared) / sum)) * across,
                  (product + squared) / sum};
  edge.weight = std::max(1.0, 0.5 * sum / std::sqrt(product));
}

/// Clips the edges of a planar graph's diagram at its enclosure, and closes the faces along it.
///
/// Call add() for every edge, then close(), then add_to_face() for the edges around each site.
class EnclosureCut {
 public:
  EnclosureCut(const PlanarGraph& planar_graph, const Box& enclosure, double tolerance,
               VoronoiDiagram& diagram)
      : planar_graph_(planar_graph),
        enclosure_(enclosure),
        tolerance_(tolerance),
        inside_{enclosure.low + Vec2{4 * tolerance, 4 * tolerance},
                enclosure.high - Vec2{4 * tolerance, 4 * tolerance}},
        point_count_(static_cast<std::uint32_t>(planar_graph.points.size())),
        diagram_(diagram) {}

  /// Whether a place is clearly inside the enclosure. Other nodes are cut off, so that nodes that
  /// are equal up to rounding are cut off together.
  bool holds(Vec2 p) const { return is_inside(inside_, p); }

  /// Appends the edge, or its parts inside the enclosure, to the diagram. `node_at(end)` gives the
  /// node of an end, and is called only for ends inside the enclosure; `take_control(part)`
  /// computes the control point and weight of a part from its ends. Returns whether the whole edge
  /// is inside.
  template <class NodeAt, class TakeControl>
  bool add(const ConicEdge& curve, std::array<std::uint32_t, 2> site, bool spoke, NodeAt&& node_at,
           TakeControl&& take_control);

  /// The same for the bisector of two points, which is straight with a curved radius. Clipping it
  /// as a curve with a large weight would be inaccurate.
  template <class NodeAt>
  void add_bisector(Vec2 from, Vec2 to, std::array<std::uint32_t, 2> site, NodeAt&& node_at);

  /// Adds the enclosure's own edges, from crossing to crossing and corner to corner. Error:
  /// internal (the added edges do not go around the enclosure).
  Status close();

  /// Appends an edge of the diagram to a face. If the edge leaves the enclosure, also appends the
  /// enclosure's edges up to the place where the face returns: clockwise, those before the
  /// crossing.
  void add_to_face(std::uint32_t edge, bool forward, std::vector<std::uint32_t>& face) const {
    face.push_back(edge);
    const std::uint32_t node = diagram_.edges[edge].node[forward ? 1 : 0];
    if (node >= first_crossing_) add_enclosure_edges(node, face);
  }
  /// Ends the face of a site. The face of a single site consists of all enclosure edges.
  void end_face(std::uint32_t site, std::vector<std::uint32_t>& face) const;

 private:
  /// A place where an edge leaves the enclosure.
  struct Crossing {
    double place;
    Disk disk;
    std::uint32_t before, after;  ///< sites beside it, counter-clockwise along the enclosure
    std::uint32_t edge, end;      ///< an edge of the diagram, and the end of it that is there
  };

  void add_crossing(const Disk& disk, std::array<std::uint32_t, 2> site, std::uint32_t edge,
                    std::uint32_t end);
  void add_enclosure_edges(std::uint32_t node, std::vector<std::uint32_t>& face) const;
  void settle_ties();
  double distance_to(std::uint32_t site, Vec2 p) const;
  std::uint32_t nearest_to(Vec2 p) const;
  std::uint32_t add_node(const Disk& disk, NodeKind kind);
  void add_enclosure_edge(std::uint32_t from, std::uint32_t to, std::uint32_t site);

  const PlanarGraph& planar_graph_;
  const Box enclosure_;
  const double tolerance_;
  const Box inside_;
  const std::uint32_t point_count_;
  VoronoiDiagram& diagram_;
  std::vector<ClippedPart> parts_;
  std::vector<Crossing> crossings_;
  std::uint32_t first_crossing_ = 0;  ///< node
  std::vector<std::uint32_t>
      enclosure_begin_;  ///< of each crossing: the enclosure's edges before it
  std::uint32_t whole_enclosure_ = no_site;
};

template <class NodeAt, class TakeControl>
bool EnclosureCut::add(const ConicEdge& curve, std::array<std::uint32_t, 2> site, bool spoke,
                       NodeAt&& node_at, TakeControl&& take_control) {
  // A curve lies in the triangle of its control points.
  if (holds(curve.from.center) && holds(curve.to.center) && holds(curve.control.center)) {
    diagram_.edges.push_back(
        {{{node_at(0), node_at(1)}, site, curve.control, curve.weight}, spoke, false});
    return true;
  }
  clip(curve, enclosure_, parts_);
  // All edges of a node must agree on whether it is inside. If the clipping of an edge near the
  // enclosure disagrees, a part of length 0 compensates for that.
  const bool begins = holds(curve.from.center), ends_inside = holds(curve.to.center);
  if (begins && ends_inside && parts_.empty()) parts_.push_back({});
  if (begins && (parts_.empty() || parts_.front().from > 0)) parts_.insert(parts_.begin(), {0, 0});
  if (ends_inside && (parts_.empty() || parts_.back().to < ConicEdge::last))
    parts_.push_back({ConicEdge::last, ConicEdge::last});
  for (const ClippedPart& part : parts_) {
    const bool from_node = begins && part.from == 0,
               to_node = ends_inside && part.to == ConicEdge::last;
    const bool whole = from_node && to_node && part.from < part.to;
    if (whole) {
      diagram_.edges.push_back(
          {{{node_at(0), node_at(1)}, site, curve.control, curve.weight}, spoke, false});
      continue;
    }
    ConicEdge cut = curve.part(part.from, part.to);
    // A part that exists only by rounding, between nodes at the enclosure.
    if (!from_node && !to_node &&
        std::max(std::abs(cut.to.center.x - cut.from.center.x),
                 std::abs(cut.to.center.y - cut.from.center.y)) <= 8 * tolerance_)
      continue;
    if (part.from < part.to) take_control(cut);
    const auto number = static_cast<std::uint32_t>(diagram_.edges.size());
    std::array<std::uint32_t, 2> ends{no_site, no_site};
    if (from_node)
      ends[0] = node_at(0);
    else
      add_crossing(cut.from, site, number, 0);
    if (to_node)
      ends[1] = node_at(1);
    else
      add_crossing(cut.to, site, number, 1);
    diagram_.edges.push_back({{ends, site, cut.control, cut.weight}, spoke, false});
  }
  return false;
}

template <class NodeAt>
void EnclosureCut::add_bisector(Vec2 from, Vec2 to, std::array<std::uint32_t, 2> site,
                                NodeAt&& node_at) {
  const Vec2 first = planar_graph_.points[site[0]], second = planar_graph_.points[site[1]];
  const auto take_control = [&](ConicEdge& part) {
    part.from.radius = distance(part.from.center, first);
    part.to.radius = distance(part.to.center, first);
    take_control_of_points(first, second, part);
  };
  const ConicEdge line{{from, 0}, {midpoint(from, to), 0}, {to, 0}, 1};
  add(line, site, false, node_at, take_control);
}

}  // namespace medial::voronoi
