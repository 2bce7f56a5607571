#include "methods/disks/contacts.h"

#include <array>
#include <cmath>
#include <numbers>

#include "base/compat.h"
#include "methods/disks/tie_fit.h"

namespace medial::disks {
namespace {

/// The angle from one direction to another, clockwise.
double turn(Vec2 from, Vec2 to) { return std::atan2(-cross(from, to), dot(from, to)); }

}  // namespace

bool Contacts::faces_side(std::uint32_t i, Vec2 c) const {
  if (element(i) == Element::edge) return faces_edge(site(i), c);
  const auto bound = [&](std::uint32_t beside) {
    if (element(beside) == Element::bridge) return bridge_direction(i, beside);
    return beside < i ? site(beside).end_normal() : site(beside).normal();
  };
  const bool all_around = element(i - 1) == Element::bridge && element(i + 1) == Element::bridge &&
                          boundary_.originals[i - 1] == boundary_.originals[i + 1];
  return all_around || in_wedge(bound(i - 1), bound(i + 1), c - site(i).point);
}

std::uint32_t Contacts::owner_on_sides(std::uint32_t i, Vec2 center, const Span& span) const {
  if (faces_side(i, center)) return i;
  const double reach = std::sqrt(site::squared_distance(site(i), center));
  std::vector<std::uint32_t> together;
  context.tree.within(center, reach + 2 * context.tolerance, span.right + 1, span.left - 1,
                      together);
  for (const std::uint32_t other : together)
    if (in_one_place(other, i, center, reach) && faces_side(other, center)) return other;
  return i;
}

std::uint32_t Contacts::owner(std::uint32_t i, Vec2 center, const Span& span) const {
  if (has_both_sides()) return owner_on_sides(i, center, span);
  if (element(i) == Element::edge) {
    // At an end that is a vertex site or a smooth joint, what goes on from there is touched, but
    // for an arc whose own circle is smaller: all of that but its end is still ahead.
    const double s = site::foot_parameter(site(i), center);
    const auto takes = [&](std::uint32_t next) {
      if (next <= span.right || next >= span.left || !boundary_.is_smooth(std::min(i, next)))
        return false;
      const double bend = site(next).curvature;
      return !(bend > 0 && bend * bend * site::squared_distance(site(i), center) > 1);
    };
    if (s <= 0 && takes(i - 1))
      --i;
    else if (s >= site(i).length && takes(i + 1))
      ++i;
  }
  if (element(i) != Element::vertex || boundary_.bridges.empty()) return i;
  // Normals turn to the right along a vertex. A vertex with several bridges takes several steps.
  std::uint32_t copy = i;
  for (std::size_t step = 0; step <= boundary_.bridges.size(); ++step) {
    const Vec2 to = center - site(copy).point;
    std::uint32_t next = copy;
    // An outer loop without a convex corner may begin with a vertex, which no bridge stands before.
    if (copy > 0 && element(copy - 1) == Element::bridge &&
        cross(bridge_direction(copy, copy - 1), to) > 0)
      next = boundary_.across(copy - 1, copy);
    else if (copy + 1 < boundary_.sites.size() && element(copy + 1) == Element::bridge &&
             cross(to, bridge_direction(copy, copy + 1)) > 0)
      next = boundary_.across(copy + 1, copy);
    if (next == copy) break;
    copy = next;
  }
  return copy > span.right && copy < span.left ? copy : i;
}

bool Contacts::touches_inside(std::uint32_t i, const Disk& disk) const {
  if (touches_all(i, disk)) return true;
  const double s = site::foot_parameter(site(i), disk.center);
  // A disk whose centre is behind an arc touches no more of it than an end.
  if (s > 0 && s < site(i).length)
    return !site(i).is_arc() || site::carrier_distance(site(i), disk.center) > 0;
  // At a smooth joint both touch, but for an arc whose own circle is smaller: see owner().
  const std::uint32_t end = s > 0 ? i : i - 1;
  return boundary_.has_arcs && element(end) == element(end + 1) && boundary_.is_smooth(end) &&
         !(site(i).curvature * disk.radius > 1);
}

bool Contacts::touches_all(std::uint32_t i, const Disk& disk) const {
  const site::Site& arc = site(i);
  // On a much flatter arc the disk would have to be tiny.
  if (!(arc.curvature * disk.radius > 0.5)) return false;
  const auto on_disk = [&](Vec2 p) {
    return std::abs(distance(p, disk.center) - disk.radius) <= 2 * context.tolerance;
  };
  const double half = 0.5 * arc.length;
  const Vec2 middle = arc.at(half), to = disk.center - middle;
  // An arc shorter than the tolerance may lie on the disk in any direction, also outside of it.
  constexpr double beside = 0x1p-10;
  const Vec2 normal = arc.normal_at(half);
  return on_disk(arc.point) && on_disk(arc.end()) && on_disk(middle) && dot(normal, to) > 0 &&
         std::abs(cross(normal, to)) <= beside * disk.radius;
}

bool Contacts::is_short_reflex_chain(const Span& span) const {
  if (site(span.right).curvature > 0) return false;
  for (std::uint32_t i = span.right; i < span.left; ++i)
    if (!boundary_.is_smooth(i) || site(i + 1).curvature > 0) return false;
  constexpr double almost_half = 3;  // of a turn: pi, less room for rounding
  double turned = 0;
  Vec2 before = site(span.right).end_normal();
  for (std::uint32_t i = span.right; i < span.left; ++i) {
    const site::Site& next = site(i + 1);
    if (next.is_vertex()) continue;
    if (!site(span.right).is_vertex() || i > span.right) turned += turn(before, next.normal());
    before = next.end_normal();
    if (i + 1 < span.left) turned += turn(next.normal(), before);
  }
  return turned < almost_half;
}

bool Contacts::are_distinct(std::uint32_t first, std::uint32_t second, double angle,
                            const Disk& disk) const {
  if (angle >= distinct_contacts) return true;
  if (!(angle > 0) || site(first).is_arc() || site(second).is_arc()) return false;
  const double apart = distinct_feet * context.tolerance;
  return squared_norm(site::foot(site(second), disk.center) -
                      site::foot(site(first), disk.center)) > apart * apart;
}

const std::vector<std::uint32_t>& Contacts::touched_between(const Span& span, const Disk& disk,
                                                            bool all_around) {
  const Boundary::SiteRange& run = run_of(span);
  const bool narrow = has_narrow_wedges();
  if (narrow && is_around(run, disk)) {
    // What is beside the disk is left out below, too, where its owner is asked: that lies in the
    // same point, and so is near the disk itself.
    touched_.clear();
    for (const Neighbor& near : near_)
      if (near.site > span.right && near.site < span.left && near.away < touching_)
        touched_.push_back(near.site);
  } else {
    ++statistics.queries;
    context.tree.within(disk.center, disk.radius + touching_, span.right + 1, span.left - 1,
                        touched_);
  }
  if (touched_.empty()) return touched_;
  // Along the boundary the contacts go around the disk counter-clockwise. What comes out of order
  // is another copy of a vertex that was touched before.
  // An arc touched all along counts from the first of its points to the last.
  const auto foot_on = [&](std::uint32_t i, double share) {
    return touches_all(i, disk) ? site(i).at(share * site(i).length)
                                : site::foot(site(i), disk.center);
  };
  const Vec2 start = foot_on(span.right, 0) - disk.center;
  const auto angle_of = [&](std::uint32_t i, double share) {
    const Vec2 to = foot_on(i, share) - disk.center;
    const double angle = std::atan2(cross(start, to), dot(start, to));
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
  };
  const double end_angle = all_around ? 2 * std::numbers::pi : angle_of(span.left, 1);
  double angle_before = 0;
  std::uint32_t before = span.right;
  std::size_t kept = 0;
  for (const std::uint32_t hit : touched_) {
    if (!faces(hit, disk.center)) continue;
    const std::uint32_t i = owner(hit, disk.center, span);
    if (i <= before || i >= span.left || !touches(i, disk, touching_) ||
        (narrow && is_beside(i, disk.center, run)))
      continue;
    const double angle = angle_of(i, 0.5);
    if (!are_distinct(before, i, angle - angle_before, disk) ||
        !are_distinct(i, span.left, end_angle - angle, disk))
      continue;
    touched_[kept++] = before = i;
    angle_before = angle;
  }
  touched_.resize(kept);
  return touched_;
}

double Contacts::beyond_bridge(std::uint32_t i, bool at_end, Vec2 center) const {
  const Vec2 to = center - site(i).point, bound = bridge_direction(i, at_end ? i + 1 : i - 1);
  return (at_end ? cross(to, bound) : cross(bound, to)) / norm(bound);
}

const std::vector<Contacts::Neighbor>& Contacts::around(const Span& span, const Disk& disk) {
  const Boundary::SiteRange& run = run_of(span);
  if (is_around(run, disk)) return near_;
  ++statistics.queries;
  around_run_ = &run;
  around_ = disk;
  around_reach_ = std::min(further_ * clearance(), std::max(clearance(), short_way * disk.radius));
  context.tree.within(disk.center, disk.radius + around_reach_, run.first, run.last, within_);
  near_.clear();
  for (const std::uint32_t i : within_) {
    const auto beyond = beyond_each(i, disk.center);
    if (is_beside(i, disk.center, run, clearance(), beyond)) continue;
    const double distance = std::sqrt(site::squared_distance(site(i), disk.center));
    if (!(distance < disk.radius + clearance()) || !faces(i, disk.center)) continue;
    near_.push_back({i, distance - disk.radius, std::max(beyond[0], beyond[1]),
                     site::foot(site(i), disk.center), site::outward(site(i), disk.center)});
  }
  constexpr std::size_t many = 32;
  if (within_.size() > many + 2 * near_.size()) further_ = std::max(1.0, further_ / 2);
  return near_;
}

double Contacts::spread_of(const std::vector<Neighbor>& sites, const Span& span,
                           Vec2 center) const {
  // Feet that only pass on are where they pass.
  const std::array<Vec2, 2> own{site::foot(site(span.right), center),
                                site::foot(site(span.left), center)};
  const double here = 4 * context.tolerance;
  if (ranges::all_of(sites, [&](const Neighbor& near) {
        return std::min(squared_norm(near.foot - own[0]), squared_norm(near.foot - own[1])) <=
               here * here;
      }))
    return 1;
  const Vec2 first = sites[0].toward;
  Vec2 ab, ac;
  double furthest = 0, widest = 0;
  for (const Neighbor& near : sites) {
    const Vec2 to = near.toward - first;
    if (const double away = squared_norm(to); away > furthest) {
      furthest = away;
      ab = to;
    }
  }
  for (const Neighbor& near : sites) {
    const Vec2 to = near.toward - first;
    if (const double wide = std::abs(cross(ab, to)); wide > widest) {
      widest = wide;
      ac = to;
    }
  }
  return 1 + 2 * (norm(ab) + norm(ac)) / widest;
}

bool Contacts::may_touch(std::uint32_t i, const Span& span, const Disk& disk, double times) const {
  return away(i, disk) <= times * touching_ && !is_beside(i, disk.center, run_of(span)) &&
         faces(i, disk.center);
}

bool Contacts::may_touch_more(const Span& span, const Disk& disk, std::uint32_t next,
                              double times) {
  ++statistics.queries;
  context.tree.within(disk.center, disk.radius + 2 * times * touching_, span.right + 1,
                      span.left - 1, touched_);
  return ranges::any_of(
      touched_, [&](std::uint32_t i) { return i != next && may_touch(i, span, disk, times); });
}

bool Contacts::passes_at(const Span& span, const Disk& disk, std::uint32_t next) const {
  constexpr double well_known = 32;  // tolerances
  const bool of_right = span.continues_right(boundary_, next);
  if (!of_right && !span.continues_left(boundary_, next)) return false;
  const std::uint32_t own = of_right ? span.right : span.left;
  return span.error <= well_known * context.tolerance &&
         std::abs(beyond_end(own, of_right, disk.center)) <= context.tolerance &&
         touches_carrier(next, disk, context.tolerance) &&
         touches_carrier(own, disk, context.tolerance);
}

bool Contacts::is_clean_tie(const Span& span, const Disk& disk, std::uint32_t sure) {
  constexpr double well_placed = 16, furthest = 0x1p-12;
  for (const std::uint32_t i : {span.right, span.left, sure})
    if (std::abs(away(i, disk)) > touching_) return false;
  const std::vector<Neighbor>& sites = around(span, disk);
  const auto has = [&](std::uint32_t i) {
    return ranges::binary_search(sites, i, {}, &Neighbor::site);
  };
  if (!has(span.right) || !has(span.left) || !has(sure)) return false;
  const double spread = spread_of(sites, span, disk.center);
  // Where the tie may be, and not only its disk, decides whether a foot has come to a joint.
  if (!(touching_ * spread <= furthest * disk.radius)) return false;
  std::uint32_t before = sites.back().site;
  Vec2 foot_before = sites.back().foot;
  // Moving one of two points by touching_ makes the tie exact, so both may be touched in it; their
  // bisector then passes the centre by touching_ over their angle. (Diagrams tell points apart that
  // are nearer.)
  constexpr double beside = 0x1p-16;  // of the radius
  const auto are_points_apart = [&](std::uint32_t i, double squared) {
    const double apart = touching_ / beside;
    return site(before).is_vertex() && site(i).is_vertex() && squared > apart * apart;
  };
  for (const auto& [i, away, beyond, foot, toward] : sites) {
    const bool at_joint = beyond > -clearance() * spread;
    if (std::abs(away) > touching_ || beyond > context.tolerance ||
        (at_joint && (spread > well_placed || beyond < -context.tolerance)))
      return false;
    // A disk that touches one place all but touches what is beside it.
    const double squared = squared_norm(foot - foot_before);
    if ((before + 1 != i || !boundary_.is_smooth(before)) && !are_points_apart(i, squared) &&
        squared <= 2 * disk.radius * clearance())
      return false;
    before = i;
    foot_before = foot;
  }
  return is_alone(sites, span, disk);
}

// A disk that moves comes nearer, in the direction of a contact's normal, by a sum of a constant, a
// cosine and a sine, which three contacts determine (Lagrange). If it reaches a site between two
// contacts of the tie and over neither of these, the sum falls towards that site from both sides,
// so that the three contacts that it touches are next to it.
bool Contacts::is_alone(const std::vector<Neighbor>& tie, const Span& span, const Disk& disk) {
  std::vector<std::uint32_t>& sites = tie_;  // without those to which a foot only passes on
  std::vector<Vec2>& toward = toward_;
  sites.clear();
  toward.clear();
  for (const Neighbor& near : tie) {
    const std::uint32_t i = near.site;
    if (!sites.empty() && sites.back() + 1 == i && boundary_.is_smooth(sites.back())) continue;
    sites.push_back(i);
    toward.push_back(near.toward);
  }
  const std::size_t count = sites.size();
  if (count < 3) return true;
  double least = 4;  // of two neighbours' distances, the squared product
  for (std::size_t i = 0; i < count; ++i)
    least = std::min(least, squared_norm(toward[(i + 1) % count] - toward[i]) *
                                squared_norm(toward[(i + 2) % count] - toward[(i + 1) % count]));
  const double furthest = std::min(12 * touching_ / std::sqrt(least), short_way * disk.radius);
  if (furthest <= clearance()) return true;
  const Boundary::SiteRange& run = run_of(span);
  const bool known = furthest <= around_reach_;
  if (!known) {
    ++statistics.queries;
    context.tree.within(disk.center, disk.radius + furthest, run.first, run.last, touched_);
  }
  // By how many times the residuals of three contacts, from each of them on, a disk may be off in
  // another direction: that is so far from each of these.
  const auto apart = [&](std::size_t i, std::size_t j) {
    return distance(toward[i % count], toward[j % count]);
  };
  shares_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const double a = apart(i, i + 1), b = apart(i + 1, i + 2), c = apart(i, i + 2);
    shares_.push_back({1 / (a * c), 1 / (a * b), 1 / (b * c)});
  }
  return ranges::all_of(known ? within_ : touched_, [&](std::uint32_t i) {
    const double gap = away(i, disk);
    if (!(gap < furthest) || ranges::binary_search(tie, i, {}, &Neighbor::site) ||
        is_beside(i, disk.center, run, furthest) || !faces(i, disk.center))
      return true;
    const Vec2 to = site::outward(site(i), disk.center);
    const auto next = static_cast<std::size_t>(ranges::lower_bound(sites, i) - sites.begin());
    const std::size_t begin = next + count - 3;
    std::array<double, 6> away_from;
    for (std::size_t k = 0; k < away_from.size(); ++k)
      away_from[k] = distance(to, toward[(begin + k) % count]);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [first, second, third] = shares_[(begin + k) % count];
      const double factor = first * away_from[k + 1] * away_from[k + 2] +
                            second * away_from[k] * away_from[k + 2] +
                            third * away_from[k] * away_from[k + 1];
      if (gap <= 2 * touching_ * factor) return false;
    }
    return true;
  });
}

