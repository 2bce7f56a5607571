// Buffers of loose points, lines and arcs: closed forms, the distance of every point, and GEOS.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/arc.h"
#include "medial/offset.h"
#include "medial/planar_graph.h"
#include "medial/query.h"
#include "support/environment.h"
#include "support/generate.h"
#include "support/offset_check.h"
#ifdef MEDIAL_HAS_GEOS
#include <geos_c.h>
#endif

namespace medial {
namespace {

using std::numbers::pi;
using Chains = std::vector<Chain>;

std::uint64_t planar_graph_count() {
  return test::number_from("MEDIAL_PROPERTY_COUNT", 12000) / 20;
}

Offsets buffers_of(const Chains& chains, const std::vector<double>& distances) {
  const auto planar_graph = build_planar_graph(chains);
  EXPECT_TRUE(planar_graph.ok());
  auto offsets = offset_curves(*planar_graph, distances);
  EXPECT_TRUE(offsets.ok()) << (offsets ? "" : to_string(offsets.error()));
  return offsets ? std::move(offsets).value() : Offsets{};
}

TEST(Buffer, OfAPointIsADisk) {
  const Offsets offsets = buffers_of({{{{3, 4}}}}, {0.5, 2});
  ASSERT_EQ(offsets.regions.size(), 2U);
  EXPECT_NEAR(area(offsets.regions[0]), 4 * pi, 1e-12);
  EXPECT_EQ(offsets.regions[0].clearance, -2);
  EXPECT_NEAR(length(offsets.regions[1]), pi, 1e-12);
  EXPECT_EQ(offsets.regions[1].parent, 0U);
}

TEST(Buffer, OfASegmentIsAStadium) {
  const Offsets offsets = buffers_of({{{{0, 0}, {5, 0}}}}, {1});
  ASSERT_EQ(offsets.regions.size(), 1U);
  ASSERT_EQ(offsets.regions[0].rings.size(), 1U);
  EXPECT_EQ(offsets.regions[0].rings[0].points.size(), 4U);
  EXPECT_NEAR(area(offsets.regions[0]), 10 + pi, 1e-12);
  EXPECT_NEAR(length(offsets.regions[0]), 10 + 2 * pi, 1e-12);
}

TEST(Buffer, OfAnArcIsABentStadium) {
  // Half a circle of radius 2: half a ring and two half disks.
  const Offsets offsets = buffers_of({{{{2, 0}, {-2, 0}}, {1}}}, {0.5});
  ASSERT_EQ(offsets.regions.size(), 1U);
  EXPECT_NEAR(area(offsets.regions[0]), pi * (2.5 * 2.5 - 1.5 * 1.5) / 2 + pi / 4, 1e-12);
}

TEST(Buffer, OfAClosedLineHasAHoleWhileThereIsRoom) {
  const Chain square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}, true};
  const Offsets offsets = buffers_of({square}, {1, 3});
  ASSERT_EQ(offsets.regions.size(), 2U);
  EXPECT_EQ(offsets.regions[0].rings.size(), 1U);  // 3 on both sides fills the square
  ASSERT_EQ(offsets.regions[1].rings.size(), 2U);
  EXPECT_NEAR(area(offsets.regions[1]), 16 + 16 + pi - 4, 1e-12);
}

TEST(Buffer, PartsJoinWhereTheyMeet) {
  const Offsets offsets = buffers_of({{{{0, 0}}}, {{{3, 0}}}, {{{7, 0}, {7, 1}}}}, {1, 1.6, 2.5});
  std::vector<std::size_t> regions(3);
  for (const OffsetRegion& region : offsets.regions)
    ++regions[region.clearance == -1 ? 0 : region.clearance == -1.6 ? 1 : 2];
  EXPECT_EQ(regions, (std::vector<std::size_t>{3, 2, 1}));
  for (std::size_t i = 1; i < offsets.regions.size(); ++i) EXPECT_LT(offsets.regions[i].parent, i);
}

