// medial axis: polygons in, medial axes out.

#include <fmt/format.h>

#include <memory>

#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

struct AxisSwitches {
  InputSwitches input;
  CommonSwitches common;
  std::string output;
  std::string format;
  io::WriteOptions write;
};

Result<int> run_axis(const AxisSwitches& switches) {
  const auto& [input, common, output, format, pictures] = switches;
  const bool to_standard_output = output == "-";
  if (to_standard_output && common.json) {
    return invalid_option("--json and -o - both claim standard output");
  }
  if (!output.empty()) {
    Status writable = check_output(output, format, io::known_output_formats(), input.path);
    if (!writable) return std::move(writable).error();
  } else if (!format.empty()) {
    return invalid_option("--format goes with -o -");
  }

  auto shapes = load_shapes(input, common.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, input, common);
  auto axes = compute_axes(std::move(shapes).value(), input.path, common);
  if (!axes) return std::move(axes).error();

  const Stopwatch writing;
  if (!output.empty()) {
    io::WriteOptions write = pictures;
    write.chord = common.chord;
    Status written = io::write_axes(output, format, axes->native, write);
    if (!written) return std::move(written).error();
  }
  const double seconds_write = output.empty() ? 0 : writing.seconds();

  const AxisSummary summary = summarize(axes->native);
  if (common.json) {
    Json object = {{"input", input.path}};
    if (!output.empty()) object["output"] = output;
    if (common.stats) object.update(stats(*axes, summary, seconds_write));
    object.update(to_json(summary));
    Status printed = print(object);
    if (!printed) return std::move(printed).error();
    return exit_success;
  }
  const double seconds =
      axes->seconds_read + axes->seconds_shape + axes->seconds_axis + seconds_write;
  const std::string line = fmt::format("{}: {}; {:.3g} s", input.path, describe(summary), seconds);
  if (output.empty()) {
    Status printed = print(line + "\n");
    if (!printed) return std::move(printed).error();
  } else if (error_is_terminal() && !common.quiet) {
    fmt::print(stderr, "{} -> {}\n", line, to_standard_output ? "standard output" : output);
  }
  if (common.stats) fmt::print(stderr, "{}", table(stats(*axes, summary, seconds_write)));
  return exit_success;
}

}  // namespace

Verb make_axis_verb(CLI::App& program) {
  auto switches = std::make_shared<AxisSwitches>();
  CLI::App* verb = program.add_subcommand("axis", "Compute medial axes and write them to a file.");
  add_input_switches(*verb, switches->input);
  verb->add_option("-o,--output", switches->output,
                   "Where to write; the extension tells the format:\n" +
                       io::known_output_formats() +
                       "\n- is standard output, see --format. Without -o, only a summary is\n"
                       "printed.")
      ->option_text("OUTPUT");
  verb->add_option("--format", switches->format, "The format of -o -, for example csv.")
      ->option_text("NAME");
  add_picture_switches(*verb, switches->write);
  add_common_switches(*verb, switches->common);
  verb->footer(
      "Each feature gets its own axis, with its attributes. Coordinates, radii and\n"
      "lengths are in the units of the input, or in metres with --project.\n"
      "\n"
      "Formats: .json is medial's own, lossless, and read back by every verb; .geojson,\n"
      ".gpkg, .shp and .fgb hold one line a branch with the radius at both ends; .csv\n"
      "has the header edge,x,y,r; pictures show the axis coloured by radius.\n"
      "\n"
      "Examples:\n"
      "  medial axis plan.geojson -o plan.svg --disks 200\n"
      "  medial axis lakes.gpkg --layer lakes --where \"area > 1e6\" --project -o axes.gpkg\n"
      "  medial axis maze.wkt.gz -o maze.json --stats\n"
      "  medial axis broken.shp --repair=even-odd -o axes.shp\n"
      "  cat shape.wkt | medial axis - -o - --format csv --chord 1e-4 | head");
  return {verb, [switches] { return run_axis(*switches); }};
}

}  // namespace medial::cli
