#include "methods/potential/saddles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

  /// The directions in which valleys lead away, in turns, ascending: there the force along the
  /// circle goes from forward to backward.
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
      // On a floor without slope the force has no direction: that is its middle.
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

  /// Looks where two looks leave open how often the sine changes its sign in between.
  void look_between(Look a, Look b, int depth) {
    const bool is_lost = (a.aside == 0) != (b.aside == 0);
    if (depth == 0 || !(is_lost || may_change_more(a, b))) return;
    const Look middle = look(0.5 * (a.turns + b.turns));
    look_between(a, middle, depth - 1);
    looks_.push_back(middle);
    look_between(middle, b, depth - 1);
  }

  /// Whether it may do so more often than its signs at both ends tell: not where it rises, or
  /// falls, at both, nor where the tangents there meet before they reach zero.
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

  /// Where the sine is 0 between two looks, by false position.
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

/// Whether p lies inside of a polygon.
bool encloses(const std::vector<Vec2>& polygon, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) inside = !inside;
  }
  return inside;
}

}  // namespace

Label SaddleSearch::probe(std::uint32_t piece, double share, Trail& trail) {
  const Charge& charge = region_.pieces[piece];
  const Vec2 along = charge.end - charge.start;
  const Vec2 foot = charge.start + share * along;
  const Vec2 inward = unit(left_of(along));
  double height = std::min(0.1 * lines_.reach(std::numeric_limits<double>::infinity()),
                           0.2 * std::min(share, 1 - share) * norm(along));
  for (int i = 0; i < 40; ++i, height /= 2) {
    const double radius = lines_.distance_at(foot + height * inward);
    if (radius >= 0.999 * height) break;
  }
  trail = lines_.follow(foot + height * inward, inward, 0.1);
  return lines_.label_of(trail);
}

const SaddleSearch::Pass& SaddleSearch::pass_at(const ValleyPoint& saddle) {
  for (const Pass& known : saddles_) {
    if (distance(known.place, saddle.place) <= 0.2 * lines_.reach(saddle.radius)) return known;
  }
  pass(saddle, ForceLines::Start::downward);
  return saddles_.back();
}

bool SaddleSearch::wanted(std::uint32_t from, std::span<const ValleyPoint> between,
                          std::uint32_t to) {
  if (from == no_point || to == no_point || from == to) return false;
  if (!graph_.connected(from, to)) return true;
  if (graph_.cycles() >= region_.holes()) return false;
  std::vector<Vec2> cycle = graph_.way(to, from);
  for (const ValleyPoint& point : between) cycle.push_back(point.place);
  Box box{cycle.front(), cycle.front()};
  for (const Vec2 p : cycle) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  std::vector<bool> around(region_.holes());
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Vec2 inside = region_.loops[i + 1].inside;
    around[i] = contains(box, inside) && encloses(cycle, inside);
  }
  // Less the cycles that are known, as sets: what is left must be a new one.
  for (const std::vector<bool>& known : cycles_) {
    const auto pivot = std::find(known.begin(), known.end(), true) - known.begin();
    if (!around[static_cast<std::size_t>(pivot)]) continue;
    for (std::size_t i = 0; i < around.size(); ++i) around[i] = around[i] != known[i];
  }
  if (std::find(around.begin(), around.end(), true) == around.end()) return false;
  cycles_.push_back(std::move(around));
  return true;
}

void SaddleSearch::traverse() {
  const auto done = [&] { return complete() || lines_.exhausted(); };
  // Minima that are found on the way come after these.
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
        // A line that passed the minimum by, or one that leads from it.
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
  // What is as near as the corner to the middle of the way is no nearer than rounding.
  constexpr double as_near = 0.999;
  for (const Region::PieceLoop& loop : region_.loops) {
    for (std::uint32_t i = loop.begin; i < loop.end && !complete() && !lines_.exhausted(); ++i) {
      const Charge& before = region_.pieces[i == loop.begin ? loop.end - 1 : i - 1];
      const Charge& after = region_.pieces[i];
      const Vec2 out = after.end - after.start, back = before.start - before.end;
      if (!(cross(out, back) < 0)) continue;
      const Vec2 across = charges.nearest_ahead(after.start, out, back) - after.start;
      const Vec2 middle = after.start + 0.5 * across;
      const double radius = lines_.distance_at(middle);
      if (!(radius > 0 && radius >= as_near * 0.5 * norm(across))) continue;
      // The valleys through a neck that is wide beside a step need not pass its middle.
      if (graph_.crossed(middle - 0.25 * across, middle + 0.25 * across, radius) != no_point)
        continue;
      const Vec2 tangent = left_of(unit(across));
      pass({middle, radius, tangent, ValleyPoint::Kind::saddle}, ForceLines::Start::either);
    }
  }
}

