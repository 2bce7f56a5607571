#include "medial/tiles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "axis/node_kinds.h"
#include "base/compat.h"
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
double line_of(double low, double high, int level, std::uint32_t i) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const double share = std::ldexp(i, -level);
  return share <= 0 ? -endless : share >= 1 ? endless : low + share * (high - low);
}

/// The leaf along one side in which a coordinate lies.
std::uint32_t leaf_of(double low, double high, int levels, double x) {
  const double share = high > low ? (x - low) / (high - low) : 0;
  const double count = std::ldexp(1, levels);
  return static_cast<std::uint32_t>(std::clamp(std::floor(share * count), 0.0, count - 1));
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

/// Calls visit(column, row) for the leaves that an edge meets or comes near to.
template <class Visit>
void for_each_leaf(const TileGrid& grid, Vec2 a, Vec2 b, Visit&& visit) {
  const auto& [low, high] = grid.box;
  const double slack = grid.slack();
  if (a.y > b.y) std::swap(a, b);
  const std::uint32_t first = leaf_of(low.y, high.y, grid.levels, a.y - slack),
                      last = leaf_of(low.y, high.y, grid.levels, b.y + slack);
  const auto x_at = [&](double y) {
    return y <= a.y ? a.x : y >= b.y ? b.x : a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
  };
  for (std::uint32_t row = first; row <= last; ++row) {
    const double bottom = line_of(low.y, high.y, grid.levels, row) - slack,
                 top = line_of(low.y, high.y, grid.levels, row + 1) + slack;
    const double x = x_at(bottom), other = x_at(top);
    const std::uint32_t end =
        leaf_of(low.x, high.x, grid.levels, std::max(x, other) + slack);
    for (std::uint32_t column = leaf_of(low.x, high.x, grid.levels, std::min(x, other) - slack);
         column <= end; ++column)
      visit(column, row);
  }
}

Tiles leaves_of(const Shape& shape, const TileGrid& grid) {
  Tiles leaves(grid.levels);
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    const std::uint32_t begin = shape.loop_begin[loop], end = shape.loop_begin[loop + 1];
    for (std::uint32_t k = begin; k < end; ++k) {
      const TileEdge edge{shape.points[k], shape.points[k + 1 == end ? begin : k + 1], k};
      for_each_leaf(grid, edge.from, edge.to, [&](std::uint32_t column, std::uint32_t row) {
        leaves.at(column, row).push_back(edge);
      });
    }
  }
  return leaves;
}

/// The open edges of four children, each once, in their order.
std::vector<TileEdge> joined(const std::vector<TilePart>& parts, int level, std::uint32_t column,
                             std::uint32_t row) {
  std::vector<TileEdge> edges;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto& open =
        parts[(std::size_t{2 * row + i / 2} << (level + 1)) + 2 * column + i % 2].open;
    edges.insert(edges.end(), open.begin(), open.end());
  }
  const auto number = [](const TileEdge& edge) { return edge.number; };
  ranges::sort(edges, {}, number);
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [](const TileEdge& a, const TileEdge& b) { return a.number == b.number; }),
              edges.end());
  return edges;
}

/// Works out all tiles of a level, each alone where there are many.
std::vector<TilePart> parts_of(const Tiles& tiles, const TileGrid& grid, const Options& options,
                               const std::function<void()>& done, std::optional<Error>& error) {
  Options own = options;
  if (static_cast<int>(tiles.edges.size()) >= 4 * effective_threads(options.threads)) own.threads = 1;
  std::vector<TilePart> parts(tiles.edges.size());
  std::vector<std::optional<Error>> errors(tiles.edges.size());
  const auto work = [&](std::size_t i) {
    auto part = axis_of_tile(tiles.edges[i], grid, tiles.level,
                             static_cast<std::uint32_t>(i % tiles.side()),
                             static_cast<std::uint32_t>(i / tiles.side()), own);
    if (part)
      parts[i] = std::move(part).value();
    else
      errors[i] = std::move(part).error();
    done();
  };
  if (own.threads == 1)
    on_threads(options.threads, [&] { parallel_for(parts.size(), work); });
  else
    for (std::size_t i = 0; i < parts.size(); ++i) work(i);
  const auto first = ranges::find_if(errors, [](const auto& one) { return one.has_value(); });
  if (first != errors.end()) error = std::move(*first);
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
  const auto refused = [](ErrorCode code, const char* text) { return Error{code, text, {}}; };
  if (has_arcs(shape))
    return refused(ErrorCode::unsupported, "tiles take straight edges only: sample the arcs first");
  if (options.exterior || options.exact || !std::holds_alternative<method::Disks>(options.method))
    return refused(ErrorCode::invalid_option,
                   "tiles take the method disks, of the interior, without --exact");
  if (grid.levels < 0 || grid.levels > TileGrid::most_levels)
    return refused(ErrorCode::invalid_option, "the number of levels must be in [0, 10]");
  constexpr double tolerances = 0x1p10;
  if (!(grid.slack() > tolerances * tolerance_for(grid.box, options.tolerance)))
    return refused(ErrorCode::invalid_option,
                   "the tiles are too small for the tolerance: take fewer levels");
  return std::nullopt;
}

}  // namespace

