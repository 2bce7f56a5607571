#pragma once

// Offset curves with true arcs, by walking the medial axis: where the axis has the radius D, the
// offsets of the boundary on its two sides meet; in between, the offset of each site is a straight
// line or an arc. The axis decides which pieces there are and how they join, so nothing is
// intersected with anything and nothing is thrown away (Persson 1978; Held 1991, chapter 4).

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
  /// The distance of its boundary from the shape's, positive inside of the shape, negative outside
  /// (as clearance() has it).
  double clearance = 0;
  /// The outer ring (counter-clockwise) first, then the holes (clockwise): lines and arcs.
  std::vector<Ring> rings;
  /// The region that contains it at the next smaller clearance of the result; or no_region.
  std::uint32_t parent = no_region;
};

/// Offset curves and how they nest.
struct Offsets {
  /// By increasing clearance, so that a parent comes before its children; those of one clearance
  /// have no point in common, but touching points within rounding.
  std::vector<OffsetRegion> regions;
  double tolerance = 0;  ///< of the axes: what a curve's clearance is off by, about
  /// Of buffers: of each of the planar graph's points, the region of the smallest distance that it
  /// lies in; those of larger distances are its ancestors. Else empty.
  std::vector<std::uint32_t> region_of_point = {};
  double seconds_axis = 0;    ///< to compute axes
  double seconds_curves = 0;  ///< to walk along them
};

/// The regions {clearance > c} for all `clearances` at once, of an axis of the interior. Duplicates
/// count once, values of at least the largest radius have no region. Where the boundary of a region
/// would run back on itself (a corridor exactly as wide as twice c) it has no part of it.
///
/// Every point of a ring has a distance from the boundary that is within a few tolerances of c,
/// beside joints that count as smooth, too. Rings have no more edges than sites whose cells they
/// cross, and one for each arc that closes a gap of the contacts; an edge turns by a half circle at
/// most.
/// O(n log m + size of the result) for n sites and m clearances.
/// Errors: invalid_option (a clearance that is not positive and finite), unsupported (an axis that
/// is sampled or of the exterior).
Result<Offsets> inward_offsets(const MedialAxis& axis, std::span<const double> clearances);

/// The same of a shape, inside where a clearance is positive and outside where it is negative:
/// there the regions are those of the shape grown by -c, by the axis of what surrounds it within a
/// enclosure out of reach. Axes that are not needed are not computed. `options` are those of
/// compute(); exterior and margin have no effect. Errors: those of compute(); invalid_option (a
/// clearance that is 0 or not finite, or below -1e5 of the shape's diagonal).
Result<Offsets> offset_curves(const Shape& shape, std::span<const double> clearances,
                              const Options& options = {});

/// Buffers of loose points, lines and arcs: the regions of all places nearer than each of
/// `distances` to the planar graph, as above; their clearance is the distance negated. Faces that
/// lines enclose become holes where they are wider. Curves as exact as those of shapes. O(n log n)
/// expected. Errors: those of voronoi_diagram(); invalid_option (a distance that is not positive
/// and finite, or above 1e5 of the planar graph's diagonal where that is not 0).
Result<Offsets> offset_curves(const PlanarGraph& planar_graph, std::span<const double> distances,
                              const Options& options = {});

/// The clearances first, first + step, ... up to the last one with a region inside: passes of a
/// tool that clears a pocket. Requires first > 0 and step > 0. Errors: invalid_option, too_large
/// (more than 1e6 passes).
Result<std::vector<double>> offset_passes(const MedialAxis& axis, double first, double step);

/// The length of all rings, and the area of all regions, of one clearance or of any.
double length(const OffsetRegion& region);
double area(const OffsetRegion& region);

}  // namespace medial
