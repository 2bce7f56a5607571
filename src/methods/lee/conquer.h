#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "methods/lee/merge.h"

namespace medial::lee {

/// The work of the merges of one level, for measurements.
struct Level {
  std::uint64_t crossings = 0;  ///< by all merge curves
  double seconds = 0;
};

struct ConquerContext {
  MergeLimits limits;
  double tie_tolerance = 0;  ///< see join_ties()
  const std::atomic<bool>* cancel = nullptr;
  /// Called from any thread with the finished share of the merges.
  std::function<void(double)> progress = {};
};

/// Merges the chains of every loop into one diagram, level by level, from lists of single chains to
/// two halves. The lists of level k are between the chains i h / 2^k of the h chains. The result
/// depends only on the chains, never on the number of threads. O(N log N). Returns the last edge of
/// each loop's last merge curve: the terminating bisector's. A loop whose segments all touch one
/// disk needs no merge. If `levels` is given, it is filled from the last merge down, and everything
/// runs on one thread. Returns none if a merge finds that a diagram is broken.
std::optional<std::vector<std::uint32_t>> conquer(Diagram& diagram, const ConquerContext& context,
                                                  Statistics& statistics,
                                                  std::vector<Level>* levels = nullptr);

}  // namespace medial::lee
