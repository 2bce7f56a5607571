// Contours, and free-form boundaries as spiral biarcs (src/curves, docs/curves.md).

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "curve/biarc.h"
#include "curve/spirals.h"
#include "medial/medial.h"
#include "support/contours.h"
#include "support/curve_check.h"
#include "support/curve_errors.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

using namespace curve;
using namespace test;
using std::numbers::pi;

Contour bezier(std::vector<Vec2> points, std::vector<double> weights = {}) {
  Contour contour;
  contour.start_at(points[0]);
  if (!weights.empty()) weights.erase(weights.begin());
  points.erase(points.begin());
  contour.bezier_to(points, weights);
  return contour;
}

/// A closed uniform B-spline with radii 1 + a sin(p angle) + b cos(q angle).
Contour closed_spline(std::uint32_t degree, int n, double a, int p, double b, int q) {
  std::vector<Vec2> control;
  for (int i = 0; i < n + static_cast<int>(degree); ++i) {
    const double angle = 2 * pi * (i % n) / n;
    const double r = 1 + a * std::sin(p * angle) + b * std::cos(q * angle);
    control.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  std::vector<double> knots(control.size() + degree + 1);
  for (std::size_t i = 0; i < knots.size(); ++i) knots[i] = static_cast<double>(i);
  Contour contour;
  EXPECT_TRUE(contour.spline_to(degree, knots, control));
  return contour;
}

/// Four cubics that join smoothly with jumps of curvature, like an outline of a font.
Contour letter() {
  Contour contour;
  contour.start_at({0, 0});
  contour.bezier_to(std::array<Vec2, 3>{{{0.6, 0}, {1, 0.3}, {1, 0.8}}});
  contour.bezier_to(std::array<Vec2, 3>{{{1, 1.4}, {0.7, 1.6}, {0.2, 1.6}}});
  contour.bezier_to(std::array<Vec2, 3>{{{-0.2, 1.6}, {-0.6, 1.2}, {-0.6, 0.9}}});
  contour.bezier_to(std::array<Vec2, 3>{{{-0.6, 0.5}, {-0.4, 0}, {0, 0}}});
  return contour;
}

/// Six smooth shapes with the interior on the left, and how many leaves each has.
struct NamedCurve {
  const char* name;
  Contour contour;
  int leaves;
};
std::vector<NamedCurve> six_shapes() {
  return {{"ellipse", ellipse(2, 1), 2},
          {"ellipse cut elsewhere", ellipse(1.3, 1, 0.4), 2},
          {"cubic spline", closed_spline(3, 60, 0.25, 5, 0, 1), 5},
          {"quintic spline", closed_spline(5, 40, 0.2, 3, 0.05, 7), 7},
          {"letter", letter(), -1},
          {"quadratic spline", closed_spline(2, 30, 0.1, 3, 0, 1), -1}};
}

Ring ring_of(const Contour& contour, double tolerance, ArcReport* report = nullptr) {
  ArcOptions options;
  options.tolerance = tolerance;
  options.threads = 1;
  auto rings = approximate_by_arcs({&contour, 1}, options, report);
  EXPECT_TRUE(rings) << to_string(rings.error());
  return rings ? rings->front() : Ring{};
}

Bezier curve_of(std::span<const Vec2> points, std::span<const double> weights = {}) {
  return make_bezier(points, weights);
}

// --- Contours

TEST(Contour, PiecesShareTheirEndPoints) {
  Contour contour;
  contour.start_at({0, 0});
  contour.line_to({1, 0});
  contour.arc_to({1, 1}, 1);
  contour.bezier_to(std::array<Vec2, 2>{{{0, 2}, {0, 1}}});
  ASSERT_EQ(contour.pieces.size(), 3u);
  EXPECT_EQ(contour.pieces[2].first, 2u);
  EXPECT_EQ(contour.pieces[2].degree, 2u);
  EXPECT_TRUE(contour.weights.empty());
  const Ring ring = ring_of(contour, 1e-6);
  EXPECT_EQ(ring.points[0], (Vec2{0, 0}));
  EXPECT_EQ(ring.points[1], (Vec2{1, 0}));
  EXPECT_EQ(ring.bulges[0], 0);
  EXPECT_EQ(ring.bulges[1], 1);
  EXPECT_EQ(ring.points[2], (Vec2{1, 1}));
  EXPECT_EQ(ring.bulges.back(), 0);  // closes the contour
  EXPECT_EQ(ring.points.back(), (Vec2{0, 1}));
}

TEST(Contour, WeightsAreScaledToThePieceBefore) {
  Contour contour;
  contour.start_at({0, 0});
  contour.line_to({1, 0});
  contour.bezier_to(std::array<Vec2, 2>{{{2, 0}, {2, 1}}}, std::array<double, 2>{0.5, 4});
  contour.bezier_to(std::array<Vec2, 2>{{{2, 2}, {0, 2}}}, std::array<double, 2>{0.5, 1});
  EXPECT_EQ(contour.weights, (std::vector<double>{1, 1, 0.5, 4, 2, 4}));
}

TEST(Contour, PointsOfEllipsesLieOnThem) {
  Contour contour;
  const Vec2 center{3, -2}, u{2, 1}, v{-0.5, 1.5};
  contour.ellipse_to(center, u, v, 0.3, -3.9);
  EXPECT_EQ(contour.pieces.size(), 3u);
  for (const CurvePiece& piece : contour.pieces) {
    for (int i = 0; i <= 20; ++i) {
      const Vec2 d = point_of(contour, piece, i / 20.0) - center;
      const double along_u = cross(d, v) / cross(u, v), along_v = cross(u, d) / cross(u, v);
      EXPECT_NEAR(along_u * along_u + along_v * along_v, 1, 1e-14);
    }
  }
  EXPECT_EQ(ellipse(2, 1).points.back(), ellipse(2, 1).points.front());
}

TEST(Contour, SplinesAreTheirBasisFunctionsSum) {
  // Cox and de Boor's definition of the basis, against the Bezier pieces.
  const std::vector<double> knots = {0, 0.5, 1, 1, 2.5, 3, 4, 4.5, 4.5, 4.5, 6, 7};
  const std::vector<Vec2> control = {{0, 0},  {1, 2},  {3, 2},  {4, -1},
                                     {2, -2}, {1, -1}, {0, -3}, {-1, 0}};
  const std::vector<double> weights = {1, 2, 0.5, 1, 1, 3, 1, 0.7};
  const std::uint32_t degree = 3;
  const auto basis = [&](auto&& self, std::size_t i, std::uint32_t p, double u) -> double {
    if (p == 0) return knots[i] <= u && u < knots[i + 1] ? 1 : 0;
    double value = 0;
    if (knots[i + p] > knots[i]) {
      value += (u - knots[i]) / (knots[i + p] - knots[i]) * self(self, i, p - 1, u);
    }
    if (knots[i + p + 1] > knots[i + 1]) {
      value +=
          (knots[i + p + 1] - u) / (knots[i + p + 1] - knots[i + 1]) * self(self, i + 1, p - 1, u);
    }
    return value;
  };
  for (const bool rational : {false, true}) {
    Contour contour;
    ASSERT_TRUE(contour.spline_to(degree, knots, control,
                                  rational ? std::span(weights) : std::span<const double>()));
    std::size_t piece = 0;
    for (std::size_t span = degree; span < control.size(); ++span) {
      if (knots[span] == knots[span + 1]) continue;
      ASSERT_LT(piece, contour.pieces.size());
      for (double t : {0.0, 0.25, 0.7}) {
        const double u = knots[span] + t * (knots[span + 1] - knots[span]);
        Vec2 sum{0, 0};
        double scale = 0;
        for (std::size_t i = 0; i < control.size(); ++i) {
          const double b = basis(basis, i, degree, u) * (rational ? weights[i] : 1);
          sum = sum + b * control[i];
          scale += b;
        }
        const Vec2 point = point_of(contour, contour.pieces[piece], t);
        EXPECT_NEAR(distance(point, (1 / scale) * sum), 0, 1e-13) << span << " " << t;
      }
      ++piece;
    }
    EXPECT_EQ(piece, contour.pieces.size());
  }
}

TEST(Contour, SplinesThatAreNoneAreRefused) {
  Contour contour;
  const std::vector<Vec2> control = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto code = [&](std::uint32_t degree, std::vector<double> knots,
                        std::vector<double> weights = {}) {
    const Status status = contour.spline_to(degree, knots, control, weights);
    return status ? ErrorCode::empty : status.error().code;
  };
  EXPECT_EQ(code(3, {0, 0, 0, 0, 1, 1, 1}), ErrorCode::malformed);
  EXPECT_EQ(code(0, {0, 1, 2, 3, 4}), ErrorCode::malformed);
  EXPECT_EQ(code(3, {0, 0, 0, 0, 0, 0, 0, 0}), ErrorCode::malformed);
  EXPECT_EQ(code(3, {0, 0, 0, 1, 0, 1, 1, 1}), ErrorCode::malformed);
  EXPECT_EQ(code(1, {0, 0, 1, 1, 2, 2}), ErrorCode::malformed);
  EXPECT_EQ(code(3, {0, 0, 0, 0, 1, 1, 1, NAN}), ErrorCode::malformed);
  EXPECT_EQ(code(3, {0, 0, 0, 0, 1, 1, 1, 1}, {1, 1, -1, 1}), ErrorCode::unsupported);
  EXPECT_EQ(code(3, {0, 0, 0, 0, 1, 1, 1, 1}, {1, 1}), ErrorCode::malformed);
  EXPECT_TRUE(contour.points.empty());
}

// --- Beziers and their splits

TEST(Bezier, RationalDerivativesAgreeWithDifferences) {
  const std::array<Vec2, 4> points = {{{0, 0}, {1, 2}, {3, 1}, {4, -1}}};
  const std::array<double, 4> weights = {1, 3, 0.5, 2};
  const Bezier curve = curve_of(points, weights);
  const double h = 1e-5;
  for (double t : {0.1, 0.5, 0.8}) {
    const Jet jet = evaluate(curve, t);
    const Vec2 low = evaluate(curve, t - h).point, high = evaluate(curve, t + h).point;
    EXPECT_NEAR(distance(jet.first, (0.5 / h) * (high - low)), 0, 1e-7);
    EXPECT_NEAR(distance(jet.second, (1 / (h * h)) * (high + low - 2 * jet.point)), 0, 1e-4);
    const double slope =
        (curvature(evaluate(curve, t + h)) - curvature(evaluate(curve, t - h))) / (2 * h);
    EXPECT_NEAR(curvature_derivative(curve, t), slope, 1e-7 * (1 + std::abs(slope)));
    Bezier before, after;
    split(curve, t, before, after);
    EXPECT_NEAR(distance(evaluate(after, 0.5).point, evaluate(curve, 0.5 * (1 + t)).point), 0,
                1e-14);
    EXPECT_NEAR(distance(evaluate(before, 0.5).point, evaluate(curve, 0.5 * t).point), 0, 1e-14);
  }
}

TEST(Bernstein, AllRootsAreFound) {
  // Products of linear factors: known roots, some close together.
  const std::vector<std::vector<double>> cases = {
      {0.5}, {0.1, 0.2, 0.3, 0.4, 0.9}, {0, 0.25, 1}, {0.5, 0.5001}, {1e-9, 0.7}, {0.3, 0.3, 0.3}};
  for (const std::vector<double>& expected : cases) {
    Polynomial p;
    p.c[0] = p.magnitude = 1;
    for (double root : expected) {
      const std::array<double, 2> factor = {-root, 1 - root};
      p = product(p, from_bernstein(factor.data(), 1));
    }
    const Roots found = roots(p);
    for (double root : expected) {
      double nearest = 1;
      for (int i = 0; i < found.count; ++i) {
        nearest = std::min(nearest, std::abs(found.t[i] - root));
      }
      EXPECT_LT(nearest, expected.size() == 3 && root == 0.3 ? 1e-4 : 1e-10) << root;
    }
    EXPECT_LE(found.count, static_cast<int>(expected.size()) + 2);
  }
}

TEST(Splits, ParabolaHasItsApexAtItsVertex) {
  const std::array<Vec2, 3> points = {{{-1, 1}, {0.25, -1.5}, {1.5, 2.25}}};  // y = x^2
  const Splits splits = find_splits(curve_of(points));
  ASSERT_EQ(splits.count, 1);
  EXPECT_EQ(splits.at[0].kind, Split::Kind::apex);
  EXPECT_NEAR(splits.at[0].t, 0.4, 1e-14);
}

TEST(Splits, EllipsesHaveTheirApicesAtTheAxes) {
  for (double start : {0.4, 1.0, 2.5}) {
    const Contour contour = ellipse(2, 1, start);
    int apices = 0;
    for (const CurvePiece& piece : contour.pieces) {
      const std::span points = std::span(contour.points).subspan(piece.first, 3);
      const std::span weights = std::span(contour.weights).subspan(piece.first, 3);
      const Bezier curve = curve_of(points, weights);
      const Splits splits = find_splits(curve);
      for (int i = 0; i < splits.count; ++i) {
        const Vec2 p = evaluate(curve, splits.at[i].t).point;
        EXPECT_LT(std::min(std::abs(p.x), std::abs(p.y)), 1e-13);
        ++apices;
      }
    }
    EXPECT_EQ(apices, 4) << start;
  }
}

/// Where curvature turns round at 20,000 parameters, by brute force.
std::vector<double> sampled_apices(const Bezier& curve) {
  std::vector<double> apices;
  constexpr int n = 20000;
  double before = curvature_derivative(curve, 0.5 / n);
  for (int i = 1; i < n; ++i) {
    const double t = (i + 0.5) / n, now = curvature_derivative(curve, t);
    if ((before > 0) != (now > 0)) apices.push_back(t - 0.5 / n);
    before = now;
  }
  return apices;
}

TEST(Splits, CubicsWithManyApices) {
  // Three with five apices each, the most a cubic can have, and others.
  const std::array<std::array<Vec2, 4>, 3> five = {
      {{{{-0.273, 0.115}, {0.167, -0.278}, {-0.509, 0.551}, {-0.821, -0.781}}},
       {{{-0.397, 0.030}, {-0.917, -0.346}, {0.737, 0.944}, {0.005, -0.753}}},
       {{{-0.078, 0.627}, {-0.960, 0.638}, {-0.336, -0.743}, {-0.749, 0.660}}}}};
  int most = 0;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (std::size_t round = 0; round < 40; ++round) {
    std::array<Vec2, 4> points;
    for (Vec2& p : points) p = {any(random), any(random)};
    if (round < five.size()) points = five[round];
    const Bezier curve = curve_of(points);
    const Splits splits = find_splits(curve);
    const std::vector<double> expected = sampled_apices(curve);
    int apices = 0;
    for (int i = 0; i < splits.count; ++i) apices += splits.at[i].kind == Split::Kind::apex;
    most = std::max(most, apices);
    EXPECT_EQ(apices, static_cast<int>(expected.size())) << round;
    for (double t : expected) {
      double nearest = 1;
      for (int i = 0; i < splits.count; ++i)
        nearest = std::min(nearest, std::abs(splits.at[i].t - t));
      EXPECT_LT(nearest, 1e-4) << round;
    }
    EXPECT_LE(apices, 5);
  }
  EXPECT_EQ(most, 5);
}

TEST(Splits, InflectionsAndCusps) {
  const Splits s = find_splits(curve_of(std::array<Vec2, 4>{{{0, 0}, {1, 1}, {2, -1}, {3, 0}}}));
  int inflections = 0;
  for (int i = 0; i < s.count; ++i) {
    if (s.at[i].kind == Split::Kind::inflection) {
      EXPECT_NEAR(s.at[i].t, 0.5, 1e-14);
      ++inflections;
    }
  }
  EXPECT_EQ(inflections, 1);
  const Splits c = find_splits(curve_of(std::array<Vec2, 4>{{{0, 0}, {1, 1}, {0, 1}, {1, 0}}}));
  ASSERT_EQ(c.count, 1);
  EXPECT_EQ(c.at[0].kind, Split::Kind::cusp);
  EXPECT_NEAR(c.at[0].t, 0.5, 1e-12);
  // A cusp at a parameter that is no double: (t - 1/3)^2 (a + b t).
  const double r = 1.0 / 3;
  std::vector<Vec2> points;
  for (int i = 0; i < 4; ++i) {
    // Bernstein coefficients of (t - r)^2 and of (t - r)^3.
    const double square[4] = {r * r, r * r - 2 * r / 3, r * r - 4 * r / 3 + 1.0 / 3,
                              (1 - r) * (1 - r)};
    const double cube[4] = {-r * r * r, r * r * (1 - r), -r * (1 - r) * (1 - r),
                            (1 - r) * (1 - r) * (1 - r)};
    points.push_back({square[i], cube[i]});
  }
  const Splits third = find_splits(curve_of(points));
  ASSERT_GE(third.count, 1);
  EXPECT_TRUE(std::any_of(third.at.begin(), third.at.begin() + third.count, [&](const Split& at) {
    return at.kind == Split::Kind::cusp && std::abs(at.t - r) < 1e-10;
  }));
}

// --- Biarcs

TEST(Biarc, TheThreeErrorsAgree) {
  const std::array<Vec2, 3> points = {{{0, 0}, {0.3, 0}, {0.5, 0.1}}};
  const Bezier curve = curve_of(points);
  ASSERT_EQ(find_splits(curve).count, 0);
  const Station a = station_at(curve, 0, curve::Side::after),
                b = station_at(curve, 1, curve::Side::before);
  const Biarc biarc = make_biarc(a, spiral_joint(a, b), b);
  const double high = std::max(std::abs(a.curvature), std::abs(b.curvature));
  const double low = std::min(std::abs(a.curvature), std::abs(b.curvature));
  const double first = std::abs(curvature(biarc.first)), second = std::abs(curvature(biarc.second));
  EXPECT_NEAR(std::max(first, second), high, 1e-13 * high);
  EXPECT_GT(std::min(first, second), low);
  EXPECT_LT(std::min(first, second), high);
  EXPECT_NEAR(cross(tangent_at_end(biarc.first), tangent_at_begin(biarc.second)), 0, 1e-15);
  EXPECT_NEAR(cross(tangent_at_begin(biarc.first), a.tangent), 0, 1e-15);
  EXPECT_NEAR(cross(tangent_at_end(biarc.second), b.tangent), 0, 1e-15);
  const double sampled = sampled_error(curve, biarc, 50), exact = extremal_error(curve, biarc);
  const double certified = certified_error(curve, biarc, 1e-15);
  EXPECT_GT(sampled, 0);
  EXPECT_LE(sampled, exact * (1 + 1e-9));
  EXPECT_LE(exact, certified * (1 + 1e-9));
  EXPECT_NEAR(sampled, exact, 0.01 * exact);
  // The coefficients of a cubic that falls to a double zero are a sixth too large, more where the
  // curve turns much.
  EXPECT_LE(certified, 1.5 * exact);
}

TEST(Biarc, JointsSettleOnTheJointCircle) {
  // Arcs of a thousandth: a rounded joint leaves angles of 1e-13, a settled one does not.
  const std::array<Vec2, 3> points = {{{0.7, 0.4}, {1.0, 0.4}, {1.2, 0.5}}};
  const Bezier curve = curve_of(points);
  PieceCoordinates frame;
  double rounded = 0, settled = 0;
  for (int i = 0; i < 1000; ++i) {
    Station a = station_at(curve, i / 1000.0, curve::Side::after);
    Station b = station_at(curve, (i + 1) / 1000.0, curve::Side::before);
    const Vec2 joint = frame.snap(spiral_joint(a, b));
    const auto angle_at = [&](Vec2 p) {
      const Biarc biarc = make_biarc(a, p, b);
      return std::abs(cross(tangent_at_end(biarc.first), tangent_at_begin(biarc.second)));
    };
    const Vec2 moved = settle_joint(joint_circle(a, b), joint, frame.spacing(joint), 1e-9);
    EXPECT_EQ(frame.snap(moved), moved);
    EXPECT_LE(distance(moved, joint), 2e-9);
    rounded = std::max(rounded, angle_at(joint));
    settled = std::max(settled, angle_at(moved));
  }
  EXPECT_GT(rounded, 1e-13);
  // Half a chord from both ends, what a joint is off turns the tangents by eight times that over
  // the chord; off() is known to two roundings of the chord.
  EXPECT_LT(settled, 16 * std::numeric_limits<double>::epsilon());
}

TEST(Biarc, NoBoundWhereTheCurveLeavesTheSector) {
  const std::array<Vec2, 4> loop = {{{0, 0}, {3, 2}, {-2, 2}, {1, 0}}};
  const Bezier curve = curve_of(loop);
  const Station a = station_at(curve, 0, curve::Side::after),
                b = station_at(curve, 1, curve::Side::before);
  const Biarc biarc = make_biarc(a, spiral_joint(a, b), b);
  EXPECT_TRUE(std::isinf(certified_error(curve, biarc, 1e-15)));
}

// --- Approximation

TEST(Arcs, ToleranceHoldsAndLeavesStay) {
  for (const NamedCurve& shape : six_shapes()) {
    int leaves = shape.leaves;
    for (double tolerance = 1e-2; tolerance > (sanitized ? 0.5e-6 : 0.5e-9); tolerance /= 10) {
      ArcReport report;
      const Ring ring = ring_of(shape.contour, tolerance, &report);
      EXPECT_EQ(report.arcs + report.segments, ring.points.size());
      EXPECT_LE(report.largest_error, report.tolerance * (1 + 1e-5)) << shape.name;
      const auto samples =
          static_cast<int>(shape_count(shape.contour.pieces.size() > 10 ? 1000 : 100, 10));
      const double measured = measured_distance(shape.contour, ring, samples);
      EXPECT_LE(measured, report.largest_error + 1e-15) << shape.name << " " << tolerance;
      EXPECT_GT(measured, 0.3 * report.largest_error - 1e-15) << shape.name << " " << tolerance;
      if (leaves < 0) leaves = locally_most_curved(ring);
      EXPECT_EQ(locally_most_curved(ring), leaves) << shape.name << " " << tolerance;
      // Neighbouring arcs have one tangent, however short they are.
      EXPECT_LT(largest_turn(ring), 1e-13) << shape.name << " " << tolerance;
    }
  }
}

/// The largest distance of points of one axis to another one, as a part of 4 error / (1 - cos(angle
/// / 2)) with the angle at which the disk touches both sides: what [aichholzer2009] prove for what
/// is away from leaves, where the disk stays the larger part of itself.
double largest_move(const MedialAxis& from, const MedialAxis& to, double error, int& points) {
  const AxisLocator locator(to);
  double largest = 0;
  for (const medial::Edge& edge : from.edges) {
    for (const double t : {0.0, 0.3, 0.6, 0.9}) {
      const Disk disk = disk_at(from, edge, t);
      const Vec2 a = foot(from.sites[edge.site[0]], disk.center) - disk.center;
      const Vec2 b = foot(from.sites[edge.site[1]], disk.center) - disk.center;
      const double half = 0.5 * std::atan2(std::abs(cross(a, b)), dot(a, b));
      const double bound = 4 * error / (1 - std::cos(half));
      if (!(bound < 0.1 * disk.radius)) continue;
      ++points;
      largest = std::max(largest, locator.nearest(disk.center).distance / bound);
    }
  }
  return largest;
}

TEST(Arcs, AwayFromLeavesTheAxisMovesAsLittleAsProved) {
  for (const NamedCurve& shape : six_shapes()) {
    const auto axis_at = [&](double tolerance, double& error) {
      ArcReport report;
      const auto built = build_shape(std::vector<Ring>{ring_of(shape.contour, tolerance, &report)});
      EXPECT_TRUE(built.ok());
      error += report.largest_error;
      return *compute(*built, {.threads = 1});
    };
    double fine_error = 0;
    const MedialAxis fine = axis_at(1e-9, fine_error);
    for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
      double error = fine_error;
      const MedialAxis coarse = axis_at(tolerance, error);
      int points = 0;
      EXPECT_LT(largest_move(coarse, fine, error, points), 1) << shape.name << " " << tolerance;
      EXPECT_LT(largest_move(fine, coarse, error, points), 1) << shape.name << " " << tolerance;
      EXPECT_GT(points, 1000) << shape.name;
    }
  }
}

