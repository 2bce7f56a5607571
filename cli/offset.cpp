// medial offset: offset curves, inwards and outwards.

#include "medial/offset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "cli/common.h"
#include "cli/costs.h"
#include "cli/loose.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "cli/verbs.h"
#include "medial/io/offsets.h"
#include "medial/voronoi.h"

namespace medial::cli {
namespace {

struct OffsetSwitches {
  InputSwitches input;
  CommonSwitches common;
  std::string output;
  std::string format;
  io::WriteOptions write;
  std::vector<double> distances;
  double step = 0;   ///< 0: no passes
  double first = 0;  ///< of the passes; 0: the step
  std::string until = "empty";
  double last = std::numeric_limits<double>::infinity();  ///< of the passes, as `until` tells
  bool exterior = false;
  bool loose = false;
  bool chords = false;
};

/// The passes step, 2 step, ... of one shape: as clearances, inside until nothing is left.
Result<Offsets> offset_one(const Shape& shape, const OffsetSwitches& switches,
                           const Options& options) {
  std::vector<double> clearances;
  for (const double d : switches.distances) clearances.push_back(switches.exterior ? -d : d);
  if (switches.step == 0) return offset_curves(shape, clearances, options);
  const double first = switches.first > 0 ? switches.first : switches.step;
  if (!std::isfinite(switches.last)) {
    auto axis = compute(shape, options);
    if (!axis) return std::move(axis).error();
    auto passes = offset_passes(*axis, first, switches.step);
    if (!passes) return std::move(passes).error();
    return inward_offsets(*axis, *passes);
  }
  constexpr double most = 1e6;
  if ((switches.last - first) / switches.step > most)
    return Error{ErrorCode::too_large, "more than 1e6 passes: the step is too small", {}};
  for (int k = 0; first + k * switches.step <= switches.last; ++k)
    clearances.push_back((switches.exterior ? -1 : 1) * (first + k * switches.step));
  return offset_curves(shape, clearances, options);
}

Status tell(const io::OffsetFile& file, const OffsetSwitches& switches, double seconds) {
  std::uint64_t regions = 0, rings = 0, edges = 0;
  double seconds_axis = 0, seconds_curves = 0, total = 0;
  for (const io::OffsetItem& item : file.items) {
    seconds_axis += item.offsets.seconds_axis;
    seconds_curves += item.offsets.seconds_curves;
    regions += item.offsets.regions.size();
    for (const OffsetRegion& region : item.offsets.regions) {
      rings += region.rings.size();
      total += length(region);
      for (const Ring& ring : region.rings) edges += ring.points.size();
    }
  }
  const Json object{{"input", switches.input.path},
                    {"features", file.items.size()},
                    {"regions", regions},
                    {"rings", rings},
                    {"edges", edges},
                    {"length", total}};
  const Json costs{
      {"seconds", {{"axis", seconds_axis}, {"curves", seconds_curves}, {"all", seconds}}},
      {"peak_bytes", peak_bytes()}};
  const std::string line =
      fmt::format("{}: {}, {}, {} of {}, length {:.6g}; {:.3g} s\n", switches.input.path,
                  counted(file.items.size(), "feature"), counted(regions, "region"),
                  counted(rings, "ring"), counted(edges, "edge"), total, seconds);
  return tell(switches.common, switches.output, object, costs, line);
}

/// Keeps of a region's attributes those that more features of it have as well.
void keep_common(io::BufferSource& of, const io::BufferSource& more) {
  if (of.features.empty())
    of.attributes = more.attributes;
  else
    std::erase_if(of.attributes, [&](const auto& own) {
      return std::ranges::find(more.attributes, own) == more.attributes.end();
    });
  of.features.insert(of.features.end(), more.features.begin(), more.features.end());
}

/// The features in each region of buffers. A chain lies in one region as a whole: where its first
/// point does, or what that point touches and has become part of. O(n log n) expected.
std::vector<io::BufferSource> sources_of(const LooseFile& file, const Soup& soup,
                                         const Offsets& offsets) {
  const SiteLocator locator(sites_of(soup));
  std::vector<io::BufferSource> sources(offsets.regions.size());
  for (std::size_t i = 0; i < file.chains.size(); ++i) {
    if (file.chains[i].points.empty()) continue;
    const std::size_t site = locator.nearest(file.chains[i].points.front()).site;
    const std::size_t count = soup.points.size();
    const std::size_t point = site < count ? site : soup.edges[site - count].from;
    const std::uint32_t region = offsets.region_of_point[point], feature = file.feature[i];
    if (region != no_region) keep_common(sources[region], {{feature}, file.attributes[feature]});
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
Result<io::OffsetFile> buffer_all(const OffsetSwitches& switches) {
  const auto& input = switches.input;
  auto loose = load_chains(input, switches.common.threads);
  if (!loose) return std::move(loose).error();
  print_notes(*loose, input, switches.common);
  Soup soup;
  auto offsets = with_soup(*loose, input, switches.common, soup, [&] {
    return offset_curves(
        soup, switches.distances,
        {.tolerance = switches.common.tolerance, .threads = switches.common.threads});
  });
  if (!offsets) return std::move(offsets).error();
  io::OffsetFile file;
  file.crs_wkt = loose->crs_wkt;
  file.y_down = loose->y_down;
  auto sources = sources_of(*loose, soup, *offsets);
  file.items.push_back({{}, std::move(offsets).value(), {}, std::move(soup), std::move(sources)});
  return file;
}

/// The offset curves of each shape of the file.
Result<io::OffsetFile> offset_each(const OffsetSwitches& switches) {
  const auto& input = switches.input;
  const auto& common = switches.common;
  auto shapes = load_shapes(input, common.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, input, common);
  io::OffsetFile file;
  file.crs_wkt = shapes->crs_wkt;
  file.y_down = shapes->y_down;
  file.items.resize(shapes->shapes.size());
  Status computed = for_each_shape(
      shapes->shapes, input.path, common, [&](std::size_t i, const Options& options) -> Status {
        auto offsets = offset_one(shapes->shapes[i], switches, options);
        if (!offsets) return std::move(offsets).error();
        file.items[i] = {std::move(shapes->shapes[i]), std::move(offsets).value(),
                         std::move(shapes->attributes[i])};
        return success();
      });
  if (!computed) return std::move(computed).error();
  return file;
}

Result<int> run_offset(const OffsetSwitches& switches) {
  const auto& input = switches.input;
  const auto& common = switches.common;
  if (switches.distances.empty() == (switches.step == 0))
    return invalid_option("give --distance or --step, one of the two");
  if (switches.exterior && switches.step > 0 && !std::isfinite(switches.last))
    return invalid_option("outwards nothing gets empty: give a distance to --until");
  if (switches.loose && (switches.step > 0 || switches.exterior))
    return invalid_option("--loose goes with --distance only");
  Status writable = check_output(switches.output, switches.format, io::known_offset_formats(),
                                 input.path, common.json);
  if (!writable) return std::move(writable).error();
  const Stopwatch watch;
  auto computed = switches.loose ? buffer_all(switches) : offset_each(switches);
  if (!computed) return std::move(computed).error();
  const io::OffsetFile file = std::move(computed).value();
  const double seconds = watch.seconds();
  if (!switches.output.empty()) {
    io::WriteOptions write = switches.write;
    write.chord = common.chord;
    const Activity shown("writing", switches.output);
    Status written =
        io::write_offsets(switches.output, switches.format, file, write, switches.chords);
    if (!written) return std::move(written).error();
  }
  Status told = tell(file, switches, seconds);
  if (!told) return std::move(told).error();
  return exit_success;
}

}  // namespace

Verb make_offset_verb(CLI::App& program) {
  auto switches = std::make_shared<OffsetSwitches>();
  CLI::App* verb = program.add_subcommand(
      "offset", "Compute offset curves, inwards and outwards, with true arcs.");
  add_input_switches(*verb, switches->input);
  add_list_switch(
      *verb, "--distance", 0,
      [switches](const std::vector<double>& distances) { switches->distances = distances; },
      "Distances from the boundary, in units of the input: inside of the shape\n"
      "where they are positive, outside where they are negative.")
      ->option_text("D[,D...]");
  verb->add_option("--step", switches->step,
                   "Instead: nested passes, one every S units of the input, from --first on.")
      ->check(a_positive_number())
      ->option_text("S");
  verb->add_option("--first", switches->first, "The first pass (default: S).")
      ->check(a_positive_number())
      ->option_text("D");
  verb->add_option("--until", switches->until,
                   "The last pass: empty (default), when nothing is left inside; or a distance.")
      ->each([switches](const std::string& text) {
        if (text == "empty") return;
        if (!CLI::detail::lexical_cast(text, switches->last) || !(switches->last > 0))
          throw CLI::ValidationError("--until", text + " is neither empty nor a distance");
      })
      ->option_text("D");
  verb->add_flag("--exterior", switches->exterior,
                 "Positive distances are outside, around the shape and in its holes.");
  verb->add_flag("--loose", switches->loose,
                 "Buffers: all places within each distance of the file's points, lines and\n"
                 "boundaries, taken together; --repair splits them where they cross.");
  add_output_switches(*verb, switches->output, switches->format, io::known_offset_formats());
  verb->add_flag("--chords", switches->chords,
                 "Well-known text: polygons of chords (see --chord) instead of exact arcs.");
  add_width_switch(*verb, switches->write.width);
  add_common_switches(*verb, switches->common);
  verb->footer(
      "A region is a connected part of all points farther than D from the boundary\n"
      "(inside), or of the shape grown by D (outside): an outer ring, then its holes. Rings\n"
      "are lines and arcs; all distances are found in one walk along the axis. Regions of\n"
      "successive distances nest: .json and .geojson tell each one's parent. .dxf has\n"
      "closed polylines with bulges, a layer for each distance; .wkt exact circular\n"
      "strings; .geojson chords. Buffers (--loose) tell in .json and .geojson which features\n"
      "are in each region, and those attributes on which all of them agree.\n"
      "\n"
      "Examples:\n"
      "  medial offset plan.wkt --distance 0.5,1,2 -o plan.svg\n"
      "  medial offset plate.dxf --distance=-3 -o grown.dxf\n"
      "  medial offset plate.dxf --step 2 --first 1 --until empty -o passes.dxf\n"
      "  medial offset plan.wkt --distance 1 -o - --format wkt\n"
      "  medial offset roads.geojson --loose --distance 5,10 -o buffers.geojson");
  return {verb, [switches] { return run_offset(*switches); }};
}

}  // namespace medial::cli
