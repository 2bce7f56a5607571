// medial voxels: the medial axis of a closed mesh on a grid of voxels.

#include <fmt/format.h>

#include <memory>

#include "cli/commands.h"
#include "cli/common.h"
#include "cli/pipeline.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/volume.h"

namespace medial::cli {
namespace {

struct VoxelArguments : FileArguments {
  double memory = 4;  ///< in GiB
  double width = 1536;
  bool potential = false;
  int order = 8;  ///< of the potential
  VoxelOptions options;
};

/// A solid and its axis.
struct Outcome {
  Solid solid;
  VoxelAxis axis;
  Phases phases;
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
  const auto& [solid, axis, phases] = outcome;
  Json object = {{"vertices", solid.surface.vertices.size()},
                 {"faces", solid.surface.faces.size()},
                 {"resolution", axis.resolution},
                 {"cells", {axis.cells[0], axis.cells[1], axis.cells[2]}},
                 {"voxels", axis.voxels.size()},
                 {"links", axis.links.size()}};
  if (!axis.surface.vertices.empty())
    object["surface"] = {{"vertices", axis.surface.vertices.size()},
                         {"triangles", axis.surface.triangles.size()},
                         {"lines", axis.surface.lines.size()}};
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

Json statistics_of(const Outcome& outcome) {
  const VoxelStatistics& s = outcome.axis.statistics;
  const Phases& phases = outcome.phases;
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
           {{"read", phases.seconds("read")},
            {"solid", phases.seconds("solid")},
            {"tree", s.seconds_tree},
            {"digitize", s.seconds_digitize},
            {"first", s.seconds_first},
            {"follow", s.seconds_follow},
            {"bridge", s.seconds_bridge},
            {"thin", s.seconds_thin},
            {"write", phases.seconds("write")}}},
          {"processor_seconds", processor_seconds()}};
}

std::string counts_of(const VoxelTopology& topology) {
  return fmt::format("{}, {}, {}", counted(topology.components, "part"),
                     counted(static_cast<std::uint64_t>(topology.tunnels), "tunnel"),
                     counted(topology.cavities, "cavity", "cavities"));
}

/// Prints notes on repairs of the mesh, and on a grid that is too coarse.
void print_notes(const VoxelArguments& arguments, const Outcome& outcome) {
  if (arguments.common.quiet) return;
  const std::string& input = arguments.input.path;
  const MeshReport& report = outcome.solid.report;
  const CountedNoun counts[] = {
      {report.dropped_faces, "dropped face without an area", "dropped faces without an area"},
      {report.reversed_faces, "reversed face"},
      {report.parted_vertices, "parted vertex", "parted vertices"}};
  const std::string repaired = enumerate(counts);
  if (!repaired.empty()) say("medial: {}: {}\n", input, repaired);
  if (outcome.axis.interior != outcome.solid.topology)
    say("medial: {}: the grid is too coarse for its topology: the mesh has {}; the interior "
        "voxels have {}\n",
        input, counts_of(outcome.solid.topology), counts_of(outcome.axis.interior));
}

Result<Outcome> compute_outcome(const VoxelArguments& arguments) {
  const std::string& input = arguments.input.path;
  const CommonOptions& common = arguments.common;
  Outcome out;
  auto mesh = io::read_mesh(input);
  if (!mesh) return std::move(mesh).error();
  out.phases.end("read");
  auto solid = build_solid(std::move(mesh).value());
  if (!solid) {
    solid.error().place.file = input;
    return std::move(solid).error();
  }
  out.solid = std::move(solid).value();
  out.phases.end("solid");
  VoxelOptions options = arguments.options;
  options.threads = common.threads;
  options.memory = static_cast<std::uint64_t>(arguments.memory * 0x1p30);
  if (arguments.potential) options.order = arguments.order;
  Progress progress("voxels", error_is_terminal() && !common.quiet);
  options.progress = progress.callback();
  auto axis = compute_voxels(out.solid, options);
  if (!axis) {
    axis.error().place.file = input;
    return std::move(axis).error();
  }
  out.axis = std::move(axis).value();
  out.phases.end("axis");
  return out;
}

Result<int> run_voxels(const VoxelArguments& arguments) {
  Status writable = check_output(arguments, io::formats_of(io::DocumentKind::voxels));
  if (!writable) return std::move(writable).error();
  auto outcome = compute_outcome(arguments);
  if (!outcome) return std::move(outcome).error();
  print_notes(arguments, *outcome);
  Status written =
      write_output(arguments, outcome->phases, [&](const auto& path, const auto& format) {
        return io::write_voxels(path, format, outcome->axis, outcome->solid, arguments.width);
      });
  if (!written) return std::move(written).error();
  const VoxelAxis& axis = outcome->axis;
  Json object = {{"input", arguments.input.path}};
  if (!arguments.output.empty()) object["output"] = arguments.output;
  object.update(summary(*outcome));
  return finish(arguments, std::move(object), outcome->phases,
                fmt::format("{}: {}, {} x {} x {} cells, {}, {}; {}", arguments.input.path,
                            counted(outcome->solid.surface.faces.size(), "face"), axis.cells[0],
                            axis.cells[1], axis.cells[2], counted(axis.voxels.size(), "voxel"),
                            counted(axis.links.size(), "link"), counts_of(axis.topology)),
                statistics_of(*outcome));
}

void add_own_options(CLI::App& command, VoxelArguments& arguments) {
  VoxelOptions& options = arguments.options;
  CLI::Option* voxels = add_value(command, "--voxels", options.voxels, "N", in_range(4, 4096, true),
                                  "Voxels along the longest side of the mesh (default: 128).");
  add_value(command, "--resolution", options.resolution, "H", a_positive_number(),
            "Instead: the edge length of a voxel, in units of the input.")
      ->excludes(voxels);
  add_value(command, "--angle", options.angle, "A", in_range(1.0, 120.0, true),
            "The smallest angle between two foot points, seen from a voxel, that count as\n"
            "distinct, 1 to 120 degrees (default: 30). Small angles give the axis of the flat\n"
            "faces; meshes of curved surfaces need larger angles.");
  CLI::Option* thin =
      add_choice<Thinning>(
          command, "--thin", options.thinning,
          {{"sheets", Thinning::sheets}, {"curves", Thinning::curves}, {"none", Thinning::none}},
          "Thin the axis to sheets, one voxel thick (default), to curves, or\n"
          "not at all (none).")
          ->option_text("KIND");
  command.add_flag("--surface", options.surface,
                   "Write sheets as triangles and curves as lines, with a radius at each\n"
                   "vertex, instead of voxels.");
  add_choice<bool>(command, "--method", arguments.potential,
                   {{"ridge", false}, {"potential", true}},
                   "ridge (default), or potential: sheets and curves along the force lines\n"
                   "of the charged surface, from convex edges and vertices.")
      ->excludes(thin);
  add_value(command, "--order", arguments.order, "N", in_range(2, 64, true),
            "The potential is the integral of 1 / distance^N (default: 8).");
  add_choice<bool>(command, "--search", options.sorted_list,
                   {{"tree", false}, {"sorted-list", true}},
                   "The search for nearest faces: tree (default), or sorted-list, as published,\n"
                   "which is slow for many faces. Both give the same voxels.");
  add_value(command, "--memory", arguments.memory, "G", in_range(0.001, 1e6, true),
            "Stop with an error above about G gibibytes of memory (default: 4).");
  add_value(command, "--width", arguments.width, "W", in_range(48.0, 8000.0, true),
            "Width of a picture of three views, in pixels (default: 1536).");
}

}  // namespace

