#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "medial/io/read.h"

namespace medial::io {

/// Makes the polygons of a feature without curves valid, each by itself, by GEOS's MakeValid
/// (method "structure": outer rings are made valid and united, holes taken away); what changed
/// becomes a note. Rings without a role stay, and so does what GEOS gives up: load_shapes() nodes
/// these. Errors: no_area (nothing is left).
Status make_valid(Feature& feature, std::size_t index, std::vector<std::string>& notes);

}  // namespace medial::io
