// Main paths, routes, widest ways, parts of an axis: closed forms, brute force, random shapes.
#include "medial/centreline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "axis/steps.h"
#include "medial/compute.h"
#include "medial/measure.h"
#include "medial/query.h"
#include "support/computed.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

using test::Computed;
using test::computed;
using test::random_any;
using test::RandomShape;
using test::Rings;

using std::numbers::pi;

Disk begin_of(const MedialAxis& axis, const AxisPath& path) {
  const PathPiece& piece = path.pieces.front();
  return disk_at(axis, axis.edges[piece.edge], piece.from);
}
Disk end_of(const MedialAxis& axis, const AxisPath& path) {
  const PathPiece& piece = path.pieces.back();
  return disk_at(axis, axis.edges[piece.edge], piece.to);
}

double reach_of(const MedialAxis& axis, const AxisPath& path) {
  if (path.closed) return path.length;
  return path.length + begin_of(axis, path).radius + end_of(axis, path).radius;
}

AxisPath only_path(const MedialAxis& axis, const MainPathOptions& options = {}) {
  const auto paths = main_paths(axis, options);
  EXPECT_EQ(paths.size(), 1U);
  return paths.empty() ? AxisPath{} : paths.front();
}

/// Every piece begins where the one before ends.
void expect_connected(const MedialAxis& axis, const AxisPath& path) {
  ASSERT_FALSE(path.pieces.empty());
  for (std::size_t i = 0; i + 1 < path.pieces.size(); ++i) {
    const PathPiece &a = path.pieces[i], &b = path.pieces[i + 1];
    EXPECT_EQ(disk_at(axis, axis.edges[a.edge], a.to).center,
              disk_at(axis, axis.edges[b.edge], b.from).center);
  }
  if (path.closed) {
    EXPECT_EQ(begin_of(axis, path).center, end_of(axis, path).center);
  }
}

TEST(MainPath, OfARectangleIsItsMiddleLine) {
  for (const double length : {3.1, 10.0, 1000.0}) {
    const auto [shape, axis] = computed(test::rectangle(length, 3));
    const AxisPath path = only_path(axis);
    EXPECT_NEAR(path.length, length - 3, 1e-12 * length);
    EXPECT_NEAR(path.narrowest, 1.5, 1e-13);
    EXPECT_EQ(path.gap, 0);
    const MedialAxis line = centre_line(shape, axis, path, {.extend = true});
    EXPECT_NEAR(total_length(line), length, 1e-12 * length);
    for (const Node& node : line.nodes) EXPECT_NEAR(node.disk.center.y, 1.5, 1e-13);
  }
}

TEST(MainPath, OfManyPartsAreThoseOfEachPart) {
  Rings all;
  for (double k = 0; k < 6; ++k) {
    for (Ring ring : {test::rectangle(4 + k, 2)[0], test::rectangle(0.5, 0.5)[0]}) {
      const bool hole = ring.points[2].x < 1;
      for (Vec2& p : ring.points)
        p = p + Vec2{12 * k, hole ? 0.75 : 0} + (hole ? 1 : 0) * Vec2{0.75, 0};
      all.push_back(ring);
    }
  }
  const auto [shape, axis] = computed(all);
  ASSERT_EQ(shape.component_count(), 6U);
  const auto paths = main_paths(axis);
  ASSERT_EQ(paths.size(), 6U);
  const CentreLineOptions options{.extend = true, .smooth = 0.5};
  const MedialAxis lines = centre_lines(shape, axis, paths, options);
  EXPECT_EQ(lines.sites.size(), axis.sites.size());
  std::size_t node = 0, edge = 0;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const auto [one, alone] = computed({all[2 * k], all[2 * k + 1]});
    EXPECT_NEAR(paths[k].length, only_path(alone).length, 1e-12);
    const MedialAxis line = centre_line(shape, axis, paths[k], options);
    ASSERT_LE(node + line.nodes.size(), lines.nodes.size());
    ASSERT_LE(edge + line.edges.size(), lines.edges.size());
    for (const Node& own : line.nodes) EXPECT_EQ(own.disk.center, lines.nodes[node++].disk.center);
    edge += line.edges.size();
  }
  EXPECT_EQ(node, lines.nodes.size());
  EXPECT_EQ(edge, lines.edges.size());
}

