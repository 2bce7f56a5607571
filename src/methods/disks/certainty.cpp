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

/// In tolerances: what a tie leaves open of where its disk is. Opposite flat corners all but tie.
constexpr double open_in_tie = 16;

}  // namespace

Certainty::Certainty(const Boundary& boundary, const Span& span, const Disk& from,
                     const Event& event)
    : boundary_(boundary),
      span_(span),
      from_(from),
      to_(event.disk),
      fourth_(event.touched(span)) {}

Certainty::Certainty(const Boundary& boundary, double tolerance, const Span& span, const Disk& from,
                     const Event& event)
    : Certainty(boundary, span, from, event) {
  if (event.kind == Event::Kind::at_node) {
    error_ = span.error;
    tie_ = true;
    certain_ = tolerance <= small_tolerance * to_.radius && is_near(span.right, tolerance) &&
               is_near(span.left, tolerance) &&
               (!boundary.has_arcs || (has_place(fourth_) && touches_own_arc(tolerance)));
    return;
  }
  const std::uint32_t fourth = fourth_;
  const bool joins_right = span.continues_right(boundary, fourth),
             joins_left = span.continues_left(boundary, fourth);
  error_ = joins_right  ? error_at_joint(boundary, span.right, fourth, span.left, to_)
           : joins_left ? error_at_joint(boundary, fourth, span.left, span.right, to_)
                        : error_of_three(fourth);
  if (!(joins_right || joins_left) && !(error_ <= tolerance))
    error_ = std::min(error_, error_at_corner(tolerance));
  const bool stays = squared_norm(to_.center - from_.center) <= tolerance * tolerance &&
                     std::abs(to_.radius - from_.radius) <= tolerance;
  if (stays) {
    tie_ = true;
    const bool joins = joins_right || joins_left;
    const bool joins_point =
        joins && site(fourth).is_vertex() && site(joins_right ? span.left : span.right).is_vertex();
    // On a polygon it is asked whether the tie is clean.
    const bool has_one =
        !boundary.has_arcs || (joins_point ? error_ < unknown : joins || has_place(fourth));
    certain_ = has_one && touches(fourth, tolerance);
    return;
  }
  if (boundary.has_arcs)
    for (const std::uint32_t i : {span.right, fourth, span.left})
      if (!fits(i, tolerance)) return;
  const bool known = error_ <= well_known * to_.radius || touches(fourth, tolerance);
  certain_ = known && (moves_forward() || comes_before(fourth));
}

Certainty::Contact Certainty::contact_of_arc(const site::Site& arc, const Disk& disk) {
  const double size = taxicab_norm(disk.center - arc.point), unsure = rounding * size;
  // The direction, the curvature and, between two pieces of an arc, the point have been rounded.
  const site::ArcView view = site::view_of_arc(arc, disk.center);
  // The height is off by 5/4 of unsure * all, which the root's derivative doubles, |toward| by 3/4,
  // curvature and direction by 1: of these 4.25 the bound is twice.
  const double bend = std::abs(arc.curvature), all = 1 + bend * size;
  return {(1 / view.size) * view.toward, view.distance - disk.radius,
          9 * unsure * all / (1 + view.size) + 0.5 * rounding, bend / view.size,
          4 * rounding * all / view.size};
}

bool Certainty::is_near(std::uint32_t i, double slack) const {
  return std::abs(site::gap(site(i), to_)) <= slack;
}

bool Certainty::touches_own_arc(double slack) const {
  constexpr double nearly = 0x1p-20;
  const site::Site& arc = site(fourth_);
  if (!(std::abs(arc.curvature * to_.radius - 1) <= nearly)) return true;
  return std::abs(distance(arc.at(0.5 * arc.length), to_.center) - to_.radius) <= slack;
}

bool Certainty::fits(std::uint32_t i, double tolerance) const {
  const double bend = site(i).curvature;
  return !(bend > 0) || bend * (to_.radius - error_ - tolerance) <= 1;
}

bool Certainty::touches(std::uint32_t third, double slack) const {
  for (const std::uint32_t i : {span_.right, third, span_.left})
    if (!(std::abs(contact(i).residual) <= slack && (site(i).is_vertex() || is_near(i, 2 * slack))))
      return false;
  return slack <= small_tolerance * to_.radius;
}

bool Certainty::has_place(std::uint32_t third) const {
  constexpr double own_circle = 0x1p-20;
  for (const std::uint32_t i : {span_.right, third, span_.left})
    if (contact(i).askew > own_circle) return true;
  return error_of_three(third) < unknown;
}

/// With C = 2 (|b - a| + |c - a|) / A, of the unit vectors from the feet and twice the area A of
/// their triangle, and residuals below f of distances whose curvature is below q: Newton's map with
/// the slopes at the disk takes the ball of radius 2 (C + 1) f around it into itself, and contracts
/// it if 4 q (C + 1)^2 f < 1 (Newton and Kantorovich).
double Certainty::error_of_three(const Boundary& boundary,
                                 const std::array<std::uint32_t, 3>& sites, const Disk& disk) {
  const Contact a = contact_of(boundary.sites[sites[0]], disk),
                b = contact_of(boundary.sites[sites[1]], disk),
                c = contact_of(boundary.sites[sites[2]], disk);
  const double residual =
      std::max({std::abs(a.residual) + a.unsure, std::abs(b.residual) + b.unsure,
                std::abs(c.residual) + c.unsure});
  const Vec2 ab = b.toward - a.toward, ac = c.toward - a.toward;
  const double area = cross(ab, ac);
  const double bend =
      std::max({1.0, a.bend * disk.radius, b.bend * disk.radius, c.bend * disk.radius});
  if (!(area > 4 * (a.askew + b.askew + c.askew))) return unknown;
  const double spread = 1 + 2 * (taxicab_norm(ab) + taxicab_norm(ac)) / area;
  const double within = 2.01 * spread * residual;
  return 2 * spread * within * bend < disk.radius ? within + rounding : unknown;
}

