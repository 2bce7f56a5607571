#pragma once

// A figure of a paper, drawn again: lines, dots, circles and labels on a part of the plane.

#include <cairo.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial::papers {

/// An SVG picture 480 wide, y upwards.
class Figure {
 public:
  explicit Figure(Box box);

  void pen(double red, double green, double blue, double line_width);
  /// One of nine colours, to distinguish numbered items.
  void color(std::size_t which, double line_width);
  void ink() { pen(0.15, 0.15, 0.17, 1.2); }
  void thin() { pen(0.6, 0.6, 0.63, 0.8); }
  void line(std::span<const Vec2> points) { stroke(points, 0); }
  void line(std::initializer_list<Vec2> points) { stroke({points.begin(), points.size()}, 0); }
  void dashed(std::span<const Vec2> points) { stroke(points, 4); }
  /// A head at the end of a way that comes along `direction`.
  void arrow_head(Vec2 at, Vec2 direction);
  void dot(Vec2 p);
  void circle(const Disk& disk);
  /// Text beside a point, off by so much to the right and up.
  void label(Vec2 p, const char* text, Vec2 offset = {5, 5});
  /// Small text with its middle in a point.
  void mark(Vec2 p, const char* text);
  /// Ends the picture. Errors: unwritable.
  Status write(const std::filesystem::path& path);
  const Box& box() const { return box_; }

 private:
  Vec2 place(Vec2 p) const;
  void stroke(std::span<const Vec2> points, double dash);

  Box box_;
  double scale_ = 1, height_ = 1;
  std::string text_;
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_{
      nullptr, cairo_surface_destroy};
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo_{nullptr, cairo_destroy};
};

}  // namespace medial::papers
