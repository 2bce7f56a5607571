#include "engines/voronoi/points_diagram.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/frame.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "base/predicates.h"
#include "base/stopwatch.h"
#include "base/tolerance.h"
#include "engines/checks.h"
#include "engines/voronoi/frame_cut.h"
#include "engines/voronoi/soup_diagram.h"
#include "geometry/delaunay.h"

namespace medial::voronoi {
namespace {

using geometry::Delaunay;
using geometry::outside;

/// How many turns ahead of its use memory is asked for.
constexpr std::uint32_t ahead = 8;
/// Marks the number of an edge that the frame cuts off. There are fewer than 2^31 edges.
constexpr std::uint32_t is_cut = 0x80000000;

/// a - b, and what rounding has taken away from it.
struct Difference {
  double value, rest;
  Difference(double a, double b) : value(a - b) {
    const double b_part = a - value, a_part = value + b_part;
    rest = (a - a_part) + (b_part - b);
  }
};

/// Twice the area of a triangle, to a few roundings of itself as long as it is above 2^-100 of the
/// sides' product: what rounding takes away is computed, too.
double careful_area(Vec2 a, Vec2 b, Vec2 c) {
  const Difference ux(b.x, a.x), uy(b.y, a.y), vx(c.x, a.x), vy(c.y, a.y);
  const double left = ux.value * vy.value, right = uy.value * vx.value;
  const double off = std::fma(ux.value, vy.value, -left) - std::fma(uy.value, vx.value, -right);
  return (left - right) + (off + (ux.value * vy.rest + ux.rest * vy.value) -
                           (uy.value * vx.rest + uy.rest * vx.value));
}

/// Twice the area of a triangle, to some hundred roundings of itself.
double area_of(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 u = b - a, v = c - a;
  const double left = u.x * v.y, right = u.y * v.x, area = left - right;
  constexpr double cancelled = 0x1p-6;
  return std::abs(area) >= cancelled * (std::abs(left) + std::abs(right)) ? area
                                                                          : careful_area(a, b, c);
}

class Dual {
 public:
  Dual(const Soup& soup, const Options& options, const Box& frame)
      : soup_(soup),
        options_(options),
        frame_(frame),
        local_(frame_of(bounding_box(soup))),
        tolerance_(tolerance_for(bounding_box(soup), options.tolerance)),
        reach_(2 * local_.scale * diagonal(frame)),
        cut_(soup, frame, tolerance_, diagram_) {}

  VoronoiDiagram run() {
    Stopwatch all, watch;
    triangulate();
    diagram_.statistics.seconds_walk = watch.lap();
    if (is_cancelled(options_)) return std::move(diagram_);
    if (triangulation_.triangles.empty()) {
      add_edges_of_line();
    } else {
      make_nodes();
      join_nodes();
      make_edges();
    }
    frame_edges_ = diagram_.edges.size();
    cut_.close();
    if (triangulation_.triangles.empty())
      make_faces_of_line();
    else
      make_faces();
    diagram_.method = "delaunay";
    diagram_.tolerance = tolerance_;
    diagram_.frame = frame_;
    if (has_ties_) set_kinds(diagram_);  // otherwise each was made with its own
    diagram_.statistics.seconds_collect = watch.lap();
    diagram_.statistics.seconds = all.lap();
    return std::move(diagram_);
  }

 private:
  void triangulate() {
    // Going to the local frame is exact, and there nothing overflows.
    std::vector<Vec2> points;
    points.reserve(soup_.points.size());
    for (const Vec2 p : soup_.points) points.push_back(local_.to_local(p));
    triangulation_ = geometry::triangulate(points, options_.cancel);
  }
  std::uint32_t site_of(std::uint32_t vertex) const { return triangulation_.input[vertex]; }
  Vec2 local_point(std::uint32_t vertex) const { return triangulation_.points[vertex]; }
  /// Exact, and close to those of neighbours in memory, as the soup's points are not.
  Vec2 point(std::uint32_t vertex) const { return local_.to_input(local_point(vertex)); }

