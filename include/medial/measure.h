#pragma once

// Widths of a shape from its axis: profiles, transects, necks, means, largest disks.

#include "medial/centreline.h"

namespace medial {

struct LocalWidth {
  double along = 0;  ///< length along the path
  Disk disk;
  std::array<Vec2, 2> feet;  ///< where the disk touches the boundary on the left and on the right
  double width() const { return 2 * disk.radius; }
  /// The length of the transect; shorter than the width where the shape tapers.
  double span() const { return distance(feet[0], feet[1]); }
};

/// The widths along a path at the given lengths, increasing in [0, path.length]. The foot points
/// lie on the edges' sites; without sites, they follow from the change of the radius. O(path).
std::vector<LocalWidth> widths_along(const MedialAxis& axis, const AxisPath& path,
                                     std::span<const double> lengths);

/// The same with ends of transects for foot points, which jump where single vertices protrude:
/// across the mean direction of the path over a disk's diameter. O(path + lengths * boundary).
std::vector<LocalWidth> transects_along(const Shape& shape, const MedialAxis& axis,
                                        const AxisPath& path, std::span<const double> lengths);

/// The maximum inscribed circle; of equal ones, that of the lowest edge. Needs a node. O(edges).
Disk deepest_disk(const MedialAxis& axis);

/// A place where a shape is narrower than on both sides.
struct Neck {
  EdgePlace place;
  LocalWidth width;
  double opens_to = 0;       ///< the largest radius that both sides reach through wider parts
  bool around_hole = false;  ///< both sides lead to the same disk: a cut separates nothing
  /// The growth of the width on both sides.
  double prominence() const { return 2 * (opens_to - width.disk.radius); }
};

/// Saddles of the radius, and middles of parallel walls, that open to at least `widening` > 1 times
/// their width: first those that separate, by prominence, then others. O(edges log edges).
std::vector<Neck> necks(const MedialAxis& axis, double widening = 1.1);

struct MeanWidth {
  double length = 0;          ///< of the line
  double area = 0;            ///< of the shape, by its axis
  double by_length = 0;       ///< the mean of 2 r along the line
  double by_area = 0;         ///< the mean of 2 r over the area, r at each point's place_on_axis()
  double area_by_length = 0;  ///< area / length
};

/// The means along a path and over the shape, for an exact axis. Relative error below 1e-10.
MeanWidth mean_width(const MedialAxis& axis, const AxisPath& path);

/// At most `count` disjoint disks of radius at least `least`, largest first (ties in any order):
/// each is the largest in the shape minus the disks before it, up to rounding of the coordinates.
/// Branch and bound over squares: O(n), then O(log n + k) per square examined after k disks, tens
/// to hundreds per disk of real outlines. After 16 squares a vertex, the axis finds the first disk.
std::vector<Disk> largest_disjoint_disks(const Shape& shape, std::size_t count, double least = 0);

}  // namespace medial