TEST(MainPath, OfASquareIsADiagonal) {
  const auto [shape, axis] = computed(test::rectangle(2, 2));
  EXPECT_NEAR(only_path(axis).length, 2 * std::sqrt(2.0), 1e-14);
}

TEST(MainPath, OfAStadiumJoinsItsCentres) {
  const auto [shape, axis] = computed({test::stadium({1, 2}, {4, 6}, 0.5)});
  const AxisPath path = only_path(axis);
  EXPECT_NEAR(path.length, 5, 1e-13);
  const MedialAxis line = centre_line(shape, axis, path, {.extend = true});
  EXPECT_NEAR(total_length(line), 6, 1e-12);
}

TEST(MainPath, OfAnAnnulusIsTheCircleBetween) {
  Rings rings{test::circle({3, -1}, 5), test::circle({3, -1}, 2)};
  const auto [shape, axis] = computed(rings);
  const AxisPath path = only_path(axis);
  EXPECT_TRUE(path.closed);
  EXPECT_NEAR(path.length, 2 * pi * 3.5, 1e-12);
  EXPECT_NEAR(path.narrowest, 1.5, 1e-13);
}

TEST(MainPath, OfARingOfCorridorsIsClosed) {
  // Four straight pieces and, around each inner corner, two pieces of parabolas.
  const auto [shape, axis] = computed({test::ring_of({{0, 0}, {10, 0}, {10, 10}, {0, 10}}),
                                       test::ring_of({{2, 2}, {8, 2}, {8, 8}, {2, 8}})});
  const AxisPath path = only_path(axis);
  EXPECT_TRUE(path.closed);
  // y = x^2 / 4 from x = 0 to 2 sqrt 2 - 2, eight times.
  const double u = std::sqrt(2.0) - 1;
  const double arc = u * std::hypot(1.0, u) + std::asinh(u);
  EXPECT_NEAR(path.length, 24 + 8 * arc, 1e-11);
  expect_connected(axis, path);
}

TEST(MainPath, OfAWedgeRunsToItsTip) {
  const double half = 10 * pi / 180;
  const auto [shape, axis] =
      computed(test::triangle({0, 0}, {10, -10 * std::tan(half)}, {10, 10 * std::tan(half)}));
  // To the centre of the incircle, and no further: the corners at the base have 80 degrees.
  const double incircle = 10 * std::sin(half) / (1 + std::sin(half));
  const AxisPath path = only_path(axis);
  EXPECT_NEAR(path.length, incircle / std::sin(half), 1e-12);
  EXPECT_NEAR(only_path(axis, {.trim = 0}).length,
              incircle / std::sin(half) + incircle / std::sin(40 * pi / 180), 1e-12);
  const MedialAxis line = centre_line(shape, axis, path, {.extend = true});
  EXPECT_NEAR(total_length(line), 10, 1e-12);
}

TEST(MainPath, OfAnEllBendsAroundItsCorner) {
  const auto [shape, axis] = computed(test::l_shape(2));
  const AxisPath path = only_path(axis);
  EXPECT_FALSE(path.closed);
  EXPECT_NEAR(path.narrowest, 1, 1e-13);
  EXPECT_NEAR(begin_of(axis, path).radius, 1, 1e-13);
  EXPECT_NEAR(end_of(axis, path).radius, 1, 1e-13);
  expect_connected(axis, path);
}

TEST(MainPath, TakesTheRoomySideOfAnIsland) {
  // A corridor with an island: 1 wide below, 3 wide above.
  const auto [shape, axis] = computed({test::ring_of({{0, 0}, {60, 0}, {60, 8}, {0, 8}}),
                                       test::ring_of({{25, 1}, {25, 5}, {35, 5}, {35, 1}})});
  const AxisPath roomy = only_path(axis);
  EXPECT_GT(roomy.narrowest, 1.4);
  const AxisPath shortest = only_path(axis, {.route = Route::shortest});
  EXPECT_LE(shortest.length, roomy.length + 1e-12);
}

