// medial carve: tool paths of a V-shaped tool along the medial axis.

#include "medial/carve.h"

#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/costs.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "medial/io/write.h"

namespace medial::cli {
namespace {

/// In millimetres: no usual tool cuts so deep, so the input's units are hardly millimetres.
constexpr double unlikely_depth = 50;

struct CarveArguments {
  InputOptions input;
  CommonOptions common;
  std::string output;
  std::string format;
  io::WriteOptions write;
  io::MachineOptions machine;
  CarveOptions carve;
  Options options;  ///< exterior and margin
  double scale = 1;
};

Status tell(const Document<io::CarveItem>& file, const CarveArguments& arguments, double seconds) {
  std::uint64_t paths = 0, moves = 0;
  double cut = 0, travel = 0, unordered = 0, deepest = 0;
  for (const io::CarveItem& item : file.items) {
    const Carving& c = item.carving;
    paths += c.paths.size();
    for (const ToolPath& path : c.paths) moves += path.points.size() - 1;
    cut += c.cut_length;
    travel += c.travel_length;
    unordered += c.travel_unordered;
    deepest = std::max(deepest, c.deepest);
  }
  if (deepest > unlikely_depth && !arguments.common.quiet) {
    say("medial: {}: note: the cut is {:.3g} mm deep; --scale tells how long a unit is\n",
        arguments.input.path, deepest);
  }
  const Json object{{"input", arguments.input.path},
                    {"features", file.items.size()},
                    {"paths", paths},
                    {"moves", moves},
                    {"deepest", deepest},
                    {"cut_length", cut},
                    {"travel_length", travel},
                    {"travel_unordered", unordered}};
  const std::string line = fmt::format(
      "{}: {}, {} of {}, deepest {:.6g}; cut {:.6g}, travel {:.6g} (unordered {:.6g}); {:.3g} s\n",
      arguments.input.path, counted(file.items.size(), "feature"), counted(paths, "path"),
      counted(moves, "move"), deepest, cut, travel, unordered, seconds);
  return tell(arguments.common, arguments.output, object,
              Json{{"seconds", seconds}, {"peak_bytes", peak_bytes()}}, line);
}

Result<int> run_carve(const CarveArguments& arguments) {
  const auto& input = arguments.input;
  const auto& common = arguments.common;
  Status writable =
      check_output(arguments.output, arguments.format, io::formats_of(io::DocumentKind::carving),
                   input.path, common.json);
  if (!writable) return std::move(writable).error();
  auto shapes = load_shapes(input, common.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, input, common);
  const Stopwatch watch;
  Document<io::CarveItem> file;
  file.y_down = shapes->y_down;
  file.items.resize(shapes->shapes.size());
  Status computed = for_each_shape(
      shapes->shapes, input.path, common, [&](std::size_t i, const Options& options) -> Status {
        if (arguments.options.exterior) {
          auto around = surroundings(shapes->shapes[i], arguments.options.margin / arguments.scale);
          if (!around) return std::move(around).error();
          shapes->shapes[i] = std::move(around).value();
        }
        auto axis = compute(shapes->shapes[i], options);
        if (!axis) return std::move(axis).error();
        auto carving = carve(*axis, scaled(arguments.carve, 1 / arguments.scale));
        if (!carving) return std::move(carving).error();
        for (Vec2& point : shapes->shapes[i].points) point = arguments.scale * point;
        file.items[i] = {std::move(shapes->shapes[i]),
                         scaled(std::move(carving).value(), arguments.scale)};
        return success();
      });
  if (!computed) return std::move(computed).error();
  const double seconds = watch.seconds();
  if (!arguments.output.empty()) {
    io::MachineOptions machine = arguments.machine;
    machine.chord = arguments.carve.chord;
    const Activity shown("writing", arguments.output);
    Status written =
        io::write_carving(arguments.output, arguments.format, file, machine, arguments.write);
    if (!written) return std::move(written).error();
  }
  Status told = tell(file, arguments, seconds);
  if (!told) return std::move(told).error();
  return exit_success;
}

}  // namespace

Command make_carve_command(CLI::App& program) {
  auto arguments = std::make_shared<CarveArguments>();
  CLI::App* command = program.add_subcommand(
      "carve", "Plan tool paths: V-carving along the axis, pockets along offsets.");
  add_input_options(*command, arguments->input);
  const auto length = [&](const char* name, double& value, const char* help, const char* text) {
    return command->add_option(name, value, help)->check(a_positive_number())->option_text(text);
  };
  command
      ->add_option("--angle", arguments->carve.angle,
                   "Between the sides of the V-shaped tool, in degrees, in [1, 170]; or 0 for an\n"
                   "end mill, which clears pockets.")
      ->required()
      ->check(in_range(0, 170))
      ->option_text("A REQUIRED");
  length("--depth", arguments->carve.depth,
         "How deep at most: what is wider gets a flat bottom (default: as deep as the\n"
         "tool reaches).",
         "Z");
  length("--tool", arguments->carve.tool,
         "The tool's diameter; of a V its largest, which limits the depth.", "D");
  length("--tip", arguments->carve.tip, "The diameter of a V's flat tip (default: a point).", "D");
  length("--pass-depth", arguments->carve.pass_depth,
         "How deep one pass goes: several, from the surface down (default: all in one).", "Z");
  length("--step", arguments->carve.step,
         "Between the passes that clear a flat bottom (default: half of the tip's\n"
         "diameter, which leaves nothing; of a pointed tool a 20th of its radius at the\n"
         "bottom, which leaves ridges).",
         "S");
  length("--path-tolerance", arguments->carve.chord,
         "How far straight moves may be off the axis's curves, always upwards (default:\n"
         "1e-5 of the diagonal), and in .csv off arcs, always inwards (default: 1e-6 of\n"
         "the tool's radius at the bottom).",
         "T");
  add_exterior_options(
      *command, arguments->options,
      "Cut what lies around the shape and in its holes, up to a frame, so that the\n"
      "shape stands out: the frame's edges become walls as well.");
  command
      ->add_option("--scale", arguments->scale,
                   "Millimetres to a unit of the input (default: 1); all options are in\n"
                   "millimetres.")
      ->check(in_range(1e-6, 1e6))
      ->option_text("S");
  constexpr char group[] = "G-code";
  length("--feed", arguments->machine.feed, "Of cutting moves, mm/min (default: 1000).", "F")
      ->group(group);
  length("--plunge", arguments->machine.plunge, "Straight downwards, mm/min (default: 300).", "F")
      ->group(group);
  length("--safe", arguments->machine.safe, "The height of other moves, mm (default: 5).", "Z")
      ->group(group);
  length("--spindle", arguments->machine.spindle, "Turns a minute (default: not started).", "S")
      ->group(group);
  add_output_options(*command, arguments->output, arguments->format,
                     io::formats_of(io::DocumentKind::carving), "for example nc");
  add_width_option(*command, arguments->write.width);
  add_common_options(*command, arguments->common);
  command->footer(
      "The tool's point follows the axis at the depth where the tool is as wide as the\n"
      "disk: walls begin at the boundary, corners come out sharp. Nothing outside is\n"
      "touched. Flat bottoms are cleared from the inside out without lifting where that is\n"
      "safe. Units of the input, pixels and font units as well, become millimetres, or what\n"
      "--scale tells; z is 0 on the surface.\n"
      "\n"
      "Examples:\n"
      "  medial carve spanner.svg --angle 60 -o spanner.nc\n"
      "  medial carve plate.dxf --angle 90 --depth 3 -o plate.svg\n"
      "  medial carve plate.dxf --angle 0 --tool 4 --depth 2 --feed 800 -o pocket.gcode\n"
      "  medial carve spanner.svg --angle 60 --scale 0.2646 --pass-depth 1 -o spanner.nc\n"
      "  medial carve --text Axis --font serif.ttf --angle 60 -o - --format csv");
  return {command, [arguments] { return run_carve(*arguments); }};
}

}  // namespace medial::cli
