#include "axis/sites.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "base/memory.h"
#include "base/predicates.h"
#include "base/threads.h"
#include "medial/query.h"
#include "site/bisector.h"

namespace medial::site {
namespace {

Joint joint_at(const LoopEdges& loop, std::uint32_t i, double tolerance, double corner_angle) {
  if (loop.turns_back(i)) return Joint::reflex;
  const std::uint32_t before = loop.before(i), after = loop.next(i);
  const Vec2 p = loop.point(before), q = loop.point(i), r = loop.point(after);
  if (loop.bulge(before) == 0 && loop.bulge(i) == 0)
    return orientation(p, q, r) > 0 ? Joint::corner : Joint::reflex;
  return joint_of({p, q, loop.bulge(before)}, {q, r, loop.bulge(i)}, tolerance, corner_angle);
}

}  // namespace

Pieces pieces_of(Vec2 start, Vec2 end, double bulge) {
  if (bulge == 0) return {{make_segment(start, end)}, 1};
  if (std::abs(bulge) <= largest_bulge) return {{make_arc(start, end, bulge)}, 1};
  const Vec2 middle = apex({start, end, bulge});
  const double half = half_bulge(bulge);
  return {{make_arc(start, middle, half), make_arc(middle, end, half)}, 2};
}

std::vector<site::Site> edge_sites(const Shape& shape, const LocalFrame& frame) {
  std::vector<site::Site> edges;
  reserve_large(edges, shape.points.size());
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const LoopEdges loop(shape, i, frame);
    for (std::uint32_t k = 0; k < loop.size(); ++k) {
      if (loop.bulge(k) == 0) {
        edges.push_back(make_segment(loop.local(k), loop.local(loop.next(k))));
        continue;
      }
      const Pieces pieces = loop.edge(k);
      for (std::size_t j = 0; j < pieces.count; ++j) edges.push_back(pieces.site[j]);
    }
  }
  return edges;
}

SiteNumbers number_sites(const Shape& shape, const LocalFrame& frame, double tolerance,
                         double corner_angle) {
  SiteNumbers numbers;
  numbers.edge.resize(shape.points.size());
  numbers.joints.resize(shape.points.size());
  const double radians = corner_angle * std::numbers::pi / 180;
  constexpr std::size_t grain = 4096;
  parallel_ranges(shape.points.size(), grain, [&](std::size_t i, std::size_t end) {
    const auto after = std::upper_bound(shape.loop_begin.begin(), shape.loop_begin.end(), i);
    auto l = static_cast<std::size_t>(after - shape.loop_begin.begin()) - 1;
    for (; i < end; ++l) {
      const LoopEdges loop(shape, l, frame);
      for (; i < std::min<std::size_t>(end, loop.begin() + loop.size()); ++i)
        numbers.joints[i] =
            joint_at(loop, static_cast<std::uint32_t>(i) - loop.begin(), tolerance, radians);
    }
  });
  count_sites(shape, numbers);
  return numbers;
}

void count_sites(const Shape& shape, SiteNumbers& numbers) {
  numbers.count = 0;
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const std::size_t begin = shape.loop_begin[loop], end = shape.loop_begin[loop + 1];
    for (std::size_t i = begin; i < end; ++i) {
      numbers.count += numbers.is_site(i) ? 1 : 0;
      numbers.edge[i] = numbers.count;
      if (end - begin > 1) ++numbers.count;
    }
  }
}

