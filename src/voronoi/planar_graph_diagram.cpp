#include "voronoi/planar_graph_diagram.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "axis/node_kinds.h"
#include "axis/sites.h"
#include "base/arc.h"
#include "base/compat.h"
#include "base/fill_gaps.h"
#include "base/local_frame.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "base/numbers_where.h"
#include "base/threads.h"
#include "shape/around.h"
#include "site/bisector.h"
#include "site/site.h"
#include "site/tangent_disk.h"
#include "voronoi/chain_order.h"
#include "voronoi/clip.h"
#include "voronoi/enclosure_cut.h"
#include "voronoi/long_edges.h"

namespace medial::voronoi {
namespace {

/// Numbers of edges leave a bit for a flag: a planar graph has less than 2^28 points and sides of
/// edges.
constexpr std::uint32_t largest_edge = none >> 1U;

/// Puts an axis together by the sites of a planar graph: see diagram_of().
///
/// An engine's site is a planar graph's point in one wedge between edges, or one side of an edge:
/// `own` sites here. The axis' edges along one own site make a chain, in the order of its feet.
/// Where one own site follows another along the boundary, their chains meet in a corner, or in the
/// node of the disk that touches where they join; there the spoke leads to.
class Assembly {
  using Step = ChainStep;

 public:
  Assembly(const PlanarGraph& planar_graph, const Shape& shape, MedialAxis& axis,
           std::vector<VoronoiEdge>& edges, const Box& enclosure)
      : planar_graph_(planar_graph),
        shape_(shape),
        axis_(axis),
        enclosure_(enclosure),
        point_count_(static_cast<std::uint32_t>(planar_graph.points.size())),
        edge_count_(static_cast<std::uint32_t>(edges.size())),
        cut_(planar_graph, enclosure, axis.tolerance, diagram_) {
    diagram_.nodes = std::move(axis.nodes);
    diagram_.edges = std::move(edges);
  }

  Result<VoronoiDiagram> run(const site::SiteNumbers& numbers) {
    const auto broken = [](const char* text) { return Error{ErrorCode::internal, text, {}}; };
    make_own_sites(numbers);
    if (!make_chains()) return broken("a Voronoi face is not connected");
    turn_cycles();
    if (!find_ends()) return broken("a Voronoi face has no edge");
    if (!make_spokes()) return broken("a Voronoi face has a gap");
    make_nodes();
    cut_off();
    if (Status closed = cut_.close(); !closed) return std::move(closed).error();
    in_parallel([&] { make_faces(); }, [&] { set_kinds(diagram_); });
    diagram_.method = std::move(axis_.method);
    diagram_.tolerance = axis_.tolerance;
    diagram_.statistics = axis_.statistics;
    diagram_.enclosure = enclosure_;
    return std::move(diagram_);
  }

 private:
  struct Spoke {
    std::uint32_t point, node;
    std::array<std::uint32_t, 2> site;  ///< of the diagram
  };
  bool is_enclosure(std::uint32_t own) const { return own_[own] == none; }
  bool is_vertex(std::uint32_t own) const {
    return !is_enclosure(own) && (own_[own] & edge_side) == 0;
  }
  std::uint32_t half_edge(std::uint32_t own) const { return own_[own] & ~edge_side; }
  /// The site of the diagram.
  std::uint32_t site_of(std::uint32_t own) const {
    if (is_enclosure(own)) return no_site;
    return is_vertex(own) ? own_[own] : point_count_ + half_edge(own) / 2;
  }

  void make_own_sites(const site::SiteNumbers& numbers) {
    own_ = large_vector(numbers.count, none);
    for (std::size_t i = 0; i < shape_.points.size(); ++i) {
      const auto [point, half_edge] = shape_.sources[i];
      if (point == none) continue;
      if (numbers.is_site(i)) own_[numbers.edge[i] - 1] = point;
      if (half_edge != none) own_[numbers.edge[i]] = edge_side | half_edge;
    }
  }
  /// The engine's site.
  Site engine_site(std::uint32_t own) const {
    Site site = site_of_planar_graph(planar_graph_, site_of(own));
    if (is_vertex(own) || half_edge(own) % 2 == 0) return site;
    std::swap(site.start, site.end);
    site.bulge = 0 - site.bulge;
    return site;
  }

