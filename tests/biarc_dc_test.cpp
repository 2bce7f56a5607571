// The method biarc-dc: base cases, divisions, and agreement with the method disks.

#include "methods/biarc_dc/biarc_dc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "medial/medial.h"
#ifdef MEDIAL_BENCH_SHAPES
#include "papers/aichholzer_2009/shapes.h"
#include "papers/aichholzer_2009/stability.h"
#endif
#include "support/generate.h"
#include "support/generate_arcs.h"
#include "support/nasty.h"
#include "support/property.h"

namespace medial::test {
namespace {

using biarc_dc::BaseCase;
using biarc_dc::Report;

Options options_for(const Method& method) { return {.method = method, .threads = 1}; }

std::uint64_t count_of(const Report& report, BaseCase base_case) {
  return report.base_cases[static_cast<std::size_t>(base_case)];
}

/// How long the edges between each pair of sites are together. Rounding may move a tie's short
/// edges from one pair to another.
std::map<std::array<std::uint32_t, 2>, double> lengths_by_sites(const MedialAxis& axis) {
  std::map<std::array<std::uint32_t, 2>, double> lengths;
  for (const Edge& edge : axis.edges)
    lengths[{std::min(edge.site[0], edge.site[1]), std::max(edge.site[0], edge.site[1])}] +=
        length(axis, edge);
  return lengths;
}

/// Leaves but for those in the centre of an arc of which the branching beside it touches all.
std::size_t leaf_count(const MedialAxis& axis, double together) {
  std::size_t count = 0;
  for (const Edge& edge : axis.edges)
    for (const std::uint32_t node : edge.node)
      if (axis.nodes[node].kind == NodeKind::leaf &&
          (axis.nodes[node].disk.radius == 0 || length(axis, edge) > together))
        ++count;
  return count;
}

/// Whether every node of `a`, or only its leaves and branchings, is near a node of `b`: a sentence
/// for the first that is not.
std::string missing_node(const MedialAxis& a, const MedialAxis& b, double together, bool all) {
  std::vector<Disk> nodes;
  for (const Node& node : b.nodes) nodes.push_back(node.disk);
  std::sort(nodes.begin(), nodes.end(),
            [](const Disk& p, const Disk& q) { return p.center.x < q.center.x; });
  for (const Node& node : a.nodes) {
    if (!all && node.kind == NodeKind::site_change) continue;
    const double x = node.disk.center.x;
    auto near = std::lower_bound(nodes.begin(), nodes.end(), x - together,
                                 [](const Disk& p, double low) { return p.center.x < low; });
    bool found = false;
    for (; !found && near != nodes.end() && near->center.x <= x + together; ++near)
      found = distance(near->center, node.disk.center) <= together &&
              std::abs(near->radius - node.disk.radius) <= together;
    if (!found)
      return "no node at (" + std::to_string(x) + ", " + std::to_string(node.disk.center.y) + ")";
  }
  return {};
}

/// What does not hold: verify() is content, and the graph is that of the method disks. `together`:
/// nodes nearer to each other, against the diagonal, count as one.
std::vector<std::string> compare(const Shape& shape, std::uint64_t seed, double together) {
  const auto axis = compute(shape, options_for(method::BiarcDc{seed}));
  if (!axis) return {"not computed: " + to_string(axis.error())};
  const Certificate certificate = verify(shape, *axis, {.threads = 1});
  std::vector<std::string> failures = certificate.failures;
  if (!certificate.passed && failures.empty()) failures.push_back("not passed, without a reason");
  const auto other = compute(shape, options_for(method::Disks{}));
  if (!other) return {"disks: not computed: " + to_string(other.error())};
  // Errors of the other method leave nothing to compare with.
  if (!verify(shape, *other, {.threads = 1}).passed) return failures;
  const double size = diagonal(bounding_box(shape));
  const Invariants own = invariants_of(*axis, size), theirs = invariants_of(*other, size);
  if (leaf_count(*axis, together * size) != leaf_count(*other, together * size))
    failures.push_back("another number of leaves");
  if (own.branching != theirs.branching) failures.push_back("another number of branchings");
  if (std::abs(own.deepest - theirs.deepest) > 1e-12 * size)
    failures.push_back("another deepest radius");
  if (std::abs(own.length - theirs.length) > together * size)
    failures.push_back("another length, by " + std::to_string((own.length - theirs.length) / size));
  const auto mine = lengths_by_sites(*axis), others = lengths_by_sites(*other);
  for (const auto& [first, second] : {std::pair{&mine, &others}, std::pair{&others, &mine}})
    for (const auto& [sites, far] : *first) {
      const auto found = second->find(sites);
      const double there = found == second->end() ? 0 : found->second;
      if (std::abs(far - there) > together * size)
        failures.push_back("another edge between sites " + std::to_string(sites[0]) + " and " +
                           std::to_string(sites[1]));
    }
  // Parts of an arc that a cutting disk divides may count as one.
  const bool all = shape.hole_count() == 0;
  for (const std::string& missing : {missing_node(*axis, *other, together * size, all),
                                     missing_node(*other, *axis, together * size, all)})
    if (!missing.empty()) failures.push_back(missing);
  return failures;
}

/// Compares `count` random shapes. Gaps of some tolerances between holes may be refused.
void compare_all(RandomShape (*make)(std::uint64_t), std::uint64_t count, double together,
                 std::size_t fewest_holes) {
  std::size_t with_holes = 0;
  int failed = 0;
  for (std::uint64_t seed = 0; seed < count && failed < 5; ++seed) {
    const RandomShape random = make(seed);
    const auto shape = build_shape(random.rings);
    if (!shape) continue;
    const auto failures = compare(*shape, seed + 1, together);
    if (failures.empty()) {
      with_holes += shape->hole_count() > 0 ? 1 : 0;
      continue;
    }
    const bool is_refused = failures.front().find("[unsupported]") != std::string::npos;
    if (is_refused && std::string(random.kind) == "near-touching holes") continue;
    ++failed;
    ADD_FAILURE() << random.kind << ", seed " << seed << ": " << failures.front();
  }
  EXPECT_GE(with_holes, fewest_holes);
}

TEST(BiarcDc, AgreesWithDisksOnPolygons) { compare_all(random_shape, 1500, 1e-7, 250); }
TEST(BiarcDc, AgreesWithDisksOnArcShapes) { compare_all(random_arc_shape, 900, 1e-6, 120); }

/// Reflex vertices beside slight arcs; joints of arcs of some roundings' length; regular polygons
/// of bulged sides, whose centre every sub-shape puts elsewhere by some tolerances.
TEST(BiarcDc, AgreesWhereRoundingDecides) {
  for (const std::uint64_t seed : {175U, 785U, 1295U, 1649U, 1756U, 3627U, 8991U})
    for (const std::uint64_t choice : {1U, 2U, 3U}) {
      const RandomShape random = random_arc_shape(seed);
      const auto shape = build_shape(random.rings);
      ASSERT_TRUE(shape.ok());
      EXPECT_EQ(compare(*shape, seed + choice, 1e-6), std::vector<std::string>{})
          << random.kind << ", seed " << seed;
    }
}

/// The sum of the reports over random shapes without holes.
Report reports_of(RandomShape (*make)(std::uint64_t), std::uint64_t count) {
  Report sum;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const auto shape = build_shape(make(seed).rings);
    if (!shape || shape->hole_count() > 0) continue;
    Report report;
    static_cast<void>(biarc_dc::run({*shape, options_for(method::BiarcDc{})}, &report));
    for (std::size_t i = 0; i < sum.base_cases.size(); ++i)
      sum.base_cases[i] += report.base_cases[i];
    sum.random_disks += report.random_disks;
    sum.branching_disks += report.branching_disks;
    sum.multi_branchings += report.multi_branchings;
    sum.only_vertices += report.only_vertices;
  }
  return sum;
}

TEST(BiarcDc, EveryBaseCaseOccurs) {
  const Report polygons = reports_of(random_shape, 300), arcs = reports_of(random_arc_shape, 300);
  for (std::size_t i = 0; i < biarc_dc::base_case_count; ++i) {
    const auto base_case = static_cast<BaseCase>(i);
    EXPECT_GT(count_of(arcs, base_case), 0U) << biarc_dc::name_of(base_case);
    // Without smooth joints, the cases that have some do not occur.
    const bool smooth =
        base_case == BaseCase::a || base_case == BaseCase::d || base_case == BaseCase::g;
    if (base_case == BaseCase::cap) continue;
    EXPECT_EQ(count_of(polygons, base_case) == 0, smooth) << biarc_dc::name_of(base_case);
  }
  for (const Report& report : {polygons, arcs}) {
    EXPECT_GT(report.random_disks, 0U);
    EXPECT_GT(report.branching_disks, 0U);
    EXPECT_GT(report.multi_branchings, 0U);
    EXPECT_GT(report.only_vertices, 0U);
  }
}

TEST(BiarcDc, NodesOfHighDegreeAreOneDisk) {
  for (const std::size_t n : {4U, 5U, 12U, 60U}) {
    const auto shape = build_shape(regular_polygon(n));
    ASSERT_TRUE(shape.ok());
    const auto axis = compute(*shape, options_for(method::BiarcDc{}));
    ASSERT_TRUE(axis.ok());
    EXPECT_EQ(axis->nodes.size(), n + 1);
    EXPECT_EQ(axis->edges.size(), n);
  }
}

/// Disks that one disk stands for, and what they touch, are as near as their radius allows: before,
/// 17, 58 and 24 of these were refused.
TEST(BiarcDc, TiesOfNarrowShapesAreAsNearAsTheirDisks) {
  std::map<std::string_view, int> refused;
  for (const NastyClass& one : nasty_classes()) {
    if (one.name != "strips" && one.name != "slits" && one.name != "rings") continue;
    for (std::uint64_t i = 0; i < 100; ++i) {
      const auto shape = build_shape(nasty_shape(one, 20261219000000000 + i, false));
      if (!shape) continue;
      const auto axis = compute(*shape, options_for(method::BiarcDc{}));
      if (axis)
        EXPECT_EQ(joined(verify(*shape, *axis, {.threads = 1})), "") << one.name << i;
      else
        ++refused[one.name];
    }
  }
  EXPECT_EQ(refused["strips"], 0);
  EXPECT_LE(refused["slits"], 12);
  EXPECT_EQ(refused["rings"], 0);
}

/// Corners rounded by 1e-9 of the size, a disk that 21 arcs touch, arcs of almost one circle: the
/// axis is certified, restarted from other places, or refused with the place.
TEST(BiarcDc, DoubtfulAxesAreVerifiedOrUnsupported) {
  const auto is_right = [](const Rings& rings) {
    const auto shape = build_shape(rings);
    EXPECT_TRUE(shape.ok());
    const auto axis = compute(*shape, options_for(method::BiarcDc{2}));
    if (axis) {
      EXPECT_EQ(joined(verify(*shape, *axis, {.threads = 1})), "");
    } else {
      EXPECT_EQ(axis.error().code, ErrorCode::unsupported) << to_string(axis.error());
      EXPECT_TRUE(axis.error().place.point);
    }
    return axis.ok();
  };
  EXPECT_TRUE(is_right(random_arc_shape(3627).rings));
  EXPECT_TRUE(is_right(random_arc_shape(4787).rings));
  EXPECT_TRUE(is_right(random_arc_shape(11728).rings));
  int right = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto n = static_cast<std::size_t>(random.integer(4, 40));
    Ring ring = bulged_polygon(n, std::tan(std::numbers::pi / (2 * static_cast<double>(n))));
    for (double& bulge : ring.bulges) bulge *= 1 + random.between(-1e-13, 1e-13);
    right += is_right({ring}) ? 1 : 0;
  }
  EXPECT_EQ(right, 30);
}

