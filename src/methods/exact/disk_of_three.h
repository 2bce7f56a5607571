#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "methods/exact/outline.h"

namespace medial::exact {

/// The disk that three sites touch in this counter-clockwise order and that is smaller than their
/// own circles. No two of the sites may be joined. None if there is no such disk, or if this
/// precision does not tell.
template <class Real>
std::optional<DiskBounds<Real>> disk_of_three(const SiteLoops& outline,
                                              const std::array<std::uint32_t, 3>& sites);

}  // namespace medial::exact
