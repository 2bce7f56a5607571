#pragma once

#include <array>
#include <vector>

#include "io/path_builder.h"

namespace medial::io {

/// A path of SVG as svgpp's grammar reports it: absolute coordinates, no shorthands.
class SvgPath {
 public:
  // What svgpp calls; the last argument says that coordinates are absolute.
  template <class Absolute>
  void path_move_to(double x, double y, Absolute) {
    start_ = last_ = {x, y};
    steps_.push_back({StepKind::start, {last_}, {}});
  }
  template <class Absolute>
  void path_line_to(double x, double y, Absolute) {
    last_ = {x, y};
    steps_.push_back({StepKind::line, {last_}, {}});
  }
  template <class Absolute>
  void path_quadratic_bezier_to(double x1, double y1, double x, double y, Absolute) {
    last_ = {x, y};
    steps_.push_back({StepKind::quadratic, {Vec2{x1, y1}, last_}, {}});
  }
  template <class Absolute>
  void path_cubic_bezier_to(double x1, double y1, double x2, double y2, double x, double y,
                            Absolute) {
    last_ = {x, y};
    steps_.push_back({StepKind::cubic, {Vec2{x1, y1}, Vec2{x2, y2}, last_}, {}});
  }
  template <class Absolute>
  void path_elliptical_arc_to(double rx, double ry, double degrees, bool large, bool sweep,
                              double x, double y, Absolute) {
    arc_to({rx, ry}, degrees, large, sweep, {x, y});
  }
  void path_close_subpath() {
    last_ = start_;
    steps_.push_back({StepKind::close, {}, {}});
  }
  void path_exit() {}

  std::size_t step_count() const { return steps_.size(); }
  /// The subpaths under a map. Those that enclose nothing are left out; of a `loose` drawing, those
  /// without a piece. With `stroked`, what is not closed is open.
  std::vector<Contour> contours(const Affine& map, RingRole role, bool loose, bool stroked) const;

 private:
  enum class StepKind : std::uint8_t { start, line, quadratic, cubic, arc, close };
  /// In the coordinates of the path: the map may stand behind it.
  struct Step {
    StepKind kind;
    std::array<Vec2, 3> points{};
    EllipticalArc arc{};
  };
  void arc_to(Vec2 radii, double degrees, bool large, bool sweep, Vec2 to);

  Vec2 start_;
  Vec2 last_;
  std::vector<Step> steps_;
};

}  // namespace medial::io
