#include "engines/voronoi/soup_diagram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "axis/node_kinds.h"
#include "axis/sites.h"
#include "base/arc.h"
#include "base/frame.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "engines/voronoi/clip.h"
#include "engines/voronoi/frame_cut.h"
#include "engines/voronoi/long_edges.h"
#include "geometry/bisector.h"
#include "geometry/site.h"
#include "geometry/tangent_disk.h"

namespace medial::voronoi {
namespace {

/// Numbers of edges leave a bit for a flag: a soup has less than 2^28 points and sides of edges.
constexpr std::uint32_t largest_edge = none >> 1U;

/// Puts an axis together by the sites of a soup: see diagram_of().
///
/// An engine's site is a soup's point in one wedge between edges, or one side of an edge: `own`
/// sites here. The axis' edges along one own site make a chain, in the order of its feet. Where
/// one own site follows another along the boundary, their chains meet in a corner, or in the node
/// of the disk that touches where they join; there the spoke leads to.
class Assembly {
 public:
  Assembly(const Soup& soup, const Shape& shape, MedialAxis& axis, const Box& frame)
      : soup_(soup),
        shape_(shape),
        axis_(axis),
        frame_(frame),
        point_count_(static_cast<std::uint32_t>(soup.points.size())),
        cut_(soup, frame, axis.tolerance, diagram_) {}

  VoronoiDiagram run() {
    make_own_sites();
    make_chains();
    find_ends();
    make_spokes();
    make_nodes();
    cut_off();
    cut_.close();
    make_faces();
    diagram_.method = std::move(axis_.method);
    diagram_.tolerance = axis_.tolerance;
    diagram_.statistics = axis_.statistics;
    diagram_.frame = frame_;
    set_kinds(diagram_);
    return std::move(diagram_);
  }

 private:
  struct Step {
    std::uint32_t edge : 31;
    std::uint32_t forward : 1;  ///< along the edge
    std::uint32_t from, to;     ///< nodes of the axis
  };
  struct Spoke {
    std::uint32_t point, node;
    std::array<std::uint32_t, 2> site;  ///< of the diagram
  };
  bool is_frame(std::uint32_t own) const { return own_[own] == none; }
  bool is_vertex(std::uint32_t own) const { return !is_frame(own) && (own_[own] & edge_side) == 0; }
  std::uint32_t half_edge(std::uint32_t own) const { return own_[own] & ~edge_side; }
  /// The site of the diagram.
  std::uint32_t site_of(std::uint32_t own) const {
    if (is_frame(own)) return no_site;
    return is_vertex(own) ? own_[own] : point_count_ + half_edge(own) / 2;
  }

  void make_own_sites() {
    own_.reserve(axis_.sites.size());
    for (const Site& site : axis_.sites)
      own_.push_back(site.ring == none               ? none
                     : site.kind == SiteKind::vertex ? site.ring
                                                     : edge_side | site.vertex);
  }

  void make_chains() {
    const std::size_t count = axis_.sites.size();
    chain_begin_.assign(count + 1, 0);
    for (const Edge& edge : axis_.edges)
      for (const std::uint32_t own : edge.site) ++chain_begin_[own + 1];
    for (std::size_t i = 0; i < count; ++i) chain_begin_[i + 1] += chain_begin_[i];
    chains_.resize(2 * axis_.edges.size());
    std::vector<std::uint32_t> filled(chain_begin_.begin(), chain_begin_.end() - 1);
    for (std::uint32_t e = 0; e < axis_.edges.size(); ++e) {
      const Edge& edge = axis_.edges[e];
      chains_[filled[edge.site[1]]++] = {e & largest_edge, 1, edge.node[0], edge.node[1]};
      chains_[filled[edge.site[0]]++] = {e & largest_edge, 0, edge.node[1], edge.node[0]};
    }
    first_.assign(count, none);
    last_.assign(count, none);
    for (std::uint32_t own = 0; own < count; ++own) {
      if (is_frame(own)) continue;
      const std::span<Step> steps = chain(own);
      if (steps.empty()) continue;
      put_in_order(steps);
      first_[own] = steps.front().from;
      last_[own] = steps.back().to;
    }
  }

  std::span<Step> chain(std::uint32_t own) {
    return std::span(chains_).subspan(chain_begin_[own], chain_begin_[own + 1] - chain_begin_[own]);
  }

