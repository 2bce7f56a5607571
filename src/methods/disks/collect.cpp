#include "methods/disks/collect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "axis/sites.h"
#include "axis/statistics.h"
#include "base/compat.h"
#include "base/fill_gaps.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "base/numbers_where.h"
#include "base/pair.h"
#include "base/threads.h"
#include "medial/query.h"
#include "site/bisector.h"
#include "site/lanes.h"

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
  std::vector<std::pair<Chunk*, std::uint32_t>> stack;
  placed.reserve(chunks.size());
  stack.reserve(chunks.size());
  for (std::size_t i = chunks.size(); i-- > 0;) stack.emplace_back(chunks[i].get(), none);
  while (!stack.empty()) {
    const auto [chunk, parent] = stack.back();
    stack.pop_back();
    placed.push_back({chunk, parent, nodes, edges});
    nodes += static_cast<std::uint32_t>(chunk->nodes.size() - 1);
    edges += static_cast<std::uint32_t>(chunk->links.size());
    const Placed self = placed.back();
    for (std::size_t i = chunk->children.size(); i-- > 0;) {
      Chunk* child = chunk->children[i].get();
      stack.emplace_back(child, self.node(child->parent_node));
    }
  }
  return placed;
}

/// How the two ends of the axis that meet at each bridge are joined: two edges become one, or a
/// node takes the other's place.
struct Gluing {
  WorkVector<std::uint32_t> number;  ///< of each node: which one of the axis it becomes
  std::vector<bool> node_stays;      ///< of those that become one, one
  std::vector<bool> edge_stays;
  std::vector<std::uint32_t> gone;                     ///< edges that do not, increasing
  std::vector<std::array<std::uint32_t, 2>> passages;  ///< edges that stay, and their bridges
};

Gluing glue(const std::vector<Placed>& placed, std::size_t bridge_count, std::uint32_t node_count,
            std::uint32_t edge_count, bool with_passages) {
  struct End {
    std::uint32_t node = none, edge = none;
    std::uint32_t before = none;  ///< the node that the edge comes from
  };
  WorkVector<std::array<End, 2>> ends(bridge_count);
  for (const Placed& p : placed) {
    for (const BridgeEnd& end : p.chunk->bridge_ends) {
      auto& pair = ends[end.bridge];
      End& slot = pair[0].node == none ? pair[0] : pair[1];
      slot.node = p.node(end.node);
      if (end.edge == BridgeEnd::no_edge) continue;
      slot.edge = p.first_edge + end.edge;
      slot.before = p.node(p.chunk->links[end.edge].node[0]);
    }
  }
  Gluing result;
  WorkVector<std::uint32_t>& moved = result.number;
  moved.resize(node_count);
  std::iota(moved.begin(), moved.end(), 0U);
  const auto target = [&](std::uint32_t node) {
    while (moved[node] != node) node = moved[node] = moved[moved[node]];
    return node;
  };
  result.edge_stays.assign(edge_count, true);
  // The node at the end of an edge has no other.
  for (std::uint32_t bridge = 0; bridge < bridge_count; ++bridge) {
    const auto& [a, b] = ends[bridge];
    if (a.node == none || b.node == none) continue;
    if (a.edge != none && b.edge != none) {
      if (with_passages) result.passages.push_back({a.edge, bridge});
      moved[a.node] = moved[b.node] = b.before;
      result.edge_stays[b.edge] = false;
      result.gone.push_back(b.edge);
    } else if (a.edge != none) {
      moved[a.node] = b.node;
    } else if (b.edge != none) {
      moved[b.node] = a.node;
    } else {
      moved[target(b.node)] = target(a.node);
    }
  }
  ranges::sort(result.passages);
  ranges::sort(result.gone);
  for (std::uint32_t i = 0; i < node_count; ++i) moved[i] = target(i);
  result.node_stays.resize(node_count);
  WorkVector<std::uint32_t> number(node_count);
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < node_count; ++i) {
    if (moved[i] != i) continue;
    result.node_stays[i] = true;
    number[i] = kept++;
  }
  for (std::uint32_t& node : moved) node = number[node];
  return result;
}

/// How many of a chunk's nodes or edges, from `first` on, stay; all where nothing is joined.
std::size_t count_of(const std::vector<bool>& stays, std::uint32_t first, std::size_t count) {
  if (stays.empty()) return count;
  const auto begin = stays.begin() + first;
  return static_cast<std::size_t>(
      std::count(begin, begin + static_cast<std::ptrdiff_t>(count), true));
}

