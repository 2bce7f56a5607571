// medial axis: shapes in, medial axes out.

#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/choose.h"
#include "medial/curve_axis.h"

namespace medial::cli {
namespace {

struct AxisArguments {
  InputOptions input;
  CommonOptions common;
  std::string output;
  std::string format;
  io::WriteOptions write;
  Options options;
  bool automatic = false;   ///< each shape by the faster one of disks and lee
  bool curve_axis = false;  ///< the method, which takes contours instead of a shape
  CurveAxisOptions curve;
  double fit = 0;  ///< for curve-axis: polygons become smooth within this distance; 0: they do not
};

Result<int> run_axis(const AxisArguments& arguments) {
  const InputOptions& input = arguments.input;
  const CommonOptions& common = arguments.common;
  const std::string &output = arguments.output, &format = arguments.format;
  Status writable =
      check_output(output, format, io::formats_of(io::DocumentKind::axes), input.path, common.json);
  if (!writable) return std::move(writable).error();

  auto shapes = load_shapes(input, common.threads, arguments.curve_axis);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, input, common);
  Engine engine;
  if (arguments.curve_axis) {
    if (arguments.fit > 0) {
      if (Status done = smooth_boundaries(*shapes, arguments.fit, input); !done)
        return std::move(done).error();
    }
    engine = [&, contours = std::move(shapes->contours)](std::size_t i, const Shape&,
                                                         const Options&) -> Result<MedialAxis> {
      auto axis = compute_curve_axis(contours[i], arguments.curve);
      if (!axis) return std::move(axis).error();
      return std::move(axis->axis);
    };
  }
  if (arguments.automatic) {
    engine = [](std::size_t, const Shape& shape, const Options& options) {
      Options own = options;
      own.method = choose_method(shape, options);
      auto axis = compute(shape, own);
      const bool failed = !axis && (axis.error().code == ErrorCode::internal ||
                                    axis.error().code == ErrorCode::unsupported);
      if (!failed || own.method == Method::disks) return axis;
      own.method = Method::disks;
      return compute(shape, own);
    };
  }
  auto axes =
      compute_axes(std::move(shapes).value(), input.path, common, arguments.options, engine);
  if (!axes) return std::move(axes).error();

  return write_and_tell(*axes, input, common, output, format, arguments.write);
}

/// Which method, and what decides its random choices.
void add_method_options(CLI::App& command, AxisArguments& arguments) {
  command
      .add_option_function<std::string>(
          "--method",
          [&arguments](const std::string& name) {
            arguments.curve_axis = name == "curve-axis";
            arguments.automatic = name == "auto";
            arguments.options.method = method_from(name).value_or(Method::disks);
          },
          "How the axes are computed: disks (default); biarc-dc, the published\n"
          "randomised divide and conquer, for shapes without holes; lee, the merging\n"
          "of Voronoi diagrams, for polygons without holes: all the same axes; auto,\n"
          "for each shape the faster one of disks and lee; or\n"
          "ridge, ridge following on a grid of pixels, or brushfire, thinning of pixels:\n"
          "sampled axes; or potential, the valleys of a potential field: a sampled axis\n"
          "too, smooth; or curve-axis, for one smooth boundary: sampled from its\n"
          "curvature's maxima on.")
      ->check(CLI::IsMember({"disks", "biarc-dc", "lee", "auto", "ridge", "brushfire", "potential",
                             "curve-axis"})
                  .description(""))
      ->option_text("NAME");
  command
      .add_option("--seed", arguments.options.seed,
                  "Of the random choices of biarc-dc (default: 1). The same seed gives the\n"
                  "same result, byte for byte.")
      ->check(a_whole_number())
      ->option_text("N");
}

/// The arguments of the methods that sample.
void add_grid_options(CLI::App& command, Options& options) {
  constexpr char group[] = "Grids of pixels (--method ridge, brushfire)";
  CLI::Option* resolution = command
                                .add_option("--resolution", options.resolution,
                                            "The side of a pixel, in units of the input.")
                                ->check(a_positive_number())
                                ->option_text("H")
                                ->group(group);
  command
      .add_option("--pixels", options.pixels,
                  "Pixels along the longer side of the bounding box (default: 1024; of an\n"
                  "image its own pixels).")
      ->check(a_positive_number())
      ->excludes(resolution)
      ->option_text("N")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--brushfire",
          [&options](const std::string& name) { options.brushfire = *brushfire_from(name); },
          "How a fire is kept from burning shapes apart: simultaneous (default), from\n"
          "all sides at once; marking, of two kinds in turn; sides, in turn; or\n"
          "sequential, pixel by pixel.")
      ->check(CLI::IsMember({"sequential", "sides", "marking", "simultaneous"}).description(""))
      ->option_text("FAMILY")
      ->group(group);
  command
      .add_option("--ridge-collinear", options.ridge_collinear,
                  "Vertices that turn by less than this, in degrees, are dropped where that\n"
                  "moves the boundary by a quarter of a pixel at most (default: 5; 0 keeps\n"
                  "every edge).")
      ->option_text("A")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--ridge-search",
          [&options](const std::string& name) {
            options.ridge_search = name == "tree" ? RidgeSearch::tree : RidgeSearch::sorted_list;
          },
          "How the nearest edges are found: tree (default) or sorted-list, the\n"
          "report's own. The pixels are the same.")
      ->check(CLI::IsMember({"tree", "sorted-list"}).description(""))
      ->option_text("NAME")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--ridge-rule",
          [&options](const std::string& name) {
            options.ridge_rule = name == "crossing" ? RidgeRule::crossing : RidgeRule::difference;
          },
          "Which pixels are medial: crossing (default), where the axis passes between\n"
          "two pixels; or difference, the report's rule: where the distances to two\n"
          "edges differ by less than a pixel.")
      ->check(CLI::IsMember({"crossing", "difference"}).description(""))
      ->option_text("NAME")
      ->group(group);
}

/// The arguments of potential.
void add_potential_options(CLI::App& command, PotentialOptions& options) {
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
      .add_option("--curve-step", arguments.curve.step,
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
  add_method_options(*command, *arguments);
  add_exterior_options(*command, arguments->options,
                       "The axis of what lies around the shape and in its holes, within a frame.");
  add_grid_options(*command, arguments->options);
  add_potential_options(*command, arguments->options.potential);
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
