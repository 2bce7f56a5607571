#include "volume/surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/threads.h"
#include "volume/complex.h"

namespace medial::volume {
namespace {

constexpr std::size_t voxels_at_once = 256;
constexpr double far_off = std::numeric_limits<double>::infinity();

/// The low corner of a voxel.
Vec3 point_of(Cell cell) { return center_of(cell) - Vec3{0.5, 0.5, 0.5}; }

/// Off the centre of a voxel by a little, in no direction that solids have: where the axis is a
/// curve in a plane of centres the way between two of them would cross it.
Vec3 sample_point(Cell cell) { return center_of(cell) + Vec3{0.0137, 0.0229, -0.0181}; }

/// A voxel and the face that is nearest to its sample point.
struct Sample {
  std::uint64_t rank = 0;
  std::uint32_t face = 0;
};

template <class T>
const T* find_rank(const std::vector<T>& sorted, std::uint64_t rank) {
  const auto less = [](const T& a, std::uint64_t r) { return a.rank < r; };
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), rank, less);
  return at != sorted.end() && at->rank == rank ? &*at : nullptr;
}

/// What all steps share.
struct Input {
  const Grid& grid;
  const FeetFinder& finder;
  const std::vector<MedialVoxel>& voxels;  ///< by rank
};

/// Calls work(i, scratch) for each i below `count`, on several threads.
template <class Work>
void each_with_scratch(std::size_t count, const Work& work) {
  Pool<FeetFinder::Scratch> pool;
  parallel_ranges(count, voxels_at_once, [&](std::size_t begin, std::size_t end) {
    pool.with_one([&](FeetFinder::Scratch& scratch) {
      for (std::size_t i = begin; i < end; ++i) work(i, scratch);
    });
  });
}

/// The voxels of a set and the interior voxels next to their faces, with the nearest face of each.
std::vector<Sample> sample(const Input& input, const VoxelSet& interior, const VoxelSet& kept) {
  VoxelSet near = kept;
  each_voxel(kept, [&](Cell cell) {
    for (Neighbourhood bits = interior.around(cell) & face_bits; bits != 0; bits &= bits - 1)
      near.insert(neighbour(cell, std::countr_zero(bits)));
  });
  std::vector<Sample> samples;
  each_voxel(near, [&](Cell cell) { samples.push_back({rank_of(cell, input.grid.size)}); });
  each_with_scratch(samples.size(), [&](std::size_t i, FeetFinder::Scratch& scratch) {
    const MedialVoxel* known = find_rank(input.voxels, samples[i].rank);
    const Vec3 point = sample_point(cell_of(samples[i].rank, input.grid.size));
    samples[i].face = input.finder.ray(point, known ? known->face[0] : 0, scratch).face;
  });
  return samples;
}

/// Whether the nearest foot jumps by the angle or more between p, whose nearest face is `from`, and
/// q, whose is `to`.
bool separated(const Input& input, Vec3 p, std::uint32_t from, Vec3 q, std::uint32_t to,
               FeetFinder::Scratch& scratch, int depth = 0) {
  constexpr int deepest = 12, halvings = 40;
  if (from == to) return false;
  const Triangle a = input.grid.triangle(from), b = input.grid.triangle(to);
  Vec3 low = p, high = q;  // where `from` is the nearer of the two, where `to` is
  for (int i = 0; i < halvings; ++i) {
    const Vec3 middle = 0.5 * (low + high);
    const bool first =
        closest_point(middle, a).squared_distance <= closest_point(middle, b).squared_distance;
    (first ? low : high) = middle;
  }
  const Vec3 x = 0.5 * (low + high);
  const Closest near = closest_point(x, a), other = closest_point(x, b);
  if (!input.finder.seen_apart(x, near.point, other.point)) return false;
  const FeetFinder::Ray ray = input.finder.ray(x, from, scratch);
  constexpr double slack = 1e-9;  // x is off by a part in 2^40 of a voxel, feet by 1e-11
  const double distance = std::sqrt(std::max(near.squared_distance, other.squared_distance));
  if (ray.length >= distance - slack || depth == deepest) return true;
  return separated(input, p, from, x, ray.face, scratch, depth + 1) ||
         separated(input, x, ray.face, q, to, scratch, depth + 1);
}

/// The squares, with their faces, between voxels that the axis separates.
CubicalComplex sheets_of(const Input& input, const VoxelSet& kept, const GridSize& size,
                         const std::vector<Sample>& samples) {
  std::vector<std::array<bool, 3>> found(samples.size());
  each_with_scratch(samples.size(), [&](std::size_t i, FeetFinder::Scratch& scratch) {
    const Cell cell = cell_of(samples[i].rank, input.grid.size);
    const std::array<Cell, 3> next = {Cell{cell.x + 1, cell.y, cell.z},
                                      Cell{cell.x, cell.y + 1, cell.z},
                                      Cell{cell.x, cell.y, cell.z + 1}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Sample* other = find_rank(samples, rank_of(next[axis], input.grid.size));
      if (!other || !(kept.contains(cell) || kept.contains(next[axis]))) continue;
      found[i][axis] = separated(input, sample_point(cell), samples[i].face,
                                 sample_point(next[axis]), other->face, scratch);
    }
  });
  CubicalComplex sheets(size);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Cell cube = cube_of(cell_of(samples[i].rank, input.grid.size));
    if (found[i][0]) insert_closed(sheets, {cube.x + 1, cube.y, cube.z});
    if (found[i][1]) insert_closed(sheets, {cube.x, cube.y + 1, cube.z});
    if (found[i][2]) insert_closed(sheets, {cube.x, cube.y, cube.z + 1});
  }
  return sheets;
}

