// medial measure: widths of shapes: profiles, transects, necks, means, largest disks.

#include "medial/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <mutex>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/lines.h"
#include "cli/pipeline.h"
#include "cli/plot.h"
#include "medial/document.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/query.h"

namespace medial::cli {
namespace {

constexpr std::uint64_t most_transects = 1'000'000;
constexpr std::uint64_t most_measured_disks = 10'000;
constexpr std::uint64_t default_samples = 200, default_transects = 50;
constexpr std::size_t default_necks = 5;

struct MeasureArguments : FileArguments {
  std::string plot;
  PathOptions path;
  std::uint64_t samples = 0;    ///< 0: default_samples
  std::uint64_t transects = 0;  ///< 0: none, or default_transects if the layers would be empty
  double spacing = 0;
  std::uint64_t necks = 0;
  double widening = 1.1;
  std::uint64_t disks = 0;
  Options options;
  std::vector<const CLI::Option*> of_widths;  ///< options that need a line, not only disks
};

/// A centre line and the widths along it.
struct Line {
  AxisPath path;
  std::vector<LocalWidth> profile, transects;
  std::vector<Neck> necks;  ///< of the line alone
};

/// The measurements of a feature.
struct Measured {
  std::vector<Line> lines;
  MeanWidth mean;
  Disk widest;
  std::vector<Neck> necks;
  std::vector<Disk> disks;
};

bool is_profile(const MeasureArguments& arguments) { return writes_one_of(arguments, "csv"); }
bool has_layers(const MeasureArguments& arguments) {
  return !arguments.output.empty() && !is_profile(arguments);
}

/// Whether no option needs an axis.
bool wants_disks_alone(const MeasureArguments& arguments) {
  return arguments.disks > 0 && !is_profile(arguments) &&
         std::none_of(arguments.of_widths.begin(), arguments.of_widths.end(),
                      [](const CLI::Option* option) { return option->count() > 0; });
}

/// `count` + 1 evenly spaced lengths from 0 to the whole.
std::vector<double> even_lengths(double whole, std::uint64_t count) {
  std::vector<double> at(count + 1);
  for (std::uint64_t i = 0; i <= count; ++i)
    at[i] = whole * static_cast<double>(i) / static_cast<double>(count);
  return at;
}

/// The middles of `count` equal parts, or multiples of a spacing, centred on the middle of the
/// line.
std::vector<double> transect_lengths(double whole, const MeasureArguments& arguments) {
  std::vector<double> at;
  if (arguments.spacing > 0) {
    const double count = std::floor(whole / arguments.spacing);
    const double first = 0.5 * (whole - count * arguments.spacing);
    for (double i = 0; i <= count; ++i) at.push_back(first + i * arguments.spacing);
  } else {
    for (std::uint64_t i = 0; i < arguments.transects; ++i)
      at.push_back(whole * (static_cast<double>(i) + 0.5) /
                   static_cast<double>(arguments.transects));
  }
  return at;
}

/// The length of an edge up to t.
double length_to(const MedialAxis& axis, const EdgePlace& place) {
  MedialAxis alone;
  Edge edge = axis.edges[place.edge];
  alone.nodes = {axis.nodes[edge.node[0]], axis.nodes[edge.node[1]]};
  edge.node = {0, 1};
  alone.edges = {edge};
  const std::vector<PathPiece> piece{{0, 0, place.t}};
  return place.t > 0 ? total_length(part_of(alone, piece)) : 0.0;
}

/// The necks of a line alone, with their lengths along it.
std::vector<Neck> necks_of(const MedialAxis& axis, const AxisPath& path, double widening) {
  const MedialAxis line = part_of(axis, path.pieces);
  std::vector<Neck> found = necks(line, widening);
  std::vector<double> before{0};
  for (const Edge& edge : line.edges) before.push_back(before.back() + length(line, edge));
  for (Neck& neck : found) neck.width.along = before[neck.place.edge] + length_to(line, neck.place);
  return found;
}

Result<Measured> measure(const AxisItem& item, const std::vector<AxisPath>& paths,
                         const MeasureArguments& arguments) {
  Measured out;
  AxisPath all;
  for (const AxisPath& path : paths) {
    if (arguments.spacing > 0 &&
        path.length / arguments.spacing > static_cast<double>(most_transects))
      return Error{
          ErrorCode::too_large,
          fmt::format("more than {} transects on a line: the spacing is too small", most_transects),
          {}};
    Line& line = out.lines.emplace_back();
    line.path = path;
    line.profile = widths_along(item.axis, path, even_lengths(path.length, arguments.samples));
    line.transects =
        transects_along(item.shape, item.axis, path, transect_lengths(path.length, arguments));
    line.necks = necks_of(item.axis, path, arguments.widening);
    all.pieces.insert(all.pieces.end(), path.pieces.begin(), path.pieces.end());
    all.length += path.length;
  }
  out.mean = mean_width(item.axis, all);
  if (!item.axis.nodes.empty()) out.widest = deepest_disk(item.axis);
  out.necks = necks(item.axis, arguments.widening);
  if (arguments.disks > 0) out.disks = largest_disjoint_disks(item.shape, arguments.disks);
  return out;
}

/// The disks of shapes whose axes are not computed.
Result<std::vector<Measured>> measure_disks(const Document<AxisItem>& file, int threads,
                                            const MeasureArguments& arguments) {
  std::vector<double> sizes;
  for (const AxisItem& item : file.items)
    sizes.push_back(static_cast<double>(item.shape.points.size()));
  return map_items<Measured>(sizes, threads, [&](std::size_t i, int) -> Result<Measured> {
    Measured out;
    out.disks = largest_disjoint_disks(file.items[i].shape, arguments.disks);
    return out;
  });
}

Document<AxisItem> without_axes(Document<ShapeItem> shapes) {
  Document<AxisItem> file{shapes, {}};
  for (ShapeItem& item : shapes.items)
    file.items.push_back({std::move(item.shape), {}, std::move(item.attributes)});
  return file;
}

/// The narrowest neck of a feature's lines, if they have one.
const Neck* narrowest_neck(const Measured& measured) {
  const Neck* narrowest = nullptr;
  for (const Line& line : measured.lines)
    for (const Neck& neck : line.necks)
      if (narrowest == nullptr || neck.width.disk.radius < narrowest->width.disk.radius)
        narrowest = &neck;
  return narrowest;
}

double narrowest_of(const Measured& measured) {
  double narrowest = std::numeric_limits<double>::infinity();
  for (const Line& line : measured.lines) narrowest = std::min(narrowest, 2 * line.path.narrowest);
  return narrowest;
}

Json point(Vec2 p) { return {{"x", p.x}, {"y", p.y}}; }

Json json_of(const Neck& neck, bool on_line) {
  Json object = {{"x", neck.width.disk.center.x},     {"y", neck.width.disk.center.y},
                 {"width", neck.width.width()},       {"opens_to", 2 * neck.opens_to},
                 {"left", point(neck.width.feet[0])}, {"right", point(neck.width.feet[1])}};
  object["around_hole"] = neck.around_hole;
  if (on_line) object["along"] = neck.width.along;
  return object;
}

Json json_of_disks(const Measured& measured) {
  Json disks = Json::array();
  for (const Disk& disk : measured.disks) disks.push_back(to_json(disk));
  return disks;
}

Json json_of(const Measured& measured, std::size_t necks_wanted) {
  Json lines = Json::array();
  for (const Line& line : measured.lines) {
    Json necks = Json::array();
    for (const Neck& neck : line.necks) necks.push_back(json_of(neck, true));
    lines.push_back({{"length", line.path.length},
                     {"narrowest_width", 2 * line.path.narrowest},
                     {"closed", line.path.closed},
                     {"necks", std::move(necks)}});
  }
  const MeanWidth& mean = measured.mean;
  const auto along = [&mean](double value) { return mean.length > 0 ? Json(value) : Json(); };
  Json object = {{"area", mean.area},
                 {"length", mean.length},
                 {"mean_width",
                  {{"by_length", along(mean.by_length)},
                   {"by_area", mean.by_area},
                   {"area_by_length", along(mean.area_by_length)}}},
                 {"widest", to_json(measured.widest)},
                 {"lines", std::move(lines)}};
  object["necks"] = Json::array();
  for (std::size_t i = 0; i < std::min(necks_wanted, measured.necks.size()); ++i)
    object["necks"].push_back(json_of(measured.necks[i], false));
  if (!measured.disks.empty()) object["disks"] = json_of_disks(measured);
  return object;
}

/// A coordinate to print: 0 if it is only a rounding error relative to the radius.
double shown(double x, double radius) { return std::abs(x) < 1e-10 * radius ? 0 : x; }
std::string place(const Disk& disk) {
  const auto [c, r] = std::pair(disk.center, disk.radius);
  return fmt::format("({:.10g}, {:.10g})", shown(c.x, r), shown(c.y, r));
}
std::string number(double value) { return fmt::format("{:.10g}", value); }

void add_disks(Rows& rows, const std::vector<Disk>& disks) {
  for (std::size_t i = 0; i < disks.size(); ++i)
    rows.add(i == 0 ? "largest disks" : "",
             fmt::format("r {:.10g} at {}", disks[i].radius, place(disks[i])));
}

/// One feature as lines of a name and a value.
std::string summary_of(const Measured& measured, const MeasureArguments& arguments, Unit unit) {
  Rows rows(24);
  if (unit != Unit::unknown) rows.add("unit", name_of(unit));
  if (wants_disks_alone(arguments)) {
    add_disks(rows, measured.disks);
    return rows.text();
  }
  const MeanWidth& mean = measured.mean;
  rows.add("area", number(mean.area));
  const std::size_t lines = measured.lines.size();
  rows.add("length", lines == 0   ? "- (no line)"
                     : lines == 1 ? number(mean.length)
                                  : fmt::format("{:.10g} ({} lines)", mean.length, lines));
  if (mean.length > 0) {
    rows.add("mean width by length", number(mean.by_length));
    rows.add("area / length", number(mean.area_by_length));
  }
  rows.add("mean width by area", number(mean.by_area));
  rows.add("widest",
           fmt::format("{:.10g} at {}", 2 * measured.widest.radius, place(measured.widest)));
  if (const Neck* neck = narrowest_neck(measured)) {
    rows.add("narrowest neck on line",
             fmt::format("{:.10g} at {}, {:.10g} from the start of the line", neck->width.width(),
                         place(neck->width.disk), neck->width.along));
  }
  const std::size_t shown = std::min<std::size_t>(
      arguments.necks > 0 ? arguments.necks : default_necks, measured.necks.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Neck& neck = measured.necks[i];
    rows.add(
        i == 0 ? "necks" : "",
        fmt::format("{:.10g} at {}, opens to {:.10g}{}", neck.width.width(), place(neck.width.disk),
                    2 * neck.opens_to, neck.around_hole ? ", around a hole" : ""));
  }
  add_disks(rows, measured.disks);
  return rows.text();
}

/// The name of a feature: its number, or its value in an image of labels.
std::string name_of_feature(const Document<AxisItem>& file, std::size_t i) {
  const Attributes& attributes = file.items[i].attributes;
  const bool label = file.pixel > 0 && attributes.size() == 1 && attributes[0].first == "value";
  return label ? attributes[0].second : fmt::format("{}", file.index_of(i));
}

/// Whether features are named by the values of an image of labels.
bool has_labels(const Document<AxisItem>& file) {
  return file.pixel > 0 && !file.items.empty() && !file.items[0].attributes.empty();
}

std::string table_head(bool labels, bool disks_alone) {
  if (disks_alone)
    return fmt::format("{:>7} {:>6} {:>12} {:>16} {:>16}\n", labels ? "value" : "feature", "rank",
                       "r", "x", "y");
  return fmt::format("{:>7} {:>12} {:>12} {:>12} {:>12} {:>12} {:>12} {:>12}\n",
                     labels ? "value" : "feature", "area", "length", "narrowest", "by length",
                     "by area", "widest", "neck");
}

/// A feature in one line, or in one for each disk.
std::string table_row(const Measured& one, const std::string& name, bool disks_alone) {
  if (disks_alone) {
    std::string rows;
    for (std::size_t k = 0; k < one.disks.size(); ++k) {
      const auto [c, r] = std::pair(one.disks[k].center, one.disks[k].radius);
      rows += fmt::format("{:>7} {:>6} {:>12.6g} {:>16.10g} {:>16.10g}\n", name, k, r,
                          shown(c.x, r), shown(c.y, r));
    }
    return rows;
  }
  const Neck* neck = narrowest_neck(one);
  const auto number = [](double value, bool known) {
    return known ? fmt::format("{:.6g}", value) : std::string("-");
  };
  const bool line = one.mean.length > 0;
  return fmt::format("{:>7} {:>12.6g} {:>12} {:>12} {:>12} {:>12.6g} {:>12.6g} {:>12}\n", name,
                     one.mean.area, number(one.mean.length, line), number(narrowest_of(one), line),
                     number(one.mean.by_length, line), one.mean.by_area, 2 * one.widest.radius,
                     number(neck == nullptr ? 0 : neck->width.width(), neck != nullptr));
}

std::string table_end(Unit unit) {
  return unit == Unit::unknown ? std::string() : fmt::format("{:>7} {}\n", "unit", name_of(unit));
}

/// Several features.
std::string summary_of(const std::vector<Measured>& all, const Document<AxisItem>& file,
                       bool disks_alone) {
  std::string text = table_head(has_labels(file), disks_alone);
  for (std::size_t i = 0; i < all.size(); ++i)
    text += table_row(all[i], name_of_feature(file, i), disks_alone);
  return text + table_end(file.unit);
}

std::vector<Plot> profile_plots(const std::vector<Measured>& all, const std::string& name,
                                const DocumentInfo& file) {
  const std::string in = file.unit == Unit::unknown ? "" : fmt::format(" [{}]", name_of(file.unit));
  constexpr std::size_t most_plots = 24;
  std::vector<Plot> plots;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Line& line : all[i].lines) {
      if (plots.size() == most_plots) return plots;
      Plot plot;
      plot.logarithmic = false;
      plot.title = all.size() > 1 ? fmt::format("feature {}", file.index_of(i)) : name;
      plot.x_label = "length along the centre line" + in;
      plot.y_label = "width" + in;
      Series width{"width", {}, false, false}, span{"foot to foot", {}, false, false};
      Series mean{"mean by length", {}, true, false};
      for (const LocalWidth& at : line.profile) {
        width.points.emplace_back(at.along, at.width());
        span.points.emplace_back(at.along, at.span());
      }
      mean.points = {{0, all[i].mean.by_length}, {line.path.length, all[i].mean.by_length}};
      Series necks{"necks", {}, false, true};
      necks.line = false;
      for (const Neck& neck : line.necks)
        necks.points.emplace_back(neck.width.along, neck.width.width());
      plot.series = {width, span, mean};
      if (!necks.points.empty()) plot.series.push_back(necks);
      plots.push_back(std::move(plot));
    }
  }
  return plots;
}

