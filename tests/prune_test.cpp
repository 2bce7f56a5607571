// Pruning: what holds for every measure on the axes of random shapes, and values worked out by
// hand.
#include "medial/prune.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/disjoint_sets.h"
#include "medial/compute.h"
#include "medial/query.h"
#include "support/computed.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

const std::uint64_t prune_count = test::shape_count(40);

using test::axis_of;
using test::RandomShape;

RandomShape shape_of(std::uint64_t seed) {
  return seed % 3 != 0 ? test::random_shape(seed) : test::random_arc_shape(seed);
}

MedialAxis axis_of(std::vector<Vec2> points) { return axis_of(test::Rings{{std::move(points)}}); }

struct Homotopy {
  std::size_t parts = 0;
  std::size_t cycles = 0;
  friend bool operator==(const Homotopy&, const Homotopy&) = default;
};

Homotopy homotopy_of(const MedialAxis& axis) {
  DisjointSets sets(axis.nodes.size());
  std::size_t cycles = 0;
  for (const Edge& edge : axis.edges) {
    if (!sets.join(edge.node[0], edge.node[1])) ++cycles;
  }
  return {sets.count(), cycles};
}

/// Thresholds from nothing to everything, the default among them.
std::vector<double> thresholds_of(const PruneOrder& order, const MedialAxis& axis,
                                  PruneMeasure measure) {
  std::vector<double> finite;
  for (std::uint32_t e = 0; e < axis.edges.size(); ++e)
    if (std::isfinite(order.of_edge(e))) finite.push_back(order.of_edge(e));
  std::sort(finite.begin(), finite.end());
  std::vector<double> thresholds{0, default_threshold(measure), 0.5 * default_threshold(measure)};
  for (const std::size_t share : {1U, 2U, 3U, 4U})
    if (!finite.empty()) thresholds.push_back(finite[(finite.size() - 1) * share / 4]);
  if (!finite.empty()) thresholds.push_back(2 * finite.back());
  std::sort(thresholds.begin(), thresholds.end());
  return thresholds;
}

/// Every measure on 2,500 shapes, on the first 100 of them at all thresholds; with
/// MEDIAL_PROPERTY_COUNT=80000 on 10,000.
TEST(Prune, KeepsTheHomotopyTypeAndIsNested) {
  std::size_t cuts = 0, removed = 0;
  const std::uint64_t thorough = test::shape_count(200), count = test::shape_count(8);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const RandomShape random = shape_of(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const MedialAxis axis = axis_of(random.rings);
    const Homotopy whole = homotopy_of(axis);
    for (const PruneMeasure measure : prune_measures()) {
      SCOPED_TRACE(name_of(measure));
      const bool tips = (seed + static_cast<std::uint64_t>(measure)) % 3 == 0;
      const PruneOrder order(axis, measure, tips);
      std::vector<PathPiece> before;
      std::vector<double> thresholds = thresholds_of(order, axis, measure);
      if (seed >= thorough) {
        const std::size_t half = thresholds.size() / 2;
        thresholds = {thresholds[seed % half], thresholds[half + seed / 4 % half]};
      }
      bool first = true;
      for (const double threshold : thresholds) {
        const std::vector<PathPiece> parts = order.parts(threshold);
        if (threshold == 0) {
          ASSERT_EQ(parts.size(), axis.edges.size());
        } else if (!first) {  // nested
          auto larger = before.begin();
          for (const PathPiece& part : parts) {
            while (larger != before.end() && larger->edge < part.edge) ++larger;
            ASSERT_TRUE(larger != before.end() && larger->edge == part.edge);
            ASSERT_GE(part.from, larger->from);
            ASSERT_LE(part.to, larger->to);
          }
        }
        before = parts;
        first = false;
        std::size_t here = 0;
        for (const PathPiece& part : parts) {
          ASSERT_LE(0, part.from);
          ASSERT_LE(part.from, part.to);
          ASSERT_LE(part.to, 1);
          here += part.from > 0 || part.to < 1 ? 1 : 0;
        }
        ASSERT_EQ(order.cuts_at(threshold), here);
        cuts += here;
        removed += axis.edges.size() - parts.size();
        const MedialAxis pruned = order.at(threshold);
        ASSERT_EQ(pruned.edges.size(), parts.size());
        ASSERT_EQ(homotopy_of(pruned), whole);
        ASSERT_EQ(branches(pruned).size(), order.branches_at(threshold));
      }
    }
  }
  EXPECT_GT(cuts, 100U);
  EXPECT_GT(removed, 100U);
}

