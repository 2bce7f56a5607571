#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/pair.h"
#include "site/site.h"

namespace medial::site {

/// A site beyond this belongs to no box. The cuts of bridges are stored there.
constexpr double outside = 64;
inline bool is_inside(const Site& site) { return std::abs(site.point.x) <= outside; }

/// An oriented box around sites. All their points p have normal . p in [low, high] and along . p in
/// [begin, end], where `along` is the normal turned to the right.
struct ChordBox {
  Vec2 normal;
  double low, high, begin, end;
  bool is_flat = false;  ///< the sites are close to their chord
};

/// The oriented boxes of a node's four lanes. In double precision, because a large disk may almost
/// touch the boundary. A lane without such a box has infinite bounds.
struct alignas(64) ChordBoxes {
  static constexpr std::uint32_t fan = 4;
  std::array<Pair, fan / 2> normal_x, normal_y, low, high, begin, end;

  void set(std::size_t lane, const std::optional<ChordBox>& box);
  double area(std::size_t lane) const {
    const std::size_t pair = lane / 2;
    return ((high[pair] - low[pair]) * (end[pair] - begin[pair]))[lane % 2];
  }
  /// The lanes whose boxes lie beyond the reach from c, as bits.
  std::uint32_t beyond(Vec2 c, double reach) const {
    std::uint32_t lanes = 0;
    for (std::uint32_t i = 0; i < fan / 2; ++i) {
      const Pair height = normal_x[i] * c.x + normal_y[i] * c.y;
      const Pair position = normal_y[i] * c.x - normal_x[i] * c.y;
      const Pair across = larger(larger(height - high[i], low[i] - height), Pair{});
      const Pair along = larger(larger(position - end[i], begin[i] - position), Pair{});
      lanes |= bits_of(across * across + along * along > reach * reach) << (2 * i);
    }
    return lanes;
  }
};

/// The box along the chord of a piece of a boundary. None if the boundary is far from its chord,
/// unless it has many sites in a small place: a much larger disk almost touches all teeth of a
/// comb, or all holes in a row. O(n).
std::optional<ChordBox> chord_box(std::span<const Site> sites);
constexpr std::size_t many_sites = 128;
constexpr double little_room = 0x1p-8;

/// From a site's start to its end; zero for a cut.
inline Vec2 chord_of(const Site& site) {
  return is_inside(site) ? site.end() - site.point : Vec2{};
}

/// The box of sites, which need not be consecutive, along the main direction of their chords; none
/// if all are cuts. O(n).
std::optional<ChordBox> box_along(std::span<const Site> sites,
                                  std::span<const std::uint32_t> indices);

}  // namespace medial::site
