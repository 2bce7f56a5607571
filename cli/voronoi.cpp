// medial voronoi: points, lines, curves and polygons in, Voronoi diagrams out.

#include "medial/voronoi.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/nearest.h"
#include "cli/pipeline.h"

namespace medial::cli {
namespace {

struct VoronoiArguments : FileArguments {
  std::string method = "disks";
  std::vector<double> enclosure;
  double margin = 0;
  NearestArguments nearest;
};

/// The diagrams of a file.
struct Diagrams {
  Document<io::VoronoiItem> file;
  Phases phases;
};

/// One diagram of the whole content of the file.
Result<Diagrams> compute_together(const VoronoiArguments& arguments) {
  const CommonOptions& common = arguments.common;
  Diagrams out;
  auto pieces = load_loose(arguments.input, common);
  if (!pieces) return std::move(pieces).error();
  out.phases.end("read");
  std::optional<Box> enclosure;
  if (const auto& box = arguments.enclosure; !box.empty())
    enclosure = Box{{box[0], box[1]}, {box[2], box[3]}};
  io::VoronoiItem item;
  Status computed = with_planar_graph(*pieces, arguments, [&](PlanarGraph& graph) -> Status {
    out.phases.end("shape");
    auto diagram = voronoi_diagram(
        graph,
        {.tolerance = common.tolerance, .threads = common.threads, .margin = arguments.margin},
        enclosure);
    if (!diagram) return std::move(diagram).error();
    item.diagram = std::move(diagram).value();
    return success();
  });
  if (!computed) return std::move(computed).error();
  out.phases.end("voronoi");
  out.file = Document<io::VoronoiItem>{pieces->features, {}};
  out.file.indices.clear();  // the diagram is that of all features
  item.pieces = std::move(*pieces);
  item.pieces.chains.clear();
  out.file.items.push_back(std::move(item));
  return out;
}

/// A diagram of each shape.
Result<Diagrams> compute_by_lee(const VoronoiArguments& arguments) {
  const CommonOptions& common = arguments.common;
  auto shapes = load_shapes(arguments.input, common);
  if (!shapes) return std::move(shapes).error();
  std::vector<ShapeItem>& items = shapes->file.items;
  const auto compute_one = [&](std::size_t i, int threads) -> Result<io::VoronoiItem> {
    auto diagram =
        voronoi_diagram(items[i].shape, {.tolerance = common.tolerance, .threads = threads});
    if (!diagram) return std::move(diagram).error();
    return io::VoronoiItem{
        std::move(items[i].shape), std::move(diagram).value(), std::move(items[i].attributes), {}};
  };
  std::vector<std::string> left_out;
  auto computed =
      map_features<io::VoronoiItem>(shapes->file, weights_of(shapes->file), common.threads,
                                    compute_one, skips(arguments.input, left_out));
  if (!computed) return std::move(computed).error();
  note_left_out(left_out, arguments.input, common);
  Diagrams out{std::move(computed).value(), std::move(shapes->phases)};
  out.phases.end("voronoi");
  return out;
}

Result<int> finish_voronoi(const Diagrams& diagrams, const VoronoiArguments& arguments) {
  const auto& [file, phases] = diagrams;
  std::uint64_t segments = 0, vertices = 0, edges = 0, spokes = 0, points = 0;
  for (const io::VoronoiItem& item : file.items) {
    const VoronoiDiagram& diagram = item.diagram;
    for (const Site& site : diagram.sites)
      ++(site.kind() == SiteKind::vertex ? vertices : segments);
    edges += diagram.edges.size();
    for (const VoronoiEdge& edge : diagram.edges) spokes += edge.spoke ? 1 : 0;
    for (const Node& node : diagram.nodes) points += node.disk.radius > 0 ? 1 : 0;
  }
  const bool lee = arguments.method == "lee";
  const std::string& input = arguments.input.path;
  return finish(
      arguments,
      {{"input", input},
       {"unit", name_of(file.unit)},
       {"features", file.items.size()},
       {"segments", segments},
       {lee ? "reflex_vertices" : "points", vertices},
       {"edges", edges},
       {"spokes", spokes},
       {"voronoi_points", points},
       {"seconds", phases.seconds("voronoi")}},
      phases,
      fmt::format(
          "{}: {}, {}, {}; {} ({}), {}", input, counted(file.items.size(), "feature"),
          counted(segments, "segment"),
          lee ? counted(vertices, "reflex vertex", "reflex vertices") : counted(vertices, "point"),
          counted(edges, "edge"), counted(spokes, "spoke"), counted(points, "Voronoi point")));
}

Result<int> run_voronoi(const VoronoiArguments& arguments) {
  const bool by_lee = arguments.method == "lee";
  const bool enclosed = !arguments.enclosure.empty() || arguments.margin > 0;
  if (arguments.nearest.any()) {
    if (by_lee || enclosed)
      return invalid_option(
          "--nearest and --queries search the whole plane: they take neither an enclosure nor "
          "--method lee");
    return run_nearest(arguments, arguments.nearest);
  }
  Status writable = check_output(arguments, io::formats_of(io::DocumentKind::voronoi));
  if (!writable) return std::move(writable).error();
  if (by_lee && enclosed) return invalid_option("the method lee takes no enclosure");
  auto diagrams = by_lee ? compute_by_lee(arguments) : compute_together(arguments);
  if (!diagrams) return std::move(diagrams).error();
  Status written =
      write_output(arguments, diagrams->phases, [&](const auto& path, const auto& format) {
        return io::write_voronoi(path, format, diagrams->file, write_options(arguments));
      });
  if (!written) return std::move(written).error();
  return finish_voronoi(*diagrams, arguments);
}

}  // namespace

Command make_voronoi_command(CLI::App& program) {
  auto arguments = std::make_shared<VoronoiArguments>();
  CLI::App* command = program.add_subcommand(
      "voronoi", "Compute the Voronoi diagram of points, lines, curves and polygons.");
  add_input_options(*command, arguments->input);
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::voronoi));
  command
      ->add_option("--method", arguments->method,
                   "The method: disks (default), for everything in the file together, within an\n"
                   "enclosure; or lee, inside each polygon.")
      ->check(CLI::IsMember({"disks", "lee"}))
      ->option_text("NAME");
  add_value(*command, "--margin", arguments->margin, "M", a_positive_number(),
            "The distance from the input's bounding box to the enclosure, in units of the\n"
            "input (default: half of the box's longer side).");
  add_list_option(
      *command, "--enclosure,--frame", 4,
      [arguments](const std::vector<double>& box) { arguments->enclosure = box; },
      "The enclosure itself: min x, min y, max x, max y, in units of the input. It must\n"
      "contain the input.")
      ->excludes("--margin")
      ->option_text("X,Y,X,Y");
  add_nearest_options(*command, arguments->nearest);
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "Every point, and every segment and arc without its ends, has a face: the points\n"
      "nearer to it than to all others, bounded by exact curves and by the enclosure. Edges\n"
      "may meet at ends; --repair splits edges that cross. In plain text, blocks\n"
      "between blank lines are chains, and a single block is a list of points.\n"
      "\n"
      "With --method lee, polygons without arcs: every segment and every reflex vertex has a\n"
      "face inside.\n"
      "\n"
      ".json holds the graph without loss, .geojson the faces as polygons and the edges\n"
      "as lines, .wkt the faces, .csv the edges. Pictures show the faces in colours.\n"
      "\n"
      "Examples:\n"
      "  medial voronoi wells.csv -o wells.geojson\n"
      "  medial voronoi roads.gpkg --margin 500 --repair -o nearest.geojson\n"
      "  medial voronoi room.wkt --method lee -o room.svg\n"
      "  medial voronoi roads.gpkg --queries houses.csv -o nearest-road.csv\n"
      "  medial voronoi parcels.geojson --where \"area > 100\" -o faces.geojson\n"
      "  medial voronoi plan.wkt -o - --format json | jq '.items[0].edges | length'");
  return command_of(command, arguments, run_voronoi);
}

}  // namespace medial::cli
