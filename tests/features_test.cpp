// Features of axes: each primitive and variation on a shape made for it, closed forms, and what no
// symmetry changes.
#include "medial/features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "medial/compute.h"
#include "medial/prune.h"
#include "medial/query.h"
#include "ops/burn.h"
#include "support/computed.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

const std::uint64_t feature_count = test::shape_count(20);

using std::numbers::pi;
using test::axis_of;
using test::RandomShape;
using test::Rings;

/// The runs of the branch of the largest mean width times length.
std::vector<PrimitiveRun> main_runs(const AxisFeatures& features) {
  const BranchFeatures* main = &features.branches.front();
  for (const BranchFeatures& branch : features.branches)
    if (branch.mean_width * branch.length > main->mean_width * main->length) main = &branch;
  const auto begin = features.runs.begin() + main->first_run;
  return {begin, begin + main->run_count};
}

/// An axis of samples along a curve: one branch without sites.
template <class Curve>
MedialAxis sampled(const Curve& curve, double from, double to, int count) {
  MedialAxis axis;
  axis.method = "made";
  axis.resolution = (to - from) / count;
  for (int i = 0; i <= count; ++i) {
    const Disk disk = curve(from + (to - from) * i / count);
    axis.nodes.push_back({disk, 0, i == 0 || i == count ? NodeKind::leaf : NodeKind::site_change});
    if (i == 0) continue;
    const auto k = static_cast<std::uint32_t>(i);
    const Disk& before = axis.nodes[k - 1].disk;
    axis.edges.push_back(
        {{k - 1, k},
         {no_site, no_site},
         {midpoint(before.center, disk.center), 0.5 * (before.radius + disk.radius)},
         1});
  }
  return axis;
}

TEST(Features, OfARectangle) {
  const AxisFeatures features = describe(axis_of(test::rectangle(8, 2)));
  EXPECT_EQ(features.ends, 4U);
  EXPECT_EQ(features.branchings, 2U);
  EXPECT_EQ(features.components, 1U);
  EXPECT_EQ(features.cycles, 0U);
  EXPECT_NEAR(features.area, 16, 1e-12);
  EXPECT_NEAR(features.boundary, 20, 1e-12);
  EXPECT_NEAR(features.length, 6 + 4 * std::sqrt(2.0), 1e-12);
  ASSERT_EQ(features.branches.size(), 5U);
  ASSERT_EQ(features.runs.size(), 5U);
  for (const BranchFeatures& branch : features.branches) {
    ASSERT_EQ(branch.run_count, 1U);
    const PrimitiveRun& run = features.runs[branch.first_run];
    EXPECT_EQ(run.variation, Variation::straight);
    EXPECT_NEAR(branch.absolute_turning, 0, 1e-12);
    EXPECT_FALSE(branch.closed);
    EXPECT_EQ(branch.from_kind, PointKind::branching);
    if (branch.to_kind == PointKind::end) {
      EXPECT_EQ(run.primitive, Primitive::closing_wedge);
      EXPECT_NEAR(run.slope, -std::sqrt(0.5), 1e-12);
      EXPECT_NEAR(branch.area, 1, 1e-12);
      EXPECT_NEAR(branch.mean_width, 1, 1e-12);
      EXPECT_NEAR(branch.significance, std::sqrt(2.0) - 1, 1e-12);
      EXPECT_NEAR(branch.side[0].length, 1, 1e-12);
      EXPECT_EQ(branch.side[0].from, branch.side[1].to);
    } else {
      EXPECT_EQ(run.primitive, Primitive::worm);
      EXPECT_NEAR(branch.length, 6, 1e-12);
      EXPECT_NEAR(branch.area, 12, 1e-12);
      // Fires from both ends meet in the middle, at the time sqrt(2) + 3.
      EXPECT_NEAR(branch.significance, std::sqrt(2.0) + 3 - 1, 1e-12);
      EXPECT_NEAR(branch.side[1].length, 6, 1e-12);
      EXPECT_NEAR(distance(branch.side[1].from, branch.side[1].to), 6, 1e-12);
    }
  }
}

