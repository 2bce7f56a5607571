#pragma once

#include <cstdint>
#include <cstring>
#ifdef __SSE2__
#include <emmintrin.h>
#else
#include <cmath>
#endif

namespace medial {

/// Vectors of two doubles, or of four floats, for SIMD instructions.
using Pair = double __attribute__((vector_size(16)));
using Lanes = float __attribute__((vector_size(16)));
using Pairwise = decltype(Pair{} < Pair{});  // -1 for true
using Lanewise = decltype(Lanes{} < Lanes{});

inline Pair both(double value) { return Pair{value, value}; }
inline Pair pair_at(const double* place) {
  Pair pair;
  std::memcpy(&pair, place, sizeof pair);
  return pair;
}

// Compilers turn the plain forms into several instructions.
#ifdef __SSE2__
inline Pair larger(Pair a, Pair b) { return _mm_max_pd(a, b); }
inline Pair smaller(Pair a, Pair b) { return _mm_min_pd(a, b); }
inline Lanes larger(Lanes a, Lanes b) { return _mm_max_ps(a, b); }
inline Pair root_of(Pair a) { return _mm_sqrt_pd(a); }
/// The true lanes as bits.
inline std::uint32_t bits_of(Pairwise what) {
  return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<Pair>(what)));
}
inline std::uint32_t bits_of(Lanewise what) {
  return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<Lanes>(what)));
}
#else
inline Pair larger(Pair a, Pair b) { return a > b ? a : b; }
inline Pair smaller(Pair a, Pair b) { return a < b ? a : b; }
inline Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }
inline Pair root_of(Pair a) { return Pair{std::sqrt(a[0]), std::sqrt(a[1])}; }
inline std::uint32_t bits_of(Pairwise what) { return (what[0] & 1U) | (what[1] & 2U); }
inline std::uint32_t bits_of(Lanewise what) {
  return (what[0] & 1U) | (what[1] & 2U) | (what[2] & 4U) | (what[3] & 8U);
}
#endif
inline bool all(Pairwise what) { return bits_of(what) == 3; }
inline bool any(Pairwise what) { return bits_of(what) != 0; }
inline Pair size_of(Pair a) { return larger(a, -a); }
/// `size`, negated in the lanes where `other` is below 0.
inline Pair with_sign_of(Pair size, Pair other) { return other < 0 ? -size : size; }

}  // namespace medial
