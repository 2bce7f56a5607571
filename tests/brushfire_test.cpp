// The method brushfire on shapes: the same pixels as on their image, exact radii, the certificate.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string_view>

#include "medial/compute.h"
#include "medial/raster.h"
#include "medial/verify.h"
#include "methods/raster/finer_grid.h"

namespace medial {
namespace {

Image blots(std::uint32_t seed) {
  std::mt19937 random(seed);
  Image image(120, 80);
  for (int i = 0; i < 25; ++i) {
    const int x = static_cast<int>(random() % 120), y = static_cast<int>(random() % 80);
    const int r = static_cast<int>(random() % 12);
    for (int v = std::max(0, y - r); v < std::min(80, y + r); ++v)
      for (int u = std::max(0, x - r); u < std::min(120, x + r); ++u)
        image.set(static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v),
                  (u - x) * (u - x) + (v - y) * (v - y) < r * r && i % 4 != 3);
  }
  return image;
}

MedialAxis burnt(const Shape& shape, Brushfire family, double resolution, std::uint32_t pixels) {
  const auto axis = compute(shape, {.method = method::Brushfire{{resolution, pixels}, family}});
  EXPECT_TRUE(axis.ok()) << to_string(axis.error());
  return axis ? *axis : MedialAxis();
}

TEST(BrushfireMethod, OnTheOutlineOfAnImageGivesItsPixels) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const Image image = blots(seed);
    const auto rings = pixel_outline(image);
    ASSERT_TRUE(rings.ok());
    const auto shape = build_shape(*rings);
    ASSERT_TRUE(shape.ok());
    const auto distances = distance_transform(image, {DistanceTo::cracks, true, 1});
    ASSERT_TRUE(distances.ok());
    for (const Brushfire family :
         {Brushfire::sequential, Brushfire::sides, Brushfire::marking, Brushfire::simultaneous}) {
      BrushfireOptions options;
      options.family = family;
      const auto thinned = thin(image, options);
      ASSERT_TRUE(thinned.ok());
      const MedialAxis axis = burnt(*shape, family, 1, 0);
      // The four subfields depend on where the grid begins: another axis, as good.
      if (family != Brushfire::sequential) {
        EXPECT_EQ(axis.nodes.size(), thinned->count());
        for (const Node& node : axis.nodes) {
          const auto x = static_cast<std::uint32_t>(node.disk.center.x);
          const auto y = static_cast<std::uint32_t>(node.disk.center.y);
          EXPECT_EQ(node.disk.center, (Vec2{x + 0.5, y + 0.5}));
          EXPECT_TRUE(thinned->at(x, y));
          EXPECT_NEAR(node.disk.radius, distances->at(x, y), 1e-12);
        }
      }
      const Certificate certificate = verify(*shape, axis);
      EXPECT_TRUE(certificate.passed)
          << (certificate.failures.empty() ? "" : certificate.failures[0]);
    }
  }
}

TEST(BrushfireMethod, TakesShapesWithArcsAndHoles) {
  // A ring between two circles, far from the origin.
  const Vec2 c{5000, -3000};
  const auto circle = [c](double r, double bulge) {
    return Ring{{c + Vec2{r, 0}, c - Vec2{r, 0}}, RingRole::any, {bulge, bulge}};
  };
  const auto shape = build_shape(std::vector<Ring>{circle(10, 1), circle(6, -1)});
  ASSERT_TRUE(shape.ok());
  const MedialAxis axis = burnt(*shape, Brushfire::simultaneous, 0, 400);
  EXPECT_EQ(axis.resolution, 0.05);
  EXPECT_TRUE(verify(*shape, axis).passed);
  for (const Node& node : axis.nodes) {
    const double off = norm(node.disk.center - c);
    // The front of a fire is no circle: the middle is missed by some pixels.
    EXPECT_NEAR(off, 8, 5 * axis.resolution);
    EXPECT_NEAR(node.disk.radius, std::min(10 - off, off - 6), 1e-9);
  }
}

