// The medial axis of a solid on a grid: the driver.

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "base/in_flight.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "base/vec3.h"
#include "medial/volume.h"
#include "volume/control.h"
#include "volume/digitize.h"
#include "volume/feet.h"
#include "volume/follow.h"
#include "volume/force.h"
#include "volume/grid.h"
#include "volume/surface.h"
#include "volume/thin.h"
#include "volume/topology.h"

namespace medial {
namespace {

using namespace volume;

constexpr int fewest_voxels = 4, most_voxels = 4096;
/// Empty cells on each side of the solid.
constexpr std::uint32_t margin = 2;
/// One edge of a voxel and a little: where a sheet lies halfway between two layers of voxels both
/// qualities are 1, up to rounding (report, Section A.3, step 6).
constexpr double tolerance = 1 + 1e-6;

std::optional<Error> refuse(const Solid& solid, const VoxelOptions& options) {
  const auto invalid = [](const char* text) { return Error{ErrorCode::invalid_option, text, {}}; };
  if (!(options.resolution >= 0) || !std::isfinite(options.resolution))
    return invalid("the resolution must be positive, or 0");
  if (options.voxels < fewest_voxels || options.voxels > most_voxels)
    return invalid("the number of voxels must be in [4, 4096]");
  if (!(options.angle >= 1 && options.angle <= 120))
    return invalid("the angle must be in [1, 120] degrees");
  if (options.order != 0 && (options.order < 2 || options.order > 64))
    return invalid("the order of the potential must be in [2, 64]");
  if (options.threads < 0 || options.threads > most_threads)
    return invalid("the number of threads must be in [0, 1024]");
  const TriangleMesh& mesh = solid.surface;
  if (mesh.faces.empty()) return Error{ErrorCode::empty, "the solid is empty", {}};
  bool consistent = solid.source.size() == mesh.faces.size();
  for (const Face& face : mesh.faces)
    for (const std::uint32_t vertex : face)
      consistent = consistent && vertex < mesh.vertices.size();
  for (const Vec3 p : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) consistent = consistent && std::isfinite(p[axis]);
  if (!consistent)
    return Error{ErrorCode::malformed, "the solid was not made by build_solid()", {}};
  return std::nullopt;
}

/// The grid around the solid, in the middle of it.
Result<Grid> make_grid(const Solid& solid, const VoxelOptions& options) {
  const Box3 box = box_of(solid.surface.vertices);
  const Vec3 sides = box.high - box.low;
  const double longest = std::max({sides.x, sides.y, sides.z});
  Grid grid;
  grid.step = options.resolution > 0 ? options.resolution : longest / options.voxels;
  const double cells = longest / grid.step;
  if (!(cells <= most_voxels))
    return Error{ErrorCode::too_large, "the grid has more than 4096 voxels on a side", {}};
  if (!(grid.step > 0) || !std::isfinite(grid.step))
    return Error{ErrorCode::no_area, "the solid has no extent", {}};
  std::uint64_t bytes = solid.surface.faces.size() * 400;
  for (int axis = 0; axis < 3; ++axis) {
    // A side of whole voxels gets no further one for its rounding.
    const double count = std::ceil(sides[axis] / grid.step - 1e-9);
    const auto k = static_cast<std::size_t>(axis);
    grid.size[k] = static_cast<std::uint32_t>(std::max(count, 1.0)) + 2 * margin;
    grid.origin[axis] = box.low[axis] + 0.5 * (sides[axis] - grid.size[k] * grid.step);
  }
  constexpr std::uint64_t sets = 5;  // that exist at the same time
  bytes += sets * VoxelSet::bytes_of_empty(grid.size);
  Control(options).check(bytes);
  grid.vertices.reserve(solid.surface.vertices.size());
  for (const Vec3 p : solid.surface.vertices)
    grid.vertices.push_back(1 / grid.step * (p - grid.origin));
  grid.faces = solid.surface.faces;
  return grid;
}

/// For each neighbour, the voxels of the box that it spans with the middle, without the two.
constexpr std::array<Neighbourhood, 27> make_between() {
  std::array<Neighbourhood, 27> between = {};
  for (int bit = 0; bit < 27; ++bit) {
    const int dx = bit % 3 - 1, dy = bit / 3 % 3 - 1, dz = bit / 9 - 1;
    for (int other = 0; other < 8; ++other) {
      const int place =
          bit_of((other & 1) != 0 ? dx : 0, (other & 2) != 0 ? dy : 0, (other & 4) != 0 ? dz : 0);
      if (place != bit && place != 13) between[static_cast<std::size_t>(bit)] |= 1U << place;
    }
  }
  return between;
}

void link_voxels(const VoxelSet& set, const std::vector<MedialVoxel>& voxels, VoxelAxis& axis) {
  static constexpr std::array<Neighbourhood, 27> between = make_between();
  constexpr Neighbourhood later = ~((center_bit << 1U) - 1);  // by rank
  for (std::uint32_t i = 0; i < voxels.size(); ++i) {
    const Cell cell = cell_of(voxels[i].rank, set.size());
    const Neighbourhood around = set.around(cell);
    for (Neighbourhood bits = around & later; bits != 0; bits &= bits - 1) {
      const int bit = std::countr_zero(bits);
      if ((around & between[static_cast<std::size_t>(bit)]) != 0) continue;
      const std::uint64_t rank = rank_of(neighbour(cell, bit), set.size());
      const auto other =
          std::lower_bound(voxels.begin() + i, voxels.end(), rank,
                           [](const MedialVoxel& v, std::uint64_t r) { return v.rank < r; });
      axis.links.push_back({i, static_cast<std::uint32_t>(other - voxels.begin())});
    }
  }
}

/// Follows ridges until bridges between the voxels found lead to no new medial voxels. Returns the
/// voxels of the axis and of bridges, which have the topology of the interior.
VoxelSet bridged(RidgeFollower& follower, const VoxelSet& interior, Control& control) {
  for (;;) {
    VoxelSet kept = peel(interior, follower.medial(), control);
    std::vector<std::uint64_t> bridges;
    each_voxel(kept, [&](Cell cell) {
      if (!follower.medial().contains(cell)) bridges.push_back(rank_of(cell, interior.size()));
    });
    std::erase_if(follower.voxels(), [](const MedialVoxel& v) { return std::isinf(v.quality); });
    if (!follower.add_bridges(bridges)) return kept;
    follower.follow();
  }
}

/// In the units of the input, with the input's faces.
Voxel voxel_of(const MedialVoxel& voxel, const Grid& grid, const Solid& solid) {
  const Cell cell = cell_of(voxel.rank, grid.size);
  Voxel out;
  out.cell = {cell.x, cell.y, cell.z};
  out.center = grid.origin + grid.step * center_of(cell);
  out.radius = grid.step * voxel.radius;
  out.quality = grid.step * voxel.quality;
  for (std::size_t k = 0; k < 2; ++k)
    if (voxel.face[k] != Voxel::no_face) out.face[k] = solid.source[voxel.face[k]];
  return out;
}

/// Fills the axis with the remaining voxels, in units of the input.
void collect(const VoxelSet& kept, std::vector<MedialVoxel> voxels, const Grid& grid,
             const Solid& solid, VoxelAxis& axis) {
  std::sort(voxels.begin(), voxels.end(),
            [](const MedialVoxel& a, const MedialVoxel& b) { return a.rank < b.rank; });
  axis.topology = topology_of(kept);
  link_voxels(kept, voxels, axis);
  axis.resolution = grid.step;
  axis.origin = grid.origin;
  axis.cells = grid.size;
  axis.voxels.reserve(voxels.size());
  for (const MedialVoxel& voxel : voxels) axis.voxels.push_back(voxel_of(voxel, grid, solid));
  for (Vec3& p : axis.surface.vertices) p = grid.origin + grid.step * p;
  for (double& radius : axis.surface.radii) radius *= grid.step;
}

/// Nothing but the surface along force lines.
Result<VoxelAxis> with_forces(VoxelAxis axis, const Grid& grid, const Solid& solid) {
  if (axis.surface.vertices.empty())
    return Error{ErrorCode::unsupported,
                 "no force line starts: at no edge the surface turns outwards by the angle",
                 {}};
  collect(VoxelSet(grid.size), {}, grid, solid, axis);
  return axis;
}

Result<VoxelAxis> run(const Solid& solid, const VoxelOptions& options) {
  Stopwatch total, lap;
  Control control(options);
  control.check(0);
  auto made = make_grid(solid, options);
  if (!made) return std::move(made).error();
  const Grid& grid = *made;
  const FaceTree tree(grid.vertices, grid.faces);
  const FeetFinder finder(grid, tree, options.sorted_list, options.angle, tolerance);
  VoxelAxis axis;
  VoxelStatistics& statistics = axis.statistics;
  statistics.seconds_tree = lap.lap();

  Digitized digitized = digitize(grid, [&] { return control.stopped(); });
  control.check(digitized.surface.bytes() + digitized.interior.bytes());
  statistics.surface_voxels = digitized.surface.count();
  digitized.surface = VoxelSet();
  const VoxelSet& interior = digitized.interior;
  statistics.interior_voxels = interior.count();
  axis.interior = topology_of(interior);
  control.report(0.1);
  statistics.seconds_digitize = lap.lap();

  if (options.order > 0) {
    const ForceField field(grid, tree, options.order);
    axis.surface = force_surface(field, grid, finder, options.angle, control);
    return with_forces(std::move(axis), grid, solid);
  }
  RidgeFollower follower(grid, interior, finder, control);
  for (const BoundedSet& set : bounded_sets(interior)) {
    ++statistics.bounded_sets;
    follower.find_first(set);
  }
  statistics.seconds_first = lap.lap();
  follower.follow();
  follower.find_islands();
  follower.follow();
  statistics.seconds_follow = lap.lap();

  VoxelSet kept = bridged(follower, interior, control);
  std::vector<MedialVoxel> voxels = std::move(follower.voxels());
  statistics.tested_voxels = follower.tested();
  statistics.face_distances = follower.distances();
  for (const MedialVoxel& voxel : voxels)
    ++(std::isinf(voxel.quality) ? statistics.bridge_voxels : statistics.medial_voxels);
  statistics.seconds_bridge = lap.lap();
  control.report(0.9);

  if (options.surface) axis.surface = surface_of(grid, interior, kept, voxels, finder, control);
  thin(kept, voxels, options.thinning, grid.size, control);
  collect(kept, std::move(voxels), grid, solid, axis);
  statistics.seconds_thin = lap.lap();
  statistics.seconds = total.lap();
  statistics.threads = effective_threads(options.threads);
  control.check(0);
  control.report(1);
  return axis;
}

}  // namespace

Result<VoxelAxis> compute_voxels(const Solid& solid, const VoxelOptions& options) {
  try {
    if (auto error = refuse(solid, options)) return std::move(*error);
    return on_threads(options.threads, [&] { return run(solid, options); });
  } catch (const Interrupted& interrupted) {
    return interrupted.error;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
