// medial verify: does a stored axis belong to these shapes?

#include "medial/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/costs.h"
#include "cli/loose.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"

namespace medial::cli {
namespace {

struct VerifyArguments {
  InputOptions input;
  CommonOptions common;
  std::string axis_path;
  int samples = VerifyOptions{}.samples_per_edge;
};

constexpr int most_samples = 1000;
constexpr std::size_t most_failures_told = 20;

/// The worst of all certificates where it is a distance, the sum where it is a count or an area.
Certificate merge(const std::vector<Certificate>& certificates) {
  Certificate all;
  all.passed = true;
  for (std::size_t i = 0; i < certificates.size(); ++i) {
    const Certificate& one = certificates[i];
    if (one.largest_residual >= all.largest_residual) {
      all.largest_residual = one.largest_residual;
      all.worst_x = one.worst_x;
      all.worst_y = one.worst_y;
    }
    all.tolerance = std::max(all.tolerance, one.tolerance);
    all.resolution = std::max(all.resolution, one.resolution);
    all.largest_intrusion = std::max(all.largest_intrusion, one.largest_intrusion);
    all.largest_contact_gap = std::max(all.largest_contact_gap, one.largest_contact_gap);
    all.largest_uncovered = std::max(all.largest_uncovered, one.largest_uncovered);
    all.worst_legality = std::max(all.worst_legality, one.worst_legality);
    all.shape_area += one.shape_area;
    all.disks_area += one.disks_area;
    all.disks_checked += one.disks_checked;
    all.components += one.components;
    all.graph_parts += one.graph_parts;
    all.holes += one.holes;
    all.cycles += one.cycles;
    all.convex_corners += one.convex_corners;
    all.corners_without_leaf += one.corners_without_leaf;
    all.curvature_leaves += one.curvature_leaves;
    all.blunt_joints += one.blunt_joints;
    all.largest_blunt_angle = std::max(all.largest_blunt_angle, one.largest_blunt_angle);
    all.reflex_vertices += one.reflex_vertices;
    all.reflex_without_contact += one.reflex_without_contact;
    all.passed = all.passed && one.passed;
    for (const std::string& failure : one.failures) {
      all.failures.push_back(certificates.size() == 1 ? failure
                                                      : fmt::format("feature {}: {}", i, failure));
    }
  }
  return all;
}

Json json_of(const Certificate& c) {
  return {{"passed", c.passed},
          {"failures", c.failures},
          {"tolerance", c.tolerance},
          {"resolution", c.resolution},
          {"largest_residual", c.largest_residual},
          {"largest_intrusion", c.largest_intrusion},
          {"largest_contact_gap", c.largest_contact_gap},
          {"largest_uncovered", c.largest_uncovered},
          {"worst_legality", c.worst_legality},
          {"worst", {{"x", c.worst_x}, {"y", c.worst_y}}},
          {"shape_area", c.shape_area},
          {"disks_area", c.disks_area},
          {"disks_checked", c.disks_checked},
          {"components", c.components},
          {"graph_parts", c.graph_parts},
          {"holes", c.holes},
          {"cycles", c.cycles},
          {"convex_corners", c.convex_corners},
          {"corners_without_leaf", c.corners_without_leaf},
          {"curvature_leaves", c.curvature_leaves},
          {"blunt_joints", c.blunt_joints},
          {"largest_blunt_angle", c.largest_blunt_angle},
          {"reflex_vertices", c.reflex_vertices},
          {"reflex_without_contact", c.reflex_without_contact}};
}

std::string verdict_table(const Certificate& c, std::size_t features) {
  std::string text;
  const auto row = [&text](const char* name, const std::string& value) {
    text += fmt::format("{:<24}{}\n", name, value);
  };
  const auto length = [](double value) { return fmt::format("{:.3g}", value); };
  row("features", fmt::format("{}", features));
  row("disks checked", fmt::format("{}", c.disks_checked));
  if (c.resolution > 0) {
    row("sampled", fmt::format("pixels of side {:.6g}; judged by half a diagonal", c.resolution));
  }
  row("tolerance", length(c.tolerance));
  row("largest |distance - r|",
      fmt::format("{:.3g} at ({:.10g}, {:.10g})", c.largest_residual, c.worst_x, c.worst_y));
  row("largest intrusion", length(c.largest_intrusion));
  const bool exact = c.resolution == 0;
  if (exact) {
    row("largest contact gap", length(c.largest_contact_gap));
    row("largest uncovered", length(c.largest_uncovered));
    row("area",
        fmt::format("{:.10g} of the disks, {:.10g} of the shape", c.disks_area, c.shape_area));
  }
  row("connected parts",
      fmt::format("{} for {}", c.graph_parts, counted(c.components, "component")));
  row("cycles", fmt::format("{} for {}", c.cycles, counted(c.holes, "hole")));
  if (exact) {
    row("convex corners",
        fmt::format("{}, {} without a leaf", c.convex_corners, c.corners_without_leaf));
  }
  if (c.curvature_leaves > 0) row("leaves at arcs", fmt::format("{}", c.curvature_leaves));
  if (c.blunt_joints > 0)
    row("blunt joints",
        fmt::format("{}, up to {:.3g} degrees", c.blunt_joints, c.largest_blunt_angle));
  if (exact) {
    row("reflex vertices",
        fmt::format("{}, {} without a contact", c.reflex_vertices, c.reflex_without_contact));
  }
  const std::size_t told = std::min(c.failures.size(), most_failures_told);
  for (std::size_t i = 0; i < told; ++i) row("failed", c.failures[i]);
  if (told < c.failures.size()) {
    row("failed", fmt::format("and {} more", c.failures.size() - told));
  }
  row("verdict", c.passed ? "passed" : "FAILED");
  return text;
}

Json json_of(const VoronoiCertificate& c) {
  return {{"passed", c.passed},
          {"failures", c.failures},
          {"tolerance", c.tolerance},
          {"largest_residual", c.largest_residual},
          {"largest_contact_gap", c.largest_contact_gap},
          {"worst", {{"x", c.worst_x}, {"y", c.worst_y}}},
          {"disks_checked", c.disks_checked},
          {"sites", c.sites},
          {"faces", c.faces},
          {"broken_faces", c.broken_faces},
          {"faces_area", c.faces_area},
          {"frame_area", c.frame_area}};
}

std::string verdict_table(const VoronoiCertificate& c) {
  std::string text;
  const auto row = [&text](const char* name, const std::string& value) {
    text += fmt::format("{:<24}{}\n", name, value);
  };
  row("sites", fmt::format("{}", c.sites));
  row("disks checked", fmt::format("{}", c.disks_checked));
  row("tolerance", fmt::format("{:.3g}", c.tolerance));
  row("largest |distance - r|",
      fmt::format("{:.3g} at ({:.10g}, {:.10g})", c.largest_residual, c.worst_x, c.worst_y));
  row("largest contact gap", fmt::format("{:.3g}", c.largest_contact_gap));
  row("faces", fmt::format("{}, {} broken", c.faces, c.broken_faces));
  row("area",
      fmt::format("{:.10g} of the faces, {:.10g} of the frame", c.faces_area, c.frame_area));
  for (const std::string& failure : c.failures) row("failed", failure);
  row("verdict", c.passed ? "passed" : "FAILED");
  return text;
}

/// A Voronoi diagram against what is loose in the input.
Result<int> verify_voronoi(const VerifyArguments& arguments) {
  const InputOptions& input = arguments.input;
  const CommonOptions& common = arguments.common;
  const Stopwatch reading;
  auto stored = [&] {
    const Activity shown("reading", arguments.axis_path);
    return io::read_voronoi(arguments.axis_path);
  }();
  if (!stored) return std::move(stored).error();
  if (stored->items.size() != 1 || !stored->items.front().diagram.frame)
    return error_at(ErrorCode::unsupported, arguments.axis_path,
                    "is of polygons alone (--method lee); diagrams within a frame are verified");
  auto loose = load_chains(input, common.threads);
  if (!loose) return std::move(loose).error();
  print_notes(*loose, input, common);
  const VoronoiDiagram& diagram = stored->items.front().diagram;
  auto planar_graph = planar_graph_of(*loose, input);
  if (!planar_graph) return std::move(planar_graph).error();
  // Of what rounding does not tell apart, it is the diagram of what touches.
  const double size = diagonal(bounding_box(*planar_graph));
  const auto fits = [&] {
    return planar_graph->points.size() + planar_graph->edges.size() == diagram.sites.size();
  };
  for (const double share : touching_shares) {
    if (fits()) break;
    auto touching = planar_graph_of(*loose, input, share * size);
    if (touching) planar_graph = std::move(touching);
  }
  const double seconds_read = reading.seconds();
  const Stopwatch checking;
  const VoronoiCertificate certificate = verify(*planar_graph, diagram,
                                                {.tolerance = common.tolerance,
                                                 .samples_per_edge = arguments.samples,
                                                 .threads = common.threads});
  const Json costs = costs_of(common, {{"read", seconds_read}, {"verify", checking.seconds()}});
  Status printed = success();
  if (common.json) {
    Json object = {{"input", input.path}, {"voronoi", arguments.axis_path}};
    if (common.stats) object.update(costs);
    object.update(json_of(certificate));
    printed = print(object);
  } else if (!common.quiet) {
    printed = print(verdict_table(certificate));
  }
  if (!printed) return std::move(printed).error();
  print_costs(common, costs);
  return certificate.passed ? exit_success : exit_failed_verdict;
}

Result<int> run_verify(const VerifyArguments& arguments) {
  const InputOptions& input = arguments.input;
  const CommonOptions& common = arguments.common;
  const std::string& axis_path = arguments.axis_path;
  if (input.path == "-" && axis_path == "-") {
    return invalid_option("INPUT and AXIS cannot both be standard input");
  }
  if (io::is_voronoi(axis_path)) return verify_voronoi(arguments);
  const Stopwatch reading;
  auto stored = [&] {
    const Activity shown("reading", axis_path);
    return io::read_native(axis_path);
  }();
  if (!stored) return std::move(stored).error();
  auto shapes = load_shapes(input, common.threads);
  if (!shapes) return std::move(shapes).error();
  print_notes(*shapes, input, common);
  const double seconds_read = reading.seconds() - shapes->seconds_shape;
  const std::size_t count = shapes->shapes.size();
  if (stored->items.size() != count) {
    return error_at(
        ErrorCode::malformed, axis_path,
        fmt::format("holds {} where {} holds {}", counted(stored->items.size(), "axis", "axes"),
                    input.path, counted(count, "feature")));
  }
  if (!common.quiet && crs_name(stored->crs_wkt) != crs_name(shapes->crs_wkt)) {
    say("medial: {}: warning: its coordinate reference system ({}) is not the input's ({}); "
        "was it made with --project?\n",
        axis_path, crs_name(stored->crs_wkt), crs_name(shapes->crs_wkt));
  }

  const Stopwatch checking;
  const std::vector<double> weights = weights_of(shapes->shapes);
  std::vector<Certificate> certificates(count);
  Status done =
      for_each_feature(weights, common.threads, [&](std::size_t i, int threads) -> Status {
        VerifyOptions options;
        options.tolerance = common.tolerance;
        options.corner_angle = common.corner_angle;
        options.samples_per_edge = arguments.samples;
        options.threads = threads;
        certificates[i] = verify(shapes->shapes[i], stored->items[i].axis, options);
        return success();
      });
  if (!done) return std::move(done).error();

  const Certificate all = merge(certificates);
  const Json costs = costs_of(
      common,
      {{"read", seconds_read}, {"shape", shapes->seconds_shape}, {"verify", checking.seconds()}});
  Status printed = success();
  if (common.json) {
    Json object = {{"input", input.path}, {"axis", axis_path}, {"features", count}};
    if (common.stats) object.update(costs);
    object.update(json_of(all));
    object["certificates"] = Json::array();
    for (const Certificate& one : certificates) object["certificates"].push_back(json_of(one));
    printed = print(object);
  } else if (!common.quiet) {
    printed = print(verdict_table(all, count));
  }
  if (!printed) return std::move(printed).error();
  print_costs(common, costs);
  return all.passed ? exit_success : exit_failed_verdict;
}

}  // namespace

Command make_verify_command(CLI::App& program) {
  auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* command = program.add_subcommand("verify", "Check a stored axis against its shapes.");
  add_input_options(*command, arguments->input, "AXIS",
                    "Axes, or a Voronoi diagram of loose pieces, in medial's own .json format.",
                    arguments->axis_path);
  command
      ->add_option(
          "--samples", arguments->samples,
          fmt::format("Points to check inside every edge (default: {}).", arguments->samples))
      ->check(in_range(0, most_samples))
      ->option_text("N");
  add_common_options(*command, arguments->common);
  command->footer(
      "Nothing is computed anew: the stored disks are measured against the shapes by\n"
      "code that shares nothing with the engine. Features and axes are matched by their\n"
      "order. Told are the largest |distance to the boundary - radius|, the largest\n"
      "intrusion of the boundary into a disk, whether the graph is connected with one\n"
      "cycle a hole, whether every convex corner has its leaf and every boundary point\n"
      "its disk, and both areas. Lengths are in the units of the input.\n"
      "Of a diagram of `medial voronoi`: samples of every edge against the nearest of all\n"
      "sites, faces closed and the right way around, and their areas against the frame's.\n"
      "Give the --layer, --where, --repair, --project and options of curves that the\n"
      "axis was made with.\n"
      "\n"
      "Exit status: 0 passed, 1 failed, 2 an error.\n"
      "\n"
      "Examples:\n"
      "  medial axis plan.geojson -o plan.json && medial verify plan.geojson plan.json\n"
      "  medial voronoi roads.geojson -o v.json && medial verify roads.geojson v.json\n"
      "  medial verify --json --quiet maze.wkt.gz maze.json");
  return {command, [arguments] { return run_verify(*arguments); }};
}

}  // namespace medial::cli
