#include "support/silhouettes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string_view>
#include <vector>

#include "support/generate.h"

namespace medial::test {
namespace {

/// All points within a radius of a way from a to b, the radius going from one to another.
struct Stroke {
  Vec2 a, b;
  double radius_a, radius_b;
  bool filled = true;  ///< or cut out
};
using Strokes = std::vector<Stroke>;

bool covers(const Stroke& stroke, Vec2 p) {
  const Vec2 along = stroke.b - stroke.a;
  const double square = squared_norm(along);
  const double t = square > 0 ? std::clamp(dot(p - stroke.a, along) / square, 0.0, 1.0) : 0;
  return distance(p, stroke.a + t * along) <=
         stroke.radius_a + t * (stroke.radius_b - stroke.radius_a);
}

bool covers(const Strokes& strokes, Vec2 p) {
  bool inside = false;
  for (const Stroke& stroke : strokes)
    if (inside != stroke.filled && covers(stroke, p)) inside = stroke.filled;
  return inside;
}

Vec2 polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Strokes hand(Random& random) {
  Strokes strokes = {{{0, -0.2}, {0, 0.1}, 0.3, 0.33}};
  for (int i = 0; i < 5; ++i) {
    const double angle = 2.6 - 0.5 * i + random.between(-0.08, 0.08);
    const double wide = random.between(0.06, 0.09);
    strokes.push_back(
        {polar(0.25, angle), polar(random.between(0.6, 0.95), angle), wide * 1.2, wide});
  }
  strokes.push_back({{0, -0.2}, {random.between(-0.1, 0.1), -0.9}, 0.22, 0.18});
  return strokes;
}

Strokes tool(Random& random) {
  Strokes strokes = {{{-0.8, 0}, {0.5, 0}, random.between(0.05, 0.12), random.between(0.06, 0.15)},
                     {{0.6, 0}, {0.6, 0}, 0.3, 0.3},
                     {{0.6, 0}, {random.between(0.6, 1.0), 0}, 0.14, 0.14, false}};
  const auto teeth = static_cast<int>(random.integer(0, 4));
  for (int i = 0; i < teeth; ++i) {
    const double x = -0.75 + 0.14 * i;
    strokes.push_back({{x, 0}, {x, random.between(-0.3, -0.15)}, 0.04, 0.03});
  }
  if (random.chance(0.5)) strokes.push_back({{-0.8, -0.25}, {-0.8, 0.25}, 0.1, 0.1});
  return strokes;
}

/// Letters as strokes from node to node of a grid of 3 x 5.
Strokes letter(Random& random) {
  constexpr std::array<std::string_view, 10> letters = {
      "AKKOAC MC",  // two node names a stroke
      "AMAC GIMO", "AMMO", "AMBNAC", "AMGICOAO", "AMCOGI", "AOCM", "ACBN", "AKKEEC", "ACCGGOOM"};
  std::string_view name = letters[static_cast<std::size_t>(random.integer(0, 9))];
  const double wide = random.between(0.06, 0.16);
  const auto node = [&](char c) {
    const int i = c - 'A';
    return Vec2{-0.5 + 0.5 * (i % 3), 0.9 - 0.45 * std::floor(i / 3)};
  };
  Strokes strokes;
  for (std::size_t i = 0; i + 1 < name.size(); i += 2) {
    if (name[i] == ' ') ++i;
    strokes.push_back({node(name[i]), node(name[i + 1]), wide, wide});
  }
  return strokes;
}

Strokes twig(Random& random) {
  Strokes strokes;
  const std::function<void(Vec2, double, double, double, int)> grow =
      [&](Vec2 p, double angle, double length, double wide, int depth) {
        const Vec2 end = p + polar(length, angle);
        strokes.push_back({p, end, wide, 0.7 * wide});
        if (depth == 0) return;
        for (const double side : {-1.0, 1.0})
          grow(end, angle + side * random.between(0.2, 0.8), length * random.between(0.55, 0.8),
               0.65 * wide, depth - 1);
      };
  grow({0, -0.9}, 0.5 * std::numbers::pi, 0.55, random.between(0.05, 0.1),
       static_cast<int>(random.integer(2, 4)));
  return strokes;
}

/// A region around the origin by its radius: a blob, or a leaf with teeth.
std::function<bool(Vec2)> round(Random& random, bool leaf) {
  std::array<double, 8> size{}, phase{};
  for (std::size_t i = 0; i < size.size(); ++i) {
    size[i] = random.between(0, 0.35) / (1 + static_cast<double>(i));
    phase[i] = random.between(0, 2 * std::numbers::pi);
  }
  const double teeth = leaf ? std::floor(random.between(8, 30)) : 0;
  return [=](Vec2 p) {
    const double angle = std::atan2(p.y, p.x);
    double radius = leaf ? 0.35 + 0.6 * std::pow(std::abs(std::cos(angle)), 2.0) : 0.7;
    for (std::size_t i = 0; i < size.size(); ++i)
      radius *= 1 + 0.7 * size[i] * std::cos((static_cast<double>(i) + 2) * angle + phase[i]);
    radius *= 1 + 0.08 * std::abs(std::sin(0.5 * teeth * angle));
    return norm(p) < 0.85 * radius;
  };
}

/// Draws what `inside` says of [-1.5, 1.5]^2, turned; borders frayed by `noise`.
Image drawn(const std::function<bool(Vec2)>& inside, Random& random, std::uint32_t pixels,
            double noise) {
  Image image(pixels, pixels);
  const Vec2 turn = polar(1, random.between(0, 2 * std::numbers::pi));
  for (std::uint32_t y = 0; y < pixels; ++y)
    for (std::uint32_t x = 0; x < pixels; ++x) {
      const Vec2 q{3 * (x + 0.5) / pixels - 1.5, 3 * (y + 0.5) / pixels - 1.5};
      const double jitter = noise > 0 ? noise * 3 / pixels : 0;
      const Vec2 p{q.x + random.between(-jitter, jitter), q.y + random.between(-jitter, jitter)};
      image.set(x, y, inside({turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y}));
    }
  return image;
}

double noise_of(Random& random) { return random.chance(0.3) ? random.between(0, 1.5) : 0; }

}  // namespace

Silhouette silhouette(std::uint64_t seed, std::uint32_t pixels) {
  Random random(seed);
  constexpr std::array<const char*, 6> kinds = {"blob", "leaf", "hand", "tool", "letter", "twig"};
  const auto kind = static_cast<std::size_t>(random.integer(0, 5));
  std::function<bool(Vec2)> inside;
  if (kind < 2) {
    inside = round(random, kind == 1);
  } else {
    constexpr std::array<Strokes (*)(Random&), 4> makers = {hand, tool, letter, twig};
    inside = [strokes = makers[kind - 2](random)](Vec2 p) { return covers(strokes, p); };
  }
  const double noise = noise_of(random);
  return {kinds[kind], drawn(inside, random, pixels, noise)};
}

Image redrawn(const Image& image, std::uint64_t seed, std::uint32_t pixels) {
  Random random(seed);
  const double scale = std::max(image.width(), image.height()) / 2.0;
  const Vec2 middle{image.width() / 2.0, image.height() / 2.0};
  const double noise = noise_of(random);
  return drawn(
      [&](Vec2 p) {
        const Vec2 q = middle + scale * p;
        return image.at(static_cast<std::int64_t>(std::floor(q.x)),
                        static_cast<std::int64_t>(std::floor(q.y)));
      },
      random, pixels, noise);
}

std::uint32_t silhouette_size(std::uint64_t seed, std::uint32_t most) {
  Random random(seed ^ 0x5117);
  return static_cast<std::uint32_t>(random.power_of_ten(std::log10(50.0), std::log10(most)));
}

}  // namespace medial::test
