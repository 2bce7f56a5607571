#include "ops/groove.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "axis/curve.h"
#include "base/numbers.h"
#include "base/open_boxes.h"
#include "base/pair.h"
#include "medial/geometry.h"

namespace medial::ops {
namespace {

/// The largest distance of a curve from its chord in (x, y, r), which is at t = 1/2.
double deviation(const Curve& curve) {
  const double rise = curve.r2 - curve.r0, control_rise = curve.r1 - curve.r0;
  const double size = squared_norm(curve.p2) + rise * rise;
  const double along = size > 0 ? (dot(curve.p1, curve.p2) + control_rise * rise) / size : 0;
  const Vec2 off = curve.p1 - along * curve.p2;
  const double off_rise = control_rise - along * rise;
  // A control point beyond the chord's ends turns the curve back.
  const double beyond = std::max({0.0, -along, along - 1}) * std::sqrt(size);
  return curve.weight / (1 + curve.weight) *
         (std::sqrt(squared_norm(off) + off_rise * off_rise) + beyond);
}

/// Appends the ends of chords of a curve, all but its first point.
void sample(const Curve& curve, double chord, int depth, std::vector<Disk>& out) {
  constexpr int deepest = 20;
  if (deviation(curve) <= chord || depth == deepest) {
    out.push_back({curve.end, curve.r2});
    return;
  }
  sample(curve.part(0, 0.5), chord, depth + 1, out);
  sample(curve.part(0.5, 1), chord, depth + 1, out);
}

}  // namespace

Grooves grooves_of(const MedialAxis& axis, double least, double most, double chord) {
  Grooves grooves;
  grooves.junctions = static_cast<std::uint32_t>(axis.nodes.size());
  const double slack = axis.tolerance;
  grooves.parts.reserve(axis.edges.size());
  std::vector<double> cuts;
  for (const Edge& edge : axis.edges) {
    const Curve whole = curve_of(axis, edge);
    cuts.assign({0.0, 1.0});
    for (const double level : {least, most})
      if (std::isfinite(level))
        add_roots(whole.r0 - level, whole.weight * (whole.r1 - level), whole.r2 - level, cuts);
    std::sort(cuts.begin(), cuts.end());
    std::uint32_t junction = edge.node[0];
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double t0 = cuts[i], t1 = cuts[i + 1];
      const std::uint32_t from = junction;
      junction = t1 == 1 ? edge.node[1] : grooves.junctions++;
      if (!(t0 < t1)) continue;
      const double middle = whole.at(0.5 * (t0 + t1)).radius;
      if (!(middle >= least - slack && middle <= most + slack)) continue;
      const Curve part = t1 - t0 < 1 ? whole.part(t0, t1) : whole;
      Groove& groove = grooves.parts.emplace_back();
      groove.from = from;
      groove.to = junction;
      groove.disks.reserve(2);
      groove.disks.push_back({part.origin, part.r0});
      const bool curved = deviation(part) > slack;
      sample(part, curved ? chord : infinity, 0, groove.disks);
      for (Disk& disk : groove.disks) disk.radius -= curved ? std::sqrt(2.0) * chord : 0;
    }
  }
  return grooves;
}

namespace {

using Trail = std::vector<GrooveStep>;

/// The order of trails, by their ends, with separate arrays for coordinates. A sentinel follows the
/// last one.
class TrailOrder {
 public:
  explicit TrailOrder(std::size_t count)
      : first_x_(count + 1),
        first_y_(count + 1),
        last_x_(count + 1),
        last_y_(count + 1),
        gap_(count + 1, -1),
        trail_(count),
        turned_(count, false) {}

  std::size_t size() const { return trail_.size(); }
  Vec2 first(std::size_t i) const { return {first_x_[i], first_y_[i]}; }
  Vec2 last(std::size_t i) const { return {last_x_[i], last_y_[i]}; }
  std::uint32_t trail(std::size_t i) const { return trail_[i]; }
  bool turned(std::size_t i) const { return turned_[i] != 0; }

