#include "methods/potential/saddles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "methods/potential/axis_ways.h"

namespace medial::potential {
namespace {

/// The force along a small circle around a minimum.
class Circle {
 public:
  Circle(ForceLines& lines, const ValleyPoint& minimum)
      : lines_(lines), center_(minimum.place), radius_(lines.reach(minimum.radius)) {}

  static Vec2 towards(double turns) {
    const double angle = 2 * std::numbers::pi * turns;
    return {std::cos(angle), std::sin(angle)};
  }
  Vec2 at(Vec2 direction) const { return center_ + radius_ * direction; }

  /// The directions, in turns and ascending, in which valleys leave the minimum: there, the force
  /// along the circle changes from forward to backward.
  std::vector<double> valleys() {
    constexpr int first_looks = 16;
    for (int i = 0; i <= first_looks; ++i) {
      const double turns = static_cast<double>(i) / first_looks;
      Look next = i < first_looks ? look(turns) : looks_.front();
      next.turns = turns;
      if (i > 0) look_between(looks_.back(), next, 2);
      looks_.push_back(next);
    }
    std::vector<double> found;
    const auto is_lost = [](const Look& one) { return one.aside == 0; };
    looks_.pop_back();
    const auto first = std::find_if_not(looks_.begin(), looks_.end(), is_lost);
    if (first == looks_.end()) return {};
    for (auto passed = looks_.begin(); passed != first; ++passed) passed->turns += 1;
    std::rotate(looks_.begin(), first, looks_.end());
    looks_.push_back(looks_.front());
    looks_.back().turns += 1;
    const Look* before = &looks_.front();
    for (const Look& here : looks_) {
      if (is_lost(here)) continue;
      // On a floor without slope, the force has no direction: the zero is its middle.
      if (before->aside > 0 && here.aside < 0) found.push_back(between(*before, here));
      before = &here;
    }
    return found;
  }

 private:
  struct Look {
    double turns = 0;
    double aside = 0;  ///< the sine from the direction outward to the force; 0: lost
    double slope = 0;  ///< of that, by turns
  };

  Look look(double turns) {
    const Vec2 out = towards(turns), along = left_of(out);
    double distance = 0;
    const Force force = lines_.force_at(at(out), distance);
    const double size = norm(force.force);
    if (!(distance > 0) || !(size > 0) || lines_.lost(force)) return {turns};
    const Vec2 direction = (1 / size) * force.force;
    const Vec2 change = (radius_ / (distance * size)) * force.derivative(along);
    const double turning = cross(direction, change) - 1;
    return {turns, cross(out, direction), 2 * std::numbers::pi * turning * dot(out, direction)};
  }

  /// Looks between two looks if they do not determine how often the sine changes its sign.
  void look_between(Look a, Look b, int depth) {
    const bool is_lost = (a.aside == 0) != (b.aside == 0);
    if (depth == 0 || !(is_lost || may_change_more(a, b))) return;
    const Look middle = look(0.5 * (a.turns + b.turns));
    look_between(a, middle, depth - 1);
    looks_.push_back(middle);
    look_between(middle, b, depth - 1);
  }

  /// Whether the sine may change its sign more often than the signs at both ends show. Not if it
  /// rises, or falls, at both ends, nor if the tangents there meet before they reach zero.
  static bool may_change_more(const Look& a, const Look& b) {
    if (a.aside == 0) return false;
    const double way = a.aside > 0 ? 1 : -1;
    const double begins = way * a.aside, ends = way * b.aside;
    const double falls = -way * a.slope, rises = way * b.slope, width = b.turns - a.turns;
    if (ends < 0) return !(falls > 0 && rises < 0);
    if (!(falls > 0 && rises > 0)) return false;
    const double meeting = (ends - begins - rises * width) / -(falls + rises);
    return begins - falls * std::clamp(meeting, 0.0, width) <= 0;
  }

  /// A zero of the sine between two looks, by false position.
  double between(Look a, Look b) {
    constexpr int most_looks = 4;
    constexpr double widest = 1.0 / 16, accuracy = 1e-3;
    if (b.turns - a.turns > widest) return 0.5 * (a.turns + b.turns);
    double turns = 0;
    for (int i = 0; i < most_looks; ++i) {
      const double share = std::clamp(a.aside / (a.aside - b.aside), 0.1, 0.9);
      turns = a.turns + share * (b.turns - a.turns);
      const Look here = look(turns);
      if (std::abs(here.aside) <= accuracy) break;
      (here.aside > 0 ? a : b) = here;
    }
    return turns;
  }

  ForceLines& lines_;
  const Vec2 center_;
  const double radius_;
  std::vector<Look> looks_;
};

}  // namespace

SaddleSearch::SaddleSearch(const Region& region, ValleyGraph& graph, ForceLines& lines)
    : region_(region), graph_(graph), lines_(lines), holes_(region.holes()) {
  std::iota(holes_.begin(), holes_.end(), 0U);
  std::sort(holes_.begin(), holes_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return region.loops[a + 1].inside.y < region.loops[b + 1].inside.y;
  });
}

