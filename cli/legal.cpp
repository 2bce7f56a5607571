// medial legal: can these functions be medial axes at all?

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/sides.h"

namespace medial::cli {
namespace {

struct LegalArguments {
  std::string path;
  CommonOptions common;
  double slack = 1e-9;
};

constexpr double largest_slack = 1;
constexpr std::size_t most_offences_shown = 20;

Json place_of(const AxisJet& jet) {
  return {{"x", jet.disk.center.x}, {"y", jet.disk.center.y}, {"r", jet.disk.radius}};
}

Json json_of(const Legality& one, std::size_t branch, double slack) {
  Json object = {{"branch", branch}, {"frames", one.jets}};
  if (one.jets == 0) return object;
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
  const AxisJet& at = steep ? one.steepest : one.sharpest;
  return fmt::format(
      "feature {}, branch {}: {} at ({:.10g}, {:.10g})", feature, branch,
      steep
          ? fmt::format("too steep a radius, |R'| exceeds 1 by {:.3g}", one.steepness)
          : fmt::format("too sharp a bend, |K| R sqrt(1 - R'^2) exceeds 1 - R'^2 - R R'' by {:.3g}",
                        one.bend),
      at.disk.center.x, at.disk.center.y);
}

/// All branches of a file.
struct Verdict {
  std::uint64_t branches = 0, judged = 0, legal = 0, strict = 0;
  std::vector<std::string> offences;
  Json features = Json::array();
};

/// With `listed` every branch becomes an object.
Verdict judge(const Document<AxisItem>& file, double slack, bool listed) {
  Verdict verdict;
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    Json list = Json::array();
    const std::vector<Legality> branches = legality(file.items[i].axis);
    verdict.branches += branches.size();
    for (std::size_t branch = 0; branch < branches.size(); ++branch) {
      const Legality& one = branches[branch];
      if (listed) list.push_back(json_of(one, branch, slack));
      if (one.jets == 0) continue;
      ++verdict.judged;
      verdict.strict += one.strictly_legal(slack) ? 1 : 0;
      if (one.legal(slack)) {
        ++verdict.legal;
      } else {
        verdict.offences.push_back(offence(one, i, branch, slack));
      }
    }
    verdict.features.push_back({{"branches", std::move(list)}});
  }
  return verdict;
}

std::string text_of(const Verdict& verdict, const Document<AxisItem>& file) {
  Rows rows(16);
  rows.add("branches", verdict.branches);
  rows.add("judged", fmt::format("{}{}", verdict.judged,
                                 verdict.judged < verdict.branches
                                     ? " (the others are too short or too rough to judge)"
                                     : ""));
  rows.add("legal", verdict.legal);
  rows.add("strictly legal", verdict.strict);
  const std::size_t shown = std::min(verdict.offences.size(), most_offences_shown);
  for (std::size_t i = 0; i < shown; ++i) rows.add("illegal", verdict.offences[i]);
  if (verdict.offences.size() > shown)
    rows.add("illegal", fmt::format("and {} more", verdict.offences.size() - shown));
  for (const AxisItem& item : file.items)
    if (item.axis.method == "pack")
      rows.add("within", fmt::format("{:.6g}, the error of the pack", item.axis.resolution));
  rows.add("verdict", !verdict.offences.empty() ? "ILLEGAL"
                      : verdict.judged > 0      ? "legal"
                                                : "legal, as far as is known");
  return rows.text();
}

Result<int> run_legal(const LegalArguments& arguments) {
  Phases phases;
  const auto file = io::read_native(arguments.path);
  if (!file) return file.error();
  phases.end("read");
  Verdict verdict = judge(*file, arguments.slack, arguments.common.json);
  phases.end("legal");
  const bool legal = verdict.offences.empty();
  return finish(arguments.common,
                {{"axis", arguments.path},
                 {"legal", legal},
                 {"branches", verdict.branches},
                 {"judged", verdict.judged},
                 {"legal_branches", verdict.legal},
                 {"strictly_legal_branches", verdict.strict},
                 {"slack", arguments.slack},
                 {"features", std::move(verdict.features)}},
                phases, arguments.common.quiet ? std::string() : text_of(verdict, *file), {},
                legal ? exit_success : exit_failed_verdict);
}

}  // namespace

Command make_legal_command(CLI::App& program) {
  auto arguments = std::make_shared<LegalArguments>();
  CLI::App* command = program.add_subcommand(
      "legal", "Check whether curves with radii can be medial axes, branch by branch.");
  command
      ->add_option("AXIS", arguments->path,
                   "Axes in medial's own .json format; - is standard input.")
      ->required()
      ->option_text("REQUIRED");
  add_value(*command, "--slack", arguments->slack, "S", in_range(0, largest_slack),
            "By how much the restrictions may be missed, no unit (default: 1e-9); more\n"
            "for samples, whose derivatives are differences.");
  add_report_options(*command, arguments->common);
  command->footer(
      "A curve with a radius function is the medial axis of some shape only if the radius\n"
      "changes no faster than the arc length, |R'| <= 1, and the curve does not bend too\n"
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
  return command_of(command, arguments, run_legal);
}

}  // namespace medial::cli
