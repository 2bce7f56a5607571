#include "methods/raster/ridge/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "site/boundary_tree.h"

namespace medial::ridge {

double NearestEdges::distance_to(std::uint32_t edge, Vec2 c) const {
  return std::sqrt(site::squared_distance(outline_.edges[edge], c));
}

bool NearestEdges::is_another(Vec2 c, Near first, std::uint32_t edge, RidgeRule rule) const {
  if (edge == first.edge) return false;
  if (rule == RidgeRule::crossing)
    return !outline_.are_one({first.edge, c}, {edge, c}, first.distance);
  const std::uint32_t seen = outline_.seen_edge({edge, c});
  if (seen == first.edge || outline_.meet_concavely(first.edge, seen)) return false;
  // Section V.B.1, for two edges of one curve only: with the text as it stands a lens, whose two
  // arcs have radii larger than any disk in it, would have no axis at all.
  const double least = std::min(outline_.radius[first.edge], outline_.radius[edge]);
  return least == std::numeric_limits<double>::infinity() ||
         !outline_.are_one({first.edge, c}, {edge, c}, first.distance);
}

bool NearestEdges::is_seen(Vec2 c, Near first, Near other, double away) const {
  if (away == std::numeric_limits<double>::infinity()) return true;
  // |c + t u - x| = r + t for the unit vector u from the nearest foot to c.
  const double r = first.distance, s = other.distance;
  const Vec2 u = (1 / r) * (c - foot(outline_.edges[first.edge], c));
  const Vec2 to = foot(outline_.edges[other.edge], c) - c;
  return s * s - r * r <= 2 * away * (r + dot(u, to));
}

namespace {

/// The report's search (A.6): all edges with lower bounds of their distances, kept sorted from
/// pixel to pixel, and distances computed in this order until the bounds exceed what was found.
/// O(edges) for each pixel, as long as the pixels are neighbours.
class SortedList final : public NearestEdges {
 public:
  explicit SortedList(const EdgeOutline& outline)
      : NearestEdges(outline), list_(outline.edges.size()) {
    for (std::uint32_t e = 0; e < list_.size(); ++e) list_[e] = {0, e};
  }

  Near nearest(Vec2 c, std::uint32_t) override {
    ++queries;
    sort_for(c);
    // By squares, as the tree compares them.
    Near best{no_edge, std::numeric_limits<double>::infinity()};
    for (const Bound& bound : list_) {
      if (exceeds(bound, std::sqrt(best.distance))) break;
      ++distances;
      take({bound.edge, site::squared_distance(outline_.edges[bound.edge], c)}, best);
    }
    best.distance = std::sqrt(best.distance);
    return best;
  }

  Near second(Vec2 c, Near first, double reach, RidgeRule rule, double away) override {
    sort_for(c);
    Near best{no_edge, reach};
    for (const Bound& bound : list_) {
      if (exceeds(bound, best.distance)) break;
      if (!is_another(c, first, bound.edge, rule)) continue;
      ++distances;
      const Near candidate{bound.edge, distance_to(bound.edge, c)};
      if (is_seen(c, first, candidate, away)) take(candidate, best);
    }
    return best;
  }

 private:
  struct Bound {
    double lower;
    std::uint32_t edge;
  };

  /// Bounds and distances are rounded differently: equal ones must stay equal here.
  static bool exceeds(const Bound& bound, double distance) {
    constexpr double rounding = 1 + 0x1p-40;
    return bound.lower > rounding * distance;
  }
  static void take(Near candidate, Near& best) {
    if (candidate.distance < best.distance ||
        (candidate.distance == best.distance && candidate.edge < best.edge && best.edge != no_edge))
      best = candidate;
  }
  /// A.6.a: the larger of the distances along x and along y from the edge's box.
  double lower_bound(std::uint32_t e, Vec2 c) const {
    const Vec2 a = outline_.edges[e].point, b = outline_.edges[outline_.next[e]].point;
    const double dx = std::max({std::min(a.x, b.x) - c.x, c.x - std::max(a.x, b.x), 0.0});
    const double dy = std::max({std::min(a.y, b.y) - c.y, c.y - std::max(a.y, b.y), 0.0});
    return std::max(dx, dy) - outline_.sagitta;
  }

  void sort_for(Vec2 c) {
    if (sorted_ && c == center_) return;
    sorted_ = true;
    center_ = c;
    for (Bound& bound : list_) bound.lower = lower_bound(bound.edge, c);
    const auto before = [](const Bound& a, const Bound& b) {
      return a.lower != b.lower ? a.lower < b.lower : a.edge < b.edge;
    };
    // Insertion, which the list needs little of from one pixel to its neighbour; after a jump it
    // would take too long.
    std::size_t budget = 16 * list_.size() + 64;
    for (std::size_t i = 1; i < list_.size(); ++i) {
      const Bound moving = list_[i];
      std::size_t at = i;
      for (; at > 0 && before(moving, list_[at - 1]); --at) list_[at] = list_[at - 1];
      list_[at] = moving;
      if (i - at <= budget) {
        budget -= i - at;
        continue;
      }
      std::sort(list_.begin(), list_.end(), before);
      return;
    }
  }

  std::vector<Bound> list_;
  Vec2 center_;
  bool sorted_ = false;
};

class Tree final : public NearestEdges {
 public:
  explicit Tree(const EdgeOutline& outline) : NearestEdges(outline), tree_(outline.edges) {}

  Near nearest(Vec2 c, std::uint32_t hint) override {
    ++queries;
    constexpr double beyond_all = 8;  // local coordinates are below 2
    constexpr double a_little_more = 1 + 0x1p-40;
    const double reach = hint == no_edge ? beyond_all : a_little_more * distance_to(hint, c);
    auto hit = tree_.nearest(c, reach);
    if (!hit) hit = tree_.nearest(c, beyond_all);  // c lies on the edge of the hint
    return {hit.site, std::sqrt(hit.squared_distance)};
  }

  Near second(Vec2 c, Near first, double reach, RidgeRule rule, double away) override {
    constexpr double a_little_more = 1 + 0x1p-40;
    tree_.within(c, a_little_more * reach, 0, static_cast<std::uint32_t>(outline_.edges.size() - 1),
                 found_);
    Near best{no_edge, reach};
    for (const std::uint32_t edge : found_) {
      const double distance = distance_to(edge, c);
      if (distance < best.distance && is_another(c, first, edge, rule) &&
          is_seen(c, first, {edge, distance}, away))
        best = {edge, distance};
    }
    return best;
  }

 private:
  site::BoundaryTree tree_;
  std::vector<std::uint32_t> found_;
};

}  // namespace

std::unique_ptr<NearestEdges> make_search(const EdgeOutline& outline, bool sorted_list) {
  if (sorted_list) return std::make_unique<SortedList>(outline);
  return std::make_unique<Tree>(outline);
}

}  // namespace medial::ridge
