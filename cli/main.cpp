// The command line: parses, calls the library, prints. One file for each command.

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <new>
#include <sstream>
#include <string>
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

/// In the order of the help.
constexpr MakeCommand* makers[] = {
    make_axis_command,       make_verify_command,  make_info_command,      make_legal_command,
    make_draw_command,       make_prune_command,   make_smooth_command,    make_rebuild_command,
    make_features_command,   make_match_command,   make_nest_command,      make_pack_command,
    make_unpack_command,     make_voronoi_command, make_distance_command,  make_voxels_command,
    make_field_command,      make_compare_command, make_methods_command,   make_offset_command,
    make_centreline_command, make_measure_command, make_carve_command,     make_tiles_command,
    make_doctor_command,     make_help_command,    make_completion_command};

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

int run(std::vector<std::string> words, bool json) {
  CLI::App program(
      "Exact medial axis transform of shapes with holes: the centres of all maximal\n"
      "disks inside a shape, with their radii.");
  describe_program(program);
  std::vector<Command> commands;
  for (MakeCommand* make : makers) {
    commands.push_back(make(program));
    commands.back().app->group("Commands");
  }
  heed_help_anywhere(program);
  if (!words.empty() &&
      (words[0] == "-h" || words[0].starts_with("--help")))  // of the command that follows
    std::rotate(words.begin(), words.begin() + 1, words.end());
  give_default_values(program, words);
  try {
    std::ranges::reverse(words);  // as CLI11 takes them
    program.parse(std::move(words));
  } catch (const CLI::ParseError& parse_error) {
    return explain_and_exit(program, parse_error, json);
  }
  const auto command = std::find_if(commands.begin(), commands.end(), [](const Command& candidate) {
    return candidate.app->parsed();
  });
  allow_startable_threads(requested_threads(*command->app));
  const Result<int> status = command->run();
  return status ? *status : report_error(status.error(), json);
}

}  // namespace
}  // namespace medial::cli

int main(int argc, char** argv) {
  using namespace medial;
  cli::occupy_standard_descriptors();
  // Find out whether errors should be JSON even if the line cannot be parsed.
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
