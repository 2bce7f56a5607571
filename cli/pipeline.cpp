#include "cli/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "medial/document.h"
#include "medial/features.h"
#include "medial/measure.h"
#include "medial/query.h"
#include "medial/threads.h"

namespace medial::cli {
namespace {

/// Prints notes; of notes that differ only in their numbers, the first ten.
void print_notes(const std::vector<std::string>& notes, const InputOptions& input,
                 const CommonOptions& common) {
  if (common.quiet) return;
  constexpr std::uint64_t many = 10;
  std::map<std::string, std::uint64_t> counts;
  std::uint64_t unsaid = 0;
  const auto print = [&input](const std::string& note) {
    say("medial: {}: note: {}\n", input.path, note);
  };
  for (const std::string& note : notes) {
    std::string kind = note;
    std::erase_if(kind, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; });
    if (++counts[kind] <= many)
      print(note);
    else
      ++unsaid;
  }
  if (unsaid > 0) print(counted(unsaid, "more note") + " like these");
}

template <class Item>
void print_notes(const Document<Item>& file, const InputOptions& input,
                 const CommonOptions& common) {
  print_notes(file.notes, input, common);
  if (file.geographic && !input.source.read.project && !common.quiet) {
    say("medial: {}: warning: longitudes and latitudes are taken as plane coordinates, which "
        "distorts distances; --project computes in metres\n",
        input.path);
  }
}

void note_report(const AxesReport& report, const InputOptions& input, const CommonOptions& common) {
  note_left_out(report.left_out, input, common);
  if (report.by_disks > 0 && !common.quiet)
    say("medial: {}: note: the method disks computed {} instead, with --exact or because rounding "
        "decides there\n",
        input.path, counted(report.by_disks, "feature"));
  if (report.unresolved == 0 || common.quiet) return;
  const bool is_known = report.pixels < std::numeric_limits<std::uint32_t>::max();
  say("medial: {}: note: the grid does not resolve {} of the shape's parts or holes; {}\n",
      input.path, report.unresolved,
      is_known ? "--pixels " + std::to_string(report.pixels) + " does"
               : "a smaller --resolution may, or another method");
}

template <class T>
Result<T> naming_file(Result<T> result, const InputOptions& input) {
  if (!result && result.error().place.file.empty()) result.error().place.file = input.path;
  return result;
}

/// The error of an invalid shape, with a remedy. The caller knows whether the file is an image; a
/// pipe that has been read cannot tell.
Error with_cure(Error error, const InputOptions& input, bool of_image,
                const char* by_repair = "repairs such rings") {
  using enum ErrorCode;
  const io::ReadOptions& read = input.source.read;
  const bool tangled = error.code == crossing || error.code == overlap ||
                       error.code == hole_outside || error.code == nested_outer;
  const bool flat = error.code == no_area || error.code == too_few_points;
  // medial's own format is not repaired.
  std::error_code ignored;
  const bool native =
      std::filesystem::is_regular_file(input.path, ignored) && io::is_native(input.path);
  const bool mends = !of_image && !native;
  if ((tangled || flat) && read.repair == RepairRule::none && mends)
    error.text += tangled ? fmt::format("; --repair {}", by_repair)
                          : "; --repair drops such rings, and so does --skip-invalid";
  else if (flat && !read.skip_invalid)
    error.text += "; --skip-invalid leaves such features out";
  return error;
}

/// The entries of --stats for commands that compute axes.
Json statistics_of(const LoadedAxes& axes, const AxisSummary& summary) {
  const Statistics& counted = axes.axes.statistics;
  const ShapeReport& cleaned = axes.report.shapes;
  const double sites = static_cast<double>(std::max<std::uint64_t>(summary.sites, 1));
  Json object = {{"phases",
                  {{"sites", counted.seconds_sites},
                   {"tree", counted.seconds_tree},
                   {"connect", counted.seconds_connect},
                   {"walk", counted.seconds_walk},
                   {"collect", counted.seconds_collect}}},
                 {"features", summary.features},
                 {"sites", summary.sites},
                 {"nodes", summary.nodes()},
                 {"edges", summary.edges},
                 {"branches", summary.branches},
                 {"queries_per_site", static_cast<double>(counted.queries) / sites},
                 {"precision_retries", counted.precision_retries},
                 {"apollonius", counted.apollonius},
                 {"brackets", counted.brackets},
                 {"cuts", counted.bridges},
                 {"unresolved", axes.axes.unresolved},
                 {"largest_residual", counted.largest_residual},
                 {"input_rings", cleaned.input_rings},
                 {"input_points", cleaned.input_points},
                 {"cleaned", to_json(cleaned)}};
  if (counted.exact_filtered + counted.exact_twofold + counted.exact_precise > 0)
    object["exact"] = {{"filtered", counted.exact_filtered},
                       {"twofold", counted.exact_twofold},
                       {"precise", counted.exact_precise},
                       {"changes", counted.exact_changes}};
  if (axes.report.arcs.pieces > 0) object["arcs"] = to_json(axes.report.arcs);
  return object;
}

/// " mm", or nothing if the unit is unknown.
std::string in_units(Unit unit) {
  const std::string name = name_of(unit);
  return name.empty() ? name : " " + name;
}

/// "1 feature, 12 sites, 20 nodes, 19 edges, 7 branches; deepest disk: radius 3 at (1, 2)"
std::string describe(const AxisSummary& summary, Unit unit) {
  std::string text =
      fmt::format("{}, {}, {}, {}, {}", counted(summary.features, "feature"),
                  counted(summary.sites, "site"), counted(summary.nodes(), "node"),
                  counted(summary.edges, "edge"), counted(summary.branches, "branch", "branches"));
  if (summary.deepest.radius >= 0) {
    text +=
        fmt::format("; deepest disk: radius {:.6g}{} at ({:.10g}, {:.10g})", summary.deepest.radius,
                    in_units(unit), summary.deepest.center.x, summary.deepest.center.y);
    if (summary.features > 1) text += fmt::format(" in feature {}", summary.deepest_feature);
  }
  return text;
}

/// Whether a native file holds the requested axes. It may hold only shapes or contours, and a
/// margin requires new axes.
bool has_axes(const Document<AxisItem>& file, const Options& options) {
  const auto& items = file.items;
  if (std::ranges::any_of(items, [](const auto& item) { return !item.contours.empty(); }))
    return false;
  if (options.exterior && (options.margin > 0 || !std::ranges::all_of(items, [](const auto& item) {
                             return item.axis.exterior > 0;
                           })))
    return false;
  return items.empty() ||
         std::ranges::any_of(items, [](const auto& item) { return !item.axis.nodes.empty(); });
}

bool has_effect(const UnitOptions& units) {
  return units.given != Unit::unknown || units.wanted != Unit::unknown || units.scale != 1 ||
         units.pixel_size > 0;
}

/// Options of images have no effect on other files.
Status check_image_options(const InputOptions& input) {
  const io::ImageOptions& image = input.source.read.image;
  if (!image.threshold && !image.invert && !image.labels && !input.whole_smooth) return success();
  if (image.labels && (image.threshold || image.invert))
    return invalid_option(
        "--labels uses each value above 0: --threshold and --invert have no effect");
  std::error_code ignored;
  const bool is_there = input.path == "-" || std::filesystem::exists(input.path, ignored);
  if (!is_there || io::is_image(input.path)) return success();
  if (input.whole_smooth && io::is_native(input.path)) return success();  // may be of an image
  return invalid_option(
      "--threshold, --invert, --labels and --smooth-contour are for images, which " +
      (input.path == "-" ? "standard input" : input.path) + " is not");
}

/// Resets options that do not apply to a file: `choices` for medial's own format, which has no
/// layers and no rings to repair; `pixels` for files other than images.
void leave_out(io::ReadOptions& read, bool choices, bool pixels) {
  const io::ReadOptions given = read;
  if (choices) {
    read = {};
    read.skip_invalid = given.skip_invalid;
    read.smooth_contour = given.smooth_contour;
    read.image = given.image;
  }
  if (pixels) read.image = {};
}

/// The shapes of features that have been read, with notes.
Result<LoadedShapes> shapes_of(Document<Feature> features, LoadedShapes out,
                               const InputOptions& input, const CommonOptions& common) {
  LoadOptions options = input.source.load;
  options.repair = input.source.read.repair;
  options.skip_invalid = input.source.read.skip_invalid;
  options.threads = common.threads;
  auto shapes = naming_file(medial::load_shapes(std::move(features), options, &out.report), input);
  if (!shapes) return with_cure(std::move(shapes).error(), input, out.of_image);
  out.file = std::move(shapes).value();
  out.file.corner_angle = common.corner_angle.value_or(out.file.corner_angle);
  out.phases.end("shape");
  print_notes(out.file, input, common);
  return out;
}

}  // namespace

