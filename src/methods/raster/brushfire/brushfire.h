#pragma once

#include <optional>

#include "medial/axis.h"
#include "methods/problem.h"

namespace medial::brushfire {

/// The method `brushfire`: fills the shape's interior on a grid (see PixelGrid), burns it down, and
/// links what is left. The radius of each node is its exact distance to the boundary. Requires that
/// refuse() found nothing. Errors: unsupported (no pixel's centre lies inside the shape),
/// cancelled.
Result<MedialAxis> run(const Problem& problem);

/// Errors: invalid_option, too_large, unsupported (see grid_for()).
std::optional<Error> refuse(const Problem& problem);

}  // namespace medial::brushfire
