#pragma once

// Carving with a V-shaped tool. Its tip follows the axis where the cone is as wide as the disk, so
// inner corners come out sharp. Wider parts get a flat bottom, cleared along offsets.

#include "medial/axis.h"
#include "medial/shape.h"

namespace medial {

/// The middle of a tab: from one side, over the centre of a maximal disk, to the other.
using TabLine = std::array<Vec2, 3>;

/// Bars of material left across a cut, so that no part comes loose.
struct Tabs {
  std::vector<TabLine> lines = {};
  double width = 0;  ///< positive if there are lines
  double top = 0;    ///< the depth of their upper side below the surface
};

/// The number of tabs for each part that would come loose.
struct TabOptions {
  std::uint32_t count = 0;
  double spacing = 0;  ///< along the part's boundary; used if the count is 0
};

/// Lengths in units of the input.
struct CarveOptions {
  double angle = 90;  ///< between the sides of the cone, in degrees, in [0, 170]; 0: an end mill
  double depth = 0;   ///< largest; 0: as deep as the tool reaches; required for an end mill
  double tool = 0;    ///< largest diameter, which limits the depth of a cone; 0: no limit
  double tip = 0;     ///< diameter of the cone's flat tip, below `tool`; an end mill's is `tool`
  double pass_depth = 0;  ///< largest depth of one pass, from the surface down; 0: one pass
  double ramp = 90;       ///< steepest angle of ramps, degrees in (0, 90]; 90: straight down
  /// Distance between passes that clear a flat bottom; 0: half of the tip's diameter, which leaves
  /// nothing, or for a pointed tip 1/20 of the cone's radius at that depth, which leaves ridges.
  double step = 0;
  /// Largest height of straight moves above the axis; at least 1e-8 diagonals; 0: 1e-5 of them.
  double chord = 0;
  double allowance = 0;  ///< material that an end mill leaves at the boundary
  double cleared = 0;    ///< diameter of a mill that cuts flat bottoms before: clearing_before()
  Tabs tabs = {};        ///< bars to leave: see place_tabs()
};

struct ToolPoint {
  Vec2 point;
  double z = 0;      ///< 0 on the surface, negative below; chords may begin a little above it
  double bulge = 0;  ///< of the move to the next point, an arc at one depth: see Ring
};

enum class ToolPathKind : std::uint8_t {
  clearing,  ///< a flat bottom, inside its wall
  wall,      ///< along the foot of the walls around a flat bottom
  groove,    ///< along the axis
  ramp,      ///< down to the start of the next path
  plunge,    ///< straight down: where the tool fits one place only, or would ramp over 1e4 times
};

/// Moves without lifting the tool.
struct ToolPath {
  ToolPathKind kind = ToolPathKind::groove;
  std::vector<ToolPoint> points;
  std::uint32_t pass = 0;  ///< from the surface down
};

struct Carving {
  std::vector<ToolPath> paths;       ///< in the order of cutting
  double deepest = 0;                ///< depth, positive
  double flat_from = 0;              ///< the bottom is flat at larger clearances; infinite: nowhere
  double tip_radius = 0, slope = 0;  ///< of the tool; the slope: tangent of half of the angle
  double step = 0;                   ///< between clearing passes
  std::uint32_t passes = 0;          ///< in depth
  // Lengths in the plane.
  double own_length = 0, cut_length = 0;  ///< of all passes, without and with ramps and links
  double travel_length = 0;               ///< of lifted moves from path to path
  double travel_unordered = 0;            ///< the same in the order of the axis, to compare
  Tabs tabs;                              ///< as in the options
};

/// Plans the paths of one tool in one shape (docs/carve.md). Let c(p) be the clearance of a point,
/// t the radius of the tip and m = tan(angle / 2). No path goes deeper than min((c(p) - t) / m,
/// depth), up to rounding (a few 1e-15 of the size). Together they cut all that the tool can
/// reach, except 3 chords / m along curved edges of the axis, and ridges of step / m on flat
/// bottoms if the tip is a point or `step` exceeds its radius. O(n log n + size of the result).
/// Errors: invalid_option, unsupported (a sampled axis, or an axis of the exterior), too_large
/// (more than 1e6 clearing passes, or 1e4 in depth).
Result<Carving> carve(const MedialAxis& axis, const CarveOptions& options);

/// Places tabs for the parts that come loose when a shape is cut through: its holes. A tab stands
/// where a maximal disk touches the part and another loop: evenly around the part, preferably where
/// the gap is narrow, not at corners. Groups of parts that only hold each other get further tabs.
/// Requires the shape's exact axis. O(n log n). Errors: invalid_option, unsupported.
Result<std::vector<TabLine>> place_tabs(const Shape& shape, const MedialAxis& axis,
                                        const TabOptions& options);

/// The options of an end mill that clears flat bottoms before the V-shaped tool `v`, and touches no
/// wall. `v` needs a depth, or a tool diameter that limits it.
CarveOptions clearing_before(const CarveOptions& v, double diameter, double pass_depth);

/// Converts units: multiplies every length by `factor` > 0.
CarveOptions scaled(CarveOptions options, double factor);
Carving scaled(Carving carving, double factor);

/// The carving with `zero` moved to the origin, and y negated if `mirrored`.
Carving placed(Carving carving, Vec2 zero, bool mirrored);

/// The points of a path with chords for arcs, within `chord` > 0 of them and never nearer to the
/// boundary: inside arcs that turn left, outside arcs that turn right.
std::vector<ToolPoint> without_arcs(const ToolPath& path, double chord);

}  // namespace medial
