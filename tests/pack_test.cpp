// Packs: unpacked shapes are within the bound, and no bytes break the reader.
#include "medial/pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial/compute.h"
#include "medial/query.h"
#include "medial/sides.h"
#include "ops/disk_lines.h"
#include "support/computed.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

const std::uint64_t pack_count = test::shape_count(100);

using test::Random;
using test::RandomShape;

/// How far a point lies outside the hulls of an axis of straight edges; 0 or less inside.
double outside(const MedialAxis& axis, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Node& node : axis.nodes)
    least = std::min(least, distance(node.disk.center, p) - node.disk.radius);
  for (const Edge& edge : axis.edges) {
    const Disk &a = axis.nodes[edge.node[0]].disk, &b = axis.nodes[edge.node[1]].disk;
    // |p - c(t)| - r(t) is convex in t: ternary search.
    const auto at = [&](double t) {
      const Vec2 c = a.center + t * (b.center - a.center);
      return distance(c, p) - (a.radius + t * (b.radius - a.radius));
    };
    double low = 0, high = 1;
    for (int i = 0; i < 40; ++i) {
      const double u = low + (high - low) / 3, v = high - (high - low) / 3;
      (at(u) < at(v) ? high : low) = at(u) < at(v) ? v : u;
    }
    least = std::min(least, at(low));
  }
  return least;
}

/// Points on the boundary of the hulls' union: on disks and on tangents, less those inside others.
std::vector<Vec2> boundary_points(const MedialAxis& axis) {
  std::vector<Vec2> points;
  for (const Node& node : axis.nodes)
    for (int k = 0; k < 8; ++k) {
      const double angle = 0.3 + k * 0.785398;
      points.push_back(node.disk.center +
                       node.disk.radius * Vec2{std::cos(angle), std::sin(angle)});
    }
  for (const Edge& edge : axis.edges) {
    const Disk &a = axis.nodes[edge.node[0]].disk, &b = axis.nodes[edge.node[1]].disk;
    const double length = distance(a.center, b.center);
    const double rate = (b.radius - a.radius) / length;
    if (!(length > 0) || std::abs(rate) >= 1) continue;
    const Vec2 along = (1 / length) * (b.center - a.center);
    for (const double side : {-1.0, 1.0}) {
      const Vec2 out = side * std::sqrt(1 - rate * rate) * left_of(along) - rate * along;
      for (const double t : {0.0, 0.5, 1.0})
        points.push_back(a.center + t * (b.center - a.center) +
                         (a.radius + t * (b.radius - a.radius)) * out);
    }
  }
  return points;
}

TEST(Pack, ComesBackWithinTheBound) {
  std::uint64_t checked = 0;
  for (std::uint64_t seed = 0; seed < pack_count; ++seed) {
    const RandomShape random = test::random_any(seed);
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    const auto shape = build_shape(random.rings);
    ASSERT_TRUE(shape.ok());
    if (shape->points.size() > 150) continue;
    auto axis = compute(*shape);
    ASSERT_TRUE(axis.ok());
    const double size = diagonal(bounding_box(*shape));
    const double error = size * (seed % 3 == 0 ? 0.03 : seed % 3 == 1 ? 3e-3 : 1e-4);
    const std::array<MedialAxis, 1> axes{*axis};
    PackReport report;
    const auto code = encode_axes(axes, {error, seed % 2 == 0 ? 0.3 : 0.2}, &report);
    ASSERT_TRUE(code.ok());
    const auto decoded = decode_axes(*code);
    ASSERT_TRUE(decoded.ok()) << decoded.error().text;
    ASSERT_EQ(decoded->size(), 1U);
    const MedialAxis& back = decoded->front();
    EXPECT_EQ(back.nodes.size(), report.disks);
    // Homotopy: as many parts and cycles as before.
    EXPECT_EQ(back.edges.size() + shape->component_count() - back.nodes.size(),
              shape->hole_count());
    const double bound = error * (1 + 1e-6);  // of the search
    for (std::size_t k = 0; k < shape->points.size(); k += 1 + shape->points.size() / 25)
      EXPECT_LE(outside(back, shape->points[k]), bound);
    for (std::size_t k = 0; k < axis->nodes.size(); k += 1 + axis->nodes.size() / 15) {
      const Disk& disk = axis->nodes[k].disk;
      EXPECT_LE(outside(back, disk.center + Vec2{0, disk.radius}), bound);
    }
    const std::vector<Vec2> points = boundary_points(back);
    for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / 25)
      EXPECT_GE(clearance(*shape, points[k]), -bound);
    // The shape that is rebuilt from it keeps the bound, too.
    const auto rebuilt = rebuild(back);
    ASSERT_TRUE(rebuilt.ok()) << rebuilt.error().text;
    for (std::size_t k = 0; k < rebuilt->points.size(); k += 1 + rebuilt->points.size() / 50)
      EXPECT_LE(std::abs(clearance(*shape, rebuilt->points[k])), bound);
    for (std::size_t k = 0; k < shape->points.size(); k += 1 + shape->points.size() / 25)
      EXPECT_GE(clearance(*rebuilt, shape->points[k]), -bound);
    for (std::size_t k = 0; k < axis->nodes.size(); k += 1 + axis->nodes.size() / 25) {
      const Disk& disk = axis->nodes[k].disk;
      EXPECT_GE(clearance(*rebuilt, disk.center), disk.radius - bound);
    }
    ++checked;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(checked, pack_count / 2);
}

