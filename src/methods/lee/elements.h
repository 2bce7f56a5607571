#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "methods/problem.h"
#include "site/site.h"

namespace medial::lee {

/// The elements of a shape without holes, in the local frame: Section II's list e_1, ..., e_N of
/// every loop, segments and reflex vertices in boundary order, from one convex vertex on.
struct Elements {
  /// The chains of one loop (Definition 9).
  struct ChainLoop {
    std::uint32_t first_chain = 0;
    std::uint32_t end_chain = 0;
    std::uint32_t component = 0;
  };
  std::vector<site::Site> sites;
  std::vector<std::uint32_t> originals;  ///< index among the result's sites
  /// The first element of every chain: a segment that begins at a convex vertex. One more at the
  /// end, the number of elements.
  std::vector<std::uint32_t> chains;
  std::vector<ChainLoop> loops;

  std::uint32_t size() const { return static_cast<std::uint32_t>(sites.size()); }
  bool is_vertex(std::uint32_t i) const { return sites[i].is_vertex(); }
};

/// Requires straight edges. Nothing where a loop has no convex vertex, as every simple polygon has.
/// O(n).
std::optional<Elements> elements_of(const Problem& problem);

}  // namespace medial::lee
