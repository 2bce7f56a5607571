// Bytes to a shape, its axis and the certificate, for libFuzzer: `make fuzz-coverage`.
//
// The first byte says whether there are arcs and which method computes. Then a byte for each point
// says how it is given: on a grid, as two doubles, near an earlier point, or as a new ring.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "medial/medial.h"

namespace {

using medial::Ring;
using medial::Vec2;

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

Vec2 point_from(Bytes& bytes, int kind, const std::vector<Vec2>& earlier) {
  if (kind == 0) return {bytes.number(), bytes.number()};
  if (kind == 1 && !earlier.empty()) {
    const Vec2 p = earlier[bytes.byte() % earlier.size()];
    const double x = bytes.small(), y = bytes.small();
    const int exponent = -(bytes.byte() % 64);
    return p + Vec2{std::ldexp(x, exponent), std::ldexp(y, exponent)};
  }
  const double x = bytes.small();
  return {x, bytes.small()};
}

std::vector<Ring> rings_from(Bytes& bytes, bool arcs) {
  constexpr std::size_t most = 200;  // certificates take seconds beyond
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

[[noreturn]] void fail(const char* what, const std::vector<Ring>& rings) {
  std::fprintf(stderr, "%s\n", what);
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i)
      std::fprintf(stderr, "%.17g %.17g %.17g\n", ring.points[i].x, ring.points[i].y,
                   ring.bulges.empty() ? 0 : ring.bulges[i]);
    std::fprintf(stderr, "\n");
  }
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t what = bytes.byte();
  const std::vector<Ring> rings = rings_from(bytes, what & 1);
  medial::Options options{.threads = 1};
  if (what & 2) options.method = medial::method::Lee{};
  options.exterior = (what & 12) == 12;
  const auto shape = medial::build_shape(rings);
  if (!shape) {
    if (shape.error().code == medial::ErrorCode::internal) fail("build_shape(): internal", rings);
    return 0;
  }
  const auto axis = medial::compute(*shape, options);
  if (!axis) {
    const medial::ErrorCode code = axis.error().code;
    const bool fault = code == medial::ErrorCode::internal || code == medial::ErrorCode::malformed;
    if (fault) fail(to_string(axis.error()).c_str(), rings);
    return 0;
  }
  const medial::Certificate certificate = medial::verify(*shape, *axis, {.threads = 1});
  if (!certificate.passed) fail(certificate.failures.front().c_str(), rings);
  return 0;
}
