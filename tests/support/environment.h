#pragma once

// What the environment of a test says: how many random shapes, which, and where the real inputs
// are.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>

namespace medial::test {

/// Whether sanitizers are on: a task of a second may then take twenty.
#ifdef MEDIAL_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// A number from the environment.
inline std::uint64_t number_from(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text && *text ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// One in `share` of MEDIAL_PROPERTY_COUNT (20,000 without it), but not fewer than `least`.
inline std::uint64_t shape_count(std::uint64_t share, std::uint64_t least = 1) {
  return std::max(number_from("MEDIAL_PROPERTY_COUNT", 20000) / share, least);
}

/// The first seed: MEDIAL_PROPERTY_SEED, another number for other shapes.
inline std::uint64_t first_seed() { return number_from("MEDIAL_PROPERTY_SEED", 0) << 32U; }

/// The folder of real inputs: MEDIAL_DATA, or shared/data beside the project. It need not exist.
std::filesystem::path data_folder();

}  // namespace medial::test
