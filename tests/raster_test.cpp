// Images: their topology, their exact distances, and brushfires, compared with simple computations.

#include "medial/raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <vector>

#include "medial/shape.h"
#include "methods/raster/disks.h"

namespace medial {
namespace {

Image parse(const std::vector<std::string>& rows) {
  Image image(static_cast<std::uint32_t>(rows[0].size()), static_cast<std::uint32_t>(rows.size()));
  for (std::uint32_t y = 0; y < image.height(); ++y)
    for (std::uint32_t x = 0; x < image.width(); ++x) image.set(x, y, rows[y][x] == '#');
  return image;
}

std::string text(const Image& image) {
  std::string rows;
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    for (std::uint32_t x = 0; x < image.width(); ++x) rows += image.at(x, y) ? '#' : '.';
    rows += '\n';
  }
  return rows;
}

/// Random pixels, smoothed so often that larger patches come about.
Image random_image(std::uint32_t width, std::uint32_t height, int smoothing, std::uint32_t seed) {
  std::mt19937 random(seed);
  Image image(width, height);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) image.set(x, y, random() % 100 < 52);
  for (int i = 0; i < smoothing; ++i) {
    const Image before = image;
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        int sum = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            sum += before.at(std::int64_t{x} + dx, std::int64_t{y} + dy);
        image.set(x, y, sum >= 5);
      }
    }
  }
  return image;
}

/// Parts of the pixels of one value in the image and a frame around it.
std::uint64_t count_parts(const Image& image, bool value, bool diagonal) {
  std::set<std::pair<std::int64_t, std::int64_t>> left;
  for (std::int64_t y = -1; y <= image.height(); ++y)
    for (std::int64_t x = -1; x <= image.width(); ++x)
      if (image.at(x, y) == value) left.insert({x, y});
  std::uint64_t parts = 0;
  while (!left.empty()) {
    ++parts;
    std::vector<std::pair<std::int64_t, std::int64_t>> stack{*left.begin()};
    left.erase(left.begin());
    while (!stack.empty()) {
      const auto [x, y] = stack.back();
      stack.pop_back();
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if ((diagonal || dx == 0 || dy == 0) && left.erase({x + dx, y + dy}) > 0)
            stack.emplace_back(x + dx, y + dy);
    }
  }
  return parts;
}

Topology flooded(const Image& image) {
  return {count_parts(image, true, true), count_parts(image, false, false) - 1};
}

TEST(Topology, IsWhatFloodingFinds) {
  for (std::uint32_t bits = 0; bits < 1 << 12; ++bits) {
    Image image(4, 3);
    for (std::uint32_t i = 0; i < 12; ++i) image.set(i % 4, i / 4, (bits >> i) & 1);
    ASSERT_EQ(topology(image), flooded(image)) << text(image);
  }
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const Image image = random_image(60 + 3 * seed, 20 + seed, static_cast<int>(seed % 3), seed);
    ASSERT_EQ(topology(image), flooded(image)) << text(image);
  }
}

TEST(Topology, OfNothingIsNothing) {
  EXPECT_EQ(topology(Image()), (Topology{0, 0}));
  EXPECT_EQ(topology(Image(70, 3)), (Topology{0, 0}));
}

/// Four times the squared distance, by looking at all pixels.
std::uint64_t looked_up(const Image& image, std::int64_t x, std::int64_t y,
                        const DistanceOptions& options) {
  std::uint64_t nearest = std::numeric_limits<std::uint64_t>::max();
  if (!image.at(x, y)) return 0;
  const bool cracks = options.to == DistanceTo::cracks;
  const std::int64_t border = options.outside_is_background || cracks ? 1 : 0;
  for (std::int64_t v = -border; v < image.height() + border; ++v) {
    for (std::int64_t u = -border; u < image.width() + border; ++u) {
      if (image.at(u, v)) continue;
      std::int64_t dx = 2 * std::abs(u - x), dy = 2 * std::abs(v - y);
      if (cracks) {
        dx = std::max<std::int64_t>(dx - 1, 0);
        dy = std::max<std::int64_t>(dy - 1, 0);
      }
      nearest = std::min(nearest, static_cast<std::uint64_t>(dx * dx + dy * dy));
    }
  }
  return nearest;
}

