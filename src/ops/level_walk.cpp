#include "ops/level_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "axis/node_kinds.h"
#include "base/arc.h"
#include "ops/routes.h"

namespace medial::ops {
namespace {

/// Whether a disk lies in the circle of an arc, to `slack`.
bool touches_all_of(const Site& site, const Disk& disk, double slack) {
  if (site.kind() != SiteKind::arc || !(site.bulge > 0)) return false;
  const BulgeArc arc{site.start, site.end, site.bulge};
  const double radius = 1 / curvature(arc);
  const Vec2 center = arc.start + radius * left_of(start_tangent(arc));
  return std::abs(radius - disk.radius) <= slack && distance(center, disk.center) <= slack;
}

/// The angle from u to v, of a walk that goes clockwise: what is not so is rounding.
double clockwise(Vec2 u, Vec2 v) {
  const double angle = signed_angle(u, v);
  return angle > 0.5 * std::numbers::pi ? angle - 2 * std::numbers::pi : angle;
}

std::size_t count_below(std::span<const double> levels, double radius) {
  return static_cast<std::size_t>(std::lower_bound(levels.begin(), levels.end(), radius) -
                                  levels.begin());
}

BulgeArc arc_of(const Site& site) { return {site.start, site.end, site.bulge}; }

/// Where the offsets of two edges meet beside a joint that turns to the left by no more than the
/// corner angle: the branch that would lead there is not in the axis. None where they do not meet.
///
/// At x from the joint both have the distance d. With the edges' normals n1 and n2, curvatures k1
/// and k2, and s = (x^2 - d^2) / 2, that is x.n1 = d + k1 s and x.n2 = d + k2 s; along the normals'
/// bisector and across it, that leaves a quadratic in s, of which this is the smaller root. Nothing
/// is divided by the angle, so that it may be as small as it likes.
std::optional<Vec2> beside_joint(const Site& before, const Site& after, double d) {
  if (before.kind() == SiteKind::vertex || after.kind() == SiteKind::vertex) return std::nullopt;
  const BulgeArc one = arc_of(before), other = arc_of(after);
  const Vec2 n1 = left_of(end_tangent(one)), n2 = left_of(start_tangent(other));
  const double cosine = norm(n1 + n2) / 2, sine = cross(n1, n2) / (2 * cosine);
  if (!(sine > 0)) return std::nullopt;
  const double k1 = curvature(one), k2 = curvature(other);
  const double square = cosine * cosine, mean = (k1 + k2) / 2, half = 1 - d * mean / square;
  const double root = ((1 - k1 * d) * (1 - k2 * d) - sine * sine) / square;
  if (!(root >= 0 && half > 0)) return std::nullopt;
  const double share = d * d * sine / (square * (half + std::sqrt(root)));  // s / sine
  const double along = (d + mean * share * sine) / cosine, across = (k1 - k2) / 2 * share;
  const Vec2 between = (0.5 / cosine) * (n1 + n2);
  return before.end + along * between - across * left_of(between);
}

}  // namespace

/// Puts a ring together, piece by piece.
class LevelWalk::RingBuilder {
 public:
  /// `largest`: of the coordinates, in size.
  RingBuilder(const MedialAxis& axis, double largest, double level, Ring& ring)
      : axis_(axis),
        rounding_(2 * std::numeric_limits<double>::epsilon() * (largest + std::abs(level))),
        level_(level),
        ring_(ring) {}

  /// Forgets all pieces.
  void restart() {
    ring_ = {};
    end_.reset();
  }
  /// Begins a piece at a point: the offset of a site.
  void begin(std::uint32_t site, Vec2 point) {
    site_ = site;
    first_ = last_ = point;
    turn_ = 0;
  }
  /// Goes on to a point on the offset of the same site. Only turns around a vertex are counted: a
  /// step is less than a half turn then.
  void pass(Vec2 towards) {
    const Site& site = axis_.sites[site_];
    if (site.kind() != SiteKind::vertex) return;
    turn_ += clockwise(last_ - site.start, towards - site.start);
    last_ = towards;
  }
  void end(Vec2 point) {
    if (site_ == no_site) return;  // no walk has started
    const Site& site = axis_.sites[site_];
    switch (site.kind()) {
      case SiteKind::segment:
        return add(point, 0);
      case SiteKind::vertex:
        pass(point);
        return add_turn(site.start, point, turn_);
      case SiteKind::arc:
        return add_offset(arc_of(site), point);
    }
  }
  /// A step between two points.
  void step(Vec2 point, Vec2 to) {
    first_ = point;
    add(to, 0);
  }
  /// The arc of a disk that touches the boundary all along, counter-clockwise; or a step of
  /// rounding.
  void close_gap(Vec2 center, Vec2 point, Vec2 to, bool around_an_end, double slack) {
    first_ = point;
    const double angle = signed_angle(point - center, to - center);
    if (distance(point, to) <= slack || (angle < 0 && !around_an_end)) return add(to, 0);
    add_turn(center, to, angle < 0 ? angle + 2 * std::numbers::pi : angle);
  }