TEST(Arcs, ErrorFallsWithTheThirdPowerOfTheirNumber) {
  for (const NamedCurve& shape : six_shapes()) {
    // Least squares of log(error) against log(arcs), from twice the arcs of 1e-5 on: a spiral that
    // is not divided has its biarc whatever the tolerance.
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    std::uint64_t undivided = 0;
    for (double tolerance = 1e-5; tolerance > 0.9e-11; tolerance /= std::sqrt(10)) {
      ArcReport report;
      ring_of(shape.contour, tolerance, &report);
      if (undivided == 0) undivided = report.arcs;
      if (report.arcs < 2 * undivided) continue;
      const double x = std::log(static_cast<double>(report.arcs));
      const double y = std::log(report.largest_error);
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    EXPECT_GE(n, 8) << shape.name;
    const double exponent = (n * sxy - sx * sy) / (n * sxx - sx * sx);
    EXPECT_GT(exponent, -3.3) << shape.name;
    EXPECT_LT(exponent, -2.7) << shape.name;
  }
}

TEST(Arcs, CurvatureIsMonotoneAlongSpirals) {
  // Between apices, inflections and joints, the amount of curvature goes one way only.
  const std::array<Vec2, 4> points = {{{0, 0}, {1, 1.3}, {2, -1.4}, {3, 0.2}}};
  const Bezier curve = curve_of(points);
  const Splits splits = find_splits(curve);
  ASSERT_GE(splits.count, 3);
  Contour contour = bezier({points.begin(), points.end()});
  for (double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const Ring ring = ring_of(contour, tolerance);
    int turns = 0, sign_changes = 0;
    double before = 0, direction = 0;
    for (std::size_t i = 0; i + 1 < ring.points.size(); ++i) {
      const double k = ArcEdge{ring.points[i], ring.points[i + 1], ring.bulges[i]}.curvature();
      if (i > 0) {
        sign_changes += (k > 0) != (before > 0);
        const double step = k - before;
        if (direction != 0 && (step > 0) != (direction > 0)) ++turns;
        direction = step;
      }
      before = k;
    }
    int apices = 0, inflections = 0;
    for (int i = 0; i < splits.count; ++i) {
      (splits.at[i].kind == Split::Kind::apex ? apices : inflections) += 1;
    }
    EXPECT_EQ(sign_changes, inflections) << tolerance;
    EXPECT_EQ(turns, apices) << tolerance;
  }
}

TEST(Arcs, AnApexOfLargestCurvatureIsOneArc) {
  const Contour contour = ellipse(2, 1, 0.4);  // its apices are inside its pieces
  const Ring ring = ring_of(contour, 1e-6);
  int at_apex = 0;
  for (const ArcEdge& edge : edges_of(ring)) {
    if (std::abs(edge.curvature() - 2) < 1e-9) {
      ++at_apex;
      EXPECT_NEAR(edge.distance_to({std::copysign(2, edge.begin.x), 0}), 0, 1e-15);
    }
  }
  EXPECT_EQ(at_apex, 2);
}

TEST(Arcs, CurvatureThatJumpsUpIsALeafAtEveryTolerance) {
  // Two quadratics: curvature falls towards (1, 0) and starts a little higher beyond, falling.
  for (double step : {1.5, 1.1, 1.01}) {
    Contour contour;
    contour.start_at({0, 0.3});
    contour.bezier_to(std::array<Vec2, 2>{{{0.2, 0}, {1, 0}}});
    const double k = 0.5 * std::abs(cross(Vec2{0.8, 0}, Vec2{0.2, -0.3})) / (0.8 * 0.8 * 0.8);
    // The second begins with curvature k * step: 0.5 * h / length^2.
    const double length = 0.4, h = 2 * k * step * length * length;
    contour.bezier_to(std::array<Vec2, 2>{{{1 + length, 0}, {1 + length + 0.5, h}}});
    contour.line_to({1, 3});
    const int expected = locally_most_curved(ring_of(contour, 1e-10));
    for (double tolerance = 1e-2; tolerance > 0.5e-9; tolerance /= 10) {
      EXPECT_EQ(locally_most_curved(ring_of(contour, tolerance)), expected)
          << step << " " << tolerance;
    }
  }
}

/// Quadratics like those of a TrueType font, flattest where they join. The right half may be a
/// little wider: curvature then jumps by 6 % at the top and the bottom.
TEST(Arcs, SmallJumpsTakeNoFurtherArcs) {
  const auto arcs_of = [](double width) {
    const auto at = [&](Vec2 p, int quarter) {
      for (int i = 0; i < quarter; ++i) p = left_of(p);
      return Vec2{p.x > 0 ? width * p.x : p.x, p.y};
    };
    Contour contour;
    contour.start_at(at({700, 0}, 0));
    for (int k = 0; k < 4; ++k) {
      contour.bezier_to(std::array{at({700, 290}, k), at({495, 495}, k)});
      contour.bezier_to(std::array{at({290, 700}, k), at({0, 700}, k)});
    }
    return ring_of(contour, 1e-4).points.size();
  };
  EXPECT_EQ(arcs_of(1), 40U);  // 5 each
  EXPECT_LE(arcs_of(1.02), 40U);
}

TEST(Arcs, CirclesAreExact) {
  const Ring circle = ring_of(ellipse(1, 1), 1e-3);
  ASSERT_EQ(circle.points.size(), 4u);
  for (const ArcEdge& edge : edges_of(circle)) {
    EXPECT_NEAR(edge.bulge, std::tan(pi / 8), 1e-15);
    EXPECT_NEAR(norm(edge.begin), 1, 1e-16);
  }
  // The circle as one NURBS of degree 2 with nine control points.
  const double s = std::sqrt(0.5);
  Contour contour;
  ASSERT_TRUE(contour.spline_to(
      2, std::vector<double>{0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
      std::vector<Vec2>{{7, 5}, {7, 7}, {5, 7}, {3, 7}, {3, 5}, {3, 3}, {5, 3}, {7, 3}, {7, 5}},
      std::vector<double>{1, s, 1, s, 1, s, 1, s, 1}));
  const Ring nurbs = ring_of(contour, 1e-3);
  ASSERT_EQ(nurbs.points.size(), 4u);
  for (const ArcEdge& edge : edges_of(nurbs)) EXPECT_NEAR(edge.curvature(), 0.5, 1e-15);
}

TEST(Arcs, RationalCurvesMeetTheTolerance) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < (sanitized ? 5 : 20); ++round) {
    std::vector<Vec2> points;
    std::vector<double> weights;
    const int degree = 2 + round % 5;
    for (int i = 0; i <= degree; ++i) {
      points.push_back({any(random), any(random)});
      weights.push_back(std::exp(any(random)));
    }
    points.back() = points.front();
    const Contour contour = bezier(points, round % 2 == 0 ? weights : std::vector<double>());
    for (double tolerance : {1e-2, 1e-5, 1e-8}) {
      ArcReport report;
      const Ring ring = ring_of(contour, tolerance, &report);
      EXPECT_LE(report.largest_error, report.tolerance * (1 + 1e-6));
      EXPECT_LE(measured_distance(contour, ring, 200), report.largest_error + 1e-15)
          << round << " " << tolerance;
    }
  }
}

