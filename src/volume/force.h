#pragma once

// Force following inside a solid whose surface is charged (Ahuja and Chuang 1997, their outlook).

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

  /// The direction of the force on p, of length 1. `radius` is the distance of the surface, which
  /// must be positive. By quadrature over triangles that are small as seen from p; what lies so far
  /// off that it adds less than a thousandth is left out.
  Vec3 direction(Vec3 p, double radius) const;

 private:
  const Grid& grid_;
  const FaceTree& tree_;
  int order_;
  double reach_;  ///< in multiples of the radius
};

/// Sheets swept by the force lines that start at convex edges, and curves: those that start at
/// convex vertices, and where neighbouring lines of a sheet meet. In units of the grid. Convex
/// edges are those at which the surface turns by `angle` or more. Lines end in minima of the
/// potential.
AxisSurface force_surface(const ForceField& field, const Grid& grid, const FeetFinder& finder,
                          double angle, Control& control);

}  // namespace medial::volume
