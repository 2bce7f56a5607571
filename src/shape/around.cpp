#include "shape/around.h"

#include <algorithm>
#include <vector>

#include "base/spatial_order.h"
#include "shape/clean.h"

namespace medial {

Shape around(const PlanarGraph& planar_graph, const Box& enclosure) {
  Shape shape;
  const std::size_t count = 4 + planar_graph.half_edges.size() + planar_graph.lone_points.size();
  const bool has_arcs = std::any_of(planar_graph.edges.begin(), planar_graph.edges.end(),
                                    [](const PlanarGraphEdge& edge) { return edge.bulge != 0; });
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
    add_loop(planar_graph.face[i], planar_graph.hole[i]);
    for (std::uint32_t k = planar_graph.loop_begin[i]; k < planar_graph.loop_begin[i + 1]; ++k) {
      const std::uint32_t h = planar_graph.half_edges[k], from = start_of(planar_graph, h);
      add_point(planar_graph.points[from], bulge_of(planar_graph, h), {from, h});
    }
  };

  add_loop(0, false);
  for (const Vec2 corner : {enclosure.low, Vec2{enclosure.high.x, enclosure.low.y}, enclosure.high,
                            Vec2{enclosure.low.x, enclosure.high.y}})
    add_point(corner, 0, {no_index, no_index});
  // Faces count from 1 in the order of their outer loops.
  std::vector<std::uint32_t> holes;
  for (std::uint32_t i = 0; i < planar_graph.loop_count(); ++i) {
    if (planar_graph.hole[i])
      holes.push_back(i);
    else
      add_loop_of(i);
  }
  std::vector<Vec2> places;
  places.reserve(holes.size() + planar_graph.lone_points.size());
  for (const std::uint32_t i : holes)
    places.push_back(planar_graph.points[start_of(
        planar_graph, planar_graph.half_edges[planar_graph.loop_begin[i]])]);
  for (const LonePoint& lone : planar_graph.lone_points)
    places.push_back(planar_graph.points[lone.point]);
  for (const std::uint32_t i : z_order(places)) {
    if (i < holes.size()) {
      add_loop_of(holes[i]);
      continue;
    }
    const LonePoint& lone = planar_graph.lone_points[i - holes.size()];
    add_loop(lone.face, true);
    add_point(planar_graph.points[lone.point], 0, {lone.point, no_index});
  }
  shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
  return shape;
}

}  // namespace medial