TEST(Features, OfADiskAreOneEndPoint) {
  Ring ring;
  ring.points = {{2, 0}, {-2, 0}};
  ring.bulges = {1, 1};
  const AxisFeatures features = describe(axis_of({ring}));
  EXPECT_EQ(features.ends, 1U);
  EXPECT_TRUE(features.branches.empty());
  EXPECT_NEAR(features.area, 4 * pi, 1e-12);
  EXPECT_NEAR(features.boundary, 4 * pi, 1e-12);
  EXPECT_NEAR(features.mean_width, 4, 1e-12);
}

/// A ring between two circles, the inner one moved aside: Fig 5's torus.
Rings torus(double aside) {
  Ring outer, inner;
  outer.points = {{4, 0}, {-4, 0}};
  inner.points = {{2 + aside, 0}, {-2 + aside, 0}};
  outer.bulges = inner.bulges = {1, 1};
  inner.role = RingRole::hole;
  return {outer, inner};
}

TEST(Features, OfATorusAreOneClosedBranch) {
  const AxisFeatures even = describe(axis_of(torus(0)));
  ASSERT_EQ(even.branches.size(), 1U);
  EXPECT_TRUE(even.branches[0].closed);
  EXPECT_EQ(even.ends + even.branchings, 0U);
  EXPECT_EQ(even.cycles, 1U);
  EXPECT_EQ(even.closed_branches, 1U);
  EXPECT_NEAR(even.length, 6 * pi, 1e-9);
  EXPECT_NEAR(std::abs(even.branches[0].turning), 2 * pi, 1e-9);
  EXPECT_NEAR(even.area, 12 * pi, 1e-9);
  EXPECT_TRUE(std::isinf(even.branches[0].significance));
  ASSERT_EQ(even.runs.size(), 1U);
  EXPECT_EQ(even.runs[0].primitive, Primitive::worm);
  EXPECT_TRUE(even.runs[0].variation == Variation::left_circular ||
              even.runs[0].variation == Variation::right_circular);

  // Deformed: it opens on the way to the wide side, and closes again.
  const AxisFeatures bent = describe(axis_of(torus(1)));
  ASSERT_EQ(bent.branches.size(), 1U);
  EXPECT_TRUE(bent.branches[0].closed);
  EXPECT_NEAR(bent.branches[0].smallest_radius, 0.5, 1e-9);
  EXPECT_NEAR(bent.branches[0].largest_radius, 1.5, 1e-9);
  EXPECT_NEAR(bent.area, 12 * pi, 1e-9);
  double opening = 0, closing = 0;
  for (const PrimitiveRun& run : bent.runs) {
    (run.slope > 0 ? opening : closing) += run.length;
  }
  EXPECT_NEAR(opening, closing, 1e-9);
}

// Fig 6. The sides of a straight axis: lines for worm and wedge, arcs for cup and flare.

/// Between y = -h(x) and y = h(x): the corners (0, a), (8, b) and their mirror images, the two long
/// sides with the given bulge, the short ones straight.
AxisFeatures horn(double a, double b, double bulge) {
  Ring ring;
  ring.points = {{0, -a}, {8, -b}, {8, b}, {0, a}};
  ring.bulges = {bulge, 0, bulge, 0};
  return describe(axis_of({ring}));
}

TEST(Primitives, Worm) {
  const auto runs = main_runs(horn(1, 1, 0));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].primitive, Primitive::worm);
  EXPECT_EQ(runs[0].variation, Variation::straight);
}

TEST(Primitives, Wedge) {
  const auto runs = main_runs(horn(3, 1, 0));
  ASSERT_EQ(runs.size(), 1U);  // from the deeper end
  EXPECT_EQ(runs[0].primitive, Primitive::closing_wedge);
  EXPECT_NEAR(runs[0].slope, -std::sin(std::atan(0.25)), 1e-9);
}

