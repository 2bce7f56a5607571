#pragma once

#include <cstdint>
#include <string>

#include "medial/error.h"

namespace medial::io {

inline Place in_file(std::string path) {
  Place place;
  place.file = std::move(path);
  return place;
}

inline Place in_feature(std::uint64_t index) {
  Place place;
  place.feature = index;
  return place;
}

}  // namespace medial::io
