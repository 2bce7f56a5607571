// medial prune: removes branches that do not matter.

#include "medial/prune.h"

#include <fmt/format.h>

#include <array>
#include <memory>

#include "cli/commands.h"
#include "cli/prune_options.h"
#include "medial/features.h"
#include "medial/io/write.h"
#include "medial/query.h"

namespace medial::cli {

namespace {

/// The help of each measure, in the order of PruneMeasure.
constexpr std::array measure_helps = {
    "Branches by the geometric mean of --significance and --erosion",
    "Branches by how far the shape reaches beyond the disk where they\n"
    "begin, relative to that disk's radius (Ho and Dyer)",
    "Branches by their longest path to an end, relative to that radius",
    "Branches by the length of the boundary beyond that disk, relative to\n"
    "the chord between its feet",
    "Points by their radius, relative to R",
    "Points by the angle between the radii to the boundary, in degrees",
    "Points by erosion thickness: how far the shape reaches beyond the\n"
    "disk, relative to R",
    "Points by the length of the boundary beyond, relative to 2 pi R",
    "Points by that length minus its chord, relative to 2 R",
    "Points by the area that would be lost, relative to the shape's",
    "Lambda medial axis: the smallest circle around the feet, relative to R",
    "Scale axis: the growth factor >= 1 at which another disk covers this one",
};

}  // namespace

void add_prune_options(CLI::App& command, PruneArguments& arguments) {
  const OptionGroup group(command, "What matters");
  arguments.thresholds.resize(prune_measures().size());
  std::vector<CLI::Option*> options;
  for (const PruneMeasure measure : prune_measures()) {
    const auto index = static_cast<std::size_t>(measure);
    CLI::Option* option =
        add_value(command, fmt::format("--{}", name_of(measure)), arguments.thresholds[index], "T",
                  in_range(0, 1e9),
                  fmt::format("{} ({}).", measure_helps.at(index), default_threshold(measure)));
    option->expected(0, 1)
        ->default_str(fmt::format("{}", default_threshold(measure)))
        ->option_text("[T]");
    for (CLI::Option* other : options) option->excludes(other);
    options.push_back(option);
  }
  CLI::Option* by = command
                        .add_option("--by", arguments.by,
                                    "One of these measures with its default, or for --keep\n"
                                    "(default: prominence).")
                        ->option_text("MEASURE");
  CLI::Option* keep = add_value(command, "--keep", arguments.keep, "N", a_whole_number(),
                                "Instead of a threshold: keep at most N branches of each\n"
                                "feature, the most important ones, besides those that\n"
                                "always stay (cycles and the paths between them; see\n"
                                "--specks).");
  for (CLI::Option* option : options) {
    by->excludes(option);
    keep->excludes(option);
  }
  command.add_flag("--tips", arguments.tips,
                   "Extend the ends of what is kept to the tips, along the paths that\n"
                   "reach farthest.");
  // A flag with an optional value, like --repair.
  command
      .add_flag(
          fmt::format("--specks{{{}}}", speck_share), arguments.speck_share,
          fmt::format("First remove specks: holes and parts with a bounding box whose\n"
                      "diagonal is below this share of the square root of the feature's area\n"
                      "(without a value: {}). Computes stored axes again.",
                      speck_share))
      ->disable_flag_override(false)
      ->check(in_range(0, 1, true))
      ->each([&arguments](const std::string& share) {
        CLI::detail::lexical_cast(share, arguments.specks);
      });
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
      return invalid_option(fmt::format("--by: '{}' is not one of{}", arguments.by, names));
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

std::optional<PruneOptions> image_pruning(const Document<AxisItem>& file,
                                          const InputOptions& input) {
  if (file.pixel == 0 || input.whole_smooth || !input.source.read.smooth_contour)
    return std::nullopt;
  return PruneOptions{.threshold = image_prominence};
}

void note_specks(const Document<AxisItem>& file, const InputOptions& input,
                 const CommonOptions& common) {
  if (file.pixel == 0 || common.quiet) return;
  std::size_t specks = 0;
  for (const AxisItem& item : file.items)
    specks += item.shape.loop_count() - without_specks(item.shape, speck_share).loop_count();
  if (specks > 0)
    say("medial: {}: note: {} with an axis or a cycle of its own; `medial prune --specks` leaves "
        "out specks\n",
        input.path,
        specks == 1 ? "1 part or hole of the image is a speck"
                    : fmt::format("{} parts and holes of the image are specks, each", specks));
}

Result<PruneReport> prune_all(Document<AxisItem>& file, const PruneOptions& options, int threads) {
  std::vector<PruneReport> reports(file.items.size());
  const auto prune_one = [&](std::size_t i, int) -> Status {
    MedialAxis& axis = file.items[i].axis;
    auto pruned = prune(axis, options, &reports[i]);
    if (!pruned) return std::move(pruned).error();
    axis = std::move(pruned).value();
    file.items[i].part = true;
    return success();
  };
  Status done = for_each_item(edge_weights_of(file), threads, prune_one);
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

struct PruneCommandArguments : FileArguments {
  PruneArguments prune;
  Options options;
  bool preview = false;
};

/// A threshold around a chosen one.
double scaled_threshold(PruneMeasure measure, double chosen, double factor) {
  if (measure == PruneMeasure::angle)  // from 0 to 180 degrees
    return factor <= 1 ? chosen * factor : chosen + (180 - chosen) * factor / 5;
  if (measure == PruneMeasure::scale || measure == PruneMeasure::ratio)  // from 1 up
    return 1 + (chosen - 1) * factor;
  return chosen * factor;
}

/// The axes at thresholds around the chosen one, side by side.
Status write_previews(const Document<AxisItem>& file, const PruneOptions& options,
                      const PruneCommandArguments& arguments) {
  const double chosen = options.threshold.value_or(default_threshold(options.measure));
  std::vector<Panel> panels;
  std::vector<double> thresholds;
  for (const double factor : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    thresholds.push_back(scaled_threshold(options.measure, chosen, factor));
    panels.push_back({fmt::format("{} {:.3g}", name_of(options.measure), thresholds.back()), {}});
  }
  Box box = Box::nothing();
  for (const AxisItem& item : file.items) {
    if (!item.shape.points.empty()) box.add(bounding_box(item.shape));
    for (const Node& node : item.axis.nodes) box.add(node.disk.center);
    const PruneOrder order(item.axis, options.measure, options.tips);
    for (std::size_t i = 0; i < panels.size(); ++i)
      panels[i].items.push_back({item.shape, order.at(thresholds[i]), {}});
  }
  return write_panels(arguments, file, box, std::move(panels), arguments.write.width);
}

Result<int> run_prune(const PruneCommandArguments& arguments) {
  const CommonOptions& common = arguments.common;
  if (arguments.preview && (arguments.output.empty() || arguments.prune.keep))
    return invalid_option("--preview needs -o with the name of a picture, and no --keep");
  auto options = prune_options(arguments.prune);
  if (!options) return options.error();
  Status writable =
      check_output(arguments, arguments.preview ? io::formats_of(io::DocumentKind::field)
                                                : io::formats_of(io::DocumentKind::axes));
  if (!writable) return std::move(writable).error();
  if (!arguments.preview && arguments.prune.specks == 0 && !common.stats) {
    const auto change = [&options](Document<AxisItem>& part) -> Status {
      const auto report = prune_all(part, *options, 1);
      return report ? success() : Status(report.error());
    };
    const auto streamed = stream_axes(arguments, arguments.input, arguments.options, change);
    if (!streamed) return streamed.error();
    if (*streamed) return **streamed;
  }
  auto axes = load_axes(arguments.input, common, arguments.prune.specks, arguments.options);
  if (!axes) return std::move(axes).error();
  if (axes->file.pixel > 0 && options->measure == PruneMeasure::prominence && !options->keep &&
      !options->threshold)
    options->threshold = image_prominence;
  if (arguments.preview) {
    if (axes->file.items.empty()) return no_shape(arguments.input.path);
    Status written = write_previews(axes->file, *options, arguments);
    if (!written) return std::move(written).error();
    return exit_success;
  }
  if (arguments.prune.specks == 0) note_specks(axes->file, arguments.input, common);
  const auto report = prune_all(axes->file, *options, common.threads);
  if (!report) return report.error();
  axes->phases.end("prune");
  if (common.stats && !common.json) {
    say_text(table({{"measure", name_of(options->measure)},
                    {"threshold", report->threshold},
                    {"branches_before", report->branches_before},
                    {"edges_before", report->edges_before},
                    {"cuts", report->cuts}}));
  }
  return finish_axes(*axes, arguments);
}

}  // namespace

Command make_prune_command(CLI::App& program) {
  auto arguments = std::make_shared<PruneCommandArguments>();
  CLI::App* command = program.add_subcommand("prune", "Remove the branches that do not matter.");
  add_input_options(*command, arguments->input);
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::axes));
  add_prune_options(*command, arguments->prune);
  add_exterior_options(
      *command, arguments->options,
      "Prune the axis of the exterior: around the shape and in its holes, within a\n"
      "rectangle.");
  command->add_flag(
      "--preview", arguments->preview,
      "Instead: one picture of several thresholds: 0, and 1/4, 1/2, 1, 2 and 4 times\n"
      "the chosen one.");
  add_simplify_option(*command, arguments->write);
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "INPUT is medial's own .json or .safetensors with axes, or shapes, whose\n"
      "axes are then computed. R is the radius of the deepest disk of each connected part.\n"
      "Measures are dimensionless.\n"
      "Parts and cycles stay at any threshold; a larger threshold keeps a subset of the axis.\n"
      "Edges of exact axes are cut exactly. Only one measure can be used at a time.\n"
      "\n"
      "Examples:\n"
      "  medial prune plan.json -o spine.json\n"
      "  medial prune coast.wkt.gz --erosion 0.2 -o coast.svg\n"
      "  medial axis gear.svg -o - | medial prune - --angle 60 -o gear.pdf\n"
      "  medial prune leaf.png --keep 20 --specks --tips -o veins.svg\n"
      "  medial prune coast.wkt.gz --preview -o thresholds.png");
  return command_of(command, arguments, run_prune);
}

}  // namespace medial::cli
