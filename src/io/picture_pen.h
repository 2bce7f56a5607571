#pragma once

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_set>

#include "io/color.h"
#include "io/picture_frame.h"

namespace medial::io {

inline constexpr Color outline_color{0.25, 0.25, 0.27};

inline constexpr int pieces_per_stroke = 2000;  ///< of a path: long ones are slow to stroke

/// A piece of an edge, in units of the picture: a rational quadratic curve with weights 1, w, 1.
struct Piece {
  Vec2 from, control, to;
  double weight = 1;
  bool straight = true;
};

/// Tells which pieces smaller than a cell add nothing to a picture: those in a cell where one of
/// the same shade is drawn already.
class Cells {
 public:
  explicit Cells(double size) : size_(size) {}

  bool add(const Piece& piece) {
    const double extent =
        std::max(std::fabs(piece.to.x - piece.from.x), std::fabs(piece.to.y - piece.from.y));
    if (!(extent <= size_)) return true;
    // A file may hold curves that leave the picture.
    const auto index = [this](double place) {
      return static_cast<std::uint64_t>(std::clamp(place / size_, 0.0, farthest));
    };
    return drawn_.insert(index(piece.from.y) << 32U | index(piece.from.x)).second;
  }

 private:
  static constexpr double farthest = 1e9;  // more cells than any picture has
  double size_;
  std::unordered_set<std::uint64_t> drawn_;
};

/// What the parts of a picture of axes draw with. Places are in the picture, in its units, unless a
/// function takes shapes.
class Pen {
 public:
  /// `fineness`: a factor of all line widths.
  Pen(cairo_t* context, const PictureFrame& frame, double fineness)
      : context_(context),
        frame_(frame),
        fineness_(fineness),
        pixels_(cairo_surface_get_type(cairo_get_target(context)) == CAIRO_SURFACE_TYPE_IMAGE) {}

  const PictureFrame& frame() const { return frame_; }
  /// How far apart places are that can be told apart: a fraction of a pixel, or where a picture can
  /// be looked at closer, of the thinnest line, which hides what is smaller at any size.
  double cell() const { return pixels_ ? 0.25 : thickness(0.1); }
  /// Of lines: in thousandths of the longer side.
  double thickness(double thousandths) const {
    return thousandths * 1e-3 * fineness_ * longer_side();
  }
  double longer_side() const { return std::max(frame_.width, frame_.height); }
  void line_width(double thousandths) { cairo_set_line_width(context_, thickness(thousandths)); }
  void color(const Color& c, double alpha = 1) {
    cairo_set_source_rgba(context_, c.red, c.green, c.blue, alpha);
  }
  void move_to(Vec2 p) { cairo_move_to(context_, p.x, p.y); }
  void line_to(Vec2 p) { cairo_line_to(context_, p.x, p.y); }
  void arc_to(const BulgeArc& arc) { io::arc_to(context_, arc); }
  void circle(Vec2 center, double radius) { add_circle(context_, center, radius); }
  /// Goes on along a piece, from where it begins.
  void piece_to(const Piece& piece);
  void close() { cairo_close_path(context_); }
  void stroke() { cairo_stroke(context_); }
  /// Fills what is inside by the even-odd rule, or all that any part of the path goes around.
  void fill_even_odd(bool keep = false);
  void fill();

  /// Words whose base line has its middle here, so many thousandths of the longer side high.
  void text(Vec2 middle, double thousandths, const std::string& words);

  /// Strokes or fills once so many pieces have come that the path gets slow; whether it did.
  bool count_piece(bool filled) {
    if (++batch_ % pieces_per_stroke != 0) return false;
    filled ? fill() : stroke();
    return true;
  }

  void fill_shape(const Shape& shape, const Color& inside);
  /// Strokes all loops with the colour and width set.
  void stroke_shape(const Shape& shape);

 private:
  template <class Each>
  void trace_loop(const Shape& shape, std::size_t loop, Each each);

  cairo_t* context_;
  const PictureFrame& frame_;
  double fineness_;
  bool pixels_;
  int batch_ = 0;
};

}  // namespace medial::io
