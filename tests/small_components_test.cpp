// Components that are far smaller than the shape: each has the axis that it would have alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "base/tolerance.h"
#include "medial/medial.h"
#include "support/computed.h"
#include "support/nasty.h"
#include "support/property.h"

namespace medial {
namespace {

using test::Rings;
using test::shape_of;

/// Rings next to the origin, of a width in [1, 2) times `size`.
Rings moved(Rings rings, double size) {
  Box box = Box::nothing();
  for (const Ring& ring : rings)
    for (const Vec2 p : ring.points) box.add(p);
  const double width = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  const double scale = size * std::exp2(-std::ilogb(width));
  for (Ring& ring : rings)
    for (Vec2& p : ring.points) p = scale * (p - box.low);
  return rings;
}

/// With a square of side 1 away from them.
Rings beside_a_square(Rings rings) {
  Ring square{{{-2, -2}, {-1, -2}, {-1, -1}, {-2, -1}}};
  rings.insert(rings.begin(), std::move(square));
  return rings;
}

auto key_of(const Disk& disk) { return std::tuple(disk.center.x, disk.center.y, disk.radius); }
/// The edges of an axis, up to their order and the numbers of nodes and sites.
auto keys_of(const MedialAxis& axis) {
  const auto ends_of = [&](std::uint32_t i) {
    const Site& site = axis.sites[i];
    return std::tuple(site.start.x, site.start.y, site.end.x, site.end.y);
  };
  std::vector<decltype(std::tuple_cat(key_of(Disk{}), key_of(Disk{}), key_of(Disk{}), ends_of(0),
                                      ends_of(0), std::tuple(0.0)))>
      keys;
  for (const Edge& edge : axis.edges)
    keys.push_back(std::tuple_cat(key_of(axis.nodes[edge.node[0]].disk),
                                  key_of(axis.nodes[edge.node[1]].disk), key_of(edge.control),
                                  ends_of(edge.site[0]), ends_of(edge.site[1]),
                                  std::tuple(edge.weight)));
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// The part of an axis that is of some components.
MedialAxis part_of(const MedialAxis& axis, std::uint32_t first_component) {
  MedialAxis part = axis;
  part.edges.clear();
  for (const Edge& edge : axis.edges)
    if (axis.nodes[edge.node[0]].component >= first_component) part.edges.push_back(edge);
  return part;
}

/// Small parts of some classes that have an axis alone.
std::vector<Rings> small_parts(double size) {
  std::vector<Rings> parts;
  constexpr std::uint64_t first = 20261128180000000, of_each = 12;
  for (const test::NastyClass& one : test::nasty_classes())
    for (std::uint64_t seed = first; seed < first + of_each && !one.has_arcs; ++seed)
      if (Rings part = moved(test::nasty_shape(one, seed, true), size);
          build_shape(part) && build_shape(beside_a_square(part)))
        parts.push_back(std::move(part));
  return parts;
}

class SmallComponents : public testing::TestWithParam<Method> {};

TEST_P(SmallComponents, HaveTheAxisThatTheyHaveAlone) {
  const Options options{.method = GetParam(), .threads = 1};
  std::size_t compared = 0;
  for (const double size : {0x1p-18, 0x1p-40}) {
    for (const Rings& part : small_parts(size)) {
      const Shape alone = shape_of(part), among = shape_of(beside_a_square(part));
      // Several components may be small next to each other, too.
      if (alone.component_count() > 1) continue;
      const auto axis = compute(alone, options), whole = compute(among, options);
      ASSERT_EQ(axis.ok(), whole.ok());
      if (!axis) continue;
      ++compared;
      EXPECT_EQ(keys_of(*axis), keys_of(part_of(*whole, 1)));
      EXPECT_EQ(whole->nodes.size(), axis->nodes.size() + 5);
      EXPECT_TRUE(verify(among, *whole, {.threads = 1}).passed);
    }
  }
  EXPECT_GT(compared, 100);
}

INSTANTIATE_TEST_SUITE_P(Methods, SmallComponents,
                         testing::Values(Method{method::Disks{}}, Method{method::Lee{}}),
                         [](const auto& tested) {
                           return std::string(info_of(tested.param).name);
                         });

/// Steps of a staircase of components, each a quarter of the one before, the first five large.
Rings staircase(int count) {
  Rings rings;
  for (int i = 0; i < count; ++i) {
    const double side = std::ldexp(1.0, -2 * i);
    for (Ring ring : moved(test::l_shape(2), 0.5 * side)) {
      for (Vec2& p : ring.points) p = p + Vec2{side, side};
      rings.push_back(std::move(ring));
    }
  }
  return rings;
}

TEST(SmallComponents, HaveNamesInTheWhole) {
  const Shape shape = shape_of(staircase(20));
  const auto axis = compute(shape, {.threads = 1});
  ASSERT_TRUE(axis) << to_string(axis.error());
  const Certificate certificate = verify(shape, *axis, {.threads = 1});
  EXPECT_TRUE(certificate.passed);
  EXPECT_EQ(certificate.graph_parts, 20);
  EXPECT_LE(axis->tolerance, tolerance_for(bounding_box(shape), 0));
  std::vector<std::size_t> nodes(20);
  for (const Node& node : axis->nodes) ++nodes[node.component];
  EXPECT_EQ(nodes, std::vector<std::size_t>(20, nodes[0]));
  // Sites are in the order of the boundary, whatever is computed first.
  EXPECT_TRUE(
      std::is_sorted(axis->sites.begin(), axis->sites.end(), [](const Site& a, const Site& b) {
        return std::tuple(a.ring, a.vertex) < std::tuple(b.ring, b.vertex);
      }));
}

/// A square of side 1 among many tiny ones.
Shape dust(int side) {
  Rings rings;
  for (int i = 0; i < side * side; ++i)
    for (Ring ring : moved(test::rectangle(2, 1), 0x1p-20)) {
      for (Vec2& p : ring.points) p = p + Vec2{0x1p-10 * (i % side), 0x1p-10 * (i / side)};
      rings.push_back(std::move(ring));
    }
  return shape_of(beside_a_square(rings));
}

TEST(SmallComponents, DoNotDependOnTheNumberOfThreads) {
  const Shape shape = dust(40);
  const auto one = compute(shape, {.threads = 1}), three = compute(shape, {.threads = 3});
  ASSERT_TRUE(one && three);
  EXPECT_TRUE(test::identical(*one, *three));
  EXPECT_EQ(one->nodes.size(), 5 + 6 * 40 * 40);
  EXPECT_TRUE(verify(shape, *one, {.threads = 1}).passed);
}

/// What rounding leaves open is one of the whole again.
TEST(SmallComponents, ShareAToleranceThatIsAskedFor) {
  const Shape shape = dust(2);
  const auto axis = compute(shape, {.tolerance = 1e-9, .threads = 1});
  ASSERT_TRUE(axis);
  EXPECT_EQ(axis->tolerance, 1e-9 * diagonal(bounding_box(shape)));
}

TEST(SmallComponents, ComeInPartsAfterTheLargeOnes) {
  for (const Shape& shape : {dust(40), shape_of(staircase(20))}) {
    const auto whole = compute(shape, {.threads = 1});
    MedialAxis joined;
    joined.sites = whole->sites;
    std::size_t begins = 0;
    const auto rest = compute_in_parts(shape, {.threads = 1}, [&](AxisPart&& part) {
      begins += part.begins ? 1 : 0;
      for (std::size_t i = part.known; i < part.nodes.size(); ++i) {
        EXPECT_EQ(part.nodes[i], joined.nodes.size());
        joined.nodes.push_back(part.axis.nodes[i]);
      }
      for (Edge edge : part.axis.edges) {
        for (std::uint32_t& node : edge.node) node = part.nodes[node];
        for (std::uint32_t& site : edge.site) site = part.sites[site];
        joined.edges.push_back(edge);
      }
      return success();
    });
    ASSERT_TRUE(whole && rest);
    EXPECT_EQ(begins, 1);
    EXPECT_EQ(rest->tolerance, whole->tolerance);
    EXPECT_EQ(keys_of(joined), keys_of(*whole));
    EXPECT_TRUE(verify(shape, joined, {.threads = 1}).passed);
  }
}

TEST(SmallComponents, AreCancelledAndTellTheirProgress) {
  const Shape shape = dust(40);
  double last = 0;
  ASSERT_TRUE(compute(shape, {.threads = 1, .progress = [&](double share) {
                                EXPECT_GE(share, last);
                                last = share;
                              }}));
  EXPECT_EQ(last, 1);
  std::atomic<bool> cancel = false;
  const auto axis =
      compute(shape, {.threads = 1, .progress = [&](double) { cancel = true; }, .cancel = &cancel});
  ASSERT_FALSE(axis);
  EXPECT_EQ(axis.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace medial
