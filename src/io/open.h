#pragma once

#include "io/format.h"

namespace medial::io {

/// Opens a file to be read feature by feature; null: its format is read as a whole. Where its
/// reader finds it Unusual, it is to be opened once more so. Errors: those of read_document().
Result<std::unique_ptr<FeatureReader>> open_features(const std::string& path,
                                                     const ReadOptions& options,
                                                     bool unusual = false);

/// The reference system that is asked for, or the one of the file if coordinates of this reach can
/// be its longitudes and latitudes.
Status settle_crs(Document<Feature>& document, const std::string& crs, Vec2 reach);

}  // namespace medial::io
