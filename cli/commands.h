#pragma once

#include <functional>
#include <memory>
#include <type_traits>

#include "cli/common.h"

namespace medial::cli {

/// A command: its place on the command line, and what to do once the line is parsed. `run` gives
/// the exit status, or the error that main() reports.
struct Command {
  CLI::App* app = nullptr;
  std::function<Result<int>()> run;
};
/// Errors that name a feature, but no file, are of the command's input.
template <class Arguments>
Command command_of(CLI::App* app, std::shared_ptr<Arguments> arguments,
                   Result<int> (*run)(const Arguments&)) {
  return {app, [arguments, run] {
            Result<int> status = run(*arguments);
            if constexpr (std::is_base_of_v<FileArguments, Arguments>) {
              if (!status && status.error().place.feature && status.error().place.file.empty())
                status.error().place.file = arguments->input.path;
            }
            return status;
          }};
}

/// Each adds its command to the program; each has a file of its own.
using MakeCommand = Command(CLI::App& program);
MakeCommand make_axis_command, make_verify_command, make_info_command, make_legal_command,
    make_draw_command, make_prune_command, make_smooth_command, make_rebuild_command,
    make_features_command, make_match_command, make_nest_command, make_pack_command,
    make_unpack_command, make_voronoi_command, make_distance_command, make_voxels_command,
    make_methods_command, make_field_command, make_compare_command, make_offset_command,
    make_centreline_command, make_measure_command, make_carve_command, make_doctor_command,
    make_tiles_command, make_help_command, make_completion_command;

}  // namespace medial::cli
