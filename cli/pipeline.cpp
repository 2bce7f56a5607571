#include "cli/pipeline.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>

#include "cli/terminal.h"
#include "medial/curve_axis.h"
#include "medial/measure.h"
#include "medial/query.h"

namespace medial::cli {
namespace {

/// Lets the sources of a shape built from the loops of `original` name what those came from.
void keep_sources(Shape& shape, const Shape& original) {
  for (VertexSource& source : shape.sources) {
    source = original.sources[original.loop_begin[source.ring] + source.vertex];
  }
}

/// What --stats tells.
Json stats(const AxisFile& file, const AxisSummary& summary, double seconds_write) {
  const Statistics& counted_by_engine = file.statistics;
  const double sites = static_cast<double>(std::max<std::uint64_t>(summary.sites, 1));
  Json object = {{"seconds",
                  {{"read", file.seconds_read},
                   {"shape", file.seconds_shape},
                   {"axis", file.seconds_axis},
                   {"write", seconds_write}}},
                 {"processor",
                  {{"read", file.processor_read},
                   {"shape", file.processor_shape},
                   {"axis", file.processor_axis}}},
                 {"phases",
                  {{"sites", counted_by_engine.seconds_sites},
                   {"tree", counted_by_engine.seconds_tree},
                   {"connect", counted_by_engine.seconds_connect},
                   {"walk", counted_by_engine.seconds_walk},
                   {"collect", counted_by_engine.seconds_collect},
                   {"exact", counted_by_engine.seconds_exact}}},
                 {"features", summary.features},
                 {"sites", summary.sites},
                 {"nodes", summary.nodes()},
                 {"edges", summary.edges},
                 {"branches", summary.branches},
                 {"queries_per_site", static_cast<double>(counted_by_engine.queries) / sites},
                 {"precision_retries", counted_by_engine.precision_retries},
                 {"apollonius", counted_by_engine.apollonius},
                 {"brackets", counted_by_engine.brackets},
                 {"cuts", counted_by_engine.bridges},
                 {"unresolved", file.unresolved},
                 {"largest_residual", counted_by_engine.largest_residual},
                 {"threads", counted_by_engine.threads},
                 {"peak_bytes", peak_bytes()},
                 {"input_rings", file.cleaned.input_rings},
                 {"input_points", file.cleaned.input_points},
                 {"cleaned", to_json(file.cleaned)}};
  if (counted_by_engine.seconds_exact > 0)
    object["exact"] = {{"filtered", counted_by_engine.exact_filtered},
                       {"precise", counted_by_engine.exact_precise},
                       {"rational", counted_by_engine.exact_rational},
                       {"ties", counted_by_engine.exact_ties},
                       {"changes", counted_by_engine.exact_changes}};
  if (file.arcs.pieces > 0) object["arcs"] = to_json(file.arcs);
  return object;
}

/// The roles by which a rule decides what is inside. make-valid keeps what the file says: its own
/// rule of filling, or even-odd for outer rings and holes.
void apply_rule(io::RepairRule rule, std::vector<Ring>& rings) {
  for (Ring& ring : rings) {
    if (rule == io::RepairRule::non_zero)
      ring.role = RingRole::winding;
    else if (rule == io::RepairRule::even_odd || ring.role != RingRole::winding)
      ring.role = RingRole::any;
  }
}

/// What a file holds, and where it is in medial's own format, the shapes they were.
struct InputFile {
  Document<Feature> dataset;
  std::vector<Shape> originals;  ///< one without points where the file holds contours
};

Result<InputFile> read_input(const InputOptions& input) {
  InputFile source;
  if (!input.text.empty()) {
    if (!input.read.layer.empty() || !input.read.where.empty() || input.read.project ||
        input.read.close) {
      return invalid_option("--layer, --where, --project and --close are not for --text");
    }
    auto dataset = io::read_text(input.text, input.path);
    if (!dataset) return std::move(dataset).error();
    source.dataset = std::move(dataset).value();
    return source;
  }
  if (!io::is_native(input.path)) {
    auto dataset = io::read_dataset(input.path, input.read);
    if (!dataset) return std::move(dataset).error();
    source.dataset = std::move(dataset).value();
    return source;
  }
  if (!input.read.layer.empty() || !input.read.where.empty() || input.read.project ||
      input.read.repair != io::RepairRule::none || input.read.close) {
    return invalid_option(
        "--layer, --where, --repair, --project and --close are not for medial's own format");
  }
  auto native = io::read_native(input.path);
  if (!native) return std::move(native).error();
  source.dataset.crs_wkt = native->crs_wkt;
  source.dataset.y_down = native->y_down;
  for (AxisItem& item : native->items) {
    Feature feature;
    feature.rings = rings_of(item.shape);  // to be checked anew: a file may hold anything
    feature.contours = std::move(item.contours);
    feature.id = static_cast<std::int64_t>(source.dataset.items.size());
    feature.attributes = std::move(item.attributes);
    source.dataset.items.push_back(std::move(feature));
    source.originals.push_back(std::move(item.shape));
  }
  return source;
}

}  // namespace

Error at_feature(Error error, const std::string& path, std::size_t feature) {
  if (error.place.file.empty()) error.place.file = path;
  error.place.feature = feature;
  return error;
}

bool holds_contours(const Document<AxisItem>& file) {
  return std::ranges::any_of(file.items,
                             [](const AxisItem& item) { return !item.contours.empty(); });
}

std::vector<double> weights_of(std::span<const Shape> shapes) {
  std::vector<double> weights;
  for (const Shape& shape : shapes) weights.push_back(static_cast<double>(shape.points.size()));
  return weights;
}

Status for_each_feature(std::span<const double> weights, int threads,
                        const std::function<Status(std::size_t, int)>& work) {
  const int available = effective_threads(threads);
  // More threads than the machine has are a user's right: oneTBB has to be told.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(available));
  const std::size_t count = weights.size();
  std::vector<std::optional<Error>> errors(count);
  std::atomic<std::size_t> lowest_error = count;
  const auto run = [&](std::size_t i, int own_threads) {
    if (i > lowest_error.load()) return;
    Status status = work(i, own_threads);
    if (status) return;
    errors[i] = std::move(status).error();
    std::size_t seen = lowest_error.load();
    while (i < seen && !lowest_error.compare_exchange_weak(seen, i)) {
    }
  };

  // A feature is large if, on one thread, it could outlast all others together.
  const double share = std::accumulate(weights.begin(), weights.end(), 0.0) / available;
  const auto is_large = [&](std::size_t i) { return available > 1 && weights[i] >= share; };
  std::vector<std::size_t> small;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_large(i)) {
      run(i, available);
    } else {
      small.push_back(i);
    }
  }
  tbb::task_arena(available).execute([&] {
    tbb::parallel_for(std::size_t{0}, small.size(), [&](std::size_t k) { run(small[k], 1); });
  });

  if (lowest_error.load() == count) return success();
  return std::move(*errors[lowest_error.load()]);
}

