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

/// The paths of every feature: the main paths, or the one between the named places, in the feature
/// where the first of them lies. Errors name the feature.
Result<std::vector<std::vector<AxisPath>>> choose_paths(const Document<AxisItem>& file,
                                                        const PathOptions& arguments, int threads);

/// Refuses places X,Y in what is projected: nobody knows its coordinates before it is read.
Status check_places(const PathOptions& arguments, const InputOptions& input);

/// Notes on named places: each that lies in no shape, and in which of several features the line is.
void note_places(const Document<AxisItem>& file, const PathOptions& arguments,
                 const FileArguments& files);

}  // namespace medial::cli
