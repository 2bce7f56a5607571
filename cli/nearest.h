#pragma once

// Which point, segment or arc of a file is nearest to a place.

#include <string>
#include <vector>

#include "cli/common.h"

namespace medial::cli {

/// What is asked for.
struct NearestArguments {
  std::vector<Vec2> places;
  std::string queries;  ///< a file of more places; empty for none
  bool any() const { return !places.empty() || !queries.empty(); }
};

/// --nearest and --queries.
void add_nearest_options(CLI::App& command, NearestArguments& nearest);

/// Answers for all places, the option's before the file's: as .csv or .json to the output, or to
/// standard output. No diagram is computed. Returns the exit status.
Result<int> run_nearest(const FileArguments& arguments, const NearestArguments& asked);

}  // namespace medial::cli
