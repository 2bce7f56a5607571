#pragma once

#include <optional>

#include "medial/error.h"
#include "methods/problem.h"

namespace medial {

/// The error instead of an axis that verify() refuses, where decisions alone do not make it
/// certain. Disks there touch nearly all of these, so that every search takes O(n): of large axes
/// fewer disks are measured.
std::optional<Error> error_if_refused(const Problem& problem, const MedialAxis& axis);

/// The error of a shape without a right axis: which two edges cross, if any surely do. The shape is
/// invalid then, though build_shape() lets arcs pass that cross by less than its tolerance. Else
/// the one given. O(n log n), if no edge has many neighbours.
Error crossing_or(const Problem& problem, Error error);

/// The error instead of an axis that has come out wrong: unsupported, with the place, where it has
/// disks of so few tolerances that rounding is the cause; internal, with the text, else. O(n).
Error error_of_wrong_axis(const MedialAxis& axis, const char* text);

}  // namespace medial
