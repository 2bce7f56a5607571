#pragma once

// The accuracy of axes made of pixels, as Volkmann and St. Clair (1987) measure it (Section II.B.3,
// Fig. 14): an axis is inverted, and the pixels that differ are counted.

#include <cstdint>
#include <string>
#include <vector>

#include "medial/error.h"
#include "medial/image.h"
#include "medial/io/image.h"

namespace medial::cli {

/// One way to an axis of one image.
struct AccuracyCell {
  std::string method;         ///< "brushfire simultaneous", "ridge", "disks"
  std::uint64_t pixels = 0;   ///< of the axis; of the exact one its nodes
  std::uint64_t missing = 0;  ///< foreground that no disk covers
  std::uint64_t extra = 0;    ///< background that a disk covers
  Image axis;                 ///< its pixels; empty for the exact axis
  Image inverted;
};

struct AccuracyRow {
  std::string name;
  std::uint64_t foreground = 0;
  std::vector<AccuracyCell> cells;
  Image image;
};

/// A shape of the kind of the report's Fig. 14: a few pixels, slanting sides, an arm.
Image figure_14();

/// Inverts the axes of an image by all families of brushfire, by ridge following on the same
/// pixels, and by the exact method, whose disks are taken at every eighth of a pixel along its
/// edges.
Result<AccuracyRow> measure_accuracy(const std::string& name, const Image& image);

/// The image, each axis, and what it becomes: missing pixels marked. One row of drawings a method.
std::string accuracy_drawing(const AccuracyRow& row);

std::string accuracy_table(const std::vector<AccuracyRow>& rows);
std::string accuracy_csv(const std::vector<AccuracyRow>& rows);

}  // namespace medial::cli
