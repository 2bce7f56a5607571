#pragma once

#include "methods/problem.h"

namespace medial {

/// What the table of methods holds for each (table.cpp): a new method is a folder, its options in
/// medial/methods.h, and a row.
struct MethodRow {
  MethodInfo info;
  Method defaults;
  /// What the method cannot take of the problem beyond what `info` says, if anything.
  std::optional<Error> (*refuse)(const Problem& problem);
  /// Requires what compute() and refuse() have checked. Cut short, with any content, where the
  /// caller cancels.
  Result<Outcome> (*run)(const Problem& problem);
};

const MethodRow& row_of(const Method& method);
/// The row of the method that computes: with Options::exact that of `disks`, for all that take it.
const MethodRow& solver_of(const Options& options);

}  // namespace medial
