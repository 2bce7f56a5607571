#include <algorithm>
#include <array>

#include "io/pictures/cut_surface.h"
#include "io/pictures/pictures.h"
#include "io/tool_paths.h"

namespace medial::io {

namespace {

/// Tabs, where paths rise, are drawn above the cut.
double lowest_of(const ToolPath& path) {
  return std::ranges::min_element(path.points, {}, &ToolPoint::z)->z;
}

using Walls = std::vector<std::vector<const ToolPath*>>;  // of each pass

Walls walls_of(const Carving& carving) {
  Walls walls;
  for (const ToolPath& path : carving.paths) {
    if (path.kind != ToolPathKind::wall) continue;
    walls.resize(std::max<std::size_t>(walls.size(), path.pass + 1));
    walls[path.pass].push_back(&path);
  }
  return walls;
}

/// Adds the part of a groove that is deeper than a level: around each move as much as the cone is
/// wide there.
void add_groove(Canvas& canvas, const Carving& carving, const ToolPath& path, double depth) {
  const auto wide = [&carving](double over) {
    return over >= 0 ? carving.tip_radius + carving.slope * over : 0;
  };
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const ToolPoint &from = path.points[i], &to = path.points[i + 1];
    const double over0 = -from.z - depth, over1 = -to.z - depth;
    if (!(over0 > 0 || over1 > 0)) continue;
    // Where the move rises through the level the cut ends before it does.
    const double share0 = over0 < 0 ? over0 / (over0 - over1) : 0;
    const double share1 = over1 < 0 ? over0 / (over0 - over1) : 1;
    canvas.tapered(from.point + share0 * (to.point - from.point), wide(over0),
                   from.point + share1 * (to.point - from.point), wide(over1));
  }
}

/// What an end mill has cleared before, down to a level.
void fill_cleared(Canvas& canvas, const Carving& clearing, double depth) {
  canvas.width_in_units(2 * clearing.tip_radius);
  for (const ToolPath& path : clearing.paths) {
    if (!(lowest_of(path) < -depth)) continue;
    canvas.trace(line_of(path.points), false);
    canvas.stroke();
  }
}

/// What is deeper than a level: flat bottoms within their walls, and around each path as much as
/// the cone is wide there.
void fill_level(Canvas& canvas, const Carving& carving, const Walls& walls, double depth) {
  for (const auto& of_pass : walls) {
    // A wall may be all tabs, and stands around a part nevertheless.
    const auto is_deeper = [&](const ToolPath* wall) { return lowest_of(*wall) < -depth; };
    if (std::ranges::none_of(of_pass, is_deeper)) continue;
    for (const ToolPath* wall : of_pass) canvas.trace(line_of(wall->points));
    canvas.fill_even_odd();
  }
  for (const ToolPath& path : carving.paths) {
    const double over = -lowest_of(path) - depth;
    if (path.kind != ToolPathKind::wall || !(over > 0)) continue;
    canvas.width_in_units(2 * (carving.tip_radius + carving.slope * over));
    canvas.trace(line_of(path.points), false);
    canvas.stroke();
  }
  for (const ToolPath& path : carving.paths)
    if (path.kind == ToolPathKind::groove || path.kind == ToolPathKind::plunge)
      add_groove(canvas, carving, path, depth);
  canvas.fill();
}

/// Bars that are left, as high as their upper side.
void draw_tabs(Canvas& canvas, const Tabs& tabs, const Color& top) {
  canvas.color(top);
  canvas.width_in_units(tabs.width);
  cairo_set_line_cap(canvas.context(), CAIRO_LINE_CAP_BUTT);
  for (const TabLine& line : tabs.lines) {
    canvas.trace(std::span<const Vec2>(line));
    canvas.stroke();
  }
  cairo_set_line_cap(canvas.context(), CAIRO_LINE_CAP_ROUND);
}

/// The paths, and the ways through the air between them.
void draw_paths(Canvas& canvas, const std::vector<ToolPath>& paths) {
  canvas.line_width(0.8);
  for (const ToolPath& path : paths) {
    canvas.color(
        path.kind == ToolPathKind::groove ? Color{0.95, 0.95, 1.0} : Color{0.55, 0.8, 0.95},
        path.kind == ToolPathKind::clearing ? 0.5 : 0.9);
    canvas.trace(line_of(path.points), false);
    canvas.stroke();
  }
  canvas.color({0.85, 0.2, 0.2}, 0.8);
  canvas.line_width(0.6);
  for (std::size_t k = 0; k + 1 < paths.size(); ++k) {
    const std::array<Vec2, 2> way{paths[k].points.back().point, paths[k + 1].points.front().point};
    canvas.trace(std::span<const Vec2>(way));
    canvas.stroke();
  }
}

}  // namespace

Status write_picture(Target& target, const CarvingOutput& output) {
  const auto& items = output.document.items;
  Extent extent;
  double deepest = 0;
  for (const CarveItem& item : items) {
    extent.add(item.shape);
    deepest = std::max(deepest, item.carving.deepest);
  }
  const auto draw = [&](Canvas& canvas) {
    if (output.machine.shaded)
      return canvas.image(
          shaded(surface_after(output.document, canvas.viewport()), canvas.viewport()));
    constexpr Color wood{0.93, 0.86, 0.74}, bottom{0.36, 0.22, 0.12}, outline{0.25, 0.25, 0.3};
    const auto shade = [&](double t) {
      return Color{wood.red + t * (bottom.red - wood.red),
                   wood.green + t * (bottom.green - wood.green),
                   wood.blue + t * (bottom.blue - wood.blue)};
    };
    const int levels = target.format == "png" ? 32 : 12;
    for (const CarveItem& item : items) {
      const Walls walls = walls_of(item.carving);
      for (int level = 0; level < levels; ++level) {
        const double t = (level + 0.5) / levels;
        canvas.color(shade(t));
        fill_cleared(canvas, item.clearing, deepest * level / levels);
        fill_level(canvas, item.carving, walls, deepest * level / levels);
      }
      if (deepest > 0) draw_tabs(canvas, item.carving.tabs, shade(item.carving.tabs.top / deepest));
      draw_paths(canvas, item.clearing.paths);
      draw_paths(canvas, item.carving.paths);
      canvas.color(outline);
      canvas.line_width(1.2);
      canvas.trace(item.shape);
      canvas.stroke();
    }
  };
  return write_canvas(target, extent.box(), output.options.width, output.document.y_down, draw);
}

}  // namespace medial::io