std::vector<bool> SaddleSearch::new_cycle(std::uint32_t from, std::span<const Vec2> between,
                                          std::uint32_t to) {
  std::vector<bool> around(region_.holes());
  if (graph_.cycles() >= region_.holes()) return around;
  std::vector<Vec2> cycle = graph_.way(to, from);
  cycle.insert(cycle.end(), between.begin(), between.end());
  const auto inside = [&](std::uint32_t hole) { return region_.loops[hole + 1].inside; };
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    Vec2 a = cycle[i], b = cycle[(i + 1) % cycle.size()];
    if (a.y > b.y) std::swap(a, b);
    auto hole = std::partition_point(holes_.begin(), holes_.end(),
                                     [&](std::uint32_t h) { return inside(h).y < a.y; });
    for (; hole != holes_.end() && inside(*hole).y < b.y; ++hole) {
      const Vec2 p = inside(*hole);
      if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) around[*hole] = !around[*hole];
    }
  }
  // Subtract the known cycles, as sets: what remains must be a new one.
  for (const std::vector<bool>& known : cycles_) {
    const auto pivot = std::find(known.begin(), known.end(), true) - known.begin();
    if (!around[static_cast<std::size_t>(pivot)]) continue;
    for (std::size_t i = 0; i < around.size(); ++i) around[i] = around[i] != known[i];
  }
  return around;
}

bool SaddleSearch::is_new(std::uint32_t from, std::span<const Vec2> between, std::uint32_t to,
                          std::vector<bool>& cycle) {
  cycle.clear();
  if (from == no_point || to == no_point || (from == to && between.empty())) return false;
  if (!graph_.connected(from, to)) return true;
  cycle = new_cycle(from, between, to);
  return std::find(cycle.begin(), cycle.end(), true) != cycle.end();
}

bool SaddleSearch::wanted(std::uint32_t from, std::span<const ValleyPoint> between,
                          std::uint32_t to) {
  std::vector<Vec2> places;
  for (const ValleyPoint& point : between) places.push_back(point.place);
  std::vector<bool> cycle;
  if (!is_new(from, places, to, cycle)) return false;
  if (!cycle.empty()) cycles_.push_back(std::move(cycle));
  return true;
}

void SaddleSearch::traverse() {
  const auto done = [&] { return complete() || lines_.exhausted(); };
  // Minima found on the way are appended to the list.
  for (; traversed_ < graph_.skeleton.points.size() && !done(); ++traversed_) {
    const std::uint32_t m = traversed_;
    const ValleyPoint minimum = graph_.skeleton.points[m];
    if (minimum.kind != ValleyPoint::Kind::minimum) continue;
    Circle circle(lines_, minimum);
    for (const double turns : circle.valleys()) {
      if (done()) break;
      const Vec2 direction = Circle::towards(turns), p = circle.at(direction);
      const double radius = lines_.distance_at(p);
      const std::uint32_t known =
          graph_.joined(p, radius, direction, 2 * ForceLines::merge_share, true);
      if (known != no_point) {
        // A line that passed the minimum, or one that leaves it.
        if (wanted(m, {}, known)) graph_.add_link(m, known);
        continue;
      }
      Trail trail = lines_.follow(p, direction, ForceLines::merge_share, ForceLines::Start::either);
      if (!wanted(m, trail.points, trail.end)) continue;
      trail.points.insert(trail.points.begin(), {p, radius, direction, ValleyPoint::Kind::valley});
      lines_.keep(m, trail);
    }
  }
}

void SaddleSearch::pass_necks(const Charges& charges) {
  // A corner whose distance is this close to the distance of the middle of the way is no nearer, up
  // to rounding.
  constexpr double as_near = 0.999;
  for (const std::uint32_t piece : region_.reflex) {
    if (complete() || lines_.exhausted()) return;
    const Charge &before = region_.pieces[region_.before(piece)], &after = region_.pieces[piece];
    const Vec2 out = after.end - after.start, back = before.start - before.end;
    const Vec2 across = charges.nearest_ahead(after.start, out, back) - after.start;
    const Vec2 middle = after.start + 0.5 * across;
    const double radius = lines_.distance_at(middle);
    if (!(radius > 0 && radius >= as_near * 0.5 * norm(across))) continue;
    // The valleys through a neck that is wide compared with a step need not pass its middle.
    if (graph_.crossed(middle - 0.25 * across, middle + 0.25 * across, radius) != no_point)
      continue;
    const Vec2 tangent = left_of(unit(across));
    pass({middle, radius, tangent, ValleyPoint::Kind::valley});
  }
}

void SaddleSearch::pass(const ValleyPoint& point) {
  const auto line = [&](Vec2 direction) {
    return lines_.follow(point.place, direction, ForceLines::merge_share,
                         ForceLines::Start::either);
  };
  const Trail one = line(point.tangent);
  keep(point, one, line(-point.tangent));
}

