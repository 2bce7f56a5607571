#include "site/chord_boxes.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "base/spatial_order.h"

namespace medial::site {
namespace {

/// A bound for the rounding error (u = 2^-53) of a height above a chord, or of a position along it.
/// A sum of two products with a local point whose coordinates are below 2: 4 sqrt(2) u < 6 u, once
/// for the boundary's point and once for the query's centre. The end of a site, 4 roundings below
/// 2, or the next site's start in its place, up to 8 u away in both coordinates: 12 u. A direction
/// that is a unit vector up to 3 u, times a distance below 4: 12 u. The sum is 36 u; the constant
/// is 64 u.
constexpr double chord_rounding = 0x1p-47;
/// Chord boxes pay off if the boundary is within this share of the chord's length from the chord.
constexpr double flat_enough = 1.0 / 16;

/// The normal of the line through the highest points (to the left) of the first and of the last
/// third of a boundary, or of its chord if these points are close together. For a staircase or a
/// row of holes, a box in this direction is tightest on the left.
Vec2 facing_normal(std::span<const Site> sites, Vec2 begin, Vec2 chord) {
  const auto highest = [&](std::span<const Site> some, Vec2 so_far) {
    double height = 0;
    for (const Site& site : some) {
      const double h = cross(chord, site.point - begin);
      if (!(h > height) || !is_inside(site)) continue;
      height = h;
      so_far = site.point;
    }
    return so_far;
  };
  const std::size_t third = sites.size() / 3;
  Vec2 along = highest(sites.last(third), begin + chord) - highest(sites.first(third), begin);
  constexpr double near = 0.25;
  if (!(dot(along, chord) > near * squared_norm(chord))) along = chord;
  return left_of((1 / norm(along)) * along);
}

/// A box that grows, empty at first.
struct GrowingBox {
  ChordBox box;

  explicit GrowingBox(Vec2 normal) : box{normal, infinity, -infinity, infinity, -infinity} {}
  void add(Vec2 p) {
    const double height = dot(box.normal, p), position = cross(p, box.normal);
    box.low = std::min(box.low, height);
    box.high = std::max(box.high, height);
    box.begin = std::min(box.begin, position);
    box.end = std::max(box.end, position);
  }
  ChordBox rounded() const {
    return {box.normal,
            box.low - chord_rounding,
            box.high + chord_rounding,
            box.begin - chord_rounding,
            box.end + chord_rounding,
            false};
  }
};

}  // namespace

std::optional<ChordBox> chord_box(std::span<const Site> sites) {
  const auto first = std::find_if(sites.begin(), sites.end(), is_inside);
  if (first == sites.end()) return std::nullopt;
  const Vec2 begin = first->point,
             chord = std::find_if(sites.rbegin(), sites.rend(), is_inside)->end() - begin;
  const double length = norm(chord), highest = flat_enough * length;
  constexpr double shortest = 0x1p-500;  // a unit vector needs its square
  if (!(length > shortest)) return std::nullopt;
  const bool may_be_high = sites.size() >= many_sites && length <= little_room;
  // A few points suffice to reject most boundaries.
  for (std::size_t i = 1; i < 4 && !may_be_high; ++i) {
    const Site& site = sites[i * sites.size() / 4];
    if (!is_inside(site) || std::abs(cross(chord, site.point - begin)) > highest * length)
      return std::nullopt;
  }
  GrowingBox growing(facing_normal(sites, begin, chord));
  for (const Site& site : sites) {
    if (is_inside(site)) {
      const Site* const next = &site == &sites.back() ? nullptr : &site + 1;
      growing.add(site.point);
      if (site.is_arc()) growing.add(site.apex());
      if (!site.is_vertex() && (next == nullptr || !meets(site, *next))) growing.add(site.end());
    } else if (!may_be_high) {
      return std::nullopt;
    }
  }
  ChordBox box = growing.rounded();
  const double height = growing.box.high - growing.box.low,
               size = std::max(height, growing.box.end - growing.box.begin);
  box.is_flat = height <= highest;
  if (!box.is_flat && !(may_be_high && size <= little_room)) return std::nullopt;
  return box;
}

std::optional<ChordBox> box_along(std::span<const Site> sites,
                                  std::span<const std::uint32_t> indices) {
  const Axes axes = axes_of(indices, [&](std::uint32_t i) { return chord_of(sites[i]); });
  GrowingBox growing(axes.across);
  for (const std::uint32_t i : indices) {
    if (!is_inside(sites[i])) continue;
    growing.add(sites[i].point);
    growing.add(sites[i].end());
    if (sites[i].is_arc()) growing.add(sites[i].apex());
  }
  if (!(growing.box.low <= growing.box.high)) return std::nullopt;
  return growing.rounded();
}

void ChordBoxes::set(std::size_t lane, const std::optional<ChordBox>& box) {
  constexpr double all = infinity;
  const ChordBox own = box.value_or(ChordBox{{1, 0}, -all, all, -all, all});
  const std::size_t pair = lane / 2, side = lane % 2;
  normal_x[pair][side] = own.normal.x;
  normal_y[pair][side] = own.normal.y;
  low[pair][side] = own.low;
  high[pair][side] = own.high;
  begin[pair][side] = own.begin;
  end[pair][side] = own.end;
}

}  // namespace medial::site