TEST(Primitives, Cup) {
  const auto runs = main_runs(horn(2, 0.5, 0.2));
  ASSERT_GE(runs.size(), 1U);
  for (const PrimitiveRun& run : runs)
    EXPECT_TRUE(run.primitive == Primitive::opening_cup || run.primitive == Primitive::closing_cup);
}

TEST(Primitives, FlareIsCutAtItsThroat) {
  const auto runs = main_runs(horn(3, 3, -0.2));
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].primitive, Primitive::closing_flare);
  EXPECT_EQ(runs[1].primitive, Primitive::opening_flare);
  EXPECT_NEAR(runs[0].to.disk.center.x, 4, 1e-9);
  EXPECT_NEAR(runs[0].to.disk.radius, 3 - 0.8, 1e-9);
  EXPECT_NEAR(runs[0].length, runs[1].length, 1e-9);
}

// Every primitive and every variation by its functions: radius and curvature along the axis.

struct Made {
  double slope, bend;   ///< radius: 1 + slope s + bend s^2 / 2 over s in [0, 2]
  double turn, spiral;  ///< curvature: turn + spiral s
};

/// The axis with these functions, by small steps along the curve.
MedialAxis made(const Made& m, double sign = 1) {
  constexpr int count = 400;
  const double step = 2.0 / count;
  Vec2 at{0, 0};
  MedialAxis axis = sampled(
      [&](double s) {
        // The direction is the integral of the curvature; the midpoint rule over the last step.
        const double middle = s - 0.5 * step;
        const double angle = sign * (m.turn * middle + m.spiral * middle * middle / 2);
        if (s > 0) at = at + step * Vec2{std::cos(angle), std::sin(angle)};
        return Disk{at, 3 + m.slope * s + m.bend * s * s / 2};
      },
      0, 2, count);
  return axis;
}

TEST(Primitives, EachByItsFunctions) {
  // describe() walks from the deeper end: `made` closes, so its order is kept.
  const std::array<std::pair<Made, Primitive>, 4> closing{{
      {{0, 0, 0, 0}, Primitive::worm},
      {{-0.5, 0, 0, 0}, Primitive::closing_wedge},
      {{-0.1, -0.2, 0, 0}, Primitive::closing_cup},
      {{-0.6, 0.2, 0, 0}, Primitive::closing_flare},
  }};
  for (const auto& [functions, primitive] : closing) {
    const AxisFeatures features = describe(made(functions));
    ASSERT_EQ(features.runs.size(), 1U);
    EXPECT_EQ(features.runs[0].primitive, primitive) << name_of(features.runs[0].primitive);
    EXPECT_EQ(features.runs[0].variation, Variation::straight);
    EXPECT_NEAR(features.runs[0].slope, functions.slope + functions.bend, 0.01);
    EXPECT_NEAR(features.runs[0].bend, 2 * functions.bend, 0.01);
  }
  // Opening ones follow a neck: the branch starts with the deeper half.
  const std::array<std::pair<double, std::pair<Primitive, Primitive>>, 2> necks{{
      {0.0, {Primitive::closing_wedge, Primitive::opening_wedge}},
      {0.3, {Primitive::closing_flare, Primitive::opening_flare}},
  }};
  for (const auto& [bend, pair] : necks) {
    const double b = bend;
    const MedialAxis axis = sampled(
        [b](double s) {
          const double x = std::abs(s);
          return Disk{{s, 0}, 3 + 0.3 * x + b * x * x / 2 + (s < 0 ? 0.1 * x : 0)};
        },
        -2, 2, 800);
    const AxisFeatures features = describe(axis);
    ASSERT_EQ(features.runs.size(), 2U);
    EXPECT_EQ(features.runs[0].primitive, pair.first);
    EXPECT_EQ(features.runs[1].primitive, pair.second);
    EXPECT_NEAR(features.runs[0].to.disk.center.x, 0, 0.1);
  }
  const AxisFeatures lens = describe(sampled(
      [](double s) {
        return Disk{{s, 0}, 3 - 0.3 * s * s / 2 + 0.001 * s};
      },
      -2, 1.5, 700));
  ASSERT_EQ(lens.runs.size(), 2U);
  EXPECT_EQ(lens.runs[0].primitive, Primitive::opening_cup);
  EXPECT_EQ(lens.runs[1].primitive, Primitive::closing_cup);
}

