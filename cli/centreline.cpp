// medial centreline: the main paths, widest paths or wide parts of shapes.

#include "medial/centreline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/lines.h"
#include "cli/pipeline.h"
#include "medial/io/write.h"
#include "medial/prune.h"
#include "medial/query.h"

namespace medial::cli {
namespace {

struct CentrelineArguments : FileArguments {
  PathOptions path;
  CentreLineOptions line;
  bool all = false;  ///< the whole network
  bool keep_loops = false;
  double clearance = 0;
  double collapse = 0;  ///< a width
  Options options;      ///< of the axis
};

constexpr char collapse_formats[] = ".json .geojson .gpkg .wkt .svg .pdf .png .ps";

constexpr double infinity = std::numeric_limits<double>::infinity();

using Paths = std::vector<std::vector<AxisPath>>;

/// The pieces of all paths of a shape, for functions that take O(shape) time per call.
AxisPath all_of(const std::vector<AxisPath>& paths) {
  AxisPath all;
  for (const AxisPath& path : paths)
    all.pieces.insert(all.pieces.end(), path.pieces.begin(), path.pieces.end());
  return all;
}

/// The smallest radius on an edge.
double narrowest_of(const MedialAxis& axis, Edge edge) {
  MedialAxis alone;
  alone.nodes = {axis.nodes[edge.node[0]], axis.nodes[edge.node[1]]};
  edge.node = {0, 1};
  alone.edges = {edge};
  const auto path = path_between(alone, {0, 0}, {0, 1});
  return path ? path->narrowest : infinity;
}

/// The branches of lines with their lengths and smallest radii, as paths without pieces.
std::vector<AxisPath> measured(const MedialAxis& lines) {
  std::vector<AxisPath> out;
  for (const Branch& branch : branches(lines)) {
    AxisPath& line = out.emplace_back();
    line.closed = branch.from == branch.to;
    line.narrowest = infinity;
    for (const Step& step : branch.steps) {
      line.length += length(lines, lines.edges[step.edge]);
      line.narrowest = std::min(line.narrowest, narrowest_of(lines, lines.edges[step.edge]));
    }
  }
  return out;
}

/// The smallest radius of a smoothed line between its extensions to the boundary, where radii
/// shrink to 0. `ends` are those of the path.
double narrowest_between(const MedialAxis& lines, const Branch& branch,
                         const std::array<Vec2, 2>& ends) {
  const auto disk = [&lines](std::uint32_t node) { return lines.nodes[node].disk; };
  const double before = distance(disk(branch.from).center, ends[0]);
  const double after = distance(disk(branch.to).center, ends[1]);
  double whole = 0, along = 0, narrowest = infinity;
  for (const Step& step : branch.steps) whole += length(lines, lines.edges[step.edge]);
  std::uint32_t node = branch.from;
  for (std::size_t i = 0;; ++i) {
    const bool closed = branch.from == branch.to;
    if (closed || (along >= before && whole - along >= after))
      narrowest = std::min(narrowest, disk(node).radius);
    if (i == branch.steps.size()) return narrowest;
    const Edge& edge = lines.edges[branch.steps[i].edge];
    node = edge.node[branch.steps[i].forward ? 1 : 0];
    along += length(lines, edge);
  }
}

/// The lengths of the lines along paths, with extensions, and their smallest radii, without
/// extensions; as paths without pieces.
std::vector<AxisPath> measured(const MedialAxis& lines, const MedialAxis& axis,
                               const std::vector<AxisPath>& paths,
                               const CentreLineOptions& options) {
  std::vector<AxisPath> out = paths;
  for (AxisPath& path : out) path.pieces.clear();
  const std::vector<Branch> found = branches(lines);
  if ((options.smooth == 0 && !options.extend) || found.size() != paths.size()) return out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].length = 0;
    for (const Step& step : found[i].steps) out[i].length += length(lines, lines.edges[step.edge]);
    if (options.smooth == 0) continue;
    const PathPiece first = paths[i].pieces.front(), last = paths[i].pieces.back();
    out[i].narrowest = narrowest_between(lines, found[i],
                                         {disk_at(axis, axis.edges[first.edge], first.from).center,
                                          disk_at(axis, axis.edges[last.edge], last.to).center});
  }
  return out;
}

