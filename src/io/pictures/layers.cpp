#include <array>

#include "io/pictures/pictures.h"

namespace medial::io {

namespace {

// Of layers, one after another: polygons have the first.
constexpr std::array<Color, 4> layer_colors{
    {{0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.80, 0.15, 0.20}, {0.00, 0.62, 0.45}}};

}  // namespace

void draw_polygons(Canvas& canvas, const Document<Layer>& layers) {
  for (const Layer& layer : layers.items) {
    if (layer.kind != LayerKind::polygons) continue;
    for (const LayerFeature& feature : layer.features) {
      for (const auto& ring : feature.parts) {
        canvas.trace(std::span<const Vec2>(ring));
        canvas.close();
      }
      canvas.color(layer_colors[0], 0.35);
      canvas.fill_even_odd(true);
      canvas.color(layer_colors[0]);
      canvas.line_width(0.8);
      canvas.stroke();
    }
  }
}

void draw_lines_and_disks(Canvas& canvas, const Document<Layer>& layers) {
  std::size_t kind = 0;
  for (const Layer& layer : layers.items) {
    if (layer.kind == LayerKind::polygons) continue;
    canvas.color(layer_colors[++kind % layer_colors.size()]);
    for (const LayerFeature& feature : layer.features) {
      canvas.line_width(1.2);
      if (layer.kind == LayerKind::lines) {
        canvas.trace(std::span<const Vec2>(feature.parts[0]));
      } else {
        canvas.circle(feature.parts[0][0], feature.values[0]);
      }
      canvas.stroke();
    }
  }
}

}  // namespace medial::io
