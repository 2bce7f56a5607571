#include "voronoi/long_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "axis/sites.h"
#include "base/arc.h"
#include "base/compat.h"
#include "site/around_point.h"
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

/// Whether the foot on an arc moves forward between two centres. It never passes half a circle, so
/// it does where the feet are more than a quarter apart.
bool moves_forward(const site::Site& arc, Vec2 from, Vec2 to) {
  const Vec2 toward = site::view_of_arc(arc, from).toward, way = to - from;
  return cross(way, toward) > 0 || squared_norm(toward) <= arc.curvature * dot(toward, way);
}

/// Where an edge around a point begins and ends, by its parameter, and by how much it turns.
struct WayAround {
  double first = 0, last = 0, turn = 0;
};

/// The way from a centre to another one in the direction `sign`; none where they are one place up
/// to rounding.
WayAround way_around(const site::AroundPoint& around, Vec2 begin, Vec2 end, double sign,
                     double tolerance, bool of_lone_point, bool is_loop) {
  constexpr double half = std::numbers::pi, whole = 2 * half, backward = 1e-6;
  double first = around.parameter(begin), last = around.parameter(end);
  if (is_loop) {
    // Between the point and the arc; one node on both sides of the ellipse stands for two.
    first = -sign * std::abs(first);
    return {first, -first, 2 * std::abs(around.direction_at(first))};
  }
  const auto way_by = [&](auto&& angle_at) {
    const double wrap = sign * (last - first) < 0 ? whole : 0;
    return sign * (angle_at(last) - angle_at(first)) + wrap;
  };
  // No foot goes further on an arc than half a circle, and a quarter may be rounding next to its
  // centre: else a node that stands for both sides of the far half has been taken for the other.
  const auto fits = [&] {
    return way_by([&](double p) { return around.foot_at(p); }) <= 1.5 * half;
  };
  if (!fits()) {
    const double at_begin = around.misfit(begin), at_end = around.misfit(end);
    double& unsure = at_begin > at_end ? first : last;
    unsure = -unsure;
    if (std::max(at_begin, at_end) == 0 || !fits()) unsure = -unsure;
  }
  const double way = way_by([](double p) { return p; });
  const double turn = way_by([&](double p) { return around.direction_at(p); });
  // Along one part of a bisector both feet go forward. Where only the one around a lone point goes
  // backward, by more than the rounding of both ends, an ellipse leads all around.
  const auto goes_around = [&] {
    const double rounding = around.rounding(begin, tolerance) + around.rounding(end, tolerance);
    return whole - way > rounding &&
           moves_forward(around.own, sign < 0 ? end : begin, sign < 0 ? begin : end);
  };
  const bool is_backward =
      way > half && !(whole - turn > backward || (of_lone_point && goes_around()));
  return {first, last, is_backward ? 0 : turn};
}

/// Directions around a point that divide an edge there, which turns so far: into parts of at most a
/// quarter of a turn, by direction and by the ellipse's own parameter.
std::vector<double> divide(const site::AroundPoint& around, double start, double turn) {
  constexpr double quarter = 0.5 * std::numbers::pi, whole = 4 * quarter, rounding = 1e-6;
  const auto parts_of = [](double angle) {
    return std::ceil(std::abs(angle) / quarter - rounding);
  };
  std::vector<double> directions;
  const double parts = parts_of(turn);
  double before = around.parameter_at(start);
  for (double k = 1; k <= parts; ++k) {
    const double direction = std::remainder(start + turn * k / parts, whole);
    const double after = around.parameter_at(direction);
    double way = after - before;
    if ((turn > 0 ? way : -way) < -rounding) way += std::copysign(whole, turn);
    const double smaller = parts_of(way);
    for (double i = 1; i < smaller; ++i)
      directions.push_back(around.direction_at(before + way * i / smaller));
    if (k < parts) directions.push_back(direction);
    before = after;
  }
  return directions;
}

/// An edge that is divided, and its pieces so far.
template <class E>
class Pieces {
 public:
  Pieces(MedialAxis& axis, std::vector<E>& edges, std::size_t e)
      : axis_(axis), edges_(edges), e_(e), edge_(edges[e]), last_(edge_.node[0]) {}

