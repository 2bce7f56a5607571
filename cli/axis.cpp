// medial axis: shapes in, medial axes out.

#include <fmt/format.h>

#include <memory>
#include <tuple>
#include <variant>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/curve_axis.h"

namespace medial::cli {
namespace {

template <class>
struct OneOfEach;
template <class... Own>
struct OneOfEach<std::variant<Own...>> : std::tuple<Own...> {};

/// The options of all methods, of which one is chosen.
struct MethodArguments {
  Method chosen;
  PixelGrid grid;  ///< of the methods that have one
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

struct AxisArguments {
  InputOptions input;
  CommonOptions common;
  std::string output;
  std::string format;
  io::WriteOptions write;
  Options options;
  MethodArguments methods;
  double fit = 0;  ///< for curve-axis: polygons become smooth within this distance; 0: they do not
};

Result<int> run_axis(const AxisArguments& arguments) {
  const InputOptions& input = arguments.input;
  const CommonOptions& common = arguments.common;
  const std::string &output = arguments.output, &format = arguments.format;
  Status writable =
      check_output(output, format, io::formats_of(io::DocumentKind::axes), input.path, common.json);
  if (!writable) return std::move(writable).error();

  Options options = arguments.options;
  options.method = arguments.methods.method();
  const bool contours = info_of(options.method).contours;
  auto shapes = load_shapes(input, common.threads, contours);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, input, common);
  if (contours && arguments.fit > 0)
    if (Status done = smooth_boundaries(*shapes, arguments.fit, input); !done)
      return std::move(done).error();
  auto axes = compute_axes(std::move(shapes).value(), input.path, common, options);
  if (!axes) return std::move(axes).error();

  return write_and_tell(*axes, input, common, output, format, arguments.write);
}

/// Which method, and what decides its random choices.
void add_method_options(CLI::App& command, MethodArguments& arguments) {
  std::string help = "How the axes are computed; `medial methods` shows what each takes:";
  std::vector<std::string> names;
  for (const MethodInfo& info : methods()) {
    help += fmt::format("\n{:<10} {}", info.name, info.summary);
    names.emplace_back(info.name);
  }
  command
      .add_option_function<std::string>(
          "--method",
          [&arguments](const std::string& name) { arguments.chosen = *method_from(name); }, help)
      ->check(CLI::IsMember(names).description(""))
      ->option_text("NAME");
  command
      .add_option("--seed", arguments.of<method::BiarcDc>().seed,
                  "Of the random choices of biarc-dc (default: 1). The same seed gives the\n"
                  "same result, byte for byte.")
      ->check(a_whole_number())
      ->option_text("N");
}

/// The arguments of the methods that sample.
void add_grid_options(CLI::App& command, MethodArguments& arguments) {
  auto& ridge = arguments.of<method::Ridge>();
  auto& brushfire = arguments.of<method::Brushfire>();
  constexpr char group[] = "Grids of pixels (--method ridge, brushfire)";
  CLI::Option* resolution = command
                                .add_option("--resolution", arguments.grid.resolution,
                                            "The side of a pixel, in units of the input.")
                                ->check(a_positive_number())
                                ->option_text("H")
                                ->group(group);
  command
      .add_option("--pixels", arguments.grid.pixels,
                  "Pixels along the longer side of the bounding box (default: 1024; of an\n"
                  "image its own pixels).")
      ->check(a_positive_number())
      ->excludes(resolution)
      ->option_text("N")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--brushfire",
          [&brushfire](const std::string& name) { brushfire.family = *brushfire_from(name); },
          "How a fire is kept from burning shapes apart: simultaneous (default), from\n"
          "all sides at once; marking, of two kinds in turn; sides, in turn; or\n"
          "sequential, pixel by pixel.")
      ->check(CLI::IsMember({"sequential", "sides", "marking", "simultaneous"}).description(""))
      ->option_text("FAMILY")
      ->group(group);
  command
      .add_option("--ridge-collinear", ridge.collinear,
                  "Vertices that turn by less than this, in degrees, are dropped where that\n"
                  "moves the boundary by a quarter of a pixel at most (default: 5; 0 keeps\n"
                  "every edge).")
      ->option_text("A")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--ridge-search",
          [&ridge](const std::string& name) {
            ridge.search = name == "tree" ? RidgeSearch::tree : RidgeSearch::sorted_list;
          },
          "How the nearest edges are found: tree (default) or sorted-list, the\n"
          "report's own. The pixels are the same.")
      ->check(CLI::IsMember({"tree", "sorted-list"}).description(""))
      ->option_text("NAME")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--ridge-rule",
          [&ridge](const std::string& name) {
            ridge.rule = name == "crossing" ? RidgeRule::crossing : RidgeRule::difference;
          },
          "Which pixels are medial: crossing (default), where the axis passes between\n"
          "two pixels; or difference, the report's rule: where the distances to two\n"
          "edges differ by less than a pixel.")
      ->check(CLI::IsMember({"crossing", "difference"}).description(""))
      ->option_text("NAME")
      ->group(group);
}