void note_left_out(const std::vector<std::string>& left_out, const InputOptions& input,
                   const CommonOptions& common) {
  print_notes(left_out, input, common);
  if (!left_out.empty() && !common.quiet)
    say("medial: {}: note: {} could not be computed and {} left out\n", input.path,
        counted(left_out.size(), "feature"), left_out.size() == 1 ? "was" : "were");
}

Result<Document<ShapeItem>> without_axis(const Document<AxisItem>& axes, const InputOptions& input,
                                         Document<ShapeItem>& shapes) {
  Document<ShapeItem> kept{shapes, {}}, rest{shapes, {}};
  if (!input.source.read.skip_invalid) return rest;
  kept.indices.clear();
  rest.indices.clear();
  std::map<std::uint64_t, ShapeItem*> by_number;
  for (std::size_t i = 0; i < shapes.items.size(); ++i)
    by_number.emplace(shapes.index_of(i), &shapes.items[i]);
  const auto move_to = [](Document<ShapeItem>& to, std::uint64_t number, ShapeItem& item) {
    to.indices.push_back(number);
    to.items.push_back(std::move(item));
  };
  for (std::size_t i = 0; i < axes.items.size(); ++i) {
    const auto found = by_number.extract(axes.index_of(i));
    if (!found)
      return error_at(ErrorCode::malformed, input.path,
                      fmt::format("holds no shape of feature {}", axes.index_of(i)));
    move_to(kept, found.key(), *found.mapped());
  }
  for (const auto& [number, item] : by_number) move_to(rest, number, *item);
  shapes = std::move(kept);
  return rest;
}