/// Fills a vector with what each chunk has, chunk after chunk: count(chunk) elements, which
/// write(chunk, to) writes. A few chunks at a time, so that what they have is freed before more
/// memory is touched.
template <class T, class Count, class Write>
void gather(const std::vector<Placed>& placed, std::vector<T>& all, std::size_t spare,
            const Count& count, const Write& write) {
  if (placed.size() == 1) {  // as most small shapes: without a list
    reserve_large(all, count(placed[0]) + spare);
    all.resize(count(placed[0]));
    return write(placed[0], all.data());
  }
  constexpr std::size_t of_thread = 1 << 12, most = 1 << 15;
  const std::size_t at_a_time =
      std::min(most, of_thread * static_cast<std::size_t>(effective_threads(0)));
  std::vector<std::size_t> begin(placed.size() + 1);  // of each chunk
  for (std::size_t i = 0; i < placed.size(); ++i) begin[i + 1] = begin[i] + count(placed[i]);
  reserve_large(all, begin.back() + spare);
  for (std::size_t first = 0, last = 0; first < placed.size(); first = last) {
    while (last < placed.size() && begin[last] < begin[first] + at_a_time) ++last;
    touch_in_parallel(all, begin[first], begin[last]);
    all.resize(begin[last]);
    parallel_for(last - first,
                 [&](std::size_t i) { write(placed[first + i], all.data() + begin[first + i]); });
  }
}

/// Two disks of an edge, such as those at its ends.
struct TwoDisks {
  TwoDisks(const Disk& from, const Disk& to, double a_slack)
      : slack(a_slack),
        x{from.center.x, to.center.x},
        y{from.center.y, to.center.y},
        radius{from.radius, to.radius} {
    const Pair least = radius - slack, most = radius + slack;
    squared_least = larger(least, both(0)) * larger(least, both(0));
    squared_most = most * most;
  }

  bool touch(const site::Site& left, const site::Site& right) const {
    return touch(left) && touch(right);
  }
  /// Whether both touch a site from its inside, give or take the slack.
  bool touch(const site::Site& site) const {
    if (site.is_arc()) return touches_arc(site);
    const Pair dx = x - site.point.x, dy = y - site.point.y;
    const Pair along = site.direction.x * dx + site.direction.y * dy;
    const Pair height = site.direction.x * dy - site.direction.y * dx;
    const Pair foot = smaller(larger(along, both(0)), both(site.length));
    const Pair beside_x = dx - foot * site.direction.x, beside_y = dy - foot * site.direction.y;
    const Pair squared = beside_x * beside_x + beside_y * beside_y;
    // Nor do they lie behind the site, where they get through a gap that rounding has closed.
    // False for no number, too.
    return is_between(squared) && all(height >= -slack);
  }

 private:
  /// The arc and its circle: next to the centre a disk may touch the arc's end while the circle is
  /// far away there, and the edge, which lies on the bisector of the circles, as well.
  bool touches_arc(const site::Site& arc) const {
    const auto [distance, squared] = site::distances_from_arc(arc, x, y);
    return is_between(squared) && all(size_of(distance - radius) <= slack);
  }
  bool is_between(Pair squared) const {
    return all(squared >= squared_least) && all(squared <= squared_most);
  }

  double slack;
  Pair x, y, radius, squared_least, squared_most;
};

}  // namespace