  /// False where the edges along one own site do not make a chain.
  bool make_chains() {
    std::atomic<bool> connected = true;
    const std::size_t count = own_.size();
    // One place further, so that while the chains are filled, each grows to where the next begins.
    chain_begin_ = large_vector(count + 2, 0U);
    for (const Edge& edge : diagram_.edges)
      for (const std::uint32_t own : edge.site) ++chain_begin_[own + 2];
    for (std::size_t i = 1; i <= count; ++i) chain_begin_[i + 1] += chain_begin_[i];
    chains_ = uninitialized<Step[]>(2 * diagram_.edges.size());
    prefer_large_pages(chains_.get(), 2 * diagram_.edges.size() * sizeof(Step));
    for (std::uint32_t e = 0; e < diagram_.edges.size(); ++e) {
      const Edge& edge = diagram_.edges[e];
      chains_[chain_begin_[edge.site[1] + 1]++] = {e & largest_edge, 1, edge.node[0], edge.node[1]};
      chains_[chain_begin_[edge.site[0] + 1]++] = {e & largest_edge, 0, edge.node[1], edge.node[0]};
    }
    first_ = large_vector(count, none);
    last_ = large_vector(count, none);
    parallel_ranges(count, 4096, [&](std::size_t begin, std::size_t end) {
      for (auto own = static_cast<std::uint32_t>(begin); own < end; ++own) {
        if (is_enclosure(own)) continue;
        const std::span<Step> steps = chain(own);
        if (steps.empty()) continue;
        if (!put_in_order(steps, !shape_.bulges.empty(), foot_of_side(own))) connected = false;
        first_[own] = steps.front().from;
        last_[own] = steps.back().to;
      }
    });
    return connected;
  }

  std::span<Step> chain(std::uint32_t own) const {
    return {chains_.get() + chain_begin_[own], chains_.get() + chain_begin_[own + 1]};
  }

  /// foot_of() a side of an edge; nothing for a vertex.
  std::function<double(const Step&)> foot_of_side(std::uint32_t own) const {
    if (shape_.bulges.empty() || is_vertex(own)) return {};
    return [this, own](const Step& step) { return foot_of(own, step); };
  }
  /// How far along a side of an edge the disk halfway along a step touches it.
  double foot_of(std::uint32_t own, const Step& step) const {
    const VoronoiEdge& edge = diagram_.edges[step.edge];
    const Vec2 from = diagram_.nodes[edge.node[0]].disk.center,
               to = diagram_.nodes[edge.node[1]].disk.center;
    const Vec2 halfway =
        (0.5 / (1 + edge.weight)) * (from + to + 2 * edge.weight * edge.control.center);
    const Site site = engine_site(own);
    const site::Pieces pieces = site::pieces_of(site.start, site.end, site.bulge);
    const bool on_first = pieces.count == 1 || site::squared_distance(pieces.first(), halfway) <=
                                                   site::squared_distance(pieces.last(), halfway);
    return on_first ? site::foot_parameter(pieces.first(), halfway)
                    : pieces.first().length + site::foot_parameter(pieces.last(), halfway);
  }

  /// Calls visit(first, last) for the own sites of every loop of the planar graph: [first, last).
  template <class Visit>
  void for_each_loop(Visit&& visit) const {
    std::uint32_t own = 0;
    for (std::size_t l = 0; l < shape_.loop_count(); ++l) {
      const std::uint32_t first = own;
      const std::size_t size = shape_.loop_begin[l + 1] - shape_.loop_begin[l];
      for (std::size_t i = 0; i < size; ++i) {
        if (is_vertex(own)) ++own;
        if (size > 1) ++own;
      }
      if (l > 0) visit(first, own, l);
    }
  }

  /// Whether the edges along an own site make a cycle: around a lone point, or along an edge around
  /// the cell of a point that is next to it.
  bool is_cycle(std::uint32_t own) const {
    return chain_begin_[own + 1] - chain_begin_[own] > 1 && first_[own] == last_[own];
  }

