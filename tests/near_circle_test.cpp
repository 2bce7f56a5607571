// Circles as files have them: arcs whose coordinates and bulges have few digits. Their arcs'
// centres and radii differ by anything between a rounding and a thousandth, and all of the axis
// lies between the centres.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "medial/medial.h"
#include "support/property.h"
#include "support/random_shapes.h"

namespace medial::test {
namespace {

std::string failures_of(const Ring& ring) {
  std::string text;
  for (const std::string& failure : check_axis({ring})) text += failure + "\n";
  return text;
}

class NearCircle : public testing::TestWithParam<int> {};

TEST_P(NearCircle, OfFewDigitsIsVerified) {
  for (const int point_digits : {3, 5, 8, 10, 12}) {
    for (const int bulge_digits : {3, 6, 8, 9, 11, 13})
      EXPECT_EQ(failures_of(with_digits(arcs_of_circle(GetParam()), point_digits, bulge_digits)),
                "")
          << point_digits << " digits, bulges " << bulge_digits;
  }
}

TEST_P(NearCircle, WithRandomErrorsIsVerified) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  for (int e = 3; e <= 12; ++e) {
    const double size = std::pow(10.0, -e);
    Ring points = arcs_of_circle(GetParam()), bulges = points;
    for (Vec2& p : points.points)
      p = p + Vec2{random.between(-size, size), random.between(-size, size)};
    for (double& bulge : bulges.bulges) bulge *= 1 + random.between(-size, size);
    EXPECT_EQ(failures_of(points), "") << "points off by 1e-" << e;
    if (e < 10) {
      EXPECT_EQ(failures_of(bulges), "") << "bulges off by 1e-" << e;
    }
  }
}

/// To fifteen digits it is a circle: two half circles, and an axis of one node.
TEST_P(NearCircle, OfManyDigitsIsACircle) {
  const auto shape = build_shape(Rings{with_digits(arcs_of_circle(GetParam()), 15, 16)});
  ASSERT_TRUE(shape) << to_string(shape.error());
  EXPECT_EQ(shape->points.size(), 2);
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis) << to_string(axis.error());
  EXPECT_EQ(axis->nodes.size(), 1);
  EXPECT_TRUE(verify(*shape, *axis).passed);
}

/// Whichever of its vertices tie, its two half circles meet where they do in every image.
TEST_P(NearCircle, IsMergedAlikeInImages) {
  Rings rings(3);
  for (int i = 0; i < GetParam(); ++i) {
    const double angle = 2 * std::numbers::pi * i / GetParam();
    rings[0].points.push_back({4 * std::cos(angle), 4 * std::sin(angle)});
    rings[0].bulges.push_back(std::tan(std::numbers::pi / (2 * GetParam())));
  }
  rings[1].points = {{-2, -1.5}, {-1.5, -1.5}, {-2, -1}};
  rings[2].points = {{1.5, -1.5}, {2, -1.5}, {1.5, -1}};
  std::vector<std::size_t> nodes;
  for (unsigned map = 0; map < 8; ++map) {
    const bool swaps = (map & 1) != 0, left = (map & 2) != 0, down = (map & 4) != 0;
    Rings image = rings;
    for (Ring& ring : image) {
      for (Vec2& p : ring.points) {
        if (swaps) p = {p.y, p.x};
        p = {left ? -p.x : p.x, down ? -p.y : p.y};
      }
      if (swaps != (left != down))
        for (double& bulge : ring.bulges) bulge = -bulge;
    }
    const auto shape = build_shape(image);
    ASSERT_TRUE(shape) << map << ": " << to_string(shape.error());
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis) << map << ": " << to_string(axis.error());
    nodes.push_back(axis->nodes.size());
  }
  EXPECT_EQ(nodes, std::vector<std::size_t>(8, nodes.front()));
}

/// Moves vertices, scales bulges, or both, by some tolerances.
void disturb(Random& random, double size, int n, Ring& ring) {
  const std::int64_t kind = random.integer(0, 2);
  if (kind != 1)
    for (Vec2& p : ring.points)
      p = p + Vec2{random.between(-size, size), random.between(-size, size)};
  if (kind != 0)
    for (double& bulge : ring.bulges)
      bulge *= 1 + random.between(-size, size) * (random.chance(0.5) ? n : 1);
}

