// Options::exact: the numbers it decides with, its decisions, and that the default and exact axes
// have the same combinatorics. MEDIAL_PROPERTY_COUNT: how many random shapes (2,000 without it).

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "medial/compute.h"
#include "medial/verify.h"
#include "methods/exact/disk_bounds.h"
#include "methods/exact/numbers.h"
#include "support/nasty_check.h"
#include "support/random_shapes.h"
#include "support/same_graph.h"

namespace medial::test {
namespace {

// ---- Numbers.

/// The bound of a product follows from the sizes of its factors, not of what they came from.
TEST(Bounded, IsAsSmallAsADifference) {
  using Number = Bounded<exact::Precise>;
  const Number small = Number(1 + 0x1p-50) - Number(1.0);
  EXPECT_LE((small * Number(exact::Precise(1.0), 0x1p-200L)).error, 0x1.1p-250L);
}

exact::Precise precise(const Twofold& x) { return exact::Precise(x.high) + x.low; }

/// Sums, products, quotients, roots and small differences of random numbers, and in 256 bits.
template <class Real>
void check_bounds(std::uint64_t seed, double most) {
  using Number = Bounded<Real>;
  using Reference = Bounded<exact::Precise>;
  Random random(seed);
  for (int i = 0; i < 4000; ++i) {
    const double first = random.between(-1, 1);
    Number x(first);
    Reference y(first);
    for (int step = 0; step < 12; ++step) {
      const double other = random.between(0.5, 2) * (random.chance(0.3) ? -1 : 1);
      const auto nearest = static_cast<double>(x.value);
      switch (random.integer(0, 4)) {
        case 0:
          x = x + Number(other);
          y = y + Reference(other);
          break;
        case 1:
          x = x * Number(other);
          y = y * Reference(other);
          break;
        case 2:
          x = x / Number(other);
          y = y / Reference(other);
          break;
        case 3:
          x = root_of(x * x + Number(0.25));
          y = root_of(y * y + Reference(0.25));
          break;
        default:
          x = (x - Number(nearest)) + Number(0.125);
          y = (y - Reference(nearest)) + Reference(0.125);
      }
      const auto small = x - Number(static_cast<double>(x.value));
      const auto same = y - Reference(static_cast<double>(x.value));
      // Of an exact zero the reference may not know the sign.
      if (const auto sign = small.sign(); sign && (*sign != 0 || same.sign())) {
        ASSERT_EQ(sign, same.sign());
      }
    }
    const exact::Precise off = abs(precise(x.value) - y.value);
    EXPECT_LE(off, exact::Precise(x.error) * (1 + 1e-9) + 1e-70) << i;
    EXPECT_LT(x.error, most);
  }
}

TEST(Bounded, BoundsItsErrors) { check_bounds<Twofold>(8, 1e-27); }

TEST(Twofold, KnowsItsDigitsWhereNumbersAreTiny) {
  // Below the normal numbers a rest is lost, and the bound says so.
  const Bounded<Twofold> tiny(0x1.123456789abcdp-540), other(0x1.fedcba9876543p-520);
  const auto product = tiny * other;
  const exact::Precise exact = precise(tiny.value) * precise(other.value);
  EXPECT_LE(abs(precise(product.value) - exact), exact::Precise(product.error));
  const Bounded<Twofold> third = Bounded<Twofold>(1.0) / Bounded<Twofold>(3.0);
  EXPECT_EQ((third * Bounded<Twofold>(3.0) - Bounded<Twofold>(1.0)).sign(), std::nullopt);
  EXPECT_EQ((Bounded<Twofold>(0x1p100) + Bounded<Twofold>(0x1p-6) - Bounded<Twofold>(0x1p100) -
             Bounded<Twofold>(0x1p-6))
                .sign(),
            0);
}

// ---- Decisions.

/// A segment, vertex or arc that a disk touches in a direction, but for `off`.
exact::ExactSite touching_site(Random& random, const Disk& disk, double angle, double off) {
  const auto at = [](double a) { return Vec2{std::cos(a), std::sin(a)}; };
  const Vec2 foot = disk.center + (disk.radius + off) * at(angle);
  const double reach = disk.radius * std::pow(10, random.between(-6, 0));
  const auto kind = random.integer(0, 3);
  if (kind == 0) return {foot, foot, 0};
  const Vec2 along = at(angle + std::numbers::pi / 2);
  if (kind == 1) return {foot - reach * along, foot + random.between(0.1, 2) * reach * along, 0};
  const double half = random.between(0.01, 1.5), bend = kind == 2 ? 1 : -1;
  const double own = disk.radius * (kind == 2 ? random.between(1.1, 20) : random.between(0.1, 20));
  const Vec2 center = foot - bend * own * at(angle);
  const double middle = kind == 2 ? angle : angle + std::numbers::pi;
  return {center + own * at(middle - bend * half), center + own * at(middle + bend * half),
          bend * std::tan(half / 2)};
}

/// Four sites that one disk all but touches, counter-clockwise, none joined to another one.
exact::SiteLoops nearly_touched(Random& random) {
  const Disk disk{{random.between(-1, 1), random.between(-1, 1)},
                  std::pow(10, random.between(-5, -0.5))};
  std::array<double, 4> angles;
  for (double& angle : angles) angle = random.between(0, 2 * std::numbers::pi);
  if (random.chance(0.3)) angles[1] = angles[0] + std::pow(10, random.between(-7, -2));
  std::sort(angles.begin(), angles.end());
  exact::SiteLoops loops;
  std::vector<exact::ExactSite> sites;
  for (const double angle : angles) {
    const double off = random.between(-1, 1) * std::pow(10, random.between(-19, -9));
    sites.push_back(touching_site(random, disk, angle, off));
    loops.next.push_back(static_cast<std::uint32_t>(loops.next.size()));
  }
  loops.sites.work_out = [sites](std::uint32_t i) { return sites[i]; };
  loops.passes.assign(4, false);
  loops.loop_begin = {0, 4};
  return loops;
}

/// What the search of an event asks of disks that touch three of the sites: none where that is
/// open.
template <class Real>
struct Answers {
  std::optional<exact::DiskBounds<Real>> first, second;
  std::array<int, 6> signs{};