  /// Makes an own site's cycle begin where its neighbours in the loop end and begin; of two cycles,
  /// in a node of both; of the only site with edges, where a disk touches its ends. Where there is
  /// no such node, make_spokes() finds a gap.
  void turn_cycle(std::uint32_t own, std::uint32_t before, std::uint32_t after) {
    const std::span<Step> steps = chain(own);
    const auto begins_at = [&](std::uint32_t node) {
      return ranges::find_if(steps, [&](const Step& step) { return step.from == node; });
    };
    auto begin = steps.end();
    if (!is_cycle(before)) begin = begins_at(last_[before]);
    if (begin == steps.end() && !is_cycle(after)) begin = begins_at(first_[after]);
    if (begin == steps.end() && before == own) begin = touching_ends(own);
    if (begin == steps.end())
      for (const Step& step : chain(before))
        if (begin == steps.end()) begin = begins_at(step.from);
    if (begin == steps.end()) return;
    std::rotate(steps.begin(), begin, steps.end());
    first_[own] = last_[own] = steps.front().from;
  }

  /// The step from the disk that touches both ends of an edge's side, as far as any does: where a
  /// cycle along it begins, it ends.
  std::span<Step>::iterator touching_ends(std::uint32_t own) const {
    const Site side = engine_site(own);
    return ranges::max_element(chain(own), {}, [&](const Step& step) {
      const Disk& disk = diagram_.nodes[step.from].disk;
      const auto away = [&](Vec2 end) {
        return std::abs(distance(disk.center, end) - disk.radius);
      };
      return -std::max(away(side.start), away(side.end));
    });
  }

  void turn_cycles() {
    for_each_loop([&](std::uint32_t first, std::uint32_t last, std::size_t) {
      if (last - first == 1) return;  // a lone point
      // Ends at a site with a cycle at the latest.
      const auto before = [&](std::uint32_t own) {
        do {
          own = (own == first ? last : own) - 1;
        } while (chain(own).empty());
        return own;
      };
      const auto after = [&](std::uint32_t own) {
        do {
          own = own + 1 == last ? first : own + 1;
        } while (chain(own).empty());
        return own;
      };
      for (std::uint32_t own = first; own < last; ++own)
        if (is_cycle(own)) turn_cycle(own, before(own), after(own));
    });
  }

  /// Of own sites without edges, the node that they are touched in: that of the site before. False
  /// where there is none.
  bool find_ends() {
    bool found = true;
    std::vector<std::uint32_t> lone(shape_.component_count(), none);
    std::vector<bool> used(diagram_.nodes.size());
    for (const Edge& edge : diagram_.edges) used[edge.node[0]] = used[edge.node[1]] = true;
    for (std::uint32_t n = 0; n < diagram_.nodes.size(); ++n)
      if (!used[n]) lone[diagram_.nodes[n].component] = n;
    for_each_loop([&](std::uint32_t first, std::uint32_t last, std::size_t loop) {
      std::uint32_t node = lone[shape_.component[loop]];
      for (std::uint32_t own = first; own < last; ++own)
        if (last_[own] != none) node = last_[own];
      for (std::uint32_t own = first; own < last; ++own) {
        if (first_[own] == none) first_[own] = last_[own] = node;
        node = last_[own];
        found = found && node != none;
      }
    });
    return found;
  }

  bool is_empty_vertex(std::uint32_t own) const {
    return is_vertex(own) && chain_begin_[own] == chain_begin_[own + 1];
  }

  /// Spokes wherever one own site follows another but in a corner, and the nodes of the planar
  /// graph's points. False where one does not end where the next begins.
  bool make_spokes() {
    bool closed = true;
    spoke_before_ = large_vector(own_.size(), none);
    spoke_after_ = large_vector(own_.size(), none);
    node_of_axis_ = large_vector(diagram_.nodes.size(), none);
    reserve_large(spokes_, own_.size());
    for_each_loop([&](std::uint32_t first, std::uint32_t last, std::size_t) {
      if (last - first == 1) return;  // a lone point
      std::uint32_t before = last - 1;
      while (is_empty_vertex(before)) --before;
      for (std::uint32_t own = first; own < last; ++own) {
        if (is_empty_vertex(own)) continue;
        const std::uint32_t node = first_[own];
        closed = closed && last_[before] == node;
        if (site_of(before) == site_of(own)) {  // around an end whose cell is narrower than a tie
          before = own;
          continue;
        }
        const std::uint32_t point =
            is_vertex(own) ? own_[own] : start_of(planar_graph_, half_edge(own));
        // Elsewhere radii may be rounded to 0, too.
        const bool at_corner = !is_vertex(before) && !is_vertex(own);
        if (at_corner && diagram_.nodes[node].disk.radius == 0) {
          node_of_axis_[node] = point;
        } else {
          spoke_before_[own] = spoke_after_[before] = static_cast<std::uint32_t>(spokes_.size());
          spokes_.push_back({point, node, {site_of(before), site_of(own)}});
        }
        before = own;
      }
    });
    return closed;
  }

