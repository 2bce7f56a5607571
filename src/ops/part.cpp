// Parts of an axis, cut at exact places, and the way from the plane to the axis.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "base/arc.h"
#include "base/compat.h"
#include "base/numbers.h"
#include "medial/centreline.h"
#include "medial/query.h"
#include "ops/routes.h"

namespace medial {
namespace {

/// The direction in which disks leave the boundary at a foot; 0 where a vertex leaves it open.
Vec2 inward_at(const Site& site, Vec2 foot, Vec2 p) {
  if (site.kind() == SiteKind::vertex) return p - foot;
  if (site.kind() == SiteKind::segment) return left_of(site.end - site.start);
  const BulgeArc arc{site.start, site.end, site.bulge};
  return left_of(start_tangent(arc) + curvature(arc) * left_of(foot - site.start));
}

/// Where an edge's centres cross the line from `foot` in direction `inward`, and by how much they
/// miss it where they do not.
std::pair<double, double> crossing_of(const Curve& curve, Vec2 foot, Vec2 inward) {
  const Vec2 start = curve.origin - foot;
  const auto beside = [&](double t) { return cross(inward, start + curve.offset(t)); };
  double low = 0, high = 1;
  const double at_low = beside(0), at_high = beside(1);
  if (at_low == 0) return {0, 0};
  if (at_high == 0) return {1, 0};
  if ((at_low < 0) == (at_high < 0)) {
    const bool first = std::abs(at_low) <= std::abs(at_high);
    return {first ? 0 : 1, std::abs(first ? at_low : at_high) / norm(inward)};
  }
  for (double t = 0.5; low < t && t < high; t = 0.5 * (low + high))
    ((beside(t) < 0) == (at_low < 0) ? low : high) = t;
  return {high, 0};
}

/// The place of the smallest radius (sign 1) or of the largest (sign -1).
EdgePlace extreme_place(const MedialAxis& axis, std::uint32_t edge, double sign) {
  const Edge& e = axis.edges[edge];
  const double r0 = axis.nodes[e.node[0]].disk.radius, r2 = axis.nodes[e.node[1]].disk.radius;
  // The derivative has the sign of the quadratic Bernstein polynomial a, b, c.
  const double a = sign * e.weight * (e.control.radius - r0);
  const double b = sign * 0.5 * (r2 - r0);
  const double c = sign * e.weight * (r2 - e.control.radius);
  const double rounding = 4 * std::max(axis.tolerance, 0x1p-52 * std::max(r0, r2));
  if (std::max({std::abs(a), std::abs(b), std::abs(c)}) <= rounding) return {edge, 0.5};
  if (a < 0 && c > 0) {  // falls, then rises: exactly one root in between
    const double root = std::sqrt(b * b - a * c);
    const double t = b > 0 ? -a / (b - a + root) : (root - b) / (c - b + root);
    if (t > 0 && t < 1) return {edge, t};
  }
  return {edge, b >= 0 ? 0.0 : 1.0};
}

}  // namespace

EdgePlace ops::narrowest_place(const MedialAxis& axis, std::uint32_t edge) {
  return extreme_place(axis, edge, 1);
}

EdgePlace ops::widest_place(const MedialAxis& axis, std::uint32_t edge) {
  return extreme_place(axis, edge, -1);
}

MedialAxis ops::PartMaker::part(std::span<const PathPiece> pieces) {
  MedialAxis part;
  part.method = axis_.method;
  part.tolerance = axis_.tolerance;
  part.resolution = axis_.resolution;
  part.exterior = axis_.exterior;
  std::map<std::pair<std::uint32_t, double>, std::uint32_t> inner_node_of;
  const auto add_node = [&](const Node& node) {
    part.nodes.push_back(node);
    return static_cast<std::uint32_t>(part.nodes.size() - 1);
  };
  const auto node_at = [&](std::uint32_t edge, double t) {
    const Edge& e = axis_.edges[edge];
    if (t == 0 || t == 1) {
      const std::uint32_t old = e.node[t == 0 ? 0 : 1];
      if (node_of_[old] == none) node_of_[old] = add_node(axis_.nodes[old]);
      return node_of_[old];
    }
    const auto [found, is_new] = inner_node_of.try_emplace({edge, t}, 0);
    if (is_new) {
      found->second =
          add_node({disk_at(axis_, e, t), axis_.nodes[e.node[0]].component, NodeKind::site_change});
    }
    return found->second;
  };
  part.edges.reserve(pieces.size());
  for (const PathPiece& piece : pieces) {
    Edge edge = axis_.edges[piece.edge];
    const Curve curve = curve_of(axis_, edge);
    edge.node = {node_at(piece.edge, piece.from), node_at(piece.edge, piece.to)};
    if (std::abs(piece.to - piece.from) != 1)
      std::tie(edge.control, edge.weight) = curve.control_between(piece.from, piece.to);
    if (piece.from > piece.to) std::swap(edge.site[0], edge.site[1]);
    part.edges.push_back(edge);
  }
  for (const PathPiece& piece : pieces)
    for (const std::uint32_t node : axis_.edges[piece.edge].node) node_of_[node] = none;
  set_node_kinds(part);
  return part;
}

MedialAxis part_of(const MedialAxis& axis, std::span<const PathPiece> pieces) {
  MedialAxis part = ops::PartMaker(axis).part(pieces);
  part.sites = axis.sites;
  return part;
}

namespace ops {

std::vector<PathPiece> wide_pieces(const MedialAxis& axis, std::uint32_t index, double clearance) {
  // The radius less `clearance`, times the denominator of the curve.
  const Edge& edge = axis.edges[index];
  const double a = axis.nodes[edge.node[0]].disk.radius - clearance;
  const double b = edge.weight * (edge.control.radius - clearance);
  const double c = axis.nodes[edge.node[1]].disk.radius - clearance;
  std::vector<double> cuts{0};
  add_roots(a, b, c, cuts);
  std::sort(cuts.begin(), cuts.end());
  if (cuts.size() == 3 && cuts[1] == cuts[2]) cuts.resize(1);  // touches it
  cuts.push_back(1);
  // Just behind its start, the edge is wide by the first number that is not 0.
  bool wide = a != 0 ? a > 0 : b != 0 ? b > 0 : c >= 0;
  std::vector<PathPiece> pieces;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i, wide = !wide)
    if (wide) pieces.push_back({index, cuts[i], cuts[i + 1]});
  return pieces;
}

}  // namespace ops

