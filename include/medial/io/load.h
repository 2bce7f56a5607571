#pragma once

#include <string>

#include "medial/document.h"
#include "medial/error.h"
#include "medial/io/read.h"
#include "medial/load.h"

namespace medial::io {

/// How a file becomes shapes or planar graphs.
struct SourceOptions {
  ReadOptions read;  ///< its `repair` goes for features with curves as well
  std::string text;  ///< not empty: the outlines of this text in the font `path`, see read_text()
  LoadOptions load;  ///< but for `repair`
};

/// What a file holds: shapes of any format by read_dataset(), those of medial's own .json with
/// their sources and without their axes, or a text. Errors: theirs, with the file; invalid_option
/// (an option of `read` that is not for such a source).
Result<Document<Feature>> read_features(const std::string& path, const SourceOptions& options = {});

/// The shapes of a file, one for each feature: read_features() and medial::load_shapes(). Errors:
/// theirs, with the file.
Result<Document<ShapeItem>> load_shapes(const std::string& path, const SourceOptions& options = {},
                                        LoadReport* report = nullptr);

/// What a file holds as loose pieces, for planar_graph_of(): medial::load_loose(). Nothing is
/// repaired. Errors as load_shapes().
Result<LoosePieces> load_loose(const std::string& path, const SourceOptions& options = {});

}  // namespace medial::io