/// Slots and tangent arcs that are off by 1e-12 to 1e-8: disks beside the centres of arcs touched
/// their ends and reached over their circles, and a tie in a channel moved along it past another
/// node.
TEST(BiarcDc, SlotsAndTangentArcs) {
  const std::vector<Rings> all{
      Rings{{{{1.8459779543949077, -0.7946372725265439},
              {2.530780284270082, 0.8085248440411992},
              {1.4848023298751747, 2.203162116567743},
              {-0.24597795439490766, 1.994637272526544},
              {-1.8459779543949075, 0.794637272526544},
              {-2.5307802842700826, -0.8085248440411987},
              {-1.4848023396359062, -2.203162103553434},
              {0.24597795439490744, -1.994637272526544}},
             RingRole::any,
             {0.2679491924311227, 0.2679491924311227, 0.2679491924311227, 0, 0.2679491924311227,
              0.2679491924311227, 0.2679491924311227, 0}}},
      Rings{{{{0.9128128578056982, -1.355277484356698},
              {1.0828540170450123, 1.2236958571268957},
              {-0.9128128578091197, 1.3552774843569235},
              {-1.082854017043907, -1.2236958571269685}},
             RingRole::any,
             {0.9999999999999999, 0, 0.9999999999999999, 0}},
            {{{0.9298169737269959, -1.097380150208165},
              {2.0294227740185065, -0.13380727731336442},
              {1.0658499011208913, 0.9657985229785491},
              {-0.9298169737297857, 1.0973801502056508},
              {-2.0294227740208757, 0.13380727731067962},
              {-1.0658499011208915, -0.965798522978549}},
             RingRole::any,
             {0.41421356237309503, 0.41421356237309503, 0, 0.41421356237309503, 0.41421356237309503,
              0}}},
      Rings{{{{-2.0000000000000004, -1.9999999999999998},
              {2, -1.9999999999999998},
              {2, 2},
              {-1.9999999999999998, 2}}},
            {{{0.5546875722704593, -0.6986709547968553},
              {0.5546875722704594, 0.6986709547968551},
              {0.391922925684616, 0.4936565705453652},
              {0.3919229258038145, -0.4936565705496612}},
             RingRole::any,
             {0.482916216990187, 1, -0.482916216990187, 1}},
            {{{-0.5546875722704592, 0.6986709547968554},
              {-0.5546875722704594, -0.6986709547968551},
              {-0.39192292561068226, -0.49365657053309},
              {-0.391922925527388, 0.4936565704293311}},
             RingRole::any,
             {0.482916216990187, 1, -0.482916216990187, 1}}},
      Rings{{{{-67.4, -47.8},
              {-64.19999999999992, -45.40000000000021},
              {-66.60000000000022, -42.200000000000166},
              {-69.8, -44.6}}},
            {{{-66.2483284656175, -45.29843438845175},
              {-67.07602898328634, -44.19483369822613},
              {-67.04575356997127, -44.515458038048706},
              {-66.54765071611855, -45.17959517651847}},
             RingRole::any,
             {0.5603060131129286, 1, -0.5603060131129286, 1}},
            {{{-67.75167153438275, -44.70156561154844},
              {-66.92397101671366, -45.80516630177387},
              {-66.95424643002873, -45.484541961951294},
              {-67.45234928388129, -44.82040482348122}},
             RingRole::any,
             {0.5603060131129286, 1, -0.5603060131129286, 1}}},
      Rings{{{{-2.7002639900936884, 0.8417686046671687},
              {-0.8417686046671687, -2.7002639900936884},
              {2.7002639900936884, -0.8417686046671687},
              {0.8417686046671687, 2.7002639900936884}}},
            {{{-0.4506773055583291, -0.7125746260356312},
              {0.8424436861053937, -0.03407737014929696},
              {0.5932122459341628, -0.02399580366160864},
              {-0.3173473800445335, -0.501764095677184}},
             RingRole::any,
             {0.5773238829448858, 1, -0.5773238829448858, 1}},
            {{{0.45067730555832913, 0.7125746260356312},
              {-0.8424436861053937, 0.03407737014929707},
              {-0.5932122459337493, 0.023995803654526082},
              {0.3173473800457454, 0.5017640956633813}},
             RingRole::any,
             {0.5773238829448858, 1, -0.5773238829448858, 1}}},
  };
  int right = 0;
  for (const Rings& rings : all)
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const auto shape = build_shape(rings);
      ASSERT_TRUE(shape.ok());
      const auto axis = compute(*shape, options_for(method::BiarcDc{seed}));
      right += axis ? 1 : 0;
      if (axis)
        EXPECT_EQ(joined(verify(*shape, *axis, {.threads = 1})), "");
      else
        EXPECT_EQ(axis.error().code, ErrorCode::unsupported);
    }
  EXPECT_GE(right, 25);
}