  /// Keeps the nodes inside the enclosure; the planar graph's points among them once they are
  /// asked for.
  void make_nodes() {
    node_of_point_ = large_vector(planar_graph_.points.size(), none);
    std::vector<Node>& nodes = diagram_.nodes;
    std::uint32_t kept = 0;
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      const std::uint32_t point = node_of_axis_[n];
      if (point == none && !cut_.holds(nodes[n].disk.center)) {
        node_of_axis_[n] = is_cut | static_cast<std::uint32_t>(outside_.size());
        outside_.push_back(nodes[n].disk);
        continue;
      }
      if (point != none && node_of_point_[point] != none) {
        node_of_axis_[n] = node_of_point_[point];
        continue;
      }
      nodes[kept] =
          point == none ? nodes[n] : Node{{planar_graph_.points[point], 0}, 0, NodeKind::leaf};
      if (point != none) node_of_point_[point] = kept;
      node_of_axis_[n] = kept++;
    }
    nodes.resize(kept);
  }
  bool is_inside(std::uint32_t node) const { return (node_of_axis_[node] & is_cut) == 0; }
  const Disk& disk_of(std::uint32_t node) const {
    const std::uint32_t now = node_of_axis_[node];
    return is_inside(node) ? diagram_.nodes[now].disk : outside_[now & ~is_cut];
  }
  std::uint32_t node_of_point(std::uint32_t point) {
    std::uint32_t& node = node_of_point_[point];
    if (node == none) {
      node = static_cast<std::uint32_t>(diagram_.nodes.size());
      diagram_.nodes.push_back({{planar_graph_.points[point], 0}, 0, NodeKind::leaf});
    }
    return node;
  }

  /// Keeps the edges that are clearly all in the enclosure, as their triangles of control points
  /// are; adds the parts of others, and the spokes or their parts.
  void cut_off() {
    std::vector<VoronoiEdge>& edges = diagram_.edges;
    reserve_large(place_, edge_count_ + spokes_.size());
    place_.resize(edge_count_);
    const auto gone = numbers_where(edge_count_, [&](std::size_t e) {
      place_[e] = static_cast<std::uint32_t>(e);
      return !keep_whole(edges[e]);
    });
    std::vector<Edge> to_cut;
    for (const std::uint32_t e : gone) {
      place_[e] = is_cut | static_cast<std::uint32_t>(to_cut.size());
      to_cut.push_back(edges[e]);
    }
    fill_gaps(edges, gone, [&](std::uint32_t from, std::uint32_t to) { place_[from] = to; });
    for (const Edge& edge : to_cut) {
      const auto begin = static_cast<std::uint32_t>(edges.size());
      add_parts_of(edge);
      parts_.push_back({begin, static_cast<std::uint32_t>(edges.size())});
    }
    for (const Spoke& spoke : spokes_) add_spoke(spoke);
  }
  /// Makes an edge of the axis one of the diagram, unless it may leave the enclosure.
  bool keep_whole(Edge& edge) const {
    const auto [from, to] = edge.node;
    const std::array<std::uint32_t, 2> site{site_of(edge.site[0]), site_of(edge.site[1])};
    if (!(is_inside(from) && is_inside(to) && site[0] != no_site && site[1] != no_site &&
          cut_.holds(edge.control.center)))
      return false;
    edge.node = {node_of_axis_[from], node_of_axis_[to]};
    edge.site = site;
    return true;
  }
  void add_parts_of(const Edge& edge) {
    const std::array<std::uint32_t, 2> site{site_of(edge.site[0]), site_of(edge.site[1])};
    if (site[0] == no_site || site[1] == no_site) return;
    const Disk &from = disk_of(edge.node[0]), &to = disk_of(edge.node[1]);
    const auto node_at = [&](std::size_t end) { return node_of_axis_[edge.node[end]]; };
    if (site[0] < point_count_ && site[1] < point_count_)
      return cut_.add_bisector(from.center, to.center, site, node_at);
    const auto take_control_of_part = [&](ConicEdge& part) {
      take_control(engine_site(edge.site[0]), engine_site(edge.site[1]), part);
    };
    cut_.add({from, edge.control, to, edge.weight}, site, false, node_at, take_control_of_part);
  }
  void add_spoke(const Spoke& spoke) {
    const auto begin = static_cast<std::uint32_t>(diagram_.edges.size());
    const Disk from{planar_graph_.points[spoke.point], 0}, to = disk_of(spoke.node);
    const ConicEdge line{from, {midpoint(from.center, to.center), 0.5 * to.radius}, to, 1};
    const auto node_at = [&](std::size_t end) {
      return end == 0 ? node_of_point(spoke.point) : node_of_axis_[spoke.node];
    };
    if (cut_.add(line, spoke.site, true, node_at, [](ConicEdge&) {}))
      return place_.push_back(begin);
    place_.push_back(is_cut | static_cast<std::uint32_t>(parts_.size()));
    parts_.push_back({begin, static_cast<std::uint32_t>(diagram_.edges.size())});
  }