  /// The circle around a triangle, in units of the input.
  Disk circle_of(const Delaunay::Triangle& t) const {
    Vec2 a = local_point(t.vertex[0]), b = local_point(t.vertex[1]), c = local_point(t.vertex[2]);
    // Seen from an end of the shortest side, the centre keeps its digits.
    constexpr double much_shorter = 0x1p-6;
    const double opposite = squared_norm(c - b);
    if (opposite < much_shorter * std::min(squared_norm(b - a), squared_norm(c - a))) {
      std::swap(a, b);
      std::swap(b, c);
    }
    const Vec2 u = b - a, v = c - a;
    const double factor = 0.5 / area_of(a, b, c);
    const double uu = squared_norm(u), vv = squared_norm(v);
    const Vec2 center{factor * (uu * v.y - vv * u.y), factor * (vv * u.x - uu * v.x)};
    return {local_.to_input(a + center), local_.inverse * norm(center)};
  }

  /// A node for each triangle whose circle has its centre inside of the frame; the same for
  /// neighbours whose centres are one.
  void make_nodes() {
    const auto& triangles = triangulation_.triangles;
    reserve_large(node_, triangles.size());
    node_.resize(triangles.size());
    reserve_large(diagram_.nodes, triangles.size() + 64);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const Delaunay::Triangle& triangle = triangles[t];
      node_[t] = none;
      if (triangle.is_ghost()) continue;
      const Disk disk = circle_of(triangle);
      if (!cut_.holds(disk.center)) continue;
      for (const std::uint32_t twin : triangle.twin) {
        const std::uint32_t other = twin >> 2U;
        if (other >= t || node_[other] == none) continue;
        if (!are_one(disk, diagram_.nodes[node_[other]].disk)) continue;
        has_ties_ = true;
        if (node_[t] == none)
          node_[t] = node_[other];
        else if (node_[t] != node_[other])
          to_join_.emplace_back(node_[t], node_[other]);
      }
      if (node_[t] != none) continue;
      node_[t] = static_cast<std::uint32_t>(diagram_.nodes.size());
      diagram_.nodes.push_back({disk, 0, NodeKind::branching});
    }
  }
  bool are_one(const Disk& a, const Disk& b) const {
    return std::abs(a.center.x - b.center.x) <= tolerance_ &&
           std::abs(a.center.y - b.center.y) <= tolerance_;
  }
  /// Nodes found to be one only after they were made. Each set stays within the tolerance of its
  /// first node.
  void join_nodes() {
    if (to_join_.empty()) return;
    const auto count = static_cast<std::uint32_t>(diagram_.nodes.size());
    DisjointSets sets(count);
    for (const auto& [a, b] : to_join_)
      if (are_one(diagram_.nodes[sets.find(a)].disk, diagram_.nodes[sets.find(b)].disk))
        sets.join(a, b);
    std::vector<std::uint32_t> number(count);
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t first = sets.find(i);
      number[i] = first == i ? kept : number[first];
      if (first == i) diagram_.nodes[kept++] = diagram_.nodes[i];
    }
    diagram_.nodes.resize(kept);
    for (std::uint32_t& node : node_)
      if (node != none) node = number[node];
  }

  /// How far along the bisector of a half-edge's ends, seen to its left, the centre of the circle
  /// around its triangle lies, at most `reach_` away, in local units; which is beyond the frame.
  double place_on_bisector(std::uint32_t h) const {
    const Delaunay::Triangle& t = triangulation_.triangles[h >> 2U];
    if (t.is_ghost()) return reach_;
    const Vec2 a = local_point(triangulation_.start(h));
    const Vec2 b = local_point(triangulation_.start(Delaunay::next(h)));
    const Vec2 c = local_point(triangulation_.start(Delaunay::before(h)));
    const double cosine = dot(a - c, b - c), area = area_of(c, a, b);
    const double place = 0.5 * norm(b - a) * cosine / area;
    // An area that vanishes is that of a triangle without an end.
    if (std::isnan(place)) return cosine >= 0 ? reach_ : -reach_;
    return std::clamp(place, -reach_, reach_);
  }