/// Replaces the axes of a file by lines along the paths. Returns their lengths and smallest radii.
Result<Paths> make_lines(Document<AxisItem>& file, const Paths& paths,
                         const CentrelineArguments& arguments, int threads) {
  const auto make = [&](std::size_t i, int) -> Result<std::vector<AxisPath>> {
    AxisItem& item = file.items[i];
    item.part = true;
    if (arguments.keep_loops) {
      AxisPath whole = all_of(paths[i]);
      const std::vector<PathPiece> channels = side_channels(item.axis, whole);
      whole.pieces.insert(whole.pieces.end(), channels.begin(), channels.end());
      item.axis = part_of(item.axis, whole.pieces);
      return measured(item.axis);
    }
    MedialAxis lines = centre_lines(item.shape, item.axis, paths[i], arguments.line);
    std::vector<AxisPath> sizes = measured(lines, item.axis, paths[i], arguments.line);
    item.axis = std::move(lines);
    return sizes;
  };
  return map_items<std::vector<AxisPath>>(std::vector<double>(file.items.size(), 1.0), threads,
                                          make);
}

/// The axis without forks in corners: for a network, all of its paths, including cycles.
Result<MedialAxis> network_of(const MedialAxis& axis, double trim) {
  PruneOptions options;
  options.measure = PruneMeasure::significance;
  options.threshold = trim;
  return prune(axis, options);
}

Status make_networks(Document<AxisItem>& file, const CentrelineArguments& arguments, int threads) {
  return for_each_item(edge_weights_of(file), threads, [&](std::size_t i, int) -> Status {
    AxisItem& item = file.items[i];
    auto network = network_of(item.axis, arguments.path.path.trim);
    if (!network) return std::move(network).error();
    item.axis = std::move(network).value();
    item.part = true;
    return success();
  });
}

/// The lines of some features as they are written, and the lengths of paths that are not part of
/// the main paths.
struct LineSums {
  std::uint64_t features = 0, lines = 0;
  double length = 0, narrowest = infinity;
  double chosen = 0;         ///< length of the main paths alone
  double network = 0;        ///< length of the whole networks
  double channels = 0;       ///< of the paths around holes
  std::uint64_t points = 0;  ///< features without a line

  LineSums& operator+=(const LineSums& more) {
    features += more.features, lines += more.lines;
    length += more.length, narrowest = std::min(narrowest, more.narrowest);
    chosen += more.chosen, network += more.network, channels += more.channels;
    points += more.points;
    return *this;
  }
};

void add_sizes(const Paths& written, LineSums& sums) {
  for (const auto& of_item : written)
    for (const AxisPath& line : of_item) sums += {0, 1, line.length, line.narrowest};
}

/// Sums up the lengths of the paths, and of the network and channels outside them, for a note.
Result<LineSums> what_is_left_out(const Document<AxisItem>& file, const Paths& paths,
                                  const CentrelineArguments& arguments, int threads) {
  LineSums sums{paths.size()};
  if (arguments.common.quiet || arguments.path.between_places()) return sums;
  auto each = map_items<LineSums>(
      edge_weights_of(file), threads, [&](std::size_t i, int) -> Result<LineSums> {
        const MedialAxis& axis = file.items[i].axis;
        auto network = network_of(axis, arguments.path.path.trim);
        if (!network) return std::move(network).error();
        LineSums out;
        out.points = paths[i].empty() ? 1 : 0;
        for (const AxisPath& path : paths[i]) out.chosen += path.length;
        out.network = total_length(*network);
        for (const PathPiece& piece : side_channels(axis, all_of(paths[i])))
          out.channels += length(axis, axis.edges[piece.edge]);
        return out;
      });
  if (!each) return std::move(each).error();
  for (const LineSums& one : *each) sums += one;
  return sums;
}