Result<std::size_t> refused_without_axis(const Document<AxisItem>& axes,
                                         const std::string& axes_path, const InputOptions& input,
                                         const CommonOptions& common, Document<ShapeItem>& shapes) {
  auto rest = without_axis(axes, input, shapes);
  if (!rest) return std::move(rest).error();
  const std::size_t count = rest->items.size();
  if (count == 0) return count;
  Options options;
  options.exterior =
      std::ranges::any_of(axes.items, [](const AxisItem& item) { return item.axis.exterior > 0; });
  options = engine_options(common, common.threads, shapes.corner_angle, std::move(options));
  AxesReport refused;
  const auto computed =
      medial::compute_axes(std::move(*rest), {std::move(options), true}, &refused);
  if (!computed) return computed.error();
  if (!computed->items.empty())
    return error_at(ErrorCode::malformed, axes_path,
                    fmt::format("has no axis of feature {} of {}, which has one",
                                computed->index_of(0), input.path));
  if (!common.quiet)
    say("medial: {}: note: it has no axis of {}, left out\n", axes_path, counted(count, "feature"));
  return count;
}

InputOptions first_input(InputOptions input, const std::string& second) {
  if (!input.source.text.empty()) return input;
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(second, ignored);
  const bool choices = io::is_native(input.path) && !io::is_native(second);
  const bool pixels = !io::is_image(input.path) && (folder || io::is_image(second));
  leave_out(input.source.read, choices, pixels);
  return input;
}

InputOptions second_input(InputOptions input, const std::string& second) {
  input.path = second;
  input.font.clear();
  input.source.text.clear();
  leave_out(input.source.read, io::is_native(second), !io::is_image(second));
  return input;
}

