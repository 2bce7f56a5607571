#pragma once

// How wide a shape is, by its axis: profiles, transects, necks, means, largest disks.

#include "medial/centreline.h"

namespace medial {

struct LocalWidth {
  double along = 0;  ///< the length of the path up to here
  Disk disk;
  std::array<Vec2, 2> feet;  ///< where the disk touches the boundary on the left and on the right
  double width() const { return 2 * disk.radius; }
  /// The length of the transect; shorter than the width where the shape tapers.
  double span() const { return distance(feet[0], feet[1]); }
};

/// The widths along a path at the given lengths, which increase from 0 to path.length. The feet lie
/// on the edges' sites; without sites, the change of the radius gives them. O(path).
std::vector<LocalWidth> widths_along(const MedialAxis& axis, const AxisPath& path,
                                     std::span<const double> lengths);

/// The same with the ends of transects across the path's course over a disk's diameter in place of
/// feet, which swing to and fro where single vertices stick in. O(path + lengths * boundary).
std::vector<LocalWidth> transects_along(const Shape& shape, const MedialAxis& axis,
                                        const AxisPath& path, std::span<const double> lengths);

/// The maximum inscribed circle; of equal ones, that of the lowest edge. Requires a node. O(edges).
Disk deepest_disk(const MedialAxis& axis);

/// A place where a shape is narrower than on both sides of it.
struct Neck {
  EdgePlace place;
  LocalWidth width;
  double opens_to = 0;       ///< the largest radius that both sides reach through wider parts only
  bool around_hole = false;  ///< both sides lead to the same disk: cutting here separates nothing
  /// By how much the width grows on both sides.
  double prominence() const { return 2 * (opens_to - width.disk.radius); }
};

/// The saddles of the radius, or middles of parallel walls, that open to at least `widening` > 1
/// times their width: by prominence those that separate, then around holes. O(edges log edges).
std::vector<Neck> necks(const MedialAxis& axis, double widening = 1.1);

struct MeanWidth {
  double length = 0;          ///< of the line
  double area = 0;            ///< of the shape, by its axis
  double by_length = 0;       ///< the mean of 2 r along the line
  double by_area = 0;         ///< of 2 r over the area, r that of the place_on_axis() of each point
  double area_by_length = 0;  ///< area / length
};

/// The means along a path and over the shape, of an exact axis. Relative error below 1e-10.
MeanWidth mean_width(const MedialAxis& axis, const AxisPath& path);

/// At most `count` disks without overlap, by decreasing radius, none smaller than `least`: each
/// is the deepest disk of the shape less the disks before it, to the rounding of the coordinates.
/// By branch and bound over squares, without an axis: O(n), then O(log n + k) for each square
/// examined and k disks before; real outlines need tens to hundreds of squares for each disk.
std::vector<Disk> largest_disjoint_disks(const Shape& shape, std::size_t count, double least = 0);

}  // namespace medial
