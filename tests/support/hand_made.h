#pragma once

// Shapes with their axes in closed form, written by hand: no builder and no engine is involved.

#include <cmath>
#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "medial/shape.h"

namespace medial::test {

struct HandMade {
  Shape shape;
  MedialAxis axis;
  std::vector<std::uint32_t> segment_site;  ///< of the edge that begins in each point of the shape
  std::vector<std::uint32_t> vertex_site;   ///< of each point, where it is reflex

  /// Fills the shape and the sites. The first loop is the outer one.
  explicit HandMade(const std::vector<std::vector<Vec2>>& loops) {
    shape.loop_begin.push_back(0);
    for (std::uint32_t ring = 0; ring < loops.size(); ++ring) {
      const auto& loop = loops[ring];
      for (std::uint32_t i = 0; i < loop.size(); ++i) {
        const Vec2 before = loop[(i + loop.size() - 1) % loop.size()], point = loop[i],
                   after = loop[(i + 1) % loop.size()];
        shape.points.push_back(point);
        shape.sources.push_back({ring, i});
        vertex_site.push_back(0);
        if (cross(point - before, after - point) < 0) {
          vertex_site.back() = static_cast<std::uint32_t>(axis.sites.size());
          axis.sites.push_back({point, point, ring, i});
        }
        segment_site.push_back(static_cast<std::uint32_t>(axis.sites.size()));
        axis.sites.push_back({point, after, ring, i});
      }
      shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
      shape.component.push_back(0);
      shape.hole.push_back(ring > 0);
    }
    axis.method = "by hand";
  }

  std::uint32_t node(double x, double y, double r) {
    axis.nodes.push_back({{{x, y}, r}, 0, NodeKind::leaf});
    return static_cast<std::uint32_t>(axis.nodes.size() - 1);
  }

  void edge(std::uint32_t from, std::uint32_t to, std::uint32_t left, std::uint32_t right) {
    const Disk a = axis.nodes[from].disk, b = axis.nodes[to].disk;
    const Site& s = axis.sites[left];
    const Site& t = axis.sites[right];
    Edge out{{from, to}, {left, right}, {}, 1};
    const bool s_vertex = s.kind() == SiteKind::vertex, t_vertex = t.kind() == SiteKind::vertex;
    if (s_vertex && t_vertex) {
      // Homogeneous coordinates of a hyperbola: the control point is where the end tangents meet,
      // and the weight follows from the disk over the middle of the two ends' angles.
      const Vec2 middle = midpoint(s.start, t.start);
      const double half = 0.5 * distance(s.start, t.start);
      const Vec2 along = (0.5 / half) * left_of(s.start - t.start);
      const double u = std::asinh(dot(along, a.center - middle) / half);
      const double v = std::asinh(dot(along, b.center - middle) / half);
      out.weight = std::cosh(0.5 * (v - u));
      out.control = {middle + (half * std::sinh(0.5 * (u + v)) / out.weight) * along,
                     half * std::cosh(0.5 * (u + v)) / out.weight};
    } else if (s_vertex || t_vertex) {
      // The tangents at both ends of a parabola meet over the middle of the ends' feet, on the line
      // with direction derivative of r = (x^2 + y^2) / (2 y), which is x / y.
      const Site& segment = s_vertex ? t : s;
      const Vec2 vertex = s_vertex ? s.start : t.start;
      const Vec2 d = (1 / distance(segment.start, segment.end)) * (segment.end - segment.start);
      const double y = cross(d, vertex - segment.start);
      const double x0 = dot(d, a.center - vertex), x1 = dot(d, b.center - vertex);
      const double slope = x0 / y, x = 0.5 * (x0 + x1);
      const double r = a.radius + slope * (x - x0);
      out.control = {vertex + x * d + (r - y) * left_of(d), r};
    } else {
      out.control = {midpoint(a.center, b.center), 0.5 * (a.radius + b.radius)};
    }
    axis.edges.push_back(out);
  }

