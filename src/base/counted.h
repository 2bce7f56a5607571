#pragma once

#include <cstdint>
#include <string>

namespace medial {

/// "1 ring", "2 rings".
inline std::string counted(std::uint64_t number, const char* noun) {
  return std::to_string(number) + ' ' + noun + (number == 1 ? "" : "s");
}

/// "1 of 3 features is invalid and was left out".
inline std::string invalid_left_out(std::uint64_t number, std::uint64_t all) {
  return std::to_string(number) + " of " + counted(all, "feature") +
         (number == 1 ? " is invalid and was left out" : " are invalid and were left out");
}

}  // namespace medial
