#include "methods/lee/graph.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "axis/node_kinds.h"
#include "base/memory.h"
#include "site/bisector.h"

namespace medial::lee {
namespace {

/// The curve of an edge that ends at `from` and `to`.
site::Control control_of(const Graph& graph, std::uint32_t edge, const Disk& from, const Disk& to) {
  const auto& [i, j] = graph[edge].element;
  const Elements& elements = graph.elements();
  if (!graph.is_spoke(edge))
    return site::control_of(elements.sites[i], elements.sites[j], from, to);
  return {{midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)}, 1};
}

/// The edge with its curve, in units of the input.
Edge result_edge(const Graph& graph, const LocalFrame& frame, std::uint32_t edge,
                 const site::Control& control) {
  const auto& [i, j] = graph[edge].element;
  const std::vector<std::uint32_t>& originals = graph.elements().originals;
  return {{},
          {originals[i], originals[j]},
          {frame.to_input(control.point.center), frame.inverse * control.point.radius},
          control.weight};
}

constexpr double endless = std::numeric_limits<double>::infinity();

/// The largest gap or overlap between the disk in the middle of an edge and its elements, or their
/// carriers if a bridge has divided the elements but not the edge.
double residual_in_middle(const Graph& graph, std::uint32_t edge, const Disk& from,
                          const site::Control& control, const Disk& to) {
  const double scale = 1 / (2 + 2 * control.weight), weight = 2 * control.weight * scale;
  const Vec2 center = scale * (from.center + to.center) + weight * control.point.center;
  const double radius = scale * (from.radius + to.radius) + weight * control.point.radius;
  double residual = 0;
  for (const std::uint32_t i : graph[edge].element) {
    const site::Site& site = graph.elements().sites[i];
    const double away = graph.begins_at_bridge(edge)
                            ? site::carrier_distance(site, center)
                            : std::sqrt(site::squared_distance(site, center));
    const double off = std::abs(away - radius);
    if (!(off <= residual)) residual = std::isnan(off) ? endless : off;
  }
  return residual;
}

Disk to_input(const LocalFrame& frame, const Disk& disk) {
  return {frame.to_input(disk.center), frame.inverse * disk.radius};
}

/// Updates the kind of a node to which an edge is added.
void add_edge(NodeKind& kind, bool is_first) {
  kind = is_first                 ? NodeKind::leaf
         : kind == NodeKind::leaf ? NodeKind::site_change
                                  : NodeKind::branching;
}

/// Numbers a result's nodes in the order of the requests.
class Numbers {
 public:
  Numbers(const Graph& graph, const LocalFrame& frame, std::vector<Node>& nodes)
      : graph_(graph), frame_(frame), nodes_(nodes), number_(graph.places(), none) {}

  /// The number of an edge's end.
  std::uint32_t of_end(std::uint32_t node, std::uint32_t component) {
    std::uint32_t& number = number_[node];
    const bool is_first = number == none;
    if (is_first) {
      number = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back({to_input(frame_, graph_.disk(node)), component});
    }
    add_edge(nodes_[number].kind, is_first);
    return number;
  }

  /// Makes two ends one node. Returns false if both are nodes already.
  bool unite(std::uint32_t a, std::uint32_t b, std::uint32_t component) {
    if (number_[a] == none) std::swap(a, b);
    if (number_[b] != none) return false;
    if (number_[a] == none) of_end(a, component);
    number_[b] = number_[a];
    return true;
  }

  /// Merges the inner end of an edge with its outer end.
  void join(std::uint32_t edge) { number_[edge] = joined; }
  bool is_joined(std::uint32_t edge) const { return number_[edge] == joined; }

  /// The end of an edge, skipping edges without length; compresses the path for the next call.
  std::uint32_t end_past_joined(Graph& graph, std::uint32_t edge) const {
    std::uint32_t end = graph.to(edge);
    while (is_joined(end)) end = graph.to(end);
    for (std::uint32_t at = edge; graph.to(at) != end;) {
      const std::uint32_t next = graph.to(at);
      graph.set_to(at, end);
      at = next;
    }
    return end;
  }

 private:
  static constexpr std::uint32_t joined = none - 1;
  const Graph& graph_;
  const LocalFrame& frame_;
  std::vector<Node>& nodes_;
  std::vector<std::uint32_t> number_;
};

/// The two edges that begin at the disk of a bridge. They are mostly pieces of one edge, which
/// leads outward along the first from the end of the second.
struct Bridged {
  std::uint32_t edge = none, other = none;
  std::uint32_t component = 0;