TEST(SideChannels, AreTheOtherWaysAroundHolesAndNoTributaries) {
  // A river with two islands, a tributary, and a tributary with an island of its own.
  const auto [shape, axis] =
      computed({test::ring_of({{0, 0},
                               {20, 0},
                               {20, -30},
                               {24, -30},
                               {24, 0},
                               {60, 0},
                               {60, -10},
                               {55, -10},
                               {55, -20},
                               {67, -20},
                               {67, -10},
                               {62, -10},
                               {62, 0},
                               {100, 0},
                               {100, 8},
                               {0, 8}}),
                test::ring_of({{30, 3}, {30, 5}, {40, 5}, {40, 3}}),
                test::ring_of({{70, 2}, {70, 5}, {80, 5}, {80, 2}}),
                test::ring_of({{59, -17}, {59, -13}, {63, -13}, {63, -17}})});
  const AxisPath path = only_path(axis);
  const std::vector<PathPiece> channels = side_channels(axis, path);
  ASSERT_FALSE(channels.empty());
  double beside = 0;
  for (const PathPiece& piece : channels) {
    const Disk disk = disk_at(axis, axis.edges[piece.edge], 0.5);
    EXPECT_GT(disk.center.y, -1);  // none of a tributary
    EXPECT_TRUE((disk.center.x > 25 && disk.center.x < 45) ||
                (disk.center.x > 65 && disk.center.x < 85));
    beside += length(axis, axis.edges[piece.edge]);
  }
  EXPECT_GT(beside, 20);
  EXPECT_LT(beside, 50);
  // With them, there is a cycle for each of the two islands.
  std::vector<PathPiece> all = path.pieces;
  all.insert(all.end(), channels.begin(), channels.end());
  const MedialAxis network = part_of(axis, all);
  EXPECT_EQ(network.edges.size() + 1 - network.nodes.size(), 2U);
  const auto simple = computed({test::ring_of({{0, 0}, {30, 0}, {30, 8}, {0, 8}})});
  EXPECT_TRUE(side_channels(simple.axis, only_path(simple.axis)).empty());
}

/// The largest reach between any two leaves by Floyd and Warshall's algorithm.
double reach_by_all_pairs(const MedialAxis& axis) {
  const std::size_t n = axis.nodes.size();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> d(n, std::vector<double>(n, infinity));
  for (std::size_t i = 0; i < n; ++i) d[i][i] = 0;
  for (const Edge& edge : axis.edges) {
    const double l = length(axis, edge);
    d[edge.node[0]][edge.node[1]] = std::min(d[edge.node[0]][edge.node[1]], l);
    d[edge.node[1]][edge.node[0]] = std::min(d[edge.node[1]][edge.node[0]], l);
  }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
  double best = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i != j && d[i][j] < infinity)
        best = std::max(best, d[i][j] + axis.nodes[i].disk.radius + axis.nodes[j].disk.radius);
    }
  }
  return best;
}

TEST(MainPath, ReachesAsFarAsAnyShortestWay) {
  std::size_t with_holes = 0;
  for (std::uint64_t seed = 0; seed < test::shape_count(100, 24); ++seed) {
    const RandomShape random = random_any(seed);
    const auto [shape, axis] = computed(random.rings);
    if (axis.nodes.size() > 150) continue;
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const auto paths = main_paths(axis, {.trim = 0, .route = Route::shortest});
    double reach = 0, gap = 0;
    bool closed = false;
    for (const AxisPath& path : paths) {
      expect_connected(axis, path);
      reach = std::max(reach, reach_of(axis, path));
      gap = std::max(gap, path.gap);
      closed = closed || path.closed;
    }
    if (closed || gap > 0) continue;
    if (shape.hole_count() > 0) ++with_holes;
    const double expected = reach_by_all_pairs(axis);
    ASSERT_NEAR(reach, expected, 1e-9 * expected);
  }
  EXPECT_GT(with_holes, 0U);
}

