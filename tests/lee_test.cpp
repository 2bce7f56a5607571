// Lee's divide and conquer: what the paper proves of the diagram holds for random simple polygons,
// and its axis is that of `disks`.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "medial/medial.h"
#include "methods/disks/boundary.h"
#include "support/generate_arcs.h"
#include "support/nasty.h"
#include "support/property.h"
#include "support/random_shapes.h"

namespace medial::test {
namespace {

/// Where along its site an edge's disk of one node touches: the parameter of a segment, in units of
/// length; around a reflex vertex no foot moves.
double foot_parameter(const Site& site, Vec2 center) {
  if (site.kind() == SiteKind::vertex) return 0;
  const Vec2 d = site.end - site.start;
  return dot(center - site.start, d) / norm(d);
}

double distance_to(const Site& site, Vec2 p) { return distance(foot(site, p), p); }

/// A text about the properties that a polygon's diagram violates; empty if there are none.
std::string check_diagram(const Shape& shape, const VoronoiDiagram& diagram) {
  const double slack = 1e-7 * diagonal(bounding_box(shape));
  const std::size_t holes = shape.hole_count(), outer = shape.loop_count() - holes;
  const std::size_t count = diagram.sites.size();
  // Lemma 3, and Euler's formula; `disks` leaves out edges without length.
  const bool is_whole = diagram.method == "lee";
  if (is_whole && diagram.edges.size() != 2 * count + 3 * holes - 3 * outer)
    return "the number of edges is not 2N - 3";
  const std::size_t points = diagram.nodes.size() - shape.points.size();
  if (is_whole && points != count + 2 * holes - 2 * outer)
    return "the number of Voronoi points is not N - 2";
  if (diagram.edges.size() + outer != points + count + holes) return "against Euler's formula";
  // Corollary 2: the disks of an edge touch both of its sites, Lemma 2: and no other reaches in.
  for (const VoronoiEdge& edge : diagram.edges)
    for (const std::uint32_t node : edge.node) {
      const Disk& disk = diagram.nodes[node].disk;
      for (const std::uint32_t site : edge.site)
        if (std::abs(distance_to(diagram.sites[site], disk.center) - disk.radius) > slack)
          return "a disk does not touch a site of its edge";
    }
  // By brute force, for all but the largest.
  constexpr std::size_t most_pairs = 20000;
  const bool is_small = diagram.nodes.size() * count <= most_pairs;
  for (const Node& node : diagram.nodes)
    for (std::uint32_t i = 0; i < (is_small ? count : 0); ++i)
      if (const Site& site = diagram.sites[i];
          distance_to(site, node.disk.center) < node.disk.radius - slack)
        return "a disk is not empty";
  // Corollary 1: a face is one chain of edges from the start of its site to the end, along which
  // the foot moves forward.
  std::size_t spokes = 0;
  for (std::uint32_t site = 0; site < count; ++site) {
    const Site& own = diagram.sites[site];
    const auto face = diagram.face(site);
    if (face.empty()) return "a face has no edge";
    Vec2 at = own.start;
    double reached = 0;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const VoronoiEdge& edge = diagram.edges[face[i]];
      const bool forward = edge.site[1] == site;
      if (!forward && edge.site[0] != site) return "a face has an edge of others";
      if (distance(at, diagram.nodes[edge.node[forward ? 0 : 1]].disk.center) > slack)
        return "a face is not one chain";
      at = diagram.nodes[edge.node[forward ? 1 : 0]].disk.center;
      const double parameter = foot_parameter(own, at);
      if (parameter < reached - slack) return "a foot moves backward";
      reached = std::max(reached, parameter);
      spokes += edge.spoke ? 1 : 0;
    }
    if (distance(at, own.end) > slack) return "a face does not end at its site's end";
  }
  const auto reflex = static_cast<std::size_t>(
      std::count_if(diagram.sites.begin(), diagram.sites.end(),
                    [](const Site& site) { return site.kind() == SiteKind::vertex; }));
  if (spokes != 4 * reflex) return "a reflex vertex does not have two spokes";
  return "";
}

/// Largest distance from samples of one axis to another axis.
double furthest(const MedialAxis& from, const MedialAxis& to, double step) {
  const AxisLocator locator(to);
  double largest = 0;
  for (const Edge& edge : from.edges)
    for (const Disk& disk : sample_by_step(from, edge, step))
      largest = std::max(largest, locator.nearest(disk.center).distance);
  return largest;
}

Options by_lee(int threads = 1) { return {.method = method::Lee{}, .threads = threads}; }

/// The axis is verified and is that of `disks`; empty where it is.
std::string check_axis_of(const Shape& shape, bool as_graph) {
  const auto axis = compute(shape, by_lee());
  if (!axis) return to_string(axis.error());
  const Certificate certificate = verify(shape, *axis, {.threads = 1});
  if (!certificate.passed) return certificate.failures.front();
  const auto other = compute(shape, {.threads = 1});
  if (!other) return "disks: " + to_string(other.error());
  const double size = diagonal(bounding_box(shape));
  const Invariants ours = invariants_of(*axis, size), theirs = invariants_of(*other, size);
  if (std::abs(ours.deepest - theirs.deepest) > 1e-12 * size) return "another deepest disk";
  if (!as_graph) return "";
  if (ours.leaves != theirs.leaves) return "other leaves";
  if (ours.branching != theirs.branching) return "other branchings";
  if (std::abs(ours.length - theirs.length) > 1e-8 * theirs.length) return "another length";
  const double off =
      std::max(furthest(*axis, *other, 0.05 * size), furthest(*other, *axis, 0.05 * size));
  return off > 1e-8 * size ? "another set of points" : "";
}

constexpr std::uint64_t lee_shares = 8;

class Lee : public testing::TestWithParam<std::uint64_t> {
 protected:
  /// Calls `check` with this share of about `count` polygons.
  template <class Check>
  static void for_polygons(double share_of_all, const Check& check) {
    const auto all = static_cast<double>(shape_count(1));
    const std::uint64_t base = first_seed();
    const auto wanted = static_cast<std::uint64_t>(share_of_all * all / lee_shares) + 1;
    std::uint64_t checked = 0;
    int failed = 0;
    for (std::uint64_t i = GetParam(); checked < wanted && failed < 3; i += lee_shares) {
      const RandomShape random = random_shape(base + i);
      const auto shape = build_shape(random.rings);
      if (!shape) continue;
      ++checked;
      const std::string failure = check(random, *shape);
      if (failure.empty()) continue;
      ++failed;
      ADD_FAILURE() << "random_shape(" << base + i << "), " << random.kind << ": " << failure
                    << "\n"
                    << to_wkt(random.rings);
    }
  }
};

TEST_P(Lee, HasTheDiagramOfTheLemmas) {
  for_polygons(1, [](const RandomShape&, const Shape& shape) -> std::string {
    const auto diagram = voronoi_diagram(shape, {.threads = 1});
    if (!diagram) return to_string(diagram.error());
    return check_diagram(shape, *diagram);
  });
}

TEST_P(Lee, HasTheAxisOfDisks) {
  for_polygons(0.1, [](const RandomShape& random, const Shape& shape) {
    return check_axis_of(shape, random.rigid);
  });
}

INSTANTIATE_TEST_SUITE_P(Random, Lee, testing::Range<std::uint64_t>(0, lee_shares));

Shape built(const Rings& rings) { return build_shape(rings).value(); }

/// A merge curve that had left the shape for good dropped edges that lay behind its disk, before it
/// saw by the first edge that did not that the disk was not inside.
TEST(LeeDiagram, KeepsWhatADiskOutsideWouldCover) {
  EXPECT_EQ(check_axis_of(built(random_shape(47244732905).rings), true), "");
}

/// In general position no edge is without length: Lemma 3 holds with equality in the plane, too.
TEST(LeeDiagram, HasNoEmptyEdgesInGeneralPosition) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Shape shape = built({star(random, 30)});
    const auto diagram = voronoi_diagram(shape, {.threads = 1});
    ASSERT_TRUE(diagram.ok());
    for (const VoronoiEdge& edge : diagram->edges)
      EXPECT_GT(distance(diagram->nodes[edge.node[0]].disk.center,
                         diagram->nodes[edge.node[1]].disk.center),
                0);
  }
}