TEST(BiarcDc, RoundShapes) {
  const auto round = build_shape(std::vector{circle({1, 2}, 3, 0.5)});
  ASSERT_TRUE(round.ok());
  const auto point = compute(*round, options_for(method::BiarcDc{}));
  ASSERT_TRUE(point.ok());
  EXPECT_TRUE(point->edges.empty());
  ASSERT_EQ(point->nodes.size(), 1U);
  EXPECT_NEAR(point->nodes[0].disk.radius, 3, 1e-14);

  const auto long_one = build_shape(std::vector{stadium({0, 0}, {5, 0}, 1)});
  ASSERT_TRUE(long_one.ok());
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto line = compute(*long_one, options_for(method::BiarcDc{seed}));
    ASSERT_TRUE(line.ok());
    EXPECT_EQ(line->edges.size(), 1U);
    EXPECT_NEAR(total_length(*line), 5, 1e-13);
  }
}

TEST(BiarcDc, TheSeedDecides) {
  const auto shape = build_shape(comb(40));
  ASSERT_TRUE(shape.ok());
  const auto first = compute(*shape, options_for(method::BiarcDc{1})),
             again = compute(*shape, options_for(method::BiarcDc{1})),
             other = compute(*shape, options_for(method::BiarcDc{2}));
  ASSERT_TRUE(first.ok() && again.ok() && other.ok());
  EXPECT_EQ(first->method, "biarc-dc");
  EXPECT_EQ(first->statistics.threads, 1);
  EXPECT_TRUE(identical(*first, *again));
  EXPECT_FALSE(identical(*first, *other));
  EXPECT_NEAR(total_length(*first), total_length(*other), 1e-10);
}

