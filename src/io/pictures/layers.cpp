#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "io/pictures/labels.h"
#include "io/pictures/pictures.h"

namespace medial::io {

namespace {

// Layers get these colours in turn; polygons have the first.
constexpr std::array<Color, 4> layer_colors{
    {{0.00, 0.45, 0.70}, {0.84, 0.37, 0.00}, {0.80, 0.15, 0.20}, {0.00, 0.62, 0.45}}};

/// Four digits, and of longer numbers those before the point: 3.142, 42613.
std::string short_number(double value) {
  const bool longer = std::abs(value) >= 1e4 && std::abs(value) < 1e15;
  return longer ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

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

void draw_numbers(Canvas& canvas, const Document<AxisItem>& file, const Document<Layer>& layers) {
  constexpr double letters = 13;  // thousandths of the picture's longer side
  constexpr int most = 200;
  Labels labels(canvas, canvas.thickness(letters));
  const auto line = [&](Vec2 a, Vec2 b) {
    labels.avoid(canvas.viewport()(a), canvas.viewport()(b));
  };
  for (const AxisItem& item : file.items)
    for (std::size_t i = 0; i < item.shape.loop_count(); ++i)
      for (std::uint32_t k = item.shape.loop_begin[i]; k < item.shape.loop_begin[i + 1]; ++k)
        line(item.shape.points[k],
             item.shape
                 .points[k + 1 < item.shape.loop_begin[i + 1] ? k + 1 : item.shape.loop_begin[i]]);
  for (const AxisItem& item : file.items)
    for (const Edge& edge : item.axis.edges)
      line(item.axis.nodes[edge.node[0]].disk.center, item.axis.nodes[edge.node[1]].disk.center);
  std::size_t kind = 0;
  int count = 0;
  for (const Layer& layer : layers.items) {
    if (layer.kind == LayerKind::polygons) continue;
    const Color& color = layer_colors[++kind % layer_colors.size()];
    if (!layer.label) continue;
    for (const LayerFeature& feature : layer.features) {
      const std::vector<Vec2>& part = feature.parts[0];
      const Vec2 at = canvas.viewport()(midpoint(part.front(), part.back()));
      const std::string number = short_number(feature.values[*layer.label]);
      if (count < most && labels.put(at, number, color)) ++count;
    }
  }
}

}  // namespace medial::io