/// Prints notes on features without a line, and on network edges and paths around holes outside the
/// main paths.
void note_what_is_left_out(const LineSums& sums, const CentrelineArguments& arguments) {
  const double whole = sums.network, channels = sums.channels, chosen = sums.chosen;
  constexpr double worth_a_note = 0.01;
  const bool kept = arguments.keep_loops;
  if (sums.points > 0)
    say("medial: {}: note: {} no line, as the axis is a single point, the centre of a disk\n",
        arguments.input.path, counted(sums.points, "feature has", "features have"));
  if (channels > worth_a_note * chosen)
    say("medial: {}: note: the main paths are {:.10g} long, the other paths around holes {:.10g}; "
        "{}\n",
        arguments.input.path, chosen, channels,
        kept ? "both are kept" : "--loops=keep keeps them, --all the whole network");
  else if (whole - chosen > worth_a_note * whole)
    say("medial: {}: note: the main paths are {:.10g} long, the whole network {:.10g}; --all keeps "
        "it\n",
        arguments.input.path, chosen, whole);
}

std::string describe(const LineSums& sums, const CentrelineArguments& arguments) {
  if (arguments.common.quiet) return {};
  std::string line =
      fmt::format("{}: {}, {}, length {:.10g}", arguments.input.path,
                  counted(sums.features, "feature"), counted(sums.lines, "line"), sums.length);
  if (sums.lines > 0) line += fmt::format(", smallest radius {:.10g}", sums.narrowest);
  return line;
}

Json json_of(const std::vector<AxisPath>& lines, std::uint64_t feature,
             const Attributes& attributes) {
  Json list = Json::array();
  for (const AxisPath& line : lines) {
    list.push_back({{"length", line.length},
                    {"narrowest_radius", line.narrowest},
                    {"closed", line.closed},
                    {"gap", line.gap}});
  }
  return {{"feature", feature}, {"lines", std::move(list)}, {"attributes", to_json(attributes)}};
}

Result<int> finish_lines(const Paths& lines, const LineSums& sums, const LoadedAxes& axes,
                         const CentrelineArguments& arguments) {
  Json object = {{"input", arguments.input.path}, {"unit", name_of(axes.file.unit)}};
  if (!arguments.output.empty()) object["output"] = arguments.output;
  object["features"] = Json::array();
  for (std::size_t i = 0; i < lines.size(); ++i)
    object["features"].push_back(
        json_of(lines[i], axes.file.index_of(i), axes.file.items[i].attributes));
  return finish(arguments, std::move(object), axes.phases, describe(sums, arguments));
}

/// The polygons of a shape, one per component, as rings of points; chords replace arcs.
void add_polygons(const Shape& shape, std::uint32_t feature, double chord, io::Layer& layer) {
  std::vector<io::LayerFeature> polygons(shape.component_count());
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    std::vector<Vec2> ring;
    for (std::uint32_t k = shape.loop_begin[i]; k < shape.loop_begin[i + 1]; ++k) {
      const Vec2 start = shape.points[k];
      const Vec2 end = shape.points[k + 1 < shape.loop_begin[i + 1] ? k + 1 : shape.loop_begin[i]];
      ring.push_back(start);
      const double bulge = shape.bulge(k);
      if (bulge == 0) continue;
      // A chord over an angle a departs by r (1 - cos(a / 2)) from its arc.
      const double angle = 4 * std::atan(bulge);
      const double radius = distance(start, end) / (2 * std::abs(std::sin(angle / 2)));
      const double step = 2 * std::acos(std::clamp(1 - chord / radius, 0.0, 1.0));
      const int pieces = static_cast<int>(std::clamp(std::ceil(std::abs(angle) / step), 1.0, 1e4));
      const Vec2 center =
          midpoint(start, end) + (1 / (2 * std::tan(angle / 2))) * left_of(end - start);
      for (int j = 1; j < pieces; ++j) {
        const double turn = angle * j / pieces;
        const Vec2 arm = start - center;
        ring.push_back(center + std::cos(turn) * arm + std::sin(turn) * left_of(arm));
      }
    }
    ring.push_back(ring.front());
    auto& parts = polygons[shape.component[i]].parts;
    parts.insert(shape.hole[i] ? parts.end() : parts.begin(), std::move(ring));
  }
  for (io::LayerFeature& polygon : polygons) {
    polygon.feature = feature;
    layer.features.push_back(std::move(polygon));
  }
}

