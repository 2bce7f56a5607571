#pragma once

#include "cli/pipeline.h"

namespace medial::cli {

/// The axes that a command works on: of medial's own .json as they stand there, of shapes computed
/// now. With `specks` above 0 computed of without_specks() of the shapes, stored axes or not; and
/// with the exterior asked for of what surrounds them, also of stored axes of the interior.
/// Errors: those of reading and computing.
Result<AxisFile> load_axes(const InputOptions& input, const CommonOptions& common,
                           double specks = 0, const Options& options = {});

}  // namespace medial::cli