io::Layer profile_of(const std::vector<Measured>& all) {
  io::Layer profile{"profile", io::LayerKind::profile, {"line", "along", "width", "span"}, {}};
  for (std::uint32_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < all[i].lines.size(); ++k)
      for (const LocalWidth& at : all[i].lines[k].profile)
        profile.features.push_back({i,
                                    {{at.disk.center, at.feet[0], at.feet[1]}},
                                    {static_cast<double>(k), at.along, at.width(), at.span()}});
  return profile;
}

Document<io::Layer> layers_of(const Document<AxisItem>& file, const std::vector<Measured>& all,
                              const MeasureArguments& arguments) {
  Document<io::Layer> layers{file, {}};
  if (is_profile(arguments)) {
    layers.items.push_back(profile_of(all));
    return layers;
  }
  io::Layer transects{"transects", io::LayerKind::lines, {"line", "along", "width", "span"}, {}, 3};
  io::Layer necks{"necks", io::LayerKind::lines, {"width", "opens_to", "around_hole"}, {}, 0};
  io::Layer disks{"disks", io::LayerKind::disks, {"r", "rank"}, {}, 0};
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < all[i].lines.size(); ++k) {
      for (const LocalWidth& at : all[i].lines[k].transects) {
        transects.features.push_back({i,
                                      {{at.feet[0], at.feet[1]}},
                                      {static_cast<double>(k), at.along, at.width(), at.span()}});
      }
    }
    for (std::size_t k = 0; k < std::min<std::size_t>(arguments.necks, all[i].necks.size()); ++k) {
      const Neck& neck = all[i].necks[k];
      necks.features.push_back(
          {i,
           {{neck.width.feet[0], neck.width.feet[1]}},
           {neck.width.width(), 2 * neck.opens_to, neck.around_hole ? 1.0 : 0.0}});
    }
    for (std::size_t k = 0; k < all[i].disks.size(); ++k) {
      const Disk& disk = all[i].disks[k];
      disks.features.push_back({i, {{disk.center}}, {disk.radius, static_cast<double>(k)}});
    }
  }
  if (arguments.transects > 0 || arguments.spacing > 0)
    layers.items.push_back(std::move(transects));
  if (arguments.necks > 0) layers.items.push_back(std::move(necks));
  if (arguments.disks > 0) layers.items.push_back(std::move(disks));
  return layers;
}