Result<LoadedShapes> load_shapes(const InputOptions& input, const CommonOptions& common) {
  LoadedShapes out;
  if (Status suited = check_image_options(input); !suited) return std::move(suited).error();
  auto features = [&] {
    const Activity shown("reading", input.path);
    out.of_image = input.source.text.empty() && io::is_image(input.path);
    return io::read_features(input.path, input.source);
  }();
  if (!features) return with_cure(std::move(features).error(), input, out.of_image);
  out.phases.end("read");
  return shapes_of(std::move(*features), std::move(out), input, common);
}

Result<LoosePieces> load_loose(const InputOptions& input, const CommonOptions& common) {
  const Activity shown("reading", input.path);
  io::SourceOptions source = input.source;
  source.load.threads = common.threads;
  auto pieces = io::load_loose(input.path, source);
  if (pieces) print_notes(pieces->features.notes, input, common);
  return pieces;
}

Status with_planar_graph(const LoosePieces& pieces, const FileArguments& arguments,
                         const std::function<Status(PlanarGraph&)>& use) {
  const InputOptions& input = arguments.input;
  const bool repair = input.source.read.repair != RepairRule::none;
  auto touching = naming_file(medial::with_planar_graph(pieces, repair, use), input);
  if (!touching)
    return with_cure(std::move(touching).error(), input, pieces.features.pixel > 0,
                     "splits lines where they cross or overlap");
  if (*touching > 0 && !arguments.common.quiet)
    say("medial: {}: note: points and edges within {:.2g} of each other touch, as rounding "
        "cannot separate them\n",
        input.path, *touching);
  return success();
}

Result<LoadedAxes> compute_axes(LoadedShapes shapes, const InputOptions& input,
                                const CommonOptions& common, Options options) {
  LoadedAxes out{{}, {}, shapes.report, std::move(shapes.phases)};
  Progress progress("medial axis", error_is_terminal() && !common.quiet);
  options = engine_options(common, common.threads, shapes.file.corner_angle, std::move(options));
  options.progress = progress.callback();
  auto axes = naming_file(
      medial::compute_axes(std::move(shapes.file),
                           {std::move(options), input.source.read.skip_invalid}, &out.axes),
      input);
  if (!axes) return std::move(axes).error();
  out.file = std::move(axes).value();
  out.phases.end("axis");
  note_report(out.axes, input, common);
  return out;
}

namespace {

/// The axes of a native file, or axes computed from its shapes if it lacks the requested ones.
Result<LoadedAxes> load_stored(const InputOptions& input, const CommonOptions& common,
                               const Options& options) {
  if (Status suited = check_image_options(input); !suited) return std::move(suited).error();
  LoadedAxes out;
  auto stored = [&input] {
    const Activity shown("reading", input.path);
    return io::read_native(input.path, input.source.read);
  }();
  if (!stored) return std::move(stored).error();
  out.phases.end("read");
  const UnitOptions& units = input.source.units;
  if (!has_axes(*stored, options)) {
    Document<Feature> features = io::features_of(std::move(*stored));
    if (Status done = convert_units(features, units); !done)
      return naming_file<LoadedAxes>(std::move(done).error(), input);
    LoadedShapes begun;
    begun.phases = std::move(out.phases);
    auto shapes = shapes_of(std::move(features), std::move(begun), input, common);
    if (!shapes) return std::move(shapes).error();
    return compute_axes(std::move(shapes).value(), input, common, options);
  }
  if (has_effect(units))
    return error_at(ErrorCode::invalid_option, input.path,
                    "a stored axis keeps its units: convert its shape instead");
  out.file = std::move(stored).value();
  print_notes(out.file, input, common);
  return out;
}

}  // namespace

Result<LoadedAxes> load_axes(const InputOptions& input, const CommonOptions& common, double specks,
                             const Options& options) {
  if (specks == 0 && input.source.text.empty() && io::is_native(input.path))
    return load_stored(input, common, options);
  auto shapes = load_shapes(input, common);
  if (!shapes) return std::move(shapes).error();
  if (specks > 0)
    for (ShapeItem& item : shapes->file.items) item.shape = without_specks(item.shape, specks);
  return compute_axes(std::move(shapes).value(), input, common, options);
}

