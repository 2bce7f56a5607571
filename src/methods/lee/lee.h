#pragma once

#include <vector>

#include "medial/axis.h"
#include "methods/lee/conquer.h"
#include "methods/problem.h"

namespace medial::lee {

/// The method `lee` (docs/lee.md); a diagram requires straight edges. Empty where the caller
/// cancels. O(n log n). `levels`: see conquer(). Errors: unsupported, with the place, where
/// find_overreach() finds a disk, and next to arcs where rounding breaks a diagram or verify()
/// refuses the axis; of polygons, where 256 bits do not separate the sides; internal where
/// rounding breaks another polygon's diagram.
Result<MedialAxis> run(const Problem& problem, std::vector<Level>* levels = nullptr);
Result<VoronoiDiagram> voronoi_diagram(const Problem& problem);

}  // namespace medial::lee
