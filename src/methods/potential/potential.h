#pragma once

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "medial/shape.h"

namespace medial::potential {

/// The engine `potential` (docs/potential.md). Requires what compute() has checked. Errors:
/// unsupported (valleys that the arithmetic cannot tell apart, so that no connected skeleton is
/// found), invalid_option (a seed outside of the shape).
Result<MedialAxis> run(const Shape& shape, const Options& options);

}  // namespace medial::potential
