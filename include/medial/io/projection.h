#pragma once

#include <memory>
#include <string>
#include <vector>

#include "medial/error.h"
#include "medial/io/read.h"

namespace medial::io {

/// Replaces longitudes and latitudes by metres in one local projection fitted to all features: the
/// transverse Mercator projection on their middle meridian (conformal: disks stay disks) where they
/// lie within 300 km of their middle, the azimuthal equal-area projection elsewhere. A dataset
/// without a reference system counts as WGS 84 if its coordinates can be degrees; one that is
/// projected already only gets a note. Errors: invalid_option (coordinates that are no degrees),
/// unsupported (points that cannot be projected).
Status project_to_local(Document<Feature>& dataset);

/// Whether a reference system is one that project_to_local() made.
bool is_local_projection(const std::string& crs_wkt);

/// Takes points of a local projection back to longitude and latitude.
class BackToGeographic {
 public:
  /// Errors: unsupported (crs_wkt is not one that project_to_local() made).
  static Result<BackToGeographic> make(const std::string& crs_wkt);
  ~BackToGeographic();
  BackToGeographic(BackToGeographic&&) noexcept;
  BackToGeographic& operator=(BackToGeographic&&) noexcept;

  /// Transforms points in place, within 2 mm. Lengths and radii have no counterpart: they stay in
  /// metres.
  Status transform(std::vector<Vec2>& points) const;
  /// The geographic reference system, as WKT.
  const std::string& crs_wkt() const;

 private:
  struct Transformation;
  explicit BackToGeographic(std::unique_ptr<Transformation> transformation);
  std::unique_ptr<Transformation> transformation_;
};

}  // namespace medial::io
