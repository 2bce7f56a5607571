#include "engines/disks/collect.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "axis/sites.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "geometry/bisector.h"

namespace medial::disks {
namespace {

/// A chunk in its final place: its node i > 0 is node `first_node + i - 1` of the axis, and its
/// node 0 is node `parent`.
struct Placed {
  Chunk* chunk;
  std::uint32_t parent;
  std::uint32_t first_node;
  std::uint32_t first_edge;

  std::uint32_t node(std::uint32_t i) const { return i == 0 ? parent : first_node + i - 1; }
};

/// All chunks, parents before children, in an order that depends on the walk only.
std::vector<Placed> place(const std::vector<std::unique_ptr<Chunk>>& chunks, std::uint32_t& nodes,
                          std::uint32_t& edges) {
  std::vector<Placed> placed;
  for (const auto& root : chunks) {
    std::vector<std::pair<Chunk*, std::uint32_t>> stack{{root.get(), none}};
    while (!stack.empty()) {
      const auto [chunk, parent] = stack.back();
      stack.pop_back();
      placed.push_back({chunk, parent, nodes, edges});
      nodes += static_cast<std::uint32_t>(chunk->nodes.size() - 1);
      edges += static_cast<std::uint32_t>(chunk->edges.size());
      const Placed self = placed.back();
      for (std::size_t i = chunk->children.size(); i-- > 0;) {
        Chunk* child = chunk->children[i].get();
        stack.emplace_back(child, self.node(child->parent_node));
      }
    }
  }
  return placed;
}

/// Joins the two ends of the axis that meet at each cut: two edges become one, or a node takes the
/// other's place. Removes what is then left over.
void glue_cuts(const std::vector<Placed>& placed, std::size_t cut_count, MedialAxis& axis) {
  struct End {
    std::uint32_t node = none, edge = none;
  };
  std::vector<std::array<End, 2>> ends(cut_count);
  for (const Placed& p : placed) {
    for (const CutEnd& end : p.chunk->cut_ends) {
      auto& pair = ends[end.cut];
      End& slot = pair[0].node == none ? pair[0] : pair[1];
      slot = {p.node(end.node), end.edge == CutEnd::no_edge ? none : p.first_edge + end.edge};
    }
  }
  std::vector<std::uint32_t> moved(axis.nodes.size());
  for (std::uint32_t i = 0; i < moved.size(); ++i) moved[i] = i;
  const auto target = [&](std::uint32_t node) {
    while (moved[node] != node) node = moved[node] = moved[moved[node]];
    return node;
  };
  std::vector<bool> node_gone(axis.nodes.size()), edge_gone(axis.edges.size());
  for (const auto& [a, b] : ends) {
    if (a.node == none || b.node == none) continue;
    if (a.edge != none && b.edge != none) {
      axis.edges[a.edge].node[1] = axis.edges[b.edge].node[0];
      edge_gone[b.edge] = node_gone[a.node] = node_gone[b.node] = true;
    } else if (a.edge != none) {
      axis.edges[a.edge].node[1] = b.node;
      node_gone[a.node] = true;
    } else if (b.edge != none) {
      axis.edges[b.edge].node[1] = a.node;
      node_gone[b.node] = true;
    } else if (target(a.node) != target(b.node)) {
      node_gone[target(b.node)] = true;
      moved[target(b.node)] = target(a.node);
    }
  }
  std::vector<std::uint32_t> number(axis.nodes.size());
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < axis.nodes.size(); ++i) {
    if (node_gone[i]) continue;
    number[i] = kept;
    axis.nodes[kept++] = axis.nodes[i];
  }
  axis.nodes.resize(kept);
  std::size_t edges = 0;
  for (std::size_t i = 0; i < axis.edges.size(); ++i) {
    if (edge_gone[i]) continue;
    Edge edge = axis.edges[i];
    for (std::uint32_t& node : edge.node) node = number[target(node)];
    axis.edges[edges++] = edge;
  }
  axis.edges.resize(edges);
}

}  // namespace

