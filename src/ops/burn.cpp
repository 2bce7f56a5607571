#include "ops/burn.h"

#include <queue>

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

  std::vector<std::uint32_t> unburnt(axis.nodes.size());
  for (std::size_t i = 0; i < unburnt.size(); ++i) unburnt[i] = begin[i + 1] - begin[i];
  std::vector<std::array<double, 2>> start(fuses.size(), {not_burnt, not_burnt});
  std::vector<bool> burnt(ends.size(), false);  // the fire has arrived at this end

  struct Arrival {
    double time;
    std::uint32_t end;
    bool operator<(const Arrival& other) const {
      return time != other.time ? time > other.time : end > other.end;
    }
  };
  std::priority_queue<Arrival> queue;
  const auto ignite = [&](std::uint32_t node, double time) {
    for (std::uint32_t k = begin[node]; k < begin[node + 1]; ++k) {
      const std::uint32_t end = ends[k];
      if (burnt[end]) continue;
      start[end / 2][end % 2] = time;
      queue.push({time + fuses[end / 2].length, end ^ 1U});
    }
  };
  for (std::uint32_t node = 0; node < unburnt.size(); ++node)
    if (unburnt[node] == 1) ignite(node, axis.nodes[node].disk.radius);
  while (!queue.empty()) {
    const auto [time, end] = queue.top();
    queue.pop();
    // Two fires that run towards each other meet inside the branch.
    if (start[end / 2][end % 2] < not_burnt) continue;
    burnt[end] = true;
    const std::uint32_t node = fuses[end / 2].node[end % 2];
    if (--unburnt[node] == 1) ignite(node, time);
  }
  return start;
}

}  // namespace medial::ops