  void make_faces() {
    const auto count = point_count_ + static_cast<std::uint32_t>(planar_graph_.edges.size());
    // Own sites of each site, in the order in which they come around it.
    auto owns = large_vector<std::array<std::uint32_t, 2>>(count, {none, none});
    for_each_loop([&](std::uint32_t first, std::uint32_t last, std::size_t) {
      for (std::uint32_t own = first; own < last; ++own) {
        if (is_empty_vertex(own)) continue;
        auto& pair = owns[site_of(own)];
        const std::size_t side = is_vertex(own) ? (pair[0] == none ? 0 : 1) : half_edge(own) % 2;
        pair[side] = own;
      }
    });
    // Faces are found in blocks, then put one behind the other.
    constexpr std::uint32_t block = 1 << 12;
    std::vector<std::vector<std::uint32_t>> edges((count + block - 1) / block);
    std::vector<std::uint32_t>& face_begin = diagram_.face_begin;
    face_begin = large_vector(count + 1, 0U);
    diagram_.sites = large_vector<Site>(count);
    const auto for_each_block = [&](auto&& visit) {
      parallel_for(edges.size(), [&](std::size_t i) {
        const auto first = static_cast<std::uint32_t>(i) * block;
        visit(edges[i], first, std::min(first + block, count));
      });
    };
    for_each_block([&](std::vector<std::uint32_t>& some, std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t site = first; site < last; ++site) {
        face_begin[site] = static_cast<std::uint32_t>(some.size());
        diagram_.sites[site] = site_of_planar_graph(planar_graph_, site);
        for (const std::uint32_t own : owns[site])
          if (own != none) add_own(own, some);
        cut_.end_face(site, some);
      }
    });
    std::uint32_t all = 0;
    std::vector<std::uint32_t> begin;
    for (const auto& some : edges) {
      begin.push_back(all);
      all += static_cast<std::uint32_t>(some.size());
    }
    face_begin[count] = all;
    diagram_.face_edges = large_vector(all, 0U);
    for_each_block([&](std::vector<std::uint32_t>& some, std::uint32_t first, std::uint32_t last) {
      const std::uint32_t before = begin[first / block];
      for (std::uint32_t site = first; site < last; ++site) face_begin[site] += before;
      std::copy(some.begin(), some.end(), diagram_.face_edges.begin() + before);
      some = {};
    });
  }

  /// Appends the edges along an own site, with the spokes at its ends, to a face.
  void add_own(std::uint32_t own, std::vector<std::uint32_t>& face) const {
    if (spoke_before_[own] != none) add_to_face(edge_count_ + spoke_before_[own], true, face);
    for (const Step& step : chain(own)) add_to_face(step.edge, step.forward != 0, face);
    if (spoke_after_[own] != none) add_to_face(edge_count_ + spoke_after_[own], false, face);
  }