TEST(Arcs, StraightCurvesStaySegments) {
  Contour contour = bezier({{0, 0}, {0, 0}, {3, 3}, {3, 3}});
  contour.line_to({3, 0});
  contour.line_to({3, 0});
  contour.bezier_to(std::array<Vec2, 3>{{{3, 0}, {3, 0}, {3, 0}}});
  ArcReport report;
  const Ring ring = ring_of(contour, 1e-6, &report);
  EXPECT_EQ(ring.points, (std::vector<Vec2>{{0, 0}, {3, 3}, {3, 0}}));
  EXPECT_EQ(report.segments, 3u);
  EXPECT_EQ(report.largest_error, 0);
  // A curve on a line that overshoots its end turns back there.
  Contour beyond = bezier({{0, 0}, {4, 0}, {1, 0}});
  beyond.line_to({0, 1});
  const Ring turned = ring_of(beyond, 1e-6);
  ASSERT_EQ(turned.points.size(), 4u);
  EXPECT_NEAR(turned.points[1].x, 16.0 / 7, 1e-14);
}

TEST(Arcs, NearlyEverythingIsConverted) {
  const double huge = 1e300, tiny = 1e-300;
  const std::vector<std::vector<Vec2>> cases = {
      {{0, 0}, {1, 1}, {0, 1}, {1, 0}},                  // cusp
      {{0, 0}, {0, 0}, {1, 1}, {1, 0}},                  // no first derivative
      {{0, 0}, {0, 0}, {0, 0}, {1, 0}, {1, 1}},          // nor second
      {{0, 0}, {1, 0}, {1, 0}, {0, 1}},                  // repeated in the middle
      {{0, 0}, {1, 0}, {0, 1}, {0, 0}},                  // closed
      {{0, 0}, {1, 1}, {-1e-9, 1}, {1, 0}},              // nearly a cusp
      {{0, 0}, {1, 1}, {1e-5, 1}, {1, 0}},               // a tiny loop or a sharp bend
      {{0, 0}, {1, 1e-14}, {2, 1e-13}, {3, 0}},          // nearly straight
      {{0, 0}, {1, 1e-17}, {2, 0}},                      // straight up to rounding
      {{1e8, 1e8}, {1e8 + 1, 1e8}, {1e8 + 1, 1e8 + 1}},  // far away
      {{0, 0}, {huge, 0}, {huge, huge}},
      {{-1e308, 0}, {1e308, 0}, {1e308, 1e308}},
      {{0, 0}, {tiny, 0}, {tiny, tiny}},
      {{0, 0}, {5e-324, 0}, {5e-324, 5e-324}},
      {{0, 0}, {1e-8, 1}, {1, 1e-8}, {1, 1}},
      {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 1}},  // flat at one end
      {{0, 0}, {2, 1}, {-1, 1}, {1, 0}, {2, 2}, {-1, 2}, {0, 0}, {1, 1}}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (double tolerance : {1e-2, 1e-6, 1e-9}) {
      const Contour contour = bezier(cases[i]);
      ArcOptions options;
      options.tolerance = tolerance;
      ArcReport report;
      const auto rings = approximate_by_arcs({&contour, 1}, options, &report);
      ASSERT_TRUE(rings) << i << to_string(rings.error());
      const Ring& ring = rings->front();
      EXPECT_LT(ring.points.size(), 20000u) << i << " " << tolerance;
      EXPECT_EQ(ring.points.front(), cases[i].front());
      for (const Vec2& p : ring.points) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << i;
      for (double bulge : ring.bulges) EXPECT_LE(std::abs(bulge), 1 + 1e-9) << i;
      EXPECT_LE(report.largest_error, report.tolerance * (1 + 1e-5)) << i << " " << tolerance;
    }
  }
}

