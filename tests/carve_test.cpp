// Carving: closed forms, and the tool at work on random shapes: nowhere deeper than allowed, and
// nothing left that another place of the tool would take.
#include "medial/carve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "axis/steps.h"
#include "base/open_boxes.h"
#include "medial/compute.h"
#include "medial/measure.h"
#include "medial/query.h"
#include "support/computed.h"
#include "support/cut.h"
#include "support/random_shapes.h"
#include "verify/boundary_edge.h"

namespace medial {
namespace {

const std::uint64_t carve_count = test::shape_count(60);

using test::RandomShape;
using test::shape_of;

Carving carving_of(const Shape& shape, const CarveOptions& options) {
  const auto axis = compute(shape);
  EXPECT_TRUE(axis.ok());
  auto carving = carve(*axis, options);
  EXPECT_TRUE(carving.ok()) << to_string(carving.error());
  return std::move(carving).value();
}

TEST(OpenBoxes, FindTheNearestThatIsLeft) {
  test::Random random(7);
  std::vector<Box> boxes;
  for (int i = 0; i < 300; ++i) {
    const Vec2 p{std::floor(20 * random.unit()), std::floor(20 * random.unit())};
    boxes.push_back({p, p});
  }
  OpenBoxes open(boxes);
  std::vector<bool> left(boxes.size(), true);
  for (std::size_t count = boxes.size(); count > 0; --count) {
    ASSERT_FALSE(open.empty());
    const Vec2 p{20 * random.unit(), std::floor(20 * random.unit())};
    const auto far = [&](std::uint32_t i) { return squared_norm(boxes[i].low - p); };
    std::uint32_t expected = 0, first = 0;
    while (!left[first]) ++first;
    EXPECT_EQ(open.first(), first);
    expected = first;
    for (std::uint32_t i = first; i < boxes.size(); ++i)
      if (left[i] && far(i) < far(expected)) expected = i;
    EXPECT_EQ(open.nearest(p, far), expected);
    open.erase(expected);
    left[expected] = false;
  }
  EXPECT_TRUE(open.empty());
}

TEST(Carve, ASquareIsAPyramid) {
  const Shape square = shape_of(test::rectangle(10, 10));
  const Carving carving = carving_of(square, {.angle = 90});
  EXPECT_NEAR(carving.deepest, 5, 1e-12);
  EXPECT_TRUE(std::isinf(carving.flat_from));
  ASSERT_EQ(carving.paths.size(), 2U);  // four branches, two trails
  const test::Cutter cutter{carving.tip_radius, carving.slope};
  for (const Vec2 p : {Vec2{5, 5}, Vec2{1, 5}, Vec2{2, 7}, Vec2{0.001, 0.001}})
    EXPECT_NEAR(cutter.depth_at(p, carving.paths), clearance(square, p), 1e-12);
  // The tool comes up to the corners.
  double highest = -10;
  for (const ToolPath& path : carving.paths)
    for (const ToolPoint& point : path.points) highest = std::max(highest, point.z);
  EXPECT_NEAR(highest, 0, 1e-12);
}

TEST(Carve, ANarrowerToolGoesDeeper) {
  const Shape square = shape_of(test::rectangle(10, 10));
  EXPECT_NEAR(carving_of(square, {.angle = 60}).deepest, 5 * std::sqrt(3), 1e-12);
  EXPECT_NEAR(carving_of(square, {.angle = 120}).deepest, 5 / std::sqrt(3), 1e-12);
}

TEST(Carve, DepthAndToolMakeFlatBottoms) {
  const Shape square = shape_of(test::rectangle(10, 10));
  const Carving by_depth = carving_of(square, {.angle = 90, .depth = 2});
  const Carving by_tool = carving_of(square, {.angle = 90, .tool = 4});
  for (const Carving& carving : {by_depth, by_tool}) {
    EXPECT_NEAR(carving.deepest, 2, 1e-12);
    EXPECT_NEAR(carving.flat_from, 2, 1e-12);
    EXPECT_EQ(std::count_if(carving.paths.begin(), carving.paths.end(),
                            [](const ToolPath& path) { return path.kind == ToolPathKind::wall; }),
              1);
    const test::Cutter cutter{carving.tip_radius, carving.slope};
    EXPECT_NEAR(cutter.depth_at({1, 5}, carving.paths), 1, 1e-12);
    EXPECT_NEAR(cutter.depth_at({5, 5}, carving.paths), 2, carving.step / carving.slope + 1e-12);
  }
}

TEST(Carve, AnEndMillClearsAPocket) {
  const Shape square = shape_of(test::rectangle(10, 10));
  const Carving carving = carving_of(square, {.angle = 0, .depth = 3, .tool = 2});
  EXPECT_NEAR(carving.deepest, 3, 0);
  EXPECT_EQ(carving.travel_length, 0);  // from pass to pass without lifting
  const test::Cutter cutter{carving.tip_radius, carving.slope};
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p{random.between(0.3, 9.7), random.between(0.3, 9.7)};
    EXPECT_EQ(cutter.depth_at(p, carving.paths), 3);
  }
  EXPECT_EQ(cutter.depth_at({0.05, 0.05}, carving.paths), 0);  // the corner is round
}

TEST(Carve, WaysBetweenPathsAreShort) {
  const Shape maze = shape_of(test::maze(2000));
  const Carving carving = carving_of(maze, {.angle = 90});
  EXPECT_LT(carving.travel_length, 0.7 * carving.travel_unordered);
  // As few paths as the graph's odd nodes allow.
  const auto axis = compute(maze);
  const Incidence incidence(*axis);
  std::size_t odd = 0;
  for (std::uint32_t n = 0; n < axis->nodes.size(); ++n) odd += incidence.degree(n) % 2;
  EXPECT_EQ(carving.paths.size(), odd / 2);
}

TEST(Carve, RefusesWhatNoToolIs) {
  const auto axis = compute(shape_of(test::rectangle(1, 1)));
  for (const CarveOptions& options :
       {CarveOptions{.angle = 180}, CarveOptions{.angle = -1}, CarveOptions{.angle = 0},
        CarveOptions{.angle = std::nan("")}, CarveOptions{.angle = 90, .depth = -1},
        CarveOptions{.angle = 90, .tool = 1, .tip = 1}, CarveOptions{.angle = 0, .tool = 1}})
    EXPECT_EQ(carve(*axis, options).error().code, ErrorCode::invalid_option);
  EXPECT_EQ(carve(MedialAxis{}, {}).error().code, ErrorCode::empty);
  EXPECT_EQ(carve(*axis, {.angle = 90, .depth = 1e-3, .step = 1e-9}).error().code,
            ErrorCode::too_large);
}

/// How deep the tool, along straight moves, cuts beyond the boundary; of an end mill, how far.
double gouge_of(const Shape& shape, const Carving& carving, double chord) {
  std::vector<std::vector<ToolPoint>> paths;
  std::size_t moves = 0;
  for (const ToolPath& path : carving.paths) {
    paths.push_back(without_arcs(path, chord));
    moves += paths.back().size();
  }
  constexpr std::size_t most = 400;  // moves that are checked, evenly spread
  const std::size_t stride = 1 + moves / most;
  double worst = 0;
  std::size_t count = 0;
  for (const std::vector<ToolPoint>& points : paths) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      if (count++ % stride != 0) continue;
      for (const double share : {0.0, 0.25, 0.5, 0.75}) {
        const Vec2 p = points[i].point + share * (points[i + 1].point - points[i].point);
        const double z = points[i].z + share * (points[i + 1].z - points[i].z);
        const double over = carving.tip_radius - carving.slope * z - clearance(shape, p);
        worst = std::max(worst, carving.slope > 0 ? std::min(-z, over / carving.slope) : over);
      }
    }
  }
  return worst;
}

