#include "methods/disks/open_graph.h"

#include <algorithm>
#include <array>
#include <utility>

#include "axis/node_kinds.h"
#include "axis/statistics.h"
#include "base/compat.h"
#include "base/disjoint_sets.h"
#include "base/numbers.h"
#include "methods/disks/merge_ties.h"
#include "methods/disks/walk.h"

namespace medial::disks {
namespace {

/// Of the size: no near tie is that far off (see disks.cpp).
constexpr double looseness = 0x1p-20;

/// The numbers that are looked up for the first time, in that order, and their places there.
class FirstPlaces {
 public:
  explicit FirstPlaces(std::size_t most) {
    while (table_.size() < 2 * most + 2) table_.resize(2 * table_.size());
    std::fill(table_.begin(), table_.end(), none);
  }
  std::uint32_t place_of(std::uint32_t number) {
    constexpr std::uint32_t spread = 0x9E3779B1;  // the golden ratio's bits
    for (std::uint32_t i = number * spread;; ++i) {
      std::uint32_t& place = table_[i & (table_.size() - 1)];
      if (place == none) {
        place = static_cast<std::uint32_t>(numbers.size());
        numbers.push_back(number);
      }
      if (numbers[place] == number) return place;
    }
  }
  std::vector<std::uint32_t> numbers;

 private:
  std::vector<std::uint32_t> table_ = std::vector<std::uint32_t>(64);
};

}  // namespace

OpenGraph::OpenGraph(const Problem& problem, const SiteNumbers& numbers,
                     const site::BoundaryTree& tree, const ExactSites& exact)
    : problem_(problem),
      numbers_(numbers),
      boundary_(exact.boundary),
      tree_(tree),
      exact_(exact),
      slack_(std::max(looseness * diagonal(problem.box), 4 * problem.tolerance)),
      ends_(boundary_.bridges.size()),
      balance_(boundary_.runs.size()) {
  const Shape& shape = problem.shape;
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop)
    balance_[shape.component[loop]] += shape.hole[loop] ? 1 : -1;
}

void OpenGraph::begin(std::vector<std::unique_ptr<Chunk>> roots) {
  while (!roots.empty()) {
    tasks_.push_back({std::move(roots.back()), none});
    roots.pop_back();
  }
}

std::vector<OpenGraph::Task> OpenGraph::take(std::size_t nodes) {
  std::vector<Task> taken;
  for (std::size_t sum = 0; sum < nodes && !tasks_.empty();) {
    sum += std::min<std::size_t>(tasks_.back().chunk->span, nodes / 16) + 1;
    taken.push_back(std::move(tasks_.back()));
    tasks_.pop_back();
  }
  return taken;
}

void OpenGraph::add(Task task) {
  Chunk& chunk = *task.chunk;
  const auto first_node = static_cast<std::uint32_t>(graph_.nodes.size());
  const auto first_link = static_cast<std::uint32_t>(graph_.edges.size());
  const auto place = [&](std::uint32_t i) { return i == 0 ? task.node : first_node + i - 1; };
  if (task.node != none) --waiting_[task.node];
  chunk.nodes.drain(true, [&](std::size_t i, const Disk& disk) {
    if (i == 0) return;
    moved_.push_back(static_cast<std::uint32_t>(graph_.nodes.size()));
    graph_.nodes.push_back({disk, chunk.component, NodeKind::leaf});
  });
  number_.resize(graph_.nodes.size(), none);
  waiting_.resize(graph_.nodes.size());
  chunk.links.drain(true, [&](std::size_t, const Link& link) {
    graph_.edges.push_back({{place(link.node[0]), place(link.node[1])}, link.site, {}});
  });
  for (const BridgeEnd& end : chunk.bridge_ends)
    meet(end.bridge,
         {place(end.node), end.edge == BridgeEnd::no_edge ? none : first_link + end.edge});
  for (auto& child : chunk.children) {
    const std::uint32_t node = place(child->parent_node);
    if (node != none) ++waiting_[node];
    tasks_.push_back({std::move(child), node});
  }
  lost_ = lost_ || !chunk.lost.empty();
  statistics_ += chunk.statistics;
}

