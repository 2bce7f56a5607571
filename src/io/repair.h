#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "medial/io/read.h"

namespace medial::io {

/// Rings that bound a valid region, by a rule:
///   make_valid  every polygon by itself by GEOS's MakeValid (method "structure": outer rings made
///               valid and united, holes taken away). Rings without a role go by even_odd.
///   even_odd    what an odd number of rings encloses; roles and orientations do not count
///   non_zero    what the rings wind around a number of times that is not zero; orientations count
/// Rings that are valid by the rule are left as they are. What changed becomes a note.
/// Where GEOS gives up the rings stay as well, for load_shapes() to node them. Errors: not_finite,
/// no_area (nothing is left).
Status repair(Feature& feature, std::size_t index, RepairRule rule,
              std::vector<std::string>& notes);

}  // namespace medial::io
