#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "methods/lee/merge.h"

namespace medial::lee {

/// What the merges of one level amount to, for measurements.
struct Level {
  std::uint64_t crossings = 0;  ///< of all merge curves
  double seconds = 0;
};

struct ConquerContext {
  MergeLimits limits;
  double tie_tolerance = 0;  ///< see join_ties()
  const std::atomic<bool>* cancel = nullptr;
  /// Called with the share of the merges that is done, from any thread.
  std::function<void(double)> progress = {};
};

/// Merges the chains of every loop into one diagram: level by level, from lists of single chains to
/// halves of all. Level k has the lists between chains i h / 2^k, of h in all. The result depends
/// on the chains only, never on the number of threads. O(N log N). Returns the last edge of each
/// loop's last merge curve: the terminating bisector's. A loop whose segments all touch one disk
/// needs no merge. `levels`, if it is given, is filled from the last merge down, which then runs on
/// one thread. Nothing where a merge finds a diagram broken.
std::optional<std::vector<std::uint32_t>> conquer(Diagram& diagram, const ConquerContext& context,
                                                  Statistics& statistics,
                                                  std::vector<Level>* levels = nullptr);

}  // namespace medial::lee