void expect_distances(const Image& image, const DistanceOptions& options) {
  const Result<DistanceMap> map = distance_transform(image, options);
  ASSERT_TRUE(map.ok());
  const std::uint64_t unit = options.to == DistanceTo::cracks ? 1 : 4;
  for (std::uint32_t y = 0; y < image.height(); ++y) {
    for (std::uint32_t x = 0; x < image.width(); ++x) {
      const std::uint64_t expected = looked_up(image, x, y, options);
      const std::uint32_t found = map->squared_at(x, y);
      if (expected == std::numeric_limits<std::uint64_t>::max()) {
        ASSERT_EQ(found, DistanceMap::unbounded);
        ASSERT_TRUE(std::isinf(map->at(x, y)));
      } else {
        ASSERT_EQ(unit * found, expected) << "at " << x << ", " << y << "\n" << text(image);
        ASSERT_DOUBLE_EQ(map->at(x, y), 0.5 * std::sqrt(static_cast<double>(expected)));
      }
    }
  }
}

TEST(Distance, IsTheNearestOfAllPixels) {
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    const Image image =
        random_image(1 + seed * 5 % 71, 1 + seed * 7 % 37, static_cast<int>(seed % 5), seed);
    for (const DistanceTo to : {DistanceTo::pixels, DistanceTo::cracks})
      for (const bool frame : {true, false}) expect_distances(image, {to, frame, 1});
  }
}

TEST(Distance, OfExtremes) {
  Image all(67, 5);
  for (std::uint32_t y = 0; y < 5; ++y)
    for (std::uint32_t x = 0; x < 67; ++x) all.set(x, y);
  Image one_missing = all;
  one_missing.set(66, 4, false);
  for (const Image& image : {all, one_missing, Image(67, 5)}) {
    for (const DistanceTo to : {DistanceTo::pixels, DistanceTo::cracks})
      for (const bool frame : {true, false}) expect_distances(image, {to, frame, 1});
  }
  EXPECT_TRUE(distance_transform(Image()).ok());
}

TEST(Distance, FitsIntoItsBitsUpToTheLargestSize) {
  // One row and one column as long as an image can be, with background at one end only.
  Image row(65534, 1);
  Image column(1, 65534);
  for (std::uint32_t i = 0; i + 1 < 65534; ++i) {
    row.set(i, 0);
    column.set(0, i);
  }
  const auto of_row = distance_transform(row, {DistanceTo::pixels, false, 1});
  const auto of_column = distance_transform(column, {DistanceTo::pixels, false, 1});
  ASSERT_TRUE(of_row.ok() && of_column.ok());
  EXPECT_EQ(of_row->squared_at(0, 0), 65533U * 65533U);
  EXPECT_EQ(of_column->squared_at(0, 0), 65533U * 65533U);
  EXPECT_FALSE(fits_image(65535, 1));
  EXPECT_EQ(distance_transform(Image(65535, 1)).error().code, ErrorCode::too_large);
}

TEST(Distance, IsTheSameWithAnyNumberOfThreads) {
  const Image image = random_image(2100, 300, 2, 7);
  const auto one = distance_transform(image, {DistanceTo::pixels, true, 1});
  const auto four = distance_transform(image, {DistanceTo::pixels, true, 4});
  ASSERT_TRUE(one.ok() && four.ok());
  EXPECT_EQ(one->squared, four->squared);
  EXPECT_EQ(distance_transform(image, {DistanceTo::pixels, true, -1}).error().code,
            ErrorCode::invalid_option);
}

