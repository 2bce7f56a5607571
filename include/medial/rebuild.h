#pragma once

// From an axis back to its shape: exactly, from tangents of sampled disks, or as pixels.

#include <cstdint>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/image.h"
#include "medial/shape.h"

namespace medial {

enum class RebuildBy : std::uint8_t {
  /// boundary_of() an exact axis. Samples have none: theirs is by hulls for packs and, without
  /// `points`, for pixels (ridge and brushfire), else by tangents.
  outline,
  tangents,  ///< a polygon from points on the axis and tangents of their disks (Volkmann and St.
             ///< Clair, Section II.C)
  hulls,     ///< a polygon around the convex hulls of the disks at both ends of each edge
};

struct RebuildOptions {
  RebuildBy by = RebuildBy::outline;
  /// Of tangents: about how many points on the axis, besides ends and branching points, evenly by
  /// its length. 0: the nodes of samples, 1000 of an exact axis.
  std::uint64_t points = 0;
  /// Arcs become chords within this distance, in units of the input; 0: they stay arcs. Hulls have
  /// chords in any case: within a sixteenth of the axis's resolution, or 1e-6 of its extent.
  double chord = 0;
};

struct RebuildReport {
  std::uint64_t medial_points = 0;  ///< of tangents and hulls: points on the axis that were used
  std::uint64_t crossings = 0;      ///< where the new boundary crossed itself, and was split
};

/// The shape of an axis, whole or pruned. An exact axis gives back its shape, whose vertices are
/// the same bit for bit where they are ends of sites; a pruned one the union of its disks; that of
/// an exterior the shape's surroundings within the enclosure. O(n log n). Errors: empty (an axis
/// without nodes), those of build_shape().
Result<Shape> rebuild(const MedialAxis& axis, const RebuildOptions& options = {},
                      RebuildReport* report = nullptr);

/// The union of the disks as pixels.
struct DiskImage {
  Image image;
  double pixel = 0;  ///< side, in units of the input
  Vec2 corner;       ///< of the image, where x and y are smallest
};

/// The pixels whose centres lie in one of the disks. The longer side of the disks' box has `pixels`
/// pixels, with a margin of one around; the first row is that of the largest y, with `y_down` of
/// the smallest. No point of the union is missed that is a tenth of a pixel inside, where radii
/// exceed one. Errors: empty, invalid_option (pixels is 0 or above 32768).
Result<DiskImage> rebuild_image(const MedialAxis& axis, std::uint32_t pixels, bool y_down = false);

}  // namespace medial
