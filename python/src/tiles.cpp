// One tile of a shape, for engines that distribute tiles over many machines.

#include "ops/tiles.h"

#include <cmath>
#include <utility>

#include "binding.h"

namespace medial::python {
namespace {

using EdgeRows = nb::ndarray<const double, nb::shape<-1, 4>, nb::c_contig, nb::device::cpu>;

TileGrid grid_of(const std::array<double, 4>& box, int levels) {
  if (levels < 0 || levels > TileGrid::most_levels)
    refuse(ErrorCode::invalid_option, "levels are from 0 to 10");
  const TileGrid grid{{{box[0], box[1]}, {box[2], box[3]}}, levels};
  for (const double value : box)
    if (!std::isfinite(value)) refuse(ErrorCode::malformed, "the box is empty");
  if (!(box[0] <= box[2] && box[1] <= box[3] && grid.side() > 0 && std::isfinite(grid.side())))
    refuse(ErrorCode::malformed, "the box is empty");
  return grid;
}

/// Errors: data that no tile of the grid accepts.
void check(const std::array<double, 4>& box, int levels, double tolerance) {
  Options options;
  options.tolerance = tolerance;
  if (auto error = refuse_grid(grid_of(box, levels), options)) throw Failure(std::move(*error));
}

/// Rows of an edge's index, and the column and row of a leaf that it meets.
Array<std::int64_t, 2> leaves(const EdgeRows& edges, const std::array<double, 4>& box, int levels) {
  const TileGrid grid = grid_of(box, levels);
  std::vector<std::array<std::int64_t, 3>> rows;
  for (std::size_t i = 0; i < edges.shape(0); ++i) {
    const double* const at = edges.data() + 4 * i;
    for (const auto& [column, row] : leaves_of(grid, {{at[0], at[1]}, {at[2], at[3]}}))
      rows.push_back({static_cast<std::int64_t>(i), column, row});
  }
  return rows_of<std::int64_t>(std::move(rows));
}

/// Computes a tile from the numbered edges. Returns the final edges as rows of two nodes, two sites
/// and two degrees, and rows of two disks, the control point and the weight; and the numbers of the
/// edges that stay open.
nb::tuple tile(const EdgeRows& edges, const Values<std::int64_t>& numbers,
               const std::array<double, 4>& box, int levels, int level, std::uint32_t column,
               std::uint32_t row, double tolerance) {
  if (numbers.shape(0) != edges.shape(0)) refuse(ErrorCode::malformed, "each edge has one number");
  const TileGrid grid = grid_of(box, levels);
  if (level < 0 || level > levels)
    refuse(ErrorCode::invalid_option, "the level of a tile is from 0 to levels");
  std::vector<TileEdge> given(edges.shape(0));
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (numbers.data()[i] < 0) refuse(ErrorCode::malformed, "numbers of edges are at least 0");
    const double* const at = edges.data() + 4 * i;
    given[i] = {{at[0], at[1]}, {at[2], at[3]}, static_cast<std::uint64_t>(numbers.data()[i])};
  }
  const TilePart part = value_of(run(given.size(), [&](const std::atomic<bool>* cancel) {
    Options options;
    options.tolerance = tolerance;
    options.threads = 1;
    options.cancel = cancel;
    return axis_of_tile(given, grid, level, column, row, options);
  }));
  std::vector<std::array<std::uint64_t, 6>> names;
  std::vector<std::array<double, 10>> curves;
  for (const TileAxisEdge& edge : part.axis) {
    names.push_back(
        {edge.node[0], edge.node[1], edge.site[0], edge.site[1], edge.degree[0], edge.degree[1]});
    std::array<double, 10>& curve = curves.emplace_back();
    auto to = curve.begin();
    for (const Disk& disk : {edge.disk[0], edge.disk[1], edge.control})
      for (const double value : {disk.center.x, disk.center.y, disk.radius}) *to++ = value;
    *to = edge.weight;
  }
  std::vector<std::int64_t> open;
  for (const TileEdge& edge : part.open) open.push_back(static_cast<std::int64_t>(edge.number));
  return nb::make_tuple(rows_of<std::int64_t>(std::move(names)), rows_of<double>(std::move(curves)),
                        array_of(std::move(open)));
}

}  // namespace

void bind_tiles(nb::module_& module) {
  module.def("check_tiles", &check, nb::arg("box"), nb::arg("levels"), nb::arg("tolerance"));
  module.def("tile_leaves", &leaves, nb::arg("edges"), nb::arg("box"), nb::arg("levels"));
  module.def("tile", &tile, nb::arg("edges"), nb::arg("numbers"), nb::arg("box"), nb::arg("levels"),
             nb::arg("level"), nb::arg("column"), nb::arg("row"), nb::arg("tolerance"));
}

}  // namespace medial::python
