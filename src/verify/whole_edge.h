#pragma once

#include <algorithm>
#include <array>

#include "medial/axis.h"
#include "verify/boundary_edge.h"

namespace medial::verify_detail {

/// Disks of which all disks of an edge are convex combinations, in x, y and radius.
using DiskHull = std::array<Disk, 3>;

/// Bounds on all disks of an edge at once; infinite if none is found. `arc` is the Arc of an edge
/// that is not straight.
///
/// A disk (c, r) is tangent to the line or circle of a boundary edge, on its left, if
///   H = 2 (n.u - r) - k (u.u - r r) = 0,   u = c - start,
/// with the normal n at the start and the curvature k. If its centre is at the distance d,
///   H = (d - r) (|1 - k d| + 1 - k r),
/// and (1 - k d)^2 = (1 - k r)^2 - k H. Along the edge, H is a polynomial of degree 4 over a
/// positive one, and lies between the ratios of their Bernstein coefficients, which follow from
/// pairs of the three control points. For a point, H = d^2 - r^2.
class WholeEdge {
 public:
  /// Requires a positive weight, and radii that are not negative.
  WholeEdge(const DiskHull& control, double weight);

  /// A bound on |d - r|, with the distance d from a site, negative on the right of its edge.
  double contact_gap(const Site& site, const Arc* arc) const;
  /// A bound on r - d, with the distance d from an edge if the disks lie on its left, inside or
  /// outside of its circle, or from a point.
  double intrusion(const BoundaryEdge& edge, const Arc* arc) const;
  double intrusion(Vec2 point) const;
  /// A bound on how much nearer an edge is than its start, or its end; zero if all centres lie
  /// behind that end.
  double nearer_than_end(const BoundaryEdge& edge, const Arc* arc, bool start) const;

 private:
  struct Range {
    double low, high;
    double size() const { return std::max(-low, high); }
  };
  template <class Product>
  Range range_of(const Product& product) const;
  Range range_of(Vec2 start, Vec2 start_tangent, const Arc* arc) const;
  Range range_of(Vec2 point) const;
  double least_factor(const Arc* arc, double size) const;
  double rounding_of_form(Vec2 start, const Arc* arc) const;
  double bound_at_point(double size) const;
  double most_ahead(Vec2 point, Vec2 tangent) const;

  const DiskHull& control_;
  double weight_, least_radius_, largest_radius_;
};

}  // namespace medial::verify_detail
