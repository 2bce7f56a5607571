#include "ops/tiles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "axis/node_kinds.h"
#include "base/compat.h"
#include "base/disjoint_sets.h"
#include "base/in_flight.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "base/tolerance.h"
#include "methods/checks.h"
#include "methods/problem.h"
#include "shape/clean.h"

namespace medial {
namespace {

/// One of the lines that divide a side of the grid into 2^level parts; open at the rim.
double line_of(double low, double side, int level, std::uint32_t i) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const double share = std::ldexp(i, -level);
  return share <= 0 ? -endless : share >= 1 ? endless : low + share * side;
}

/// The leaf along one side in which a coordinate lies.
std::uint32_t leaf_of(double low, double side, int levels, double x) {
  const double count = std::ldexp(1, levels);
  return static_cast<std::uint32_t>(
      std::clamp(std::floor((x - low) / side * count), 0.0, count - 1));
}

/// The tiles of one level by column and row, each with its edges.
struct Tiles {
  explicit Tiles(int at_level) : level(at_level), edges(std::size_t{1} << (2 * at_level)) {}
  int level;
  std::vector<std::vector<TileEdge>> edges;

  std::uint32_t side() const { return std::uint32_t{1} << level; }
  std::vector<TileEdge>& at(std::uint32_t column, std::uint32_t row) {
    return edges[(std::size_t{row} << level) + column];
  }
};

/// Calls take(edge, edges of the leaf) for each edge and each leaf that it meets, until one returns
/// false. Whether none did.
template <class Take>
bool for_leaves(const Shape& shape, const TileGrid& grid, Tiles& leaves, const Take& take) {
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const std::uint32_t begin = shape.loop_begin[loop], end = shape.loop_begin[loop + 1];
    for (std::uint32_t k = begin; k < end; ++k) {
      const TileEdge edge{shape.points[k], shape.points[k + 1 == end ? begin : k + 1], k};
      for (const auto& [column, row] : leaves_of(grid, edge))
        if (!take(edge, leaves.at(column, row))) return false;
    }
  }
  return true;
}

/// The leaves with their edges. Errors: invalid_option, where they would take far more memory than
/// the edges alone.
Result<Tiles> leaves_with_edges(const Shape& shape, const TileGrid& grid) {
  const std::uint64_t most = 64 * std::uint64_t{shape.points.size()} + (1 << 20);
  Tiles leaves(grid.levels);
  std::vector<std::uint32_t> counts(leaves.edges.size());
  std::uint64_t sum = 0;
  const auto count = [&](const TileEdge&, const std::vector<TileEdge>& leaf) {
    ++counts[static_cast<std::size_t>(&leaf - leaves.edges.data())];
    return ++sum <= most;
  };
  if (!for_leaves(shape, grid, leaves, count))
    return Error{ErrorCode::invalid_option, "edges meet too many tiles: use fewer levels", {}};
  for (std::size_t i = 0; i < counts.size(); ++i) leaves.edges[i].reserve(counts[i]);
  for_leaves(shape, grid, leaves, [](const TileEdge& edge, std::vector<TileEdge>& leaf) {
    leaf.push_back(edge);
    return true;
  });
  return leaves;
}

/// The open edges of four children, each once, in their order.
std::vector<TileEdge> joined(const std::vector<TilePart>& parts, int level, std::uint32_t column,
                             std::uint32_t row) {
  std::vector<TileEdge> edges;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto& open =
        parts[(std::size_t{2 * row + i / 2} << (level + 1)) + (2 * column + i % 2)].open;
    edges.insert(edges.end(), open.begin(), open.end());
  }
  const auto number = [](const TileEdge& edge) { return edge.number; };
  ranges::sort(edges, {}, number);
  edges.erase(
      std::unique(edges.begin(), edges.end(),
                  [](const TileEdge& a, const TileEdge& b) { return a.number == b.number; }),
      edges.end());
  return edges;
}

