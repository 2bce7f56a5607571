#pragma once

#include <vector>

#include "medial/io/write.h"

namespace medial::io {

const char* name_of(ToolPathKind kind);

/// Calls visit(carving, path, kind) for all paths in the order of cutting. The kind of an end
/// mill's that goes before is "mill".
template <class Visit>
void for_each_path(const CarveItem& item, const Visit& visit) {
  for (const ToolPath& path : item.clearing.paths) visit(item.clearing, path, "mill");
  for (const ToolPath& path : item.carving.paths) visit(item.carving, path, name_of(path.kind));
}

/// A path in the plane, a bulge for each point.
Ring line_of(const std::vector<ToolPoint>& points);

}  // namespace medial::io
