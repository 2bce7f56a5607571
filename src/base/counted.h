#pragma once

#include <cstdint>
#include <string>

namespace medial {

/// "1 ring", "2 rings".
inline std::string counted(std::uint64_t number, const char* noun) {
  return std::to_string(number) + ' ' + noun + (number == 1 ? "" : "s");
}

}  // namespace medial