TEST(LeeDiagram, LessItsSpokesIsTheAxis) {
  const Shape shape = built(l_shape(2));
  const auto diagram = voronoi_diagram(shape, {.threads = 1});
  const auto axis = compute(shape, by_lee());
  ASSERT_TRUE(diagram.ok() && axis.ok());
  double length_of_edges = 0;
  for (const VoronoiEdge& edge : diagram->edges) {
    MedialAxis one;
    one.nodes = diagram->nodes;
    one.sites = diagram->sites;
    if (!edge.spoke) length_of_edges += length(one, edge);
  }
  EXPECT_NEAR(length_of_edges, total_length(*axis), 1e-12);
}

/// The lists have a touched element in pieces, and the result has it in one piece again.
std::string check_holes(const Rings& rings) {
  const Shape shape = built(rings);
  const auto diagram = voronoi_diagram(shape, {.threads = 1});
  if (!diagram) return to_string(diagram.error());
  const std::string failure = check_diagram(shape, *diagram);
  return failure.empty() ? check_axis_of(shape, true) : failure;
}

TEST(LeeHoles, AreConnectedByBridges) {
  for (const std::size_t k : {1U, 2U, 7U, 20U}) EXPECT_EQ(check_holes(hole_grid(k)), "") << k;
  EXPECT_EQ(check_holes(nested_squares(9)), "");
  Random random(1982);
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(check_holes(star_with_holes(random, 12, 1 + static_cast<std::size_t>(i) % 5)), "")
        << i;
    EXPECT_EQ(check_holes(nested(random, 9, 4)), "") << i;
  }
  const auto axis = compute(built(hole_grid(7)), by_lee());
  ASSERT_TRUE(axis.ok());
  EXPECT_EQ(axis->statistics.bridges, 49U);
}

