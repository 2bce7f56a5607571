// medial voronoi: points, lines, curves and polygons in, Voronoi diagrams out.

#include "medial/voronoi.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/costs.h"
#include "cli/loose.h"
#include "cli/nearest.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

struct VoronoiArguments {
  InputOptions input;
  CommonOptions common;
  std::string method = "disks";
  std::vector<double> frame;
  double margin = 0;
  NearestArguments nearest;
  std::string output;
  std::string format;
  io::WriteOptions write;
};

/// What there is to tell of diagrams.
struct Summary {
  std::uint64_t segments = 0, vertices = 0, edges = 0, spokes = 0, points = 0;
  bool planar_graph = false;
};

Summary sum_of(const Document<io::VoronoiItem>& file) {
  Summary sum;
  for (const io::VoronoiItem& item : file.items) {
    const VoronoiDiagram& diagram = item.diagram;
    for (const Site& site : diagram.sites)
      ++(site.kind == SiteKind::vertex ? sum.vertices : sum.segments);
    sum.planar_graph = sum.planar_graph || diagram.frame.has_value();
    sum.edges += diagram.edges.size();
    for (const VoronoiEdge& edge : diagram.edges) sum.spokes += edge.spoke ? 1 : 0;
    for (const Node& node : diagram.nodes) sum.points += node.disk.radius > 0 ? 1 : 0;
  }
  return sum;
}

Result<Document<io::VoronoiItem>> compute_diagrams(ShapeFile shapes, const std::string& path,
                                                   const CommonOptions& common) {
  Document<io::VoronoiItem> file;
  file.crs_wkt = shapes.crs_wkt;
  file.y_down = shapes.y_down;
  file.items.resize(shapes.shapes.size());
  Status computed = for_each_feature(
      weights_of(shapes.shapes), common.threads, [&](std::size_t i, int threads) -> Status {
        auto diagram =
            voronoi_diagram(shapes.shapes[i], {.tolerance = common.tolerance, .threads = threads});
        if (!diagram) return at_feature(std::move(diagram).error(), path, i);
        file.items[i] = {std::move(shapes.shapes[i]), std::move(diagram).value(),
                         std::move(shapes.attributes[i])};
        return success();
      });
  if (!computed) return std::move(computed).error();
  return file;
}

/// Seconds by phase.
struct Phases {
  double read = 0;
  double shape = 0;
  double voronoi = 0;
};

/// One diagram of all that the file holds.
Result<Document<io::VoronoiItem>> compute_planar_graph(const VoronoiArguments& arguments,
                                                       Phases& seconds) {
  const auto& input = arguments.input;
  const Stopwatch reading;
  auto loose = load_chains(input, arguments.common.threads);
  if (!loose) return std::move(loose).error();
  print_notes(*loose, input, arguments.common);
  seconds.read = reading.seconds();
  std::optional<Box> frame;
  if (!arguments.frame.empty())
    frame = Box{{arguments.frame[0], arguments.frame[1]}, {arguments.frame[2], arguments.frame[3]}};
  PlanarGraph planar_graph;
  const Stopwatch watch;
  auto diagram = with_planar_graph(*loose, input, arguments.common, planar_graph, [&] {
    const Stopwatch computing;
    auto computed = voronoi_diagram(planar_graph,
                                    {.tolerance = arguments.common.tolerance,
                                     .threads = arguments.common.threads,
                                     .margin = arguments.margin},
                                    frame);
    seconds.voronoi = computing.seconds();
    return computed;
  });
  if (!diagram) return std::move(diagram).error();
  seconds.shape = watch.seconds() - seconds.voronoi;
  Document<io::VoronoiItem> file;
  file.crs_wkt = loose->crs_wkt;
  file.y_down = loose->y_down;
  file.items.push_back({{}, std::move(diagram).value(), {}});
  return file;
}

Status tell(const Document<io::VoronoiItem>& file, const VoronoiArguments& arguments,
            double seconds, const Json& costs) {
  const Summary sum = sum_of(file);
  if (arguments.common.json) {
    Json object = {{"input", arguments.input.path},
                   {"features", file.items.size()},
                   {"segments", sum.segments},
                   {sum.planar_graph ? "points" : "reflex_vertices", sum.vertices},
                   {"edges", sum.edges},
                   {"spokes", sum.spokes},
                   {"voronoi_points", sum.points},
                   {"seconds", seconds}};
    if (arguments.common.stats) object.update(costs);
    return print(object);
  }
  const std::string line =
      fmt::format("{}: {}, {}, {}; {} ({}), {}; {:.3g} s\n", arguments.input.path,
                  counted(file.items.size(), "feature"), counted(sum.segments, "segment"),
                  sum.planar_graph ? counted(sum.vertices, "point")
                                   : counted(sum.vertices, "reflex vertex", "reflex vertices"),
                  counted(sum.edges, "edge"), counted(sum.spokes, "spoke"),
                  counted(sum.points, "Voronoi point"), seconds);
  if (arguments.output.empty()) return print(line);
  if (error_is_terminal() && !arguments.common.quiet) say_text(line);
  return success();
}

