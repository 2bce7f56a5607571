#include "methods/disks/boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/arc.h"
#include "base/threads.h"
#include "base/twofold.h"
#include "methods/checks.h"

namespace medial::disks {
namespace {

using site::Joint;
using site::LoopEdges;
using site::Pieces;

/// Where a loop's run begins.
struct Start {
  std::uint32_t point = 0;
  std::optional<double> inside;  ///< parameter inside an arc of the edge that begins at the point,
  std::size_t piece = 0;         ///< and which of its pieces
};

/// A convex corner to start from: a flat one would leave the first disks undetermined, so the first
/// that turns by a sixth of a circle, or the one that turns most. The search starts in the middle
/// of the order: that shares the work well on shapes that were drawn from end to end. Where there
/// is no corner, the smooth or reflex place where the boundary is least convex, because its disk
/// cannot be the one of an arc that touches all of it; in the end any place.
Start start_of_outer(const LoopEdges& loop, const SiteNumbers& numbers, bool has_arcs) {
  constexpr double clear = 0.5;  // cosine of the turn
  std::optional<std::uint32_t> best;
  double best_cosine = 2;
  for (std::uint32_t step = 0; step < loop.size(); ++step) {
    const std::uint32_t i = (loop.size() / 2 + step) % loop.size();
    if (numbers.joints[loop.begin() + i] != Joint::corner) continue;
    Vec2 before, after;
    if (has_arcs) {
      before = -left_of(loop.edge(loop.before(i)).last().end_normal());
      after = loop.edge(i).first().direction;
    } else {
      before = loop.point(i) - loop.point(loop.before(i));
      after = loop.point(loop.next(i)) - loop.point(i);
    }
    const double cosine = dot(before, after) / (norm(before) * norm(after));
    if (cosine < best_cosine) {
      best_cosine = cosine;
      best = i;
    }
    if (cosine <= clear) break;
  }
  if (best) return {*best, {}, 0};

  double least = std::numeric_limits<double>::infinity();
  Start start;
  const auto curvature_of = [&](std::uint32_t i) {
    return curvature({loop.local(i), loop.local(loop.next(i)), loop.bulge(i)});
  };
  double before = curvature_of(loop.size() - 1);
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const double after = curvature_of(i);
    const double larger = std::max(before, after);
    before = after;
    if (numbers.joints[loop.begin() + i] == Joint::blunt) continue;
    if (larger < least) start.point = i;
    least = std::min(least, larger);
  }
  return start;
}

/// Whether a disk that reaches out in the direction `outreach` may touch the boundary where two
/// edges join. It may not at a reflex vertex that looks the other way, though up to rounding that
/// may lie as far out, on the far side of edges across that direction. At a smooth joint it may
/// only where both edges lead back from it: elsewhere a place inside one of them lies further out,
/// and is touched.
bool can_reach_out(const LoopEdges& loop, const SiteNumbers& numbers, std::uint32_t i) {
  if (loop.size() == 1) return true;
  const Vec2 before = loop.edge(loop.before(i)).last().end_normal();
  const Vec2 after = loop.edge(i).first().normal();
  if (numbers.joints[loop.begin() + i] != Joint::smooth) return dot(before + after, outreach) > -1;
  constexpr double rounding = 0x1p-50;
  return cross(before, outreach) <= rounding && cross(after, outreach) >= -rounding;
}

/// Whether a place lies further in the direction `outreach` than another one: decided with twice
/// the digits where double leaves it open, as it does along an edge of some roundings.
bool is_further_out(Vec2 place, Vec2 other) {
  constexpr double rounding = 0x1p-50;
  const Vec2 way = place - other;
  const double out = dot(outreach, way);
  if (std::abs(out) > rounding * (std::abs(way.x) + std::abs(way.y))) return out > 0;
  using Number = Bounded<Twofold>;
  const Number x = Number(place.x) - Number(other.x), y = Number(place.y) - Number(other.y);
  return (Number(outreach.x) * x + Number(outreach.y) * y).positive();
}

/// The furthest place in the direction `outreach`, of those where a disk can touch the loop.
Start start_of_hole(const LoopEdges& loop, const SiteNumbers& numbers, bool has_arcs) {
  Start start;
  std::optional<Vec2> furthest;
  const auto consider = [&](Vec2 place, const Start& candidate) {
    if (furthest && !is_further_out(place, *furthest)) return;
    if (!candidate.inside && !can_reach_out(loop, numbers, candidate.point)) return;
    start = candidate;
    furthest = place;
  };
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const Joint joint = numbers.joints[loop.begin() + i];
    if (joint == Joint::reflex || joint == Joint::smooth) consider(loop.local(i), {i, {}, 0});
    if (!has_arcs || loop.bulge(i) == 0) continue;
    const Pieces pieces = loop.edge(i);
    bool is_past = false;
    for (std::size_t piece = 0; piece < pieces.count; ++piece) {
      const site::Site& arc = pieces.site[piece];
      const double s =
          -2 * dot(arc.direction, outreach) / (arc.curvature * (1 + dot(arc.normal(), outreach)));
      // Rounding may leave a place between two pieces of an arc in neither.
      if ((s > 0 || is_past) && s < arc.length)
        consider(arc.at(std::max(s, 0.0)), {i, std::max(s, 0.0), piece});
      is_past = s >= arc.length;
    }
  }
  return start;
}

