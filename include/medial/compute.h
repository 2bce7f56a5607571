#pragma once

#include "medial/methods.h"

namespace medial {

struct Options {
  Method method = method::Disks{};
  /// Disks whose residuals stay below this count as touching. Relative to the bounding box's
  /// diagonal, in (0, 1e-3]; 0: 4e-15, or what the coordinates allow far from the origin.
  double tolerance = 0;
  /// A convex joint with an arc is no corner if it turns by less than this; in degrees, in [0, 10].
  double corner_angle = 0.01;
  /// Makes every decision about the graph exact (docs/exact.md): sites that touch one disk only
  /// within the tolerance have nodes of their own, at short edges. Slower; not of sampled methods.
  bool exact = false;
  /// Threads to use, at most 1024; 0: all of the machine. The result is the same, byte for byte.
  int threads = 0;
  /// Computes the axis of the exterior: of an enclosure less the shape, without edges whose disks
  /// touch the enclosure. Every concavity and every hole has its axis.
  bool exterior = false;
  /// From the shape's box to the enclosure, in [1e-6, 1e6] diagonals; 0: half of the longer side.
  double margin = 0;
  /// Called from any thread with the share that is done, in any order, at last 1; must not throw.
  std::function<void(double)> progress = {};
  /// Once it is true, compute() returns ErrorCode::cancelled: from the walk at once, from other
  /// phases when they end.
  const std::atomic<bool>* cancel = nullptr;
};

/// The exact medial axis transform of a shape; by the method `disks` O(n log n) expected.
///
/// The graph has one connected part per component of the shape and exactly one independent cycle
/// per hole; by `ridge` and `brushfire`, per bounded set of interior pixels and per hole in it,
/// which are the shape's where nothing is narrower than some pixels. Methods that follow a smooth
/// boundary take `contours`, which the shape approximates, or without them the shape's edges.
///
/// Errors: invalid_option; cancelled; empty; too_large (2^29 vertices; ridge: 2^31 pixels;
/// brushfire: a diagonal of 2^16 pixels); unsupported (a coordinate above 1e100, or not 0 but below
/// 1e-100 in size or as a share of the largest; what the method does not take, see MethodInfo;
/// pixels as fine as the coordinates; Options::exact, where the build lacks it or arcs are of one
/// circle but for rounding; a place too narrow to separate its sides from rounding); malformed (not
/// by build_shape(), as far as arrays show); out_of_memory; internal.
Result<MedialAxis> compute(const Shape& shape, const Options& options = {},
                           std::span<const Contour> contours = {});

/// Some edges of an axis, with the nodes and sites that they name.
struct AxisPart {
  MedialAxis axis;
  std::vector<std::uint32_t> nodes, sites;  ///< their numbers in the whole axis
  std::size_t known = 0;                    ///< the first nodes, which were in parts before
  bool begins = true;                       ///< what came before is void
};
using AxisSink = std::function<Status(AxisPart&& part)>;

/// compute() that hands the axis out as it grows, and returns what else it has. By `disks` of
/// straight edges, without `exact` and `exterior`, memory holds the boundary, its tree and what the
/// walk has left open (docs/parts.md); otherwise all is one part. The sink is called from one
/// thread at a time; its error ends the work.
Result<MedialAxis> compute_in_parts(const Shape& shape, const Options& options,
                                    const AxisSink& sink);

}  // namespace medial
