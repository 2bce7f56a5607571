#include "io/pictures/viewport.h"

#include <cairo-pdf.h>
#include <cairo-ps.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string_view>

#include "io/pictures/color.h"

namespace medial::io {

namespace {

cairo_surface_t* create_surface(OutputStream& out, const std::string& format, double width,
                                double height) {
  if (format == "svg") return cairo_svg_surface_create_for_stream(write_bytes, &out, width, height);
  if (format == "pdf") return cairo_pdf_surface_create_for_stream(write_bytes, &out, width, height);
  if (format == "ps") return cairo_ps_surface_create_for_stream(write_bytes, &out, width, height);
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                    static_cast<int>(height));
}

}  // namespace

void Extent::add(const Shape& shape) {
  if (!shape.points.empty()) add(bounding_box(shape));
}

Box Extent::box() const { return box_.is_nothing() ? Box{{0, 0}, {1, 1}} : box_; }

Box box_of(const Document<AxisItem>& file) {
  Extent extent;
  for (const AxisItem& item : file.items) {
    extent.add(item.shape);
    for (const Node& node : item.axis.nodes) extent.add(node.disk.center);
    for (const Site& site : item.axis.sites) extent.add(site.start);
  }
  return extent.box();
}

Result<Viewport> viewport_for(const Box& box, double width, bool y_down) {
  constexpr double smallest = 16;
  constexpr double largest = 8000;  // four times as high stays below Cairo's 32767
  if (!(width >= smallest && width <= largest))
    return Error{ErrorCode::invalid_option,
                 fmt::format("the width of a picture lies between {} and {}", smallest, largest),
                 {}};
  Viewport viewport;
  viewport.width = std::floor(width);
  viewport.up = y_down ? -1 : 1;
  viewport.center = midpoint(box.low, box.high);
  const Vec2 size = box.high - box.low;
  const double margin = 0.03 * viewport.width;
  viewport.scale = size.x > 0 ? (viewport.width - 2 * margin) / size.x : 1;
  // A needle gets a picture of moderate height: its width gives way.
  const double height = size.x > 0 ? size.y * viewport.scale : 4 * viewport.width;
  viewport.height =
      std::ceil(std::clamp(height + 2 * margin, viewport.width / 8, 4 * viewport.width));
  if (size.y > 0 && size.y * viewport.scale + 2 * margin > viewport.height)
    viewport.scale = (viewport.height - 2 * margin) / size.y;
  if (!(viewport.scale > 0) || !std::isfinite(viewport.scale) || !std::isfinite(viewport.height))
    return Error{ErrorCode::unsupported, "the coordinates are too large or too small to draw", {}};
  return viewport;
}

void arc_to(cairo_t* context, const BulgeArc& arc) {
  // Pieces of a 16th turn or less become cubic curves.
  constexpr double longest = 0.0985;  // tangent of a quarter of a 16th turn
  const double bulge = arc.bulge;
  if (std::abs(bulge) > longest) {
    const Vec2 middle = apex(arc);
    arc_to(context, {arc.start, middle, half_bulge(bulge)});
    arc_to(context, {middle, arc.end, half_bulge(bulge)});
    return;
  }
  const Vec2 along = (1 - bulge * bulge) / 3 * arc.chord();
  const Vec2 aside = -2 * bulge / 3 * left_of(arc.chord());
  const Vec2 a = arc.start + along + aside, b = arc.end - along + aside;
  cairo_curve_to(context, a.x, a.y, b.x, b.y, arc.end.x, arc.end.y);
}

void add_circle(cairo_t* context, Vec2 center, double radius) {
  // Beyond what its fixed point numbers hold, cairo loops for ever.
  if (radius > 1 << 22) return;
  cairo_new_sub_path(context);
  cairo_arc(context, center.x, center.y, radius, 0, 2 * std::numbers::pi);
}

cairo_status_t write_bytes(void* out, const unsigned char* bytes, unsigned count) {
  auto* stream = static_cast<OutputStream*>(out);
  stream->put(std::string_view(reinterpret_cast<const char*>(bytes), count));
  return stream->failed() ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
}

Status write_surface(OutputStream& out, const std::string& format, double width, double height,
                     const std::function<void(cairo_t*)>& draw) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      create_surface(out, format, width, height), &cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()),
                                                                   &cairo_destroy);
  cairo_set_line_cap(context.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_source_rgb(context.get(), paper_color.red, paper_color.green, paper_color.blue);
  cairo_paint(context.get());
  draw(context.get());
  cairo_status_t status = cairo_status(context.get());
  if (status == CAIRO_STATUS_SUCCESS && format == "png") return write_png(out, surface.get());
  cairo_surface_finish(surface.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS && !out.failed())
    return Error{
        ErrorCode::unwritable, fmt::format("cannot draw: {}", cairo_status_to_string(status)), {}};
  return success();
}

}  // namespace medial::io
