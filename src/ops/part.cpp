// Parts of an axis, cut at exact places, and the way from the plane to the axis.

#include "ops/part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "base/arc.h"
#include "base/compat.h"
#include "base/numbers.h"
#include "medial/centreline.h"
#include "medial/query.h"

namespace medial {
namespace {

/// The rational function of an edge's radius less `clearance`, times its denominator:
/// a (1-t)^2 + 2 b t (1-t) + c t^2.
struct Excess {
  double a, b, c;
  Excess(const MedialAxis& axis, const Edge& edge, double clearance)
      : a(axis.nodes[edge.node[0]].disk.radius - clearance),
        b(edge.weight * (edge.control.radius - clearance)),
        c(axis.nodes[edge.node[1]].disk.radius - clearance) {}
};

/// A point between the ends of an edge, by the homogeneous blossom at two parameters; coordinates
/// are relative to the edge's first node.
struct Lifted {
  double x, y, r, w;
};

Lifted blossom(const Curve& curve, double s, double t) {
  const double b0 = (1 - s) * (1 - t), b1 = (1 - s) * t + s * (1 - t), b2 = s * t;
  const double w1 = b1 * curve.weight;
  return {w1 * curve.p1.x + b2 * curve.p2.x, w1 * curve.p1.y + b2 * curve.p2.y,
          b0 * curve.r0 + w1 * curve.r1 + b2 * curve.r2, b0 + w1 + b2};
}

/// The direction in which disks leave the boundary at a foot; 0 where a vertex leaves it open.
Vec2 inward_at(const Site& site, Vec2 foot, Vec2 p) {
  if (site.kind == SiteKind::vertex) return p - foot;
  if (site.kind == SiteKind::segment) return left_of(site.end - site.start);
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

}  // namespace

namespace {

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

EdgePlace narrowest_place(const MedialAxis& axis, std::uint32_t edge) {
  return extreme_place(axis, edge, 1);
}

EdgePlace widest_place(const MedialAxis& axis, std::uint32_t edge) {
  return extreme_place(axis, edge, -1);
}

MedialAxis part_of(const MedialAxis& axis, std::span<const PathPiece> pieces) {
  MedialAxis part;
  part.method = axis.method;
  part.tolerance = axis.tolerance;
  part.resolution = axis.resolution;
  part.exterior = axis.exterior;
  part.sites = axis.sites;
  std::vector<std::uint32_t> node_of(axis.nodes.size(), none);
  std::map<std::pair<std::uint32_t, double>, std::uint32_t> inner_node_of;
  std::vector<std::uint32_t> degree;
  const auto add_node = [&](const Node& node) {
    part.nodes.push_back(node);
    degree.push_back(0);
    return static_cast<std::uint32_t>(part.nodes.size() - 1);
  };
  const auto node_at = [&](std::uint32_t edge, double t) {
    const Edge& e = axis.edges[edge];
    if (t == 0 || t == 1) {
      const std::uint32_t old = e.node[t == 0 ? 0 : 1];
      if (node_of[old] == none) node_of[old] = add_node(axis.nodes[old]);
      return node_of[old];
    }
    const auto [found, is_new] = inner_node_of.try_emplace({edge, t}, 0);
    if (is_new) {
      found->second =
          add_node({disk_at(axis, e, t), axis.nodes[e.node[0]].component, NodeKind::site_change});
    }
    return found->second;
  };
  part.edges.reserve(pieces.size());
  for (const PathPiece& piece : pieces) {
    Edge edge = axis.edges[piece.edge];
    const Curve curve = curve_of(axis, edge);
    edge.node = {node_at(piece.edge, piece.from), node_at(piece.edge, piece.to)};
    for (const std::uint32_t node : edge.node) ++degree[node];
    const bool whole = std::abs(piece.to - piece.from) == 1;
    if (!whole) {
      const double from = blossom(curve, piece.from, piece.from).w;
      const double to = blossom(curve, piece.to, piece.to).w;
      const Lifted middle = blossom(curve, piece.from, piece.to);
      edge.control = {curve.origin + (1 / middle.w) * Vec2{middle.x, middle.y},
                      middle.r / middle.w};
      edge.weight = middle.w / std::sqrt(from * to);
    }
    if (piece.from > piece.to) std::swap(edge.site[0], edge.site[1]);
    part.edges.push_back(edge);
  }
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    part.nodes[i].kind = kind_of_degree(degree[i]);
  }
  return part;
}

namespace ops {

std::vector<PathPiece> wide_pieces(const MedialAxis& axis, std::uint32_t index, double clearance) {
  const auto [a, b, c] = Excess(axis, axis.edges[index], clearance);
  const double discriminant = b * b - a * c;
  if (a < 0 && c < 0 && !(b > 0 && discriminant > 0)) return {};
  // The roots as t = u / (1 + u), where c u^2 + 2 b u + a = 0: without cancellation.
  const double q = std::abs(b) + std::sqrt(std::max(discriminant, 0.0));
  if (a < 0 && c < 0) return {{index, a / (a - q), q / (q - c)}};  // rises, then falls
  if (a >= 0 && c >= 0) {
    if (!(b < 0 && discriminant > 0)) return {{index, 0, 1}};
    std::vector<PathPiece> pieces;
    const double first = a / (a + q), second = q / (q + c);
    if (first > 0) pieces.push_back({index, 0, first});
    if (second < 1) pieces.push_back({index, second, 1});
    return pieces;
  }
  if (a >= 0) {  // falls through
    const double t = b <= 0 ? a / (a + q) : q / (q - c);
    return t > 0 ? std::vector<PathPiece>{{index, 0, t}} : std::vector<PathPiece>{};
  }
  const double t = b <= 0 ? q / (q + c) : -a / (q - a);
  return t < 1 ? std::vector<PathPiece>{{index, t, 1}} : std::vector<PathPiece>{};
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

std::optional<EdgePlace> place_on_axis(const MedialAxis& axis, Vec2 p) {
  if (axis.edges.empty()) return std::nullopt;
  const auto nearest_of = [&](const auto& takes) -> std::optional<EdgePlace> {
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
  };
  const bool named = ranges::all_of(axis.edges, [](const Edge& edge) {
    return edge.site[0] != no_site && edge.site[1] != no_site;
  });
  if (!named) return nearest_of([](const Edge&) { return true; });

  // Of a vertex and the end of an edge there, the vertex: their distances differ by rounding.
  constexpr double rounding = 1 + 0x1p-48;
  std::uint32_t site = 0;
  Vec2 touched;
  double nearest = infinity;
  for (std::uint32_t i = 0; i < axis.sites.size(); ++i) {
    const Vec2 q = foot(axis.sites[i], p);
    const double d = distance(p, q);
    const bool vertex = axis.sites[i].kind == SiteKind::vertex;
    const bool after_vertex =
        nearest < infinity && axis.sites[site].kind == SiteKind::vertex && !vertex;
    if (after_vertex ? d * rounding < nearest : d < nearest * (vertex ? rounding : 1)) {
      nearest = d;
      site = i;
      touched = q;
    }
  }
  const auto has_site = [&](const Edge& edge) {
    return edge.site[0] == site || edge.site[1] == site;
  };
  const Vec2 inward = inward_at(axis.sites[site], touched, p);
  if (!(norm(inward) > 0)) return nearest_of(has_site);
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
      const Vec2 expected = touched + (disk.radius / size) * inward;
      const double missed = distance(disk.center, expected);
      if (!(missed < least)) continue;
      least = missed;
      best = {i, t};
    }
  }
  return best;
}

}  // namespace medial