Graph collect(std::vector<std::unique_ptr<Chunk>>& chunks, std::span<const Bridge> bridges,
              std::size_t spare_nodes, bool with_passages) {
  Graph graph;
  std::uint32_t node_count = 0, edge_count = 0;
  const std::vector<Placed> placed = place(chunks, node_count, edge_count);
  const bool glued = !bridges.empty();
  // Some megabytes are used again sooner than the system could clear others.
  constexpr std::uint32_t few = 1 << 18;
  const bool gives_back = node_count + edge_count > few;
  const Gluing gluing =
      glued ? glue(placed, bridges.size(), node_count, edge_count, with_passages) : Gluing{};

  const auto collect_nodes = [&] {
    const auto count = [&](const Placed& p) {
      return count_of(gluing.node_stays, p.first_node, p.chunk->nodes.size() - 1);
    };
    gather(placed, graph.nodes, spare_nodes, count, [&](const Placed& p, Node* to) {
      p.chunk->nodes.drain(gives_back, [&](std::size_t i, const Disk& disk) {
        if (i == 0 || (glued && !gluing.node_stays[p.first_node + i - 1])) return;
        to->disk = disk;  // a leaf, as all are at first
        to++->component = p.chunk->component;
      });
    });
  };
  const auto collect_edges = [&] {
    const auto number = [&](std::uint32_t node) { return glued ? gluing.number[node] : node; };
    const auto count = [&](const Placed& p) {
      return count_of(gluing.edge_stays, p.first_edge, p.chunk->links.size());
    };
    gather(placed, graph.edges, 0, count, [&](const Placed& p, Edge* to) {
      p.chunk->links.drain(gives_back, [&](std::size_t i, const Link& link) {
        if (glued && !gluing.edge_stays[p.first_edge + i]) return;
        to->node = {number(p.node(link.node[0])), number(p.node(link.node[1]))};
        to++->site = link.site;
      });
    });
  };
  in_parallel(collect_nodes, collect_edges);
  for (const auto& [edge, bridge] : gluing.passages) {
    const auto before = ranges::lower_bound(gluing.gone, edge) - gluing.gone.begin();
    graph.passages.push_back({edge - static_cast<std::uint32_t>(before), bridges[bridge].disk});
  }
  for (const auto& [chunk, parent, first_node, first_edge] : placed) {
    graph.statistics += chunk->statistics;
    graph.lost.insert(graph.lost.end(), chunk->lost.begin(), chunk->lost.end());
  }
  chunks.clear();
  return graph;
}

namespace {

/// Whether a disk is an arc's own, which an axis leads to.
bool is_own_circle(const site::Site& site, const Disk& disk, double tolerance) {
  return site.curvature > 0 &&
         squared_norm(disk.center - site::focus_of(site)) <= tolerance * tolerance;
}

/// Whether a disk touches all that lies between its feet on two sites of a run within the
/// tolerance, without a corner or a whole convex arc: so an edge that leads on from it would only
/// reach a joint, where an axis has no leaf.
bool touches_all_between(const Boundary& boundary, const Boundary::SiteRange& run, const Disk& disk,
                         std::uint32_t first, std::uint32_t last, double tolerance) {
  const auto touches = [&](Vec2 place) {
    return std::abs(distance(disk.center, place) - disk.radius) <= tolerance;
  };
  const auto is_edge = [&](std::uint32_t i) { return boundary.elements[i] == Element::edge; };
  for (std::uint32_t i = first;; i = run.after(i)) {
    const site::Site& site = boundary.sites[i];
    if (boundary.elements[i] == Element::bridge) return false;
    double begin = 0, end = site.length;
    if (site.is_arc()) {
      // The feet may lie on any piece of the arc.
      const bool at_first = boundary.is_same(i, first), at_last = boundary.is_same(i, last);
      if (!at_first && !at_last && site.curvature > 0) return false;
      const double foot = std::clamp(site::carrier_parameter(site, disk.center), 0.0, site.length);
      if (at_first) begin = foot;
      if (at_last) end = foot;
      // Along a quarter of a circle, three places bound how far the disk is away.
      if (begin < end && !touches(site.at(0.5 * (begin + end)))) return false;
    }
    if (i == last || end < site.length) return true;
    const std::uint32_t next = run.after(i);
    if (begin == site.length && boundary.is_same(i, next)) continue;
    const bool at_corner = is_edge(i) && is_edge(next) && boundary.joint(i) == site::Joint::corner;
    if (at_corner || !touches(site.end())) return false;
  }
}

}  // namespace