TEST(Variations, EachByItsFunctions) {
  const std::array<std::pair<Made, std::pair<Variation, Variation>>, 4> cases{{
      {{-0.5, 0, 0, 0}, {Variation::straight, Variation::straight}},
      {{-0.5, 0, 0.5, 0}, {Variation::left_circular, Variation::right_circular}},
      {{-0.5, 0, 0.1, 0.4}, {Variation::spiral_in_left, Variation::spiral_in_right}},
      {{-0.5, 0, 0.9, -0.4}, {Variation::spiral_out_left, Variation::spiral_out_right}},
  }};
  for (const auto& [functions, variations] : cases) {
    for (const bool left : {true, false}) {
      const AxisFeatures features = describe(made(functions, left ? 1 : -1));
      ASSERT_EQ(features.runs.size(), 1U);
      EXPECT_EQ(features.runs[0].primitive, Primitive::closing_wedge);
      EXPECT_EQ(features.runs[0].variation, left ? variations.first : variations.second)
          << name_of(features.runs[0].variation);
      EXPECT_NEAR(features.runs[0].turning,
                  (left ? 1 : -1) * (2 * functions.turn + 2 * functions.spiral), 0.01);
    }
  }
}

TEST(Variations, OfShapes) {
  // A quarter of a ring of constant width: circular; a wider one has the same turning.
  Ring bend;
  bend.points = {{5, 0}, {7, 0}, {0, 7}, {0, 5}};
  const double quarter = std::tan(pi / 8);
  bend.bulges = {0, quarter, 0, -quarter};
  const auto runs = main_runs(describe(axis_of({bend})));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].primitive, Primitive::worm);
  EXPECT_TRUE(runs[0].variation == Variation::left_circular ||
              runs[0].variation == Variation::right_circular);
}

TEST(Variations, OfASpiralIsOne) {
  // A band of half circles, each larger than the one before: as spirals are approximated by arcs.
  constexpr double half_width = 0.5;
  Ring band;
  std::vector<Vec2> outer, inner;
  double x = 4, radius = 4;
  for (int i = 0; i <= 8; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    outer.push_back({x + side * half_width, 0});
    inner.push_back({x - side * half_width, 0});
    x -= side * 2 * radius;
    radius += 0.6;
  }
  for (std::size_t i = 0; i < outer.size(); ++i) {
    band.points.push_back(outer[i]);
    band.bulges.push_back(i + 1 < outer.size() ? 1 : 0);
  }
  for (std::size_t i = inner.size(); i-- > 0;) {
    band.points.push_back(inner[i]);
    band.bulges.push_back(i > 0 ? -1 : 0);
  }
  const auto runs = main_runs(describe(axis_of({band})));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].primitive, Primitive::worm);
  EXPECT_TRUE(runs[0].variation == Variation::spiral_out_left ||
              runs[0].variation == Variation::spiral_out_right ||
              runs[0].variation == Variation::spiral_in_left ||
              runs[0].variation == Variation::spiral_in_right);
  EXPECT_NEAR(std::abs(runs[0].turning), 8 * pi, 0.3);
}

/// A shape whose axis is one branch of a given radius and curvature: the disks' envelope as cubics,
/// and around both ends.
struct Horn {
  double length;
  double (*radius)(double s);
  double (*curvature)(double share);  ///< by s / length

