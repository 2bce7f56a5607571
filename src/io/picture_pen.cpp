#include "io/picture_pen.h"

#include <cmath>

namespace medial::io {

void Pen::fill_even_odd(bool keep) {
  cairo_set_fill_rule(context_, CAIRO_FILL_RULE_EVEN_ODD);
  keep ? cairo_fill_preserve(context_) : cairo_fill(context_);
}

void Pen::fill() {
  cairo_set_fill_rule(context_, CAIRO_FILL_RULE_WINDING);
  cairo_fill(context_);
}

/// Goes along all edges of a loop, as one path; `each` is told the end of every edge drawn.
template <class Each>
void Pen::trace_loop(const Shape& shape, std::size_t loop, Each each) {
  const std::size_t begin = shape.loop_begin[loop];
  const std::size_t end = shape.loop_begin[loop + 1];
  const double smallest = cell();
  Vec2 last = frame_(shape.points[begin]);
  move_to(last);
  for (std::size_t k = begin; k < end; ++k) {
    const Vec2 p = frame_(shape.points[k + 1 == end ? begin : k + 1]);
    const double bulge = shape.bulge(k);
    if (distance(p, last) < smallest) continue;
    if (bulge == 0) {
      line_to(p);
    } else {
      arc_to({frame_(shape.points[k]), p, frame_.bulge(bulge)});
    }
    last = p;
    each(p);
  }
}

void Pen::fill_shape(const Shape& shape, const Color& inside) {
  color(inside);
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    trace_loop(shape, i, [](Vec2) {});
    close();
  }
  fill_even_odd();
}

void Pen::stroke_shape(const Shape& shape) {
  int batch = 0;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    trace_loop(shape, i, [&](Vec2 p) {
      if (++batch % pieces_per_stroke != 0) return;
      stroke();
      move_to(p);
    });
  }
  stroke();
}

/// A quadratic Bezier curve (weight 1) is one cubic exactly; other conics come very near to one
/// once they are cut so often that their weights are nearly 1, which each cut in halves makes
/// them four times as nearly: a circle's 16th turn stays within 7e-8 radii.
void Pen::piece_to(const Piece& piece) {
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

void Pen::text(Vec2 middle, double thousandths, const std::string& words) {
  cairo_select_font_face(context_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, 1e-3 * thousandths * longer_side());
  cairo_text_extents_t extents;
  cairo_text_extents(context_, words.c_str(), &extents);
  cairo_move_to(context_, middle.x - 0.5 * extents.width - extents.x_bearing, middle.y);
  cairo_show_text(context_, words.c_str());
  cairo_new_path(context_);
}

}  // namespace medial::io
