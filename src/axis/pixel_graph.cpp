#include "axis/pixel_graph.h"

#include "axis/node_kinds.h"
#include "medial/query.h"

namespace medial {
namespace {

/// Orders two sites: first the one on the left of the line from one point to another.
std::array<std::uint32_t, 2> sites_beside(const MedialAxis& axis, std::array<std::uint32_t, 2> site,
                                          Vec2 from, Vec2 to) {
  if (site[0] == no_site || site[1] == no_site) return {no_site, no_site};
  const Vec2 way = to - from;
  const double first = cross(way, foot(axis.sites[site[0]], from) - from);
  const double second = cross(way, foot(axis.sites[site[1]], from) - from);
  return first >= second ? site : std::array{site[1], site[0]};
}

/// The pixels of one row, with a cursor that moves forward.
class Row {
 public:
  Row(std::span<const MedialPixel> pixels, std::size_t begin, std::size_t end)
      : pixels_(pixels), at_(begin), end_(end) {}
  static constexpr std::size_t none = ~std::size_t{0};
  /// Finds the pixel in this column. Successive columns may decrease by at most two.
  std::size_t find(std::int64_t column) {
    while (at_ < end_ && pixels_[at_].pixel.column + std::int64_t{2} < column) ++at_;
    for (std::size_t i = at_; i < end_ && pixels_[i].pixel.column <= column; ++i)
      if (pixels_[i].pixel.column == column) return i;
    return none;
  }

 private:
  std::span<const MedialPixel> pixels_;
  std::size_t at_, end_;
};

}  // namespace

void add_link(MedialAxis& axis, std::uint32_t from, std::uint32_t to,
              std::array<std::uint32_t, 2> sites) {
  const Disk &a = axis.nodes[from].disk, &b = axis.nodes[to].disk;
  Edge edge;
  edge.node = {from, to};
  edge.site = sites_beside(axis, sites, a.center, b.center);
  edge.control = {midpoint(a.center, b.center), a.radius + 0.5 * (b.radius - a.radius)};
  axis.edges.push_back(edge);
}

void link_pixels(const raster::Grid& grid, std::span<const MedialPixel> pixels,
                 const raster::BitMap* barrier, MedialAxis& axis) {
  axis.resolution = grid.step;
  const auto first_node = static_cast<std::uint32_t>(axis.nodes.size());
  axis.nodes.reserve(axis.nodes.size() + pixels.size());
  for (const MedialPixel& pixel : pixels)
    axis.nodes.push_back(
        {{grid.center(pixel.pixel), pixel.radius}, pixel.component, NodeKind::leaf});
  const auto link = [&](std::size_t i, std::size_t j) {
    add_link(axis, first_node + static_cast<std::uint32_t>(i),
             first_node + static_cast<std::uint32_t>(j), pixels[i].site);
  };
  const auto blocked = [&](std::int64_t column, std::int64_t row) {
    return barrier != nullptr && barrier->contains(column, row) &&
           barrier->at({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)});
  };

  for (std::size_t begin = 0, end = 0; begin < pixels.size(); begin = end) {
    const std::uint32_t row = pixels[begin].pixel.row;
    const auto row_end = [&](std::size_t from, std::uint64_t r) {
      while (from < pixels.size() && pixels[from].pixel.row == r) ++from;
      return from;
    };
    end = row_end(begin, row);
    Row above(pixels, end, row_end(end, std::uint64_t{row} + 1));
    for (std::size_t i = begin; i < end; ++i) {
      const std::int64_t column = pixels[i].pixel.column;
      const bool left = i > begin && pixels[i - 1].pixel.column + 1 == column;
      const bool right = i + 1 < end && pixels[i + 1].pixel.column == column + 1;
      const std::size_t up_left = above.find(column - 1), up = above.find(column),
                        up_right = above.find(column + 1);
      const auto diagonal = [&](std::size_t to, bool beside, std::int64_t side) {
        if (to == Row::none || beside || up != Row::none) return;
        if (blocked(column + side, row) && blocked(column, row + std::int64_t{1})) return;
        link(i, to);
      };
      if (right && (up == Row::none || up_right == Row::none)) link(i, i + 1);
      diagonal(up_left, left, -1);
      if (up != Row::none) link(i, up);
      diagonal(up_right, right, 1);
    }
  }
  set_node_kinds(axis);
}

}  // namespace medial
