#include "methods/disks/tie_fit.h"

#include <algorithm>

namespace medial::disks {

void Fit::begin(std::span<const Touch> contacts) {
  std::array<Vec2, 2> spread{normal(contacts[0]), {}};
  reference_[0] = contacts[0];
  double largest = -1;
  for (const Touch& i : contacts) {
    const double size = squared_norm(normal(i) - spread[0]);
    if (!(size > largest)) continue;
    largest = size;
    reference_[1] = i;
  }
  spread[1] = normal(reference_[1]) - spread[0];
  largest = -1;
  for (const Touch& i : contacts) {
    const double size = std::abs(cross(spread[1], normal(i) - spread[0]));
    if (!(size > largest)) continue;
    largest = size;
    reference_[2] = i;
  }
  count_ = 3;
}

bool Fit::touches(std::initializer_list<std::span<const Touch>> lists) {
  worst = 0;
  furthest_ = {};
  for (const auto contacts : lists) {
    for (const Touch& i : contacts) {
      const double distance = distance_to(i);
      const double residual = std::abs(distance - disk.radius);
      if (residual <= worst) continue;
      worst = residual;
      furthest_ = i;
    }
  }
  return worst <= bound_;
}

bool Fit::improve() {
  const auto end = reference_.begin() + static_cast<std::ptrdiff_t>(count_);
  if (std::find(reference_.begin(), end, furthest_) == end) exchange();
  if (count_ < 4)
    return move({contact(reference_[0]), contact(reference_[1]), contact(reference_[2])}, {});
  const std::array<ContactEquation, 4> contact = contacts(reference_);
  const Dependency dependency(contact);
  if (!(std::abs(dependency.level) <= bound_)) return false;
  // The contact with the largest factor follows from the others, which are far from singular.
  std::size_t last = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (std::abs(dependency.factor[i]) > std::abs(dependency.factor[last])) last = i;
  std::array<ContactEquation, 3> others;
  std::array<double, 3> goal{};
  for (std::size_t i = 0, k = 0; i < 4; ++i) {
    if (i == last) continue;
    others[k] = contact[i];
    goal[k++] = std::copysign(1.0, dependency.factor[i]) * dependency.level;
  }
  return move(others, goal);
}

double Fit::distance_to(const Touch& i) const {
  if (i.part == Touch::Part::site)
    return std::sqrt(site::squared_distance(sites_[i.site], disk.center));
  return distance(i.seen_from(sites_, disk.center).point, disk.center);
}

std::array<ContactEquation, 4> Fit::contacts(const std::array<Touch, 4>& reference) const {
  std::array<ContactEquation, 4> result;
  for (std::size_t i = 0; i < 4; ++i) result[i] = contact(reference[i]);
  return result;
}

void Fit::exchange() {
  if (count_ < 4) {
    reference_[count_++] = furthest_;
    return;
  }
  std::array<Touch, 4> best = reference_;
  double highest = -1;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Touch, 4> next = reference_;
    next[i] = furthest_;
    const double level = std::abs(Dependency(contacts(next)).level);
    if (!(level > highest)) continue;
    highest = level;
    best = next;
  }
  reference_ = best;
}

bool Fit::move(const std::array<ContactEquation, 3>& contact, const std::array<double, 3>& goal) {
  const Vec2 b = contact[1].outward - contact[0].outward;
  const Vec2 c = contact[2].outward - contact[0].outward;
  const double a_change = goal[0] - contact[0].residual;
  const double db = goal[1] - contact[1].residual - a_change;
  const double dc = goal[2] - contact[2].residual - a_change;
  const double inverse = 1 / cross(b, c);
  const Vec2 step = inverse * Vec2{db * c.y - dc * b.y, b.x * dc - c.x * db};
  disk.center = disk.center + step;
  disk.radius += dot(contact[0].outward, step) - a_change;
  return std::isfinite(disk.center.x) && std::isfinite(disk.center.y) && disk.radius > 0;
}

}  // namespace medial::disks
