// Widths along a path, and mean widths.

#include "medial/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "base/quadrature.h"
#include "medial/query.h"
#include "ops/half_edges.h"
#include "ops/routes.h"

namespace medial {
namespace ops {

LocalWidth width_at(const MedialAxis& axis, EdgePlace place, bool forward) {
  const Edge& edge = axis.edges[place.edge];
  LocalWidth out;
  out.disk = disk_at(axis, edge, place.t);
  const bool named = std::max(edge.site[0], edge.site[1]) < axis.sites.size();
  out.feet = feet_at(axis, edge, place.t, out.disk, named && axis.resolution == 0);
  if (!forward) std::swap(out.feet[0], out.feet[1]);
  return out;
}

}  // namespace ops

namespace {

/// The integrals along an edge that mean widths are made of.
struct Sums {
  double diameter = 0;       ///< of 2 r ds
  double area = 0;           ///< of what the disks sweep, less the nodes' terms
  double area_diameter = 0;  ///< of 2 r over that area, likewise
  Sums& operator+=(const Sums& other) {
    diameter += other.diameter;
    area += other.area;
    area_diameter += other.area_diameter;
    return *this;
  }
};

/// What one length of axis adds, at t. With R' the rate of the radius and s = sqrt(1 - R'^2), both
/// sides together sweep 2 R s - R^2 R'' / s a length; R'' / s is the derivative of asin R', and
/// integrating by parts leaves 2 R (s + R' asin R'), and terms at the nodes.
Sums at(const Curve& curve, double t) {
  const Curve::Derivatives d = curve.derivatives(t);
  const double speed = norm(d.first);
  if (!(speed > 0)) return {};
  const double r = std::max(curve.at(t).radius, 0.0);
  const double rate = std::clamp(d.radius_first / speed, -1.0, 1.0);
  const double s = std::sqrt((1 - rate) * (1 + rate)), turn = rate * std::asin(rate);
  return {2 * r * speed, 2 * r * (s + turn) * speed, r * r * (4 * s + 6 * turn) * speed};
}

Sums gauss(const Curve& curve, double low, double high) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  Sums sum;
  for (const auto& [place, weight] : gauss8) {
    for (const double side : {-half, half}) {
      const Sums one = at(curve, middle + side * place);
      const double f = half * weight;
      sum += {f * one.diameter, f * one.area, f * one.area_diameter};
    }
  }
  return sum;
}

/// Halved until two halves agree with the whole, up to shares of `scale`.
Sums integral(const Curve& curve, double low, double high, const Sums& whole, const Sums& scale,
              int depth) {
  constexpr double relative = 1e-12;
  constexpr int deepest = 20;
  const double middle = 0.5 * (low + high);
  const Sums first = gauss(curve, low, middle), second = gauss(curve, middle, high);
  Sums both = first;
  both += second;
  const auto agree = [](double a, double b, double of) { return std::abs(a - b) <= relative * of; };
  if (depth == deepest || (agree(whole.diameter, both.diameter, scale.diameter) &&
                           agree(whole.area, both.area, scale.area) &&
                           agree(whole.area_diameter, both.area_diameter, scale.area_diameter)))
    return both;
  Sums sum = integral(curve, low, middle, first, scale, depth + 1);
  sum += integral(curve, middle, high, second, scale, depth + 1);
  return sum;
}

Sums integral(const Curve& curve, double low, double high) {
  // No less than the integrals of the largest values.
  const double size = norm(curve.p1) + norm(curve.p2 - curve.p1);
  const double r = std::max({curve.r0, curve.r2, std::abs(curve.r1)});
  const Sums scale{2 * r * size, 2 * r * size, 4 * r * r * size};
  return integral(curve, low, high, gauss(curve, low, high), scale, 0);
}

}  // namespace

Disk deepest_disk(const MedialAxis& axis) {
  Disk deepest = axis.nodes[deepest_node(axis)].disk;
  for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
    const EdgePlace place = ops::widest_place(axis, i);
    if (place.t == 0 || place.t == 1) continue;
    const Disk disk = disk_at(axis, axis.edges[i], place.t);
    if (disk.radius > deepest.radius) deepest = disk;
  }
  return deepest;
}

std::vector<LocalWidth> widths_along(const MedialAxis& axis, const AxisPath& path,
                                     std::span<const double> lengths) {
  std::vector<LocalWidth> out;
  out.reserve(lengths.size());
  double before = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < path.pieces.size() && next < lengths.size(); ++i) {
    const PathPiece& piece = path.pieces[i];
    const Curve curve = curve_of(axis, axis.edges[piece.edge]);
    const double from = curve.length(piece.from);
    const bool forward = piece.from <= piece.to;
    const double size = std::abs(curve.length(piece.to) - from);
    const bool last = i + 1 == path.pieces.size();
    while (next < lengths.size() && (last || lengths[next] <= before + size)) {
      const double step = std::clamp(lengths[next] - before, 0.0, size);
      const double t = step == size  ? piece.to
                       : step == 0.0 ? piece.from
                                     : curve.at_length(forward ? from + step : from - step);
      LocalWidth width = ops::width_at(axis, {piece.edge, t}, forward);
      width.along = lengths[next++];
      out.push_back(width);
    }
    before += size;
  }
  return out;
}

MeanWidth mean_width(const MedialAxis& axis, const AxisPath& path) {
  // A node of n edges adds what its disk has between the spokes: with the terms left by the
  // integrals, pi (1 - n / 2) r^2 to the area.
  const std::vector<std::uint32_t> degree = degrees_of(axis);
  Sums all;
  for (const Edge& edge : axis.edges) all += integral(curve_of(axis, edge), 0, 1);
  for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
    const double r = axis.nodes[i].disk.radius;
    const double share = std::numbers::pi * (1 - 0.5 * degree[i]) * r * r;
    all.area += share;
    all.area_diameter += 2 * r * share;
  }
  MeanWidth mean;
  double diameter = 0;
  for (const PathPiece& piece : path.pieces) {
    const auto [low, high] = std::minmax(piece.from, piece.to);
    diameter += integral(curve_of(axis, axis.edges[piece.edge]), low, high).diameter;
  }
  mean.length = path.length;
  mean.area = all.area;
  mean.by_area = all.area > 0 ? all.area_diameter / all.area : 0;
  mean.by_length = path.length > 0 ? diameter / path.length : 0;
  mean.area_by_length = path.length > 0 ? all.area / path.length : 0;
  return mean;
}

}  // namespace medial
