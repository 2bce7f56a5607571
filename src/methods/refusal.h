#pragma once

#include <optional>

#include "medial/error.h"
#include "methods/problem.h"

namespace medial {

/// The error to return if verify() refuses an axis that the decisions alone do not make certain.
/// There, disks touch almost all sites, so that each search takes O(n): of large axes fewer disks
/// are measured.
std::optional<Error> error_if_refused(const Problem& problem, const MedialAxis& axis);

/// The error of a shape for which no correct axis was found. If two edges certainly cross, it names
/// them: the shape is invalid then, though build_shape() accepts arcs that cross by less than its
/// tolerance. Otherwise returns `error`. O(n log n) if no edge has many neighbours.
Error crossing_or(const Problem& problem, Error error);

/// The error to return instead of a wrong axis: `unsupported`, with the place, if the narrowest
/// disk is only a few tolerances large, so that rounding is the cause; otherwise `internal`, with
/// the text. O(n).
Error error_of_wrong_axis(const MedialAxis& axis, const char* text);

}  // namespace medial
