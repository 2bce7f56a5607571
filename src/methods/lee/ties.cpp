#include "methods/lee/ties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "site/bisector.h"

namespace medial::lee {
namespace {

/// Voronoi points that may be one point, with bounds on their errors.
class Ties {
 public:
  Ties(Graph& graph, double slack) : graph_(graph), elements_(graph.elements()), slack_(slack) {
    const auto could_be_empty = [&](std::uint32_t edge) {
      const std::uint32_t end = graph.to(edge);
      const Disk &from = graph.disk(edge), &to = graph.disk(end);
      return !is_same(from, to) && (touches(end, from) || touches(edge, to));
    };
    const auto& all = graph.doubtful_edges();
    if (std::any_of(all.begin(), all.end(), could_be_empty)) edges_ = all;
  }

  bool empty() const { return edges_.empty(); }

  /// Starts at the most accurate point: all points whose elements its disk touches get this disk.
  /// O(points).
  void join() {
    number_points();
    const std::vector<std::uint32_t> order = best_known_first();
    std::vector<bool> is_joined(points_.size(), false);
    std::vector<std::uint32_t> open;
    for (const std::uint32_t start : order) {
      if (is_joined[start]) continue;
      is_joined[start] = true;
      const Disk disk = graph_.disk(points_[start]);
      open.assign(1, start);
      while (!open.empty()) {
        const std::uint32_t point = open.back();
        open.pop_back();
        for (std::uint32_t i = first_[point]; i < first_[point + 1]; ++i) {
          const std::uint32_t next = neighbours_[i];
          if (is_joined[next]) continue;
          if (!is_same(graph_.disk(points_[next]), disk)) {
            if (!touches(points_[next], disk)) continue;
            graph_.set_disk(points_[next], disk);
          }
          is_joined[next] = true;
          open.push_back(next);
        }
      }
    }
  }

  /// Handles edges that run backward because the borders of such sets have changed places: moves
  /// the inner end of the edge to its outer end, or else the other way round, with a little more
  /// slack; then checks the edges around it again. O(edges).
  void straighten(double more_slack) {
    slack_ = more_slack;
    constexpr std::size_t most_moves = 16;  // per edge, on average
    std::vector<std::uint32_t> open(points_.size());
    std::iota(open.begin(), open.end(), 0u);
    for (std::size_t moves = 0; !open.empty() && moves < most_moves * edges_.size();) {
      const std::uint32_t point = open.back();
      open.pop_back();
      for (std::uint32_t i = first_[point]; i < first_[point + 1]; ++i) {
        const std::uint32_t next = neighbours_[i];
        const bool is_inner = graph_.to(points_[point]) == points_[next];
        const std::uint32_t inner = is_inner ? point : next, outer = is_inner ? next : point;
        if (!runs_backward(points_[inner])) continue;
        const Disk from = graph_.disk(points_[inner]), to = graph_.disk(points_[outer]);
        const bool inner_moves = touches(points_[inner], to);
        if (!inner_moves && !touches(points_[outer], from)) continue;
        const std::uint32_t moved = inner_moves ? inner : outer;
        graph_.set_disk(points_[moved], inner_moves ? to : from);
        open.push_back(moved);
        ++moves;
        if (moved == point) break;
      }
    }
  }

 private:
  bool runs_backward(std::uint32_t edge) const {
    const Disk &from = graph_.disk(edge), &to = graph_.disk(graph_.to(edge));
    if (from.center == to.center) return false;
    const auto& [first, second] = graph_[edge].element;
    const site::Site &right = elements_.sites[second], &left = elements_.sites[first];
    if (right.is_arc() || left.is_arc()) {
      const site::Bisector bisector(right, left);
      return bisector.position(from.center) > bisector.position(to.center);
    }
    const Vec2 along = site::direction_along(right, left);
    return dot(along, from.center) > dot(along, to.center);
  }

  /// Numbers the ends of the edges, and lists the neighbours of each.
  void number_points() {
    std::vector<std::uint32_t> number(graph_.places(), none);
    const auto for_ends = [&](const auto& work) {
      for (const std::uint32_t edge : edges_) {
        work(edge, graph_.to(edge));
        work(graph_.to(edge), edge);
      }
    };
    first_.assign(2, 0);
    for_ends([&](std::uint32_t node, std::uint32_t) {
      if (number[node] == none) {
        number[node] = static_cast<std::uint32_t>(points_.size());
        points_.push_back(node);
        first_.push_back(0);
      }
      ++first_[number[node] + 2];
    });
    for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
    neighbours_.resize(first_.back());
    for_ends([&](std::uint32_t node, std::uint32_t other) {
      neighbours_[first_[number[node] + 1]++] = number[other];
    });
  }

