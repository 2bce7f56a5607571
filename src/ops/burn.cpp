#include "ops/burn.h"

#include <algorithm>
#include <utility>

namespace medial::ops {

std::vector<std::array<double, 2>> burn(const MedialAxis& axis, std::span<const Fuse> fuses) {
  // The ends of branches around each node: 2 i + side.
  std::vector<std::uint32_t> begin(axis.nodes.size() + 1, 0);
  for (const Fuse& fuse : fuses)
    for (const std::uint32_t node : fuse.node) ++begin[node + 1];
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<std::uint32_t> ends(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t i = 0; i < fuses.size(); ++i)
    for (std::uint32_t side = 0; side < 2; ++side) ends[next[fuses[i].node[side]]++] = 2 * i + side;

  // The time at which the fire arrives at each end from the other one, where the branch starts to
  // burn once all others have burnt. If the fire never starts from that end, because it comes from
  // this end sooner, its hypothetical arrival would be later than all others and changes nothing.
  std::vector<double> arrival(ends.size(), not_burnt);
  std::vector<std::uint32_t> known(axis.nodes.size(), 0), ready;
  std::vector<bool> sent(ends.size(), false);
  const auto earlier = [&](std::uint32_t a, std::uint32_t b) {
    return arrival[a] != arrival[b] ? arrival[a] < arrival[b] : a < b;
  };
  // The last end at which the fire arrives at a node, and the time of arrival at all other ends.
  const auto last_of = [&](std::uint32_t node) {
    std::uint32_t last = ends[begin[node]];
    double others = begin[node + 1] - begin[node] == 1 ? axis.nodes[node].disk.radius : 0;
    for (std::uint32_t k = begin[node] + 1; k < begin[node + 1]; ++k) {
      const std::uint32_t first = std::min(last, ends[k], earlier);
      last = first == last ? ends[k] : last;
      others = std::max(others, arrival[first]);
    }
    return std::pair{last, others};
  };
  const auto send = [&](std::uint32_t end, double time) {
    if (sent[end]) return;
    sent[end] = true;
    arrival[end ^ 1U] = time + fuses[end / 2].length;
    const std::uint32_t node = fuses[end / 2].node[(end ^ 1U) % 2];
    if (++known[node] + 1 >= begin[node + 1] - begin[node]) ready.push_back(node);
  };
  for (std::uint32_t i = 0; i < axis.nodes.size(); ++i)
    if (begin[i + 1] - begin[i] == 1) ready.push_back(i);
  while (!ready.empty()) {
    const std::uint32_t node = ready.back();
    ready.pop_back();
    const auto [last, others] = last_of(node);
    send(last, others);
    if (known[node] == begin[node + 1] - begin[node])
      for (std::uint32_t k = begin[node]; k < begin[node + 1]; ++k) send(ends[k], arrival[last]);
  }
  std::vector<std::array<double, 2>> start(fuses.size(), {not_burnt, not_burnt});
  for (std::uint32_t i = 0; i < axis.nodes.size(); ++i) {
    const std::uint32_t count = begin[i + 1] - begin[i];
    if (count == 0 || known[i] + 1 < count) continue;
    const auto [last, others] = last_of(i);
    start[last / 2][last % 2] = others;
  }
  return start;
}

}  // namespace medial::ops