  explicit Answers(const exact::SiteLoops& loops) {
    first = exact::disk_bounds<Real>(loops, {0, 1, 2});
    second = exact::disk_bounds<Real>(loops, {0, 1, 3});
    if (!first || !second) return;
    const auto sign = [](std::optional<int> known) { return known.value_or(7); };
    signs = {exact::clearance(loops.sites[3], *first),
             exact::clearance(loops.sites[2], *second),
             sign(exact::further_along(loops.sites[0], *first, *second)),
             sign(exact::further_along(loops.sites[1], *second, *first)),
             exact::may_have_foot(loops.sites[2], *first) ? 1 : 0,
             exact::may_have_foot(loops.sites[3], *second) ? 1 : 0};
  }
};

TEST(Twofold, DecidesAs256BitsDo) {
  Random random(1118);
  int decided = 0, with_disks = 0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const exact::SiteLoops loops = nearly_touched(random);
    const std::uint64_t before = Bounded<Twofold>::open_signs;
    const Answers<Twofold> fast(loops);
    if (Bounded<Twofold>::open_signs != before) continue;
    ++decided;
    const Answers<exact::Precise> sure(loops);
    ASSERT_EQ(fast.first.has_value(), sure.first.has_value()) << i;
    ASSERT_EQ(fast.second.has_value(), sure.second.has_value()) << i;
    ASSERT_EQ(fast.signs, sure.signs) << i;
    if (!fast.first) continue;
    ++with_disks;
    const auto off = [](const auto& a, const auto& b) {
      return abs(precise(a.value) - b.value) <= exact::Precise(a.error) * (1 + 1e-9) + 1e-60;
    };
    EXPECT_TRUE(off(fast.first->center.x, sure.first->center.x)) << i;
    EXPECT_TRUE(off(fast.first->center.y, sure.first->center.y)) << i;
    EXPECT_TRUE(off(fast.first->radius, sure.first->radius)) << i;
  }
  EXPECT_GE(decided, count * 9 / 10);
  EXPECT_GE(with_disks, count / 2);
}

// Three lines leave open where a disk is in a flat corner; the corner's bisector does not.
TEST(Twofold, KnowsDisksInFlatCorners) {
  const double up = 0x1p-52;
  const std::vector<exact::ExactSite> sites{
      {{-1, 0}, {0, -up}}, {{0, -up}, {1, 0}}, {{1, 1}, {-1, 1}}, {{0.25, 1}, {0.25, 1}}};
  exact::SiteLoops loops;
  loops.sites.work_out = [&sites](std::uint32_t i) { return sites[i]; };
  loops.next = {0, 1, 2, 3};
  loops.passes.assign(4, false);
  loops.loop_begin = {0, 4};
  for (const std::uint32_t third : {2u, 3u}) {
    const auto fast = exact::disk_bounds<Twofold>(loops, {0, 1, third});
    const auto sure = exact::disk_bounds<exact::Precise>(loops, {0, 1, third});
    ASSERT_TRUE(fast && sure) << third;
    EXPECT_LT(fast->center.x.error + fast->center.y.error + fast->radius.error, 1e-28) << third;
    EXPECT_LT(abs(precise(fast->radius.value) - sure->radius.value), 1e-28) << third;
    EXPECT_NEAR(fast->center.x.value.high, 0, up) << third;
  }
  // In the other order around the disk there is none.
  EXPECT_FALSE(exact::disk_bounds<exact::Precise>(loops, {1, 0, 2}));
}

/// Tips of a tree's and of a snowflake's branch: arcs around an apex of which two are as good as of
/// one circle, and joints that are off by rounding.
/// x, y, bulge.
const std::vector<std::array<double, 3>> tip_of_tree = {
    {-0.12956863570877175, 1.149687310151162, 0.0297192819529369},
    {-0.12967040923045578, 1.1497188380083372, 0.029100084166277181},
    {-0.1296969024363292, 1.1497237357564365, 0.065044879358430535},
    {-0.12974329034617388, 1.1497234905337455, 0.047481544528033978},
    {-0.12975763158282441, 1.1497201313443164, 0.098171332253182308},
    {-0.12977807193911922, 1.1497084091810417, 0.24104188154956807},
    {-0.12978959647427049, 1.1496796664177249, 0.098171334890407469},
    {-0.12978291624539257, 1.1496570701383548, 0.047481542776925338},
    {-0.12977486817503389, 1.1496447338602391, 0.065044881113014777},
    {-0.12974149900652809, 1.1496125096923784, 0.030618963789629874},
    {-0.12971773950133159, 1.149597051033856, 0}};
const std::vector<std::array<double, 3>> tip_of_snowflake = {
    {-1.026693619401996, 0.88625682889180801, 0.032594892013821833},
    {-1.0264735687725155, 0.88624637651791627, 0.0247715409281518},
    {-1.0263832756037272, 0.8862524565871357, 0.054427897904066297},
    {-1.0262195241026142, 0.88629002436494864, 0.047368719203141188},
    {-1.0261274005486967, 0.88633215515061237, 0.047368718511556621},
    {-1.0260448524424783, 0.88639087109458792, 0.054427898596116485},
    {-1.0259304420405655, 0.88651390016672527, 0.024771540843309774},
    {-1.0258800299620139, 0.8865890563096841, 0.032594892098687961},
    {-1.0257790566683505, 0.88678485193226908, 0}};

/// A tip less `cut` arcs on both sides.
Ring part_of(const std::vector<std::array<double, 3>>& tip, std::size_t cut) {
  Ring ring;
  for (std::size_t i = cut; i + cut < tip.size(); ++i) {
    ring.points.push_back({tip[i][0], tip[i][1]});
    ring.bulges.push_back(i + cut + 1 < tip.size() ? tip[i][2] : 0);
  }
  return ring;
}

// ---- Axes.

std::vector<std::string> compare_exact(const Rings& rings) {
  const auto shape = build_shape(rings);
  if (!shape) return {to_string(shape.error())};
  Options options;
  const auto plain = compute(*shape, options);
  options.exact = true;
  const auto certain = compute(*shape, options);
  for (const auto* one : {&plain, &certain})
    if (!*one) return {to_string(one->error())};
  std::vector<std::string> failures;
  const std::string differs = difference(*shape, *plain, *certain, plain->tolerance);
  if (!differs.empty()) failures.push_back(differs);
  const Certificate certificate = verify(*shape, *certain);
  failures.insert(failures.end(), certificate.failures.begin(), certificate.failures.end());
  return failures;
}

const std::vector<std::string> no_failures;

/// Two methods that share nothing find one graph of every polygon, up to ties within the tolerance;
/// and where one of them leaves it open which way such a tie goes, exact decisions of both agree.
TEST(ExactAxis, OfLeeIsThatOfDisks) {
  const std::uint64_t count = shape_count(200, 20);
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto shape = build_shape(random_shape(first_seed() + i).rings);
    if (!shape) continue;
    const auto disks = compute(*shape, {.threads = 1});
    const auto exact = compute(*shape, {.method = method::Lee{}, .exact = true, .threads = 1});
    const auto lee = compute(*shape, {.method = method::Lee{}, .threads = 1});
    ASSERT_TRUE(lee.ok() && exact.ok() && disks.ok()) << first_seed() + i;
    EXPECT_EQ(exact->method, "disks");
    for (const auto* other : {&disks, &exact})
      EXPECT_EQ(difference(*shape, *lee, **other, lee->tolerance), "")
          << "random_shape(" << first_seed() + i << ")";
  }
}

