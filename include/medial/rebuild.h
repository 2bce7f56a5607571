#pragma once

// From an axis back to its shape: exactly, from tangents of sampled disks, or as pixels.

#include <cstdint>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/image.h"
#include "medial/shape.h"

namespace medial {

enum class RebuildBy : std::uint8_t {
  outline,   ///< boundary_of(): segments and arcs of an exact axis, each ended by its disks' arcs
  tangents,  ///< a polygon from points on the axis and tangents of their disks (Volkmann and St.
             ///< Clair, Section II.C)
  hulls,     ///< a polygon around the convex hulls of the disks at both ends of each edge: what
             ///< packs stand for
};

struct RebuildOptions {
  /// Samples have no exact outline: theirs is by hulls where a pack was unpacked (the axis's method
  /// is "pack") and, without `points`, of pixels ("ridge" and "brushfire", hulls of pixels so far
  /// apart that half a pixel is missed or added), or else by tangents.
  RebuildBy by = RebuildBy::outline;
  /// Of tangents: how many points on the axis, about, besides ends and branching points; spread
  /// evenly over its length. 0: the nodes of samples, 1000 of an exact axis.
  std::uint64_t points = 0;
  /// Arcs become chords within this distance, in units of the input; 0: they stay arcs. Of hulls,
  /// those around disks are chords in any case: within a sixteenth of the axis's resolution, or
  /// else 1e-6 of its extent.
  double chord = 0;
};

struct RebuildReport {
  std::uint64_t medial_points = 0;  ///< of tangents and hulls: points on the axis that were used
  std::uint64_t crossings = 0;      ///< where the new boundary crossed itself, and was split
};

/// The shape of an axis, whole or pruned. An exact axis gives back the shape that it was computed
/// of, the vertices of which are its own bit for bit where they are ends of sites; a pruned one the
/// union of its disks. O(n log n). The axis of an exterior gives the shape's surroundings, up to
/// the enclosure. Errors: empty (an axis without nodes), those of build_shape().
Result<Shape> rebuild(const MedialAxis& axis, const RebuildOptions& options = {},
                      RebuildReport* report = nullptr);

/// The union of the disks as pixels.
struct DiskImage {
  Image image;
  double pixel = 0;  ///< side, in units of the input
  Vec2 corner;       ///< of the image, where x and y are smallest
};

/// The pixels whose centres lie in one of the disks, the longer side of their bounding box `pixels`
/// wide and a margin of one pixel around; the first row is that of the largest y, or with `y_down`
/// of the smallest. So many disks are taken that no point of the union is missed that is a tenth of
/// a pixel inside, where radii exceed one. Errors: empty, invalid_option (pixels is 0 or above
/// 32768).
Result<DiskImage> rebuild_image(const MedialAxis& axis, std::uint32_t pixels, bool y_down = false);

}  // namespace medial
