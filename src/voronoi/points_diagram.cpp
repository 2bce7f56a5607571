#include "voronoi/points_diagram.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/compat.h"
#include "base/disjoint_sets.h"
#include "base/local_frame.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "base/predicates.h"
#include "base/stopwatch.h"
#include "base/tolerance.h"
#include "base/wide.h"
#include "methods/checks.h"
#include "voronoi/delaunay.h"
#include "voronoi/enclosure_cut.h"
#include "voronoi/planar_graph_diagram.h"

namespace medial::voronoi {
namespace {

/// How many turns ahead of its use memory is asked for.
constexpr std::uint32_t ahead = 8;
/// Marks the degree of a vertex some of whose edges the enclosure cuts off.
constexpr std::uint32_t is_cut = 0x80000000;
/// Marks the number of an edge in the place of a vertex's. There are fewer than 2^31 - 1 edges.
constexpr std::uint32_t is_edge = 0x80000000;

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

/// Some edges: the points that they separate, their ends and control points.
struct PointEdges {
  static constexpr std::size_t room = 32;
  struct Points {
    alignas(32) std::array<double, room> x{}, y{};
    void set(std::size_t i, Vec2 p) { x[i] = p.x, y[i] = p.y; }
    Vec2 at(std::size_t i) const { return {x[i], y[i]}; }
  };
  struct Disks {
    Points center;
    alignas(32) std::array<double, room> radius{};
    void set(std::size_t i, const Disk& disk) {
      center.set(i, disk.center);
      radius[i] = disk.radius;
    }
    Disk at(std::size_t i) const { return {center.at(i), radius[i]}; }
  };
  Points first, second;
  Disks from, to, control;
  alignas(32) std::array<double, room> weight{};
};

/// take_control_of_points(), several at a time.
MEDIAL_WIDE void take_controls(PointEdges& edges) {
  for (std::size_t i = 0; i < PointEdges::room; ++i) {
    ConicEdge edge;
    edge.from = edges.from.at(i);
    edge.to = edges.to.at(i);
    take_control_of_points(edges.first.at(i), edges.second.at(i), edge);
    edges.control.set(i, edge.control);
    edges.weight[i] = edge.weight;
  }
}

class Dual {
 public:
  Dual(const PlanarGraph& planar_graph, const Options& options, const Box& enclosure)
      : planar_graph_(planar_graph),
        options_(options),
        enclosure_(enclosure),
        box_(bounding_box(planar_graph)),
        local_(frame_of(box_)),
        tolerance_(tolerance_for(box_, options.tolerance)),
        reach_(2 * local_.scale * diagonal(enclosure)),
        cut_(planar_graph, enclosure, tolerance_, diagram_) {}

  Result<VoronoiDiagram> run() {
    Stopwatch all, watch;
    triangulate();
    diagram_.statistics.seconds_walk = watch.lap();
    if (options_.cancel != nullptr && options_.cancel->load()) return std::move(diagram_);
    if (triangulation_.triangles.empty()) {
      add_edges_of_line();
    } else {
      make_nodes();
      join_nodes();
      make_cut_edges();
    }
    enclosure_edges_ = static_cast<std::uint32_t>(diagram_.edges.size());
    if (Status closed = cut_.close(); !closed) return std::move(closed).error();
    if (triangulation_.triangles.empty())
      make_faces_of_line();
    else
      make_faces();
    triangulation_ = {};  // whose memory the sites take
    make_sites();
    diagram_.method = "delaunay";
    diagram_.tolerance = tolerance_;
    diagram_.enclosure = enclosure_;
    if (has_ties_) set_kinds(diagram_);  // otherwise each was made with its own
    diagram_.statistics.seconds_collect = watch.lap();
    diagram_.statistics.seconds = all.lap();
    return std::move(diagram_);
  }

 private:
  /// A triangle that is no node: a ghost, or with its centre outside the enclosure.
  struct Outer {
    std::uint32_t triangle;
    std::array<std::uint32_t, 3> vertex;
  };
  /// An edge to be made, dual to a half-edge.
  struct NewEdge {
    std::uint32_t from, to;             ///< vertices
    std::array<std::uint32_t, 2> node;  ///< of the triangles on its right and left
  };

