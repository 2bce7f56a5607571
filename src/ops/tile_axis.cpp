#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/compat.h"
#include "base/in_flight.h"
#include "base/random.h"
#include "base/tolerance.h"
#include "medial/planar_graph.h"
#include "ops/tiles.h"
#include "shape/around.h"
#include "shape/clean.h"
#include "voronoi/axis_around.h"

namespace medial {
namespace {

/// The largest value along a rational quadratic with the values a, b, c and the weights 1, w, 1.
double largest_value(double a, double b, double c, double w) {
  if (b <= std::max(a, c)) return std::max(a, c);  // it lies in the hull of its control points
  // With s = t / (1 - t), its slope has the sign of p + m s + q s^2, where p > 0 > q.
  const double p = w * (b - a), m = c - a, q = w * (c - b);
  const double root = std::sqrt(m * m - 4 * p * q);
  const double part = m >= 0 ? m + root : 2 * p, rest = m >= 0 ? -2 * q : root - m;
  const double t = part / (part + rest), u = rest / (part + rest);
  const double summit =
      (u * u * a + 2 * w * t * u * b + t * t * c) / (u * u + 2 * w * t * u + t * t);
  return std::max({a, c, summit});
}

/// The box around all disks of an edge.
Box box_of_disks(const Disk& from, const Disk& control, const Disk& to, double weight) {
  const auto farthest = [&](double x, double y) {
    const auto value = [&](const Disk& d) { return x * d.center.x + y * d.center.y + d.radius; };
    return largest_value(value(from), value(control), value(to), weight);
  };
  return {{-farthest(-1, 0), -farthest(0, -1)}, {farthest(1, 0), farthest(0, 1)}};
}

/// Whether a box lies inside another, and farther from its border than that.
bool is_inside(const Box& box, const Box& window, double slack) {
  return box.low.x > window.low.x + slack && box.low.y > window.low.y + slack &&
         box.high.x < window.high.x - slack && box.high.y < window.high.y - slack;
}

/// The planar graph of a tile's edges.
struct TileGraph {
  std::vector<std::uint32_t> chain_begin;  ///< of each chain its first edge
  PlanarGraph graph;

  std::uint32_t edge_of(std::uint32_t half_edge) const {
    const VertexSource& source = graph.edges[half_edge / 2].source;
    return chain_begin[source.ring] + source.vertex;
  }
};

/// Edges that follow each other become one chain.
Result<TileGraph> graph_of(std::span<const TileEdge> edges) {
  TileGraph tile;
  std::vector<Chain> chains;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    if (i == 0 || edges[i].number != edges[i - 1].number + 1 ||
        !(edges[i].from == edges[i - 1].to)) {
      tile.chain_begin.push_back(i);
      chains.emplace_back().points.push_back(edges[i].from);
    }
    chains.back().points.push_back(edges[i].to);
  }
  auto graph = build_planar_graph(chains);
  if (!graph) {
    graph.error().place.ring = graph.error().place.vertex = std::nullopt;  // of the tile's chains
    return std::move(graph).error();
  }
  if (graph->edges.size() != edges.size())
    return Error{ErrorCode::malformed, "the edges of a tile repeat or touch each other", {}};
  tile.graph = std::move(graph).value();
  return tile;
}

/// The diagram of a tile's edges on both of their sides, and its final edges.
class TileAxis {
 public:
  TileAxis(std::span<const TileEdge> edges, const TileGraph& tile, const MedialAxis& axis)
      : edges_(edges), tile_(tile), axis_(axis) {
    boxes_.reserve(axis.edges.size());
    for (const Edge& edge : axis.edges)
      boxes_.push_back(
          box_of_disks(disk(edge.node[0]), edge.control, disk(edge.node[1]), edge.weight));
    for (const Site& site : axis.sites) numbers_.push_back(number_of(site));
    name_nodes();
  }

  /// Sites that disks of edges outside the window touch, at their ends too.
  std::vector<TileEdge> open(const Box& window, double slack) const {
    std::vector<bool> open_node(axis_.nodes.size(), false), touched(edges_.size(), false);
    std::vector<bool> touched_point(tile_.graph.points.size(), false);
    for (std::size_t i = 0; i < axis_.edges.size(); ++i)
      if (at_enclosure(i) || !is_inside(boxes_[i], window, slack))
        for (const std::uint32_t node : axis_.edges[i].node) open_node[node] = true;
    for (const Edge& edge : axis_.edges) {
      if (!open_node[edge.node[0]] && !open_node[edge.node[1]]) continue;
      for (const std::uint32_t i : edge.site) {
        const Site& site = axis_.sites[i];
        if (site.ring == no_index) continue;
        if (site.kind() == SiteKind::vertex)
          touched_point[site.ring] = true;
        else
          touched[tile_.edge_of(site.vertex)] = true;
      }
    }
    const auto& planar = tile_.graph.edges;
    for (std::uint32_t e = 0; e < planar.size(); ++e)
      if (touched_point[planar[e].from] || touched_point[planar[e].to])
        touched[tile_.edge_of(2 * e)] = true;
    std::vector<TileEdge> result;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (touched[i]) result.push_back(edges_[i]);
    return result;
  }