  void set(std::uint32_t i, Vec2 first, Vec2 last) {
    std::tie(first_x_[i], first_y_[i]) = std::tie(first.x, first.y);
    std::tie(last_x_[i], last_y_[i]) = std::tie(last.x, last.y);
    trail_[i] = i;
    if (i > 0) set_gap(i - 1);
  }
  /// Reverses a run of trails.
  void turn(std::size_t from, std::size_t to) {
    for (auto* const values : {&first_x_, &first_y_, &last_x_, &last_y_})
      reverse(*values, from, to);
    reverse(trail_, from, to);
    reverse(turned_, from, to);
    const auto swap = [&](std::vector<double>& a, std::vector<double>& b) {
      std::swap_ranges(a.begin() + offset(from), a.begin() + offset(to) + 1,
                       b.begin() + offset(from));
    };
    swap(first_x_, last_x_);
    swap(first_y_, last_y_);
    for (std::size_t k = from; k <= to; ++k) turned_[k] ^= 1;
    for (std::size_t k = from == 0 ? 0 : from - 1; k <= to && k + 1 < size(); ++k) set_gap(k);
  }
  /// The first j from `from` to before `end` for which turning `begin` to j shortens one of its two
  /// ways, of which the first leads from `before` and has the square `way`; or `end`.
  std::size_t find_shorter(std::size_t begin, Vec2 before, double way, std::size_t from,
                           std::size_t end) const {
    const Vec2 start = first(begin);
    for (; from + 1 < end; from += 2) {
      const Pair x = pair_at(&last_x_[from]) - before.x, y = pair_at(&last_y_[from]) - before.y;
      const Pair u = pair_at(&first_x_[from + 1]) - start.x;
      const Pair v = pair_at(&first_y_[from + 1]) - start.y;
      if (!all((x * x + y * y >= both(way)) & (u * u + v * v >= pair_at(&gap_[from])))) break;
    }
    for (; from < end; ++from)
      if (squared_norm(last(from) - before) < way ||
          squared_norm(first(from + 1) - start) < gap_[from])
        break;
    return from;
  }

 private:
  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }
  template <class Values>
  static void reverse(Values& values, std::size_t from, std::size_t to) {
    std::reverse(values.begin() + offset(from), values.begin() + offset(to) + 1);
  }
  void set_gap(std::size_t i) { gap_[i] = squared_norm(first(i + 1) - last(i)); }

  std::vector<double> first_x_, first_y_, last_x_, last_y_;
  std::vector<double> gap_;  ///< the squared distance to the next one, or -1
  std::vector<std::uint32_t> trail_;
  std::vector<std::uint8_t> turned_;
};

TrailOrder order_of(const Grooves& grooves, const std::vector<Trail>& trails) {
  const auto place = [&](const GrooveStep& step, bool at_end) {
    const auto& disks = grooves.parts[step.part].disks;
    return (step.forward == at_end ? disks.back() : disks.front()).center;
  };
  TrailOrder order(trails.size());
  for (std::uint32_t i = 0; i < trails.size(); ++i)
    order.set(i, place(trails[i].front(), false), place(trails[i].back(), true));
  return order;
}

