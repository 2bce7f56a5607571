#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/feature_reader.h"

namespace medial::io {

/// Opens a file of GeoJSON that is a plain collection of polygons, as far as its beginning says,
/// and what it reads: see Unusual. Null: GDAL has to read it.
std::unique_ptr<FeatureReader> open_geojson(const std::string& path);
/// Reads it in one pass; nothing: GDAL has to.
std::optional<Document<Feature>> read_geojson(const std::string& path);

/// In which a collection names its unit, if at all.
inline constexpr std::size_t beginning_size = 512;
/// The unit that a collection names instead of a reference system, before its features: as medial
/// writes plane coordinates. Nothing where it names none.
std::optional<Unit> plane_unit_of(std::string_view beginning);

}  // namespace medial::io
