#pragma once

#include <cstring>
#ifdef __SSE2__
#include <emmintrin.h>
#else
#include <cmath>
#endif

namespace medial {

/// Two numbers, worked on at once where the machine can.
using Pair = double __attribute__((vector_size(16)));
using Pairwise = decltype(Pair{} < Pair{});  // -1 where it holds

inline Pair both(double value) { return Pair{value, value}; }
inline Pair pair_at(const double* place) {
  Pair pair;
  std::memcpy(&pair, place, sizeof pair);
  return pair;
}
inline bool all(Pairwise what) { return (what[0] & what[1]) != 0; }
inline bool any(Pairwise what) { return (what[0] | what[1]) != 0; }

// A compiler makes several instructions of the plain forms.
#ifdef __SSE2__
inline Pair larger(Pair a, Pair b) { return _mm_max_pd(a, b); }
inline Pair smaller(Pair a, Pair b) { return _mm_min_pd(a, b); }
inline Pair root_of(Pair a) { return _mm_sqrt_pd(a); }
#else
inline Pair larger(Pair a, Pair b) { return a > b ? a : b; }
inline Pair smaller(Pair a, Pair b) { return a < b ? a : b; }
inline Pair root_of(Pair a) { return Pair{std::sqrt(a[0]), std::sqrt(a[1])}; }
#endif
inline Pair size_of(Pair a) { return larger(a, -a); }
/// Negative where the other one is below 0.
inline Pair with_sign_of(Pair size, Pair other) { return other < 0 ? -size : size; }

}  // namespace medial
