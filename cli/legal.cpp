// medial legal: can these functions be medial axes at all?

#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "medial/sides.h"

namespace medial::cli {
namespace {

struct LegalArguments {
  std::string path;
  CommonOptions common;
  double slack = 1e-9;
};

constexpr double largest_slack = 1;
constexpr std::size_t most_branches_told = 20;

Json place_of(const AxisFrame& frame) {
  return {{"x", frame.disk.center.x}, {"y", frame.disk.center.y}, {"r", frame.disk.radius}};
}

Json json_of(const Legality& one, std::size_t branch, double slack) {
  Json object = {{"branch", branch}, {"frames", one.frames}};
  if (one.frames == 0) return object;
  object["legal"] = one.legal(slack);
  object["strictly_legal"] = one.strictly_legal(slack);
  object["steepness"] = one.steepness;
  object["steepest"] = place_of(one.steepest);
  object["bend"] = one.bend;
  object["sharpest"] = place_of(one.sharpest);
  return object;
}

/// Which restriction a branch breaks, and where.
std::string offence(const Legality& one, std::size_t feature, std::size_t branch, double slack) {
  const bool steep = one.steepness > slack;
  const AxisFrame& at = steep ? one.steepest : one.sharpest;
  return fmt::format(
      "feature {}, branch {}: {} at ({:.10g}, {:.10g})", feature, branch,
      steep
          ? fmt::format("too steep a radius, |R'| exceeds 1 by {:.3g}", one.steepness)
          : fmt::format("too sharp a bend, |K| R sqrt(1 - R'^2) exceeds 1 - R'^2 - R R'' by {:.3g}",
                        one.bend),
      at.disk.center.x, at.disk.center.y);
}

Result<int> run_legal(const LegalArguments& arguments) {
  const Stopwatch reading;
  const auto file = io::read_native(arguments.path);
  if (!file) return file.error();
  const double seconds_read = reading.seconds();
  const Stopwatch judging;
  std::vector<std::vector<Legality>> judged;
  for (const AxisItem& item : file->items) judged.push_back(legality(item.axis));
  const double seconds_legal = judging.seconds();

  std::uint64_t count = 0, told = 0, legal = 0, strict = 0;
  std::vector<std::string> offences;
  Json features = Json::array();
  for (std::size_t i = 0; i < judged.size(); ++i) {
    Json list = Json::array();
    for (std::size_t k = 0; k < judged[i].size(); ++k) {
      const Legality& one = judged[i][k];
      ++count;
      if (arguments.common.json) list.push_back(json_of(one, k, arguments.slack));
      if (one.frames == 0) continue;
      ++told;
      strict += one.strictly_legal(arguments.slack) ? 1 : 0;
      if (one.legal(arguments.slack)) {
        ++legal;
      } else {
        offences.push_back(offence(one, i, k, arguments.slack));
      }
    }
    if (arguments.common.json) features.push_back({{"branches", std::move(list)}});
  }

  const Json costs = {{"seconds", {{"read", seconds_read}, {"legal", seconds_legal}}},
                      {"peak_bytes", peak_bytes()}};
  Status printed = success();
  if (arguments.common.json) {
    Json object = {{"axis", arguments.path},   {"legal", offences.empty()},
                   {"branches", count},        {"judged", told},
                   {"legal_branches", legal},  {"strictly_legal_branches", strict},
                   {"slack", arguments.slack}, {"features", std::move(features)}};
    if (arguments.common.stats) object.update(costs);
    printed = print(object);
  } else if (!arguments.common.quiet) {
    std::string text;
    const auto row = [&text](const char* name, const std::string& value) {
      text += fmt::format("{:<16}{}\n", name, value);
    };
    row("branches", fmt::format("{}", count));
    row("judged",
        fmt::format("{}{}", told,
                    told < count ? " (the others are too short or too rough to tell)" : ""));
    row("legal", fmt::format("{}", legal));
    row("strictly legal", fmt::format("{}", strict));
    for (std::size_t i = 0; i < std::min(offences.size(), most_branches_told); ++i) {
      row("illegal", offences[i]);
    }
    if (offences.size() > most_branches_told) {
      row("illegal", fmt::format("and {} more", offences.size() - most_branches_told));
    }
    for (const AxisItem& item : file->items)
      if (item.axis.method == "pack")
        row("within", fmt::format("{:.6g}, the error of the pack", item.axis.resolution));
    row("verdict", !offences.empty() ? "ILLEGAL"
                   : told > 0        ? "legal"
                                     : "legal, as far as is known");
    printed = print(text);
  }
  if (!printed) return std::move(printed).error();
  if (arguments.common.stats && !arguments.common.json) say_text(table(costs));
  return offences.empty() ? exit_success : exit_failed_verdict;
}

}  // namespace

Command make_legal_command(CLI::App& program) {
  auto arguments = std::make_shared<LegalArguments>();
  CLI::App* command = program.add_subcommand(
      "legal", "Tell whether functions can be medial axes, branch by branch.");
  command
      ->add_option("AXIS", arguments->path,
                   "Axes in medial's own .json format; - is standard input.")
      ->required()
      ->option_text("REQUIRED");
  command
      ->add_option("--slack", arguments->slack,
                   "By how much the restrictions may be missed, no unit (default: 1e-9); more\n"
                   "for samples, whose derivatives are differences.")
      ->check(in_range(0, largest_slack))
      ->option_text("S");
  command->add_flag("--stats", arguments->common.stats, "Tell times and memory.")->group("Output");
  command->add_flag("--json", arguments->common.json, "Print one JSON object on standard output.")
      ->group("Output");
  command->add_flag("--quiet", arguments->common.quiet, "Only the exit status, and errors.")
      ->group("Output");
  command->footer(
      "A curve with a radius function is the medial axis of some shape only if nowhere\n"
      "the radius changes faster than the way, |R'| <= 1, nor the curve bends too\n"
      "sharply, 1 - R'^2 - R R'' >= |K| R sqrt(1 - R'^2) (Shaked and Bruckstein 1996,\n"
      "(9) and (10)); where both hold strictly it is one locally. No shape is needed.\n"
      "Branches count as in the native format's edges: by their lowest edge. Of an\n"
      "unpacked axis only what its error does not explain is illegal.\n"
      "\n"
      "Exit status: 0 legal, 1 illegal, 2 an error.\n"
      "\n"
      "Examples:\n"
      "  medial axis plan.geojson -o plan.json && medial legal plan.json\n"
      "  medial legal --json drawn.json");
  return {command, [arguments] { return run_legal(*arguments); }};
}

}  // namespace medial::cli
