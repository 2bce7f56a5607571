// medial draw: a picture of polygons or of stored axes.

#include <fmt/format.h>

#include <memory>

#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

constexpr char picture_formats[] = ".svg .pdf .png .ps";

struct DrawSwitches {
  InputSwitches input;
  EngineSwitches engine;
  ReportSwitches report;
  std::string output;
  std::string format;
  io::WriteOptions write;
};

/// Stored axes as they are; of polygons, axes computed now.
Result<io::NativeFile> axes_to_draw(const DrawSwitches& switches) {
  if (io::is_native(switches.input.path)) return io::read_native(switches.input.path);
  auto shapes = load_shapes(switches.input, switches.engine.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, switches.input, switches.report);
  auto axes = compute_axes(std::move(shapes).value(), switches.input.path, switches.engine,
                           switches.report);
  if (!axes) return std::move(axes).error();
  return std::move(axes->native);
}

Result<int> run_draw(const DrawSwitches& switches) {
  const Stopwatch watch;
  if (switches.output == "-" && switches.report.json) {
    return invalid_option("--json and -o - both claim standard output");
  }
  Status writable =
      check_output(switches.output, switches.format, picture_formats, switches.input.path);
  if (!writable) return std::move(writable).error();
  auto axes = axes_to_draw(switches);
  if (!axes) return std::move(axes).error();
  Status written = io::write_axes(switches.output, switches.format, *axes, switches.write);
  if (!written) return std::move(written).error();

  const AxisSummary summary = summarize(*axes);
  if (switches.report.json) {
    Json object = {{"input", switches.input.path}, {"output", switches.output}};
    object.update(to_json(summary));
    Status printed = print(object);
    if (!printed) return std::move(printed).error();
  } else if (error_is_terminal() && !switches.report.quiet) {
    fmt::print(stderr, "{}: {}; {:.3g} s -> {}\n", switches.input.path, describe(summary),
               watch.seconds(), switches.output);
  }
  return exit_success;
}

}  // namespace

Verb make_draw_verb(CLI::App& program) {
  auto switches = std::make_shared<DrawSwitches>();
  CLI::App* verb = program.add_subcommand("draw", "Draw shapes and their medial axes.");
  add_input_switches(*verb, switches->input);
  verb->add_option("-o,--output", switches->output,
                   fmt::format("The picture; its extension tells the format: {}\n"
                               "- is standard output, see --format.",
                               picture_formats))
      ->required()
      ->option_text("PICTURE REQUIRED");
  verb->add_option("--format", switches->format, "The format of -o -, for example svg.")
      ->option_text("NAME");
  add_engine_switches(*verb, switches->engine);
  add_report_switches(*verb, switches->report);
  add_picture_switches(*verb, switches->write);
  verb->footer(
      "INPUT may be polygons, whose axes are then computed, or medial's own .json, which\n"
      "is drawn as it stands. The axis is coloured by radius. Vector pictures hold exact\n"
      "curves.\n"
      "\n"
      "Examples:\n"
      "  medial draw plan.json -o plan.pdf --disks 100 --nodes\n"
      "  medial draw country.wkt.gz -o country.png --width 3000\n"
      "  medial draw gear.json -o - --format svg --no-shape > gear.svg");
  return {verb, [switches] { return run_draw(*switches); }};
}

}  // namespace medial::cli
