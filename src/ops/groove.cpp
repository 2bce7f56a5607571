#include "ops/groove.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "axis/curve.h"

namespace medial::ops {
namespace {

/// A point of (x, y, r) space.
struct Point {
  Vec2 p;
  double r = 0;
};
Point mix(const Point& a, double wa, const Point& b, double wb) {
  const double sum = wa + wb;
  return {(1 / sum) * (wa * a.p + wb * b.p), (wa * a.r + wb * b.r) / sum};
}
double dot3(const Point& a, const Point& b) { return dot(a.p, b.p) + a.r * b.r; }
Point minus(const Point& a, const Point& b) { return {a.p - b.p, a.r - b.r}; }

/// A rational quadratic with end weights 1, relative to an origin.
struct Conic {
  Point p0, p1, p2;
  double w = 1;

  std::array<Conic, 2> split(double t) const {
    const double s = 1 - t, w01 = s + t * w, w12 = s * w + t;
    const double middle = s * w01 + t * w12, root = std::sqrt(middle);
    const Point a = mix(p0, s, p1, t * w), b = mix(p1, s * w, p2, t);
    const Point m = mix(a, s * w01, b, t * w12);
    return {{{p0, a, m, w01 / root}, {m, b, p2, w12 / root}}};
  }
  /// The part between two parameters.
  Conic part(double t0, double t1) const {
    if (t1 < 1) {
      const Conic first = split(t1)[0];
      // In standard form the parameter moves: t' / (1 - t') = t / (1 - t) scaled by end weights.
      if (t0 <= 0) return first;
      const double s1 = 1 - t1;
      const double end = s1 * (s1 + t1 * w) + t1 * (s1 * w + t1);  // weight at t1
      const double u = t0 / t1;  // of the whole part, before its end weight became 1
      const double v = u * std::sqrt(end) / ((1 - u) + u * std::sqrt(end));
      return first.split(v)[1];
    }
    return t0 > 0 ? split(t0)[1] : *this;
  }
  /// The largest distance from the chord: that of the point at t = 1/2.
  double deviation() const {
    const Point chord = minus(p2, p0), aside = minus(p1, p0);
    const double size = dot3(chord, chord);
    const double along = size > 0 ? dot3(aside, chord) / size : 0;
    const Point off{aside.p - along * chord.p, aside.r - along * chord.r};
    // A control point beyond the chord's ends turns the curve back.
    const double beyond = std::max({0.0, -along, along - 1}) * std::sqrt(size);
    return w / (1 + w) * (std::sqrt(dot3(off, off)) + beyond);
  }
};

/// The parameters in (0, 1) where the radius is `level`.
void add_crossings(const MedialAxis& axis, const Edge& edge, double level,
                   std::vector<double>& out) {
  const double a = axis.nodes[edge.node[0]].disk.radius - level;
  const double b = edge.weight * (edge.control.radius - level);
  const double c = axis.nodes[edge.node[1]].disk.radius - level;
  const double square = b * b - a * c;
  if (!(square >= 0)) return;
  // a s^2 + 2 b s t + c t^2 = 0: t / s = numerator / denominator, twice.
  const double q = -(b + std::copysign(std::sqrt(square), b));
  for (const auto& [numerator, denominator] : {std::pair(q, c), std::pair(a, q)}) {
    if (numerator == 0 || denominator == 0 || (numerator > 0) != (denominator > 0)) continue;
    const double t = numerator / (numerator + denominator);
    if (t > 0 && t < 1) out.push_back(t);
  }
}

void sample(const Conic& conic, double chord, int depth, std::vector<Point>& out) {
  constexpr int deepest = 20;
  if (conic.deviation() <= chord || depth == deepest) {
    out.push_back(conic.p2);
    return;
  }
  const auto halves = conic.split(0.5);
  sample(halves[0], chord, depth + 1, out);
  sample(halves[1], chord, depth + 1, out);
}

}  // namespace

Grooves grooves_of(const MedialAxis& axis, double least, double most, double chord) {
  Grooves grooves;
  grooves.junctions = static_cast<std::uint32_t>(axis.nodes.size());
  const double slack = axis.tolerance;
  std::vector<double> cuts;
  std::vector<Point> points;
  for (const Edge& edge : axis.edges) {
    const Disk& first = axis.nodes[edge.node[0]].disk;
    const Disk& last = axis.nodes[edge.node[1]].disk;
    const Vec2 origin = first.center;
    const Conic whole{{{0, 0}, first.radius},
                      {edge.control.center - origin, edge.control.radius},
                      {last.center - origin, last.radius},
                      edge.weight};
    cuts.assign({0.0});
    add_crossings(axis, edge, least, cuts);
    if (std::isfinite(most)) add_crossings(axis, edge, most, cuts);
    cuts.push_back(1.0);
    std::sort(cuts.begin(), cuts.end());
    std::uint32_t junction = edge.node[0];
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double t0 = cuts[i], t1 = cuts[i + 1];
      const std::uint32_t from = junction;
      junction = t1 == 1 ? edge.node[1] : grooves.junctions++;
      if (!(t0 < t1)) continue;
      const double middle = curve_of(axis, edge).at(0.5 * (t0 + t1)).radius;
      if (!(middle >= least - slack && middle <= most + slack)) continue;
      const Conic part = whole.part(t0, t1);
      points.assign({part.p0});
      double lower = 0;
      if (part.deviation() > slack) {
        lower = std::sqrt(2.0) * chord;
        sample(part, chord, 0, points);
      } else {
        points.push_back(part.p2);
      }
      Groove& groove = grooves.parts.emplace_back();
      groove.from = from;
      groove.to = junction;
      for (const Point& p : points) groove.disks.push_back({origin + p.p, p.r - lower});
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
    Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Vec2 high = -low;
    for (const std::uint32_t m : all) {
      low = {std::min(low.x, places[m].x), std::min(low.y, places[m].y)};
      high = {std::max(high.x, places[m].x), std::max(high.y, places[m].y)};
    }
    low_ = low;
    const double count = std::max<double>(1, static_cast<double>(all.size()));
    const double extent = std::max(high.x - low.x, high.y - low.y);
    side_ = extent > 0 ? extent / std::ceil(std::sqrt(count)) : 1;
    last_ = {column(high.x - low.x), column(high.y - low.y)};
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
    double best = std::numeric_limits<double>::infinity();
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