/// Gaps of 1e-6 to 1e-9 beside holes, on which rounding decides.
TEST(LeeHoles, MayAllButTouch) {
  Random random(7);
  for (int i = 0; i < 40; ++i) {
    const Shape shape = built(near_touching(random, std::pow(10, -random.between(6, 9))));
    EXPECT_EQ(check_axis_of(shape, false), "") << i;
  }
}

Rings ellipse(std::size_t n, double height = 1) {
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    ring.points.push_back({2 * std::cos(angle), height * std::sin(angle)});
  }
  return {ring};
}

/// Half circles, of `n` sides each, and two straight sides: many segments around one disk, but not
/// all.
Rings stadium(std::size_t n, double length) {
  Ring ring;
  for (const double side : {1.0, -1.0})
    for (std::size_t i = 0; i <= n; ++i) {
      const double angle = std::numbers::pi * (static_cast<double>(i) / static_cast<double>(n) -
                                               (side > 0 ? 0.5 : -0.5));
      ring.points.push_back({std::cos(angle) + side * length, std::sin(angle)});
    }
  return {ring};
}

/// Tangents of the unit circle, at angles of all kinds.
Rings tangential(std::size_t n) {
  Ring ring;
  Random random(1982);
  std::vector<double> angles;
  for (std::size_t i = 0; i < n; ++i)
    angles.push_back(
        (2 * std::numbers::pi / static_cast<double>(n)) *
        (static_cast<double>(i) + 0.8 * 0x1p-53 * static_cast<double>(random.next() >> 11)));
  for (std::size_t i = 0; i < n; ++i) {
    const double first = angles[i],
                 second = i + 1 < n ? angles[i + 1] : angles[0] + 2 * std::numbers::pi;
    const double middle = 0.5 * (first + second), far = 1 / std::cos(0.5 * (second - first));
    ring.points.push_back({far * std::cos(middle), far * std::sin(middle)});
  }
  return {ring};
}

struct Degenerate {
  const char* name;
  Rings (*rings)();
  bool as_graph = true;
};
void PrintTo(const Degenerate& tested, std::ostream* out) { *out << tested.name; }

class LeeDegenerate : public testing::TestWithParam<Degenerate> {};

TEST_P(LeeDegenerate, HasTheAxisOfDisks) {
  EXPECT_EQ(check_axis_of(built(GetParam().rings()), GetParam().as_graph), "");
}

INSTANTIATE_TEST_SUITE_P(
    Fixed, LeeDegenerate,
    testing::Values(Degenerate{"Triangle",
                               [] {
                                 return triangle({0, 0}, {4, 0}, {1, 3});
                               }},
                    Degenerate{"Square", [] { return rectangle(4, 4); }},
                    Degenerate{"Regular7", [] { return regular_polygon(7); }},
                    Degenerate{"Regular1000", [] { return regular_polygon(1000); }, false},
                    Degenerate{"Regular10000", [] { return regular_polygon(10000); }, false},
                    Degenerate{"Ellipse100000", [] { return ellipse(100000); }, false},
                    Degenerate{"Stadium", [] { return stadium(50, 2); }},
                    Degenerate{"Stadium10000", [] { return stadium(10000, 0.1); }, false},
                    Degenerate{"Tangential5", [] { return tangential(5); }},
                    Degenerate{"Tangential300", [] { return tangential(300); }, false},
                    Degenerate{"Blob", [] { return blob(3000); }, false},
                    Degenerate{"Maze", [] { return maze(3000); }},
                    Degenerate{"Comb", [] { return comb(300); }},
                    Degenerate{"Spiral", [] { return spiral(1000, 20); }},
                    Degenerate{"Needle", [] { return needle(1e-7); }, false},
                    Degenerate{"Cross", [] { return cross_shape(2); }},
                    Degenerate{"JaggedStar", [] { return jagged_star(1000); }}),
    [](const auto& tested) { return std::string(tested.param.name); });

