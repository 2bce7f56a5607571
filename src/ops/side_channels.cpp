#include <algorithm>
#include <limits>
#include <vector>

#include "axis/steps.h"
#include "base/numbers.h"
#include "medial/centreline.h"
#include "medial/query.h"
#include "ops/trees.h"

namespace medial {
namespace {

/// The edges of a graph without which a connected part of it falls apart, by the order in which a
/// search in depth meets the nodes (Tarjan 1974).
class Bridges {
 public:
  Bridges(const MedialAxis& axis, const Incidence& incidence, const std::vector<bool>& gone)
      : axis_(axis),
        incidence_(incidence),
        gone_(gone),
        met_(axis.nodes.size(), unmet),
        lowest_(axis.nodes.size(), unmet),
        is_bridge_(axis.edges.size(), false) {
    for (std::uint32_t node = 0; node < axis.nodes.size(); ++node)
      if (met_[node] == unmet) search(node);
  }
  bool contains(std::uint32_t edge) const { return is_bridge_[edge]; }

 private:
  static constexpr std::uint32_t unmet = std::numeric_limits<std::uint32_t>::max();
  struct Visit {
    std::uint32_t node, via;  ///< via an edge
    std::size_t next = 0;     ///< of the node's edges
  };

  void search(std::uint32_t start) {
    std::vector<Visit> way;
    enter(way, start, none);
    while (!way.empty()) {
      Visit& visit = way.back();
      const auto edges = incidence_.edges(visit.node);
      if (visit.next == edges.size()) {
        leave(way);
        continue;
      }
      const std::uint32_t edge = edges[visit.next++];
      if (gone_[edge] || edge == visit.via) continue;
      const std::uint32_t to = other_end(axis_.edges[edge], visit.node);
      if (met_[to] == unmet)
        enter(way, to, edge);
      else
        lowest_[visit.node] = std::min(lowest_[visit.node], met_[to]);
    }
  }
  void enter(std::vector<Visit>& way, std::uint32_t node, std::uint32_t via) {
    met_[node] = lowest_[node] = count_++;
    way.push_back({node, via});
  }
  void leave(std::vector<Visit>& way) {
    const Visit done = way.back();
    way.pop_back();
    if (way.empty()) return;
    const std::uint32_t before = way.back().node;
    lowest_[before] = std::min(lowest_[before], lowest_[done.node]);
    is_bridge_[done.via] = lowest_[done.node] > met_[before];
  }

  const MedialAxis& axis_;
  const Incidence& incidence_;
  const std::vector<bool>& gone_;
  std::vector<std::uint32_t> met_, lowest_;
  std::vector<bool> is_bridge_;
  std::uint32_t count_ = 0;
};

}  // namespace

std::vector<PathPiece> side_channels(const MedialAxis& axis, const AxisPath& path) {
  std::vector<bool> gone(axis.edges.size(), false), on_path(axis.edges.size(), false);
  ops::take_off_leaves(
      axis, [](std::uint32_t) { return false; },
      [&gone](std::uint32_t edge, std::uint32_t, std::uint32_t) { gone[edge] = true; });
  const Incidence incidence(axis);
  const Bridges bridges(axis, incidence, gone);
  std::vector<bool> seen(axis.nodes.size(), false);
  std::vector<std::uint32_t> reached;
  const auto reach = [&](std::uint32_t node) {
    if (!seen[node]) reached.push_back(node);
    seen[node] = true;
  };
  for (const PathPiece& piece : path.pieces) {
    on_path[piece.edge] = true;
    for (const std::uint32_t node : axis.edges[piece.edge].node) reach(node);
  }
  std::vector<bool> taken = on_path;
  std::vector<PathPiece> channels;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const std::uint32_t edge : incidence.edges(reached[i])) {
      if (taken[edge] || gone[edge] || bridges.contains(edge)) continue;
      taken[edge] = true;
      channels.push_back({edge, 0, 1});
      reach(other_end(axis.edges[edge], reached[i]));
    }
  }
  return channels;
}

}  // namespace medial
