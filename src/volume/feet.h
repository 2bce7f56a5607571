#pragma once

// The two nearest feet of a voxel: what decides whether it is medial.

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

/// The nearest point of the surface, and the second nearest that counts as another one, in units of
/// the grid.
struct Feet {
  double radius = 0;
  /// Second distance less the first one; infinite where that is not below the tolerance.
  double quality = std::numeric_limits<double>::infinity();
  std::array<Vec3, 2> foot;
  std::array<std::uint32_t, 2> face = {Voxel::no_face, Voxel::no_face};

  bool medial() const { return face[1] != Voxel::no_face; }
};

/// Finds the feet of voxels. With f the nearest point of the surface, at the distance r, and u the
/// direction from f to the voxel's centre p, a face's nearest point x at the distance s counts as a
/// second foot if
///  - s - r is below the tolerance (the report's quality);
///  - x and f lie at least the angle apart as seen from p. Two feet that coincide, as those on
///  faces
///    around a concave edge or vertex do, or that nearly do, are one: the report's rules of concave
///    and of collinear edges in one;
///  - the ball that touches the surface in f, grown until it touches x, has its centre not farther
///    than `reach` from p: at t = (s^2 - r^2) / (2 (r + u.(x - p))). Points beside f on its own
///    plane are touched never, those of faces beyond a convex edge not before their face's foot is.
/// The exact axis of the mesh meets the segment from p to p + t u, because the largest ball that
/// touches f from that side is at most that large. So a medial voxel lies within `reach` of it,
/// whatever the shape.
///
/// `reach` is the tolerance / (2 sin(angle / 2)), for this reason: where a sheet's feet lie at an
/// angle a, p at a distance e from it has s - r = 2 e sin(a / 2) and t = e / sin(a / 2), about. So
/// all p with e <= 1/2 pass, and the voxels that do hold a digital plane, which has no gaps.
///
/// Both searches look at every face that can matter and break ties by the faces' indices, so their
/// answers are the same, bit for bit.
class FeetFinder {
 public:
  /// What one thread needs for itself.
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

  /// The feet of p. Requires p at least 1/2 away from the surface, inside. `hint` is any face,
  /// best a near one; the answer does not depend on it.
  Feet feet(Vec3 p, std::uint32_t hint, Scratch& scratch) const;

  /// The nearest point of the surface, and the way from there to p.
  struct Ray {
    Vec3 foot;
    Vec3 up;            ///< of length 1
    double length = 0;  ///< the distance of p
    std::uint32_t face = 0;
  };
  /// Requires p as feet() does; by the tree, whatever the search.
  Ray ray(Vec3 p, std::uint32_t hint, Scratch& scratch) const;
  /// Whether two points are seen from p at the angle apart, or more.
  bool seen_apart(Vec3 p, Vec3 a, Vec3 b) const {
    return dot(a - p, b - p) <= cosine_ * norm(a - p) * norm(b - p);
  }
  /// How far from the exact axis medial voxels lie at most.
  double reach() const { return reach_; }
  /// The point of the exact axis on a ray: the centre of the largest ball inside that touches the
  /// surface in its foot. Nothing if that is larger than `largest`, or if the two feet of the ball
  /// lie less than the angle and a half apart, as seen from it. By a ball that shrinks until it is
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
  /// The nearest face, of several at one distance the lowest; `start` is some face.
  Foot nearest(Vec3 p, std::uint32_t start, bool by_tree, Scratch& scratch) const;
  bool in_cone(Vec3 p, Vec3 direction, const Box3& box) const;
  template <class Take>
  void visit_tree(Vec3 p, Scratch& scratch, Take take) const;
  void sort_list(Vec3 p, Scratch& scratch) const;

  const FaceTree& tree_;
  bool sorted_list_;
  double cosine_, sine_;
  double strong_;  ///< the cosine of what axis_point() asks for
  double tolerance_, reach_;
  std::vector<Triangle> triangles_;
};

}  // namespace medial::volume