/// A bar with half circles at both ends, of 2 to 40 arcs each.
Ring bar_with_ends_of_arcs(Random& random) {
  const double half_length = random.power_of_ten(-1, 1), turn = random.between(0, 6);
  const Vec2 along{std::cos(turn), std::sin(turn)};
  Ring ring;
  for (int side = 0; side < 2; ++side) {
    const auto n = static_cast<int>(random.integer(2, 40));
    for (int i = 0; i <= n; ++i) {
      const double angle = std::numbers::pi * (static_cast<double>(i) / n + side - 0.5);
      const double x = std::cos(angle) + (side == 0 ? half_length : -half_length);
      ring.points.push_back(x * along + std::sin(angle) * left_of(along));
      ring.bulges.push_back(i < n ? std::tan(std::numbers::pi / (4.0 * n)) : 0);
    }
  }
  return ring;
}

/// Off by some tolerances.
void expect_verified(const Ring& ring, std::uint64_t seed, double tolerance = 0) {
  const auto shape = build_shape(Rings{ring});
  ASSERT_TRUE(shape) << seed << ": " << to_string(shape.error());
  const auto axis = compute(*shape, {.tolerance = tolerance, .threads = 1});
  ASSERT_TRUE(axis) << seed << ": " << to_string(axis.error());
  const Certificate certificate = verify(*shape, *axis, {.threads = 1});
  EXPECT_TRUE(certificate.passed) << seed << ": " << certificate.failures.front();
}

TEST(CircleOfArcs, OffBySomeTolerancesIsVerified) {
  const std::uint64_t count = shape_count(40, 50);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    Random random(seed);
    const auto n = static_cast<int>(random.integer(4, 100));
    Ring ring = arcs_of_circle(n);
    const double size = random.power_of_ten(-14.3, -12.7);
    disturb(random, size, n, ring);
    expect_verified(ring, seed);
  }
}

/// Contracted ties stay contracted, even if closer ties would turn an edge around.
TEST(CircleOfArcs, OfThousandsIsVerified) {
  constexpr double size = 3e-14;
  constexpr std::uint64_t seed = 10;
  Random random(seed);
  Ring ring = arcs_of_circle(3000);
  for (Vec2& p : ring.points) p = (1 + random.between(-size, size)) * p;
  expect_verified(ring, seed);
}

/// Four reflex vertices and an end of an arc on one circle: the node there stays where it touches
/// them all, though the arc's other end is a few tolerances away, and the next node is near.
TEST(ArcOnACircle, OfVerticesIsTouchedInOneEnd) {
  Ring ring;
  ring.points = {{-1.5, -1.5},
                 {1.5, -1.5},
                 {1.3053232526290575, 0.5060940684753157},
                 {0.9249578500640337, 0.3800696983513692},
                 {1.2925036938674672, 0.5379908933606148},
                 {0.9214568408215073, 0.3884807466313698},
                 {0.9212125692973304, 0.38905963831858953},
                 {1.2856412281863974, 0.5541900688278091},
                 {0.9153677042433385, 0.4026188843413364},
                 {1.2694600998787573, 0.5903143694810545},
                 {0.8977509765824532, 0.44050333034522254},
                 {1.2487044226011204, 0.6330381228460118},
                 {0.8859608765266932, 0.4637599867000536},
                 {1.2271127524012064, 0.6739393836943612},
                 {1.5, 1.5},
                 {-1.5, 1.5}};
  ring.bulges.assign(ring.points.size(), 0);
  ring.bulges[5] = 0.00015707961770071823;
  expect_verified(ring, 0);
}

TEST(BarWithEndsOfArcs, OffBySomeTolerancesIsVerified) {
  const std::uint64_t count = shape_count(40, 50);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    Random random(seed);
    Ring ring = bar_with_ends_of_arcs(random);
    disturb(random, random.power_of_ten(-14.3, -12), 40, ring);
    expect_verified(ring, seed);
  }
}

/// The walk begins where a bar's straight side begins, in the centre of these arcs, and they lie
/// behind it.
TEST(BarWithEndsOfArcs, WhereTheWalkBeginsIsVerified) {
  Ring ring;
  ring.points = {{-0.96966539587239797, -0.33571651744046893},
                 {1.0188714576936357, -0.12189139728453782},
                 {0.96966539587239808, 0.33571651744046882},
                 {0.60285231976218923, 1.0074565004855984},
                 {-1.0188714576936357, 0.12189139728453796}};
  ring.bulges = {1, 0, 0.19891236737987572, 0.66817863791929888, 0};
  expect_verified(ring, 1597);
}

