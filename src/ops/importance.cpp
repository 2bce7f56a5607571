#include "ops/importance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "axis/curve.h"
#include "base/arc.h"
#include "medial/query.h"

namespace medial::ops {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degrees = 180 / pi;

/// a / b, but finite.
double share(double a, double b) {
  return a <= 0 ? 0 : std::min(a / b, std::numeric_limits<double>::max());
}

}  // namespace

Importance::Importance(const MedialAxis& axis, const Trees& trees, PruneMeasure measure,
                       bool reaches)
    : axis_(axis), trees_(trees), measure_(measure), size_(trees.radius) {
  using enum PruneMeasure;
  of_branches_ =
      measure == prominence || measure == significance || measure == length || measure == ratio;
  of_sides_ = measure == ratio || measure == potential || measure == residual || measure == area;
  of_reach_ = reaches || measure == prominence || measure == significance || measure == length ||
              measure == erosion;
  if (measure == angle || measure == lambda || measure == residual) steps_ = 4;
  if (measure == scale) find_vanishing();
  if (of_reach_ || of_sides_) sum_up();
}

void Importance::find_vanishing() {
  disks_.emplace(axis_.nodes, trees_.part);
  vanishing_.resize(axis_.nodes.size());
  const auto find = [&](std::uint32_t node, const Disk& likely) {
    auto& [factor, other] = vanishing_[node];
    other = likely;
    factor = disks_->vanishes_at(axis_.nodes[node].disk, trees_.part[node], other);
  };
  // From the core outwards, because neighbours usually vanish in the same disk.
  for (std::uint32_t i = 0; i < axis_.nodes.size(); ++i)
    if (trees_.inwards[i] == none) find(i, axis_.nodes[trees_.deepest[trees_.part[i]]].disk);
  for (auto e = trees_.order.rbegin(); e != trees_.order.rend(); ++e) {
    const auto& node = axis_.edges[*e].node;
    const bool outer_first = trees_.outer_end(axis_, *e) == 0;
    find(node[outer_first ? 0 : 1], vanishing_[node[outer_first ? 1 : 0]].second);
  }
}

void Importance::sum_up() {
  beyond_.resize(axis_.nodes.size());
  for (std::size_t i = 0; i < beyond_.size(); ++i) beyond_[i].reach = axis_.nodes[i].disk.radius;
  if (of_sides_) {
    const HalfEdges halves(axis_);
    for (HalfEdge half = 0; half < halves.count(); ++half) {
      const double angle = halves.gap(half), radius = halves.disk(half, true).radius;
      Beyond& at = beyond_[halves.to(half)];
      at.boundary += radius * angle;
      at.area += radius * radius * angle / 2;
    }
  }
  for (const std::uint32_t e : trees_.order) {
    const Beyond all = beyond(e, 1);
    const auto& ends = axis_.edges[e].node;
    Beyond& inner = beyond_[ends[trees_.outer_end(axis_, e) == 0 ? 1 : 0]];
    inner.way = std::max(inner.way, all.way);
    inner.reach = std::max(inner.reach, all.reach);
    inner.boundary += all.boundary;
    inner.area += all.area;
  }
  if (measure_ != PruneMeasure::area) return;
  // Of each part: its trees, and the sides of its core.
  std::fill(size_.begin(), size_.end(), 0.0);
  for (std::uint32_t i = 0; i < axis_.nodes.size(); ++i)
    if (trees_.inwards[i] == none) size_[trees_.part[i]] += beyond_[i].area;
  for (std::uint32_t e = 0; e < axis_.edges.size(); ++e) {
    if (trees_.in_tree(axis_, e)) continue;
    Beyond sides;
    add_sides(e, 0, 1, sides);
    size_[trees_.part[axis_.edges[e].node[0]]] += sides.area;
  }
}

std::array<Vec2, 2> Importance::feet(const Edge& edge, double t, const Disk& disk) const {
  const auto [left, right] = edge.site;
  return feet_at(axis_, edge, t, disk, std::max(left, right) < axis_.sites.size() && left != right);
}

void Importance::add_sides(std::uint32_t e, double t0, double t1, Beyond& sum) const {
  const Edge& edge = axis_.edges[e];
  const Curve whole = curve_of(axis_, edge);
  const Curve curve = t0 == 0 && t1 == 1 ? whole : whole.part(t0, t1);
  const Disk first{curve.origin, curve.r0}, last{curve.end, curve.r2};
  const bool exact = axis_.resolution == 0;
  const std::size_t sites = axis_.sites.size();
  const auto points = [&](double t, const Disk& disk) -> std::array<Vec2, 2> {
    if (!exact || std::max(edge.site[0], edge.site[1]) >= sites)
      return feet_at(axis_, edge, t, disk, false);
    const bool at_last = t == t1;  // where the right side ends, and the left one begins
    return {touch_of(axis_, axis_.sites[edge.site[0]], disk.center, !at_last),
            touch_of(axis_, axis_.sites[edge.site[1]], disk.center, at_last)};
  };
  const std::array<Vec2, 2> from = points(t0, first), to = points(t1, last);
  // Around the piece on the right, counter-clockwise: out along the first radius, along the
  // boundary, back along the last radius and the axis; on the left its mirror image.
  const auto side = [&](Vec2 a, Vec2 b, std::uint32_t site, double sign) {
    double bulge = 0;
    // From the centre of an arc to its centre: nothing of it was passed.
    if (exact && curve.origin == curve.end) return;
    if (exact && site < axis_.sites.size() && axis_.sites[site].kind() == SiteKind::arc &&
        !(a == b)) {
      const Site& arc = axis_.sites[site];
      // On the left the boundary runs against the edge.
      bulge = sign < 0 ? partial_bulge({arc.start, arc.end, arc.bulge}, a, b)
                       : -partial_bulge({arc.start, arc.end, arc.bulge}, b, a);
    }
    sum.boundary += arc_length(distance(a, b), bulge);
    const Vec2 p = a - curve.origin, q = b - curve.origin;
    const double around = cross(p, q) + cross(q, curve.p2);
    const double beside = a == b ? 0 : area_beside_chord({a, b, bulge});
    sum.area += -sign * (around / 2 + beside) + sign * curve.area_beside_chord();
  };
  side(from[1], to[1], edge.site[1], -1);
  side(from[0], to[0], edge.site[0], 1);
}

