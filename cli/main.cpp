// The command line: parses, calls the library, prints. Each command has its own file.

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/help.h"
#include "medial/threads.h"

namespace medial::cli {
namespace {

int requested_threads(const CLI::App& command) {
  const CLI::Option* option = command.get_option_no_throw("--threads");
  return option != nullptr && option->count() > 0 ? option->as<int>() : 0;
}

struct Maker {
  std::string_view name;
  MakeCommand* make;
  bool needs_others = false;  ///< the command inspects all other commands
};
/// In the order of the help.
constexpr Maker makers[] = {{"axis", make_axis_command},
                            {"verify", make_verify_command},
                            {"info", make_info_command},
                            {"legal", make_legal_command},
                            {"draw", make_draw_command},
                            {"prune", make_prune_command},
                            {"smooth", make_smooth_command},
                            {"rebuild", make_rebuild_command},
                            {"features", make_features_command},
                            {"match", make_match_command},
                            {"nest", make_nest_command},
                            {"pack", make_pack_command},
                            {"unpack", make_unpack_command},
                            {"voronoi", make_voronoi_command},
                            {"distance", make_distance_command},
                            {"voxels", make_voxels_command},
                            {"field", make_field_command},
                            {"compare", make_compare_command},
                            {"methods", make_methods_command},
                            {"offset", make_offset_command},
                            {"centreline", make_centreline_command},
                            {"measure", make_measure_command},
                            {"carve", make_carve_command},
                            {"tiles", make_tiles_command},
                            {"doctor", make_doctor_command},
                            {"help", make_help_command, true},
                            {"completion", make_completion_command, true}};

/// Prints the help, the version, or the error of the command line.
int explain_and_exit(const CLI::App& program, const CLI::ParseError& parse_error, bool json) {
  if (parse_error.get_exit_code() == 0) {
    std::ostringstream text;
    program.exit(parse_error, text, text);
    const Status printed = print(text.str());
    return printed ? exit_success : report_error(printed.error(), json);
  }
  const auto [text, hint] = explain(parse_error, program);
  return report_error(invalid_option(text), json, hint);
}

/// Adds the default value of an option whose value is optional, unless a number follows: CLI11
/// would take any next word.
void give_default_values(CLI::App& program, std::vector<std::string>& words) {
  const CLI::App* command = words.empty() ? nullptr : find_command(program, words[0]);
  if (command == nullptr) return;
  for (std::size_t i = 1; i < words.size() && words[i] != "--"; ++i) {
    const CLI::Option* option = command->get_option_no_throw(words[i]);
    double number = 0;
    if (option == nullptr || option->get_items_expected_min() > 0 ||
        option->get_items_expected_max() == 0 ||
        (i + 1 < words.size() && CLI::detail::lexical_cast(words[i + 1], number)))
      continue;
    words[i] += "=" + option->get_default_str();
  }
}

/// Parses the words with a program of these commands. Nothing if the program is not `whole` and the
/// words do not parse.
std::optional<int> run_with(std::span<const Maker> parts, std::vector<std::string> words, bool json,
                            bool whole) {
  CLI::App program(
      "Exact medial axis transform of shapes with holes: the centres of all maximal\n"
      "disks inside a shape, with their radii.");
  describe_program(program);
  std::vector<Command> commands;
  for (const Maker& maker : parts) {
    commands.push_back(maker.make(program));
    commands.back().app->group("Commands");
  }
  heed_help_anywhere(program);
  give_default_values(program, words);
  try {
    std::ranges::reverse(words);  // as CLI11 takes them
    program.parse(std::move(words));
  } catch (const CLI::ParseError& parse_error) {
    if (!whole) return std::nullopt;
    return explain_and_exit(program, parse_error, json);
  }
  const auto command = std::find_if(commands.begin(), commands.end(), [](const Command& candidate) {
    return candidate.app->parsed();
  });
  allow_startable_threads(requested_threads(*command->app));
  const Result<int> status = command->run();
  return status ? *status : report_error(status.error(), json);
}

int run(std::vector<std::string> words, bool json) {
  if (!words.empty() &&
      (words[0] == "-h" || words[0].starts_with("--help")))  // of the command that follows
    std::rotate(words.begin(), words.begin() + 1, words.end());
  // Building the options of all commands takes longer than most axes, and more memory.
  for (const Maker& maker : makers)
    if (!words.empty() && words[0] == maker.name && !maker.needs_others)
      if (const auto status = run_with({&maker, 1}, words, json, false)) return *status;
  return *run_with(makers, std::move(words), json, true);
}

}  // namespace
}  // namespace medial::cli

int main(int argc, char** argv) {
  using namespace medial;
  cli::occupy_standard_descriptors();
  // Look for --json before parsing, so that parse errors are JSON, too.
  const bool json =
      std::any_of(argv, argv + argc, [](const char* word) { return !std::strcmp(word, "--json"); });
  cli::install_signal_handlers();
  if (std::any_of(argv, argv + argc, [](const char* word) {
        return !std::strcmp(word, "--quiet") || !std::strcmp(word, "-q");
      }))
    cli::be_quiet();
  Error error{ErrorCode::internal, "something unexpected happened", {}};
  try {
    return cli::run({argv + 1, argv + argc}, json);
  } catch (const std::bad_alloc&) {
    error = {ErrorCode::out_of_memory, "memory ran out", {}};
  } catch (const std::exception& exception) {
    error.text += std::string(": ") + exception.what();
  } catch (...) {
  }
  io::remove_partial_files();
  return cli::report_error(error, json);
}
