#pragma once

// Axes as masks of the pixels of an image.

#include "cli/common.h"
#include "medial/document.h"

namespace medial::cli {

/// Whether the options go with a mask. Errors: invalid_option.
Status check_mask(const FileArguments& arguments);

/// The axes as lines one pixel wide, in an image like the one that they are of: pixels of its
/// foreground, with as many components and holes; but of the axes of labels, and of an exterior,
/// the pixels that they pass through.
Status write_mask(const Document<AxisItem>& axes, const FileArguments& arguments, bool exterior);

}  // namespace medial::cli
