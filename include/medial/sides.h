#pragma once

// From an axis back to its boundary, as a shape, as pixels, and on both sides (Shaked, Bruckstein
// 1996, Sections 2 and 3: their equations in brackets; subscripts a are derivatives by length).

#include "medial/query.h"
#include "medial/raster.h"

namespace medial {

/// The jet of an axis at one of its points: the disk there and how it changes along the axis.
struct AxisJet {
  Disk disk;
  Vec2 tangent;            ///< A_a, of length 1
  double radius_rate = 0;  ///< R_a, no unit; beyond [-1, 1] no shape has such an axis
  double radius_bend = 0;  ///< R_aa, 1 / length
  double curvature = 0;    ///< K_A, 1 / length, positive where the axis turns left
  double rate_error = 0;   ///< of R_a, by rounding, or of packs their own; 0 on other samples
  double bend_error = 0;   ///< of R_aa and K_A in the same way
};

/// The jet at t in [0, 1] of an edge; of length 0 the tangent is 0 and the rest undefined.
AxisJet jet_at(const MedialAxis& axis, const Edge& edge, double t);

/// The boundary at a foot of a disk, followed in the direction of the axis.
struct BoundaryJet {
  Vec2 point;            ///< (3)
  Vec2 tangent;          ///< (5), of length 1
  double rate = 0;       ///< (6): length of boundary by length of axis; 0 at a reflex vertex
  double curvature = 0;  ///< (7), 1 / length, positive where the shape is convex; infinite at a
                         ///< reflex vertex; NaN where nothing decides it (|R_a| = 1)
  double radius_of_curvature() const { return 1 / curvature; }  ///< (8), with its sign
};

enum class Side : std::uint8_t { left, right };

/// One side of the axis. Requires |R_a| <= 1; values beyond are taken for 1.
BoundaryJet boundary_at(const AxisJet& jet, Side side);

/// The curvature of the boundary on one side at t in (0, 1) of an edge, and its first `order`
/// derivatives by the boundary's length, by power series; not finite at a reflex vertex. O(order^2)
std::vector<double> boundary_curvatures(const MedialAxis& axis, const Edge& edge, double t,
                                        Side side, int order);

struct FootCurvature {
  Side side = Side::left;
  Disk disk;
  Vec2 foot;
  double curvature = 0, slope = 0;  ///< (7), and its derivative with the interior on the left
};
/// At the feet of jets_along(), but at reflex vertices: by power series of exact edges, of samples
/// by polynomials through five feet of a side, the left one first.
std::vector<FootCurvature> curvatures_along(const MedialAxis& axis, const Branch& branch);

/// The jets along a branch in its direction: of an exact axis `samples` inside of every
/// edge with a length, of a sampled one at every inner node from its neighbours.
std::vector<AxisJet> jets_along(const MedialAxis& axis, const Branch& branch, int samples = 8);

/// How far a branch is from breaking the two conditions that every medial axis meets: no unit,
/// positive where it breaks them. Jets whose errors leave the answer open do not count.
struct Legality {
  double steepness = 0;    ///< (9): the largest |R_a| - 1
  double bend = 0;         ///< (10): the largest |K_A| R s - (1 - R_a^2 - R R_aa), with
                           ///< s^2 = 1 - R_a^2; it is 0 along a reflex vertex
  std::uint64_t jets = 0;  ///< how many counted
  AxisJet steepest;        ///< where `steepness` is reached
  AxisJet sharpest;        ///< where `bend` is
  /// Whether both conditions hold up to `slack`, for rounding or the noise of samples.
  bool legal(double slack) const { return steepness <= slack && bend <= slack; }
  /// With more than that to spare: then each short piece is the axis of what its own disks cover.
  bool strictly_legal(double slack) const { return steepness < -slack && bend < -slack; }
};

/// One for each of branches(axis), in that order. O(edges).
std::vector<Legality> legality(const MedialAxis& axis, int samples_per_edge = 8);

enum class RebuildBy : std::uint8_t {
  /// boundary_of() exact axes; hulls of packs and, without `points`, of pixels; tangents of others
  outline,
  tangents,  ///< a polygon from tangents of disks (Volkmann and St. Clair, Section II.C)
  hulls,     ///< a polygon around the convex hulls of the disks at both ends of each edge
};

struct RebuildOptions {
  RebuildBy by = RebuildBy::outline;
  /// Of tangents: about how many points on the axis, by its length. 0: samples' nodes, or 1000.
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

/// The union of the disks: the pixels whose centres lie in one of them, `pixels` along the longer
/// side of their box, with a margin of one around. The first row has the largest y, or with
/// `y_down` the smallest. Where radii exceed a pixel, every point a tenth of a pixel inside the
/// union is covered. Errors: empty, invalid_option (pixels is 0 or above 32768).
Result<PlacedImage> rebuild_image(const MedialAxis& axis, std::uint32_t pixels,
                                  bool y_down = false);

}  // namespace medial