TEST(Carve, ChordsOfRoundWallsDoNotGouge) {
  // A slot around a post: arcs that turn right around its corners, and left in the round ends.
  Ring outer{.points = {{0, 0}, {20, 0}, {20, 10}, {0, 10}}, .bulges = {0, 1, 0, 1}};
  Ring post{.points = {{8, 4}, {12, 4}, {12, 6}, {8, 6}}};
  const Shape shape = shape_of({outer, post});
  for (const double chord : {1e-4, 1e-2, 0.1}) {
    for (const CarveOptions& options :
         {CarveOptions{.angle = 90, .depth = 1}, CarveOptions{.angle = 0, .depth = 1, .tool = 2}}) {
      const Carving carving = carving_of(shape, options);
      EXPECT_LE(gouge_of(shape, carving, chord), 1e-12) << chord;
      // With chords for arcs, the cut is narrower by up to their distance.
      const test::Cutter cutter{carving.tip_radius, carving.slope};
      Carving chords = carving;
      for (ToolPath& path : chords.paths) path.points = without_arcs(path, chord);
      for (double angle = 0; angle < 1.5; angle += 0.1) {
        const Vec2 p = Vec2{12, 6} + (0.1 + chord) * Vec2{std::cos(angle), std::sin(angle)};
        EXPECT_GE(cutter.depth_at(p, chords.paths), std::min(1.0, 0.1) - 1e-9) << angle;
      }
    }
  }
}

