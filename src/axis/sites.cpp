#include "axis/sites.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numbers>

#include "base/memory.h"
#include "base/predicates.h"
#include "base/tolerance.h"

namespace medial::sites {
namespace {

using geometry::Joint;

Joint joint_at(const Loop& loop, std::uint32_t i, double tolerance, double corner_angle) {
  const std::uint32_t before = loop.before(i), after = loop.next(i);
  const Vec2 p = loop.point(before), q = loop.point(i), r = loop.point(after);
  if (loop.bulge(before) == 0 && loop.bulge(i) == 0)
    return orientation(p, q, r) > 0 ? Joint::corner : Joint::reflex;
  return geometry::joint_of({p, q, loop.bulge(before)}, {q, r, loop.bulge(i)}, tolerance,
                            corner_angle);
}

/// Calls work(loop, first, last) in parallel for parts of the loops that together are all points.
template <class Work>
void in_parts(const Shape& shape, Work&& work) {
  constexpr std::size_t grain = 4096;
  const std::vector<std::uint32_t>& begin = shape.loop_begin;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, shape.points.size(), grain), [&](const auto& range) {
        const auto after = std::upper_bound(begin.begin(), begin.end(), range.begin());
        auto loop = static_cast<std::size_t>(after - begin.begin()) - 1;
        for (auto i = static_cast<std::uint32_t>(range.begin()); i < range.end(); ++loop) {
          const auto end =
              static_cast<std::uint32_t>(std::min<std::size_t>(range.end(), begin[loop + 1]));
          work(loop, i - begin[loop], end - begin[loop]);
          i = end;
        }
      });
}

}  // namespace

Pieces pieces_of(Vec2 start, Vec2 end, double bulge) {
  if (bulge == 0) return {{geometry::make_segment(start, end)}, 1};
  if (std::abs(bulge) <= geometry::largest_bulge)
    return {{geometry::make_arc(start, end, bulge)}, 1};
  const Vec2 middle = apex({start, end, bulge});
  const double half = half_bulge(bulge);
  return {{geometry::make_arc(start, middle, half), geometry::make_arc(middle, end, half)}, 2};
}

SiteNumbers number_sites(const Shape& shape, const Frame& frame, double corner_angle) {
  SiteNumbers numbers;
  numbers.edge.resize(shape.points.size());
  numbers.joints.resize(shape.points.size());
  const double tolerance = tolerance_for(bounding_box(shape), 0);
  const double radians = corner_angle * std::numbers::pi / 180;
  in_parts(shape, [&](std::size_t l, std::uint32_t first, std::uint32_t last) {
    const Loop loop(shape, l, frame);
    for (std::uint32_t i = first; i < last; ++i)
      numbers.joints[loop.begin() + i] = joint_at(loop, i, tolerance, radians);
  });
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    numbers.count += numbers.is_site(i) ? 1 : 0;
    numbers.edge[i] = numbers.count++;
  }
  return numbers;
}

std::vector<Site> result_sites(const Shape& shape, const SiteNumbers& numbers) {
  std::vector<Site> sites;
  reserve_large(sites, numbers.count);
  sites.resize(numbers.count);
  in_parts(shape, [&](std::size_t loop, std::uint32_t first, std::uint32_t last) {
    const std::uint32_t begin = shape.loop_begin[loop], end = shape.loop_begin[loop + 1];
    for (std::uint32_t i = begin + first; i < begin + last; ++i) {
      const Vec2 p = shape.points[i], q = shape.points[i + 1 == end ? begin : i + 1];
      const VertexSource source = shape.sources[i];
      const double bulge = shape.bulge(i);
      const std::uint32_t number = numbers.edge[i];
      sites[number] = {
          p, q, source.ring, source.vertex, bulge == 0 ? SiteKind::segment : SiteKind::arc, bulge};
      if (numbers.is_site(i))
        sites[number - 1] = {p, p, source.ring, source.vertex, SiteKind::vertex};
    }
  });
  return sites;
}

}  // namespace medial::sites
