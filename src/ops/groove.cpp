#include "ops/groove.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "axis/curve.h"
#include "base/numbers.h"
#include "base/open_boxes.h"
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

using Trail = std::vector<GrooveStep>;

/// Trails in order, by their ends.
struct TrailEnds {
  Vec2 first, last;
  double gap;  ///< the square of the way to the next one
  std::uint32_t trail;
  bool turned;
};

/// Turns a run of trails around.
void turn(std::span<TrailEnds> order, std::size_t i, std::size_t j) {
  std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i),
               order.begin() + static_cast<std::ptrdiff_t>(j) + 1);
  for (std::size_t k = i; k <= j; ++k) {
    std::swap(order[k].first, order[k].last);
    order[k].turned = !order[k].turned;
  }
  for (std::size_t k = i == 0 ? 0 : i - 1; k <= j && k + 1 < order.size(); ++k)
    order[k].gap = squared_norm(order[k + 1].first - order[k].last);
}

/// Shortens the ways between trails: turns runs of up to `window` trails around where that helps
/// (2-opt), a few times over.
void shorten_ways(const Grooves& grooves, Vec2 start, std::vector<Trail>& trails) {
  constexpr std::size_t window = 150;
  constexpr int passes = 4;
  const auto place = [&](const GrooveStep& step, bool at_end) {
    const auto& disks = grooves.parts[step.part].disks;
    return (step.forward == at_end ? disks.back() : disks.front()).center;
  };
  std::vector<TrailEnds> order;
  for (std::uint32_t i = 0; i < trails.size(); ++i) {
    order.push_back({place(trails[i].front(), false), place(trails[i].back(), true), 0, i, false});
    if (i > 0) order[i - 1].gap = squared_norm(order[i].first - order[i - 1].last);
  }
  std::vector<bool> changed(order.size(), true), changes;
  for (int pass = 0; pass < passes && !order.empty(); ++pass) {
    changes.assign(order.size(), false);
    // What turns run i to j depends on those from i - 1 to j + 1. The next one that has changed
    // since i was looked at last, and where those end that have changed now.
    std::size_t next = 0, end = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      while (next < order.size() && (next + 1 < i || !changed[next])) ++next;
      if (end + 1 <= i && next > i + window) continue;
      const Vec2 before = i == 0 ? start : order[i - 1].last;
      double way = squared_norm(order[i].first - before);
      for (std::size_t j = i; j < std::min(order.size(), i + window); ++j) {
        // A turn that shortens neither of its two ways gains nothing.
        if (squared_norm(order[j].last - before) >= way &&
            (j + 1 == order.size() ||
             squared_norm(order[j + 1].first - order[i].first) >= order[j].gap))
          continue;
        double gain = distance(before, order[i].first) - distance(before, order[j].last);
        if (j + 1 < order.size())
          gain += distance(order[j].last, order[j + 1].first) -
                  distance(order[i].first, order[j + 1].first);
        if (!(gain > 1e-9 * distance(before, order[i].first))) continue;
        turn(order, i, j);
        std::fill(changes.begin() + static_cast<std::ptrdiff_t>(i),
                  changes.begin() + static_cast<std::ptrdiff_t>(j) + 1, true);
        end = std::max(end, j + 1);
        way = squared_norm(order[i].first - before);
      }
    }
    if (end == 0) break;
    changed.swap(changes);
  }
  std::vector<Trail> out;
  out.reserve(trails.size());
  for (const TrailEnds& ends : order) {
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
  std::vector<std::uint32_t> left(grooves.junctions), place_of(grooves.junctions);
  for (std::uint32_t j = 0; j < grooves.junctions; ++j)
    left[j] = static_cast<std::uint32_t>(around[j].size());
  std::vector<bool> done(parts.size(), false);
  std::vector<std::vector<GrooveStep>> trails;
  Vec2 at = start;
  // A trail that begins at a junction of odd degree ends at another one: there is no way to need
  // fewer. What then is left are closed trails.
  for (const bool odd : {true, false}) {
    std::vector<std::uint32_t> ends;
    for (std::uint32_t j = 0; j < grooves.junctions; ++j)
      if (odd ? left[j] % 2 == 1 : left[j] > 0) ends.push_back(j);
    std::vector<Box> boxes;
    for (const std::uint32_t j : ends) {
      place_of[j] = static_cast<std::uint32_t>(boxes.size());
      boxes.push_back({places[j], places[j]});
    }
    OpenBoxes open(std::move(boxes), true);
    while (!open.empty()) {
      const std::uint32_t nearest =
          open.nearest(at, [&](std::uint32_t i) { return squared_norm(places[ends[i]] - at); });
      open.erase(nearest);
      std::uint32_t j = ends[nearest];
      if (left[j] == 0) continue;
      auto& trail = trails.emplace_back();
      while (left[j] > 0) {
        auto& on = around[j];
        while (done[on.back().part]) on.pop_back();
        const End step = on.back();
        on.pop_back();
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
