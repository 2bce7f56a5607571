// medial axis: shapes in, medial axes out.

#include <memory>

#include "cli/common.h"
#include "cli/pipeline.h"

namespace medial::cli {
namespace {

struct AxisSwitches {
  InputSwitches input;
  CommonSwitches common;
  std::string output;
  std::string format;
  io::WriteOptions write;
  Options options;
};

Result<int> run_axis(const AxisSwitches& switches) {
  const auto& [input, common, output, format, pictures, options] = switches;
  Status writable =
      check_output(output, format, io::known_output_formats(), input.path, common.json);
  if (!writable) return std::move(writable).error();

  auto shapes = load_shapes(input, common.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, input, common);
  auto axes = compute_axes(std::move(shapes).value(), input.path, common, options);
  if (!axes) return std::move(axes).error();

  return write_and_tell(*axes, input, common, output, format, pictures);
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
      ->check(a_name())
      ->option_text("OUTPUT");
  verb->add_option("--format", switches->format, "The format of -o -, for example csv.")
      ->option_text("NAME");
  verb->add_flag("--radius-as-z", switches->write.radius_as_z,
                 "Drawings (.dxf): splines in space, with the radius as z.");
  verb->add_option_function<std::string>(
          "--method",
          [switches](const std::string& name) { switches->options.method = *method_from(name); },
          "How the axes are computed: disks (default); biarc-dc, the published\n"
          "randomised divide and conquer, for shapes without holes; or lee, the\n"
          "merging of Voronoi diagrams, for polygons without holes. All give the\n"
          "same axes.")
      ->check(CLI::IsMember({"disks", "biarc-dc", "lee"}).description(""))
      ->option_text("NAME");
  verb->add_option("--seed", switches->options.seed,
                   "Of the random choices of biarc-dc (default: 1). The same seed gives the\n"
                   "same result, byte for byte.")
      ->check(a_whole_number())
      ->option_text("N");
  add_picture_switches(*verb, switches->write);
  add_common_switches(*verb, switches->common);
  verb->footer(
      "Each feature gets its own axis, with its attributes. Coordinates, radii and\n"
      "lengths are in the units of the input, or in metres with --project.\n"
      "\n"
      "Formats: .json is medial's own, lossless, and read back by every verb; .geojson,\n"
      ".gpkg, .shp and .fgb hold one line a branch with the radius at both ends; .csv\n"
      "has the header edge,x,y,r; .dxf holds polylines and exact splines; pictures show\n"
      "the axis coloured by radius.\n"
      "\n"
      "Examples:\n"
      "  medial axis plan.geojson -o plan.svg --disks 200\n"
      "  medial axis lakes.gpkg --layer lakes --where \"area > 1e6\" --project -o axes.gpkg\n"
      "  medial axis maze.wkt.gz -o maze.json --stats\n"
      "  medial axis --text \"Rg&8\" --font DejaVuSans.ttf -o letters.svg\n"
      "  medial axis part.dxf --layer OUTLINE -o axis.dxf --radius-as-z\n"
      "  medial axis broken.shp --repair=even-odd -o axes.shp\n"
      "  cat shape.wkt | medial axis - -o - --format csv --chord 1e-4 | head");
  return {verb, [switches] { return run_axis(*switches); }};
}

}  // namespace medial::cli
