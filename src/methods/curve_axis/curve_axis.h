#pragma once

#include "methods/problem.h"

namespace medial {

/// A point of the axis, from the generation process of method::CurveAxis.
struct CurveAxisPoint {
  double length = 0;  ///< along its branch, from the branch's first point
  Disk disk;
  double left = 0;  ///< where the disk touches the boundary: index of the contour's piece plus the
  double right =
      0;  ///< parameter on it; holes continue the count of the outer contour, and run clockwise
};

/// How often each rule of the control process was applied (Section 5.2 of the paper).
struct CurveAxisRules {
  std::uint64_t maxima = 0;       ///< of curvature, corners and ends of bridges on the boundary
  std::uint64_t skipped = 0;      ///< of these, on boundary that was scanned already
  std::uint64_t larger = 0;       ///< conflicts that ended a generation (Fig 5a)
  std::uint64_t smaller = 0;      ///< conflicts that took a point from an older branch (Fig 5b)
  std::uint64_t junctions = 0;    ///< conflicts at equal radius: merged, redirected (Fig 6)
  std::uint64_t dissolved = 0;    ///< junctions undone, as their third branch was too long
  std::uint64_t abandoned = 0;    ///< maxima that belong to no leaf of the axis (Fig 9b)
  std::uint64_t retreats = 0;     ///< generations stopped by restriction (10) (Fig 7a)
  std::uint64_t outside_box = 0;  ///< generations that left the bounding box (Fig 7b)
  std::uint64_t resumed = 0;      ///< generations resumed where boundary was left
  std::uint64_t ends = 0;         ///< the end in the last maximum (Fig 8)
  std::uint64_t meetings = 0;     ///< the end where two branches meet head-on
  std::uint64_t restarts = 0;     ///< attempts after the first, which the paper does not have
  CurveAxisRules& operator+=(const CurveAxisRules& other);
};

struct CurveAxis {
  /// A graph without sites through all points of the branches; `resolution` is the largest step
  /// between two points. Each edge is a quadratic with the axis' tangents at its ends, so its
  /// distance from the axis is proportional to the fourth power of the step.
  MedialAxis axis;
  /// The discrete parametric axis: one for each chain of edges between leaves and branchings.
  std::vector<std::vector<CurveAxisPoint>> branches;
  CurveAxisRules rules;
};

/// Computes the medial axis of closed curves. Follows it from the boundary's maxima of curvature
/// and convex corners, and into cycles around holes from disks that touch two loops: after Shaked
/// and Bruckstein, "The Curve Axis", 1996. Each point is a zero of (14), as exact as the curve. The
/// contours may have any orientation and order. The time grows with the number of points, and with
/// the square of the number of tips.
///
/// Errors: not_finite, invalid_option, cancelled, too_large (20,000 pieces, 2^21 points, some
/// seconds of work), unsupported (a cusp, with the place; contours that touch; a circle; a disk
/// that the boundary enters by more than 1e-5 of the size, or boundary that no branch reaches: the
/// method has failed), crossing and others of build_shape().
Result<CurveAxis> compute_curve_axis(std::span<const Contour> contours,
                                     const method::CurveAxis& options = {},
                                     const std::atomic<bool>* cancel = nullptr);

namespace curve_axis {

/// Checks that an axis is connected and has as many cycles as its component has holes. Errors:
/// unsupported, as the method has failed.
Status check_cycles(const MedialAxis& axis, std::size_t holes);

/// The method `curve-axis` (docs/curve-axis.md) on the problem's contours, or on the shape's own
/// loops. Errors: those of compute_curve_axis().
Result<MedialAxis> run(const Problem& problem);

}  // namespace curve_axis
}  // namespace medial
