// Small shapes, one after another on one thread: footprints and glyphs.
//
//     medial_bench_small [FONT...]
//
// Glyphs become arcs within a 64th of a font unit, the default of fonts.
//
// Prints microseconds of processor time, the least of five rounds: for a footprint in the shape of
// an L its shape and axis, and Boost.Polygon's diagram beside it; for a glyph (of each font the
// first 1,000 with an outline) what is done from its curves to a verified axis. What the library
// refuses is counted.

#include <algorithm>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "axes/peers.h"
#include "clock.h"
#include "medial/compute.h"
#include "medial/contour.h"
#include "medial/io/read.h"
#include "medial/shape.h"
#include "medial/verify.h"

namespace {

using medial::Ring;
using Shapes = std::vector<std::vector<Ring>>;

constexpr std::size_t most_glyphs = 1000;
constexpr double font_tolerance = 1.0 / 64;

Shapes footprints() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> side(4, 20), share(0.3, 0.7), place(0, 1e5);
  Shapes all(10000);
  for (std::vector<Ring>& rings : all) {
    const double x = place(random), y = place(random), a = side(random), b = side(random);
    const double c = a * share(random), d = b * share(random);
    rings.emplace_back().points = {{x, y},         {x + a, y},     {x + a, y + d},
                                   {x + c, y + d}, {x + c, y + b}, {x, y + b}};
  }
  return all;
}

/// Microseconds for each of `count` items.
double least(std::size_t count, const std::function<void()>& work) {
  double best = 0;
  for (int round = 0; round < 5; ++round) {
    const double begin = medial::bench::processor_seconds();
    work();
    const double seconds = medial::bench::processor_seconds() - begin;
    best = round == 0 ? seconds : std::min(best, seconds);
  }
  return 1e6 * best / static_cast<double>(count);
}

struct Steps {
  bool axis = true, verify = false;
};

/// 1 if all steps succeed, else 0.
std::size_t run(const std::vector<Ring>& rings, const Steps& steps) {
  const auto shape = medial::build_shape(rings);
  if (!shape || !steps.axis) return shape.ok() ? 1 : 0;
  medial::Options options;
  options.threads = 1;
  const auto axis = medial::compute(*shape, options);
  if (!axis || !steps.verify) return axis.ok() ? 1 : 0;
  return medial::verify(*shape, *axis, {.threads = 1}).passed ? 1 : 0;
}

void measure_footprints() {
  const Shapes all = footprints();
  const auto row = [&](const char* what, const Steps& steps) {
    std::size_t good = 0;
    const double time = least(all.size(), [&] {
      good = 0;
      for (const std::vector<Ring>& rings : all) good += run(rings, steps);
    });
    std::printf("| L-shaped footprint: %s | %.2f | %zu of %zu |\n", what, time, good, all.size());
  };
  row("shape", {.axis = false});
  row("shape and axis", {});
  row("shape, axis and `verify`", {.verify = true});
  double boost = 0;
  for (const std::vector<Ring>& rings : all) boost += medial::bench::run_boost(rings).seconds;
  std::printf("| the same, Boost.Polygon %s | %.2f | |\n", medial::bench::boost_version().c_str(),
              1e6 * boost / static_cast<double>(all.size()));
}

/// The glyphs' outlines.
std::vector<medial::Feature> glyphs_of(const std::string& font) {
  std::vector<medial::Feature> glyphs;
  for (unsigned code = 33; code < 0x2000 && glyphs.size() < most_glyphs; ++code) {
    std::string text;  // in UTF-8
    const auto add = [&](unsigned byte) { text.push_back(static_cast<char>(byte)); };
    if (code < 0x80) add(code);
    if (code >= 0x80 && code < 0x800) add(0xC0 | code >> 6);
    if (code >= 0x800) {
      add(0xE0 | code >> 12);
      add(0x80 | (code >> 6 & 0x3F));
    }
    if (code >= 0x80) add(0x80 | (code & 0x3F));
    auto read = medial::io::read_text(text, font);
    if (read)
      for (medial::Feature& glyph : read->items) glyphs.push_back(std::move(glyph));
  }
  return glyphs;
}

void measure_glyphs(const std::string& font) {
  const std::vector<medial::Feature> glyphs = glyphs_of(font);
  const auto row = [&](const char* what, const Steps* steps) {
    std::size_t good = 0;
    const double time = least(glyphs.size(), [&] {
      good = 0;
      for (const medial::Feature& glyph : glyphs) {
        auto arcs = medial::approximate_by_arcs(
            glyph.contours, {.tolerance = font_tolerance, .relative = false, .threads = 1});
        if (arcs && steps != nullptr) good += run(*arcs, *steps);
      }
    });
    std::printf("| %s: %s | %.1f | %zu of %zu |\n", font.substr(font.rfind('/') + 1).c_str(), what,
                time, good, glyphs.size());
  };
  const Steps shape{.axis = false}, axis, verified{.verify = true};
  row("arcs", nullptr);
  row("and shape", &shape);
  row("and axis", &axis);
  row("and `verify`", &verified);
}

}  // namespace

int main(int count, char** words) {
  std::puts("| what | microseconds | come out |\n|---|--:|--:|");
  measure_footprints();
  for (int i = 1; i < count; ++i) measure_glyphs(words[i]);
}
