// medial compare: all methods that take an input, side by side.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "cli/axis_distance.h"
#include "cli/commands.h"
#include "cli/common.h"
#include "cli/costs.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "medial/compute.h"
#include "medial/verify.h"

namespace medial::cli {
namespace {

struct CompareArguments {
  InputOptions input;
  CommonOptions common;
  std::string methods = "all";
  std::string output;
  double fit = 0;   ///< boundaries become smooth within this distance; 0: they do not
  Options options;  ///< exterior and margin
};

struct Row {
  std::string method;
  std::string refused;  ///< why there is nothing else
  bool failed = false;  ///< no axis of an input that the method takes, or one that is not verified
  double seconds = 0;
  std::uint64_t nodes = 0, branches = 0, parts = 0, cycles = 0;
  AxisDistance distance;
  double radius_error = 0;
  bool passed = false;
  bool unresolved = false;  ///< not passed only because the grid is too coarse for the shape
  std::string failure;
  MedialAxis axis;
};

/// The largest |distance to the boundary - radius|, over 1000 nodes or a few more.
double radius_error(const Shape& shape, const MedialAxis& axis) {
  double largest = 0;
  const std::size_t stride = axis.nodes.size() / 1000 + 1;
  for (std::size_t i = 0; i < axis.nodes.size(); i += stride) {
    const Disk& disk = axis.nodes[i].disk;
    largest = std::max(largest, std::abs(std::abs(clearance(shape, disk.center)) - disk.radius));
  }
  return largest;
}

/// One method's axis beside the exact one, of a shape or of its exterior, which is the same as the
/// axis of `region`. With `lenient` the method may refuse the kind of input.
Row measure(const Shape& shape, const Shape& region, const std::vector<Contour>& contours,
            const MedialAxis& exact, const CommonOptions& common, const Options& options,
            bool lenient) {
  Row row;
  row.method = name_of(options.method);
  const Stopwatch watch;
  auto axis = compute(shape, options, contours);
  row.seconds = watch.seconds();
  if (!axis) {
    row.refused = axis.error().text;
    row.failed = axis.error().code != ErrorCode::unsupported || !lenient;
    return row;
  }
  row.axis = std::move(axis).value();
  row.nodes = row.axis.nodes.size();
  row.branches = branches(row.axis).size();
  const Box box = bounding_box(region);
  const double size = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  row.distance = distance_between(row.axis, exact, 0.005 * size, 0.05 * size);
  row.radius_error = radius_error(region, row.axis);
  const Certificate certificate =
      verify(shape, row.axis, {.tolerance = common.tolerance, .corner_angle = common.corner_angle});
  row.parts = certificate.graph_parts;
  row.cycles = certificate.cycles;
  row.passed = certificate.passed;
  row.unresolved = is_of_pixels(row.method) && certificate.unresolved > 0 &&
                   certificate.unresolved == certificate.failures.size();
  row.failed = !row.passed && !row.unresolved;
  if (!certificate.failures.empty()) row.failure = certificate.failures.front();
  return row;
}

Json json_of(const Row& row) {
  if (!row.refused.empty()) return {{"method", row.method}, {"refused", row.refused}};
  return {{"method", row.method},
          {"seconds", row.seconds},
          {"nodes", row.nodes},
          {"branches", row.branches},
          {"hausdorff", std::max(row.distance.largest, row.distance.uncovered)},
          {"largest_distance", row.distance.largest},
          {"mean_distance", row.distance.mean},
          {"largest_uncovered", row.distance.uncovered},
          {"radius_error", row.radius_error},
          {"parts", row.parts},
          {"cycles", row.cycles},
          {"passed", row.passed},
          {"unresolved", row.unresolved},
          {"failure", row.failure}};
}

std::string table_of(const std::vector<Row>& rows) {
  std::string text = fmt::format("{:<10} {:>10} {:>8} {:>8} {:>10} {:>10} {:>10} {:>6} {:>7}  {}\n",
                                 "method", "seconds", "nodes", "branches", "Hausdorff", "mean",
                                 "radius", "parts", "cycles", "verified");
  for (const Row& row : rows) {
    if (!row.refused.empty()) {
      text += fmt::format("{:<10} {}\n", row.method, row.refused);
      continue;
    }
    text +=
        fmt::format("{:<10} {:>10.6f} {:>8} {:>8} {:>10.3g} {:>10.3g} {:>10.3g} {:>6} {:>7}  {}\n",
                    row.method, row.seconds, row.nodes, row.branches,
                    std::max(row.distance.largest, row.distance.uncovered), row.distance.mean,
                    row.radius_error, row.parts, row.cycles,
                    row.passed ? "yes" : (row.unresolved ? "unresolved: " : "NO: ") + row.failure);
  }
  return text;
}

/// The methods of a list, separated by commas; of "all", each but `auto`, which only chooses one.
/// Errors: invalid_option.
Result<std::vector<Method>> methods_of(const std::string& names) {
  std::vector<Method> chosen;
  if (names == "all") {
    for (const MethodInfo& info : methods()) chosen.push_back(*method_from(info.name));
    std::erase_if(chosen, [](const Method& one) { return std::get_if<method::Auto>(&one); });
    return chosen;
  }
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    const auto method = method_from(name);
    if (!method) return invalid_option("no such method: " + name);
    chosen.push_back(*method);
  }
  if (chosen.empty()) return invalid_option("--methods needs a name");
  return chosen;
}

/// One picture of all axes: each in a frame of its own, side by side in the plane, with its method
/// below.
Status write_comparison(const std::string& path, const Shape& shape, const Box& box,
                        std::vector<Row>& rows, const ShapeFile& file) {
  Document<AxisItem> native;
  native.crs_wkt = file.crs_wkt;
  native.y_down = file.y_down;
  const Vec2 size = box.high - box.low;
  const Vec2 pitch{1.1 * size.x, size.y + 0.1 * std::max(size.x, size.y)};
  std::size_t count = 0;
  constexpr std::size_t columns = 3;
  for (Row& row : rows) {
    if (!row.refused.empty()) continue;
    const Vec2 move{static_cast<double>(count % columns) * pitch.x,
                    (file.y_down ? 1 : -1) * static_cast<double>(count / columns) * pitch.y};
    ++count;
    AxisItem item;
    item.shape = shape;
    item.axis = row.axis;
    item.attributes = {{"title", row.method}};
    for (Vec2& p : item.shape.points) p = p + move;
    for (Site& site : item.axis.sites) {
      site.start = site.start + move;
      site.end = site.end + move;
    }
    for (Node& node : item.axis.nodes) node.disk.center = node.disk.center + move;
    for (Edge& edge : item.axis.edges) edge.control.center = edge.control.center + move;
    native.items.push_back(std::move(item));
  }
  io::WriteOptions options;
  options.width = 1500;
  options.titles = true;
  return io::write_axes(path, {}, native, options);
}

Result<int> run_compare(const CompareArguments& arguments) {
  const auto& [input, common, names, output, fit, options] = arguments;
  auto methods = methods_of(names);
  if (!methods) return std::move(methods).error();
  Status writable = check_output(output, {}, ".svg .pdf .png .ps", input.path, common.json);
  if (!writable) return std::move(writable).error();
  const bool smooth = std::any_of(methods->begin(), methods->end(),
                                  [](const Method& one) { return info_of(one).contours; });
  auto file = load_shapes(input, common.threads, smooth || fit > 0);
  if (!file) return std::move(file).error();
  if (fit > 0)
    if (Status done = smooth_boundaries(*file, fit, input); !done) return std::move(done).error();
  const std::vector<Contour> nothing;
  bool failed = false;
  print_notes(*file, input, common);
  const Stopwatch comparing;
  Json features = Json::array();
  std::string text;
  for (std::size_t i = 0; i < file->shapes.size(); ++i) {
    const Shape& shape = file->shapes[i];
    Options own = options;
    own.tolerance = common.tolerance;
    own.corner_angle = common.corner_angle;
    const auto exact = compute(shape, own);
    if (!exact) return at_feature(exact.error(), input.path, i);
    Shape around;
    if (options.exterior) {
      auto found = surroundings(shape, options.margin);
      if (!found) return at_feature(std::move(found).error(), input.path, i);
      around = std::move(found).value();
    }
    const Shape& region = options.exterior ? around : shape;
    std::vector<Row> rows;
    own.threads = 1;
    for (const Method& method : *methods) {
      own.method = method;
      rows.push_back(measure(shape, region, i < file->contours.size() ? file->contours[i] : nothing,
                             *exact, common, own, names == "all"));
    }
    if (file->shapes.size() > 1) text += fmt::format("feature {}\n", i);
    text += table_of(rows);
    for (const Row& row : rows) failed = failed || row.failed;
    Json list = Json::array();
    for (const Row& row : rows) list.push_back(json_of(row));
    features.push_back(std::move(list));
    if (i == 0 && !output.empty()) {
      Status written = write_comparison(output, shape, bounding_box(region), rows, *file);
      if (!written) return std::move(written).error();
    }
  }
  const Json costs = costs_of(common, {{"read", file->seconds_read},
                                       {"shape", file->seconds_shape},
                                       {"compare", comparing.seconds()}});
  Json object = {{"features", std::move(features)}};
  if (common.stats) object.update(costs);
  Status printed = common.json ? print(object) : print(text);
  if (!printed) return std::move(printed).error();
  print_costs(common, costs);
  return failed ? exit_failed_verdict : exit_success;
}

}  // namespace