namespace {

/// The boundary of a feature as contours, whatever it was read as.
std::vector<Contour> contours_of(const Feature& feature) {
  std::vector<Contour> contours = feature.contours;
  for (const Ring& ring : feature.rings)
    if (!ring.points.empty()) contours.push_back(contour_of(ring.points, ring.bulges, true));
  return contours;
}

/// The shape of a feature, whose boundaries are given back as soon as they are not needed any more:
/// curves become arcs, and what crosses is mended if that is asked for.
Result<Shape> shape_of(Feature& feature, const InputOptions& input, ShapeReport& report,
                       ArcReport& arc_report) {
  const bool curved =
      !feature.contours.empty() ||
      std::ranges::any_of(feature.rings, [](const Ring& ring) { return !ring.bulges.empty(); });
  if (!feature.contours.empty()) {
    auto rings = approximate_by_arcs(feature.contours, input.arcs, &arc_report);
    if (!rings) return std::move(rings).error();
    std::ranges::move(*rings, std::back_inserter(feature.rings));
    feature.contours = {};
  }
  ShapeOptions options;
  if (curved && input.read.repair != io::RepairRule::none) {
    options.node_crossings = true;
    apply_rule(input.read.repair, feature.rings);
  }
  auto shape = build_shape(feature.rings, options, &report);
  feature.rings = {};
  return shape;
}

}  // namespace

