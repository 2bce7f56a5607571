#pragma once

// Files as loose points and lines, for verbs that do not need shapes.

#include <string>
#include <utility>
#include <vector>

#include "cli/pipeline.h"
#include "medial/soup.h"

namespace medial::cli {

/// All that a file holds, and the feature that each chain is of.
struct LooseFile {
  std::vector<Chain> chains;
  std::vector<std::uint32_t> feature;
  std::vector<std::vector<std::pair<std::string, std::string>>> attributes;  ///< of each feature
  std::string crs_wkt;
  bool y_down = false;
  std::vector<std::string> notes;
};

/// Reads points, lines and boundaries as they are, without making shapes of them.
Result<LooseFile> load_chains(const InputSwitches& input, int threads);
void print_notes(const LooseFile& file, const InputSwitches& input, const CommonSwitches& common);

/// An error of a soup, which names a chain, in terms of the file's features.
Error in_terms_of(const LooseFile& file, Error error, const std::string& path);

}  // namespace medial::cli
