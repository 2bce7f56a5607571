// The method brushfire on shapes: the same pixels as on their image, exact radii, the certificate.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "medial/compute.h"
#include "medial/raster.h"
#include "medial/verify.h"

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
  EXPECT_EQ(compute(*square, options).error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace medial
