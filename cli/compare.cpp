// medial compare: the methods that support an input, side by side.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "cli/axis_distance.h"
#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/compute.h"
#include "medial/query.h"
#include "medial/verify.h"

namespace medial::cli {
namespace {

struct CompareArguments : FileArguments {
  std::string methods = "all";
  Options options;  ///< exterior and margin
};

struct Row {
  std::string method;
  std::string refused;  ///< the reason, if there is nothing else
  bool failed = false;  ///< no axis although the method supports the input, or a wrong one
  double seconds = 0;
  std::uint64_t nodes = 0, branches = 0, parts = 0, cycles = 0;
  AxisDistance distance;
  double radius_error = 0;
  bool passed = false;
  bool unresolved = false;  ///< failed only because the grid is too coarse for the shape
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

/// The reference for the axes of all methods.
struct Reference {
  Shape region;  ///< the shape, or its surroundings, whose axis is that of the exterior
  MedialAxis axis;
  Options options;
  bool lenient = false;  ///< methods may refuse the kind of input
};

Result<Reference> reference_of(const Shape& shape, double of_input,
                               const CompareArguments& arguments) {
  Reference reference;
  reference.options = engine_options(arguments.common, 0, of_input, arguments.options);
  reference.lenient = arguments.methods == "all";
  auto exact = compute(shape, reference.options);
  if (!exact) return std::move(exact).error();
  reference.axis = std::move(exact).value();
  reference.region = shape;
  if (arguments.options.exterior) {
    auto around = surroundings(shape, arguments.options.margin);
    if (!around) return std::move(around).error();
    reference.region = std::move(around).value();
  }
  return reference;
}

/// Compares one method's axis of a shape with the exact one, on one thread.
Row measure(const ShapeItem& item, const Reference& reference, const Method& method) {
  Row row;
  row.method = name_of(method);
  Options options = reference.options;
  options.method = method;
  options.threads = 1;
  const Stopwatch watch;
  auto axis = compute(item.shape, options, item.contours);
  row.seconds = watch.seconds();
  if (!axis) {
    row.refused = axis.error().text;
    const ErrorCode code = axis.error().code;
    const bool untaken = code == ErrorCode::unsupported || code == ErrorCode::invalid_option;
    row.failed = !untaken || !reference.lenient;
    return row;
  }
  row.axis = std::move(axis).value();
  row.nodes = row.axis.nodes.size();
  row.branches = branch_count(row.axis);
  const Box box = bounding_box(reference.region);
  const double size = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  row.distance = distance_between(row.axis, reference.axis, 0.005 * size, 0.05 * size);
  row.radius_error = radius_error(reference.region, row.axis);
  const Certificate certificate = verify(
      item.shape, row.axis, {.tolerance = options.tolerance, .corner_angle = options.corner_angle});
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
          {"computed_by", row.axis.method},
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
          {"verified", row.axis.resolution == 0 ? Json::array({"disks", "graph", "cover"})
                                                : Json::array({"radii", "graph"})},
          {"unresolved", row.unresolved},
          {"failure", row.failure}};
}

/// The checks of verify(), and the distance to the reference, which verify() does not measure.
std::string verdict_of(const Row& row) {
  const bool exact = row.axis.resolution == 0;
  const char* checked = exact ? "disks, graph, cover" : "radii, graph";
  const std::string verdict = row.passed       ? fmt::format("yes: {}", checked)
                              : row.unresolved ? "unresolved: " + row.failure
                                               : "NO: " + row.failure;
  if (row.axis.method != row.method) return verdict + "; computed by " + row.axis.method;
  return exact ? verdict
               : fmt::format("{}; up to {:.3g} away", verdict,
                             std::max(row.distance.largest, row.distance.uncovered));
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
                    row.radius_error, row.parts, row.cycles, verdict_of(row));
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
    if (!method) {
      std::string known = "all";
      for (const MethodInfo& info : methods()) known += fmt::format(",{}", info.name);
      return invalid_option(fmt::format("--methods: {} not in {{{}}}", name, known));
    }
    chosen.push_back(*method);
  }
  if (chosen.empty()) return invalid_option("--methods needs a name");
  return chosen;
}

