#pragma once

// Finds the point, segment or arc of a file that is nearest to a place.

#include <string>
#include <vector>

#include "cli/common.h"

namespace medial::cli {

/// The places to search from.
struct NearestArguments {
  std::vector<Vec2> places;
  std::string queries;  ///< a file of more places; empty for none
  bool any() const { return !places.empty() || !queries.empty(); }
};

/// --nearest and --queries.
void add_nearest_options(CLI::App& command, NearestArguments& nearest);

/// Finds the nearest site for all places: first those of --nearest, then those of the file. Writes
/// .csv or .json to the output or to standard output. Computes no diagram. Returns the exit status.
Result<int> run_nearest(const FileArguments& arguments, const NearestArguments& asked);

}  // namespace medial::cli
