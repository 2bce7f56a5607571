#pragma once

#include <memory>
#include <string>
#include <vector>

#include "medial/document.h"

class OGRCoordinateTransformation;

namespace medial::io {

/// Whether a reference system is one that project_to_local() made.
bool is_local_projection(const std::string& crs_wkt);

/// Takes points of a local projection back to the coordinates that were projected.
class BackToInput {
 public:
  /// Errors: unsupported (crs_wkt is no local projection).
  static Result<BackToInput> make(const std::string& crs_wkt);

  /// In place, within 2 mm. Lengths and radii have no counterpart: they stay in metres.
  Status transform(std::vector<Vec2>& points) const;
  /// The reference system of the input, as WKT.
  const std::string& crs_wkt() const { return crs_wkt_; }
  /// Whether the input had longitudes, and none beyond 180.
  bool within_half_turn() const { return within_half_turn_; }

 private:
  BackToInput() = default;
  std::shared_ptr<OGRCoordinateTransformation> to_geographic_;
  /// From there to the projected coordinates of the input; null if it had longitudes.
  std::shared_ptr<OGRCoordinateTransformation> to_projected_;
  double middle_ = 0;  ///< of the projection, as a longitude
  std::string crs_wkt_;
  bool within_half_turn_ = false;
};

}  // namespace medial::io
