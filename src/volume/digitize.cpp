#include "volume/digitize.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/threads.h"
#include "base/vec3.h"
#include "volume/predicates.h"
#include "volume/topology.h"

namespace medial::volume {
namespace {

/// Half the edge of a voxel, and a little for the rounding of coordinates up to 2^13.
constexpr double half_edge = 0.5 + 1e-9;

/// Whether the line through the origin in the direction `axis` parts the triangle, given relative
/// to the centre, from the cube: separating axes after Akenine-Moller (2001).
bool separates(Vec3 axis, const Triangle& t) {
  const double a = dot(axis, t.corner[0]), b = dot(axis, t.corner[1]), c = dot(axis, t.corner[2]);
  const double reach = half_edge * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
  return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
}

/// Whether a cube around `center` with half_edge meets the triangle.
bool cube_meets(Vec3 center, const Triangle& triangle) {
  const Triangle t = {
      {triangle.corner[0] - center, triangle.corner[1] - center, triangle.corner[2] - center}};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = t.corner[0][axis], b = t.corner[1][axis], c = t.corner[2][axis];
    if (std::min({a, b, c}) > half_edge || std::max({a, b, c}) < -half_edge) return false;
  }
  const Vec3 side[3] = {t.corner[1] - t.corner[0], t.corner[2] - t.corner[1],
                        t.corner[0] - t.corner[2]};
  if (separates(cross(side[0], side[1]), t)) return false;
  for (const Vec3 s : side) {
    if (separates({0, -s.z, s.y}, t)) return false;
    if (separates({s.z, 0, -s.x}, t)) return false;
    if (separates({-s.y, s.x, 0}, t)) return false;
  }
  return true;
}

/// The cells that an interval meets, with a little around it, within [low, high).
struct CellRange {
  std::uint32_t begin, end;
};
CellRange cells_of(double from, double to, std::uint32_t low, std::uint32_t high) {
  constexpr double little = 1e-9;
  const double begin = std::floor(from - little), end = std::floor(to + little) + 1;
  return {static_cast<std::uint32_t>(std::clamp(begin, double(low), double(high))),
          static_cast<std::uint32_t>(std::clamp(end, double(low), double(high)))};
}

/// Adds the voxels of layers [low, high) that a face meets: in each column along the main axis of
/// its normal, those between the bounds that its plane sets.
void add_face(const Triangle& face, std::uint32_t low, std::uint32_t high, VoxelSet& surface) {
  const Box3 box = face.box();
  const GridSize& size = surface.size();
  std::array<CellRange, 3> range;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    range[k] =
        cells_of(box.low[axis], box.high[axis], axis == 2 ? low : 0, axis == 2 ? high : size[k]);
  }
  const Vec3 normal = cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]);
  const int main = longest_axis(normal);
  const int second = (main + 1) % 3, third = (main + 2) % 3;
  const auto index = [](int axis) { return static_cast<std::size_t>(axis); };
  // Over a square of the grid the plane rises by no more than this from its middle.
  const bool flat = !(std::abs(normal[main]) > 0);
  const double slope2 = flat ? 0 : normal[second] / normal[main];
  const double slope3 = flat ? 0 : normal[third] / normal[main];
  const double rise = half_edge * (std::abs(slope2) + std::abs(slope3));
  for (std::uint32_t i = range[index(second)].begin; i < range[index(second)].end; ++i) {
    for (std::uint32_t j = range[index(third)].begin; j < range[index(third)].end; ++j) {
      CellRange column = range[index(main)];
      if (!flat) {
        const double at = face.corner[0][main] - slope2 * (i + 0.5 - face.corner[0][second]) -
                          slope3 * (j + 0.5 - face.corner[0][third]);
        column = cells_of(at - rise, at + rise, column.begin, column.end);
      }
      for (std::uint32_t k = column.begin; k < column.end; ++k) {
        std::array<std::uint32_t, 3> at;
        at[index(main)] = k;
        at[index(second)] = i;
        at[index(third)] = j;
        const Cell cell = {at[0], at[1], at[2]};
        if (cube_meets(center_of(cell), face)) surface.insert(cell);
      }
    }
  }
}

/// Where the middle line of a row crosses a face.
struct Crossing {
  std::uint32_t z, y;
  double x;
};

/// Adds the crossings of rows of layers [low, high) with a face.
void add_crossings(const Triangle& face, std::uint32_t low, std::uint32_t high,
                   const GridSize& size, std::vector<Crossing>& crossings) {
  const Box3 box = face.box();
  const CellRange layers = cells_of(box.low.z - 0.5, box.high.z - 0.5, low, high);
  const CellRange rows = cells_of(box.low.y - 0.5, box.high.y - 0.5, 0, size[1]);
  const Vec3 normal = cross(face.corner[1] - face.corner[0], face.corner[2] - face.corner[0]);
  for (std::uint32_t z = layers.begin; z < layers.end; ++z) {
    for (std::uint32_t y = rows.begin; y < rows.end; ++y) {
      const Vec2 at{y + 0.5, z + 0.5};
      if (!line_crosses(at, face.corner)) continue;
      // The place along the row need not be exact, see digitize(), but within the face's box.
      const Vec3 origin = face.corner[0];
      const double x =
          origin.x - (normal.y * (at.x - origin.y) + normal.z * (at.y - origin.z)) / normal.x;
      crossings.push_back(
          {z, y, std::isfinite(x) ? std::clamp(x, box.low.x, box.high.x) : box.low.x});
    }
  }
}

}  // namespace

Digitized digitize(const Grid& grid, const std::function<bool()>& stop) {
  Digitized result{VoxelSet(grid.size), VoxelSet(grid.size)};
  const auto slabs = result.surface.slab_count();
  // Few faces are many voxels each, or many faces few voxels each: either way a slab of layers
  // looks through all faces once.
  parallel_for(slabs, [&](std::size_t s) {
    const auto slab = static_cast<std::uint32_t>(s);
    if (stop()) return;
    const std::uint32_t low = slab * 8, high = std::min(grid.size[2], low + 8);
    std::vector<Crossing> crossings;
    for (std::uint32_t f = 0; f < grid.faces.size(); ++f) {
      const Triangle face = grid.triangle(f);
      const Box3 box = face.box();
      if (box.high.z < low - 0.5 || box.low.z > high + 0.5) continue;
      add_face(face, low, high, result.surface);
      add_crossings(face, low, high, grid.size, crossings);
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
      return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    });
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const Crossing& in = crossings[i];
      const Crossing& out = crossings[i + 1];
      result.interior.insert_run(static_cast<std::uint32_t>(in.x),
                                 static_cast<std::uint32_t>(out.x) + 1, in.y, in.z);
    }
    result.interior.subtract(result.surface, slab);
    result.surface.compress(slab);
    result.interior.compress(slab);
  });
  return result;
}

std::vector<BoundedSet> bounded_sets(const VoxelSet& interior) {
  auto [runs, parts] = connected_runs(interior, false);
  std::vector<BoundedSet> sets;
  std::vector<std::uint32_t> set_of(runs.size());
  for (std::uint32_t i = 0; i < runs.size(); ++i) {
    const std::uint32_t first = parts.find(i);
    if (first == i) {
      set_of[i] = static_cast<std::uint32_t>(sets.size());
      sets.push_back({0, runs[i].z, runs[i].z, {}});
    }
    BoundedSet& set = sets[set_of[first]];
    set.voxels += runs[i].end - runs[i].begin;
    set.high = runs[i].z;
    set.runs.push_back(runs[i]);
  }
  return sets;
}

}  // namespace medial::volume