/// All sides touch one disk: one node, however the merges broke the tie.
TEST(LeeTies, OfRegularPolygonsAreOneNode) {
  for (const std::size_t n : {5U, 12U, 100U, 1000U, 10000U, 100000U}) {
    const auto axis = compute(built(regular_polygon(n)), by_lee());
    ASSERT_TRUE(axis.ok());
    EXPECT_EQ(axis->nodes.size(), n + 1);
    EXPECT_EQ(axis->edges.size(), n);
  }
}

/// In closed form, as the diagram of a list or of the whole polygon.
TEST(LeeTies, OfSegmentsAroundOneDiskHaveTheDiagramOfTheLemmas) {
  for (const Rings& rings : {regular_polygon(3), regular_polygon(4), regular_polygon(100),
                             tangential(40), stadium(40, 1), stadium(1000, 1e-3)}) {
    const Shape shape = built(rings);
    const auto diagram = voronoi_diagram(shape, {.threads = 1});
    ASSERT_TRUE(diagram.ok());
    EXPECT_EQ(check_diagram(shape, *diagram), "");
  }
}

/// Ties by the thousand: disks that touch the end of a segment from behind, and so not the segment.
TEST(LeeTies, OfMazesAreBrokenAlike) {
  for (const std::uint64_t seed : {153U, 155U, 446U, 451U, 600U})
    EXPECT_EQ(check_axis_of(built(maze(10000, seed)), true), "") << seed;
}

/// Next to the ends of the axis hundreds of sides touch one disk up to rounding, of which three
/// determine it to some 1e-8 only: taken for a tie, it may reach over sides further on.
TEST(LeeTies, OfNearlyRoundEllipsesReachOverNothing) {
  const Shape shape = built(ellipse(300000, 1.998));
  const auto axis = compute(shape, by_lee());
  ASSERT_TRUE(axis.ok());
  const std::size_t count = axis->sites.size();
  double deepest = 0;
  for (const Edge& edge : axis->edges) {
    const Disk& disk = axis->nodes[edge.node[0]].disk;
    for (std::size_t step = 1; step <= 1024; step *= 2)
      for (const std::size_t far : {edge.site[0] + step, edge.site[0] + count - step})
        deepest =
            std::max(deepest, disk.radius - distance_to(axis->sites[far % count], disk.center));
  }
  EXPECT_LT(deepest, 2 * axis->tolerance);
}

/// A list of a thousand of these sides turns too little to tell their disk: the largest lists tell.
TEST(LeeTies, OfHalfCirclesWithVeryManySidesAreOneNodeEach) {
  const Shape shape = built(stadium(100000, 0.1));
  const auto axis = compute(shape, by_lee());
  ASSERT_TRUE(axis.ok());
  EXPECT_EQ(axis->nodes.size(), shape.points.size() + 4);
  EXPECT_LT(axis->statistics.queries, 1000u);
}

/// Three sides next to each other determine a disk to 1e-8 only, of an axis that is 4e-10 long: no
/// disk that reaches over the other side is given out.
TEST(LeeLeavesToDisks, WhatIsTooNearlyRoundForItsNumberOfSides) {
  const Shape shape = built(ellipse(3000, 2 - 2e-11));
  EXPECT_EQ(check_axis_of(shape, false), "");
  EXPECT_EQ(compute(shape, by_lee()).value().method, "disks");
}

/// Two quarters of a circle are off by some tolerances, so that each side of these is nearly tied
/// with all of the others: disks in between reached over the boundary by tens of tolerances.
TEST(LeeTies, OfQuartersOfACircleReachOverNothing) {
  const auto quarters = [](std::size_t n, const auto& off) {
    const double turn = 2 * std::numbers::pi / static_cast<double>(n);
    std::vector<double> height(n, 1.0);
    for (std::size_t i = 0; i < n; ++i)
      if ((4 * i / n) % 2 == 1) height[i] += off(turn * static_cast<double>(i));
    Ring ring;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = turn * static_cast<double>(i), half = std::sin(0.5 * turn);
      const double along =
          (height[(i + 1) % n] - height[i] + height[i] * 2 * half * half) / std::sin(turn);
      ring.points.push_back({height[i] * std::cos(angle) - along * std::sin(angle),
                             height[i] * std::sin(angle) + along * std::cos(angle)});
    }
    return Rings{ring};
  };
  Random random(5);
  const auto smooth = [](double angle) { return 2e-13 * std::cos(2 * angle); };
  const auto rough = [&](double) { return 2e-13 * random.between(-1, 1); };
  EXPECT_EQ(check_axis_of(built(quarters(3000, smooth)), false), "");
  EXPECT_EQ(check_axis_of(built(quarters(10000, rough)), false), "");
}

