#pragma once

#include "io/format.h"

namespace medial::io {

/// Reads plain text: two numbers a line, apart by blanks, a comma or a semicolon. A blank line, or
/// a line that begins with `#`, ends a ring. A first line of two names may put y first ("lat,lon").
/// All rings are one feature, by the even-odd rule. Errors: malformed, not_finite, unreadable.
Result<Document<Feature>> read_xy(TextSource& source, bool loose);

/// Whether a text begins like plain coordinates: with a number, a comment, or two names above
/// numbers.
bool begins_like_xy(std::string_view text);

/// Whether the first line of a table holds two names or two numbers, and no more.
bool has_two_columns(std::string_view text);

}  // namespace medial::io