/// The arguments of potential.
void add_potential_options(CLI::App& command, method::Potential& options) {
  command
      .add_option("--order", options.order,
                  "Of the potential: the n of 1 / r^n. 0 (default) chooses it for each point.")
      ->option_text("N");
  command
      .add_option("--base-order", options.base_order,
                  "Of the force lines that potential follows first (default: the order, at most\n"
                  "512). 1 is the paper's.")
      ->option_text("N");
  add_list_option(
      command, "--from", 2,
      [&options](const std::vector<double>& xy) {
        options.from = Vec2{xy[0], xy[1]};
      },
      "Potential: only the branch that the force leads to from this place, in units\n"
      "of the input.")
      ->option_text("X,Y");
  add_list_option(
      command, "--within", 4,
      [&options](const std::vector<double>& box) {
        options.within = Box{{box[0], box[1]}, {box[2], box[3]}};
      },
      "Potential: only what lies in this box: low x, low y, high x, high y, in units\n"
      "of the input.")
      ->option_text("X,Y,X,Y");
  command
      .add_option(
          "--step", options.step,
          "Of potential: from point to point, as a share of the longer side of the bounding\n"
          "box (default: 0.01).")
      ->option_text("SHARE");
  command
      .add_option("--coarse", options.coarse,
                  "Potential: first the axis of a polygon within this share of the size of the\n"
                  "boundary, then refined on finer ones: without the branches of small teeth.")
      ->option_text("SHARE");
}

/// The arguments of curve-axis.
void add_curve_options(CLI::App& command, AxisArguments& arguments) {
  command
      .add_option("--curve-step", arguments.methods.of<method::CurveAxis>().step,
                  "Of curve-axis: the way from point to point, as a share of the diagonal\n"
                  "(default: 0.001).")
      ->check(in_range(1e-6, 0.1))
      ->option_text("SHARE");
  command
      .add_option("--fit", arguments.fit,
                  "For curve-axis: a smooth curve through the corners of the boundary, within\n"
                  "this distance of it, in units of the input.")
      ->check(a_positive_number())
      ->option_text("D");
}

}  // namespace

Command make_axis_command(CLI::App& program) {
  auto arguments = std::make_shared<AxisArguments>();
  CLI::App* command =
      program.add_subcommand("axis", "Compute medial axes and write them to a file.");
  add_input_options(*command, arguments->input);
  add_output_options(*command, arguments->output, arguments->format,
                     io::formats_of(io::DocumentKind::axes));
  command->add_flag("--radius-as-z", arguments->write.radius_as_z,
                    "Drawings (.dxf): splines in space, with the radius as z.");
  add_method_options(*command, arguments->methods);
  add_exterior_options(*command, arguments->options,
                       "The axis of what lies around the shape and in its holes, within a frame.");
  add_grid_options(*command, arguments->methods);
  add_potential_options(*command, arguments->methods.of<method::Potential>());
  add_curve_options(*command, *arguments);
  command->add_flag("--exact", arguments->options.exact,
                    "Make every decision of the combinatorics certain: which sites a disk\n"
                    "touches, and which nodes an edge joins. What was decided how is counted in\n"
                    "--stats. Ties within the tolerance that are none get nodes of their own.");
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "Each feature gets its own axis, with its attributes. Coordinates, radii and\n"
      "lengths are in the units of the input, or in metres with --project.\n"
      "\n"
      "Formats: .json is medial's own, lossless, and read back by every command; .geojson,\n"
      ".gpkg, .shp and .fgb hold one line a branch with the radius at both ends; .csv\n"
      "has the header edge,x,y,r; .dxf holds polylines and exact splines; pictures show\n"
      "the axis coloured by radius.\n"
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
  return {command, [arguments] { return run_axis(*arguments); }};
}

}  // namespace medial::cli
