#include "methods/disks/early_starts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "medial/compute.h"
#include "medial/verify.h"
#include "methods/disks/boundary.h"
#include "methods/disks/connect.h"
#include "methods/disks/exact_event.h"
#include "methods/problem.h"
#include "support/computed.h"
#include "support/generate.h"

namespace medial::test {
namespace {

using disks::EarlyStart;

constexpr std::uint32_t least = 64;

/// The early starts of a shape with holes or without, and the boundary that they are numbered by.
struct Found {
  explicit Found(const Shape& shape, std::uint32_t apart = least) : problem(shape, options) {
    boundary = disks::connected_boundary(problem);
    const disks::ExactSites sites(problem, problem.numbers(), boundary);
    const site::BoundaryTree tree(boundary.sites);
    starts = disks::early_starts({sites, tree}, apart);
  }
  Options options;
  Problem problem;
  disks::Boundary boundary;
  std::vector<EarlyStart> starts;
};

/// Every disk touches its two edges, and keeps clear of everything else by more than it may be off.
void expect_maximal(const Found& found, std::size_t at_least) {
  EXPECT_GE(found.starts.size(), at_least);
  for (const EarlyStart& start : found.starts) {
    const auto run = found.boundary.runs[start.component];
    EXPECT_GE(start.left - start.right, least);
    EXPECT_GE(run.last - run.first - (start.left - start.right), least);
    for (std::uint32_t i = 0; i < found.boundary.sites.size(); ++i) {
      if (found.boundary.elements[i] == disks::Element::bridge) continue;
      const double gap =
          std::sqrt(site::squared_distance(found.boundary.sites[i], start.disk.center)) -
          start.disk.radius;
      if (i == start.right || i == start.left)
        EXPECT_NEAR(gap, 0, start.error) << i;
      else
        EXPECT_GT(gap, 8 * start.error) << i;
    }
  }
}

TEST(EarlyStarts, AreMaximalDisksInsideEdges) {
  expect_maximal(Found(shape_of(comb(400))), 8);
  expect_maximal(Found(shape_of(blob(2000))), 8);
  expect_maximal(Found(shape_of(maze(2000))), 4);
  expect_maximal(Found(shape_of(hole_grid(20))), 4);
}

TEST(EarlyStarts, AreFoundByTheirSites) {
  const Found found(shape_of(comb(400)));
  ASSERT_FALSE(found.starts.empty());
  for (const EarlyStart& start : found.starts) {
    const EarlyStart* const same = early_start_of({start.right, start.left, 0}, found.starts);
    EXPECT_EQ(same, &start);
    EXPECT_EQ(early_start_of({start.right, start.left + 1, 0}, found.starts), nullptr);
  }
}

/// In a regular polygon every disk that grows from an edge touches all of them.
TEST(EarlyStarts, AreNoneInRoundShapes) {
  EXPECT_TRUE(Found(shape_of(regular_polygon(1000))).starts.empty());
}

/// The walk of a comb with so many teeth begins at several places, and its axis is one tree.
TEST(EarlyStarts, AreJoinedToOneAxis) {
  const Shape shape = shape_of(comb(2000));
  EXPECT_FALSE(Found(shape, 1024).starts.empty());
  const auto axis = compute(shape);
  ASSERT_TRUE(axis);
  EXPECT_EQ(axis->nodes.size(), axis->edges.size() + 1);
  EXPECT_TRUE(verify(shape, *axis).passed);
}

}  // namespace
}  // namespace medial::test