/// Works out all tiles of a level, each alone where there are many.
std::vector<TilePart> parts_of(const Tiles& tiles, const TileGrid& grid, const Options& options,
                               const std::function<void()>& done, std::optional<Error>& error) {
  Options own = options;
  if (static_cast<int>(tiles.edges.size()) >= 4 * effective_threads(options.threads))
    own.threads = 1;
  std::vector<TilePart> parts(tiles.edges.size());
  std::vector<std::unique_ptr<Error>> errors(tiles.edges.size());
  const auto work = [&](std::size_t i) {
    auto part = axis_of_tile(tiles.edges[i], grid, tiles.level,
                             static_cast<std::uint32_t>(i % tiles.side()),
                             static_cast<std::uint32_t>(i / tiles.side()), own);
    if (part)
      parts[i] = std::move(part).value();
    else
      errors[i] = std::make_unique<Error>(std::move(part).error());
    done();
  };
  if (own.threads == 1)
    on_threads(options.threads, [&] { parallel_for(parts.size(), work); });
  else
    for (std::size_t i = 0; i < parts.size(); ++i) work(i);
  const auto first = ranges::find_if(errors, [](const auto& one) { return one != nullptr; });
  if (first != errors.end()) error = std::move(**first);
  return parts;
}

TileLevel row_of(const Tiles& tiles, const std::vector<TilePart>& parts) {
  TileLevel row;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::uint64_t edges = tiles.edges[i].size();
    row.tiles += edges > 0 ? 1 : 0;
    row.edges += edges;
    row.most = std::max(row.most, edges);
    row.axis += parts[i].axis.size();
  }
  return row;
}

std::optional<Error> refuse_tiles(const Shape& shape, const TileGrid& grid,
                                  const Options& options) {
  if (auto error = refuse(shape, options)) return error;
  if (has_arcs(shape))
    return Error{ErrorCode::invalid_option,
                 "tiles take straight edges only: replace the arcs by chords first",
                 {}};
  return refuse_grid(grid, options);
}

/// Sorts edges by their sites and nodes, and drops those that are there twice: what follows does
/// not depend on how the shape was divided.
void put_in_order(std::vector<TileAxisEdge>& edges) {
  const auto key = [](const TileAxisEdge& edge) { return std::tie(edge.site, edge.node); };
  std::stable_sort(edges.begin(), edges.end(),
                   [&](const TileAxisEdge& a, const TileAxisEdge& b) { return key(a) < key(b); });
  const auto same = [&](const TileAxisEdge& a, const TileAxisEdge& b) { return key(a) == key(b); };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
}

/// The names of all nodes, each once, in order.
std::vector<std::uint64_t> names_of(const std::vector<TileAxisEdge>& edges) {
  std::vector<std::uint64_t> names;
  names.reserve(2 * edges.size());
  for (const TileAxisEdge& edge : edges)
    names.insert(names.end(), edge.node.begin(), edge.node.end());
  ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Adds edges in order, and their nodes as they come. Returns of each node how many edges it lacks.
std::vector<std::uint32_t> add_edges(const Shape& shape, const site::SiteNumbers& numbers,
                                     const std::vector<TileAxisEdge>& edges, MedialAxis& axis) {
  std::vector<std::uint32_t> component;  // of each edge of the boundary
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop)
    component.resize(shape.loop_begin[loop + 1], shape.component[loop]);
  const std::vector<std::uint64_t> names = names_of(edges);
  std::vector<std::uint32_t> number(names.size(), no_index), lacking;
  axis.nodes.reserve(names.size());
  axis.edges.reserve(edges.size());
  for (const TileAxisEdge& edge : edges) {
    Edge own{{}, {}, edge.control, edge.weight};
    for (std::size_t i = 0; i < 2; ++i) {
      own.site[i] = numbers.edge[edge.site[i] / 2] - static_cast<std::uint32_t>(edge.site[i] % 2);
      const auto name = ranges::lower_bound(names, edge.node[i]) - names.begin();
      std::uint32_t& node = number[static_cast<std::size_t>(name)];
      if (node == no_index) {
        node = static_cast<std::uint32_t>(axis.nodes.size());
        axis.nodes.push_back({edge.disk[i], component[edge.site[0] / 2], NodeKind::leaf});
        lacking.push_back(edge.degree[i]);
      }
      own.node[i] = node;
      --lacking[node];
    }
    axis.edges.push_back(own);
  }
  return lacking;
}

