#include "methods/exact/replace_nodes.h"

#include <algorithm>
#include <utility>

#include "axis/node_kinds.h"
#include "base/compat.h"
#include "base/numbers.h"
#include "site/bisector.h"

namespace medial::exact {
namespace {

class Replacer {
 public:
  Replacer(const SiteLoops& outline, const LocalFrame& frame, const ContactGraph& graph,
           Replaced replaced, MedialAxis& axis)
      : outline_(outline),
        frame_(frame),
        graph_(graph),
        replaced_(std::move(replaced)),
        axis_(axis) {}

  /// Drops what is gone, and works out the new edges' curves and the nodes' kinds.
  void run() {
    const std::vector<bool> edge_gone = find_gone_edges();
    std::vector<std::uint32_t> number(axis_.nodes.size(), none);
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < axis_.nodes.size(); ++i) {
      if (replaced_.gone[i]) continue;
      number[i] = kept;
      axis_.nodes[kept++] = axis_.nodes[i];
    }
    axis_.nodes.resize(kept);
    std::size_t edges = 0;
    std::vector<std::uint32_t> degree(kept, 0);
    for (std::size_t i = 0; i < axis_.edges.size(); ++i) {
      if (edge_gone[i]) continue;
      Edge edge = axis_.edges[i];
      const bool moved = replaced_.added[edge.node[0]] || replaced_.added[edge.node[1]];
      for (std::uint32_t& node : edge.node) ++degree[node = number[node]];
      if (moved) {
        const Disk from = local(axis_.nodes[edge.node[0]].disk),
                   to = local(axis_.nodes[edge.node[1]].disk);
        const Vec2 middle = midpoint(from.center, to.center);
        const site::Control control = site::control_of(piece_of(edge.site[0], middle),
                                                       piece_of(edge.site[1], middle), from, to);
        edge.control = {frame_.to_input(control.point.center),
                        frame_.inverse * control.point.radius};
        edge.weight = control.weight;
      }
      axis_.edges[edges++] = edge;
    }
    axis_.edges.resize(edges);
    for (std::uint32_t i = 0; i < kept; ++i) axis_.nodes[i].kind = kind_of_degree(degree[i]);
  }

 private:
  Disk local(const Disk& disk) const {
    return {frame_.to_local(disk.center), frame_.scale * disk.radius};
  }

  /// The piece of a site that a disk touches.
  site::Site piece_of(std::uint32_t site, Vec2 center) const {
    const ExactSite& exact = outline_.sites[site];
    if (exact.is_vertex()) return site::make_vertex(exact.start);
    const site::Pieces pieces = site::pieces_of(exact.start, exact.end, exact.bulge);
    const bool last = pieces.count > 1 && site::squared_distance(pieces.last(), center) <
                                              site::squared_distance(pieces.first(), center);
    return last ? pieces.last() : pieces.first();
  }

  /// The edges of dropped links; their inner nodes are gone, too.
  std::vector<bool> find_gone_edges() {
    std::vector<std::vector<std::uint32_t>> around(axis_.nodes.size());
    for (std::uint32_t i = 0; i < axis_.edges.size(); ++i)
      for (const std::uint32_t node : axis_.edges[i].node)
        if (graph_.contacts(node).empty()) around[node].push_back(i);
    std::vector<bool> gone(axis_.edges.size(), false);
    std::vector<std::uint32_t> stack = replaced_.gone_edges;
    while (!stack.empty()) {
      const std::uint32_t edge = stack.back();
      stack.pop_back();
      if (gone[edge]) continue;
      gone[edge] = true;
      for (const std::uint32_t node : axis_.edges[edge].node) {
        if (around[node].empty()) continue;
        replaced_.gone[node] = true;
        stack.insert(stack.end(), around[node].begin(), around[node].end());
      }
    }
    return gone;
  }

  const SiteLoops& outline_;
  const LocalFrame& frame_;
  const ContactGraph& graph_;
  Replaced replaced_;
  MedialAxis& axis_;
};

}  // namespace

void replace_nodes(const SiteLoops& outline, const LocalFrame& frame, const ContactGraph& graph,
                   Replaced replaced, MedialAxis& axis) {
  Replacer(outline, frame, graph, std::move(replaced), axis).run();
}

}  // namespace medial::exact
