#include <algorithm>
#include <cmath>
#include <vector>

#include "io/pictures/pictures.h"

namespace medial::io {

namespace {

/// Draws what there is, from below: `diagrams` and `layers` may be null.
Status draw_picture(Target& target, const Document<AxisItem>& file, const WriteOptions& options,
                    const Document<VoronoiItem>* diagrams, const Document<Layer>* layers) {
  double largest = 0, edges = 0;
  for (const AxisItem& item : file.items) {
    for (const Node& node : item.axis.nodes) largest = std::max(largest, node.disk.radius);
    edges += static_cast<double>(item.axis.edges.size());
  }
  // The more there is to see, the finer the lines: down to a third.
  constexpr double many_edges = 5000;
  const double fineness =
      std::clamp(std::pow(many_edges / std::max(edges, 1.0), 0.2), 1.0 / 3, 1.0);
  const auto draw = [&](Canvas& canvas) {
    constexpr Color inside{0.945, 0.945, 0.925};
    constexpr double outline_width = 0.8;
    std::vector<const Shape*> shapes;
    if (options.shape)
      for (const AxisItem& item : file.items) shapes.push_back(&item.shape);
    canvas.line_width(outline_width);
    canvas.draw_shapes(shapes, inside, outline_color);
    if (layers != nullptr) draw_polygons(canvas, *layers);
    if (diagrams != nullptr) {
      draw_faces(canvas, *diagrams);
      canvas.line_width(outline_width);
      canvas.stroke_shapes(shapes, outline_color);
      if (options.shape) draw_sites(canvas, *diagrams);
    }
    if (options.disks > 0) draw_disks(canvas, file, options.disks);
    if (options.contacts) draw_feet(canvas, file);
    draw_axes(canvas, file, largest);
    if (layers != nullptr) draw_lines_and_disks(canvas, *layers);
    if (layers != nullptr) draw_numbers(canvas, file, *layers);
    if (options.nodes) draw_nodes(canvas, file);
    if (options.titles) draw_titles(canvas, file);
  };
  return write_canvas(target, box_of(file), options.width, file.y_down, draw, fineness);
}

}  // namespace

Status write_picture(Target& target, const AxesOutput& output) {
  return draw_picture(target, output.document, output.options, nullptr, nullptr);
}

Status write_picture(Target& target, const ShapesOutput& output) {
  Document<AxisItem> axes{output.document, {}};
  for (const ShapeItem& item : output.document.items) axes.items.push_back({item.shape, {}, {}});
  return draw_picture(target, axes, output.options, nullptr, nullptr);
}

Status write_picture(Target& target, const LayersOutput& output) {
  return draw_picture(target, output.background, output.options, nullptr, &output.document);
}

Status write_picture(Target& target, const VoronoiOutput& output) {
  // Less its spokes, the diagram is the axis.
  Document<AxisItem> axes{output.document, {}};
  for (const VoronoiItem& item : output.document.items) {
    AxisItem& own = axes.items.emplace_back();
    own.shape = item.shape;
    own.axis.sites = item.diagram.sites;
    own.axis.nodes = item.diagram.nodes;
    for (const VoronoiEdge& edge : item.diagram.edges)
      if (!edge.spoke && !edge.on_enclosure) own.axis.edges.push_back(edge);
  }
  return draw_picture(target, axes, output.options, &output.document, nullptr);
}

Format with_pictures(Format format) {
  Writer<ShapesOutput> shapes = std::get<Writer<ShapesOutput>>(format.writers);
  if (shapes == nullptr) shapes = write_picture;
  return format.writes<AxesOutput, ShapesOutput, VoronoiOutput, LayersOutput, OffsetsOutput,
                       CarvingOutput, FeaturesOutput, FieldOutput>(
      write_picture, shapes, write_picture, write_picture, write_picture, write_picture,
      write_picture, write_picture);
}

}  // namespace medial::io