/// Two components whose pixels touch on a coarse grid keep an axis each, in one part, and a ring
/// within a pixel of another has its cycle.
TEST(BrushfireMethod, ComponentsThatTouchOnTheGridStayApart) {
  const auto box = [](double x, double y, double size) {
    return Ring{{{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}}, RingRole::any, {}};
  };
  const auto shape = build_shape(std::vector<Ring>{box(0, 0, 30), box(5, 5, 20), box(30.05, 0, 30),
                                                   box(35, 5, 20), box(15, 30.05, 30)});
  ASSERT_TRUE(shape.ok());
  ASSERT_EQ(shape->component_count(), 3U);
  for (const Brushfire family :
       {Brushfire::sequential, Brushfire::sides, Brushfire::marking, Brushfire::simultaneous}) {
    const Certificate certificate = verify(*shape, burnt(*shape, family, 1, 0));
    EXPECT_TRUE(certificate.passed) << certificate.failures.front();
    EXPECT_EQ(certificate.graph_parts, 3U);
    EXPECT_EQ(certificate.cycles, 2U);
  }
}

/// Where a grid is too coarse for necks and holes, the number of pixels that is named does.
TEST(BrushfireMethod, NamesTheGridThatDoes) {
  // Two squares joined by a neck, and a small hole beside them.
  const Ring outer{{{0, 0},
                    {40, 0},
                    {40, 18},
                    {41, 18},
                    {41, 0},
                    {80, 0},
                    {80, 40},
                    {41, 40},
                    {41, 18.6},
                    {40, 18.6},
                    {40, 40},
                    {0, 40}},
                   RingRole::any,
                   {}};
  const Ring hole{{{10.1, 10.1}, {10.1, 10.9}, {10.9, 10.9}, {10.9, 10.1}}, RingRole::any, {}};
  const auto shape = build_shape(std::vector<Ring>{outer, hole});
  ASSERT_TRUE(shape.ok());
  for (const char* const name : {"brushfire", "ridge"}) {
    const auto axis_of = [&](std::uint32_t pixels) {
      Method method = method::Brushfire{{.pixels = pixels}};
      if (std::string_view(name) == "ridge") method = method::Ridge{.grid = {.pixels = pixels}};
      return compute(*shape, {.method = method});
    };
    const auto coarse = axis_of(20);
    ASSERT_TRUE(coarse.ok());
    const Certificate certificate = verify(*shape, *coarse);
    EXPECT_FALSE(certificate.passed);
    EXPECT_EQ(certificate.unresolved, certificate.failures.size());
    const std::uint32_t pixels = raster::pixels_that_do(*shape, name, coarse->resolution);
    EXPECT_GT(pixels, 20U);
    EXPECT_LE(pixels, 320U);
    const auto fine = axis_of(pixels);
    ASSERT_TRUE(fine.ok());
    EXPECT_TRUE(verify(*shape, *fine).passed) << name;
  }
  // Nothing up to sixteen times as many pixels shows this neck.
  EXPECT_EQ(raster::pixels_that_do(*shape, "brushfire", 1e9), 0U);
}

TEST(BrushfireMethod, RefusesWhatItCannot) {
  // A frame so thin that all centres of coarse pixels miss it.
  const auto box = [](double low, double high) {
    return Ring{{{low, low}, {high, low}, {high, high}, {low, high}}, RingRole::any, {}};
  };
  const auto frame = build_shape(std::vector<Ring>{box(0, 100), box(0.001, 99.999)});
  ASSERT_TRUE(frame.ok());
  Options options{.method = method::Brushfire{{.pixels = 10}}};
  EXPECT_EQ(compute(*frame, options).error().code, ErrorCode::unsupported);
  options.method = method::Brushfire{{.pixels = 70000}};
  EXPECT_EQ(compute(*frame, options).error().code, ErrorCode::too_large);
  options.method = method::Brushfire{{.resolution = 1000}};
  EXPECT_EQ(compute(*frame, options).error().code, ErrorCode::invalid_option);
  const auto square =
      build_shape(std::vector<Ring>{Ring{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, RingRole::any, {}}});
  const std::atomic<bool> cancel = true;
  options.method = method::Brushfire{};
  options.cancel = &cancel;
  EXPECT_EQ(compute(*square, options).error().code, ErrorCode::cancelled);
  options.cancel = nullptr;
  options.exterior = true;
  EXPECT_EQ(compute(*square, options).error().code, ErrorCode::invalid_option);
}

}  // namespace
}  // namespace medial