/// Joins what lies together of the nodes that lack edges. Whether one lies alone.
bool join_close(const std::vector<std::uint32_t>& lacking, const MedialAxis& axis,
                DisjointSets& sets) {
  const double close = 0x1p10 * axis.tolerance;  // where sites hardly differ, a tie is long
  using Cell = std::array<double, 2>;            // column and row of a square of that side
  const auto place = [&](std::uint32_t node) { return axis.nodes[node].disk.center; };
  std::vector<std::pair<Cell, std::uint32_t>> open;
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node)
    if (lacking[node] != 0)
      open.push_back(
          {{std::floor(place(node).x / close), std::floor(place(node).y / close)}, node});
  std::sort(open.begin(), open.end());
  std::vector<bool> alone(axis.nodes.size(), true);
  for (const auto& [cell, a] : open)
    for (const double column : {cell[0] - 1, cell[0], cell[0] + 1}) {
      const std::pair<Cell, std::uint32_t> below{{column, cell[1] - 1}, 0};
      const Cell above{column, cell[1] + 1};
      for (auto other = std::lower_bound(open.begin(), open.end(), below);
           other != open.end() && other->first <= above; ++other) {
        const std::uint32_t b = other->second;
        if (b <= a || axis.nodes[a].component != axis.nodes[b].component ||
            distance(place(a), place(b)) > close)
          continue;
        sets.join(a, b);
        alone[a] = alone[b] = false;
      }
    }
  return ranges::any_of(open, [&](const auto& one) { return alone[one.second]; });
}

/// Sites that touch a disk to within the tolerance only may be one node in one tile and several in
/// another, each with a part of the edges. Nodes that lack edges become one where they lie
/// together; edges between them go, and so does a node that has no edge left: another tile has all
/// of them. Whether any edge is still missing.
bool join_ties(const std::vector<std::uint32_t>& lacking, MedialAxis& axis) {
  DisjointSets sets(axis.nodes.size());
  if (join_close(lacking, axis, sets)) return true;
  std::vector<bool> kept(axis.nodes.size());
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node) kept[node] = lacking[node] == 0;
  for (Edge& edge : axis.edges)
    for (std::uint32_t& node : edge.node) node = sets.find(node);
  std::erase_if(axis.edges, [](const Edge& edge) { return edge.node[0] == edge.node[1]; });
  for (const Edge& edge : axis.edges)
    for (const std::uint32_t node : edge.node) kept[node] = true;
  std::vector<std::uint32_t> number(axis.nodes.size());
  std::uint32_t count = 0;
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node) {
    number[node] = count;
    if (kept[node]) axis.nodes[count++] = axis.nodes[node];
  }
  axis.nodes.resize(count);
  for (Edge& edge : axis.edges)
    for (std::uint32_t& node : edge.node) node = number[node];
  return false;
}

}  // namespace

Box TileGrid::window(int level, std::uint32_t column, std::uint32_t row) const {
  const double x = box.low.x, y = box.low.y;
  return {{line_of(x, side(), level, column), line_of(y, side(), level, row)},
          {line_of(x, side(), level, column + 1), line_of(y, side(), level, row + 1)}};
}

std::optional<Error> refuse_grid(const TileGrid& grid, const Options& options) {
  if (auto error = refuse(options)) return error;
  const auto refused = [](const char* text) { return Error{ErrorCode::invalid_option, text, {}}; };
  if (options.exterior || options.exact || !std::holds_alternative<method::Disks>(options.method))
    return refused("tiles take the method disks, of the interior, without --exact");
  if (grid.levels < 0 || grid.levels > TileGrid::most_levels)
    return refused("the number of levels must be in [0, 10]");
  constexpr double far_above = 16;  // a disk may be off by some tolerances
  if (!(grid.slack() > far_above * tolerance_for(grid.box, options.tolerance)))
    return refused("the tiles are too small for the tolerance: use fewer levels");
  return std::nullopt;
}

