#pragma once

// Offset curves with true arcs, by walking the medial axis (Persson 1978; Held 1991, chapter 4):
// the offsets of neighbouring sites meet where the axis's radius equals the distance.

#include "medial/compute.h"
#include "medial/planar_graph.h"

namespace medial {

constexpr std::uint32_t no_region = 0xFFFFFFFF;  ///< stands for a missing region

/// A connected set of points whose clearance exceeds a value.
struct OffsetRegion {
  double clearance = 0;     ///< distance to the shape's boundary, negative outside the shape
  std::vector<Ring> rings;  ///< the outer one (counter-clockwise), then the holes (clockwise)
  std::uint32_t parent = no_region;  ///< the region around it at the next smaller clearance
};

struct Offsets {
  /// By increasing clearance, parents first; those of one clearance are disjoint, up to rounding.
  std::vector<OffsetRegion> regions;
  double tolerance = 0;  ///< of the axes; about the error of a curve's clearance
  /// For buffers: the region of the smallest distance around each point of the planar graph.
  std::vector<std::uint32_t> region_of_point = {};
  double seconds_axis = 0, seconds_curves = 0;  ///< to compute axes, to walk along them
};

/// The regions {clearance > c} for all `clearances` at once, from an axis of the interior.
/// Duplicates count once. No region exists for values of at least the largest radius, nor in a
/// corridor exactly 2 c wide. Rings are within a few tolerances of the distance c from the
/// boundary; edges turn by at most a half circle. O(n log nm + size) for n sites, m values. Errors:
/// invalid_option (a value not positive), unsupported (sampled; exterior), too_large (2^32 points).
Result<Offsets> inward_offsets(const MedialAxis& axis, std::span<const double> clearances);

/// The same for a shape; a negative clearance c gives the shape grown by -c. Errors: those of
/// compute(); invalid_option (a clearance that is 0, not finite, or below -1e5 of the diagonal).
Result<Offsets> offset_curves(const Shape& shape, std::span<const double> clearances,
                              const Options& options = {});

/// Buffers: the regions within each of `distances` of points, lines and arcs; their clearance is
/// the negated distance. O(n log n) expected. Errors: those of voronoi_diagram(); invalid_option
/// (a distance that is not positive and finite, or above 1e5 of the graph's diagonal, if any).
Result<Offsets> offset_curves(const PlanarGraph& planar_graph, std::span<const double> distances,
                              const Options& options = {});

/// Passes that clear a pocket: the clearances first, first + step, ... that have a region.
/// Errors: invalid_option (first or step not positive), too_large (over 1e6 passes).
Result<std::vector<double>> offset_passes(const MedialAxis& axis, double first, double step);

double length(const OffsetRegion& region);  ///< of all rings
double area(const OffsetRegion& region);

}  // namespace medial