Result<Document<io::VoronoiItem>> compute_by_lee(const VoronoiArguments& arguments,
                                                 Phases& seconds) {
  auto shapes = load_shapes(arguments.input, arguments.common.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, arguments.input, arguments.common);
  seconds.read = shapes->seconds_read;
  seconds.shape = shapes->seconds_shape;
  const Stopwatch watch;
  auto computed =
      compute_diagrams(std::move(shapes).value(), arguments.input.path, arguments.common);
  seconds.voronoi = watch.seconds();
  return computed;
}

Result<int> run_voronoi(const VoronoiArguments& arguments) {
  const auto& [input, common, method, frame, margin, nearest, output, format, pictures] = arguments;
  const bool by_lee = method == "lee";
  if (nearest.any()) {
    if (by_lee || !frame.empty() || margin > 0)
      return invalid_option("the nearest site is that of the whole plane: no frame, not by lee");
    return run_nearest(input, common, nearest, output, format);
  }
  Status writable = check_output(output, format, io::formats_of(io::DocumentKind::voronoi),
                                 input.path, common.json);
  if (!writable) return std::move(writable).error();
  if (by_lee && !(frame.empty() && margin == 0))
    return invalid_option("the method lee has no frame: polygons are it");
  Phases seconds;
  auto diagrams =
      by_lee ? compute_by_lee(arguments, seconds) : compute_planar_graph(arguments, seconds);
  if (!diagrams) return std::move(diagrams).error();
  const Stopwatch writing;
  if (!output.empty()) {
    io::WriteOptions write = pictures;
    write.chord = common.chord;
    const Activity shown("writing", output);
    Status written = io::write_voronoi(output, format, *diagrams, write);
    if (!written) return std::move(written).error();
  }
  const Json costs = costs_of(common, {{"read", seconds.read},
                                       {"shape", seconds.shape},
                                       {"voronoi", seconds.voronoi},
                                       {"write", writing.seconds()}});
  Status told = tell(*diagrams, arguments, seconds.voronoi, costs);
  if (!told) return std::move(told).error();
  print_costs(common, costs);
  return exit_success;
}

}  // namespace

Command make_voronoi_command(CLI::App& program) {
  auto arguments = std::make_shared<VoronoiArguments>();
  CLI::App* command = program.add_subcommand(
      "voronoi", "Compute the Voronoi diagram of points, lines, curves and polygons.");
  add_input_options(*command, arguments->input);
  add_output_options(*command, arguments->output, arguments->format,
                     io::formats_of(io::DocumentKind::voronoi));
  command
      ->add_option("--method", arguments->method,
                   "How: disks (default), of everything in the file together, within a\n"
                   "frame; or lee, of each polygon inside of it.")
      ->check(CLI::IsMember({"disks", "lee"}).description(""))
      ->option_text("NAME");
  command
      ->add_option("--margin", arguments->margin,
                   "How far the frame is away from the input's bounding box, in units of the\n"
                   "input (default: half of its longer side).")
      ->check(a_positive_number())
      ->option_text("M");
  add_list_option(
      *command, "--frame", 4,
      [arguments](const std::vector<double>& frame) { arguments->frame = frame; },
      "The frame itself: low x, low y, high x, high y, in units of the input. It must\n"
      "hold the input.")
      ->excludes("--margin")
      ->option_text("X,Y,X,Y");
  add_nearest_options(*command, arguments->nearest);
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "Every point, and every segment and arc between its ends, has a face: the places\n"
      "that are nearer to it than to all others, bounded by exact curves and by the\n"
      "frame. Edges may meet in ends; where they cross, --repair splits them. In plain\n"
      "text, blocks between blank lines are chains, and a single block a list of points.\n"
      "\n"
      "With --method lee, polygons without holes and without arcs: every segment and every\n"
      "reflex vertex has a face inside.\n"
      "\n"
      ".json holds the graph without loss, .geojson the faces as polygons and the edges\n"
      "as lines, .wkt the faces, .csv the edges; pictures show the faces in colours.\n"
      "\n"
      "Examples:\n"
      "  medial voronoi wells.csv -o wells.geojson\n"
      "  medial voronoi roads.gpkg --margin 500 --repair -o nearest.geojson\n"
      "  medial voronoi room.wkt --method lee -o room.svg\n"
      "  medial voronoi roads.gpkg --queries houses.csv -o nearest-road.csv\n"
      "  medial voronoi parcels.geojson --where \"area > 100\" -o faces.geojson\n"
      "  medial voronoi plan.wkt -o - --format json | jq '.items[0].edges | length'");
  return {command, [arguments] { return run_voronoi(*arguments); }};
}

}  // namespace medial::cli