void SaddleSearch::pass(const ValleyPoint& point, ForceLines::Start start) {
  const Trail one = lines_.follow(point.place, point.tangent, ForceLines::merge_share, start);
  const Trail two = lines_.follow(point.place, -point.tangent, ForceLines::merge_share, start);
  saddles_.push_back({point.place, lines_.label_of(one), lines_.label_of(two)});
  std::vector<ValleyPoint> between(one.points.rbegin(), one.points.rend());
  between.push_back(point);
  between.insert(between.end(), two.points.begin(), two.points.end());
  if (!wanted(one.end, between, two.end)) return;
  const std::uint32_t index = graph_.add_point(point);
  ++graph_.skeleton.saddles;
  graph_.labels[index] = lines_.keep(index, one);
  lines_.keep(index, two);
}

/// Looks for saddles between two places of a loop, the second one further on.
void SaddleSearch::part_lines(const Region::PieceLoop& loop, const Sample& first,
                              const Sample& second, bool sides, int depth) {
  const bool same_minimum = first.label.minimum == second.label.minimum;
  if (first.label.minimum == no_point || second.label.minimum == no_point || complete()) return;
  if (lines_.exhausted()) return;
  if (sides ? first.label == second.label
            : same_minimum || graph_.connected(first.label.minimum, second.label.minimum))
    return;
  // Two lines that arrive from both sides may have nothing but their minimum in between.
  if (depth > (same_minimum ? 14 : 44)) return;
  Trail trail;
  Sample middle{0.5 * (first.place + second.place), {}};
  middle.label = probe_at(loop, middle.place, trail);
  if (std::isfinite(trail.weakest)) {
    const auto saddle = lines_.critical_point(trail.place, false);
    if (saddle && distance(saddle->place, trail.place) <= 4 * lines_.reach(saddle->radius)) {
      const Pass& pass = pass_at(*saddle);
      if ((pass.one == first.label && pass.two == second.label) ||
          (pass.two == first.label && pass.one == second.label))
        return;
    }
  }
  part_lines(loop, first, middle, sides, depth + 1);
  part_lines(loop, middle, second, sides, depth + 1);
}

Label SaddleSearch::probe_at(const Region::PieceLoop& loop, double place, Trail& trail) {
  const double count = loop.end - loop.begin;
  double local = place - loop.begin;
  if (local >= count) local -= count;
  const double whole = std::min(std::floor(local), count - 1);
  const double share = std::clamp(local - whole, 1e-9, 1 - 1e-9);
  return probe(loop.begin + static_cast<std::uint32_t>(whole), share, trail);
}

void SaddleSearch::connect(const std::vector<Label>& corner_labels) {
  if (graph_.skeleton.points.empty()) return;
  // Ever more places of the border, until all is connected.
  for (const int round : {0, 1, 2}) {
    if (complete()) return;
    for (std::size_t l = 0; l < region_.loops.size() && !complete(); ++l) {
      const Region::PieceLoop& loop = region_.loops[l];
      std::vector<Sample> samples = samples_of(l, round, corner_labels);
      if (samples.empty()) continue;
      samples.push_back(samples.front());
      samples.back().place += loop.end - loop.begin;
      for (std::size_t i = 0; i + 1 < samples.size(); ++i)
        part_lines(loop, samples[i], samples[i + 1], round > 0, 0);
    }
  }
}

/// The convex corners of a loop, and as many places between them as the round asks for.
std::vector<SaddleSearch::Sample> SaddleSearch::samples_of(
    std::size_t l, int round, const std::vector<Label>& corner_labels) {
  const Region::PieceLoop& loop = region_.loops[l];
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < region_.corners.size(); ++i) {
    const std::uint32_t piece = region_.corners[i];
    if (piece >= loop.begin && piece < loop.end && corner_labels[i].minimum != no_point)
      samples.push_back({static_cast<double>(piece), corner_labels[i]});
  }
  const std::uint32_t count = loop.end - loop.begin;
  const std::uint32_t wanted_probes = round == 2 ? count : round == 1 ? 16 : l == 0 ? 0 : 4;
  if (samples.size() < wanted_probes || round == 2) {
    const std::uint32_t stride = std::max(1U, count / std::max(1U, wanted_probes));
    for (std::uint32_t i = 0; i < count; i += stride) {
      Trail trail;
      const double place = loop.begin + i + 0.5;
      samples.push_back({place, probe_at(loop, place, trail)});
    }
  }
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.place < b.place; });
  return samples;
}

}  // namespace medial::potential