/// Holes nearly touch, by 3e-8: around a vertex next to such a gap a disk is known to 1e-8 only,
/// and the foot on the side beside it moved backward.
TEST(LeeTies, OfHolesThatNearlyTouchMoveNoFootBackward) {
  const Shape shape = built(Rings{{{{3.536834812734912, 5.123645180803398},
                                    {0.9939695002231714, 6.336558764231959},
                                    {-1.8009755186890104, 5.982149820074334},
                                    {-3.960624948634842, 4.1729406839666305},
                                    {-4.799305354960215, 1.4833424733621443},
                                    {-4.050741634489404, -1.232716383665045},
                                    {-1.952597479373387, -3.1129063907636434},
                                    {0.8289811659166919, -3.5602805054676177},
                                    {3.4108627351967686, -2.432800607352896},
                                    {4.973318072923852, -0.08843359767862549},
                                    {5.020278649151463, 2.7285005624893626}}},
                                  {{{0, 0},
                                    {0.799999976150937, 0.5999999821132027},
                                    {0.19999999403773427, 1.3999999582641398},
                                    {-0.5999999821132027, 0.799999976150937}}},
                                  {{{-0.5999999999999999, 0.8000000000000003},
                                    {0.199999976150937, 1.3999999821132028},
                                    {-0.4000000059622656, 2.1999999582641396},
                                    {-1.199999982113203, 1.5999999761509365}}},
                                  {{{-0.3400000077509454, 1.61999997555471},
                                    {-0.6199999994037733, 1.659999974362257},
                                    {-0.6599999982113202, 1.3799999827094291},
                                    {-0.3800000065584924, 1.3399999839018826}}},
                                  {{{-0.4858578677789977, 1.5989949255470155},
                                    {-0.5989949493960784, 1.5141421143342049},
                                    {-0.5141421381832677, 1.401005032717124},
                                    {-0.4010050565661872, 1.4858578439299346}}},
                                  {{{0.8000000000000003, 0.6},
                                    {1.599999976150937, 1.1999999821132026},
                                    {0.9999999940377342, 1.9999999582641395},
                                    {0.20000001788679733, 1.399999976150937}}},
                                  {{{0.20000000000000007, 1.4},
                                    {0.9999999761509367, 1.9999999821132022},
                                    {0.39999999403773434, 2.7999999582641397},
                                    {-0.3999999821132026, 2.199999976150936}}}});
  const auto axis = compute(shape, by_lee());
  ASSERT_TRUE(axis.ok());
  EXPECT_EQ(joined(verify(shape, *axis)), "");
}

/// The disk that connects a hole touches a joint of its arcs, or a place where one is divided: in
/// the former case it is a node.
TEST(LeeArcs, HolesMayBeConnectedAtJoints) {
  const double outreach = std::atan2(disks::outreach.y, disks::outreach.x);
  const Ring square{{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}};
  for (const int arcs : {2, 3, 4})
    for (const int begin : {0, 1})
      for (int digits = 10; digits < 18; ++digits) {
        Ring hole;
        const double turn = 2 * std::numbers::pi / arcs;
        for (int i = 0; i < arcs; ++i) {
          const double angle = outreach + std::pow(10.0, -digits) + (i + 0.5 * begin) * turn;
          hole.points.push_back({0.3 + 0.5 * std::cos(angle), 0.1 + 0.5 * std::sin(angle)});
          hole.bulges.push_back(std::tan(0.25 * turn));
        }
        const Shape shape = built({square, hole});
        for (const Method& method : {by_lee().method, Method{method::BiarcDc{}}}) {
          const auto axis = compute(shape, {.method = method, .threads = 1});
          ASSERT_TRUE(axis.ok()) << to_string(axis.error());
          EXPECT_EQ(joined(verify(shape, *axis)), "") << arcs << begin << digits;
        }
      }
}

/// Between the two long sides, nearly on one line, hardly anything decides where along them a disk
/// touches: one was taken for a tie, and the foot on one of them moved backward.
TEST(LeeTies, OfSidesNearlyOnOneLineMoveNoFootBackward) {
  const Ring ring{{{-119, 36.699999999999996},
                   {-119, 36.293228326591269},
                   {-119.00000000559641, 36.293228326591269},
                   {-119.00000000327202, 36.293228322833968},
                   {-119, 36.293228322833968},
                   {-118.99999998513714, 35.699999999999996},
                   {-118, 35.700819478179135},
                   {-117.90000000000001, 36.899999999999999}}};
  EXPECT_EQ(check_axis_of(built({ring}), false), "");
}

