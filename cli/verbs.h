#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "medial/error.h"

namespace medial::cli {

/// A verb: its place on the command line, and what to do once the line is parsed. `run` gives the
/// exit status, or the error that main() reports.
struct Verb {
  CLI::App* app = nullptr;
  std::function<Result<int>()> run;
};

/// Each adds its verb to the program; each has a file of its own.
Verb make_axis_verb(CLI::App& program);
Verb make_verify_verb(CLI::App& program);
Verb make_info_verb(CLI::App& program);
Verb make_legal_verb(CLI::App& program);
Verb make_draw_verb(CLI::App& program);
Verb make_prune_verb(CLI::App& program);
Verb make_smooth_verb(CLI::App& program);
Verb make_rebuild_verb(CLI::App& program);
Verb make_features_verb(CLI::App& program);
Verb make_match_verb(CLI::App& program);
Verb make_pack_verb(CLI::App& program);
Verb make_unpack_verb(CLI::App& program);
Verb make_voronoi_verb(CLI::App& program);
Verb make_distance_verb(CLI::App& program);
Verb make_voxels_verb(CLI::App& program);
Verb make_bench_verb(CLI::App& program);
Verb make_field_verb(CLI::App& program);
Verb make_compare_verb(CLI::App& program);
Verb make_offset_verb(CLI::App& program);
Verb make_centreline_verb(CLI::App& program);
Verb make_measure_verb(CLI::App& program);
Verb make_carve_verb(CLI::App& program);

}  // namespace medial::cli
