#pragma once

// Ways along an axis of any method: main paths, routes, centre lines, what is wide and what is
// narrow. The reach of a path is its length and the radii at its two ends.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial {

/// A point of the axis: the parameter t in [0, 1] on an edge.
struct EdgePlace {
  std::uint32_t edge = 0;
  double t = 0;
};

/// A part of an edge, from its parameter `from` to `to`: against the edge where from > to.
struct PathPiece {
  std::uint32_t edge = 0;
  double from = 0;
  double to = 1;
};

/// A way along the axis; each piece begins where the one before it ends.
struct AxisPath {
  std::vector<PathPiece> pieces;
  bool closed = false;   ///< the last piece ends where the first one begins
  double length = 0;     ///< in the plane
  double narrowest = 0;  ///< the smallest radius along it
  double gap = 0;        ///< of a main path around holes: how much longer the largest reach may be
};

/// The place of the smallest radius on an edge, and of the largest; the middle where the radius
/// does not change. Closed forms.
EdgePlace narrowest_place(const MedialAxis& axis, std::uint32_t edge);
EdgePlace widest_place(const MedialAxis& axis, std::uint32_t edge);

/// The part of the axis that the pieces cover, exactly: an axis of the same sites, its edges in the
/// order and direction of the pieces; pieces that end at the same place share a node. O(pieces).
MedialAxis part_of(const MedialAxis& axis, std::span<const PathPiece> pieces);

/// All points of the axis whose radius is at least `clearance`, where a disk of that radius can go.
/// Edges are cut exactly; a node alone stays a node. O(edges).
MedialAxis clearance_part(const MedialAxis& axis, double clearance);

/// Where a point of the shape falls when the shape shrinks to its axis: the centre of the maximal
/// disk that touches the boundary where it is nearest to the point. Of an axis that names no sites,
/// its nearest point. Nothing where there is no edge. O(sites + edges).
std::optional<EdgePlace> place_on_axis(const MedialAxis& axis, Vec2 p);

/// How one way among several is chosen: around holes.
enum class Route : std::uint8_t {
  shortest,  ///< the least length
  /// The least integral of ds / r, the quasihyperbolic length of Gehring and Palka (1976): a
  /// passage twice as wide may be twice as long.
  roomy,
};

/// The best way between two places; and the widest, along which the largest disk can move, of
/// several the shortest. O(edges log edges). Errors: invalid_option (a place that is not on the
/// axis, or no way between them).
Result<AxisPath> path_between(const MedialAxis& axis, EdgePlace from, EdgePlace to,
                              Route route = Route::shortest);
Result<AxisPath> widest_path(const MedialAxis& axis, EdgePlace from, EdgePlace to);

struct MainPathOptions {
  /// A path does not run into a corner: its end is cut back to a branching node from whose disk the
  /// rest protrudes by less than `trim` radii, of several in a row to the one where most is left of
  /// these. A corner of the angle a protrudes by 1 / sin(a / 2) - 1 radii: 1 cuts corners of more
  /// than 60 degrees, 0 cuts nothing.
  double trim = 1;
  Route route = Route::roomy;
};

/// The main path of every connected part of the axis that has an edge, by increasing lowest node:
/// between the two ends that are farthest apart (by the largest reach of a shortest way between
/// them), along the given route, trimmed unless trimming would use it up. A part with one cycle and
/// nothing that protrudes from it gives the cycle.
///
/// Without holes O(n). With holes one search of O(n log n) for each end that cannot be ruled out,
/// at most 100; `gap` is what remains unproven.
std::vector<AxisPath> main_paths(const MedialAxis& axis, const MainPathOptions& options = {});

struct CentreLineOptions {
  /// Go on to the boundary at both ends: straight ahead, or where it is far in this direction to
  /// its nearest place that lies ahead.
  bool extend = false;
  /// Average over this many radii, with Gaussian weights; 0: not at all. The line stays inside the
  /// shape, and its ends where they are.
  double smooth = 0;
};

/// A path as a line: an axis that is one chain of edges. They are exact; an extension is straight,
/// with the site where it ends on both sides. A smoothed line is sampled: straight edges without
/// sites, between nodes with their distance to the boundary as radius. O(path + sites), smoothed
/// O(samples log n).
MedialAxis centre_line(const Shape& shape, const MedialAxis& axis, const AxisPath& path,
                       const CentreLineOptions& options = {});

/// A shape with its narrow parts collapsed.
struct CollapsedShape {
  /// The union of the maximal disks that stay. Ends towards a line are arcs of half the width.
  Shape polygons;
  MedialAxis lines;  ///< the axis of the narrow parts, from polygon to polygon; without corners
};

/// Parts of the shape narrower than `width` become lines. Polygons keep the opening of the shape by
/// a disk of that width, narrower corners that protrude from it by at most width / 2 (times `trim`)
/// and necks between two such disks that overlap. A cusp between arcs may be rounded by a disk of
/// 2^-20 (at worst 2^-10) of the width. O(n log n). Errors: invalid_option (a width that is not
/// positive), those of build_shape().
Result<CollapsedShape> collapse_narrow(const MedialAxis& axis, double width, double trim = 1);

}  // namespace medial
