#pragma once

// Axes of many features, written as they are computed: in constant memory, on all threads.

#include <optional>

#include "medial/io/write.h"

namespace medial::io {

struct StreamOptions {
  SourceOptions source;
  WriteOptions write;
  int threads = 0;  ///< see Options
  /// The axes of some shapes of the file; called for several parts of it at once.
  std::function<Result<Document<AxisItem>>(Document<ShapeItem> shapes, int threads,
                                           AxesReport& report)>
      compute;
  /// Sees the parts in order, before they are written; may be empty.
  std::function<void(const Document<AxisItem>& part)> visit;
  /// Gets the share that is done, in [0, 1], and the number of features; may be empty.
  std::function<void(double share, std::uint64_t features)> progress;
  std::uint64_t least_bytes = std::uint64_t{1} << 20;  ///< of a file; smaller ones are read whole
};

struct StreamReport {
  LoadReport load;
  AxesReport axes;
  Document<AxisItem> document;  ///< without items: what held for all, and the notes
};

/// What load_shapes(), options.compute and write_axes() make of a file, with the same bytes, part
/// by part; the file is read twice. Without a target's name nothing is written. Returns nothing
/// where the input is no file of .wkt or GDAL's vector formats, the output no table, .wkt, .csv or
/// .json, or an option needs all features (repair, project, units, contours). A .fgb has no spatial
/// index. Errors: those of the three, of the first part with one.
Result<std::optional<StreamReport>> stream_axes(const std::string& path, const Destination& target,
                                                const std::string& format,
                                                const StreamOptions& options);

}  // namespace medial::io
