#include "ops/groove.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "axis/curve.h"
#include "base/numbers.h"
#include "medial/geometry.h"

namespace medial::ops {
namespace {

/// How far a curve departs from its chord in (x, y, r): most at t = 1/2.
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
      groove.disks.push_back({part.origin, part.r0});
      const bool curved = deviation(part) > slack;
      sample(part, curved ? chord : infinity, 0, groove.disks);
      for (Disk& disk : groove.disks) disk.radius -= curved ? std::sqrt(2.0) * chord : 0;
    }
  }
  return grooves;
}

namespace {

/// The junctions that parts still end at, in a grid of squares; finds the nearest.
class OpenEnds {
 public:
  /// `all`: what may ever be put in.
  OpenEnds(const std::vector<Vec2>& places, const std::vector<std::uint32_t>& all)
      : places_(places) {
    Box box = Box::nothing();
    for (const std::uint32_t m : all) box.add(places[m]);
    low_ = box.low;
    const Vec2 size = box.high - box.low;
    const double count = std::max<double>(1, static_cast<double>(all.size()));
    const double extent = std::max(size.x, size.y);
    side_ = extent > 0 ? extent / std::ceil(std::sqrt(count)) : 1;
    last_ = {column(size.x), column(size.y)};
  }
  bool empty() const { return count_ == 0; }
  void insert(std::uint32_t m) {
    cells_[key(m)].push_back(m);
    ++count_;
  }
  void erase(std::uint32_t m) {
    auto& cell = cells_[key(m)];
    const auto found = std::find(cell.begin(), cell.end(), m);
    if (found == cell.end()) return;
    *found = cell.back();
    cell.pop_back();
    --count_;
  }
  /// Requires one. Squares around p, ring after ring, until no nearer one can follow.
  std::uint32_t nearest(Vec2 p) const {
    const std::int64_t x = std::clamp<std::int64_t>(column(p.x - low_.x), 0, last_[0]);
    const std::int64_t y = std::clamp<std::int64_t>(column(p.y - low_.y), 0, last_[1]);
    double best = infinity;
    std::uint32_t found = 0;
    const std::int64_t reach = std::max(last_[0], last_[1]) + 1;
    for (std::int64_t ring = 0; ring <= reach; ++ring) {
      if (best <= std::pow(static_cast<double>(ring - 1) * side_, 2) && ring > 0) break;
      for (std::int64_t j = y - ring; j <= y + ring; ++j) {
        const bool edge = j == y - ring || j == y + ring;
        for (std::int64_t i = x - ring; i <= x + ring; i += edge || ring == 0 ? 1 : 2 * ring) {
          const auto cell = cells_.find(pack(i, j));
          if (cell == cells_.end()) continue;
          for (const std::uint32_t m : cell->second) {
            const double d = squared_norm(places_[m] - p);
            if (d < best || (d == best && m < found)) best = d, found = m;
          }
        }
      }
    }
    return found;
  }

 private:
  std::int64_t column(double offset) const {
    return static_cast<std::int64_t>(std::floor(offset / side_));
  }
  static std::uint64_t pack(std::int64_t i, std::int64_t j) {
    return static_cast<std::uint64_t>(i) << 32U ^ (static_cast<std::uint64_t>(j) & 0xFFFFFFFFU);
  }
  std::uint64_t key(std::uint32_t m) const {
    return pack(column(places_[m].x - low_.x), column(places_[m].y - low_.y));
  }

  const std::vector<Vec2>& places_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
  Vec2 low_;
  double side_ = 1;
  std::array<std::int64_t, 2> last_{};
  std::size_t count_ = 0;
};

using Trail = std::vector<GrooveStep>;

/// Shortens the ways between trails: turns runs of up to `window` trails around where that helps
/// (2-opt), a few times over.
void shorten_ways(const Grooves& grooves, Vec2 start, std::vector<Trail>& trails) {
  constexpr std::size_t window = 150;
  constexpr int passes = 4;
  struct Ends {
    Vec2 first, last;
    std::uint32_t trail;
    bool turned;
  };
  const auto place = [&](const GrooveStep& step, bool at_end) {
    const auto& disks = grooves.parts[step.part].disks;
    return (step.forward == at_end ? disks.back() : disks.front()).center;
  };
  std::vector<Ends> order;
  for (std::uint32_t i = 0; i < trails.size(); ++i)
    order.push_back({place(trails[i].front(), false), place(trails[i].back(), true), i, false});
  for (int pass = 0; pass < passes; ++pass) {
    bool changed = false;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Vec2 before = i == 0 ? start : order[i - 1].last;
      for (std::size_t j = i; j < std::min(order.size(), i + window); ++j) {
        double gain = distance(before, order[i].first) - distance(before, order[j].last);
        if (j + 1 < order.size())
          gain += distance(order[j].last, order[j + 1].first) -
                  distance(order[i].first, order[j + 1].first);
        if (!(gain > 1e-9 * distance(before, order[i].first))) continue;
        std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i),
                     order.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        for (std::size_t k = i; k <= j; ++k) {
          std::swap(order[k].first, order[k].last);
          order[k].turned = !order[k].turned;
        }
        changed = true;
      }
    }
    if (!changed) break;
  }
  std::vector<Trail> out;
  out.reserve(trails.size());
  for (const Ends& ends : order) {
    Trail& trail = out.emplace_back(std::move(trails[ends.trail]));
    if (!ends.turned) continue;
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
  std::vector<std::vector<End>> around(grooves.junctions);
  std::vector<Vec2> places(grooves.junctions);
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    around[parts[i].from].push_back({i, true});
    around[parts[i].to].push_back({i, false});
    places[parts[i].from] = parts[i].disks.front().center;
    places[parts[i].to] = parts[i].disks.back().center;
  }
  // A trail that begins at a junction of odd degree ends at another one: there is no way to need
  // fewer. What then is left are closed trails.
  std::vector<std::uint32_t> used, left(grooves.junctions);
  for (std::uint32_t j = 0; j < grooves.junctions; ++j) {
    left[j] = static_cast<std::uint32_t>(around[j].size());
    if (left[j] > 0) used.push_back(j);
  }
  OpenEnds odd_ends(places, used), even_ends(places, used);
  for (const std::uint32_t j : used) (left[j] % 2 == 1 ? odd_ends : even_ends).insert(j);
  std::vector<bool> done(parts.size(), false);
  std::vector<std::vector<GrooveStep>> trails;
  Vec2 at = start;
  while (!odd_ends.empty() || !even_ends.empty()) {
    const bool from_odd = !odd_ends.empty();
    std::uint32_t j = from_odd ? odd_ends.nearest(at) : even_ends.nearest(at);
    if (left[j] == 0) {
      even_ends.erase(j);
      continue;
    }
    if (from_odd) odd_ends.erase(j);
    auto& trail = trails.emplace_back();
    const std::uint32_t begin = j;
    while (left[j] > 0) {
      auto& ends = around[j];
      while (done[ends.back().part]) ends.pop_back();
      const End step = ends.back();
      ends.pop_back();
      done[step.part] = true;
      trail.push_back({step.part, step.forward});
      --left[j];
      j = step.forward ? parts[step.part].to : parts[step.part].from;
      --left[j];
    }
    // The first junction has become even and the last one, too.
    if (from_odd && j != begin) odd_ends.erase(j);
    if (from_odd && left[begin] > 0) even_ends.insert(begin);
    at = places[j];
  }
  shorten_ways(grooves, start, trails);
  return trails;
}

}  // namespace medial::ops
