#pragma once

// Carving along the medial axis with a V-shaped tool: where its point follows the axis at the depth
// at which the cone is as wide as the disk, the walls become planes that start at the shape's
// boundary, and inner corners come out sharp. What is wider than the tool reaches gets a flat
// bottom, cleared along offset curves.

#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "medial/error.h"

namespace medial {

/// A tool, and how deep it may go. All lengths in units of the input.
struct CarveOptions {
  /// Between the sides of the cone, in degrees, in [0, 170]; 0: an end mill, which is all tip.
  double angle = 90;
  /// How deep at most; 0: as deep as the tool reaches. Required for an end mill.
  double depth = 0;
  /// The diameter of the tool; 0: no limit. Of a cone the largest one, which limits the depth.
  double tool = 0;
  /// The diameter of the cone's flat tip, below `tool`. An end mill's is `tool`.
  double tip = 0;
  /// How deep one pass goes at most; 0: all in one. Passes are cut one after another from the
  /// surface down, each to its own flat bottom.
  double pass_depth = 0;
  /// Between the passes that clear a flat bottom; 0: half of the tip's diameter, which leaves
  /// nothing; where the tip is a point a 20th of the cone's radius at that depth, which leaves
  /// ridges.
  double step = 0;
  /// How far the straight moves may be off the curved parts of the axis; 0: 1e-5 of the diagonal of
  /// the axis's sites, at least 1e-8 of it. They are always off upwards: see below.
  double chord = 0;
};

/// Where the tool's tip is: z is 0 on the surface and negative below it. (Chords of curves may
/// begin a little above it: they are lifted as a whole.)
struct ToolPoint {
  Vec2 point;
  double z = 0;
  double bulge = 0;  ///< of the move to the next point, which is an arc at one depth: see Ring
};

enum class ToolPathKind : std::uint8_t {
  clearing,  ///< a flat bottom, inside of its wall
  wall,      ///< along the foot of the walls around a flat bottom
  groove,    ///< along the axis
};

/// Moves without lifting the tool.
struct ToolPath {
  ToolPathKind kind = ToolPathKind::groove;
  std::vector<ToolPoint> points;
  std::uint32_t pass = 0;  ///< from the surface down: see CarveOptions::pass_depth
};

struct Carving {
  std::vector<ToolPath> paths;  ///< in the order of cutting
  double deepest = 0;           ///< depth, positive
  double flat_from = 0;         ///< the clearance from which on the bottom is flat; infinite: none
  double tip_radius = 0;        ///< of the tool
  double slope = 0;             ///< tangent of half of the angle
  double step = 0;              ///< between clearing passes
  double cut_length = 0;        ///< in the plane
  double travel_length = 0;     ///< in the plane, of lifted moves from path to path
  double travel_unordered = 0;  ///< the same if branches and rings came as the axis numbers them
};

/// Plans the paths of one tool in one shape.
///
/// With c(p) the clearance of a point, t the radius of the tip and m = tan(angle / 2), the tool may
/// be at p where c(p) >= t, at the depth min((c(p) - t) / m, depth). The paths
/// - never gouge: nowhere is the tool deeper, but for rounding (a few 1e-15 of the size);
/// - leave nothing that the tool could reach, but (1) 3 chords / m along curved edges of the axis,
///   and (2) where the tip is a point, ridges of step / m on flat bottoms; (2) also where `step`
///   exceeds the tip's radius.
/// With a pass depth, pass k cuts as if that were k pass depths deep at most, but for what the
/// passes before it have cut: it takes off one pass depth at most, and ridges (2).
/// Axis parts narrower than the tip are left out. O(n log n + size of the result).
/// Errors: invalid_option, unsupported (an axis that is sampled or of the exterior), too_large
/// (more than 1e6 clearing passes, or 1e4 in depth).
Result<Carving> carve(const MedialAxis& axis, const CarveOptions& options);

/// Options and carvings in other units: every length times `factor`, which must be positive.
CarveOptions scaled(CarveOptions options, double factor);
Carving scaled(Carving carving, double factor);

/// The points of a path with its arcs as chords, at most `chord` away from them, and never nearer
/// to the shape's boundary than they are: inside of arcs that turn left, and outside, along their
/// tangents, of those that turn right. Requires chord > 0.
std::vector<ToolPoint> without_arcs(const ToolPath& path, double chord);

}  // namespace medial