double corner_angle(const CommonOptions& common, double of_input) {
  return common.corner_angle.value_or(of_input > 0 ? of_input : Options{}.corner_angle);
}

Options engine_options(const CommonOptions& common, int threads, double of_input, Options options) {
  options.tolerance = common.tolerance;
  options.corner_angle = corner_angle(common, of_input);
  options.threads = threads;
  return options;
}

std::vector<double> edge_weights_of(const Document<AxisItem>& file) {
  std::vector<double> weights;
  for (const AxisItem& item : file.items)
    weights.push_back(static_cast<double>(item.axis.edges.size()) + 1);
  return weights;
}

AxisSummary summarize(const Document<AxisItem>& file) {
  AxisSummary summary;
  add_to(summary, file);
  return summary;
}

namespace {

void count_kind(AxisSummary& summary, const Node& node) {
  ++(node.kind == NodeKind::leaf          ? summary.leaves
     : node.kind == NodeKind::site_change ? summary.site_changes
                                          : summary.branchings);
}
void take_deepest(AxisSummary& summary, const MedialAxis& axis, std::uint64_t feature) {
  if (axis.nodes.empty()) return;
  const Disk disk = deepest_disk(axis);
  if (!(disk.radius > summary.deepest.radius)) return;
  summary.deepest = disk;
  summary.deepest_feature = feature;
}

constexpr std::uint8_t inner_bit = 1, end_bit = 2;
bool is_inner(const Node& node) { return node.kind == NodeKind::site_change; }

}  // namespace

void add_to(AxisSummary& summary, const Document<AxisItem>& more) {
  for (std::size_t i = 0; i < more.items.size(); ++i) {
    const MedialAxis& axis = more.items[i].axis;
    summary.sites += axis.sites.size();
    summary.edges += axis.edges.size();
    summary.branches += branch_count(axis);
    summary.length += total_length(axis);
    for (const Node& node : axis.nodes) count_kind(summary, node);
    take_deepest(summary, axis, more.indices.empty() ? summary.features : more.indices[i]);
    ++summary.features;
  }
}

void PartsSummary::add(std::size_t shape, std::uint64_t number, const AxisPart& part) {
  if (part.begins) {
    if (shape == 0) *this = {};
    end_shape();
  }
  const MedialAxis& axis = part.axis;
  for (std::size_t i = part.known; i < axis.nodes.size(); ++i) {
    const Node& node = axis.nodes[i];
    count_kind(summary_, node);
    if (node.component >= kinds_.size()) kinds_.resize(node.component + 1);
    kinds_[node.component] |= is_inner(node) ? inner_bit : end_bit;
  }
  for (const Edge& edge : axis.edges)
    for (const std::uint32_t node : edge.node) branch_ends_ += is_inner(axis.nodes[node]) ? 0 : 1;
  nodes_ += axis.nodes.size() - part.known;
  edges_ += axis.edges.size();
  summary_.length += total_length(axis);
  take_deepest(summary_, axis, number);
}

void PartsSummary::end_shape() {
  if (nodes_ > 0 && edges_ == 0) ++points_;
  summary_.edges += std::exchange(edges_, 0);
  nodes_ = 0;
  // A closed branch is all of its component.
  summary_.branches +=
      static_cast<std::uint64_t>(std::ranges::count(std::exchange(kinds_, {}), inner_bit));
}

AxisSummary PartsSummary::finish(std::size_t shapes, std::uint64_t sites) {
  end_shape();
  summary_.branches += std::exchange(branch_ends_, 0) / 2;
  summary_.features = shapes;
  summary_.sites = sites;
  return summary_;
}

Json to_json(const AxisSummary& summary) {
  const Disk& disk = summary.deepest;
  Json deepest;  // null where there is no disk
  if (disk.radius >= 0)
    deepest = {{"x", disk.center.x},
               {"y", disk.center.y},
               {"radius", disk.radius},
               {"feature", summary.deepest_feature}};
  return {{"features", summary.features}, {"sites", summary.sites},
          {"nodes", summary.nodes()},     {"edges", summary.edges},
          {"branches", summary.branches}, {"length", summary.length},
          {"deepest", std::move(deepest)}};
}