/// The branches of lines, as lines with their lengths.
void add_lines(const MedialAxis& lines, std::uint32_t feature, double chord, io::Layer& layer) {
  for (const Branch& branch : branches(lines)) {
    std::vector<Vec2> points;
    double sum = 0, narrowest = infinity;
    for (const Step& step : branch.steps) {
      const Edge& edge = lines.edges[step.edge];
      std::vector<Disk> samples = sample_by_chord(lines, edge, chord);
      if (!step.forward) std::ranges::reverse(samples);
      for (std::size_t i = points.empty() ? 0 : 1; i < samples.size(); ++i) {
        points.push_back(samples[i].center);
        narrowest = std::min(narrowest, samples[i].radius);
      }
      sum += length(lines, edge);
    }
    layer.features.push_back({feature, {std::move(points)}, {sum, 2 * narrowest}});
  }
}

/// The collapsed shapes of a file.
struct Collapse {
  std::vector<CollapsedShape> shapes;
  Document<io::Layer> layers;  ///< polygons, lines
};

Result<Collapse> collapse_all(const Document<AxisItem>& file,
                              const CentrelineArguments& arguments) {
  Collapse out;
  auto shapes = map_items<CollapsedShape>(
      std::vector<double>(file.items.size(), 1.0), arguments.common.threads,
      [&](std::size_t i, int) {
        return collapse_narrow(file.items[i].axis, arguments.collapse, arguments.path.path.trim,
                               corner_angle(arguments.common, file.corner_angle));
      });
  if (!shapes) return std::move(shapes).error();
  out.shapes = std::move(shapes).value();
  out.layers = Document<io::Layer>{file, {}};
  out.layers.items = {{"polygons", io::LayerKind::polygons, {}, {}},
                      {"lines", io::LayerKind::lines, {"length", "width_min"}, {}}};
  for (std::uint32_t i = 0; i < out.shapes.size(); ++i) {
    const AxisItem& item = file.items[i];
    const double chord = arguments.common.chord * diagonal(bounding_box(item.shape));
    add_polygons(out.shapes[i].polygons, i, chord, out.layers.items[0]);
    add_lines(out.shapes[i].lines, i, chord, out.layers.items[1]);
  }
  return out;
}

Result<int> run_collapse(LoadedAxes axes, const CentrelineArguments& arguments) {
  auto collapse = collapse_all(axes.file, arguments);
  if (!collapse) return std::move(collapse).error();
  axes.phases.end("collapse");
  std::uint64_t polygons = 0;
  double sum_area = 0, sum_length = 0;
  for (const CollapsedShape& one : collapse->shapes) {
    polygons += one.polygons.component_count();
    sum_area += area(one.polygons);
    sum_length += total_length(one.lines);
  }
  const bool native = arguments.format == "json" || arguments.output.ends_with(".json");
  for (std::size_t i = 0; i < collapse->shapes.size(); ++i) {
    AxisItem& item = axes.file.items[i];
    item.axis = native ? std::move(collapse->shapes[i].lines) : MedialAxis{};
    if (native) item.shape = std::move(collapse->shapes[i].polygons);
  }
  Status written = write_output(arguments, axes.phases, [&](const auto& path, const auto& format) {
    const io::WriteOptions write = write_options(arguments);
    return native ? io::write_axes(path, format, axes.file, write)
                  : io::write_layers(path, format, collapse->layers, axes.file, write);
  });
  if (!written) return std::move(written).error();
  const std::size_t features = axes.file.items.size();
  const std::size_t lines = collapse->layers.items[1].features.size();
  const std::string line =
      fmt::format("{}: {}, {} of area {:.10g}, {} of length {:.10g}", arguments.input.path,
                  counted(features, "feature"), counted(polygons, "polygon"), sum_area,
                  counted(lines, "line"), sum_length);
  return finish(arguments,
                {{"input", arguments.input.path},
                 {"unit", name_of(axes.file.unit)},
                 {"features", features},
                 {"polygons", polygons},
                 {"area", sum_area},
                 {"lines", lines},
                 {"length", sum_length},
                 {"seconds", axes.phases.seconds("collapse")}},
                axes.phases, arguments.common.quiet ? std::string() : line);
}

