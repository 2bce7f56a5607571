#include "voronoi/clip.h"

#include <algorithm>
#include <cmath>

namespace medial::voronoi {
namespace {

/// A point with its weight: curves between such are polynomials.
struct Weighted {
  Vec2 center;
  double radius = 0, weight = 1;
};
Weighted weighted(const Disk& disk, double w) { return {w * disk.center, w * disk.radius, w}; }
Weighted sum(double a, const Weighted& u, double b, const Weighted& v, double c,
             const Weighted& w) {
  return {a * u.center + b * v.center + c * w.center, a * u.radius + b * v.radius + c * w.radius,
          a * u.weight + b * v.weight + c * w.weight};
}

/// 1 - t and t.
std::array<double, 2> shares_of(double s) {
  if (s == ConicEdge::last) return {0, 1};
  return {1 / (1 + s), s / (1 + s)};
}

/// The curve's polar form: its points at s = t, and the control point of the part from s to t.
Weighted blossom(const ConicEdge& edge, double s, double t) {
  const auto [before, at] = shares_of(s);
  const auto [other_before, other_at] = shares_of(t);
  return sum(before * other_before, weighted(edge.from, 1), before * other_at + at * other_before,
             weighted(edge.control, edge.weight), at * other_at, weighted(edge.to, 1));
}
Disk disk_of(const Weighted& w) { return {(1 / w.weight) * w.center, w.radius / w.weight}; }

/// Appends the s above 0 where a + 2 b s + c s^2 is 0, without cancellation.
void add_ratios(double a, double b, double c, std::vector<double>& out) {
  const double squared = b * b - a * c;
  if (!(squared >= 0)) return;
  const double sum = -(b + std::copysign(std::sqrt(squared), b));
  for (const double s : {sum / c, a / sum})
    if (s > 0 && s < ConicEdge::last) out.push_back(s);
}

/// A parameter between two others, at neither end up to rounding unless both are there.
double between(double s, double t) {
  if (t == ConicEdge::last) return 1 + 2 * s;
  return s > 0 ? std::sqrt(s) * std::sqrt(t) : t / (2 + t);
}

}  // namespace

Disk ConicEdge::at(double s) const {
  return s == 0 ? from : s == last ? to : disk_of(blossom(*this, s, s));
}

ConicEdge ConicEdge::part(double begin, double end) const {
  if (begin == 0 && end == last) return *this;
  const Weighted first = blossom(*this, begin, begin), other = blossom(*this, end, end);
  const Weighted middle = blossom(*this, begin, end);
  return {at(begin), disk_of(middle), at(end),
          middle.weight / std::sqrt(first.weight * other.weight)};
}

void clip(const ConicEdge& edge, const Box& box, std::vector<ClippedPart>& parts) {
  parts.clear();
  const std::array<Vec2, 3> hull{edge.from.center, edge.control.center, edge.to.center};
  const auto all = [&](auto&& holds) { return std::all_of(hull.begin(), hull.end(), holds); };
  // By its weights, a curve stays in the hull of its control points.
  if (all([&](Vec2 p) { return is_inside(box, p); })) {
    parts.push_back({});
    return;
  }
  if (all([&](Vec2 p) { return p.x <= box.low.x; }) ||
      all([&](Vec2 p) { return p.x >= box.high.x; }) ||
      all([&](Vec2 p) { return p.y <= box.low.y; }) ||
      all([&](Vec2 p) { return p.y >= box.high.y; }))
    return;
  std::vector<double> stops{0, ConicEdge::last};
  for (const double x : {box.low.x, box.high.x})
    add_ratios(hull[0].x - x, edge.weight * (hull[1].x - x), hull[2].x - x, stops);
  for (const double y : {box.low.y, box.high.y})
    add_ratios(hull[0].y - y, edge.weight * (hull[1].y - y), hull[2].y - y, stops);
  std::sort(stops.begin(), stops.end());
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    if (!(stops[i] < stops[i + 1])) continue;
    if (!is_inside(box, edge.at(between(stops[i], stops[i + 1])).center)) continue;
    if (!parts.empty() && parts.back().to == stops[i])
      parts.back().to = stops[i + 1];
    else
      parts.push_back({stops[i], stops[i + 1]});
  }
}

double place_on_border(const Box& box, Vec2 p) {
  const double width = box.high.x - box.low.x, height = box.high.y - box.low.y;
  if (p.y == box.low.y) return (p.x - box.low.x) / width;
  if (p.x == box.high.x) return 1 + (p.y - box.low.y) / height;
  if (p.y == box.high.y) return 2 + (box.high.x - p.x) / width;
  return 3 + (box.high.y - p.y) / height;
}

Vec2 onto_border(const Box& box, Vec2 p) {
  p = {std::clamp(p.x, box.low.x, box.high.x), std::clamp(p.y, box.low.y, box.high.y)};
  const double left = p.x - box.low.x, right = box.high.x - p.x;
  const double below = p.y - box.low.y, above = box.high.y - p.y;
  const double least = std::min({left, right, below, above});
  if (least == below) return {p.x, box.low.y};
  if (least == right) return {box.high.x, p.y};
  if (least == above) return {p.x, box.high.y};
  return {box.low.x, p.y};
}

}  // namespace medial::voronoi
