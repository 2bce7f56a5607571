// medial info: what a file of shapes or of axes holds.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/costs.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

struct InfoArguments {
  InputOptions input;
  CommonOptions common;
};

/// Adds lines of a name and a value.
class Table {
 public:
  void row(const char* name, const std::string& value) {
    text_ += fmt::format("{:<20}{}\n", name, value);
  }
  void row(const char* name, std::uint64_t count) { row(name, fmt::format("{}", count)); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

struct ShapeSummary {
  std::uint64_t components = 0;
  std::uint64_t loops = 0;
  std::uint64_t holes = 0;
  std::uint64_t vertices = 0;
  double area = 0;
  Box extent;
};

template <class Shapes>
ShapeSummary summarize_shapes(const Shapes& shapes) {
  ShapeSummary summary;
  Box extent = Box::nothing();
  for (const Shape& shape : shapes) {
    summary.components += shape.component_count();
    summary.loops += shape.loop_count();
    summary.holes += shape.hole_count();
    summary.vertices += shape.points.size();
    summary.area += area(shape);
    if (!shape.points.empty()) extent.add(bounding_box(shape));
  }
  if (!extent.is_nothing()) summary.extent = extent;
  return summary;
}

void add_rows(Table& table, const ShapeSummary& summary) {
  table.row("outer rings", summary.loops - summary.holes);
  table.row("holes", summary.holes);
  table.row("vertices", summary.vertices);
  table.row("extent",
            fmt::format("x {:.10g} to {:.10g}, y {:.10g} to {:.10g}", summary.extent.low.x,
                        summary.extent.high.x, summary.extent.low.y, summary.extent.high.y));
  table.row("area", fmt::format("{:.10g}", summary.area));
}

void add_members(Json& object, const ShapeSummary& summary) {
  object["components"] = summary.components;
  object["rings"] = summary.loops;
  object["holes"] = summary.holes;
  object["vertices"] = summary.vertices;
  object["extent"] = to_json(summary.extent);
  object["area"] = summary.area;
}

std::string crs_text(const std::string& wkt, bool geographic) {
  const std::string name = one_line(crs_name(wkt));
  return (name.empty() ? "unknown" : name) + (geographic ? " (longitude and latitude)" : "");
}

/// Prints what was found as an object or as a table, with the costs of finding it on request.
Result<int> tell(const CommonOptions& common, Json object, const Table& table,
                 const Json& seconds) {
  const Json costs = costs_of(common, seconds);
  if (common.json && common.stats) object.update(costs);
  Status printed = common.json ? print(object) : print(table.text());
  if (!printed) return std::move(printed).error();
  print_costs(common, costs);
  return exit_success;
}

/// Of what is no shape, the error tells; main() reports it.
Result<int> tell_shapes(const InfoArguments& arguments) {
  auto file = load_shapes(arguments.input, arguments.common.threads);
  if (!file) return std::move(file).error();
  print_notes(*file, arguments.input, arguments.common);
  const ShapeSummary summary = summarize_shapes(file->shapes);
  Json object = {{"input", arguments.input.path},
                 {"kind", "polygons"},
                 {"valid", true},
                 {"features", file->shapes.size()}};
  add_members(object, summary);
  object["input_rings"] = file->report.input_rings;
  object["input_points"] = file->report.input_points;
  object["cleaned"] = to_json(file->report);
  if (file->arcs.pieces > 0) object["arcs"] = to_json(file->arcs);
  object["notes"] = file->notes;
  object["crs"] = crs_name(file->crs_wkt);
  object["geographic"] = file->geographic;

  Table table;
  table.row("polygons", "valid");
  table.row("features", file->shapes.size());
  add_rows(table, summary);
  table.row("as read", fmt::format("{}, {}", counted(file->report.input_rings, "ring"),
                                   counted(file->report.input_points, "point")));
  const std::string mended = describe(file->report);
  table.row("cleaned", mended.empty() ? "nothing" : mended);
  if (file->arcs.pieces > 0) {
    table.row("curves",
              fmt::format("{} as {} and {}, within {:.3g}", counted(file->arcs.pieces, "piece"),
                          counted(file->arcs.arcs, "arc"), counted(file->arcs.segments, "segment"),
                          file->arcs.largest_error));
  }
  table.row("coordinates", crs_text(file->crs_wkt, file->geographic));
  return tell(arguments.common, std::move(object), table,
              {{"read", file->seconds_read}, {"shape", file->seconds_shape}});
}

/// One value if all axes agree, or else how many there are.
template <class Get>
std::string common_value(const Document<AxisItem>& file, Get get) {
  const std::string first = get(file.items.front().axis);
  const bool same = std::all_of(file.items.begin(), file.items.end(),
                                [&](const auto& item) { return get(item.axis) == first; });
  return same ? first : "differs by feature";
}

Result<int> tell_axes(const InfoArguments& arguments) {
  const Stopwatch reading;
  const auto file = io::read_native(arguments.input.path);
  if (!file) return file.error();
  const double seconds_read = reading.seconds();
  if (file->items.empty()) {
    return error_at(ErrorCode::empty, arguments.input.path, "holds no axis");
  }
  if (holds_contours(*file)) return tell_shapes(arguments);
  const AxisSummary axes = summarize(*file);
  std::vector<std::reference_wrapper<const Shape>> shape_list;
  for (const AxisItem& item : file->items) shape_list.emplace_back(item.shape);
  const ShapeSummary shapes = summarize_shapes(shape_list);
  const std::string method = common_value(*file, [](const MedialAxis& a) { return a.method; });
  double tolerance = 0;
  double resolution = 0;
  for (const AxisItem& item : file->items) {
    tolerance = std::max(tolerance, item.axis.tolerance);
    resolution = std::max(resolution, item.axis.resolution);
  }

  Json object = {{"input", arguments.input.path}, {"kind", "axis"}, {"features", axes.features}};
  object["method"] = method;
  object["tolerance"] = tolerance;
  object["resolution"] = resolution;
  object["sites"] = axes.sites;
  object["nodes"] = {
      {"leaf", axes.leaves}, {"site_change", axes.site_changes}, {"branching", axes.branchings}};
  object["edges"] = axes.edges;
  object["branches"] = axes.branches;
  object["length"] = axes.length;
  object["deepest"] = to_json(axes)["deepest"];
  add_members(object["shape"], shapes);
  object["crs"] = crs_name(file->crs_wkt);

  Table table;
  table.row("medial axes", axes.features);
  table.row("method", method);
  table.row("tolerance", fmt::format("{:.3g}", tolerance));
  if (resolution > 0) table.row("resolution", fmt::format("{:.3g}", resolution));
  table.row("sites", axes.sites);
  table.row("nodes",
            fmt::format("{} ({}, {}, {})", axes.nodes(), counted(axes.leaves, "leaf", "leaves"),
                        counted(axes.site_changes, "change of sites", "changes of sites"),
                        counted(axes.branchings, "branching")));
  table.row("edges", axes.edges);
  table.row("branches", axes.branches);
  table.row("length", fmt::format("{:.10g}", axes.length));
  if (axes.deepest.radius >= 0) {
    const std::string where =
        axes.features > 1 ? fmt::format(", feature {}", axes.deepest_feature) : std::string();
    table.row("deepest disk",
              fmt::format("radius {:.10g} at ({:.10g}, {:.10g}){}", axes.deepest.radius,
                          axes.deepest.center.x, axes.deepest.center.y, where));
  }
  add_rows(table, shapes);
  table.row("coordinates", crs_text(file->crs_wkt, false));
  return tell(arguments.common, std::move(object), table, {{"read", seconds_read}});
}

Result<int> run_info(const InfoArguments& arguments) {
  if (!arguments.input.text.empty() || !io::is_native(arguments.input.path)) {
    return tell_shapes(arguments);
  }
  return tell_axes(arguments);
}

}  // namespace

Command make_info_command(CLI::App& program) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = program.add_subcommand("info", "Tell what a file of polygons or axes holds.");
  add_input_options(*command, arguments->input);
  add_common_options(*command, arguments->common);
  command->footer(
      "Of polygons: features, outer rings, holes, vertices, extent, area, what was\n"
      "cleaned, and the coordinate reference system; polygons that are not valid are an\n"
      "error (exit status 2) that names the place. Of axes: nodes by kind, edges,\n"
      "branches, length and the deepest disk, which is the maximum inscribed circle.\n"
      "Lengths are in the units of the file.\n"
      "\n"
      "Examples:\n"
      "  medial info country.shp\n"
      "  medial info --json plan.json");
  return {command, [arguments] { return run_info(*arguments); }};
}

}  // namespace medial::cli