#ifdef MEDIAL_BENCH_SHAPES
/// Many of a fine tree's disks are nearly their arcs' own circles, where positions along a bisector
/// are found by feet that turn fast.
TEST(BiarcDc, AgreesOnATreeOfFineArcs) {
  ArcOptions fine;
  fine.tolerance = 1e-6;
  const auto rings = approximate_by_arcs(papers::tree(4), fine);
  ASSERT_TRUE(rings.ok());
  const auto shape = build_shape(*rings);
  ASSERT_TRUE(shape.ok());
  for (const std::uint64_t seed : {1U, 2U})
    EXPECT_EQ(compare(*shape, seed, 1e-9), std::vector<std::string>{}) << "seed " << seed;
}

/// A disk that touches both ends of the arc of largest curvature, but not its middle, is no leaf.
TEST(BiarcDc, EndsInTheCentreOfTheArcOfLargestCurvature) {
  const auto rings = approximate_by_arcs(papers::border(10), {.tolerance = 1e-3});
  ASSERT_TRUE(rings.ok());
  const auto shape = build_shape(*rings);
  ASSERT_TRUE(shape.ok());
  const auto other = compute(*shape, options_for(method::Disks{}));
  ASSERT_TRUE(other.ok());
  for (const std::uint64_t seed : {1U, 3U}) {
    const auto axis = compute(*shape, options_for(method::BiarcDc{seed}));
    ASSERT_TRUE(axis.ok());
    EXPECT_EQ(verify(*shape, *axis, {.threads = 1}).failures, std::vector<std::string>{})
        << "seed " << seed;
    EXPECT_EQ(leaf_count(*axis, 0), leaf_count(*other, 0)) << "seed " << seed;
  }
}