Status write_measures(Document<AxisItem>& file, const std::vector<Measured>& all,
                      const MeasureArguments& arguments) {
  if (arguments.output.empty()) return success();
  const Document<io::Layer> layers = layers_of(file, all, arguments);
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<PathPiece> pieces;
    for (const Line& line : all[i].lines)
      pieces.insert(pieces.end(), line.path.pieces.begin(), line.path.pieces.end());
    file.items[i].axis = part_of(file.items[i].axis, pieces);
  }
  return io::write_layers(arguments.output, arguments.format, layers, file,
                          write_options(arguments));
}

Result<std::vector<Measured>> measure_all(const Document<AxisItem>& file, int threads,
                                          const MeasureArguments& arguments) {
  if (wants_disks_alone(arguments)) return measure_disks(file, threads, arguments);
  auto paths = choose_paths(file, arguments.path, threads);
  if (!paths) return std::move(paths).error();
  auto all = map_features<Measured>(
      file, std::vector<double>(paths->size(), 1.0), threads,
      [&](std::size_t i, int) { return measure(file.items[i], (*paths)[i], arguments); }, nullptr);
  if (!all) return std::move(all).error();
  return std::move(all->items);
}

/// Without an output file, the result is the table.
bool prints_table(const MeasureArguments& arguments) {
  return arguments.output != "-" &&
         (!arguments.common.quiet || (arguments.output.empty() && arguments.plot.empty()));
}