/// An arc so short that its own curvature means nothing belongs to the circle around it.
TEST(CircleOfArcs, WithASliverIsACircle) {
  Ring ring;
  for (const double angle : {0.0, 1e-6, 2.0, 4.0})
    ring.points.push_back({std::cos(angle), std::sin(angle)});
  ring.bulges = {(1 + 1e-9) * std::tan(1e-6 / 4), std::tan((2.0 - 1e-6) / 4), std::tan(0.5),
                 std::tan((2 * std::numbers::pi - 4) / 4)};
  const auto shape = build_shape(Rings{ring});
  ASSERT_TRUE(shape) << to_string(shape.error());
  EXPECT_EQ(shape->points.size(), 2);
  EXPECT_EQ(failures_of(ring), "");
}

/// A disk at one end of an arc, next to the arc's own, touches both of the arc's ends, and is no
/// leaf.
TEST(BarWithEndsOfArcs, WhereALeafTouchesBothEndsOfAnArcIsVerified) {
  Ring ring;
  ring.points = {{0.59080603709916502, -0.80698920971998311},
                 {-0.56331051568408408, 0.82641673569159702},
                 {-0.59080603710689006, 0.80698920973620503},
                 {0.56331051564328505, -0.82641673570970009}};
  ring.bulges = {0.99999999996855338, 0, 0.99999999998062983, 0};
  expect_verified(ring, 20261127001780);
}

/// A bump of two tolerances has corners as its tangents say: it is no cusp, whose edges lie next to
/// each other.
TEST(CircleOfArcs, WithABumpIsVerified) {
  expect_verified({{{0.9722596531310993, 0.23390418314649244},
                    {0.97225965313108109, 0.23390418314652842},
                    {-0.88625470178744858, 0.46319823354547496},
                    {0.36301720658775555, -0.93178243582997144}},
                   RingRole::any,
                   {1, 0.69294477207019034, 0.69294477207019034, 0.37508583931414247}},
                  0);
  expect_verified({{{0.57793090201394803, 0.81608570168662076},
                    {-0.68115172183368922, 0.73214228934203796},
                    {0.57110027622027071, -0.82088030461273975},
                    {0.5711002762203089, -0.82088030461272909}},
                   RingRole::any,
                   {0.35529188901319231, 0.93164487430211262, 1, 0.51983450297614342}},
                  1);
}

/// What leads to a contracted edge's node has to lie on its two sites' bisector at both ends: next
/// to an arc's centre, a disk may touch the arc's end and be far from its circle.
TEST(OffsetOfTwoArcs, WithAnEdgeNextToACentreIsVerified) {
  expect_verified({{{0.33068278786779215, -0.37503196521959314},
                    {0.33098309646673801, -0.37476652719680609},
                    {0.19215501552078182, 0.46160213511063325},
                    {0.19215498745412196, 0.46160214679417572},
                    {0.19215498699801345, 0.46160214698404384},
                    {-0.49690261854007689, 0.055568595595895422}},
                   RingRole::any,
                   {-0.00020040126220642154, 0.55401878340404453, -1.5200681386496097e-08, 0,
                    0.49978091339804298, 0.68590040045235745}},
                  0);
}

/// An edge that turns around a focus, between arcs of nearly one circle, is known by twice the
/// digits only.
TEST(OffsetOfTwoArcs, WithAnEdgeAroundAFocusIsVerified) {
  expect_verified(
      {{{7.727903130671798, 1.154547557025793},
        {7.727903129881271, 1.1545475574086819},
        {5.891409769385595, 0.11918797655280139},
        {5.891234714571764, 0.11723913189827719},
        {6.836177260605704, -1.2389959472657575},
        {6.8361781434786515, -1.238996184215118},
        {8.438969384128152, -0.17918866558357815},
        {8.438975445801681, -0.17914567059966424}},
       RingRole::any,
       {7.763796838216026e-10, 0.5234098722970584, 0.0017294941754341733, 0.36505961584298346,
        8.079737992472294e-07, 0.4504345403849451, 3.837843263362668e-05, 0.3258096187733731}},
      1);
}