 private:
  /// The offset of an arc spans the same angle as the feet of its ends. The angle is taken from
  /// where there is more room: a small arc has large offsets, a large one's centre is far away.
  void add_offset(const BulgeArc& arc, Vec2 point) {
    const double round = curvature(arc);
    if (round < 0 && -round * level_ > 1) {
      const Vec2 center = arc.start + (1 / round) * left_of(start_tangent(arc));
      return add(point, std::tan(clockwise(first_ - center, point - center) / 4));
    }
    const Site site{arc.start, arc.end, 0, 0, arc.bulge};
    const Vec2 a = foot(site, first_), b = foot(site, point);
    add(point, a == b ? 0 : partial_bulge(arc, a, b));
  }
  void add_turn(Vec2 center, Vec2 point, double angle) {
    if (std::abs(angle) <= std::numbers::pi) return add(point, std::tan(angle / 4));
    const Vec2 start = first_;
    first_ = center + turned(start - center, std::cos(angle / 2), std::sin(angle / 2));
    const Vec2 middle = first_;
    first_ = start;
    add(middle, std::tan(angle / 8));
    first_ = middle;
    add(point, std::tan(angle / 8));
  }
  /// Adds the piece that ends at `to`, unless it is no more than a step of rounding. The ring holds
  /// where pieces start.
  void add(Vec2 to, double bulge) {
    if (!end_) end_ = first_;
    if (!(distance(*end_, to) > rounding_)) return;
    ring_.points.push_back(*end_);
    ring_.bulges.push_back(bulge);
    end_ = to;
  }

  const MedialAxis& axis_;
  const double rounding_;
  const double level_;
  Ring& ring_;
  std::uint32_t site_ = no_site;
  Vec2 first_, last_;
  std::optional<Vec2> end_;  ///< of the last piece that the ring holds
  double turn_ = 0;
};

LevelWalk::LevelWalk(const MedialAxis& axis)
    : axis_(axis),
      halves_(axis, Around::sites),
      rise_(2 * axis.edges.size()),
      risen_(2 * axis.edges.size(), false) {
  for (const Site& site : axis.sites)
    for (const double x : {site.start.x, site.start.y, site.end.x, site.end.y})
      largest_ = std::max(largest_, std::abs(x));
  lowest_.reserve(axis.edges.size());
  for (std::uint32_t e = 0; e < axis.edges.size(); ++e)
    lowest_.push_back(narrowest_radius(axis, {e, 0, 1}) - axis.tolerance);
  const std::vector<std::uint32_t> degree = degrees_of(axis);
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node)
    if (degree[node] == 0) alone_.push_back(node);
  halves_.each_walk([&](std::span<const HalfEdge> walk) {
    Face face{walk[0], lowest_[walk[0] / 2]};
    for (const HalfEdge half : walk) {
      face.lowest = std::min(face.lowest, lowest_[half / 2]);
      if (halves_.right_site(half) != halves_.right_site(halves_.next(half))) face.last = half;
    }
    faces_.push_back(face);
  });
}

std::vector<LevelWalk::Crossing> LevelWalk::crossings_of(std::span<const double> levels) const {
  std::vector<Crossing> crossings;
  crossings.reserve(axis_.edges.size());
  for (std::uint32_t e = 0; e < axis_.edges.size(); ++e) {
    const auto& node = axis_.edges[e].node;
    const double largest = std::max(height(node[0]), height(node[1]));
    crossings.push_back({e, count_below(levels, lowest_[e]), count_below(levels, largest)});
  }
  return crossings;
}

std::uint64_t LevelWalk::points_at(std::span<const double> levels) const {
  // An edge above a level or across it separates the offsets of two sites.
  std::uint64_t points = 0;
  for (const Crossing& crossing : crossings_of(levels)) points += crossing.end;
  for (const std::uint32_t node : alone_) points += 2 * count_below(levels, height(node));
  return points;
}

