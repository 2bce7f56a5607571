#pragma once

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/raster.h"
#include "medial/shape.h"

namespace medial {

enum class RebuildBy : std::uint8_t {
  /// boundary_of() exact axes; hulls of packs and, without `points`, of pixels; tangents of others
  outline,
  tangents,  ///< a polygon from tangents of disks (Volkmann and St. Clair, Section II.C)
  hulls,     ///< a polygon around the convex hulls of the disks at both ends of each edge
};

struct RebuildOptions {
  RebuildBy by = RebuildBy::outline;
  /// Of tangents: about how many points on the axis, evenly by its length, besides ends and
  /// branching points. 0: the nodes of samples, 1000 of an exact axis.
  std::uint64_t points = 0;
  /// Arcs become chords within this distance, in units of the input; 0: they stay arcs. Hulls
  /// always have chords: within a sixteenth of the axis's resolution, or 1e-6 of its extent.
  double chord = 0;
};

struct RebuildReport {
  std::uint64_t medial_points = 0;  ///< of tangents and hulls: points on the axis that were used
  std::uint64_t crossings = 0;      ///< where the new boundary crossed itself, and was split
};
/// The shape of an axis. An exact one gives back its shape, with ends of sites bit for bit; a
/// pruned one the union of its disks; that of an exterior the surroundings within the enclosure.
/// O(n log n). Errors: empty (an axis without nodes), those of build_shape().
Result<Shape> rebuild(const MedialAxis& axis, const RebuildOptions& options = {},
                      RebuildReport* report = nullptr);

struct DiskImage {
  Image image;
  double pixel = 0;  ///< side, in units of the input
  Vec2 corner;       ///< of the image, where x and y are smallest
};

/// The union of the disks: the pixels whose centres lie in one of them, `pixels` along the longer
/// side of their box, with a margin of one around. The first row has the largest y, or with
/// `y_down` the smallest. Where radii exceed a pixel, every point a tenth of a pixel inside the
/// union is covered. Errors: empty, invalid_option (pixels is 0 or above 32768).
Result<DiskImage> rebuild_image(const MedialAxis& axis, std::uint32_t pixels, bool y_down = false);

}  // namespace medial
