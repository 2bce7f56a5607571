#pragma once

#include <optional>

#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/shape.h"

namespace medial::brushfire {

/// Method::brushfire: fills the shape's interior on a grid (see Options), burns it down, and links
/// what is left. The radius of each node is its exact distance to the boundary. Requires that
/// refuse() found nothing. Errors: unsupported (no pixel's centre lies inside the shape),
/// cancelled.
Result<MedialAxis> run(const Shape& shape, const Options& options);

/// Errors: invalid_option, too_large, unsupported (see grid_for()).
std::optional<Error> refuse(const Shape& shape, const Options& options);

}  // namespace medial::brushfire
