#pragma once

#include <cstdint>
#include <vector>

#include "axis/sites.h"
#include "base/local_frame.h"
#include "medial/shape.h"
#include "site/site.h"

namespace medial::lee {

/// The elements of a shape without holes, in the local frame: Section II's list e_1, ..., e_N of
/// every loop, segments and reflex vertices in boundary order, from one convex vertex on.
struct Elements {
  /// The chains of one loop (Definition 9).
  struct Loop {
    std::uint32_t first_chain = 0;
    std::uint32_t end_chain = 0;
    std::uint32_t component = 0;
  };
  std::vector<site::Site> sites;
  std::vector<std::uint32_t> originals;  ///< index among the result's sites
  /// The first element of every chain: a segment that begins at a convex vertex. One more at the
  /// end, the number of elements.
  std::vector<std::uint32_t> chains;
  std::vector<Loop> loops;

  std::uint32_t size() const { return static_cast<std::uint32_t>(sites.size()); }
  bool is_vertex(std::uint32_t i) const { return sites[i].is_vertex(); }
};

/// Requires straight edges. Throws std::runtime_error where a loop has no convex vertex, which no
/// simple polygon is without. O(n).
Elements elements_of(const Shape& shape, const sites::SiteNumbers& numbers,
                     const LocalFrame& frame);

}  // namespace medial::lee
