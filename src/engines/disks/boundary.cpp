#include "engines/disks/boundary.h"

#include <algorithm>
#include <limits>

#include "base/predicates.h"

namespace medial::disks {
namespace {

/// A convex corner to start from: a flat one would leave the first disks undetermined, so the first
/// that turns by a sixth of a circle, or the one that turns most. The search starts in the middle
/// of the order: that shares the work well on shapes that were drawn from end to end.
template <class IsCorner>
std::uint32_t clear_corner(std::span<const Vec2> points, IsCorner&& is_corner) {
  constexpr double clear = 0.5;  // cosine of the turn
  const auto n = static_cast<std::uint32_t>(points.size());
  std::uint32_t best = 0;
  double best_cosine = 2;
  for (std::uint32_t step = 0; step < n; ++step) {
    const std::uint32_t i = (n / 2 + step) % n;
    if (!is_corner(i)) continue;
    const Vec2 before = points[i] - points[i == 0 ? n - 1 : i - 1];
    const Vec2 after = points[i + 1 == n ? 0 : i + 1] - points[i];
    const double cosine = dot(before, after) / (norm(before) * norm(after));
    if (cosine < best_cosine) {
      best_cosine = cosine;
      best = i;
    }
    if (cosine <= clear) break;
  }
  return best;
}

}  // namespace

SiteNumbers number_sites(const Shape& shape) {
  SiteNumbers numbers;
  numbers.segment.resize(shape.points.size());
  numbers.is_site.resize(shape.points.size());
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const std::span<const Vec2> points = shape.loop(loop);
    const std::size_t n = points.size(), begin = shape.loop_begin[loop];
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 before = points[i == 0 ? n - 1 : i - 1], after = points[i + 1 == n ? 0 : i + 1];
      const bool site = orientation(before, points[i], after) <= 0;
      numbers.is_site[begin + i] = site;
      if (site) ++numbers.count;
      numbers.segment[begin + i] = numbers.count++;
    }
  }
  return numbers;
}

std::vector<Site> result_sites(const Shape& shape, const SiteNumbers& numbers) {
  std::vector<Site> sites(numbers.count);
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const std::uint32_t begin = shape.loop_begin[loop], end = shape.loop_begin[loop + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const Vec2 p = shape.points[i], q = shape.points[i + 1 == end ? begin : i + 1];
      const VertexSource source = shape.sources[i];
      const std::uint32_t number = numbers.segment[i];
      sites[number] = {p, q, source.ring, source.vertex, SiteKind::segment};
      if (numbers.is_site[i])
        sites[number - 1] = {p, p, source.ring, source.vertex, SiteKind::vertex};
    }
  }
  return sites;
}

Boundary loops_boundary(const Shape& shape, const SiteNumbers& numbers, const Frame& frame) {
  Boundary boundary;
  boundary.sites.reserve(numbers.count);
  boundary.elements.reserve(numbers.count);
  boundary.originals.reserve(numbers.count);
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const std::span<const Vec2> points = shape.loop(loop);
    const std::uint32_t n = static_cast<std::uint32_t>(points.size());
    const std::uint32_t begin = shape.loop_begin[loop];
    std::uint32_t start = 0;
    if (shape.hole[loop]) {
      double furthest = -std::numeric_limits<double>::infinity();
      for (std::uint32_t i = 0; i < n; ++i) {
        if (!numbers.is_site[begin + i]) continue;
        const double here = dot(outreach, frame.to_local(points[i]));
        if (here > furthest) start = i;
        furthest = std::max(furthest, here);
      }
    } else {
      start = clear_corner(points, [&](std::uint32_t i) { return !numbers.is_site[begin + i]; });
    }
    const auto first = static_cast<std::uint32_t>(boundary.sites.size());
    Vec2 p = frame.to_local(points[start]);
    for (std::uint32_t step = 0; step < n; ++step) {
      const std::uint32_t i = start + step < n ? start + step : start + step - n;
      const Vec2 q = frame.to_local(points[i + 1 == n ? 0 : i + 1]);
      const std::uint32_t number = numbers.segment[begin + i];
      if (numbers.is_site[begin + i])
        boundary.add(geometry::make_vertex(p), Element::vertex, number - 1);
      boundary.add(geometry::make_segment(p, q), Element::segment, number);
      p = q;
    }
    boundary.runs.push_back({first, static_cast<std::uint32_t>(boundary.sites.size() - 1)});
  }
  return boundary;
}

}  // namespace medial::disks
