#pragma once

// What all pictures share: how the plane lies in them, and the way from Cairo to a file.

#include <cairo.h>

#include <functional>
#include <string>

#include "base/arc.h"
#include "io/output.h"
#include "medial/io/read.h"

namespace medial::io {

/// The box around what is added to it.
class Extent {
 public:
  void add(Vec2 p) { box_.add(p); }
  void add(const Box& box) { box_.add(box); }
  void add(const Shape& shape);
  /// A unit square where nothing was added.
  Box box() const;

 private:
  Box box_ = Box::nothing();
};

/// The box around shapes, axes and sites.
Box box_of(const Document<AxisItem>& file);

/// How the plane lies in a picture: in its middle, aspect kept.
struct Viewport {
  double width = 0;
  double height = 0;
  double scale = 1;  ///< from units of the input to those of the picture
  double up = 1;     ///< -1 where the y axis of the plane points down, as the picture's does
  Vec2 center;       ///< of what is drawn

  /// The place in the picture of a point of the plane, and back.
  Vec2 operator()(Vec2 p) const {
    return {0.5 * width + (p.x - center.x) * scale, 0.5 * height - (p.y - center.y) * (up * scale)};
  }
  Vec2 plane_at(Vec2 q) const {
    return {center.x + (q.x - 0.5 * width) / scale, center.y - (q.y - 0.5 * height) / (up * scale)};
  }
  /// The bulge of an edge in the picture.
  double bulge(double of_plane) const { return -up * of_plane; }
};

/// The viewport of a picture of a box, of moderate height. Errors: invalid_option (width),
/// unsupported (a box that no picture can hold).
Result<Viewport> viewport_for(const Box& box, double width, bool y_down);

/// Goes on along an arc of the picture, within 7e-8 radii.
void arc_to(cairo_t* context, const BulgeArc& arc);

/// Adds a full circle of the picture to the path, if it is not larger than any picture.
void add_circle(cairo_t* context, Vec2 center, double radius);

/// Takes what Cairo writes; `out` is an OutputStream.
cairo_status_t write_bytes(void* out, const unsigned char* bytes, unsigned count);

/// Writes an image of Cairo in RGB24. Errors: unwritable.
Status write_png(OutputStream& out, cairo_surface_t* surface);

/// Lets `draw` draw an svg, pdf, ps or png on white paper. Errors: unwritable.
Status write_surface(OutputStream& out, const std::string& format, double width, double height,
                     const std::function<void(cairo_t*)>& draw);

}  // namespace medial::io
