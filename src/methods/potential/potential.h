#pragma once

#include "medial/axis.h"
#include "medial/error.h"
#include "methods/problem.h"

namespace medial::potential {

/// The error if the method does not support its options.
std::optional<Error> refuse(const Problem& problem);

/// The engine `potential` (docs/potential.md). Requires what compute() has checked. Errors:
/// unsupported (verify() refuses the result; no input is known to cause this), invalid_option (a
/// seed outside the shape, a box without axis), and the errors of the method `disks`.
Result<MedialAxis> run(const Problem& problem);

}  // namespace medial::potential