/// Turned, scaled, mirrored, reversed and re-started: about as many disks (the grid that
/// they are rounded to decides some), and a shape within the error.
TEST(Pack, DoesNotDependOnHowTheShapeIsWritten) {
  std::uint64_t checked = 0;
  for (std::uint64_t seed = 0; seed < pack_count / 4; ++seed) {
    const RandomShape random = test::random_any(seed);
    if (!random.rigid) continue;
    const double size = diagonal(bounding_box(test::shape_of(random.rings)));
    double disks = 0;  // of the first, the identity
    for (std::size_t i = 0; i < test::symmetries().size(); ++i) {
      const test::Symmetry& symmetry = test::symmetries()[i];
      // Far from the origin the shape is another one: its coordinates are rounded.
      if (norm(Vec2{symmetry.dx, symmetry.dy}) > 1e4 * symmetry.scale() * size) continue;
      SCOPED_TRACE(random.kind + " " + std::to_string(seed) + " " + symmetry.name);
      const auto [shape, axis] = test::computed(test::symmetric(random.rings, i));
      const double error = 3e-3 * symmetry.scale() * size;
      PackReport report;
      const auto code = encode_axes({&axis, 1}, {error}, &report);
      ASSERT_TRUE(code.ok());
      const auto found = static_cast<double>(report.disks);
      if (i == 0) disks = found;
      const bool written_anew = symmetry.name == "reversed" || symmetry.name == "re-started";
      EXPECT_NEAR(found, disks, 1 + (written_anew ? 0.02 : 0.2) * disks);
      const auto back = decode_axes(*code);
      ASSERT_TRUE(back.ok());
      const auto rebuilt = rebuild(back->front());
      ASSERT_TRUE(rebuilt.ok());
      for (std::size_t k = 0; k < rebuilt->points.size(); k += 1 + rebuilt->points.size() / 25)
        EXPECT_LE(std::abs(clearance(shape, rebuilt->points[k])), error * (1 + 1e-6));
      ++checked;
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(checked, 0U);
}

TEST(Pack, OfARectangleIsSixDisks) {
  const auto shape = build_shape(test::rectangle(8, 2));
  ASSERT_TRUE(shape.ok());
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis.ok());
  PackReport report;
  const std::array<MedialAxis, 1> axes{*axis};
  ASSERT_TRUE(encode_axes(axes, {0.01}, &report).ok());
  EXPECT_EQ(report.disks, 6U);
  EXPECT_EQ(report.lines, 5U);
  // An error as large as the corners reach beyond the disks: a worm is left.
  ASSERT_TRUE(encode_axes(axes, {0.7, 0.1, 0.9}, &report).ok());
  EXPECT_EQ(report.disks, 2U);
  EXPECT_EQ(report.lines, 1U);
}

TEST(Pack, LinesOfUnevenZigzagsAreSimplifiedInFewSteps) {
  constexpr std::uint32_t n = 6000;
  for (const bool grows : {true, false}) {
    std::vector<Vec2> points;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double width = grows ? i : n - i;
      points.push_back({static_cast<double>(i), i % 2 == 0 ? width : -width});
    }
    std::uint64_t steps = 0;
    const auto excess = [&](std::uint32_t i, std::uint32_t first, std::uint32_t last) {
      ++steps;
      const Vec2 d = points[last] - points[first], v = points[i] - points[first];
      const double t = std::clamp(dot(d, v) / squared_norm(d), 0.0, 1.0);
      return norm(v - t * d) - 10;
    };
    const auto kept = ops::simplified(n, excess);
    EXPECT_LT(steps, 500 * n);
    ASSERT_GE(kept.size(), 2U);
    EXPECT_EQ(kept.front(), 0U);
    EXPECT_EQ(kept.back(), n - 1);
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
      ASSERT_LT(kept[k], kept[k + 1]);
      for (std::uint32_t i = kept[k] + 1; i < kept[k + 1]; ++i)
        EXPECT_LE(excess(i, kept[k], kept[k + 1]), 0);
    }
  }
}

