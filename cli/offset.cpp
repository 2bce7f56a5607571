// medial offset: offset curves, inwards and outwards.

#include "medial/offset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/io/write.h"
#include "medial/voronoi.h"

namespace medial::cli {
namespace {

struct OffsetArguments : FileArguments {
  std::vector<double> distances;
  double step = 0;   ///< 0: no passes
  double first = 0;  ///< of the passes; 0: the step
  std::string until = "empty";
  double last = std::numeric_limits<double>::infinity();  ///< of the passes, by `until`
  bool exterior = false;
  bool loose = false;
};

/// The clearances of passes of one shape at each step, inside until nothing is left.
Result<Offsets> offset_one(const Shape& shape, const OffsetArguments& arguments,
                           const Options& options) {
  std::vector<double> clearances;
  for (const double d : arguments.distances) clearances.push_back(arguments.exterior ? -d : d);
  if (arguments.step == 0) return offset_curves(shape, clearances, options);
  const double first = arguments.first > 0 ? arguments.first : arguments.step;
  if (!std::isfinite(arguments.last)) {
    auto axis = compute(shape, options);
    if (!axis) return std::move(axis).error();
    auto passes = offset_passes(*axis, first, arguments.step);
    if (!passes) return std::move(passes).error();
    return inward_offsets(*axis, *passes);
  }
  constexpr double most = 1e6;
  if ((arguments.last - first) / arguments.step > most)
    return Error{ErrorCode::too_large, "more than 1e6 passes: the step is too small", {}};
  for (int k = 0; first + k * arguments.step <= arguments.last; ++k)
    clearances.push_back((arguments.exterior ? -1 : 1) * (first + k * arguments.step));
  return offset_curves(shape, clearances, options);
}

/// Sums over all features.
struct OffsetSums {
  std::uint64_t features = 0, regions = 0, rings = 0, edges = 0;
  double length = 0, seconds_axis = 0, seconds_curves = 0;
  Unit unit = Unit::unknown;