/// Refuses options for results that are neither written nor printed.
Status check_used(const MeasureArguments& arguments) {
  const bool table = prints_table(arguments) && !is_profile(arguments);
  if (arguments.samples > 0 && !is_profile(arguments) && arguments.plot.empty())
    return invalid_option("--samples is for width profiles: -o FILE.csv, or --plot");
  if (has_layers(arguments)) return success();
  if (arguments.transects > 0 || arguments.spacing > 0)
    return invalid_option(
        "--transects and --spacing are for layers and pictures: -o FILE.geojson, FILE.svg and "
        "others; a .csv has the width profile, with --samples");
  if ((arguments.necks > 0 || arguments.disks > 0) && !arguments.common.json && !table)
    return invalid_option(
        "--necks and --disks are for layers and pictures, -o FILE.geojson, FILE.svg and others, "
        "for --json and for the printed table");
  return success();
}

/// Refuses options whose results do not fit into the table of several features.
Status check_table(const MeasureArguments& arguments, std::uint64_t features) {
  const bool lists = arguments.necks > 0 || arguments.disks > 0;
  if (features <= 1 || !lists || has_layers(arguments) || arguments.common.json ||
      wants_disks_alone(arguments))
    return success();
  return invalid_option(fmt::format(
      "the table of {} features has no room for {}: use --json, or -o FILE.geojson, FILE.svg and "
      "others{}",
      features, arguments.necks > 0 ? "--necks" : "--disks with options of lines",
      arguments.disks > 0 ? "; --disks alone has a table of its own" : ""));
}