Status write_panels(const FileArguments& arguments, const DocumentInfo& info, const Box& box,
                    std::vector<Panel> panels, double width) {
  Document<AxisItem> file{info, {}};
  const Vec2 size = box.high - box.low;
  const Vec2 pitch{1.1 * size.x, size.y + 0.1 * std::max(size.x, size.y)};
  constexpr std::size_t columns = 3;
  const double up = info.y_down ? -1 : 1;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Vec2 move{static_cast<double>(i % columns) * pitch.x,
                    -up * static_cast<double>(i / columns) * pitch.y};
    const auto bottom = [up](const AxisItem& item) {
      const Box own = bounding_box(item.shape);
      return up > 0 ? own.low.y : -own.high.y;
    };
    std::ranges::min_element(panels[i].items, {}, bottom)->attributes = {
        {"title", panels[i].title}};
    for (AxisItem& item : panels[i].items) {
      for (Vec2& p : item.shape.points) p = p + move;
      for (Site& site : item.axis.sites) {
        site.start = site.start + move;
        site.end = site.end + move;
      }
      for (Node& node : item.axis.nodes) node.disk.center = node.disk.center + move;
      for (Edge& edge : item.axis.edges) edge.control.center = edge.control.center + move;
      file.items.push_back(std::move(item));
    }
  }
  io::WriteOptions options;
  options.width = width;
  options.titles = true;
  return io::write_axes(arguments.output, arguments.format, file, options);
}

namespace {

/// Prints a summary, statistics or both.
Result<int> print_summary(LoadedAxes& axes, const AxisSummary& summary,
                          const FileArguments& arguments) {
  Json object = {{"input", arguments.input.path}};
  if (!arguments.output.empty()) object["output"] = arguments.output;
  object.update(to_json(summary));
  object["unit"] = name_of(axes.file.unit);
  return finish(arguments, std::move(object), axes.phases,
                fmt::format("{}: {}", arguments.input.path, describe(summary, axes.file.unit)),
                arguments.common.stats ? statistics_of(axes, summary) : Json());
}

}  // namespace

Result<std::optional<LoadedAxes>> stream(const FileArguments& arguments, const InputOptions& input,
                                         io::StreamOptions stream) {
  const CommonOptions& common = arguments.common;
  LoadedAxes out;
  Progress progress("medial axis", error_is_terminal() && !common.quiet);
  stream.source = input.source;
  stream.write = write_options(arguments);
  stream.threads = common.threads;
  stream.progress = progress.counting_callback();
  // Only errors of shapes have a remedy; other errors name a file already.
  stream.compute = [&input, compute = std::move(stream.compute)](Document<ShapeItem> shapes,
                                                                 int threads, AxesReport& axes) {
    return naming_file(compute(std::move(shapes), threads, axes), input);
  };
  auto report = io::stream(input.path, arguments.output, arguments.format, stream);
  if (!report && report.error().place.file.empty())
    return with_cure(naming_file(std::move(report), input).error(), input, false);
  if (!report) return std::move(report).error();
  if (!*report) return std::optional<LoadedAxes>();
  out.phases.end("stream");
  io::StreamReport& done = **report;
  out.report = done.load;
  out.axes = done.axes;
  out.axes.statistics.threads = effective_threads(common.threads);
  static_cast<DocumentInfo&>(out.file) = std::move(done.document);
  print_notes(out.file, input, common);
  note_report(out.axes, input, common);
  return std::optional(std::move(out));
}

namespace {

/// Items whose axis is one point, the centre of a disk.
std::uint64_t points_of(const Document<AxisItem>& file) {
  return static_cast<std::uint64_t>(std::ranges::count_if(file.items, [](const AxisItem& item) {
    return item.axis.edges.empty() && !item.axis.nodes.empty();
  }));
}

void note_points(std::uint64_t points, const FileArguments& arguments) {
  if (points == 0 || arguments.common.quiet || arguments.output.empty()) return;
  say("medial: {}: note: the axis of {} is a single point, the centre of a disk, not a line; "
      ".json, .graphml and .nodelink hold it as a node\n",
      arguments.input.path, counted(points, "feature"));
}

}  // namespace

