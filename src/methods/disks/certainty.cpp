#include "methods/disks/certainty.h"

#include <cmath>
#include <limits>

namespace medial::disks {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// The tolerance decides what one disk touches only where it is so small against the disk.
constexpr double small_tolerance = 0x1p-16;

/// How far a disk may be off, against its radius, for the next step to begin at it.
constexpr double well_known = 0x1p-10;

double taxicab_norm(Vec2 v) { return std::abs(v.x) + std::abs(v.y); }

}  // namespace

Certainty::Certainty(const Boundary& boundary, double tolerance, const Span& span, const Disk& from,
                     const Event& event)
    : boundary_(boundary), span_(span), from_(from), to_(event.disk) {
  using Kind = Event::Kind;
  const bool ties = tolerance <= small_tolerance * to_.radius;
  const auto is_near = [&](std::uint32_t i) {
    const double away = std::sqrt(site::squared_distance(site(i), to_.center));
    return std::abs(away - to_.radius) <= tolerance;
  };
  if (event.kind == Kind::at_node) {
    error_ = span.error;
    certain_ = ties && is_near(span.right) && is_near(span.left);
    return;
  }
  const std::uint32_t fourth = event.kind == Kind::pass_right  ? span.right + 1
                               : event.kind == Kind::pass_left ? span.left - 1
                                                               : event.site;
  const bool joins_right = fourth == span.right + 1 && boundary.is_smooth(span.right),
             joins_left = fourth + 1 == span.left && boundary.is_smooth(fourth);
  error_ = joins_right || joins_left ? error_at_joint(joins_right) : error_of_three(fourth);
  const bool stays = squared_norm(to_.center - from_.center) <= tolerance * tolerance &&
                     std::abs(to_.radius - from_.radius) <= tolerance;
  if (stays) {
    certain_ = touches(fourth, tolerance);
    return;
  }
  certain_ = (error_ <= well_known * to_.radius || touches(fourth, tolerance)) &&
             (moves_forward() || comes_before(fourth) || (ties && is_one_tie(0.5 * tolerance)));
}

Certainty::Contact Certainty::contact(std::uint32_t i) const {
  const site::Site& s = site(i);
  const Vec2 d = to_.center - s.point;
  const double unsure = rounding * taxicab_norm(d);
  if (!s.is_vertex()) return {s.normal(), cross(s.direction, d) - to_.radius, unsure};
  const double away = norm(d);
  return {(1 / away) * d, away - to_.radius, unsure};
}

bool Certainty::touches(std::uint32_t third, double slack) const {
  for (const std::uint32_t i : {span_.right, third, span_.left})
    if (!(std::abs(contact(i).residual) <= slack)) return false;
  return slack <= small_tolerance * to_.radius;
}

bool Certainty::is_one_tie(double slack) const {
  if (span_.third >= boundary_.sites.size()) return false;
  const Contact other = contact(span_.third);
  return std::abs(other.residual) + other.unsure <= slack;
}

/// Newton and Kantorovich, as in exact/disk_bounds.h.
double Certainty::error_of_three(std::uint32_t third) const {
  const Contact a = contact(span_.right), b = contact(third), c = contact(span_.left);
  const double residual =
      std::max({std::abs(a.residual) + a.unsure, std::abs(b.residual) + b.unsure,
                std::abs(c.residual) + c.unsure});
  const Vec2 ab = b.toward - a.toward, ac = c.toward - a.toward;
  const double area = cross(ab, ac);
  if (!(area > 0)) return unknown;
  const double spread = 1 + 2 * (taxicab_norm(ab) + taxicab_norm(ac)) / area;
  const double within = 2.01 * spread * residual;
  // A vertex bends by 1 / (2 r).
  return 2 * spread * within < to_.radius ? within + rounding : unknown;
}

double Certainty::error_at_joint(bool on_right) const {
  const std::uint32_t own = on_right ? span_.right : span_.left;
  const std::uint32_t next = on_right ? own + 1 : own - 1;
  const std::uint32_t edge = site(own).is_vertex() ? next : own;
  const Contact a = contact(edge), b = contact(on_right ? span_.left : span_.right);
  const double closing = 1 - dot(a.toward, b.toward);
  if (!(closing > 0)) return unknown;
  // The centre lies on the normal at the joint.
  const Vec2 joint = site(own).is_vertex() ? site(own).point : site(next).point;
  const double beside = std::abs(dot(site(edge).direction, to_.center - joint)) + a.unsure;
  const double within =
      2.01 * (std::abs(b.residual) + b.unsure + std::abs(a.residual) + a.unsure + 2 * beside) /
      closing;
  return 2 * within < to_.radius * closing ? within + rounding : unknown;
}

bool Certainty::moves_forward() const {
  const double error = error_ + span_.error;
  const auto forward = [&](const site::Site& s) {
    if (!s.is_vertex()) return dot(s.direction, to_.center - from_.center);
    // Round a vertex, normals turn to the right.
    return cross(to_.center - s.point, from_.center - s.point) /
           (norm(to_.center - s.point) + error);
  };
  constexpr double both = 2.01;
  return forward(site(span_.right)) > both * error || -forward(site(span_.left)) > both * error;
}

bool Certainty::comes_before(std::uint32_t fourth) const {
  if (span_.third >= boundary_.sites.size() || !(from_.radius > 0)) return false;
  const Contact a = contact(span_.right), b = contact(fourth), c = contact(span_.left),
                d = contact(span_.third);
  const auto area = [](const Contact& p, const Contact& q, const Contact& r) {
    return cross(q.toward - p.toward, r.toward - p.toward);
  };
  const double of_a = area(b, c, d), of_b = area(a, c, d), of_c = area(a, b, d),
               of_d = area(a, b, c);
  if (!(of_a > 0 && of_b > 0 && of_c > 0 && of_d > 0)) return false;
  const double level =
      of_b * b.residual + of_d * d.residual - of_a * a.residual - of_c * c.residual;
  double unsure = of_a * a.unsure + of_b * b.unsure + of_c * c.unsure + of_d * d.unsure;
  const bool bends = site(span_.right).is_vertex() || site(span_.left).is_vertex() ||
                     site(fourth).is_vertex() || site(span_.third).is_vertex();
  if (bends)
    unsure += (of_a + of_b + of_c + of_d) * squared_norm(to_.center - from_.center) /
              std::min(from_.radius, to_.radius);
  return level > 2 * unsure;
}

}  // namespace medial::disks