/// Beside a hole's vertex that its cutting disk touches, elements are parts of sites whose ends
/// belong to other parts: what touches such an end touches the vertex. Of 729 letters with such
/// holes a wrong contact would spoil some, whatever the seed.
TEST(BiarcDc, PartsOfSitesAreNotTouchedAtTheSitesEnds) {
  const auto rings = approximate_by_arcs(papers::lettering(27), {.tolerance = 1e-6});
  ASSERT_TRUE(rings.ok());
  const auto shape = build_shape(*rings);
  ASSERT_TRUE(shape.ok());
  const auto axis = compute(*shape, options_for(method::BiarcDc{})),
             other = compute(*shape, options_for(method::Disks{}));
  ASSERT_TRUE(axis.ok()) << to_string(axis.error());
  EXPECT_EQ(leaf_count(*axis, 0), leaf_count(*other, 0));
  EXPECT_NEAR(total_length(*axis) / total_length(*other), 1, 1e-9);
}

/// Section 2.4: where the boundary is off by at most epsilon, a point of the axis is at most
/// 4 epsilon / (1 - cos(xi / 2)) off, where its disk's rays to the boundary enclose the angle xi,
/// but near leaves.
TEST(BiarcDc, TheAxisIsAsStableAsThePaperSays) {
  const std::vector<Contour> contours = papers::tree(3);
  const auto axis_at = [&](double tolerance, ArcReport& report) {
    const auto rings = approximate_by_arcs(contours, {.tolerance = tolerance}, &report);
    return *compute(*build_shape(*rings), options_for(method::BiarcDc{}));
  };
  ArcReport fine;
  const MedialAxis exact = axis_at(1e-9, fine);
  double last = 0;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    ArcReport coarse;
    const MedialAxis axis = axis_at(tolerance, coarse);
    const papers::Stability stability =
        papers::stability(exact, axis, coarse.largest_error + fine.largest_error);
    EXPECT_LE(stability.worst_share, 1) << tolerance;
    EXPECT_GT(stability.points, exact.edges.size());
    EXPECT_TRUE(last == 0 || stability.largest < 0.2 * last) << tolerance;
    last = stability.largest;
  }
}
#endif

