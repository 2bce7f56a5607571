#include "methods/raster/ridge/follow.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace medial::ridge {

using raster::BitMap;
using raster::Pixel;

Pixel neighbour(Pixel p, int direction) {
  constexpr std::array<int, 8> right{1, 1, 0, -1, -1, -1, 0, 1}, up{0, 1, 1, 1, 0, -1, -1, -1};
  const auto d = static_cast<std::size_t>(direction);
  return {p.column + static_cast<std::uint32_t>(right[d]),
          p.row + static_cast<std::uint32_t>(up[d])};
}

bool crosses_contour(const BitMap& boundary, Pixel p, int direction) {
  return direction % 2 == 1 && boundary.at(neighbour(p, direction - 1)) &&
         boundary.at(neighbour(p, (direction + 1) % 8));
}

std::vector<std::uint32_t> MedialMap::in_rows() const {
  std::vector<std::uint32_t> order;
  for (std::uint32_t r = 0; r < medial.rows(); ++r)
    for (std::uint32_t w = 0; w < medial.words_per_row(); ++w)
      for (std::uint64_t rest = medial.row(r)[w]; rest != 0; rest &= rest - 1)
        order.push_back(place.at({64 * w + static_cast<std::uint32_t>(std::countr_zero(rest)), r}) -
                        1);
  return order;
}

namespace {

/// "A very small number" (step 6 of A.3), as a share of the pixel.
constexpr double a_little = 1e-9;
/// Beside the boundary two pixels of it may lie on both sides of one pixel. The edges through them
/// pass within half a pixel of their centres along a row or column: at most 3/2 from the pixel
/// between, and at least 1/2 along the row or column, as that pixel is not drawn: 1 / (2 sqrt 2).
/// The difference of the distances is at most 3/2 - 1 / (2 sqrt 2).
constexpr double beside_boundary = 1.1465;
/// How far from the axis such a pixel may be, in pixels.
constexpr double farthest = 1;

}  // namespace

Follower::Follower(const EdgeOutline& outline, const LocalGrid& local, const BitMap& boundary,
                   NearestEdges& search, RidgeRule rule, const std::atomic<bool>* cancel)
    : outline_(outline),
      local_(local),
      boundary_(boundary),
      search_(search),
      rule_(rule),
      cancel_(cancel),
      checked_(local.grid.columns, local.grid.rows),
      label_(local.grid.columns, local.grid.rows, no_edge),
      map_(local.grid.columns, local.grid.rows) {}

std::uint32_t Follower::label(Pixel p, std::uint32_t hint) {
  std::uint32_t& known = label_[p];
  if (known == no_edge) {
    const Vec2 c = local_.grid.center(p);
    known = outline_.seen_edge({search_.nearest(c, hint).edge, c});
  }
  return known;
}

bool Follower::by_difference(Pixel p, double tolerance, double away, Found& found) {
  const Vec2 c = local_.grid.center(p);
  found.radius = search_.distance_to(found.first, c);
  const Near second =
      search_.second(c, {found.first, found.radius}, found.radius + tolerance, rule_, away);
  if (second.edge == no_edge) return false;
  found.second = second.edge;
  found.quality = second.distance - found.radius;
  return true;
}

bool Follower::by_crossing(Pixel p, Found& found) {
  const Vec2 c = local_.grid.center(p);
  found.radius = search_.distance_to(found.first, c);
  found.quality = std::numeric_limits<double>::infinity();
  bool beside = false;
  for (int direction = 0; direction < 8; direction += 2) {
    const Pixel q = neighbour(p, direction);
    if (boundary_.at(q)) {
      beside = true;
      continue;
    }
    const std::uint32_t other = label(q, found.first);
    if (other == found.first) continue;
    const Vec2 d = local_.grid.center(q);
    const double radius = search_.distance_to(other, d);
    if (outline_.are_one({found.first, c}, {other, d}, std::max(found.radius, radius))) continue;
    // Both have the other's edge farther than their own; the axis is nearer to the one that has it
    // less so. Of equals, the lower one is medial.
    const double own = search_.distance_to(other, c) - found.radius;
    const double its = search_.distance_to(found.first, d) - radius;
    const bool lower = p < q;
    if ((own < its || (own == its && lower)) && own < found.quality) {
      found.quality = own;
      found.second = other;
    }
  }
  if (found.second != no_edge) return true;
  if (!beside ||
      !by_difference(p, beside_boundary * local_.grid.step, farthest * local_.grid.step, found))
    return false;
  found.quality += local_.grid.step;
  return true;
}

bool Follower::check(Pixel p) {
  if (checked_.test_and_set(p)) return map_.medial.at(p);
  Found found{p};
  found.first = label(p, hint_);
  hint_ = found.first;
  const bool medial = rule_ == RidgeRule::crossing
                          ? by_crossing(p, found)
                          : by_difference(p, (1 + a_little) * local_.grid.step,
                                          std::numeric_limits<double>::infinity(), found);
  if (!medial) return false;
  map_.add(found);
  waiting_.push_back(static_cast<std::uint32_t>(map_.found.size() - 1));
  return true;
}

Found Follower::measured(Pixel p) {
  Found found{p, std::numeric_limits<double>::infinity()};
  found.first = label(p, hint_);
  found.radius = search_.distance_to(found.first, local_.grid.center(p));
  return found;
}

bool Follower::find_first(Pixel seed) {
  if (check(seed)) return true;
  for (const int direction : {2, 6})
    for (Pixel p = neighbour(seed, direction); !boundary_.at(p); p = neighbour(p, direction))
      if (check(p)) return true;
  return false;
}

void Follower::follow() {
  std::uint64_t count = 0;
  while (!waiting_.empty()) {
    const Found from = map_.found[waiting_.back()];
    waiting_.pop_back();
    hint_ = from.first;
    for (int direction = 0; direction < 8; ++direction) {
      const Pixel q = neighbour(from.pixel, direction);
      if (boundary_.at(q) || checked_.at(q) || crosses_contour(boundary_, from.pixel, direction))
        continue;
      check(q);
    }
    if (++count % 4096 == 0 && cancel_ != nullptr && cancel_->load()) return;
  }
}

}  // namespace medial::ridge
