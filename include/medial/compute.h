#pragma once

#include <atomic>
#include <functional>
#include <span>

#include "medial/axis.h"
#include "medial/contour.h"
#include "medial/error.h"
#include "medial/methods.h"
#include "medial/shape.h"

namespace medial {

struct Options {
  Method method = method::Disks{};
  /// Disks whose residuals stay below this count as touching. Relative to the diagonal of the
  /// bounding box, in (0, 1e-3]; 0: the default, 4e-15, or what the coordinates' own spacing allows
  /// where the shape lies far from the origin.
  double tolerance = 0;
  /// Where two edges meet at a convex angle and one of them is an arc, the joint is smooth, no
  /// corner, if the directions differ by less than this; in degrees, in [0, 10].
  double corner_angle = 0.01;
  /// Makes every decision of the combinatorics certain: which sites a disk touches and in which
  /// order, and which nodes an edge joins. Sites that touch one disk within the tolerance, but not
  /// exactly, then have nodes of their own, with edges shorter than the tolerance in between; see
  /// docs/exact.md for what counts as the exact shape. Slower. Not for methods that sample.
  bool exact = false;
  /// Threads to use, at most 1024; 0: all of the machine. The result is the same, byte for byte.
  int threads = 0;
  /// Compute the axis of what lies around the shape and in its holes instead: of an enclosure less
  /// the shape, without the edges that touch it. Every concavity and every hole has its axis.
  bool exterior = false;
  /// How far the enclosure is away from the shape's bounding box, in units of the input, at least
  /// 1e-6 and at most 1e6 of the diagonal; 0: half of the longer side.
  double margin = 0;
  /// Called now and then, from any thread and out of order, with the share of the boundary that the
  /// walk is done with, in [0, 1]; in the end with 1. What comes before the walk (sites, holes,
  /// tree) counts as 0, what comes after it as 1: together less than half of the time. Must not
  /// throw.
  std::function<void(double)> progress = {};
  /// When set to true, compute() returns ErrorCode::cancelled as soon as it can: at once during the
  /// walk, and otherwise at the end of the phase. Set too late it changes nothing but the result.
  const std::atomic<bool>* cancel = nullptr;
};

/// The exact medial axis transform of a shape; by the method `disks` O(n log n) expected.
///
/// The graph has one connected part for each component of the shape and exactly one independent
/// cycle for each hole; by the methods `ridge` and `brushfire` that holds for each bounded set of
/// interior pixels and its holes, which are the shape's where nothing is narrower than some pixels.
///
/// `contours`: the smooth boundary that the shape approximates, for methods that follow it; without
/// it they take the shape's own edges.
///
/// Errors: invalid_option; cancelled; empty; too_large (2^29 vertices; ridge: 2^31 pixels;
/// brushfire: a diagonal of 2^16 pixels); unsupported (a coordinate above 1e100, or not 0 but below
/// 1e-100 in size or as a share of the largest; what the method does not take, see MethodInfo;
/// pixels as fine as the coordinates, for ridge and brushfire; no pixel's centre inside, for
/// brushfire; Options::exact, where the build lacks it or arcs are of one circle but for rounding;
/// a place too narrow to separate its sides from rounding); malformed (not by build_shape(), as far
/// as arrays tell: not whether edges cross); out_of_memory; internal.
Result<MedialAxis> compute(const Shape& shape, const Options& options = {},
                           std::span<const Contour> contours = {});

}  // namespace medial
