#pragma once

// From an axis back to its boundary, as a shape, as pixels, and on both sides (Shaked, Bruckstein
// 1996, Sections 2 and 3: equation numbers in brackets; subscript a: derivative by arc length).

#include "medial/query.h"
#include "medial/raster.h"

namespace medial {

/// The jet of an axis at one of its points: the disk there and how it changes along the axis.
struct AxisJet {
  Disk disk;
  Vec2 tangent;            ///< A_a, of length 1
  double radius_rate = 0;  ///< R_a, no unit; in [-1, 1] on every axis of a shape
  double radius_bend = 0;  ///< R_aa, 1 / length
  double curvature = 0;    ///< K_A, 1 / length, positive where the axis turns left
  double rate_error = 0;   ///< of R_a, by rounding or the error of a pack; 0 for other samples
  double bend_error = 0;   ///< the same for R_aa and K_A
};

/// The jet at t in [0, 1] of an edge; if its length is 0, the tangent is 0, the rest undefined.
AxisJet jet_at(const MedialAxis& axis, const Edge& edge, double t);

/// The boundary at a foot of a disk, followed in the direction of the axis.
struct BoundaryJet {
  Vec2 point;            ///< (3)
  Vec2 tangent;          ///< (5), of length 1
  double rate = 0;       ///< (6): length of boundary per length of axis; 0 at a reflex vertex
  double curvature = 0;  ///< (7), 1 / length, positive where the shape is convex; infinite at a
                         ///< reflex vertex; NaN where undetermined (|R_a| = 1)
  double radius_of_curvature() const { return 1 / curvature; }  ///< (8), with its sign
};

enum class Side : std::uint8_t { left, right };

/// The boundary on one side of the axis. Clamps R_a to [-1, 1].
BoundaryJet boundary_at(const AxisJet& jet, Side side);

/// The curvature of the boundary on one side at t in (0, 1) of an edge, and its first `order`
/// derivatives by arc length, from power series; not finite at a reflex vertex. O(order^2).
std::vector<double> boundary_curvatures(const MedialAxis& axis, const Edge& edge, double t,
                                        Side side, int order);

struct FootCurvature {
  Side side = Side::left;
  Disk disk;
  Vec2 foot;
  double curvature = 0, slope = 0;  ///< (7), and its derivative with the interior on the left
};
/// The curvatures at the foot points of jets_along(), except reflex vertices: on exact edges from
/// power series; of samples from polynomials through five foot points, the left side first.
std::vector<FootCurvature> curvatures_along(const MedialAxis& axis, const Branch& branch);

/// The jets along a branch in its direction: for an exact axis, at `samples` points inside every
/// edge of positive length; for a sampled one, at every inner node, from its neighbours.
std::vector<AxisJet> jets_along(const MedialAxis& axis, const Branch& branch, int samples = 8);

/// How far a branch is from violating the two conditions that every medial axis meets: no unit,
/// positive if it violates them. Ignores jets whose errors leave the answer open.
struct Legality {
  double steepness = 0;    ///< (9): the largest |R_a| - 1
  double bend = 0;         ///< (10): the largest |K_A| R s - (1 - R_a^2 - R R_aa), with
                           ///< s^2 = 1 - R_a^2; it is 0 along a reflex vertex
  std::uint64_t jets = 0;  ///< how many counted
  AxisJet steepest;        ///< where `steepness` is reached
  AxisJet sharpest;        ///< where `bend` is
  /// Whether both conditions hold up to `slack`, an allowance for rounding or noise of samples.
  bool legal(double slack) const { return steepness <= slack && bend <= slack; }
  /// With more than `slack` to spare: then each short piece is the axis of its own disks' union.
  bool strictly_legal(double slack) const { return steepness < -slack && bend < -slack; }
};

/// One for each of branches(axis), in order. O(edges).
std::vector<Legality> legality(const MedialAxis& axis, int samples_per_edge = 8);

enum class RebuildBy : std::uint8_t {
  /// The exact boundary of exact axes; hulls for packs and, without `points`, pixels; else tangents
  outline,
  tangents,  ///< a polygon from tangents of disks (Volkmann and St. Clair, Section II.C)
  hulls,     ///< a polygon around the convex hulls of the disks at both ends of each edge
};

struct RebuildOptions {
  RebuildBy by = RebuildBy::outline;
  std::uint64_t points = 0;  ///< for tangents: about how many; 0: nodes of samples, or 1000
  /// Replaces arcs by chords within this distance, in units of the input; 0: keeps arcs. Hulls
  /// always have chords: within 1/16 of the axis's resolution, or 1e-6 of its extent.
  double chord = 0;
  double corner_angle = 0.01;  ///< that the axis was computed with; see Options
};

struct RebuildReport {
  std::uint64_t medial_points = 0;  ///< for tangents and hulls: points used on the axis
  std::uint64_t crossings = 0;      ///< places where the new boundary crossed itself and was split
};
/// The shape of an axis: for an exact one its original shape, with ends of sites bit for bit; for a
/// pruned one the union of its disks; for an exterior the surroundings within the enclosure.
/// O(n log n). Errors: empty (an axis without nodes), those of build_shape().
Result<Shape> rebuild(const MedialAxis& axis, const RebuildOptions& options = {},
                      RebuildReport* report = nullptr);

/// The union of the disks as an image: sets pixels whose centre is in a disk, `pixels` of them
/// along the longer side of the box, plus a margin of one. The first row has the largest y, or with
/// `y_down` the smallest. Covers every point a tenth of a pixel inside the union where radii exceed
/// a pixel. Errors: empty, invalid_option (pixels is 0 or above 32768).
Result<PlacedImage> rebuild_image(const MedialAxis& axis, std::uint32_t pixels,
                                  bool y_down = false);

}  // namespace medial
