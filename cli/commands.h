#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "medial/error.h"

namespace medial::cli {

/// A command: its place on the command line, and what to do once the line is parsed. `run` gives
/// the exit status, or the error that main() reports.
struct Command {
  CLI::App* app = nullptr;
  std::function<Result<int>()> run;
};

/// Each adds its command to the program; each has a file of its own.
Command make_axis_command(CLI::App& program);
Command make_verify_command(CLI::App& program);
Command make_info_command(CLI::App& program);
Command make_legal_command(CLI::App& program);
Command make_draw_command(CLI::App& program);
Command make_prune_command(CLI::App& program);
Command make_smooth_command(CLI::App& program);
Command make_rebuild_command(CLI::App& program);
Command make_features_command(CLI::App& program);
Command make_match_command(CLI::App& program);
Command make_pack_command(CLI::App& program);
Command make_unpack_command(CLI::App& program);
Command make_voronoi_command(CLI::App& program);
Command make_distance_command(CLI::App& program);
Command make_voxels_command(CLI::App& program);
Command make_methods_command(CLI::App& program);
Command make_field_command(CLI::App& program);
Command make_compare_command(CLI::App& program);
Command make_offset_command(CLI::App& program);
Command make_centreline_command(CLI::App& program);
Command make_measure_command(CLI::App& program);
Command make_carve_command(CLI::App& program);

}  // namespace medial::cli