TEST(Distance, DisksAroundAllPixelsAreTheImage) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const Image image = random_image(70, 45, static_cast<int>(seed % 5), seed);
    const auto distances = distance_transform(image);
    const auto cracks = distance_transform(image, {DistanceTo::cracks, true, 1});
    ASSERT_TRUE(distances.ok() && cracks.ok());
    EXPECT_EQ(text(union_of_disks(image, *distances)), text(image));
    std::vector<Disk> disks;
    for (std::uint32_t y = 0; y < 45; ++y)
      for (std::uint32_t x = 0; x < 70; ++x)
        if (image.at(x, y)) disks.push_back({{x + 0.5, y + 0.5}, cracks->at(x, y)});
    EXPECT_EQ(text(union_of_disks(70, 45, disks)), text(image));
  }
  // One disk, of the squared radius 9: open.
  Image one(9, 9);
  one.set(4, 4);
  DistanceMap nine{9, 9, std::vector<std::uint32_t>(81, 9), DistanceTo::pixels};
  const Image disk = union_of_disks(one, nine);
  EXPECT_EQ(disk.count(), 25U);
  EXPECT_TRUE(disk.at(2, 2) && disk.at(4, 2) && !disk.at(4, 1));
}

/// Twice the area inside a ring, positive where the foreground lies inside.
double doubled_area(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.points.size(); ++i)
    sum += cross(ring.points[i], ring.points[(i + 1) % ring.points.size()]);
  return sum;
}

void expect_outline(const Image& image) {
  const auto rings = pixel_outline(image, 0);
  ASSERT_TRUE(rings.ok());
  Topology found;
  double doubled = 0;
  for (const Ring& ring : *rings) {
    ++(doubled_area(ring) > 0 ? found.components : found.holes);
    doubled += doubled_area(ring);
  }
  EXPECT_EQ(found, topology(image)) << text(image);
  EXPECT_EQ(doubled, 2 * static_cast<double>(image.count()));
  if (rings->empty()) return;
  ShapeReport report;
  const auto shape = build_shape(*rings, {}, &report);
  ASSERT_TRUE(shape.ok()) << to_string(shape.error()) << text(image);
  EXPECT_EQ(area(*shape), static_cast<double>(image.count()));
  EXPECT_EQ(report.collinear_points + report.repeated_points, 0U);
  // The interior is connected over sides only: pixels that touch at a corner are another component.
  EXPECT_EQ(shape->component_count(), count_parts(image, true, false)) << text(image);

  // Through necks it is connected as the image is.
  const auto connected_rings = pixel_outline(image);
  ASSERT_TRUE(connected_rings.ok());
  const auto connected = build_shape(*connected_rings);
  ASSERT_TRUE(connected.ok()) << to_string(connected.error()) << text(image);
  EXPECT_EQ((Topology{connected->component_count(), connected->hole_count()}), topology(image));
  EXPECT_NEAR(area(*connected), area(*shape), static_cast<double>(connected->points.size()) / 512);
}

TEST(Outline, HasARingForEachComponentAndHole) {
  for (std::uint32_t bits = 0; bits < 1 << 16; bits += 3) {
    Image image(4, 4);
    for (std::uint32_t i = 0; i < 16; ++i) image.set(i % 4, i / 4, (bits >> i) & 1);
    expect_outline(image);
    if (HasFatalFailure()) return;
  }
  for (std::uint32_t seed = 0; seed < 20; ++seed)
    expect_outline(random_image(80 + seed, 50, static_cast<int>(seed % 4), seed));
}

TEST(Outline, GoesTwiceThroughACornerWherePixelsTouch) {
  const auto pair = pixel_outline(parse({"#.", ".#"}), 0);
  ASSERT_TRUE(pair.ok());
  ASSERT_EQ(pair->size(), 1U);
  EXPECT_EQ(std::ranges::count((*pair)[0].points, Vec2{1, 1}), 2);
  const auto holes = pixel_outline(parse({"####", "#.##", "##.#", "####"}), 0);
  ASSERT_TRUE(holes.ok());
  ASSERT_EQ(holes->size(), 3U);
  EXPECT_EQ((*holes)[1].points.size() + (*holes)[2].points.size(), 8U);
  EXPECT_EQ(pixel_outline(Image(1, 1), 0.5).error().code, ErrorCode::invalid_option);
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const double t = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
  return norm(p - (a + t * (b - a)));
}

