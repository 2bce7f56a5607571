#pragma once

#include <vector>

#include "medial/carve.h"
#include "medial/shape.h"

namespace medial::io {

const char* name_of(ToolPathKind kind);

/// A path with y upwards, as machines have it.
std::vector<ToolPoint> upright_path(const ToolPath& path, bool y_down);

/// A path in the plane, a bulge for each point.
Ring line_of(const std::vector<ToolPoint>& points);

}  // namespace medial::io
