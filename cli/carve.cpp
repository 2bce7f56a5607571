// medial carve: tool paths of a V-shaped tool along the medial axis.

#include "medial/carve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/document.h"
#include "medial/io/write.h"

namespace medial::cli {
namespace {

/// In millimetres. Common tools do not cut deeper; a deeper cut suggests a wrong unit.
constexpr double unlikely_depth = 50;
constexpr char gcode_formats[] = ".nc .gcode .ngc .tap .cnc";

/// The options given, in units of the result; defaults are in millimetres.
struct MachineArguments {
  std::optional<double> safe, rapid, pass_depth, clear_pass_depth;
  std::optional<double> feed, plunge, clear_feed, clear_plunge;
  double spindle = 0, clear_spindle = 0;
  std::string post;
};

struct TabArguments : TabOptions {
  std::optional<double> width, height;
  bool wanted() const { return count > 0 || spacing > 0; }
};

struct CarveArguments : FileArguments {
  MachineArguments machine;
  TabArguments tabs;
  CarveOptions carve;
  double clear_tool = 0;
  std::string origin, preview;
  Options options;  ///< exterior and margin
};

/// The point of a box at a share of its width and height.
struct NamedOrigin {
  const char* name;
  double across, up;
};
constexpr std::array<NamedOrigin, 6> origins{{{"lower-left", 0, 0},
                                              {"lower-right", 1, 0},
                                              {"upper-left", 0, 1},
                                              {"upper-right", 1, 1},
                                              {"center", 0.5, 0.5},
                                              {"centre", 0.5, 0.5}}};

/// X,Y of the drawing; nothing if the text is not such a pair.
std::optional<Vec2> point_of(const std::string& text) {
  const std::size_t comma = text.find(',');
  Vec2 p;
  if (comma == std::string::npos || !CLI::detail::lexical_cast(text.substr(0, comma), p.x) ||
      !CLI::detail::lexical_cast(text.substr(comma + 1), p.y) || !std::isfinite(p.x + p.y))
    return std::nullopt;
  return p;
}

/// The place of the drawing that becomes 0,0. By default its own origin, or the lower left corner
/// if y is flipped.
Vec2 zero_of(const Document<ShapeItem>& file, const std::string& origin) {
  if (const auto point = point_of(origin)) return *point;
  if (origin == "drawing" || (origin.empty() && !file.y_down)) return {};
  Box box = Box::nothing();
  for (const ShapeItem& item : file.items)
    if (!item.shape.points.empty()) box.add(bounding_box(item.shape));
  const auto found = std::ranges::find(origins, origin, &NamedOrigin::name);
  const NamedOrigin& named = found == origins.end() ? origins[0] : *found;
  const double up = file.y_down ? 1 - named.up : named.up;
  const Vec2 size = box.high - box.low;
  return box.low + Vec2{named.across * size.x, up * size.y};
}

/// Refuses an origin so far away that coordinates could not have six decimals.
Status check_zero(const Document<ShapeItem>& file, Vec2 zero) {
  constexpr double most = 1e9;
  for (const ShapeItem& item : file.items)
    if (!item.shape.points.empty() && distance(item.shape.points[0], zero) > most)
      return invalid_option("--origin is too far from the drawing for six decimals");
  return success();
}

/// Fills in the defaults of hobby machines in wood.
io::MachineOptions machine_of(const CarveArguments& arguments, Unit unit) {
  const MachineArguments& given = arguments.machine;
  const double one = 1 / millimetres(unit);  // a millimetre
  const auto or_else = [](const std::optional<double>& value, double other) {
    return value ? *value : other;
  };
  io::MachineOptions machine;
  machine.safe = or_else(given.safe, 5 * one);
  machine.rapid = or_else(given.rapid, 3000 * one);
  machine.carving = {or_else(given.feed, 1000 * one), or_else(given.plunge, 300 * one),
                     given.spindle};
  machine.clearing = {or_else(given.clear_feed, machine.carving.feed),
                      or_else(given.clear_plunge, machine.carving.plunge),
                      given.clear_spindle > 0 ? given.clear_spindle : given.spindle};
  machine.chord = arguments.carve.chord;
  machine.post = given.post;
  return machine;
}

/// Half of an end mill's diameter; 2 mm for a V.
CarveOptions carve_options(const CarveArguments& arguments, Unit unit) {
  CarveOptions options = arguments.carve;
  options.cleared = arguments.clear_tool;
  options.pass_depth = arguments.machine.pass_depth.value_or(
      options.angle == 0 ? options.tool / 2 : 2 / millimetres(unit));
  return options;
}

/// Tabs of 6 mm, 2 mm high but at most half of the depth.
Result<Tabs> tabs_for(const Shape& shape, const MedialAxis& axis, const CarveArguments& arguments,
                      const CarveOptions& options, Unit unit) {
  if (!arguments.tabs.wanted()) return Tabs{};
  const double bottom = clearing_before(options, 0, 0).depth, one = 1 / millimetres(unit);
  if (!(bottom > 0)) return invalid_option("tabs need --depth, the thickness of the material");
  const double height = arguments.tabs.height.value_or(std::min(2 * one, bottom / 2));
  if (height >= bottom) return invalid_option("--tab-height must be below the depth");
  auto lines = place_tabs(shape, axis, arguments.tabs);
  if (!lines) return std::move(lines).error();
  return Tabs{std::move(lines).value(), arguments.tabs.width.value_or(6 * one), bottom - height};
}

/// Merges all shapes into one, because the exterior of a single shape would contain its neighbours.
Status unite(std::vector<ShapeItem>& items) {
  std::vector<Ring> rings;
  for (const ShapeItem& item : items)
    for (Ring& ring : rings_of(item.shape)) {
      ring.role = RingRole::winding;
      rings.push_back(std::move(ring));
    }
  auto shape = build_shape(rings, {.node_crossings = true});
  if (!shape) return std::move(shape).error();
  items.resize(1);
  items[0].shape = std::move(shape).value();
  return success();
}

struct CarvedItem : io::CarveItem {
  std::uint64_t parts = 0, narrow = 0;  ///< all parts; those too narrow for the tool
};

/// Counts parts by their largest disks at nodes; others are hardly larger.
void count_parts(const MedialAxis& axis, const CarveOptions& options, CarvedItem& item) {
  constexpr double rounding = 1e-9;
  std::map<std::uint32_t, double> widest;
  for (const Node& node : axis.nodes) {
    double& radius = widest[node.component];
    radius = std::max(radius, node.disk.radius);
  }
  const double least = (1 - rounding) * 0.5 * (options.angle == 0 ? options.tool : options.tip);
  item.parts = widest.size();
  for (const auto& [part, radius] : widest) item.narrow += radius < least ? 1 : 0;
}

Result<CarvedItem> carve_one(Shape shape, const CarveArguments& arguments,
                             CarveOptions carving_options, const Options& options, Unit unit) {
  if (arguments.options.exterior) {
    auto around = surroundings(shape, arguments.options.margin);
    if (!around) return std::move(around).error();
    shape = std::move(around).value();
  }
  auto axis = compute(shape, options);
  if (!axis) return std::move(axis).error();
  auto tabs = tabs_for(shape, *axis, arguments, carving_options, unit);
  if (!tabs) return std::move(tabs).error();
  carving_options.tabs = std::move(tabs).value();
  auto carving = carve(*axis, carving_options);
  if (!carving) return std::move(carving).error();
  CarvedItem item{{std::move(shape), std::move(carving).value()}};
  count_parts(*axis, carving_options, item);
  if (arguments.clear_tool > 0) {
    auto clearing = carve(
        *axis,
        clearing_before(carving_options, arguments.clear_tool,
                        arguments.machine.clear_pass_depth.value_or(0.5 * arguments.clear_tool)));
    if (!clearing) return std::move(clearing).error();
    item.clearing = std::move(clearing).value();
  }
  return item;
}

Result<std::vector<CarvedItem>> carve_all(Document<ShapeItem>& shapes,
                                          const CarveArguments& arguments) {
  const CarveOptions options = carve_options(arguments, shapes.unit);
  const auto carve_item = [&](std::size_t i, int threads) {
    return carve_one(std::move(shapes.items[i].shape), arguments, options,
                     engine_options(arguments.common, threads, shapes.corner_angle), shapes.unit);
  };
  std::vector<std::string> left_out;
  auto carved = map_features<CarvedItem>(shapes, weights_of(shapes), arguments.common.threads,
                                         carve_item, skips(arguments.input, left_out));
  if (!carved) return std::move(carved).error();
  note_left_out(left_out, arguments.input, arguments.common);
  if (carved->items.empty()) return no_shape(arguments.input.path);
  return std::move(carved->items);
}

/// Prints notes on parts that the tools do not reach. Errors: empty (the tool fits nowhere).
Status check_uncut(const std::vector<CarvedItem>& items, const CarveArguments& arguments) {
  const std::string& input = arguments.input.path;
  const CarveOptions& tool = arguments.carve;
  std::uint64_t parts = 0, narrow = 0, paths = 0, clearing = 0;
  for (const CarvedItem& item : items) {
    parts += item.parts, narrow += item.narrow;
    paths += item.carving.paths.size(), clearing += item.clearing.paths.size();
  }
  const double margin = arguments.options.margin, diameter = tool.angle == 0 ? tool.tool : tool.tip;
  const bool is_beside = arguments.options.exterior && margin > 0 && margin < diameter;
  if (paths == 0 && clearing == 0)
    return error_at(
        ErrorCode::empty, input,
        fmt::format("nothing is cut: the tool fits nowhere in the shape; use a smaller "
                    "{}, {}or another --units or --scale",
                    tool.angle == 0 ? "--tool" : "--tip", is_beside ? "a larger --margin, " : ""));
  if (arguments.common.quiet) return success();
  if (paths == 0)
    say("medial: {}: note: the V fits nowhere: only the mill of --clear-tool cuts; use a smaller "
        "--tip\n",
        input);
  else if (narrow > 0)
    say("medial: {}: note: {} of {} parts {} narrower than the tool and not cut\n", input, narrow,
        parts, narrow == 1 ? "is" : "are");
  if (is_beside)
    say("medial: {}: note: --margin is narrower than the tool, which does not fit between the "
        "shape and the rectangle around it\n",
        input);
  if (tool.angle == 0 && tool.step > tool.tool / 2)
    say("medial: {}: note: --step {:.6g} is more than half of the tool's diameter, which may leave "
        "ridges; at most {:.6g} leaves nothing\n",
        input, tool.step, tool.tool / 2);
  if (arguments.clear_tool > 0 && clearing == 0)
    say("medial: {}: note: the mill of --clear-tool fits nowhere: the V clears everything\n",
        input);
  return success();
}

Result<int> finish_carve(const Document<io::CarveItem>& file, const CarveArguments& arguments,
                         const Phases& phases) {
  std::uint64_t paths = 0, tabs = 0;
  double unordered = 0, deepest = 0;
  for (const io::CarveItem& item : file.items) {
    tabs += item.carving.tabs.lines.size();
    for (const Carving* c : {&item.carving, &item.clearing}) {
      paths += c->paths.size();
      unordered += c->travel_unordered;
      deepest = std::max(deepest, c->deepest);
    }
  }
  const std::string& input = arguments.input.path;
  const std::string unit = name_of(file.unit);
  if (deepest * millimetres(file.unit) > unlikely_depth && !arguments.common.quiet)
    say("medial: {}: note: the cut is {:.3g} {} deep; {} the unit of the input, --depth limits the "
        "cut\n",
        input, deepest, unit,
        arguments.input.font.empty() ? "--units gives"
                                     : "--font-size is how large letters are, --units");
  if (arguments.tabs.wanted() && tabs == 0 && !arguments.common.quiet)
    say("medial: {}: note: there are no tabs, as nothing comes loose: there are no holes{}\n",
        input, arguments.options.exterior ? "" : "; --exterior cuts around shapes");
  if (!is_talkative(arguments)) return exit_success;
  const io::CutReport report = io::report_of(file, machine_of(arguments, file.unit));
  const auto seconds = static_cast<std::uint64_t>(std::ceil(report.seconds));
  return finish(
      arguments,
      {{"input", input},
       {"unit", unit},
       {"features", file.items.size()},
       {"paths", paths},
       {"tabs", tabs},
       {"moves", report.moves},
       {"deepest", deepest},
       {"passes_length", report.own},
       {"cut_length", report.cut},
       {"travel_length", report.travel},
       {"travel_unordered", unordered},
       {"seconds_cutting", report.seconds}},
      phases,
      fmt::format(
          "{0}: {1}, {2} of {3}, deepest {4:.6g} {5}; cut {6:.6g} {5}, travel {7:.6g} {5}{8}; "
          "about {9} min {10} s on the machine",
          input, counted(file.items.size(), "feature"), counted(paths, "path"),
          counted(report.moves, "move"), deepest, unit, report.cut, report.travel,
          report.own > 0 ? fmt::format(", together {:.3g} times as long as the paths ({:.6g} {})",
                                       (report.cut + report.travel) / report.own, report.own, unit)
                         : std::string(),
          seconds / 60, seconds % 60));
}

Status write_preview(const CarveArguments& arguments, const Document<io::CarveItem>& file,
                     io::MachineOptions machine) {
  if (arguments.preview.empty()) return success();
  machine.shaded = true;
  return io::write_carving(arguments.preview, {}, file, machine, arguments.write);
}

/// The text of a template file, or a known name unchanged.
Status read_post(std::string& post) {
  const std::string known = io::post_names();
  if (post.empty() || (", " + known + ",").find(", " + post + ",") != std::string::npos)
    return success();
  std::ifstream file(post, std::ios::binary);
  std::stringstream text;
  if (!(text << file.rdbuf()))
    return invalid_option("--post is " + known + " or the name of a readable template");
  post = text.str();
  return success();
}

/// Refuses a --step so large that the tool does not reach from one pass to the next.
Status check_step(const CarveOptions& carve) {
  const bool mill = carve.angle == 0;
  const double flat = mill ? carve.tool : carve.tip;
  const double width = mill ? flat : flat + 2 * clearing_before(carve, 0, 0).allowance;
  const bool bottom = mill || carve.depth > 0 || carve.tool > 0;
  if (!bottom || carve.step <= width) return success();
  return invalid_option(fmt::format(
      "--step {:.6g} is more than the tool's diameter of {:.6g}{}: ridges as high as the material "
      "would be left; at most {:.6g} {}",
      carve.step, width, mill ? "" : " at the largest depth", flat > 0 ? flat / 2 : width / 40,
      flat > 0 ? "leaves nothing" : "leaves low ones"));
}

/// Refuses missing options, and options without effect.
Status check_tools(const CarveArguments& arguments) {
  const CarveOptions& carve = arguments.carve;
  if (!arguments.tabs.wanted() && (arguments.tabs.width || arguments.tabs.height))
    return invalid_option("--tab-width and --tab-height need --tabs or --tab-spacing");
  if (carve.angle == 0 && !(carve.depth > 0 && carve.tool > 0))
    return invalid_option("--angle 0 is an end mill, which needs --tool and --depth");
  if (carve.angle == 0 && carve.tip > 0)
    return invalid_option("--tip is for V-shaped tools; --tool is the diameter of an end mill");
  if (arguments.clear_tool > 0 && carve.angle > 0 && !(carve.depth > 0 || carve.tool > 0))
    return invalid_option("--clear-tool clears flat bottoms, which need --depth or --tool");
  const std::string& output = arguments.output;
  if (!output.empty() && name_one_file(output, arguments.preview))
    return invalid_option("--preview and -o name the same file");
  if (!arguments.machine.post.empty() && !output.empty() &&
      !writes_one_of(arguments, gcode_formats))
    return invalid_option(std::string("--post is for G-code: ") + gcode_formats);
  return check_step(carve);
}

Result<int> run_carve(const CarveArguments& given) {
  CarveArguments arguments = given;
  const CommonOptions& common = arguments.common;
  FileArguments program = arguments;
  if (!arguments.preview.empty()) program.write.width = io::WriteOptions{}.width;  // of the preview
  Status possible = check_output(program, io::formats_of(io::DocumentKind::carving));
  if (possible)
    possible =
        check_output(arguments.preview, {}, ".png .svg .pdf .ps", arguments.input.path, false);
  if (possible) possible = read_post(arguments.machine.post);
  if (possible) possible = check_tools(arguments);
  if (!possible) return std::move(possible).error();
  UnitOptions& units = arguments.input.source.units;
  const bool usual = units.wanted == Unit::unknown || units.wanted == Unit::millimetre ||
                     units.wanted == Unit::inch;
  if (!usual) return invalid_option("G-code is in mm or in: --output-units must be one of them");
  units.assumed = Unit::millimetre;
  if (units.wanted == Unit::unknown) units.wanted = Unit::millimetre;
  auto shapes = load_shapes(arguments.input, common);
  if (!shapes) return std::move(shapes).error();
  if (shapes->file.items.empty())
    return error_at(ErrorCode::empty, arguments.input.path, "there is no shape to cut");
  if (arguments.options.exterior && shapes->file.items.size() > 1)
    if (Status united = unite(shapes->file.items); !united) return std::move(united).error();
  Document<io::CarveItem> file{shapes->file, {}};
  file.indices.clear();
  file.crs_wkt.clear();  // a machine has no reference system
  const Vec2 zero = zero_of(shapes->file, arguments.origin);
  if (Status near = check_zero(shapes->file, zero); !near) return std::move(near).error();
  auto items = carve_all(shapes->file, arguments);
  if (!items) return std::move(items).error();
  if (Status cut = check_uncut(*items, arguments); !cut) return std::move(cut).error();
  std::ranges::move(*items, std::back_inserter(file.items));
  io::place(file, zero);
  shapes->phases.end("carve");
  const io::MachineOptions machine = machine_of(arguments, file.unit);
  Status written =
      write_output(arguments, shapes->phases, [&](const auto& path, const auto& format) {
        return io::write_carving(path, format, file, machine, arguments.write);
      });
  if (!written && written.error().code == ErrorCode::invalid_option && !machine.post.empty())
    written.error().place.file = given.machine.post;
  if (written) written = write_preview(arguments, file, machine);
  if (!written) return std::move(written).error();
  return finish_carve(file, arguments, shapes->phases);
}

template <class T>
void add_length(CLI::App& command, const char* name, T& value, const char* text, const char* help) {
  add_value(command, name, value, text, a_positive_number(), help);
}

/// 0 or 1 to 170 degrees.
CLI::Validator an_angle() {
  return a_number([](double value) {
    return value == 0 || (value >= 1 && value <= 170) ? "" : " is neither 0 nor in [1 - 170]";
  });
}

void add_tool_options(CLI::App& command, CarveArguments& arguments) {
  CarveOptions& carve = arguments.carve;
  add_value(command, "--angle", carve.angle, "A REQUIRED", an_angle(),
            "The angle between the sides of the V-shaped tool, in degrees, in [1, 170]; or 0\n"
            "for an end mill, which clears pockets.")
      ->required();
  add_length(command, "--depth", carve.depth, "Z",
             "The largest depth; wider places get a flat bottom (default: as deep as the\n"
             "tool reaches).");
  add_length(command, "--tool", carve.tool, "D",
             "The tool's diameter; for a V, its largest diameter, which limits the depth.");
  add_length(command, "--tip", carve.tip, "D",
             "The diameter of a V's flat tip (default: a point).");
  add_value(command, "--pass-depth", arguments.machine.pass_depth, "Z", in_range(0, 1e9, true),
            "The depth of one pass (default: 2 mm, or half of an end mill's diameter; 0: all\n"
            "in one).");
  carve.ramp = 20;
  add_value(command, "--ramp", carve.ramp, "A", in_range(0.1, 90),
            "The steepest angle of ramps into the material, in degrees (default: 20;\n"
            "90: straight down).");
  add_length(command, "--step", carve.step, "S",
             "The distance between passes that clear a flat bottom, at most the tool's diameter\n"
             "(default: half of the tip's diameter, which clears all; for a pointed tool, 1/20 of\n"
             "its radius at the bottom, which leaves ridges).");
  add_length(command, "--path-tolerance", carve.chord, "T",
             "The largest error of straight moves that replace curves of the axis (default:\n"
             "1e-5 of the diagonal), and in .csv arcs (default: 1e-6 of the tool's radius at\n"
             "the bottom).");
}

void add_tab_options(CLI::App& command, CarveArguments& arguments) {
  const OptionGroup group(command, "Tabs");
  TabArguments& tabs = arguments.tabs;
  CLI::Option* count =
      command
          .add_option(
              "--tabs", tabs.count,
              "Leave this many bars at each part that would come loose: at each hole, or with\n"
              "--exterior around each shape. They lie on the bottom, from side to side, and\n"
              "need --depth.")
          ->check(CLI::Range(1, 1000))
          ->option_text("N");
  command
      .add_option("--tab-spacing", tabs.spacing,
                  "Instead: one bar per this length of the boundary.")
      ->check(a_positive_number())
      ->option_text("L")
      ->excludes(count);
  add_length(command, "--tab-width", tabs.width, "W", "The width of the bars (default: 6 mm).");
  add_length(command, "--tab-height", tabs.height, "H",
             "Their height above the bottom (default: 2 mm, at most half of the depth).");
}

void add_clearing_options(CLI::App& command, CarveArguments& arguments) {
  const OptionGroup group(command, "Clearing before a V");
  CLI::Option* tool =
      command
          .add_option(
              "--clear-tool", arguments.clear_tool,
              "First clear flat bottoms with an end mill of this diameter; the V then cuts\n"
              "walls, corners and what the mill leaves. Needs --depth or --tool.")
          ->check(a_positive_number())
          ->option_text("D");
  MachineArguments& machine = arguments.machine;
  const auto add = [&](const char* name, auto& value, const char* text, const char* help) {
    add_value(command, name, value, text, a_positive_number(), help)->needs(tool);
  };
  add("--clear-pass-depth", machine.clear_pass_depth, "Z",
      "The depth of one pass (default: half of the diameter).");
  add("--clear-feed", machine.clear_feed, "F", "Like --feed, for the mill (default: --feed).");
  add("--clear-plunge", machine.clear_plunge, "F", "Like --plunge (default: --plunge).");
  add("--clear-spindle", machine.clear_spindle, "S", "Like --spindle (default: --spindle).");
}

void add_machine_options(CLI::App& command, CarveArguments& arguments) {
  const OptionGroup group(command, "G-code");
  MachineArguments& machine = arguments.machine;
  add_length(command, "--feed", machine.feed, "F",
             "Speed of cutting moves, in units per minute (default: 1000 mm).");
  add_length(command, "--plunge", machine.plunge, "F",
             "Speed straight downwards, in units per minute (default: 300 mm).");
  add_length(command, "--rapid", machine.rapid, "F",
             "Speed of other moves, for the estimated time (default: 3000 mm).");
  add_length(command, "--safe", machine.safe, "Z", "The height of other moves (default: 5 mm).");
  add_length(command, "--spindle", machine.spindle, "S",
             "Revolutions per minute (default: not started).");
  const auto check = [](const std::string& text) {
    const bool known = text == "drawing" || point_of(text) ||
                       std::ranges::find(origins, text, &NamedOrigin::name) != origins.end();
    return known ? std::string() : "'" + text + "' is neither a corner, center, drawing nor X,Y";
  };
  command
      .add_option(
          "--origin", arguments.origin,
          "The place that becomes 0,0: lower-left, lower-right, upper-left, upper-right or\n"
          "center of the shapes; drawing, for its own origin; or a point X,Y of it, in the\n"
          "result's unit (default: lower-left if y points down in the file, else drawing).")
      ->check(CLI::Validator(check, ""))
      ->option_text("WHERE");
  command
      .add_option("--post", machine.post,
                  "The dialect of the G-code: " + io::post_names() +
                      " (default:\nplain), or a template file: see docs/carve.md.")
      ->option_text("NAME");
  command
      .add_option("--preview", arguments.preview,
                  "Also write a picture of the simulated surface after the cut.")
      ->check(a_name())
      ->option_text("PICTURE");
}

}  // namespace

Command make_carve_command(CLI::App& program) {
  auto arguments = std::make_shared<CarveArguments>();
  CLI::App* command = program.add_subcommand(
      "carve", "Plan tool paths: V-carving along the axis, pockets along offsets.");
  add_input_options(*command, arguments->input);
  add_tool_options(*command, *arguments);
  add_clearing_options(*command, *arguments);
  add_tab_options(*command, *arguments);
  add_exterior_options(
      *command, arguments->options,
      "Cut around the shape, up to a rectangle, and in its holes, so that the shape\n"
      "stands out. The rectangle's edges become walls, too.");
  command->get_option("--margin")
      ->description(
          "The distance from the shape's bounding box to that rectangle, in units of\n"
          "the result (default: half of the box's longer side).");
  add_machine_options(*command, *arguments);
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::carving),
                     "for example nc");
  add_width_option(*command, arguments->write.width);
  add_common_options(*command, arguments->common);
  command->footer(
      "The tip of the tool follows the axis at the depth where the tool is as wide as the\n"
      "disk, so walls begin at the boundary and corners are sharp. Nothing outside is\n"
      "touched. Flat bottoms are cleared from the inside out, without lifting the tool if that\n"
      "is safe. Lengths are millimetres, or inches with --output-units in, except --font-size,\n"
      "which is in --units (default: millimetres). For an SVG, the physical size applies,\n"
      "or 96 pixels per inch. z is 0 on the surface.\n"
      "\n"
      "Examples:\n"
      "  medial carve spanner.svg --angle 60 -o spanner.nc\n"
      "  medial carve plate.dxf --angle 90 --depth 3 -o plate.svg\n"
      "  medial carve plate.dxf --angle 0 --tool 4 --depth 2 --feed 800 -o pocket.gcode\n"
      "  medial carve part.svg --angle 0 --tool 3 --depth 6 --exterior --margin 4 --tabs 4 \\\n"
      "    -o part.nc\n"
      "  medial carve spanner.svg --angle 60 --output-units in -o spanner.nc\n"
      "  medial carve sign.svg --angle 60 --post grbl --spindle 12000 -o sign.gcode\n"
      "  medial carve --text Axis --font serif.ttf --font-size 40 --angle 60 -o axis.nc");
  return command_of(command, arguments, run_carve);
}

}  // namespace medial::cli
