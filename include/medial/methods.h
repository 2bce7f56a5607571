#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "medial/box.h"
#include "medial/brushfire.h"
#include "medial/vec2.h"

namespace medial {

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

/// The size of square pixels; both 0: 1024 along the longer side of the bounding box, and at most
/// 2^31 in all.
struct PixelGrid {
  double resolution = 0;     ///< the side of a pixel, at most the longer side of the bounding box
  std::uint32_t pixels = 0;  ///< or how many lie along that side
};

/// The methods, each with the options that it alone has. Exact methods return the same graph; the
/// others come near to it and say so by MedialAxis::resolution.
namespace method {

/// Walks along the axis and asks a tree over the boundary: the fastest.
struct Disks {};

/// The randomised divide and conquer of Aichholzer et al. as published: O(n log n) to O(n^2).
struct BiarcDc {
  std::uint64_t seed = 1;  ///< the same seed gives the same result, byte for byte
};

/// Lee's divide and conquer, which merges Voronoi diagrams of lists of segments and reflex
/// vertices.
struct Lee {};

/// Whichever of these takes the least processor time, by what was measured (docs/lee.md): `lee` for
/// polygons without holes that are convex or nearly so, or smooth; `disks` for all others, and
/// where `lee` fails. It does not depend on the number of threads.
struct Auto {};

/// Ridge following on a grid of pixels, as Volkmann and St. Clair have it.
struct Ridge {
  PixelGrid grid = {};
  /// Vertices between straight edges that turn by less than this, in degrees, in [0, 45], are
  /// dropped where the combined edge stays within a quarter of a pixel of them; 0 keeps all.
  double collinear = 5;
  RidgeSearch search = RidgeSearch::tree;
  RidgeRule rule = RidgeRule::crossing;
};

/// Thins the interior's pixels to lines.
struct Brushfire {
  PixelGrid grid = {};
  medial::Brushfire family = medial::Brushfire::simultaneous;
};

/// Valleys of a potential after Ahuja and Chuang; see docs/potential.md.
struct Potential {
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

/// Follows the axis of one smooth curve from the maxima of its curvature; see medial/curve_axis.h.
struct CurveAxis {
  /// The way along the axis from point to point, relative to the diagonal of the bounding box, in
  /// [1e-6, 0.1]; shorter where the boundary turns fast. Where the control process goes astray it
  /// restarts with half of it, up to five times: MedialAxis::resolution is the last one's.
  double step = 1e-3;
  /// Which of the curvature's maxima, counted along the boundary from its start, the first
  /// generation starts from. The axis is the same for each, to the steps.
  std::size_t first_maximum = 0;
};

}  // namespace method

/// One of the methods, with its options.
using Method = std::variant<method::Disks, method::BiarcDc, method::Lee, method::Auto,
                            method::Ridge, method::Brushfire, method::Potential, method::CurveAxis>;

/// What a method's axes are made of.
enum class Sampling : std::uint8_t {
  none,    ///< exact curves
  points,  ///< points in steps along the axis
  pixels,  ///< pixels of a grid
};

/// What a method is and what it takes. compute() refuses the rest.
struct MethodInfo {
  const char* name;     ///< on the command line and in MedialAxis::method
  const char* summary;  ///< a few words
  Sampling sampling = Sampling::none;
  bool holes = true;      ///< shapes with holes
  bool arcs = true;       ///< boundaries with arcs
  bool exterior = true;   ///< Options::exterior
  bool part = false;      ///< computes a part of an axis
  bool contours = false;  ///< follows smooth contours in place of a shape
  bool threads = false;   ///< uses several threads
  /// Whether it takes Options::exact.
  bool exact() const { return sampling == Sampling::none; }
};

/// All methods, in the order of Method's alternatives.
std::span<const MethodInfo> methods();
const MethodInfo& info_of(const Method& method);
inline const char* name_of(const Method& method) { return info_of(method).name; }

/// The method of that name with its default options, if there is one.
std::optional<Method> method_from(std::string_view name);
/// Whether axes with this MedialAxis::method are made of pixels.
bool is_of_pixels(std::string_view method);

}  // namespace medial