/// A needle whose diagram has an edge without an end, in double.
Rings needle_of_many_corners() {
  // 4e-10 of its length wide: in double, an edge of its diagram has no end.
  const Ring ring{
      {{-150784414267.10709, 913083866112.70703}, {-137514003886.00409, 832724117286.32654},
       {-138230401329.84375, 837062303770.70947}, {-151986200707.91208, 920361353711.64917},
       {-134667116778.24831, 815484624674.72498}, {-115032845260.2494, 696588141490.35095},
       {-117088306267.87149, 709035106014.15417}, {-108227828444.42972, 655379962443.19958},
       {-81117078008.439972, 491209222678.94714}, {-72286320396.666153, 437734051655.99573},
       {-56826574376.590424, 344116652807.57544}, {-42590806385.820885, 257911124198.30841},
       {-28912300699.232021, 175080130696.04712}, {-11451959067.776033, 69348007515.432373},
       {4203286264.6661525, -25453248924.791325}, {21708797158.462486, -131458897096.15002},
       {34316804834.402874, -207807426841.29025}, {50059858795.037521, -303140413869.11621},
       {74220835662.37822, -449448626418.52148},  {83753581088.546555, -507174725643.73712},
       {100331361221.05685, -607562445199.67554}, {113369469533.63347, -686515474946.55823},
       {106045185967.83154, -642162846037.64673}, {131837357875.58084, -798348855756.46179},
       {127082660860.51878, -769556508767.05359}, {147541278689.72311, -893444869036.80798},
       {155436152275.56851, -941252738857.45264}, {160282703531.48328, -970601314083.75269},
       {133852442270.15169, -810551316271.30408}, {139285811424.04065, -843453401685.17419},
       {148697521946.96625, -900446566627.77246}, {122739341314.14241, -743255280727.25293},
       {123578917904.64784, -748339385755.19104}, {112805342394.03136, -683099366911.302},
       {117073544809.53714, -708945717080.2887},  {99982225924.833694, -605448232697.65173},
       {84447948027.249924, -511379501219.50104}, {69273009820.420303, -419486772879.37378},
       {56046119082.75251, -339390559943.41492},  {34487643368.281654, -208841945350.6683},
       {21291237692.414776, -128930336354.25555}, {4550270635.749301, -27554428610.801121},
       {-12045083496.554491, 72939712248.217438}, {-29444969394.274567, 178305741768.66718},
       {-47622198414.791603, 288379018415.63208}, {-66470277391.88488, 402514666402.37244},
       {-69192347286.093643, 418998319815.83752}, {-92638639148.937012, 560978715874.61145},
       {-98680940777.379425, 597568227582.63928}, {-106917257357.59917, 647443725581.7384},
       {-130984921298.44702, 793186876124.22107}, {-143395367593.10583, 868339061499.23291},
       {-130725073714.29567, 791613353392.68066}, {-148440590930.22855, 898890706939.05823},
       {-131784627319.15491, 798029541904.51965}}};
  return {ring};
}

/// Where double does not decide a diagram, `disks` computes it, and the result says so.
TEST(LeeLeavesToDisks, Needles) {
  const Shape needle = built(needle_of_many_corners());
  EXPECT_EQ(check_axis_of(needle, false), "");
  EXPECT_EQ(compute(needle, by_lee()).value().method, "disks");
  EXPECT_EQ(compute(built(l_shape(2)), by_lee()).value().method, "lee");
  const auto diagram = voronoi_diagram(needle, {.threads = 1});
  ASSERT_TRUE(diagram);
  EXPECT_EQ(diagram->method, "disks");
  EXPECT_EQ(check_diagram(needle, *diagram), "");
}

/// Their faces are chains from spoke to spoke, too.
TEST(LeeLeavesToDisks, DiagramsOfNastyShapes) {
  std::size_t left = 0;
  for (const NastyClass& one : nasty_classes())
    for (std::uint64_t seed = 0; seed < 40 && !one.has_arcs; ++seed) {
      const auto shape = build_shape(nasty_shape(one, seed, seed % 2 == 0));
      if (!shape) continue;
      const auto diagram = voronoi_diagram(*shape, {.threads = 1});
      ASSERT_TRUE(diagram) << one.name << seed << to_string(diagram.error());
      EXPECT_EQ(check_diagram(*shape, *diagram), "") << one.name << seed;
      left += diagram->method == "disks" ? 1 : 0;
    }
  EXPECT_GT(left, 3U);
}

/// Libfuzzer found it: its width is 1e-86 of its length.
TEST(LeeLeavesToDisks, NeedlesThinnerThanAnyPreciseNumber) {
  for (const Ring& ring : {ring_of({{-121, -121}, {-82, -82}, {-7.8801867941895333e-84, 0}}),
                           ring_of({{0, 0}, {1, 0}, {1, 1e-80}, {0, 1e-80}})})
    EXPECT_EQ(check_axis_of(built({ring}), false), "");
}

