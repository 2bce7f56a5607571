#include "io/pictures/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace medial::io {

void Canvas::edge_to(Vec2 from, Vec2 to, double bulge) {
  const Vec2 end = viewport_(to);
  bulge == 0 ? line_to(end) : arc_to({viewport_(from), end, viewport_.bulge(bulge)});
}

void Canvas::trace(const Ring& ring, bool closed) {
  const std::size_t count = ring.points.size();
  if (count == 0) return;
  move_to(viewport_(ring.points[0]));
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i)
    edge_to(ring.points[i], ring.points[i + 1 == count ? 0 : i + 1],
            ring.bulges.empty() ? 0 : ring.bulges[i]);
  if (closed) close();
}

void Canvas::trace(const Shape& shape) {
  for (std::size_t i = 0; i < shape.loop_count(); ++i) trace(ring_of(shape, i));
}

void Canvas::trace(std::span<const Vec2> line) {
  for (std::size_t i = 0; i < line.size(); ++i)
    i == 0 ? move_to(viewport_(line[i])) : line_to(viewport_(line[i]));
}

void Canvas::tapered(Vec2 a, double radius_a, Vec2 b, double radius_b) {
  const double way = distance(a, b);
  if (way <= std::abs(radius_a - radius_b)) {
    circle(radius_a > radius_b ? a : b, std::max(radius_a, radius_b));
    return;
  }
  // Both tangents touch at this angle from the way back.
  const Vec2 from = viewport_(a), to = viewport_(b);
  const double along = std::atan2(to.y - from.y, to.x - from.x);
  const double aside = std::acos((radius_a - radius_b) / way);
  cairo_new_sub_path(context_);
  cairo_arc(context_, from.x, from.y, radius_a * viewport_.scale, along + aside,
            along - aside + 2 * std::numbers::pi);
  cairo_arc(context_, to.x, to.y, radius_b * viewport_.scale, along - aside, along + aside);
  cairo_close_path(context_);
}

void Canvas::fill_even_odd(bool keep_path) {
  cairo_set_fill_rule(context_, CAIRO_FILL_RULE_EVEN_ODD);
  keep_path ? cairo_fill_preserve(context_) : cairo_fill(context_);
  cairo_set_fill_rule(context_, CAIRO_FILL_RULE_WINDING);
}

/// Goes along all edges of a loop as nearly as can be seen, as one path or in strokes.
void Canvas::trace_nearly(const Shape& shape, std::size_t loop, bool in_strokes) {
  const std::size_t begin = shape.loop_begin[loop];
  const std::size_t end = shape.loop_begin[loop + 1];
  Thinning line;
  const auto draw_line = [&] {
    line_to(line.last());
    if (in_strokes && count_piece(false)) move_to(line.last());
    line.start(line.last(), detail());
  };
  move_to(viewport_(shape.points[begin]));
  line.start(viewport_(shape.points[begin]), detail());
  for (std::size_t k = begin; k < end; ++k) {
    const Vec2 from = viewport_(shape.points[k]);
    const Vec2 p = viewport_(shape.points[k + 1 == end ? begin : k + 1]);
    const double bulge = shape.bulge(k);
    if (std::fabs(bulge) * distance(from, p) < 0.25 * detail()) {  // twice its height
      if (line.take(p)) continue;
      draw_line();
      line.take(p);
    } else {
      if (line.holds()) draw_line();
      arc_to({from, p, viewport_.bulge(bulge)});
      line.start(p, detail());
    }
  }
  if (line.holds()) draw_line();
}

void Canvas::stroke_shapes(std::span<const Shape* const> shapes, const Color& outline) {
  color(outline);
  for (const Shape* shape : shapes)
    for (std::size_t i = 0; i < shape->loop_count(); ++i) trace_nearly(*shape, i, true);
  stroke();
}

void Canvas::draw_shapes(std::span<const Shape* const> shapes, const Color& inside,
                         const Color& outline) {
  // A file is smaller if one path serves to fill and to stroke. Other shapes may hide outlines.
  const bool at_once = !pixels_ && shapes.size() == 1;
  for (const Shape* shape : shapes) {
    for (std::size_t i = 0; i < shape->loop_count(); ++i) {
      trace_nearly(*shape, i, false);
      close();
    }
    color(inside);
    fill_even_odd(at_once);
  }
  if (!at_once) return stroke_shapes(shapes, outline);
  color(outline);
  stroke();
}

