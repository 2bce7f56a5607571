#pragma once

// Plots with logarithmic or linear axes, drawn by Cairo.

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
  bool logarithmic = true;  ///< both axes; otherwise linear axes, with y from 0
};

/// Writes the plots, two in a row, as one SVG, or by the extension as .png or .pdf. Errors:
/// unwritable.
Status write_plots(const std::string& path, const std::vector<Plot>& plots);

/// The functions that late_plot.cpp loads from the module of pictures.
struct PlotModule {
  const char* stamp;  ///< see cmake/stamp.cmake
  decltype(&cli::write_plots) write_plots;
};
constexpr const char* plot_module_name = "medial_plot_table";

}  // namespace medial::cli
