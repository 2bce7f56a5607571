#pragma once

namespace medial {

/// Two numbers, worked on at once where the machine can.
using Pair = double __attribute__((vector_size(16)));

inline Pair both(double value) { return Pair{value, value}; }
inline Pair larger(Pair a, Pair b) { return a > b ? a : b; }
inline Pair smaller(Pair a, Pair b) { return a < b ? a : b; }

}  // namespace medial