TEST(Buffer, RefusesWhatIsNoDistance) {
  const auto planar_graph = build_planar_graph(Chains{{{{0, 0}}}, {{{1, 0}}}});
  ASSERT_TRUE(planar_graph.ok());
  for (const double d : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e9})
    EXPECT_EQ(offset_curves(*planar_graph, {&d, 1}).error().code, ErrorCode::invalid_option) << d;
  const double one = 1;
  EXPECT_EQ(offset_curves(PlanarGraph{}, {&one, 1}).error().code, ErrorCode::empty);
  EXPECT_TRUE(offset_curves(*planar_graph, std::span<const double>{})->regions.empty());
}

/// Points, lines and arcs without crossings, some of them closed.
Chains random_planar_graph(std::uint64_t seed) {
  test::Random random(seed);
  const auto place = [&] { return Vec2{random.unit(), random.unit()}; };
  Chains chains;
  for (std::int64_t i = random.integer(1, 12); i > 0; --i) {
    Chain chain{{place()}};
    for (std::int64_t k = random.integer(0, 3); k > 0; --k) {
      const Vec2 last = chain.points.back();
      chain.points.push_back(last + 0.4 * (place() - last));
    }
    if (seed % 2 == 1)
      for (std::size_t k = 0; k < chain.points.size(); ++k)
        chain.bulges.push_back(random.unit() < 0.5 ? 0 : random.between(-1, 1));
    chain.closed = chain.points.size() > 2 && random.unit() < 0.3;
    chains.push_back(chain);
    if (!build_planar_graph(chains)) chains.pop_back();
  }
  if (chains.empty()) chains.push_back({{place()}});
  return chains;
}

double distance_to(const PlanarGraph& planar_graph, Vec2 p) {
  double least = HUGE_VAL;
  for (const Vec2 q : planar_graph.points) least = std::min(least, distance(p, q));
  for (const PlanarGraphEdge& edge : planar_graph.edges) {
    const Site site{planar_graph.points[edge.from], planar_graph.points[edge.to], 0, 0, edge.bulge};
    least = std::min(least, distance(p, foot(site, p)));
  }
  return least;
}

TEST(Buffer, EveryPointHasItsDistance) {
  std::size_t regions = 0;
  for (std::uint64_t seed = 0; seed < planar_graph_count(); ++seed) {
    SCOPED_TRACE(seed);
    const auto planar_graph = build_planar_graph(random_planar_graph(seed));
    ASSERT_TRUE(planar_graph.ok());
    test::Random random(seed);
    const std::vector<double> distances{random.between(0.001, 0.05), random.between(0.05, 0.3), 2};
    const auto offsets = offset_curves(*planar_graph, distances);
    ASSERT_TRUE(offsets.ok()) << to_string(offsets.error());
    regions += offsets->regions.size();
    for (const OffsetRegion& region : offsets->regions) {
      for (const Ring& ring : region.rings) {
        for (std::size_t i = 0; i < ring.points.size(); ++i) {
          const BulgeArc edge{ring.points[i], ring.points[(i + 1) % ring.points.size()],
                              ring.bulges.empty() ? 0 : ring.bulges[i]};
          for (const Vec2 p : {edge.start, apex(edge)})
            ASSERT_NEAR(distance_to(*planar_graph, p), -region.clearance, 1e-9)
                << p.x << " " << p.y;
        }
      }
    }
    for (const double d : distances) {
      std::vector<Ring> rings;
      for (const OffsetRegion& region : offsets->regions)
        if (region.clearance == -d)
          rings.insert(rings.end(), region.rings.begin(), region.rings.end());
      for (int i = 0; i < 40; ++i) {
        const Vec2 p{random.between(-d, 1 + d), random.between(-d, 1 + d)};
        const double away = distance_to(*planar_graph, p);
        if (std::abs(away - d) < 1e-9) continue;
        ASSERT_EQ(test::winding(rings, p), away < d ? 1 : 0) << p.x << " " << p.y << " at " << d;
      }
    }
  }
  EXPECT_GT(regions, 3 * planar_graph_count());
}

