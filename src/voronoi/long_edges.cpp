#include "voronoi/long_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "axis/sites.h"
#include "base/arc.h"
#include "base/compat.h"
#include "site/bisector.h"
#include "site/site.h"
#include "site/tangent_disk.h"

namespace medial::voronoi {
namespace {

bool is_vertex(const MedialAxis& axis, std::uint32_t own) {
  return axis.sites[own].kind() == SiteKind::vertex;
}

/// Whether no edge begins at a vertex: of others, a planar graph has at most a half turn as a site.
bool is_lone_point(const MedialAxis& axis, std::uint32_t own) {
  if (own + 1 == axis.sites.size()) return true;
  const Site& next = axis.sites[own + 1];
  return next.kind() == SiteKind::vertex || next.start != axis.sites[own].start;
}

/// A power of two that makes a size about one.
double unit_for(double size) {
  return std::exp2(-std::ilogb(std::max(size, std::numeric_limits<double>::min())));
}

/// A site seen from an origin, in a unit of its own; of an arc longer than a quarter of a circle,
/// the half next to a place.
site::Site seen_from(const Site& site, Vec2 origin, double unit, Vec2 near) {
  const auto seen = [&](Vec2 p) { return unit * (p - origin); };
  if (site.kind() == SiteKind::vertex) return site::make_vertex(seen(site.start));
  const site::Pieces pieces = site::pieces_of(seen(site.start), seen(site.end), site.bulge);
  const bool first = pieces.count == 1 || site::squared_distance(pieces.first(), near) <=
                                              site::squared_distance(pieces.last(), near);
  return first ? pieces.first() : pieces.last();
}

/// How far the foot on a site moves between two centres, up to a factor.
double foot_way(const Site& site, Vec2 from, Vec2 to) {
  const double unit = unit_for(distance(site.start, from));
  const site::Site seen = seen_from(site, from, unit, {0, 0});
  return site::carrier_parameter(seen, unit * (to - from)) - site::carrier_parameter(seen, {0, 0});
}

/// The disk through a point that grows in a direction until it touches an arc, if rounding leaves
/// one.
std::optional<Disk> disk_towards(const MedialAxis& axis, Vec2 point, Vec2 direction,
                                 std::uint32_t own) {
  const Site& site = axis.sites[own];
  const site::Pieces pieces = site::pieces_of(site.start - point, site.end - point, site.bulge);
  const double radius = site::tangent_radius({0, 0}, direction, pieces.first());
  if (!std::isfinite(radius)) return std::nullopt;
  return Disk{point + radius * direction, radius};
}

template <class E>
void add_piece(const MedialAxis& axis, std::vector<E>& edges, std::size_t e, bool first, E edge,
               std::uint32_t from, std::uint32_t to) {
  edge.node = {from, to};
  ConicEdge curve{axis.nodes[from].disk, {}, axis.nodes[to].disk, 1};
  take_control(axis.sites[edge.site[0]], axis.sites[edge.site[1]], curve);
  edge.control = curve.control;
  edge.weight = curve.weight;
  if (first)
    edges[e] = edge;
  else
    edges.push_back(edge);
}

}  // namespace

void take_control(const Site& left, const Site& right, ConicEdge& part) {
  // Rounding is measured against a size of about one.
  const Vec2 origin = part.from.center, way = part.to.center - origin;
  const double unit = unit_for(std::max({norm(way), part.from.radius, part.to.radius}));
  const Vec2 middle = midpoint({0, 0}, unit * way);
  const site::Control control = site::control_of(
      seen_from(left, origin, unit, middle), seen_from(right, origin, unit, middle),
      {{0, 0}, unit * part.from.radius}, {unit * way, unit * part.to.radius});
  part.control = {origin + (1 / unit) * control.point.center, control.point.radius / unit};
  part.weight = control.weight;
}

template <class E>
Status split_long_edges(MedialAxis& axis, std::vector<E>& edges, bool parabolas) {
  const auto is_arc = [](const Site& site) { return site.kind() == SiteKind::arc; };
  if (!parabolas && ranges::none_of(axis.sites, is_arc)) return success();
  const std::size_t count = edges.size();
  for (std::size_t e = 0; e < count; ++e) {
    const E edge = edges[e];
    const std::size_t side = is_vertex(axis, edge.site[0]) ? 0 : 1;
    const Site& other = axis.sites[edge.site[1 - side]];
    if (!is_vertex(axis, edge.site[side]) || !(is_arc(other) || parabolas)) continue;
    if (other.kind() == SiteKind::vertex) continue;
    const Vec2 point = axis.sites[edge.site[side]].start;
    const Vec2 from = axis.nodes[edge.node[0]].disk.center - point;
    const Vec2 to = axis.nodes[edge.node[1]].disk.center - point;
    // The foot on the right goes forward, around a vertex clockwise; on the left it is the other
    // way around.
    const double sign = side == 1 ? -1 : 1;
    double turn = sign * std::atan2(cross(from, to), dot(from, to));
    // Along one part of a bisector both feet go forward. Where only the one around a lone point
    // goes backward, by more than the rounding of both ends, an ellipse leads all around.
    constexpr double backward = 1e-6;
    const double rounding = 2 * axis.tolerance / std::min(norm(from), norm(to));
    const auto goes_around = [&] {
      const Vec2 begin = axis.nodes[edge.node[0]].disk.center;
      const Vec2 end = axis.nodes[edge.node[1]].disk.center;
      return edge.node[0] == edge.node[1] ||
             (turn < -rounding && sign * foot_way(other, begin, end) > 0);
    };
    if (turn < -backward ||
        (is_arc(other) && is_lone_point(axis, edge.site[side]) && goes_around()))
      turn += 2 * std::numbers::pi;
    const double pieces = std::ceil(turn / (0.5 * std::numbers::pi));
    std::uint32_t last = edge.node[0];
    for (double k = 1; k < pieces; ++k) {
      const double angle = sign * turn * k / pieces, size = norm(from);
      const Vec2 direction = (1 / size) * turned(from, std::cos(angle), std::sin(angle));
      const auto node = static_cast<std::uint32_t>(axis.nodes.size());
      const auto disk = disk_towards(axis, point, direction, edge.site[1 - side]);
      if (!disk) return Error{ErrorCode::internal, "a Voronoi edge has no middle", {}};
      axis.nodes.push_back({*disk, axis.nodes[edge.node[0]].component, NodeKind::site_change});
      add_piece(axis, edges, e, k == 1, edge, last, node);
      last = node;
    }
    if (pieces > 1) add_piece(axis, edges, e, false, edge, last, edge.node[1]);
  }
  return success();
}

template Status split_long_edges(MedialAxis&, std::vector<Edge>&, bool);
template Status split_long_edges(MedialAxis&, std::vector<VoronoiEdge>&, bool);

}  // namespace medial::voronoi