MedialAxis clearance_part(const MedialAxis& axis, double clearance) {
  std::vector<PathPiece> pieces;
  std::vector<bool> covered(axis.nodes.size(), false);
  for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
    for (const PathPiece& piece : ops::wide_pieces(axis, i, clearance)) {
      pieces.push_back(piece);
      if (piece.from == 0) covered[axis.edges[i].node[0]] = true;
      if (piece.to == 1) covered[axis.edges[i].node[1]] = true;
    }
  }
  MedialAxis part = part_of(axis, pieces);
  for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
    if (covered[i] || !(axis.nodes[i].disk.radius >= clearance)) continue;
    part.nodes.push_back(axis.nodes[i]);
    part.nodes.back().kind = NodeKind::leaf;
  }
  return part;
}

namespace {

/// Of the edges that `takes` takes, the nearest place to p.
template <class Takes>
std::optional<EdgePlace> nearest_place(const MedialAxis& axis, Vec2 p, const Takes& takes) {
  std::optional<EdgePlace> best;
  double nearest = infinity;
  for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
    if (!takes(axis.edges[i])) continue;
    const Curve curve = curve_of(axis, axis.edges[i]);
    const double t = curve.nearest(p);
    const double d = norm(curve.offset(t) - (p - curve.origin));
    if (d < nearest) {
      nearest = d;
      best = {i, t};
    }
  }
  return best;
}

/// The nearest site to p, and the foot there. Of a vertex and the end of an edge there, the vertex:
/// their distances differ by rounding.
std::pair<std::uint32_t, Vec2> nearest_site(const MedialAxis& axis, Vec2 p) {
  constexpr double rounding = 1 + 0x1p-48;
  std::pair<std::uint32_t, Vec2> best;
  double nearest = infinity;
  for (std::uint32_t i = 0; i < axis.sites.size(); ++i) {
    const Vec2 q = foot(axis.sites[i], p);
    const double d = distance(p, q);
    const bool vertex = axis.sites[i].kind() == SiteKind::vertex;
    const bool after_vertex =
        nearest < infinity && axis.sites[best.first].kind() == SiteKind::vertex && !vertex;
    if (after_vertex ? d * rounding < nearest : d < nearest * (vertex ? rounding : 1)) {
      nearest = d;
      best = {i, q};
    }
  }
  return best;
}

}  // namespace

std::optional<EdgePlace> place_on_axis(const MedialAxis& axis, Vec2 p) {
  if (axis.edges.empty()) return std::nullopt;
  const bool named = ranges::all_of(axis.edges, [](const Edge& edge) {
    return edge.site[0] != no_site && edge.site[1] != no_site;
  });
  if (!named) return nearest_place(axis, p, [](const Edge&) { return true; });
  const std::pair<std::uint32_t, Vec2> nearest = nearest_site(axis, p);
  const Vec2 touched = nearest.second;
  const auto has_site = [&](const Edge& edge) {
    return edge.site[0] == nearest.first || edge.site[1] == nearest.first;
  };
  const Vec2 inward = inward_at(axis.sites[nearest.first], touched, p);
  if (!(norm(inward) > 0)) return nearest_place(axis, p, has_site);
  std::optional<EdgePlace> best;
  double least = infinity;
  for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
    if (!has_site(axis.edges[i])) continue;
    const Curve curve = curve_of(axis, axis.edges[i]);
    const auto [t, missed] = crossing_of(curve, touched, inward);
    // A vertex has disks in a range of directions, and none in the opposite ones.
    if (dot(inward, curve.origin + curve.offset(t) - touched) < 0) continue;
    if (missed < least) {
      least = missed;
      best = {i, t};
    }
  }
  // A site that touches the disks of nodes only: an arc around a node, which all its normals meet.
  const double size = norm(inward);
  for (std::uint32_t i = 0; i < axis.edges.size() && !(best && least == 0); ++i) {
    for (const double t : {0.0, 1.0}) {
      const Disk disk = disk_at(axis, axis.edges[i], t);
      const double missed = distance(disk.center, touched + (disk.radius / size) * inward);
      if (!(missed < least)) continue;
      least = missed;
      best = {i, t};
    }
  }
  return best;
}

}  // namespace medial