TEST(Arcs, NoToleranceIsBelowRounding) {
  const Contour contour = closed_spline(3, 12, 0.2, 3, 0, 1);
  ArcReport report;
  const Ring ring = ring_of(contour, 1e-30, &report);
  EXPECT_LT(ring.points.size(), 2000000u);
  EXPECT_LT(report.largest_error, 1e-14);
}

TEST(Arcs, WrongInputIsAnError) {
  const auto code = [](const Contour& contour, ArcOptions options = {}) {
    const auto rings = approximate_by_arcs({&contour, 1}, options);
    return rings ? ErrorCode::empty : rings.error().code;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(bezier({{0, 0}, {nan, 1}, {1, 0}})), ErrorCode::not_finite);
  EXPECT_EQ(code(bezier({{0, 0}, {1, INFINITY}, {1, 0}})), ErrorCode::not_finite);
  EXPECT_EQ(code(bezier({{0, 0}, {0, 1}, {1, 0}}, {1, -1, 1})), ErrorCode::unsupported);
  EXPECT_EQ(code(bezier({{0, 0}, {0, 1}, {1, 0}}, {1, 0, 1})), ErrorCode::unsupported);
  EXPECT_EQ(code(bezier({{0, 0}, {0, 1}, {1, 0}}, {1, nan, 1})), ErrorCode::not_finite);
  EXPECT_EQ(code(bezier({{2, 3}, {2, 3}, {2, 3}})), ErrorCode::no_area);
  EXPECT_EQ(code(Contour{}), ErrorCode::no_area);
  EXPECT_EQ(code(bezier(std::vector<Vec2>(40, Vec2{1, 2}))), ErrorCode::unsupported);
  Contour bulged;
  bulged.start_at({0, 0});
  bulged.arc_to({1, 0}, nan);
  EXPECT_EQ(code(bulged), ErrorCode::not_finite);
  Contour torn = bezier({{0, 0}, {0, 1}, {1, 0}});
  torn.pieces[0].first = 1;
  EXPECT_EQ(code(torn), ErrorCode::malformed);
  torn.pieces[0] = {0, 7, 0};
  EXPECT_EQ(code(torn), ErrorCode::malformed);
  torn.pieces[0] = {0, 1, 0};
  EXPECT_EQ(code(torn), ErrorCode::malformed);
  for (double tolerance : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    ArcOptions options;
    options.tolerance = tolerance;
    EXPECT_EQ(code(ellipse(2, 1), options), ErrorCode::invalid_option);
  }
}

