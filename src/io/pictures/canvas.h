#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "io/format.h"
#include "io/pictures/color.h"
#include "io/pictures/viewport.h"
#include "medial/shape.h"

namespace medial::io {

inline constexpr Color outline_color{0.25, 0.25, 0.27};

inline constexpr int pieces_per_stroke = 500;  ///< of a path: long ones are slow to stroke

/// A piece of an edge, in units of the picture: a rational quadratic curve with weights 1, w, 1.
struct Piece {
  Vec2 from, control, to;
  double weight = 1;
  bool straight = true;
};

/// Which pieces smaller than a cell add nothing to a picture: those in a cell where one of the same
/// shade is drawn already.
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

/// Which points of a line may be left out, so that the line passes all of them within a slack: as
/// long as the directions to them have one in common.
class Thinning {
 public:
  /// Starts a line, without which nothing is held. `detail`: nobody sees what is smaller.
  void start(Vec2 at, double detail) {
    from_ = last_ = at;
    detail_ = detail;
    open_ = true;
    farthest_ = 0;
  }
  /// The end of what was taken.
  Vec2 last() const { return last_; }
  /// Whether anything was taken since from where the line was drawn.
  bool holds() const { return !(last_ == from_); }
  /// Takes a point; false if the line has to be drawn to last() before.
  bool take(Vec2 p) {
    const Vec2 way = p - from_;
    const double square = squared_norm(way);
    if (square < farthest_ || !(open_ || (cross(low_, way) >= 0 && cross(way, high_) >= 0)))
      return false;
    farthest_ = square;
    last_ = p;
    narrow(way, square);
    return true;
  }

  /// By how much nobody sees that a line to there is off; less if it is so long that a smooth curve
  /// would have facets.
  static double slack(double square, double detail) {
    return detail / (square <= detail * detail ? 8 : 80);
  }

 private:
  /// Leaves the directions that pass a point within its slack.
  void narrow(Vec2 way, double square) {
    const double allowed = slack(square, detail_);
    const double beyond = square - allowed * allowed;
    if (!(beyond > 0)) return;
    const Vec2 along = std::sqrt(beyond) * way, aside = allowed * left_of(way);
    if (open_ || cross(low_, along - aside) > 0) low_ = along - aside;
    if (open_ || cross(along + aside, high_) > 0) high_ = along + aside;
    open_ = false;
  }

  double detail_ = 0;
  Vec2 from_, last_;
  bool open_ = true;  ///< all directions are left
  Vec2 low_, high_;   ///< else those between, with less than half a turn
  double farthest_ = 0;
};

/// A picture of curves in the plane, drawn through Cairo: aspect kept. Line widths are in
/// thousandths of the picture's longer side.
class Canvas {
 public:
  /// `fineness`: a factor of all line widths.
  Canvas(cairo_t* context, const Viewport& viewport, double fineness = 1)
      : context_(context),
        viewport_(viewport),
        fineness_(fineness),
        pixels_(cairo_surface_get_type(cairo_get_target(context)) == CAIRO_SURFACE_TYPE_IMAGE) {}

  cairo_t* context() { return context_; }
  const Viewport& viewport() const { return viewport_; }
  /// How far apart places are that differ to the eye: a pixel, or in pictures that can be enlarged,
  /// the line's width, which hides what is smaller at any size.
  double detail() const { return pixels_ ? 1 : cairo_get_line_width(context_); }
  /// How small a piece is that adds nothing to one nearby.
  double cell() const { return detail() / (pixels_ ? 2 : 3); }
  /// The thickness of a line that is given in thousandths of the longer side.
  double thickness(double thousandths) const {
    return thousandths * 1e-3 * fineness_ * longer_side();
  }
  double longer_side() const { return std::max(viewport_.width, viewport_.height); }
  void line_width(double thousandths) { cairo_set_line_width(context_, thickness(thousandths)); }
  void width_in_units(double units) { cairo_set_line_width(context_, units * viewport_.scale); }
  void color(const Color& c, double alpha = 1) {
    cairo_set_source_rgba(context_, c.red, c.green, c.blue, alpha);
  }

  // The path, in places of the picture.
  void move_to(Vec2 p) { cairo_move_to(context_, p.x, p.y); }
  void line_to(Vec2 p) { cairo_line_to(context_, p.x, p.y); }
  void arc_to(const BulgeArc& arc) { io::arc_to(context_, arc); }
  void dot(Vec2 center, double radius) { add_circle(context_, center, radius); }
  /// Goes on along a piece, from where it begins.
  void piece_to(const Piece& piece);
  void close() { cairo_close_path(context_); }

  // The path, in the plane.
  /// Goes on along an edge.
  void edge_to(Vec2 from, Vec2 to, double bulge);
  /// Adds a ring, without its last edge if it is open; all loops of a shape; or a polyline.
  void trace(const Ring& ring, bool closed = true);
  void trace(const Shape& shape);
  void trace(std::span<const Vec2> line);
  void circle(Vec2 center, double radius) { dot(viewport_(center), radius * viewport_.scale); }
  /// Adds the convex hull of two disks.
  void tapered(Vec2 a, double radius_a, Vec2 b, double radius_b);

  void stroke() { cairo_stroke(context_); }
  /// Fills all that any part of the path goes around, or what is inside by the even-odd rule.
  void fill() { cairo_fill(context_); }
  void fill_even_odd(bool keep_path = false);
  /// Strokes or fills once the path has become long, and thus slow; whether it did.
  bool count_piece(bool filled) {
    if (++batch_ % pieces_per_stroke != 0) return false;
    filled ? fill() : stroke();
    return true;
  }
  /// Draws outlines that nobody can tell from those of shapes.
  void stroke_shapes(std::span<const Shape* const> shapes, const Color& outline);
  /// Fills the shapes before.
  void draw_shapes(std::span<const Shape* const> shapes, const Color& inside, const Color& outline);

  /// Covers all of the picture with pixels 0xRRGGBB, as many in a row as it is wide.
  void image(std::vector<std::uint32_t> pixels);
  /// Words from a point of the plane on; their height in thousandths of the longer side.
  void text(Vec2 at, double thousandths, const std::string& words);
  /// Words whose base line has its middle at a place of the picture.
  void centred_text(Vec2 middle, double thousandths, const std::string& words);
  /// `size`: in units of the picture.
  void use_font(double size);

 private:
  void trace_nearly(const Shape& shape, std::size_t loop, bool in_strokes);

  cairo_t* context_;
  Viewport viewport_;
  double fineness_;
  bool pixels_;
  int batch_ = 0;
};

/// Draws a picture of a box of the plane as svg, pdf, ps or png. Errors: invalid_option (width),
/// unwritable.
Status write_canvas(Target& target, const Box& box, double width, bool y_down,
                    const std::function<void(Canvas&)>& draw, double fineness = 1);

/// A bar in the lower margin that is a round number of units long, with that number; nothing for
/// an empty unit.
void draw_scale_bar(Canvas& canvas, const std::string& unit);

}  // namespace medial::io
