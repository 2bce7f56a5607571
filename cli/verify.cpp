// medial verify: checks a stored axis against its shapes.

#include "medial/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <tuple>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"

namespace medial::cli {
namespace {

struct VerifyArguments : FileArguments {
  std::string axis_path;
  int samples = VerifyOptions{}.samples_per_edge;
};

constexpr int most_samples = 1000;
constexpr std::size_t most_failures_shown = 20;

/// Calls visit(name, number, is_sum) for every number of a Certificate. `is_sum`: a file reports
/// the sum over its features, or else the largest value.
template <class Visit>
void each_number(const Visit& visit) {
  using C = Certificate;
  visit("tolerance", &C::tolerance, false);
  visit("resolution", &C::resolution, false);
  visit("largest_residual", &C::largest_residual, false);
  visit("largest_intrusion", &C::largest_intrusion, false);
  visit("largest_contact_gap", &C::largest_contact_gap, false);
  visit("largest_uncovered", &C::largest_uncovered, false);
  visit("worst_legality", &C::worst_legality, false);
  visit("shape_area", &C::shape_area, true);
  visit("disks_area", &C::disks_area, true);
  visit("disks_checked", &C::disks_checked, true);
  visit("components", &C::components, true);
  visit("graph_parts", &C::graph_parts, true);
  visit("holes", &C::holes, true);
  visit("cycles", &C::cycles, true);
  visit("convex_corners", &C::convex_corners, true);
  visit("corners_without_leaf", &C::corners_without_leaf, true);
  visit("curvature_leaves", &C::curvature_leaves, true);
  visit("blunt_joints", &C::blunt_joints, true);
  visit("largest_blunt_angle", &C::largest_blunt_angle, false);
  visit("reflex_vertices", &C::reflex_vertices, true);
  visit("reflex_without_contact", &C::reflex_without_contact, true);
}

/// The certificate of a whole file.
Certificate merge(const std::vector<Certificate>& certificates, const DocumentInfo& file) {
  Certificate all;
  all.passed = true;
  for (std::size_t i = 0; i < certificates.size(); ++i) {
    const Certificate& one = certificates[i];
    if (one.largest_residual >= all.largest_residual) {
      all.worst = one.worst;
    }
    each_number([&](const char*, auto number, bool is_sum) {
      all.*number = is_sum ? all.*number + one.*number : std::max(all.*number, one.*number);
    });
    all.passed = all.passed && one.passed;
    for (const std::string& failure : one.failures) {
      all.failures.push_back(certificates.size() == 1
                                 ? failure
                                 : fmt::format("feature {}: {}", file.index_of(i), failure));
    }
  }
  return all;
}

/// `whole`: the axis is neither a part nor of the exterior. Values that are not checked are null.
Json json_of(const Certificate& c, bool whole) {
  Json object = {{"passed", c.passed}, {"failures", c.failures}};
  each_number([&](const char* name, auto number, bool) { object[name] = c.*number; });
  if (!whole || c.resolution > 0)
    for (const char* unchecked : {"largest_uncovered", "shape_area", "disks_area"})
      object[unchecked] = nullptr;
  object["worst"] = {{"x", c.worst.x}, {"y", c.worst.y}};
  return object;
}

std::string worst_text(double residual, double x, double y) {
  return fmt::format("{:.3g} at ({:.10g}, {:.10g})", residual, x, y);
}

void add_verdict(Rows& rows, const std::vector<std::string>& failures, bool passed) {
  const std::size_t shown = std::min(failures.size(), most_failures_shown);
  for (std::size_t i = 0; i < shown; ++i) rows.add("failed", failures[i]);
  if (shown < failures.size())
    rows.add("failed", fmt::format("and {} more", failures.size() - shown));
  rows.add("verdict", passed ? "passed" : "FAILED");
}

/// What the axes of a file have in common.
struct Kind {
  bool part = false;      ///< pruned, cut or smoothed
  bool exterior = false;  ///< of what lies around the shapes
  bool pixels = false;    ///< of pixels, if sampled
  bool whole() const { return !part && !exterior; }
};

Kind kind_of(const Document<AxisItem>& file) {
  Kind kind;
  for (const AxisItem& item : file.items) {
    kind.part = kind.part || item.part;
    kind.exterior = kind.exterior || item.axis.exterior > 0;
    kind.pixels = kind.pixels || is_of_pixels(item.axis.method);
  }
  return kind;
}

std::string verdict_table(const Certificate& c, std::size_t features, const Kind& kind) {
  Rows rows(24);
  const auto length = [](double value) { return fmt::format("{:.3g}", value); };
  const bool exact = c.resolution == 0;
  rows.add("features", features);
  if (kind.part)
    rows.add("part", "pruned, cut or smoothed: leaves, corners, coverage and area are not checked");
  if (kind.exterior)
    rows.add("exterior", "without the edges at the enclosure: disks are checked, counts are not");
  rows.add("disks checked", c.disks_checked);
  if (!exact)
    rows.add("sampled",
             fmt::format("{} {:.6g}; radii may be off by 0.71 of that",
                         kind.pixels ? "pixels of side" : "steps of at most", c.resolution));
  rows.add("tolerance", length(c.tolerance));
  rows.add("largest |distance - r|", worst_text(c.largest_residual, c.worst.x, c.worst.y));
  rows.add("largest intrusion", length(c.largest_intrusion));
  if (exact) {
    rows.add("largest contact gap", length(c.largest_contact_gap));
    if (kind.whole()) {
      rows.add("largest uncovered", length(c.largest_uncovered));
      rows.add("area", fmt::format("{:.10g} of the disks, {:.10g} of the shape", c.disks_area,
                                   c.shape_area));
    }
  }
  rows.add("connected parts", kind.exterior ? std::to_string(c.graph_parts)
                                            : fmt::format("{} for {}", c.graph_parts,
                                                          counted(c.components, "component")));
  rows.add("cycles", kind.exterior ? std::to_string(c.cycles)
                                   : fmt::format("{} for {}", c.cycles, counted(c.holes, "hole")));
  if (exact && kind.whole())
    rows.add("convex corners",
             fmt::format("{}, {} without a leaf", c.convex_corners, c.corners_without_leaf));
  if (c.curvature_leaves > 0) rows.add("leaves at arcs", c.curvature_leaves);
  if (c.blunt_joints > 0)
    rows.add("blunt joints",
             fmt::format("{}, up to {:.3g} degrees", c.blunt_joints, c.largest_blunt_angle));
  if (exact && kind.whole())
    rows.add("reflex vertices",
             fmt::format("{}, {} without a contact", c.reflex_vertices, c.reflex_without_contact));
  add_verdict(rows, c.failures, c.passed);
  return rows.text();
}

Json json_of(const VoronoiCertificate& c) {
  return {{"passed", c.passed},
          {"failures", c.failures},
          {"tolerance", c.tolerance},
          {"largest_residual", c.largest_residual},
          {"largest_contact_gap", c.largest_contact_gap},
          {"worst", {{"x", c.worst.x}, {"y", c.worst.y}}},
          {"disks_checked", c.disks_checked},
          {"sites", c.sites},
          {"faces", c.faces},
          {"broken_faces", c.broken_faces},
          {"faces_area", c.faces_area},
          {"frame_area", c.enclosure_area}};
}

std::string verdict_table(const VoronoiCertificate& c) {
  Rows rows(24);
  rows.add("sites", c.sites);
  rows.add("disks checked", c.disks_checked);
  rows.add("tolerance", fmt::format("{:.3g}", c.tolerance));
  rows.add("largest |distance - r|", worst_text(c.largest_residual, c.worst.x, c.worst.y));
  rows.add("largest contact gap", fmt::format("{:.3g}", c.largest_contact_gap));
  rows.add("faces", fmt::format("{}, {} broken", c.faces, c.broken_faces));
  rows.add("area", fmt::format("{:.10g} of the faces, {:.10g} of the enclosure", c.faces_area,
                               c.enclosure_area));
  add_verdict(rows, c.failures, c.passed);
  return rows.text();
}

/// Reads the stored file. Shows a line on the terminal if reading takes long.
template <class Read>
auto read_stored(const std::string& path, Read read) {
  const Activity shown("reading", path);
  return read(path);
}

/// The planar graph of a diagram. If pieces had to touch because rounding could not separate them,
/// returns the graph with as many sites as the diagram, or else the last one tried.
Result<PlanarGraph> graph_of(const LoosePieces& pieces, const VoronoiDiagram& diagram,
                             const VerifyArguments& arguments) {
  std::optional<PlanarGraph> found;
  FileArguments quiet = arguments;
  quiet.common.quiet = true;
  Status fitting = with_planar_graph(pieces, quiet, [&](PlanarGraph& graph) -> Status {
    const bool fits = graph.points.size() + graph.edges.size() == diagram.sites.size();
    const Vec2 point = graph.points.front();
    found = std::move(graph);
    if (fits) return success();
    Error too_close{ErrorCode::unsupported, "another number of sites", {}};
    too_close.place.ring = 0;
    too_close.place.point = point;
    return too_close;
  });
  if (!found) return std::move(fitting).error();
  return std::move(*found);
}

/// Checks a Voronoi diagram against the loose pieces of the input.
Result<int> verify_voronoi(const VerifyArguments& arguments) {
  const CommonOptions& common = arguments.common;
  Phases phases;
  auto stored = read_stored(arguments.axis_path, io::read_voronoi);
  if (!stored) return std::move(stored).error();
  if (stored->items.size() != 1 || !stored->items.front().diagram.enclosure)
    return error_at(
        ErrorCode::unsupported, arguments.axis_path,
        "this diagram has no enclosure (--method lee); only diagrams within an enclosure "
        "can be verified");
  auto pieces = load_loose(arguments.input, common);
  if (!pieces) return std::move(pieces).error();
  const VoronoiDiagram& diagram = stored->items.front().diagram;
  const auto graph = graph_of(*pieces, diagram, arguments);
  if (!graph) return graph.error();
  phases.end("read");
  const VoronoiCertificate certificate = verify(*graph, diagram,
                                                {.tolerance = common.tolerance,
                                                 .samples_per_edge = arguments.samples,
                                                 .threads = common.threads});
  phases.end("verify");
  Json object = {{"input", arguments.input.path}, {"voronoi", arguments.axis_path}};
  object.update(json_of(certificate));
  return finish(common, std::move(object), phases,
                common.quiet ? std::string() : verdict_table(certificate), {},
                certificate.passed ? exit_success : exit_failed_verdict);
}

Result<std::vector<Certificate>> verify_all(const Document<ShapeItem>& shapes,
                                            const Document<AxisItem>& stored,
                                            const VerifyArguments& arguments) {
  const CommonOptions& common = arguments.common;
  const auto verify_one = [&](std::size_t i, int threads) {
    VerifyOptions options;
    options.tolerance = common.tolerance;
    options.corner_angle = corner_angle(common, shapes.corner_angle);
    options.samples_per_edge = arguments.samples;
    options.threads = threads;
    options.part = stored.items[i].part;
    return verify(shapes.items[i].shape, stored.items[i].axis, options);
  };
  return map_items<Certificate>(weights_of(shapes), common.threads, verify_one);
}

/// Whether the axes belong to other shapes, for example because of different input options.
bool are_other_shapes(const Document<AxisItem>& stored, const Document<ShapeItem>& shapes) {
  for (std::size_t i = 0; i < shapes.items.size(); ++i)
    if (stored.items[i].shape.points != shapes.items[i].shape.points) return true;
  return false;
}

Result<int> run_verify(const VerifyArguments& arguments) {
  const auto& [input, common] = std::tie(arguments.input, arguments.common);
  const std::string& axis_path = arguments.axis_path;
  if (io::is_voronoi(axis_path)) return verify_voronoi(arguments);
  auto stored =
      read_stored(axis_path, [](const std::string& path) { return io::read_native(path); });
  if (!stored) return std::move(stored).error();
  if (!stored->items.empty() && std::ranges::all_of(stored->items, [](const AxisItem& item) {
        return item.axis.method.empty();
      }))
    return error_at(ErrorCode::malformed, axis_path, "holds shapes, but no axes");
  InputOptions source = input;
  // Axes of pixels belong to the pixels' own boundary.
  for (const AxisItem& item : stored->items)
    if (is_of_pixels(item.axis.method)) source.source.read.smooth_contour = false;
  auto loaded = load_shapes(source, common);
  if (!loaded) return std::move(loaded).error();
  const auto left_out = refused_without_axis(*stored, axis_path, input, common, loaded->file);
  if (!left_out) return left_out.error();
  const Document<ShapeItem>& shapes = loaded->file;
  const std::size_t count = shapes.items.size();
  if (stored->items.size() != count) {
    return error_at(
        ErrorCode::malformed, axis_path,
        fmt::format("holds {}, but {} holds {}", counted(stored->items.size(), "axis", "axes"),
                    input.path, counted(count, "feature")));
  }
  const std::string stored_crs = crs_name(stored->crs_wkt), input_crs = crs_name(shapes.crs_wkt);
  if (!common.quiet && stored_crs != input_crs) {
    say("medial: {}: warning: its coordinate reference system ({}) is not the input's ({}); "
        "was it made with --project?\n",
        axis_path, stored_crs, input_crs);
  }
  const auto certificates = verify_all(shapes, *stored, arguments);
  if (!certificates) return certificates.error();
  loaded->phases.end("verify");
  const Certificate all = merge(*certificates, shapes);
  if (!all.passed && !common.quiet && are_other_shapes(*stored, shapes))
    say("medial: {0}: note: its axes belong to other shapes than the input; repeat the options "
        "of the command that made them, such as --fit, --pixel-outline or --repair, or check them "
        "against the shapes stored with them: medial verify {0} {0}\n",
        axis_path);
  Json object = {
      {"input", input.path}, {"axis", axis_path}, {"features", count}, {"without_axis", *left_out}};
  const Kind kind = kind_of(*stored);
  object["part"] = kind.part;
  object["exterior"] = kind.exterior;
  object.update(json_of(all, kind.whole()));
  object["certificates"] = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const AxisItem& item = stored->items[i];
    object["certificates"].push_back(
        json_of((*certificates)[i], !item.part && item.axis.exterior == 0));
  }
  return finish(common, std::move(object), loaded->phases,
                common.quiet ? std::string() : verdict_table(all, count, kind), {},
                all.passed ? exit_success : exit_failed_verdict);
}

}  // namespace

