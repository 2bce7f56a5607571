#include "engines/lee/graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/memory.h"
#include "geometry/bisector.h"

namespace medial::lee {
namespace {

/// Numbers the nodes: each is the inner end of one edge, but for the two spokes of a reflex vertex,
/// which are the first edges of the vertex's chain for ever.
class Numbering {
 public:
  Numbering(const Diagram& diagram, Graph& graph)
      : diagram_(diagram), graph_(graph), number_(diagram.edges.size(), none) {}

  void add(std::uint32_t place, std::uint32_t component) {
    const ListEdge& edge = diagram_.edges[place];
    const bool second_spoke =
        diagram_.is_spoke(edge) && diagram_.elements.is_vertex(edge.element[0]);
    if (second_spoke) {
      number_[place] = number_[2 * (edge.element[0] - 1)];
    } else {
      number_[place] = add_node(edge.inner, edge.element, component);
    }
  }
  std::uint32_t add_node(const Disk& disk, const std::array<std::uint32_t, 2>& element,
                         std::uint32_t component) {
    graph_.nodes.push_back(disk);
    graph_.touched.push_back({element[0], element[1], element[1]});
    graph_.component.push_back(component);
    return static_cast<std::uint32_t>(graph_.nodes.size() - 1);
  }
  std::uint32_t operator[](std::uint32_t place) const { return number_[place]; }

