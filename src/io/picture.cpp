#include "io/picture.h"

#include <algorithm>
#include <cmath>

#include "io/picture_parts.h"

namespace medial::io {

namespace {

constexpr Color inside_color{0.945, 0.945, 0.925};

/// Draws what there is, from below: `diagrams` and `layers` may be null.
Status draw_picture(OutputStream& out, const std::string& format, const Document<AxisItem>& file,
                    const WriteOptions& options, const Document<VoronoiItem>* diagrams,
                    const LayerFile* layers = nullptr) {
  const Result<PictureFrame> frame = frame_for(box_of(file), options.width, file.y_down);
  if (!frame) return frame.error();
  double largest = 0, edges = 0;
  for (const AxisItem& item : file.items) {
    for (const Node& node : item.axis.nodes) largest = std::max(largest, node.disk.radius);
    edges += static_cast<double>(item.axis.edges.size());
  }
  // The more there is to see, the finer the lines: down to a third.
  constexpr double many_edges = 5000;
  const double fineness =
      std::clamp(std::pow(many_edges / std::max(edges, 1.0), 0.2), 1.0 / 3, 1.0);
  return write_surface(out, format, frame->width, frame->height, [&](cairo_t* context) {
    Pen pen(context, *frame, fineness);
    const auto outlines = [&] {
      if (!options.shape) return;
      pen.color(outline_color);
      pen.line_width(0.8);
      for (const AxisItem& item : file.items) pen.stroke_shape(item.shape);
    };
    if (options.shape)
      for (const AxisItem& item : file.items) pen.fill_shape(item.shape, inside_color);
    outlines();
    if (layers != nullptr) draw_polygons(pen, *layers);
    if (diagrams != nullptr) {
      draw_faces(pen, *diagrams);
      outlines();
      if (options.shape) draw_sites(pen, *diagrams);
    }
    if (options.disks > 0) draw_disks(pen, file, options.disks);
    if (options.contacts) draw_contacts(pen, file);
    draw_axes(pen, file, largest);
    if (layers != nullptr) draw_lines_and_disks(pen, *layers);
    if (options.nodes) draw_nodes(pen, file);
    if (options.titles) draw_titles(pen, file);
  });
}

}  // namespace

Status write_picture(OutputStream& out, const std::string& format, const Document<AxisItem>& file,
                     const WriteOptions& options) {
  return draw_picture(out, format, file, options, nullptr);
}

Status write_layers_picture(OutputStream& out, const std::string& format, const LayerFile& file,
                            const Document<AxisItem>& background, const WriteOptions& options) {
  return draw_picture(out, format, background, options, nullptr, &file);
}

Status write_voronoi_picture(OutputStream& out, const std::string& format,
                             const Document<VoronoiItem>& file, const WriteOptions& options) {
  // Less its spokes, the diagram is the axis.
  Document<AxisItem> axes;
  axes.y_down = file.y_down;
  for (const VoronoiItem& item : file.items) {
    AxisItem& own = axes.items.emplace_back();
    own.shape = item.shape;
    own.axis.sites = item.diagram.sites;
    own.axis.nodes = item.diagram.nodes;
    for (const VoronoiEdge& edge : item.diagram.edges)
      if (!edge.spoke && !edge.frame) own.axis.edges.push_back(edge);
  }
  return draw_picture(out, format, axes, options, &file);
}

}  // namespace medial::io