  /// Whether they are pieces of one edge. If the bridge touches a joint, its disk is a node between
  /// two edges.
  bool are_one(const Graph& graph) const {
    const std::vector<std::uint32_t>& originals = graph.elements().originals;
    const auto& [i, j] = graph[edge].element;
    const auto& [k, l] = graph[other].element;
    return std::minmax(originals[i], originals[j]) == std::minmax(originals[k], originals[l]);
  }
};

std::vector<Bridged> bridged_edges(const Graph& graph) {
  const Elements& elements = graph.elements();
  std::vector<Bridged> all(elements.passages.size() / 2);
  if (all.empty()) return all;
  for (const Elements::ChainLoop& loop : elements.loops)
    graph.for_edges(loop, [&](std::uint32_t edge) {
      if (!graph.begins_at_bridge(edge)) return;
      Bridged& one = all[elements.passage_from(graph[edge].element[0]).bridge];
      (one.edge == none ? one.edge : one.other) = edge;
      one.component = loop.component;
    });
  return all;
}

/// The edges around every site. Around each element: edges shared with earlier elements, inner ones
/// first, then edges shared with later ones, outer ones first. If bridges touch a site, its
/// elements follow each other.
class Faces {
 public:
  Faces(const Graph& graph, VoronoiDiagram& diagram)
      : graph_(graph), elements_(graph.elements()), diagram_(diagram) {
    order_elements();
    next_.resize(elements_.size(), {0, 0});
    for (const Elements::ChainLoop& loop : elements_.loops)
      graph.for_edges(loop, [&](std::uint32_t edge) {
        const auto& [first, second] = graph[edge].element;
        ++next_[first][1];
        ++next_[second][0];
      });
    std::uint32_t at = 0;
    diagram.face_begin.assign(1, 0);
    for (std::size_t site = 0; site < diagram.sites.size(); ++site) {
      for (std::uint32_t i = first_[site]; i < first_[site + 1]; ++i) {
        const auto [earlier, later] = next_[order_[i]];
        next_[order_[i]] = {at + earlier, at + earlier};
        at += earlier + later;
      }
      diagram.face_begin.push_back(at);
    }
    diagram.face_edges.resize(at);
  }

  /// The node where an edge begins: the same one for both spokes of a vertex.
  std::uint32_t from(std::uint32_t edge) const {
    const std::uint32_t first = graph_[edge].element[0];
    if (!graph_.is_spoke(edge) || !elements_.is_vertex(first)) return edge;
    return 2 * (order_[first_[elements_.originals[first]]] - 1);
  }

  /// Edges are added in the order of Graph::for_edges().
  void add(const std::array<std::uint32_t, 2>& element, std::uint32_t number) {
    diagram_.face_edges[--next_[element[1]][0]] = number;
    diagram_.face_edges[next_[element[0]][1]++] = number;
  }

  /// An edge that a bridge divides is stored twice, once for each piece.
  void join_pieces() {
    std::vector<std::uint32_t>& edges = diagram_.face_edges;
    std::uint32_t kept = 0, begin = 0;
    for (std::size_t site = 0; site < diagram_.sites.size(); ++site) {
      const std::uint32_t end = diagram_.face_begin[site + 1], first = kept;
      for (std::uint32_t i = begin; i < end; ++i)
        if (kept == first || edges[i] != edges[kept - 1]) edges[kept++] = edges[i];
      diagram_.face_begin[site + 1] = kept;
      begin = end;
    }
    edges.resize(kept);
  }

 private:
  /// Sorts the elements by their sites. The list of a hole begins and ends within a vertex: its
  /// last pieces are the first ones of the site.
  void order_elements() {
    first_.assign(diagram_.sites.size() + 2, 0);
    for (const std::uint32_t site : elements_.originals)
      if (site != none) ++first_[site + 2];
    for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
    order_.resize(first_.back());
    for (std::uint32_t i = 0; i < elements_.size(); ++i)
      if (!elements_.is_of_bridge(i)) order_[first_[elements_.originals[i] + 1]++] = i;
    for (std::size_t site = 0; site < diagram_.sites.size(); ++site) {
      const auto begin = order_.begin() + first_[site], end = order_.begin() + first_[site + 1];
      if (end - begin < 2) continue;
      std::rotate(
          begin,
          std::find_if(begin, end,
                       [&](std::uint32_t i) { return i == 0 || !elements_.is_of_bridge(i - 1); }),
          end);
    }
  }

  const Graph& graph_;
  const Elements& elements_;
  VoronoiDiagram& diagram_;
  std::vector<std::uint32_t> first_, order_;  ///< the elements of each site
  /// The position of each element's next edge: with an earlier element, and with a later one.
  std::vector<std::array<std::uint32_t, 2>> next_;
};

}  // namespace