  void triangulate() {
    // Going to the local frame is exact, and there nothing overflows.
    triangulation_ = voronoi::triangulate(planar_graph_.points, local_, options_.cancel);
  }
  std::uint32_t site_of(std::uint32_t vertex) const { return triangulation_.input[vertex]; }
  Vec2 local_point(std::uint32_t vertex) const { return triangulation_.points[vertex]; }
  /// Exact, and close to those of neighbours in memory, as the planar graph's points are not.
  Vec2 point(std::uint32_t vertex) const { return local_.to_input(local_point(vertex)); }

  /// The same where the triangulation has it with fewer digits.
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

  /// A node for each triangle whose circle has its centre inside the enclosure; the same for
  /// neighbours whose centres are one. Nodes take the place of the circles, none of which comes
  /// before its own.
  void make_nodes() {
    auto& triangles = triangulation_.triangles;
    degree_.resize(planar_graph_.points.size());
    diagram_.nodes = std::move(triangulation_.circles);
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (t + ahead < triangles.size())
        for (const std::uint32_t twin : triangles[t + ahead].twin)
          __builtin_prefetch(&triangles[twin >> 2U]);
      for (const std::uint32_t vertex : triangles[t].vertex)
        if (vertex != outside) ++degree_[vertex];
      const bool is_ghost = triangles[t].is_ghost();
      const Disk disk = is_ghost ? Disk{} : disk_of(t);
      if (is_ghost || !cut_.holds(disk.center)) {
        triangles[t].spare = static_cast<std::uint32_t>(outer_.size());
        outer_.push_back({t, triangles[t].vertex});
        node_of(t) = none;
        continue;
      }
      node_of(t) = node_of_neighbours(t, disk.center);
      if (node_of(t) != none) continue;
      node_of(t) = count;
      diagram_.nodes[count++] = {disk, 0, NodeKind::branching};
    }
    diagram_.nodes.resize(count);
  }
  /// The mark of a triangle is its node from then on.
  std::uint32_t& node_of(std::uint32_t t) { return triangulation_.triangles[t].mark; }
  std::uint32_t node_of(std::uint32_t t) const { return triangulation_.triangles[t].mark; }
  std::uint32_t node_at(std::uint32_t h) const { return node_of(h >> 2U); }

  /// The circle around a triangle, in units of the input, as long as it has no node.
  Disk disk_of(std::uint32_t t) const {
    const Delaunay::Triangle& triangle = triangulation_.triangles[t];
    if (triangle.mark == 0) return circle_of(triangle);
    const auto& [center, size] = diagram_.nodes[t].disk;
    return {local_.to_input(center), local_.inverse * std::sqrt(size)};
  }
  /// The node of a triangle's neighbours before it that has the same centre, if any.
  std::uint32_t node_of_neighbours(std::uint32_t t, Vec2 center) {
    std::uint32_t own = none;
    for (const std::uint32_t twin : triangulation_.triangles[t].twin) {
      if (twin > 4 * t) continue;
      const std::uint32_t other = node_at(twin);
      if (other == none || !are_one(center, diagram_.nodes[other].disk.center)) continue;
      has_ties_ = true;
      if (own == none)
        own = other;
      else if (own != other)
        to_join_.emplace_back(own, other);
    }
    return own;
  }
  bool are_one(Vec2 a, Vec2 b) const {
    return std::abs(a.x - b.x) <= tolerance_ && std::abs(a.y - b.y) <= tolerance_;
  }
  /// Nodes found to be one only after they were made. Each set stays within the tolerance of its
  /// first node.
  void join_nodes() {
    if (to_join_.empty()) return;
    const auto count = static_cast<std::uint32_t>(diagram_.nodes.size());
    DisjointSets sets(count);
    for (const auto& [a, b] : to_join_)
      if (are_one(diagram_.nodes[sets.find(a)].disk.center,
                  diagram_.nodes[sets.find(b)].disk.center))
        sets.join(a, b);
    std::vector<std::uint32_t> number(count);
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t first = sets.find(i);
      number[i] = first == i ? kept : number[first];
      if (first == i) diagram_.nodes[kept++] = diagram_.nodes[i];
    }
    diagram_.nodes.resize(kept);
    for (std::uint32_t t = 0; t < triangulation_.triangles.size(); ++t)
      if (node_of(t) != none) node_of(t) = number[node_of(t)];
  }