  /// From the step that no other leads to, or where they make a cycle, any one.
  void put_in_order(std::span<Step> steps) {
    if (steps.size() == 1) return;
    constexpr std::size_t few = 24;
    if (steps.size() > few) return put_many_in_order(steps);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const bool begins = std::none_of(
          steps.begin(), steps.end(), [&](const Step& other) { return other.to == steps[i].from; });
      if (begins) {
        std::swap(steps[0], steps[i]);
        break;
      }
    }
    for (std::size_t i = 1; i < steps.size(); ++i) {
      const auto next =
          std::find_if(steps.begin() + static_cast<std::ptrdiff_t>(i), steps.end(),
                       [&](const Step& other) { return other.from == steps[i - 1].to; });
      if (next == steps.end()) throw std::runtime_error("a Voronoi face is not connected");
      std::swap(steps[i], *next);
    }
  }
  void put_many_in_order(std::span<Step> steps) {
    std::vector<Step> sorted(steps.begin(), steps.end());
    std::sort(sorted.begin(), sorted.end(),
              [](const Step& a, const Step& b) { return a.from < b.from; });
    std::vector<std::uint32_t> to;
    for (const Step& step : sorted) to.push_back(step.to);
    std::sort(to.begin(), to.end());
    const auto begin = std::find_if(sorted.begin(), sorted.end(), [&](const Step& step) {
      return !std::binary_search(to.begin(), to.end(), step.from);
    });
    Step at = begin == sorted.end() ? sorted.front() : *begin;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      steps[i] = at;
      if (i + 1 == steps.size()) break;
      const auto next =
          std::lower_bound(sorted.begin(), sorted.end(), at.to,
                           [](const Step& step, std::uint32_t node) { return step.from < node; });
      if (next == sorted.end() || next->from != at.to)
        throw std::runtime_error("a Voronoi face is not connected");
      at = *next;
    }
  }

  /// Calls visit(first, last) for the own sites of every loop of the soup: [first, last).
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

  /// Of own sites without edges, the node that they are touched in: that of the site before.
  void find_ends() {
    std::vector<std::uint32_t> lone(shape_.component_count(), none);
    std::vector<bool> used(axis_.nodes.size());
    for (const Edge& edge : axis_.edges) used[edge.node[0]] = used[edge.node[1]] = true;
    for (std::uint32_t n = 0; n < axis_.nodes.size(); ++n)
      if (!used[n]) lone[axis_.nodes[n].component] = n;
    for_each_loop([&](std::uint32_t first, std::uint32_t last, std::size_t loop) {
      std::uint32_t node = lone[shape_.component[loop]];
      for (std::uint32_t own = first; own < last; ++own)
        if (last_[own] != none) node = last_[own];
      for (std::uint32_t own = first; own < last; ++own) {
        if (first_[own] == none) first_[own] = last_[own] = node;
        node = last_[own];
        if (node == none) throw std::runtime_error("a Voronoi face has no edge");
      }
    });
  }

  bool is_empty_vertex(std::uint32_t own) const {
    return is_vertex(own) && chain_begin_[own] == chain_begin_[own + 1];
  }

  /// Spokes wherever one own site follows another but in a corner, and the nodes of the soup's
  /// points.
  void make_spokes() {
    spoke_before_.assign(axis_.sites.size(), none);
    spoke_after_.assign(axis_.sites.size(), none);
    corner_.assign(axis_.nodes.size(), none);
    for_each_loop([&](std::uint32_t first, std::uint32_t last, std::size_t) {
      if (last - first == 1) return;  // a lone point
      std::uint32_t before = last - 1;
      while (is_empty_vertex(before)) --before;
      for (std::uint32_t own = first; own < last; ++own) {
        if (is_empty_vertex(own)) continue;
        const std::uint32_t node = first_[own];
        if (last_[before] != node) throw std::runtime_error("a Voronoi face has a gap");
        const std::uint32_t point = is_vertex(own) ? own_[own] : soup_.start(half_edge(own));
        if (axis_.nodes[node].disk.radius == 0) {
          corner_[node] = point;
        } else {
          spoke_before_[own] = spoke_after_[before] = static_cast<std::uint32_t>(spokes_.size());
          spokes_.push_back({point, node, {site_of(before), site_of(own)}});
        }
        before = own;
      }
    });
  }