double Certainty::error_at_corner(double tolerance) const {
  const auto is_corner = [&](std::uint32_t before, std::uint32_t after) {
    const site::Site &first = site(before), &second = site(after);
    return before + 1 == after && !first.is_vertex() && !second.is_vertex() && !first.is_arc() &&
           !second.is_arc() && dot(first.direction, second.direction) > 0;
  };
  const auto error_of = [&](std::uint32_t before, std::uint32_t after, std::uint32_t third) {
    const site::Site &first = site(before), &second = site(after);
    const Vec2 between = first.normal() + second.normal(), d = to_.center - second.point;
    const double growth = 0.5 * norm(between);
    const Contact a = contact(before);
    return error_on({(0.5 / growth) * between, growth, d, a.residual,
                     std::max(a.unsure, rounding * taxicab_norm(d))},
                    contact(third), to_.radius);
  };
  const double error = is_corner(span_.right, fourth_)  ? error_of(span_.right, fourth_, span_.left)
                       : is_corner(fourth_, span_.left) ? error_of(fourth_, span_.left, span_.right)
                                                        : unknown;
  return error <= open_in_tie * tolerance ? error : unknown;
}

double Certainty::error_at_joint(const Boundary& boundary, std::uint32_t before,
                                 std::uint32_t after, std::uint32_t third, const Disk& disk) {
  const site::Site &first = boundary.sites[before], &second = boundary.sites[after];
  Line line;
  if (first.is_arc() || second.is_arc()) {
    const auto place = boundary.smooth_place(before, after);
    const Vec2 d = disk.center - place.point;
    line = {place.normal, 1, d, dot(place.normal, d) - disk.radius, 4 * rounding * taxicab_norm(d)};
  } else {
    const Contact a = contact_of(first.is_vertex() ? second : first, disk);
    line = {a.toward, 1, disk.center - second.point, a.residual, a.unsure};
  }
  return error_on(line, contact_of(boundary.sites[third], disk), disk.radius);
}

/// Along the line, the distance to what meets there grows by `growth`, and the third one by the dot
/// product of both directions: the third site closes in by the difference. (Newton and Kantorovich,
/// as above.)
double Certainty::error_on(const Line& line, const Contact& third, double radius) {
  const double closing = line.growth - dot(line.direction, third.toward);
  if (!(closing > 0)) return unknown;
  const double beside = std::abs(cross(line.direction, line.to_center));
  const double within = 2.01 *
                        (std::abs(third.residual) + third.unsure + std::abs(line.residual) +
                         line.unsure + 2 * (beside + line.unsure)) /
                        closing;
  const double bend = std::max(1.0, third.bend * radius);
  return 2 * within * bend < radius * closing ? within + rounding : unknown;
}

bool Certainty::moves_forward() const {
  constexpr double both = 2.01;
  const Vec2 way = to_.center - from_.center;
  // How far the foot moves, and by how much more than `error` that may be off.
  const auto moves = [&](const site::Site& s, double sense) {
    const double error = both * (error_ + span_.error);
    if (s.is_vertex()) {
      // Round a vertex, normals turn to the right.
      const double turn = cross(to_.center - s.point, from_.center - s.point);
      return sense * turn / (norm(to_.center - s.point) + error_ + span_.error) > error;
    }
    if (!s.is_arc()) return sense * dot(s.direction, way) > error;
    const Vec2 toward = s.normal() - s.curvature * (from_.center - s.point);
    const double unsure = 4 * rounding + std::abs(s.curvature) * both * (span_.error + rounding);
    return sense * cross(way, toward) > error * norm(toward) + unsure * norm(way);
  };
  return moves(site(span_.right), 1) || moves(site(span_.left), -1);
}

bool Certainty::ends(const Boundary& boundary, double tolerance, const Span& span,
                     const Disk& disk) {
  const auto gap = [&](std::uint32_t after) {
    return std::abs(distance(boundary.sites[after].point, disk.center) - disk.radius);
  };
  for (std::uint32_t i = span.right; i < span.left; ++i) {
    if (boundary.is_smooth(i)) {
      const std::uint32_t at = boundary.elements[i] == Element::vertex ? i : i + 1;
      if (!(gap(at) <= open_in_tie * tolerance + span.error)) return false;
      continue;
    }
    // At a corner so flat that any disk beside it touches its vertex, no foot can be seen to move.
    if (gap(i + 1) <= open_in_tie * tolerance) continue;
    const Event leaf{Event::Kind::contact, i + 1, Disk{boundary.sites[i + 1].point, 0}};
    Certainty end(boundary, span, disk, leaf);
    if (disk.radius > open_in_tie * tolerance && !end.moves_forward()) return false;
  }
  return true;
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
  double bend = std::max({a.bend, b.bend, c.bend, d.bend});
  const double squared_way = squared_norm(to_.center - from_.center);
  if (!(4 * squared_way * bend * bend < 1)) return false;
  for (const std::uint32_t i : {span_.right, fourth, span_.left, span_.third})
    if (site(i).is_vertex()) bend = std::max(bend, 1 / std::min(from_.radius, to_.radius));
  unsure += (of_a + of_b + of_c + of_d) * squared_way * bend;
  return level > 2 * unsure;
}

}  // namespace medial::disks
