#pragma once

// Values that mean "nothing" or "beyond everything".

#include <cstdint>
#include <limits>

namespace medial {

/// Farther, dearer and larger than all that is finite.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The index of no node, edge, site, ...
inline constexpr std::uint32_t none = ~std::uint32_t{0};

}  // namespace medial