  ConicEdge curve_of(std::uint32_t e) const {
    if (e < axis_.edges.size()) {
      const Edge& edge = axis_.edges[e];
      return {axis_.nodes[edge.node[0]].disk, edge.control, axis_.nodes[edge.node[1]].disk,
              edge.weight};
    }
    const Spoke& spoke = spokes_[e - axis_.edges.size()];
    const Disk from{soup_.points[spoke.point], 0}, to = axis_.nodes[spoke.node].disk;
    return {from, {midpoint(from.center, to.center), 0.5 * to.radius}, to, 1};
  }
  std::array<std::uint32_t, 2> sites_of(std::uint32_t e) const {
    if (e >= axis_.edges.size()) return spokes_[e - axis_.edges.size()].site;
    const Edge& edge = axis_.edges[e];
    return {site_of(edge.site[0]), site_of(edge.site[1])};
  }
  /// The nodes inside of the frame; the soup's points among them once they are asked for.
  void make_nodes() {
    node_of_point_.assign(soup_.points.size(), none);
    node_of_axis_.assign(axis_.nodes.size(), none);
    reserve_large(diagram_.nodes, axis_.nodes.size() + soup_.points.size());
    for (std::uint32_t n = 0; n < axis_.nodes.size(); ++n) {
      const Node& node = axis_.nodes[n];
      if (corner_[n] != none)
        node_of_axis_[n] = node_of_point(corner_[n]);
      else if (cut_.holds(node.disk.center))
        node_of_axis_[n] = add_node(node.disk, node.component);
    }
  }
  /// An end as a node of the diagram, inside of the frame.
  std::uint32_t node_at(std::uint32_t e, std::size_t end) {
    if (e < axis_.edges.size()) return node_of_axis_[axis_.edges[e].node[end]];
    const Spoke& spoke = spokes_[e - axis_.edges.size()];
    return end == 0 ? node_of_point(spoke.point) : node_of_axis_[spoke.node];
  }
  std::uint32_t node_of_point(std::uint32_t point) {
    std::uint32_t& node = node_of_point_[point];
    if (node == none) node = add_node({soup_.points[point], 0}, 0);
    return node;
  }
  std::uint32_t add_node(const Disk& disk, std::uint32_t component) {
    diagram_.nodes.push_back({disk, component, NodeKind::leaf});
    return static_cast<std::uint32_t>(diagram_.nodes.size() - 1);
  }

  /// The edges inside of the frame, or the parts of them.
  void cut_off() {
    const auto edges = static_cast<std::uint32_t>(axis_.edges.size());
    const std::size_t count = edges + spokes_.size();
    reserve_large(diagram_.edges, count + 64);
    reserve_large(part_begin_, count + 1);
    for (std::uint32_t e = 0; e < count; ++e) {
      const auto begin = static_cast<std::uint32_t>(diagram_.edges.size());
      const std::array<std::uint32_t, 2> site = sites_of(e);
      if (e < edges && add_whole(axis_.edges[e], site)) {
        part_begin_.push_back(begin);
        continue;
      }
      part_begin_.push_back(is_cut | begin);
      if (site[0] == no_site || site[1] == no_site) continue;
      const bool spoke = e >= edges;
      if (!spoke && site[0] < point_count_ && site[1] < point_count_) {
        const Edge& edge = axis_.edges[e];
        cut_.add_bisector(axis_.nodes[edge.node[0]].disk.center,
                          axis_.nodes[edge.node[1]].disk.center, site,
                          [&](std::size_t end) { return node_at(e, end); });
        continue;
      }
      const bool whole = cut_.add(
          curve_of(e), site, spoke, [&](std::size_t end) { return node_at(e, end); },
          [&](ConicEdge& part) {
            if (!spoke) take_control(axis_, axis_.edges[e].site, part);
          });
      if (whole) part_begin_.back() = begin;
    }
    part_begin_.push_back(static_cast<std::uint32_t>(diagram_.edges.size()));
  }
  /// Adds an edge of the axis that is clearly all in the frame: as its triangle of control points
  /// is. False where it is not.
  bool add_whole(const Edge& edge, std::array<std::uint32_t, 2> site) {
    const std::uint32_t from = node_of_axis_[edge.node[0]], to = node_of_axis_[edge.node[1]];
    if (from == none || to == none || site[0] == no_site || site[1] == no_site ||
        !cut_.holds(edge.control.center))
      return false;
    diagram_.edges.push_back({{{from, to}, site, edge.control, edge.weight}, false, false});
    return true;
  }