 private:
  const Diagram& diagram_;
  Graph& graph_;
  std::vector<std::uint32_t> number_;
};

geometry::Control curve(const Graph& graph, const Elements& elements, const Graph::Edge& edge) {
  const Disk &from = graph.nodes[edge.from], &to = graph.nodes[edge.to];
  if (edge.spoke) return {{midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)}, 1};
  return geometry::control_of(elements.sites[edge.element[0]], elements.sites[edge.element[1]],
                              from, to);
}

Edge result_edge(const Graph& graph, const Elements& elements, const Frame& frame,
                 const Graph::Edge& edge) {
  const geometry::Control control = curve(graph, elements, edge);
  return {{edge.from, edge.to},
          {elements.originals[edge.element[0]], elements.originals[edge.element[1]]},
          {frame.to_input(control.point.center), frame.inverse * control.point.radius},
          control.weight};
}

Disk to_input(const Frame& frame, const Disk& disk) {
  return {frame.to_input(disk.center), frame.inverse * disk.radius};
}

/// Nodes that turned out to be one.
class Nodes {
 public:
  explicit Nodes(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) { parent_[find(j)] = find(i); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

Graph graph_of(const Diagram& diagram, const std::vector<std::uint32_t>& last_edges) {
  const Elements& elements = diagram.elements;
  Graph graph;
  reserve_large(graph.nodes, diagram.edges.size());
  reserve_large(graph.touched, diagram.edges.size());
  reserve_large(graph.component, diagram.edges.size());
  reserve_large(graph.edges, diagram.edges.size());
  Numbering number(diagram, graph);
  for (std::size_t l = 0; l < elements.loops.size(); ++l) {
    const Elements::Loop& loop = elements.loops[l];
    const std::uint32_t begin = elements.chains[loop.first_chain],
                        end = elements.chains[loop.end_chain];
    const auto for_all = [&](const auto& work) {
      for (std::uint32_t i = begin; i < end; ++i)
        for (std::uint32_t place = diagram.top[i][0]; place != none;
             place = diagram.edges[place].inward[0])
          work(place);
    };
    for_all([&](std::uint32_t place) { number.add(place, loop.component); });
    const std::uint32_t last_corner =
        number.add_node({elements.sites[begin].point, 0}, {begin, end - 1}, loop.component);
    const std::size_t edges_before = graph.edges.size();
    for_all([&](std::uint32_t place) {
      const ListEdge& edge = diagram.edges[place];
      const bool terminating = place == last_edges[l];
      if ((edge.outer == none) != terminating || (!terminating && number[edge.outer] == none))
        throw std::runtime_error("a Voronoi edge has no end");
      const std::uint32_t to = terminating ? last_corner : number[edge.outer];
      graph.edges.push_back({number[place], to, edge.element, diagram.is_spoke(edge)});
      if (terminating) return;
      std::array<std::uint32_t, 3>& touched = graph.touched[to];
      const bool shares_first = edge.element[0] == touched[0] || edge.element[0] == touched[1];
      touched[2] = edge.element[shares_first ? 1 : 0];
    });
    if (graph.edges.size() - edges_before != 2 * std::size_t{end - begin} - 3)
      throw std::runtime_error("a Voronoi diagram has too few edges");
  }
  return graph;
}

void complete(const Graph& graph, const Elements& elements, const Frame& frame,
              VoronoiDiagram& diagram) {
  std::vector<std::uint8_t> degree(graph.nodes.size(), 0);
  diagram.edges.reserve(graph.edges.size());
  for (const Graph::Edge& edge : graph.edges) {
    diagram.edges.push_back({result_edge(graph, elements, frame, edge), edge.spoke});
    for (const std::uint32_t node : {edge.from, edge.to}) ++degree[node];
  }
  diagram.nodes.reserve(graph.nodes.size());
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    diagram.nodes.push_back({to_input(frame, graph.nodes[i]), graph.component[i],
                             degree[i] == 1   ? NodeKind::leaf
                             : degree[i] == 2 ? NodeKind::site_change
                                              : NodeKind::branching});
  // Of an element's edges with earlier ones, the inner come first; with later ones, the outer.
  const std::size_t count = elements.size();
  std::vector<std::uint32_t>& begin = diagram.face_begin;
  begin.assign(count + 1, 0);
  for (const Graph::Edge& edge : graph.edges)
    for (const std::uint32_t element : edge.element) ++begin[elements.originals[element] + 1];
  for (std::size_t i = 0; i < count; ++i) begin[i + 1] += begin[i];
  diagram.face_edges.resize(2 * graph.edges.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  // Edges with a later first element come from further inward: the earlier partners by descending
  // index, then the later ones as they stand.
  for (std::size_t e = graph.edges.size(); e-- > 0;)
    diagram.face_edges[next[elements.originals[graph.edges[e].element[1]]]++] =
        static_cast<std::uint32_t>(e);
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    diagram.face_edges[next[elements.originals[graph.edges[e].element[0]]]++] =
        static_cast<std::uint32_t>(e);
}

void complete(const Graph& graph, const Elements& elements, const Frame& frame, double tolerance,
              MedialAxis& axis) {
  Nodes nodes(graph.nodes.size());
  const auto coincide = [&](const Disk& a, const Disk& b) {
    // A corner stays a leaf, however thin the shape is there.
    return a.radius > 0 && b.radius > 0 &&
           squared_norm(a.center - b.center) <= tolerance * tolerance &&
           std::abs(a.radius - b.radius) <= tolerance;
  };
  constexpr std::uint32_t unused = none;
  std::vector<std::uint32_t> number(graph.nodes.size(), unused);
  std::size_t kept = 0;
  for (const Graph::Edge& edge : graph.edges) {
    if (edge.spoke) continue;
    const std::uint32_t from = nodes.find(edge.from), to = nodes.find(edge.to);
    if (coincide(graph.nodes[from], graph.nodes[to]))
      nodes.join(from, to);
    else
      ++kept;
  }
  std::vector<std::uint8_t> degree;
  double largest_residual = 0;
  reserve_large(axis.edges, kept);
  reserve_large(axis.nodes, kept + elements.loops.size());  // one tree a loop
  degree.reserve(kept + elements.loops.size());
  const auto number_of = [&](std::uint32_t node) {
    if (number[node] == unused) {
      number[node] = static_cast<std::uint32_t>(axis.nodes.size());
      axis.nodes.push_back({to_input(frame, graph.nodes[node]), graph.component[node]});
      degree.push_back(0);
    }
    if (degree[number[node]] < 3) ++degree[number[node]];
    return number[node];
  };
  for (Graph::Edge edge : graph.edges) {
    edge.from = nodes.find(edge.from);
    edge.to = nodes.find(edge.to);
    if (edge.spoke || edge.from == edge.to) continue;
    Edge made = result_edge(graph, elements, frame, edge);
    made.node = {number_of(edge.from), number_of(edge.to)};
    axis.edges.push_back(made);
    for (const std::uint32_t element : edge.element)
      for (const std::uint32_t node : {edge.from, edge.to})
        largest_residual = std::max(
            largest_residual,
            std::abs(geometry::carrier_distance(elements.sites[element], graph.nodes[node].center) -
                     graph.nodes[node].radius));
  }
  for (std::size_t i = 0; i < degree.size(); ++i)
    axis.nodes[i].kind = degree[i] <= 1   ? NodeKind::leaf
                         : degree[i] == 2 ? NodeKind::site_change
                                          : NodeKind::branching;
  axis.statistics.largest_residual = frame.inverse * largest_residual;
}

}  // namespace medial::lee