std::optional<Disk> Contacts::clean_tie(const Span& span, const Disk& near, std::uint32_t sure) {
  const TieSites sites{boundary_.sites};
  Disk disk = near;
  // What touches a disk places it better, so that it touches more.
  for (std::size_t before = 3;;) {
    std::vector<Touch> contacts;
    for (const Neighbor& one : around(span, disk)) contacts.push_back({one.site});
    if (contacts.size() <= before) return std::nullopt;
    before = 2 * contacts.size();
    TieFit fit(sites, disk);
    if (!fit.fits(contacts, context.tolerance)) return std::nullopt;
    disk = fit.disk;
    if (is_clean_tie(span, disk, sure)) return disk;
  }
}

void Contacts::split(const Span& span, const Disk& disk, std::uint32_t sure, bool all_around,
                     std::vector<Span>& parts) {
  parts.clear();
  std::uint32_t before = span.right;
  const std::vector<std::uint32_t>& touched = touched_between(span, disk, all_around);
  parts.reserve(touched.size() + 1);
  for (const std::uint32_t i : touched) {
    parts.push_back({before, i, span.node});
    before = i;
  }
  if (parts.empty()) {
    if (sure > span.right && sure < span.left) {
      parts.push_back({span.right, sure, span.node});
      before = sure;
    } else if (!all_around) {
      return;
    }
  }
  parts.push_back({before, span.left, span.node});
}

}  // namespace medial::disks
