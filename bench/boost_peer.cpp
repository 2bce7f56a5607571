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
  const double scale = 0x1p31 / std::max(high.x - low.x, high.y - low.y);
  const Vec2 center = midpoint(low, high);
  const auto scaled = [&](Vec2 p) {
    return Point(static_cast<std::int32_t>(std::lround((1 - 0x1p-30) * scale * (p.x - center.x))),
                 static_cast<std::int32_t>(std::lround((1 - 0x1p-30) * scale * (p.y - center.y))));
  };
  PeerRun run;
  std::vector<Segment> segments;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const Point from = scaled(ring.points[i]);
      const Point to = scaled(ring.points[(i + 1) % ring.points.size()]);
      if (from == to) {
        ++run.left_out;
      } else {
        segments.emplace_back(from, to);
      }
    }
  }
  const double start = processor_seconds();
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(segments.begin(), segments.end(), &diagram);
  run.seconds = processor_seconds() - start;
  run.vertices = diagram.num_vertices();
  return run;
}

std::string boost_version() {
  return std::to_string(BOOST_VERSION / 100000) + "." + std::to_string(BOOST_VERSION / 100 % 1000);
}

}  // namespace medial::bench
