#pragma once

// How many random shapes a test takes, and which.

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "support/generate_arcs.h"

namespace medial::test {

/// Whether sanitizers watch: what takes a second otherwise may take twenty then.
#ifdef __SANITIZE_ADDRESS__
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

/// Random shapes, straight and curved by turns.
inline RandomShape random_any(std::uint64_t seed) {
  return seed % 2 == 0 ? random_shape(seed) : random_arc_shape(seed);
}

}  // namespace medial::test
