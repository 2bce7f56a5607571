#pragma once

// Carving with a V-shaped tool. Its tip follows the axis where the cone is as wide as the disk, so
// inner corners come out sharp. Wider parts get a flat bottom, cleared along offsets.

#include "medial/axis.h"
#include "medial/shape.h"

namespace medial {

/// The middle of a tab: from one side, over the centre of a maximal disk, to the other.
using TabLine = std::array<Vec2, 3>;

/// Bars of material that are left across what is cut, so that no part comes loose.
struct Tabs {
  std::vector<TabLine> lines = {};
  double width = 0;  ///< positive where there are lines
  double top = 0;    ///< how deep their upper side lies below the surface
};

/// How many tabs each part has that would come loose.
struct TabOptions {
  std::uint32_t count = 0;
  double spacing = 0;  ///< along the part's boundary, where the count is 0
};

/// Lengths in units of the input.
struct CarveOptions {
  double angle = 90;  ///< between the sides of the cone, in degrees, in [0, 170]; 0: an end mill
  double depth = 0;   ///< at most; 0: as deep as the tool reaches; required for an end mill
  double tool = 0;    ///< largest diameter, which limits the depth of a cone; 0: no limit
  double tip = 0;     ///< diameter of the cone's flat tip, below `tool`; an end mill's is `tool`
  double pass_depth = 0;  ///< of one pass at most; 0: all in one; cut from the surface down
  double ramp = 90;       ///< steepest way into the material, in degrees, in (0, 90]; 90: straight
  /// Between the passes that clear a flat bottom; 0: half of the tip's diameter, which leaves
  /// nothing, or for a pointed tip a 20th of the cone's radius at that depth, which leaves ridges.
  double step = 0;
  /// How far straight moves may be above the axis, at least 1e-8 diagonals of its sites; 0: 1e-5.
  double chord = 0;
  double allowance = 0;  ///< of an end mill: kept from the boundary besides
  /// Diameter of an end mill that has cleared flat bottoms with clearing_before(); 0: none has.
  double cleared = 0;
  Tabs tabs = {};  ///< to be left standing, see place_tabs()
};

struct ToolPoint {
  Vec2 point;
  double z = 0;      ///< 0 on the surface, negative below; chords may begin a little above it
  double bulge = 0;  ///< of the move to the next point, an arc at one depth: see Ring
};

enum class ToolPathKind : std::uint8_t {
  clearing,  ///< a flat bottom, inside of its wall
  wall,      ///< along the foot of the walls around a flat bottom
  groove,    ///< along the axis
  ramp,      ///< down to where the next path begins
};

/// Moves without lifting the tool.
struct ToolPath {
  ToolPathKind kind = ToolPathKind::groove;
  std::vector<ToolPoint> points;
  std::uint32_t pass = 0;  ///< from the surface down
};

struct Carving {
  std::vector<ToolPath> paths;  ///< in the order of cutting
  double deepest = 0;           ///< depth, positive
  double flat_from = 0;         ///< the bottom is flat from this clearance on; infinite: nowhere
  double tip_radius = 0, slope = 0;  ///< of the tool; the slope: tangent of half of the angle
  double step = 0;                   ///< between clearing passes
  std::uint32_t passes = 0;          ///< in depth
  // Lengths in the plane.
  double own_length = 0, cut_length = 0;  ///< of all passes, without ramps and ways between; with
  double travel_length = 0;               ///< of lifted moves from path to path
  double travel_unordered = 0;  ///< the same if branches and rings came as the axis numbers them
  Tabs tabs;                    ///< as in the options
};

/// Plans the paths of one tool in one shape (docs/carve.md). With c(p) the clearance of a point, t
/// the radius of the tip and m = tan(angle / 2), no path goes deeper than min((c(p) - t) / m,
/// depth), but for rounding (a few 1e-15 of the size). Together they cut all that the tool can
/// reach, except for 3 chords / m along curved edges of the axis, and for ridges of step / m on
/// flat bottoms where the tip is a point or `step` exceeds its radius. O(n log n + size of the
/// result). Errors: invalid_option, unsupported (an axis that is sampled or of the exterior),
/// too_large (more than 1e6 clearing passes, or 1e4 in depth).
Result<Carving> carve(const MedialAxis& axis, const CarveOptions& options);

/// Tabs for the parts that come loose when a shape is cut through: its holes. A tab stands where a
/// maximal disk touches the part and another loop; evenly around the part, but the nearer the sides
/// the better, and not at corners. Further tabs tie parts to the rest that are tied to each other
/// only. Of the exact axis of the shape. O(n log n). Errors: invalid_option, unsupported.
Result<std::vector<TabLine>> place_tabs(const Shape& shape, const MedialAxis& axis,
                                        const TabOptions& options);

/// The options of an end mill that clears the flat bottoms of a V-shaped tool before it, so that no
/// wall is touched. The V needs a depth, its own or its tool's.
CarveOptions clearing_before(const CarveOptions& v, double diameter, double pass_depth);

/// Options and carvings in other units: every length times `factor` > 0.
CarveOptions scaled(CarveOptions options, double factor);
Carving scaled(Carving carving, double factor);

/// A carving whose point `zero` becomes the origin, and with y turned round where `mirrored`.
Carving placed(Carving carving, Vec2 zero, bool mirrored);

/// The points of a path with its arcs as chords, at most `chord` > 0 away and never nearer to the
/// boundary: inside of arcs that turn left, outside of those that turn right.
std::vector<ToolPoint> without_arcs(const ToolPath& path, double chord);

}  // namespace medial