/// The table of a stream, kept in a temporary file until the end, so that an error prints nothing.
class LateTable {
 public:
  explicit LateTable(bool disks_alone) : disks_alone_(disks_alone) {}
  void add(const std::vector<Measured>& all, const Document<AxisItem>& file) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (features_++ == 0) first_ = all[i];
      put(table_row(all[i], name_of_feature(file, i), disks_alone_));
    }
  }
  Status print_all(const MeasureArguments& arguments, Unit unit) {
    if (features_ == 1) return print(summary_of(first_, arguments, unit));
    if (Status held = check_table(arguments, features_); !held) return held;
    if (!file_ || std::fflush(file_.get()) != 0 || std::fseek(file_.get(), 0, SEEK_SET) != 0)
      failed_ = true;
    if (failed_) return Error{ErrorCode::unwritable, "cannot write a temporary file", {}};
    if (Status head = print(table_head(false, disks_alone_)); !head) return head;
    std::string chunk(1 << 16, 0);
    while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file_.get()))
      if (Status printed = print(chunk.substr(0, count)); !printed) return printed;
    return print(table_end(unit));
  }

 private:
  void put(const std::string& row) {
    failed_ = failed_ || !file_ || std::fwrite(row.data(), 1, row.size(), file_.get()) < row.size();
  }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{std::tmpfile(), std::fclose};
  bool disks_alone_;
  std::uint64_t features_ = 0;
  Measured first_;
  bool failed_ = false;
};

