#include "methods/drop_enclosure.h"

#include <algorithm>

#include "axis/node_kinds.h"
#include "medial/query.h"

namespace medial {

void drop_enclosure(const std::vector<bool>& site_of_enclosure, const Box& enclosure,
                    MedialAxis& axis) {
  std::vector<std::uint32_t> site(axis.sites.size()), node(axis.nodes.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < axis.sites.size(); ++i) {
    site[i] = count;
    if (!site_of_enclosure[i]) axis.sites[count++] = axis.sites[i];
  }
  axis.sites.resize(count);

  std::vector<bool> lost(axis.nodes.size(), false), needed(axis.nodes.size(), false);
  // A sampled axis that follows the enclosure misses it by less than this.
  const double slack = 1e-7 * diagonal(enclosure);
  const auto touches_enclosure = [&](const Edge& edge) {
    if (edge.site[0] == no_site && edge.site[1] == no_site) {
      const auto [center, radius] = disk_at(axis, edge, 0.5);
      return std::min({center.x - enclosure.low.x, enclosure.high.x - center.x,
                       center.y - enclosure.low.y, enclosure.high.y - center.y}) <= radius + slack;
    }
    return std::any_of(edge.site.begin(), edge.site.end(),
                       [&](std::uint32_t s) { return s != no_site && site_of_enclosure[s]; });
  };
  for (const Edge& edge : axis.edges)
    for (const std::uint32_t n : edge.node) (touches_enclosure(edge) ? lost : needed)[n] = true;
  std::erase_if(axis.edges, touches_enclosure);
  count = 0;
  for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
    node[i] = count;
    if (needed[i] || !lost[i]) axis.nodes[count++] = axis.nodes[i];
  }
  axis.nodes.resize(count);
  for (Edge& edge : axis.edges) {
    for (std::uint32_t& n : edge.node) n = node[n];
    for (std::uint32_t& s : edge.site)
      if (s != no_site) s = site[s];
  }
  set_node_kinds(axis);
}

}  // namespace medial
