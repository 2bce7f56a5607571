#pragma once

// The features of a shape by its axis, of any method: points, branches, and the primitives that
// branches are made of, after Blum and Nagel (Pattern Recognition 10, 1978), as Volkmann and St.
// Clair report them (Section II.A.1, Figs 4 to 7). docs/features.md explains them.

#include <array>
#include <cstdint>
#include <vector>

#include "medial/axis.h"

namespace medial {

/// A point of the axis by how many separate parts of the boundary its disk touches.
enum class PointKind : std::uint8_t {
  end,        ///< one: a leaf; also the centre of a shape that is one disk
  normal,     ///< two
  branching,  ///< three or more
};

/// Blum and Nagel's primitives, by the radius along the axis (Fig 6): opening where it grows,
/// closing where it shrinks.
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

/// The variations of a primitive, by the curvature of the axis (Fig 7): spirals go in where it
/// grows in size and out where it falls.
enum class Variation : std::uint8_t {
  spiral_in_left,
  left_circular,
  spiral_out_left,
  straight,
  spiral_out_right,
  right_circular,
  spiral_in_right,
};
constexpr int variation_count = 7;

/// "closing_wedge", "spiral_in_left", "branching": stable names.
const char* name_of(PointKind kind);
const char* name_of(Primitive primitive);
const char* name_of(Variation variation);

/// How a run, a part of a branch, is classified, by numbers without a unit. Slope and bend, turning
/// and spiral of a run are those of the quadratic functions of its length that fit its radius and
/// its direction best (least squares).
struct FeatureOptions {
  double parallel = 0.05;  ///< a worm's radius changes by at most this times the run's length ...
  double even = 0.1;       ///< ... and times its mean; other runs without bend are wedges
  double bend = 0.1;       ///< the rate dR/ds of a cup or flare changes by more than this
  double turn = 0.1;       ///< a straight run turns by at most this, in radians
  double spiral = 0.5;     ///< a spiral's curvature changes by more than this times its mean
  double shortest = 0.25;  ///< shorter runs, by their mean radius, join a neighbour
};

/// A place on a branch.
struct AxisPlace {
  std::uint32_t edge = 0;
  double t = 0;  ///< parameter on that edge
  Disk disk;
};

/// A part of a branch that is one primitive in one variation, in the branch's direction.
struct PrimitiveRun {
  Primitive primitive = Primitive::worm;
  Variation variation = Variation::straight;
  AxisPlace from, to;
  double length = 0;
  double mean_radius = 0;
  double slope = 0;    ///< mean rate of the radius
  double bend = 0;     ///< by how much the rate of the radius changes from end to end
  double turning = 0;  ///< radians, positive to the left
  double spiral = 0;   ///< change of the curvature over its mean; 0 in a straight run
};

/// What a branch's disks touch on one side, with the interior on its left.
struct BoundarySection {
  std::uint32_t ring = no_site;          ///< of the input; no_site where the axis names no sites
  std::uint32_t first_vertex = no_site;  ///< of the sites at both ends: vertex of the input
  std::uint32_t last_vertex = no_site;
  Vec2 from, to;
  double length = 0;
};

/// One medial branch. It runs from its deeper end to the other one, and from a branching point to
/// an end where both are equally deep; a closed one starts where its longest run does.
struct BranchFeatures {
  std::uint32_t branch = 0;  ///< index in branches(axis)
  bool reversed = false;     ///< whether it runs against branches(axis)
  bool closed = false;       ///< without an end or branching point (Fig 5)
  std::uint32_t from = 0;    ///< node
  std::uint32_t to = 0;      ///< node
  PointKind from_kind = PointKind::normal;
  PointKind to_kind = PointKind::normal;
  double length = 0;
  double smallest_radius = 0;
  double largest_radius = 0;
  double mean_width = 0;        ///< twice the mean radius along the branch
  double turning = 0;           ///< radians, positive to the left
  double absolute_turning = 0;  ///< without signs: how much it bends in all
  double area = 0;  ///< of the shape's part whose nearest boundary the branch stands for
  /// How far the branch and all beyond it reach out of the disk at its base, in radii of that disk:
  /// the erosion thickness (Liu et al. 2011) over the radius. Infinite on cycles and between them.
  double significance = 0;
  /// When a fire from the axis's ends, started at each at the time of its radius, sets off from the
  /// two ends of the branch: at branching points once all other branches have burnt. Infinite where
  /// it does not.
  std::array<double, 2> burn{};
  std::array<BoundarySection, 2> side;  ///< left, right
  std::uint32_t first_run = 0;          ///< its runs are runs[first_run .. first_run + run_count)
  std::uint32_t run_count = 0;
};

/// The features of one axis.
struct AxisFeatures {
  std::vector<PointKind> points;         ///< of each node
  std::vector<BranchFeatures> branches;  ///< in the order of branches(axis); without length: none
  std::vector<PrimitiveRun> runs;        ///< branch after branch
  // Of the whole.
  std::uint64_t ends = 0;
  std::uint64_t branchings = 0;
  std::uint64_t closed_branches = 0;
  std::uint64_t components = 0;
  std::uint64_t cycles = 0;  ///< independent ones: the shape's holes
  double length = 0;
  double area = 0;      ///< of the shape
  double boundary = 0;  ///< length of the shape's boundary
  double largest_radius = 0;
  double mean_width = 0;
  /// Length of the runs of each class over the length of all: by primitive and variation.
  std::array<std::array<double, variation_count>, primitive_count> share{};
};

/// Describes an axis. Exact branches are cut where the signs of dR/ds, its derivative, the
/// curvature and its derivative change, samples at every node; then runs are merged by
/// FeatureOptions. The result does not depend on rotation, scale, translation, numbering and
/// direction of the input but for rounding; reflection swaps left and right. O(n log n), memory
/// O(n).
AxisFeatures describe(const MedialAxis& axis, const FeatureOptions& options = {});

}  // namespace medial
