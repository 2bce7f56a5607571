#pragma once

// Plots with logarithmic or even axes, drawn by Cairo.

#include <string>
#include <utility>
#include <vector>

#include "medial/error.h"

namespace medial::cli {

struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< positive on logarithmic axes
  bool reference = false;                         ///< a dashed line without marks, to compare with
  bool marks = true;                              ///< draw the points,
  bool line = true;                               ///< and a line through them
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Series> series;
  bool logarithmic = true;  ///< both axes; otherwise even ones, y from 0
};

/// Writes the plots, two in a row, as one SVG, or by the extension as .png or .pdf. Errors:
/// unwritable.
Status write_plots(const std::string& path, const std::vector<Plot>& plots);

}  // namespace medial::cli