/// The medial voxels around a corner.
std::vector<const MedialVoxel*> voxels_around(const Input& input, Cell corner) {
  std::vector<const MedialVoxel*> around;
  for (std::uint32_t k = 0; k < 8; ++k) {
    const Cell cell = {corner.x - (k & 1U), corner.y - (k >> 1U & 1U), corner.z - (k >> 2U)};
    const MedialVoxel* voxel = find_rank(input.voxels, rank_of(cell, input.grid.size));
    if (voxel && voxel->face[1] != Voxel::no_face) around.push_back(voxel);
  }
  return around;
}

/// The centre of the ball that touches a voxel's nearest foot and grows until it touches the second
/// one (volume/feet.h).
Vec3 grown_center(const Input& input, const MedialVoxel& voxel) {
  const Vec3 p = center_of(cell_of(voxel.rank, input.grid.size));
  const Closest foot = closest_point(p, input.grid.triangle(voxel.face[0]));
  const Closest other = closest_point(p, input.grid.triangle(voxel.face[1]));
  const double radius = std::sqrt(foot.squared_distance);
  const Vec3 up = 1 / radius * (p - foot.point);
  const double lag = other.squared_distance - foot.squared_distance;
  return p + lag / (2 * (radius + dot(up, other.point - p))) * up;
}

/// Where the axis is near a corner, if it is a curve: the mean of the balls' centres.
std::optional<Vec3> place_on_curve(const Input& input, Cell corner) {
  const auto around = voxels_around(input, corner);
  if (around.empty()) return std::nullopt;
  Vec3 sum;
  for (const MedialVoxel* voxel : around) sum = sum + grown_center(input, *voxel);
  return 1 / static_cast<double>(around.size()) * sum;
}

/// From p to where the two feet of each voxel are equally far: the least squares step, damped, so
/// that it leads across a smooth sheet, not along it.
Vec3 step_to_sheets(const Input& input, Vec3 p, const std::vector<const MedialVoxel*>& voxels) {
  constexpr double damping = 0.05;
  Vec3 x{damping, 0, 0}, y{0, damping, 0}, z{0, 0, damping}, right;
  for (const MedialVoxel* voxel : voxels) {
    const Closest a = closest_point(p, input.grid.triangle(voxel->face[0]));
    const Closest b = closest_point(p, input.grid.triangle(voxel->face[1]));
    const double near = std::sqrt(a.squared_distance), far = std::sqrt(b.squared_distance);
    if (!(near > 0 && far > 0)) continue;
    const Vec3 slope = 1 / near * (a.point - p) - 1 / far * (b.point - p);
    x = x + slope.x * slope;
    y = y + slope.y * slope;
    z = z + slope.z * slope;
    right = right - (far - near) * slope;
  }
  const double scale = 1 / dot(x, cross(y, z));
  return scale * (right.x * cross(y, z) + right.y * cross(z, x) + right.z * cross(x, y));
}

/// Where a corner of a sheet goes: at most by `reach` along each direction, then to where its own
/// two feet are equally far.
Vec3 place_on_sheets(const Input& input, Cell corner, FeetFinder::Scratch& scratch) {
  constexpr int steps = 4, own_steps = 2;
  constexpr double reach = 1;
  const auto around = voxels_around(input, corner);
  const Vec3 start = point_of(corner);
  Vec3 p = start;
  for (int i = 0; i < steps; ++i) {
    p = p + step_to_sheets(input, p, around);
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = std::clamp(p[axis], start[axis] - reach, start[axis] + reach);
  }
  for (int i = 0; i < own_steps; ++i) {
    const Feet feet = input.finder.feet(p, around.empty() ? 0 : around[0]->face[0], scratch);
    if (!feet.medial()) break;
    const Vec3 slope = 1 / feet.radius * (feet.foot[0] - p) -
                       1 / (feet.radius + feet.quality) * (feet.foot[1] - p);
    p = p - feet.quality / squared_norm(slope) * slope;
  }
  return p;
}

