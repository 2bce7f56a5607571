#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <boost/polygon/voronoi.hpp>
#include <boost/version.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "clock.h"
#include "peers.h"

namespace medial::bench {

namespace {

using Point = boost::polygon::point_data<std::int32_t>;
using Segment = boost::polygon::segment_data<std::int32_t>;

/// Builds the diagram of the rings with every coordinate c as round(scale (c - origin)).
PeerRun run(std::span<const Ring> rings, double scale, Vec2 origin) {
  const auto scaled = [&](Vec2 p) {
    return Point(static_cast<std::int32_t>(std::lround(scale * (p.x - origin.x))),
                 static_cast<std::int32_t>(std::lround(scale * (p.y - origin.y))));
  };
  PeerRun result;
  std::vector<Segment> segments;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const Point from = scaled(ring.points[i]);
      const Point to = scaled(ring.points[(i + 1) % ring.points.size()]);
      if (from == to) {
        ++result.left_out;
      } else {
        segments.emplace_back(from, to);
      }
    }
  }
  const double start = processor_seconds();
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(segments.begin(), segments.end(), &diagram);
  result.seconds = processor_seconds() - start;
  result.vertices = diagram.num_vertices();
  return result;
}

/// Whether `scale` makes int32 values of all coordinates, but for the rounding of decimals.
bool makes_integers(std::span<const Ring> rings, double scale) {
  for (const Ring& ring : rings) {
    for (const Vec2 p : ring.points) {
      for (const double c : {scale * p.x, scale * p.y}) {
        if (std::abs(c) >= 0x1p31 || std::abs(c - std::round(c)) > 0x1p-51 * std::abs(c)) {
          return false;
        }
      }
    }
  }
  return true;
}

}  // namespace

PeerRun run_boost(std::span<const Ring> rings) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Vec2 low{infinite, infinite};
  Vec2 high{-infinite, -infinite};
  for (const Ring& ring : rings) {
    for (const Vec2 p : ring.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const double span = std::max(high.x - low.x, high.y - low.y);
  return run(rings, (1 - 0x1p-30) * 0x1p31 / span, midpoint(low, high));
}

PeerRun run_boost_unstretched(std::span<const Ring> rings) {
  for (const double scale : {1.0, 1e6}) {
    if (makes_integers(rings, scale)) return run(rings, scale, {0, 0});
  }
  PeerRun none;
  none.seconds = -1;
  return none;
}

std::string boost_version() {
  return std::to_string(BOOST_VERSION / 100000) + "." + std::to_string(BOOST_VERSION / 100 % 1000);
}

}  // namespace medial::bench
