#pragma once

// Random shapes of all kinds; how many of them, and which, is up to the environment.

#include <cstdint>

#include "support/environment.h"
#include "support/generate_arcs.h"

namespace medial::test {

/// Random shapes, straight and curved by turns.
inline RandomShape random_any(std::uint64_t seed) {
  return seed % 2 == 0 ? random_shape(seed) : random_arc_shape(seed);
}

}  // namespace medial::test