Result<ShapeFile> load_shapes(const InputOptions& input, int threads, bool keep_contours) {
  ShapeFile file;
  const Stopwatch reading;
  double processor = processor_seconds();
  auto source = [&input] {
    const Activity shown("reading", input.path);
    return read_input(input);
  }();
  if (!source) {
    Error error = std::move(source).error();
    if (error.place.file.empty()) error.place.file = input.path;
    return error;
  }
  Document<Feature>& dataset = source->dataset;
  if (dataset.items.empty()) {
    return error_at(ErrorCode::empty, input.path, "holds no polygon");
  }
  file.crs_wkt = std::move(dataset.crs_wkt);
  file.y_down = dataset.y_down;
  file.pixel = dataset.pixel;
  file.geographic = dataset.geographic;
  file.notes = std::move(dataset.notes);
  file.seconds_read = reading.seconds();
  file.processor_read = processor_seconds() - processor;

  const Stopwatch shaping;
  processor = processor_seconds();
  const std::size_t count = dataset.items.size();
  std::vector<double> weights;
  for (Feature& feature : dataset.items) {
    std::size_t points = 1;
    for (const Ring& ring : feature.rings) points += ring.points.size();
    for (const Contour& contour : feature.contours) points += contour.points.size();
    weights.push_back(static_cast<double>(points));
    if (keep_contours) file.contours.push_back(contours_of(feature));
    file.attributes.push_back(std::move(feature.attributes));
  }
  file.shapes.resize(count);
  std::vector<ShapeReport> reports(count);
  std::vector<ArcReport> arc_reports(count);
  Status built = for_each_feature(weights, threads, [&](std::size_t i, int) -> Status {
    auto shape = shape_of(dataset.items[i], input, reports[i], arc_reports[i]);
    if (!shape) return at_feature(std::move(shape).error(), input.path, i);
    file.shapes[i] = std::move(shape).value();
    if (!source->originals.empty() && !source->originals[i].points.empty()) {
      keep_sources(file.shapes[i], source->originals[i]);
    }
    return success();
  });
  if (!built) return std::move(built).error();
  for (std::size_t i = 0; i < count; ++i) {
    if (reports[i].crossings == 0) continue;
    file.notes.push_back(
        fmt::format("feature {} was repaired: its edges cross in {} places and are split there; {} "
                    "rings before, {} loops after",
                    i, reports[i].crossings, reports[i].input_rings, file.shapes[i].loop_count()));
  }
  for (const ShapeReport& report : reports) add(file.report, report);
  for (const ArcReport& report : arc_reports) add(file.arcs, report);
  file.seconds_shape = shaping.seconds();
  file.processor_shape = processor_seconds() - processor;
  return file;
}

void print_notes(const ShapeFile& file, const InputOptions& input, const CommonOptions& common) {
  if (common.quiet) return;
  for (const std::string& note : file.notes) {
    say("medial: {}: note: {}\n", input.path, note);
  }
  if (file.geographic && !input.read.project) {
    say("medial: {}: warning: longitudes and latitudes are taken as plane coordinates, which "
        "distorts distances; --project computes in metres\n",
        input.path);
  }
}

namespace {

/// How far an axis of pixels of an interior is from one part for each component and one cycle for
/// each hole of its shape, by the Euler characteristic.
std::uint64_t unresolved_in(const Shape& shape, const MedialAxis& axis) {
  if (!is_of_pixels(axis.method) || axis.exterior > 0) return 0;
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  return static_cast<std::uint64_t>(std::abs(count(axis.nodes.size()) - count(axis.edges.size()) -
                                             count(shape.component_count()) +
                                             count(shape.hole_count())));
}

}  // namespace

