#pragma once

// Paths along an axis. The reach of a path is its length plus the radii at its two ends.

#include "medial/query.h"

namespace medial {

/// A part of an edge between two parameters in [0, 1]; reversed if from > to.
struct PathPiece {
  std::uint32_t edge = 0;
  double from = 0, to = 1;
};

/// A path along the axis; each piece begins where the previous one ends.
struct AxisPath {
  std::vector<PathPiece> pieces;
  bool closed = false;   ///< the last piece ends where the first one begins
  double length = 0;     ///< in the plane
  double narrowest = 0;  ///< the smallest radius along it
  double gap = 0;        ///< of a main path: bound on how much longer the largest reach is
};

/// The pieces as an axis, exactly: with all sites, and edges in the order and direction of the
/// pieces. Pieces that end at the same place share a node. O(nodes + sites + pieces log(pieces)).
MedialAxis part_of(const MedialAxis& axis, std::span<const PathPiece> pieces);
/// The part of radius at least `clearance`, cut exactly; keeps single nodes. O(edges).
MedialAxis clearance_part(const MedialAxis& axis, double clearance);

/// The centre of the maximal disk that touches the boundary nearest to p, a point of the shape; if
/// the axis has no sites, its point nearest to p. Nothing if it has no edges. O(sites + edges).
std::optional<EdgePlace> place_on_axis(const MedialAxis& axis, Vec2 p);

/// Which path around holes is best.
enum class Route : std::uint8_t {
  shortest,  ///< the least length
  roomy,     ///< the least integral of ds / r, the quasihyperbolic length (Gehring, Palka 1976)
};

/// The best path between two places; and the widest one, along which the largest disk can move.
/// O(n log n). Errors: invalid_option (a place off the axis, or no path between them).
Result<AxisPath> path_between(const MedialAxis& axis, EdgePlace from, EdgePlace to,
                              Route route = Route::shortest);
Result<AxisPath> widest_path(const MedialAxis& axis, EdgePlace from, EdgePlace to);

struct MainPathOptions {
  /// Keeps ends out of corners: cuts an end back to a branching node from whose disk the rest
  /// protrudes by less than `trim` radii; of several in a row, to the one with the widest margin. A
  /// corner of angle a protrudes by 1 / sin(a / 2) - 1 radii: 1 cuts corners above 60 degrees.
  double trim = 1;
  Route route = Route::roomy;
};

/// The main path of each connected part with an edge, ordered by lowest node. It follows `route`
/// between the two ends of the axis whose shortest path has the largest reach, and is trimmed
/// unless nothing would remain. A part that is a cycle is its own main path. O(n); with holes, a
/// search of O(n log n) for each of at most 100 ends: see AxisPath::gap.
std::vector<AxisPath> main_paths(const MedialAxis& axis, const MainPathOptions& options = {});
/// The paths around holes that leave `path` and return to it, as whole edges. O(n).
std::vector<PathPiece> side_channels(const MedialAxis& axis, const AxisPath& path);

struct CentreLineOptions {
  bool extend = false;  ///< ends to the boundary: straight; if far, to the nearest place ahead
  double smooth = 0;    ///< Gaussian average over this many radii, inside, from end to end; 0: none
};

/// Paths as an axis: chains of exact edges, extended by straight ones. Smoothed lines are sampled:
/// straight edges without sites. O(n log n) once for all paths, smoothed O(samples log n) more.
MedialAxis centre_lines(const Shape& shape, const MedialAxis& axis, std::span<const AxisPath> paths,
                        const CentreLineOptions& options = {});
MedialAxis centre_line(const Shape& shape, const MedialAxis& axis, const AxisPath& path,
                       const CentreLineOptions& options = {});

struct CollapsedShape {
  Shape polygons;    ///< the union of the disks kept; lines begin at arcs of half the width
  MedialAxis lines;  ///< the axis of the narrow parts, between polygons; without corners
};

/// Collapses the parts narrower than `width`. Polygons keep the opening of the shape by a disk of
/// that width, corners that protrude from it by at most `trim` * width / 2, and necks between two
/// such disks that overlap. Cusps between arcs may be rounded by 2^-20 (at worst 2^-10) of the
/// width. `corner_angle`: see RebuildOptions. O(n log n). Errors: invalid_option, build_shape()'s.
Result<CollapsedShape> collapse_narrow(const MedialAxis& axis, double width, double trim = 1,
                                       double corner_angle = 0.01);

}  // namespace medial