/// A wall nearly on one line, with a notch in it: a disk beside the notch touches both of its ends
/// and the wall on both sides up to rounding, of which each joint lies behind the other's line.
/// And where the wall leaves open how far along it a disk touches, no foot moves backward.
TEST(ExactAxis, OfNotchesInAWall) {
  Random random(1);
  for (int i = 0; i < 90; ++i) {
    const double width = std::pow(10, -random.between(6, 9)), far = random.chance(0.5) ? 119 : 0;
    const double lean = 1e-6 * random.between(-1, 1), up = random.between(0.3, 0.7);
    Ring ring{{{0, 1},
               {0, up},
               {-width * random.between(0.5, 1.5), up},
               {-width * random.between(0.5, 1.5), up - width},
               {lean * width, up - width},
               {lean, 0},
               {1, 1e-3 * random.between(-1, 1)},
               {1.1, 1.2}}};
    for (Vec2& p : ring.points) p = p + Vec2{-far, 0.3 * far};
    const auto shape = build_shape(std::vector<Ring>{ring});
    ASSERT_TRUE(shape.ok());
    std::vector<MedialAxis> certain;
    for (const Method& method : {Method(method::Disks{}), Method(method::Lee{})}) {
      Options options{.method = method, .threads = 1};
      EXPECT_TRUE(verify(*shape, compute(*shape, options).value(), {.threads = 1}).passed) << i;
      options.exact = true;
      const auto axis = compute(*shape, options);
      ASSERT_TRUE(axis.ok()) << i;
      certain.push_back(*axis);
    }
    EXPECT_EQ(difference(*shape, certain[0], certain[1], certain[0].tolerance), "") << i;
  }
}

