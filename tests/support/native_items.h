#pragma once

// Axes and shapes by hand, as the native format holds them, and what the tests of files share.

#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/query.h"
#include "support/scratch_folder.h"

namespace medial::io {

class Io : public test::ScratchFolder {};

inline ErrorCode code_of(const Result<Document<Feature>>& result) {
  EXPECT_FALSE(result.ok());
  return result.ok() ? ErrorCode::internal : result.error().code;
}

inline Shape shape_of(const std::vector<std::vector<Vec2>>& loops) {
  Shape shape;
  shape.loop_begin.push_back(0);
  std::uint32_t ring = 0;
  for (const auto& loop : loops) {
    for (std::uint32_t k = 0; k < loop.size(); ++k) {
      shape.points.push_back(loop[k]);
      shape.sources.push_back({ring, k});
    }
    shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
    shape.component.push_back(0);
    shape.hole.push_back(ring++ > 0);
  }
  return shape;
}

inline Disk middle(const Disk& a, const Disk& b) {
  return {midpoint(a.center, b.center), a.radius + 0.5 * (b.radius - a.radius)};
}

/// The rectangle [0, 4] x [0, 2]: four leaves, two branching nodes, five edges.
inline AxisItem rectangle() {
  AxisItem item;
  item.shape = shape_of({{{0, 0}, {4, 0}, {4, 2}, {0, 2}}});
  MedialAxis& axis = item.axis;
  axis.method = "hand";
  axis.tolerance = 1e-15;
  const auto& p = item.shape.points;
  for (std::uint32_t i = 0; i < 4; ++i) {
    axis.sites.push_back({p[i], p[(i + 1) % 4], 0, i});
    axis.nodes.push_back({{p[i], 0}, 0, NodeKind::leaf});
  }
  axis.nodes.push_back({{{1, 1}, 1}, 0, NodeKind::branching});
  axis.nodes.push_back({{{3, 1}, 1}, 0, NodeKind::branching});
  const auto add = [&axis](std::uint32_t from, std::uint32_t to, std::uint32_t left,
                           std::uint32_t right) {
    axis.edges.push_back(
        {{from, to}, {left, right}, middle(axis.nodes[from].disk, axis.nodes[to].disk), 1});
  };
  add(0, 4, 3, 0);
  add(1, 5, 0, 1);
  add(2, 5, 1, 2);
  add(3, 4, 2, 3);
  add(4, 5, 2, 0);
  axis.statistics.queries = 12;
  return item;
}

/// One parabola, between the vertex (0, 1) of a notch and the line below it. Not the whole axis.
inline AxisItem parabola() {
  AxisItem item;
  item.shape = shape_of({{{-2, 0}, {2, 0}, {2, 2}, {0, 1}, {-2, 2}}});
  MedialAxis& axis = item.axis;
  axis.method = "hand";
  axis.sites.push_back({{-2, 0}, {2, 0}, 0, 0});
  axis.sites.push_back({{0, 1}, {0, 1}, 0, 3});
  axis.nodes.push_back({{{-1, 1}, 1}, 0, NodeKind::site_change});
  axis.nodes.push_back({{{1, 1}, 1}, 0, NodeKind::site_change});
  axis.edges.push_back({{0, 1}, {1, 0}, {{0, 0}, 0}, 1});
  item.attributes = {{"name", "notch \"1\""}, {"height", "2.5"}, {"code", "007"}, {"count", "3"}};
  return item;
}

inline Document<AxisItem> two_items() {
  Document<AxisItem> file;
  file.items = {rectangle(), parabola()};
  return file;
}

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool same(Vec2 a, Vec2 b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y); }
inline bool same(const Disk& a, const Disk& b) {
  return same(a.center, b.center) && same_bits(a.radius, b.radius);
}

inline void expect_same(const AxisItem& a, const AxisItem& b) {
  EXPECT_EQ(a.attributes, b.attributes);
  ASSERT_EQ(a.shape.points.size(), b.shape.points.size());
  for (std::size_t i = 0; i < a.shape.points.size(); ++i) {
    EXPECT_TRUE(same(a.shape.points[i], b.shape.points[i]));
    EXPECT_EQ(a.shape.sources[i].ring, b.shape.sources[i].ring);
    EXPECT_EQ(a.shape.sources[i].vertex, b.shape.sources[i].vertex);
  }
  EXPECT_EQ(a.shape.loop_begin, b.shape.loop_begin);
  EXPECT_EQ(a.shape.component, b.shape.component);
  EXPECT_EQ(a.shape.hole, b.shape.hole);
  EXPECT_EQ(a.axis.method, b.axis.method);
  EXPECT_TRUE(same_bits(a.axis.tolerance, b.axis.tolerance));
  EXPECT_TRUE(same_bits(a.axis.resolution, b.axis.resolution));
  ASSERT_EQ(a.axis.sites.size(), b.axis.sites.size());
  for (std::size_t i = 0; i < a.axis.sites.size(); ++i) {
    const Site& s = a.axis.sites[i];
    const Site& t = b.axis.sites[i];
    EXPECT_TRUE(same(s.start, t.start) && same(s.end, t.end));
    EXPECT_TRUE(s.ring == t.ring && s.vertex == t.vertex && s.kind() == t.kind());
  }
  ASSERT_EQ(a.axis.nodes.size(), b.axis.nodes.size());
  for (std::size_t i = 0; i < a.axis.nodes.size(); ++i) {
    EXPECT_TRUE(same(a.axis.nodes[i].disk, b.axis.nodes[i].disk));
    EXPECT_EQ(a.axis.nodes[i].kind, b.axis.nodes[i].kind);
    EXPECT_EQ(a.axis.nodes[i].component, b.axis.nodes[i].component);
  }
  ASSERT_EQ(a.axis.edges.size(), b.axis.edges.size());
  for (std::size_t i = 0; i < a.axis.edges.size(); ++i) {
    EXPECT_EQ(a.axis.edges[i].node, b.axis.edges[i].node);
    EXPECT_EQ(a.axis.edges[i].site, b.axis.edges[i].site);
    EXPECT_TRUE(same(a.axis.edges[i].control, b.axis.edges[i].control));
    EXPECT_TRUE(same_bits(a.axis.edges[i].weight, b.axis.edges[i].weight));
  }
  EXPECT_EQ(a.axis.statistics.queries, b.axis.statistics.queries);
}

/// One triangle of longitudes and latitudes.
inline std::string degrees(double x, double y, double size) {
  std::ostringstream text;
  text << "SRID=4326;POLYGON((" << x << ' ' << y << ',' << x + size << ' ' << y << ',' << x << ' '
       << y + size << "))";
  return text.str();
}

}  // namespace medial::io
