#pragma once

#include "io/format.h"

namespace medial::io {

/// Reads the closed curves of a drawing in DXF: a feature for each layer that has any, with the
/// layer's name as attribute, holes by the even-odd rule. Loose curves are joined (io/join.h); what
/// stays open is left out with a note. Hidden and frozen layers and the paper space are left out,
/// unless options.layer names the layer.
/// Errors: unreadable, malformed, not_finite, unsupported, too_large (blocks that unfold to more
/// than they may), empty, invalid_option (no such layer).
Result<Document<Feature>> read_dxf(const Input& input, const ReadOptions& options);

}  // namespace medial::io
