#pragma once

#include "cli/pipeline.h"

namespace medial::cli {

/// The axes that a verb works on: of medial's own .json as they stand there, of shapes computed
/// now. Errors: those of reading and computing.
Result<AxisFile> load_axes(const InputSwitches& input, const CommonSwitches& common);

}  // namespace medial::cli