/// An ellipse with a dent, in which about a share of the vertices are reflex.
Rings dented(std::size_t n, double share) {
  Ring ring = ellipse(n)[0];
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    const double away = (angle - 1.3) / (4 * share);
    ring.points[i] = (1 - 0.2 * std::exp(-away * away)) * ring.points[i];
  }
  return {ring};
}

/// Where it was measured to be faster (docs/lee.md).
TEST(LeeByAuto, IsTakenWhereItIsFaster) {
  const auto taken = [](const Rings& rings) {
    return compute(built(rings), {.method = method::Auto{}, .threads = 1}).value().method;
  };
  EXPECT_EQ(taken(blob(1000)), "lee");
  EXPECT_EQ(taken(blob(30000)), "lee");
  EXPECT_EQ(taken(dented(30000, 0.1)), "lee");
  EXPECT_EQ(taken(maze(3000)), "disks");
  EXPECT_EQ(taken(hole_grid(3)), "disks");
}

TEST(LeeProgress, GrowsToOneOnOneThread) {
  std::vector<double> told;
  Options options = by_lee();
  options.progress = [&](double share) { told.push_back(share); };
  ASSERT_TRUE(compute(built(blob(20000)), options).ok());
  EXPECT_GT(told.size(), 10u);
  EXPECT_GT(told.front(), 0);
  EXPECT_LT(told.front(), 0.2);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1);
}

/// Of a shape that lee leaves to `disks`, and of one that this walks again in 256 bits.
TEST(LeeProgress, GrowsToOneOnceWhereDisksTakesOver) {
  Rings round{{}};
  for (int i = 0; i < 2000; ++i) {
    const double angle = std::numbers::pi * i / 1000;
    round[0].points.push_back({std::cos(angle), (1 - 1e-11) * std::sin(angle)});
  }
  for (const Rings& rings : {round, random_arc_shape(27).rings}) {
    std::vector<double> told;
    Options options = by_lee();
    options.progress = [&](double share) { told.push_back(share); };
    const auto axis = compute(built(rings), options);
    ASSERT_TRUE(axis.ok());
    EXPECT_EQ(axis->method, "disks");
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(std::count(told.begin(), told.end(), 1), 1);
  }
}

TEST(LeeThreads, GiveTheSameBytes) {
  for (const Rings& rings :
       {maze(20000), blob(20000), jagged_star(10000), spiral(10000, 20), hole_grid(40)}) {
    const Shape shape = built(rings);
    const auto one = compute(shape, by_lee(1));
    ASSERT_TRUE(one.ok());
    for (const int threads : {2, 8}) EXPECT_TRUE(identical(*one, *compute(shape, by_lee(threads))));
  }
}

// ---- Arcs.

TEST_P(Lee, HasTheAxisOfDisksNextToArcs) {
  const std::uint64_t count = shape_count(20, lee_shares), base = first_seed();
  for (std::uint64_t i = GetParam(); i < count; i += lee_shares) {
    const RandomShape random = random_arc_shape(base + i);
    const auto shape = build_shape(random.rings);
    ASSERT_TRUE(shape) << base + i;
    EXPECT_EQ(check_axis_of(*shape, random.rigid), "") << base + i << ", " << random.kind;
    Options outside = by_lee();
    outside.exterior = true;
    const auto axis = compute(*shape, outside);
    ASSERT_TRUE(axis) << base + i << ", " << random.kind << ": " << to_string(axis.error());
    EXPECT_TRUE(verify(*shape, *axis, {.threads = 1}).passed) << base + i << ", " << random.kind;
  }
}

/// The number of leaves and branchings of an axis.
std::array<std::size_t, 2> ends_of(const Rings& rings, const Options& options) {
  const Shape shape = built(rings);
  const auto axis = compute(shape, options);
  if (!axis) return {~std::size_t{0}, 0};
  EXPECT_TRUE(verify(shape, *axis, {.corner_angle = options.corner_angle, .threads = 1}).passed);
  const Invariants found = invariants_of(*axis, diagonal(bounding_box(shape)));
  return {found.leaves, found.branching};
}
using Ends = std::array<std::size_t, 2>;