Result<int> run_compare(const CompareArguments& arguments) {
  const CommonOptions& common = arguments.common;
  auto methods = methods_of(arguments.methods);
  if (!methods) return std::move(methods).error();
  Status writable = check_output(arguments, ".svg .pdf .png .ps");
  if (!writable) return std::move(writable).error();
  InputOptions input = arguments.input;
  input.source.load.keep_contours = std::any_of(
      methods->begin(), methods->end(), [](const Method& one) { return info_of(one).contours; });
  for (Method& one : *methods)
    if (auto* own = std::get_if<method::CurveAxis>(&one)) own->fit = input.source.load.fit;
  auto loaded = load_shapes(input, common);
  if (!loaded) return std::move(loaded).error();
  const Document<ShapeItem>& file = loaded->file;
  if (file.items.empty()) return no_shape(input.path);
  bool failed = false;
  std::vector<std::string> left_out;
  Json features = Json::array();
  std::string text;
  for (std::size_t i = 0; i < file.items.size(); ++i) {
    const ShapeItem& item = file.items[i];
    auto reference = reference_of(item.shape, file.corner_angle, arguments);
    if (!reference) {
      reference.error().place.feature = file.index_of(i);
      if (leave_out_feature(reference.error(), skips(input, left_out))) continue;
      return std::move(reference).error();
    }
    std::vector<Row> rows;
    for (const Method& method : *methods) rows.push_back(measure(item, *reference, method));
    if (file.items.size() > 1) text += fmt::format("feature {}\n", file.index_of(i));
    text += table_of(rows);
    Json& list = features.emplace_back(Json::array());
    for (const Row& row : rows) {
      failed = failed || row.failed;
      list.push_back(json_of(row));
    }
    if (features.size() == 1 && !arguments.output.empty()) {
      std::vector<Panel> panels;
      for (Row& row : rows)
        if (row.refused.empty())
          panels.push_back({row.method, {{item.shape, std::move(row.axis), {}}}});
      Status written =
          write_panels(arguments, file, bounding_box(reference->region), std::move(panels), 1500);
      if (!written) return std::move(written).error();
    }
  }
  note_left_out(left_out, input, common);
  if (features.empty()) return no_shape(input.path);
  loaded->phases.end("compare");
  return finish(common, {{"features", std::move(features)}}, loaded->phases, text, {},
                failed ? exit_failed_verdict : exit_success);
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
  add_output_option(*command, arguments->output, "PICTURE",
                    "A picture of the first feature's axes side by side: .svg .pdf .png .ps");
  add_fit_option(*command, arguments->input);
  add_exterior_options(*command, arguments->options,
                       "The axes of the exterior: around the shape, within a rectangle, and in\n"
                       "holes.");
  add_common_options(*command, arguments->common);
  command->footer(
      "Each method runs on one thread. Distances are measured at samples, to the axis of the\n"
      "method disks; Hausdorff is the larger of both directions. For a method that does not\n"
      "support the input, the table says why. For a sampled axis, verification covers the\n"
      "radii and the graph but not the position, which the distance shows. An axis of pixels\n"
      "is unresolved if its grid is too coarse for parts or holes of the shape. Exit status 1:\n"
      "an axis is wrong in another way, a method failed, or a method named by --methods does\n"
      "not support the input.\n"
      "\n"
      "Examples:\n"
      "  medial compare plan.wkt\n"
      "  medial compare plan.wkt --methods disks,ridge,potential -o methods.svg --json\n"
      "  medial compare island.wkt --methods all --fit 0.5");
  return command_of(command, arguments, run_compare);
}

}  // namespace medial::cli
