#pragma once

// What is written through GDAL, and the reference system of all outputs.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "medial/axis.h"
#include "medial/io/projection.h"

class OGRSpatialReference;

namespace medial::io {

struct TableSource;

/// The reference system of an output: that of the input, or its longitudes and latitudes again
/// where that is a local projection of project_to_local().
class OutputCrs {
 public:
  /// Errors: unsupported (a local projection that cannot be undone).
  static Result<OutputCrs> make(const std::string& crs_wkt);
  ~OutputCrs();
  OutputCrs(OutputCrs&&) noexcept;

  /// For GDAL; null where there is none.
  OGRSpatialReference* reference() const { return reference_.get(); }
  /// Whether points have to be transformed.
  bool changes_points() const { return back_.has_value(); }
  /// Points of the computation become points of the output. Errors: unsupported.
  Status transform(std::vector<Vec2>& points) const;
  /// The same for the centres of disks; radii stay.
  Status transform(std::vector<Disk>& disks) const;

 private:
  OutputCrs();
  std::unique_ptr<OGRSpatialReference> reference_;
  std::optional<BackToGeographic> back_;
};

/// Makes a dataset with an empty layer for each table, in GDAL's words where it cannot; and puts
/// the tables into it, feature by feature. The one layer of a format that is no GeoPackage is named
/// after the file. Errors: unsupported, unwritable, and those of `fill`.
Status create_by_gdal(const std::string& path, const std::string& format, const OutputCrs& crs,
                      const TableSource& source);
Status write_by_gdal(const std::string& path, const std::string& format, const OutputCrs& crs,
                     const TableSource& source);

}  // namespace medial::io