TEST(LeeArcs, EndInTheirCentresAndAtCorners) {
  EXPECT_EQ(ends_of({circle({1, 2}, 3)}, by_lee()), (Ends{1, 0}));
  EXPECT_EQ(ends_of({test::stadium(Vec2{0, 0}, Vec2{4, 1}, 1)}, by_lee()), (Ends{2, 0}));
  EXPECT_EQ(ends_of({rounded(rectangle(8, 3)[0], 0.5)}, by_lee()), (Ends{4, 2}));
  EXPECT_EQ(ends_of({bulged_polygon(3, std::tan(std::numbers::pi / 12))}, by_lee()), (Ends{3, 1}));
  EXPECT_EQ(ends_of({bulged_polygon(2, 0.3)}, by_lee()), (Ends{2, 0}));
  EXPECT_EQ(ends_of({bulged_polygon(4, -0.2)}, by_lee()), (Ends{4, 1}));
  Ring half_disk{{{0, 0}, {2, 0}}};
  half_disk.bulges = {0, 1};
  EXPECT_EQ(ends_of({half_disk}, by_lee()), (Ends{2, 0}));
}

/// The one axis node of a circle, and of a ring the circle halfway.
TEST(LeeArcs, OfCirclesAreTheirCentres) {
  const auto one = compute(built({circle({1, 2}, 3)}), by_lee());
  ASSERT_TRUE(one.ok());
  ASSERT_EQ(one->nodes.size(), 1U);
  EXPECT_LT(distance(one->nodes[0].disk.center, {1, 2}), 1e-14);
  EXPECT_NEAR(one->nodes[0].disk.radius, 3, 1e-14);
  const auto ring = compute(built({circle({0, 0}, 3), circle({0, 0}, 1)}), by_lee());
  ASSERT_TRUE(ring.ok());
  for (const Node& node : ring->nodes) EXPECT_NEAR(norm(node.disk.center), 2, 1e-14);
}

/// The start and the end of such a list join smoothly.
TEST(LeeArcs, NeedNoCornerToBeginAt) {
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    const Rings smooth{smooth_biarcs(random, 48, 3)};
    EXPECT_EQ(ends_of(smooth, by_lee()), ends_of(smooth, {.threads = 1})) << i;
  }
}

/// A joint below the corner angle is no leaf.
TEST(LeeArcs, HaveNoLeavesAtBluntJoints) {
  Ring ring = bulged_polygon(6, 0.1);
  Options blunt = by_lee(), other{.threads = 1};
  blunt.corner_angle = other.corner_angle = 10;
  ring.bulges.assign(6, std::tan(std::numbers::pi / 12 - 0.02));  // corners of 4.6 degrees
  EXPECT_EQ(ends_of({ring}, blunt), ends_of({ring}, other));
  EXPECT_EQ(ends_of({ring}, by_lee())[0], 6U);
}

TEST(LeeArcs, GiveTheSameBytesOnAnyNumberOfThreads) {
  Random random(3);
  for (const Rings& rings : {Rings{smooth_biarcs(random, 4000, 40)}, circle_grid(30, 0.3)}) {
    const Shape shape = built(rings);
    const auto one = compute(shape, by_lee(1));
    ASSERT_TRUE(one.ok());
    for (const int threads : {2, 8}) EXPECT_TRUE(identical(*one, *compute(shape, by_lee(threads))));
  }
}

// Found by fuzzing: a disk of two tolerances next to an arc of 61 spacings of its coordinates.
TEST(LeeArcs, ASmallDiskNextToASmallArcIsLeftToDisks) {
  Ring needle;
  needle.points = {{38, 96}, {38.000000000000583, 96.000000000000654}, {-78, 61}};
  needle.bulges = {0.11811023622047244, 0.36220472440944884, 0};
  const Shape shape = built({needle});
  const auto axis = compute(shape, by_lee());
  ASSERT_TRUE(axis.ok()) << to_string(axis.error());
  EXPECT_TRUE(verify(shape, *axis).passed);
}

TEST(LeeRefuses, DiagramsWithArcs) {
  const auto diagram = voronoi_diagram(built({circle({0, 0}, 1)}));
  ASSERT_FALSE(diagram.ok());
  EXPECT_EQ(diagram.error().code, ErrorCode::invalid_option);
}

TEST(LeeRefuses, ShapesThatNobodyBuilt) {
  Shape bowtie;  // crosses itself: any typed answer, but no crash and no hang
  bowtie.points = {{0, 0}, {4, 4}, {4, 0}, {0, 4.5}, {-1, 2}};
  bowtie.sources.resize(5);
  bowtie.loop_begin = {0, 5};
  bowtie.component = {0};
  bowtie.hole = {false};
  const auto axis = compute(bowtie, by_lee());
  EXPECT_TRUE(axis.ok() || !axis.error().text.empty());
}

TEST(LeeRefuses, WhenCancelled) {
  const std::atomic<bool> cancel = true;
  Options options = by_lee();
  options.cancel = &cancel;
  const auto axis = compute(built(maze(1000)), options);
  ASSERT_FALSE(axis.ok());
  EXPECT_EQ(axis.error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace medial::test
