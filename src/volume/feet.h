#pragma once

// The two nearest feet of a voxel: what decides whether it is medial.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

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

/// Tells the feet of voxels. A foot of p on a face counts as a second one beside the nearest, f, if
///  - no face that shares the corner or side on which it lies is nearer to p: else it is no foot at
///    all, but the place where its face comes nearest to the foot on its neighbour. This is the
///    report's rule of the concave angle, for any number of faces around a corner, and for convex
///    and flat angles as well;
///  - the directions from p to it and to f differ by the angle at least: two feet that coincide, or
///    nearly so, are one. This is the report's rule of collinear edges, measured where it matters.
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

  /// `angle` in degrees; `tolerance` in units of the grid: how far the second foot may be farther.
  /// Keeps references to the grid and the tree.
  FeetFinder(const Grid& grid, const FaceTree& tree, FaceSearch search, double angle,
             double tolerance);

  /// The feet of p. Requires p at least 1/2 away from the surface, inside. `hint` is any face,
  /// best a near one; the answer does not depend on it.
  Feet feet(Vec3 p, std::uint32_t hint, Scratch& scratch) const;

 private:
  Closest closest(Vec3 p, std::uint32_t face, Scratch& scratch) const {
    ++scratch.distances;
    return closest_point(p, triangles_[face]);
  }
  bool is_foot(Vec3 p, std::uint32_t face, const Closest& there, Scratch& scratch) const;
  bool in_cone(Vec3 p, Vec3 direction, const Box3& box) const;
  template <class Take>
  void visit_tree(Vec3 p, Scratch& scratch, Take take) const;
  void sort_list(Vec3 p, Scratch& scratch) const;

  const Grid& grid_;
  const FaceTree& tree_;
  FaceSearch search_;
  double cosine_, sine_;
  double tolerance_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> beside_;        ///< for side k of face f, at 3 f + k: the other face
  std::vector<std::uint32_t> around_begin_;  ///< for each vertex, into around_
  std::vector<std::uint32_t> around_;        ///< faces
};

}  // namespace medial::volume