/// Calls use(task) for those that begin at a node: the components not yet begun lie below them.
template <class Use>
void OpenGraph::for_each_begun(const Use& use) {
  for (auto task = tasks_.rbegin(); task != tasks_.rend() && task->node != none; ++task) use(*task);
}

bool OpenGraph::is_full(std::size_t nodes) const {
  return graph_.nodes.size() >= last_held_ + std::max(nodes, last_held_);
}

std::uint32_t OpenGraph::target(std::uint32_t node) {
  while (moved_[node] != node) node = moved_[node] = moved_[moved_[node]];
  return node;
}

/// As glue() of collect.cpp: two edges become one, or a node takes the other's place.
void OpenGraph::meet(std::uint32_t bridge, End b) {
  End& a = ends_[bridge];
  if (a.node == none) {
    a = b;
    ++waiting_[b.node];
    half_met_.push_back(bridge);
    return;
  }
  --waiting_[a.node];
  glued_ = true;
  if (a.link != none && b.link != none) {
    moved_[a.node] = moved_[b.node] = graph_.edges[b.link].node[0];
    gone_links_.push_back(b.link);
  } else if (a.link != none) {
    moved_[a.node] = b.node;
  } else if (b.link != none) {
    moved_[b.node] = a.node;
  } else {
    moved_[target(b.node)] = target(a.node);
  }
  a = {};
}

/// Replaces nodes that have become others at bridges.
void OpenGraph::resolve() {
  std::erase_if(half_met_, [&](std::uint32_t bridge) { return ends_[bridge].node == none; });
  if (!std::exchange(glued_, false)) return;
  for (std::uint32_t i = 0; i < moved_.size(); ++i)
    if (const std::uint32_t to = target(i); to != i) waiting_[to] += std::exchange(waiting_[i], 0);
  std::sort(gone_links_.begin(), gone_links_.end());
  for (const std::uint32_t bridge : half_met_) {
    End& end = ends_[bridge];
    end.node = target(end.node);
    if (end.link == none) continue;
    const auto after = std::lower_bound(gone_links_.begin(), gone_links_.end(), end.link);
    end.link -= static_cast<std::uint32_t>(after - gone_links_.begin());
  }
  for (const std::uint32_t gone : gone_links_) graph_.edges[gone].node = {none, none};
  std::erase_if(graph_.edges, [](const Edge& link) { return link.node[0] == none; });
  gone_links_.clear();
  for (Edge& link : graph_.edges)
    for (std::uint32_t& node : link.node) node = target(node);
  for_each_begun([&](Task& task) { task.node = target(task.node); });
}

/// Marks open nodes, their neighbours and what may be contracted with them; and those that others
/// have become.
std::vector<std::uint8_t> OpenGraph::held_nodes(const std::vector<std::uint32_t>& ties) const {
  std::vector<std::uint8_t> held(graph_.nodes.size());
  for (std::size_t i = 0; i < held.size(); ++i) held[i] = waiting_[i] > 0;
  for (const Edge& link : graph_.edges) {
    for (const std::size_t k : {0U, 1U})
      if (waiting_[link.node[k]] > 0) held[link.node[1 - k]] = true;
  }
  if (!ties.empty()) hold_ties(ties, held);
  return held;
}

/// What an edge connects that may be contracted, and what lies next to each other of that, is
/// decided at once: it is held where one of its nodes is, or is next to one that is.
void OpenGraph::hold_ties(const std::vector<std::uint32_t>& ties,
                          std::vector<std::uint8_t>& held) const {
  std::vector<std::uint8_t> in_tie(held.size()), waits(held.size());
  for (const std::uint32_t tie : ties)
    for (const std::uint32_t node : graph_.edges[tie].node) in_tie[node] = true;
  DisjointSets sets(held.size());
  const auto for_each_link = [&](const auto& use) {
    for (const Edge& link : graph_.edges) use(link.node[0], link.node[1]);
  };
  for_each_link([&](std::uint32_t from, std::uint32_t to) {
    if (in_tie[from] && in_tie[to]) sets.join(from, to);
  });
  for_each_link([&](std::uint32_t from, std::uint32_t to) {
    if (in_tie[from] && (held[from] || held[to])) waits[sets.find(from)] = true;
    if (in_tie[to] && (held[from] || held[to])) waits[sets.find(to)] = true;
  });
  for (std::uint32_t node = 0; node < held.size(); ++node)
    if (in_tie[node] && waits[sets.find(node)]) held[node] = true;
}

