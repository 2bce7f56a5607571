// Pixels become a graph with the pixels' own topology.

#include "axis/pixel_graph.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "medial/query.h"
#include "medial/verify.h"

namespace medial {
namespace {

using raster::BitMap;
using raster::Grid;
using raster::Pixel;

/// Pixels from rows of text, the topmost first; everything but '#' is background.
std::vector<MedialPixel> pixels_of(const std::vector<std::string>& text) {
  std::vector<MedialPixel> pixels;
  for (std::size_t r = 0; r < text.size(); ++r)
    for (std::size_t c = 0; c < text[text.size() - 1 - r].size(); ++c)
      if (text[text.size() - 1 - r][c] == '#')
        pixels.push_back({{static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(r)}, 1.0});
  return pixels;
}

MedialAxis linked(const std::vector<MedialPixel>& pixels, const BitMap* barrier = nullptr) {
  MedialAxis axis;
  link_pixels({{10, 20}, 0.5, 100, 100}, pixels, barrier, axis);
  return axis;
}

/// Connected parts of the pixels of a map that are `value`; the map has a margin of background.
std::size_t parts(const std::vector<std::vector<int>>& map, int value, bool diagonals) {
  const std::size_t rows = map.size(), columns = map[0].size();
  std::vector<std::size_t> set(rows * columns);
  std::iota(set.begin(), set.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (set[i] != i) i = set[i] = set[set[i]];
    return i;
  };
  std::size_t count = 0;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      if (map[r][c] != value) continue;
      ++count;
      const auto join = [&](std::size_t r2, std::size_t c2) {
        if (r2 >= rows || c2 >= columns || map[r2][c2] != value) return;
        const std::size_t a = find(r * columns + c), b = find(r2 * columns + c2);
        if (a == b) return;
        set[a] = b;
        --count;
      };
      if (r > 0) join(r - 1, c);
      if (c > 0) join(r, c - 1);
      if (diagonals && r > 0) {
        join(r - 1, c + 1);
        if (c > 0) join(r - 1, c - 1);
      }
    }
  return count;
}

TEST(PixelGraph, LinksWithoutTriangles) {
  const MedialAxis axis = linked(pixels_of({"#..", "##.", ".##"}));
  ASSERT_EQ(axis.nodes.size(), 5u);
  EXPECT_EQ(axis.edges.size(), 4u);
  EXPECT_EQ(axis.resolution, 0.5);
  EXPECT_EQ(axis.nodes[0].disk.center, (Vec2{10.5, 20}));
  EXPECT_EQ(axis.nodes[0].kind, NodeKind::site_change);
  EXPECT_EQ(axis.nodes[1].kind, NodeKind::leaf);
  for (const Edge& edge : axis.edges) {
    EXPECT_EQ(edge.site[0], no_site);
    EXPECT_EQ(edge.weight, 1);
  }
}

TEST(PixelGraph, SquaresOpenAndRingsStay) {
  EXPECT_EQ(linked(pixels_of({"##", "##"})).edges.size(), 3u);
  EXPECT_EQ(linked(pixels_of({".#.", "#.#", ".#."})).edges.size(), 4u);
  EXPECT_EQ(linked(pixels_of({"###", "###", "###"})).edges.size(), 8u);
}

TEST(PixelGraph, NoLinkAcrossAContour) {
  BitMap barrier(100, 100);
  const auto pixels = pixels_of({".#", "#."});
  EXPECT_EQ(linked(pixels, &barrier).edges.size(), 1u);
  barrier.set({0, 1});
  EXPECT_EQ(linked(pixels, &barrier).edges.size(), 1u);
  barrier.set({1, 0});
  EXPECT_EQ(linked(pixels, &barrier).edges.size(), 0u);
}

TEST(PixelGraph, SitesStandOnTheirSides) {
  MedialAxis axis;
  axis.sites = {{{0, 0}, {10, 0}}, {{10, 2}, {0, 2}}};
  const std::vector<MedialPixel> pixels{{{3, 1}, 1.0, 0, {0, 1}}, {{4, 1}, 1.0, 0, {1, 0}}};
  link_pixels({{0, 0}, 1, 10, 3}, pixels, nullptr, axis);
  ASSERT_EQ(axis.edges.size(), 1u);
  EXPECT_EQ(axis.edges[0].site, (std::array<std::uint32_t, 2>{1, 0}));
}

TEST(PixelGraph, HasTheTopologyOfItsPixels) {
  std::mt19937 random(5);
  for (int round = 0; round < 400; ++round) {
    const std::size_t rows = 3 + random() % 12, columns = 3 + random() % 12;
    const auto share = 20 + random() % 70;
    std::vector<std::vector<int>> map(rows + 2, std::vector<int>(columns + 2, 0));
    std::vector<MedialPixel> pixels;
    for (std::size_t r = 1; r <= rows; ++r)
      for (std::size_t c = 1; c <= columns; ++c)
        if (random() % 100 < share) {
          map[r][c] = 1;
          pixels.push_back({{static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(r)}, 1.0});
        }
    const MedialAxis axis = linked(pixels);
    std::vector<std::uint32_t> set(axis.nodes.size());
    std::iota(set.begin(), set.end(), 0U);
    std::size_t graph_parts = set.size();
    const auto find = [&](std::uint32_t i) {
      while (set[i] != i) i = set[i] = set[set[i]];
      return i;
    };
    for (const Edge& edge : axis.edges) {
      const std::uint32_t a = find(edge.node[0]), b = find(edge.node[1]);
      if (a == b) continue;
      set[a] = b;
      --graph_parts;
    }
    ASSERT_EQ(graph_parts, parts(map, 1, true));
    const std::size_t holes = parts(map, 0, false) - 1;
    ASSERT_EQ(axis.edges.size() + graph_parts - axis.nodes.size(), holes);
  }
}

TEST(PixelGraph, VerifyJudgesByTheResolution) {
  Ring ring{{{0, 0}, {8, 0}, {8, 2}, {0, 2}}};
  const Shape shape = build_shape({&ring, 1}).value();
  std::vector<MedialPixel> pixels;
  for (std::uint32_t c = 1; c < 7; ++c) pixels.push_back({{c, 1}, 1.2});
  MedialAxis axis;
  link_pixels({{0.5, 0}, 1, 9, 3}, pixels, nullptr, axis);
  const Certificate good = verify(shape, axis);
  EXPECT_TRUE(good.passed);
  EXPECT_EQ(good.resolution, 1);
  EXPECT_NEAR(good.largest_residual, 0.2, 1e-12);
  axis.nodes[2].disk.radius = 1.8;
  EXPECT_FALSE(verify(shape, axis).passed);
  axis.nodes[2].disk.radius = 1;
  axis.edges.pop_back();
  EXPECT_FALSE(verify(shape, axis).passed);
}

}  // namespace
}  // namespace medial
