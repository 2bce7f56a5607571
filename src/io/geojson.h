#pragma once

// GeoJSON (RFC 7946), written number by number: through GDAL's feature objects it takes four times
// as long.

#include <string>
#include <string_view>

#include "io/output.h"
#include "medial/vec2.h"

class OGRSpatialReference;

namespace medial::io {

class OutputCrs;
struct TableSource;

/// A collection of features, one by one: start(), member()s, geometry(), coordinates, end().
class GeojsonCollection {
 public:
  /// `name` is left out where it is empty. A reference system with a code is named as GDAL does.
  GeojsonCollection(OutputStream& out, const std::string& name,
                    const OGRSpatialReference* reference);

  void start();
  /// The key of a property, as a JSON string; its value is put next.
  void member(std::string_view quoted_key);
  /// Properties end; the geometry's coordinates are put next.
  void geometry(std::string_view type);
  void end();
  /// Behind the last feature.
  void finish();

 private:
  OutputStream& out_;
  bool first_feature_ = true;
  bool first_member_ = true;
};

/// A text as a JSON string.
void put_quoted(OutputStream& out, const std::string& text);

/// A number that readers take for a real one, also where it is whole.
void put_real(OutputStream& out, double value);

/// All tables as one collection. Errors: those of the source's `fill`.
Status put_geojson(OutputStream& out, const std::string& name, const OutputCrs& crs,
                   const TableSource& source);

}  // namespace medial::io