  void add(const Document<io::OffsetItem>& file) {
    unit = file.unit;
    features += file.items.size();
    for (const io::OffsetItem& item : file.items) {
      seconds_axis += item.offsets.seconds_axis;
      seconds_curves += item.offsets.seconds_curves;
      regions += item.offsets.regions.size();
      for (const OffsetRegion& region : item.offsets.regions) {
        rings += region.rings.size();
        length += medial::length(region);
        for (const Ring& ring : region.rings) edges += ring.points.size();
      }
    }
  }
};

Result<int> finish_offsets(const OffsetSums& sums, const OffsetArguments& arguments,
                           const Phases& phases) {
  const std::string& input = arguments.input.path;
  if (sums.features > 0 && sums.regions == 0 && !arguments.common.quiet)
    say("medial: {}: note: the result is empty: no shape is wide enough for that distance\n",
        input);
  const Json seconds = {{"axis", sums.seconds_axis},
                        {"curves", sums.seconds_curves},
                        {"all", phases.seconds("offset") + phases.seconds("stream")},
                        {"write", phases.seconds("write")}};
  return finish(arguments,
                {{"input", input},
                 {"unit", name_of(sums.unit)},
                 {"features", sums.features},
                 {"regions", sums.regions},
                 {"rings", sums.rings},
                 {"edges", sums.edges},
                 {"length", sums.length}},
                phases,
                fmt::format("{}: {}, {}, {} of {}, length {:.6g}", input,
                            counted(sums.features, "feature"), counted(sums.regions, "region"),
                            counted(sums.rings, "ring"), counted(sums.edges, "edge"), sums.length),
                {{"seconds", seconds}});
}

/// Keeps only the attributes of a region that another of its features has, too.
void keep_common(io::BufferSource& of, const io::BufferSource& more) {
  if (of.features.empty())
    of.attributes = more.attributes;
  else
    std::erase_if(of.attributes, [&](const auto& own) {
      return std::ranges::find(more.attributes, own) == more.attributes.end();
    });
  of.features.insert(of.features.end(), more.features.begin(), more.features.end());
}

/// The features in each region of buffers. A chain is in one region: the region of its first point,
/// or of the piece that this point touches and was merged into. O(n log n) expected.
std::vector<io::BufferSource> sources_of(const LoosePieces& file, const PlanarGraph& planar_graph,
                                         const Offsets& offsets) {
  const SiteLocator locator(sites_of(planar_graph));
  std::vector<io::BufferSource> sources(offsets.regions.size());
  for (std::size_t i = 0; i < file.chains.size(); ++i) {
    if (file.chains[i].points.empty()) continue;
    const std::size_t site = locator.nearest(file.chains[i].points.front()).site;
    const std::size_t count = planar_graph.points.size();
    const std::size_t point = site < count ? site : planar_graph.edges[site - count].from;
    const std::uint32_t region = offsets.region_of_point[point], feature = file.feature[i];
    if (region != no_region)
      keep_common(sources[region], {{static_cast<std::uint32_t>(file.features.index_of(feature))},
                                    file.features.items[feature]});
  }
  // Parents come before their children.
  for (std::size_t region = sources.size(); region-- > 0;) {
    auto& features = sources[region].features;
    std::ranges::sort(features);
    features.erase(std::unique(features.begin(), features.end()), features.end());
    const std::uint32_t parent = offsets.regions[region].parent;
    if (parent != no_region && !features.empty()) keep_common(sources[parent], sources[region]);
  }
  return sources;
}

/// Buffers of all points and lines of the file together.
Result<Document<io::OffsetItem>> buffer_all(const OffsetArguments& arguments) {
  const CommonOptions& common = arguments.common;
  auto pieces = load_loose(arguments.input, common);
  if (!pieces) return std::move(pieces).error();
  io::OffsetItem item;
  Status computed = with_planar_graph(*pieces, arguments, [&](PlanarGraph& graph) -> Status {
    auto offsets = offset_curves(graph, arguments.distances,
                                 {.tolerance = common.tolerance, .threads = common.threads});
    if (!offsets) return std::move(offsets).error();
    item.offsets = std::move(offsets).value();
    item.planar_graph = std::move(graph);
    return success();
  });
  if (!computed) return std::move(computed).error();
  item.sources = sources_of(*pieces, item.planar_graph, item.offsets);
  Document<io::OffsetItem> file{pieces->features, {}};
  file.indices.clear();  // the buffer is that of all features
  file.items.push_back(std::move(item));
  return file;
}

/// The offset curves of each shape.
Result<Document<io::OffsetItem>> offset_each(Document<ShapeItem> shapes, int threads,
                                             const OffsetArguments& arguments,
                                             std::vector<std::string>& left_out) {
  const auto offset_item = [&](std::size_t i, int own_threads) -> Result<io::OffsetItem> {
    ShapeItem& item = shapes.items[i];
    auto offsets = offset_one(item.shape, arguments,
                              engine_options(arguments.common, own_threads, shapes.corner_angle));
    if (!offsets) return std::move(offsets).error();
    return io::OffsetItem{std::move(item.shape), std::move(offsets).value(),
                          std::move(item.attributes)};
  };
  return map_features<io::OffsetItem>(shapes, weights_of(shapes), threads, offset_item,
                                      skips(arguments.input, left_out));
}

Result<Document<io::OffsetItem>> offset_file(const OffsetArguments& arguments) {
  if (arguments.loose) return buffer_all(arguments);
  auto shapes = load_shapes(arguments.input, arguments.common);
  if (!shapes) return std::move(shapes).error();
  std::vector<std::string> left_out;
  auto file = offset_each(std::move(shapes->file), arguments.common.threads, arguments, left_out);
  note_left_out(left_out, arguments.input, arguments.common);
  return file;
}

/// The same for a file of many features, part by part; nothing if the file cannot be streamed.
Result<std::optional<int>> stream_offsets(const OffsetArguments& arguments) {
  if (arguments.loose) return std::optional<int>();
  OffsetSums sums;
  io::StreamOptions how;
  how.none = Document<io::OffsetItem>();
  how.compute = [&](Document<ShapeItem> shapes, int threads,
                    AxesReport& report) -> Result<io::StreamItems> {
    auto file = offset_each(std::move(shapes), threads, arguments, report.left_out);
    if (!file) return std::move(file).error();
    return io::StreamItems(std::move(*file));
  };
  how.visit = [&](const io::StreamItems& part) {
    sums.add(std::get<Document<io::OffsetItem>>(part));
  };
  const auto done = stream(arguments, arguments.input, std::move(how));
  if (!done) return done.error();
  if (!*done) return std::optional<int>();
  auto status = finish_offsets(sums, arguments, (*done)->phases);
  return status ? Result<std::optional<int>>(*status) : std::move(status).error();
}

Result<int> run_offset(const OffsetArguments& arguments) {
  if (arguments.distances.empty() == (arguments.step == 0))
    return invalid_option("give either --distance or --step");
  if (arguments.exterior && arguments.step > 0 && !std::isfinite(arguments.last))
    return invalid_option("outward passes never end: --until needs a distance");
  if (arguments.loose && (arguments.step > 0 || arguments.exterior))
    return invalid_option("--loose needs --distance, not --step");
  if (arguments.write.chords && !writes_one_of(arguments, "wkt"))
    return invalid_option(
        "--chords is for well-known text: other formats have arcs, or chords only");
  Status writable = check_output(arguments, io::formats_of(io::DocumentKind::offsets));
  if (!writable) return std::move(writable).error();
  const auto streamed = stream_offsets(arguments);
  if (!streamed) return streamed.error();
  if (*streamed) return **streamed;
  Phases phases;
  const auto file = offset_file(arguments);
  if (!file) return file.error();
  phases.end("offset");
  Status written = write_output(arguments, phases, [&](const auto& path, const auto& format) {
    return io::write_offsets(path, format, *file, write_options(arguments));
  });
  if (!written) return std::move(written).error();
  OffsetSums sums;
  sums.add(*file);
  return finish_offsets(sums, arguments, phases);
}

}  // namespace

Command make_offset_command(CLI::App& program) {
  auto arguments = std::make_shared<OffsetArguments>();
  CLI::App* command = program.add_subcommand(
      "offset", "Compute offset curves, inwards and outwards, with true arcs.");
  add_input_options(*command, arguments->input);
  add_list_option(
      *command, "--distance", 0,
      [arguments](const std::vector<double>& distances) { arguments->distances = distances; },
      "Distances from the boundary, in units of the input: positive inside the\n"
      "shape, negative outside.")
      ->option_text("D[,D...]");
  add_value(*command, "--step", arguments->step, "S", a_positive_number(),
            "Instead: nested passes, one every S units of the input, starting at --first.");
  add_value(*command, "--first", arguments->first, "D", a_positive_number(),
            "The first pass (default: S).");
  command
      ->add_option("--until", arguments->until,
                   "The last pass: empty (default), when nothing is left inside; or a distance.")
      ->each([arguments](const std::string& text) {
        if (text == "empty") return;
        if (!CLI::detail::lexical_cast(text, arguments->last) || !(arguments->last > 0))
          throw CLI::ValidationError("--until", text + " is neither empty nor a distance");
      })
      ->option_text("D");
  command->add_flag("--exterior", arguments->exterior,
                    "Positive distances are outside: around the shape and in its holes.");
  command->add_flag("--loose", arguments->loose,
                    "Buffers: all points within each distance of the file's points, lines and\n"
                    "boundaries together; --repair splits these where they cross.");
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::offsets));
  command->add_flag("--chords", arguments->write.chords,
                    "Well-known text: polygons of chords (see --chord) instead of exact arcs.");
  add_width_option(*command, arguments->write.width);
  add_common_options(*command, arguments->common);
  command->footer(
      "A region is a connected part of all points farther than D from the boundary\n"
      "(inside), or of the shape grown by D (outside): an outer ring, then its holes. Rings\n"
      "are lines and arcs; one walk along the axis finds all distances. Regions of\n"
      "successive distances nest: .json and .geojson name each one's parent. .dxf has\n"
      "closed polylines with bulges, one layer per distance; .wkt exact circular strings;\n"
      ".geojson chords. For buffers (--loose), .json and .geojson list the features in each\n"
      "region, and the attributes that all of them share.\n"
      "\n"
      "Examples:\n"
      "  medial offset plan.wkt --distance 0.5,1,2 -o plan.svg\n"
      "  medial offset plate.dxf --distance=-3 -o grown.dxf\n"
      "  medial offset plate.dxf --step 2 --first 1 --until empty -o passes.dxf\n"
      "  medial offset plan.wkt --distance 1 -o - --format wkt\n"
      "  medial offset roads.geojson --loose --distance 5,10 -o buffers.geojson");
  return command_of(command, arguments, run_offset);
}

}  // namespace medial::cli