TEST(MainPath, IsTheSameUnderSymmetries) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < test::shape_count(200, 24); ++seed) {
    const RandomShape random = test::random_shape(seed);
    if (!random.rigid) continue;
    const auto [shape, axis] = computed(random.rings);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const auto reaches = [](const MedialAxis& of, const MainPathOptions& options) {
      std::vector<double> all;
      for (const AxisPath& path : main_paths(of, options))
        all.push_back(reach_of(of, path) + path.gap);
      std::ranges::sort(all);
      return all;
    };
    const MainPathOptions whole{.trim = 0, .route = Route::shortest};
    const auto expected = reaches(axis, whole);
    for (std::size_t i = 1; i < test::symmetries().size(); ++i) {
      const test::Symmetry& symmetry = test::symmetries()[i];
      const auto moved = computed(test::transformed(random.rings, symmetry));
      const auto found = reaches(moved.axis, whole);
      ASSERT_EQ(found.size(), expected.size()) << symmetry.name;
      for (std::size_t k = 0; k < found.size(); ++k)
        ASSERT_NEAR(found[k] / symmetry.scale(), expected[k],
                    1e-7 * expected[k] + 100 * moved.axis.tolerance / symmetry.scale())
            << symmetry.name;
      ++compared;
    }
  }
  EXPECT_GT(compared, 0U);
}

/// Calls `take` for every simple path between two nodes.
void every_path(const MedialAxis& axis, std::uint32_t from, std::uint32_t to,
                const std::function<void(double narrowest, double length)>& take) {
  const Incidence incidence(axis);
  std::vector<bool> on_path(axis.nodes.size(), false);
  const std::function<void(std::uint32_t, double, double)> go = [&](std::uint32_t node,
                                                                    double narrow, double sum) {
    if (node == to) return take(narrow, sum);
    on_path[node] = true;
    for (const std::uint32_t e : incidence.edges(node)) {
      const Edge& edge = axis.edges[e];
      const std::uint32_t next = edge.node[0] == node ? edge.node[1] : edge.node[0];
      if (on_path[next]) continue;
      double least = narrow;
      for (int i = 0; i <= 64; ++i) least = std::min(least, disk_at(axis, edge, i / 64.0).radius);
      go(next, least, sum + length(axis, edge));
    }
    on_path[node] = false;
  };
  go(from, axis.nodes[from].disk.radius, 0);
}

TEST(WidestPath, AgreesWithEveryPath) {
  std::size_t compared = 0, choices = 0;
  for (std::uint64_t seed = 0; seed < test::shape_count(50, 24); ++seed) {
    test::Random random(seed);
    const Rings rings = test::star_with_holes(random, 6 + seed % 5, 2);
    const auto [shape, axis] = computed(rings);
    const Incidence incidence(axis);
    const auto n = static_cast<std::int64_t>(axis.nodes.size());
    const auto from = static_cast<std::uint32_t>(random.integer(0, n - 1));
    const auto to = static_cast<std::uint32_t>(random.integer(0, n - 1));
    if (from == to) continue;
    const auto place = [&, &axis = axis](std::uint32_t node) -> EdgePlace {
      const std::uint32_t edge = incidence.edges(node)[0];
      return {edge, axis.edges[edge].node[0] == node ? 0.0 : 1.0};
    };
    double widest = -1, shortest = std::numeric_limits<double>::infinity();
    std::size_t count = 0;
    every_path(axis, from, to, [&](double narrow, double sum) {
      widest = std::max(widest, narrow);
      shortest = std::min(shortest, sum);
      ++count;
    });
    choices += count > 1 ? 1 : 0;
    const auto wide = widest_path(axis, place(from), place(to));
    const auto near = path_between(axis, place(from), place(to));
    ASSERT_TRUE(wide.ok() && near.ok());
    // Sixty-four samples an edge see the narrowest place to a few thousandths.
    ASSERT_LE(wide->narrowest, widest + 1e-12) << seed;
    ASSERT_GE(wide->narrowest, widest - 2e-3) << seed;
    ASSERT_NEAR(near->length, shortest, 1e-12) << seed;
    ASSERT_GE(wide->length, shortest - 1e-12);
    ++compared;
  }
  EXPECT_GT(compared, 0U);
  EXPECT_GT(choices, 0U);
}