std::vector<std::array<std::uint32_t, 2>> leaves_of(const TileGrid& grid, const TileEdge& edge) {
  const Vec2 low = grid.box.low;
  const double side = grid.side(), slack = grid.slack();
  const bool upward = edge.from.y <= edge.to.y;
  const Vec2 a = upward ? edge.from : edge.to, b = upward ? edge.to : edge.from;
  const auto leaf_at = [&](double from, double at) { return leaf_of(from, side, grid.levels, at); };
  const auto x_at = [&](double y) {
    return y <= a.y ? a.x : y >= b.y ? b.x : a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
  };
  std::vector<std::array<std::uint32_t, 2>> leaves;
  const std::uint32_t last_row = leaf_at(low.y, b.y + slack);
  for (std::uint32_t row = leaf_at(low.y, a.y - slack); row <= last_row; ++row) {
    const double bottom = x_at(line_of(low.y, side, grid.levels, row) - slack),
                 top = x_at(line_of(low.y, side, grid.levels, row + 1) + slack);
    const std::uint32_t last = leaf_at(low.x, std::max(bottom, top) + slack);
    for (std::uint32_t column = leaf_at(low.x, std::min(bottom, top) - slack); column <= last;
         ++column)
      leaves.push_back({column, row});
  }
  return leaves;
}

Result<MedialAxis> join_tiles(const Shape& shape, std::vector<TileAxisEdge> edges,
                              const Options& options) {
  try {
    const Problem problem(shape, options);
    if (ranges::any_of(edges, [&](const TileAxisEdge& edge) {
          return std::max(edge.site[0], edge.site[1]) / 2 >= shape.points.size();
        }))
      return Error{ErrorCode::malformed, "the tiles are of another shape", {}};
    return on_threads(options.threads, [&]() -> Result<MedialAxis> {
      put_in_order(edges);
      MedialAxis axis;
      axis.method = "disks";
      axis.tolerance = problem.tolerance;
      axis.sites = problem.result_sites();
      const auto lacking = add_edges(shape, problem.numbers(), edges, axis);
      if (join_ties(lacking, axis) || !has_right_topology(shape, axis.nodes, axis.edges))
        return Error{
            ErrorCode::internal, "the tiles do not make a whole axis: one seems to be missing", {}};
      set_node_kinds(axis);
      return axis;
    });
  } catch (...) {
    return error_in_flight();
  }
}

Result<MedialAxis> compute_in_tiles(const Shape& shape, int levels, const Options& options,
                                    std::vector<TileLevel>* report) {
  try {
    const TileGrid grid{bounding_box(shape), levels};
    if (auto error = refuse_tiles(shape, grid, options)) return std::move(*error);
    Stopwatch all;
    std::vector<TileLevel> rows(static_cast<std::size_t>(levels) + 1);
    std::vector<TileAxisEdge> axis_edges;
    std::atomic<std::size_t> finished = 0;
    const double count = (std::ldexp(4, 2 * levels) - 1) / 3;  // of the tiles of all levels
    const auto done = [&] {
      if (options.progress)
        options.progress(std::min(1.0, static_cast<double>(++finished) / count));
    };
    auto leaves = leaves_with_edges(shape, grid);
    if (!leaves) return std::move(leaves).error();
    Tiles tiles = std::move(leaves).value();
    for (;;) {
      std::optional<Error> error;
      std::vector<TilePart> parts = parts_of(tiles, grid, options, done, error);
      if (error) return std::move(*error);
      rows[static_cast<std::size_t>(tiles.level)] = row_of(tiles, parts);
      for (const TilePart& part : parts)
        axis_edges.insert(axis_edges.end(), part.axis.begin(), part.axis.end());
      if (tiles.level == 0) break;
      tiles = Tiles(tiles.level - 1);
      for (std::uint32_t row = 0; row < tiles.side(); ++row)
        for (std::uint32_t column = 0; column < tiles.side(); ++column)
          tiles.at(column, row) = joined(parts, tiles.level, column, row);
    }
    if (report != nullptr) *report = std::move(rows);
    auto axis = join_tiles(shape, std::move(axis_edges), options);
    if (!axis) return axis;
    axis->statistics.threads = effective_threads(options.threads);
    axis->statistics.seconds = all.lap();
    if (options.progress) options.progress(1);
    return axis;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
