#include "methods/lee/graph.h"

#include <algorithm>
#include <cmath>

#include "base/memory.h"
#include "site/bisector.h"

namespace medial::lee {
namespace {

/// The curve of an edge from `from` to `to`, its ends, in units of the input.
Edge result_edge(const Graph& graph, const LocalFrame& frame, std::uint32_t edge, const Disk& from,
                 const Disk& to) {
  const auto& [i, j] = graph[edge].element;
  const Elements& elements = graph.elements();
  const site::Control control =
      graph.is_spoke(edge)
          ? site::Control{{midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)}, 1}
          : site::control_of(elements.sites[i], elements.sites[j], from, to);
  return {{},
          {elements.originals[i], elements.originals[j]},
          {frame.to_input(control.point.center), frame.inverse * control.point.radius},
          control.weight};
}

Disk to_input(const LocalFrame& frame, const Disk& disk) {
  return {frame.to_input(disk.center), frame.inverse * disk.radius};
}

/// One more edge at a node.
void add_edge(NodeKind& kind, bool is_first) {
  kind = is_first                 ? NodeKind::leaf
         : kind == NodeKind::leaf ? NodeKind::site_change
                                  : NodeKind::branching;
}

/// Numbers a result's nodes in the order in which they are asked for.
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

  /// Makes the inner end of an edge its outer end.
  void join(std::uint32_t edge) { number_[edge] = joined; }
  bool is_joined(std::uint32_t edge) const { return number_[edge] == joined; }

 private:
  static constexpr std::uint32_t joined = none - 1;
  const Graph& graph_;
  const LocalFrame& frame_;
  std::vector<Node>& nodes_;
  std::vector<std::uint32_t> number_;
};

}  // namespace

Graph::Graph(Diagram& diagram, const std::vector<std::uint32_t>& last_edges, double tolerance)
    : diagram_(diagram), tolerance_(tolerance) {
  for (std::size_t l = 0; l < last_edges.size() && is_whole_; ++l)
    is_whole_ = close(elements().loops[l], last_edges[l]);
}

/// An edge is below the one that begins at its outer end in one of its two stacks, and on top of
/// the other. So stacks of earlier elements are turned over, those of later ones only walked down;
/// element by element backward, so that an edge is met in the former first.
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
  return count == 2 * std::size_t{end - begin} - 3;
}

void Graph::find_doubtful_edge(std::uint32_t edge) {
  const Disk &inner = disk(edge), &outer = disk(to(edge));
  if (!(inner.radius > 0 && outer.radius > 0)) return;
  const double limit = std::max(furthest * inner.radius, tolerance_);
  if (squared_norm(inner.center - outer.center) <= limit * limit || runs_backward(edge, tolerance_))
    doubtful_edges_.push_back(edge);
}

bool Graph::runs_backward(std::uint32_t edge, double slack) const {
  const auto& [first, second] = diagram_.edges[edge].element;
  const Vec2 way = disk(to(edge)).center - disk(edge).center;
  return dot(elements().sites[first].direction, way) > slack ||
         dot(elements().sites[second].direction, way) < -slack;
}

std::array<std::uint32_t, 2> Graph::loop_around(std::uint32_t element) const {
  const auto& loops = elements().loops;
  const auto after = std::upper_bound(
      loops.begin(), loops.end(), element,
      [&](std::uint32_t e, const Elements::ChainLoop& loop) { return e < begin_of(loop); });
  return {begin_of(*(after - 1)), end_of(*(after - 1))};
}

void complete(const Graph& graph, const LocalFrame& frame, VoronoiDiagram& diagram) {
  const Elements& elements = graph.elements();
  const std::size_t count = elements.size();
  diagram.edges.reserve(2 * count);
  diagram.nodes.reserve(2 * count);
  std::vector<std::uint32_t>& begin = diagram.face_begin;
  begin.assign(count + 1, 0);
  Numbers numbers(graph, frame, diagram.nodes);
  for (const Elements::ChainLoop& loop : elements.loops)
    graph.for_edges(loop, [&](std::uint32_t edge) {
      const std::uint32_t from = graph.from(edge), to = graph.to(edge);
      Edge made = result_edge(graph, frame, edge, graph.disk(from), graph.disk(to));
      made.node = {numbers.of_end(from, loop.component), numbers.of_end(to, loop.component)};
      for (const std::uint32_t site : made.site) ++begin[site + 1];
      diagram.edges.push_back({made, graph.is_spoke(edge)});
    });
  // Of an element's edges with earlier ones, the inner come first; with later ones, the outer.
  for (std::size_t i = 0; i < count; ++i) begin[i + 1] += begin[i];
  diagram.face_edges.resize(2 * diagram.edges.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  // Edges with a later first element come from further inward: the earlier partners by descending
  // index, then the later ones as they stand.
  for (std::size_t e = diagram.edges.size(); e-- > 0;)
    diagram.face_edges[next[diagram.edges[e].site[1]]++] = static_cast<std::uint32_t>(e);
  for (std::size_t e = 0; e < diagram.edges.size(); ++e)
    diagram.face_edges[next[diagram.edges[e].site[0]]++] = static_cast<std::uint32_t>(e);
}

void complete(Graph& graph, const LocalFrame& frame, double tolerance, MedialAxis& axis) {
  const Elements& elements = graph.elements();
  Numbers numbers(graph, frame, axis.nodes);
  // Where an edge ends, if those without length are left out; found again at once next time.
  const auto end_of = [&](std::uint32_t edge) {
    std::uint32_t end = graph.to(edge);
    while (numbers.is_joined(end)) end = graph.to(end);
    for (std::uint32_t at = edge; graph.to(at) != end;) {
      const std::uint32_t next = graph.to(at);
      graph.set_to(at, end);
      at = next;
    }
    return end;
  };
  std::size_t kept = 0;
  for (const Elements::ChainLoop& loop : elements.loops)
    kept +=
        2 * std::size_t{elements.chains[loop.end_chain] - elements.chains[loop.first_chain]} - 3;
  for (const site::Site& site : elements.sites) kept -= site.is_vertex() ? 2 : 0;
  for (const std::uint32_t edge : graph.doubtful_edges()) {
    const Disk &from = graph.disk(edge), &to = graph.disk(end_of(edge));
    if (squared_norm(from.center - to.center) > tolerance * tolerance ||
        std::abs(from.radius - to.radius) > tolerance)
      continue;
    numbers.join(edge);
    --kept;
  }
  double largest_residual = 0;
  reserve_large(axis.edges, kept);
  reserve_large(axis.nodes, kept + elements.loops.size());  // one tree a loop
  for (const Elements::ChainLoop& loop : elements.loops)
    graph.for_edges(loop, [&](std::uint32_t edge) {
      if (graph.is_spoke(edge) || numbers.is_joined(edge)) return;
      const std::uint32_t end = end_of(edge);
      const Disk& to = graph.disk(end);
      Edge made = result_edge(graph, frame, edge, graph.disk(edge), to);
      made.node = {numbers.of_end(edge, loop.component), numbers.of_end(end, loop.component)};
      axis.edges.push_back(made);
      // Of the three elements of a Voronoi point, all are of edges that end there.
      for (const std::uint32_t element : graph[edge].element)
        largest_residual = std::max(
            largest_residual,
            std::abs(site::carrier_distance(elements.sites[element], to.center) - to.radius));
    });
  axis.statistics.largest_residual = frame.inverse * largest_residual;
}

}  // namespace medial::lee