TEST(ExactAxis, OfFixedShapes) {
  for (const auto& rings :
       {rectangle(8, 3), rectangle(3, 3), l_shape(2), t_shape(2), u_shape(3), cross_shape(2),
        comb(5), maze(400), hole_grid(4), nested_squares(6), needle(1e-6), spiral(40), blob(60)}) {
    EXPECT_EQ(compare_exact(rings), no_failures) << to_wkt(rings);
  }
}

TEST(ExactAxis, OfConcentricHalfCircles) {
  // Each edge of the axis turns by a half circle.
  Rings rings;
  for (const double radius : {8.0, 10.0}) {
    Ring& ring = rings.emplace_back();
    ring.points = {{12 - radius, 12}, {12 + radius, 12}};
    ring.bulges = {1, 1};
  }
  EXPECT_EQ(compare_exact(rings), no_failures);
}

TEST(ExactAxis, KeepsTrueTiesAndDividesOthers) {
  const auto nodes_of = [](const Rings& rings) {
    EXPECT_EQ(compare_exact(rings), no_failures);
    return compute(*build_shape(rings), {.exact = true})->nodes.size();
  };
  EXPECT_EQ(nodes_of(rectangle(8, 8)), 5u);
  // A corner moved by one ulp: default precision calls it a tie.
  EXPECT_EQ(nodes_of(rectangle(8, std::nextafter(8.0, 9.0))), 6u);
  // The vertices of a regular polygon, rounded, lie on no circle.
  EXPECT_GT(nodes_of(regular_polygon(24)), 25u);
  // A disk that touches four edges, whose centre is not the same in doubles for each three of them.
  const Ring box{{{0, -4},
                  {10, -1},
                  {24, -4},
                  {24, 4},
                  {10, 1},
                  {0, 4},
                  {0, 0.4},
                  {-0.6, 0.4},
                  {-0.6, -0.4},
                  {0, -0.4}}};
  EXPECT_EQ(nodes_of({box}), 14u);
}

