#pragma once

#include "medial/raster.h"

namespace medial {

/// The pixels whose centres lie inside the disks around the pixels `centers`, with the distances to
/// pixels as radii: what an axis of pixels retains of its image. Disks are open, so none reaches a
/// background pixel. Requires equal sizes. O(sum of the radii) where most disks overlap, in any
/// case at most a 64th of the sum of their areas more.
Image union_of_disks(const Image& centers, const DistanceMap& distances);
/// The same for any disks, in coordinates of pixels, as an image of this size.
Image union_of_disks(std::uint32_t width, std::uint32_t height, std::span<const Disk> disks);

}  // namespace medial