Graph::Graph(Diagram& diagram, const std::vector<std::uint32_t>& last_edges, double tolerance)
    : diagram_(diagram), tolerance_(tolerance) {
  for (std::size_t l = 0; l < last_edges.size() && is_whole_; ++l)
    is_whole_ = close(elements().loops[l], last_edges[l]);
}

/// An edge is below the edge that begins at its outer end in one of its two stacks, and on top of
/// it in the other. So the stacks of earlier elements are reversed, and those of later ones only
/// traversed. Elements are visited in reverse order, so that an edge is first met in a stack of the
/// former kind.
bool Graph::close(const Elements::ChainLoop& loop, std::uint32_t last_edge) {
  const std::uint32_t begin = begin_of(loop), end = end_of(loop);
  const std::uint32_t last_corner = diagram_.free[loop.first_chain].first;
  if (last_corner == none) return false;  // too many edges
  diagram_.edges[last_corner] = {
      {begin, end - 1}, {none, none}, {elements().sites[begin].point, 0}};
  std::size_t count = 0;
  for (std::uint32_t i = end; i-- > begin;) {
    std::uint32_t outer = none;
    for (std::uint32_t edge = diagram_.top[i][0]; edge != none;
         edge = diagram_.edges[edge].inward[0]) {
      std::uint32_t& to = diagram_.edges[edge].inward[1];
      if (edge == last_edge && to == none && outer == none)
        to = last_corner;
      else if ((to == none) == (outer == none))
        return false;  // an edge without an end
      else if (outer != none)
        to = outer;
      outer = edge;
      ++count;
      find_doubtful_edge(edge);
    }
    outer = none;
    for (std::uint32_t edge = diagram_.top[i][1]; edge != none;) {
      std::uint32_t& inward = diagram_.edges[edge].inward[1];
      const std::uint32_t next = inward;
      inward = outer;
      outer = edge;
      edge = next;
    }
  }
  return count == 2 * std::size_t{loop.size} - 3;
}

void Graph::find_doubtful_edge(std::uint32_t edge) {
  const Disk &inner = disk(edge), &outer = disk(to(edge));
  if (!(inner.radius > 0 && outer.radius > 0) || begins_at_bridge(edge)) return;
  const double limit = std::max(furthest * inner.radius, tolerance_);
  if (squared_norm(inner.center - outer.center) <= limit * limit || runs_backward(edge, tolerance_))
    doubtful_edges_.push_back(edge);
}

bool Graph::runs_backward(std::uint32_t edge, double slack) const {
  const auto& [first, second] = diagram_.edges[edge].element;
  const Vec2 from = disk(edge).center, end = disk(to(edge)).center;
  const auto forward = [&](const site::Site& site) {
    if (!site.is_vertex()) return advance(site, from, end);
    // Around a vertex, normals turn right.
    const Vec2 a = from - site.point, b = end - site.point;
    const double further = std::sqrt(std::max(squared_norm(a), squared_norm(b)));
    return further > 0 ? cross(b, a) / further : 0;
  };
  return forward(elements().sites[first]) > slack || forward(elements().sites[second]) < -slack;
}

void complete(const Graph& graph, const LocalFrame& frame, VoronoiDiagram& diagram) {
  const Elements& elements = graph.elements();
  diagram.edges.reserve(2 * std::size_t{elements.size()});
  diagram.nodes.reserve(2 * std::size_t{elements.size()});
  Faces faces(graph, diagram);
  Numbers numbers(graph, frame, diagram.nodes);
  const std::vector<Bridged> bridged = bridged_edges(graph);
  std::vector<std::uint32_t> number_of(bridged.size(), none);
  for (const Elements::ChainLoop& loop : elements.loops)
    graph.for_edges(loop, [&](std::uint32_t edge) {
      auto number = static_cast<std::uint32_t>(diagram.edges.size());
      std::uint32_t from = faces.from(edge);
      if (graph.begins_at_bridge(edge)) {
        const std::uint32_t bridge = elements.passage_from(graph[edge].element[0]).bridge;
        const Bridged& one = bridged[bridge];
        const bool are_one = one.are_one(graph);
        from = are_one ? graph.to(one.other) : one.edge;
        if (are_one && edge == one.other) number = number_of[bridge];
        number_of[bridge] = number;
      }
      faces.add(graph[edge].element, number);
      if (number < diagram.edges.size()) return;
      const std::uint32_t to = graph.to(edge);
      Edge made = result_edge(graph, frame, edge,
                              control_of(graph, edge, graph.disk(from), graph.disk(to)));
      made.node = {numbers.of_end(from, loop.component), numbers.of_end(to, loop.component)};
      diagram.edges.push_back({made, graph.is_spoke(edge)});
    });
  if (!bridged.empty()) faces.join_pieces();
}

