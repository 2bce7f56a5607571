// medial features: end, normal and branching points, branches and their primitives.

#include "medial/features.h"

#include <fmt/format.h>

#include <array>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/stored_axes.h"
#include "cli/terminal.h"
#include "medial/io/write.h"

namespace medial::cli {
namespace {

struct FeatureArguments {
  InputOptions input;
  CommonOptions common;
  std::string output;
  std::string format;
  io::FeatureWriteOptions write;
  FeatureOptions options;
  Options axis;
};

constexpr double most = 1e3;  // of a threshold

/// What there is to tell of all items together.
struct FeatureSummary {
  std::uint64_t ends = 0, branchings = 0, branches = 0, closed = 0, runs = 0;
  double length = 0;
  std::array<double, primitive_count> primitive{};
  std::array<double, variation_count> variation{};
};

FeatureSummary sum_of(std::span<const AxisFeatures> features) {
  FeatureSummary sum;
  for (const AxisFeatures& item : features) {
    sum.ends += item.ends;
    sum.branchings += item.branchings;
    sum.branches += item.branches.size();
    sum.closed += item.closed_branches;
    sum.runs += item.runs.size();
    sum.length += item.length;
    for (const PrimitiveRun& run : item.runs) {
      sum.primitive[static_cast<std::size_t>(run.primitive)] += run.length;
      sum.variation[static_cast<std::size_t>(run.variation)] += run.length;
    }
  }
  return sum;
}

/// Shares by name, of those that are not 0.
template <class Kind, std::size_t N>
Json shares(const std::array<double, N>& lengths, double total) {
  Json object = Json::object();
  for (std::size_t i = 0; i < N; ++i)
    if (lengths[i] > 0) object[name_of(static_cast<Kind>(i))] = lengths[i] / total;
  return object;
}

Status tell(const AxisFile& file, std::span<const AxisFeatures> features,
            const FeatureArguments& arguments, double seconds_features, double seconds_write) {
  const auto& common = arguments.common;
  const bool terminal = !arguments.output.empty() && error_is_terminal() && !common.quiet;
  if (!common.json && !common.stats && !arguments.output.empty() && !terminal) return success();
  const FeatureSummary sum = sum_of(features);
  const Json costs = {{"seconds",
                       {{"read", file.seconds_read},
                        {"shape", file.seconds_shape},
                        {"axis", file.seconds_axis},
                        {"features", seconds_features},
                        {"write", seconds_write}}},
                      {"peak_bytes", peak_bytes()}};
  if (common.json) {
    Json object = {{"input", arguments.input.path},
                   {"features", features.size()},
                   {"ends", sum.ends},
                   {"branchings", sum.branchings},
                   {"branches", sum.branches},
                   {"closed_branches", sum.closed},
                   {"runs", sum.runs},
                   {"length", sum.length}};
    object["primitives"] = shares<Primitive>(sum.primitive, sum.length);
    object["variations"] = shares<Variation>(sum.variation, sum.length);
    if (common.stats) object.update(costs);
    return print(object);
  }
  std::string text = fmt::format(
      "{}: {}, {}, {} ({} closed), {}\n", arguments.input.path, counted(sum.ends, "end"),
      counted(sum.branchings, "branching point"), counted(sum.branches, "branch", "branches"),
      sum.closed, counted(sum.runs, "primitive"));
  const auto rows = [&text, &sum]<class Kind, std::size_t N>(Kind,
                                                             const std::array<double, N>& lengths) {
    for (std::size_t i = 0; i < N; ++i)
      if (lengths[i] > 0)
        text += fmt::format("  {:<18}{:>6.1f} %\n", name_of(static_cast<Kind>(i)),
                            100 * lengths[i] / sum.length);
  };
  rows(Primitive{}, sum.primitive);
  rows(Variation{}, sum.variation);
  if (common.stats) say_text(table(costs));
  if (arguments.output.empty()) return print(text);
  if (terminal) say_text(text);
  return success();
}

Result<int> run_features(const FeatureArguments& arguments) {
  const InputOptions& input = arguments.input;
  const CommonOptions& common = arguments.common;
  const std::string &output = arguments.output, &format = arguments.format;
  Status writable = check_output(output, format, io::formats_of(io::DocumentKind::features),
                                 input.path, common.json);
  if (!writable) return std::move(writable).error();
  auto axes = load_axes(input, common, 0, arguments.axis);
  if (!axes) return std::move(axes).error();
  const Stopwatch watch;
  std::vector<AxisFeatures> features(axes->native.items.size());
  std::vector<double> weights;
  for (const AxisItem& item : axes->native.items)
    weights.push_back(static_cast<double>(item.axis.edges.size()) + 1);
  Status described = for_each_feature(weights, common.threads, [&](std::size_t i, int) {
    features[i] = describe(axes->native.items[i].axis, arguments.options);
    return success();
  });
  if (!described) return std::move(described).error();
  const double seconds = watch.seconds();
  const Stopwatch writing;
  if (!output.empty()) {
    io::FeatureWriteOptions own = arguments.write;
    own.write.chord = common.chord;
    const Activity shown("writing", output);
    Status written = io::write_features(output, format, axes->native, features, own);
    if (!written) return std::move(written).error();
  }
  Status told = tell(*axes, features, arguments, seconds, output.empty() ? 0 : writing.seconds());
  if (!told) return std::move(told).error();
  return exit_success;
}

void add_thresholds(CLI::App& command, FeatureOptions& options) {
  constexpr char group[] = "Thresholds (no unit)";
  const auto add = [&](const char* name, double& value, const char* help) {
    command.add_option(name, value, fmt::format("{} (default: {}).", help, value))
        ->check(in_range(0, most))
        ->option_text("X")
        ->group(group);
  };
  add("--parallel", options.parallel, "A worm's radius changes by at most this times its length,");
  add("--even", options.even, "and by at most this times its mean radius");
  add("--bend", options.bend, "A cup's or flare's rate of the radius changes by more");
  add("--turn", options.turn, "A straight run turns by at most this, in radians");
  add("--spiral", options.spiral, "A spiral's curvature changes by more, over its mean");
  add("--shortest", options.shortest,
      "Runs shorter than this times their radius are\njoined to a neighbour");
}

}  // namespace

Command make_features_command(CLI::App& program) {
  auto arguments = std::make_shared<FeatureArguments>();
  CLI::App* command = program.add_subcommand(
      "features", "Describe shapes by their branches and what these are made of.");
  add_input_options(*command, arguments->input);
  add_output_options(*command, arguments->output, arguments->format,
                     io::formats_of(io::DocumentKind::features));
  command
      ->add_option_function<std::string>(
          "--table",
          [arguments](const std::string& name) {
            arguments->write.table = name == "runs"       ? io::FeatureTable::runs
                                     : name == "branches" ? io::FeatureTable::branches
                                                          : io::FeatureTable::points;
          },
          "What .geojson .shp .fgb .csv hold: runs (default), branches or points;\n"
          ".json and .gpkg hold all.")
      ->check(CLI::IsMember({"runs", "branches", "points"}).description(""))
      ->option_text("NAME");
  command
      ->add_flag("!--no-names", arguments->write.names, "Pictures without the names of primitives.")
      ->group("Pictures");
  add_thresholds(*command, arguments->options);
  add_exterior_options(*command, arguments->axis,
                       "Of what lies around the shape and in its holes, within a frame.");
  add_picture_options(*command, arguments->write.write);
  add_common_options(*command, arguments->common);
  command->footer(
      "INPUT may be shapes, whose axes are then computed, or medial's own .json. A branch\n"
      "runs from its deeper end. It is cut into primitives by its radius: worm (even),\n"
      "wedge (linear), cup (bulging sides), flare (hollow sides), opening or closing; in\n"
      "seven variations by its curvature: straight, circular, spiral in, spiral out, left or\n"
      "right (Blum and Nagel). Prune noisy outlines first.\n"
      "\n"
      "Examples:\n"
      "  medial features leaf.svg -o leaf-features.svg\n"
      "  medial axis plan.geojson -o - --format json | medial features - -o features.gpkg\n"
      "  medial features gear.dxf -o - --format csv --table branches");
  return {command, [arguments] { return run_features(*arguments); }};
}

}  // namespace medial::cli
