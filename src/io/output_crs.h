#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/back_to_geographic.h"
#include "medial/axis.h"
#include "medial/io/read.h"

class OGRSpatialReference;

namespace medial::io {

/// The reference system of an output: that of the document, or its longitudes and latitudes again
/// where that is a local projection of project_to_local().
class OutputCrs {
 public:
  /// None: points stay.
  OutputCrs();
  /// Errors: unsupported (a local projection that cannot be undone).
  static Result<OutputCrs> make(const std::string& crs_wkt, Unit unit);
  ~OutputCrs();
  OutputCrs(OutputCrs&&) noexcept;
  OutputCrs& operator=(OutputCrs&&) noexcept;

  /// For GDAL; null where there is none.
  OGRSpatialReference* reference() const { return reference_.get(); }
  /// Whether points have to be transformed.
  bool changes_points() const { return back_.has_value(); }
  /// Points of the document become points of the output. Errors: unsupported.
  Status transform(std::vector<Vec2>& points) const;
  /// The same for the centres of disks; radii stay.
  Status transform(std::vector<Disk>& disks) const;

 private:
  std::unique_ptr<OGRSpatialReference> reference_;
  std::optional<BackToGeographic> back_;
};

}  // namespace medial::io
