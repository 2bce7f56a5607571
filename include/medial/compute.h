#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "medial/axis.h"
#include "medial/brushfire.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial {

/// How an axis is computed. Exact methods return the same graph; the others come near to it and say
/// so by MedialAxis::resolution.
enum class Method : std::uint8_t {
  disks,      ///< walks along the axis; asks a tree over the boundary. The fastest; holes, threads
  biarc_dc,   ///< the randomised divide and conquer of Aichholzer et al. as published: one thread
              ///< and shapes without holes only, O(n log n) to O(n^2)
  lee,        ///< Lee's divide and conquer: merges Voronoi diagrams of lists of segments and reflex
              ///< vertices; shapes of straight edges without holes only, threads
  ridge,      ///< ridge following on a grid of pixels, as Volkmann and St. Clair have it: a sampled
              ///< axis (see MedialAxis); one thread
  potential,  ///< valleys of a potential after Ahuja and Chuang: sampled, near the axis, smooth
  brushfire,  ///< thins the interior's pixels to lines: a sampled axis; one thread
};

/// How `ridge` finds the edges nearest to a pixel. Both give the same pixels.
enum class RidgeSearch : std::uint8_t {
  tree,         ///< by the boundary tree: for real sizes
  sorted_list,  ///< by the report's list of all edges, sorted by lower bounds of their distances
};

/// Which pixels `ridge` takes for medial.
enum class RidgeRule : std::uint8_t {
  /// Between the pixel and one of its four neighbours lies a point of the axis: their nearest edges
  /// are two places of the boundary; the pixel is the one of the two that is nearer to
  /// equidistance.
  /// Every medial pixel is within one pixel of the axis. Beside the boundary, as `difference`.
  crossing,
  /// The report's: the distances to the nearest and the second nearest edge, which do not meet at a
  /// concave vertex, differ by less than one pixel. Where the boundary has details finer than
  /// pixels, or turns by small angles, that takes whole regions.
  difference,
};

/// The name of a method on the command line and in MedialAxis::method: "disks", "biarc-dc", "lee",
/// "ridge", "potential", "brushfire".
const char* name_of(Method method);
/// The method of that name, if there is one.
std::optional<Method> method_from(std::string_view name);

/// Of the method `potential`: see docs/potential.md.
struct PotentialOptions {
  /// n of the force that the points are found with, in [1, 4096], any real number; 0: chosen for
  /// each point (the algorithm MAT-Generalized-Polygonal).
  double order = 0;
  /// The order of the force lines that are followed first, in [1, 4096]; 0: `order`, at most 512,
  /// or 512 where that is 0. Less, down to 1, where the arithmetic cannot connect these valleys.
  double base_order = 0;
  /// The longest step, as a share of the larger side of the bounding box, in [1e-4, 0.1].
  double step = 0.01;
  /// Coarse to fine: the skeleton of a polygon within this of the border, as a share of the larger
  /// side of the bounding box, refined on ever nearer polygons: without the branches of what that
  /// one leaves out. In [0, 0.2]; 0: all branches. Of a whole axis only.
  double coarse = 0;
  /// theta_min in degrees: how much the force may still turn with the order. In (0, 90].
  double angle = 2.56;
  /// e_min, as a share of the larger side of the bounding box: how far a point may still move with
  /// the order. In (0, 0.1].
  double movement = 0.0005;
  /// Only the branch that the force leads to from this place.
  std::optional<Vec2> from = {};
  /// Only what lies in this box: traced from the convex corners in it, connected or not.
  std::optional<Box> within = {};
  bool whole() const { return !from && !within; }
};

struct Options {
  Method method = Method::disks;
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
  /// Of ridge and brushfire: the side of a pixel, in units of the input, at most the longer side of
  /// the bounding box; or 0, and `pixels` tells how many lie along that side; both 0: 1024. At most
  /// 2^31 pixels in all.
  double resolution = 0;
  std::uint32_t pixels = 0;
  /// Of ridge: vertices between straight edges that turn by less than this, in degrees, in [0, 45],
  /// are dropped where the combined edge stays within a quarter of a pixel of them; 0 keeps all.
  double ridge_collinear = 5;
  RidgeSearch ridge_search = RidgeSearch::tree;
  RidgeRule ridge_rule = RidgeRule::crossing;
  /// Compute the axis of what lies around the shape and in its holes instead: of a frame less the
  /// shape, without the edges that touch the frame. Every concavity and every hole has its axis.
  bool exterior = false;
  /// How far the frame is away from the shape's bounding box, in units of the input, at least 1e-6
  /// and at most 1e6 of the diagonal; 0: half of the longer side.
  double margin = 0;
  /// Of brushfire: which of the report's families.
  Brushfire brushfire = Brushfire::simultaneous;
  /// Of the random choices of biarc_dc: the same seed gives the same result, byte for byte.
  std::uint64_t seed = 1;
  PotentialOptions potential = {};
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
/// Errors: invalid_option; cancelled; empty; too_large (2^29 vertices; ridge: 2^31 pixels;
/// brushfire: a diagonal of 2^16 pixels); unsupported (a coordinate above 1e100, or not 0 but below
/// 1e-100 in size or as a share of the largest; holes, for biarc_dc and lee; arcs, for lee;
/// pixels as fine as the coordinates, for ridge and brushfire; no pixel's centre inside, and the
/// exterior, for brushfire; Options::exact, where the build lacks it or arcs are of one circle but
/// for rounding; a place too narrow for its sides to be told from rounding); malformed (not by
/// build_shape(), as far as arrays tell: not whether edges cross); out_of_memory; internal.
Result<MedialAxis> compute(const Shape& shape, const Options& options = {});

}  // namespace medial
