#pragma once

#include <vector>

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/shape.h"
#include "medial/diagram.h"
#include "methods/lee/conquer.h"

namespace medial::lee {

/// The method `lee` (docs/lee.md). Both require what compute() has checked: straight edges, no
/// holes. Empty where the caller cancels. May throw std::runtime_error; see merge(). O(n log n).
/// `levels`: see conquer(). Error: unsupported, with the place, where find_overreach() finds a
/// disk.
Result<MedialAxis> run(const Shape& shape, const Options& options,
                       std::vector<Level>* levels = nullptr);
Result<VoronoiDiagram> voronoi_diagram(const Shape& shape, const Options& options);

}  // namespace medial::lee