void LevelWalk::go_down_to(std::size_t k) {
  std::erase_if(crossed_, [&](const Crossing& crossing) { return crossing.begin > k; });
  const auto old = static_cast<std::ptrdiff_t>(crossed_.size());
  for (; !waiting_.empty() && waiting_.back().end == k + 1; waiting_.pop_back())
    if (waiting_.back().begin <= k) crossed_.push_back(waiting_.back());
  std::reverse(crossed_.begin() + old, crossed_.end());
  std::inplace_merge(crossed_.begin(), crossed_.begin() + old, crossed_.end(),
                     [](const Crossing& a, const Crossing& b) { return a.edge < b.edge; });
}

/// Where an edge crosses the level: its radius less the level is a s^2 + 2 b s t + c t^2 over a
/// positive denominator, with s = 1 - t.
void LevelWalk::find_crossing(std::uint32_t index, double level) {
  const Edge& e = axis_.edges[index];
  const Curve curve = curve_of(axis_, e);
  // A node that counts as outside must not be above the level.
  const bool inside0 = height(e.node[0]) > level, inside2 = height(e.node[1]) > level;
  const double a = inside0 ? curve.r0 - level : std::min(curve.r0 - level, 0.0);
  double b = curve.weight * (curve.r1 - level);
  const double c = inside2 ? curve.r2 - level : std::min(curve.r2 - level, 0.0);
  // Between two nodes inside, what is up to a tolerance above the level counts as below it, without
  // a crossing. By the least change of b that touches the level, a place up to two tolerances
  // above.
  if (inside0 && inside2) b = std::min(b, -std::sqrt(a) * std::sqrt(c));
  const double root = std::sqrt(std::max(b * b - a * c, 0.0));
  const auto at = [&](double t, double s) { return curve.at(s / (s + t), t / (s + t)).center; };
  const std::size_t place = 2 * std::size_t{index};
  if (inside2) {
    rise_[place] = b <= 0 ? at(root - b, c) : at(-a, b + root);
    risen_[place] = true;
  }
  if (inside0) {
    rise_[place + 1] = b <= 0 ? at(a, root - b) : at(b + root, -c);
    risen_[place + 1] = true;
  }
}

std::vector<OffsetRing> LevelWalk::loops_at(double level) {
  std::vector<OffsetRing> loops;
  const auto keep = [&](OffsetRing loop) {
    const bool curved = std::any_of(loop.ring.bulges.begin(), loop.ring.bulges.end(),
                                    [](double bulge) { return bulge != 0; });
    if (!curved) loop.ring.bulges.clear();
    if (loop.ring.points.size() >= (curved ? 2U : 3U)) loops.push_back(std::move(loop));
  };
  for (const Crossing& crossing : crossed_) find_crossing(crossing.edge, level);
  for (const Crossing& crossing : crossed_)
    for (const HalfEdge half : {2 * crossing.edge, 2 * crossing.edge + 1})
      if (risen_[half]) keep(loop_from(half, level));
  for (const Face& face : faces_)
    if (face.lowest > level) keep(loop_around(face.last, level));
  for (const std::uint32_t node : alone_) {
    const Disk& disk = axis_.nodes[node].disk;
    if (!(height(node) > level)) continue;
    const Vec2 east{disk.radius - level, 0};
    keep({{{disk.center - east, disk.center + east}, RingRole::any, {1, 1}}, node, no_site});
  }
  return loops;
}