TEST(Buffer, BetweenPointsThatAlmostTouch) {
  // The edge between the two has a weight of 1 / gap: where it is at the level, the shares of its
  // ends differ as much.
  for (int k = 3; k <= 50; ++k) {
    const double gap = std::ldexp(1, -k);
    const Chains chains{{{{0, 0}}}, {{{0.6 * gap, 0.8 * gap}}}, {{{1, 0.1}}}};
    const auto planar_graph = build_planar_graph(chains);
    ASSERT_TRUE(planar_graph.ok());
    for (const double d : {0.1, 0.3, 0.4}) {
      const Offsets offsets = buffers_of(chains, {d});
      EXPECT_FALSE(offsets.regions.empty());
      for (const OffsetRegion& region : offsets.regions)
        for (const Ring& ring : region.rings)
          for (const Vec2 p : ring.points)
            EXPECT_NEAR(distance_to(*planar_graph, p), d, 1e-14) << gap;
    }
  }
}

TEST(Buffer, MovesWithThePlanarGraph) {
  // Rotation, scale, shift, mirroring, the other direction, another start and order.
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < planar_graph_count() / 4; ++seed) {
    const Chains chains = random_planar_graph(seed);
    const double size = diagonal(bounding_box(*build_planar_graph(chains)));
    test::Random random(seed);
    const std::vector<double> distances{random.between(0.01, 0.1), random.between(0.1, 0.4)};
    const test::Measures expected = test::measures_of(buffers_of(chains, distances), 1);
    for (const test::Symmetry& symmetry : test::symmetries()) {
      SCOPED_TRACE(std::to_string(seed) + " " + symmetry.name);
      const double scale = symmetry.scale();
      const auto planar_graph = build_planar_graph(test::transformed(chains, symmetry));
      ASSERT_TRUE(planar_graph.ok());
      const auto offsets =
          offset_curves(*planar_graph, std::vector{scale * distances[0], scale * distances[1]});
      // Points close to each other may coincide far from the origin.
      if (!offsets && offsets.error().code == ErrorCode::unsupported && symmetry.dx == 1e7)
        continue;
      ASSERT_TRUE(offsets.ok()) << to_string(offsets.error());
      const test::Measures moved = test::measures_of(*offsets, scale);
      ASSERT_EQ(expected.rings, moved.rings);
      // The rounding error of a shift far from the origin.
      const double slack = 1e-9 + 1e-13 * std::abs(symmetry.dx) / scale;
      for (std::size_t i = 0; i < moved.areas.size(); ++i) {
        EXPECT_NEAR(expected.areas[i], moved.areas[i], slack * (size + 1));
        EXPECT_NEAR(expected.lengths[i], moved.lengths[i], 1e3 * slack * (size + 1));
      }
      ++compared;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(compared, 12 * planar_graph_count() / 5);
}

#ifdef MEDIAL_HAS_GEOS
/// Area and number of parts of GEOS's buffer, with many chords to a quarter of a circle.
class Geos {
 public:
  Geos() : context_(GEOS_init_r()) {}
  ~Geos() { GEOS_finish_r(context_); }
  struct Buffer {
    double area = 0;
    int parts = 0;
  };
  /// Takes the geometry.
  Buffer buffer(GEOSGeometry* geometry, double distance) {
    constexpr int quadrant_segments = 200;
    GEOSGeometry* buffer = GEOSBuffer_r(context_, geometry, distance, quadrant_segments);
    Buffer result;
    GEOSArea_r(context_, buffer, &result.area);
    result.parts =
        GEOSisEmpty_r(context_, buffer) == 1 ? 0 : GEOSGetNumGeometries_r(context_, buffer);
    GEOSGeom_destroy_r(context_, buffer);
    GEOSGeom_destroy_r(context_, geometry);
    return result;
  }
  GEOSGeometry* from_text(const std::string& text) {
    GEOSWKTReader* reader = GEOSWKTReader_create_r(context_);
    GEOSGeometry* geometry = GEOSWKTReader_read_r(context_, reader, text.c_str());
    GEOSWKTReader_destroy_r(context_, reader);
    return geometry;
  }

 private:
  GEOSContextHandle_t context_;
};

std::string text_of(std::span<const Vec2> points, bool closed) {
  std::string text = "(";
  char buffer[64];
  for (std::size_t i = 0; i < points.size() + (closed ? 1 : 0); ++i) {
    const Vec2 p = points[i % points.size()];
    std::snprintf(buffer, sizeof buffer, "%s%.17g %.17g", i > 0 ? ", " : "", p.x, p.y);
    text += buffer;
  }
  return text + ")";
}

struct Sum {
  double area = 0;
  int parts = 0;
};
Sum sum_of(const Offsets& offsets, double clearance) {
  Sum sum;
  for (const OffsetRegion& region : offsets.regions) {
    if (region.clearance != clearance) continue;
    sum.area += area(region);
    ++sum.parts;
  }
  return sum;
}

/// Before GEOS buffers lines, it removes details smaller than a hundredth of the distance.
double simplified(const Offsets& offsets, double distance) {
  double around = 0;
  for (const OffsetRegion& region : offsets.regions) around += length(region);
  return 0.01 * std::abs(distance) * around;
}

TEST(Buffer, AgreesWithGeosOnLinesAndPoints) {
  Geos geos;
  for (std::uint64_t seed = 0; seed < planar_graph_count() / 10; seed += 2) {  // straight ones
    SCOPED_TRACE(seed);
    const Chains chains = random_planar_graph(seed);
    std::string text = "GEOMETRYCOLLECTION(";
    for (std::size_t i = 0; i < chains.size(); ++i) {
      const bool point = chains[i].points.size() == 1;
      text += std::string(i > 0 ? ", " : "") + (point ? "POINT" : "LINESTRING") +
              text_of(chains[i].points, chains[i].closed);
    }
    for (const double d : {0.02, 0.11, 0.4}) {
      const Offsets offsets = buffers_of(chains, {d});
      const Sum own = sum_of(offsets, -d);
      const Geos::Buffer peer = geos.buffer(geos.from_text(text + ")"), d);
      EXPECT_NEAR(own.area, peer.area, simplified(offsets, d) + 1e-4 * own.area) << d;
      EXPECT_EQ(own.parts, peer.parts) << d;
    }
  }
}

TEST(Buffer, OfPolygonsAgreesWithGeosOnBothSides) {
  Geos geos;
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < planar_graph_count() / 6; ++seed) {
    const test::RandomShape random = test::random_shape(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const auto shape = build_shape(random.rings);
    ASSERT_TRUE(shape.ok());
    if (shape->component_count() != 1 || shape->points.size() > 200) continue;
    std::string text = "POLYGON(";
    std::string holes;
    for (std::size_t i = 0; i < shape->loop_count(); ++i)
      (shape->hole[i] ? holes += ", " : text) += text_of(shape->loop(i), true);
    const double size = diagonal(bounding_box(*shape));
    for (const double c : {-0.2 * size, -0.013 * size, 0.011 * size}) {
      const auto offsets = offset_curves(*shape, {&c, 1});
      ASSERT_TRUE(offsets.ok());
      const Sum own = sum_of(*offsets, c);
      const Geos::Buffer peer = geos.buffer(geos.from_text(text + holes + ")"), -c);
      EXPECT_NEAR(own.area, peer.area, simplified(*offsets, c) + 1e-6 * size * size) << c;
      ++compared;
    }
  }
  EXPECT_GT(compared, planar_graph_count() / 10);
}
#endif

}  // namespace
}  // namespace medial
