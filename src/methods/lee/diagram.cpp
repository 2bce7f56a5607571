#include "methods/lee/diagram.h"

#include "base/memory.h"

namespace medial::lee {

/// Begins with the diagrams of the chains: the spokes, and nothing else. A disk that touches a
/// chain twice would enclose a boundary that turns to the left, which a chain does not.
Diagram::Diagram(const Elements& all)
    : elements(all), top(all.size(), {none, none}), free(all.chains.size() - 1) {
  reserve_large(edges, 2 * std::size_t{all.size()});
  for (std::size_t chain = 0; chain < free.size(); ++chain) {
    const std::uint32_t begin = all.chains[chain], last = all.chains[chain + 1] - 1;
    for (std::uint32_t i = begin; i < last; ++i) {
      const Vec2 vertex = all.sites[all.is_vertex(i) ? i : i + 1].point;
      edges.push_back({{i, i + 1}, {none, none}, {vertex, 0}});
      top[i][0] = top[i + 1][1] = 2 * i;
      edges.push_back({{}, {i + 1 == last ? 2 * last : 2 * i + 3, none}, {}});
    }
    edges.push_back({{}, {2 * last + 1, none}, {}});
    edges.push_back({{}, {none, none}, {}});
    free[chain] = {begin == last ? 2 * begin : 2 * begin + 1, 2 * last + 1};
  }
}

}  // namespace medial::lee
