#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/document.h"
#include "medial/error.h"

namespace medial::io {

/// The reference system of an output, see output_crs_of().
struct OutputCrs {
  std::string wkt;            ///< empty: none, but lengths may have a unit
  Unit unit = Unit::unknown;  ///< of a plane without a reference system
  /// Points of the document become points of the output; null: they stay. Errors: unsupported.
  std::function<Status(std::vector<Vec2>&)> change;
  bool within_half_turn = false;  ///< longitudes should not be beyond 180: see turn_back()

  bool changes_points() const { return change != nullptr; }
  Status transform(std::vector<Vec2>& points) const { return change ? change(points) : success(); }
  /// Changes the centres of disks; radii stay.
  Status transform(std::vector<Disk>& disks) const;
};

/// Turns a point, a line or the rings of a polygon, the outer one first, by 360 degrees where all
/// of it lies beyond a longitude of 180. What crosses that meridian stays in one piece.
void turn_back(std::span<std::vector<Vec2>> parts);

}  // namespace medial::io