void add_loop(const LoopEdges& loop, const SiteNumbers& numbers, const Start& start,
              Boundary& boundary) {
  const auto add_vertex = [&](std::uint32_t i) {
    if (numbers.is_site(loop.begin() + i))
      boundary.add(site::make_vertex(loop.local(i)), Element::vertex,
                   numbers.edge[loop.begin() + i] - 1);
  };
  // The joint after the last piece of an edge is that at the edge's end.
  const auto add_edge = [&](std::uint32_t i, std::size_t from_piece, double from,
                            std::size_t to_piece, double to) {
    const std::uint32_t number = numbers.edge[loop.begin() + i];
    if (loop.bulge(i) == 0) {
      boundary.add(site::make_segment(loop.local(i), loop.local(loop.next(i))), Element::edge,
                   number, numbers.joints[loop.begin() + loop.next(i)]);
      return;
    }
    const Pieces pieces = loop.edge(i);
    for (std::size_t piece = from_piece; piece <= std::min(to_piece, pieces.count - 1); ++piece) {
      const site::Site& site = pieces.site[piece];
      const bool begins_here = piece == from_piece && from > 0;
      const bool ends_here = piece == to_piece && to < site.length;
      if (ends_here && to == 0) return;  // it begins and ends between two pieces
      const bool last = piece + 1 == pieces.count;
      const Joint joint =
          last && !ends_here ? numbers.joints[loop.begin() + loop.next(i)] : Joint::smooth;
      boundary.add(begins_here || ends_here
                       ? site::part_of(site, begins_here ? from : 0, ends_here ? to : site.length)
                       : site,
                   Element::edge, number, joint);
    }
  };
  if (loop.size() == 1) return add_vertex(start.point);
  constexpr std::size_t last_piece = 1;
  constexpr double to_end = std::numeric_limits<double>::infinity();
  if (start.inside)
    add_edge(start.point, start.piece, *start.inside, last_piece, to_end);
  else {
    add_vertex(start.point);
    add_edge(start.point, 0, 0, last_piece, to_end);
  }
  for (std::uint32_t i = loop.next(start.point); i != start.point; i = loop.next(i)) {
    add_vertex(i);
    add_edge(i, 0, 0, last_piece, to_end);
  }
  if (start.inside) {
    add_vertex(start.point);
    add_edge(start.point, 0, 0, start.piece, *start.inside);
  }
}

/// add_loop() of a shape without arcs: a loop's sites have the numbers in turn, so that each has
/// its place.
void add_polygon(const LoopEdges& loop, const SiteNumbers& numbers, const Start& start,
                 Boundary& boundary) {
  const std::size_t end = boundary.sites.size();
  const std::uint32_t last = loop.size() - 1;
  const std::uint32_t count =
      numbers.edge[loop.begin() + last] + (last > 0 ? 1 : 0) - numbers.first(loop.begin());
  const std::uint32_t start_number = numbers.first(loop.begin() + start.point);
  const auto place_of = [&](std::uint32_t number) {
    return end + (number >= start_number ? number - start_number : number + count - start_number);
  };
  boundary.resize(end + count);
  constexpr std::size_t grain = 4096;
  parallel_ranges(loop.size(), grain, [&](std::size_t begin, std::size_t stop) {
    for (auto i = static_cast<std::uint32_t>(begin); i < stop; ++i) {
      const std::uint32_t number = numbers.edge[loop.begin() + i];
      if (numbers.is_site(loop.begin() + i))
        boundary.set(place_of(number - 1), site::make_vertex(loop.local(i)), Element::vertex,
                     number - 1);
      if (last > 0)
        boundary.set(place_of(number), site::make_segment(loop.local(i), loop.local(loop.next(i))),
                     Element::edge, number);
    }
  });
}

}  // namespace