  /// How far along the bisector of a half-edge's ends, seen to its left, the centre of the circle
  /// around its triangle lies, at most `reach_` away, in local units; which is beyond the
  /// enclosure.
  double place_on_bisector(std::uint32_t h) const {
    const auto& vertex = outer_[triangulation_.triangles[h >> 2U].spare].vertex;
    if (vertex[0] == outside || vertex[1] == outside) return reach_;
    const Vec2 a = local_point(vertex[h & 3U]);
    const Vec2 b = local_point(vertex[Delaunay::next(h) & 3U]);
    const Vec2 c = local_point(vertex[Delaunay::before(h) & 3U]);
    const double cosine = dot(a - c, b - c), area = area_of(c, a, b);
    const double place = 0.5 * norm(b - a) * cosine / area;
    // An area that vanishes is that of a triangle without an end.
    if (std::isnan(place)) return cosine >= 0 ? reach_ : -reach_;
    return std::clamp(place, -reach_, reach_);
  }

  /// The part inside the enclosure of the edge between two sites, the first one on its left; or
  /// none.
  std::uint32_t add_cut_edge(std::array<std::uint32_t, 2> site, ConicEdge& curve,
                             std::array<std::uint32_t, 2> node) {
    const auto number = static_cast<std::uint32_t>(diagram_.edges.size());
    cut_.add_bisector(curve.from.center, curve.to.center, site,
                      [&](std::size_t end) { return node[end]; });
    return number < diagram_.edges.size() ? number : none;
  }

