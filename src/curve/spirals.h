#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/compat.h"
#include "curve/bezier.h"
#include "medial/geometry.h"

namespace medial::curve {

/// The coordinates in which one piece is converted: close to the origin, and about 1 large. The
/// transformation and its inverse are exact for points of the input's grid (see
/// base/local_frame.h).
struct PieceCoordinates {
  Vec2 half_origin;    ///< halves: the difference of two coordinates may be too large for a double
  double scale = 1;    ///< local units per half an input unit: a power of two
  double inverse = 1;  ///< 1 / scale

  Vec2 to_local(Vec2 p) const {
    return {scale * (0.5 * p.x - half_origin.x), scale * (0.5 * p.y - half_origin.y)};
  }
  Vec2 to_input(Vec2 p) const {
    return {2 * (half_origin.x + inverse * p.x), 2 * (half_origin.y + inverse * p.y)};
  }
  /// The point of the input's grid next to p.
  Vec2 snap(Vec2 p) const { return to_local(to_input(p)); }
  /// The steps around p of the points that both local and input coordinates can hold.
  Vec2 spacing(Vec2 p) const {
    const auto unit_in_last_place = [](double x) {
      constexpr std::uint64_t exponent = 0x7ff0000000000000;
      const auto power = bit_cast<double>(bit_cast<std::uint64_t>(x) & exponent);
      return std::numeric_limits<double>::epsilon() * power;
    };
    const Vec2 input = to_input(p);
    return {std::max(local_length(unit_in_last_place(input.x)), unit_in_last_place(p.x)),
            std::max(local_length(unit_in_last_place(input.y)), unit_in_last_place(p.y))};
  }
  double local_length(double input) const { return 0.5 * scale * input; }
  double input_length(double local) const { return 2 * (inverse * local); }
};

/// Bounds on the curvature of the arcs at the ends of a piece that smoothly joins a more curved
/// neighbour. Without them, coarse arcs could hide a jump of the curvature.
struct CurvatureLimits {
  double begin = 0;  ///< as an amount; infinite: none
  double end = 0;
};

struct SpiralOptions {
  double tolerance = 0;  ///< largest distance from the curve
  double rounding = 0;   ///< the distance that means nothing: some units of the coordinates' last
                         ///< place. No tolerance is smaller
  CurvatureLimits limits;
};

/// Arcs end to end.
struct ArcChain {
  std::vector<Vec2> points;    ///< where each arc begins, in units of the input
  std::vector<double> bulges;  ///< see Ring; 0: a segment
  std::uint64_t spirals = 0;
};

/// Appends a curve in its frame as spiral biarcs, and returns the certified Hausdorff distance
/// (both in local units). Requires a curve that is no point and not straight. The chain's first arc
/// begins at the curve's first control point; the last one ends at its last, which is not appended.
///
/// The curve is split at its apices, inflections and cusps into spirals, each of these divided
/// until the biarc of Algorithm 1 is valid and within the tolerance. Along each spiral the arcs'
/// curvature is monotone; two spirals that meet in an apex of largest curvature share one arc,
/// which is their osculating circle there. No allocation except for the result.
double append_spirals(const Bezier& curve, const PieceCoordinates& frame,
                      const SpiralOptions& options, ArcChain& chain);

/// The parameters in (0, 1), increasing, at which a curve is split into spirals.
struct Split {
  enum class Kind : std::uint8_t { apex, inflection, cusp };
  double t;
  Kind kind;
};
struct Splits {
  int count = 0;
  Fixed<Split, 3 * max_polynomial_degree> at;

  Splits() {}  // NOLINT(modernize-use-equals-default)
  void add(Split split) {
    if (count < at.size()) at[count++] = split;
  }
};
Splits find_splits(const Bezier& curve);

}  // namespace medial::curve