  /// The points, sorted by accuracy in powers of two.
  std::vector<std::uint32_t> best_known_first() const {
    constexpr int worst = 127;
    std::vector<std::uint8_t> rank(points_.size());
    std::array<std::uint32_t, worst + 2> begin{};
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double known = spread(points_[i]);
      rank[i] = static_cast<std::uint8_t>(known > 0 ? std::clamp(2 - std::ilogb(known), 0, worst)
                                                    : worst);
      ++begin[rank[i] + 1u];
    }
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    std::vector<std::uint32_t> order(points_.size());
    for (std::uint32_t i = 0; i < points_.size(); ++i) order[begin[rank[i]]++] = i;
    return order;
  }

  /// Whether a disk can replace a Voronoi point: it touches the elements, and their carriers, so
  /// that no edge bends.
  bool touches(std::uint32_t node, const Disk& disk) const {
    const auto touched = graph_.touched(node);
    return std::all_of(touched.rbegin(), touched.rend(), [&](std::uint32_t element) {
      const site::Site& site = elements_.sites[element];
      return std::abs(site::gap(site, disk)) <= slack_ &&
             std::abs(site::carrier_distance(site, disk.center) - disk.radius) <= slack_;
    });
  }

  /// Twice the area of the triangle of the unit vectors to a Voronoi point's feet: the determinant
  /// of its equations. Not a number at the centre of an arc.
  double spread(std::uint32_t node) const {
    std::array<Vec2, 3> g;
    const auto touched = graph_.touched(node);
    for (std::size_t k = 0; k < 3; ++k)
      g[k] = site::outward(elements_.sites[touched[k]], graph_.disk(node).center);
    return std::abs(cross(g[1] - g[0], g[2] - g[0]));
  }

  Graph& graph_;
  const Elements& elements_;
  double slack_;
  std::vector<std::uint32_t> edges_;   ///< that may have no length
  std::vector<std::uint32_t> points_;  ///< their ends, numbered
  std::vector<std::uint32_t> first_, neighbours_;
};

}  // namespace

void join_ties(Graph& graph, double tolerance) {
  Ties ties(graph, 0.5 * tolerance);
  if (ties.empty()) return;
  ties.join();
  ties.straighten(tolerance);
}

bool is_right_locally(const Graph& graph, double slack) {
  // If a tie is not exactly one disk, a mirror image may choose other points of it.
  constexpr double near = 32, narrow = 16;
  const auto is_near_tie = [&](std::uint32_t edge) {
    const Disk &from = graph.disk(edge), &to = graph.disk(graph.to(edge));
    return !is_same(from, to) && distance(from.center, to.center) <= near * slack;
  };
  const auto& doubtful = graph.doubtful_edges();
  if (std::any_of(doubtful.begin(), doubtful.end(), is_near_tie)) return false;
  const Elements& elements = graph.elements();
  // The distance by which a disk misses the elements of a node; negative if it reaches over them.
  const auto reach = [&](std::uint32_t node, const Disk& disk, double& least, double& most) {
    for (const std::uint32_t i : graph.touched(node)) {
      const double gap = site::gap(elements.sites[i], disk);
      least = std::min(least, gap);
      most = std::isnan(gap) ? std::numeric_limits<double>::infinity() : std::max(most, gap);
    }
  };
  // Next to the centre of an arc, a disk may touch the arc's end and reach over its circle.
  const auto reaches_over_circle = [&](std::uint32_t node) {
    const Disk& disk = graph.disk(node);
    const auto touched = graph.touched(node);
    return std::any_of(touched.begin(), touched.end(), [&](std::uint32_t i) {
      return elements.is_convex_arc(i) &&
             site::carrier_distance(elements.sites[i], disk.center) < disk.radius - slack;
    });
  };
  double least = 0, most = 0, any = 0;
  for (const Elements::ChainLoop& loop : elements.loops)
    graph.for_edges(loop, [&](std::uint32_t edge) {
      const bool from_node = graph.disk(edge).radius > 0 && !graph.begins_at_bridge(edge);
      if (from_node) reach(edge, graph.disk(edge), least, most);
      // If a shape is not much wider than the tolerance, rounding turns its sides.
      const bool is_narrow = graph.disk(edge).radius <= narrow * slack;
      if (from_node && (is_narrow || reaches_over_circle(edge)))
        most = std::numeric_limits<double>::infinity();
      const std::uint32_t end = graph.to(edge);
      if (!from_node || !(graph.disk(end).radius > 0)) return;
      reach(edge, graph.disk(end), least, any);
      reach(end, graph.disk(edge), least, any);
      if (graph.runs_backward(edge, slack)) most = std::numeric_limits<double>::infinity();
    });
  return least >= -slack && most <= slack;
}

}  // namespace medial::lee