std::size_t point_of(const SiteNumbers& numbers, std::uint32_t site, std::size_t near) {
  const std::vector<std::uint32_t>& edge = numbers.edge;
  std::size_t low = near, high = near;
  for (std::size_t step = 1; low > 0 && edge[low - 1] >= site; step *= 2)
    low -= std::min(low, step);
  for (std::size_t step = 1; high < edge.size() && edge[high] < site; step *= 2)
    high = std::min(edge.size(), high + step);
  const auto at = [&](std::size_t i) { return edge.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto point =
      static_cast<std::size_t>(std::lower_bound(at(low), at(high), site) - edge.begin());
  // A lone point has no edge, so this is also the first number of the next point.
  const std::size_t after = point + 1;
  const bool is_of_next =
      after < edge.size() && edge[point] == site && numbers.first(after) == site;
  return is_of_next ? after : point;
}

medial::Site result_site(const Shape& shape, const SiteNumbers& numbers, std::uint32_t site,
                         std::size_t point) {
  const auto [ring, vertex] = shape.sources[point];
  const Vec2 p = shape.points[point];
  if (site < numbers.edge[point]) return {p, p, ring, vertex};
  const auto& begin = shape.loop_begin;
  const auto loop = std::upper_bound(begin.begin(), begin.end(), point);
  const Vec2 q = shape.points[point + 1 == *loop ? *(loop - 1) : point + 1];
  const double bulge = shape.bulge(point);
  return {p, q, ring, vertex, bulge};
}

std::vector<medial::Site> result_sites(const Shape& shape, const SiteNumbers& numbers,
                                       std::size_t first, std::size_t last) {
  const auto first_number = [&](std::size_t point) {
    return point < numbers.edge.size() ? numbers.first(point) : numbers.count;
  };
  const std::uint32_t base = first_number(first);
  auto sites = large_vector<medial::Site>(first_number(last) - base);
  const auto& begins = shape.loop_begin;
  constexpr std::size_t grain = 4096;
  parallel_ranges(last - first, grain, [&](std::size_t i, std::size_t stop) {
    i += first;
    stop += first;
    auto next = std::upper_bound(begins.begin(), begins.end(), i);  // loop
    for (medial::Site* site = sites.data() + (first_number(i) - base); i < stop; ++i) {
      while (*next <= i) ++next;
      const std::size_t begin = *(next - 1), end = *next;
      const Vec2 p = shape.points[i], q = shape.points[i + 1 == end ? begin : i + 1];
      const auto [ring, vertex] = shape.sources[i];
      if (numbers.is_site(i)) *site++ = {p, p, ring, vertex};
      if (end - begin > 1) *site++ = {p, q, ring, vertex, shape.bulge(i)};
    }
  });
  return sites;
}

std::vector<medial::Site> result_sites(const Shape& shape, const SiteNumbers& numbers) {
  return result_sites(shape, numbers, 0, shape.points.size());
}

}  // namespace medial::site

namespace medial {
namespace {

/// A site of the result in a frame. For an arc in two pieces, the piece nearer to `center`.
site::Site local_site(const Site& own, const LocalFrame& frame, Vec2 center) {
  if (own.kind() == SiteKind::vertex) return site::make_vertex(frame.to_local(own.start));
  const site::Pieces pieces =
      site::pieces_of(frame.to_local(own.start), frame.to_local(own.end), own.bulge);
  const bool is_first =
      squared_distance(pieces.first(), center) <= squared_distance(pieces.last(), center);
  return is_first ? pieces.first() : pieces.last();
}

}  // namespace

Edge conic_of(const MedialAxis& axis, const Edge& edge) {
  if (edge.site[0] == no_site || edge.site[1] == no_site) return edge;
  Box box = Box::nothing();
  for (const std::uint32_t i : edge.site)
    for (const Vec2 p : {axis.sites[i].start, axis.sites[i].end}) box.add(p);
  for (const std::uint32_t i : edge.node) box.add(axis.nodes[i].disk.center);
  const LocalFrame frame = frame_of(box);
  const auto disk_of = [&](std::uint32_t node) -> Disk {
    const Disk& own = axis.nodes[node].disk;
    return {frame.to_local(own.center), frame.scale * own.radius};
  };
  const Disk from = disk_of(edge.node[0]), to = disk_of(edge.node[1]);
  const auto site_of = [&](std::uint32_t site) {
    return local_site(axis.sites[site], frame, from.center);
  };
  const site::Control control =
      site::control_of(site_of(edge.site[0]), site_of(edge.site[1]), from, to);
  Edge curved = edge;
  curved.control = {frame.to_input(control.point.center), frame.inverse * control.point.radius};
  curved.weight = control.weight;
  return curved;
}

}  // namespace medial
