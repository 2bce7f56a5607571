// medial rebuild and medial smooth: from axes back to shapes.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>

#include "cli/commands.h"
#include "cli/prune_options.h"
#include "medial/features.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/query.h"
#include "medial/sides.h"
#include "medial/verify.h"

namespace medial::cli {
namespace {

struct RebuildArguments : FileArguments {
  PruneArguments prune;  ///< of smooth
  bool tangents = false;
  std::uint64_t points = 0;
  bool polygon = false;
  std::uint32_t pixels = 0;
  std::string against;
  Options options;  ///< of smooth: exterior and margin
};

/// The rebuilt shapes, and their distance from the reference.
struct Rebuilt {
  std::vector<Shape> shapes;
  std::uint64_t medial_points = 0, crossings = 0;  ///< summed over the features
  std::string compared_with;                       ///< a file
  std::size_t left_out = 0;                        ///< its features without an axis
  ShapeDistance distance;
};

InputOptions input_of(const RebuildArguments& arguments) {
  const std::string& against = arguments.against;
  return against.empty() ? arguments.input : first_input(arguments.input, against);
}

/// The axes of the exteriors of a file's shapes, in a rectangle. Moves the shapes to `before`.
Result<LoadedAxes> axes_outside(const RebuildArguments& arguments, Document<ShapeItem>& before) {
  const InputOptions input = input_of(arguments);
  const CommonOptions& common = arguments.common;
  auto loaded = load_shapes(input, common);
  if (!loaded) return std::move(loaded).error();
  before = std::move(loaded->file);
  const auto around_one = [&](std::size_t i, int) -> Result<ShapeItem> {
    ShapeItem& item = before.items[i];
    if (arguments.prune.specks > 0) item.shape = without_specks(item.shape, arguments.prune.specks);
    auto around = surroundings(item.shape, arguments.options.margin);
    if (!around) return std::move(around).error();
    return ShapeItem{std::move(around).value(), std::move(item.attributes)};
  };
  std::vector<std::string> left_out;
  auto around = map_features<ShapeItem>(before, weights_of(before), common.threads, around_one,
                                        skips(input, left_out));
  if (!around) return std::move(around).error();
  note_left_out(left_out, input, common);
  loaded->file = std::move(around).value();
  auto axes = compute_axes(std::move(loaded).value(), input, common);
  if (!axes) return axes;
  if (auto rest = without_axis(axes->file, input, before); !rest) return std::move(rest).error();
  return axes;
}

/// The shape with these surroundings: bounded by their loops without the rectangle, which is the
/// loop that reaches furthest to the left.
Result<Shape> inside_surroundings(const Shape& around) {
  std::vector<Ring> rings = rings_of(around);
  const auto leftmost = [](const Ring& ring) {
    return std::ranges::min(ring.points, {}, &Vec2::x).x;
  };
  rings.erase(std::ranges::min_element(rings, {}, leftmost));
  for (Ring& ring : rings) ring.role = RingRole::any;  // holes around the shape are its outer loops
  return build_shape(rings);
}

Result<Shape> rebuild_one(const AxisItem& item, double of_input, const RebuildArguments& arguments,
                          RebuildReport& report) {
  RebuildOptions options;
  options.corner_angle = corner_angle(arguments.common, of_input);
  if (arguments.tangents) options.by = RebuildBy::tangents;
  options.points = arguments.points;
  if (arguments.polygon) {
    double size = 0;
    for (const Node& node : item.axis.nodes)
      size = std::max(size, distance(node.disk.center, item.axis.nodes[0].disk.center));
    if (!item.shape.points.empty()) size = diagonal(bounding_box(item.shape));
    options.chord = arguments.common.chord * size;
  }
  auto shape = rebuild(item.axis, options, &report);
  if (shape && arguments.options.exterior) return inside_surroundings(*shape);
  return shape;
}

Result<Rebuilt> rebuild_all(const Document<AxisItem>& file, const RebuildArguments& arguments) {
  Rebuilt out;
  std::vector<RebuildReport> reports(file.items.size());
  auto shapes =
      map_items<Shape>(edge_weights_of(file), arguments.common.threads, [&](std::size_t i, int) {
        return rebuild_one(file.items[i], file.corner_angle, arguments, reports[i]);
      });
  if (!shapes) return std::move(shapes).error();
  out.shapes = std::move(shapes).value();
  for (const RebuildReport& report : reports) {
    out.medial_points += report.medial_points;
    out.crossings += report.crossings;
  }
  return out;
}

/// The largest distances of all features, the sums of their areas.
Status compare(Rebuilt& rebuilt, const std::vector<ShapeItem>& others, const std::string& path,
               int threads) {
  const std::vector<Shape>& shapes = rebuilt.shapes;
  if (shapes.size() != others.size()) {
    return error_at(ErrorCode::malformed, path,
                    fmt::format("holds {}, but {} were rebuilt", counted(others.size(), "feature"),
                                shapes.size()));
  }
  std::vector<double> weights;
  for (const Shape& shape : shapes) weights.push_back(static_cast<double>(shape.points.size()));
  const auto distances = map_items<ShapeDistance>(weights, threads, [&](std::size_t i, int) {
    return shape_distance(shapes[i], others[i].shape);
  });
  if (!distances) return distances.error();
  rebuilt.compared_with = path;
  ShapeDistance& sum = rebuilt.distance;
  for (const ShapeDistance& one : *distances) {
    if (one.hausdorff() >= sum.hausdorff()) sum.worst = one.worst;
    sum.area += one.area;
    sum.other_area += one.other_area;
    sum.from_first = std::max(sum.from_first, one.from_first);
    sum.from_second = std::max(sum.from_second, one.from_second);
  }
  return success();
}

Status compare_with_file(Rebuilt& rebuilt, const Document<AxisItem>& axes,
                         const RebuildArguments& arguments) {
  const InputOptions input = second_input(arguments.input, arguments.against);
  CommonOptions quiet = arguments.common;
  quiet.quiet = true;
  auto loaded = load_shapes(input, quiet);
  if (!loaded) return std::move(loaded).error();
  const auto left_out =
      refused_without_axis(axes, arguments.input.path, input, arguments.common, loaded->file);
  if (!left_out) return left_out.error();
  rebuilt.left_out = *left_out;
  return compare(rebuilt, loaded->file.items, input.path, arguments.common.threads);
}

Status write_pixels(const Document<AxisItem>& axes, const RebuildArguments& arguments,
                    Json& object) {
  if (axes.items.size() != 1) {
    return error_at(ErrorCode::unsupported, arguments.input.path,
                    "--pixels takes one feature only");
  }
  auto image = rebuild_image(axes.items[0].axis, arguments.pixels, axes.y_down);
  if (!image) {
    image.error().place.feature = 0;
    return std::move(image).error();
  }
  io::ImageFile placed;
  placed.crs_wkt = axes.crs_wkt;
  placed.placement = image->placement;
  const double h = image->placement[1];
  object["pixel"] = h;
  object["pixels"] = image->image.count();
  object["area"] = static_cast<double>(image->image.count()) * h * h;
  return io::write_image(arguments.output, arguments.format, image->image, placed);
}

void add_measures(const Rebuilt& rebuilt, Json& object) {
  std::uint64_t vertices = 0;
  double sum_area = 0;
  for (const Shape& shape : rebuilt.shapes) {
    vertices += shape.points.size();
    sum_area += area(shape);
  }
  object["vertices"] = vertices;
  object["area"] = sum_area;
  if (rebuilt.medial_points > 0) object["medial_points"] = rebuilt.medial_points;
  if (rebuilt.crossings > 0) object["crossings"] = rebuilt.crossings;
  if (rebuilt.compared_with.empty()) return;
  const ShapeDistance& distance = rebuilt.distance;
  object["against"] = {{"input", rebuilt.compared_with},
                       {"without_axis", rebuilt.left_out},
                       {"area", distance.other_area},
                       {"area_error", distance.area - distance.other_area},
                       {"hausdorff", distance.hausdorff()},
                       {"x", distance.worst.x},
                       {"y", distance.worst.y}};
}

Status write_rebuilt(Rebuilt& rebuilt, Document<AxisItem>& axes,
                     const RebuildArguments& arguments) {
  Document<ShapeItem> file{axes, {}};
  io::WriteOptions write = arguments.write;
  write.chord = arguments.common.chord;
  for (std::size_t i = 0; i < rebuilt.shapes.size(); ++i)
    file.items.push_back({std::move(rebuilt.shapes[i]), std::move(axes.items[i].attributes)});
  return io::write_shapes(arguments.output, arguments.format, file, write);
}

/// The printed table, with the place of the Hausdorff distance in its row.
std::string rows_of(Json object) {
  if (const auto against = object.find("against"); against != object.end()) {
    Json& rows = *against;
    rows["hausdorff"] = fmt::format("{:.6g} at ({:.6g}, {:.6g})", rows["hausdorff"].get<double>(),
                                    rows["x"].get<double>(), rows["y"].get<double>());
    rows.erase("x");
    rows.erase("y");
  }
  return table(object);
}

Result<int> finish_rebuild(const RebuildArguments& arguments, Json object, const Phases& phases,
                           bool compared) {
  const bool to_screen = arguments.output.empty() || compared;
  const bool printed = arguments.output != "-" && !arguments.common.quiet && to_screen;
  const std::string text = printed ? rows_of(object) : std::string();
  return finish(arguments.common, std::move(object), phases, text);
}

Status check(const RebuildArguments& arguments) {
  const bool pixels = arguments.pixels > 0;
  if (pixels && (arguments.output.empty() || arguments.output == "-"))
    return invalid_option("--pixels needs -o with the name of an image");
  if (pixels && !arguments.against.empty()) return invalid_option("--against is not for --pixels");
  if (arguments.input.path == "-" && arguments.against == "-")
    return invalid_option("INPUT and --against cannot both be standard input");
  const std::string formats = pixels ? image_formats : io::formats_of(io::DocumentKind::shapes);
  if (Status possible = arguments.against.empty() ? success()
                                                  : check_output(arguments.output, arguments.format,
                                                                 formats, arguments.against, false);
      !possible)
    return possible;
  return check_output(arguments, formats);
}

Result<int> run(const RebuildArguments& arguments, bool smooths) {
  const InputOptions input = input_of(arguments);
  const CommonOptions& common = arguments.common;
  const auto options = prune_options(arguments.prune);
  if (!options) return options.error();
  if (Status possible = check(arguments); !possible) return std::move(possible).error();
  Document<ShapeItem> before;
  auto axes = arguments.options.exterior ? axes_outside(arguments, before)
                                         : load_axes(input, common, arguments.prune.specks);
  if (!axes) return std::move(axes).error();
  Document<AxisItem>& file = axes->file;
  Json object = {{"input", input.path}, {"unit", name_of(file.unit)}};
  if (!arguments.output.empty()) object["output"] = arguments.output;
  if (smooths) {
    if (!arguments.options.exterior)
      for (const AxisItem& item : file.items) before.items.push_back({item.shape, {}});
    const auto report = prune_all(file, *options, common.threads);
    if (!report) return report.error();
    object["measure"] = name_of(options->measure);
    object["threshold"] = report->threshold;
    object["branches_before"] = report->branches_before;
    object["branches"] = report->branches;
  }
  if (arguments.pixels > 0) {
    Status written = write_pixels(file, arguments, object);
    if (!written) return std::move(written).error();
    axes->phases.end("rebuild");
    return finish_rebuild(arguments, std::move(object), axes->phases, false);
  }
  auto rebuilt = rebuild_all(file, arguments);
  if (!rebuilt) return std::move(rebuilt).error();
  axes->phases.end(smooths ? "smooth" : "rebuild");
  Status done = success();
  if (!arguments.against.empty())
    done = compare_with_file(*rebuilt, file, arguments);
  else if (smooths && (common.json || arguments.output.empty()))
    done = compare(*rebuilt, before.items, input.path, common.threads);
  if (!done) return std::move(done).error();
  add_measures(*rebuilt, object);
  if (!arguments.output.empty()) done = write_rebuilt(*rebuilt, file, arguments);
  if (!done) return std::move(done).error();
  return finish_rebuild(arguments, std::move(object), axes->phases,
                        !rebuilt->compared_with.empty());
}

Result<int> run_rebuild(const RebuildArguments& arguments) { return run(arguments, false); }
Result<int> run_smooth(const RebuildArguments& arguments) { return run(arguments, true); }

void add_rebuild_options(CLI::App& command, RebuildArguments& arguments) {
  CLI::Option* tangents =
      command.add_flag("--tangents", arguments.tangents,
                       "Make polygons from tangents of disks instead (for smooth sampled axes).");
  add_value(command, "--points", arguments.points, "N", in_range(3, 10'000'000),
            "With --tangents: the approximate number of points on the axis (default:\n"
            "the samples, or 1000 on an exact axis).");
  add_value(command, "--pixels", arguments.pixels, "N", in_range(1, 32768),
            fmt::format("The union of the disks as an image with N pixels along the\n"
                        "shape's longer side and a margin of one pixel: {}",
                        image_formats))
      ->excludes(tangents);
}

void add_options(CLI::App& command, RebuildArguments& arguments, bool smooths) {
  add_input_options(command, arguments.input);
  add_output_options(command, arguments, io::formats_of(io::DocumentKind::shapes));
  command.add_flag("--polygon", arguments.polygon,
                   "Write polygons: replace arcs by chords within --chord.");
  add_width_option(command, arguments.write.width);
  add_value(command, "--against", arguments.against, "SHAPES", a_name(),
            "Measure area and Hausdorff distance against these shapes.");
  if (smooths) {
    add_prune_options(command, arguments.prune);
    add_exterior_options(command, arguments.options,
                         "Fill notches instead: prune the axis of the exterior, around the shape,\n"
                         "within a rectangle, and in its holes.");
  } else {
    add_rebuild_options(command, arguments);
  }
  add_common_options(command, arguments.common);
}

}  // namespace

Command make_rebuild_command(CLI::App& program) {
  auto arguments = std::make_shared<RebuildArguments>();
  CLI::App* command = program.add_subcommand("rebuild", "Rebuild the shape of an axis.");
  add_options(*command, *arguments, false);
  command->footer(
      "From an exact axis, rebuilds the exact boundary of segments and arcs; where the axis was\n"
      "pruned, arcs of the last disks close the boundary. Sampled axes give polygons. INPUT is\n"
      "medial's own .json or .safetensors with axes, or shapes, whose axes are computed first.\n"
      "\n"
      "Examples:\n"
      "  medial rebuild plan.json -o again.svg --against plan.geojson\n"
      "  medial axis gear.svg -o - | medial prune - --angle 60 -o - |\n"
      "    medial rebuild - -o smooth.svg\n"
      "  medial rebuild ridge.json --against plan.wkt --json\n"
      "  medial rebuild plan.json --pixels 2000 -o plan.png");
  return command_of(command, arguments, run_rebuild);
}

Command make_smooth_command(CLI::App& program) {
  auto arguments = std::make_shared<RebuildArguments>();
  CLI::App* command = program.add_subcommand("smooth", "Smooth shapes by pruning their axes.");
  add_options(*command, *arguments, true);
  command->footer(
      "Computes the axis, prunes it like `medial prune`, and rebuilds the shape: arcs of the\n"
      "disks at their base replace protrusions (Ho and Dyer). Notches stay; with --exterior,\n"
      "notches are filled and protrusions stay. Parts and holes always stay.\n"
      "\n"
      "Examples:\n"
      "  medial smooth coast.wkt.gz -o calm.geojson\n"
      "  medial smooth scan.svg --significance 0.2 -o clean.svg\n"
      "  medial smooth plan.wkt --radius 0.3 --json\n"
      "  medial smooth plan.wkt --exterior --significance 0.5 -o filled.svg");
  return command_of(command, arguments, run_smooth);
}

}  // namespace medial::cli