  Contour outline() const {
    constexpr int fine = 2400, pieces = 24;
    std::vector<Vec2> centers{{0, 0}};
    std::vector<double> angles{0};
    const double step = length / fine;
    for (int i = 0; i < fine; ++i) {
      const double angle = angles.back() + step * curvature((i + 0.5) / fine);
      const double middle = 0.5 * (angles.back() + angle);
      centers.push_back(centers.back() + step * Vec2{std::cos(middle), std::sin(middle)});
      angles.push_back(angle);
    }
    const auto slope = [&](int i) {
      constexpr double h = 1e-4;
      return (radius(i * step + h) - radius(i * step - h)) / (2 * h);
    };
    const auto side = [&](int i, double left) {
      const auto at = static_cast<std::size_t>(i);
      const Vec2 along{std::cos(angles[at]), std::sin(angles[at])};
      const double share = -slope(i);
      return centers[at] + radius(i * step) * (share * along + left * std::sqrt(1 - share * share) *
                                                                   left_of(along));
    };
    Contour contour;
    contour.start_at(side(0, -1));
    for (const int way : {1, -1}) {
      const auto at = [&](int i) { return side(way > 0 ? i : fine - i, -way); };
      if (way < 0) contour.arc_to(at(0), std::tan(std::acos(-slope(fine)) / 2));
      constexpr int size = fine / pieces;
      const auto tangent = [&](int i) {  // times a third of a piece
        const int a = std::max(i - 1, 0), b = std::min(i + 1, fine);
        return (size / 3.0 / (b - a)) * (at(b) - at(a));
      };
      for (int i = 0; i + size <= fine; i += size) {
        const Vec2 end = at(i + size);
        const std::array<Vec2, 3> control{at(i) + tangent(i), end - tangent(i + size), end};
        contour.bezier_to(control);
      }
    }
    contour.arc_to(contour.points[0], std::tan((pi - std::acos(-slope(0))) / 2));
    return contour;
  }
};

TEST(Variations, OfEachPrimitiveOnAShapeMadeForIt) {
  // An opening run follows a steep closing one: a branch begins at its deeper end.
  struct Radius {
    Primitive primitive;
    double length;
    double (*radius)(double);
  };
  const std::array<Radius, primitive_count> radii{{
      {Primitive::worm, 12, [](double s) { return 1.02 - 0.004 * s; }},
      {Primitive::opening_wedge, 12,
       [](double s) { return 0.6 + 0.1 * (s - 6) + (s < 6 ? 0.039 * (6 - s) * (6 - s) : 0); }},
      {Primitive::closing_wedge, 10, [](double s) { return 1.6 - 0.1 * s; }},
      {Primitive::opening_cup, 12,
       [](double s) {
         return s < 8 ? 1 + 0.16 * s - 0.01 * s * s : 1.64 - 0.05 * (s - 8) * (s - 8);
       }},
      {Primitive::closing_cup, 9, [](double s) { return 1.5 - 0.01 * s * s; }},
      {Primitive::opening_flare, 14,
       [](double s) { return 0.6 + (s < 5 ? 0.052 : 0.01) * (s - 5) * (s - 5); }},
      {Primitive::closing_flare, 9, [](double s) { return 2 - 0.3 * s + 0.015 * s * s; }},
  }};
  const std::array<std::pair<Variation, double (*)(double)>, variation_count> curvatures{{
      {Variation::straight, [](double) { return 0.0; }},
      {Variation::left_circular, [](double) { return 0.12; }},
      {Variation::right_circular, [](double) { return -0.12; }},
      {Variation::spiral_in_left, [](double t) { return 0.02 + 0.24 * t; }},
      {Variation::spiral_in_right, [](double t) { return -0.02 - 0.24 * t; }},
      {Variation::spiral_out_left, [](double t) { return 0.26 - 0.24 * t; }},
      {Variation::spiral_out_right, [](double t) { return -0.26 + 0.24 * t; }},
  }};
  for (const auto& [primitive, length, radius] : radii) {
    for (const auto& [variation, curvature] : curvatures) {
      SCOPED_TRACE(std::string(name_of(primitive)) + " " + name_of(variation));
      const Contour outline = Horn{length, radius, curvature}.outline();
      const auto rings = approximate_by_arcs(std::span(&outline, 1));
      ASSERT_TRUE(rings.ok()) << to_string(rings.error());
      // Where the ends' arcs meet the sides, rounding may make corners, which have branches.
      const MedialAxis axis = axis_of(*rings);
      const AxisFeatures features = describe(PruneOrder(axis, PruneMeasure::erosion).at(0.01));
      ASSERT_EQ(features.branches.size(), 1U);
      const auto runs = main_runs(features);
      const auto longest = std::ranges::max_element(runs, {}, &PrimitiveRun::length);
      EXPECT_EQ(longest->primitive, primitive) << name_of(longest->primitive);
      EXPECT_EQ(longest->variation, variation) << name_of(longest->variation);
      EXPECT_GT(longest->length, 0.4 * length);
    }
  }
}

