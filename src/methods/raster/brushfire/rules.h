#pragma once

// The rules that decide which pixels may be deleted, for the 64 pixels of a tile at once: bit i is
// pixel i.

#include "methods/raster/brushfire/tiles.h"

namespace medial::brushfire {

/// The pixels at which exactly one of four is set.
constexpr Tile exactly_one(Tile a, Tile b, Tile c, Tile d) {
  return (a ^ b ^ c ^ d) & ~((a & b) | (c & d));
}

/// Whether a foreground pixel is simple: the foreground among its neighbours is one part by eight
/// neighbours, and one of its four neighbours is background. Deleting it changes neither the number
/// of components nor that of holes. (Hilditch's crossing number is 1; Rosenfeld 1970.)
constexpr Tile simple(const Neighbors& p) {
  return exactly_one(~p.n & (p.ne | p.e), ~p.e & (p.se | p.s), ~p.s & (p.sw | p.w),
                     ~p.w & (p.nw | p.n));
}

/// Whether two neighbours or more are foreground: the pixel is neither alone nor the end of a line.
constexpr Tile not_an_end(const Neighbors& p) {
  Tile one = p.n;
  Tile two = one & p.ne;
  one |= p.ne;
  for (const Tile next : {p.e, p.se, p.s, p.sw, p.w, p.nw}) {
    two |= one & next;
    one |= next;
  }
  return two;
}

/// Whether a four-neighbour is background.
constexpr Tile at_border(const Neighbors& p) { return ~(p.n & p.e & p.s & p.w); }

/// Guo and Hall's A1: the crossing number is 1; of the pairs of consecutive neighbours, counted in
/// both ways, two or three contain foreground in the way with fewer; and a condition that keeps
/// lines two pixels wide from vanishing at once, which looks to the other side in every second
/// pass.
constexpr Tile guo_hall(const Neighbors& p, bool first) {
  const auto two_or_three = [](Tile a, Tile b, Tile c, Tile d, Tile& two, Tile& four) {
    const Tile ab = a & b, cd = c & d;
    two = ab | cd | ((a | b) & (c | d));
    four = ab & cd;
  };
  Tile two_1, four_1, two_2, four_2;
  two_or_three(p.nw | p.n, p.ne | p.e, p.se | p.s, p.sw | p.w, two_1, four_1);
  two_or_three(p.n | p.ne, p.e | p.se, p.s | p.sw, p.w | p.nw, two_2, four_2);
  // The smaller count is at least 2 if both are, and at most 3 if one is not 4.
  const Tile count = two_1 & two_2 & ~(four_1 & four_2);
  const Tile kept = first ? (p.s | p.sw | ~p.nw) & p.w : (p.n | p.ne | ~p.se) & p.e;
  return simple(p) & count & ~kept;
}

}  // namespace medial::brushfire