void remove_spurs(const Boundary& boundary, double tolerance, Graph& graph,
                  std::span<const std::uint32_t> borders) {
  // Of each node, how many edges end there, and the exclusive or of their numbers: the one edge of
  // a leaf.
  std::vector<std::array<std::uint32_t, 2>> ends(graph.nodes.size());
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e)
    for (const std::uint32_t node : graph.edges[e].node) {
      ++ends[node][0];
      ends[node][1] ^= e;
    }
  for (const std::uint32_t node : borders) ++ends[node][0];
  const auto is_spur = [&](const Edge& edge, std::uint32_t leaf) {
    const auto [left, right] = edge.site;
    // Most leaves are corners.
    if (boundary.sides == Sides::both || !(graph.nodes[leaf].disk.radius > 0)) return false;
    const Disk& end = graph.nodes[leaf].disk;
    if (is_own_circle(boundary.sites[left], end, tolerance) ||
        is_own_circle(boundary.sites[right], end, tolerance))
      return false;
    const bool is_end = leaf == edge.node[1];
    const Node& root = graph.nodes[edge.node[is_end ? 0 : 1]];
    // What an event took for touched may be a little further away as it is measured here.
    constexpr double share = 1.25;
    return touches_all_between(boundary, boundary.runs[root.component], root.disk,
                               is_end ? right : left, is_end ? left : right, share * tolerance);
  };
  std::vector<std::uint32_t> edges, nodes;
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i)
    for (std::uint32_t leaf = i; ends[leaf][0] == 1;) {
      const std::uint32_t e = ends[leaf][1];
      if (!is_spur(graph.edges[e], leaf)) break;
      edges.push_back(e);
      nodes.push_back(leaf);
      ends[leaf][0] = 0;
      const auto [from, to] = graph.edges[e].node;
      leaf = leaf == from ? to : from;
      --ends[leaf][0];
      ends[leaf][1] ^= e;
    }
  if (edges.empty()) return;
  std::sort(edges.begin(), edges.end());
  std::sort(nodes.begin(), nodes.end());
  std::vector<std::uint32_t> place(graph.nodes.size());
  std::iota(place.begin(), place.end(), 0U);
  fill_gaps(graph.nodes, nodes, [&](std::uint32_t from, std::uint32_t to) { place[from] = to; });
  fill_gaps(graph.edges, edges, [](std::uint32_t, std::uint32_t) {});
  for (Edge& edge : graph.edges)
    for (std::uint32_t& node : edge.node) node = place[node];
}

WorkVector<std::uint8_t> degrees_of(const Graph& graph) {
  WorkVector<std::uint8_t> degree(graph.nodes.size());
  for (const Edge& edge : graph.edges)
    for (const std::uint32_t node : edge.node)
      if (degree[node] < 4) ++degree[node];
  return degree;
}

namespace {

/// Notes the sites that disks at the tips of branches reach over. Where arcs lie on one circle up
/// to rounding, a disk in their centre may touch each of them within the tolerance in turn, and
/// reach over others by more.
void find_intruders(const Boundary& boundary, const site::BoundaryTree& tree, double slack,
                    Graph& graph) {
  const WorkVector<std::uint8_t> degree = degrees_of(graph);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const auto& [disk, component, kind] = graph.nodes[i];
    if (degree[i] == 2 || disk.radius <= slack) continue;
    const Boundary::SiteRange& run = boundary.runs[component];
    if (const auto hit = tree.nearest(disk.center, disk.radius - slack, run.first, run.last))
      graph.lost.push_back(hit.site);
  }
}

/// Whether the foot on a site moves forward from one disk to another, by the sides of directions.
bool moves_forward(const site::Site& s, Vec2 from, Vec2 to) {
  const Vec2 first = from - s.point, last = to - s.point;
  if (s.is_vertex()) return cross(last, first) > 0;  // round a vertex, normals turn to the right
  if (!s.is_arc()) return dot(s.direction, to - from) > 0;
  const Vec2 normal = s.normal();
  return s.curvature * cross(normal - s.curvature * first, normal - s.curvature * last) > 0;
}

/// Whether an edge may run backward along its sites. Next to the centre of an arc, rounding decides
/// that of an edge no longer than `slack`.
bool may_run_backward(const site::Site& left, const site::Site& right, Vec2 from, Vec2 to,
                      double slack) {
  if (squared_norm(to - from) > slack * slack)
    return !(moves_forward(right, from, to) && moves_forward(left, to, from)) &&
           !(site::foot_advances(right, from, to, slack) &&
             site::foot_advances(left, to, from, slack));
  constexpr double far = 64;
  const auto is_open = [&](const site::Site& s) {
    return s.is_arc() && std::abs(site::carrier_parameter(s, to) -
                                  site::carrier_parameter(s, from)) > far * slack;
  };
  return is_open(left) || is_open(right) || !site::foot_advances(right, from, to, slack) ||
         !site::foot_advances(left, to, from, slack);
}

/// Notes the edges next to arcs that may run backward: what the walk takes for one node leaves open
/// where its disk is, and so in which direction edges lead from there.
void find_backward(const Boundary& boundary, double slack, Graph& graph) {
  for (const Edge& edge : graph.edges) {
    const auto [from, to] = edge.node;
    if (may_run_backward(boundary.sites[edge.site[0]], boundary.sites[edge.site[1]],
                         graph.nodes[from].disk.center, graph.nodes[to].disk.center, slack))
      graph.lost.push_back(edge.site[0]);
  }
}

}  // namespace

