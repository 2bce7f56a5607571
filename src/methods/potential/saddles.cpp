#include "methods/potential/saddles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace medial::potential {
namespace {

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
  constexpr int directions = 48;
  constexpr int halvings = 5;
  const auto done = [&] { return complete() || lines_.exhausted(); };
  // Minima that are found on the way come after these.
  for (; traversed_ < graph_.skeleton.points.size() && !done(); ++traversed_) {
    const std::uint32_t m = traversed_;
    const ValleyPoint minimum = graph_.skeleton.points[m];
    if (minimum.kind != ValleyPoint::Kind::minimum) continue;
    const double around = lines_.reach(minimum.radius);
    // The force along a circle turns from forward to backward in a valley.
    double radius = 0;
    const auto along = [&](Vec2 direction) {
      const Force force = lines_.force_at(minimum.place + around * direction, radius);
      return radius > 0 && !lines_.lost(force) ? dot(force.force, left_of(direction)) : 0;
    };
    const auto towards = [](double turns) {
      const double angle = 2 * std::numbers::pi * turns / directions;
      return Vec2{std::cos(angle), std::sin(angle)};
    };
    // The last place where the force is none or has no direction lies before this.
    int known_at = -1;
    double before = along(towards(known_at));
    while (before == 0 && known_at > -directions) before = along(towards(--known_at));
    for (int i = 0; i < directions && !done(); ++i) {
      const double here = along(towards(i));
      if (here == 0) continue;
      const bool valley = before > 0 && here < 0;
      double low = known_at, high = i;
      before = here;
      known_at = i;
      if (!valley) continue;
      // On a floor without slope the force has no direction: that is its middle.
      for (int k = 0; k < halvings && high - low <= 1; ++k) {
        const double middle = 0.5 * (low + high);
        (along(towards(middle)) > 0 ? low : high) = middle;
      }
      const Vec2 direction = towards(0.5 * (low + high));
      const Vec2 p = minimum.place + around * direction;
      radius = lines_.distance_at(p);
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
      const Vec2 tangent = left_of(unit(across));
      if (graph_.joined(middle, radius, tangent, 2 * ForceLines::merge_share, true) != no_point)
        continue;
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