/// The largest distance of points on the contour from a ring, and of the ring's corners from it.
std::pair<double, double> distances_between(const Contour& contour, const Ring& ring) {
  std::vector<Vec2> samples;
  for (const CurvePiece& piece : contour.pieces) {
    for (int i = 0; i < 16; ++i) {
      const double t = i / 16.0, s = 1 - t;
      const Vec2* const p = contour.points.data() + piece.first;
      samples.push_back(s * s * p[0] + 2 * s * t * p[1] + t * t * p[2]);
    }
  }
  double out = 0, back = 0;
  for (const Vec2 sample : samples) {
    double nearest = 1e9;
    for (std::size_t i = 0; i < ring.points.size(); ++i)
      nearest = std::min(nearest, distance_to_segment(sample, ring.points[i],
                                                      ring.points[(i + 1) % ring.points.size()]));
    out = std::max(out, nearest);
  }
  for (const Vec2 corner : ring.points) {
    double nearest = 1e9;
    for (std::size_t i = 0; i < samples.size(); ++i)
      nearest = std::min(
          nearest, distance_to_segment(corner, samples[i], samples[(i + 1) % samples.size()]));
    back = std::max(back, nearest);
  }
  return {out, back};
}

void expect_smooth_outline(const Image& image) {
  const auto rings = pixel_outline(image, 0);
  const auto contours = smooth_outline(image);
  ASSERT_TRUE(rings.ok() && contours.ok());
  ASSERT_EQ(rings->size(), contours->size());
  for (std::size_t i = 0; i < rings->size(); ++i) {
    const auto [out, back] = distances_between((*contours)[i], (*rings)[i]);
    EXPECT_LE(out, 0.5) << text(image);
    EXPECT_LE(back, 0.501) << text(image);
  }
  const auto arcs = approximate_by_arcs(*contours);
  ASSERT_TRUE(arcs.ok()) << to_string(arcs.error());
  const auto shape = build_shape(*arcs);
  ASSERT_TRUE(shape.ok()) << to_string(shape.error()) << text(image);
  // Necks connect pixels that touch at a corner: the shape has the image's own topology.
  EXPECT_EQ((Topology{shape->component_count(), shape->hole_count()}), topology(image))
      << text(image);
}

TEST(SmoothOutline, StaysSimpleAndNear) {
  for (std::uint32_t bits = 1; bits < 1 << 12; bits += 7) {
    Image image(4, 3);
    for (std::uint32_t i = 0; i < 12; ++i) image.set(i % 4, i / 4, (bits >> i) & 1);
    expect_smooth_outline(image);
    if (HasFailure()) return;
  }
  for (std::uint32_t seed = 0; seed < 12; ++seed)
    expect_smooth_outline(random_image(30 + seed, 25, static_cast<int>(seed % 4), seed));
}

TEST(SmoothOutline, CoordinatesAreZeroOrNoMuchSmallerThanAPixel) {
  // Along the image's own border offsets tend to 0, the further from the ends the more.
  Image image(6, 600);
  for (std::uint32_t y = 0; y < 600; ++y)
    for (std::uint32_t x = 0; x < 6; ++x) image.set(x, y, x < 4 || (y > 20 && y < 30));
  const auto contours = smooth_outline(image);
  ASSERT_TRUE(contours.ok());
  for (const Contour& contour : *contours)
    for (const Vec2 p : contour.points) {
      EXPECT_TRUE(p.x == 0 || std::abs(p.x) > 0x1p-42) << p.x;
      EXPECT_TRUE(p.y == 0 || std::abs(p.y) > 0x1p-42) << p.y;
    }
  EXPECT_TRUE(build_shape(*approximate_by_arcs(*contours)).ok());
}

