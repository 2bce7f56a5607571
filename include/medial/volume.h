#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <vector>

#include "medial/error.h"
#include "medial/statistics.h"

namespace medial {

/// Triangles as a file holds them: of any orientation, with or without shared vertices.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< indices into vertices
};

struct VoxelTopology {  // Betti numbers
  std::uint64_t components = 0;
  std::int64_t tunnels = 0;
  std::uint64_t cavities = 0;
  friend bool operator==(const VoxelTopology&, const VoxelTopology&) = default;
};

struct MeshReport {
  std::uint64_t input_vertices = 0, input_faces = 0, joined_vertices = 0, unused_vertices = 0;
  std::uint64_t dropped_faces = 0;    ///< with two corners in one place
  std::uint64_t reversed_faces = 0;   ///< with a normal that pointed into the solid
  std::uint64_t parted_vertices = 0;  ///< added where surfaces touched in a vertex only
};

/// A bounded part of space with a closed surface: every edge has two faces, every vertex one fan.
struct Solid {
  TriangleMesh surface;
  std::vector<std::uint32_t> source;  ///< of each face: its index in the input
  VoxelTopology topology;
  MeshReport report;
};

/// Makes a solid from a mesh, and repairs what MeshReport counts, by exact decisions. A point in an
/// odd number of closed surfaces is inside. O(n log n) unless most faces are near each other.
/// Errors, with the place: empty, not_finite, too_large (2^31 vertices or faces), unsupported
/// (coordinates above 1e100), malformed (an index out of range), open_surface, non_manifold,
/// crossing, overlap (of faces beyond corners and edges), no_area, out_of_memory.
Result<Solid> build_solid(TriangleMesh mesh);

enum class Thinning : std::uint8_t {
  none,    ///< all voxels below the tolerance: sheets up to several voxels thick
  sheets,  ///< sheets one voxel thick
  curves,  ///< sheets become curves, except where they enclose a cavity
};

struct VoxelOptions {
  double resolution = 0;     ///< edge of a voxel, in units of the input; 0: from `voxels`
  int voxels = 128;          ///< along the longest side of the bounding box, in [4, 4096]
  double angle = 30;         ///< least angle between a voxel's two feet, in degrees in [1, 120]
  bool sorted_list = false;  ///< the report's search: same result, but O(faces) per voxel
  Thinning thinning = Thinning::sheets;
  bool surface = false;  ///< make VoxelAxis::surface, which is never thinned
  int order = 0;         ///< if not 0, make only the surface, from force lines of a potential
  std::uint64_t memory = std::uint64_t{4} << 30U;  ///< approximate limit, in bytes
  int threads = 0;                                 ///< this and the next two: see Options
  std::function<void(double)> progress = {};       ///< called by one thread at a time
  const std::atomic<bool>* cancel = nullptr;
};

/// A voxel of the axis: two points of the surface are about equally near to its centre.
struct Voxel {
  static constexpr std::uint32_t no_face = std::numeric_limits<std::uint32_t>::max();
  std::array<std::uint32_t, 3> cell = {};  ///< column, row, layer: x, y, z
  Vec3 center;
  double radius = 0;
  double quality = 0;  ///< excess distance of the second foot; infinite: only for the topology
  std::array<std::uint32_t, 2> face = {no_face, no_face};  ///< of the two feet, in the input
};

/// Sheets as triangles and curves as lines, with the homotopy type of the interior. Except on
/// bridges, vertices lie within half a voxel of the exact axis.
struct AxisSurface {
  std::vector<Vec3> vertices;
  std::vector<double> radii;  ///< of the vertices
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> lines;
};

struct VoxelAxis {
  double resolution = 0;                    ///< edge of a voxel
  Vec3 origin;                              ///< low corner of cell (0, 0, 0)
  std::array<std::uint32_t, 3> cells = {};  ///< of the grid
  std::vector<Voxel> voxels;                ///< by increasing x within y within z
  /// Pairs of voxels that share a corner, sorted, lower first; none that a third one connects.
  std::vector<std::array<std::uint32_t, 2>> links;
  AxisSurface surface;
  VoxelTopology topology;  ///< of the voxels as cubes that share faces, edges and corners
  VoxelTopology interior;  ///< of all interior voxels; the solid's if the grid is fine enough
  VoxelStatistics statistics;
};

/// The medial axis of a solid by ridge following (docs/voxels.md): voxels with the topology of the
/// interior. Memory: O(voxels of surface and axis + volume / 512). Errors: cancelled, empty,
/// invalid_option, too_large, malformed, out_of_memory, unsupported (no convex edge).
Result<VoxelAxis> compute_voxels(const Solid& solid, const VoxelOptions& options = {});

}  // namespace medial
