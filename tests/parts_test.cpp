// An axis handed out in parts: the same as that of compute().
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/threads.h"
#include "medial/verify.h"
#include "methods/disks/disks.h"
#include "support/computed.h"
#include "support/nasty.h"
#include "support/random_shapes.h"
#include "support/same_graph.h"

namespace medial {
namespace {

using test::shape_of;

auto key_of(const Site& site) {
  return std::tuple(site.start.x, site.start.y, site.end.x, site.end.y, site.ring, site.vertex);
}
auto key_of(const Node& node) {
  return std::tuple(node.disk.center.x, node.disk.center.y, node.disk.radius, node.kind,
                    node.component);
}
/// Assembles parts; reports what is wrong with one.
struct Joined {
  explicit Joined(const Shape& shape) { axis.sites = Problem(shape, options).result_sites(); }

  Options options;
  MedialAxis axis;
  std::string fault;
  std::size_t parts = 0, voids = 0, most = 0;

  Status add(const AxisPart& part) {
    if (part.begins) {
      ++voids;
      axis.nodes.clear();
      axis.edges.clear();
    }
    ++parts;
    most = std::max(most, part.axis.nodes.size());
    axis.method = part.axis.method;
    axis.tolerance = part.axis.tolerance;
    const auto& nodes = part.axis.nodes;
    if (part.nodes.size() != nodes.size() || part.sites.size() != part.axis.sites.size())
      fault = "numbers are missing";
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::uint32_t number = part.nodes[i];
      if (i >= part.known && number != axis.nodes.size()) fault = "a new node has an old number";
      if (i >= part.known) axis.nodes.push_back(nodes[i]);
      if (key_of(axis.nodes[number]) != key_of(nodes[i])) fault = "a node has changed";
    }
    std::vector<bool> is_named(nodes.size());
    for (const Edge& edge : part.axis.edges)
      for (const std::uint32_t node : edge.node) is_named[node] = true;
    for (std::size_t i = 0; i < part.known; ++i)
      if (!is_named[i]) fault = "no edge names a known node";
    for (std::size_t i = 0; i < part.sites.size(); ++i)
      if (key_of(part.axis.sites[i]) != key_of(axis.sites[part.sites[i]])) fault = "another site";
    for (Edge edge : part.axis.edges) {
      for (std::uint32_t& node : edge.node) node = part.nodes[node];
      for (std::uint32_t& site : edge.site) site = part.sites[site];
      axis.edges.push_back(edge);
    }
    return success();
  }
};

/// The axis of a shape in parts of about this many nodes.
Joined joined(const Shape& shape, std::size_t part_nodes, int threads = 1) {
  Joined joined(shape);
  joined.options.threads = threads;
  const Problem problem(shape, joined.options);
  const auto rest = on_threads(threads, [&] {
    return disks::run_in_parts(
        problem, [&](AxisPart&& part) { return joined.add(part); }, part_nodes);
  });
  if (!rest) joined.fault = to_string(rest.error());
  if (rest && !*rest) joined.fault = "there are no parts";
  return joined;
}

template <class List>
auto keys_of(const List& list) {
  std::vector<decltype(key_of(list[0]))> keys;
  for (const auto& one : list) keys.push_back(key_of(one));
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// How the axis in parts differs from the whole one; empty where it does not.
std::string difference(const Shape& shape, std::size_t part_nodes) {
  const auto whole = compute(shape, {.threads = 1});
  const Joined parts = joined(shape, part_nodes);
  if (!whole) return to_string(whole.error());
  if (!parts.fault.empty()) return parts.fault;
  if (whole->edges.size() != parts.axis.edges.size()) return "another number of edges";
  return test::difference(shape, *whole, parts.axis, whole->tolerance);
}

TEST(Parts, AreTheAxisOfTheWhole) {
  const std::pair<const char*, test::Rings> families[] = {{"rectangle", test::rectangle(3, 1)},
                                                          {"cross", test::cross_shape(1)},
                                                          {"comb", test::comb(50)},
                                                          {"blob", test::blob(300)},
                                                          {"circle", test::regular_polygon(300)},
                                                          {"star", test::jagged_star(300)},
                                                          {"maze", test::maze(3000)},
                                                          {"holes", test::hole_grid(12)},
                                                          {"nested", test::nested_squares(9)},
                                                          {"spiral", test::spiral(300)}};
  for (const auto& [name, rings] : families)
    for (const std::size_t nodes : {16, 100, 1000})
      EXPECT_EQ(difference(shape_of(rings), nodes), "") << name << ' ' << nodes;
}

TEST(Parts, AreTheAxisOfTheWholeOfRandomShapes) {
  const std::uint64_t count = test::shape_count(300), first = test::first_seed();
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const test::RandomShape random = test::random_shape(seed);
    const Shape shape = shape_of(random.rings);
    for (const std::size_t nodes : {16, 64})
      EXPECT_EQ(difference(shape, nodes), "") << seed << ' ' << random.kind << ' ' << nodes;
  }
}

/// Of a shape in which the walk in parts loses its way, so that compute() begins again.
TEST(Parts, ProgressGrowsToOneOnceWhereTheWalkIsLost) {
  const auto classes = test::nasty_classes();
  const auto rings = std::ranges::find(classes, "rings", &test::NastyClass::name);
  const auto shape = build_shape(test::nasty_shape(*rings, 53, false));
  ASSERT_TRUE(shape);
  std::vector<double> told;
  const Options options{.threads = 1, .progress = [&](double share) { told.push_back(share); }};
  ASSERT_TRUE(comes_in_parts(*shape, options));
  const auto axis = compute_in_parts(*shape, options, [](const AxisPart&) { return success(); });
  ASSERT_TRUE(axis) << to_string(axis.error());
  EXPECT_GE(told.size(), 3U);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(std::count(told.begin(), told.end(), 1), 1);
}

TEST(Parts, HaveTheSameNodesAsTheWhole) {
  const Shape shape = shape_of(test::maze(4000));
  const auto whole = compute(shape, {.threads = 1});
  const Joined parts = joined(shape, 256);
  EXPECT_EQ(keys_of(whole->nodes), keys_of(parts.axis.nodes));
  EXPECT_GT(parts.parts, 10U);
  EXPECT_LT(parts.most, 1500U);
  EXPECT_EQ(parts.voids, 1U);
  EXPECT_TRUE(verify(shape, parts.axis).passed);
}

TEST(Parts, ComeInTheSameOrderOnAnyNumberOfThreads) {
  const Shape shape = shape_of(test::hole_grid(20));
  const Joined one = joined(shape, 256, 1), four = joined(shape, 256, 4);
  ASSERT_EQ(one.axis.edges.size(), four.axis.edges.size());
  for (std::size_t i = 0; i < one.axis.edges.size(); ++i) {
    EXPECT_EQ(one.axis.edges[i].node, four.axis.edges[i].node);
    EXPECT_EQ(one.axis.edges[i].site, four.axis.edges[i].site);
  }
}

TEST(Parts, EndWithTheErrorOfTheSink) {
  const Error full{ErrorCode::unwritable, "the disk is full", {}};
  const auto axis =
      compute_in_parts(shape_of(test::blob(300)), {}, [&](AxisPart&&) { return Status(full); });
  ASSERT_FALSE(axis.ok());
  EXPECT_EQ(axis.error().text, full.text);
}

TEST(Parts, EndWhereTheCallerCancels) {
  std::atomic<bool> cancel = false;
  Options options;
  options.cancel = &cancel;
  std::size_t parts = 0;
  const auto axis = compute_in_parts(shape_of(test::maze(40000)), options, [&](AxisPart&&) {
    ++parts;
    cancel = true;
    return success();
  });
  ASSERT_FALSE(axis.ok());
  EXPECT_EQ(axis.error().code, ErrorCode::cancelled);
  EXPECT_EQ(parts, 1U);
}

// Methods that cannot hand out parts hand out one.
TEST(Parts, AreOneOfOtherMethods) {
  const Shape shape = shape_of(test::maze(500));
  Options options;
  options.method = method::Lee{};
  Joined parts(shape);
  const auto rest =
      compute_in_parts(shape, options, [&](AxisPart&& part) { return parts.add(part); });
  ASSERT_TRUE(rest.ok());
  EXPECT_EQ(rest->method, "lee");
  EXPECT_TRUE(rest->nodes.empty());
  EXPECT_EQ(parts.fault, "");
  EXPECT_EQ(parts.parts, 1U);
  EXPECT_TRUE(verify(shape, parts.axis).passed);
}

}  // namespace
}  // namespace medial
