// One giant shape, made in memory: time and memory of its axis, whole or written in parts.
//
//     medial_bench_scale SHAPE VERTICES [-o FILE] [--whole] [--shape FILE]
//
// SHAPE: coast, comb, blob, needles, star. FILE: what `medial axis --parts` writes; without it
// parts are counted. With --shape the shape is written, and nothing computed. Prints one object in
// JSON: seconds of processor time and bytes a vertex, which is the peak above the shape alone.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "clock.h"
#include "medial/io/write.h"
#include "peak_memory.h"

namespace {

using medial::Vec2;
using Points = std::vector<Vec2>;

Vec2 polar(double radius, std::size_t i, std::size_t count) {
  const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Midpoints displaced at random, in a ring: as rough on every scale.
Points coast(std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  std::size_t first = count;
  while (first > 64) first = (first + 1) / 2;
  std::vector<double> radii(first), finer;
  double scale = 0.3;
  while (radii.size() < count) {
    finer.clear();
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const double next = radii[(i + 1) % radii.size()];
      finer.push_back(radii[i]);
      finer.push_back((radii[i] + next) / 2 + scale * shift(random));
    }
    radii.swap(finer);
    scale *= 0.55;
  }
  Points points;
  for (std::size_t i = 0; i < radii.size(); ++i)
    points.push_back(polar(1 + radii[i], i, radii.size()));
  return points;
}

Points comb(std::size_t count) {
  const std::size_t teeth = count / 4;
  Points points{{0, 0}, {static_cast<double>(2 * teeth - 1), 0}};
  for (std::size_t i = teeth; i-- > 0;) {
    const auto x = static_cast<double>(2 * i);
    points.push_back({x + 1, 6});
    points.push_back({x, 6});
    if (i > 0) {
      points.push_back({x, 1});
      points.push_back({x - 1, 1});
    }
  }
  return points;
}

Points blob(std::size_t count) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    points.push_back(polar(1 + 0.3 * std::cos(5 * angle) + 0.05 * std::cos(13 * angle), i, count));
  }
  return points;
}

/// A star; no two needles are equal.
Points needles(std::size_t count, bool alike, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double other = alike ? 0 : share(random);
    points.push_back(polar(i % 2 == 0 ? 1 + other : 0.5 + 0.1 * other, i, count));
  }
  return points;
}

medial::Result<medial::Shape> shape_of(const std::string& name, std::size_t count) {
  std::mt19937_64 random(1);
  medial::Ring ring;
  if (name == "coast") ring.points = coast(count, random);
  if (name == "comb") ring.points = comb(count);
  if (name == "blob") ring.points = blob(count);
  if (name == "needles" || name == "star") ring.points = needles(count, name == "star", random);
  return medial::build_shape({&ring, 1});
}

}  // namespace

int main(int count, char** words) {
  std::string output, shape_file;
  bool whole = false;
  for (int i = 3; i < count; ++i) {
    if (std::strcmp(words[i], "-o") == 0 && i + 1 < count) output = words[++i];
    if (std::strcmp(words[i], "--shape") == 0 && i + 1 < count) shape_file = words[++i];
    if (std::strcmp(words[i], "--whole") == 0) whole = true;
  }
  if (count < 3) return 2;
  auto shape = shape_of(words[1], std::strtoull(words[2], nullptr, 10));
  if (!shape) return std::puts(medial::to_string(shape.error()).c_str()), 1;
  medial::Document<medial::ShapeItem> file;
  file.items.push_back({std::move(*shape), {}});
  if (!shape_file.empty()) return medial::io::write_shapes(shape_file, "", file).ok() ? 0 : 1;
  const auto points = static_cast<double>(file.items[0].shape.points.size());
  std::uint64_t parts = 0, edges = 0;
  const medial::bench::PeakMemory memory;
  const double begin = medial::bench::processor_seconds();
  medial::Options options;
  options.threads = 1;
  if (whole) {
    const auto axis = medial::compute(file.items[0].shape, options);
    if (!axis) return std::puts(medial::to_string(axis.error()).c_str()), 1;
    edges = axis->edges.size();
  } else {
    const auto visit = [&](std::size_t, std::uint64_t, const medial::AxisPart& part) {
      ++parts;
      edges += part.axis.edges.size();
    };
    const auto done = medial::io::write_in_parts(output, "", std::move(file), {options}, {}, visit);
    if (!done) return std::puts(medial::to_string(done.error()).c_str()), 1;
  }
  const double seconds = medial::bench::processor_seconds() - begin;
  std::printf(
      "{\"shape\": \"%s\", \"vertices\": %.0f, \"parts\": %llu, \"edges\": %llu, \"seconds\": "
      "%.2f, "
      "\"microseconds_a_vertex\": %.3f, \"bytes_a_vertex\": %.1f}\n",
      words[1], points, static_cast<unsigned long long>(parts),
      static_cast<unsigned long long>(edges), seconds, 1e6 * seconds / points,
      memory.bytes() / points);
  return 0;
}