/// Holes side by side, nested components, holes whose cutting disks divide one long wall; one hole
/// with an arc where its cutting disk touches it.
TEST(BiarcDc, CutsHolesOpen) {
  for (const Rings& rings : {hole_grid(1), hole_grid(9), nested_squares(6),
                             Rings{rectangle(1, 1)[0], stadium({0.3, 0.4}, {0.7, 0.5}, 0.1)},
                             Rings{circle({0, 0}, 2, 0.5), circle({0.3, 0.1}, 1, 0.25)}}) {
    const auto shape = build_shape(rings);
    ASSERT_TRUE(shape.ok());
    EXPECT_EQ(compare(*shape, 5, 1e-9), std::vector<std::string>{}) << shape->hole_count();
    const auto axis = compute(*shape, options_for(method::BiarcDc{}));
    ASSERT_TRUE(axis.ok());
    EXPECT_EQ(axis->statistics.bridges, shape->hole_count());
  }
}

/// Conics that are left to later are those of the axis with all of them, wherever they are asked
/// for: each follows from the two sites and the two disks of its edge.
TEST(BiarcDc, ConicsCanComeLater) {
  for (const std::uint64_t seed : {3U, 8U, 11U, 20U, 41U, 55U})
    for (const RandomShape& random : {random_shape(seed), random_arc_shape(seed)}) {
      const auto shape = build_shape(random.rings);
      if (!shape) continue;
      auto now = compute(*shape, options_for(method::BiarcDc{1, true}));
      auto later = compute(*shape, options_for(method::BiarcDc{1, false}));
      ASSERT_EQ(now.ok(), later.ok());
      if (!now) continue;
      ASSERT_EQ(now->edges.size(), later->edges.size());
      const double size = diagonal(bounding_box(*shape));
      for (std::size_t i = 0; i < now->edges.size(); ++i) {
        const Edge& edge = now->edges[i];
        EXPECT_EQ(sample_by_step(*later, later->edges[i], size).size(), 2U);
        later->edges[i] = conic_of(*later, later->edges[i]);
        for (const double t : {0.25, 0.5, 0.75}) {
          const Disk a = disk_at(*now, edge, t), b = disk_at(*later, later->edges[i], t);
          EXPECT_LE(distance(a.center, b.center), 1e-9 * size) << random.kind << ", edge " << i;
        }
      }
      EXPECT_EQ(joined(verify(*shape, *later, {.threads = 1})), "") << random.kind;
    }
}