/// Shares with left and right, opening and closing taken together.
using Folded = std::array<std::array<double, 4>, 4>;
Folded folded(const AxisFeatures& features) {
  Folded out{};
  for (std::size_t p = 0; p < primitive_count; ++p)
    for (std::size_t v = 0; v < variation_count; ++v) {
      // Seen backwards an opening spiral in is a closing spiral out: spirals are one class.
      const std::size_t bent = v == 3 ? 0 : v == 1 || v == 5 ? 1 : 2;
      out[(p + 1) / 2][bent] += features.share[p][v];
    }
  return out;
}

TEST(Features, OfRandomShapesAddUp) {
  for (std::uint64_t seed = 0; seed < feature_count; ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const auto shape = build_shape(random.rings);
    ASSERT_TRUE(shape.ok());
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis.ok());
    const AxisFeatures features = describe(*axis);
    const double size = diagonal(bounding_box(*shape));
    EXPECT_NEAR(features.area, area(*shape), 1e-9 * size * size);
    EXPECT_NEAR(features.length, total_length(*axis), 1e-9 * features.length);
    EXPECT_EQ(features.cycles, shape->hole_count());
    EXPECT_EQ(features.components, shape->component_count());
    EXPECT_EQ(features.branches.size(), branches(*axis).size());
    double share = 0, runs = 0;
    for (const auto& row : features.share)
      for (const double one : row) share += one;
    for (const PrimitiveRun& run : features.runs) runs += run.length;
    if (!features.runs.empty()) {
      EXPECT_NEAR(share, 1, 1e-9);
    }
    EXPECT_NEAR(runs, features.length, 1e-9 * features.length);
    for (const BranchFeatures& branch : features.branches) {
      EXPECT_LE(branch.smallest_radius, branch.largest_radius);
      EXPECT_GE(branch.significance, 0);
      EXPECT_GE(branch.absolute_turning + 1e-9, std::abs(branch.turning));
      EXPECT_EQ(std::isinf(branch.significance),
                std::isinf(branch.burn[0]) && std::isinf(branch.burn[1]));
    }
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Features, OfAnySizeAreTheSame) {
  const auto wave = [](double size) {  // straight and curved branches, in and out
    Rings rings{test::stadium({0, 0}, {5 * size, size}, size)};
    rings.push_back(test::ring_of({{9 * size, 0},
                                   {14 * size, 0},
                                   {14 * size, 3 * size},
                                   {11 * size, size},
                                   {9 * size, 4 * size}}));
    return describe(axis_of(rings));
  };
  const AxisFeatures one = wave(1);
  for (const double size : {1e-90, 1e-60, 1e60, 1e90}) {
    SCOPED_TRACE(size);
    const AxisFeatures other = wave(size);
    ASSERT_EQ(other.runs.size(), one.runs.size());
    for (std::size_t i = 0; i < one.runs.size(); ++i) {
      EXPECT_EQ(other.runs[i].primitive, one.runs[i].primitive);
      EXPECT_EQ(other.runs[i].variation, one.runs[i].variation);
      EXPECT_NEAR(other.runs[i].slope, one.runs[i].slope, 1e-9);
      EXPECT_NEAR(other.runs[i].mean_radius / size, one.runs[i].mean_radius, 1e-9);
    }
  }
}