void SaddleSearch::keep(const ValleyPoint& point, const Trail& one, const Trail& two) {
  std::vector<ValleyPoint> between(one.points.rbegin(), one.points.rend());
  between.push_back(point);
  between.insert(between.end(), two.points.begin(), two.points.end());
  if (!wanted(one.end, between, two.end)) return;
  const std::uint32_t index = graph_.add_point(point);
  lines_.keep(index, one);
  lines_.keep(index, two);
}

Trail SaddleSearch::line_from(Vec2 place) {
  double radius = 0;
  const Vec2 direction = unit(lines_.force_at(place, radius).force);
  Trail line = lines_.follow(place, direction, ForceLines::merge_share);
  line.points.insert(line.points.begin(), {place, radius, direction, ValleyPoint::Kind::valley});
  return line;
}

void SaddleSearch::connect(const Skeleton& axis) {
  std::vector<std::uint32_t> parts;  // a point of each part, a minimum if it has one
  std::vector<std::uint32_t> number(graph_.skeleton.points.size(), no_point);
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    std::uint32_t& part = number[graph_.part(i)];
    if (part == no_point) {
      part = static_cast<std::uint32_t>(parts.size());
      parts.push_back(i);
    } else if (graph_.skeleton.points[i].kind == ValleyPoint::Kind::minimum) {
      parts[part] = i;
    }
  }
  for (const AxisWay& way : ways_between(axis, graph_.skeleton, parts))
    part_lines(way.places, Trail{{}, way.from}, Trail{{}, way.to});
}

bool SaddleSearch::lead_apart(std::span<const Vec2> way, const Trail& first, const Trail& last) {
  if (complete() || lines_.exhausted()) return false;
  std::vector<Vec2> between;
  for (const ValleyPoint& point : first.points) between.push_back(point.place);
  std::reverse(between.begin(), between.end());
  between.insert(between.end(), way.begin(), way.end());
  for (const ValleyPoint& point : last.points) between.push_back(point.place);
  std::vector<bool> cycle;
  return is_new(first.end, between, last.end, cycle);
}

/// If lines from both ends of a way lead to places that are not connected, or around a hole, lines
/// from some place in between diverge at a saddle.
void SaddleSearch::part_lines(std::span<const Vec2> way, const Trail& first, const Trail& last) {
  if (!lead_apart(way, first, last)) return;
  std::array<Vec2, 3> halved{way.front(), midpoint(way.front(), way.back()), way.back()};
  if (way.size() == 2) {
    constexpr double near = 1.0 / 64;
    const ValleyPoint& one = graph_.skeleton.points[first.end];
    const ValleyPoint& two = graph_.skeleton.points[last.end];
    // On a floor without slope, each line ends where it begins.
    if (distance(one.place, two.place) <= lines_.reach(std::min(one.radius, two.radius)) &&
        wanted(first.end, {}, last.end))
      return graph_.add_link(first.end, last.end);
    if (distance(way[0], way[1]) <= near * lines_.reach(lines_.distance_at(halved[1])))
      return join(way.front(), first, way.back(), last);
    way = halved;
  }
  // Start from the place in the middle, or from another one whose line has an end.
  std::size_t middle = way.size() / 2;
  Trail line = line_from(way[middle]);
  for (std::size_t i = 1; line.end == no_point && i + 1 < way.size() && !lines_.exhausted(); ++i)
    if (i != way.size() / 2) line = line_from(way[middle = i]);
  if (line.end == no_point) return join(way.front(), first, way.back(), last);
  part_lines(way.first(middle + 1), first, line);
  part_lines(way.subspan(middle), line, last);
}

void SaddleSearch::join(Vec2 at_one, Trail one, Vec2 at_two, Trail two) {
  constexpr double beside = 0.5;
  const auto add_start = [](Trail& line, Vec2 place) {
    if (line.points.empty()) line.points.push_back({place, 0, {}, ValleyPoint::Kind::valley});
  };
  add_start(one, at_one);
  add_start(two, at_two);
  std::size_t of_one = 0, of_two = 0;
  for (std::size_t i = 0, k = 0; i < one.points.size(); ++i) {
    const auto away = [&](std::size_t at) {
      return distance(one.points[i].place, two.points[at].place);
    };
    while (k + 1 < two.points.size() && away(k + 1) < away(k)) ++k;
    if (away(k) > beside * lines_.reach(one.points[i].radius)) break;
    of_one = i, of_two = k;
  }
  const Vec2 place = midpoint(one.points[of_one].place, two.points[of_two].place);
  const double radius = lines_.distance_at(place);
  const auto saddle = lines_.critical_point(place, false, lines_.reach(radius));
  const Vec2 along = unit(two.points.back().place - one.points.back().place);
  const ValleyPoint middle =
      saddle ? *saddle : ValleyPoint{place, radius, along, ValleyPoint::Kind::valley};
  const auto cut = [](Trail& line, std::size_t last) {
    line.points.erase(line.points.begin(),
                      line.points.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  };
  cut(one, of_one);
  cut(two, of_two);
  keep(middle, one, two);
}

}  // namespace medial::potential
