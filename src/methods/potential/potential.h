#pragma once

#include "medial/axis.h"
#include "medial/error.h"
#include "methods/problem.h"

namespace medial::potential {

/// What the method cannot take of its options.
std::optional<Error> refuse(const Problem& problem);

/// The engine `potential` (docs/potential.md). Requires what compute() has checked. Errors:
/// unsupported (what verify() refuses, which no input is known to lead to), invalid_option (a seed
/// outside of the shape, a box without axis), and those of the method `disks`.
Result<MedialAxis> run(const Problem& problem);

}  // namespace medial::potential
