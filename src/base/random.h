#pragma once

#include <cstdint>

namespace medial {

/// splitmix64 (Steele, Lea, Flood 2014): the same numbers on every machine, unlike the
/// distributions of the standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  /// A random number in [0, 1).
  double share() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// A random number in [0, count), uniform to within count / 2^32.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(((next() >> 32) * count) >> 32);
  }

 private:
  std::uint64_t state_;
};

}  // namespace medial