/// Where few digits are left, what the walk takes for one node may leave an edge that runs
/// backward, or one that is no longer than they tell: the axis is measured then.
TEST(OffsetOfTwoArcs, WhoseEdgesRunBackwardInDoubleIsVerified) {
  expect_verified({{{9007199953522936, 1038028424559516.9},
                    {9007199953522902, 1038028424559517},
                    {9007199224742773, 1038028424559751.5},
                    {9007199224742740, 1038028424559751.6},
                    {9007182920713663, -1038028424431238.8},
                    {9007199305507164, -1038028424559750.8},
                    {9007199305507204, -1038028424559750.9},
                    {9007200945890298, -1038028424558374.4}},
                   RingRole::any,
                   {0, 1.7552027279723816e-07, 0, 0.9999921177683454, 3.946133148692011e-06, 0,
                    3.9507181479557063e-07, 0.9999988488129217}},
                  2);
  expect_verified(
      {{{948.60266680623181, 0.23060899701292056},
        {948.60122188101582, 0.23035534711074868},
        {950.10229445846664, -0.8501248671524394},
        {950.55727543268893, -0.19114337873330975},
        {950.5572754332419, -0.19114337589387756},
        {949.33805169252173, 0.97134801051491404}},
       RingRole::any,
       {0, 0.66885843198875006, 0.20893700130651605, 0, 0.54730303023831184, 0.28164532713707596}},
      3);
}

/// A joint that is smooth up to rounding leaves open how large the disk is that touches it.
TEST(TwoArcs, WhoseJointsTurnByLessThanTheToleranceAreVerified) {
  expect_verified({{{1.8076067910711346, 12.750235234121801},
                    {1.8076067858669418, 12.750235239080721},
                    {1.0774562195980519, 11.027087048172708},
                    {1.0774562181862828, 11.027087045687491}},
                   RingRole::any,
                   {0, 1.4456293588247482, 0, 0.69174023760270664}},
                  4);
  expect_verified({{{4.1038259319647228, -0.71960220589301682},
                    {4.1038259326792819, -0.71960220520349683},
                    {3.4151760934462532, 0.99998354499952646},
                    {3.4151760934462532, 0.99998354499952646},
                    {2.4731905538386201, 0.35133760241442313},
                    {2.4731905538250789, 0.35133760238125272},
                    {3.0349939869672289, -0.92724896213557939},
                    {3.0349939869679412, -0.9272489621356661}},
                   RingRole::any,
                   {0, 0.67256102285737018, 0, 0.31414565947442402, 0, 0.40696855995322784, 0,
                    0.29606348469197108}},
                  5);
}

/// As the doubles have them, two edges join at a convex angle that counts as smooth: where the axis
/// leads to that joint, it ends as soon as all that follows is touched, but no earlier.
TEST(OffsetOfTwoArcs, ALeafTowardsAJointIsNoSpur) {
  expect_verified({{{10.85420087843892, -0.0907826151912458},
                    {10.854200880427058, -0.09078264329471042},
                    {12.739421429765944, -1.1369504428049462},
                    {12.93388929886824, 1.0103049756929359},
                    {12.933889283389819, 1.0103049878945898}},
                   RingRole::any,
                   {2.4832033023774528e-08, 0.5421217873034916, 0.5421217873034913,
                    1.7371709918403234e-08, 0.6512410719417552}},
                  6);
  expect_verified({{{74.99999182849578, 75.49857746037526},
                    {75.00000817150423, 75.49857746037526},
                    {75.00144861425069, 75.49858370272217},
                    {75, 76.50141004318112},
                    {74.99855138574931, 75.49858370272217}},
                   RingRole::any,
                   {0.0028890811089673854, -0.0007222714082318368, 0.9985565118222661,
                    0.9985565118222661, -0.0007222714082318368}},
                  7);
  expect_verified(
      {{{165.49394240344597, 153.98420145644207},  {165.49182111232918, 153.98579242477967},
        {165.49023600484185, 153.98698133970908},  {165.49023600480342, 153.98698133973792},
        {34.78579345956741, 252.0153132486649},    {-5.958649430810892, 246.19467855003944},
        {-103.98698133973791, 115.49023600480344}, {-98.16634664111243, 74.74579311442513},
        {32.53809590412359, -23.282538794501882},  {32.53809590417016, -23.28253879453682},
        {32.53968109262101, -23.283727601561026},  {32.54180238376793, -23.285318569921223},
        {32.543387491273094, -23.28650748486403},  {32.54338749127328, -23.28650748486416},
        {163.2425384493596, -121.3108707034289},   {203.9869813397379, -115.49023600480344},
        {302.0153132486649, 15.214206540432583},   {296.1946785500395, 55.9586494308109},
        {165.4955275919531, 153.98301264937567},   {165.49552759191468, 153.9830126494045}},
       RingRole::any,
       {-3.404156085343527e-05,
        1.7020780823818424e-05,
        0,
        0,
        0.41421356237309515,
        0,
        0.4142135623730951,
        0,
        0,
        1.702078106182409e-05,
        -3.404156133686823e-05,
        1.7020781015545212e-05,
        0,
        0,
        0.4142135623730947,
        0,
        0.4142135623730948,
        0,
        0,
        1.7020781253469083e-05}},
      8);
}

