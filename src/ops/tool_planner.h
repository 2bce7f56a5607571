#pragma once

// Tool paths in the order of cutting, with ramps and plunges into the material.

#include <vector>

#include "medial/carve.h"

namespace medial::ops {

/// Appends paths to a carving, and joins paths whose link is safe.
class Planner {
 public:
  /// `slope`: of ramps; infinite: none.
  Planner(Carving& carving, double slope, double chord)
      : carving_(carving), slope_(slope), chord_(chord) {}

  /// Starts a pass. Material above `level` has been cut before, along all paths of this pass.
  void begin_pass(std::uint32_t pass, double level) {
    pass_ = pass;
    level_ = level;
  }

  Vec2 at() const {
    return carving_.paths.empty() ? Vec2{} : carving_.paths.back().points.back().point;
  }
  bool started() const { return !carving_.paths.empty(); }

  /// `reach`: the largest length of a straight link to the path that stays inside the region that
  /// is or may be cut at its depth; below 0, the tool is lifted.
  void add(ToolPathKind kind, std::vector<ToolPoint> points, double reach);

 private:
  void append(ToolPathKind kind, std::vector<ToolPoint> points);

  Carving& carving_;
  double slope_, chord_, level_ = 0;
  std::uint32_t pass_ = 0;
};

}  // namespace medial::ops
