// medial features: end, normal and branching points, branches and their primitives.

#include "medial/features.h"

#include <fmt/format.h>

#include <array>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/io/write.h"

namespace medial::cli {
namespace {

struct FeatureArguments : FileArguments {
  io::FeatureWriteOptions table;  ///< except for `write`
  FeatureOptions options;
  Options axis;
};

constexpr double most = 1e3;  // of a threshold

/// The sums over all items.
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

Result<int> finish_features(const LoadedAxes& axes, std::span<const AxisFeatures> features,
                            const FeatureArguments& arguments) {
  if (!is_talkative(arguments)) return exit_success;
  const FeatureSummary sum = sum_of(features);
  Json object = {{"input", arguments.input.path}, {"unit", name_of(axes.file.unit)},
                 {"features", features.size()},   {"ends", sum.ends},
                 {"branchings", sum.branchings},  {"branches", sum.branches},
                 {"closed_branches", sum.closed}, {"runs", sum.runs},
                 {"length", sum.length}};
  object["primitives"] = shares<Primitive>(sum.primitive, sum.length);
  object["variations"] = shares<Variation>(sum.variation, sum.length);
  std::string text = fmt::format(
      "{}: {}, {}, {} ({} closed), {}\n", arguments.input.path, counted(sum.ends, "end"),
      counted(sum.branchings, "branching point"), counted(sum.branches, "branch", "branches"),
      sum.closed, counted(sum.runs, "primitive"));
  for (const char* kind : {"primitives", "variations"})
    for (const auto& [name, share] : object[kind].items())
      text += fmt::format("  {:<18}{:>6.1f} %\n", name, 100 * share.get<double>());
  const CommonOptions& common = arguments.common;
  if (!arguments.output.empty()) {
    if (!common.json && !common.quiet && error_is_terminal()) say_text(text);
    text.clear();
  }
  return finish(common, std::move(object), axes.phases, text);
}

Result<int> run_features(const FeatureArguments& arguments) {
  const CommonOptions& common = arguments.common;
  Status writable = check_output(arguments, io::formats_of(io::DocumentKind::features));
  if (!writable) return std::move(writable).error();
  auto axes = load_axes(arguments.input, common, 0, arguments.axis);
  if (!axes) return std::move(axes).error();
  const auto features =
      map_items<AxisFeatures>(edge_weights_of(axes->file), common.threads, [&](std::size_t i, int) {
        return medial::describe(axes->file.items[i].axis, arguments.options);
      });
  if (!features) return features.error();
  axes->phases.end("features");
  Status written = write_output(arguments, axes->phases, [&](const auto& path, const auto& format) {
    io::FeatureWriteOptions own = arguments.table;
    own.write = write_options(arguments);
    return io::write_features(path, format, axes->file, *features, own);
  });
  if (!written) return std::move(written).error();
  return finish_features(*axes, *features, arguments);
}

void add_thresholds(CLI::App& command, FeatureOptions& options) {
  const OptionGroup group(command, "Thresholds (no unit)");
  const auto add = [&](const char* name, double& value, const char* help) {
    add_value(command, name, value, "X", in_range(0, most),
              fmt::format("{} (default: {}).", help, value));
  };
  add("--parallel", options.parallel, "A worm's radius changes by at most this times its length");
  add("--even", options.even, "A worm's radius also changes by at most this times its mean");
  add("--bend", options.bend, "The slope of a cup's or flare's radius changes by more");
  add("--turn", options.turn, "A straight run turns by at most this, in radians");
  add("--spiral", options.spiral, "A spiral's curvature changes by more than this times its mean");
  add("--shortest", options.shortest,
      "Runs shorter than this times their radius are\njoined to a neighbour");
}

}  // namespace

Command make_features_command(CLI::App& program) {
  auto arguments = std::make_shared<FeatureArguments>();
  CLI::App* command = program.add_subcommand(
      "features", "Describe shapes by their branches and the primitives in them.");
  add_input_options(*command, arguments->input);
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::features));
  add_choice<io::FeatureTable>(
      *command, "--table", arguments->table.table,
      {{"runs", io::FeatureTable::runs},
       {"branches", io::FeatureTable::branches},
       {"points", io::FeatureTable::points}},
      "The content of .geojson .shp .fgb .csv: runs (default), branches or points;\n"
      ".json and .gpkg hold all.");
  command
      ->add_flag("!--no-names", arguments->table.names, "Pictures without the names of primitives.")
      ->group("Pictures");
  add_thresholds(*command, arguments->options);
  add_exterior_options(
      *command, arguments->axis,
      "Describe the exterior: around the shape, within a rectangle, and in holes.");
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "INPUT may be shapes, whose axes are then computed, or stored axes. A branch runs from\n"
      "its deeper end. Its radius divides it into primitives: worm (constant), wedge (linear),\n"
      "cup (bulging sides), flare (hollow sides), opening or closing; its curvature into seven\n"
      "variations: straight, circular, spiral in, spiral out, left or right (Blum and Nagel).\n"
      "Prune noisy outlines first.\n"
      "\n"
      "Examples:\n"
      "  medial features leaf.svg -o leaf-features.svg\n"
      "  medial axis plan.geojson -o - --format json | medial features - -o features.gpkg\n"
      "  medial features gear.dxf -o - --format csv --table branches");
  return command_of(command, arguments, run_features);
}

}  // namespace medial::cli
