#pragma once

#include <string_view>

#include "io/output.h"
#include "io/text_source.h"
#include "medial/io/read.h"

namespace medial::io {

/// The highest version of the native format that is read (docs/format.md). A file is written in the
/// lowest version that can tell it: 1, or 2 where there are arcs.
inline constexpr int native_version = 2;

/// Whether a text begins like medial's own JSON: an object whose first member is "medial".
bool begins_like_native(std::string_view text);
/// The same of a Voronoi diagram: the first member is "medial_voronoi".
bool begins_like_voronoi(std::string_view text);

/// Reads and checks: every index is in its range, every number finite.
/// Errors: unreadable, malformed, unsupported (a newer version), too_large (4 GiB or more).
Result<Document<AxisItem>> read_native(TextSource& source);

/// Reads and checks Voronoi diagrams. Errors as read_native().
Result<Document<VoronoiItem>> read_voronoi(TextSource& source);

/// Writes without loss. Errors: internal (a number is not finite; the stream may hold a part then).
Status write_native(OutputStream& out, const Document<AxisItem>& file);

/// The control point of a straight edge whose radius runs evenly: files leave it out.
Disk middle_of(const Disk& a, const Disk& b);

/// The shapes of a native file as a dataset: their loops are the rings.
Document<Feature> dataset_of(Document<AxisItem> file);

}  // namespace medial::io