/// Divides the open graph. In the part come first the nodes of parts before, then those with edges
/// that stay, so that contracting ties leaves these in their places.
OpenGraph::Cut OpenGraph::cut() {
  Cut cut;
  const std::vector<std::uint32_t> ties =
      tie_candidates(tree_, exact_, problem_.local_tolerance(), graph_);
  const std::vector<std::uint8_t> held = held_nodes(ties);
  const std::size_t count = graph_.nodes.size();
  const auto is_ready = [&](std::uint32_t i) {
    return !held[i] && number_[i] == none && moved_[i] == i;
  };
  const auto is_known = [&](std::uint32_t i) { return number_[i] != none; };
  cut.place.assign(count, none);
  const auto take = [&](std::uint32_t i) {
    cut.place[i] = static_cast<std::uint32_t>(cut.graph.nodes.size());
    cut.graph.nodes.push_back(graph_.nodes[i]);
  };
  const auto take_first = [&](std::uint32_t i) {
    if (cut.place[i] != none) return;
    take(i);
    cut.rim.push_back(i);
  };
  const auto take_ends = [&](const auto& takes) {
    for (const Edge& link : graph_.edges)
      for (const std::size_t k : {0U, 1U})
        if (takes(link.node[k], link.node[1 - k])) take_first(link.node[k]);
  };
  take_ends(
      [&](std::uint32_t node, std::uint32_t other) { return is_known(node) && is_ready(other); });
  cut.known = cut.rim.size();
  take_ends([&](std::uint32_t node, std::uint32_t other) {
    return is_ready(node) && !is_ready(other) && !is_known(other);
  });
  for (std::uint32_t i = 0; i < count; ++i)
    if (is_ready(i) && cut.place[i] == none) take(i);
  cut.more_ends.resize(cut.rim.size());
  for (std::uint32_t i = 0; i < graph_.edges.size(); ++i) {
    const auto [from, to] = graph_.edges[i].node;
    if (cut.place[from] != none && cut.place[to] != none) {
      cut.graph.edges.push_back({{cut.place[from], cut.place[to]}, graph_.edges[i].site, {}});
      continue;
    }
    cut.stays.push_back(i);
    for (const std::uint32_t node : {from, to})
      if (cut.place[node] != none && cut.more_ends[cut.place[node]] < 3)
        ++cut.more_ends[cut.place[node]];
  }
  cut.has_ties = ranges::any_of(ties, [&](std::uint32_t tie) {
    const auto [from, to] = graph_.edges[tie].node;
    return cut.place[from] != none && cut.place[to] != none;
  });
  return cut;
}

AxisPart OpenGraph::next_part() {
  resolve();
  Cut next = cut();
  AxisPart part;
  part.begins = std::exchange(begins_, false);
  part.axis.method = "disks";
  part.axis.tolerance = problem_.tolerance;
  complete_part(next, part);
  keep(next);
  return part;
}

void OpenGraph::complete_part(Cut& cut, AxisPart& part) {
  Graph& graph = cut.graph;
  if (cut.has_ties) merge_ties(tree_, exact_, problem_.local_tolerance(), graph);
  if (!keeps_rim(cut)) {
    lost_ = true;
    return;
  }
  for (const Edge& link : graph.edges) --balance_[graph.nodes[link.node[0]].component];
  for (std::size_t i = cut.known; i < graph.nodes.size(); ++i) ++balance_[graph.nodes[i].component];
  statistics_ += std::exchange(graph.statistics, {});
  const auto doubtful = complete(boundary_, problem_.frame, problem_.frame.scale * slack_, graph);
  part.axis.nodes = std::move(graph.nodes);
  part.axis.edges = std::move(graph.edges);
  name_nodes(cut, part);
  name_sites(part);
  lost_ = lost_ || ranges::any_of(doubtful, [&](std::uint32_t edge) {
            return !touches_its_sites(part.axis, part.axis.edges[edge], slack_);
          });
}