TEST(Pack, RefusesErrorsThatItCannotKeep) {
  const auto shape = build_shape(test::rectangle(8, 2));
  auto axis = compute(*shape);
  ASSERT_TRUE(axis.ok());
  std::array<MedialAxis, 1> axes{*axis};
  for (const double error : {0.0, -1.0, 1e-40, 1e-16, std::nan("")}) {
    EXPECT_EQ(encode_axes(axes, {error}).error().code, ErrorCode::invalid_option) << error;
    EXPECT_EQ(encode_boundary({&*shape, 1}, error).error().code, ErrorCode::invalid_option)
        << error;
  }
  const auto far = build_shape(test::Rings{test::ring_of({{1e9, 0}, {1e9 + 1, 0}, {1e9, 1}})});
  EXPECT_TRUE(encode_boundary({&*far, 1}, 1e-6).ok());
  EXPECT_EQ(encode_boundary({&*far, 1}, 2e-9).error().text,
            "the error is too small for the coordinates");
  axes[0].nodes[0].disk.radius = std::nan("");
  EXPECT_EQ(encode_axes(axes, {0.1}).error().code, ErrorCode::not_finite);
}

TEST(Pack, OfAnySizeComesBack) {
  for (const double size : {1e-90, 1e-50, 1e-38, 1.0, 3e38, 3e45, 1e60, 1e90}) {
    SCOPED_TRACE(size);
    const auto axis = compute(test::shape_of(test::rectangle(8 * size, 2 * size)));
    ASSERT_TRUE(axis.ok());
    const auto code = encode_axes({&*axis, 1}, {0.01 * size});
    ASSERT_TRUE(code.ok()) << code.error().text;
    const auto back = decode_axes(*code);
    ASSERT_TRUE(back.ok()) << back.error().text;
    EXPECT_GE(back->front().resolution, 0.01 * size);
    EXPECT_LE(back->front().resolution, 0.01 * size * (1 + 1e-6));
    const auto shape = rebuild(back->front());
    ASSERT_TRUE(shape.ok()) << shape.error().text;
    EXPECT_NEAR(area(*shape) / (size * size), 16, 0.3);
  }
}

TEST(Pack, DamagedCodesAreRefused) {
  Random random(7);
  const RandomShape shape_with_holes = test::random_shape(12);
  const auto shape = build_shape(shape_with_holes.rings);
  ASSERT_TRUE(shape.ok());
  const auto axis = compute(*shape);
  ASSERT_TRUE(axis.ok());
  const std::array<MedialAxis, 1> axes{*axis};
  const auto code = encode_axes(axes, {1e-3 * diagonal(bounding_box(*shape))});
  ASSERT_TRUE(code.ok());
  const std::uint64_t rounds = 40 * pack_count;
  std::uint64_t refused = 0;
  for (std::uint64_t i = 0; i < rounds; ++i) {
    ShapeCode damaged = *code;
    auto& stream = damaged[random.next() % damaged.size()];
    if (stream.empty()) continue;
    const std::size_t at = random.next() % stream.size();
    switch (random.next() % 4) {
      case 0:
        stream[at] ^= static_cast<std::uint8_t>(1U << (random.next() % 8));
        break;
      case 1:
        stream[at] = static_cast<std::uint8_t>(random.next());
        break;
      case 2:
        stream.resize(at);
        break;
      default:
        stream.insert(stream.begin() + static_cast<std::ptrdiff_t>(at), 9, 0xFF);
    }
    const auto decoded = decode_axes(damaged);
    if (decoded.ok()) {
      for (const Edge& edge : decoded->front().edges)
        for (const std::uint32_t node : edge.node) ASSERT_LT(node, decoded->front().nodes.size());
      for (const Node& node : decoded->front().nodes) ASSERT_GE(node.disk.radius, 0);
    } else {
      ++refused;
      ASSERT_TRUE(decoded.error().code == ErrorCode::malformed ||
                  decoded.error().code == ErrorCode::unsupported);
    }
  }
  EXPECT_GT(refused, rounds / 3);
}

