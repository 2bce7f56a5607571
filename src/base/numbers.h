#pragma once

// Sentinel values.

#include <cstdint>
#include <limits>

namespace medial {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The index of a missing node, edge or site.
inline constexpr std::uint32_t none = ~std::uint32_t{0};

}  // namespace medial