Command make_compare_command(CLI::App& program) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command =
      program.add_subcommand("compare", "Compute axes by several methods and compare them.");
  add_input_options(*command, arguments->input);
  command
      ->add_option("--methods", arguments->methods,
                   "all (default), or names separated by commas, for example disks,potential.")
      ->option_text("NAMES");
  command
      ->add_option("-o,--output", arguments->output,
                   "A picture of the first feature's axes side by side: .svg .pdf .png .ps")
      ->check(a_name())
      ->option_text("PICTURE");
  command
      ->add_option(
          "--fit", arguments->fit,
          "First replace every boundary by a smooth curve through its corners and within D\n"
          "of it, as curve-axis wants it.")
      ->check(a_positive_number())
      ->option_text("D");
  add_exterior_options(*command, arguments->options,
                       "The axes of what lies around the shape and in its holes, within a frame.");
  add_common_options(*command, arguments->common);
  command->footer(
      "Each method runs on one thread. Distances are to the axis of the method disks, by\n"
      "samples; Hausdorff is the larger of both directions. A method that does not take\n"
      "the input says why. An axis of pixels is unresolved if its grid is too coarse for\n"
      "parts or holes of the shape. Exit status 1: an axis is not verified otherwise, a\n"
      "method failed, or one that --methods names does not take the input.\n"
      "\n"
      "Examples:\n"
      "  medial compare plan.wkt\n"
      "  medial compare plan.wkt --methods disks,ridge,potential -o methods.svg --json\n"
      "  medial compare island.wkt --methods all --fit 0.5");
  return {command, [arguments] { return run_compare(*arguments); }};
}

}  // namespace medial::cli