TEST(SmoothOutline, MakesStairsStraight) {
  // A long stripe of slope 1/7: away from its ends the curve has nearly no bend.
  Image image(240, 60);
  for (std::uint32_t x = 4; x < 236; ++x)
    for (std::uint32_t y = 0; y < 14; ++y) image.set(x, 5 + y + x / 7, true);
  const auto contours = smooth_outline(image);
  ASSERT_TRUE(contours.ok());
  double largest = 0;
  for (const CurvePiece& piece : (*contours)[0].pieces) {
    const Vec2* const p = (*contours)[0].points.data() + piece.first;
    if (p[1].x < 40 || p[1].x > 200) continue;
    const Vec2 in = p[1] - p[0], out = p[2] - p[1];
    largest = std::max(largest, std::abs(std::atan2(cross(in, out), dot(in, out))));
  }
  EXPECT_LT(largest, 0.05);  // radians
}

TEST(SmoothOutline, EnclosesTheAreaOfThePixels) {
  const auto expect_area = [](const Image& image, double share) {
    const auto contours = smooth_outline(image);
    ASSERT_TRUE(contours.ok());
    const auto shape = build_shape(*approximate_by_arcs(*contours));
    ASSERT_TRUE(shape.ok());
    const auto pixels = static_cast<double>(image.count());
    EXPECT_NEAR(area(*shape), pixels, share * pixels) << text(image);
  };
  for (const std::uint32_t side : {4U, 5U, 7U, 9U, 12U, 17U, 30U, 61U}) {
    Image square(side + 6, side + 4), frame(2 * side, 2 * side), disk(side + 1, side + 1);
    for (std::uint32_t y = 0; y < 2 * side; ++y)
      for (std::uint32_t x = 0; x < 2 * side; ++x) {
        if (x < side && y < side) square.set(x + 3, y + 2);
        const bool inner = x >= side / 2 && x < 3 * side / 2 && y >= side / 2 && y < 3 * side / 2;
        if (side > 7 && !inner) frame.set(x, y);
        if (x <= side && y <= side && std::hypot(2.0 * x - side, 2.0 * y - side) < side)
          disk.set(x, y);
      }
    const double share = side < 12 ? 0.04 : 0.02;
    expect_area(square, share);
    if (side > 4) expect_area(disk, share);  // three pixels across otherwise
    if (side > 7) expect_area(frame, share);
  }
}

constexpr std::array families = {Brushfire::sequential, Brushfire::sides, Brushfire::marking,
                                 Brushfire::simultaneous};

Image thinned(const Image& image, Brushfire family) {
  BrushfireOptions options;
  options.family = family;
  Result<Image> result = thin(image, options);
  EXPECT_TRUE(result.ok());
  return result ? *result : Image();
}

/// The neighbours from the north on clockwise.
std::array<bool, 8> around(const Image& image, std::int64_t x, std::int64_t y) {
  return {image.at(x, y - 1), image.at(x + 1, y - 1), image.at(x + 1, y), image.at(x + 1, y + 1),
          image.at(x, y + 1), image.at(x - 1, y + 1), image.at(x - 1, y), image.at(x - 1, y - 1)};
}

int neighbors_of(const Image& image, std::int64_t x, std::int64_t y) {
  const auto p = around(image, x, y);
  return static_cast<int>(std::ranges::count(p, true));
}

/// Whether deleting a pixel keeps the topology of its three by three surroundings.
bool is_simple(const Image& image, std::int64_t x, std::int64_t y) {
  const auto p = around(image, x, y);
  int crossings = 0;
  for (std::size_t k = 0; k < 8; k += 2) crossings += !p[k] && (p[k + 1] || p[(k + 2) % 8]);
  return crossings == 1;
}

