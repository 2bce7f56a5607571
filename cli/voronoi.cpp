// medial voronoi: points, lines, curves and polygons in, Voronoi diagrams out.

#include "medial/voronoi.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/common.h"
#include "cli/costs.h"
#include "cli/loose.h"
#include "cli/nearest.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "cli/verbs.h"

namespace medial::cli {
namespace {

struct VoronoiSwitches {
  InputSwitches input;
  CommonSwitches common;
  std::string method = "disks";
  std::vector<double> frame;
  double margin = 0;
  NearestSwitches nearest;
  std::string output;
  std::string format;
  io::WriteOptions write;
};

/// What there is to tell of diagrams.
struct Summary {
  std::uint64_t segments = 0, vertices = 0, edges = 0, spokes = 0, points = 0;
  bool soup = false;
};

Summary sum_of(const io::VoronoiFile& file) {
  Summary sum;
  for (const io::VoronoiItem& item : file.items) {
    const VoronoiDiagram& diagram = item.diagram;
    for (const Site& site : diagram.sites)
      ++(site.kind == SiteKind::vertex ? sum.vertices : sum.segments);
    sum.soup = sum.soup || diagram.frame.has_value();
    sum.edges += diagram.edges.size();
    for (const VoronoiEdge& edge : diagram.edges) sum.spokes += edge.spoke ? 1 : 0;
    for (const Node& node : diagram.nodes) sum.points += node.disk.radius > 0 ? 1 : 0;
  }
  return sum;
}

Result<io::VoronoiFile> compute_diagrams(ShapeFile shapes, const std::string& path,
                                         const CommonSwitches& common) {
  io::VoronoiFile file;
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
Result<io::VoronoiFile> compute_soup(const VoronoiSwitches& switches, Phases& seconds) {
  const auto& input = switches.input;
  const Stopwatch reading;
  auto loose = load_chains(input, switches.common.threads);
  if (!loose) return std::move(loose).error();
  print_notes(*loose, input, switches.common);
  seconds.read = reading.seconds();
  std::optional<Box> frame;
  if (!switches.frame.empty())
    frame = Box{{switches.frame[0], switches.frame[1]}, {switches.frame[2], switches.frame[3]}};
  Soup soup;
  const Stopwatch watch;
  auto diagram = with_soup(*loose, input, switches.common, soup, [&] {
    const Stopwatch computing;
    auto computed = voronoi_diagram(soup,
                                    {.tolerance = switches.common.tolerance,
                                     .threads = switches.common.threads,
                                     .margin = switches.margin},
                                    frame);
    seconds.voronoi = computing.seconds();
    return computed;
  });
  if (!diagram) return std::move(diagram).error();
  seconds.shape = watch.seconds() - seconds.voronoi;
  io::VoronoiFile file;
  file.crs_wkt = loose->crs_wkt;
  file.y_down = loose->y_down;
  file.items.push_back({{}, std::move(diagram).value(), {}});
  return file;
}

Status tell(const io::VoronoiFile& file, const VoronoiSwitches& switches, double seconds,
            const Json& costs) {
  const Summary sum = sum_of(file);
  if (switches.common.json) {
    Json object = {
        {"input", switches.input.path}, {"features", file.items.size()},
        {"segments", sum.segments},     {sum.soup ? "points" : "reflex_vertices", sum.vertices},
        {"edges", sum.edges},           {"spokes", sum.spokes},
        {"voronoi_points", sum.points}, {"seconds", seconds}};
    if (switches.common.stats) object.update(costs);
    return print(object);
  }
  const std::string line =
      fmt::format("{}: {}, {}, {}; {} ({}), {}; {:.3g} s\n", switches.input.path,
                  counted(file.items.size(), "feature"), counted(sum.segments, "segment"),
                  sum.soup ? counted(sum.vertices, "point")
                           : counted(sum.vertices, "reflex vertex", "reflex vertices"),
                  counted(sum.edges, "edge"), counted(sum.spokes, "spoke"),
                  counted(sum.points, "Voronoi point"), seconds);
  if (switches.output.empty()) return print(line);
  if (error_is_terminal() && !switches.common.quiet) say_text(line);
  return success();
}

Result<io::VoronoiFile> compute_by_lee(const VoronoiSwitches& switches, Phases& seconds) {
  auto shapes = load_shapes(switches.input, switches.common.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, switches.input, switches.common);
  seconds.read = shapes->seconds_read;
  seconds.shape = shapes->seconds_shape;
  const Stopwatch watch;
  auto computed = compute_diagrams(std::move(shapes).value(), switches.input.path, switches.common);
  seconds.voronoi = watch.seconds();
  return computed;
}

Result<int> run_voronoi(const VoronoiSwitches& switches) {
  const auto& [input, common, method, frame, margin, nearest, output, format, pictures] = switches;
  const bool by_lee = method == "lee";
  if (nearest.any()) {
    if (by_lee || !frame.empty() || margin > 0)
      return invalid_option("the nearest site is that of the whole plane: no frame, not by lee");
    return run_nearest(input, common, nearest, output, format);
  }
  Status writable =
      check_output(output, format, io::known_voronoi_formats(), input.path, common.json);
  if (!writable) return std::move(writable).error();
  if (by_lee && !(frame.empty() && margin == 0))
    return invalid_option("the method lee has no frame: polygons are it");
  Phases seconds;
  auto diagrams = by_lee ? compute_by_lee(switches, seconds) : compute_soup(switches, seconds);
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
  Status told = tell(*diagrams, switches, seconds.voronoi, costs);
  if (!told) return std::move(told).error();
  print_costs(common, costs);
  return exit_success;
}

}  // namespace

Verb make_voronoi_verb(CLI::App& program) {
  auto switches = std::make_shared<VoronoiSwitches>();
  CLI::App* verb = program.add_subcommand(
      "voronoi", "Compute the Voronoi diagram of points, lines, curves and polygons.");
  add_input_switches(*verb, switches->input);
  add_output_switches(*verb, switches->output, switches->format, io::known_voronoi_formats());
  verb->add_option("--method", switches->method,
                   "How: disks (default), of everything in the file together, within a\n"
                   "frame; or lee, of each polygon inside of it.")
      ->check(CLI::IsMember({"disks", "lee"}).description(""))
      ->option_text("NAME");
  verb->add_option("--margin", switches->margin,
                   "How far the frame is away from the input's bounding box, in units of the\n"
                   "input (default: half of its longer side).")
      ->check(a_positive_number())
      ->option_text("M");
  add_list_switch(
      *verb, "--frame", 4,
      [switches](const std::vector<double>& frame) { switches->frame = frame; },
      "The frame itself: low x, low y, high x, high y, in units of the input. It must\n"
      "hold the input.")
      ->excludes("--margin")
      ->option_text("X,Y,X,Y");
  add_nearest_switches(*verb, switches->nearest);
  add_picture_switches(*verb, switches->write);
  add_common_switches(*verb, switches->common);
  verb->footer(
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
  return {verb, [switches] { return run_voronoi(*switches); }};
}

}  // namespace medial::cli