void find_doubts(const Boundary& boundary, const site::BoundaryTree& tree, double tolerance,
                 Graph& graph) {
  find_intruders(boundary, tree, 2 * tolerance, graph);
  // A diagram is measured as a whole.
  if (boundary.sides == Sides::one) find_backward(boundary, 4 * tolerance, graph);
}

bool strays_at_centre(const site::Site& left, const site::Site& right, const Disk& from,
                      const Disk& to, double slack) {
  constexpr double near = 4;  // lengths
  const double reach = near * distance(from.center, to.center);
  const auto comes_near = [&](const site::Site& s) {
    return s.curvature > 0 && (std::abs(1 - s.curvature * from.radius) <= s.curvature * reach ||
                               std::abs(1 - s.curvature * to.radius) <= s.curvature * reach);
  };
  if (!comes_near(left) && !comes_near(right)) return false;
  const site::Control control = site::control_of(left, right, from, to);
  const Curve curve(from, control.point, to, control.weight);
  return !TwoDisks(curve.at(0.25), curve.at(0.75), slack).touch(left, right);
}

WorkVector<std::uint32_t> complete(const Boundary& boundary, const LocalFrame& frame,
                                   std::optional<double> slack, Graph& graph) {
  graph.statistics.largest_residual *= frame.inverse;
  constexpr std::size_t block = 1 << 12, ahead = 16;
  const auto fill_edge = [&](std::size_t i) {
    Edge& edge = graph.edges[i];
    // Sites lie far from each other in memory. Edges of the next block may be another thread's.
    if (i % block + ahead < block && i + ahead < graph.edges.size())
      for (const std::uint32_t site : graph.edges[i + ahead].site)
        __builtin_prefetch(&boundary.sites[site]);
    const site::Site &left = boundary.sites[edge.site[0]], &right = boundary.sites[edge.site[1]];
    const Disk &from = graph.nodes[edge.node[0]].disk, &to = graph.nodes[edge.node[1]].disk;
    const site::Control control = site::control_of(left, right, from, to);
    const bool is_doubtful =
        slack && (!TwoDisks(from, to, *slack).touch(left, right) ||
                  (boundary.has_arcs && strays_at_centre(left, right, from, to, *slack)));
    edge.site = {boundary.originals[edge.site[0]], boundary.originals[edge.site[1]]};
    edge.control = {frame.to_input(control.point.center), frame.inverse * control.point.radius};
    edge.weight = control.weight;
    return is_doubtful;
  };
  WorkVector<std::uint32_t> doubtful;
  WorkVector<std::uint8_t> degree;
  in_parallel(
      [&] {
        if (slack) degree = degrees_of(graph);
      },
      [&] { doubtful = numbers_where<block>(graph.edges.size(), fill_edge); });
  parallel_ranges(graph.nodes.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Node& node = graph.nodes[i];
      // Where a vertex all but touches an edge, a radius may be below 0 by rounding.
      node.disk = {frame.to_input(node.disk.center),
                   frame.inverse * std::max(0.0, node.disk.radius)};
      if (slack) node.kind = kind_of_degree(degree[i]);
    }
  });
  return doubtful;
}

bool touches_its_sites(const MedialAxis& axis, const Edge& edge, double slack) {
  const auto squared_distance = [](const Site& site, Vec2 c) {
    if (site.start == site.end) return squared_norm(c - site.start);
    const site::Pieces pieces = site::pieces_of(site.start, site.end, site.bulge);
    const double first = site::squared_distance(pieces.first(), c);
    return pieces.count == 1 ? first : std::min(first, site::squared_distance(pieces.last(), c));
  };
  const auto touches = [&](const Disk& disk, const Site& site) {
    const Vec2 along = site.end - site.start;
    if (site.kind() == SiteKind::segment &&
        cross(along, disk.center - site.start) < -slack * norm(along))
      return false;
    return std::abs(std::sqrt(squared_distance(site, disk.center)) - disk.radius) <= slack;
  };
  const Curve curve = curve_of(axis, edge);
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Disk disk = curve.at(t);
    if (!touches(disk, axis.sites[edge.site[0]]) || !touches(disk, axis.sites[edge.site[1]]))
      return false;
  }
  return true;
}

}  // namespace medial::disks
