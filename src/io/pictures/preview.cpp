#include <algorithm>
#include <cmath>
#include <limits>

#include "io/pictures/pictures.h"
#include "medial/query.h"

namespace medial::io {

namespace {

/// Where the panels lie: in as many columns as make the whole about four by three.
struct Layout {
  Box box;  ///< of the shapes
  std::size_t columns = 1;
  Vec2 pitch;  ///< from panel to panel
  double text = 0;

  Layout(std::span<const Shape> shapes, std::size_t panels, double up) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Extent extent;
    for (const Shape& shape : shapes) extent.add(shape);
    box = extent.box();
    const Vec2 size = box.high - box.low;
    const double longer = std::max(size.x, size.y);
    pitch = {size.x + 0.08 * longer, up * (size.y + 0.16 * longer)};
    double best = infinity;
    for (std::size_t k = 1; k <= panels; ++k) {
      const double rows = std::ceil(static_cast<double>(panels) / static_cast<double>(k));
      const double aspect = static_cast<double>(k) * pitch.x / (rows * std::abs(pitch.y));
      const double miss = std::abs(std::log(aspect * 3 / 4));
      if (miss < best) columns = k, best = miss;
    }
  }
  Vec2 shift(std::size_t panel) const {
    return {static_cast<double>(panel % columns) * pitch.x,
            -static_cast<double>(panel / columns) * pitch.y};
  }
};

void draw_panel(Canvas& canvas, std::span<const Shape> shapes, const PreviewPanel& panel,
                Vec2 shift, double step) {
  constexpr Color inside{0.945, 0.945, 0.925}, outline{0.6, 0.6, 0.62}, axis_color{0.1, 0.25, 0.5};
  for (Shape shape : shapes) {
    for (Vec2& p : shape.points) p = p + shift;
    canvas.color(inside);
    canvas.trace(shape);
    canvas.fill_even_odd();
    canvas.color(outline);
    canvas.line_width(0.4);
    canvas.trace(shape);
    canvas.stroke();
  }
  canvas.color(axis_color);
  canvas.line_width(1.1);
  for (const MedialAxis& axis : panel.axes) {
    for (const Branch& branch : branches(axis)) {
      std::vector<Vec2> line;
      for (const Step& along : branch.steps) {
        std::vector<Disk> disks = sample_by_chord(axis, axis.edges[along.edge], 0.2 * step);
        if (!along.forward) std::reverse(disks.begin(), disks.end());
        for (const Disk& disk : disks) {
          const Vec2 p = disk.center + shift;
          const bool last = &disk == &disks.back();
          if (line.empty() || last || distance(line.back(), p) >= step) line.push_back(p);
        }
      }
      canvas.trace(std::span<const Vec2>(line));
    }
    canvas.stroke();
  }
}

}  // namespace

Status write_picture(Target& target, const PreviewOutput& output) {
  const double up = output.y_down ? -1 : 1;
  const Layout layout(output.shapes, output.panels.size(), up);
  const Vec2 size = layout.box.high - layout.box.low;
  const double longer = std::max(size.x, size.y);
  const std::size_t rows = (output.panels.size() + layout.columns - 1) / layout.columns;
  const double down = (static_cast<double>(rows) - 1) * std::abs(layout.pitch.y) + 0.12 * longer;
  Box box = layout.box;
  box.high.x += (static_cast<double>(layout.columns) - 1) * layout.pitch.x;
  (output.y_down ? box.high.y : box.low.y) += up * -down;
  const double step = (box.high.x - box.low.x) / output.width / 2;
  const auto draw = [&](Canvas& canvas) {
    for (std::size_t i = 0; i < output.panels.size(); ++i) {
      const Vec2 shift = layout.shift(i);
      draw_panel(canvas, output.shapes, output.panels[i], shift, step);
      const double below =
          output.y_down ? layout.box.high.y + 0.09 * longer : layout.box.low.y - 0.09 * longer;
      canvas.color({0, 0, 0});
      canvas.text(Vec2{layout.box.low.x, below} + shift, 22, output.panels[i].title);
    }
  };
  return write_canvas(target, box, output.width, output.y_down, draw);
}

}  // namespace medial::io
