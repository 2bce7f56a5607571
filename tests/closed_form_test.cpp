// Shapes whose medial axis is known in closed form: every node's position, radius and degree, the
// length of the axis and the largest disk, to 1e-12 of the diagonal, again under every symmetry.
//
// Where a disk rolls around a reflex vertex opposite to an edge, its centre runs on a parabola; in
// coordinates (u, v) along and across the edge, v = p/2 + u^2 / (2 p), p their distance.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "axis/steps.h"
#include "medial/measure.h"
#include "medial/medial.h"
#include "support/generate.h"

namespace medial::test {
namespace {

const double root2 = std::sqrt(2.0);
const double root5 = std::sqrt(5.0);
const double root6 = std::sqrt(6.0);

/// Length of the parabola with distance p between focus and directrix, from its apex to u.
double parabola_length(double p, double u) {
  const double s = u / p;
  return p / 2 * (s * std::sqrt(1 + s * s) + std::asinh(s));
}

struct ExpectedNode {
  Vec2 center;
  double radius;
  std::size_t degree;
};

struct Case {
  std::string name;
  Rings rings;
  std::vector<ExpectedNode> nodes;
  double length = 0;
  /// A vertex lies in the inside of an edge: a rounded rotation about another point would end that.
  bool contact_in_edge = false;
};

double spacing_at(double x) { return std::nextafter(std::abs(x), INFINITY) - std::abs(x); }

void check(const Case& expected, const Symmetry& symmetry) {
  SCOPED_TRACE(expected.name + ", " + symmetry.name);
  const Rings rings = transformed(expected.rings, symmetry);
  const auto shape = build_shape(rings);
  ASSERT_TRUE(shape) << to_string(shape.error());
  // Far from the origin neither the input nor the result can be finer than the doubles there.
  const Box box = bounding_box(*shape);
  const double far = std::max(
      {std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  Options options;
  options.threads = 1;
  const auto axis = compute(*shape, options);
  ASSERT_TRUE(axis) << to_string(axis.error());

  const double tolerance = 1e-12 * diagonal(box) + 4 * spacing_at(far);
  const double scale = symmetry.scale();

  const Incidence incidence(*axis);
  std::vector<bool> used(axis->nodes.size(), false);
  double deepest = 0;
  for (const ExpectedNode& node : expected.nodes) {
    const Vec2 center = symmetry(node.center);
    const double radius = scale * node.radius;
    deepest = std::max(deepest, radius);
    bool found = false;
    for (std::uint32_t i = 0; i < axis->nodes.size() && !found; ++i) {
      const Disk& disk = axis->nodes[i].disk;
      found = !used[i] && incidence.degree(i) == node.degree &&
              distance(disk.center, center) <= tolerance &&
              std::abs(disk.radius - radius) <= tolerance;
      if (found) used[i] = true;
    }
    EXPECT_TRUE(found) << "no node of degree " << node.degree << ", radius " << radius << " at ("
                       << center.x << ", " << center.y << ")";
  }
  EXPECT_EQ(axis->nodes.size(), expected.nodes.size());
  for (std::uint32_t i = 0; i < axis->nodes.size(); ++i) {
    const std::size_t degree = incidence.degree(i);
    const NodeKind kind = degree == 1   ? NodeKind::leaf
                          : degree == 2 ? NodeKind::site_change
                                        : NodeKind::branching;
    EXPECT_EQ(axis->nodes[i].kind, kind) << "node " << i << " of degree " << degree;
  }
  const double edges = static_cast<double>(axis->edges.size());
  EXPECT_NEAR(total_length(*axis), scale * expected.length, (edges + 1) * tolerance);
  if (!axis->nodes.empty()) {
    EXPECT_NEAR(deepest_disk(*axis).radius, deepest, tolerance);
  }
}

void check_everywhere(const Case& expected) {
  for (const Symmetry& symmetry : symmetries()) {
    if (expected.contact_in_edge && !symmetry.exact && symmetry.dx != 0) continue;
    check(expected, symmetry);
  }
}

/// Adds a node and its images in the given mirror lines x = `x` and y = `y`.
void add_mirrored(std::vector<ExpectedNode>& nodes, const ExpectedNode& node, double x) {
  nodes.push_back(node);
  nodes.push_back({{2 * x - node.center.x, node.center.y}, node.radius, node.degree});
}
void add_mirrored(std::vector<ExpectedNode>& nodes, const ExpectedNode& node, double x, double y) {
  add_mirrored(nodes, node, x);
  add_mirrored(nodes, {{node.center.x, 2 * y - node.center.y}, node.radius, node.degree}, x);
}

/// Where corridors of width a meet at a right angle with the inner corner (a, a), the disk on the
/// diagonal that touches it has its centre at (t, t); from there to the corridors run parabolas.
double elbow(double a) { return a * (2 - root2); }
double elbow_arc(double a) { return parabola_length(a, a - elbow(a)); }

TEST(ClosedForm, Rectangle) {
  Case wide{"5 x 3", rectangle(5, 3), {}, 2 + 4 * 1.5 * root2};
  add_mirrored(wide.nodes, {{0, 0}, 0, 1}, 2.5, 1.5);
  add_mirrored(wide.nodes, {{1.5, 1.5}, 1.5, 3}, 2.5);
  check_everywhere(wide);

  Case thin{"1024 x 1", rectangle(1024, 1), {}, 1023 + 2 * root2};
  add_mirrored(thin.nodes, {{0, 0}, 0, 1}, 512, 0.5);
  add_mirrored(thin.nodes, {{0.5, 0.5}, 0.5, 3}, 512);
  check_everywhere(thin);

  Case square{"square", rectangle(4, 4), {{{2, 2}, 2, 4}}, 8 * root2};
  add_mirrored(square.nodes, {{0, 0}, 0, 1}, 2, 2);
  check_everywhere(square);
}

TEST(ClosedForm, L) {
  const double t = elbow(2);
  check_everywhere({"L",
                    l_shape(2),
                    {{{0, 0}, 0, 1},
                     {{4, 0}, 0, 1},
                     {{4, 2}, 0, 1},
                     {{2, 4}, 0, 1},
                     {{0, 4}, 0, 1},
                     {{3, 1}, 1, 3},
                     {{1, 3}, 1, 3},
                     {{2, 1}, 1, 2},
                     {{1, 2}, 1, 2},
                     {{t, t}, t, 3}},
                    t * root2 + 2 + 4 * root2 + 2 * elbow_arc(2)});
}

TEST(ClosedForm, T) {
  Case expected{"T", t_shape(2), {{{3, 1}, 1, 3}, {{3, 4}, 1, 2}, {{3, 4.75}, 1.25, 3}}, 0};
  add_mirrored(expected.nodes, {{2, 0}, 0, 1}, 3);
  add_mirrored(expected.nodes, {{0, 4}, 0, 1}, 3);
  add_mirrored(expected.nodes, {{0, 6}, 0, 1}, 3);
  add_mirrored(expected.nodes, {{1, 5}, 1, 3}, 3);
  add_mirrored(expected.nodes, {{2, 5}, 1, 2}, 3);
  expected.length = 6 * root2 + 2 * 1 + 2 * parabola_length(2, 1) + 0.75 + 3;
  check_everywhere(expected);
}

TEST(ClosedForm, U) {
  const double t = elbow(2);
  Case expected{"U", u_shape(2), {}, 0};
  add_mirrored(expected.nodes, {{0, 0}, 0, 1}, 3);
  add_mirrored(expected.nodes, {{0, 4}, 0, 1}, 3);
  add_mirrored(expected.nodes, {{2, 4}, 0, 1}, 3);
  add_mirrored(expected.nodes, {{1, 3}, 1, 3}, 3);
  add_mirrored(expected.nodes, {{1, 2}, 1, 2}, 3);
  add_mirrored(expected.nodes, {{t, t}, t, 3}, 3);
  add_mirrored(expected.nodes, {{2, 1}, 1, 2}, 3);
  expected.length = 2 * (2 * root2 + 1 + 2 * elbow_arc(2) + t * root2) + 2;
  check_everywhere(expected);
}

TEST(ClosedForm, Cross) {
  Case expected{"cross", cross_shape(2), {{{3, 3}, root2, 4}}, 4 * (2 * root2 + 2)};
  add_mirrored(expected.nodes, {{2, 0}, 0, 1}, 3, 3);
  add_mirrored(expected.nodes, {{0, 2}, 0, 1}, 3, 3);
  const std::vector<ExpectedNode> arm{{{3, 1}, 1, 3}, {{3, 2}, 1, 2}};
  for (const ExpectedNode& node : arm) {
    const double y = node.center.y;
    for (const Vec2 center : {Vec2{3, y}, Vec2{3, 6 - y}, Vec2{y, 3}, Vec2{6 - y, 3}}) {
      expected.nodes.push_back({center, node.radius, node.degree});
    }
  }
  check_everywhere(expected);
}

TEST(ClosedForm, Comb) {
  for (const std::size_t teeth : std::vector<std::size_t>{2, 3, 10, 200}) {
    const auto count = static_cast<double>(teeth);
    const double middle = count - 0.5;
    const double t = elbow(1);
    Case expected{"comb of " + std::to_string(teeth), comb(teeth), {}, 0};
    add_mirrored(expected.nodes, {{0, 0}, 0, 1}, middle);
    add_mirrored(expected.nodes, {{t, t}, t, 3}, middle);
    for (std::size_t i = 0; i < teeth; ++i) {
      const double x = 2 * static_cast<double>(i);
      expected.nodes.push_back({{x, 6}, 0, 1});
      expected.nodes.push_back({{x + 1, 6}, 0, 1});
      expected.nodes.push_back({{x + 0.5, 5.5}, 0.5, 3});
      expected.nodes.push_back({{x + 0.5, 1}, 0.5, 2});
      if (i > 0) expected.nodes.push_back({{x, 0.5}, 0.5, 2});
      if (i + 1 < teeth) expected.nodes.push_back({{x + 1, 0.5}, 0.5, 2});
      if (i > 0 && i + 1 < teeth) expected.nodes.push_back({{x + 0.5, 0.625}, 0.625, 3});
    }
    expected.length = count * (root2 + 4.5) + 2 * (t * root2 + 2 * elbow_arc(1)) +
                      (count - 2) * (0.375 + 2 * parabola_length(1, 0.5)) + (count - 1);
    check_everywhere(expected);
  }
}

TEST(ClosedForm, TrianglesHaveTheirIncentre) {
  const std::vector<std::vector<Vec2>> triangles{{{0, 0}, {4, 0}, {0, 3}},
                                                 {{0, 0}, {8, 1}, {3, 5}},
                                                 {{0, 0}, {1024, 0}, {1000, 1}},
                                                 {{-3, -7}, {11, 2}, {-8, 13}}};
  for (const auto& p : triangles) {
    const double a = distance(p[1], p[2]);
    const double b = distance(p[2], p[0]);
    const double c = distance(p[0], p[1]);
    const double perimeter = a + b + c;
    const Vec2 center = (1 / perimeter) * (a * p[0] + b * p[1] + c * p[2]);
    const double radius = cross(p[1] - p[0], p[2] - p[0]) / perimeter;
    check_everywhere({"triangle",
                      triangle(p[0], p[1], p[2]),
                      {{p[0], 0, 1}, {p[1], 0, 1}, {p[2], 0, 1}, {center, radius, 3}},
                      distance(center, p[0]) + distance(center, p[1]) + distance(center, p[2])});
  }
}

TEST(ClosedForm, RegularPolygonsHaveOneNode) {
  std::vector<std::size_t> sizes;
  for (std::size_t n = 3; n <= 64; ++n) sizes.push_back(n);
  sizes.push_back(1000);
  for (const std::size_t n : sizes) {
    const auto count = static_cast<double>(n);
    Case expected{std::to_string(n) + "-gon", regular_polygon(n), {}, count};
    for (const Vec2 corner : expected.rings[0].points) expected.nodes.push_back({corner, 0, 1});
    expected.nodes.push_back({{0, 0}, std::cos(std::numbers::pi / count), n});
    check_everywhere(expected);
  }
}

TEST(ClosedForm, StarsHaveOneNodeAmongTheirReflexVertices) {
  for (const std::size_t n : {5U, 12U, 40U, 100U, 400U}) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < 2 * n; ++i) {
      const double angle = std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
      const double radius = i % 2 == 0 ? 2 : 1;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    for (const Symmetry& symmetry : symmetries()) {
      SCOPED_TRACE(std::to_string(n) + " reflex vertices, " + symmetry.name);
      const auto shape = build_shape(transformed({ring_of(points)}, symmetry));
      ASSERT_TRUE(shape);
      const auto axis = compute(*shape, {.threads = 1});
      ASSERT_TRUE(axis);
      const Incidence incidence(*axis);
      std::size_t inside = 0;
      for (std::uint32_t i = 0; i < axis->nodes.size(); ++i) {
        if (incidence.degree(i) < 3) continue;
        ++inside;
        EXPECT_EQ(incidence.degree(i), n);
        EXPECT_NEAR(axis->nodes[i].disk.radius, symmetry.scale(), 1e-7 * symmetry.scale());
      }
      EXPECT_EQ(inside, 1u);
      const Certificate certificate = verify(*shape, *axis, {.threads = 1});
      EXPECT_TRUE(certificate.passed);
    }
  }
}

Ring box_ring(double x0, double y0, double x1, double y1) {
  return ring_of({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

TEST(ClosedForm, RectangleWithARectangularHole) {
  const double t = elbow(2);
  Case expected{"hole", {box_ring(0, 0, 8, 6), box_ring(2, 2, 6, 4)}, {}, 0};
  add_mirrored(expected.nodes, {{0, 0}, 0, 1}, 4, 3);
  add_mirrored(expected.nodes, {{t, t}, t, 3}, 4, 3);
  add_mirrored(expected.nodes, {{2, 1}, 1, 2}, 4, 3);
  add_mirrored(expected.nodes, {{1, 2}, 1, 2}, 4, 3);
  expected.length = 4 * (t * root2 + 2 * elbow_arc(2)) + 2 * (4 + 2);
  check_everywhere(expected);
}

TEST(ClosedForm, SquareWithASmallTriangularHole) {
  // Below the hole a corridor 4 wide; beside it the parabolas of its lower corners, up to where
  // their normals at 45 degrees begin; above, the bisectors of the sloping sides.
  Case expected{
      "triangular hole", {box_ring(-4, -4, 4, 4), ring_of({{-1, 0}, {1, 0}, {0, 1}})}, {}};
  const double low = 7 - 2 * root6;         // (3 - t)^2 + (4 - t)^2 = t^2
  const double high = 7 * (2 - root2) / 2;  // (7 - 2 t) / sqrt 2 = t
  const double q = 3 * (root2 - 1);         // q sqrt 2 = 3 - q
  add_mirrored(expected.nodes, {{4, -4}, 0, 1}, 0);
  add_mirrored(expected.nodes, {{4, 4}, 0, 1}, 0);
  add_mirrored(expected.nodes, {{1, -2}, 2, 2}, 0);
  add_mirrored(expected.nodes, {{4 - low, low - 4}, low, 3}, 0);
  add_mirrored(expected.nodes, {{1 + q, q}, 3 - q, 2}, 0);
  add_mirrored(expected.nodes, {{4 - high, 4 - high}, high, 3}, 0);
  add_mirrored(expected.nodes, {{q, 1 + q}, 3 - q, 2}, 0);
  expected.length =
      2 + 2 * (parabola_length(4, 3 - low) + parabola_length(3, 4 - low) + parabola_length(3, q) +
               distance(Vec2{1 + q, q}, Vec2{4 - high, 4 - high}) +
               distance(Vec2{q, 1 + q}, Vec2{4 - high, 4 - high}) + (low + high) * root2 +
               parabola_length(3, q));
  check_everywhere(expected);
}

TEST(ClosedForm, RectangleWithTwoSquareHoles) {
  const double t = elbow(2);
  Case expected{
      "two holes", {box_ring(0, 0, 10, 6), box_ring(2, 2, 4, 4), box_ring(6, 2, 8, 4)}, {}, 0};
  add_mirrored(expected.nodes, {{0, 0}, 0, 1}, 5, 3);
  add_mirrored(expected.nodes, {{t, t}, t, 3}, 5, 3);
  add_mirrored(expected.nodes, {{2, 1}, 1, 2}, 5, 3);
  add_mirrored(expected.nodes, {{1, 2}, 1, 2}, 5, 3);
  add_mirrored(expected.nodes, {{4, 1}, 1, 2}, 5, 3);
  for (const double y : {2.0, 4.0}) expected.nodes.push_back({{5, y}, 1, 2});
  for (const double y : {1.25, 4.75}) expected.nodes.push_back({{5, y}, 1.25, 3});
  expected.length = 4 * (t * root2 + 2 * elbow_arc(2)) + 4 * 2 + 2 * 2 +
                    2 * (0.75 + 2 * parabola_length(2, 1)) + 2;
  check_everywhere(expected);
}

TEST(ClosedForm, HoleThatTouchesAnEdge) {
  // A diamond that stands on the lower side; wedges of 45 degrees on both sides of the contact.
  Case expected{"hole on an edge",
                {box_ring(-6, 0, 6, 8), ring_of({{0, 0}, {2, 2}, {0, 4}, {-2, 2}})},
                {},
                0,
                true};
  const double q = 2 * (root2 - 1);  // q sqrt 2 = 2 - q
  const double w = 4 * (root2 - 1);  // w sqrt 2 = 4 - w
  const double t = 5 * (2 - root2);  // (10 - 2 t) / sqrt 2 = t
  const Vec2 first{2 + q, 2 - q};
  const Vec2 corner{6 - t, 8 - t};
  add_mirrored(expected.nodes, {{0, 0}, 0, 1}, 0);
  add_mirrored(expected.nodes, {{6, 0}, 0, 1}, 0);
  add_mirrored(expected.nodes, {{6, 8}, 0, 1}, 0);
  add_mirrored(expected.nodes, {first, 2 - q, 2}, 0);
  add_mirrored(expected.nodes, {{4, 2}, 2, 3}, 0);
  add_mirrored(expected.nodes, {{2 + w, 2 + w}, 4 - w, 2}, 0);
  add_mirrored(expected.nodes, {corner, t, 3}, 0);
  add_mirrored(expected.nodes, {{w, 4 + w}, 4 - w, 2}, 0);
  expected.length = 2 * (norm(first) + parabola_length(2, 2) - parabola_length(2, q) + 2 * root2 +
                         parabola_length(4, w) + distance({2 + w, 2 + w}, corner) + t * root2 +
                         distance({w, 4 + w}, corner) + parabola_length(4, w));
  check_everywhere(expected);
}

TEST(ClosedForm, HoleThatTouchesACorner) {
  Case expected{
      "hole in a corner", {box_ring(0, 0, 8, 8), ring_of({{0, 0}, {4, 2}, {2, 4}})}, {}, 0};
  const double s = 10 - 4 * root5;   // s = 2 - 2 s / sqrt 5
  const double q = 4 * (root2 - 1);  // q sqrt 2 = 4 - q
  const double t = 5 * (2 - root2);  // (10 - 2 t) / sqrt 2 = t
  const Vec2 first{4 + s / root5, s};
  const Vec2 corner{8 - t, 8 - t};
  const std::vector<ExpectedNode> half{
      {{0, 0}, 0, 1}, {{8, 0}, 0, 1}, {first, s, 2}, {{6, 2}, 2, 3}, {{4 + q, 2 + q}, 4 - q, 2}};
  for (const ExpectedNode& node : half) {
    expected.nodes.push_back(node);
    expected.nodes.push_back({{node.center.y, node.center.x}, node.radius, node.degree});
  }
  expected.nodes.push_back({{8, 8}, 0, 1});
  expected.nodes.push_back({corner, t, 3});
  expected.length = 2 * (norm(first) + parabola_length(2, 2) - parabola_length(2, s / root5) +
                         2 * root2 + parabola_length(4, q) + distance({4 + q, 2 + q}, corner)) +
                    t * root2;
  check_everywhere(expected);
}

/// The upper side of a rectangle pushed down to the vertex (0, 1); its halves have slopes 3/4.
Case notch() {
  Case expected{"notch", {ring_of({{-4, 0}, {4, 0}, {4, 4}, {0, 1}, {-4, 4}})}, {}, 0};
  const Vec2 end{1.0 / 3, 5.0 / 9};     // 1 - 4 s / 5 = s, at (3 s / 5, s)
  const Vec2 branch{8.0 / 3, 4.0 / 3};  // 3 (4 - t) + 4 = 9 t
  add_mirrored(expected.nodes, {{4, 0}, 0, 1}, 0);
  add_mirrored(expected.nodes, {{4, 4}, 0, 1}, 0);
  add_mirrored(expected.nodes, {end, end.y, 2}, 0);
  add_mirrored(expected.nodes, {branch, branch.y, 3}, 0);
  expected.length = 2 * (parabola_length(1, end.x) + distance(end, branch) +
                         distance(branch, {4, 0}) + distance(branch, {4, 4}));
  return expected;
}

TEST(ClosedForm, Notch) { check_everywhere(notch()); }

TEST(ClosedForm, ParabolaOfANotch) {
  const auto shape = build_shape(notch().rings);
  ASSERT_TRUE(shape);
  const auto axis = compute(*shape, {.threads = 1});
  ASSERT_TRUE(axis);
  int parabolas = 0;
  for (const Edge& edge : axis->edges) {
    const SiteKind left = axis->sites[edge.site[0]].kind();
    const SiteKind right = axis->sites[edge.site[1]].kind();
    if (left == SiteKind::segment && right == SiteKind::segment) continue;
    ++parabolas;
    EXPECT_EQ(edge.weight, 1);
    // The tangents at x = -1/3 and x = 1/3 meet on the axis of the parabola.
    EXPECT_NEAR(edge.control.center.x, 0, 1e-12);
    EXPECT_NEAR(edge.control.center.y, 0.5 - 1.0 / 18, 1e-12);
    EXPECT_NEAR(edge.control.radius, 0.5 - 1.0 / 18, 1e-12);
    for (int i = 0; i <= 64; ++i) {
      const Disk disk = disk_at(*axis, edge, i / 64.0);
      const double x = disk.center.x;
      EXPECT_NEAR(disk.center.y, 0.5 + x * x / 2, 1e-13);
      EXPECT_NEAR(disk.radius, disk.center.y, 1e-13);
      EXPECT_NEAR(std::abs(x), std::abs(i / 32.0 - 1) / 3, 1e-13);
    }
  }
  EXPECT_EQ(parabolas, 1);
}

}  // namespace
}  // namespace medial::test
