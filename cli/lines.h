#pragma once

// The options of `centreline` and `measure` that choose paths along the axes of a file.

#include <string>
#include <vector>

#include "cli/common.h"
#include "medial/centreline.h"

namespace medial::cli {

struct PathOptions {
  std::string from, to;             ///< "X,Y" or "RING/VERTEX"
  std::vector<std::string> widest;  ///< two of them, instead
  MainPathOptions path;

  bool between_places() const { return !from.empty() || !to.empty() || !widest.empty(); }
};

/// --from, --to, --widest, --route, --trim.
void add_path_options(CLI::App& command, PathOptions& arguments);

/// The paths of every feature: the main paths, or the path between the named places in the feature
/// that contains the first place. Errors name the feature.
Result<std::vector<std::vector<AxisPath>>> choose_paths(const Document<AxisItem>& file,
                                                        const PathOptions& arguments, int threads);

/// Refuses places X,Y with --project, because projected coordinates are not known in advance.
Status check_places(const PathOptions& arguments, const InputOptions& input);

/// Prints notes on named places that lie in no shape, and on the feature that contains the line.
void note_places(const Document<AxisItem>& file, const PathOptions& arguments,
                 const FileArguments& files);

}  // namespace medial::cli
