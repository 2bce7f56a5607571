#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/image.h"

namespace medial {

/// The ways in which a fire can be kept from burning an image apart (Volkmann and St. Clair 1987,
/// Section II.B.1). All keep every component and every hole, and end points.
enum class Brushfire : std::uint8_t {
  sequential,    ///< one pixel after another, each looked at when its turn comes (Rosenfeld and Kak
                 ///< 1982); pixels of a pass in the order of four subfields
  sides,         ///< from the north, south, west and east in turn (Rosenfeld 1975)
  marking,       ///< marks all border pixels, then deletes them; two kinds of marks take turns, so
                 ///< that two pixels' width shrinks to one (Guo and Hall 1989, algorithm A1)
  simultaneous,  ///< from all sides at once; of pixels that may not all go, the critical cliques,
                 ///< one stays (Bertrand and Couprie 2008)
};

/// The name on the command line: "sequential", "sides", "marking", "simultaneous".
const char* name_of(Brushfire family);
std::optional<Brushfire> brushfire_from(std::string_view name);

struct BrushfireOptions {
  Brushfire family = Brushfire::simultaneous;
  /// Called after each pass with the share of pixels known to be done with, in [0, 1]; must not
  /// throw.
  std::function<void(double)> progress = {};
  /// When set to true, the work ends after the pass with ErrorCode::cancelled.
  const std::atomic<bool>* cancel = nullptr;
};

/// Thins the foreground to lines by a brushfire. The result has the image's topology() and is part
/// of the image; no pixel of it can go by the family's own rule. O(pixels): 64 pixels at a time,
/// and only where the fire burns. Errors: too_large, cancelled, out_of_memory.
Result<Image> thin(const Image& image, const BrushfireOptions& options = {});

}  // namespace medial
