#pragma once

#include "medial/methods.h"

namespace medial {

struct Options {
  Method method = method::Disks{};
  /// Disks touch sites at a distance below this share of the bounding box's diagonal, at most 1e-3.
  /// 0: 4e-15 (a small component's own, docs/disks.md), or what rounding of coordinates allows.
  double tolerance = 0;
  /// A convex joint with an arc is a corner if it turns by more than this; degrees in [0, 10].
  double corner_angle = 0.01;
  /// Keeps nodes apart that are closer than the tolerance (docs/exact.md); for `lee` and `biarc-dc`
  /// `disks` then computes the axis. Slower; not for sampled axes.
  bool exact = false;
  /// Number of threads, at most 1024; 0: all of the machine. Does not change the result's bytes.
  int threads = 0;
  /// Computes the axis of the exterior: of an enclosure minus the shape, without edges whose disks
  /// touch the enclosure. It covers every concavity and every hole.
  bool exterior = false;
  /// From the bounding box to the enclosure, in [1e-6, 1e6] diagonals; 0: half of the longer side.
  double margin = 0;
  /// Called from any thread with the share done, in any order, finally with 1; must not throw.
  std::function<void(double)> progress = {};
  /// Once true, compute() returns ErrorCode::cancelled: at once, or when the current phase ends.
  const std::atomic<bool>* cancel = nullptr;
};

/// The medial axis transform of a shape. The method `disks` takes O(n log n) expected time.
///
/// The graph has one connected part per component of the shape and exactly one independent cycle
/// per hole. With `ridge` and `brushfire` this holds for sets of interior pixels and their holes,
/// which are the shape's unless it is only a few pixels wide. Methods that follow smooth boundaries
/// use `contours`, which the shape approximates, or, without contours, the shape's edges.
///
/// Errors: invalid_option (also what the method does not take: MethodInfo); cancelled; empty;
/// too_large (2^29 vertices; ridge: 2^31 pixels, 2^23 crossings with them; brushfire: a diagonal of
/// 2^16 pixels); unsupported (a coordinate above 1e100, or nonzero but below 1e-100 in size or as a
/// share of the largest; what the method cannot follow; pixels as fine as the coordinates; a place
/// so narrow that rounding could join its sides); crossing (of arcs, by less than build_shape() can
/// see); malformed (arrays that it cannot have made); out_of_memory; internal.
Result<MedialAxis> compute(const Shape& shape, const Options& options = {},
                           std::span<const Contour> contours = {});

/// Some edges of an axis, with the nodes and sites that they name.
struct AxisPart {
  MedialAxis axis;
  std::vector<std::uint32_t> nodes, sites;  ///< their indices in the whole axis
  std::size_t known = 0;                    ///< number of first nodes that earlier parts had
  bool begins = true;                       ///< discard all earlier parts
};
using AxisSink = std::function<Status(AxisPart&& part)>;

/// Like compute(), but passes edges to `sink` as they are found; the result holds everything else.
/// For straight edges and `disks` without `exact` and `exterior`, memory holds only the boundary,
/// its tree and the open ends of the walk (docs/parts.md); otherwise the axis is one part. The sink
/// is called from one thread at a time; its error ends the computation.
Result<MedialAxis> compute_in_parts(const Shape& shape, const Options& options,
                                    const AxisSink& sink);

}  // namespace medial