  /// The edges at triangles that are no node: the enclosure cuts them off. From here on the number
  /// of an edge, once it has one, takes the place of the vertex that a half-edge starts from,
  /// marked; or none where there is no edge.
  void make_cut_edges() {
    reserve_large(diagram_.edges, 3 * planar_graph_.points.size() + 64);
    for (const Outer& outer : outer_)
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t h = 4 * outer.triangle + i, vertex = outer.vertex[i];
        if (vertex == outside) continue;
        degree_[vertex] |= is_cut;
        if (triangulation_.start(h) != vertex) continue;  // made from the other side
        const std::uint32_t twin = triangulation_.twin(h), other = triangulation_.start(twin);
        edge_of(h) = edge_of(twin) = other == outside ? none : make_cut_edge(h, vertex, other);
      }
  }
  std::uint32_t& edge_of(std::uint32_t h) {
    return triangulation_.triangles[h >> 2U].vertex[h & 3U];
  }
  std::uint32_t make_cut_edge(std::uint32_t h, std::uint32_t v, std::uint32_t w) {
    const std::uint32_t twin = triangulation_.twin(h);
    const Vec2 from = local_point(v), to = local_point(w);
    const auto end_of = [&](std::uint32_t half, double sign) -> Disk {
      if (node_at(half) != none) return diagram_.nodes[node_at(half)].disk;
      const double place = sign * place_on_bisector(half);
      const Vec2 left = (1 / distance(from, to)) * left_of(to - from);
      return {local_.to_input(midpoint(from, to) + place * left), 0};
    };
    // From the triangle on the right to the one on the left.
    ConicEdge curve;
    curve.from = end_of(twin, -1);
    curve.to = end_of(h, 1);
    const std::uint32_t edge =
        add_cut_edge({site_of(v), site_of(w)}, curve, {node_at(twin), node_at(h)});
    return edge | is_edge;
  }

  /// Where each face begins.
  void begin_faces() {
    const auto count = static_cast<std::uint32_t>(planar_graph_.points.size());
    std::vector<std::uint32_t>& begin = diagram_.face_begin;
    reserve_large(begin, count + 1);
    begin.resize(count + 1);
    for (std::uint32_t v = 0; v < count; ++v) {
      begin[site_of(v) + 1] = degree_[v];
      if ((degree_[v] & is_cut) == 0) continue;
      take_cut_face(v, cut_face_);
      begin[site_of(v) + 1] = static_cast<std::uint32_t>(cut_face_.size());
    }
    if (has_ties_) drop_ties();
    for (std::uint32_t i = 0; i < count; ++i) begin[i + 1] += begin[i];
  }
  /// Edges whose ends are one node are not made.
  void drop_ties() {
    const auto& triangles = triangulation_.triangles;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t h = 4 * t + i;
        if (node_at(h) == none || node_at(h) != node_at(triangles[t].twin[i])) continue;
        --diagram_.face_begin[site_of(triangles[t].vertex[i]) + 1];
        edge_of(h) = none;
      }
  }

  /// Clockwise around each site, and the edges inside the enclosure. The triangulation has its
  /// points in an order in which neighbours are close, so the walks go along that, so few at a time
  /// that what they have met is still in the cache when their edges are made.
  void make_faces() {
    begin_faces();
    const auto count = static_cast<std::uint32_t>(planar_graph_.points.size());
    reserve_large(diagram_.face_edges, diagram_.face_begin[count]);
    diagram_.face_edges.resize(diagram_.face_begin[count]);
    constexpr std::uint32_t at_a_time = 128;
    for (std::uint32_t first = 0; first < count; first += at_a_time) {
      const std::uint32_t last = std::min(count, first + at_a_time);
      to_make_.clear();
      for (std::uint32_t v = first; v < last; ++v) make_face(v);
      for (std::size_t i = 0; i < to_make_.size(); i += PointEdges::room)
        make_edges(std::span(to_make_).subspan(i, std::min(to_make_.size() - i, PointEdges::room)));
    }
  }
  /// Numbers the edges around a vertex that have no number yet, and lists all of them.
  void make_face(std::uint32_t v) {
    const auto& triangles = triangulation_.triangles;
    // Asked for here: g++ leaves out calls of a function that does nothing else.
    if (v + 3 * ahead < degree_.size()) {
      const auto star = [&](std::uint32_t turns) -> const Delaunay::Triangle& {
        return triangles[triangulation_.leaving[v + turns] >> 2U];
      };
      __builtin_prefetch(&diagram_.face_begin[site_of(v + 3 * ahead)]);
      __builtin_prefetch(&star(3 * ahead));
      for (const std::uint32_t twin : star(2 * ahead).twin)
        __builtin_prefetch(&triangles[twin >> 2U]);
      for (const std::uint32_t twin : star(ahead).twin)
        for (const std::uint32_t other : triangles[twin >> 2U].twin)
          __builtin_prefetch(&triangles[other >> 2U]);
      const std::uint32_t* const face =
          diagram_.face_edges.data() + diagram_.face_begin[site_of(v + ahead)];
      __builtin_prefetch(face, 1);
      __builtin_prefetch(face + 6, 1);  // mostly its last one
    }
    const std::uint32_t degree = degree_[v] & ~is_cut;
    const bool whole = degree == degree_[v];
    const std::size_t begin = to_make_.size();
    to_make_.resize(begin + degree);
    NewEdge* const made = to_make_.data() + begin;
    const auto number = static_cast<std::uint32_t>(diagram_.edges.size() + begin);
    std::uint32_t* out = diagram_.face_edges.data() + diagram_.face_begin[site_of(v)];
    std::uint32_t h = triangulation_.leaving[v], count = 0;
    for (std::uint32_t k = 0; k < degree; ++k) {
      const std::uint32_t twin = triangulation_.twin(h);
      std::uint32_t &own = edge_of(h), &other = edge_of(twin);
      __builtin_prefetch(diagram_.nodes.data() + node_at(h));
      made[count] = {v, other, {node_at(twin), node_at(h)}};
      const bool is_new = own < is_edge;  // still a vertex
      own = other = is_new ? (number + count) | is_edge : own;
      count += static_cast<std::uint32_t>(is_new);
      if (whole && own != none) *out++ = own & ~is_edge;
      h = Delaunay::next(twin);
    }
    to_make_.resize(begin + count);
    if (whole) return;
    take_cut_face(v, cut_face_);
    ranges::copy(cut_face_, out);
  }
  void make_edges(std::span<const NewEdge> made) {
    for (std::size_t i = 0; i < made.size(); ++i) {
      some_edges_.first.set(i, point(made[i].from));
      some_edges_.second.set(i, point(made[i].to));
      some_edges_.from.set(i, diagram_.nodes[made[i].node[0]].disk);
      some_edges_.to.set(i, diagram_.nodes[made[i].node[1]].disk);
    }
    take_controls(some_edges_);
    for (std::size_t i = 0; i < made.size(); ++i) {
      const std::array<std::uint32_t, 2> site{site_of(made[i].from), site_of(made[i].to)};
      diagram_.edges.push_back(
          {{made[i].node, site, some_edges_.control.at(i), some_edges_.weight[i]}, false, false});
    }
  }
  /// A face that the enclosure cuts off.
  void take_cut_face(std::uint32_t v, std::vector<std::uint32_t>& face) const {
    face.clear();
    std::uint32_t h = triangulation_.leaving[v];
    do {
      const std::uint32_t twin = triangulation_.twin(h);
      const std::uint32_t start = triangulation_.start(h), edge = start & ~is_edge;
      if (start != none) {
        if (start >= is_edge && edge < enclosure_edges_)
          cut_.add_to_face(edge, diagram_.edges[edge].site[0] != site_of(v), face);
        else
          face.push_back(edge);
      }
      h = Delaunay::next(twin);
    } while (h != triangulation_.leaving[v]);
  }
  void make_sites() {
    const auto count = static_cast<std::uint32_t>(planar_graph_.points.size());
    reserve_large(diagram_.sites, count);
    for (std::uint32_t i = 0; i < count; ++i)
      diagram_.sites.push_back(site_of_planar_graph(planar_graph_, i));
  }

  /// Of points on one line, the bisectors of neighbours.
  void add_edges_of_line() {
    line_.resize(planar_graph_.points.size());
    std::iota(line_.begin(), line_.end(), 0U);
    std::sort(line_.begin(), line_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return lexicographic_less(planar_graph_.points[a], planar_graph_.points[b]);
    });
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) {
      const Vec2 a = local_.to_local(planar_graph_.points[line_[i]]);
      const Vec2 b = local_.to_local(planar_graph_.points[line_[i + 1]]);
      const Vec2 left = (reach_ / distance(a, b)) * left_of(b - a);
      ConicEdge curve;
      curve.from = {local_.to_input(midpoint(a, b) - left), 0};
      curve.to = {local_.to_input(midpoint(a, b) + left), 0};
      line_edges_.push_back(add_cut_edge({line_[i], line_[i + 1]}, curve, {none, none}));
    }
  }
  void make_faces_of_line() {
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

  const PlanarGraph& planar_graph_;
  const Options& options_;
  const Box enclosure_, box_;
  const LocalFrame local_;
  const double tolerance_;
  const double reach_;  ///< local: further than that from a site is outside the enclosure
  Delaunay triangulation_;
  bool has_ties_ = false;
  std::vector<Outer> outer_;  ///< by the `spare` of its triangle
  std::vector<std::pair<std::uint32_t, std::uint32_t>> to_join_;
  std::vector<std::uint32_t> degree_;  ///< of each vertex: triangles around it, and `is_cut`
  std::uint32_t enclosure_edges_ = 0;  ///< number of the first one
  std::vector<NewEdge> to_make_;
  PointEdges some_edges_;
  std::vector<std::uint32_t> cut_face_;
  std::vector<std::uint32_t> line_edges_;  ///< where all points lie on one: between neighbours
  std::vector<std::uint32_t> line_;        ///< sites, where all lie on one
  VoronoiDiagram diagram_;
  EnclosureCut cut_;
};

}  // namespace

Result<VoronoiDiagram> diagram_of_points(const PlanarGraph& planar_graph, const Options& options,
                                         const Box& enclosure) {
  return Dual(planar_graph, options, enclosure).run();
}

}  // namespace medial::voronoi
