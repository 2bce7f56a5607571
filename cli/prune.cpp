// medial prune: axes less what does not matter.

#include "medial/prune.h"

#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/prune_options.h"
#include "cli/stored_axes.h"
#include "cli/terminal.h"
#include "medial/io/write.h"
#include "medial/match.h"
#include "medial/query.h"

namespace medial::cli {

namespace {

const char* help_of(PruneMeasure measure) {
  switch (measure) {
    case PruneMeasure::prominence:
      return "Branches by the geometric mean of significance and of the same by R";
    case PruneMeasure::significance:
      return "Branches by how far the shape reaches out beyond the disk where they\n"
             "begin, by that disk's radius (Ho and Dyer)";
    case PruneMeasure::length:
      return "Branches by their longest way to an end, by that radius";
    case PruneMeasure::ratio:
      return "Branches by the boundary beyond that disk, by the chord it stands on";
    case PruneMeasure::radius:
      return "Points by their radius, by R";
    case PruneMeasure::angle:
      return "Points by the angle between the radii to the boundary, in degrees";
    case PruneMeasure::erosion:
      return "Points by erosion thickness: how far the shape reaches out, by R";
    case PruneMeasure::potential:
      return "Points by the length of the boundary beyond, by 2 pi R";
    case PruneMeasure::residual:
      return "Points by that length less the chord it stands on, by 2 R";
    case PruneMeasure::area:
      return "Points by the area that would be lost, by that of the shape";
    case PruneMeasure::lambda:
      return "The lambda medial axis: the smallest circle around the feet, by R";
    case PruneMeasure::scale:
      return "The scale axis: the growth that hides a disk in another, from 1 up";
  }
  return "";
}

}  // namespace

void add_prune_options(CLI::App& command, PruneArguments& arguments) {
  constexpr char group[] = "What matters";
  arguments.thresholds.resize(prune_measures().size());
  std::vector<CLI::Option*> options;
  for (const PruneMeasure measure : prune_measures()) {
    CLI::Option* option = command
                              .add_option(fmt::format("--{}", name_of(measure)),
                                          arguments.thresholds[static_cast<std::size_t>(measure)],
                                          fmt::format("{} (default: {}).", help_of(measure),
                                                      default_threshold(measure)))
                              ->check(in_range(0, 1e9))
                              ->option_text("T")
                              ->group(group);
    for (CLI::Option* other : options) option->excludes(other);
    options.push_back(option);
  }
  CLI::Option* by =
      command
          .add_option("--by", arguments.by,
                      "One of these measures with its default, or for --keep (default:\n"
                      "prominence).")
          ->option_text("MEASURE")
          ->group(group);
  CLI::Option* keep = command
                          .add_option("--keep", arguments.keep,
                                      "The most important branches, so many at most for each\n"
                                      "feature, instead of a threshold.")
                          ->check(a_whole_number())
                          ->option_text("N")
                          ->group(group);
  for (CLI::Option* option : options) {
    by->excludes(option);
    keep->excludes(option);
  }
  command
      .add_flag("--tips", arguments.tips,
                "What is kept runs on to its tips, along the ways that reach farthest.")
      ->group(group);
  // A flag that carries a value, as --repair is one.
  command
      .add_flag(
          fmt::format("--specks{{{}}}", speck_share), arguments.speck_share,
          fmt::format("Leave out specks before: holes and parts with a bounding box whose\n"
                      "diagonal is below this share of the square root of the feature's area\n"
                      "(without a value: {}). Stored axes are computed anew.",
                      speck_share))
      ->check(in_range(0, 1, true))
      ->each([&arguments](const std::string& share) {
        CLI::detail::lexical_cast(share, arguments.specks);
      })
      ->group(group);
}

Result<PruneOptions> prune_options(const PruneArguments& arguments) {
  PruneOptions options;
  options.keep = arguments.keep;
  options.tips = arguments.tips;
  if (!arguments.by.empty()) {
    const auto measure = prune_measure_from(arguments.by);
    if (!measure) {
      std::string names;
      for (const PruneMeasure one : prune_measures()) names += fmt::format(" {}", name_of(one));
      return invalid_option(fmt::format("--by takes no '{}', only one of:{}", arguments.by, names));
    }
    options.measure = *measure;
  }
  for (std::size_t i = 0; i < arguments.thresholds.size(); ++i) {
    if (!arguments.thresholds[i]) continue;
    options.measure = prune_measures()[i];
    options.threshold = arguments.thresholds[i];
  }
  return options;
}

Result<PruneReport> prune_all(AxisFile& file, const PruneOptions& options, int threads) {
  std::vector<double> weights;
  for (const AxisItem& item : file.native.items)
    weights.push_back(static_cast<double>(item.axis.edges.size()));
  std::vector<PruneReport> reports(weights.size());
  Status done = for_each_feature(weights, threads, [&](std::size_t i, int) -> Status {
    MedialAxis& axis = file.native.items[i].axis;
    auto pruned = prune(axis, options, &reports[i]);
    if (!pruned) return std::move(pruned).error();
    axis = std::move(pruned).value();
    return success();
  });
  if (!done) return std::move(done).error();
  PruneReport sum;
  for (const PruneReport& one : reports) {
    sum.threshold = std::max(sum.threshold, one.threshold);
    sum.edges_before += one.edges_before;
    sum.edges += one.edges;
    sum.branches_before += one.branches_before;
    sum.branches += one.branches;
    sum.cuts += one.cuts;
  }
  return sum;
}

namespace {

struct PruneVerbArguments {
  InputOptions input;
  CommonOptions common;
  PruneArguments prune;
  std::string output;
  std::string format;
  io::WriteOptions write;
  Options options;
  bool preview = false;
};

/// The axes at thresholds around the chosen one, side by side.
Status write_previews(const AxisFile& file, const PruneOptions& options,
                      const PruneVerbArguments& arguments) {
  const double chosen = options.threshold.value_or(default_threshold(options.measure));
  std::vector<double> thresholds;
  for (const double factor : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    if (options.measure == PruneMeasure::angle) {  // from 0 to 180 degrees
      const double half = factor <= 1 ? chosen * factor : chosen + (180 - chosen) * factor / 5;
      thresholds.push_back(half);
    } else if (options.measure == PruneMeasure::scale ||
               options.measure == PruneMeasure::ratio) {  // from 1 up
      thresholds.push_back(1 + (chosen - 1) * factor);
    } else {
      thresholds.push_back(chosen * factor);
    }
  }
  std::vector<io::PreviewPanel> panels;
  for (const double threshold : thresholds)
    panels.push_back({fmt::format("{} {:.3g}", name_of(options.measure), threshold), {}});
  std::vector<Shape> shapes;
  for (const AxisItem& item : file.native.items) {
    shapes.push_back(item.shape);
    const PruneOrder order(item.axis, options.measure, options.tips);
    for (std::size_t i = 0; i < panels.size(); ++i)
      panels[i].axes.push_back(order.at(thresholds[i]));
  }
  return io::write_preview(arguments.output, arguments.format, shapes, panels,
                           arguments.write.width, file.native.y_down);
}

Result<int> run_prune(const PruneVerbArguments& arguments) {
  const auto& [input, common, how, output, format, pictures, axis_options, preview] = arguments;
  if (preview && (output.empty() || how.keep))
    return invalid_option("--preview needs -o with the name of a picture, and no --keep");
  const auto options = prune_options(how);
  if (!options) return options.error();
  Status writable = check_output(
      output, format,
      preview ? io::formats_of(io::DocumentKind::preview) : io::formats_of(io::DocumentKind::axes),
      input.path, common.json);
  if (!writable) return std::move(writable).error();
  auto axes = load_axes(input, common, how.specks, axis_options);
  if (!axes) return std::move(axes).error();
  if (preview) {
    Status written = write_previews(*axes, *options, arguments);
    if (!written) return std::move(written).error();
    return exit_success;
  }
  const Stopwatch pruning;
  const auto report = prune_all(*axes, *options, common.threads);
  if (!report) return report.error();
  const double seconds = pruning.seconds();
  if (common.stats && !common.json) {
    say_text(table({{"measure", name_of(options->measure)},
                    {"threshold", report->threshold},
                    {"branches_before", report->branches_before},
                    {"edges_before", report->edges_before},
                    {"cuts", report->cuts},
                    {"seconds_prune", seconds}}));
  }
  return write_and_tell(*axes, input, common, output, format, pictures);
}

}  // namespace

Command make_prune_command(CLI::App& program) {
  auto arguments = std::make_shared<PruneVerbArguments>();
  CLI::App* command = program.add_subcommand("prune", "Remove the branches that do not matter.");
  add_input_options(*command, arguments->input);
  add_output_options(*command, arguments->output, arguments->format,
                     io::formats_of(io::DocumentKind::axes));
  add_prune_options(*command, arguments->prune);
  add_exterior_options(*command, arguments->options,
                       "Of what lies around the shape and in its holes, within a frame.");
  command->add_flag(
      "--preview", arguments->preview,
      "One picture over thresholds instead: none, a quarter, a half, the chosen one,\n"
      "twice and four times it.");
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "INPUT is medial's own .json with axes, or shapes, whose axes are then computed. R\n"
      "is the radius of the deepest disk of each connected part. No measure has a unit.\n"
      "Parts and cycles stay whatever the threshold, and more of a measure leaves less\n"
      "of the axis, never anything else. Edges of exact axes are cut exactly. One measure\n"
      "at a time.\n"
      "\n"
      "Examples:\n"
      "  medial prune plan.json -o spine.json\n"
      "  medial prune coast.wkt.gz --erosion 0.2 -o coast.svg\n"
      "  medial axis gear.svg -o - | medial prune - --angle 60 -o gear.pdf\n"
      "  medial prune leaf.png --keep 20 --tips -o veins.svg\n"
      "  medial prune coast.wkt.gz --preview -o thresholds.png");
  return {command, [arguments] { return run_prune(*arguments); }};
}

}  // namespace medial::cli