/// Returns whether anything is left.
bool keep_clearance(Document<AxisItem>& file, double clearance) {
  bool any = false;
  for (AxisItem& item : file.items) {
    item.axis = clearance_part(item.axis, clearance);
    item.part = true;
    any = any || !item.axis.nodes.empty();
  }
  return any;
}

void note_if_empty(bool any, const CentrelineArguments& arguments) {
  if (any || arguments.common.quiet) return;
  say("medial: {}: note: the result is empty: no shape is wide enough for a disk of that radius\n",
      arguments.input.path);
}

/// The same for a file of many features, part by part; nothing if the file cannot be streamed.
Result<std::optional<int>> stream_centreline(const CentrelineArguments& arguments) {
  if (arguments.collapse > 0 || arguments.path.between_places() || arguments.common.json)
    return std::optional<int>();
  std::mutex adding;
  std::map<std::uint64_t, LineSums> parts;  // by their first features, so that sums are the same
  const auto sum = [&parts] {
    LineSums sums;
    for (const auto& [first, part] : parts) sums += part;
    return sums;
  };
  const auto line = [&] { return describe(sum(), arguments); };
  const bool lines = !arguments.all && arguments.clearance == 0;
  std::atomic<bool> any = arguments.clearance == 0;
  const auto change = [&](Document<AxisItem>& part) -> Status {
    if (arguments.clearance > 0 && keep_clearance(part, arguments.clearance)) any = true;
    if (arguments.all) return make_networks(part, arguments, 1);
    if (!lines) return success();
    const auto paths = choose_paths(part, arguments.path, 1);
    if (!paths) return paths.error();
    auto sums = what_is_left_out(part, *paths, arguments, 1);
    if (!sums) return std::move(sums).error();
    auto written = make_lines(part, *paths, arguments, 1);
    if (!written) return std::move(written).error();
    add_sizes(*written, *sums);
    const std::lock_guard<std::mutex> alone(adding);
    parts[part.index_of(0)] = *sums;
    return success();
  };
  auto done = stream_axes(arguments, arguments.input, arguments.options, change,
                          lines ? line : std::function<std::string()>());
  if (lines && done && *done) note_what_is_left_out(sum(), arguments);
  if (done && *done) note_if_empty(any, arguments);
  return done;
}

Result<int> run_centreline(const CentrelineArguments& arguments) {
  const auto& [input, common] = std::tie(arguments.input, arguments.common);
  Status writable =
      check_output(arguments, arguments.collapse > 0 ? collapse_formats
                                                     : io::formats_of(io::DocumentKind::axes));
  if (writable) writable = check_places(arguments.path, input);
  if (!writable) return std::move(writable).error();
  const auto streamed = stream_centreline(arguments);
  if (!streamed) return streamed.error();
  if (*streamed) return **streamed;
  auto shapes = load_shapes(input, common);
  if (!shapes) return std::move(shapes).error();
  auto axes = compute_axes(std::move(shapes).value(), input, common, arguments.options);
  if (!axes) return std::move(axes).error();
  if (arguments.collapse > 0) return run_collapse(std::move(axes).value(), arguments);
  if (arguments.clearance > 0) {
    note_if_empty(keep_clearance(axes->file, arguments.clearance), arguments);
    return finish_axes(*axes, arguments);
  }
  if (arguments.all) {
    Status networks = make_networks(axes->file, arguments, common.threads);
    if (!networks) return std::move(networks).error();
    axes->phases.end("lines");
    return finish_axes(*axes, arguments);
  }
  note_places(axes->file, arguments.path, arguments);
  auto paths = choose_paths(axes->file, arguments.path, common.threads);
  if (!paths) return std::move(paths).error();
  auto sums = what_is_left_out(axes->file, *paths, arguments, common.threads);
  if (!sums) return std::move(sums).error();
  note_what_is_left_out(*sums, arguments);
  const auto lines = make_lines(axes->file, *paths, arguments, common.threads);
  if (!lines) return lines.error();
  add_sizes(*lines, *sums);
  axes->phases.end("lines");
  Status written = write_output(arguments, axes->phases, [&](const auto& path, const auto& format) {
    return io::write_axes(path, format, axes->file, write_options(arguments));
  });
  if (!written) return std::move(written).error();
  return finish_lines(*lines, *sums, *axes, arguments);
}