Importance::Beyond Importance::beyond(std::uint32_t e, double s) const {
  const Edge& edge = axis_.edges[e];
  const bool outer_first = trees_.outer_end(axis_, e) == 0;
  Beyond sum = beyond_[edge.node[outer_first ? 0 : 1]];
  if (s == 0) return sum;
  if (of_reach_) {
    const Curve curve = curve_of(axis_, edge);
    const double along = s == 1        ? curve.length()
                         : outer_first ? curve.length(s)
                                       : curve.length() - curve.length(1 - s);
    sum.way += along;
    sum.reach += along;
  }
  if (of_sides_) add_sides(e, outer_first ? 0 : 1 - s, outer_first ? s : 1, sum);
  return sum;
}

double Importance::reach(std::uint32_t e) const { return beyond(e, 1).reach; }

double Importance::lost_area(const Edge& edge, bool outer_first, double t, const Disk& disk,
                             double area_beyond) const {
  // The sector of the disk that faces outwards stays.
  constexpr double apart = 1e-6;
  const auto [on_left, on_right] = feet(edge, t, disk);
  // Outwards is against the edge where the outer end is the first.
  const Vec2 left = (outer_first ? on_right : on_left) - disk.center;
  const Vec2 right = (outer_first ? on_left : on_right) - disk.center;
  double angle = left_turn(right, left);
  if (distance(left, right) <= apart * disk.radius) {
    const double rate = curve_of(axis_, edge).derivatives(t).radius_first;
    angle = (rate > 0) == outer_first ? 0 : 2 * pi;
  }
  return area_beyond - disk.radius * disk.radius * angle / 2;
}

double Importance::at(std::uint32_t e, double s) const {
  using enum PruneMeasure;
  const Edge& edge = axis_.edges[e];
  const bool outer_first = trees_.outer_end(axis_, e) == 0;
  const double t = outer_first ? s : 1 - s;
  const Disk disk = curve_of(axis_, edge).at(t);
  const std::uint32_t part = trees_.part[edge.node[0]];
  const double size = size_[part], r = disk.radius;
  const auto chord = [&] {
    const auto [left, right] = feet(edge, t, disk);
    return distance(left, right);
  };
  switch (measure_) {
    case prominence:
      return share(beyond(e, s).reach - r, std::sqrt(r) * std::sqrt(size));
    case significance:
      return share(beyond(e, s).reach - r, r);
    case length:
      return share(beyond(e, s).way, r);
    case ratio:
      return share(beyond(e, s).boundary, chord());
    case radius:
      return share(r, size);
    case angle: {
      if (!(r > 0)) {  // the limit, in a corner
        const double rate = std::min(std::abs(jet_at(axis_, edge, t).radius_rate), 1.0);
        return 2 * degrees * std::acos(rate);
      }
      const auto [left, right] = feet(edge, t, disk);
      return degrees * std::abs(signed_angle(left - disk.center, right - disk.center));
    }
    case erosion:
      return share(beyond(e, s).reach - r, size);
    case potential:
      return share(beyond(e, s).boundary, 2 * pi * size);
    case residual:
      return share(beyond(e, s).boundary - chord(), 2 * size);
    case area:
      return share(lost_area(edge, outer_first, t, disk, beyond(e, s).area), size);
    case lambda:
      return share(chord(), 2 * size);
    case scale: {
      if (t == 0 || t == 1) return vanishing_[edge.node[t == 0 ? 0 : 1]].first;
      Disk other = vanishing_[edge.node[outer_first ? 1 : 0]].second;
      return disks_->vanishes_at(disk, part, other);
    }
  }
  return 0;
}

bool Importance::reaches(std::uint32_t e, double s, double threshold) const {
  if (measure_ != PruneMeasure::scale || s == 0 || s == 1) return at(e, s) >= threshold;
  const Edge& edge = axis_.edges[e];
  const bool outer_first = trees_.outer_end(axis_, e) == 0;
  return !disks_->vanishes_below(threshold, curve_of(axis_, edge).at(outer_first ? s : 1 - s),
                                 trees_.part[edge.node[0]],
                                 vanishing_[edge.node[outer_first ? 1 : 0]].second);
}

}  // namespace medial::ops
