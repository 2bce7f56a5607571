#include "engines/lee/ties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/bisector.h"

namespace medial::lee {
namespace {

/// Voronoi points that may be one, with what tells how well each is known.
class Ties {
 public:
  Ties(Graph& graph, const Elements& elements, double slack)
      : graph_(graph), elements_(elements), slack_(slack) {
    for (const Graph::Edge& edge : graph.edges) {
      if (edge.spoke || graph.nodes[edge.from].radius == 0 || graph.nodes[edge.to].radius == 0)
        continue;
      if (touches(edge.from, graph.nodes[edge.to]) || touches(edge.to, graph.nodes[edge.from])) {
        links_.emplace_back(edge.from, edge.to);
        links_.emplace_back(edge.to, edge.from);
        edges_.push_back(&edge);
      }
    }
    std::sort(links_.begin(), links_.end());
  }

  /// From the best known point outward, all that its disk touches become its disk.
  void join() {
    std::vector<std::pair<double, std::size_t>> order;  // by how badly known; the first link
    for (std::size_t i = 0; i < links_.size(); ++i)
      if (i == 0 || links_[i].first != links_[i - 1].first)
        order.emplace_back(-spread(links_[i].first), i);
    std::sort(order.begin(), order.end());
    std::vector<bool> is_joined(links_.size(), false);  // of the first link of each node
    std::vector<std::size_t> open;
    for (const auto& [unused, start] : order) {
      if (is_joined[start]) continue;
      is_joined[start] = true;
      const Disk disk = graph_.nodes[links_[start].first];
      open.assign(1, start);
      while (!open.empty()) {
        std::size_t i = open.back();
        open.pop_back();
        const std::uint32_t node = links_[i].first;
        for (; i < links_.size() && links_[i].first == node; ++i) {
          const std::uint32_t next = links_[i].second;
          const auto first = static_cast<std::size_t>(
              std::lower_bound(links_.begin(), links_.end(), std::pair{next, std::uint32_t{0}}) -
              links_.begin());
          if (is_joined[first] || !touches(next, disk)) continue;
          is_joined[first] = true;
          graph_.nodes[next] = disk;
          open.push_back(first);
        }
      }
    }
  }

  /// Where the borders of such sets have changed places, their ends move on one by one, with a
  /// little more slack.
  void straighten() {
    slack_ *= 2;
    constexpr int most_rounds = 16;
    bool is_straight = false;
    for (int round = 0; round < most_rounds && !is_straight; ++round) {
      is_straight = true;
      for (const Graph::Edge* edge : edges_) {
        Disk &from = graph_.nodes[edge->from], &to = graph_.nodes[edge->to];
        if (from.center == to.center) continue;
        const geometry::Bisector bisector(elements_.sites[edge->element[1]],
                                          elements_.sites[edge->element[0]]);
        if (bisector.position(from.center) <= bisector.position(to.center)) continue;
        is_straight = false;
        if (touches(edge->from, to))
          from = to;
        else if (touches(edge->to, from))
          to = from;
      }
    }
  }

 private:
  /// Whether a disk could stand for a Voronoi point: it touches the elements, and their carriers,
  /// so that no edge is bent.
  bool touches(std::uint32_t node, const Disk& disk) const {
    const auto& touched = graph_.touched[node];
    return std::all_of(touched.rbegin(), touched.rend(), [&](std::uint32_t element) {
      const geometry::Site& site = elements_.sites[element];
      const double squared = geometry::squared_distance(site, disk.center);
      return std::abs(std::sqrt(squared) - disk.radius) <= slack_ &&
             std::abs(geometry::carrier_distance(site, disk.center) - disk.radius) <= slack_;
    });
  }

  /// Twice the area of the triangle of the unit vectors to a Voronoi point's feet: the determinant
  /// of its equations.
  double spread(std::uint32_t node) const {
    std::array<Vec2, 3> g;
    for (std::size_t k = 0; k < 3; ++k)
      g[k] = geometry::outward(elements_.sites[graph_.touched[node][k]], graph_.nodes[node].center);
    return std::abs(cross(g[1] - g[0], g[2] - g[0]));
  }

  Graph& graph_;
  const Elements& elements_;
  double slack_;
  std::vector<const Graph::Edge*> edges_;                       ///< that may have no length
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links_;  ///< both ways, sorted
};

}  // namespace

void join_ties(Graph& graph, const Elements& elements, double tolerance) {
  Ties ties(graph, elements, 0.5 * tolerance);
  ties.join();
  ties.straighten();
}

}  // namespace medial::lee
