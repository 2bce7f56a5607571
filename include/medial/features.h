#pragma once

// Features of a shape from its axis, after Blum and Nagel (1978) and Volkmann and St. Clair
// (Section II.A.1, Figs 4 to 7); similarity of shapes, and nesting.

#include "medial/query.h"

namespace medial {

/// A point of the axis by the number of separate parts of the boundary that its disk touches.
enum class PointKind : std::uint8_t {
  end,        ///< one: a leaf; also the centre of a shape that is one disk
  normal,     ///< two
  branching,  ///< three or more
};

/// Blum and Nagel's primitives (Fig 6): opening where the radius grows, closing where it shrinks.
enum class Primitive : std::uint8_t {
  worm,           ///< constant radius
  opening_wedge,  ///< linear radius
  closing_wedge,
  opening_cup,  ///< the slope falls: the sides bulge outwards
  closing_cup,
  opening_flare,  ///< the slope rises: the sides bend inwards, as a trumpet's
  closing_flare,
};
constexpr int primitive_count = 7;

/// Variations (Fig 7): along a spiral in, the size of the axis's curvature grows; out, it falls.
enum class Variation : std::uint8_t {
  spiral_in_left,
  left_circular,
  spiral_out_left,
  straight,
  spiral_out_right,
  right_circular,
  spiral_in_right
};
constexpr int variation_count = 7;

/// "closing_wedge", "spiral_in_left", "branching": stable names.
const char* name_of(PointKind kind);
const char* name_of(Primitive primitive);
const char* name_of(Variation variation);

/// Thresholds that classify runs (parts of branches), fitted by quadratics over arc length.
struct FeatureOptions {
  double parallel = 0.05;  ///< a worm's radius changes by at most this times the run's length ...
  double even = 0.1;       ///< ... and times its mean radius; other runs without bend are wedges
  double bend = 0.1;       ///< the slope dR/ds of a cup or flare changes by more than this
  double turn = 0.1;       ///< a straight run turns by at most this, in radians
  double spiral = 0.5;     ///< a spiral's curvature changes by more than this times its mean
  double shortest = 0.25;  ///< shorter runs, in units of their mean radius, join a neighbour
};

/// A part of a branch that is one primitive in one variation, in the branch's direction.
struct PrimitiveRun {
  Primitive primitive = Primitive::worm;
  Variation variation = Variation::straight;
  AxisPlace from, to;
  double length = 0, mean_radius = 0;
  double slope = 0, bend = 0;  ///< mean of dR/ds, and its change
  double turning = 0;          ///< radians, positive to the left
  double spiral = 0;           ///< change of the curvature divided by its mean; 0 if straight
};

/// The boundary that a branch's disks touch on one side; the interior is on its left.
struct BoundarySection {
  std::uint32_t ring = no_site;  ///< of the input; no_site if the axis has no sites
  std::uint32_t first_vertex = no_site, last_vertex = no_site;  ///< of the sites at both ends
  Vec2 from, to;
  double length = 0;
};

/// A branch from its deeper end (if equal, a branching); if closed, from its longest run.
struct BranchFeatures {
  std::uint32_t branch = 0;        ///< index in branches(axis)
  bool reversed = false;           ///< runs against the direction in branches(axis)
  bool closed = false;             ///< without an end or branching point (Fig 5)
  std::uint32_t from = 0, to = 0;  ///< nodes
  PointKind from_kind = PointKind::normal, to_kind = PointKind::normal;
  double length = 0, smallest_radius = 0, largest_radius = 0;
  double mean_width = 0;                     ///< twice the mean radius along the branch
  double turning = 0, absolute_turning = 0;  ///< in radians, signed (left positive), unsigned
  double area = 0;  ///< of the points of the shape that belong to the branch's boundary sections
  /// Erosion thickness (Liu et al. 2011): how far the branch and all beyond it reach out of the
  /// disk at its base, in radii of that disk. Infinite on cycles and between them.
  double significance = 0;
  /// The times at which a fire leaves its two ends: an end of the axis at the time of its radius, a
  /// branching once all other branches have burnt. Infinite if it never does.
  std::array<double, 2> burn{};
  std::array<BoundarySection, 2> side;         ///< left, right
  std::uint32_t first_run = 0, run_count = 0;  ///< runs[first_run .. first_run + run_count)
};

struct AxisFeatures {
  std::vector<PointKind> points;         ///< of each node
  std::vector<BranchFeatures> branches;  ///< as branches(axis), except those of length 0
  std::vector<PrimitiveRun> runs;        ///< branch after branch
  // Totals.
  std::uint64_t ends = 0, branchings = 0, closed_branches = 0, components = 0;
  std::uint64_t cycles = 0;  ///< independent cycles: the shape's holes
  double length = 0, largest_radius = 0, mean_width = 0;
  double area = 0, boundary = 0;  ///< of the shape, and the length of its boundary
  /// The share of each class in the length of all runs, by primitive and variation.
  std::array<std::array<double, variation_count>, primitive_count> share{};
};

/// Cuts exact branches where dR/ds, the curvature or their derivatives change sign, and sampled
/// ones at every node; then merges runs. Reflection swaps left and right. O(n log n).
AxisFeatures describe(const MedialAxis& axis, const FeatureOptions& options = {});

/// A shape as dimensionless numbers, the same if it is rotated, scaled or mirrored. Pieces of the
/// axis are weighted by length, and less near noise of the boundary.
struct ShapeSignature {
  std::array<double, 101> values{};
};

constexpr double speck_share = 0.1;  ///< of without_specks()
/// The shape without specks: holes and components whose bounding box has a diagonal of at most
/// `share` times the square root of the area. If all components are specks, keeps all. O(n).
Shape without_specks(const Shape& shape, double share = speck_share);

/// Takes the axis of without_specks(), and the features of that axis. O(edges log(edges)).
ShapeSignature signature_of(const MedialAxis& axis, const AxisFeatures& features);

/// 0 for the same shape, about 1 for two random shapes; symmetric.
double dissimilarity(const ShapeSignature& a, const ShapeSignature& b);

/// A rigid motion: x -> -x if mirrored, then rotated about the origin (radians), then moved.
struct Placement {
  double angle = 0;
  bool mirrored = false;
  Vec2 move = {};
  Vec2 bay = {};     ///< the bottom of the bay, of either shape, that a peninsula lies in
  double saved = 0;  ///< area of the shapes' convex hulls less that of their common hull
  double gap = 0;    ///< the least distance between the shapes
};
Result<Shape> placed(const Shape& shape, const Placement& at);  ///< errors: see build_shape()

/// Placements of `moving` in which the shapes interlock: pairs bays of each (branches of its
/// exterior's axis) with peninsulas of the other. Returns at most `best` that save area, best
/// first. Errors: invalid_option (gap); of feature 0 or 1 those of compute(), and unsupported.
Result<std::vector<Placement>> nest(const Shape& fixed, const Shape& moving, double gap = 0,
                                    bool mirror = true, std::size_t best = 5);

}  // namespace medial