Result<AxisFile> compute_axes(ShapeFile shapes, const std::string& path,
                              const CommonOptions& common, Options options) {
  const Stopwatch watch;
  const double processor = processor_seconds();
  AxisFile file;
  options.tolerance = common.tolerance;
  options.corner_angle = common.corner_angle;
  std::visit(
      [&](auto& own) {
        if constexpr (requires { own.grid; })
          if (own.grid.resolution == 0 && own.grid.pixels == 0) own.grid.resolution = shapes.pixel;
      },
      options.method);
  const std::size_t count = shapes.shapes.size();
  file.native.items.resize(count);
  file.native.crs_wkt = std::move(shapes.crs_wkt);
  file.native.y_down = shapes.y_down;
  const std::vector<double> weights = weights_of(shapes.shapes);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  Progress progress("medial axis", total, error_is_terminal() && !common.quiet);
  Status computed =
      for_each_feature(weights, common.threads, [&](std::size_t i, int threads) -> Status {
        Options own = options;
        own.threads = threads;
        own.progress = progress.part(weights[i]);
        const auto contours = shapes.contours.empty()
                                  ? std::span<const Contour>()
                                  : std::span<const Contour>(shapes.contours[i]);
        auto axis = compute(shapes.shapes[i], own, contours);
        if (!axis) return at_feature(std::move(axis).error(), path, i);
        AxisItem& item = file.native.items[i];
        item.axis = std::move(axis).value();
        item.shape = std::move(shapes.shapes[i]);
        item.attributes = std::move(shapes.attributes[i]);
        if (own.progress) own.progress(1.0);
        return success();
      });
  if (!computed) return std::move(computed).error();

  for (AxisItem& item : file.native.items) {
    Statistics& part = item.axis.statistics;
    file.statistics += part;
    file.unresolved += unresolved_in(item.shape, item.axis);
    // What differs from run to run is told by --stats and is no part of the file.
    part.threads = 1;
    part.seconds_sites = part.seconds_tree = part.seconds_connect = 0;
    part.seconds_walk = part.seconds_collect = part.seconds_exact = part.seconds = 0;
  }
  if (file.unresolved > 0 && !common.quiet)
    say("medial: {}: note: the grid does not tell apart {} of the shape's parts or holes; a "
        "smaller --resolution may\n",
        path, file.unresolved);
  file.statistics.threads = effective_threads(common.threads);
  file.cleaned = shapes.report;
  file.arcs = shapes.arcs;
  file.seconds_read = shapes.seconds_read;
  file.seconds_shape = shapes.seconds_shape;
  file.seconds_axis = watch.seconds();
  file.processor_read = shapes.processor_read;
  file.processor_shape = shapes.processor_shape;
  file.processor_axis = processor_seconds() - processor;
  return file;
}

CLI::Option* add_exterior_options(CLI::App& command, Options& options, const std::string& help) {
  CLI::Option* exterior = command.add_flag("--exterior", options.exterior, help);
  command
      .add_option("--margin", options.margin,
                  "How far that frame is away from the shape's bounding box, in units of the\n"
                  "input (default: half of the box's longer side).")
      ->check(a_positive_number())
      ->needs(exterior)
      ->option_text("D");
  return exterior;
}

Options engine_options(const CommonOptions& common, int threads) {
  Options options;
  options.tolerance = common.tolerance;
  options.corner_angle = common.corner_angle;
  options.threads = threads;
  return options;
}

Status for_each_shape(std::span<const Shape> shapes, const std::string& path,
                      const CommonOptions& common,
                      const std::function<Status(std::size_t i, const Options& options)>& work) {
  return for_each_feature(weights_of(shapes), common.threads,
                          [&](std::size_t i, int threads) -> Status {
                            Status done = work(i, engine_options(common, threads));
                            if (!done) return at_feature(std::move(done).error(), path, i);
                            return success();
                          });
}

