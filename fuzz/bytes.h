#pragma once

// What bytes mean to the programs of libFuzzer: numbers, points and rings.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "medial/shape.h"

namespace medial::fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), end_(data + size) {}
  bool done() const { return data_ == end_; }
  std::uint8_t byte() { return done() ? 0 : *data_++; }
  double small() { return static_cast<std::int8_t>(byte()); }
  double number() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8U | byte();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  const std::uint8_t* data_;
  const std::uint8_t* end_;
};

/// A point as two doubles, near an earlier one, or on a grid.
inline Vec2 point_from(Bytes& bytes, int kind, const std::vector<Vec2>& earlier) {
  if (kind == 0) {
    const double x = bytes.number();
    return {x, bytes.number()};
  }
  if (kind == 1 && !earlier.empty()) {
    const Vec2 p = earlier[bytes.byte() % earlier.size()];
    const double x = bytes.small(), y = bytes.small();
    const int exponent = -(bytes.byte() % 64);
    return p + Vec2{std::ldexp(x, exponent), std::ldexp(y, exponent)};
  }
  const double x = bytes.small();
  return {x, bytes.small()};
}

/// Rings of at most so many points: a byte for each point says how it is given, and whether a new
/// ring begins there.
inline std::vector<Ring> rings_from(Bytes& bytes, bool arcs, std::size_t most) {
  std::vector<Ring> rings(1);
  std::vector<Vec2> earlier;
  while (!bytes.done() && earlier.size() < most) {
    const std::uint8_t kind = bytes.byte();
    if (kind % 16 == 15 && !rings.back().points.empty()) rings.emplace_back();
    earlier.push_back(point_from(bytes, kind % 4, earlier));
    rings.back().points.push_back(earlier.back());
    if (arcs) rings.back().bulges.push_back(kind & 16 ? bytes.small() / 127 : 0);
  }
  return rings;
}

/// Prints rings so that they can be read again.
inline void print(const std::vector<Ring>& rings) {
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i)
      std::fprintf(stderr, "%.17g %.17g %.17g\n", ring.points[i].x, ring.points[i].y,
                   ring.bulges.empty() ? 0 : ring.bulges[i]);
    std::fprintf(stderr, "\n");
  }
}

/// Prints what is wrong with rings, and aborts.
[[noreturn]] inline void fail(const char* what, const std::vector<Ring>& rings) {
  std::fprintf(stderr, "%s\n", what);
  print(rings);
  std::abort();
}

}  // namespace medial::fuzz