TEST(WidestPath, WithinOneEdgeAndBetweenParts) {
  const auto [shape, axis] = computed(test::rectangle(10, 2));
  const auto a = place_on_axis(axis, {3, 1}), b = place_on_axis(axis, {7, 0.5});
  ASSERT_TRUE(a && b);
  const auto path = widest_path(axis, *a, *b);
  ASSERT_TRUE(path.ok());
  EXPECT_NEAR(path->length, 4, 1e-13);
  Rings two = test::rectangle(1, 2);
  for (Ring ring : test::rectangle(1, 2)) {
    for (Vec2& p : ring.points) p.x += 5;
    two.push_back(ring);
  }
  const auto apart = computed(two);
  const auto c = place_on_axis(apart.axis, {0.5, 1}), d = place_on_axis(apart.axis, {5.5, 1});
  ASSERT_TRUE(c && d);
  EXPECT_FALSE(widest_path(apart.axis, *c, *d).ok());
  EXPECT_FALSE(path_between(apart.axis, *c, *d).ok());
  EXPECT_EQ(path_between(axis, {9999, 0}, *b).error().code, ErrorCode::invalid_option);
}

TEST(PlaceOnAxis, OfASideIsTheDiskThatTouchesItsMiddle) {
  const auto [shape, axis] = computed(test::rectangle(10, 4));
  const auto end = place_on_axis(axis, {0, 2});
  ASSERT_TRUE(end);
  const Disk disk = disk_at(axis, axis.edges[end->edge], end->t);
  EXPECT_NEAR(distance(disk.center, {2, 2}), 0, 1e-13);
  const auto inside = place_on_axis(axis, {4, 0.25});
  ASSERT_TRUE(inside);
  EXPECT_NEAR(distance(disk_at(axis, axis.edges[inside->edge], inside->t).center, {4, 2}), 0,
              1e-12);
}

TEST(PlaceOnAxis, LiesBeyondThePointSeenFromItsFoot) {
  std::size_t checked = 0;
  for (std::uint64_t seed = 0; seed < test::shape_count(40, 24); ++seed) {
    const RandomShape random_shape = random_any(seed);
    const auto [shape, axis] = computed(random_shape.rings);
    const Box box = bounding_box(shape);
    const double size = diagonal(box);
    test::Random random(seed);
    for (int i = 0; i < 20; ++i) {
      const Vec2 p{random.between(box.low.x, box.high.x), random.between(box.low.y, box.high.y)};
      const double depth = clearance(shape, p);
      if (depth < 1e-3 * size) continue;
      const auto place = place_on_axis(axis, p);
      if (!place) continue;
      const Disk disk = disk_at(axis, axis.edges[place->edge], place->t);
      // The disk around p lies in the maximal disk, and touches it where both touch the boundary.
      EXPECT_NEAR(disk.radius - distance(disk.center, p), depth, 1e-7 * size)
          << random_shape.kind << " " << seed;
      ++checked;
    }
  }
  EXPECT_GT(checked, 0U);
}

TEST(PartOf, IsTheSameCurve) {
  for (std::uint64_t seed = 0; seed < test::shape_count(200, 24); ++seed) {
    const RandomShape random = random_any(seed);
    const auto [shape, axis] = computed(random.rings);
    const double size = diagonal(bounding_box(shape));
    std::vector<PathPiece> pieces;
    for (std::uint32_t i = 0; i < axis.edges.size(); ++i) pieces.push_back({i, 0.75, 0.125});
    const MedialAxis part = part_of(axis, pieces);
    ASSERT_EQ(part.edges.size(), axis.edges.size());
    for (std::size_t i = 0; i < part.edges.size(); ++i) {
      const Disk middle = disk_at(part, part.edges[i], 0.5);
      for (const std::uint32_t s : part.edges[i].site)
        EXPECT_NEAR(distance(foot(axis.sites[s], middle.center), middle.center), middle.radius,
                    1e-9 * size);
      EXPECT_EQ(part.edges[i].site[0], axis.edges[i].site[1]);
    }
  }
}