/// Takes away patches of sheets of fewer than `least` squares: where the way between two samples
/// happens to meet a curve.
void drop_patches(CubicalComplex& sheets, std::size_t least) {
  VoxelSet seen(sheets.size());
  CubicalComplex kept(sheets.size());
  std::vector<Cell> patch;
  each_voxel(sheets, [&](Cell square) {
    if (dimension(square) != 2 || !seen.insert(square)) return;
    patch.assign(1, square);
    for (std::size_t i = 0; i < patch.size(); ++i)
      each_cell(patch[i], faces_of(patch[i]), [&](Cell edge) {
        if (dimension(edge) == 1)
          each_cell(edge, cofaces_of(edge) & sheets.around(edge), [&](Cell other) {
            if (seen.insert(other)) patch.push_back(other);
          });
      });
    if (patch.size() >= least)
      for (const Cell cell : patch) insert_closed(kept, cell);
  });
  sheets = std::move(kept);
}

/// The points of a complex, in the order of their indices.
class Points {
 public:
  explicit Points(const CubicalComplex& complex) : size_(complex.size()) {
    each_voxel(complex, [&](Cell cell) {
      if (dimension(cell) == 0) ranks_.push_back(rank_of(cell, size_));
    });
  }
  std::size_t count() const { return ranks_.size(); }
  Cell cell(std::size_t i) const { return cell_of(ranks_[i], size_); }
  Cell corner(std::size_t i) const { return {cell(i).x / 2, cell(i).y / 2, cell(i).z / 2}; }
  std::uint32_t index(Cell cell) const {
    const auto at = std::lower_bound(ranks_.begin(), ranks_.end(), rank_of(cell, size_));
    return static_cast<std::uint32_t>(at - ranks_.begin());
  }

 private:
  GridSize size_;
  std::vector<std::uint64_t> ranks_;
};

/// Two triangles, by the shorter diagonal.
void add_square(const std::array<std::uint32_t, 4>& corner, AxisSurface& surface) {
  const auto length = [&](std::size_t i, std::size_t j) {
    return distance(surface.vertices[corner[i]], surface.vertices[corner[j]]);
  };
  const auto [a, b, c, d] = corner;
  if (length(0, 2) <= length(1, 3)) {
    surface.triangles.insert(surface.triangles.end(), {{a, b, c}, {a, c, d}});
  } else {
    surface.triangles.insert(surface.triangles.end(), {{a, b, d}, {b, c, d}});
  }
}

/// Squares become triangles, edges of no square lines.
void add_cells(const CubicalComplex& complex, const Points& points, AxisSurface& surface) {
  each_voxel(complex, [&](Cell cell) {
    std::array<std::uint32_t, 4> corners;  // of a square: two on one side, two on the other
    std::size_t count = 0;
    const bool square = dimension(cell) == 2;
    if (!square && (dimension(cell) != 1 || (complex.around(cell) & cofaces_of(cell)) != 0)) return;
    each_corner(cell, [&](Cell corner) { corners[count++] = points.index(corner); });
    if (square) {
      add_square({corners[0], corners[1], corners[3], corners[2]}, surface);
    } else {
      surface.lines.push_back({corners[0], corners[1]});
    }
  });
}

}  // namespace

AxisSurface surface_of(const Grid& grid, const VoxelSet& interior, const VoxelSet& kept,
                       std::vector<MedialVoxel> voxels, const FeetFinder& finder,
                       Control& control) {
  std::sort(voxels.begin(), voxels.end(),
            [](const MedialVoxel& a, const MedialVoxel& b) { return a.rank < b.rank; });
  const Input input{grid, finder, voxels};
  CubicalComplex complex = complex_of(kept);
  control.check(2 * complex.bytes() + voxels.size() * sizeof(MedialVoxel));
  const std::vector<Sample> samples = sample(input, interior, kept);
  const Points all(complex);
  std::vector<std::optional<Vec3>> centers(all.count());
  each_with_scratch(all.count(), [&](std::size_t i, FeetFinder::Scratch&) {
    centers[i] = place_on_curve(input, all.corner(i));
  });
  const auto off_axis = [&](Cell cell) {
    double off = 0;
    each_corner(cell, [&](Cell corner) {
      const std::uint32_t i = all.index(corner);
      off = std::max(off, centers[i] ? distance(*centers[i], point_of(all.corner(i))) : far_off);
    });
    return off;
  };
  const double reach = finder.reach();
  CubicalComplex sheets = sheets_of(input, kept, complex.size(), samples);
  drop_patches(sheets, static_cast<std::size_t>(4 * reach * reach));
  collapse(complex, sheets, static_cast<int>(std::ceil(std::sqrt(3.0) * reach)), off_axis, control);
  const Points points(complex);
  AxisSurface surface;
  surface.vertices.resize(points.count());
  surface.radii.resize(points.count());
  each_with_scratch(points.count(), [&](std::size_t i, FeetFinder::Scratch& scratch) {
    const Cell cell = points.cell(i);
    const std::optional<Vec3>& center = centers[all.index(cell)];
    surface.vertices[i] = sheets.contains(cell) ? place_on_sheets(input, points.corner(i), scratch)
                                                : center.value_or(point_of(points.corner(i)));
    surface.radii[i] = finder.ray(surface.vertices[i], 0, scratch).length;
  });
  add_cells(complex, points, surface);
  return surface;
}

}  // namespace medial::volume
