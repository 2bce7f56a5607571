#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "verify/checks.h"

namespace medial::verify_detail {

inline bool is_on_arc(const Site& site) {
  return site.kind() == SiteKind::arc && !(site.start == site.end);
}

/// The positions along arcs at which the disks at the ends of each edge touch those of its sites
/// that are arcs. Several checks use them.
class ArcFeet {
 public:
  explicit ArcFeet(const Problem& problem) : edges_(problem.axis.edges.data()) {
    // Including sites that are not on the boundary.
    if (std::none_of(problem.axis.sites.begin(), problem.axis.sites.end(), is_on_arc)) return;
    at_.resize(problem.axis.edges.size());
    parallel_for(at_.size(), [&](std::size_t i) {
      const Edge& edge = edges_[i];
      for (std::size_t side = 0; side < 2; ++side)
        if (is_on_arc(problem.axis.sites[edge.site[side]]))
          with_arc(problem, edge.site[side], [&](const Arc& arc) {
            for (std::size_t end = 0; end < 2; ++end)
              at_[i][2 * side + end] = arc.way_to_foot(problem.disk(edge.node[end]).center);
          });
    });
  }

  double at(const Edge& edge, std::size_t side, std::size_t end) const {
    return at_[static_cast<std::size_t>(&edge - edges_)][2 * side + end];
  }

 private:
  const Edge* edges_;
  std::vector<std::array<double, 4>> at_;  ///< none if no site is an arc
};

}  // namespace medial::verify_detail
