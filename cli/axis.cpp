// medial axis: shapes in, medial axes out.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <tuple>
#include <variant>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/mask.h"
#include "cli/pipeline.h"
#include "cli/prune_options.h"
#include "medial/query.h"
#include "medial/raster.h"

namespace medial::cli {
namespace {

template <class>
struct OneOfEach;
template <class... Own>
struct OneOfEach<std::variant<Own...>> : std::tuple<Own...> {};

/// The options of all methods; the chosen method uses its own.
struct MethodArguments {
  Method chosen;
  PixelGrid grid;  ///< for the methods with a grid
  OneOfEach<Method> own;

  template <class Own>
  Own& of() {
    return std::get<Own>(own);
  }
  Method method() const {
    Method result = chosen;
    std::visit(
        [&]<class Own>(Own& options) {
          options = std::get<Own>(own);
          if constexpr (requires { options.grid; }) options.grid = grid;
        },
        result);
    return result;
  }
};

struct AxisArguments : FileArguments {
  Options options;
  MethodArguments methods;
  bool mask = false;   ///< write an image of the input's size
  bool parts = false;  ///< write in parts, however small
  const CLI::App* command = nullptr;
};

/// Prunes the axes of an image to the branches that a person would draw. Prints a note.
Status prune_image(LoadedAxes& axes, const AxisArguments& arguments) {
  if (axes.file.items.empty() || is_of_pixels(axes.file.items[0].axis.method)) return success();
  const auto options = image_pruning(axes.file, arguments.input);
  if (!options) return success();
  note_specks(axes.file, arguments.input, arguments.common);
  const auto report = prune_all(axes.file, *options, arguments.common.threads);
  if (!report) return report.error();
  if (!arguments.common.quiet && report->branches < report->branches_before)
    say("medial: {}: note: {} of {} branches matter (`prune --prominence {:g}`) and are kept; "
        "--smooth-contour keeps all branches of the smooth outline, --pixel-outline also those of "
        "the pixels' steps\n",
        arguments.input.path, report->branches, report->branches_before, image_prominence);
  return success();
}

/// Refuses options of other methods. Their groups are called "... (--method NAME, NAME)".
Status check_method_options(const CLI::App& command, std::string_view method) {
  constexpr std::string_view before = "(--method ";
  for (const CLI::Option* option : command.get_options()) {
    const std::string& group = option->get_group();
    const std::size_t begin = group.find(before);
    if (option->count() == 0 || begin == std::string::npos) continue;
    const std::string names =
        group.substr(begin + before.size(), group.find(')', begin) - begin - before.size());
    if (names.find(method) == std::string::npos)
      return invalid_option(fmt::format("{} is for --method {}", option->get_name(), names));
  }
  return success();
}

/// Shapes with more vertices are computed and written in parts. Other commands have no such limit.
constexpr std::uint64_t most_points = std::uint64_t{1} << 22;

std::string growing_formats() { return io::formats_of(io::DocumentKind::axes, true); }

/// Whether axes can be written in parts: no step needs a whole axis, and both the method and the
/// format support parts.
bool allows_parts(const AxisArguments& arguments, const Options& options) {
  const std::string& path = arguments.output;
  return (path.empty() || (path != "-" && has_extension(path, growing_formats()))) &&
         !arguments.mask && std::holds_alternative<method::Disks>(options.method) &&
         !options.exact && !options.exterior;
}

/// Axes of images are pruned as a whole.
bool wants_parts(const LoadedShapes& shapes, const AxisArguments& arguments) {
  if (shapes.of_image) return false;
  return arguments.parts || std::ranges::any_of(shapes.file.items, [](const ShapeItem& item) {
           return item.shape.points.size() > most_points;
         });
}

Result<int> run_axis(const AxisArguments& arguments) {
  Status writable = check_output(
      arguments, io::formats_of(arguments.mask ? io::DocumentKind::image : io::DocumentKind::axes));
  if (!writable) return std::move(writable).error();
  if (Status possible = arguments.mask ? check_mask(arguments) : success(); !possible)
    return std::move(possible).error();
  if (arguments.write.radius_as_z && !writes_one_of(arguments, ".dxf"))
    return invalid_option(
        "--radius-as-z is for .dxf; other formats have a column or a number for r");
  Options options = arguments.options;
  options.method = arguments.methods.method();
  if (Status suited = check_method_options(*arguments.command, name_of(options.method)); !suited)
    return std::move(suited).error();
  InputOptions input = arguments.input;
  if (is_of_pixels(name_of(options.method))) input.source.read.smooth_contour = input.whole_smooth;
  input.source.load.keep_contours = info_of(options.method).contours;
  if (auto* own = std::get_if<method::CurveAxis>(&options.method)) own->fit = input.source.load.fit;
  const bool in_parts = allows_parts(arguments, options);
  if (arguments.parts && !in_parts)
    return invalid_option(
        fmt::format("--parts is for files of {}, and for --method disks without --exact, "
                    "--exterior and --mask",
                    growing_formats()));
  if (!arguments.mask && !arguments.parts) {
    const auto streamed = stream_axes(arguments, input, options, nullptr, nullptr,
                                      in_parts ? most_points : ~std::uint64_t{0});
    if (!streamed) return streamed.error();
    if (*streamed) return **streamed;
  }
  auto shapes = load_shapes(input, arguments.common);
  if (!shapes) return std::move(shapes).error();
  if (in_parts && wants_parts(*shapes, arguments)) {
    const auto written = finish_in_parts(*shapes, arguments, input, options);
    if (!written) return written.error();
    if (*written) return **written;
  }
  auto axes = compute_axes(std::move(shapes).value(), input, arguments.common, options);
  if (!axes) return std::move(axes).error();
  if (Status pruned = prune_image(*axes, arguments); !pruned) return std::move(pruned).error();
  if (!arguments.mask) return finish_axes(*axes, arguments);
  Status written = write_mask(axes->file, arguments, arguments.options.exterior);
  if (!written) return std::move(written).error();
  return exit_success;
}

void add_method_options(CLI::App& command, MethodArguments& arguments) {
  std::string help = "The method; `medial methods` shows what each supports:";
  std::vector<std::string> names;
  for (const MethodInfo& info : methods()) {
    help += fmt::format("\n{:<10} {}", info.name, info.summary);
    names.emplace_back(info.name);
  }
  command
      .add_option_function<std::string>(
          "--method",
          [&arguments](const std::string& name) { arguments.chosen = *method_from(name); }, help)
      ->check(CLI::IsMember(names))
      ->option_text("NAME");
}

void add_random_options(CLI::App& command, method::BiarcDc& options) {
  const OptionGroup group(command, "Random choices (--method biarc-dc)");
  add_value(command, "--seed", options.seed, "N", a_whole_number(),
            "Seed of the random choices (default: 1). The same seed gives the same result,\n"
            "byte for byte.");
}

/// The options of sampled methods.
void add_grid_options(CLI::App& command, MethodArguments& arguments) {
  const OptionGroup group(command, "Grids of pixels (--method ridge, brushfire)");
  auto& ridge = arguments.of<method::Ridge>();
  CLI::Option* resolution =
      add_value(command, "--resolution", arguments.grid.resolution, "H", a_positive_number(),
                "The side of a pixel, in units of the input.");
  add_value(command, "--pixels", arguments.grid.pixels, "N", a_positive_number(),
            "Pixels along the longer side of the bounding box (default: 1024; for an\n"
            "image, its own pixels).")
      ->excludes(resolution);
  add_choice<Brushfire>(command, "--brushfire", arguments.of<method::Brushfire>().family,
                        {{"sequential", *brushfire_from("sequential")},
                         {"sides", *brushfire_from("sides")},
                         {"marking", *brushfire_from("marking")},
                         {"simultaneous", *brushfire_from("simultaneous")}},
                        "How thinning keeps shapes connected: simultaneous (default), from\n"
                        "all sides at once; marking, by two rules in turn; sides, one by one;\n"
                        "or sequential, pixel by pixel.")
      ->option_text("FAMILY");
  command
      .add_option("--ridge-collinear", ridge.collinear,
                  "Drop vertices that turn by less than this, in degrees, if that moves\n"
                  "the boundary by at most a quarter of a pixel (default: 5; 0 keeps\n"
                  "every edge).")
      ->option_text("A");
  add_choice<bool>(command, "--ridge-search", ridge.sorted_list,
                   {{"tree", false}, {"sorted-list", true}},
                   "The search for nearest edges: tree (default), or sorted-list, as published.\n"
                   "Both give the same pixels.");
  add_choice<RidgeRule>(
      command, "--ridge-rule", ridge.rule,
      {{"crossing", RidgeRule::crossing}, {"difference", RidgeRule::difference}},
      "Which pixels are medial: crossing (default), where the axis passes between\n"
      "two pixels; or difference, the report's rule: where the distances to two\n"
      "edges differ by less than a pixel.");
}

/// The base order that selects points of the exact axis.
constexpr double exact_start_order = 4096;

/// The options of potential.
void add_potential_options(CLI::App& command, method::Potential& options) {
  const OptionGroup group(command, "Potential fields (--method potential)");
  command
      .add_option("--order", options.order,
                  "The exponent n of the potential 1 / r^n; 0 (default) chooses it for each point.")
      ->option_text("N");
  command
      .add_option("--base-order", options.base_order,
                  "The order of the first force lines: 1 is the paper's (default: the order,\n"
                  "at most 24).")
      ->option_text("N");
  command.add_flag(
      "--exact-start",
      [&options](std::int64_t count) {
        if (count > 0) options.base_order = exact_start_order;
      },
      "Start on the exact axis instead of following force lines (default: above 2,000\n"
      "edges, at the default order and at orders above 24).");
  add_list_option(
      command, "--from", 2,
      [&options](const std::vector<double>& xy) {
        options.from = Vec2{xy[0], xy[1]};
      },
      "Compute only the branch that the force line from this point reaches, in units of the\n"
      "input.")
      ->option_text("X,Y");
  add_list_option(
      command, "--within", 4,
      [&options](const std::vector<double>& box) {
        options.within = Box{{box[0], box[1]}, {box[2], box[3]}};
      },
      "Compute only the part in this box: min x, min y, max x, max y, in units of the\n"
      "input.")
      ->option_text("X,Y,X,Y");
  command
      .add_option("--step", options.step,
                  "The step from point to point, as a share of the longer side of the bounding\n"
                  "box (default: 0.01).")
      ->option_text("SHARE");
  command
      .add_option("--coarse", options.coarse,
                  "Ignore small bumps and notches: compute the axis of a polygon within this\n"
                  "distance of the boundary, then refine it step by step. A share of the longer\n"
                  "side of the bounding box.")
      ->option_text("SHARE");
}

/// The options of curve-axis.
void add_curve_options(CLI::App& command, AxisArguments& arguments) {
  const OptionGroup group(command, "Smooth boundaries (--method curve-axis)");
  add_value(command, "--curve-step", arguments.methods.of<method::CurveAxis>().step, "SHARE",
            in_range(1e-6, 0.1),
            "The step from point to point, as a share of the diagonal (default: 0.001).");
  add_fit_option(command, arguments.input);
}

}  // namespace

Command make_axis_command(CLI::App& program) {
  auto arguments = std::make_shared<AxisArguments>();
  CLI::App* command =
      program.add_subcommand("axis", "Compute medial axes and write them to a file.");
  arguments->command = command;
  add_input_options(*command, arguments->input);
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::axes));
  command->add_flag("--radius-as-z", arguments->write.radius_as_z,
                    "Drawings (.dxf): splines in space, with the radius as z.");
  command->add_flag(
      "--mask", arguments->mask,
      "Images: write a mask of pixels (" + io::formats_of(io::DocumentKind::image) + ").");
  command->add_flag(
      "--parts", arguments->parts,
      "Write the file while the axis is being computed, which takes less memory. Formats:\n" +
          growing_formats() +
          ".\n"
          "Always done for shapes of more than 4 million vertices. Changes the order\n"
          "of edges.");
  add_method_options(*command, arguments->methods);
  add_exterior_options(
      *command, arguments->options,
      "The axis of the exterior: around the shape, within a rectangle, and in holes.");
  add_random_options(*command, arguments->methods.of<method::BiarcDc>());
  add_grid_options(*command, arguments->methods);
  add_potential_options(*command, arguments->methods.of<method::Potential>());
  add_curve_options(*command, *arguments);
  command->add_flag("--exact", arguments->options.exact,
                    "Keep apart nodes that are closer than the tolerance. disks then computes the\n"
                    "axis, also for lee and biarc-dc. --stats counts the decisions.");
  add_simplify_option(*command, arguments->write);
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "Each feature gets its own axis, with its attributes. Coordinates, radii and\n"
      "lengths are in the units of the input, or in metres with --project.\n"
      "\n"
      "Formats: .json is medial's own: lossless, and every command reads it. .safetensors holds\n"
      "the same as binary columns: smaller and three times as fast. .geojson, .gpkg, .shp and\n"
      ".fgb hold one line per branch with its nodes and the radius at both ends. .graphml,\n"
      ".nodelink (JSON) and .edgelist hold the graph of branches, for networkx. .csv has the\n"
      "header edge,x,y,r. .dxf holds polylines and exact splines. Pictures show the axis\n"
      "coloured by radius.\n"
      "\n"
      "Examples:\n"
      "  medial axis plan.geojson -o plan.svg --disks 200\n"
      "  medial axis lakes.gpkg --layer lakes --where \"area > 1e6\" --project -o axes.gpkg\n"
      "  medial axis maze.wkt.gz -o maze.json --stats\n"
      "  medial axis gear.dxf --exact --stats -o gear.json\n"
      "  medial axis --text \"Rg&8\" --font DejaVuSans.ttf -o letters.svg\n"
      "  medial axis part.dxf --layer OUTLINE -o axis.dxf --radius-as-z\n"
      "  medial axis broken.shp --repair=even-odd -o axes.shp\n"
      "  medial axis plan.wkt --method ridge --pixels 2000 -o plan.png\n"
      "  medial axis part.dxf --exterior --margin 20 -o around.svg\n"
      "  cat shape.wkt | medial axis - -o - --format csv --chord 1e-4 | head");
  return command_of(command, arguments, run_axis);
}

}  // namespace medial::cli
