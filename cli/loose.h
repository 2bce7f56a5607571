#pragma once

// Files as loose points and lines, for commands that do not need shapes.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "cli/pipeline.h"
#include "medial/document.h"
#include "medial/planar_graph.h"

namespace medial::cli {

/// All that a file holds, and the feature that each chain is of.
struct LooseFile {
  std::vector<Chain> chains;
  std::vector<std::uint32_t> feature;
  std::vector<Attributes> attributes;  ///< of each feature
  std::string crs_wkt;
  bool y_down = false;
  std::vector<std::string> notes;
};

/// Reads points, lines and boundaries as they are, without making shapes of them.
Result<LooseFile> load_chains(const InputOptions& input, int threads);
void print_notes(const LooseFile& file, const InputOptions& input, const CommonOptions& common);

/// An error of a planar graph, which names a chain, in terms of the file's features.
Error in_terms_of(const LooseFile& file, Error error, const std::string& path);

/// The planar graph of all chains, crossings split where --repair is given. Errors in terms of the
/// features.
Result<PlanarGraph> planar_graph_of(const LooseFile& file, const InputOptions& input,
                                    double reach = 0);

/// Distances, shares of the size and increasing, within which things are made to touch where
/// rounding does not tell them apart (PlanarGraphOptions::reach).
inline constexpr std::array<double, 3> touching_shares{0x1p-39, 0x1p-35, 0x1p-31};

/// Whether this is the error of a diagram whose points and edges are too near to each other.
bool is_too_close(const Error& error);
/// Tells that what is nearer than `reach` touches now.
void tell_touching(double reach, const InputOptions& input, const CommonOptions& common);

/// What work(planar graph) gives for the planar graph of all chains, which stays there. Where
/// points or edges are too near to each other, they are made to touch, with a note on standard
/// error.
template <class Work>
auto with_planar_graph(const LooseFile& file, const InputOptions& input,
                       const CommonOptions& common, PlanarGraph& planar_graph, Work&& work)
    -> decltype(work()) {
  auto first = planar_graph_of(file, input);
  if (!first) return std::move(first).error();
  planar_graph = std::move(first).value();
  auto result = work();
  const double size = diagonal(bounding_box(planar_graph));
  for (const double share : touching_shares) {
    if (result || !is_too_close(result.error())) break;
    auto touching = planar_graph_of(file, input, share * size);
    if (!touching) continue;
    planar_graph = std::move(touching).value();
    result = work();
    if (result) tell_touching(share * size, input, common);
  }
  if (!result) return in_terms_of(file, std::move(result).error(), input.path);
  return result;
}

}  // namespace medial::cli