Result<std::optional<int>> stream_axes(
    const FileArguments& arguments, const InputOptions& input, Options options,
    const std::function<Status(Document<AxisItem>& part)>& change,
    const std::function<std::string()>& line, std::uint64_t most_points) {
  const bool talkative = is_talkative(arguments);
  AxisSummary summary;
  std::uint64_t points = 0;
  options = engine_options(arguments.common, 1, 0, std::move(options));
  io::StreamOptions how;
  Document<AxisItem> none;
  none.corner_angle = arguments.common.corner_angle.value_or(0);
  how.none = std::move(none);
  how.most_points = most_points;
  how.compute = [&](Document<ShapeItem> shapes, int threads,
                    AxesReport& report) -> Result<io::StreamItems> {
    Options own = options;
    own.threads = threads;
    auto axes = medial::compute_axes(std::move(shapes),
                                     {std::move(own), input.source.read.skip_invalid}, &report);
    if (!axes) return std::move(axes).error();
    if (change && !axes->items.empty())
      if (Status changed = change(*axes); !changed) return std::move(changed).error();
    return io::StreamItems(std::move(*axes));
  };
  how.visit = [&](const io::StreamItems& part) {
    const auto& of_part = std::get<Document<AxisItem>>(part);
    points += points_of(of_part);
    if (talkative) add_to(summary, of_part);
  };
  auto axes = stream(arguments, input, std::move(how));
  if (!axes) return std::move(axes).error();
  if (!*axes) return std::optional<int>();
  if (!line) note_points(points, arguments);
  if (!talkative) return std::optional<int>(exit_success);
  auto printed = line ? finish(arguments, {}, (*axes)->phases, line())
                      : print_summary(**axes, summary, arguments);
  if (!printed) return std::move(printed).error();
  return std::optional<int>(*printed);
}

Result<std::optional<int>> finish_in_parts(LoadedShapes& shapes, const FileArguments& arguments,
                                           const InputOptions& input, Options options) {
  const CommonOptions& common = arguments.common;
  PartsSummary parts;
  LoadedAxes out{{shapes.file, {}}, {}, shapes.report, shapes.phases};
  Progress progress("medial axis", error_is_terminal() && !common.quiet);
  options = engine_options(common, common.threads, shapes.file.corner_angle, std::move(options));
  options.progress = progress.callback();
  const auto visit = [&](std::size_t shape, std::uint64_t number, const AxisPart& part) {
    parts.add(shape, number, part);
  };
  const std::size_t features = shapes.file.items.size();
  auto report =
      naming_file(io::write_in_parts(arguments.output, arguments.format, std::move(shapes.file),
                                     {std::move(options), input.source.read.skip_invalid},
                                     write_options(arguments), visit),
                  input);
  if (!report) return std::move(report).error();
  if (!*report) return std::optional<int>();
  out.axes = **report;
  out.axes.statistics.threads = effective_threads(common.threads);
  out.phases.end("axis");
  note_report(out.axes, input, common);
  const AxisSummary summary = parts.finish(features - out.axes.left_out.size(), out.axes.sites);
  note_points(parts.points(), arguments);
  if (!is_talkative(arguments)) return std::optional<int>(exit_success);
  auto printed = print_summary(out, summary, arguments);
  if (!printed) return std::move(printed).error();
  return std::optional<int>(*printed);
}

Result<int> finish_axes(LoadedAxes& axes, const FileArguments& arguments) {
  Status written =
      write_output(arguments, axes.phases, [&](const std::string& path, const std::string& format) {
        return io::write_axes(path, format, axes.file, write_options(arguments));
      });
  if (!written) return std::move(written).error();
  note_points(points_of(axes.file), arguments);
  if (!is_talkative(arguments)) return exit_success;
  return print_summary(axes, summarize(axes.file), arguments);
}

}  // namespace medial::cli