  /// Edges of the interior that lie in the window, and in none of those whose edges are final.
  std::vector<TileAxisEdge> final(const Box& window, std::span<const Box> done,
                                  double slack) const {
    const auto is_new = [&](const Box& box) {
      return is_inside(box, window, slack) && ranges::none_of(done, [&](const Box& other) {
               return is_inside(box, other, 2 * slack);
             });
    };
    std::vector<TileAxisEdge> result;
    for (std::size_t i = 0; i < axis_.edges.size(); ++i) {
      const Edge& edge = axis_.edges[i];
      if (!is_interior(edge.site[0]) || !is_interior(edge.site[1]) || !is_new(boxes_[i])) continue;
      const std::size_t low = numbers_[edge.site[0]] <= numbers_[edge.site[1]] ? 0 : 1;
      const std::uint32_t from = edge.node[low], to = edge.node[1 - low];
      result.push_back({{names_[from], names_[to]},
                        {numbers_[edge.site[low]], numbers_[edge.site[1 - low]]},
                        {disk(from), disk(to)},
                        {degrees_[from], degrees_[to]},
                        edge.control,
                        edge.weight});
    }
    return result;
  }

 private:
  static constexpr std::uint64_t outside = ~std::uint64_t{0};

  const Disk& disk(std::uint32_t node) const { return axis_.nodes[node].disk; }
  bool is_interior(std::uint32_t site) const { return numbers_[site] != outside; }
  bool at_enclosure(std::size_t edge) const {
    return ranges::any_of(axis_.edges[edge].site,
                          [&](std::uint32_t site) { return axis_.sites[site].ring == no_index; });
  }
  /// The number that all tiles have for a site of the interior, else `outside`. A vertex has the
  /// interior around it if the edge that begins there has it on its left.
  std::uint64_t number_of(const Site& site) const {
    if (site.ring == no_index) return outside;
    const std::uint32_t half_edge = site.vertex;
    const TileEdge& edge = edges_[tile_.edge_of(half_edge)];
    if (!(tile_.graph.points[start_of(tile_.graph, half_edge)] == edge.from)) return outside;
    return 2 * edge.number + (site.kind() == SiteKind::vertex ? 1 : 0);
  }

  /// Names and degrees of the nodes. A name is made of the sites on both sides of each edge that
  /// leaves: no two nodes have the same ones, and all tiles that have the node have the same sites.
  /// It is a sum of random numbers that they stand for: two of n nodes get one name by chance, in
  /// one of 2^65 / n^2 axes.
  void name_nodes() {
    names_.resize(axis_.nodes.size());
    degrees_.resize(axis_.nodes.size());
    const auto leave = [&](std::uint32_t node, std::uint32_t right, std::uint32_t left) {
      names_[node] += Random(Random(numbers_[right]).next() ^ numbers_[left]).next();
      ++degrees_[node];
    };
    for (const Edge& edge : axis_.edges) {
      leave(edge.node[0], edge.site[1], edge.site[0]);
      leave(edge.node[1], edge.site[0], edge.site[1]);
    }
  }

  std::span<const TileEdge> edges_;
  const TileGraph& tile_;
  const MedialAxis& axis_;
  std::vector<Box> boxes_;              ///< of the disks of each edge
  std::vector<std::uint64_t> numbers_;  ///< of each site
  std::vector<std::uint64_t> names_;    ///< of each node
  std::vector<std::uint32_t> degrees_;
};

/// The axis around a tile's planar graph, in an enclosure that no disk of the interior within the
/// window comes near to.
Result<MedialAxis> axis_of(const TileGraph& tile, const TileGrid& grid, const Box& window,
                           const Options& options) {
  const auto& [low, high] = grid.box;
  Box box = bounding_box(tile.graph);
  box.add(Box{{std::max(low.x, window.low.x), std::max(low.y, window.low.y)},
              {std::min(high.x, window.high.x), std::min(high.y, window.high.y)}});
  const double away = 0.5 * diagonal(box);
  box = {box.low - Vec2{away, away}, box.high + Vec2{away, away}};
  // Of the grid's size alone: axis_around() adds what coordinates far from the origin ask for.
  const double tolerance = tolerance_for({{0, 0}, high - low}, options.tolerance);
  Options own;
  own.tolerance = relative_tolerance(tolerance, box);
  own.threads = options.threads;
  own.cancel = options.cancel;
  auto axis = axis_around(tile.graph, around(tile.graph, box), own, false);
  if (!axis) axis.error().place.ring = axis.error().place.vertex = std::nullopt;
  return axis;
}

}  // namespace

Result<TilePart> axis_of_tile(std::span<const TileEdge> edges, const TileGrid& grid, int level,
                              std::uint32_t column, std::uint32_t row, const Options& options) {
  try {
    if (auto error = refuse_grid(grid, options)) return std::move(*error);
    if (edges.empty()) return TilePart{};
    auto tile = graph_of(edges);
    if (!tile) return std::move(tile).error();
    const Box window = grid.window(level, column, row);
    auto axis = axis_of(*tile, grid, window, options);
    if (!axis) return std::move(axis).error();
    std::vector<Box> done;
    for (std::uint32_t i = 0; level < grid.levels && i < 4; ++i)
      done.push_back(grid.window(level + 1, 2 * column + i % 2, 2 * row + i / 2));
    const TileAxis parts(edges, *tile, *axis);
    TilePart part{parts.final(window, done, grid.slack()), {}};
    if (level > 0) part.open = parts.open(window, 2 * grid.slack());
    return part;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
