#include "base/quarter_map.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/predicates.h"

namespace medial {
namespace {

std::vector<QuarterMap> quarter_maps() {
  std::vector<QuarterMap> maps;
  maps.reserve(8);
  for (unsigned i = 0; i < 8; ++i) maps.push_back({(i & 1) != 0, (i & 2) != 0, (i & 4) != 0});
  return maps;
}

/// Keeps the maps with the smallest key.
template <class Key>
void keep_least(std::vector<QuarterMap>& maps, const Key& key) {
  std::vector<std::pair<double, double>> keys;
  keys.reserve(maps.size());
  for (const QuarterMap& map : maps) keys.push_back(key(map));
  const auto least = *std::min_element(keys.begin(), keys.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < maps.size(); ++i)
    if (keys[i] == least) maps[kept++] = maps[i];
  maps.resize(kept);
}

}  // namespace

std::vector<QuarterMap> best_maps(std::span<const Vec2> points) {
  std::vector<QuarterMap> maps = quarter_maps();
  Box box = Box::nothing();
  for (const Vec2 p : points) box.add(p);
  keep_least(maps, [&](const QuarterMap& map) {
    return std::pair(std::min(map.to_image(box.low).x, map.to_image(box.high).x), 0.0);
  });
  const auto keep_lowest = [&](const auto& counts) {
    keep_least(maps, [&](const QuarterMap& map) {
      constexpr double none = std::numeric_limits<double>::infinity();
      Vec2 lowest{none, none};
      for (const Vec2 p : points)
        if (const Vec2 q = map.to_image(p); lexicographic_less(q, lowest) && counts(p)) lowest = q;
      return std::pair(lowest.x, lowest.y);
    });
  };
  keep_lowest([](Vec2) { return true; });
  if (maps.size() > 1)
    keep_lowest([&](Vec2 p) {
      return p.x > box.low.x && p.x < box.high.x && p.y > box.low.y && p.y < box.high.y;
    });
  return maps;
}

QuarterMap best_map(std::span<const BulgeArc> edges) {
  std::vector<Vec2> points;
  points.reserve(edges.size());
  for (const BulgeArc& edge : edges) points.push_back(edge.start);
  const std::vector<QuarterMap> maps = best_maps(points);
  if (maps.size() == 1) return maps.front();
  const auto image_of = [&](const QuarterMap& map) {
    std::vector<std::array<double, 5>> image;
    image.reserve(edges.size());
    for (const BulgeArc& edge : edges) {
      Vec2 p = map.to_image(edge.start), q = map.to_image(edge.end);
      double bulge = map.mirrors() ? -edge.bulge : edge.bulge;
      if (lexicographic_less(q, p)) std::swap(p, q), bulge = -bulge;
      image.push_back({p.x, p.y, q.x, q.y, bulge});
    }
    std::sort(image.begin(), image.end());
    return image;
  };
  return *std::min_element(maps.begin(), maps.end(), [&](const QuarterMap& a, const QuarterMap& b) {
    return image_of(a) < image_of(b);
  });
}

}  // namespace medial