/// A disk next to the end of a slot touches the end's joints within the tolerance, but no more.
TEST(BarWithEndsOfArcs, AShortPieceBeforeAnEndKeepsItsLeaf) {
  const Ring slot{{{0, 0.025670824191800886},
                   {1e-11, 0.025670824191800886},
                   {4, 0.02567},
                   {4, 0.0256718},
                   {-2e-13, 0.0256718}},
                  RingRole::any,
                  {-1e-10, 2e-10, 1, -7e-10, 0.99999976}};
  expect_verified(slot, 13);
}

/// A disk next to the centre of an arc touches one end of it long before the rest.
TEST(BarWithEndsOfArcs, OfTwoQuartersHasALeafInACentre) {
  expect_verified({{{0, 0}, {40, 0}, {9e-11, 2}, {-1, 1}},
                   RingRole::any,
                   {0, 0.4, 0.414213562373, 0.414213562373}},
                  14);
}

/// Ties that are far coarser than rounding may join nodes that are not ties.
TEST(Gear, WithACoarseToleranceIsVerified) {
  const Ring gear{
      {{1, 0},
       {0.6, 0.82},
       {0.31, 1},
       {-0.6, 0.8},
       {-0.81, 0.6},
       {-0.9453283872, -0.32611997},
       {-0.809016994375, -0.58778525},
       {0.01803598738, -0.9998373384},
       {0.018035987, -0.9998373362},
       {0.30901699, -0.9510565142443409},
       {0.3090169944, -0.95105652},
       {0.9564752425, -0.2918134858},
       {1, -0.3}},
      RingRole::any,
      {0.24, 0.07, 0.24, 0.074, 0.245, 0.0742, 0.2448531042, 0, 0.0742, 0, 0.2448531042, 0, 0.07}};
  expect_verified(gear, 15, 4.57e-5);
}

/// A box of arcs rounds: a disk may be larger than half of it.
TEST(OffsetOfTwoArcs, ADiskThatFillsABoxThatIsRounded) {
  expect_verified({{{-11.399990472330394, 74.79999285424833},
                    {-11.3999904724743, 74.79999285435571},
                    {-11.399990472330922, 74.79999285424763}},
                   RingRole::any,
                   {0.9975525573594629, 0.997535748127191, -2.215128374736204e-13}},
                  9);
}

