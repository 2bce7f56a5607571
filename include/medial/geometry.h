#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

// Points, disks and boxes of the plane and vectors of space, in the units of the input.
namespace medial {

struct Vec2 {
  double x = 0, y = 0;

  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
  friend constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
  friend constexpr bool operator==(Vec2, Vec2) = default;
};

constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// The z component of the cross product: positive where b lies to the left of a.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// a rotated by a quarter turn to the left.
constexpr Vec2 left_of(Vec2 a) { return {-a.y, a.x}; }
constexpr double squared_norm(Vec2 a) { return dot(a, a); }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
inline double distance(Vec2 a, Vec2 b) { return norm(a - b); }
constexpr Vec2 midpoint(Vec2 a, Vec2 b) { return a + 0.5 * (b - a); }

struct Disk {
  Vec2 center;
  double radius = 0;
};

/// An axis-parallel rectangle.
struct Box {
  Vec2 low, high;

  /// The empty box, to add to.
  static constexpr Box nothing() {
    constexpr double endless = std::numeric_limits<double>::infinity();
    return {{endless, endless}, {-endless, -endless}};
  }
  bool is_nothing() const { return !(low.x <= high.x); }
  void add(Vec2 p) { add(Box{p, p}); }
  void add(const Box& box) {
    low = {std::min(low.x, box.low.x), std::min(low.y, box.low.y)};
    high = {std::max(high.x, box.high.x), std::max(high.y, box.high.y)};
  }
};

inline double diagonal(const Box& box) {
  return std::hypot(box.high.x - box.low.x, box.high.y - box.low.y);
}

struct Vec3 {
  double x = 0, y = 0, z = 0;

  constexpr double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  friend constexpr bool operator==(Vec3, Vec3) = default;
};

}  // namespace medial
