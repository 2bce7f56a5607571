#pragma once

// Plots with logarithmic axes, drawn by Cairo.

#include <string>
#include <utility>
#include <vector>

#include "medial/error.h"

namespace medial::cli {

struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< positive
  bool reference = false;                         ///< a dashed line without marks, to compare with
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Series> series;
};

/// Writes the plots, two in a row, as one SVG. Errors: unwritable.
Status write_plots(const std::string& path, const std::vector<Plot>& plots);

/// Writes a text to a new file that appears all at once. Errors: unwritable.
Status write_text(const std::string& path, const std::string& text);

}  // namespace medial::cli