TEST(Arcs, ThreadsChangeNothing) {
  const std::vector<Contour> contours = {closed_spline(3, 700, 0.2, 9, 0.1, 31), ellipse(3, 1),
                                         letter()};
  ArcOptions options;
  options.tolerance = 1e-7;
  options.threads = 1;
  const auto one = approximate_by_arcs(contours, options);
  ASSERT_TRUE(one);
  for (int threads : {0, 2, 8}) {
    options.threads = threads;
    const auto many = approximate_by_arcs(contours, options);
    ASSERT_TRUE(many);
    for (std::size_t i = 0; i < contours.size(); ++i) {
      EXPECT_EQ((*one)[i].points, (*many)[i].points);
      EXPECT_EQ((*one)[i].bulges, (*many)[i].bulges);
    }
  }
}

TEST(Arcs, MovingAndScalingChangesRoundingOnly) {
  const Contour contour = letter();
  const Ring ring = ring_of(contour, 1e-5);
  for (double scale : {0x1p-40, 0x1p30}) {
    Contour scaled = contour;
    for (Vec2& p : scaled.points) p = scale * p;
    const Ring other = ring_of(scaled, 1e-5);
    ASSERT_EQ(other.points.size(), ring.points.size());
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      EXPECT_LE(distance(other.points[i], scale * ring.points[i]), 1e-12 * scale);
    }
  }
  Contour reversed;
  reversed.start_at(contour.points.back());
  for (std::size_t i = contour.pieces.size(); i-- > 0;) {
    const std::size_t at = contour.pieces[i].first;
    reversed.bezier_to(
        std::vector<Vec2>{contour.points[at + 2], contour.points[at + 1], contour.points[at]});
  }
  const Ring back = ring_of(reversed, 1e-5);
  EXPECT_EQ(back.points.size(), ring.points.size());
}

}  // namespace
}  // namespace medial
