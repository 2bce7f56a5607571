// The axis of closed meshes, from voxels.

#include <algorithm>

#include "binding.h"

namespace medial::python {
namespace {

using Vertices = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Faces = nb::ndarray<const std::uint32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

Thinning thinning_from(const std::string& name) {
  if (name == "none") return Thinning::none;
  if (name == "sheets") return Thinning::sheets;
  if (name == "curves") return Thinning::curves;
  refuse(ErrorCode::invalid_option, "thinning is 'none', 'sheets' or 'curves'");
}

nb::tuple tuple_of(const VoxelTopology& topology) {
  return nb::make_tuple(topology.components, topology.tunnels, topology.cavities);
}

/// The vertices, radii, triangles and lines of sheets and curves.
nb::tuple tuple_of(AxisSurface surface) {
  return nb::make_tuple(rows_of<double>(std::move(surface.vertices)),
                        array_of(std::move(surface.radii)),
                        rows_of<std::uint32_t>(std::move(surface.triangles)),
                        rows_of<std::uint32_t>(std::move(surface.lines)));
}

nb::dict voxels_of(const Vertices& vertices, const Faces& faces, double resolution, int voxels,
                   double angle, const std::string& thinning, bool surface, int order,
                   double gibibytes, int threads) {
  VoxelOptions options;
  options.resolution = resolution;
  options.voxels = voxels;
  options.angle = angle;
  options.thinning = thinning_from(thinning);
  options.surface = surface;
  options.order = order;
  options.memory = static_cast<std::uint64_t>(std::clamp(gibibytes, 0.0, 1e6) * 0x1p30);
  options.threads = threads;
  TriangleMesh mesh;
  for (std::size_t i = 0; i < vertices.shape(0); ++i)
    mesh.vertices.push_back({vertices(i, 0), vertices(i, 1), vertices(i, 2)});
  for (std::size_t i = 0; i < faces.shape(0); ++i)
    mesh.faces.push_back({faces(i, 0), faces(i, 1), faces(i, 2)});
  VoxelAxis axis = value_of(run(long_work, [&](const std::atomic<bool>* cancel) {
    options.cancel = cancel;
    auto solid = build_solid(std::move(mesh));
    return solid ? compute_voxels(*solid, options) : Result<VoxelAxis>(std::move(solid).error());
  }));
  std::vector<std::array<std::uint32_t, 3>> cells;
  std::vector<Vec3> centers;
  std::vector<double> radii, qualities;
  for (const Voxel& voxel : axis.voxels) {
    cells.push_back(voxel.cell);
    centers.push_back(voxel.center);
    radii.push_back(voxel.radius);
    qualities.push_back(voxel.quality);
  }
  nb::dict result;
  result["resolution"] = axis.resolution;
  result["origin"] = nb::make_tuple(axis.origin.x, axis.origin.y, axis.origin.z);
  result["shape"] = nb::make_tuple(axis.cells[0], axis.cells[1], axis.cells[2]);
  result["cells"] = rows_of<std::uint32_t>(std::move(cells));
  result["centers"] = rows_of<double>(std::move(centers));
  result["radii"] = array_of(std::move(radii));
  result["qualities"] = array_of(std::move(qualities));
  result["links"] = rows_of<std::uint32_t>(std::move(axis.links));
  result["surface"] = tuple_of(std::move(axis.surface));
  result["topology"] = tuple_of(axis.topology);
  result["interior"] = tuple_of(axis.interior);
  return result;
}

}  // namespace

void bind_solids(nb::module_& module) { module.def("voxels_of", &voxels_of); }

}  // namespace medial::python