/// Triangles that touch each other in a square: two nodes whose disks round to the same doubles in
/// one of both images only.
TEST(ExactAxis, JoinsNoNodesByHowTheyAreRounded) {
  const Rings rings{
      {{{0, 0},
        {0.6000000000000001, 0},
        {0.6000000000000001, 0.6000000000000001},
        {0, 0.6000000000000001}}},
      {{{0.30000000000000004, 0.2}, {0.4, 0.2}, {0.30000000000000004, 0.30000000000000004}}},
      {{{0.4, 0.1}, {0.5, 0.2}, {0.4, 0.2}}}};
  const Finding finding = examine_nasty(rings, {.exact = true});
  EXPECT_EQ(finding.fault, Fault::none) << finding.words;
  EXPECT_EQ(compute(*build_shape(rings), {.exact = true})->nodes.size(), 20u);
}

template <class Generate>
void check_random(std::uint64_t count, const Generate& generate) {
  int failed = 0;
  for (std::uint64_t seed = 0; seed < count && failed < 5; ++seed) {
    const RandomShape shape = generate(seed);
    const auto failures = compare_exact(shape.rings);
    if (failures.empty()) continue;
    ++failed;
    ADD_FAILURE() << "seed " << seed << ", " << shape.kind << ": " << failures[0];
  }
}

TEST(ExactAxis, OfRandomPolygons) { check_random(shape_count(33), random_shape); }
TEST(ExactAxis, OfRandomPolygonsOnGrids) { check_random(shape_count(10), random_integer_shape); }
TEST(ExactAxis, OfRandomArcs) { check_random(shape_count(25), random_arc_shape); }

/// Gears whose arcs have one circle up to rounding: a disk near the centre may touch such a
/// circle where its arc is not.
TEST(ExactAxis, OfGearsAroundTheirHub) {
  for (const std::uint64_t seed : {184U, 1522U, 4185U, 5987U}) {
    const auto shape = build_shape(random_arc_shape(seed).rings);
    ASSERT_TRUE(shape);
    const auto plain = compute(*shape), axis = compute(*shape, {.exact = true});
    ASSERT_TRUE(plain && axis) << seed << ": " << to_string(axis.error());
    EXPECT_EQ(difference(*shape, *plain, *axis, plain->tolerance), "") << seed;
    const Certificate certificate = verify(*shape, *axis);
    EXPECT_TRUE(certificate.passed) << seed << ": " << certificate.failures[0];
  }
}

/// A disk touches a spiral of half circles on the normal of one of the two at a joint, the same one
/// in a mirror image; and next to a half circle a run of sites that bends away is met in one place.
TEST(ExactAxis, IsThatOfAMirrorImage) {
  constexpr double size = 2.6528094596219013e+35, off = 0x1p-50 * size;
  const Ring spiral{
      {{size, 0}, {-size, 0}, {1.5 * size, off}, {1.501 * size, 0}, {-1.001 * size, 0}},
      RingRole::any,
      {1, 1, 0, -1, -1}};
  constexpr double up = 9.150608435826071e-31, end = 1.006566927940868e-30;
  const Ring teeth{{{1.8301216871652142e-30, 0},
                    {1.830121687165205e-30, up},
                    {1.830121687165205e-30, end},
                    {9.150608435826162e-31, end},
                    {9.150608435826162e-31, up},
                    {9.15060843582598e-31, end},
                    {9.143294557304965e-45, up}},
                   RingRole::any,
                   {0, 0, 1, 0, 0, 0, 0}};
  for (const Ring& ring : {spiral, teeth}) {
    const Finding finding = examine_nasty(Rings{ring}, {.exact = true});
    EXPECT_EQ(finding.fault, Fault::none) << finding.words;
  }
}

