#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "medial/contour.h"
#include "medial/error.h"
#include "medial/methods.h"

namespace medial {

/// A point of the axis as the generation process finds it.
struct CurveAxisPoint {
  double length = 0;  ///< along its branch, from the branch's first point
  Disk disk;
  double left = 0;   ///< where the disk touches the boundary: index of the contour's piece plus the
  double right = 0;  ///< parameter on it, in [0, number of pieces)
};

/// How often each rule of the control process was applied (Section 5.2 of the paper).
struct CurveAxisRules {
  std::uint64_t maxima = 0;         ///< positive maxima of curvature on the boundary
  std::uint64_t skipped = 0;        ///< of them, on boundary that was scanned already
  std::uint64_t larger = 0;         ///< conflicts that ended a generation (Fig 5a)
  std::uint64_t smaller = 0;        ///< conflicts that took a point from an older branch (Fig 5b)
  std::uint64_t junctions = 0;      ///< conflicts at equal radius: merged, redirected (Fig 6)
  std::uint64_t dissolved = 0;      ///< junctions taken back, their third branch being too long
  std::uint64_t abandoned = 0;      ///< maxima that belong to no leaf of the axis (Fig 9b)
  std::uint64_t retreats = 0;       ///< generations stopped by restriction (10) (Fig 7a)
  std::uint64_t outside_frame = 0;  ///< generations stopped by the frame (Fig 7b)
  std::uint64_t resumed = 0;        ///< generations taken up again where boundary was left
  std::uint64_t ends = 0;           ///< the end in the last maximum (Fig 8)
  std::uint64_t meetings = 0;       ///< the end where two branches meet head-on
};

struct CurveAxis {
  /// The points as a graph: method "curve-axis", resolution the largest step; edges are quadratics
  /// with the axis's tangents at their ends, so between points it is off by the fourth power of the
  /// step. It names no sites.
  MedialAxis axis;
  /// The discrete parametric axis: one for each edge chain between leaves and junctions.
  std::vector<std::vector<CurveAxisPoint>> branches;
  CurveAxisRules rules;
};

/// The medial axis of one smooth closed curve, by following it from the boundary's maxima of
/// curvature: Shaked and Bruckstein, "The Curve Axis", 1996. Each point is a zero of (14), so as
/// exact as the curve.
///
/// The contour may run either way; its pieces have to join with one direction and, to a hundredth,
/// one curvature. Time grows with the number of points, and with the square of the number of
/// maxima of curvature. Errors: not_finite, invalid_option, cancelled, too_large (20,000 pieces,
/// 2^21 points, some seconds of work), unsupported (not smooth: the place
/// is named; more than one contour; no maximum of curvature, as for a circle; a disk that the
/// boundary reaches into by more than 1e-5 of the size, or boundary that no branch reaches: the
/// method has gone astray), crossing and what else build_shape() refuses.
Result<CurveAxis> compute_curve_axis(std::span<const Contour> contours,
                                     const method::CurveAxis& options = {},
                                     const std::atomic<bool>* cancel = nullptr);

}  // namespace medial
