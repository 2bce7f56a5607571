// medial rebuild and medial smooth: from axes back to shapes.

#include "medial/rebuild.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <tuple>
#include <utility>

#include "cli/commands.h"
#include "cli/prune_options.h"
#include "cli/stored_axes.h"
#include "cli/terminal.h"
#include "medial/io/image.h"
#include "medial/io/write.h"
#include "medial/match.h"
#include "medial/query.h"
#include "medial/shape_distance.h"

namespace medial::cli {
namespace {

struct RebuildArguments {
  InputOptions input;
  CommonOptions common;
  PruneArguments prune;  ///< of smooth
  std::string output;
  std::string format;
  bool tangents = false;
  std::uint64_t points = 0;
  bool polygon = false;
  std::uint32_t pixels = 0;
  std::string against;
  double width = 1024;
  Options options;  ///< of smooth: exterior and margin
};

/// What was rebuilt, summed over the features, and how far it is from what it should be.
struct Told {
  double area = 0;
  std::uint64_t vertices = 0, medial_points = 0, crossings = 0;
  bool compared = false;
  ShapeDistance distance;
};

/// The axes of what lies around a file's shapes, in a frame. The shapes go to `before`.
Result<AxisFile> axes_outside(const RebuildArguments& arguments, std::vector<Shape>& before) {
  const auto& [input, common] = std::tie(arguments.input, arguments.common);
  auto file = load_shapes(input, common.threads);
  if (!file) return std::move(file).error();
  print_notes(*file, input, common);
  for (std::size_t i = 0; i < file->shapes.size(); ++i) {
    Shape& shape = file->shapes[i];
    if (arguments.prune.specks > 0) shape = without_specks(shape, arguments.prune.specks);
    auto around = surroundings(shape, arguments.options.margin);
    if (!around) return at_feature(std::move(around).error(), input.path, i);
    before.push_back(std::exchange(shape, std::move(around).value()));
  }
  return compute_axes(std::move(file).value(), input.path, common);
}

/// The shape that these surroundings are of: what their loops enclose but the frame's, which
/// reaches furthest to the left.
Result<Shape> without_frame(const Shape& around) {
  std::vector<Ring> rings = rings_of(around);
  const auto leftmost = [](const Ring& ring) {
    return std::ranges::min(ring.points, {}, &Vec2::x).x;
  };
  rings.erase(std::ranges::min_element(rings, {}, leftmost));
  for (Ring& ring : rings) ring.role = RingRole::any;  // holes around the shape are its outer loops
  return build_shape(rings);
}

Result<std::vector<Shape>> rebuild_all(const AxisFile& axes, const RebuildArguments& arguments,
                                       Told& told) {
  const auto& items = axes.native.items;
  std::vector<Shape> shapes(items.size());
  std::vector<RebuildReport> reports(items.size());
  std::vector<double> weights;
  for (const AxisItem& item : items) weights.push_back(static_cast<double>(item.axis.edges.size()));
  Status done =
      for_each_feature(weights, arguments.common.threads, [&](std::size_t i, int) -> Status {
        const MedialAxis& axis = items[i].axis;
        RebuildOptions options;
        if (arguments.tangents) options.by = RebuildBy::tangents;
        options.points = arguments.points;
        if (arguments.polygon) {
          const Shape& shape = items[i].shape;
          double size = 0;
          for (const Node& node : axis.nodes)
            size = std::max(size, distance(node.disk.center, axis.nodes[0].disk.center));
          if (!shape.points.empty()) size = diagonal(bounding_box(shape));
          options.chord = arguments.common.chord * size;
        }
        auto shape = rebuild(axis, options, &reports[i]);
        if (shape && arguments.options.exterior) shape = without_frame(*shape);
        if (!shape) return at_feature(std::move(shape).error(), arguments.input.path, i);
        shapes[i] = std::move(shape).value();
        return success();
      });
  if (!done) return std::move(done).error();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    told.area += area(shapes[i]);
    told.vertices += shapes[i].points.size();
    told.medial_points += reports[i].medial_points;
    told.crossings += reports[i].crossings;
  }
  return shapes;
}

/// The largest distances of all features, the sums of their areas.
Status compare(const std::vector<Shape>& shapes, const std::vector<Shape>& others,
               const std::string& path, int threads, Told& told) {
  if (shapes.size() != others.size()) {
    return error_at(ErrorCode::malformed, path,
                    fmt::format("holds {} where there are {} rebuilt",
                                counted(others.size(), "feature"), shapes.size()));
  }
  std::vector<ShapeDistance> distances(shapes.size());
  Status done = for_each_feature(weights_of(shapes), threads, [&](std::size_t i, int) -> Status {
    distances[i] = shape_distance(shapes[i], others[i]);
    return success();
  });
  if (!done) return done;
  told.compared = true;
  for (const ShapeDistance& one : distances) {
    if (one.hausdorff() >= told.distance.hausdorff()) told.distance.worst = one.worst;
    told.distance.area += one.area;
    told.distance.other_area += one.other_area;
    told.distance.from_first = std::max(told.distance.from_first, one.from_first);
    told.distance.from_second = std::max(told.distance.from_second, one.from_second);
  }
  return success();
}

Status write_pixels(const AxisFile& axes, const RebuildArguments& arguments, Json& object) {
  if (axes.native.items.size() != 1) {
    return error_at(ErrorCode::unsupported, arguments.input.path,
                    "--pixels takes one feature only");
  }
  auto image = rebuild_image(axes.native.items[0].axis, arguments.pixels, axes.native.y_down);
  if (!image) return at_feature(std::move(image).error(), arguments.input.path, 0);
  io::ImageFile placed;
  placed.crs_wkt = axes.native.crs_wkt;
  const double h = image->pixel;
  const double height = h * image->image.height();
  placed.placement =
      axes.native.y_down
          ? io::PixelPlacement{image->corner.x, h, 0, image->corner.y, 0, h}
          : io::PixelPlacement{image->corner.x, h, 0, image->corner.y + height, 0, -h};
  object["pixel"] = h;
  object["pixels"] = image->image.count();
  object["area"] = static_cast<double>(image->image.count()) * h * h;
  return io::write_image(arguments.output, image->image, placed);
}

Status tell(const Told& told, const RebuildArguments& arguments, Json object, const Json& seconds) {
  const CommonOptions& common = arguments.common;
  if (arguments.pixels == 0) {
    object["vertices"] = told.vertices;
    object["area"] = told.area;
    if (told.medial_points > 0) object["medial_points"] = told.medial_points;
    if (told.crossings > 0) object["crossings"] = told.crossings;
  }
  if (told.compared) {
    object["against"] = {
        {"input", arguments.against.empty() ? arguments.input.path : arguments.against},
        {"area", told.distance.other_area},
        {"area_error", told.distance.area - told.distance.other_area},
        {"hausdorff", told.distance.hausdorff()},
        {"x", told.distance.worst.x},
        {"y", told.distance.worst.y}};
  }
  const Json costs = {{"seconds", seconds}, {"peak_bytes", peak_bytes()}};
  if (common.json) {
    if (common.stats) object.update(costs);
    return print(object);
  }
  if (common.stats) say_text(table(costs));
  const bool to_screen = arguments.output.empty() || told.compared;
  if (arguments.output == "-" || common.quiet || !to_screen) return success();
  return print(table(object));
}

Result<int> run(const RebuildArguments& arguments, bool smooths) {
  const auto& [input, common, how, output, format, tangents, points, polygon, pixels, against,
               width, around] = arguments;
  if (pixels > 0 && (output.empty() || output == "-"))
    return invalid_option("--pixels needs -o with the name of an image");
  if (pixels > 0 && !against.empty()) return invalid_option("--against is not for --pixels");
  const auto options = prune_options(how);
  if (!options) return options.error();
  Status writable = check_output(
      output, format, pixels > 0 ? image_formats : io::formats_of(io::DocumentKind::shapes),
      input.path, common.json);
  if (!writable) return std::move(writable).error();
  std::vector<Shape> before;
  auto axes =
      around.exterior ? axes_outside(arguments, before) : load_axes(input, common, how.specks);
  if (!axes) return std::move(axes).error();
  const Stopwatch watch;
  Json object = {{"input", input.path}};
  if (!output.empty()) object["output"] = output;
  if (smooths) {
    if (!around.exterior)
      for (const AxisItem& item : axes->native.items) before.push_back(item.shape);
    const auto report = prune_all(*axes, *options, common.threads);
    if (!report) return report.error();
    object["measure"] = name_of(options->measure);
    object["threshold"] = report->threshold;
    object["branches_before"] = report->branches_before;
    object["branches"] = report->branches;
  }
  Told told;
  if (pixels > 0) {
    Status written = write_pixels(*axes, arguments, object);
    if (!written) return std::move(written).error();
  } else {
    auto shapes = rebuild_all(*axes, arguments, told);
    if (!shapes) return std::move(shapes).error();
    const double seconds = watch.seconds();
    if (!against.empty()) {
      InputOptions other = input;
      other.path = against;
      auto file = load_shapes(other, common.threads);
      if (!file) return std::move(file).error();
      Status done = compare(*shapes, file->shapes, against, common.threads, told);
      if (!done) return std::move(done).error();
    } else if (smooths && (common.json || output.empty())) {
      Status done = compare(*shapes, before, input.path, common.threads, told);
      if (!done) return std::move(done).error();
    }
    if (!output.empty()) {
      auto file = same_frame<ShapeItem>(axes->native);
      io::WriteOptions write;
      write.chord = common.chord;
      write.width = width;
      for (std::size_t i = 0; i < shapes->size(); ++i)
        file.items.push_back(
            {std::move((*shapes)[i]), std::move(axes->native.items[i].attributes)});
      Status written = io::write_shapes(output, format, file, write);
      if (!written) return std::move(written).error();
    }
    Status printed = tell(told, arguments, std::move(object),
                          {{"read", axes->seconds_read},
                           {"shape", axes->seconds_shape},
                           {"axis", axes->seconds_axis},
                           {smooths ? "smooth" : "rebuild", seconds}});
    if (!printed) return std::move(printed).error();
    return exit_success;
  }
  Status printed = tell(told, arguments, std::move(object),
                        {{"read", axes->seconds_read},
                         {"shape", axes->seconds_shape},
                         {"axis", axes->seconds_axis},
                         {"rebuild", watch.seconds()}});
  if (!printed) return std::move(printed).error();
  return exit_success;
}

void add_switches(CLI::App& command, RebuildArguments& arguments, bool smooths) {
  add_input_options(command, arguments.input);
  add_output_options(command, arguments.output, arguments.format,
                     io::formats_of(io::DocumentKind::shapes));
  command.add_flag("--polygon", arguments.polygon,
                   "Straight edges only: arcs become chords within --chord.");
  add_width_option(command, arguments.width);
  command
      .add_option("--against", arguments.against,
                  "Measure area and Hausdorff distance against these shapes.")
      ->check(a_name())
      ->option_text("SHAPES");
  if (!smooths) {
    CLI::Option* tangents =
        command.add_flag("--tangents", arguments.tangents,
                         "Polygons by tangents of disks instead, as of smooth sampled axes.");
    command
        .add_option("--points", arguments.points,
                    "With --tangents: points on the axis, about (default: the samples, or\n"
                    "1000 of an exact axis).")
        ->check(in_range(3, 10'000'000))
        ->option_text("N");
    command
        .add_option("--pixels", arguments.pixels,
                    fmt::format("The union of the disks as an image, its longer side so many\n"
                                "pixels: {}",
                                image_formats))
        ->check(in_range(1, 32768))
        ->option_text("N")
        ->excludes(tangents);
  }
  if (smooths) {
    add_prune_options(command, arguments.prune);
    add_exterior_options(
        command, arguments.options,
        "Fill what sticks in instead: prune the axis of what lies around the shape and\n"
        "in its holes, within a frame.");
  }
  add_common_options(command, arguments.common);
}

}  // namespace

