#pragma once

#include <memory>
#include <string>

#include "medial/compute.h"
#include "medial/document.h"

namespace medial::io {

/// Writes axes while they grow, one shape after another.
class AxisWriter {
 public:
  AxisWriter() = default;
  AxisWriter(const AxisWriter&) = delete;
  AxisWriter& operator=(const AxisWriter&) = delete;
  virtual ~AxisWriter() = default;

  /// The axis of the next shape of the document begins, which gets one part at least.
  virtual Status begin() = 0;
  virtual Status add(AxisPart&& part) = 0;
  virtual Status end(const Statistics& statistics) = 0;
  /// All axes are there.
  virtual Status finish() = 0;
};

/// What a writer of whole graphs knows from the beginning. The sites are those of Problem.
struct GrowingFrame {
  const Document<ShapeItem>& shapes;
  const Options& options;
  std::string folder;  ///< for what waits to be written
};

/// Makes a part's indices those of the whole axis, and leaves out the nodes of earlier parts.
void take_whole_numbers(AxisPart& part);

}  // namespace medial::io
