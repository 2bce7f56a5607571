#pragma once

// Force lines inside a solid with a charged surface (the outlook of Ahuja and Chuang 1997).

#include "volume/control.h"
#include "volume/face_tree.h"
#include "volume/feet.h"
#include "volume/grid.h"

namespace medial::volume {

/// The force of a uniformly charged surface whose potential is the integral of 1 / distance^order.
class ForceField {
 public:
  /// Keeps references to both.
  ForceField(const Grid& grid, const FaceTree& tree, int order);

  /// The unit direction of the force on p. `radius`, the distance of the surface, must be positive.
  /// Integrates over triangles that are small as seen from p, and omits those so distant that they
  /// contribute less than a thousandth.
  Vec3 direction(Vec3 p, double radius) const;

 private:
  const Grid& grid_;
  const FaceTree& tree_;
  int order_;
  double reach_;  ///< in multiples of the radius
};

/// The sheets swept by the force lines from convex edges, and curves: the force lines from convex
/// vertices, and the places where neighbouring lines of a sheet meet. In units of the grid. At a
/// convex edge, the surface turns by `angle` or more. Lines end at minima of the potential.
AxisSurface force_surface(const ForceField& field, const Grid& grid, const FeetFinder& finder,
                          double angle, Control& control);

}  // namespace medial::volume
