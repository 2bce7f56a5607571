#pragma once

#include <optional>
#include <vector>

#include "medial/axis.h"
#include "methods/lee/conquer.h"
#include "methods/problem.h"

namespace medial::lee {

/// The method `lee` (docs/lee.md). If rounding may have decided what disks touch, returns the axis
/// of `disks`; the axis names its method. O(n log n). `levels`: see conquer().
Result<MedialAxis> run(const Problem& problem, std::vector<Level>* levels = nullptr);

/// The diagram inside a shape of straight edges. Returns none if rounding may have decided what
/// disks touch, or if the caller cancels. O(n log n).
std::optional<VoronoiDiagram> voronoi_diagram(const Problem& problem);

}  // namespace medial::lee
