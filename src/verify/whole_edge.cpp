#include "verify/whole_edge.h"

#include <cmath>
#include <limits>

#include "base/pair.h"

namespace medial::verify_detail {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

Vec2 start_tangent_of(const BoundaryEdge& edge, const Arc* arc) {
  return arc != nullptr ? arc->start_tangent() : (1 / norm(edge.chord())) * edge.chord();
}

/// Two disks side by side.
struct TwoDisks {
  Pair x, y, radius;

  TwoDisks(const Disk& a, const Disk& b)
      : x{a.center.x, b.center.x}, y{a.center.y, b.center.y}, radius{a.radius, b.radius} {}
};

}  // namespace

WholeEdge::WholeEdge(const DiskHull& control, double weight) : control_(control), weight_(weight) {
  const double a = control[0].radius, b = control[1].radius, c = control[2].radius;
  least_radius_ = std::min({a, b, c});
  largest_radius_ = std::max({a, b, c});
}

/// Of a quadratic form of the disk, by its polar form: `product` of two disks each.
template <class Product>
WholeEdge::Range WholeEdge::range_of(const Product& product) const {
  const TwoDisks first{control_[0], control_[1]}, second{control_[1], control_[2]};
  const TwoDisks ends{control_[0], control_[2]}, reversed{control_[1], control_[0]};
  const Pair inner = product(reversed, second), beside = product(first, second),
             outer = product(ends, ends);
  const double square = 2 * weight_ * weight_;
  const double middle = (square * inner[0] + inner[1]) / (square + 1);
  const Pair low = smaller(outer, beside), high = larger(outer, beside);
  const Pair sum = outer + beside;
  if (!std::isfinite(sum[0] + sum[1] + middle)) return {-unknown, unknown};
  return {std::min(std::min(low[0], low[1]), middle), std::max(std::max(high[0], high[1]), middle)};
}

/// H of an edge.
WholeEdge::Range WholeEdge::range_of(Vec2 start, Vec2 start_tangent, const Arc* arc) const {
  const Vec2 normal = left_of(start_tangent);
  if (arc == nullptr) {
    const auto over = [&](const Disk& disk) {
      return dot(normal, disk.center - start) - disk.radius;
    };
    const double a = over(control_[0]), b = over(control_[1]), c = over(control_[2]);
    return {2 * std::min(std::min(a, b), c), 2 * std::max(std::max(a, b), c)};
  }
  const double k = arc->curvature();
  return range_of([&](const TwoDisks& p, const TwoDisks& q) {
    const Pair px = p.x - start.x, py = p.y - start.y, qx = q.x - start.x, qy = q.y - start.y;
    const Pair power = px * qx + py * qy - p.radius * q.radius;
    return (normal.x * px + normal.y * py - p.radius) + (normal.x * qx + normal.y * qy - q.radius) -
           k * power;
  });
}

/// H of a point.
WholeEdge::Range WholeEdge::range_of(Vec2 point) const {
  return range_of([&](const TwoDisks& p, const TwoDisks& q) {
    return (p.x - point.x) * (q.x - point.x) + (p.y - point.y) * (q.y - point.y) -
           p.radius * q.radius;
  });
}

/// The least of |1 - k d| + 1 - k r where H is no larger than `size`; 0 where disks may lie round
/// the centre of the circle.
double WholeEdge::least_factor(const Arc* arc, double size) const {
  const double k = arc != nullptr ? arc->curvature() : 0;
  const double least = 1 - k * (k > 0 ? largest_radius_ : least_radius_);
  return least > 0 ? least + std::sqrt(std::max(0.0, least * least - std::abs(k) * size)) : 0;
}

/// What rounding leaves open of the H of an arc: next to the circle's centre, where the factor is
/// small, it is more than H.
double WholeEdge::rounding_of_form(Vec2 start, const Arc* arc) const {
  if (arc == nullptr) return 0;
  constexpr double rounding = 0x1p-49;  // of sixteen operations
  double squared = largest_radius_ * largest_radius_;
  for (const Disk& disk : control_) squared = std::max(squared, squared_norm(disk.center - start));
  const double most = std::sqrt(squared);
  return rounding * most * (1 + std::abs(arc->curvature()) * most);
}

/// On |d - r|, by that on H.
double WholeEdge::bound_at_point(double size) const {
  const double r = least_radius_;
  return r > 0 ? size / (r + std::sqrt(std::max(0.0, r * r - size))) : unknown;
}

/// How far centres lie ahead of a line, at most, or 0.
double WholeEdge::most_ahead(Vec2 point, Vec2 tangent) const {
  double most = 0;
  for (const Disk& disk : control_) most = std::max(most, dot(tangent, disk.center - point));
  return most;
}

double WholeEdge::contact_gap(const Site& site, const Arc* arc) const {
  if (site.start == site.end) return bound_at_point(range_of(site.start).size());
  if (arc == nullptr && site.bulge != 0) return unknown;
  const BoundaryEdge edge = edge_of(site);
  const Vec2 start_tangent = start_tangent_of(edge, arc);
  const double size =
      range_of(edge.start, start_tangent, arc).size() + rounding_of_form(edge.start, arc);
  const double factor = least_factor(arc, size);
  if (!(factor > 0)) return unknown;
  const Vec2 end_tangent = arc != nullptr ? arc->end_tangent() : start_tangent;
  const double beyond =
      std::max(most_ahead(site.start, -start_tangent), most_ahead(site.end, end_tangent));
  if (arc == nullptr) return size / factor + beyond;
  for (const Disk& disk : control_)
    if (!arc->is_in_front(disk.center)) return unknown;
  // From its end, the foot is off by the angle at the circle's centre times the radius.
  return (size + 4 * beyond) / factor;
}

double WholeEdge::intrusion(const BoundaryEdge& edge, const Arc* arc) const {
  const Range range = range_of(edge.start, start_tangent_of(edge, arc), arc);
  const double size = std::max(0.0, -range.low) + rounding_of_form(edge.start, arc);
  const double factor = least_factor(arc, size);
  return factor > 0 ? size / factor : unknown;
}

double WholeEdge::intrusion(Vec2 point) const {
  return bound_at_point(std::max(0.0, -range_of(point).low));
}

/// An edge leads away from a centre as long as its tangent does: all along an arc, of a half circle
/// at most, that does so at both ends. The foot of one that lies ahead is off the end by the angle
/// at the circle's centre times the radius.
double WholeEdge::nearer_than_end(const BoundaryEdge& edge, const Arc* arc, bool start) const {
  if (arc == nullptr) {
    const double ahead =
        start ? most_ahead(edge.start, edge.chord()) : most_ahead(edge.end, -edge.chord());
    return ahead > 0 ? ahead / norm(edge.chord()) : 0;
  }
  const Vec2 first = arc->start_tangent(), last = arc->end_tangent();
  if (start ? most_ahead(edge.end, last) > 0 : most_ahead(edge.start, -first) > 0) return unknown;
  const double ahead = start ? most_ahead(edge.start, first) : most_ahead(edge.end, -last);
  if (ahead == 0) return 0;
  double nearest = 1;  // to the circle's centre, in radii
  for (const Disk& disk : control_)
    nearest =
        std::min(nearest, 1 - arc->curvature() * (start ? cross(first, disk.center - edge.start)
                                                        : cross(last, disk.center - edge.end)));
  return nearest > 0 ? 2 / nearest * ahead : unknown;
}

}  // namespace medial::verify_detail
