#pragma once

// Silhouettes as images of things are: drawn from a seed, or from images of things.

#include <cstdint>
#include <string>

#include "medial/raster.h"

namespace medial::test {

struct Silhouette {
  std::string kind;
  Image image;
};

/// A blob, hand, tool, letter, leaf or branching twig, turned at random, some with frayed borders;
/// about `pixels` along the longer side. One seed, one image, for ever.
Silhouette silhouette(std::uint64_t seed, std::uint32_t pixels);

/// An image turned, scaled to about `pixels` along the longer side, and some of it frayed.
Image redrawn(const Image& image, std::uint64_t seed, std::uint32_t pixels);

/// A size from a seed: 50 to `most` pixels, small ones more often.
std::uint32_t silhouette_size(std::uint64_t seed, std::uint32_t most = 2000);

}  // namespace medial::test
