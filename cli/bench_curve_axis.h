#pragma once

// The figures of Shaked and Bruckstein, "The Curve Axis", 1996, drawn anew.

#include <string>

#include "cli/commands.h"
#include "cli/common.h"

namespace medial::cli {

/// Figs. 1 to 9 as SVG files in a directory. Errors: unwritable.
Status write_curve_axis_figures(const std::string& directory);

/// `medial bench curve-axis`.
Command add_curve_axis_bench(CLI::App& bench);

}  // namespace medial::cli
