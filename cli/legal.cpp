// medial legal: checks whether curves with radii can be medial axes; boundary curvature.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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
  std::string curvature;  ///< a path, or empty
  io::WriteOptions write;
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

/// The condition that a branch violates, and where.
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

/// With `listed`, every branch becomes an object.
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
                                                : "legal, but no branch could be judged");
  return rows.text();
}

using Curvatures = std::vector<std::vector<FootCurvature>>;  // by branch

/// feature,branch,side and the disk, its foot, the curvature there and its derivative.
std::string curvature_csv(const std::vector<Curvatures>& all) {
  std::string text = "feature,branch,side,axis_x,axis_y,r,x,y,curvature,slope\n";
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < all[i].size(); ++k)
      for (const FootCurvature& at : all[i][k])
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{}\n", i, k,
                       at.side == Side::left ? "left" : "right", at.disk.center.x, at.disk.center.y,
                       at.disk.radius, at.foot.x, at.foot.y, at.curvature, at.slope);
  return text;
}

template <class Act>
void each_foot(const std::vector<Curvatures>& all, const Act& act) {
  for (std::uint32_t i = 0; i < all.size(); ++i)
    for (const auto& branch : all[i])
      for (const FootCurvature& at : branch) act(i, at);
}

/// Lines from foot points towards the centre of curvature (inside where the shape is convex), with
/// lengths proportional to the curvature: its 95 % quantile is 5 % of the size long.
io::Layer curvature_comb(const std::vector<Curvatures>& all) {
  constexpr double apart = 0.003;  // teeth, as a share of the size
  std::vector<double> sizes;
  Box box{{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  each_foot(all, [&](std::uint32_t, const FootCurvature& at) {
    sizes.push_back(std::abs(at.curvature));
    box.low = {std::min(box.low.x, at.foot.x), std::min(box.low.y, at.foot.y)};
    box.high = {std::max(box.high.x, at.foot.x), std::max(box.high.y, at.foot.y)};
  });
  io::Layer comb{"curvature", io::LayerKind::lines, {"curvature", "slope", "r"}, {}};
  if (sizes.empty()) return comb;
  const auto large = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 19 / 20);
  std::nth_element(sizes.begin(), large, sizes.end());
  if (!(*large > 0)) return comb;
  const double size = distance(box.low, box.high), longest = 0.05 * size;
  Vec2 last{INFINITY, INFINITY};
  each_foot(all, [&](std::uint32_t i, const FootCurvature& at) {
    if (!(at.disk.radius > 0) || distance(at.foot, last) < apart * size) return;
    last = at.foot;
    const Vec2 inwards = (1 / at.disk.radius) * (at.disk.center - at.foot);
    const double tooth = std::clamp(longest / *large * at.curvature, -longest, longest);
    comb.features.push_back(
        {i, {{at.foot, at.foot + tooth * inwards}}, {at.curvature, at.slope, at.disk.radius}});
  });
  return comb;
}

Status write_curvatures(const Document<AxisItem>& file, const LegalArguments& arguments) {
  if (arguments.curvature.empty()) return success();
  std::vector<Curvatures> all;
  for (const AxisItem& item : file.items) {
    Curvatures& own = all.emplace_back();
    for (const Branch& branch : branches(item.axis))
      own.push_back(curvatures_along(item.axis, branch));
  }
  if (arguments.curvature.ends_with(".csv"))
    return io::write_text(arguments.curvature, curvature_csv(all));
  Document<io::Layer> layers{file, {}};
  layers.items.push_back(curvature_comb(all));
  return io::write_layers(arguments.curvature, {}, layers, file, arguments.write);
}

Result<int> run_legal(const LegalArguments& arguments) {
  Phases phases;
  if (Status writable =
          check_output(arguments.curvature, {}, io::formats_of(io::DocumentKind::layers),
                       arguments.path, arguments.common.json);
      !writable)
    return std::move(writable).error();
  const auto file = io::read_native(arguments.path);
  if (!file) return file.error();
  phases.end("read");
  Verdict verdict = judge(*file, arguments.slack, arguments.common.json);
  phases.end("legal");
  if (Status written = write_curvatures(*file, arguments); !written)
    return std::move(written).error();
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
                   "Axes in medial's own .json or .safetensors; - is standard input.")
      ->required()
      ->option_text("REQUIRED");
  add_value(*command, "--slack", arguments->slack, "S", in_range(0, largest_slack),
            "The largest violation of the conditions to accept, dimensionless (default: 1e-9).\n"
            "Sampled axes, whose derivatives are finite differences, need more.");
  add_value(*command, "--curvature", arguments->curvature, "FILE", a_name(),
            "Write the boundary's curvature at the foot points of disks, and its derivative\n"
            "along the boundary: as numbers (.csv), or as a comb of lines:\n" +
                io::formats_of(io::DocumentKind::layers));
  add_width_option(*command, arguments->write.width);
  add_report_options(*command, arguments->common);
  command->footer(
      "A curve with a radius function is the medial axis of some shape only if the radius\n"
      "changes no faster than the arc length, |R'| <= 1, and the curve does not bend too\n"
      "sharply, 1 - R'^2 - R R'' >= |K| R sqrt(1 - R'^2) (Shaked and Bruckstein 1996,\n"
      "(9) and (10)). If both hold strictly, each short piece is the axis of its own disks'\n"
      "union. No shape is needed.\n"
      "Branches are ordered by their lowest edge in the native format. In an unpacked\n"
      "axis, only violations that its error cannot explain are illegal.\n"
      "\n"
      "Exit status: 0 legal, 1 illegal, 2 an error.\n"
      "\n"
      "Examples:\n"
      "  medial axis plan.geojson -o plan.json && medial legal plan.json\n"
      "  medial legal --json drawn.json\n"
      "  medial legal curve.json --slack 0.01 --curvature comb.png");
  return command_of(command, arguments, run_legal);
}

}  // namespace medial::cli