/// Options of lines; returns --all.
CLI::Option* add_line_options(CLI::App& command, CentrelineArguments& arguments) {
  add_path_options(command, arguments.path);
  command.add_flag("--extend", arguments.line.extend, "Extend both ends to the boundary.");
  add_value(command, "--smooth", arguments.line.smooth, "RADII", in_range(0, 1000),
            "Average the line over this many mean radii (Gaussian weights). It\n"
            "stays inside the shape.");
  CLI::Option* all = command.add_flag(
      "--all", arguments.all,
      "Instead of a line: the whole network, with all paths around holes, but without\n"
      "forks in corners (see --trim).");
  for (const char* other : {"--from", "--to", "--widest", "--extend", "--smooth", "--route"})
    all->excludes(other);
  command
      .add_option_function<std::string>(
          "--loops",
          [&arguments](const std::string& what) { arguments.keep_loops = what == "keep"; },
          "Paths around holes that leave the line and return to it, such as a river's side\n"
          "channels (not its tributaries): keep, or drop (default).")
      ->check(CLI::IsMember({"keep", "drop"}))
      ->option_text("WHAT")
      ->excludes(all);
  for (const char* other : {"--extend", "--smooth"}) command.get_option("--loops")->excludes(other);
  return all;
}

}  // namespace

Command make_centreline_command(CLI::App& program) {
  auto arguments = std::make_shared<CentrelineArguments>();
  CLI::App* command = program.add_subcommand(
      "centreline", "Compute the centre lines of shapes, or the widest path between two places.");
  command->alias("centerline");
  add_input_options(*command, arguments->input);
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::axes));
  CLI::Option* all = add_line_options(*command, *arguments);
  CLI::Option* clearance =
      add_value(*command, "--clearance", arguments->clearance, "R", a_positive_number(),
                "Instead of a line: the whole axis where a disk of this radius fits.");
  CLI::Option* collapse =
      add_value(
          *command, "--collapse", arguments->collapse, "WIDTH", a_positive_number(),
          "Instead: collapse parts narrower than this to lines, and keep the rest as polygons;\n"
          "as layers, or as shapes with lines in .json. Formats:\n" +
              std::string(collapse_formats))
          ->excludes(clearance);
  clearance->excludes(all);
  collapse->excludes(all);
  for (CLI::Option* option : {clearance, collapse})
    for (const char* place : {"--from", "--to", "--widest", "--loops"}) option->excludes(place);
  add_exterior_options(*command, arguments->options,
                       "Lines of the exterior: around the shape, within a rectangle, and in holes.")
      ->excludes(collapse);
  add_simplify_option(*command, arguments->write);
  add_picture_options(*command, arguments->write);
  add_common_options(*command, arguments->common);
  command->footer(
      "The main path of a shape joins the two ends of its axis that are farthest apart,\n"
      "measured along the axis. Each part of a feature has one. The main path of a ring\n"
      "without dead ends is closed. Lines get the attributes of their features.\n"
      "\n"
      "Formats are those of `medial axis`: exact curves in .json, .dxf and .svg, lines\n"
      "with the radii of both ends in .geojson, .gpkg, .shp and .fgb, samples with radii in .csv.\n"
      "\n"
      "Examples:\n"
      "  medial centreline rivers.geojson --project --extend --smooth 1 -o lines.gpkg\n"
      "  medial centreline river.wkt --from 0/12 --to 0/873 -o line.svg\n"
      "  medial centreline plan.geojson --widest 2,3 40,12 -o way.csv\n"
      "  medial centreline roads.gpkg --all --simplify 0.5 -o network.gpkg\n"
      "  medial centreline amazon.wkt --loops keep -o channels.geojson\n"
      "  medial centreline plan.geojson --clearance 0.6 -o reachable.svg\n"
      "  medial centreline rivers.geojson --project --collapse 50 -o rivers.gpkg");
  return command_of(command, arguments, run_centreline);
}

}  // namespace medial::cli
