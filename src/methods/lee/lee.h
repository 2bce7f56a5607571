#pragma once

#include <optional>
#include <vector>

#include "medial/axis.h"
#include "methods/lee/conquer.h"
#include "methods/problem.h"

namespace medial::lee {

/// The method `lee` (docs/lee.md); where rounding may have decided what disks touch, the axis of
/// `disks`, as the axis says. O(n log n). `levels`: see conquer().
Result<MedialAxis> run(const Problem& problem, std::vector<Level>* levels = nullptr);

/// The diagram inside a shape of straight edges; none where rounding may have decided what disks
/// touch, and where the caller cancels. O(n log n).
std::optional<VoronoiDiagram> voronoi_diagram(const Problem& problem);

}  // namespace medial::lee