/// A quadratic Bezier curve (weight 1) is one cubic exactly; other conics come very near to one
/// once they are cut so often that their weights are nearly 1, which each cut in halves makes
/// them four times as nearly: a circle's 16th turn stays within 7e-8 radii.
void Canvas::piece_to(const Piece& piece) {
  if (piece.straight) return line_to(piece.to);
  const double nearly_one = 0.0192;  // 1 - cos(turn / 2) of a 16th turn
  const double w = piece.weight;
  if (std::fabs(1 - w) > nearly_one) {
    const Vec2 left = 1 / (1 + w) * (piece.from + w * piece.control);
    const Vec2 right = 1 / (1 + w) * (piece.to + w * piece.control);
    const Vec2 middle = midpoint(left, right);
    const double half = std::sqrt(0.5 * (1 + w));
    piece_to({piece.from, left, middle, half, false});
    piece_to({middle, right, piece.to, half, false});
    return;
  }
  const double share = 4 * w / (3 * (1 + w));
  const Vec2 a = piece.from + share * (piece.control - piece.from);
  const Vec2 b = piece.to + share * (piece.control - piece.to);
  cairo_curve_to(context_, a.x, a.y, b.x, b.y, piece.to.x, piece.to.y);
}

void Canvas::image(std::vector<std::uint32_t> pixels) {
  const int columns = static_cast<int>(viewport_.width), rows = static_cast<int>(viewport_.height);
  cairo_surface_t* surface =
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                          CAIRO_FORMAT_RGB24, columns, rows, 4 * columns);
  cairo_set_source_surface(context_, surface, 0, 0);
  cairo_paint(context_);
  // A vector picture keeps the image until it is finished, and then copies the pixels.
  cairo_set_source_rgb(context_, 0, 0, 0);
  cairo_surface_flush(cairo_get_target(context_));
  cairo_surface_finish(surface);
  cairo_surface_destroy(surface);
}

void Canvas::use_font(double size) {
  cairo_select_font_face(context_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, size);
}

void Canvas::text(Vec2 at, double thousandths, const std::string& words) {
  use_font(1e-3 * thousandths * longer_side());
  move_to(viewport_(at));
  cairo_show_text(context_, words.c_str());
}

void Canvas::centred_text(Vec2 middle, double thousandths, const std::string& words) {
  use_font(1e-3 * thousandths * longer_side());
  cairo_text_extents_t extents;
  cairo_text_extents(context_, words.c_str(), &extents);
  move_to({middle.x - 0.5 * extents.width - extents.x_bearing, middle.y});
  cairo_show_text(context_, words.c_str());
  cairo_new_path(context_);
}

void draw_scale_bar(Canvas& canvas, const std::string& unit) {
  if (unit.empty()) return;
  const Viewport& viewport = canvas.viewport();
  constexpr double longest = 0.2, margin = 0.03, below = 0.01, letters = 13;
  const double most = longest * viewport.width / viewport.scale;
  const double power = std::pow(10, std::floor(std::log10(most)));
  const double length = power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
  const Vec2 from{margin * viewport.width, viewport.height - below * viewport.width};
  const Vec2 to = from + Vec2{length * viewport.scale, 0};
  canvas.color(outline_color);
  canvas.line_width(1.5);
  canvas.move_to(from);
  canvas.line_to(to);
  canvas.stroke();
  canvas.use_font(1e-3 * letters * viewport.width);
  canvas.move_to(to + Vec2{below * viewport.width, 0});
  cairo_show_text(canvas.context(), fmt::format("{:g} {}", length, unit).c_str());
}

Status write_canvas(Target& target, const Box& box, double width, bool y_down,
                    const std::function<void(Canvas&)>& draw, double fineness) {
  const Result<Viewport> viewport = viewport_for(box, width, y_down);
  if (!viewport) return viewport.error();
  return write_surface(*target.out, target.format, viewport->width, viewport->height,
                       [&](cairo_t* context) {
                         Canvas canvas(context, *viewport, fineness);
                         draw(canvas);
                         draw_scale_bar(canvas, target.unit);
                       });
}

}  // namespace medial::io
