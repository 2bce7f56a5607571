#pragma once

// Offset curves with true arcs, by walking the medial axis: where the axis has the radius D, the
// offsets of the boundary on its two sides meet; in between, the offset of each site is a line or
// an arc. Nothing is intersected and nothing is thrown away (Persson 1978; Held 1991, chapter 4).

#include <cstdint>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial {

/// In place of a region: none.
constexpr std::uint32_t no_region = 0xFFFFFFFF;

/// A connected part of the points whose clearance exceeds a value.
struct OffsetRegion {
  double clearance = 0;     ///< distance from the shape's boundary, negative outside of the shape
  std::vector<Ring> rings;  ///< the outer one (counter-clockwise), then the holes (clockwise)
  /// The region that contains it at the next smaller clearance of the result; or no_region.
  std::uint32_t parent = no_region;
};

/// Offset curves and how they nest.
struct Offsets {
  /// By increasing clearance, parents before children; those of one clearance have no point in
  /// common, but touching points within rounding.
  std::vector<OffsetRegion> regions;
  double tolerance = 0;  ///< of the axes: what a curve's clearance is off by, about
  /// Of buffers: for each point of the planar graph, the region of the smallest distance that it
  /// lies in. Else empty.
  std::vector<std::uint32_t> region_of_point = {};
  double seconds_axis = 0;    ///< to compute axes
  double seconds_curves = 0;  ///< to walk along them
};

/// The regions {clearance > c} for all `clearances` at once, of an axis of the interior. Duplicates
/// count once, values of at least the largest radius have no region; a corridor exactly as wide as
/// twice c belongs to none.
///
/// Every point of a ring is within a few tolerances of the distance c from the boundary. Rings have
/// no more edges than sites whose Voronoi cells they cross, and one for each arc that closes a gap
/// of the feet; an edge turns by a half circle at most.
/// O(n log m + size of the result) for n sites and m clearances.
/// Errors: invalid_option (a clearance that is not positive and finite), unsupported (an axis that
/// is sampled or of the exterior).
Result<Offsets> inward_offsets(const MedialAxis& axis, std::span<const double> clearances);

/// The same of a shape, inside where a clearance is positive. Where it is negative, the regions are
/// those of the shape grown by -c, by the axis of what surrounds it. `exterior` and `margin` of
/// `options` have no effect. Errors: those of compute(); invalid_option (a clearance that is 0 or
/// not finite, or below -1e5 of the shape's diagonal).
Result<Offsets> offset_curves(const Shape& shape, std::span<const double> clearances,
                              const Options& options = {});

/// Buffers of points, lines and arcs: the regions nearer than each of `distances` to the planar
/// graph; their clearance is the distance negated. O(n log n) expected. Errors: those of
/// voronoi_diagram(); invalid_option (a distance that is not positive and finite, or above 1e5 of
/// the planar graph's diagonal where that is not 0).
Result<Offsets> offset_curves(const PlanarGraph& planar_graph, std::span<const double> distances,
                              const Options& options = {});

/// The clearances first, first + step, ... that have a region inside: passes of a tool that clears
/// a pocket. Errors: invalid_option (first or step not positive), too_large (over 1e6 passes).
Result<std::vector<double>> offset_passes(const MedialAxis& axis, double first, double step);

/// The length of all rings, and the area that they enclose.
double length(const OffsetRegion& region);
double area(const OffsetRegion& region);

}  // namespace medial