/// Shortens the travel between trails by reversing runs of up to `window` trails (2-opt), in a few
/// passes.
void shorten_ways(const Grooves& grooves, Vec2 start, std::vector<Trail>& trails) {
  constexpr std::size_t window = 150;
  constexpr int passes = 4;
  TrailOrder order = order_of(grooves, trails);
  const std::size_t count = order.size();
  std::vector<bool> changed(count, true), changes;
  for (int pass = 0; pass < passes; ++pass) {
    changes.assign(count, false);
    // What turns run i to j depends on those from i - 1 to j + 1. The next one that has changed
    // since i was looked at last, and where those end that have changed now.
    std::size_t next = 0, end = 0;
    for (std::size_t i = 0; i < count; ++i) {
      while (next < count && (next + 1 < i || !changed[next])) ++next;
      if (end + 1 <= i && next > i + window) continue;
      const Vec2 before = i == 0 ? start : order.last(i - 1);
      const std::size_t last = std::min(count, i + window);
      double way = squared_norm(order.first(i) - before);
      for (std::size_t j = i;; ++j) {
        j = order.find_shorter(i, before, way, j, last);
        if (j == last) break;
        double gain = distance(before, order.first(i)) - distance(before, order.last(j));
        if (j + 1 < count)
          gain += distance(order.last(j), order.first(j + 1)) -
                  distance(order.first(i), order.first(j + 1));
        if (!(gain > 1e-9 * distance(before, order.first(i)))) continue;
        order.turn(i, j);
        std::fill_n(changes.begin() + static_cast<std::ptrdiff_t>(i), j + 1 - i, true);
        end = std::max(end, j + 1);
        way = squared_norm(order.first(i) - before);
      }
    }
    if (end == 0) break;
    changed.swap(changes);
  }
  std::vector<Trail> out;
  out.reserve(trails.size());
  for (std::size_t i = 0; i < count; ++i) {
    Trail& trail = out.emplace_back(std::move(trails[order.trail(i)]));
    if (!order.turned(i)) continue;
    std::reverse(trail.begin(), trail.end());
    for (GrooveStep& step : trail) step.forward = !step.forward;
  }
  trails = std::move(out);
}

}  // namespace

std::vector<std::vector<GrooveStep>> trails_of(const Grooves& grooves, Vec2 start) {
  struct End {
    std::uint32_t part;
    bool forward;
  };
  const auto& parts = grooves.parts;
  // The ends of parts around each junction, side by side, are taken from behind: those of j stand
  // before around[behind[j]].
  std::vector<std::uint32_t> left(grooves.junctions), behind(left), place_of(left);
  for (const Groove& part : parts) {
    ++left[part.from];
    ++left[part.to];
  }
  std::exclusive_scan(left.begin(), left.end(), behind.begin(), 0U);
  std::vector<End> around(2 * parts.size());
  std::vector<Vec2> places(grooves.junctions);
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    around[behind[parts[i].from]++] = {i, true};
    around[behind[parts[i].to]++] = {i, false};
    places[parts[i].from] = parts[i].disks.front().center;
    places[parts[i].to] = parts[i].disks.back().center;
  }
  std::vector<bool> done(parts.size(), false);
  std::vector<std::vector<GrooveStep>> trails;
  Vec2 at = start;
  // A trail that begins at a junction of odd degree ends at another one, so their number is
  // minimal. The remaining trails are closed.
  for (const bool odd : {true, false}) {
    std::vector<std::uint32_t> ends;
    for (std::uint32_t j = 0; j < grooves.junctions; ++j)
      if (odd ? left[j] % 2 == 1 : left[j] > 0) ends.push_back(j);
    std::vector<Box> boxes;
    for (const std::uint32_t j : ends) {
      place_of[j] = static_cast<std::uint32_t>(boxes.size());
      boxes.push_back({places[j], places[j]});
    }
    OpenBoxes open(std::move(boxes));
    while (!open.empty()) {
      const std::uint32_t nearest =
          open.nearest(at, [&](std::uint32_t i) { return squared_norm(places[ends[i]] - at); });
      open.erase(nearest);
      std::uint32_t j = ends[nearest];
      if (left[j] == 0) continue;
      auto& trail = trails.emplace_back();
      while (left[j] > 0) {
        while (done[around[--behind[j]].part]) continue;
        const End step = around[behind[j]];
        done[step.part] = true;
        trail.push_back({step.part, step.forward});
        --left[j];
        j = step.forward ? parts[step.part].to : parts[step.part].from;
        --left[j];
      }
      if (odd) open.erase(place_of[j]);
      at = places[j];
    }
  }
  shorten_ways(grooves, start, trails);
  return trails;
}

}  // namespace medial::ops