/// The rule of each family, pixel by pixel as the papers have it; sweeps over the whole image.
Image swept(Image image, Brushfire family) {
  const auto each = [&image](const auto& visit) {
    for (std::uint32_t y = 0; y < image.height(); ++y)
      for (std::uint32_t x = 0; x < image.width(); ++x)
        if (image.at(x, y)) visit(x, y);
  };
  using Pixels = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  const auto remove = [&image](const Pixels& pixels) {
    for (const auto& [x, y] : pixels) image.set(x, y, false);
    return !pixels.empty();
  };
  for (bool changed = true; changed;) {
    changed = false;
    if (family == Brushfire::sequential) {
      Image border = image;
      each([&](auto x, auto y) {
        const auto p = around(image, x, y);
        if (p[0] && p[2] && p[4] && p[6]) border.set(x, y, false);
      });
      for (const auto& [column, row] : {std::pair{0U, 0U}, {1U, 1U}, {1U, 0U}, {0U, 1U}}) {
        each([&, column = column, row = row](auto x, auto y) {
          if (x % 2 != column || y % 2 != row || !border.at(x, y)) return;
          if (!is_simple(image, x, y) || neighbors_of(image, x, y) < 2) return;
          image.set(x, y, false);
          changed = true;
        });
      }
    } else if (family == Brushfire::sides) {
      for (const std::size_t side : {0U, 4U, 6U, 2U}) {
        Pixels gone;
        each([&](auto x, auto y) {
          if (!around(image, x, y)[side] && is_simple(image, x, y) && neighbors_of(image, x, y) > 1)
            gone.emplace_back(x, y);
        });
        changed |= remove(gone);
      }
    } else if (family == Brushfire::marking) {
      for (const bool first : {true, false}) {
        Pixels gone;
        each([&](auto x, auto y) {
          const auto [p2, p3, p4, p5, p6, p7, p8, p9] = around(image, x, y);
          const int n1 = (p9 || p2) + (p3 || p4) + (p5 || p6) + (p7 || p8);
          const int n2 = (p2 || p3) + (p4 || p5) + (p6 || p7) + (p8 || p9);
          const int n = std::min(n1, n2);
          const bool kept = first ? (p6 || p7 || !p9) && p8 : (p2 || p3 || !p5) && p4;
          if (is_simple(image, x, y) && n >= 2 && n <= 3 && !kept) gone.emplace_back(x, y);
        });
        changed |= remove(gone);
      }
    } else {
      // Of every critical clique of pixels that would all go, the first one stays.
      Image goes = image;
      each([&](auto x, auto y) {
        if (!is_simple(image, x, y) || neighbors_of(image, x, y) < 2) goes.set(x, y, false);
      });
      Image stays(image.width(), image.height());
      const auto keep_first = [&](const Pixels& clique) {
        for (const auto& [x, y] : clique)
          if (!goes.at(x, y)) return;
        stays.set(clique[0].first, clique[0].second);
      };
      for (std::int64_t y = -1; y < image.height(); ++y) {
        for (std::int64_t x = -1; x < image.width(); ++x) {
          const bool a = image.at(x, y), b = image.at(x + 1, y), c = image.at(x, y + 1),
                     d = image.at(x + 1, y + 1);
          const auto u = static_cast<std::uint32_t>(x), v = static_cast<std::uint32_t>(y);
          if ((a && d) || (b && c)) {
            Pixels clique;
            if (a) clique.emplace_back(u, v);
            if (b) clique.emplace_back(u + 1, v);
            if (c) clique.emplace_back(u, v + 1);
            if (d) clique.emplace_back(u + 1, v + 1);
            keep_first(clique);
          }
          const auto touched = [&](std::int64_t x1, std::int64_t y1, std::int64_t x2,
                                   std::int64_t y2) {
            return image.at(x1, y1) || image.at(x2, y2);
          };
          if (a && b && touched(x, y - 1, x + 1, y - 1) == touched(x, y + 1, x + 1, y + 1))
            keep_first({{u, v}, {u + 1, v}});
          if (a && c && touched(x - 1, y, x - 1, y + 1) == touched(x + 1, y, x + 1, y + 1))
            keep_first({{u, v}, {u, v + 1}});
        }
      }
      Pixels gone;
      each([&](auto x, auto y) {
        if (goes.at(x, y) && !stays.at(x, y)) gone.emplace_back(x, y);
      });
      changed |= remove(gone);
    }
  }
  return image;
}

class Families : public testing::TestWithParam<Brushfire> {};

TEST_P(Families, SweepTheWholeImage) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const Image image =
        random_image(1 + seed * 11 % 97, 1 + seed * 13 % 53, static_cast<int>(seed % 6), seed);
    ASSERT_EQ(text(thinned(image, GetParam())), text(swept(image, GetParam()))) << text(image);
  }
}