  /// Sets the nodes' kinds by their degrees.
  void finish() {
    std::vector<int> degree(axis.nodes.size(), 0);
    for (const Edge& e : axis.edges)
      for (const std::uint32_t n : e.node) ++degree[n];
    for (std::size_t i = 0; i < degree.size(); ++i)
      axis.nodes[i].kind = degree[i] == 1   ? NodeKind::leaf
                           : degree[i] == 2 ? NodeKind::site_change
                                            : NodeKind::branching;
  }
};

/// [0, 4] x [0, 2].
inline HandMade rectangle() {
  HandMade m({{{0, 0}, {4, 0}, {4, 2}, {0, 2}}});
  const auto& s = m.segment_site;
  const auto left = m.node(1, 1, 1), right = m.node(3, 1, 1);
  m.edge(left, right, s[2], s[0]);
  m.edge(m.node(0, 0, 0), left, s[3], s[0]);
  m.edge(m.node(4, 0, 0), right, s[0], s[1]);
  m.edge(m.node(4, 2, 0), right, s[1], s[2]);
  m.edge(m.node(0, 2, 0), left, s[2], s[3]);
  m.finish();
  return m;
}

/// Two arms of width 2 and one reflex vertex at (2, 2): two parabolas meet on the diagonal.
inline HandMade ell() {
  HandMade m({{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}});
  const auto& s = m.segment_site;
  const auto v = m.vertex_site[3];
  const double c = 4 - 2 * std::sqrt(2.0);
  const auto knee = m.node(c, c, c), right = m.node(2, 1, 1), up = m.node(1, 2, 1);
  const auto right_end = m.node(3, 1, 1), up_end = m.node(1, 3, 1);
  m.edge(m.node(0, 0, 0), knee, s[5], s[0]);
  m.edge(knee, right, v, s[0]);
  m.edge(right, right_end, s[2], s[0]);
  m.edge(m.node(4, 0, 0), right_end, s[0], s[1]);
  m.edge(m.node(4, 2, 0), right_end, s[1], s[2]);
  m.edge(knee, up, s[5], v);
  m.edge(up, up_end, s[5], s[3]);
  m.edge(m.node(2, 4, 0), up_end, s[3], s[4]);
  m.edge(m.node(0, 4, 0), up_end, s[4], s[5]);
  m.finish();
  return m;
}

/// [0, 6] x [0, 4] with a notch from the top whose vertex is (3, 2).
inline HandMade notch() {
  HandMade m({{{0, 0}, {6, 0}, {6, 4}, {4, 4}, {3, 2}, {2, 4}, {0, 4}}});
  const auto& s = m.segment_site;
  const auto v = m.vertex_site[4];
  const double root = std::sqrt(5.0);
  const double change = 2 * root / (root + 1), low = 8 / (3 + root), high = 4 / (1 + root);
  const double x = 3 + 2 * change / root;
  const auto right = m.node(x, change, change), left = m.node(6 - x, change, change);
  m.edge(left, right, v, s[0]);
  const auto low_right = m.node(6 - low, low, low), high_right = m.node(6 - high, 4 - high, high);
  m.edge(right, low_right, s[3], s[0]);
  m.edge(m.node(6, 0, 0), low_right, s[0], s[1]);
  m.edge(low_right, high_right, s[3], s[1]);
  m.edge(m.node(6, 4, 0), high_right, s[1], s[2]);
  m.edge(m.node(4, 4, 0), high_right, s[2], s[3]);
  const auto low_left = m.node(low, low, low), high_left = m.node(high, 4 - high, high);
  m.edge(low_left, left, s[4], s[0]);
  m.edge(m.node(0, 0, 0), low_left, s[6], s[0]);
  m.edge(low_left, high_left, s[6], s[4]);
  m.edge(m.node(0, 4, 0), high_left, s[5], s[6]);
  m.edge(m.node(2, 4, 0), high_left, s[4], s[5]);
  m.finish();
  return m;
}

/// [0, 10]^2 with the hole [4, 6]^2: one cycle.
inline HandMade square_with_hole() {
  HandMade m({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{4, 4}, {4, 6}, {6, 6}, {6, 4}}});
  const auto& s = m.segment_site;
  const auto& v = m.vertex_site;
  const double c = 4 * std::sqrt(2.0) / (1 + std::sqrt(2.0));
  // Counter-clockwise by sides: bottom, right, top, left. Along a side the outer loop is on the
  // right, the hole on the left.
  const std::vector<Vec2> knee{{c, c}, {10 - c, c}, {10 - c, 10 - c}, {c, 10 - c}};
  const std::vector<Vec2> before{{4, 2}, {8, 4}, {6, 8}, {2, 6}},
      after{{6, 2}, {8, 6}, {4, 8}, {2, 4}};
  const std::vector<std::size_t> first{4, 7, 6, 5};      // the hole's vertex after each knee
  const std::vector<std::size_t> hole_edge{7, 6, 5, 4};  // and the edge that follows
  std::vector<std::uint32_t> knees;
  for (const Vec2 p : knee) knees.push_back(m.node(p.x, p.y, c));
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    const auto begin = m.node(before[i].x, before[i].y, 2), end = m.node(after[i].x, after[i].y, 2);
    m.edge(knees[i], begin, v[first[i]], s[i]);
    m.edge(begin, end, s[hole_edge[i]], s[i]);
    m.edge(end, knees[next], v[first[next]], s[i]);
    const Vec2 corner = m.shape.points[i];
    m.edge(m.node(corner.x, corner.y, 0), knees[i], s[(i + 3) % 4], s[i]);
  }
  m.finish();
  return m;
}

/// A waist between the reflex vertices (0, -1) and (0, 1): the middle edge is a hyperbola in r.
inline HandMade hourglass() {
  HandMade m({{{-4, -3}, {0, -1}, {4, -3}, {4, 3}, {0, 1}, {-4, 3}}});
  const auto& s = m.segment_site;
  const double root = std::sqrt(5.0);
  const double x = (4 * root - 2) / (1 + root);
  const auto left = m.node(-0.5, 0, root / 2), right = m.node(0.5, 0, root / 2);
  const auto left_end = m.node(-x, 0, 4 - x), right_end = m.node(x, 0, 4 - x);
  m.edge(left, right, m.vertex_site[4], m.vertex_site[1]);
  m.edge(right, right_end, s[3], s[1]);
  m.edge(left_end, left, s[4], s[0]);
  m.edge(m.node(4, -3, 0), right_end, s[1], s[2]);
  m.edge(m.node(4, 3, 0), right_end, s[2], s[3]);
  m.edge(m.node(-4, 3, 0), left_end, s[4], s[5]);
  m.edge(m.node(-4, -3, 0), left_end, s[5], s[0]);
  m.finish();
  return m;
}

/// All of them.
inline std::vector<HandMade> all_hand_made() {
  return {rectangle(), ell(), notch(), square_with_hole(), hourglass()};
}

}  // namespace medial::test
