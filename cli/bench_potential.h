#pragma once

// The experiments of [ahuja1997] as tables. No printing here.

#include <functional>
#include <string>
#include <vector>

#include "medial/shape.h"

namespace medial::cli {

struct PotentialReport {
  std::string text;    ///< tables
  bool passed = true;  ///< every shape has an axis at every order
};

/// Shapes by name, and orders of the potential; 0 stands for the adaptive one. Measured on one
/// thread: distances to the exact axis, orders along a rectangle (Fig. 13), a border with noise
/// (Fig. 7), times (Fig. 8).
PotentialReport run_potential_experiments(const std::vector<std::pair<std::string, Shape>>& shapes,
                                          const std::function<void(const std::string&)>& progress);

/// Fig. 13 as an SVG file in a directory. Errors: unwritable.
Status write_potential_figures(const std::string& directory);

/// The paper's regions of Fig. 3: a rectangle, an L, and a shape like that of [20], Fig. 19.
std::vector<std::pair<std::string, Shape>> potential_regions();

}  // namespace medial::cli