/// Measures shapes, whose axes and boundaries are then no longer needed.
Result<io::MeasuredItems> measure_part(Document<ShapeItem> shapes, int threads, AxesReport& report,
                                       const MeasureArguments& arguments,
                                       std::vector<Measured>& all) {
  auto file = [&]() -> Result<Document<AxisItem>> {
    if (wants_disks_alone(arguments)) return without_axes(std::move(shapes));
    Options options =
        engine_options(arguments.common, threads, shapes.corner_angle, arguments.options);
    return medial::compute_axes(
        std::move(shapes), {std::move(options), arguments.input.source.read.skip_invalid}, &report);
  }();
  if (!file) return std::move(file).error();
  auto measured = measure_all(*file, threads, arguments);
  if (!measured) return std::move(measured).error();
  all = std::move(*measured);
  io::MeasuredItems out{layers_of(*file, all, arguments), std::move(*file)};
  for (AxisItem& item : out.second.items) item = {{}, {}, std::move(item.attributes)};
  return out;
}

/// Measures a file of many features part by part; nothing if the file cannot be streamed.
Result<std::optional<int>> stream_measures(const MeasureArguments& arguments) {
  const CommonOptions& common = arguments.common;
  if (!arguments.plot.empty() || common.json || arguments.path.between_places())
    return std::optional<int>();
  const bool table_wanted = prints_table(arguments);
  LateTable table(wants_disks_alone(arguments));
  std::mutex adding;
  std::map<std::uint64_t, std::vector<Measured>> parts;  // not printed yet, by first feature
  io::StreamOptions how;
  how.none = io::MeasuredItems{layers_of({}, {}, arguments), {}};
  how.compute = [&](Document<ShapeItem> shapes, int threads,
                    AxesReport& report) -> Result<io::StreamItems> {
    std::vector<Measured> all;
    auto made = measure_part(std::move(shapes), threads, report, arguments, all);
    if (!made) return std::move(made).error();
    const std::lock_guard<std::mutex> alone(adding);
    if (table_wanted && !all.empty()) parts[made->second.index_of(0)] = std::move(all);
    return io::StreamItems(std::move(*made));
  };
  how.visit = [&](const io::StreamItems& part) {
    const Document<AxisItem>& file = std::get<io::MeasuredItems>(part).second;
    const std::lock_guard<std::mutex> alone(adding);
    if (table_wanted && !file.items.empty())
      table.add(parts.extract(file.index_of(0)).mapped(), file);
  };
  auto done = stream(arguments, arguments.input, std::move(how));
  if (!done) return std::move(done).error();
  if (!*done) return std::optional<int>();
  if (table_wanted)
    if (Status printed = table.print_all(arguments, (*done)->file.unit); !printed)
      return std::move(printed).error();
  auto status = finish(common, {}, (*done)->phases, {});
  return status ? Result<std::optional<int>>(*status) : std::move(status).error();
}

