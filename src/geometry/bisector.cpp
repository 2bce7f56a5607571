#include "geometry/bisector.h"

namespace medial::geometry {
namespace {

/// The disk that touches segment `s` at parameter `at` and the vertex.
Disk disk_over(const Site& s, double at, Vec2 vertex) {
  const Vec2 foot = s.point + at * s.direction;
  const Vec2 d = vertex - foot;
  const double r = squared_norm(d) / (2 * dot(s.normal(), d));
  return {foot + r * s.normal(), r};
}

}  // namespace

Disk Bisector::disk_at(double position, const Disk& near) const {
  if (right.is_vertex() && left.is_vertex()) {
    const Vec2 middle = midpoint(right.point, left.point);
    const Vec2 center = middle + (position - dot(direction, middle)) * direction;
    return {center, distance(center, right.point)};
  }
  if (left.is_vertex())
    return disk_over(right, dot(right.direction, position * direction - right.point), left.point);
  if (right.is_vertex())
    return disk_over(left, dot(left.direction, position * direction - left.point), right.point);
  const Vec2 center = near.center + (position - dot(direction, near.center)) * direction;
  return {center, carrier_distance(right, center)};
}

double Bisector::last_position(const Disk& near, double limit) const {
  if (right.is_vertex() && left.is_vertex()) {
    const double half = 0.5 * distance(right.point, left.point);
    const double height = std::sqrt(std::max(0.0, limit * limit - half * half));
    return dot(direction, midpoint(right.point, left.point)) + height;
  }
  if (right.is_vertex() || left.is_vertex()) {
    const Site& segment = right.is_vertex() ? left : right;
    const Vec2 vertex = right.is_vertex() ? right.point : left.point;
    // Over the segment's line, a vertex at height y is reached by r = (x^2 + y^2) / (2 y).
    const double y = cross(segment.direction, vertex - segment.point);
    const double x = std::sqrt(std::max(0.0, (2 * limit - y) * y));
    return dot(direction, vertex) + x;
  }
  // Two segments: the radius is linear along the bisector.
  const double slope = dot(right.normal(), direction);
  const double reach =
      slope > 0 ? (limit - near.radius) / slope : (slope < 0 ? near.radius / -slope : limit);
  return position(near.center) + std::max(0.0, std::min(reach, 4 * limit));
}

Control control_of(const Site& a, const Site& b, const Disk& from, const Disk& to) {
  const Disk middle{midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)};
  if (a.is_vertex() && b.is_vertex()) {
    // Along the line of centres the radius is a hyperbola: with h measured from the middle of the
    // vertices, r = d cosh u and h = d sinh u, and the shoulder point lies at the mean u. Its
    // weight is cosh of half the difference of u; written with differences to spare cancellation.
    const Vec2 foot = midpoint(a.point, b.point);
    const double squared = 0.25 * squared_norm(b.point - a.point);
    const double dh = distance(from.center, to.center), dr = to.radius - from.radius;
    const double weight_squared =
        squared > 0 ? 1 + std::max(0.0, (dh - dr) * (dh + dr)) / (4 * squared) : 1;
    return {{foot + (1 / weight_squared) * (middle.center - foot), middle.radius / weight_squared},
            std::sqrt(weight_squared)};
  }
  if (!a.is_vertex() && !b.is_vertex()) return {middle, 1};
  // A parabola over the segment: polynomial in the foot's parameter, so the control point is the
  // blossom at both ends. With x and y the vertex seen from the segment,
  // r(s) = ((s - x)^2 + y^2) / (2 y) has the blossom ((s - x)(t - x) + y^2) / (2 y).
  const Site& segment = a.is_vertex() ? b : a;
  const Vec2 vertex = a.is_vertex() ? a.point : b.point;
  const double y = cross(segment.direction, vertex - segment.point);
  const double s = dot(segment.direction, from.center - vertex);
  const double t = dot(segment.direction, to.center - vertex);
  if (!(y > 0)) return {middle, 1};
  const double r = (s * t + y * y) / (2 * y);
  // Centres lie at height r over the line; the vertex at height y.
  const Vec2 center = vertex + (0.5 * (s + t)) * segment.direction + (r - y) * segment.normal();
  return {{center, r}, 1};
}

}  // namespace medial::geometry
