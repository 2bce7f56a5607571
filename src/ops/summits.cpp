#include "ops/summits.h"

#include <cmath>
#include <optional>

#include "axis/curve.h"

namespace medial::ops {
namespace {

/// Where the radius along an edge rises, then falls: t / (1 - t) there. A radius takes each value
/// twice at most along an edge, so there is one extremum at most.
std::optional<double> summit(const MedialAxis& axis, const Edge& edge) {
  const double r0 = axis.nodes[edge.node[0]].disk.radius;
  const double r2 = axis.nodes[edge.node[1]].disk.radius;
  const double r1 = edge.control.radius;
  if (!(r1 > r0 && r1 > r2)) return std::nullopt;
  // The derivative's numerator is a s^2 + 2 b s t - c t^2 with s = 1 - t; a and c are positive.
  const double a = edge.weight * (r1 - r0), b = 0.5 * (r2 - r0), c = edge.weight * (r1 - r2);
  const double root = std::sqrt(b * b + a * c);
  const double u = b > 0 ? (b + root) / c : a / (root - b);
  if (!(u > 0) || !std::isfinite(u)) return std::nullopt;
  return u;
}

void divide(MedialAxis& axis, std::size_t index, double u) {
  const Edge whole = axis.edges[index];
  const Curve curve = curve_of(axis, whole);
  const double t = u / (1 + u), s = 1 / (1 + u), w = whole.weight;
  const Disk top = curve.at(t);
  const double least = std::fmax(curve.r0, curve.r2);
  if (!(top.radius > least)) return;  // rounding
  // De Casteljau's construction in homogeneous coordinates, relative to the first centre.
  const double w01 = s + t * w, w12 = s * w + t;
  const double middle = std::sqrt(s * w01 + t * w12);
  const auto node = static_cast<std::uint32_t>(axis.nodes.size());
  axis.nodes.push_back({top, axis.nodes[whole.node[0]].component, NodeKind::site_change});
  Edge first = whole, second = whole;
  first.node[1] = second.node[0] = node;
  first.control = {curve.origin + (t * w / w01) * curve.p1,
                   (s * curve.r0 + t * w * curve.r1) / w01};
  first.weight = w01 / middle;
  second.control = {curve.origin + (1 / w12) * (s * w * curve.p1 + t * curve.p2),
                    (s * w * curve.r1 + t * curve.r2) / w12};
  second.weight = w12 / middle;
  axis.edges[index] = first;
  axis.edges.push_back(second);
}

}  // namespace

bool has_summits(const MedialAxis& axis) {
  for (const Edge& edge : axis.edges)
    if (summit(axis, edge)) return true;
  return false;
}

void divide_at_summits(MedialAxis& axis) {
  const std::size_t count = axis.edges.size();
  for (std::size_t e = 0; e < count; ++e)
    if (const auto u = summit(axis, axis.edges[e])) divide(axis, e, *u);
}

}  // namespace medial::ops
