// medial info: the contents of a file of shapes or axes.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"

namespace medial::cli {
namespace {

struct ShapeSummary {
  std::uint64_t components = 0;
  std::uint64_t loops = 0;
  std::uint64_t holes = 0;
  std::uint64_t vertices = 0;
  double area = 0;
  Box extent;
};

template <class Item>
ShapeSummary summarize_shapes(const Document<Item>& file) {
  ShapeSummary summary;
  Box extent = Box::nothing();
  for (const Item& item : file.items) {
    const Shape& shape = item.shape;
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

void add_rows(Rows& table, const ShapeSummary& summary) {
  table.add("outer rings", summary.loops - summary.holes);
  table.add("holes", summary.holes);
  table.add("vertices", summary.vertices);
  table.add("extent",
            fmt::format("x {:.10g} to {:.10g}, y {:.10g} to {:.10g}", summary.extent.low.x,
                        summary.extent.high.x, summary.extent.low.y, summary.extent.high.y));
  table.add("area", fmt::format("{:.10g}", summary.area));
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

std::string unit_text(Unit unit) {
  return unit == Unit::unknown ? "unknown" : std::string(name_of(unit));
}

/// Invalid polygons are an error, which main() reports.
Result<int> summarize_polygons(const FileArguments& arguments) {
  auto loaded = load_shapes(arguments.input, arguments.common);
  if (!loaded) return std::move(loaded).error();
  const auto& [file, of_image, report, phases] = *loaded;
  const ShapeReport& cleaned = report.shapes;
  const ArcReport& arcs = report.arcs;
  const ShapeSummary summary = summarize_shapes(file);
  Json object = {{"input", arguments.input.path},
                 {"kind", "polygons"},
                 {"valid", true},
                 {"features", file.items.size()}};
  add_members(object, summary);
  object["input_rings"] = cleaned.input_rings;
  object["input_points"] = cleaned.input_points;
  object["cleaned"] = to_json(cleaned);
  if (arcs.pieces > 0) object["arcs"] = to_json(arcs);
  object["notes"] = file.notes;
  object["crs"] = crs_name(file.crs_wkt);
  object["geographic"] = file.geographic;
  object["unit"] = name_of(file.unit);

  Rows table(20);
  table.add("polygons", "valid");
  table.add("features", file.items.size());
  add_rows(table, summary);
  table.add("as read", fmt::format("{}, {}", counted(cleaned.input_rings, "ring"),
                                   counted(cleaned.input_points, "point")));
  ShapeReport worth_saying = cleaned;
  if (arcs.pieces > 0)
    worth_saying.unclosed_rings = worth_saying.reversed_rings = 0;  // of contours
  const std::string cleaned_text = describe(worth_saying);
  table.add("cleaned", cleaned_text.empty() ? "nothing" : cleaned_text);
  if (arcs.pieces > 0) {
    table.add("curves", fmt::format("{} as {} and {}, within {:.3g}", counted(arcs.pieces, "piece"),
                                    counted(arcs.arcs, "arc"), counted(arcs.segments, "segment"),
                                    arcs.largest_error));
  }
  table.add("coordinates", crs_text(file.crs_wkt, file.geographic));
  table.add("unit", unit_text(file.unit));
  return finish(arguments.common, std::move(object), phases, table.text());
}

/// The value if all axes agree, else "differs by feature"; empty where there are none.
template <class Get>
std::string common_value(const Document<AxisItem>& file, Get get) {
  if (file.items.empty()) return {};
  const std::string first = get(file.items.front().axis);
  const bool same = std::all_of(file.items.begin(), file.items.end(),
                                [&](const auto& item) { return get(item.axis) == first; });
  return same ? first : "differs by feature";
}

std::string nodes_text(const AxisSummary& axes) {
  return fmt::format("{} ({}, {}, {})", axes.nodes(), counted(axes.leaves, "leaf", "leaves"),
                     counted(axes.site_changes, "change of sites", "changes of sites"),
                     counted(axes.branchings, "branching"));
}

std::string deepest_text(const AxisSummary& axes) {
  const Disk& disk = axes.deepest;
  return fmt::format(
      "radius {:.10g} at ({:.10g}, {:.10g}){}", disk.radius, disk.center.x, disk.center.y,
      axes.features > 1 ? fmt::format(", feature {}", axes.deepest_feature) : std::string());
}

Result<int> summarize_axes(const FileArguments& arguments) {
  Phases phases;
  const auto file = io::read_native(arguments.input.path, arguments.input.source.read);
  if (!file) return file.error();
  phases.end("read");
  // Shapes and contours, whose axes are still to be computed.
  if (std::ranges::any_of(file->items, [](const auto& item) {
        return !item.contours.empty() || item.axis.method.empty();
      }))
    return summarize_polygons(arguments);
  const AxisSummary axes = summarize(*file);
  const ShapeSummary shapes = summarize_shapes(*file);
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
  object["unit"] = name_of(file->unit);

  Rows table(20);
  table.add("medial axes", axes.features);
  if (!method.empty()) table.add("method", method);
  table.add("tolerance", fmt::format("{:.3g}", tolerance));
  if (resolution > 0) table.add("resolution", fmt::format("{:.3g}", resolution));
  table.add("sites", axes.sites);
  table.add("nodes", nodes_text(axes));
  table.add("edges", axes.edges);
  table.add("branches", axes.branches);
  table.add("length", fmt::format("{:.10g}", axes.length));
  if (axes.deepest.radius >= 0) table.add("deepest disk", deepest_text(axes));
  add_rows(table, shapes);
  table.add("coordinates", crs_text(file->crs_wkt, false));
  table.add("unit", unit_text(file->unit));
  return finish(arguments.common, std::move(object), phases, table.text());
}

Result<int> run_info(const FileArguments& arguments) {
  const InputOptions& input = arguments.input;
  const bool shapes = !input.source.text.empty() || !io::is_native(input.path);
  return shapes ? summarize_polygons(arguments) : summarize_axes(arguments);
}

}  // namespace

Command make_info_command(CLI::App& program) {
  auto arguments = std::make_shared<FileArguments>();
  CLI::App* command = program.add_subcommand("info", "Summarise a file of polygons or axes.");
  add_input_options(*command, arguments->input);
  arguments->input.source.read.smooth_contour = false;  // counts and areas are those of the pixels
  add_common_options(*command, arguments->common);
  command->footer(
      "For polygons: features, outer rings, holes, vertices, extent, area, corrections,\n"
      "and the coordinate reference system; invalid polygons are an error (exit status 2)\n"
      "that names the place. For axes: nodes by kind, edges, branches, length and the\n"
      "deepest disk, which is the maximum inscribed circle.\n"
      "Lengths are in the units of the file.\n"
      "\n"
      "Examples:\n"
      "  medial info country.shp\n"
      "  medial info --json plan.json");
  return command_of(command, arguments, run_info);
}

}  // namespace medial::cli