  void make_faces() {
    const auto count = point_count_ + static_cast<std::uint32_t>(soup_.edges.size());
    // Own sites of each site, in the order in which they come around it.
    std::vector<std::array<std::uint32_t, 2>> owns(count, {none, none});
    for_each_loop([&](std::uint32_t first, std::uint32_t last, std::size_t) {
      for (std::uint32_t own = first; own < last; ++own) {
        if (is_empty_vertex(own)) continue;
        auto& pair = owns[site_of(own)];
        const std::size_t side = is_vertex(own) ? (pair[0] == none ? 0 : 1) : half_edge(own) % 2;
        pair[side] = own;
      }
    });
    diagram_.face_begin.reserve(count + 1);
    reserve_large(diagram_.face_edges, 2 * diagram_.edges.size());
    diagram_.sites.reserve(count);
    for (std::uint32_t site = 0; site < count; ++site) {
      diagram_.face_begin.push_back(static_cast<std::uint32_t>(diagram_.face_edges.size()));
      diagram_.sites.push_back(site_of_soup(soup_, site));
      for (const std::uint32_t own : owns[site]) {
        if (own == none) continue;
        const auto axis_edges = static_cast<std::uint32_t>(axis_.edges.size());
        if (spoke_before_[own] != none) add_to_face(axis_edges + spoke_before_[own], true);
        for (const Step& step : chain(own)) add_to_face(step.edge, step.forward != 0);
        if (spoke_after_[own] != none) add_to_face(axis_edges + spoke_after_[own], false);
      }
      cut_.end_face(site, diagram_.face_edges);
    }
    diagram_.face_begin.push_back(static_cast<std::uint32_t>(diagram_.face_edges.size()));
  }

  /// Appends what is left of an edge.
  void add_to_face(std::uint32_t e, bool forward) {
    if ((part_begin_[e] & is_cut) == 0) return diagram_.face_edges.push_back(part_begin_[e]);
    const std::uint32_t begin = part_begin_[e] & ~is_cut, end = part_begin_[e + 1] & ~is_cut;
    for (std::uint32_t i = 0; i < end - begin; ++i)
      cut_.add_to_face(forward ? begin + i : end - 1 - i, forward, diagram_.face_edges);
  }

  /// Of an edge, that it is not all in the frame.
  static constexpr std::uint32_t is_cut = none - largest_edge;
  /// Of an own site, that it is a side of an edge: a half-edge's number follows, else a point's.
  static constexpr std::uint32_t edge_side = none - largest_edge;

  const Soup& soup_;
  const Shape& shape_;
  MedialAxis& axis_;
  const Box frame_;
  const std::uint32_t point_count_;
  VoronoiDiagram diagram_;
  FrameCut cut_;
  std::vector<std::uint32_t> own_;          ///< what each own site is
  std::vector<std::uint32_t> chain_begin_;  ///< of each own site
  std::vector<Step> chains_;
  std::vector<std::uint32_t> first_, last_;  ///< nodes of each own site's chain
  std::vector<Spoke> spokes_;
  std::vector<std::uint32_t> spoke_before_, spoke_after_;  ///< of each own site
  std::vector<std::uint32_t> corner_;  ///< of each node: the point that it is, if it is one
  std::vector<std::uint32_t> node_of_point_, node_of_axis_;
  std::vector<std::uint32_t>
      part_begin_;  ///< of each edge and spoke: its parts in the diagram, and `is_cut`
};

}  // namespace

Site site_of_soup(const Soup& soup, std::uint32_t site) {
  if (site < soup.points.size()) {
    const Vec2 p = soup.points[site];
    const auto [ring, vertex] = soup.point_sources[site];
    return {p, p, ring, vertex, SiteKind::vertex};
  }
  const SoupEdge& edge = soup.edges[site - soup.points.size()];
  return {soup.points[edge.from],
          soup.points[edge.to],
          edge.source.ring,
          edge.source.vertex,
          edge.bulge == 0 ? SiteKind::segment : SiteKind::arc,
          edge.bulge};
}

void set_kinds(VoronoiDiagram& diagram) {
  std::vector<std::uint8_t> degree(diagram.nodes.size());
  for (const VoronoiEdge& edge : diagram.edges)
    for (const std::uint32_t node : edge.node)
      if (degree[node] < 3) ++degree[node];
  for (std::size_t i = 0; i < degree.size(); ++i) diagram.nodes[i].kind = kind_of_degree(degree[i]);
}

Box far_frame(const Box& frame) {
  // Everything inside of the frame is nearer than its diagonal to the soup, which is inside.
  const double away = 1.0625 * diagonal(frame);
  return {frame.low - Vec2{away, away}, frame.high + Vec2{away, away}};
}

VoronoiDiagram diagram_of(const Soup& soup, const Shape& shape, MedialAxis axis, const Box& frame) {
  return Assembly(soup, shape, axis, frame).run();
}

}  // namespace medial::voronoi

namespace medial {

std::vector<Site> sites_of(const Soup& soup) {
  std::vector<Site> sites(soup.points.size() + soup.edges.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) sites[i] = voronoi::site_of_soup(soup, i);
  return sites;
}

}  // namespace medial
