#pragma once

// What the tests of curves measure with: curves in long double by their definition, distances by
// brute force. Nothing of src/curves is used.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "medial/contour.h"

namespace medial::test {

/// A point of a piece of a contour at t in [0, 1].
inline Vec2 point_of(const Contour& contour, const CurvePiece& piece, double t) {
  using Wide = long double;
  const Vec2* p = contour.points.data() + piece.first;
  if (piece.bulge != 0) {
    const Wide angle = 4 * std::atan(static_cast<Wide>(piece.bulge));
    const Wide dx = static_cast<Wide>(p[1].x) - p[0].x, dy = static_cast<Wide>(p[1].y) - p[0].y;
    // The chord from the begin to the point at `t` of the angle.
    const Wide scale = std::sin(t * angle / 2) / std::sin(angle / 2), turn = (t - 1) * angle / 2;
    const Wide c = std::cos(turn), s = std::sin(turn);
    return {static_cast<double>(p[0].x + scale * (c * dx - s * dy)),
            static_cast<double>(p[0].y + scale * (s * dx + c * dy))};
  }
  std::vector<Wide> x, y, w;
  for (std::uint32_t i = 0; i <= piece.degree; ++i) {
    const Wide weight = contour.weights.empty() ? 1 : contour.weights[piece.first + i];
    x.push_back(weight * p[i].x);
    y.push_back(weight * p[i].y);
    w.push_back(weight);
  }
  for (std::uint32_t level = piece.degree; level > 0; --level) {
    for (std::uint32_t i = 0; i < level; ++i) {
      x[i] += t * (x[i + 1] - x[i]);
      y[i] += t * (y[i + 1] - y[i]);
      w[i] += t * (w[i + 1] - w[i]);
    }
  }
  return {static_cast<double>(x[0] / w[0]), static_cast<double>(y[0] / w[0])};
}

/// ArcEdge i of a ring as an arc.
struct ArcEdge {
  Vec2 begin;
  Vec2 end;
  double bulge = 0;

  double curvature() const { return 4 * bulge / (distance(begin, end) * (1 + bulge * bulge)); }
  /// Unit tangents, from the half angle 2 atan(bulge) between chord and tangent.
  Vec2 tangent(bool at_end) const {
    const double half = 2 * std::atan(bulge) * (at_end ? 1 : -1);
    const Vec2 d = (1 / distance(begin, end)) * (end - begin);
    return {d.x * std::cos(half) - d.y * std::sin(half),
            d.x * std::sin(half) + d.y * std::cos(half)};
  }
  Vec2 middle() const { return midpoint(begin, end) - 0.5 * bulge * left_of(end - begin); }

  double distance_to(Vec2 p) const {
    const double ends = std::min(distance(p, begin), distance(p, end));
    const bool inside = dot(tangent(false), p - begin) >= 0 && dot(tangent(true), p - end) <= 0;
    if (!inside) return ends;
    // The signed distance d from the circle: 2 d + k d^2 = k |c|^2 - 2 (v x c).
    const Vec2 c = p - begin;
    const double k = curvature();
    const double f = k * squared_norm(c) - 2 * cross(tangent(false), c);
    return std::min(ends, std::abs(f) / (1 + std::sqrt(std::max(0.0, 1 + k * f))));
  }
};

inline std::vector<ArcEdge> edges_of(const Ring& ring) {
  std::vector<ArcEdge> edges;
  const std::size_t n = ring.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    edges.push_back({ring.points[i], ring.points[(i + 1) % n], ring.bulges[i]});
  }
  return edges;
}

/// The distance between a contour that its pieces close and its ring, both ways, at `samples`
/// points of each piece and at the middle of each edge. An estimate from below.
inline double measured_distance(const Contour& contour, const Ring& ring, int samples) {
  const std::vector<ArcEdge> edges = edges_of(ring);
  double largest = 0;
  struct Sample {
    Vec2 point;
    std::size_t piece;
    double t;
  };
  std::vector<Sample> on_curve;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    for (int j = 0; j <= samples; ++j) {
      const double t = static_cast<double>(j) / samples;
      on_curve.push_back({point_of(contour, contour.pieces[i], t), i, t});
    }
  }
  for (const Sample& sample : on_curve) {
    double least = 1e300;
    for (const ArcEdge& edge : edges) {
      const double reach = 2 * distance(edge.begin, edge.end);
      if (distance(sample.point, edge.begin) > least + reach) continue;
      least = std::min(least, edge.distance_to(sample.point));
    }
    largest = std::max(largest, least);
  }
  for (const ArcEdge& edge : edges) {
    const Vec2 middle = edge.middle();
    double nearest = 1e300;
    for (const Sample& sample : on_curve) {
      nearest = std::min(nearest, distance(sample.point, middle));
    }
    double least = nearest;
    for (std::size_t i = 0; i < on_curve.size(); ++i) {
      // All local minima that can hide a smaller one: curves cross themselves.
      const Sample& sample = on_curve[i];
      const Sample& before = on_curve[i == 0 ? i : i - 1];
      const Sample& after = on_curve[i + 1 == on_curve.size() ? i : i + 1];
      const double here = distance(sample.point, middle);
      if (here > distance(before.point, middle) || here > distance(after.point, middle) ||
          here > nearest + distance(before.point, after.point)) {
        continue;
      }
      const auto away = [&](double t) {
        return distance(point_of(contour, contour.pieces[sample.piece], t), middle);
      };
      // Ternary search around the sample.
      double low = std::max(0.0, sample.t - 1.0 / samples);
      double high = std::min(1.0, sample.t + 1.0 / samples);
      for (int step = 0; step < 80; ++step) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (away(a) < away(b)) {
          high = b;
        } else {
          low = a;
        }
      }
      least = std::min(least, away(low));
    }
    largest = std::max(largest, least);
  }
  return largest;
}

/// The number of convex arcs that are more curved than both neighbours, runs of one curvature
/// counted once. The interior is on the left.
inline int locally_most_curved(const Ring& ring) {
  // Neighbours on one circle differ by rounding: of points over the square of chords.
  constexpr double same = 1e-7;
  std::vector<double> k;
  for (const ArcEdge& edge : edges_of(ring)) {
    const double next = edge.curvature();
    if (k.empty() || std::abs(next - k.back()) > same * std::abs(next)) k.push_back(next);
  }
  while (k.size() > 1 && std::abs(k.front() - k.back()) <= same * std::abs(k.back())) k.pop_back();
  const std::size_t n = k.size();
  int count = 0;
  for (std::size_t i = 0; n > 1 && i < n; ++i) {
    count += k[i] > 0 && k[i] > k[(i + 1) % n] && k[i] > k[(i + n - 1) % n];
  }
  return count;
}

/// The largest angle between the tangents of neighbouring edges.
inline double largest_turn(const Ring& ring) {
  const std::vector<ArcEdge> edges = edges_of(ring);
  double largest = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vec2 u = edges[i].tangent(true), v = edges[(i + 1) % edges.size()].tangent(false);
    largest = std::max(largest, std::abs(std::atan2(cross(u, v), dot(u, v))));
  }
  return largest;
}

}  // namespace medial::test