Command make_voxels_command(CLI::App& program) {
  auto arguments = std::make_shared<VoxelArguments>();
  CLI::App* command =
      program.add_subcommand("voxels", "Compute the medial axis of a closed mesh on a grid.");
  command
      ->add_option("MESH", arguments->input.path,
                   "A closed triangle mesh: " + io::formats_of(io::DocumentKind::mesh) + ".")
      ->required()
      ->option_text(" ");
  add_output_options(*command, *arguments, io::formats_of(io::DocumentKind::voxels),
                     "for example ply");
  add_own_options(*command, *arguments);
  add_threads_option(*command, arguments->common.threads);
  add_report_options(*command, arguments->common);
  command->footer(
      "The axis is a set of voxels with radii, by ridge following: usually surfaces one\n"
      "voxel thick. It has as many parts, tunnels and cavities as the voxels inside the\n"
      "mesh. Open meshes, edges of more than two faces, and faces that cross or touch are\n"
      "refused, with the place.\n"
      "\n"
      ".ply and .vtk hold radius and quality, .glb the radius, .obj the links between\n"
      "voxels, .png the axis from three sides, coloured by radius.\n"
      "\n"
      "Examples:\n"
      "  medial voxels part.stl -o axis.ply --voxels 256\n"
      "  medial voxels part.stl -o part.png --resolution 0.5 --angle 10\n"
      "  medial voxels part.stl -o sheets.glb --surface\n"
      "  medial voxels part.stl -o force.ply --method potential\n"
      "  medial voxels tree.obj -o skeleton.obj --thin curves --stats");
  return command_of(command, arguments, run_voxels);
}

}  // namespace medial::cli