Result<int> finish_measure(const std::vector<Measured>& all, const LoadedAxes& axes,
                           const MeasureArguments& arguments) {
  const CommonOptions& common = arguments.common;
  Json object = {{"input", arguments.input.path},
                 {"unit", name_of(axes.file.unit)},
                 {"features", Json::array()}};
  const bool disks_alone = wants_disks_alone(arguments);
  std::string text;
  if (common.json) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      Json one = {{"feature", axes.file.index_of(i)}};
      one.update(disks_alone
                     ? Json{{"disks", json_of_disks(all[i])}}
                     : json_of(all[i], arguments.necks > 0 ? arguments.necks : default_necks));
      one["attributes"] = to_json(axes.file.items[i].attributes);
      object["features"].push_back(std::move(one));
    }
  } else if (prints_table(arguments)) {
    text = all.size() == 1 ? summary_of(all[0], arguments, axes.file.unit)
                           : summary_of(all, axes.file, disks_alone);
  }
  return finish(common, std::move(object), axes.phases, text);
}

Result<int> run_measure(const MeasureArguments& given) {
  MeasureArguments arguments = given;
  const InputOptions& input = arguments.input;
  const CommonOptions& common = arguments.common;
  Status writable = check_output(arguments, io::formats_of(io::DocumentKind::layers));
  if (writable)
    writable = check_output(arguments.plot, {}, ".svg .png .pdf", input.path, common.json);
  if (writable && !arguments.plot.empty() && name_one_file(arguments.plot, arguments.output))
    writable = invalid_option("--plot and -o name the same file");
  if (writable) writable = check_places(arguments.path, input);
  if (writable) writable = check_used(arguments);
  if (!writable) return std::move(writable).error();
  if (arguments.samples == 0) arguments.samples = default_samples;
  if (arguments.transects == 0 && arguments.spacing == 0 && arguments.necks == 0 &&
      arguments.disks == 0 && has_layers(arguments))
    arguments.transects = default_transects;
  const auto streamed = stream_measures(arguments);
  if (!streamed) return streamed.error();
  if (*streamed) return **streamed;
  auto shapes = load_shapes(input, common);
  if (!shapes) return std::move(shapes).error();
  if (Status held = check_table(arguments, shapes->file.items.size()); !held)
    return std::move(held).error();
  auto axes = [&]() -> Result<LoadedAxes> {
    if (wants_disks_alone(arguments))
      return LoadedAxes{
          without_axes(std::move(shapes->file)), {}, shapes->report, std::move(shapes->phases)};
    return compute_axes(std::move(shapes).value(), input, common, arguments.options);
  }();
  if (!axes) return std::move(axes).error();
  note_places(axes->file, arguments.path, arguments);
  if (axes->file.pixel > 0 && input.source.read.smooth_contour && !common.quiet)
    say("medial: {}: note: areas and widths are those of the smoothed outline, which lies within "
        "half a pixel of the pixels' edges; --pixel-outline measures the pixels\n",
        input.path);
  const auto all = measure_all(axes->file, common.threads, arguments);
  if (!all) return all.error();
  axes->phases.end("measure");
  if (Status written = write_measures(axes->file, *all, arguments); !written)
    return std::move(written).error();
  if (!arguments.plot.empty()) {
    Status plotted = write_plots(arguments.plot, profile_plots(*all, input.path, axes->file));
    if (!plotted) return std::move(plotted).error();
  }
  return finish_measure(*all, *axes, arguments);
}

