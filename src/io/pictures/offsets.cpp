#include <algorithm>
#include <cmath>

#include "io/pictures/pictures.h"
#include "io/ring_text.h"

namespace medial::io {

namespace {

void draw_source(Canvas& canvas, const OffsetItem& item, double dot) {
  constexpr Color inside{0.93, 0.93, 0.95}, outline{0.25, 0.25, 0.3};
  canvas.color(inside);
  canvas.trace(item.shape);
  canvas.fill_even_odd();
  canvas.color(outline);
  canvas.line_width(1.2);
  canvas.trace(item.shape);
  const auto& points = item.planar_graph.points;
  for (const PlanarGraphEdge& edge : item.planar_graph.edges)
    canvas.trace(Ring{{points[edge.from], points[edge.to]}, RingRole::any, {edge.bulge, 0}}, false);
  canvas.stroke();
  for (const LonePoint& lone : item.planar_graph.lone_points) {
    canvas.circle(points[lone.point], dot);
    canvas.fill();
  }
}

}  // namespace

Status write_picture(Target& target, const OffsetsOutput& output) {
  const auto& items = output.document.items;
  Extent extent;
  double deepest = 0;
  for (const OffsetItem& item : items) {
    Box own = box_of(item);
    double reach = 0;
    for (const OffsetRegion& region : item.offsets.regions) {
      reach = std::max(reach, -region.clearance);
      deepest = std::max(deepest, std::abs(region.clearance));
    }
    own = {own.low - Vec2{reach, reach}, own.high + Vec2{reach, reach}};
    extent.add(own);
  }
  const Box box = extent.box();
  const auto draw = [&](Canvas& canvas) {
    if (output.options.shape)
      for (const OffsetItem& item : items) draw_source(canvas, item, 2e-3 * diagonal(box));
    canvas.line_width(1);
    for (const OffsetItem& item : items) {
      for (const OffsetRegion& region : item.offsets.regions) {
        canvas.color(shade(static_cast<int>(
            std::lround(std::abs(region.clearance) / deepest * (shade_count - 1)))));
        for (const Ring& ring : region.rings) {
          canvas.trace(ring);
          canvas.stroke();
        }
      }
    }
  };
  return write_canvas(target, box, output.options.width, output.document.y_down, draw);
}

}  // namespace medial::io
