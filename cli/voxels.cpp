// medial voxels: a closed mesh in, its medial axis on a grid of voxels out.

#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "cli/terminal.h"
#include "medial/io/mesh.h"
#include "medial/volume.h"

namespace medial::cli {
namespace {

struct VoxelArguments {
  std::string input;
  std::string output;
  std::string format;
  std::string search = "tree";
  std::string thinning = "sheets";
  double memory = 4;  ///< in GiB
  double width = 1536;
  CommonOptions common;
  VoxelOptions options;
};

/// What a run has to tell.
struct Outcome {
  Solid solid;
  VoxelAxis axis;
  double seconds_read = 0;
  double seconds_solid = 0;
  double seconds_write = 0;
};

Json json_of(const VoxelTopology& topology) {
  return {{"components", topology.components},
          {"tunnels", topology.tunnels},
          {"cavities", topology.cavities}};
}

Json json_of(const MeshReport& report) {
  return {{"input_vertices", report.input_vertices},   {"input_faces", report.input_faces},
          {"joined_vertices", report.joined_vertices}, {"unused_vertices", report.unused_vertices},
          {"dropped_faces", report.dropped_faces},     {"reversed_faces", report.reversed_faces},
          {"parted_vertices", report.parted_vertices}};
}

Json summary(const Outcome& outcome) {
  const auto& [solid, axis, read, made, written] = outcome;
  Json object = {{"vertices", solid.surface.vertices.size()},
                 {"faces", solid.surface.faces.size()},
                 {"resolution", axis.resolution},
                 {"cells", {axis.cells[0], axis.cells[1], axis.cells[2]}},
                 {"voxels", axis.voxels.size()},
                 {"links", axis.links.size()}};
  object["topology"] = {{"solid", json_of(solid.topology)},
                        {"interior_voxels", json_of(axis.interior)},
                        {"axis", json_of(axis.topology)}};
  const Voxel* deepest = nullptr;
  for (const Voxel& voxel : axis.voxels)
    if (deepest == nullptr || voxel.radius > deepest->radius) deepest = &voxel;
  if (deepest != nullptr)
    object["deepest"] = {{"x", deepest->center.x},
                         {"y", deepest->center.y},
                         {"z", deepest->center.z},
                         {"radius", deepest->radius}};
  return object;
}

Json stats(const Outcome& outcome) {
  const VoxelStatistics& s = outcome.axis.statistics;
  return {{"threads", s.threads},
          {"mesh", json_of(outcome.solid.report)},
          {"surface_voxels", s.surface_voxels},
          {"interior_voxels", s.interior_voxels},
          {"bounded_sets", s.bounded_sets},
          {"tested_voxels", s.tested_voxels},
          {"medial_voxels", s.medial_voxels},
          {"bridge_voxels", s.bridge_voxels},
          {"face_distances", s.face_distances},
          {"seconds",
           {{"read", outcome.seconds_read},
            {"solid", outcome.seconds_solid},
            {"tree", s.seconds_tree},
            {"digitize", s.seconds_digitize},
            {"first", s.seconds_first},
            {"follow", s.seconds_follow},
            {"bridge", s.seconds_bridge},
            {"thin", s.seconds_thin},
            {"write", outcome.seconds_write}}},
          {"processor_seconds", processor_seconds()},
          {"peak_bytes", peak_bytes()}};
}

std::string counts_of(const VoxelTopology& topology) {
  return fmt::format("{}, {}, {}", counted(topology.components, "part"),
                     counted(static_cast<std::uint64_t>(topology.tunnels), "tunnel"),
                     counted(topology.cavities, "cavity", "cavities"));
}

/// What was mended, and where the grid is too coarse.
void print_notes(const VoxelArguments& arguments, const Outcome& outcome) {
  if (arguments.common.quiet) return;
  const MeshReport& report = outcome.solid.report;
  std::string mended;
  const auto mention = [&mended](std::uint64_t count, const char* noun, const char* plural) {
    if (count > 0) mended += (mended.empty() ? "" : ", ") + counted(count, noun, plural);
  };
  mention(report.dropped_faces, "dropped face without an area", "dropped faces without an area");
  mention(report.reversed_faces, "reversed face", "reversed faces");
  mention(report.parted_vertices, "parted vertex", "parted vertices");
  if (!mended.empty()) say("medial: {}: {}\n", arguments.input, mended);
  if (outcome.axis.interior != outcome.solid.topology)
    say("medial: {}: the grid is too coarse for its topology: the mesh has {}; the interior "
        "voxels have {}\n",
        arguments.input, counts_of(outcome.solid.topology), counts_of(outcome.axis.interior));
}

Result<int> tell(const VoxelArguments& arguments, const Outcome& outcome) {
  const CommonOptions& common = arguments.common;
  if (common.json) {
    Json object = {{"input", arguments.input}};
    if (!arguments.output.empty()) object["output"] = arguments.output;
    if (common.stats) object.update(stats(outcome));
    object.update(summary(outcome));
    Status printed = print(object);
    if (!printed) return std::move(printed).error();
    return exit_success;
  }
  const VoxelAxis& axis = outcome.axis;
  const std::string line =
      fmt::format("{}: {}, {} x {} x {} cells, {}, {}; {}; {:.3g} s", arguments.input,
                  counted(outcome.solid.surface.faces.size(), "face"), axis.cells[0], axis.cells[1],
                  axis.cells[2], counted(axis.voxels.size(), "voxel"),
                  counted(axis.links.size(), "link"), counts_of(axis.topology),
                  outcome.seconds_read + outcome.seconds_solid + axis.statistics.seconds +
                      outcome.seconds_write);
  if (arguments.output.empty()) {
    Status printed = print(line + "\n");
    if (!printed) return std::move(printed).error();
  } else if (error_is_terminal() && !common.quiet) {
    say("{} -> {}\n", line, arguments.output == "-" ? "standard output" : arguments.output);
  }
  if (common.stats) say_text(table(stats(outcome)));
  return exit_success;
}

Result<int> run_voxels(const VoxelArguments& arguments) {
  const CommonOptions& common = arguments.common;
  Status writable =
      check_output(arguments.output, arguments.format, io::formats_of(io::DocumentKind::voxels),
                   arguments.input, common.json);
  if (!writable) return std::move(writable).error();
  Outcome outcome;
  const Stopwatch reading;
  auto mesh = io::read_mesh(arguments.input);
  if (!mesh) return std::move(mesh).error();
  outcome.seconds_read = reading.seconds();
  const Stopwatch making;
  auto solid = build_solid(std::move(mesh).value());
  if (!solid) {
    solid.error().place.file = arguments.input;
    return std::move(solid).error();
  }
  outcome.solid = std::move(solid).value();
  outcome.seconds_solid = making.seconds();

  VoxelOptions options = arguments.options;
  options.threads = common.threads;
  options.search = arguments.search == "tree" ? FaceSearch::tree : FaceSearch::sorted_list;
  options.thinning = arguments.thinning == "none"     ? Thinning::none
                     : arguments.thinning == "curves" ? Thinning::curves
                                                      : Thinning::sheets;
  options.memory = static_cast<std::uint64_t>(arguments.memory * 0x1p30);
  Progress progress("voxels", 1, error_is_terminal() && !common.quiet);
  options.progress = progress.part(1);
  auto axis = compute_voxels(outcome.solid, options);
  if (!axis) {
    axis.error().place.file = arguments.input;
    return std::move(axis).error();
  }
  outcome.axis = std::move(axis).value();
  print_notes(arguments, outcome);

  if (!arguments.output.empty()) {
    const Stopwatch writing;
    Status written = io::write_voxels(arguments.output, arguments.format, outcome.axis,
                                      outcome.solid, arguments.width);
    if (!written) return std::move(written).error();
    outcome.seconds_write = writing.seconds();
  }
  return tell(arguments, outcome);
}

void add_own_options(CLI::App& command, VoxelArguments& arguments) {
  VoxelOptions& options = arguments.options;
  command
      .add_option("--voxels", options.voxels,
                  "Voxels along the longest side of the mesh (default: 128).")
      ->check(in_range(4, 4096, true))
      ->option_text("N");
  command
      .add_option("--resolution", options.resolution,
                  "Instead of that: the edge of a voxel, in units of the input.")
      ->check(a_positive_number())
      ->excludes("--voxels")
      ->option_text("H");
  command
      .add_option("--angle", options.angle,
                  "In degrees: two feet of a voxel count as two if they lie so far apart as\n"
                  "seen from it, 1 to 120 (default: 30). Smaller angles give the axis of\n"
                  "the faces as they are; meshes of curved surfaces need larger ones.")
      ->check(in_range(1.0, 120.0, true))
      ->option_text("A");
  command
      .add_option("--thin", arguments.thinning,
                  "What the axis is thinned to: sheets, one voxel thick (default);\n"
                  "curves; or none.")
      ->check(CLI::IsMember({"sheets", "curves", "none"}).description(""))
      ->option_text("KIND");
  command
      .add_option("--search", arguments.search,
                  "How the nearest faces are found: tree (default), or sorted-list, the\n"
                  "published way, slow for many faces. Both give the same voxels.")
      ->check(CLI::IsMember({"tree", "sorted-list"}).description(""))
      ->option_text("NAME");
  command
      .add_option("--memory", arguments.memory,
                  "Give up before more than about G gibibytes are held (default: 4).")
      ->check(in_range(0.001, 1e6, true))
      ->option_text("G");
  command
      .add_option("--width", arguments.width,
                  "Width of a picture of three views, in pixels (default: 1536).")
      ->check(in_range(48.0, 8000.0, true))
      ->option_text("W");
}

}  // namespace

Command make_voxels_command(CLI::App& program) {
  auto arguments = std::make_shared<VoxelArguments>();
  CLI::App* command =
      program.add_subcommand("voxels", "Compute the medial axis of a closed mesh on a grid.");
  command
      ->add_option("MESH", arguments->input,
                   "A closed triangle mesh: " + io::formats_of(io::DocumentKind::mesh) + ".")
      ->required()
      ->option_text(" ");
  add_output_options(*command, arguments->output, arguments->format,
                     io::formats_of(io::DocumentKind::voxels), "for example ply");
  add_own_options(*command, *arguments);
  add_threads_option(*command, arguments->common);
  add_report_options(*command, arguments->common);
  command->footer(
      "The axis is a set of voxels with radii, by ridge following: surfaces one voxel\n"
      "thick in general. It has as many parts, tunnels and cavities as the voxels inside\n"
      "of the mesh. Open meshes, edges of more than two faces and faces that cross or\n"
      "touch are refused, with the place.\n"
      "\n"
      ".ply and .vtk hold radius and quality, .obj the links between voxels, .png the\n"
      "axis from three sides, coloured by radius.\n"
      "\n"
      "Examples:\n"
      "  medial voxels part.stl -o axis.ply --voxels 256\n"
      "  medial voxels part.stl -o part.png --resolution 0.5 --angle 10\n"
      "  medial voxels tree.obj -o skeleton.obj --thin curves --stats");
  return {command, [arguments] { return run_voxels(*arguments); }};
}

}  // namespace medial::cli
