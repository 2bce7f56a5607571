#pragma once

// What all writers through GDAL share: the reference system, the dataset, the way to a file.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/output.h"
#include "medial/axis.h"
#include "medial/io/projection.h"

class GDALDataset;
class OGRLineString;
class OGRSimpleCurve;
class OGRSpatialReference;

namespace medial::io {

class GdalMessages;

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

/// Whether a format is written through GDAL: geojson, gpkg, shp, fgb.
bool through_gdal(const std::string& format);

/// An unwritable file, in GDAL's words.
Error cannot_write(const GdalMessages& messages);

/// Makes a dataset that `fill` puts layers into, in one transaction where the format has such.
/// Errors: unsupported, unwritable, and those of `fill`.
Status write_dataset(
    const std::string& path, const std::string& format,
    const std::function<Status(GDALDataset& target, const GdalMessages& messages)>& fill);

/// Points of a line or ring.
void set_points(OGRSimpleCurve& curve, const std::vector<Vec2>& points);

/// Writes a file all at once, or to a stream: where GDAL writes the format by `make`, which makes
/// the file of a path, and else by `put`, which puts its bytes. `name` is what GDAL calls a layer
/// that has no file to be named after. Exceptions become errors, and errors name the file.
Status write_file(const std::string& path, const std::string& format, const std::string& name,
                  const std::function<Status(const std::string& path)>& make,
                  const std::function<Status(OutputStream& out)>& put);

}  // namespace medial::io