/// The pruned part is unchanged: the same curves, and disks that touch the boundary.
TEST(Prune, CutsEdgesExactly) {
  std::size_t cuts = 0;
  for (std::uint64_t seed = 0; seed < prune_count / 4; ++seed) {
    const RandomShape random = shape_of(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const auto shape = build_shape(random.rings);
    ASSERT_TRUE(shape.ok());
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis.ok());
    const double slack = 1e-11 * diagonal(bounding_box(*shape));
    for (const PruneMeasure measure : {PruneMeasure::angle, PruneMeasure::erosion}) {
      const PruneOrder order(*axis, measure);
      const std::vector<PathPiece> parts = order.parts(default_threshold(measure));
      const MedialAxis pruned = order.at(default_threshold(measure));
      for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto [edge, t0, t1] = parts[i];
        if (t0 == 0 && t1 == 1) continue;
        ++cuts;
        for (const double u : {0.0, 0.3, 1.0}) {
          const Disk disk = disk_at(pruned, pruned.edges[i], u);
          ASSERT_NEAR(clearance(*shape, disk.center), disk.radius, slack);
        }
        const Disk begin = disk_at(*axis, axis->edges[edge], t0);
        const Disk end = disk_at(*axis, axis->edges[edge], t1);
        ASSERT_LE(distance(begin.center, pruned.nodes[pruned.edges[i].node[0]].disk.center), slack);
        ASSERT_LE(distance(end.center, pruned.nodes[pruned.edges[i].node[1]].disk.center), slack);
      }
    }
  }
  EXPECT_GT(cuts, 20U);
}

/// Rotated, scaled, mirrored, reversed and re-started, the same part of the axis is kept.
TEST(Prune, DoesNotDependOnHowTheShapeIsWritten) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < prune_count / 8; ++seed) {
    const RandomShape random = test::random_shape(seed);
    if (!random.rigid) continue;
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const MedialAxis axis = axis_of(random.rings);
    // Where two disks are about as deep, which one is the centre depends on the last digits.
    std::vector<double> radii;
    for (const Node& node : axis.nodes) radii.push_back(node.disk.radius);
    std::sort(radii.rbegin(), radii.rend());
    if (radii[1] > (1 - 1e-6) * radii[0]) continue;
    for (std::size_t s = 1; s < test::symmetries().size(); ++s) {
      const test::Symmetry& symmetry = test::symmetries()[s];
      SCOPED_TRACE(symmetry.name);
      // Tiny shapes lose their digits far from the origin.
      const double shift = std::max(std::abs(symmetry.dx), std::abs(symmetry.dy));
      if (shift * 1e-16 > 1e-11 * symmetry.scale() * radii[0]) continue;
      const MedialAxis other = axis_of(test::transformed(random.rings, symmetry));
      for (const PruneMeasure measure : prune_measures()) {
        SCOPED_TRACE(name_of(measure));
        const bool tips = s % 2 == 0;
        const double threshold = 1.01 * default_threshold(measure);  // no number of anyone's
        const double wanted = total_length(PruneOrder(axis, measure, tips).at(threshold));
        const double found = total_length(PruneOrder(other, measure, tips).at(threshold));
        EXPECT_NEAR(found / symmetry.scale(), wanted, 1e-5 * total_length(axis));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 100U);
}

/// A rectangle of 6 by 2: a spine between (1, 1) and (5, 1), corners at 45 degrees.
TEST(Prune, MeasuresOfARectangle) {
  const MedialAxis axis = axis_of({{0, 0}, {6, 0}, {6, 2}, {0, 2}});
  const auto length_at = [&](PruneMeasure measure, double threshold, bool tips = false) {
    return total_length(PruneOrder(axis, measure, tips).at(threshold));
  };
  const double diagonals = 4 * std::numbers::sqrt2, all = 4 + diagonals;
  constexpr double close = 1e-9;
  using enum PruneMeasure;
  // In a corner the angle is 90 degrees all along, on the spine 180.
  EXPECT_NEAR(length_at(angle, 89), all, close);
  EXPECT_NEAR(length_at(angle, 91), 4, close);
  // The radius grows from 0 to 1 along the diagonals.
  EXPECT_NEAR(length_at(radius, 0.25), 4 + 0.75 * diagonals, close);
  // x sqrt(2) from the corner along the diagonal, where the radius is x: out to sqrt(2) x - x.
  EXPECT_NEAR(length_at(erosion, 0.25 * (std::numbers::sqrt2 - 1)), 4 + 0.75 * diagonals, close);
  // The boundary beyond is 2 x, the chord sqrt(2) x.
  EXPECT_NEAR(length_at(potential, 0.25 / std::numbers::pi), 4 + 0.75 * diagonals, close);
  EXPECT_NEAR(length_at(residual, 0.25 * (1 - std::numbers::sqrt2 / 2)), 4 + 0.75 * diagonals,
              close);
  EXPECT_NEAR(length_at(lambda, 0.25 * std::numbers::sqrt2 / 2), 4 + 0.75 * diagonals, close);
  // A corner of x by x less a quarter of a disk.
  EXPECT_NEAR(length_at(area, 0.0625 * (1 - std::numbers::pi / 4) / 12), 4 + 0.75 * diagonals,
              close);
  // The disk at x vanishes in the one at 1 for s >= sqrt(2) (1 - x) / (1 - x).
  EXPECT_NEAR(length_at(scale, 1.41), all, close);
  EXPECT_LE(length_at(scale, 1.42), 4 + close);
  // Of branches: all or nothing.
  EXPECT_NEAR(length_at(significance, 0.41), all, close);
  EXPECT_NEAR(length_at(significance, 0.42), 4, close);
  EXPECT_NEAR(length_at(prominence, 0.41), all, close);
  EXPECT_NEAR(length_at(prominence, 0.42), 4, close);
  EXPECT_NEAR(length_at(length, 1.41), all, close);
  EXPECT_NEAR(length_at(length, 1.42), 4, close);
  EXPECT_NEAR(length_at(ratio, 1.41), all, close);
  EXPECT_NEAR(length_at(ratio, 1.42), 4, close);
  // The far corners belong to the spine, to its tips: the deepest disk is at one end of it.
  EXPECT_NEAR(length_at(significance, 0.42, true), 4 + std::numbers::sqrt2, close);
  EXPECT_NEAR(length_at(erosion, 0.1, true), all, close);
  // Beyond everything, the deepest disk.
  const MedialAxis least = PruneOrder(axis, significance).at(1e9);
  ASSERT_EQ(least.nodes.size(), 1U);
  EXPECT_DOUBLE_EQ(least.nodes[0].disk.radius, 1);
  EXPECT_TRUE(least.edges.empty());
}

/// A lens of two arcs: the deepest disk lies inside its only edge, which stays.
TEST(Prune, TheDeepestDiskMayLieInsideAnEdge) {
  Ring lens{{{-1, 0}, {1, 0}}, RingRole::any, {0.3, 0.3}};
  const auto shape = build_shape({&lens, 1});
  ASSERT_TRUE(shape.ok());
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis.ok());
  ASSERT_EQ(axis->edges.size(), 1U);
  for (const PruneMeasure measure : prune_measures()) {
    const MedialAxis pruned = PruneOrder(*axis, measure).at(1e6);
    EXPECT_NEAR(total_length(pruned), 2, 1e-9) << name_of(measure);
  }
}

