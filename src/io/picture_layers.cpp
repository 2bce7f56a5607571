#include <array>

#include "io/picture_parts.h"

namespace medial::io {

namespace {

// Of layers, one after another: polygons have the first.
constexpr std::array<Color, 4> layer_colors{
    {{0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.80, 0.15, 0.20}, {0.00, 0.62, 0.45}}};

void trace(Pen& pen, const std::vector<Vec2>& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    i == 0 ? pen.move_to(pen.frame()(points[i])) : pen.line_to(pen.frame()(points[i]));
}

}  // namespace

void draw_polygons(Pen& pen, const LayerFile& file) {
  for (const Layer& layer : file.layers) {
    if (layer.kind != LayerKind::polygons) continue;
    for (const LayerFeature& feature : layer.features) {
      for (const auto& ring : feature.parts) {
        trace(pen, ring);
        pen.close();
      }
      pen.color(layer_colors[0], 0.35);
      pen.fill_even_odd(true);
      pen.color(layer_colors[0]);
      pen.line_width(0.8);
      pen.stroke();
    }
  }
}

void draw_lines_and_disks(Pen& pen, const LayerFile& file) {
  std::size_t kind = 0;
  for (const Layer& layer : file.layers) {
    if (layer.kind == LayerKind::polygons) continue;
    pen.color(layer_colors[++kind % layer_colors.size()]);
    for (const LayerFeature& feature : layer.features) {
      pen.line_width(1.2);
      if (layer.kind == LayerKind::lines) {
        trace(pen, feature.parts[0]);
      } else {
        pen.circle(pen.frame()(feature.parts[0][0]), feature.values[0] * pen.frame().scale);
      }
      pen.stroke();
    }
  }
}

}  // namespace medial::io
