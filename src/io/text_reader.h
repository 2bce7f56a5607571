#pragma once

#include "io/text_source.h"
#include "medial/io/read.h"

namespace medial::io {

/// Reads well-known text: one feature for every POLYGON, MULTIPOLYGON or GEOMETRYCOLLECTION that
/// stands at the top, in any case of letters, with or without `SRID=n;` before it. Ordinates beyond
/// x and y are dropped; other geometries are counted in a note. Takes constant memory besides the
/// result, whatever the nesting. Errors: malformed, not_finite, unsupported, unreadable.
Result<Document<Feature>> read_wkt(TextSource& source, bool loose = false);

/// Reads plain text: two numbers a line, apart by blanks, a comma or a semicolon. A blank line, or
/// a line that begins with `#`, ends a ring. A first line of two names ("x,y") is passed over. All
/// rings are one feature, by the even-odd rule. Errors: malformed, not_finite, unreadable.
Result<Document<Feature>> read_xy(TextSource& source, bool loose = false);

/// Whether a text begins like well-known text: with the name of a geometry, or with `SRID=`.
bool begins_like_wkt(std::string_view text);

/// Whether a text begins like plain coordinates: with a number, a comment, or two names above
/// numbers.
bool begins_like_xy(std::string_view text);

/// Whether the first line of a table holds two names or two numbers, and no more.
bool has_two_columns(std::string_view text);

}  // namespace medial::io
