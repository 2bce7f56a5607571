#include "engines/lee/diagram.h"

#include "base/memory.h"

namespace medial::lee {

/// Begins with the diagrams of the chains: the spokes, and nothing else. A disk that touches a
/// chain twice would enclose a boundary that turns to the left, which a chain does not.
Diagram::Diagram(const Elements& all)
    : elements(all), top(all.size(), {none, none}), free(all.chains.size() - 1) {
  reserve_large(edges, 2 * std::size_t{all.size()});
  edges.resize(2 * std::size_t{all.size()});
  for (std::size_t chain = 0; chain < free.size(); ++chain) {
    const std::uint32_t begin = all.chains[chain], end = all.chains[chain + 1];
    std::uint32_t next_free = none;
    const auto add_free = [&](std::uint32_t place) {
      if (next_free == none) free[chain].last = place;
      edges[place].inward[0] = next_free;
      next_free = place;
    };
    for (std::uint32_t i = end; i-- > begin;) {
      add_free(2 * i + 1);
      if (i + 1 == end) {
        add_free(2 * i);
        continue;
      }
      const Vec2 vertex = all.sites[all.is_vertex(i) ? i : i + 1].point;
      edges[2 * i] = {{i, i + 1}, {none, none}, none, {vertex, 0}};
      top[i][0] = top[i + 1][1] = 2 * i;
    }
    free[chain].first = next_free;
  }
}

}  // namespace medial::lee
