#include "methods/lee/diagram.h"

#include "base/memory.h"

namespace medial::lee {

/// Starts with the diagrams of the chains, which contain only spokes: a disk that touches a chain
/// twice would enclose a boundary that turns left, and a chain has none.
Diagram::Diagram(const Elements& all)
    : elements(all), top(all.size(), {none, none}), free(all.chains.size() - 1) {
  reserve_large(edges, 2 * std::size_t{all.size()});
  for (std::size_t chain = 0; chain < free.size(); ++chain) {
    const std::uint32_t begin = all.chains[chain], last = all.chains[chain + 1] - 1;
    for (std::uint32_t i = begin; i <= last; ++i) {
      if (i < last && !all.is_of_bridge(i) && !all.is_of_bridge(i + 1)) {
        const Disk disk{all.sites[all.is_vertex(i) ? i : i + 1].point, 0};
        edges.push_back({{i, i + 1}, {none, none}, disk});
        top[i][0] = top[i + 1][1] = 2 * i;
      } else {
        add_free_place(free[chain]);
      }
      add_free_place(free[chain]);
    }
  }
}

void Diagram::add_free_place(FreePlaces& places) {
  const auto place = static_cast<std::uint32_t>(edges.size());
  edges.push_back({{}, {none, none}, {}});
  if (places.first == none)
    places.first = place;
  else
    edges[places.last].inward[0] = place;
  places.last = place;
}

}  // namespace medial::lee
