// One shape in tiles: the same axis as that of the whole.
#include "medial/tiles.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

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

}  // namespace
}  // namespace medial
