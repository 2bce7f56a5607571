#pragma once

#include <memory>
#include <string>
#include <vector>

#include "medial/document.h"

class OGRCoordinateTransformation;

namespace medial::io {

/// Whether a reference system is one that project_to_local() made.
bool is_local_projection(const std::string& crs_wkt);

/// Takes points of a local projection back to longitude and latitude.
class BackToGeographic {
 public:
  /// Errors: unsupported (crs_wkt is no local projection).
  static Result<BackToGeographic> make(const std::string& crs_wkt);

  /// In place, within 2 mm. Lengths and radii have no counterpart: they stay in metres.
  Status transform(std::vector<Vec2>& points) const;
  /// The geographic reference system, as WKT.
  const std::string& crs_wkt() const { return crs_wkt_; }
  /// Whether no longitude of the input was beyond 180.
  bool within_half_turn() const { return within_half_turn_; }

 private:
  BackToGeographic() = default;
  std::shared_ptr<OGRCoordinateTransformation> transformation_;
  double middle_ = 0;  ///< of the projection, as a longitude
  std::string crs_wkt_;
  bool within_half_turn_ = false;
};

}  // namespace medial::io
