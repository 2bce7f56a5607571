#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "axis/curve.h"
#include "verify/distance_tree.h"

namespace medial::test {

/// Expects that the distances of places on random curves are those of all edges one by one,
/// whatever radii are expected and whichever edge is known.
inline void expect_distances_on_curves(const Shape& shape, double size, Vec2 middle) {
  using verify_detail::distance_to_edge;
  using verify_detail::Places;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  const std::size_t count = shape.points.size();
  const auto edge = [&](std::size_t j) {
    return verify_detail::BoundaryEdge{shape.points[j], shape.points[(j + 1) % count],
                                       shape.bulge(j)};
  };
  const auto true_distance = [&](Vec2 p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < count; ++j) least = std::min(least, distance_to_edge(p, edge(j)));
    return least;
  };
  const verify_detail::DistanceTree tree(shape);
  for (int i = 0; i < 120; ++i) {
    // Long and short curves, whose radii are the distances, or smaller, or larger.
    const double spread = size * std::pow(10, -4 * unit(random));
    const double factor = i % 3 == 0 ? 1 : 2 * unit(random);
    const Vec2 near = middle + size * Vec2{unit(random) - 0.5, unit(random) - 0.5};
    verify_detail::DiskHull hull;
    for (Disk& disk : hull) {
      disk.center = near + spread * Vec2{unit(random) - 0.5, unit(random) - 0.5};
      disk.radius = factor * true_distance(disk.center);
    }
    Places places;
    places.tolerance = 1e-14 * size;
    verify_detail::NearEdges found;
    const bool all = tree.find_near(hull, places.tolerance, found);
    // The nearest edge of one place, which is that of some others; or none.
    std::uint32_t known = 0;
    for (std::uint32_t j = 1; j < count; ++j)
      if (distance_to_edge(hull[0].center, edge(j)) < distance_to_edge(hull[0].center, edge(known)))
        known = j;
    const bool is_known = i % 2 == 0;
    if (is_known) {
      std::size_t kept = 0;
      for (std::size_t k = 0; k < found.size; ++k)
        if (found.index[k] != known) found.place[kept++] = found.place[k];
      found.size = kept;
    }
    const Curve curve(hull[0], hull[1], hull[2], 0.2 + 2 * unit(random));
    places.size = 1 + random() % Places::most;
    for (std::size_t k = 0; k < places.size; ++k) {
      const Disk disk = curve.at(unit(random));
      places.x[k] = disk.center.x;
      places.y[k] = disk.center.y;
      places.radius[k] = disk.radius;
      places.distance[k] = is_known ? distance_to_edge(disk.center, edge(known))
                                    : std::numeric_limits<double>::infinity();
    }
    tree.find_distances(all ? &found : nullptr, places);
    for (std::size_t k = 0; k < places.size; ++k)
      EXPECT_EQ(places.distance[k], true_distance(places.place(k))) << count << " " << i;
  }
}

}  // namespace medial::test
