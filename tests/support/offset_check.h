#pragma once

// Properties of offset curves, measured without the axis.

#include <span>
#include <string>
#include <vector>

#include "medial/offset.h"

namespace medial::test {

struct OffsetCheck {
  std::size_t points = 0;    ///< that were measured
  double largest_error = 0;  ///< |distance to the shape's boundary - |clearance||
  Vec2 worst;
  /// What is wrong with the tree, the rings' orientations, or the sides of the boundary on which
  /// `probes` random points lie; empty: nothing.
  std::string fault;
};

/// Measures ends and `inside` points inside every edge of every ring against a tree of the shape's
/// edges.
OffsetCheck check_offsets(const Shape& shape, const Offsets& offsets, int inside = 3,
                          int probes = 100);

/// Ring counts, areas and lengths of all regions, by clearance and area; in units of `scale`.
struct Measures {
  std::vector<std::size_t> rings;
  std::vector<double> areas, lengths;
};
Measures measures_of(const Offsets& offsets, double scale);

/// How often rings wind around a point.
int winding(const std::vector<Ring>& rings, Vec2 p);

/// How many rings the boundary of {clearance > c} has, by the pixels of a grid of this many along
/// the longer side: the components of pixels whose centres are inside, and their holes; those that
/// reach further than one and a half pixels from the curve.
struct PixelCount {
  std::size_t regions = 0, rings = 0;
};
/// Of each clearance, whether every region at clearance - slack holds just one at each of some
/// clearances up to clearance + slack, with as many rings in the same places: then pixels of a
/// third of the slack tell how many there are.
std::vector<bool> are_steady(const Shape& shape, std::span<const double> clearances,
                             std::span<const double> slacks);

PixelCount count_by_pixels(const Shape& shape, double clearance, std::size_t pixels);

}  // namespace medial::test
