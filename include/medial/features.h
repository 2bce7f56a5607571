#pragma once

// The features of a shape by its axis, after Blum and Nagel (1978) and Volkmann and St. Clair
// (Section II.A.1, Figs 4 to 7); how alike two shapes are, and how they interlock.

#include "medial/query.h"

namespace medial {

/// A point of the axis by how many separate parts of the boundary its disk touches.
enum class PointKind : std::uint8_t {
  end,        ///< one: a leaf; also the centre of a shape that is one disk
  normal,     ///< two
  branching,  ///< three or more
};

/// Blum and Nagel's primitives (Fig 6): opening where the radius grows, closing where it shrinks.
enum class Primitive : std::uint8_t {
  worm,           ///< the radius stays
  opening_wedge,  ///< it changes evenly
  closing_wedge,
  opening_cup,  ///< its rate falls: the sides bulge outwards
  closing_cup,
  opening_flare,  ///< its rate rises: the sides bend inwards, as a trumpet's
  closing_flare,
};
constexpr int primitive_count = 7;

/// Variations (Fig 7): the axis's curvature grows in size along a spiral in, falls along one out.
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

/// How a run, a part of a branch, is classified: by quadratics of radius and direction by length.
struct FeatureOptions {
  double parallel = 0.05;  ///< a worm's radius changes by at most this times the run's length ...
  double even = 0.1;       ///< ... and times its mean; other runs without bend are wedges
  double bend = 0.1;       ///< the rate dR/ds of a cup or flare changes by more than this
  double turn = 0.1;       ///< a straight run turns by at most this, in radians
  double spiral = 0.5;     ///< a spiral's curvature changes by more than this times its mean
  double shortest = 0.25;  ///< shorter runs, by their mean radius, join a neighbour
};

/// A part of a branch that is one primitive in one variation, in the branch's direction.
struct PrimitiveRun {
  Primitive primitive = Primitive::worm;
  Variation variation = Variation::straight;
  AxisPlace from, to;
  double length = 0, mean_radius = 0;
  double slope = 0, bend = 0;  ///< the mean rate of the radius, and by how much that changes
  double turning = 0;          ///< radians, positive to the left
  double spiral = 0;           ///< change of the curvature over its mean; 0 in a straight run
};

/// What a branch's disks touch on one side, with the interior on its left.
struct BoundarySection {
  std::uint32_t ring = no_site;  ///< of the input; no_site where the axis names no sites
  std::uint32_t first_vertex = no_site, last_vertex = no_site;  ///< of the sites at both ends
  Vec2 from, to;
  double length = 0;
};

/// A branch from its deeper end, of equals a branching point; a closed one from its longest run.
struct BranchFeatures {
  std::uint32_t branch = 0;        ///< index in branches(axis)
  bool reversed = false;           ///< whether it runs against branches(axis)
  bool closed = false;             ///< without an end or branching point (Fig 5)
  std::uint32_t from = 0, to = 0;  ///< nodes
  PointKind from_kind = PointKind::normal, to_kind = PointKind::normal;
  double length = 0, smallest_radius = 0, largest_radius = 0;
  double mean_width = 0;                     ///< twice the mean radius along the branch
  double turning = 0, absolute_turning = 0;  ///< radians, positive to the left; without signs
  double area = 0;  ///< of the shape's part whose nearest boundary the branch stands for
  /// Erosion thickness (Liu et al. 2011) in radii of the disk at its base: how far the branch and
  /// all beyond it reach out of that disk. Infinite on cycles and between them.
  double significance = 0;
  /// When a fire leaves its two ends: from the axis's ends at the time of their radius, from a
  /// branching point once all other branches have burnt. Infinite where it never does.
  std::array<double, 2> burn{};
  std::array<BoundarySection, 2> side;         ///< left, right
  std::uint32_t first_run = 0, run_count = 0;  ///< runs[first_run .. first_run + run_count)
};

struct AxisFeatures {
  std::vector<PointKind> points;         ///< of each node
  std::vector<BranchFeatures> branches;  ///< in the order of branches(axis); without length: none
  std::vector<PrimitiveRun> runs;        ///< branch after branch
  // Of the whole.
  std::uint64_t ends = 0, branchings = 0, closed_branches = 0, components = 0;
  std::uint64_t cycles = 0;  ///< independent ones: the shape's holes
  double length = 0, largest_radius = 0, mean_width = 0;
  double area = 0, boundary = 0;  ///< of the shape, and the length of its boundary
  /// Length of the runs of each class over the length of all: by primitive and variation.
  std::array<std::array<double, variation_count>, primitive_count> share{};
};

/// Cuts exact branches where signs of dR/ds, the curvature and their derivatives change, sampled
/// ones at every node; then merges runs. Reflection swaps left and right. O(n log n).
AxisFeatures describe(const MedialAxis& axis, const FeatureOptions& options = {});

/// A shape in a few numbers without units, the same for rotated, scaled and mirrored images. Pieces
/// of the axis count by their lengths, less near the noise of the boundary.
struct ShapeSignature {
  std::array<double, 101> values{};
};

constexpr double speck_share = 0.1;  ///< of without_specks()
/// The shape without specks: holes, and components besides others, whose bounding box has a
/// diagonal of at most `share` times the square root of the area. O(n).
Shape without_specks(const Shape& shape, double share = speck_share);

/// Of the axis of without_specks(), with its own features. O(edges log(edges)).
ShapeSignature signature_of(const MedialAxis& axis, const AxisFeatures& features);

/// 0 for the same shape, about 1 for two shapes at random; symmetric.
double dissimilarity(const ShapeSignature& a, const ShapeSignature& b);

/// Where a shape lies: x -> -x if mirrored, then turned about the origin (radians), then moved.
struct Placement {
  double angle = 0;
  bool mirrored = false;
  Vec2 move = {};
  Vec2 bay = {};     ///< the bottom of the bay, of either shape, that a peninsula lies in
  double saved = 0;  ///< by how much the convex hull of both is smaller than their own hulls
  double gap = 0;    ///< the least distance between the shapes
};
Shape placed(const Shape& shape, const Placement& at);

/// Where the shapes interlock: bays of each (branches of its exterior's axis) are paired with
/// peninsulas of the other. At most `best` placements of the second shape that save area, those
/// that save most first. Errors: those of compute(); unsupported (shapes of several components).
Result<std::vector<Placement>> nest(const Shape& fixed, const Shape& moving, double gap = 0,
                                    bool mirror = true, std::size_t best = 5);

}  // namespace medial
