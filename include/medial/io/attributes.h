#pragma once

#include <string>
#include <utility>
#include <vector>

namespace medial::io {

/// What a file tells of a feature besides its geometry: names and values as text, in their order.
using Attributes = std::vector<std::pair<std::string, std::string>>;

}  // namespace medial::io