AxisSummary summarize(const Document<AxisItem>& file) {
  AxisSummary summary;
  summary.features = file.items.size();
  summary.deepest.radius = -1;
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const MedialAxis& axis = file.items[i].axis;
    summary.sites += axis.sites.size();
    summary.edges += axis.edges.size();
    summary.branches += branch_count(axis);
    summary.length += total_length(axis);
    for (const Node& node : axis.nodes) {
      switch (node.kind) {
        case NodeKind::leaf:
          ++summary.leaves;
          break;
        case NodeKind::site_change:
          ++summary.site_changes;
          break;
        case NodeKind::branching:
          ++summary.branchings;
          break;
      }
    }
    if (axis.nodes.empty()) continue;
    const Disk disk = deepest_disk(axis);
    if (disk.radius > summary.deepest.radius) {
      summary.deepest = disk;
      summary.deepest_feature = i;
    }
  }
  return summary;
}

std::string describe(const AxisSummary& summary) {
  std::string text =
      fmt::format("{}, {}, {}, {}, {}", counted(summary.features, "feature"),
                  counted(summary.sites, "site"), counted(summary.nodes(), "node"),
                  counted(summary.edges, "edge"), counted(summary.branches, "branch", "branches"));
  if (summary.deepest.radius >= 0) {
    text += fmt::format("; deepest disk: radius {:.6g} at ({:.10g}, {:.10g})",
                        summary.deepest.radius, summary.deepest.center.x, summary.deepest.center.y);
    if (summary.features > 1) text += fmt::format(" in feature {}", summary.deepest_feature);
  }
  return text;
}

Json to_json(const AxisSummary& summary) {
  return {{"features", summary.features},
          {"sites", summary.sites},
          {"nodes", summary.nodes()},
          {"edges", summary.edges},
          {"branches", summary.branches},
          {"length", summary.length},
          {"deepest",
           {{"x", summary.deepest.center.x},
            {"y", summary.deepest.center.y},
            {"radius", summary.deepest.radius},
            {"feature", summary.deepest_feature}}}};
}

Result<int> write_and_tell(const AxisFile& file, const InputOptions& input,
                           const CommonOptions& common, const std::string& output,
                           const std::string& format, const io::WriteOptions& pictures) {
  const Stopwatch writing;
  if (!output.empty()) {
    io::WriteOptions write = pictures;
    write.chord = common.chord;
    const Activity shown("writing", output);
    Status written = io::write_axes(output, format, file.native, write);
    if (!written) return std::move(written).error();
  }
  const double seconds_write = output.empty() ? 0 : writing.seconds();
  const bool summary_on_terminal = !output.empty() && error_is_terminal() && !common.quiet;
  const bool summary_is_output = output.empty() && !common.json;
  if (!common.json && !common.stats && !summary_on_terminal && !summary_is_output) {
    return exit_success;
  }

  const AxisSummary summary = summarize(file.native);
  if (common.json) {
    Json object = {{"input", input.path}};
    if (!output.empty()) object["output"] = output;
    if (common.stats) object.update(stats(file, summary, seconds_write));
    object.update(to_json(summary));
    Status printed = print(object);
    if (!printed) return std::move(printed).error();
    return exit_success;
  }
  const double seconds = file.seconds_read + file.seconds_shape + file.seconds_axis + seconds_write;
  const std::string line = fmt::format("{}: {}; {:.3g} s", input.path, describe(summary), seconds);
  if (summary_is_output) {
    Status printed = print(line + "\n");
    if (!printed) return std::move(printed).error();
  } else if (summary_on_terminal) {
    say("{} -> {}\n", line, output == "-" ? "standard output" : output);
  }
  if (common.stats) say_text(table(stats(file, summary, seconds_write)));
  return exit_success;
}

Status smooth_boundaries(ShapeFile& file, double distance, const InputOptions& input) {
  for (std::size_t i = 0; i < file.contours.size(); ++i) {
    const auto fit = [&]() -> Result<Shape> {
      for (Contour& contour : file.contours[i]) {
        auto curve = fit_smooth_contour(contour.points, distance);
        if (!curve) return std::move(curve).error();
        contour = std::move(curve).value();
      }
      const auto rings = approximate_by_arcs(file.contours[i], input.arcs);
      if (!rings) return rings.error();
      return build_shape(*rings);
    };
    auto shape = fit();
    if (!shape) return at_feature(std::move(shape).error(), input.path, i);
    file.shapes[i] = std::move(shape).value();
  }
  return success();
}

}  // namespace medial::cli
