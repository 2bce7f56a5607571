#include "axis/sites.h"

#include "base/predicates.h"

namespace medial::sites {
namespace {

using geometry::Joint;

/// The joint at point i, between the edge that ends there and the one that begins there.
Joint joint_at(const Loop& loop, std::uint32_t i, const Pieces& before, const Pieces& after,
               double corner_angle) {
  if (before.last().is_arc() || after.first().is_arc())
    return geometry::joint_of(before.last(), after.first(), corner_angle);
  const bool convex =
      orientation(loop.point(loop.before(i)), loop.point(i), loop.point(loop.next(i))) > 0;
  return convex ? Joint::corner : Joint::reflex;
}

}  // namespace

Pieces pieces_of(Vec2 start, Vec2 end, double bulge) {
  if (bulge == 0) return {{geometry::make_segment(start, end)}, 1};
  if (std::abs(bulge) <= geometry::largest_bulge)
    return {{geometry::make_arc(start, end, bulge)}, 1};
  const Vec2 middle = midpoint(start, end) - (0.5 * bulge) * left_of(end - start);
  const double half = bulge / (1 + std::sqrt(1 + bulge * bulge));
  return {{geometry::make_arc(start, middle, half), geometry::make_arc(middle, end, half)}, 2};
}

SiteNumbers number_sites(const Shape& shape, const Frame& frame, double corner_angle) {
  SiteNumbers numbers;
  numbers.edge.resize(shape.points.size());
  numbers.joints.resize(shape.points.size());
  for (std::size_t l = 0; l < shape.loop_count(); ++l) {
    const Loop loop(shape, l, frame);
    const bool has_arcs = !shape.bulges.empty();
    Pieces before = has_arcs ? loop.edge(loop.size() - 1) : Pieces{};
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      const Pieces after = has_arcs ? loop.edge(i) : Pieces{};
      const Joint joint = joint_at(loop, i, before, after, corner_angle);
      before = after;
      numbers.joints[loop.begin() + i] = joint;
      if (joint == Joint::reflex) ++numbers.count;
      numbers.edge[loop.begin() + i] = numbers.count++;
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
      const double bulge = shape.bulge(i);
      const std::uint32_t number = numbers.edge[i];
      sites[number] = {
          p, q, source.ring, source.vertex, bulge == 0 ? SiteKind::segment : SiteKind::arc, bulge};
      if (numbers.is_site(i))
        sites[number - 1] = {p, p, source.ring, source.vertex, SiteKind::vertex};
    }
  }
  return sites;
}

}  // namespace medial::sites
