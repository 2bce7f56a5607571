#pragma once

// The options and the work of the commands that prune.

#include <optional>
#include <string>
#include <vector>

#include "cli/pipeline.h"
#include "medial/prune.h"

namespace medial::cli {

struct PruneArguments {
  std::vector<std::optional<double>> thresholds;  ///< by measure
  std::string by;
  std::optional<std::uint64_t> keep;
  bool tips = false;
  std::string speck_share;  ///< as given
  double specks = 0;        ///< share of without_specks(); 0: they stay
};

/// The threshold of prominence for images: that of prune_measures() loses knobs of a key.
constexpr double image_prominence = 0.15;
/// The default pruning of an image, to the branches that a person would draw; nothing for other
/// documents, or if the options select a pruning.
std::optional<PruneOptions> image_pruning(const Document<AxisItem>& file,
                                          const InputOptions& input);

/// Prints a note on the specks of an image, which --specks would remove.
void note_specks(const Document<AxisItem>& file, const InputOptions& input,
                 const CommonOptions& common);

/// An option for every measure, --by, --keep, --tips and --specks.
void add_prune_options(CLI::App& command, PruneArguments& arguments);
/// Errors: invalid_option.
Result<PruneOptions> prune_options(const PruneArguments& arguments);
/// Prunes all axes of a file. The report holds sums, and the largest threshold.
Result<PruneReport> prune_all(Document<AxisItem>& file, const PruneOptions& options, int threads);

}  // namespace medial::cli
