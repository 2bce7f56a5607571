#include "io/whole_branches.h"

#include <utility>

#include "base/disjoint_sets.h"
#include "base/numbers.h"

namespace medial::io {

namespace {

bool is_inside(const Node& node) { return node.kind == NodeKind::site_change; }

/// Moves some edges of an axis to another one, with what they name.
class Mover {
 public:
  Mover(const AxisPart& from, AxisPart& to)
      : from_(from),
        to_(to),
        node_(from.axis.nodes.size(), none),
        site_(from.axis.sites.size(), none) {}

  void move(Edge edge) {
    for (std::uint32_t& node : edge.node) node = place_of_node(node);
    for (std::uint32_t& site : edge.site) site = place_of_site(site);
    to_.axis.edges.push_back(edge);
  }
  std::uint32_t place_of_node(std::uint32_t node) {
    const Node& own = from_.axis.nodes[node];
    if (is_inside(own) && node_[node] != none) return node_[node];
    to_.axis.nodes.push_back(own);
    to_.nodes.push_back(from_.nodes[node]);
    return node_[node] = static_cast<std::uint32_t>(to_.nodes.size() - 1);
  }

 private:
  std::uint32_t place_of_site(std::uint32_t site) {
    if (site == no_site) return site;
    if (site_[site] == none) {
      site_[site] = static_cast<std::uint32_t>(to_.axis.sites.size());
      to_.axis.sites.push_back(from_.axis.sites[site]);
    }
    return site_[site];
  }

  const AxisPart& from_;
  AxisPart& to_;
  std::vector<std::uint32_t> node_, site_;
};

}  // namespace

void WholeBranches::add(const AxisPart& part) {
  const auto first_site = static_cast<std::uint32_t>(open_.axis.sites.size());
  open_.axis.sites.insert(open_.axis.sites.end(), part.axis.sites.begin(), part.axis.sites.end());
  const auto place_of = [&](std::uint32_t i) {
    const Node& node = part.axis.nodes[i];
    if (is_inside(node)) {
      const auto [found, is_new] =
          half_met_.try_emplace(part.nodes[i], static_cast<std::uint32_t>(open_.axis.nodes.size()));
      if (!is_new) {
        const std::uint32_t place = found->second;
        half_met_.erase(found);
        return place;
      }
    }
    open_.axis.nodes.push_back(node);
    open_.nodes.push_back(part.nodes[i]);
    return static_cast<std::uint32_t>(open_.axis.nodes.size() - 1);
  };
  for (Edge edge : part.axis.edges) {
    for (std::uint32_t& node : edge.node) node = place_of(node);
    for (std::uint32_t& site : edge.site)
      if (site != no_site) site += first_site;
    open_.axis.edges.push_back(edge);
  }
}

bool WholeBranches::is_full() const {
  return open_.axis.edges.size() >= waiting_ + std::max(waiting_, least_edges);
}

/// Marks the edges of branches that a node divides which waits for its other edge.
std::vector<bool> WholeBranches::waiting_edges() const {
  const std::vector<Edge>& edges = open_.axis.edges;
  std::vector<std::uint32_t> edge_at(open_.axis.nodes.size(), none);
  DisjointSets chains(edges.size());
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    for (const std::uint32_t node : edges[i].node) {
      if (!is_inside(open_.axis.nodes[node])) continue;
      if (edge_at[node] == none)
        edge_at[node] = i;
      else
        chains.join(edge_at[node], i);
    }
  std::vector<bool> chain_waits(edges.size(), false), waits(edges.size(), false);
  for (const auto& [number, node] : half_met_) chain_waits[chains.find(edge_at[node])] = true;
  for (std::uint32_t i = 0; i < edges.size(); ++i) waits[i] = chain_waits[chains.find(i)];
  return waits;
}

AxisPart WholeBranches::take() {
  const std::vector<bool> waits = waiting_edges();
  AxisPart whole, rest;
  Mover take(open_, whole), keep(open_, rest);
  for (std::size_t i = 0; i < waits.size(); ++i) (waits[i] ? keep : take).move(open_.axis.edges[i]);
  for (auto& [number, node] : half_met_) node = keep.place_of_node(node);
  open_ = std::move(rest);
  waiting_ = open_.axis.edges.size();
  return whole;
}

}  // namespace medial::io