  /// Appends the parts of an edge inside the enclosure.
  void add_to_face(std::uint32_t e, bool forward, std::vector<std::uint32_t>& face) const {
    if ((place_[e] & is_cut) == 0) return face.push_back(place_[e]);
    const auto [begin, end] = parts_[place_[e] & ~is_cut];
    for (std::uint32_t i = 0; i < end - begin; ++i)
      cut_.add_to_face(forward ? begin + i : end - 1 - i, forward, face);
  }

  /// Of an edge or a node, that it is not, or not all, in the enclosure.
  static constexpr std::uint32_t is_cut = none - largest_edge;
  /// Of an own site, that it is a side of an edge: a half-edge's number follows, else a point's.
  static constexpr std::uint32_t edge_side = none - largest_edge;

  const PlanarGraph& planar_graph_;
  const Shape& shape_;
  MedialAxis& axis_;
  const Box enclosure_;
  const std::uint32_t point_count_;
  const std::uint32_t edge_count_;  ///< of the axis
  VoronoiDiagram diagram_;
  EnclosureCut cut_;
  std::vector<std::uint32_t> own_;          ///< what each own site is
  std::vector<std::uint32_t> chain_begin_;  ///< of each own site
  std::unique_ptr<Step[]> chains_;
  std::vector<std::uint32_t> first_, last_;  ///< nodes of each own site's chain
  std::vector<Spoke> spokes_;
  std::vector<std::uint32_t> spoke_before_, spoke_after_;  ///< of each own site
  std::vector<std::uint32_t> node_of_point_;
  /// Of each node of the axis: the point that it is, if it is one; then which node of the diagram's
  /// it has become, or `is_cut` and which one of those outside.
  std::vector<std::uint32_t> node_of_axis_;
  std::vector<Disk> outside_;
  /// Of each edge of the axis and each spoke: its place in the diagram, or `is_cut` and which of
  /// the ranges of parts.
  std::vector<std::uint32_t> place_;
  std::vector<std::array<std::uint32_t, 2>> parts_;
};

}  // namespace

Site site_of_planar_graph(const PlanarGraph& planar_graph, std::uint32_t site) {
  if (site < planar_graph.points.size()) {
    const Vec2 p = planar_graph.points[site];
    const auto [ring, vertex] = planar_graph.point_sources[site];
    return {p, p, ring, vertex};
  }
  const PlanarGraphEdge& edge = planar_graph.edges[site - planar_graph.points.size()];
  return {planar_graph.points[edge.from], planar_graph.points[edge.to], edge.source.ring,
          edge.source.vertex, edge.bulge};
}

void set_kinds(VoronoiDiagram& diagram) {
  std::vector<std::uint8_t> degree(diagram.nodes.size());
  for (const VoronoiEdge& edge : diagram.edges)
    for (const std::uint32_t node : edge.node)
      if (degree[node] < 3) ++degree[node];
  for (std::size_t i = 0; i < degree.size(); ++i) diagram.nodes[i].kind = kind_of_degree(degree[i]);
}

Box far_enclosure(const Box& enclosure) {
  // Everything inside the enclosure is nearer than its diagonal to the planar graph, which is
  // inside.
  const double away = 1.0625 * diagonal(enclosure);
  return {enclosure.low - Vec2{away, away}, enclosure.high + Vec2{away, away}};
}

Result<VoronoiDiagram> diagram_of(const PlanarGraph& planar_graph, const Shape& shape,
                                  const site::SiteNumbers& numbers, MedialAxis axis,
                                  std::vector<VoronoiEdge> edges, const Box& enclosure) {
  return Assembly(planar_graph, shape, axis, edges, enclosure).run(numbers);
}

}  // namespace medial::voronoi

namespace medial {

std::vector<Site> sites_of(const PlanarGraph& planar_graph) {
  std::vector<Site> sites(planar_graph.points.size() + planar_graph.edges.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i)
    sites[i] = voronoi::site_of_planar_graph(planar_graph, i);
  return sites;
}

}  // namespace medial
