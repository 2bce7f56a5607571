#pragma once

// The two nearest feet of a voxel, which decide whether it is medial.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "base/vec3.h"
#include "volume/closest.h"
#include "volume/grid.h"

namespace medial::volume {

/// The nearest point of the surface, and the nearest one that counts as distinct from it, in units
/// of the grid.
struct Feet {
  double radius = 0;
  /// The second distance minus the first one; infinite if that is not below the tolerance.
  double quality = std::numeric_limits<double>::infinity();
  std::array<Vec3, 2> foot;
  std::array<std::uint32_t, 2> face = {Voxel::no_face, Voxel::no_face};

  bool medial() const { return face[1] != Voxel::no_face; }
};

/// Finds the feet of voxels. With f the nearest point of the surface, at the distance r, and u the
/// direction from f to the voxel's centre p, a face's nearest point x at the distance s counts as a
/// second foot if
///  - s - r is below the tolerance (the report's quality);
///  - x and f are at least the angle apart as seen from p. Feet that coincide or nearly coincide,
///  as
///    on the faces around a concave edge or vertex, count as one; this covers the report's rules
///    for concave and for collinear edges;
///  - the ball that touches the surface at f, grown until it touches x, has its centre at most
///  `reach`
///    from p: at t = (s^2 - r^2) / (2 (r + u.(x - p))). It never touches points next to f on the
///    same plane, and touches points of a face beyond a convex edge only after that face's foot.
/// The exact axis of the mesh meets the segment from p to p + t u, because the largest ball that
/// touches f from that side is at most that large. So a medial voxel of any shape lies within
/// `reach` of the axis.
///
/// `reach` is the tolerance / (2 sin(angle / 2)). If the feet of a sheet are at an angle a, a point
/// p at the distance e from it has about s - r = 2 e sin(a / 2) and t = e / sin(a / 2). So all p
/// with e
/// <= 1/2 pass, and the voxels that pass contain a digital plane, which has no gaps.
///
/// Both searches examine every face that can matter and break ties by the faces' indices, so their
/// results are identical, bit for bit.
class FeetFinder {
 public:
  /// The working memory of one thread.
  class Scratch {
   public:
    std::uint64_t distances = 0;  ///< between points and faces, computed so far

   private:
    friend class FeetFinder;
    struct Bound {
      double squared = 0;
      std::uint32_t face = 0;
    };
    std::vector<std::uint32_t> stack;
    std::vector<Bound> list;  ///< of the sorted list: the faces in order of their lower bounds
  };

  /// `angle` in degrees, positive; `tolerance` in units of the grid.
  /// Keeps a reference to the tree.
  FeetFinder(const Grid& grid, const FaceTree& tree, bool sorted_list, double angle,
             double tolerance);

  /// The feet of p, which must be inside, at least 1/2 away from the surface. `hint` is any face,
  /// preferably a near one; the result does not depend on it.
  Feet feet(Vec3 p, std::uint32_t hint, Scratch& scratch) const;

  /// The nearest point of the surface, and the ray from there to p.
  struct Ray {
    Vec3 foot;
    Vec3 up;            ///< of length 1
    double length = 0;  ///< the distance of p
    std::uint32_t face = 0;
  };
  /// Requires p as feet() does. Always uses the tree.
  Ray ray(Vec3 p, std::uint32_t hint, Scratch& scratch) const;
  /// Whether two points are at least the angle apart as seen from p.
  bool seen_apart(Vec3 p, Vec3 a, Vec3 b) const {
    return dot(a - p, b - p) <= cosine_ * norm(a - p) * norm(b - p);
  }
  /// The largest distance of medial voxels from the exact axis.
  double reach() const { return reach_; }
  /// The point of the exact axis on a ray: the centre of the largest inner ball that touches the
  /// surface at the ray's foot. Nothing if that ball is larger than `largest`, or if its two feet
  /// are less than 1.5 times the angle apart, as seen from its centre. Shrinks a ball until it is
  /// empty (Ma, Bae and Choi 2012).
  std::optional<Vec3> axis_point(const Ray& ray, double largest, Scratch& scratch) const;

 private:
  Closest closest(Vec3 p, std::uint32_t face, Scratch& scratch) const {
    ++scratch.distances;
    return closest_point(p, triangles_[face]);
  }
  struct Foot {
    std::uint32_t face = 0;
    Closest at;
  };
  /// The nearest face; of several at equal distance, the lowest. `start` is any face.
  Foot nearest(Vec3 p, std::uint32_t start, bool by_tree, Scratch& scratch) const;
  bool in_cone(Vec3 p, Vec3 direction, const Box3& box) const;
  template <class Take>
  void visit_tree(Vec3 p, Scratch& scratch, Take take) const;
  void sort_list(Vec3 p, Scratch& scratch) const;

  const FaceTree& tree_;
  bool sorted_list_;
  double cosine_, sine_;
  double strong_;  ///< the cosine of the angle that axis_point() requires
  double tolerance_, reach_;
  std::vector<Triangle> triangles_;
};

}  // namespace medial::volume