Image random_image(Random& random) {
  const auto side = [&random] { return static_cast<std::uint32_t>(1 + random.next() % 150); };
  Image image(side(), side());
  for (int blob = 0; blob < 6; ++blob) {
    const double cx = random.between(0, image.width()), cy = random.between(0, image.height());
    const double radius = random.between(1, 40);
    for (std::uint32_t y = 0; y < image.height(); ++y)
      for (std::uint32_t x = 0; x < image.width(); ++x)
        if (std::hypot(x - cx, y - cy) < radius) image.set(x, y);
  }
  for (int i = 0; i < 20; ++i)
    image.set(static_cast<std::uint32_t>(random.next() % image.width()),
              static_cast<std::uint32_t>(random.next() % image.height()), random.chance(0.5));
  return image;
}

TEST(Squares, KeepImages) {
  Random random(3);
  for (std::uint64_t i = 0; i < pack_count / 2; ++i) {
    const Image image = random_image(random);
    SquareReport report;
    const auto back = decode_squares(encode_squares(image, 0, &report));
    ASSERT_TRUE(back.ok());
    EXPECT_TRUE(*back == image);
    EXPECT_EQ(report.missing, 0U);
  }
}

TEST(Squares, MissAtMostTheError) {
  Random random(4);
  for (std::uint64_t i = 0; i < pack_count / 10; ++i) {
    const Image image = random_image(random);
    const std::uint32_t error = 1 + static_cast<std::uint32_t>(random.next() % 3);
    SquareReport report;
    const auto back = decode_squares(encode_squares(image, error, &report));
    ASSERT_TRUE(back.ok());
    std::uint64_t missing = 0;
    for (std::uint32_t y = 0; y < image.height(); ++y)
      for (std::uint32_t x = 0; x < image.width(); ++x) {
        ASSERT_LE(back->at(x, y), image.at(x, y));
        if (back->at(x, y) == image.at(x, y)) continue;
        ++missing;
        bool near = false;
        const auto e = static_cast<std::int64_t>(error);
        for (std::int64_t v = -e; v <= e; ++v)
          for (std::int64_t u = -e; u <= e; ++u) near = near || back->at(x + u, y + v);
        ASSERT_TRUE(near);
      }
    EXPECT_EQ(missing, report.missing);
  }
}

TEST(Squares, OfMoreThanAThousandPixelsKeepImages) {
  Image image(1600, 1200);
  for (std::uint32_t y = 0; y < image.height(); ++y)
    for (std::uint32_t x = 0; x < image.width(); ++x)
      if ((x / 7 + y / 5) % 211 != 3 || y > 40) image.set(x, y, true);
  SquareReport report;
  const auto back = decode_squares(encode_squares(image, 0, &report));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(report.missing, 0U);
  EXPECT_TRUE(*back == image);
}

TEST(Squares, OfASquareAreOne) {
  Image image(20, 10);
  for (std::uint32_t y = 2; y < 9; ++y)
    for (std::uint32_t x = 5; x < 12; ++x) image.set(x, y);
  SquareReport report;
  encode_squares(image, 0, &report);
  EXPECT_EQ(report.squares, 1U);
}

TEST(Squares, DamagedCodesAreRefused) {
  Random random(5);
  const ShapeCode code = encode_squares(random_image(random));
  for (std::uint64_t i = 0; i < 10 * pack_count; ++i) {
    ShapeCode damaged = code;
    auto& stream = damaged[random.next() % damaged.size()];
    if (stream.empty()) continue;
    const std::size_t at = random.next() % stream.size();
    if (random.chance(0.3)) {
      stream.resize(at);
    } else {
      stream[at] = static_cast<std::uint8_t>(random.next());
    }
    const auto image = decode_squares(damaged);
    if (!image.ok()) {
      ASSERT_TRUE(image.error().code == ErrorCode::malformed ||
                  image.error().code == ErrorCode::unsupported ||
                  image.error().code == ErrorCode::too_large);
    }
  }
}

}  // namespace
}  // namespace medial
