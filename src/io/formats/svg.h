#pragma once

#include "io/format.h"

namespace medial::io {

/// Reads what an SVG document fills: a feature for each filled path or basic shape that is shown,
/// with its `id` as attribute, in the pixels of the outermost viewport and with the y axis pointing
/// down, as in the document (docs/format.md).
/// Errors: unreadable, malformed, unsupported (nested too deeply), too_large (a document that
/// unfolds to more than it may), empty.
Result<Document<Feature>> read_svg(const Input& input, const ReadOptions& options);

}  // namespace medial::io