void add_width_options(CLI::App& command, MeasureArguments& arguments) {
  const auto before = static_cast<std::ptrdiff_t>(command.get_options().size());
  command.add_option("--plot", arguments.plot, "Draw the width profiles: .svg .png .pdf.")
      ->check(a_name())
      ->option_text("FILE");
  add_value(command, "--samples", arguments.samples, "N", in_range(1, most_transects, true),
            "Steps of a width profile (default: 200), from end to end of the line.");
  CLI::Option* transects =
      add_value(command, "--transects", arguments.transects, "N", in_range(1, most_transects, true),
                "N transects along each line, from boundary to boundary.");
  add_value(command, "--spacing", arguments.spacing, "D", a_positive_number(),
            "Transects at this distance from each other, in units of the input.")
      ->excludes(transects);
  add_value(command, "--necks", arguments.necks, "K", in_range(1, most_transects, true),
            "The K necks that widen most on both sides.");
  add_value(command, "--widening", arguments.widening, "FACTOR", in_range(1 + 1e-9, 1e9),
            "A neck widens on both sides to at least this many times its width (default: 1.1).");
  add_path_options(command, arguments.path);
  const std::vector<CLI::Option*> all = command.get_options();
  arguments.of_widths.assign(all.begin() + before, all.end());
}

}  // namespace

Command make_measure_command(CLI::App& program) {
  auto arguments = std::make_shared<MeasureArguments>();
  CLI::App* command = program.add_subcommand(
      "measure", "Measure the widths of shapes: profiles, transects, necks, largest disks.");
  add_input_options(*command, arguments->input);
  add_output_option(*command, arguments->output, "OUTPUT",
                    "The output file: the width profile as .csv, or transects, necks and disks\n"
                    "as layers or as a picture:\n" +
                        io::formats_of(io::DocumentKind::layers) +
                        "\n- is standard output, see --format.");
  add_layer_options(*command, arguments->write);
  add_format_option(*command, arguments->format, "for example csv");
  add_width_options(*command, *arguments);
  add_value(*command, "--disks", arguments->disks, "K", in_range(1, most_measured_disks, true),
            "The K largest disjoint disks inside the shape, one after another: measured,\n"
            "not only drawn. On its own, this needs no axis and is much faster.");
  add_exterior_options(*command, arguments->options,
                       "Measure the exterior, around the shape, within a rectangle, and in its\n"
                       "holes: bays, gaps and holes. The area is that of the axis's disks.")
      ->excludes("--disks");
  add_width_option(*command, arguments->write.width);
  add_common_options(*command, arguments->common);
  command->footer(
      "Widths are diameters of maximal disks along the centre line (medial centreline).\n"
      "`mean width by length` is their mean along the line; `by area` is the mean over the\n"
      "points of the shape, each with the width at its place on the line. A neck is narrower\n"
      "than both of its sides; `narrowest` is the smallest width on the line, ends included.\n"
      "With --project, printed coordinates are those of the projection.\n"
      "\n"
      "Examples:\n"
      "  medial measure river.geojson --project --plot widths.svg -o widths.csv\n"
      "  medial measure roads.gpkg --spacing 25 -o transects.shp\n"
      "  medial measure plan.wkt --necks 10 --disks 5 -o plan.svg\n"
      "  medial measure plan.wkt --disks 1\n"
      "  medial measure parcels.geojson --json | jq '.features[].mean_width.by_area'");
  return command_of(command, arguments, run_measure);
}

}  // namespace medial::cli