/// Continues from one site to another past joints without a branch: one that counts as smooth, or
/// those at both ends of arcs that a disk touches entirely, to the corner angle. False where the
/// disk's own feet are enough.
bool LevelWalk::pass_joints(std::uint32_t before, std::uint32_t after, const Disk& disk,
                            double level, RingBuilder& builder) const {
  const auto& sites = axis_.sites;
  const auto joined = [&](std::uint32_t a, std::uint32_t b) {
    return std::max(a, b) < sites.size() && sites[a].end == sites[b].start;
  };
  // A point at the level from a joint that the disk touches, no farther from the disk's centre than
  // the level is below its radius, is nowhere nearer to the boundary. Next to the deepest places
  // others are: however small the turn, the offsets' ends lie past those of other sites. There, the
  // disk's own radius leads to a point at the level.
  const auto kept = [&](Vec2 point, Vec2 joint) {
    const double slack = axis_.tolerance;
    const bool far = distance(point, disk.center) > disk.radius - level + slack;
    const bool touched = std::abs(distance(joint, disk.center) - disk.radius) <= slack;
    return far && touched ? joint + (level / disk.radius) * (disk.center - joint) : point;
  };
  if (joined(before, after)) {
    const auto met = beside_joint(sites[before], sites[after], level);
    if (!met) return false;
    const Vec2 point = kept(*met, sites[before].end);
    builder.end(point);
    builder.begin(after, point);
    return true;
  }
  const auto chain = sites_between(axis_, before, after, joined, [&](const Site& site) {
    return site.bulge > 0 && curvature(arc_of(site)) * level < 1;
  });
  if (chain.empty()) return false;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Site &a = sites[chain[i - 1]], &b = sites[chain[i]];
    const auto met = beside_joint(a, b, level);
    // Where they do not meet, the joint turns to the right, and has a piece of its own in between.
    const Vec2 leaves =
        b.kind() == SiteKind::vertex ? end_tangent(arc_of(a)) : start_tangent(arc_of(b));
    const Vec2 arrives = a.kind() == SiteKind::vertex ? leaves : end_tangent(arc_of(a));
    const Vec2 p = kept(met ? *met : a.end + level * left_of(arrives), a.end);
    const Vec2 q = met ? p : kept(a.end + level * left_of(leaves), a.end);
    builder.end(p);
    builder.step(p, q);
    builder.begin(chain[i], q);
  }
  return true;
}

/// The offset of a site where a disk touches it. A disk that touches a whole arc has no single
/// foot there: what comes before the arc continues at its start, what comes after it at its
/// end.
Vec2 LevelWalk::offset_at(std::uint32_t index, const Disk& disk, double level, Part part) const {
  const Site& site = axis_.sites[index];
  constexpr double roundings = 64;  // in tolerances; any other disk has one foot, if a rough one
  const Vec2 touch = touches_all_of(site, disk, roundings * axis_.tolerance)
                         ? (part == Part::start ? site.start : site.end)
                         : foot(site, disk.center);
  return touch + (level / disk.radius) * (disk.center - touch);
}

/// Goes on past the node where a half edge arrives, to what is on the right of the next one.
void LevelWalk::pass_node(HalfEdge half, double level, RingBuilder& builder) const {
  const HalfEdge next = halves_.next(half);
  const std::uint32_t before = halves_.right_site(half), after = halves_.right_site(next);
  const Disk& disk = halves_.disk(half, true);
  if (before == after) return builder.pass(disk.center);
  if (pass_joints(before, after, disk, level, builder)) return;
  const Vec2 p = offset_at(before, disk, level, Part::end);
  const Vec2 q = offset_at(after, disk, level, Part::start);
  builder.end(p);
  builder.close_gap(disk.center, p, q, twin(half) == next, slack_of(axis_, disk));
  builder.begin(after, q);
}

/// The loop that begins where a half edge rises above the level.
OffsetRing LevelWalk::loop_from(HalfEdge first, double level) {
  OffsetRing loop{{}, halves_.to(first), halves_.right_site(first)};
  RingBuilder builder(axis_, largest_, level, loop.ring);
  builder.begin(loop.site, rise_[first]);
  bool risen = true;  // the walk goes on from where the half edge rises, not from its start
  for (HalfEdge half = first;;) {
    if (risen || !falls(half, level)) {
      pass_node(half, level, builder);
      half = halves_.next(half);
      risen = false;
      continue;
    }
    half = twin(half);
    risen = true;
    risen_[half] = false;
    builder.end(rise_[half]);
    if (half == first) return loop;
    builder.begin(halves_.right_site(half), rise_[half]);
  }
}

/// The loop with a face on its right that is nowhere below the level.
OffsetRing LevelWalk::loop_around(HalfEdge last, double level) const {
  const HalfEdge first = halves_.next(last);
  OffsetRing loop{{}, halves_.to(first), halves_.right_site(first)};
  RingBuilder builder(axis_, largest_, level, loop.ring);
  const bool one_site = halves_.right_site(last) == loop.site;
  const Vec2 start = offset_at(loop.site, halves_.disk(last, true), level, Part::start);
  if (one_site) {
    builder.begin(loop.site, start);
  } else {  // where the first site's offset begins is known behind what comes before it
    pass_node(last, level, builder);
    builder.restart();
  }
  for (HalfEdge half = first;; half = halves_.next(half)) {
    pass_node(half, level, builder);
    if (half == last) break;
  }
  if (one_site) builder.end(start);
  return loop;
}

}  // namespace medial::ops
