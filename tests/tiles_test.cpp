// One shape in tiles: the same axis as that of the whole.
#include "medial/tiles.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "medial/verify.h"
#include "ops/tiles.h"
#include "support/computed.h"
#include "support/random_shapes.h"
#include "support/same_graph.h"

namespace medial {
namespace {

using test::Rings;
using test::shape_of;

/// How the axis by tiles differs from that of the whole; empty where it does not.
std::string difference(const Shape& shape, int levels, std::vector<TileLevel>* report = nullptr) {
  const Options one{.threads = 1};
  const auto whole = compute(shape, one);
  const auto tiled = compute_in_tiles(shape, levels, one, report);
  if (!whole || !tiled) return to_string(whole ? tiled.error() : whole.error());
  if (whole->edges.size() != tiled->edges.size() || whole->nodes.size() != tiled->nodes.size())
    return std::to_string(tiled->edges.size()) + " edges in place of " +
           std::to_string(whole->edges.size());
  return test::difference(shape, *whole, *tiled, 4 * whole->tolerance);
}

struct Family {
  const char* name;
  Rings rings;
};

TEST(Tiles, GiveTheAxisOfTheWhole) {
  const Family families[] = {{"rectangle", test::rectangle(3, 1)},
                             {"l", test::l_shape(2)},
                             {"cross", test::cross_shape(1)},
                             {"comb", test::comb(20)},
                             {"blob", test::blob(200)},
                             {"star", test::jagged_star(200)},
                             {"maze", test::maze(2000)},
                             {"holes", test::hole_grid(8)},
                             {"nested", test::nested_squares(7)},
                             {"spiral", test::spiral(200)},
                             {"needle", test::needle(0.01)}};
  for (const Family& family : families)
    for (int levels = 0; levels <= 5; ++levels)
      EXPECT_EQ(difference(shape_of(family.rings), levels), "") << family.name << ' ' << levels;
}

TEST(Tiles, GiveTheAxisOfTheWholeOfRandomShapes) {
  const std::uint64_t count = test::shape_count(200), first = test::first_seed();
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const test::RandomShape random = test::random_shape(seed);
    const Shape shape = shape_of(random.rings);
    for (const int levels : {1, 3, 6}) {
      const auto whole = compute(shape, {.threads = 1});
      const auto tiled = compute_in_tiles(shape, levels, {.threads = 1});
      ASSERT_TRUE(whole.ok() && tiled.ok()) << seed << ' ' << to_string(tiled.error());
      EXPECT_EQ(test::difference(shape, *whole, *tiled, 4 * whole->tolerance), "")
          << seed << ' ' << random.kind << ' ' << levels;
    }
  }
}

TEST(Tiles, PassTheCertificate) {
  const Shape shape = shape_of(test::maze(4000));
  const auto axis = compute_in_tiles(shape, 4, {.threads = 1});
  ASSERT_TRUE(axis.ok());
  EXPECT_TRUE(verify(shape, *axis).passed);
}

TEST(Tiles, MakeTheSameOnAnyNumberOfThreads) {
  const Shape shape = shape_of(test::maze(4000));
  std::vector<TileLevel> report;
  const auto one = compute_in_tiles(shape, 3, {.threads = 1}, &report);
  const auto four = compute_in_tiles(shape, 3, {.threads = 4});
  ASSERT_TRUE(one.ok() && four.ok());
  ASSERT_EQ(one->nodes.size(), four->nodes.size());
  for (std::size_t i = 0; i < one->nodes.size(); ++i) {
    EXPECT_EQ(one->nodes[i].disk.center, four->nodes[i].disk.center);
    EXPECT_EQ(one->nodes[i].disk.radius, four->nodes[i].disk.radius);
  }
  ASSERT_EQ(report.size(), 4U);
  EXPECT_EQ(report[3].tiles, 64U);
  // In a maze, each level passes on the edges that cross its windows' borders: half of the level
  // below.
  for (std::size_t level = 0; level < 3; ++level) {
    EXPECT_LT(report[level].edges, report[level + 1].edges) << level;
    EXPECT_GT(report[level].edges, 0U) << level;
  }
}

// One disk over everything: nothing is final before the root has it.
TEST(Tiles, OfARegularPolygonPassEverythingOn) {
  std::vector<TileLevel> report;
  EXPECT_EQ(difference(shape_of(test::regular_polygon(500)), 2, &report), "");
  EXPECT_EQ(report[0].edges, 500U);
}

// A hundred tiles see the same edge.
TEST(Tiles, TakeEdgesLongerThanTheyAre) {
  EXPECT_EQ(difference(shape_of(test::comb(100, 1, 200)), 4), "");
  EXPECT_EQ(difference(shape_of(test::symmetric(test::comb(30, 1, 60), 1)), 5), "");
}

TEST(Tiles, MeetAtVerticesThatLoopsShare) {
  test::Random random(7);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(difference(shape_of(test::touching_holes(random, 4)), 3), "") << i;
}

// A disk touches four corners at once; windows part right there.
TEST(Tiles, KeepTiesTogether) {
  EXPECT_EQ(difference(shape_of(test::hole_grid(15)), 5), "");
  EXPECT_EQ(difference(shape_of(test::symmetric(test::hole_grid(7), 1)), 4), "");
}

TEST(Tiles, RefuseWhatTheyDoNotTake) {
  const Shape square = shape_of(test::rectangle(1, 1));
  const auto code = [](const Result<MedialAxis>& axis) {
    return axis ? std::string("none") : name_of(axis.error().code);
  };
  EXPECT_EQ(code(compute_in_tiles(square, -1)), "invalid_option");
  EXPECT_EQ(code(compute_in_tiles(square, 11)), "invalid_option");
  EXPECT_EQ(code(compute_in_tiles(square, 2, {.exterior = true})), "invalid_option");
  EXPECT_EQ(code(compute_in_tiles(square, 2, {.method = method::Lee{}})), "invalid_option");
  EXPECT_EQ(code(compute_in_tiles(square, 2, {.tolerance = 1e-4})), "invalid_option");
  EXPECT_EQ(code(compute_in_tiles({}, 2)), "empty");
  Ring lens = test::ring_of({{0, 0}, {1, 0}});
  lens.bulges = {0.5, 0.5};
  EXPECT_EQ(code(compute_in_tiles(shape_of({lens}), 1)), "invalid_option");
  const Shape wide = shape_of(test::comb(2000, 1, 4000));  // 4000 edges through 1024 rows
  const auto too_many = compute_in_tiles(wide, TileGrid::most_levels);
  EXPECT_EQ(code(too_many), "invalid_option");
  EXPECT_EQ(too_many.error().text, "edges meet too many tiles: use fewer levels");
  std::atomic<bool> stop = true;
  EXPECT_EQ(code(compute_in_tiles(square, 1, {.cancel = &stop})), "cancelled");
}

TEST(Tiles, RefuseWhatOneTileDoesNotTake) {
  const std::vector<TileEdge> edges = {
      {{0, 0}, {1, 0}, 0}, {{1, 0}, {1, 1}, 1}, {{1, 1}, {0, 1}, 2}, {{0, 1}, {0, 0}, 3}};
  const auto code = [&](int levels, double tolerance) {
    const auto part =
        axis_of_tile(edges, {{{0, 0}, {1, 1}}, levels}, 0, 0, 0, {.tolerance = tolerance});
    return part ? std::string("none") : name_of(part.error().code);
  };
  EXPECT_EQ(code(0, 0), "none");
  for (const int levels : {-1, 11}) EXPECT_EQ(code(levels, 0), "invalid_option") << levels;
  for (const double tolerance : {-1.0, 5.0, 1e-4, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(code(1, tolerance), "invalid_option") << tolerance;
}

// The rings and vertices that a planar graph names would be a tile's own.
TEST(Tiles, NameNoRingOfTheirOwn) {
  const std::vector<TileEdge> crossing = {{{0, 0}, {1, 1}, 4}, {{1, 0}, {0, 1}, 7}};
  const auto part = axis_of_tile(crossing, {{{0, 0}, {1, 1}}, 0}, 0, 0, 0);
  ASSERT_FALSE(part.ok());
  EXPECT_FALSE(part.error().place.ring || part.error().place.vertex);
}

// A task that is repeated, or whose result comes twice and in another order, changes nothing.
TEST(Tiles, AreJoinedInAnyOrder) {
  const Shape shape = shape_of(test::maze(500));
  const TileGrid grid{bounding_box(shape), 0};
  std::vector<TileEdge> edges;
  for (std::uint64_t k = 0; k < shape.points.size(); ++k)
    edges.push_back({shape.points[k], shape.points[(k + 1) % shape.points.size()], k});
  const auto part = axis_of_tile(edges, grid, 0, 0, 0);
  ASSERT_TRUE(part.ok());
  for (const TileAxisEdge& edge : part->axis) EXPECT_LT(edge.site[0], edge.site[1]);
  const auto once = join_tiles(shape, part->axis);
  std::vector<TileAxisEdge> twice(part->axis.rbegin(), part->axis.rend());
  twice.insert(twice.end(), part->axis.begin(), part->axis.end());
  const auto joined = join_tiles(shape, twice);
  ASSERT_TRUE(once.ok() && joined.ok());
  ASSERT_EQ(once->edges.size(), joined->edges.size());
  for (std::size_t i = 0; i < once->edges.size(); ++i) {
    EXPECT_EQ(once->edges[i].node, joined->edges[i].node);
    EXPECT_EQ(once->edges[i].control.center, joined->edges[i].control.center);
  }
  std::vector<TileAxisEdge> lost = part->axis;
  lost.pop_back();
  EXPECT_FALSE(join_tiles(shape, lost).ok());
}

// Leaves see an edge shorter than the tolerance where the tiles around them see one node.
TEST(Tiles, DropAnEdgeThatOnlyOneOfThemSees) {
  const Shape shape = shape_of(test::random_shape(3925).rings);
  for (const int levels : {3, 5}) EXPECT_EQ(difference(shape, levels), "");
}

// Rounding may leave open whether a tie is one node; another tile's answer differs by a name.
TEST(Tiles, JoinTiesThatTilesSeeInDifferentWays) {
  const Shape shape = shape_of(test::hole_grid(2));
  std::vector<TileEdge> edges;
  for (std::uint32_t loop = 0; loop < shape.loop_count(); ++loop)
    for (std::uint32_t k = shape.loop_begin[loop], end = shape.loop_begin[loop + 1]; k < end; ++k)
      edges.push_back(
          {shape.points[k], shape.points[k + 1 < end ? k + 1 : shape.loop_begin[loop]], k});
  auto part = axis_of_tile(edges, {bounding_box(shape), 0}, 0, 0, 0);
  ASSERT_TRUE(part.ok());
  const auto whole = join_tiles(shape, part->axis);
  const auto tie = std::find_if(part->axis.begin(), part->axis.end(),
                                [](const TileAxisEdge& edge) { return edge.degree[0] > 3; });
  ASSERT_NE(tie, part->axis.end());
  tie->node[0] ^= 1;
  const auto joined = join_tiles(shape, part->axis);
  ASSERT_TRUE(whole.ok() && joined.ok()) << to_string(joined.error());
  EXPECT_EQ(joined->nodes.size(), whole->nodes.size());
  EXPECT_EQ(test::difference(shape, *whole, *joined, whole->tolerance), "");
}

}  // namespace
}  // namespace medial
