#include "engines/lee/ties.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace medial::lee {
namespace {

using geometry::Site;

/// Voronoi points of a tie are known to a rounding divided by the square of the angle between their
/// feet: within the first of these for regular polygons of 1e4 vertices. Where not all points that
/// are so near to each other are one tie, those within the next may be.
constexpr std::array<double, 3> windows = {1e-8, 1e-10, 1e-12};

class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
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

double largest_residual(const Elements& elements, std::span<const std::uint32_t> touched,
                        const Disk& disk) {
  double largest = 0;
  for (const std::uint32_t i : touched)
    largest = std::max(
        largest,
        std::abs(geometry::carrier_distance(elements.sites[i], disk.center) - disk.radius));
  return largest;
}

/// The disk of least squared residuals, by Gauss and Newton's method from a disk nearby.
std::optional<Disk> fitted_disk(const Elements& elements, std::span<const std::uint32_t> touched,
                                Disk disk) {
  constexpr int steps = 3;
  for (int step = 0; step < steps; ++step) {
    // Normal equations of g.d - s = -residual in the step d of the centre and s of the radius.
    double xx = 0, xy = 0, yy = 0, x = 0, y = 0, ex = 0, ey = 0, e = 0;
    const auto count = static_cast<double>(touched.size());
    for (const std::uint32_t i : touched) {
      const Vec2 g = geometry::outward(elements.sites[i], disk.center);
      const double error = geometry::carrier_distance(elements.sites[i], disk.center) - disk.radius;
      xx += g.x * g.x, xy += g.x * g.y, yy += g.y * g.y, x += g.x, y += g.y;
      ex += g.x * error, ey += g.y * error, e += error;
    }
    // s = (g.d + error), averaged, leaves two equations for d.
    const double a = xx - x * x / count, b = xy - x * y / count, c = yy - y * y / count;
    const double u = ex - x * e / count, v = ey - y * e / count;
    const double determinant = a * c - b * b;
    if (!(determinant > 0)) return std::nullopt;
    const Vec2 d{(b * v - c * u) / determinant, (b * u - a * v) / determinant};
    disk.center = disk.center + d;
    disk.radius += (x * d.x + y * d.y + e) / count;
  }
  if (!std::isfinite(disk.center.x) || !std::isfinite(disk.center.y) || !(disk.radius > 0))
    return std::nullopt;
  return disk;
}

}  // namespace

void join_ties(Graph& graph, const Elements& elements, double tolerance) {
  std::vector<bool> is_joined(graph.nodes.size(), false);
  const auto is_short = [&](const Graph::Edge& edge, double window) {
    const Disk &from = graph.nodes[edge.from], &to = graph.nodes[edge.to];
    return from.radius > 0 && to.radius > 0 && !is_joined[edge.from] && !is_joined[edge.to] &&
           squared_norm(from.center - to.center) <= window * window;
  };
  for (const double window : windows) {
    std::vector<std::uint32_t> tied;  // edges
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e)
      if (!graph.edges[e].spoke && is_short(graph.edges[e], window)) tied.push_back(e);
    if (tied.empty()) return;
    Sets sets(graph.nodes.size());
    std::vector<bool> is_tied(graph.nodes.size(), false);
    for (const std::uint32_t e : tied) {
      const Graph::Edge& edge = graph.edges[e];
      sets.join(edge.from, edge.to);
      is_tied[edge.from] = is_tied[edge.to] = true;
    }
    // What each set's points touch, and the points themselves, set by set.
    using Member = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<Member> touched, points;
    for (const Graph::Edge& edge : graph.edges)
      for (const std::uint32_t node : {edge.from, edge.to})
        if (is_tied[node])
          for (const std::uint32_t element : edge.element)
            touched.emplace_back(sets.find(node), element);
    for (std::uint32_t node = 0; node < graph.nodes.size(); ++node)
      if (is_tied[node]) points.emplace_back(sets.find(node), node);
    const auto sort = [](std::vector<Member>& members) {
      std::sort(members.begin(), members.end());
      members.erase(std::unique(members.begin(), members.end()), members.end());
    };
    sort(touched);
    sort(points);
    std::vector<std::uint32_t> own;
    auto touches = touched.cbegin();
    for (auto point = points.cbegin(); point != points.cend();) {
      const std::uint32_t set = point->first;
      own.clear();
      for (; touches != touched.cend() && touches->first == set; ++touches)
        own.push_back(touches->second);
      const auto begin = point;
      while (point != points.cend() && point->first == set) ++point;
      const auto disk = fitted_disk(elements, own, graph.nodes[set]);
      if (!disk || largest_residual(elements, own, *disk) > 0.5 * tolerance) continue;
      // Other edges are longer than the window: none of them turns round.
      const bool is_near = std::all_of(begin, point, [&](const Member& member) {
        return distance(graph.nodes[member.second].center, disk->center) <= window;
      });
      if (!is_near) continue;
      for (auto member = begin; member != point; ++member) {
        graph.nodes[member->second] = *disk;
        is_joined[member->second] = true;
      }
    }
  }
}

}  // namespace medial::lee
