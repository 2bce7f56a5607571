#pragma once

// A tool at work: how deep paths cut, and how deep they may.

#include <vector>

#include "medial/carve.h"

namespace medial::test {

/// What a tool with a flat tip of radius `tip` and walls of the given slope removes.
struct Cutter {
  double tip = 0, slope = 1;

  /// The depth at p where the tool stands at `at`, `deep` deep; negative: above the surface.
  double depth_at(Vec2 p, Vec2 at, double deep) const;
  /// The largest depth at p of all paths; 0 where none cuts.
  double depth_at(Vec2 p, const std::vector<ToolPath>& paths) const;
};

}  // namespace medial::test