TEST(ClearancePart, EndsWhereTheDiskJustFits) {
  for (std::uint64_t seed = 0; seed < test::shape_count(100, 24); ++seed) {
    const RandomShape random = random_any(seed);
    const auto [shape, axis] = computed(random.rings);
    if (axis.nodes.empty()) continue;
    const double deepest = deepest_disk(axis).radius;
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    for (const double share : {0.2, 0.7}) {
      const double clearance = share * deepest;
      const MedialAxis part = clearance_part(axis, clearance);
      for (const Edge& edge : part.edges)
        for (const double t : {0.0, 0.3, 0.6, 1.0})
          ASSERT_GE(disk_at(part, edge, t).radius, clearance - 1e-9 * deepest);
      // The missing part is narrower.
      double wide = 0;
      for (const Edge& edge : axis.edges)
        for (int i = 0; i < 100; ++i)
          if (disk_at(axis, edge, (i + 0.5) / 100).radius >= clearance)
            wide += distance(disk_at(axis, edge, i / 100.0).center,
                             disk_at(axis, edge, (i + 1) / 100.0).center);
      EXPECT_NEAR(total_length(part), wide, 0.05 * total_length(axis));
    }
  }
}

TEST(CentreLine, SmoothedStaysInsideWithItsEndsInPlace) {
  for (std::uint64_t seed = 0; seed < test::shape_count(400, 24); ++seed) {
    const RandomShape random = random_any(seed);
    const auto [shape, axis] = computed(random.rings);
    const double size = diagonal(bounding_box(shape));
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    for (const AxisPath& path : main_paths(axis)) {
      const MedialAxis line = centre_line(shape, axis, path, {.extend = true, .smooth = 1});
      const MedialAxis plain = centre_line(shape, axis, path, {.extend = true});
      if (!path.closed) {
        EXPECT_EQ(line.nodes.front().disk.center,
                  plain.nodes[plain.edges.front().node[0]].disk.center);
        EXPECT_NEAR(distance(line.nodes.back().disk.center,
                             plain.nodes[plain.edges.back().node[1]].disk.center),
                    0, 1e-12 * size);
      }
      std::size_t step = std::max<std::size_t>(line.nodes.size() / 40, 1);
      for (std::size_t i = 1; i + 1 < line.nodes.size(); i += step) {
        const Disk& disk = line.nodes[i].disk;
        EXPECT_GE(clearance(shape, disk.center), -1e-9 * size);
      }
    }
  }
}

TEST(CentreLine, SmoothingTakesAwayWiggles) {
  // A corridor whose walls wave: the axis waves, the smoothed line hardly.
  std::vector<Vec2> points;
  constexpr int n = 200;
  for (int i = 0; i <= n; ++i) points.push_back({0.1 * i, 0.1 * std::sin(2.0 * i)});
  for (int i = n; i >= 0; --i) points.push_back({0.1 * i, 1 + 0.1 * std::sin(2.0 * i + 1)});
  const auto [shape, axis] = computed({test::ring_of(points)});
  const AxisPath path = only_path(axis);
  const MedialAxis smooth = centre_line(shape, axis, path, {.smooth = 1});
  const auto largest_deviation = [](const MedialAxis& line) {
    double largest = 0;
    for (const Node& node : line.nodes)
      if (node.disk.center.x > 2 && node.disk.center.x < 18)
        largest = std::max(largest, std::abs(node.disk.center.y - 0.5));
    return largest;
  };
  EXPECT_GT(largest_deviation(centre_line(shape, axis, path)), 0.01);
  EXPECT_LT(largest_deviation(smooth), 0.002);
}

}  // namespace
}  // namespace medial