TEST(Carve, PassesInDepthTakeOffNoMoreThanAsked) {
  std::size_t several = 0;
  for (std::uint64_t seed = 0; seed < carve_count / 8; ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const Shape shape = shape_of(random.rings);
    if (shape.points.size() > 60) continue;
    const Box box = bounding_box(shape);
    const auto axis = compute(shape);
    ASSERT_TRUE(axis.ok());
    const double deepest = deepest_disk(*axis).radius;
    if (deepest < 1e-2 * diagonal(box)) continue;
    CarveOptions options{.angle = seed % 4 == 3 ? 0.0 : 60.0, .chord = 1e-4 * deepest};
    if (seed % 4 != 0) options.tool = deepest;
    if (seed % 4 == 2) options.tip = 0.4 * deepest;
    if (seed % 4 == 3) options.depth = deepest;
    const auto at_once = carve(*axis, options);
    options.pass_depth = 0.3 * deepest;
    const auto in_passes = carve(*axis, options);
    ASSERT_TRUE(at_once.ok() && in_passes.ok());
    EXPECT_NEAR(in_passes->deepest, at_once->deepest, 1e-9 * deepest);
    EXPECT_LE(gouge_of(shape, *in_passes, 1e-5 * deepest), 1e-6 * deepest);
    const double slope = in_passes->slope, tip = in_passes->tip_radius;
    // Chords, and the ridges of the widest bottom where the tip is a point.
    const double left =
        slope > 0 ? (3 * options.chord + (tip > 0 ? 0 : deepest / 20)) / slope : 0.0;
    const test::Cutter cutter{tip, slope};
    const std::uint32_t passes = in_passes->paths.back().pass + 1;
    several += passes > 1 ? 1 : 0;
    test::Random numbers(seed);
    for (int i = 0; i < 10; ++i) {
      const Vec2 p{numbers.between(box.low.x, box.high.x), numbers.between(box.low.y, box.high.y)};
      double before = 0;
      std::vector<ToolPath> so_far;
      auto next = in_passes->paths.begin();
      for (std::uint32_t pass = 0; pass < passes; ++pass) {
        for (; next != in_passes->paths.end() && next->pass == pass; ++next)
          so_far.push_back(*next);
        const double cut = cutter.depth_at(p, so_far);
        EXPECT_LE(cut - before, options.pass_depth + left + 1e-9 * deepest) << pass;
        before = cut;
      }
      // In the end as much is cut as at once.
      EXPECT_NEAR(before, cutter.depth_at(p, at_once->paths), left + 1e-9 * deepest) << p.x;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(several, carve_count / 50);
}

TEST(Carve, RampsGoDownAlongThePath) {
  const Shape square = shape_of(test::rectangle(10, 8));
  for (const CarveOptions& straight :
       {CarveOptions{.angle = 0, .depth = 3, .tool = 2, .pass_depth = 1},
        CarveOptions{.angle = 60, .depth = 3, .tip = 0.5, .pass_depth = 1}}) {
    CarveOptions options = straight;
    options.ramp = 10;
    const Carving plain = carving_of(square, straight), ramped = carving_of(square, options);
    EXPECT_NEAR(ramped.own_length, plain.own_length, 1e-9);
    EXPECT_GT(ramped.cut_length, plain.cut_length);
    EXPECT_LE(gouge_of(square, ramped, 1e-6), 1e-9);
    double level = 0;
    std::size_t ramps = 0;
    for (std::size_t k = 0; k < ramped.paths.size(); ++k) {
      const ToolPath& path = ramped.paths[k];
      level = -1.0 * path.pass;
      if (path.kind != ToolPathKind::ramp) {  // nothing else goes down below what is cut
        const bool follows =
            k > 0 && ramped.paths[k - 1].points.back().point == path.points[0].point;
        EXPECT_TRUE(follows || path.points[0].z >= level - 1e-9) << k;
        continue;
      }
      ++ramps;
      EXPECT_EQ(path.points.front().z, level);
      EXPECT_NEAR(path.points.back().z, ramped.paths[k + 1].points.front().z, 1e-12);
      for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
        const ToolPoint &from = path.points[i], &to = path.points[i + 1];
        EXPECT_LE(from.z - to.z,
                  std::tan(10 * std::numbers::pi / 180) * distance(from.point, to.point) + 1e-9);
      }
    }
    EXPECT_GE(ramps, 3U);
    const test::Cutter cutter{ramped.tip_radius, ramped.slope};
    for (const Vec2 p : {Vec2{5, 5}, Vec2{1.5, 5}, Vec2{2, 7}})
      EXPECT_NEAR(cutter.depth_at(p, ramped.paths), cutter.depth_at(p, plain.paths), 1e-9);
  }
}

TEST(Carve, RampsAreNowhereSteeperThanAsked) {
  const CarveOptions options{.angle = 0, .depth = 50, .tool = 4, .ramp = 1};
  std::size_t ramps = 0;
  const Carving narrow = carving_of(shape_of(test::rectangle(4.2, 4.2)), options);
  for (const ToolPath& path : narrow.paths) {
    EXPECT_NE(path.kind, ToolPathKind::plunge);
    if (path.kind != ToolPathKind::ramp) continue;
    ++ramps;
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      const ToolPoint &from = path.points[i], &to = path.points[i + 1];
      ASSERT_LE(from.z - to.z,
                std::tan(std::numbers::pi / 180) * distance(from.point, to.point) + 1e-9);
    }
  }
  EXPECT_EQ(ramps, 1U);
  // Where the mill hardly fits there is no way along which to go down, nor in a circle.
  for (const Carving& straight :
       {carving_of(shape_of(test::rectangle(4.000001, 4.000001)), options),
        carving_of(shape_of({test::circle({0, 0}, 2)}), options),
        carving_of(shape_of({test::circle({0, 0}, 2)}), {.ramp = 5})}) {
    ASSERT_GE(straight.paths.size(), 1U);
    const ToolPath& down = straight.paths[0];
    EXPECT_EQ(down.kind, ToolPathKind::plunge);
    ASSERT_EQ(down.points.size(), 2U);
    EXPECT_EQ(down.points[0].z, 0);
    EXPECT_FALSE(std::signbit(down.points[0].z));
    EXPECT_NEAR(down.points[1].z, -straight.deepest, 1e-9);
    EXPECT_TRUE(down.points[0].point == down.points[1].point);
  }
}

