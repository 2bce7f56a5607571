#pragma once

// Axes as masks of the pixels of an image.

#include "cli/common.h"
#include "medial/document.h"

namespace medial::cli {

/// Checks that the options can be combined with --mask. Errors: invalid_option.
Status check_mask(const FileArguments& arguments);

/// The axes as lines one pixel wide, in an image of the same size as the input: foreground pixels
/// with as many components and holes. For labels and for an exterior, the pixels on the axes.
Status write_mask(const Document<AxisItem>& axes, const FileArguments& arguments, bool exterior);

}  // namespace medial::cli
