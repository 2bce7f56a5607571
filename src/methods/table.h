#pragma once

#include "methods/problem.h"

namespace medial {

/// A row of the table of methods (table.cpp). A new method needs a folder, its options in
/// medial/methods.h, and a row.
struct MethodRow {
  MethodInfo info;
  Method defaults;
  /// The error if the method does not support the problem for a reason that `info` does not state.
  std::optional<Error> (*refuse)(const Problem& problem);
  /// Requires that compute() and refuse() have checked the problem. If the caller cancels, it stops
  /// early, with any content.
  Result<Outcome> (*run)(const Problem& problem);
};

const MethodRow& row_of(const Method& method);
/// The row of the method that computes the axis: with Options::exact that of `disks`, for all
/// methods that support it.
const MethodRow& solver_of(const Options& options);

}  // namespace medial