TEST(Prune, KeepsSoManyBranches) {
  for (std::uint64_t seed = 0; seed < prune_count / 8; ++seed) {
    const MedialAxis axis = axis_of(shape_of(seed).rings);
    for (const PruneMeasure measure : {PruneMeasure::significance, PruneMeasure::residual}) {
      const std::size_t fewest = PruneOrder(axis, measure).branches_at(1e300);
      for (const std::uint64_t keep : {1U, 5U, 20U}) {
        PruneOptions options;
        options.measure = measure;
        options.keep = keep;
        PruneReport report;
        const auto pruned = prune(axis, options, &report);
        ASSERT_TRUE(pruned.ok());
        EXPECT_LE(report.branches, std::max<std::uint64_t>(keep, fewest));
        EXPECT_EQ(report.branches, branches(*pruned).size());
        EXPECT_EQ(report.branches_before, branches(axis).size());
        // No lower threshold would do.
        if (report.threshold > 0) {
          EXPECT_GT(PruneOrder(axis, measure)
                        .branches_at(std::nextafter(report.threshold, 0.0) * (1 - 1e-15)),
                    report.branches);
        }
      }
    }
  }
}

TEST(Prune, RefusesWhatIsNoThreshold) {
  const MedialAxis axis = axis_of({{0, 0}, {6, 0}, {6, 2}, {0, 2}});
  const auto code_of = [&](const PruneOptions& options) {
    const auto result = prune(axis, options);
    return result ? ErrorCode::internal : result.error().code;
  };
  EXPECT_EQ(code_of({.threshold = -1}), ErrorCode::invalid_option);
  EXPECT_EQ(code_of({.threshold = std::nan("")}), ErrorCode::invalid_option);
  EXPECT_EQ(code_of({.threshold = 1, .keep = 3}), ErrorCode::invalid_option);
  EXPECT_TRUE(prune(MedialAxis{}, {}).ok());
  for (const PruneMeasure measure : prune_measures())
    EXPECT_EQ(prune_measure_from(name_of(measure)), measure);
  EXPECT_FALSE(prune_measure_from("size").has_value());
}

}  // namespace
}  // namespace medial
