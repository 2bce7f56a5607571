#pragma once

#include "papers/experiment.h"

namespace medial::papers {

/// Section IV: the times of ridge following.
Result<bool> measure_ridge_following(const Request& request);

/// Section II.B.3, Fig. 14: how much of an image its axes keep.
Status measure_accuracy(const Request& request);

/// Section I: 50 drawings on a strip, bottom left, as they are and in pairs that interlock.
Status measure_packing(const Request& request);

}  // namespace medial::papers