/// A foot that passes the middle of a half circle is a node, unless the edges end there: of all
/// edges that are longer than ties, both axes have as many. Discs that touch an outer circle.
TEST(ExactAxis, DividesEdgesInTheMiddleOfHalfCircles) {
  struct Disc {
    double left, right, y;
  };
  Rings rings;
  for (const Disc disc : {Disc{-0.3333333333333333, 0.3333333333333333, 0},
                          Disc{-0.22222222222222215, -0.11111111111111116, -0.2222222222222222},
                          Disc{-0.14285714285714282, -0.09523809523809526, -0.2857142857142857},
                          Disc{-0.10256410256410253, -0.07692307692307693, -0.3076923076923077},
                          Disc{0.2222222222222222, 0.2444444444444444, -0.2222222222222222},
                          Disc{0.07692307692307693, 0.10256410256410253, -0.3076923076923077}})
    rings.push_back({{{disc.right, disc.y}, {disc.left, disc.y}}, RingRole::any, {1, 1}});
  const auto shape = build_shape(rings);
  ASSERT_TRUE(shape);
  const auto long_edges = [&](bool exact) {
    const auto axis = compute(*shape, {.exact = exact, .threads = 1});
    return std::count_if(axis->edges.begin(), axis->edges.end(), [&](const Edge& edge) {
      const Disk &a = axis->nodes[edge.node[0]].disk, &b = axis->nodes[edge.node[1]].disk;
      return distance(a.center, b.center) > 8 * axis->tolerance;
    });
  };
  EXPECT_EQ(long_edges(true), long_edges(false));
}

TEST(ExactAxis, OfTips) {
  for (const auto& tip : {tip_of_tree, tip_of_snowflake}) {
    for (const std::size_t cut : {0U, 1U, 2U}) {
      const Ring part = part_of(tip, cut);
      EXPECT_EQ(compare_exact({part}), no_failures) << part.points.size() << " points";
    }
  }
}

/// Disks at blunt joints of almost one circle touch both arcs, each where its own normal leads.
TEST(ExactAxis, OfNearCircles) {
  Random random(5);
  for (const int n : {3, 4, 5, 12, 24}) {
    for (int e = 3; e <= 9; ++e) {
      Ring ring;
      for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n + 0.1, size = std::pow(10.0, -e);
        ring.points.push_back({std::cos(angle), std::sin(angle)});
        ring.bulges.push_back(std::tan(std::numbers::pi / (2 * n)) *
                              (1 + random.between(-size, size)));
      }
      EXPECT_EQ(compare_exact({ring}), no_failures) << n << " arcs, off by 1e-" << e;
    }
  }
}

/// Of some joints that count as smooth no disk touches both arcs and a third. All of such an axis
/// may be some tolerances long: one disk in a thousand of the default's is off by more than one.
TEST(ExactAxis, OfCirclesOfFewDigitsIsTheDefaults) {
  const int count = static_cast<int>(shape_count(20));
  int loose = 0, all = 0;
  for (int i = 0; i < near_circles; i += std::max(1, near_circles / count), ++all) {
    const auto shape = build_shape(Rings{near_circle(i)});
    ASSERT_TRUE(shape) << i;
    const auto plain = compute(*shape, {.threads = 1});
    const auto certain = compute(*shape, {.exact = true, .threads = 1});
    ASSERT_TRUE(plain) << i << ": " << to_string(plain.error());
    ASSERT_TRUE(certain) << i << ": " << to_string(certain.error());
    EXPECT_TRUE(verify(*shape, *certain, {.threads = 1}).passed) << i;
    loose += difference(*shape, *plain, *certain, plain->tolerance).empty() ? 0 : 1;
    EXPECT_EQ(difference(*shape, *plain, *certain, 2 * plain->tolerance), "") << i;
  }
  EXPECT_LE(loose, all / 1000 + 1);
}

}  // namespace
}  // namespace medial::test