TEST(Carve, PassesFollowTheWayOfOne) {
  for (std::uint64_t seed = 0; seed < carve_count / 4; ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const auto axis = compute(shape_of(random.rings));
    ASSERT_TRUE(axis.ok());
    const double deepest = deepest_disk(*axis).radius;
    const auto one = carve(*axis, {.angle = 60});
    const auto many = carve(*axis, {.angle = 60, .pass_depth = 0.1 * deepest});
    ASSERT_TRUE(one.ok() && many.ok());
    EXPECT_LE(many->own_length, many->passes * one->own_length * (1 + 1e-9));
    EXPECT_EQ(many->cut_length, many->own_length);  // without ways in between
    EXPECT_GE(many->passes, 10U);
  }
}

TEST(Carve, AMillClearsBeforeAVAndTouchesNoWall) {
  std::size_t cleared = 0;
  double shorter = 0, longer = 0;
  for (std::uint64_t seed = 0; seed < carve_count / 4; ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const Shape shape = shape_of(random.rings);
    if (shape.points.size() > 60) continue;
    const Box box = bounding_box(shape);
    const auto axis = compute(shape);
    ASSERT_TRUE(axis.ok());
    const double deepest = deepest_disk(*axis).radius;
    if (deepest < 1e-2 * diagonal(box)) continue;
    CarveOptions options{.angle = 60, .depth = 0.4 * deepest, .chord = 1e-4 * deepest};
    if (seed % 2 == 0) options.tip = 0.1 * deepest;
    const double diameter = 0.6 * deepest;
    const auto alone = carve(*axis, options);
    const auto mill = carve(*axis, clearing_before(options, diameter, 0.15 * deepest));
    options.cleared = diameter;
    const auto after = carve(*axis, options);
    ASSERT_TRUE(alone.ok() && mill.ok() && after.ok());
    cleared += mill->paths.empty() ? 0 : 1;
    shorter += after->own_length;
    longer += alone->own_length;
    const test::Cutter v{alone->tip_radius, alone->slope}, flat{mill->tip_radius, 0};
    const double left = (3 * options.chord + (options.tip > 0 ? 0 : alone->step)) / alone->slope;
    test::Random numbers(seed);
    for (int i = 0; i < 100; ++i) {
      const Vec2 p{numbers.between(box.low.x, box.high.x), numbers.between(box.low.y, box.high.y)};
      const double room = std::max(clearance(shape, p), 0.0);
      const double milled = flat.depth_at(p, mill->paths);
      EXPECT_LE(milled, std::min(room / alone->slope, options.depth) + 1e-6 * deepest);
      EXPECT_NEAR(std::max(milled, v.depth_at(p, after->paths)), v.depth_at(p, alone->paths),
                  left + 1e-6 * deepest)
          << p.x << " " << p.y;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(cleared, carve_count / 40);
  EXPECT_LT(shorter, 0.7 * longer);
}

/// From bars with flat ends, as polygons; negative inside.
double distance_to(const Tabs& tabs, Vec2 p) {
  double least = INFINITY;
  for (const TabLine& line : tabs.lines) {
    for (const std::size_t k : {0, 1}) {
      const Vec2 a = line[k], b = line[k + 1];
      const Vec2 aside = tabs.width / 2 / distance(a, b) * left_of(b - a);
      const std::array corners{a - aside, b - aside, b + aside, a + aside};
      double nearest = INFINITY;
      bool inside = true;
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 from = corners[i], to = corners[(i + 1) % 4];
        nearest = std::min(nearest, verify_detail::distance_to_segment(p, from, to));
        inside = inside && cross(to - from, p - from) > 0;
      }
      least = std::min(least, inside ? -nearest : nearest);
    }
  }
  return least;
}

TEST(Carve, TabsStandAndNothingElseDoes) {
  // A part with round ends and a window in it, cut out by a mill, by a V, and by both.
  const Shape part =
      shape_of({{.points = {{0, 0}, {20, 0}, {20, 12}, {0, 12}}, .bulges = {0, 1, 0, 0}},
                {.points = {{5, 4}, {9, 4}, {9, 8}, {5, 8}}}});
  const Shape around = surroundings(part, 4).value();
  const auto axis = compute(around);
  ASSERT_TRUE(axis.ok());
  const auto lines = place_tabs(around, *axis, {.count = 4});
  ASSERT_TRUE(lines.ok());
  ASSERT_EQ(lines->size(), 4U);  // the window has nothing in it
  const double depth = 3, high = 1;
  const Tabs tabs{*lines, 2, depth - high};
  const CarveOptions v{.angle = 60, .depth = depth, .tip = 0.5, .pass_depth = 0.8};
  CarveOptions after = v;
  after.cleared = 1.6;
  std::vector<std::pair<CarveOptions, bool>> tools{
      {{.angle = 0, .depth = depth, .tool = 1.5, .pass_depth = 1, .ramp = 10}, false},
      {v, false},
      {after, true}};
  for (auto& [options, cleared] : tools) {
    const Carving plain = carving_of(around, cleared ? v : options);
    options.tabs = tabs;
    const Carving carving = carving_of(around, options);
    EXPECT_LE(gouge_of(around, carving, 1e-6), 1e-6);
    EXPECT_NEAR(carving.own_length, plain.own_length, cleared ? INFINITY : 1e-9 * plain.own_length);
    const test::Cutter cutter{carving.tip_radius, carving.slope};
    std::vector<ToolPath> mill;
    if (cleared) mill = carving_of(around, clearing_before(options, after.cleared, 1)).paths;
    const auto cut_at = [&](Vec2 p) {
      return std::max(cutter.depth_at(p, carving.paths),
                      test::Cutter{after.cleared / 2, 0}.depth_at(p, mill));
    };
    const double beside = carving.slope * high;  // where the bottom begins
    test::Random random(3);
    std::size_t on_tabs = 0, bottom = 0;
    const double left = cleared ? 5e-3 : 1e-6;  // chords of grooves
    for (int i = 0; i < 300; ++i) {
      const Vec2 p{random.between(-4, 30), random.between(-4, 16)};
      const double off = distance_to(tabs, p), room = clearance(around, p);
      if (room < 0) continue;
      if (off < 0) {
        EXPECT_LE(cut_at(p), tabs.top + 1e-6) << p.x << " " << p.y;
        ++on_tabs;
        // A mill leaves nothing above them; a V leaves what it would reach from nearer to the wall.
        if (carving.slope == 0) {
          EXPECT_NEAR(cut_at(p), std::min(cutter.depth_at(p, plain.paths), tabs.top), 1e-6);
        }
      } else if (off > beside + 2 * carving.tip_radius) {
        EXPECT_NEAR(cut_at(p), cutter.depth_at(p, plain.paths), left) << p.x << " " << p.y;
        bottom += cut_at(p) > depth - 1e-6 ? 1 : 0;
      }
      // Beside a tab all is cut that a tool there reaches.
      const double reach = beside + carving.tip_radius;
      if (off > reach && room > carving.tip_radius + carving.slope * depth) {
        EXPECT_NEAR(cut_at(p), depth, 1e-6);
      }
    }
    EXPECT_GT(on_tabs, 5U);
    EXPECT_GT(bottom, 20U);
  }
}

TEST(Carve, TabsEndAtTheWalls) {
  // A window behind a thin wall: nothing of a tab outside the part is left in it.
  const Shape part = shape_of({{.points = {{0, 0}, {20, 0}, {20, 12}, {0, 12}}},
                               {.points = {{0.6, 3}, {6, 3}, {6, 9}, {0.6, 9}}}});
  const Shape around = surroundings(part, 4).value();
  const Tabs tabs{{{{{-4, 6}, {-2, 6}, {0, 6}}}}, 4, 1};
  for (CarveOptions options : {CarveOptions{.angle = 0, .depth = 3, .tool = 1.5},
                               CarveOptions{.angle = 40, .depth = 3, .tip = 0.4}}) {
    const Carving plain = carving_of(around, options);
    options.tabs = tabs;
    const Carving carving = carving_of(around, options);
    const test::Cutter cutter{carving.tip_radius, carving.slope};
    test::Random random(5);
    for (int i = 0; i < 100; ++i) {
      const Vec2 in_window{random.between(0.6, 6), random.between(3, 9)};
      EXPECT_NEAR(cutter.depth_at(in_window, carving.paths),
                  cutter.depth_at(in_window, plain.paths), 1e-6);
      const Vec2 on_tab{random.between(-4, 0), random.between(4, 8)};
      EXPECT_LE(cutter.depth_at(on_tab, carving.paths), 1 + 1e-6);
    }
  }
}

TEST(Carve, TabsTieAllThatComesLoose) {
  // Two squares side by side in a wide frame: a tab of each goes to the other one.
  const Shape shape = shape_of({test::rectangle(100, 100)[0],
                                {.points = {{40, 45}, {49, 45}, {49, 54}, {40, 54}}},
                                {.points = {{51, 45}, {60, 45}, {60, 54}, {51, 54}}}});
  const auto axis = compute(shape);
  const auto lines = place_tabs(shape, *axis, {.count = 1});
  ASSERT_TRUE(lines.ok());
  const auto outside = std::ranges::count_if(*lines, [](const TabLine& line) {
    const auto on_frame = [](Vec2 p) { return std::min({p.x, p.y, 100 - p.x, 100 - p.y}) < 1e-9; };
    return on_frame(line[0]) || on_frame(line[2]);
  });
  EXPECT_GE(outside, 1);
  EXPECT_EQ(place_tabs(shape, *axis, {.spacing = 4})->size(), 18U);
  EXPECT_TRUE(place_tabs(shape_of(test::rectangle(3, 3)), *compute(shape_of(test::rectangle(3, 3))),
                         {.count = 2})
                  ->empty());
  EXPECT_EQ(place_tabs(shape, *axis, {}).error().code, ErrorCode::invalid_option);
  CarveOptions bad{.angle = 90, .depth = 1};
  bad.tabs = {*lines, 0, 0.5};
  EXPECT_EQ(carve(*axis, bad).error().code, ErrorCode::invalid_option);
}

TEST(Carve, OtherUnitsChangeTheScaleOnly) {
  const auto axis = compute(shape_of(test::rectangle(10, 6)));
  ASSERT_TRUE(axis.ok());
  const CarveOptions options{.angle = 60, .depth = 2, .tip = 0.25, .pass_depth = 1};
  const auto plain = carve(*axis, options);
  const auto other = carve(*axis, scaled(options, 0.25));
  ASSERT_TRUE(plain.ok() && other.ok());
  const Carving back = scaled(*other, 4);
  EXPECT_NEAR(back.deepest, 2, 1e-12);
  EXPECT_EQ(scaled(scaled(options, 0.25), 4).depth, options.depth);
  const auto axis4 = compute(shape_of(test::rectangle(40, 24)));
  ASSERT_TRUE(axis4.ok());
  const auto large = carve(*axis4, options);
  ASSERT_TRUE(large.ok());
  EXPECT_NEAR(back.cut_length, large->cut_length, 1e-9 * large->cut_length);
  ASSERT_EQ(back.paths.size(), large->paths.size());
}

TEST(Carve, CutsTheSameUnderSymmetries) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < carve_count / 4; ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const Shape shape = shape_of(random.rings);
    if (!random.rigid || shape.points.size() > 60) continue;
    const Box box = bounding_box(shape);
    const auto axis = compute(shape);
    ASSERT_TRUE(axis.ok());
    const double deepest = deepest_disk(*axis).radius;
    if (deepest < 1e-2 * diagonal(box)) continue;
    CarveOptions options{.angle = seed % 3 == 2 ? 0.0 : 60.0, .chord = 1e-4 * deepest};
    if (seed % 3 > 0) options.tool = deepest;
    if (seed % 3 == 2) options.depth = deepest;
    const Carving plain = carving_of(shape, options);
    const test::Cutter cutter{plain.tip_radius, plain.slope};
    const double left = plain.slope > 0 ? (3 * options.chord + plain.step) / plain.slope : 0;
    for (const test::Symmetry& symmetry : test::symmetries()) {
      const double scale = symmetry.scale();
      const auto moved = build_shape(test::transformed(random.rings, symmetry));
      ASSERT_TRUE(moved.ok()) << symmetry.name;
      const Carving other = scaled(carving_of(*moved, scaled(options, scale)), 1 / scale);
      const double rounding = 1e-7 * deepest + 1e-15 * std::abs(symmetry.dx) / scale;
      EXPECT_NEAR(other.deepest, plain.deepest, rounding) << symmetry.name;
      test::Random numbers(seed);
      for (int i = 0; i < 4; ++i) {
        const Vec2 p{numbers.between(box.low.x, box.high.x),
                     numbers.between(box.low.y, box.high.y)};
        // At the edge of a mill's bottom rounding shows.
        if (plain.slope == 0 && std::abs(clearance(shape, p)) < rounding) continue;
        EXPECT_NEAR(cutter.depth_at((1 / scale) * symmetry(p), other.paths),
                    cutter.depth_at(p, plain.paths), left + rounding)
            << symmetry.name << " " << p.x << " " << p.y;
        ++compared;
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(compared, carve_count);
}

TEST(Carve, NeitherGougesNorLeavesAnything) {
  std::size_t probes = 0;
  for (std::uint64_t seed = 0; seed < carve_count; ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const Shape shape = shape_of(random.rings);
    if (shape.points.size() > 150) continue;
    const Box box = bounding_box(shape);
    const double size = diagonal(box);
    const auto axis = compute(shape);
    ASSERT_TRUE(axis.ok());
    const double deepest = deepest_disk(*axis).radius;
    if (deepest < 1e-3 * size) continue;
    test::Random numbers(seed);
    CarveOptions options;
    options.angle = numbers.between(20, 150);
    options.chord = 1e-4 * deepest;
    switch (seed % 4) {
      case 0:  // a point, as deep as it goes
        break;
      case 1:  // a point and a flat bottom
        options.tool = 2 * deepest * numbers.between(0.2, 0.9);
        break;
      case 2:  // a flat tip and a flat bottom
        options.tool = 2 * deepest * numbers.between(0.4, 0.9);
        options.tip = options.tool * numbers.between(0.2, 0.6);
        break;
      case 3:  // an end mill
        options.angle = 0;
        options.tool = 2 * deepest * numbers.between(0.1, 0.9);
        options.depth = 0.3 * size;
        break;
    }
    const auto carving = carve(*axis, options);
    ASSERT_TRUE(carving.ok()) << to_string(carving.error());
    const test::Cutter cutter{carving->tip_radius, carving->slope};
    const double slope = carving->slope, tip = carving->tip_radius;
    const double limit = options.angle == 0
                             ? options.depth
                             : std::min(carving->deepest, (options.tool / 2 - tip) / slope +
                                                              (options.tool > 0 ? 0.0 : 1e300));
    // The material that may remain: see carve().
    const double left = slope > 0 ? (3 * options.chord + (tip > 0 ? 0 : carving->step)) / slope : 0;
    EXPECT_LE(gouge_of(shape, *carving, 1e-6 * (tip + slope * carving->deepest)), 1e-6 * deepest);
    for (int i = 0; i < 60; ++i) {
      const Vec2 p{numbers.between(box.low.x, box.high.x), numbers.between(box.low.y, box.high.y)};
      const double room = clearance(shape, p);
      const double cut = cutter.depth_at(p, carving->paths);
      // Never outside; inside no deeper than a wall from the boundary.
      const double allowed = room <= 0 ? 0 : slope > 0 ? std::min(room / slope, limit) : limit;
      EXPECT_LE(cut, allowed + 1e-6 * deepest) << p.x << " " << p.y;
      if (room <= 0) continue;
      // Another place where the tool may be takes nothing more off.
      for (int k = 0; k < 4; ++k) {
        const double angle = numbers.between(0, 7), far = numbers.between(0, 1.2 * deepest);
        const Vec2 at = k == 0 ? p : p + far * Vec2{std::cos(angle), std::sin(angle)};
        const double there = clearance(shape, at);
        if (there < tip) continue;
        const double deep = slope > 0 ? std::min((there - tip) / slope, limit) : limit;
        const double more = cutter.depth_at(p, at, deep);
        if (slope == 0 && distance(p, at) > tip * (1 - 1e-9)) continue;
        EXPECT_GE(cut, more - left - 1e-9 * deepest) << p.x << " " << p.y;
        ++probes;
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(probes, 20 * carve_count);
}

}  // namespace
}  // namespace medial