/// Between two sites that are nearly tangent, disks touch both across the edge: its control point
/// is the one that does not lead back around a vertex, a centre or along a segment.
TEST(OffsetOfTwoArcs, AnEdgeBetweenTangentSitesLeadsForward) {
  expect_verified(
      {{{59, 59.99999999726329},
        {59.00000000000006, 59.99999999726328},
        {59, 59.99999999926328},
        {58.99999999999994, 59.99999999726328}},
       RingRole::any,
       {-1.4210748015984084e-14, 0.9999700916468893, 0.9999700916468893, -1.4210748015984084e-14}},
      10);
  expect_verified(
      {{{9.313225103357973e-10, 1.1498009062312752e-10},
        {9.31322483237504e-10, -1.149800906231092e-10},
        {9.313224832376929e-10, -1.149800906231092e-10},
        {9.313225855390669e-10, -1.1498009062314496e-10},
        {9.313225855808364e-10, -1.14980090623145e-10},
        {1.0463026652386242e-09, 3.762251649843172e-17},
        {9.313225103428582e-10, 1.1498009062312752e-10}},
       RingRole::any,
       {0.9999993231107002, 1.4562901504636006e-10, 2.2243279964854748e-07, 3.220019332692634e-08,
        0.4142136302779207, 0.4142136302599498, 5.443193311158671e-09}},
      11);
  expect_verified({{{0.49999987885570385, 0.12169870784943437},
                    {0.49999987886291997, 0.12169870784943437},
                    {0.4999999989543282, 0.12169870784937593},
                    {0.5000000010456718, 0.12169870784937593},
                    {0.50000012113708, 0.12169870784943437},
                    {0.5000001211442962, 0.12169870784943437},
                    {0.8772343123890195, 0.1216987078494344},
                    {0.8783012921505656, 0.1227656876109807},
                    {0.8783012921505665, 0.8772343123890186},
                    {0.8772343123890204, 0.8783012921505647},
                    {0.12276568761097961, 0.8783012921505647},
                    {0.12169870784943349, 0.8772343123890186},
                    {0.1216987078494344, 0.12276568761098053},
                    {0.12276568761098053, 0.1216987078494344}},
                   RingRole::any,
                   {-0, -2.4669819904011044e-07, 4.900148235399343e-07, -2.4669819904011044e-07, -0,
                    -0, 0.41421356237309503, -0, 0.41421356237309503, -0, 0.41421356237309503, -0,
                    0.41421356237309503, -0}},
                  12);
}

/// The axis of an image is the image of the axis, to the last digit. One vertex is moved, as a bar
/// that is its own image has several axes within the tolerance.
TEST(BarWithEndsOfArcs, ImagesHaveTheSameAxis) {
  const std::uint64_t count = shape_count(60, 50);
  for (std::uint64_t seed = 20261127100000; seed < 20261127100000 + count; ++seed) {
    Random random(seed);
    Ring ring = bar_with_ends_of_arcs(random);
    disturb(random, random.power_of_ten(-16, -10), 40, ring);
    ring.points[0] = ring.points[0] + Vec2{1e-12, 0};
    const auto shape = build_shape(Rings{ring});
    ASSERT_TRUE(shape) << seed;
    const auto axis = compute(*shape, {.threads = 1});
    ASSERT_TRUE(axis) << seed << ": " << to_string(axis.error());
    for (const Symmetry& symmetry :
         {Symmetry{.name = "mirrored", .xx = -1},
          Symmetry{.name = "turned", .xx = 0, .xy = -1, .yx = 1, .yy = 0},
          Symmetry{.name = "restarted", .restart = 3},
          Symmetry{.name = "all", .xx = 0, .xy = 2, .yx = 2, .yy = 0, .restart = 1}}) {
      const auto image = build_shape(transformed(Rings{ring}, symmetry));
      ASSERT_TRUE(image) << seed << ", " << symmetry.name;
      const auto other = compute(*image, {.threads = 1});
      ASSERT_TRUE(other) << seed << ", " << symmetry.name;
      ASSERT_EQ(other->nodes.size(), axis->nodes.size()) << seed << ", " << symmetry.name;
      for (std::size_t i = 0; i < axis->nodes.size(); ++i) {
        const Disk &own = axis->nodes[i].disk, &there = other->nodes[i].disk;
        EXPECT_EQ(there.center, symmetry(own.center)) << seed << ", " << symmetry.name;
        EXPECT_EQ(there.radius, symmetry.scale() * own.radius) << seed << ", " << symmetry.name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Arcs, NearCircle, testing::Values(3, 4, 5, 6, 7, 8, 12, 24, 64));

#ifndef MEDIAL_SANITIZED
/// Its sides turn by less than double resolves in three neighbours' disks; 256 bits for each of
/// them would take minutes.
TEST(NearCircles, OfVeryManySidesAreMeasuredInDouble) {
  constexpr std::size_t n = 500'000;
  const auto shape = build_shape(regular_polygon(n));
  ASSERT_TRUE(shape.ok());
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis.ok()) << to_string(axis.error());
  EXPECT_EQ(axis->method, "disks");
  EXPECT_EQ(axis->nodes.size(), n + 1);
  EXPECT_LT(axis->statistics.exact_precise, 1000U);
}
#endif

}  // namespace
}  // namespace medial::test