TEST(Features, KeepUnderSymmetries) {
  std::size_t checked = 0;
  for (std::uint64_t seed = 0; seed < feature_count / 2; ++seed) {
    const RandomShape random = test::random_any(seed);
    if (!random.rigid) continue;
    const AxisFeatures before = describe(axis_of(random.rings));
    for (std::size_t i = 1; i < test::symmetries().size(); ++i) {
      // Far from the origin the shape is another one: its coordinates are rounded.
      const test::Symmetry& symmetry = test::symmetries()[i];
      if (norm(Vec2{symmetry.dx, symmetry.dy}) > 10 * symmetry.scale() * before.boundary) continue;
      SCOPED_TRACE(random.kind + " " + std::to_string(seed) + " " + test::symmetries()[i].name);
      const AxisFeatures after = describe(axis_of(test::symmetric(random.rings, i)));
      const double scale = test::symmetries()[i].scale();
      EXPECT_EQ(before.ends, after.ends);
      EXPECT_NEAR(after.length, scale * before.length, 1e-6 * scale * before.length);
      EXPECT_NEAR(after.boundary, scale * before.boundary, 1e-6 * scale * before.boundary);
      // The class of an edge hardly longer than rounding is rounding's, too.
      constexpr double short_edges = 1e-4;
      const Folded a = folded(before), b = folded(after);
      for (std::size_t p = 0; p < 4; ++p)
        for (std::size_t v = 0; v < 4; ++v) EXPECT_NEAR(a[p][v], b[p][v], short_edges);
      ++checked;
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(checked, 0U);
}

/// The grassfire, arrival after arrival: two fires that run towards each other meet.
std::vector<std::array<double, 2>> simulated_fire(const MedialAxis& axis,
                                                  const std::vector<ops::Fuse>& fuses) {
  std::vector<std::array<double, 2>> start(fuses.size(), {ops::not_burnt, ops::not_burnt});
  std::vector<std::vector<std::uint32_t>> unburnt(axis.nodes.size());
  for (std::uint32_t i = 0; i < 2 * fuses.size(); ++i)
    unburnt[fuses[i / 2].node[i % 2]].push_back(i);
  std::set<std::pair<double, std::uint32_t>> arrivals;
  const auto ignite = [&](std::uint32_t node, double time) {
    if (unburnt[node].size() != 1) return;
    const std::uint32_t end = unburnt[node][0];
    start[end / 2][end % 2] = time;
    arrivals.insert({time + fuses[end / 2].length, end ^ 1U});
  };
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node)
    ignite(node, axis.nodes[node].disk.radius);
  while (!arrivals.empty()) {
    const auto [time, end] = *arrivals.begin();
    arrivals.erase(arrivals.begin());
    if (start[end / 2][end % 2] < ops::not_burnt) continue;
    const std::uint32_t node = fuses[end / 2].node[end % 2];
    std::erase(unburnt[node], end);
    ignite(node, time);
  }
  return start;
}

TEST(Burn, IsWhatASimulationOfTheFireSays) {
  test::Random random(11);
  for (int round = 0; round < 3000; ++round) {
    MedialAxis axis;
    std::vector<ops::Fuse> fuses;
    const std::int64_t count = random.integer(1, 30);
    for (std::int64_t i = 0; i < count; ++i) {
      axis.nodes.emplace_back().disk.radius = static_cast<double>(random.integer(0, 9));
      // Trees, some with cycles or in parts; equal lengths in half of them.
      const auto other = [&] { return static_cast<std::uint32_t>(random.integer(0, i)); };
      const double length =
          round % 2 == 0 ? static_cast<double>(random.integer(1, 5)) : random.between(0.1, 5);
      if (i > 0 && !random.chance(0.05))
        fuses.push_back({{static_cast<std::uint32_t>(i), std::min(other(), other())}, length});
      if (random.chance(0.03)) fuses.push_back({{other(), other()}, length});
    }
    EXPECT_EQ(ops::burn(axis, fuses), simulated_fire(axis, fuses)) << round;
  }
}

}  // namespace
}  // namespace medial