void Originals::compress() {
  if (stored_.empty()) return;
  const std::size_t first = stored_[0], count = stored_.size();
  for (std::size_t i = 0; i < count; ++i)
    if (stored_[i] != (i + first < count ? i + first : i + first - count)) return;
  first_ = first;
  count_ = count;
  free_memory(stored_);
}

double clockwise_turn(Vec2 from, Vec2 to) {
  constexpr double none = 1e-9;  // a little to the left is rounding
  const double angle = std::atan2(-cross(from, to), dot(from, to));
  return angle >= -none ? std::max(angle, 0.0) : angle + 2 * std::numbers::pi;
}

bool faces_edge(const site::Site& edge, Vec2 c) {
  constexpr double beyond =
      0x1p-40;  // of the distance: what rounding may turn the foot's normal by
  const double away = site::carrier_distance(edge, c);
  if (!(away > 0)) return false;
  const double s = site::carrier_parameter(edge, c), slack = beyond * away;
  return s >= -slack && s <= edge.length + slack;
}

bool in_wedge(Vec2 first, Vec2 last, Vec2 to) {
  constexpr double beyond = 1e-9;
  // Sides of directions tell, without an angle, where no two are near to one line.
  constexpr double clear = 1e-8;
  const double whole = cross(first, last), begun = cross(first, to), left = cross(to, last);
  const double sizes[] = {squared_norm(first), squared_norm(last), squared_norm(to)};
  constexpr double squared = clear * clear;
  if (whole * whole > squared * sizes[0] * sizes[1] &&
      begun * begun > squared * sizes[0] * sizes[2] && left * left > squared * sizes[1] * sizes[2])
    return whole < 0 ? begun < 0 && left < 0 : begun < 0 || left < 0;
  const double angle = clockwise_turn(first, to), wedge = clockwise_turn(first, last);
  return angle <= wedge + beyond || angle >= 2 * std::numbers::pi - beyond;
}

Boundary loops_boundary(const Problem& problem, const SiteNumbers& numbers, Sides sides) {
  const Shape& shape = problem.shape;
  Boundary boundary;
  boundary.has_arcs = has_arcs(shape);
  boundary.sides = sides;
  const auto halved = std::count_if(shape.bulges.begin(), shape.bulges.end(), [](double bulge) {
    return std::abs(bulge) > site::largest_bulge;
  });
  const std::size_t divided = boundary.has_arcs ? shape.loop_count() : 0;  // where a loop begins
  boundary.reserve(numbers.count + static_cast<std::size_t>(halved) + divided);
  if (!boundary.has_arcs) touch_in_parallel(boundary.sites, 0, numbers.count);
  for (std::size_t l = 0; l < shape.loop_count(); ++l) {
    const LoopEdges loop(shape, l, problem.frame);
    const Start start = shape.hole[l] ? start_of_hole(loop, numbers, boundary.has_arcs)
                                      : start_of_outer(loop, numbers, boundary.has_arcs);
    const auto first = static_cast<std::uint32_t>(boundary.sites.size());
    if (boundary.has_arcs)
      add_loop(loop, numbers, start, boundary);
    else
      add_polygon(loop, numbers, start, boundary);
    const Joint joint = numbers.joints[loop.begin() + start.point];
    const bool at_corner = !shape.hole[l] && (joint == Joint::corner || joint == Joint::blunt);
    boundary.runs.push_back(
        {first, static_cast<std::uint32_t>(boundary.sites.size() - 1), at_corner});
  }
  if (shape.loop_count() == 1) boundary.originals.compress();
  return boundary;
}

}  // namespace medial::disks
