// medial carve: tool paths of a V-shaped tool along the medial axis.

#include "medial/carve.h"

#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/io/write.h"
#include "medial/units.h"

namespace medial::cli {
namespace {

/// In millimetres: no usual tool cuts so deep, so the input's units are hardly millimetres.
constexpr double unlikely_depth = 50;

struct CarveArguments : FileArguments {
  io::MachineOptions machine;
  CarveOptions carve;
  Options options;  ///< exterior and margin
};

Result<io::CarveItem> carve_one(Shape shape, const CarveArguments& arguments,
                                const Options& options) {
  if (arguments.options.exterior) {
    auto around = surroundings(shape, arguments.options.margin);
    if (!around) return std::move(around).error();
    shape = std::move(around).value();
  }
  auto axis = compute(shape, options);
  if (!axis) return std::move(axis).error();
  auto carving = carve(*axis, arguments.carve);
  if (!carving) return std::move(carving).error();
  return io::CarveItem{std::move(shape), std::move(carving).value()};
}

Result<int> finish_carve(const Document<io::CarveItem>& file, const CarveArguments& arguments,
                         const Phases& phases) {
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
  const std::string& input = arguments.input.path;
  if (deepest * millimetres(file.unit) > unlikely_depth && !arguments.common.quiet)
    say("medial: {}: note: the cut is {:.3g} {} deep; --units says what the input is in, --depth "
        "limits the cut\n",
        input, deepest, name_of(file.unit));
  return finish(
      arguments,
      {{"input", input},
       {"features", file.items.size()},
       {"paths", paths},
       {"moves", moves},
       {"deepest", deepest},
       {"cut_length", cut},
       {"travel_length", travel},
       {"travel_unordered", unordered}},
      phases,
      fmt::format("{}: {}, {} of {}, deepest {:.6g}; cut {:.6g}, travel {:.6g} (unordered {:.6g})",
                  input, counted(file.items.size(), "feature"), counted(paths, "path"),
                  counted(moves, "move"), deepest, cut, travel, unordered));
}

Result<int> run_carve(const CarveArguments& arguments) {
  const CommonOptions& common = arguments.common;
  Status writable = check_output(arguments, io::formats_of(io::DocumentKind::carving));
  if (!writable) return std::move(writable).error();
  InputOptions input = arguments.input;
  UnitOptions& units = input.source.units;
  units.assumed = Unit::millimetre;
  if (units.wanted == Unit::unknown) units.wanted = Unit::millimetre;
  auto shapes = load_shapes(input, common);
  if (!shapes) return std::move(shapes).error();
  Document<io::CarveItem> file;  // of a machine, without a reference system
  file.y_down = shapes->file.y_down;
  file.unit = shapes->file.unit;
  auto items = map_items<io::CarveItem>(
      weights_of(shapes->file), common.threads, [&](std::size_t i, int threads) {
        return carve_one(std::move(shapes->file.items[i].shape), arguments,
                         engine_options(common, threads, shapes->file.corner_angle));
      });
  if (!items) return std::move(items).error();
  file.items = std::move(items).value();
  shapes->phases.end("carve");
  Status written =
      write_output(arguments, shapes->phases, [&](const auto& path, const auto& format) {
        io::MachineOptions machine = arguments.machine;
        machine.chord = arguments.carve.chord;
        return io::write_carving(path, format, file, machine, arguments.write);
      });
  if (!written) return std::move(written).error();
  return finish_carve(file, arguments, shapes->phases);
}

void add_length(CLI::App& command, const char* name, double& value, const char* text,
                const char* help) {
  add_value(command, name, value, text, a_positive_number(), help);
}

void add_tool_options(CLI::App& command, CarveOptions& carve) {
  add_value(command, "--angle", carve.angle, "A REQUIRED", in_range(0, 170),
            "Between the sides of the V-shaped tool, in degrees, in [1, 170]; or 0 for an\n"
            "end mill, which clears pockets.")
      ->required();
  add_length(command, "--depth", carve.depth, "Z",
             "The largest depth: what is wider gets a flat bottom (default: as deep as the\n"
             "tool reaches).");
  add_length(command, "--tool", carve.tool, "D",
             "The tool's diameter; of a V its largest, which limits the depth.");
  add_length(command, "--tip", carve.tip, "D",
             "The diameter of a V's flat tip (default: a point).");
  add_length(command, "--pass-depth", carve.pass_depth, "Z",
             "The depth of one pass: several, from the surface down (default: all in one).");
  add_length(command, "--step", carve.step, "S",
             "Between the passes that clear a flat bottom (default: half of the tip's\n"
             "diameter, which leaves nothing; of a pointed tool a 20th of its radius at the\n"
             "bottom, which leaves ridges).");
  add_length(command, "--path-tolerance", carve.chord, "T",
             "How far straight moves may be off the axis's curves, always upwards (default:\n"
             "1e-5 of the diagonal), and in .csv off arcs, always inwards (default: 1e-6 of\n"
             "the tool's radius at the bottom).");
}

void add_machine_options(CLI::App& command, io::MachineOptions& machine) {
  const OptionGroup group(command, "G-code");
  add_length(command, "--feed", machine.feed, "F", "Of cutting moves, mm/min (default: 1000).");
  add_length(command, "--plunge", machine.plunge, "F",
             "Straight downwards, mm/min (default: 300).");
  add_length(command, "--safe", machine.safe, "Z", "The height of other moves, mm (default: 5).");
  add_length(command, "--spindle", machine.spindle, "S",
             "Turns per minute (default: not started).");
}

}  // namespace

Command make_carve_command(CLI::App& program) {
  auto arguments = std::make_shared<CarveArguments>();
  CLI::App* command = program.add_subcommand(
      "carve", "Plan tool paths: V-carving along the axis, pockets along offsets.");
  add_input_options(*command, arguments->input);
  add_tool_options(*command, arguments->carve);
  add_exterior_options(
      *command, arguments->options,
      "Cut what lies around the shape and in its holes, up to a rectangle, so that the\n"
      "shape stands out: the rectangle's edges become walls as well.");
  add_machine_options(*command, arguments->machine);
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::carving),
                     "for example nc");
  add_width_option(*command, arguments->write.width);
  add_common_options(*command, arguments->common);
  command->footer(
      "The tool's point follows the axis at the depth where the tool is as wide as the\n"
      "disk: walls begin at the boundary, corners come out sharp. Nothing outside is\n"
      "touched. Flat bottoms are cleared from the inside out without lifting where that is\n"
      "safe. Lengths are millimetres, or inches with --output-units in; of an SVG the\n"
      "physical size counts, or 96 pixels an inch; z is 0 on the surface.\n"
      "\n"
      "Examples:\n"
      "  medial carve spanner.svg --angle 60 -o spanner.nc\n"
      "  medial carve plate.dxf --angle 90 --depth 3 -o plate.svg\n"
      "  medial carve plate.dxf --angle 0 --tool 4 --depth 2 --feed 800 -o pocket.gcode\n"
      "  medial carve spanner.svg --angle 60 --output-units in -o spanner.nc\n"
      "  medial carve --text Axis --font serif.ttf --angle 60 -o - --format csv");
  return command_of(command, arguments, run_carve);
}

}  // namespace medial::cli
