// medial voronoi: polygons in, Voronoi diagrams of their segments and reflex vertices out.

#include "medial/voronoi.h"

#include <fmt/format.h>

#include <memory>

#include "cli/common.h"
#include "cli/costs.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

struct VoronoiSwitches {
  InputSwitches input;
  CommonSwitches common;
  std::string output;
  std::string format;
  io::WriteOptions write;
};

/// What there is to tell of diagrams.
struct Summary {
  std::uint64_t segments = 0, vertices = 0, edges = 0, spokes = 0, points = 0;
};

Summary summarize(const io::VoronoiFile& file) {
  Summary sum;
  for (const io::VoronoiItem& item : file.items) {
    const VoronoiDiagram& diagram = item.diagram;
    for (const Site& site : diagram.sites)
      ++(site.kind == SiteKind::vertex ? sum.vertices : sum.segments);
    sum.edges += diagram.edges.size();
    for (const VoronoiEdge& edge : diagram.edges) sum.spokes += edge.spoke ? 1 : 0;
    for (const Node& node : diagram.nodes) sum.points += node.disk.radius > 0 ? 1 : 0;
  }
  return sum;
}

Result<io::VoronoiFile> compute_diagrams(ShapeFile shapes, const std::string& path,
                                         const CommonSwitches& common) {
  io::VoronoiFile file;
  file.y_down = shapes.y_down;
  file.items.resize(shapes.shapes.size());
  Status computed = for_each_feature(
      weights_of(shapes.shapes), common.threads, [&](std::size_t i, int threads) -> Status {
        auto diagram =
            voronoi_diagram(shapes.shapes[i], {.tolerance = common.tolerance, .threads = threads});
        if (!diagram) {
          Error error = std::move(diagram).error();
          if (error.place.file.empty()) error.place.file = path;
          error.place.feature = i;
          return error;
        }
        file.items[i] = {std::move(shapes.shapes[i]), std::move(diagram).value(),
                         std::move(shapes.attributes[i])};
        return success();
      });
  if (!computed) return std::move(computed).error();
  return file;
}

Status tell(const io::VoronoiFile& file, const VoronoiSwitches& switches, double seconds,
            const Json& costs) {
  const Summary sum = summarize(file);
  if (switches.common.json) {
    Json object = {{"input", switches.input.path}, {"features", file.items.size()},
                   {"segments", sum.segments},     {"reflex_vertices", sum.vertices},
                   {"edges", sum.edges},           {"spokes", sum.spokes},
                   {"voronoi_points", sum.points}, {"seconds", seconds}};
    if (switches.common.stats) object.update(costs);
    return print(object);
  }
  const std::string line = fmt::format(
      "{}: {}, {}, {}; {} ({}), {}; {:.3g} s\n", switches.input.path,
      counted(file.items.size(), "feature"), counted(sum.segments, "segment"),
      counted(sum.vertices, "reflex vertex", "reflex vertices"), counted(sum.edges, "edge"),
      counted(sum.spokes, "spoke"), counted(sum.points, "Voronoi point"), seconds);
  if (switches.output.empty()) return print(line);
  if (error_is_terminal() && !switches.common.quiet) fmt::print(stderr, "{}", line);
  return success();
}

Result<int> run_voronoi(const VoronoiSwitches& switches) {
  const auto& [input, common, output, format, pictures] = switches;
  Status writable =
      check_output(output, format, io::known_voronoi_formats(), input.path, common.json);
  if (!writable) return std::move(writable).error();
  auto shapes = load_shapes(input, common.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, input, common);
  const double seconds_read = shapes->seconds_read, seconds_shape = shapes->seconds_shape;
  const Stopwatch watch;
  auto diagrams = compute_diagrams(std::move(shapes).value(), input.path, common);
  if (!diagrams) return std::move(diagrams).error();
  const double seconds = watch.seconds();
  const Stopwatch writing;
  if (!output.empty()) {
    io::WriteOptions write = pictures;
    write.chord = common.chord;
    Status written = io::write_voronoi(output, format, *diagrams, write);
    if (!written) return std::move(written).error();
  }
  const Json costs = costs_of(common, {{"read", seconds_read},
                                       {"shape", seconds_shape},
                                       {"voronoi", seconds},
                                       {"write", writing.seconds()}});
  Status told = tell(*diagrams, switches, seconds, costs);
  if (!told) return std::move(told).error();
  print_costs(common, costs);
  return exit_success;
}

}  // namespace

Verb make_voronoi_verb(CLI::App& program) {
  auto switches = std::make_shared<VoronoiSwitches>();
  CLI::App* verb = program.add_subcommand(
      "voronoi", "Compute the Voronoi diagrams of the edges of polygons, inside of them.");
  add_input_switches(*verb, switches->input);
  verb->add_option("-o,--output", switches->output,
                   fmt::format("Where to write; the extension tells the format:\n{}\n"
                               "- is standard output, see --format. Without -o, only a summary is\n"
                               "printed.",
                               io::known_voronoi_formats()))
      ->check(a_name())
      ->option_text("OUTPUT");
  verb->add_option("--format", switches->format, "The format of -o -, for example geojson.")
      ->option_text("NAME");
  verb->add_option_function<std::string>(
          "--method", [](const std::string&) {}, "How: lee (default), the only method so far.")
      ->check(CLI::IsMember({"lee"}).description(""))
      ->option_text("NAME");
  add_picture_switches(*verb, switches->write);
  add_common_switches(*verb, switches->common);
  verb->footer(
      "Polygons without holes and without arcs: every segment and every reflex vertex\n"
      "has a face. The edges are exact lines and parabolas; the spokes, those between a\n"
      "reflex vertex and its segments, included. Without the spokes this is the medial\n"
      "axis.\n"
      "\n"
      ".json holds the graph without loss, .geojson the faces as polygons and the edges\n"
      "as lines; pictures show the faces in colours.\n"
      "\n"
      "Examples:\n"
      "  medial voronoi plan.wkt -o plan.svg\n"
      "  medial voronoi parcels.geojson --where \"area > 100\" -o faces.geojson\n"
      "  medial voronoi plan.wkt -o - --format json | jq '.items[0].edges | length'");
  return {verb, [switches] { return run_voronoi(*switches); }};
}

}  // namespace medial::cli
