#include "shape/around.h"

#include <algorithm>
#include <vector>

#include "base/spatial_order.h"
#include "shape/clean.h"

namespace medial {

Shape around(const Soup& soup, const Box& frame) {
  Shape shape;
  const std::size_t count = 4 + soup.half_edges.size() + soup.lone_points.size();
  const bool has_arcs = std::any_of(soup.edges.begin(), soup.edges.end(),
                                    [](const SoupEdge& edge) { return edge.bulge != 0; });
  shape.points.reserve(count);
  shape.sources.reserve(count);
  if (has_arcs) shape.bulges.reserve(count);
  const auto add_point = [&](Vec2 point, double bulge, VertexSource source) {
    shape.points.push_back(point);
    shape.sources.push_back(source);
    if (has_arcs) shape.bulges.push_back(bulge);
  };
  const auto add_loop = [&](std::uint32_t face, bool hole) {
    shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
    shape.component.push_back(face);
    shape.hole.push_back(hole);
  };
  const auto add_loop_of = [&](std::uint32_t i) {
    add_loop(soup.face[i], soup.hole[i]);
    for (std::uint32_t k = soup.loop_begin[i]; k < soup.loop_begin[i + 1]; ++k) {
      const std::uint32_t h = soup.half_edges[k], from = soup.start(h);
      add_point(soup.points[from], soup.bulge(h), {from, h});
    }
  };

  add_loop(0, false);
  for (const Vec2 corner :
       {frame.low, Vec2{frame.high.x, frame.low.y}, frame.high, Vec2{frame.low.x, frame.high.y}})
    add_point(corner, 0, {no_index, no_index});
  // Faces count from 1 in the order of their outer loops.
  std::vector<std::uint32_t> holes;
  for (std::uint32_t i = 0; i < soup.loop_count(); ++i) {
    if (soup.hole[i])
      holes.push_back(i);
    else
      add_loop_of(i);
  }
  std::vector<Vec2> places;
  places.reserve(holes.size() + soup.lone_points.size());
  for (const std::uint32_t i : holes)
    places.push_back(soup.points[soup.start(soup.half_edges[soup.loop_begin[i]])]);
  for (const LonePoint& lone : soup.lone_points) places.push_back(soup.points[lone.point]);
  for (const std::uint32_t i : z_order(places)) {
    if (i < holes.size()) {
      add_loop_of(holes[i]);
      continue;
    }
    const LonePoint& lone = soup.lone_points[i - holes.size()];
    add_loop(lone.face, true);
    add_point(soup.points[lone.point], 0, {lone.point, no_index});
  }
  shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
  return shape;
}

}  // namespace medial