  /// The part inside of the frame of the edge between two sites, the first one on its left; or
  /// none.
  std::uint32_t add_cut_edge(std::array<std::uint32_t, 2> site, ConicEdge& curve,
                             std::array<std::uint32_t, 2> node) {
    const auto number = static_cast<std::uint32_t>(diagram_.edges.size());
    cut_.add_bisector(curve.from.center, curve.to.center, site,
                      [&](std::size_t end) { return node[end]; });
    return number < diagram_.edges.size() ? number : none;
  }

  /// The edges triangle by triangle. Those of a triangle that is done take the place of its
  /// vertices, which nobody asks for again.
  void make_edges() {
    auto& triangles = triangulation_.triangles;
    const auto count = static_cast<std::uint32_t>(soup_.points.size());
    leaving_.resize(count);
    degree_.assign(count, 0);
    reserve_large(diagram_.edges, 3 * soup_.points.size() + 64);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (t + ahead < triangles.size())
        for (const std::uint32_t twin : triangles[t + ahead].twin) {
          __builtin_prefetch(&node_[twin >> 2U]);
          __builtin_prefetch(&triangles[twin >> 2U]);
        }
      std::array<std::uint32_t, 3> edge{none, none, none};
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t h = 4 * t + i, twin = triangles[t].twin[i];
        const std::uint32_t a = triangles[t].vertex[i];
        if (a != outside) leaving_[a] = h;
        if (twin < h) {
          edge[i] = triangles[twin >> 2U].vertex[twin & 3U];
          continue;
        }
        const std::uint32_t b = triangles[t].vertex[i == 2 ? 0 : i + 1];
        if (a == outside || b == outside) continue;
        // From the triangle on the right to the one on the left.
        const std::array<std::uint32_t, 2> node{node_[twin >> 2U], node_[t]};
        if (node[0] == node[1] && node[0] != none) continue;
        edge[i] = add_edge(h, {a, b}, node);
        if (edge[i] == none) continue;
        ++degree_[a];
        ++degree_[b];
      }
      triangles[t].vertex = edge;
    }
  }

  /// The edge dual to a half-edge, whose ends are `vertex`.
  std::uint32_t add_edge(std::uint32_t h, std::array<std::uint32_t, 2> vertex,
                         std::array<std::uint32_t, 2> node) {
    const std::array<std::uint32_t, 2> site{site_of(vertex[0]), site_of(vertex[1])};
    ConicEdge curve;
    if (node[0] != none && node[1] != none) {
      curve.from = diagram_.nodes[node[0]].disk;
      curve.to = diagram_.nodes[node[1]].disk;
      take_control_of_points(point(vertex[0]), point(vertex[1]), curve);
      diagram_.edges.push_back({{node, site, curve.control, curve.weight}, false, false});
      return static_cast<std::uint32_t>(diagram_.edges.size() - 1);
    }
    const Vec2 from = local_point(vertex[0]), to = local_point(vertex[1]);
    const auto end_of = [&](std::uint32_t own, std::uint32_t half, double sign) -> Disk {
      if (own != none) return diagram_.nodes[own].disk;
      const double place = sign * place_on_bisector(half);
      const Vec2 left = (1 / distance(from, to)) * left_of(to - from);
      return {local_.to_input(midpoint(from, to) + place * left), 0};
    };
    curve.from = end_of(node[0], triangulation_.twin(h), -1);
    curve.to = end_of(node[1], h, 1);
    const std::uint32_t edge = add_cut_edge(site, curve, node);
    return edge == none ? none : edge | is_cut;
  }

  /// Clockwise around each site. The triangulation has its points in an order in which neighbours
  /// are close, so the walks go along that.
  void make_faces() {
    const auto count = static_cast<std::uint32_t>(soup_.points.size());
    make_sites();
    std::vector<std::uint32_t>& begin = diagram_.face_begin;
    begin.assign(count + 1, 0);
    for (std::uint32_t v = 0; v < count; ++v) begin[site_of(v) + 1] = degree_[v];
    for (std::size_t e = frame_edges_; e < diagram_.edges.size(); ++e)
      ++begin[diagram_.edges[e].site[0] + 1];
    for (std::uint32_t i = 0; i < count; ++i) begin[i + 1] += begin[i];
    reserve_large(diagram_.face_edges, begin[count]);
    diagram_.face_edges.resize(begin[count]);
    std::vector<std::uint32_t> face;
    for (std::uint32_t v = 0; v < count; ++v) {
      if (v + ahead < count)
        __builtin_prefetch(&triangulation_.triangles[leaving_[v + ahead] >> 2U]);
      face.clear();
      std::uint32_t h = leaving_[v];
      do {
        const std::uint32_t twin = triangulation_.twin(h), edge = triangulation_.start(h);
        // The half-edge with the smaller number has its start on the edge's left.
        if ((edge & is_cut) == 0)
          face.push_back(edge);
        else if (edge != none)
          cut_.add_to_face(edge & ~is_cut, twin < h, face);
        h = Delaunay::next(twin);
      } while (h != leaving_[v]);
      std::ranges::copy(face, diagram_.face_edges.begin() + begin[site_of(v)]);
    }
  }
  void make_sites() {
    const auto count = static_cast<std::uint32_t>(soup_.points.size());
    reserve_large(diagram_.sites, count);
    for (std::uint32_t i = 0; i < count; ++i) diagram_.sites.push_back(site_of_soup(soup_, i));
  }

  /// Of points on one line, the bisectors of neighbours.
  void add_edges_of_line() {
    line_.resize(soup_.points.size());
    std::iota(line_.begin(), line_.end(), 0U);
    std::sort(line_.begin(), line_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return lexicographic_less(soup_.points[a], soup_.points[b]);
    });
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) {
      const Vec2 a = local_.to_local(soup_.points[line_[i]]);
      const Vec2 b = local_.to_local(soup_.points[line_[i + 1]]);
      const Vec2 left = (reach_ / distance(a, b)) * left_of(b - a);
      ConicEdge curve;
      curve.from = {local_.to_input(midpoint(a, b) - left), 0};
      curve.to = {local_.to_input(midpoint(a, b) + left), 0};
      line_edges_.push_back(add_cut_edge({line_[i], line_[i + 1]}, curve, {none, none}));
    }
  }
  void make_faces_of_line() {
    make_sites();
    std::vector<std::uint32_t> place(line_.size());
    for (std::uint32_t i = 0; i < line_.size(); ++i) place[line_[i]] = i;
    for (std::uint32_t site = 0; site < line_.size(); ++site) {
      diagram_.face_begin.push_back(static_cast<std::uint32_t>(diagram_.face_edges.size()));
      const std::uint32_t i = place[site];
      if (i > 0) cut_.add_to_face(line_edges_[i - 1], true, diagram_.face_edges);
      if (i + 1 < line_.size()) cut_.add_to_face(line_edges_[i], false, diagram_.face_edges);
      cut_.end_face(site, diagram_.face_edges);
    }
    diagram_.face_begin.push_back(static_cast<std::uint32_t>(diagram_.face_edges.size()));
  }

  const Soup& soup_;
  const Options& options_;
  const Box frame_;
  const Frame local_;
  const double tolerance_;
  const double reach_;  ///< local: further than that from a site is outside of the frame
  Delaunay triangulation_;
  bool has_ties_ = false;
  std::vector<std::uint32_t> node_;  ///< of each triangle; none outside of the frame
  std::vector<std::pair<std::uint32_t, std::uint32_t>> to_join_;
  std::vector<std::uint32_t> leaving_, degree_;  ///< of each vertex: a half-edge, number of edges
  std::size_t frame_edges_ = 0;                  ///< number of the first one
  std::vector<std::uint32_t> line_edges_;  ///< where all points lie on one: between neighbours
  std::vector<std::uint32_t> line_;        ///< sites, where all lie on one
  VoronoiDiagram diagram_;
  FrameCut cut_;
};

}  // namespace

VoronoiDiagram diagram_of_points(const Soup& soup, const Options& options, const Box& frame) {
  return Dual(soup, options, frame).run();
}

}  // namespace medial::voronoi
