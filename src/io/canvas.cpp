#include "io/canvas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace medial::io {

void Canvas::edge_to(Vec2 from, Vec2 to, double bulge) {
  const Vec2 end = frame_(to);
  if (bulge == 0) {
    cairo_line_to(context_, end.x, end.y);
  } else {
    arc_to(context_, {frame_(from), end, frame_.bulge(bulge)});
  }
}

void Canvas::trace(const Ring& ring, bool closed) {
  const std::size_t count = ring.points.size();
  if (count == 0) return;
  const Vec2 start = frame_(ring.points[0]);
  cairo_move_to(context_, start.x, start.y);
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i)
    edge_to(ring.points[i], ring.points[i + 1 == count ? 0 : i + 1],
            ring.bulges.empty() ? 0 : ring.bulges[i]);
  if (closed) cairo_close_path(context_);
}

void Canvas::trace(const Shape& shape) {
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    const Vec2 start = frame_(loop[0]);
    cairo_move_to(context_, start.x, start.y);
    for (std::size_t k = 0; k < loop.size(); ++k)
      edge_to(loop[k], loop[k + 1 == loop.size() ? 0 : k + 1],
              shape.bulge(shape.loop_begin[i] + k));
    cairo_close_path(context_);
  }
}

void Canvas::trace(std::span<const Vec2> line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 p = frame_(line[i]);
    i == 0 ? cairo_move_to(context_, p.x, p.y) : cairo_line_to(context_, p.x, p.y);
  }
}

void Canvas::circle(Vec2 center, double radius) {
  add_circle(context_, frame_(center), radius * frame_.scale);
}

void Canvas::tapered(Vec2 a, double radius_a, Vec2 b, double radius_b) {
  const double way = distance(a, b);
  if (way <= std::abs(radius_a - radius_b)) {
    circle(radius_a > radius_b ? a : b, std::max(radius_a, radius_b));
    return;
  }
  // Both tangents touch at this angle from the way back.
  const Vec2 from = frame_(a), to = frame_(b);
  const double along = std::atan2(to.y - from.y, to.x - from.x);
  const double aside = std::acos((radius_a - radius_b) / way);
  cairo_new_sub_path(context_);
  cairo_arc(context_, from.x, from.y, radius_a * frame_.scale, along + aside,
            along - aside + 2 * std::numbers::pi);
  cairo_arc(context_, to.x, to.y, radius_b * frame_.scale, along - aside, along + aside);
  cairo_close_path(context_);
}

void Canvas::fill_even_odd() {
  cairo_set_fill_rule(context_, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill(context_);
  cairo_set_fill_rule(context_, CAIRO_FILL_RULE_WINDING);
}

void Canvas::image(std::vector<std::uint32_t> pixels) {
  const int columns = static_cast<int>(frame_.width), rows = static_cast<int>(frame_.height);
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

void Canvas::text(Vec2 at, double thousandths, const std::string& words) {
  const Vec2 p = frame_(at);
  cairo_select_font_face(context_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, 1e-3 * thousandths * std::max(frame_.width, frame_.height));
  cairo_move_to(context_, p.x, p.y);
  cairo_show_text(context_, words.c_str());
}

Status write_canvas(OutputStream& out, const std::string& format, const Box& box, double width,
                    bool y_down, const std::function<void(Canvas&)>& draw) {
  const Result<PictureFrame> frame = frame_for(box, width, y_down);
  if (!frame) return frame.error();
  return write_surface(out, format, frame->width, frame->height, [&](cairo_t* context) {
    Canvas canvas(context, *frame);
    draw(canvas);
  });
}

}  // namespace medial::io