/// Whether contracting ties has left those nodes as they are that other parts name as well. It has,
/// unless rounding finds a tie here that it has not found in the open graph.
bool OpenGraph::keeps_rim(const Cut& cut) const {
  const auto& nodes = cut.graph.nodes;
  if (nodes.size() < cut.rim.size()) return false;
  for (std::size_t i = 0; i < cut.rim.size(); ++i) {
    const Disk &now = nodes[i].disk, &before = graph_.nodes[cut.rim[i]].disk;
    if (now.center != before.center || now.radius != before.radius) return false;
  }
  return true;
}

/// Nodes get their numbers, and those on the rim their kinds: they have more edges.
void OpenGraph::name_nodes(const Cut& cut, AxisPart& part) {
  part.known = cut.known;
  part.nodes.reserve(part.axis.nodes.size());
  for (std::size_t i = 0; i < cut.known; ++i) part.nodes.push_back(number_[cut.rim[i]]);
  while (part.nodes.size() < part.axis.nodes.size()) part.nodes.push_back(given_++);
  std::vector<std::size_t> ends(cut.more_ends.begin(), cut.more_ends.end());
  for (const Edge& edge : part.axis.edges)
    for (const std::uint32_t node : edge.node)
      if (node < ends.size()) ++ends[node];
  for (std::size_t i = 0; i < cut.rim.size(); ++i) {
    Node& open = graph_.nodes[cut.rim[i]];
    if (i >= cut.known) {
      number_[cut.rim[i]] = part.nodes[i];
      open.kind = kind_of_degree(ends[i]);
    }
    part.axis.nodes[i].kind = open.kind;
  }
}

void OpenGraph::name_sites(AxisPart& part) {
  FirstPlaces places(2 * part.axis.edges.size());
  for (Edge& edge : part.axis.edges)
    for (std::uint32_t& site : edge.site) site = places.place_of(site);
  part.sites = std::move(places.numbers);
  part.axis.sites.reserve(part.sites.size());
  // The walk goes along both sides of the axis: two places in turn.
  std::array<std::size_t, 2> near{};
  for (const std::uint32_t site : part.sites) {
    std::size_t& point = near[part.axis.sites.size() % 2];
    point = point_of(numbers_, site, point);
    part.axis.sites.push_back(result_site(problem_.shape, numbers_, site, point));
  }
}

/// Keeps what has not been handed out, with the nodes that its edges name.
void OpenGraph::keep(const Cut& cut) {
  std::vector<std::uint8_t> stays(graph_.nodes.size());
  for (std::uint32_t i = 0; i < stays.size(); ++i)
    stays[i] = cut.place[i] == none && moved_[i] == i;
  for (const std::uint32_t link : cut.stays)
    for (const std::uint32_t node : graph_.edges[link].node) stays[node] = true;
  std::vector<std::uint32_t> place(graph_.nodes.size(), none);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < stays.size(); ++i) {
    if (!stays[i]) continue;
    graph_.nodes[count] = graph_.nodes[i];
    number_[count] = number_[i];
    waiting_[count] = waiting_[i];
    moved_[count] = count;
    place[i] = count++;
  }
  graph_.nodes.resize(count);
  number_.resize(count);
  waiting_.resize(count);
  moved_.resize(count);
  last_held_ = count;
  for_each_begun([&](Task& task) {
    task.node = place[task.node];
    ++last_held_;
  });
  for (const std::uint32_t bridge : half_met_) {
    End& end = ends_[bridge];
    end.node = place[end.node];
    if (end.link != none)
      end.link = static_cast<std::uint32_t>(
          std::lower_bound(cut.stays.begin(), cut.stays.end(), end.link) - cut.stays.begin());
  }
  for (std::uint32_t i = 0; i < cut.stays.size(); ++i) {
    Edge& link = graph_.edges[i] = graph_.edges[cut.stays[i]];
    for (std::uint32_t& node : link.node) node = place[node];
  }
  graph_.edges.resize(cut.stays.size());
}

bool OpenGraph::has_right_cycles() const {
  return ranges::all_of(balance_, [](std::int64_t b) { return b == 0; });
}

}  // namespace medial::disks
