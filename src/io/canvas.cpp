#include "io/canvas.h"

#include <cairo-pdf.h>
#include <cairo-ps.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/arc.h"

namespace medial::io {

namespace {

cairo_status_t write_bytes(void* out, const unsigned char* bytes, unsigned count) {
  auto* stream = static_cast<OutputStream*>(out);
  stream->put(std::string_view(reinterpret_cast<const char*>(bytes), count));
  return stream->failed() ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* create_surface(OutputStream& out, const std::string& format, double width,
                                double height) {
  if (format == "svg") return cairo_svg_surface_create_for_stream(write_bytes, &out, width, height);
  if (format == "pdf") return cairo_pdf_surface_create_for_stream(write_bytes, &out, width, height);
  if (format == "ps") return cairo_ps_surface_create_for_stream(write_bytes, &out, width, height);
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                    static_cast<int>(height));
}

}  // namespace

void Canvas::arc_to(Vec2 from, Vec2 to, double bulge) {
  // Pieces of a 16th turn or less become cubic curves: they stay within 7e-8 radii.
  constexpr double longest = 0.0985;  // tangent of a quarter of a 16th turn
  const BulgeArc arc{from, to, bulge};
  if (std::abs(bulge) > longest) {
    const Vec2 middle = apex(arc);
    arc_to(from, middle, half_bulge(bulge));
    arc_to(middle, to, half_bulge(bulge));
    return;
  }
  const Vec2 along = (1 - bulge * bulge) / 3 * arc.chord();
  const Vec2 aside = -2 * bulge / 3 * left_of(arc.chord());
  const Vec2 a = from + along + aside, b = to - along + aside;
  cairo_curve_to(context_, a.x, a.y, b.x, b.y, to.x, to.y);
}

void Canvas::edge_to(Vec2 from, Vec2 to, double bulge) {
  const Vec2 end = place(to);
  if (bulge == 0) {
    cairo_line_to(context_, end.x, end.y);
  } else {
    arc_to(place(from), end, -up_ * bulge);
  }
}

void Canvas::trace(const Ring& ring, bool closed) {
  const std::size_t count = ring.points.size();
  if (count == 0) return;
  const Vec2 start = place(ring.points[0]);
  cairo_move_to(context_, start.x, start.y);
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i)
    edge_to(ring.points[i], ring.points[i + 1 == count ? 0 : i + 1],
            ring.bulges.empty() ? 0 : ring.bulges[i]);
  if (closed) cairo_close_path(context_);
}

void Canvas::trace(const Shape& shape) {
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    const Vec2 start = place(loop[0]);
    cairo_move_to(context_, start.x, start.y);
    for (std::size_t k = 0; k < loop.size(); ++k)
      edge_to(loop[k], loop[k + 1 == loop.size() ? 0 : k + 1],
              shape.bulge(shape.loop_begin[i] + k));
    cairo_close_path(context_);
  }
}

void Canvas::trace(std::span<const Vec2> line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 p = place(line[i]);
    i == 0 ? cairo_move_to(context_, p.x, p.y) : cairo_line_to(context_, p.x, p.y);
  }
}

void Canvas::circle(Vec2 center, double radius) {
  const Vec2 c = place(center);
  cairo_new_sub_path(context_);
  cairo_arc(context_, c.x, c.y, radius * scale_, 0, 2 * std::numbers::pi);
}

void Canvas::tapered(Vec2 a, double radius_a, Vec2 b, double radius_b) {
  const double way = distance(a, b);
  if (way <= std::abs(radius_a - radius_b)) {
    circle(radius_a > radius_b ? a : b, std::max(radius_a, radius_b));
    return;
  }
  // Both tangents touch at this angle from the way back.
  const Vec2 from = place(a), to = place(b);
  const double along = std::atan2(to.y - from.y, to.x - from.x);
  const double aside = std::acos((radius_a - radius_b) / way);
  cairo_new_sub_path(context_);
  cairo_arc(context_, from.x, from.y, radius_a * scale_, along + aside,
            along - aside + 2 * std::numbers::pi);
  cairo_arc(context_, to.x, to.y, radius_b * scale_, along - aside, along + aside);
  cairo_close_path(context_);
}

void Canvas::fill_even_odd() {
  cairo_set_fill_rule(context_, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill(context_);
  cairo_set_fill_rule(context_, CAIRO_FILL_RULE_WINDING);
}

void Canvas::image(std::vector<std::uint32_t> pixels) {
  const int columns = static_cast<int>(width_), rows = static_cast<int>(height_);
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
  const Vec2 p = place(at);
  cairo_select_font_face(context_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, 1e-3 * thousandths * std::max(width_, height_));
  cairo_move_to(context_, p.x, p.y);
  cairo_show_text(context_, words.c_str());
}

Status write_canvas(OutputStream& out, const std::string& format, const Box& box, double width,
                    bool y_down, const std::function<void(Canvas&)>& draw) {
  constexpr double smallest = 16;
  constexpr double largest = 8000;  // four times as high stays below Cairo's 32767
  if (!(width >= smallest && width <= largest)) {
    return Error{ErrorCode::invalid_option,
                 fmt::format("the width of a picture lies between {} and {}", smallest, largest),
                 {}};
  }
  width = std::floor(width);
  const Vec2 size = box.high - box.low;
  const double margin = 0.03 * width;
  double scale = size.x > 0 ? (width - 2 * margin) / size.x : 1;
  // A needle gets a picture of moderate height: its width gives way.
  const double wanted = size.x > 0 ? size.y * scale : 4 * width;
  const double height = std::ceil(std::clamp(wanted + 2 * margin, width / 8, 4 * width));
  if (size.y > 0 && size.y * scale + 2 * margin > height) scale = (height - 2 * margin) / size.y;

  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      create_surface(out, format, width, height), &cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()),
                                                                   &cairo_destroy);
  cairo_set_line_cap(context.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context.get(), CAIRO_LINE_JOIN_ROUND);
  Canvas canvas(context.get(), box, width, height, scale, y_down);
  canvas.color(paper_color);
  cairo_paint(context.get());
  draw(canvas);
  cairo_status_t status = cairo_status(context.get());
  if (status == CAIRO_STATUS_SUCCESS && format == "png")
    status = cairo_surface_write_to_png_stream(surface.get(), write_bytes, &out);
  cairo_surface_finish(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS && !out.failed())
    return Error{
        ErrorCode::unwritable, fmt::format("cannot draw: {}", cairo_status_to_string(status)), {}};
  return success();
}

}  // namespace medial::io