/// However an axis branches, divisions scan O(n log n) elements in all.
TEST(BiarcDc, CutsAreBalanced) {
  Rings star = {ring_of({})};
  for (int i = 0; i < 3000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3000, radius = i % 2 == 0 ? 1 : 0.5;
    star[0].points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  std::vector<Rings> all{star, comb(2000), maze(5000), hole_grid(25)};
#ifdef MEDIAL_BENCH_SHAPES
  all.push_back(*approximate_by_arcs(papers::snowflake(4), {.tolerance = 1e-5}));
  all.push_back(*approximate_by_arcs(papers::tree(5), {.tolerance = 1e-4}));
#endif
  for (const Rings& rings : all) {
    const auto shape = build_shape(rings);
    ASSERT_TRUE(shape.ok());
    Report report;
    ASSERT_TRUE(biarc_dc::run({*shape, options_for(method::BiarcDc{})}, &report).ok());
    const auto n = static_cast<double>(shape->points.size() + 4 * shape->hole_count());
    EXPECT_LT(static_cast<double>(report.divided_elements), 3 * n * std::log2(n)) << n;
  }
}

TEST(BiarcDc, ThreadsDoNotChangeTheResult) {
  for (const Rings& rings : {comb(5000), hole_grid(40), nested_squares(40)}) {
    const auto shape = build_shape(rings);
    ASSERT_TRUE(shape.ok());
    const auto one = compute(*shape, options_for(method::BiarcDc{3}));
    ASSERT_TRUE(one.ok());
    for (const int threads : {2, 5}) {
      const auto several = compute(*shape, {.method = method::BiarcDc{3}, .threads = threads});
      ASSERT_TRUE(several.ok());
      EXPECT_TRUE(identical(*one, *several)) << threads;
    }
  }
}

TEST(BiarcDc, CanBeCancelled) {
  const auto shape = build_shape(maze(2000));
  ASSERT_TRUE(shape.ok());
  Options options = options_for(method::BiarcDc{});
  const std::atomic<bool> cancel = true;
  options.cancel = &cancel;
  const auto axis = compute(*shape, options);
  ASSERT_FALSE(axis.ok());
  EXPECT_EQ(axis.error().code, ErrorCode::cancelled);
}

TEST(BiarcDc, NamesOfMethods) {
  for (const MethodInfo& info : methods())
    EXPECT_EQ(medial::name_of(*method_from(info.name)), info.name);
  EXPECT_FALSE(method_from("biarc_dc").has_value());
}

}  // namespace
}  // namespace medial::test