TEST_P(Families, KeepTheTopologyOfEverySmallImage) {
  // All images of four by four pixels, far enough from each other in one.
  constexpr std::uint32_t step = 6;
  for (std::uint32_t part = 0; part < 16; ++part) {
    Image sheet(64 * step, 64 * step);
    for (std::uint32_t i = 0; i < 4096; ++i) {
      const std::uint32_t bits = part * 4096 + i, left = i % 64 * step, top = i / 64 * step;
      for (std::uint32_t k = 0; k < 16; ++k)
        if ((bits >> k) & 1) sheet.set(left + k % 4, top + k / 4);
    }
    const Image thin_sheet = thinned(sheet, GetParam());
    for (std::uint32_t i = 0; i < 4096; ++i) {
      Image before(4, 4), after(4, 4);
      for (std::uint32_t k = 0; k < 16; ++k) {
        const std::uint32_t x = i % 64 * step + k % 4, y = i / 64 * step + k / 4;
        before.set(k % 4, k / 4, sheet.at(x, y));
        after.set(k % 4, k / 4, thin_sheet.at(x, y));
      }
      ASSERT_EQ(topology(after), topology(before)) << text(before) << '\n' << text(after);
    }
  }
}

TEST_P(Families, ThinWhatTheyKeep) {
  for (std::uint32_t seed = 100; seed < 130; ++seed) {
    const Image image = random_image(150, 90, static_cast<int>(seed % 6), seed);
    const Image axis = thinned(image, GetParam());
    EXPECT_EQ(topology(axis), topology(image));
    for (std::uint32_t y = 0; y < axis.height(); ++y)
      for (std::uint32_t x = 0; x < axis.width(); ++x)
        ASSERT_FALSE(axis.at(x, y) && !image.at(x, y));
    // Nothing is left to go.
    EXPECT_EQ(text(thinned(axis, GetParam())), text(axis));
  }
}

TEST_P(Families, NeitherVanishNorStayTwoPixelsWide) {
  for (const std::uint32_t width : {2U, 3U, 4U, 7U, 8U}) {
    for (const std::uint32_t length : {2U, 5U, 30U}) {
      for (const bool upright : {false, true}) {
        Image bar(40, 40);
        for (std::uint32_t i = 0; i < length; ++i)
          for (std::uint32_t k = 0; k < width; ++k)
            bar.set(5 + (upright ? k : i), 5 + (upright ? i : k));
        const Image axis = thinned(bar, GetParam());
        EXPECT_EQ(topology(axis), (Topology{1, 0})) << text(bar) << text(axis);
        for (std::uint32_t i = length / 2; i == length / 2 && length > 2 * width; ++i) {
          int across = 0;
          for (std::uint32_t k = 0; k < 40; ++k)
            across += upright ? axis.at(k, 5 + i) : axis.at(5 + i, k);
          EXPECT_EQ(across, 1) << text(axis);
        }
      }
    }
  }
}

TEST_P(Families, AreNamed) {
  EXPECT_EQ(brushfire_from(name_of(GetParam())), GetParam());
  EXPECT_EQ(brushfire_from("fire"), std::nullopt);
}

TEST_P(Families, StopWhenTold) {
  const std::atomic<bool> cancel = true;
  BrushfireOptions options;
  options.family = GetParam();
  options.cancel = &cancel;
  EXPECT_EQ(thin(random_image(90, 90, 3, 1), options).error().code, ErrorCode::cancelled);
}

INSTANTIATE_TEST_SUITE_P(Brushfire, Families, testing::ValuesIn(families),
                         [](const auto& instance) { return std::string(name_of(instance.param)); });

TEST(Brushfire, LeavesLinesAlone) {
  const Image lines = parse({"#.....#...", ".#....#...", "..####....", ".....#....", "..#...#..#"});
  for (const Brushfire family : {Brushfire::sides, Brushfire::marking, Brushfire::simultaneous})
    EXPECT_EQ(text(thinned(lines, family)), text(thinned(thinned(lines, family), family)));
  EXPECT_TRUE(thin(Image()).ok());
}

}  // namespace
}  // namespace medial