  /// The next piece leads to a new node.
  void add_to(const Disk& disk, std::optional<site::Control> control) {
    const auto node = static_cast<std::uint32_t>(axis_.nodes.size());
    axis_.nodes.push_back({disk, axis_.nodes[last_].component, NodeKind::site_change});
    add(node, control);
  }
  void add_last(std::optional<site::Control> control) {
    if (!is_first_) add(edge_.node[1], control);
  }

 private:
  void add(std::uint32_t to, std::optional<site::Control> control) {
    E piece = edge_;
    piece.node = {last_, to};
    ConicEdge curve{axis_.nodes[last_].disk, {}, axis_.nodes[to].disk, 1};
    if (control) {
      curve.control = control->point;
      curve.weight = control->weight;
    } else {
      take_control(axis_.sites[edge_.site[0]], axis_.sites[edge_.site[1]], curve);
    }
    piece.control = curve.control;
    piece.weight = curve.weight;
    if (std::exchange(is_first_, false))
      edges_[e_] = piece;
    else
      edges_.push_back(piece);
    last_ = to;
  }

  MedialAxis& axis_;
  std::vector<E>& edges_;
  std::size_t e_;
  const E edge_;
  std::uint32_t last_;
  bool is_first_ = true;
};

}  // namespace

void take_control(const Site& left, const Site& right, ConicEdge& part) {
  // Compute relative to an origin at which sizes are about one. For a parabola, the origin is the
  // vertex: far from it, the vertex is close to the segment, whose direction and distance would be
  // inaccurate relative to the edge. An arc is about as large as its visible part, so the edge's
  // end serves as origin.
  const bool has_arc = left.kind() == SiteKind::arc || right.kind() == SiteKind::arc;
  const Site& vertex = left.kind() == SiteKind::vertex ? left : right;
  const Vec2 origin = has_arc ? part.from.center : vertex.start;
  const double unit = unit_for(
      std::max({distance(part.from.center, part.to.center), part.from.radius, part.to.radius}));
  const auto seen = [&](const Disk& disk) {
    return Disk{unit * (disk.center - origin), unit * disk.radius};
  };
  const Disk from = seen(part.from), to = seen(part.to);
  const Vec2 middle = midpoint(from.center, to.center);
  const site::Control control = site::control_of(seen_from(left, origin, unit, middle),
                                                 seen_from(right, origin, unit, middle), from, to);
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
    // Seen from the point, coordinates keep their digits.
    const Vec2 point = axis.sites[edge.site[side]].start;
    const site::Site seen = seen_from(other, point, 1, {0, 0});
    const site::AroundPoint around(seen, {0, 0});
    const Vec2 begin = axis.nodes[edge.node[0]].disk.center - point;
    const Vec2 end = axis.nodes[edge.node[1]].disk.center - point;
    // The foot on the right goes forward, around a vertex clockwise; on the left it is the other
    // way around.
    const double sign = side == 1 ? -1 : 1;
    const bool of_lone_point = is_arc(other) && is_lone_point(axis, edge.site[side]);
    const bool is_loop = of_lone_point && edge.node[0] == edge.node[1];
    const auto [first, last, turn] =
        way_around(around, begin, end, sign, axis.tolerance, of_lone_point, is_loop);
    if (!(turn > 0)) continue;
    double before = first;
    const auto control_to = [&](double parameter) -> std::optional<site::Control> {
      if (!is_loop || !around.is_ellipse()) return std::nullopt;
      site::Control control = around.control(std::exchange(before, parameter), parameter);
      control.point.center = control.point.center + point;
      return control;
    };
    Pieces<E> pieces(axis, edges, e);
    for (const double direction : divide(around, around.direction_at(first), sign * turn)) {
      const Disk disk = around.disk_at(direction);
      if (!std::isfinite(disk.radius))
        return Error{ErrorCode::internal, "a Voronoi edge has no middle", {}};
      pieces.add_to({point + disk.center, disk.radius}, control_to(around.parameter_at(direction)));
    }
    pieces.add_last(control_to(last));
  }
  return success();
}

template Status split_long_edges(MedialAxis&, std::vector<Edge>&, bool);
template Status split_long_edges(MedialAxis&, std::vector<VoronoiEdge>&, bool);

}  // namespace medial::voronoi
