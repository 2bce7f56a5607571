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

/// Numbers in groups, all in one array: first they are counted, then they are put in place.
class Groups {
 public:
  explicit Groups(std::size_t count) : begin_(count + 2, 0) {}
  void count(std::uint32_t group) { ++begin_[group + 2]; }
  void end_count() {
    for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    items_.resize(begin_.back());
  }
  void put(std::uint32_t group, std::uint32_t item) { items_[begin_[group + 1]++] = item; }
  std::span<const std::uint32_t> operator[](std::uint32_t group) const {
    return std::span(items_).subspan(begin_[group], begin_[group + 1] - begin_[group]);
  }

 private:
  std::vector<std::uint32_t> begin_, items_;
};

template <class ForAll>
void for_both_passes(Groups& groups, const ForAll& for_all) {
  for_all([&](std::uint32_t group, std::uint32_t) { groups.count(group); });
  groups.end_count();
  for_all([&](std::uint32_t group, std::uint32_t item) { groups.put(group, item); });
}

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
  const auto is_short = [&](const Graph::Edge& edge, double window) {
    const Disk &from = graph.nodes[edge.from], &to = graph.nodes[edge.to];
    return from.radius > 0 && to.radius > 0 &&
           squared_norm(from.center - to.center) <= window * window;
  };
  // The nodes that may be tied, numbered, and what they touch.
  std::vector<std::uint32_t> tied_edges, tied, number;
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e)
    if (!graph.edges[e].spoke && is_short(graph.edges[e], windows.front())) tied_edges.push_back(e);
  if (tied_edges.empty()) return;
  number.assign(graph.nodes.size(), none);
  for (const std::uint32_t e : tied_edges)
    for (const std::uint32_t node : {graph.edges[e].from, graph.edges[e].to})
      if (number[node] == none) {
        number[node] = static_cast<std::uint32_t>(tied.size());
        tied.push_back(node);
      }
  Groups touched(tied.size());
  for_both_passes(touched, [&](const auto& add) {
    for (const Graph::Edge& edge : graph.edges)
      for (const std::uint32_t node : {edge.from, edge.to})
        if (number[node] != none)
          for (const std::uint32_t element : edge.element) add(number[node], element);
  });

  std::vector<bool> is_joined(tied.size(), false);
  std::vector<std::uint32_t> own;
  for (const double window : windows) {
    Sets sets(tied.size());
    for (const std::uint32_t e : tied_edges) {
      const Graph::Edge& edge = graph.edges[e];
      const std::uint32_t from = number[edge.from], to = number[edge.to];
      if (!is_joined[from] && !is_joined[to] && is_short(edge, window)) sets.join(from, to);
    }
    Groups members(tied.size());
    for_both_passes(members, [&](const auto& add) {
      for (std::uint32_t i = 0; i < tied.size(); ++i) add(sets.find(i), i);
    });
    for (std::uint32_t set = 0; set < tied.size(); ++set) {
      const std::span<const std::uint32_t> points = members[set];
      if (points.size() < 2) continue;
      own.clear();
      for (const std::uint32_t point : points)
        own.insert(own.end(), touched[point].begin(), touched[point].end());
      const auto disk = fitted_disk(elements, own, graph.nodes[tied[set]]);
      if (!disk || largest_residual(elements, own, *disk) > 0.5 * tolerance) continue;
      // Other edges are longer than the window: none of them turns round.
      const bool is_near = std::all_of(points.begin(), points.end(), [&](std::uint32_t point) {
        return distance(graph.nodes[tied[point]].center, disk->center) <= window;
      });
      if (!is_near) continue;
      for (const std::uint32_t point : points) {
        graph.nodes[tied[point]] = *disk;
        is_joined[point] = true;
      }
    }
  }
}

}  // namespace medial::lee
