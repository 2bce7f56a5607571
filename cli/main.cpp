// The command line: parses, calls the library, prints. One file for each command.

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/terminal.h"
#include "medial/threads.h"

namespace medial::cli {
namespace {

/// CLI11's help, with `--repair[=RULE]`, `--close[=GAP]` and `--specks[=SHARE]` for flags that may
/// carry a value.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(27); }

  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    std::string name = CLI::Formatter::make_option_name(option, is_positional);
    const auto brace = name.find('{');
    if (brace == std::string::npos) return name;
    const bool negative = name.find("{false}") == brace;
    name.resize(brace);
    if (negative) return name;
    return name + (name == "--close" ? "[=GAP]" : name == "--specks" ? "[=SHARE]" : "[=RULE]");
  }
};

int requested_threads(const CLI::App& command) {
  const CLI::Option* option = command.get_option_no_throw("--threads");
  return option != nullptr && option->count() > 0 ? option->as<int>() : 0;
}

int run(int argc, char** argv, bool json) {
  CLI::App program(
      "Exact medial axis transform of shapes with holes: all centres of the largest\n"
      "disks inside a shape, with their radii.");
  program.name("medial");
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_version_flag("--version", "medial " MEDIAL_VERSION, "Print the version.");
  program.set_help_flag("--help,-h", "Print this help.");
  program.require_subcommand(1);
  program.get_formatter()->label("SUBCOMMAND", "VERB");
  program.footer(
      "`medial VERB --help` tells each command's options, with examples.\n"
      "\n"
      "Exit status: 0 done; 1 `verify`, `legal` or `compare` refused an axis; 2 an error, told\n"
      "in one line on standard error as `medial: FILE: feature F, ring R, vertex V at (X, Y): "
      "what\n"
      "is wrong [code]`. Features, rings and vertices count from 0. Nothing is written\n"
      "then, and an interrupted run leaves no partial file.");
  const std::array commands = {
      make_axis_command(program),        //
      make_verify_command(program),      //
      make_info_command(program),        //
      make_legal_command(program),       //
      make_draw_command(program),        //
      make_prune_command(program),       //
      make_smooth_command(program),      //
      make_rebuild_command(program),     //
      make_features_command(program),    //
      make_match_command(program),       //
      make_pack_command(program),        //
      make_unpack_command(program),      //
      make_voronoi_command(program),     //
      make_distance_command(program),    //
      make_voxels_command(program),      //
      make_field_command(program),       //
      make_compare_command(program),     //
      make_methods_command(program),     //
      make_offset_command(program),      //
      make_centreline_command(program),  //
      make_measure_command(program),     //
      make_carve_command(program),       //
  };
  for (const Command& command : commands) command.app->group("Commands");

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& parse_error) {
    if (parse_error.get_exit_code() == 0) {  // help and version
      std::ostringstream text;
      program.exit(parse_error, text, text);
      const Status printed = print(text.str());
      return printed ? exit_success : report_error(printed.error(), json);
    }
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    if (chosen.empty()) {
      const std::vector<std::string> unknown = program.remaining();
      return report_error(invalid_option(unknown.empty() ? "a command is missing"
                                                         : "no such command: " + unknown[0]),
                          json, "; see medial --help");
    }
    const std::string hint = "; see medial " + chosen.back()->get_name() + " --help";
    return report_error(invalid_option(explain(parse_error, *chosen.back())), json, hint);
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
  // Whether errors are wanted as JSON has to be known even where the line cannot be parsed.
  const bool json =
      std::any_of(argv, argv + argc, [](const char* word) { return !std::strcmp(word, "--json"); });
  cli::install_signal_handlers();
  if (std::any_of(argv, argv + argc, [](const char* word) {
        return !std::strcmp(word, "--quiet") || !std::strcmp(word, "-q");
      }))
    cli::be_quiet();
  Error error{ErrorCode::internal, "something unexpected happened", {}};
  try {
    return cli::run(argc, argv, json);
  } catch (const std::bad_alloc&) {
    error = {ErrorCode::out_of_memory, "memory ran out", {}};
  } catch (const std::exception& exception) {
    error.text += std::string(": ") + exception.what();
  } catch (...) {
  }
  io::remove_partial_files();
  return cli::report_error(error, json);
}