Command make_verify_command(CLI::App& program) {
  auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* command = program.add_subcommand("verify", "Check a stored axis against its shapes.");
  add_input_options(*command, arguments->input, "AXIS",
                    "Axes in medial's own .json or .safetensors, or a Voronoi diagram of loose\n"
                    "pieces in .json.",
                    arguments->axis_path);
  add_fit_option(*command, arguments->input);
  add_value(*command, "--samples", arguments->samples, "N", in_range(0, most_samples),
            fmt::format("Points to check inside every edge (default: {}).", arguments->samples));
  add_common_options(*command, arguments->common);
  command->footer(
      "Does not compute the axis again, but measures the stored disks against the shapes, by\n"
      "code that shares nothing with the engine. Matches axes to features by order, or with\n"
      "--skip-invalid by number; then a feature without a stored axis must be one whose axis\n"
      "cannot be computed.\n"
      "\n"
      "The report gives the largest |distance to the boundary - radius|, the largest intrusion\n"
      "of the boundary into a disk, and both areas. It says whether the graph is connected and\n"
      "has one cycle per hole, and whether every convex corner has a leaf and every boundary\n"
      "point a disk. Lengths are in the units of the input. An axis that was pruned, cut or\n"
      "smoothed is checked for disks, contacts, and no more cycles than holes; an axis of the\n"
      "exterior, which lacks the edges at the enclosure, for disks and contacts. In a diagram\n"
      "of `medial voronoi`, samples of each edge are checked against the nearest of all sites;\n"
      "faces must be closed and oriented consistently, and their areas add up to the\n"
      "enclosure's.\n"
      "\n"
      "Repeat the options that selected the shapes when the axis was computed: --fit,\n"
      "--repair, --pixel-outline, --layer, --project and the like. If specks were removed, or\n"
      "to check a file by itself, give AXIS as INPUT, too: it stores its shapes.\n"
      "\n"
      "Exit status: 0 passed, 1 failed, 2 an error.\n"
      "\n"
      "Examples:\n"
      "  medial axis plan.geojson -o plan.json && medial verify plan.geojson plan.json\n"
      "  medial axis leaf.png --method curve-axis --fit 1 -o leaf.json\n"
      "  medial verify leaf.png leaf.json --fit 1\n"
      "  medial voronoi roads.geojson -o v.json && medial verify roads.geojson v.json\n"
      "  medial verify --json --quiet maze.wkt.gz maze.json");
  return command_of(command, arguments, run_verify);
}

}  // namespace medial::cli
