#pragma once

// Gauss-Legendre rules on [-1, 1]. Boost computes the nodes of these orders at run time and misses
// the last digits; these are correctly rounded.

#include <array>

namespace medial {

struct GaussNode {
  double place, weight;
};

/// Three points: exact for polynomials of degree five.
inline constexpr std::array<GaussNode, 3> gauss3{
    {{-0.7745966692414834, 5.0 / 9}, {0, 8.0 / 9}, {0.7745966692414834, 5.0 / 9}}};

/// The positive nodes of the eight-point rule: exact up to degree fifteen.
inline constexpr std::array<GaussNode, 4> gauss8{{{0.1834346424956498, 0.3626837833783620},
                                                  {0.5255324099163290, 0.3137066458778873},
                                                  {0.7966664774136267, 0.2223810344533745},
                                                  {0.9602898564975363, 0.1012285362903763}}};

}  // namespace medial
