#pragma once

#include "medial/raster.h"

namespace medial {

/// The pixels whose centres are inside the disks around the pixels `centers`, with their distances
/// as radii: the part of an image that an axis of pixels retains. Disks are open, so none contains
/// a background pixel. Requires equal sizes. O(sum of the radii) if most disks overlap; in any case
/// plus at most a 64th of the sum of their areas.
Image union_of_disks(const Image& centers, const DistanceMap& distances);
/// The same for any disks, in coordinates of pixels, as an image of this size.
Image union_of_disks(std::uint32_t width, std::uint32_t height, std::span<const Disk> disks);

}  // namespace medial
