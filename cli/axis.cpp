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
  EngineSwitches engine;
  ReportSwitches report;
  std::string output;
  std::string format;
  io::WriteOptions write;
  bool stats = false;
};

/// The time of each step, in seconds.
struct Timing {
  double read = 0;
  double shape = 0;
  double axis = 0;
  double write = 0;
};

Json stats_object(const AxisSwitches& switches, const AxisSummary& summary, const Timing& timing,
                  const ShapeReport& cleaned, const Statistics& statistics) {
  const double sites = static_cast<double>(std::max<std::uint64_t>(summary.sites, 1));
  Json object = {{"input", switches.input.path}};
  if (!switches.output.empty()) object["output"] = switches.output;
  if (switches.stats) {
    object["seconds"] = {{"read", timing.read},
                         {"shape", timing.shape},
                         {"axis", timing.axis},
                         {"write", timing.write}};
  }
  object.update(to_json(summary));
  if (!switches.stats) return object;
  object["queries_per_site"] = static_cast<double>(statistics.queries) / sites;
  object["precision_retries"] = statistics.precision_retries;
  object["threads"] = statistics.threads;
  object["peak_bytes"] = peak_bytes();
  object["input_rings"] = cleaned.input_rings;
  object["input_points"] = cleaned.input_points;
  object["cleaned"] = to_json(cleaned);
  object["phases"] = {{"sites", statistics.seconds_sites},
                      {"tree", statistics.seconds_tree},
                      {"connect", statistics.seconds_connect},
                      {"walk", statistics.seconds_walk},
                      {"collect", statistics.seconds_collect}};
  object["queries"] = statistics.queries;
  object["apollonius"] = statistics.apollonius;
  object["brackets"] = statistics.brackets;
  object["cuts"] = statistics.cuts;
  object["largest_residual"] = statistics.largest_residual;
  return object;
}

std::string stats_table(const Json& object, const ShapeReport& cleaned) {
  const Json& seconds = object["seconds"];
  const Json& phases = object["phases"];
  const auto count = [&object](const char* key) { return object[key].get<std::uint64_t>(); };
  std::string table;
  for (const char* step : {"read", "shape", "axis", "write"}) {
    table += fmt::format("{:<20}{:>14.6f} s\n", step, seconds[step].get<double>());
    if (std::string_view(step) != "axis") continue;
    for (const auto& [phase, time] : phases.items()) {
      table += fmt::format("  {:<18}{:>14.6f} s\n", phase, time.get<double>());
    }
  }
  for (const char* key : {"features", "sites", "nodes", "edges", "branches"}) {
    table += fmt::format("{:<20}{:>14}\n", key, count(key));
  }
  table += fmt::format("{:<20}{:>14.3f}\n", "queries per site",
                       object["queries_per_site"].get<double>());
  table += fmt::format("{:<20}{:>14}\n", "precision retries", count("precision_retries"));
  table += fmt::format("{:<20}{:>14}\n", "threads", count("threads"));
  table += fmt::format("{:<20}{:>14.1f} MB\n", "peak memory",
                       static_cast<double>(count("peak_bytes")) / 1e6);
  const std::string mended = describe(cleaned);
  table += fmt::format("{:<20}{}\n", "cleaned", mended.empty() ? "nothing" : mended);
  return table;
}

Result<int> run_axis(const AxisSwitches& switches) {
  const std::string& output = switches.output;
  const bool to_standard_output = output == "-";
  if (to_standard_output && switches.report.json) {
    return invalid_option("--json and -o - both claim standard output");
  }
  if (!output.empty()) {
    Status writable =
        check_output(output, switches.format, io::known_output_formats(), switches.input.path);
    if (!writable) return std::move(writable).error();
  } else if (!switches.format.empty()) {
    return invalid_option("--format goes with -o -");
  }

  auto shapes = load_shapes(switches.input, switches.engine.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, switches.input, switches.report);
  Timing timing;
  timing.read = shapes->seconds_read;
  timing.shape = shapes->seconds_shape;
  const ShapeReport cleaned = shapes->report;

  auto axes = compute_axes(std::move(shapes).value(), switches.input.path, switches.engine,
                           switches.report);
  if (!axes) return std::move(axes).error();
  timing.axis = axes->seconds;

  if (!output.empty()) {
    const Stopwatch writing;
    Status written = io::write_axes(output, switches.format, axes->native, switches.write);
    if (!written) return std::move(written).error();
    timing.write = writing.seconds();
  }

  const AxisSummary summary = summarize(axes->native);
  const Json object = stats_object(switches, summary, timing, cleaned, axes->statistics);
  if (switches.report.json) {
    Status printed = print(object);
    if (!printed) return std::move(printed).error();
    return exit_success;
  }
  const std::string line = fmt::format("{}: {}; {:.3g} s", switches.input.path, describe(summary),
                                       timing.read + timing.shape + timing.axis + timing.write);
  if (output.empty()) {
    Status printed = print(line + "\n");
    if (!printed) return std::move(printed).error();
  } else if (error_is_terminal() && !switches.report.quiet) {
    fmt::print(stderr, "{} -> {}\n", line, to_standard_output ? "standard output" : output);
  }
  if (switches.stats) fmt::print(stderr, "{}", stats_table(object, cleaned));
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
  add_chord_switch(*verb, switches->write);
  add_engine_switches(*verb, switches->engine);
  verb->add_flag("--stats", switches->stats,
                 "Tell each phase's time, the counts, queries per site, precision retries\n"
                 "and peak memory: a table on standard error, or with --json one object\n"
                 "on standard output.");
  add_report_switches(*verb, switches->report);
  add_picture_switches(*verb, switches->write);
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
