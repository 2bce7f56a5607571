#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "medial/error.h"
#include "medial/features.h"
#include "medial/io/write.h"

namespace medial::io {

/// What a format of one table holds; .json and .gpkg hold all three.
enum class FeatureTable : std::uint8_t {
  runs,      ///< a line for each primitive
  branches,  ///< a line for each medial branch
  points,    ///< the end and branching points
};

struct FeatureWriteOptions {
  FeatureTable table = FeatureTable::runs;
  WriteOptions write;  ///< chords, and how pictures are
  bool names = true;   ///< pictures: write the names beside the longest runs
};

/// Writes features, one of `features` for each item of `axes`, by the extension of `path` as
/// write_axes() does: .json (all of AxisFeatures), .gpkg (layers runs, branches, points), .geojson
/// .shp .fgb .csv (one table, see docs/features.md for its columns), .svg .pdf .png .ps (the shapes
/// with their runs coloured by primitive, and their names). Tables through GDAL and .json have the
/// attributes of the items, too. Errors: unsupported, unwritable,
/// invalid_option.
Status write_features(const std::string& path, const std::string& format,
                      const Document<AxisItem>& axes, std::span<const AxisFeatures> features,
                      const FeatureWriteOptions& options = {});

/// The extensions write_features() takes, for help texts.
std::string known_feature_formats();

}  // namespace medial::io
