#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "io/text_source.h"
#include "medial/error.h"

namespace medial::io {

/// The part of a drawing that dxflib is given: layers, blocks, and the entities that medial reads.
struct DxfText {
  std::string text;
  int units = 0;                                ///< $INSUNITS
  std::map<std::string, std::uint64_t> others;  ///< entities that were left out, by name
};

/// Whether a text begins like a drawing in DXF: a section, after comments.
bool begins_like_dxf(std::string_view text);

/// Reads a drawing and checks what dxflib takes on trust: group codes are whole numbers,
/// coordinates are finite numbers, counts are not larger than the file, and the end is marked.
/// Errors: unreadable, malformed, not_finite (with the line), unsupported (binary), too_large.
Result<DxfText> read_dxf_text(TextSource& source);

}  // namespace medial::io
