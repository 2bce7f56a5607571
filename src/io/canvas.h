#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/color.h"
#include "io/picture_frame.h"
#include "medial/shape.h"

namespace medial::io {

/// A picture of curves in the plane, drawn through Cairo: y upwards unless told otherwise, aspect
/// kept. Line widths are in thousandths of the picture's longer side.
class Canvas {
 public:
  /// write_canvas() makes it.
  Canvas(cairo_t* context, const PictureFrame& frame) : context_(context), frame_(frame) {}

  void color(const Color& c, double alpha = 1) {
    cairo_set_source_rgba(context_, c.red, c.green, c.blue, alpha);
  }
  void line_width(double thousandths) {
    cairo_set_line_width(context_, 1e-3 * thousandths * std::max(frame_.width, frame_.height));
  }
  double scale() const { return frame_.scale; }
  double width() const { return frame_.width; }
  double height() const { return frame_.height; }
  /// The point of the plane that lies at this place of the picture, in pixels.
  Vec2 plane_at(Vec2 pixel) const { return frame_.plane_at(pixel); }
  void width_in_units(double units) { cairo_set_line_width(context_, units * frame_.scale); }

  /// Adds a ring to the path, without its last edge if it is open; or a polyline.
  void trace(const Ring& ring, bool closed = true);
  void trace(const Shape& shape);
  void trace(std::span<const Vec2> line);
  void circle(Vec2 center, double radius);
  /// Adds the convex hull of two disks.
  void tapered(Vec2 a, double radius_a, Vec2 b, double radius_b);
  void fill() { cairo_fill(context_); }
  void fill_even_odd();
  void stroke() { cairo_stroke(context_); }
  /// Covers all of the picture with pixels 0xRRGGBB, width() in a row.
  void image(std::vector<std::uint32_t> pixels);
  void text(Vec2 at, double thousandths, const std::string& words);

 private:
  void edge_to(Vec2 from, Vec2 to, double bulge);

  cairo_t* context_;
  PictureFrame frame_;
};

/// Draws a picture of a box of the plane as svg, pdf, ps or png. Errors: invalid_option (width),
/// unwritable.
Status write_canvas(OutputStream& out, const std::string& format, const Box& box, double width,
                    bool y_down, const std::function<void(Canvas&)>& draw);

}  // namespace medial::io