namespace {

/// Whether two nodes are equal within the tolerance.
bool is_one(const Disk& a, const Disk& b, double tolerance) {
  return squared_norm(a.center - b.center) <= tolerance * tolerance &&
         std::abs(a.radius - b.radius) <= tolerance;
}

/// The number of edges of the axis if each has a length, to reserve memory.
std::size_t most_edges(const Elements& elements) {
  std::size_t kept = 0;
  for (const Elements::ChainLoop& loop : elements.loops) kept += 2 * std::size_t{loop.size} - 3;
  if (elements.have_arcs()) {
    for (const Beside joint : elements.joints) kept -= joint != Beside::no ? 1 : 0;
    for (const Elements::ChainLoop& loop : elements.loops)
      kept -= elements.around[elements.chains[loop.first_chain]] != Beside::no ? 1 : 0;
  } else {
    for (const site::Site& site : elements.sites) kept -= site.is_vertex() ? 2 : 0;
    kept += elements.passages.size();  // at each passage, a vertex has one spoke
  }
  return kept;
}

/// Calls `add` for the edge that a bridge divides, or for both edges if the bridge's disk is a
/// node.
template <class Add, class BecomeOne>
void add_bridged(Graph& graph, const Bridged& one, Numbers& numbers, const Add& add,
                 const BecomeOne& become_one) {
  const auto end_of = [&](std::uint32_t edge) { return numbers.end_past_joined(graph, edge); };
  if (one.are_one(graph)) return add(one.edge, end_of(one.other), one.component);
  numbers.unite(one.edge, one.other, one.component);
  for (const std::uint32_t edge : {one.edge, one.other})
    if (!become_one(edge, end_of(edge), one)) add(edge, edge, one.component);
}

}  // namespace

double complete(Graph& graph, const LocalFrame& frame, double tolerance, MedialAxis& axis) {
  const Elements& elements = graph.elements();
  Numbers numbers(graph, frame, axis.nodes);
  const auto end_of = [&](std::uint32_t edge) { return numbers.end_past_joined(graph, edge); };
  std::size_t kept = most_edges(elements);
  for (const std::uint32_t edge : graph.doubtful_edges()) {
    if (!is_one(graph.disk(edge), graph.disk(end_of(edge)), tolerance)) continue;
    numbers.join(edge);
    --kept;
  }
  std::vector<Bridged> bridged = bridged_edges(graph);
  const auto become_one = [&](std::uint32_t from, std::uint32_t to, const Bridged& one) {
    return from != to && is_one(graph.disk(from), graph.disk(to), tolerance) &&
           numbers.unite(from, to, one.component);
  };
  const auto has_no_length = [&](const Bridged& one) {
    return become_one(end_of(one.other), end_of(one.edge), one);
  };
  bridged.erase(std::remove_if(bridged.begin(), bridged.end(), has_no_length), bridged.end());
  double largest_residual = 0, in_middle = 0;
  reserve_large(axis.edges, kept);
  reserve_large(axis.nodes, kept + elements.loops.size());  // one tree per loop
  const auto add = [&](std::uint32_t edge, std::uint32_t from, std::uint32_t component) {
    const std::uint32_t end = end_of(edge);
    const Disk& to = graph.disk(end);
    const site::Control control = control_of(graph, edge, graph.disk(from), to);
    Edge made = result_edge(graph, frame, edge, control);
    made.node = {numbers.of_end(from, component), numbers.of_end(end, component)};
    axis.edges.push_back(made);
    if (elements.have_arcs())
      in_middle =
          std::max(in_middle, residual_in_middle(graph, edge, graph.disk(from), control, to));
    // Each of the three elements of a Voronoi point belongs to an edge that ends there.
    for (const std::uint32_t element : graph[edge].element)
      largest_residual = std::max(
          largest_residual,
          std::abs(site::carrier_distance(elements.sites[element], to.center) - to.radius));
  };
  for (const Elements::ChainLoop& loop : elements.loops) {
    const std::size_t before = axis.edges.size();
    std::uint32_t inside = none;
    graph.for_edges(loop, [&](std::uint32_t edge) {
      if (graph.is_beside_axis(edge) || graph.begins_at_bridge(edge)) return;
      inside = edge;
      if (!numbers.is_joined(edge)) add(edge, edge, loop.component);
    });
    // All arcs are on one circle.
    if (axis.edges.size() == before && inside != none)
      numbers.of_end(end_of(inside), loop.component);
  }
  for (const Bridged& one : bridged) add_bridged(graph, one, numbers, add, become_one);
  if (!elements.passages.empty()) set_node_kinds(axis);
  axis.statistics.largest_residual = frame.inverse * largest_residual;
  return in_middle;
}

}  // namespace medial::lee