Box TileGrid::window(int level, std::uint32_t column, std::uint32_t row) const {
  return {{line_of(box.low.x, box.high.x, level, column), line_of(box.low.y, box.high.y, level, row)},
          {line_of(box.low.x, box.high.x, level, column + 1),
           line_of(box.low.y, box.high.y, level, row + 1)}};
}

double TileGrid::slack() const {
  constexpr double of_leaf = 0x1p-20;
  return std::ldexp(of_leaf * std::min(box.high.x - box.low.x, box.high.y - box.low.y), -levels);
}

Result<MedialAxis> join_tiles(const Shape& shape, std::vector<TileAxisEdge> edges,
                              const Options& options) {
  try {
    const Problem problem(shape, options);
    const std::vector<std::uint32_t>& site_of_edge = problem.numbers().edge;
    for (TileAxisEdge& edge : edges) {
      if (edge.site[0] / 2 >= site_of_edge.size() || edge.site[1] / 2 >= site_of_edge.size())
        return Error{ErrorCode::malformed, "the tiles are of another shape", {}};
      if (edge.site[0] <= edge.site[1]) continue;
      std::swap(edge.site[0], edge.site[1]);
      std::swap(edge.node[0], edge.node[1]);
      std::swap(edge.disk[0], edge.disk[1]);
    }
    const auto key = [](const TileAxisEdge& edge) { return std::tie(edge.site, edge.node); };
    std::stable_sort(edges.begin(), edges.end(), [&](const TileAxisEdge& a, const TileAxisEdge& b) {
      return key(a) < key(b);
    });
    edges.erase(std::unique(edges.begin(), edges.end(),
                            [&](const TileAxisEdge& a, const TileAxisEdge& b) {
                              return key(a) == key(b);
                            }),
                edges.end());

    std::vector<std::uint64_t> names;
    names.reserve(2 * edges.size());
    for (const TileAxisEdge& edge : edges) names.insert(names.end(), edge.node.begin(), edge.node.end());
    ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    std::vector<std::uint32_t> loop_of;
    for (std::size_t loop = 0; loop < shape.loop_count(); ++loop)
      loop_of.resize(shape.loop_begin[loop + 1], static_cast<std::uint32_t>(loop));

    MedialAxis axis;
    axis.method = "disks";
    axis.tolerance = problem.tolerance;
    axis.sites = problem.result_sites();
    std::vector<std::uint32_t> number(names.size(), no_index);  // in the order of the edges
    axis.edges.reserve(edges.size());
    for (const TileAxisEdge& edge : edges) {
      Edge own{{}, {}, edge.control, edge.weight};
      for (std::size_t i = 0; i < 2; ++i) {
        own.site[i] = site_of_edge[edge.site[i] / 2] - static_cast<std::uint32_t>(edge.site[i] % 2);
        auto& node = number[static_cast<std::size_t>(ranges::lower_bound(names, edge.node[i]) -
                                                     names.begin())];
        if (node == no_index) {
          node = static_cast<std::uint32_t>(axis.nodes.size());
          axis.nodes.push_back({edge.disk[i], shape.component[loop_of[edge.site[0] / 2]], {}});
        }
        own.node[i] = node;
      }
      axis.edges.push_back(own);
    }
    if (!has_right_topology(shape, axis.nodes, axis.edges))
      return Error{ErrorCode::internal, "the tiles make no whole axis: please report this shape", {}};
    set_node_kinds(axis);
    return axis;
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
    // Each level costs about as much as the leaves below it have edges.
    std::atomic<std::size_t> finished = 0;
    const double count = (std::ldexp(4, 2 * levels) - 1) / 3;
    const auto done = [&] {
      if (options.progress) options.progress(std::min(1.0, static_cast<double>(++finished) / count));
    };
    Tiles tiles = leaves_of(shape, grid);
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
