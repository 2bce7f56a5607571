#pragma once

#include <optional>
#include <string>

#include "io/text_source.h"
#include "medial/io/read.h"

namespace medial::io {

/// Reads the closed curves of a drawing in DXF: a feature for each layer that has any, with the
/// layer's name as attribute, holes told by the even-odd rule. Loose curves are joined
/// (io/join.h); what stays open is left out and told. Hidden and frozen layers and the paper space
/// are left out, unless `layer` names the layer.
/// Errors: unreadable, malformed, not_finite, unsupported, too_large (blocks that unfold to more
/// than they may), empty, invalid_option (no such layer).
Result<Document<Feature>> read_dxf(TextSource& source, const std::string& layer,
                                   std::optional<double> close, bool loose = false);

}  // namespace medial::io