void collect(std::vector<std::unique_ptr<Chunk>>& chunks, std::size_t cut_count, MedialAxis& axis) {
  std::uint32_t node_count = 0, edge_count = 0;
  const std::vector<Placed> placed = place(chunks, node_count, edge_count);

  // One after the other: what takes the time is memory that is touched for the first time.
  const auto collect_nodes = [&] {
    reserve_large(axis.nodes, node_count);
    for (const Placed& p : placed) {
      p.chunk->nodes.drain([&](std::size_t i, const Disk& disk) {
        if (i > 0) axis.nodes.push_back({disk, p.chunk->component, NodeKind::leaf});
      });
    }
  };
  const auto collect_edges = [&] {
    reserve_large(axis.edges, edge_count);
    for (const Placed& p : placed) {
      p.chunk->edges.drain([&](std::size_t, const RawEdge& raw) {
        axis.edges.push_back({{p.node(raw.from), p.node(raw.to)}, {raw.left, raw.right}, {}, 1});
      });
    }
  };
  tbb::parallel_invoke(collect_nodes, collect_edges);
  for (const Placed& p : placed) axis.statistics += p.chunk->statistics;
  if (cut_count > 0) glue_cuts(placed, cut_count, axis);
  chunks.clear();
}

tbb::concurrent_vector<std::uint32_t> complete(const Boundary& boundary, const Frame& frame,
                                               double slack, MedialAxis& axis) {
  axis.statistics.largest_residual *= frame.inverse;
  const auto touches = [&](const Disk& disk, const geometry::Site& site) {
    const double least = std::max(0.0, disk.radius - slack), most = disk.radius + slack;
    const double squared = geometry::squared_distance(site, disk.center);
    return squared >= least * least && squared <= most * most;  // false for no number, too
  };
  tbb::concurrent_vector<std::uint32_t> doubtful;
  const auto control = [&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, axis.edges.size(), 4096), [&](const auto& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            Edge& edge = axis.edges[i];
            const geometry::Site &left = boundary.sites[edge.site[0]],
                                 &right = boundary.sites[edge.site[1]];
            const Disk &from = axis.nodes[edge.node[0]].disk, &to = axis.nodes[edge.node[1]].disk;
            if (!(touches(from, left) && touches(from, right) && touches(to, left) &&
                  touches(to, right)))
              doubtful.push_back(static_cast<std::uint32_t>(i));
            const geometry::Control found = geometry::control_of(left, right, from, to);
            edge.control = {frame.to_input(found.point.center), frame.inverse * found.point.radius};
            edge.weight = found.weight;
            for (std::uint32_t& site : edge.site) site = boundary.originals[site];
          }
        });
  };
  std::vector<std::uint8_t> degree(axis.nodes.size());
  const auto count = [&] {
    for (const Edge& edge : axis.edges)
      for (const std::uint32_t node : edge.node)
        if (degree[node] < 3) ++degree[node];
  };
  tbb::parallel_invoke(count, control);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, axis.nodes.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          Node& node = axis.nodes[i];
          node.disk = {frame.to_input(node.disk.center), frame.inverse * node.disk.radius};
          node.kind = degree[i] <= 1   ? NodeKind::leaf
                      : degree[i] == 2 ? NodeKind::site_change
                                       : NodeKind::branching;
        }
      });
  return doubtful;
}

bool touches_its_sites(const MedialAxis& axis, const Edge& edge, double slack) {
  const auto squared_distance = [](const Site& site, Vec2 c) {
    if (site.start == site.end) return squared_norm(c - site.start);
    const sites::Pieces pieces = sites::pieces_of(site.start, site.end, site.bulge);
    const double first = geometry::squared_distance(pieces.first(), c);
    return pieces.count == 1 ? first
                             : std::min(first, geometry::squared_distance(pieces.last(), c));
  };
  const auto touches = [&](const Disk& disk, const Site& site) {
    return std::abs(std::sqrt(squared_distance(site, disk.center)) - disk.radius) <= slack;
  };
  for (const std::uint32_t node : edge.node)
    for (const std::uint32_t site : edge.site)
      if (!touches(axis.nodes[node].disk, axis.sites[site])) return false;
  return true;
}

}  // namespace medial::disks