Command make_rebuild_command(CLI::App& program) {
  auto arguments = std::make_shared<RebuildArguments>();
  CLI::App* command = program.add_subcommand("rebuild", "The shape that an axis stands for.");
  add_switches(*command, *arguments, false);
  command->footer(
      "From an exact axis the boundary comes back exactly, as segments and arcs; where it\n"
      "was pruned, arcs of the last disks close it. Sampled axes give polygons. INPUT is\n"
      "medial's own .json with axes; of shapes the axis is computed first.\n"
      "\n"
      "Examples:\n"
      "  medial rebuild plan.json -o again.svg --against plan.geojson\n"
      "  medial axis gear.svg -o - | medial prune - --angle 60 -o - |\n"
      "    medial rebuild - -o smooth.svg\n"
      "  medial rebuild ridge.json --against plan.wkt --json\n"
      "  medial rebuild plan.json --pixels 2000 -o plan.png");
  return {command, [arguments] { return run(*arguments, false); }};
}

Command make_smooth_command(CLI::App& program) {
  auto arguments = std::make_shared<RebuildArguments>();
  CLI::App* command = program.add_subcommand("smooth", "Remove what does not matter from shapes.");
  add_switches(*command, *arguments, true);
  command->footer(
      "Computes the axis, prunes it as `medial prune` does, and rebuilds the shape: what\n"
      "is removed is replaced by the arcs of the disks that it stood on (Ho and Dyer).\n"
      "Only what sticks out is removed; notches stay, and with --exterior the other way\n"
      "round. Parts and holes stay.\n"
      "\n"
      "Examples:\n"
      "  medial smooth coast.wkt.gz -o calm.geojson\n"
      "  medial smooth scan.svg --significance 0.2 -o clean.svg\n"
      "  medial smooth plan.wkt --radius 0.3 --json\n"
      "  medial smooth plan.wkt --exterior --significance 0.5 -o filled.svg");
  return {command, [arguments] { return run(*arguments, true); }};
}

}  // namespace medial::cli
