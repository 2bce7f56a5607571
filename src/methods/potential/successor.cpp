#include "methods/potential/successor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace medial::potential {
namespace {

/// Valleys of an order from here on are sharp enough for a much higher order at once.
constexpr double searched_below = 24;
/// From order to order of one point.
constexpr double ratio = 4;

/// The angle between two forces.
double angle_between(Vec2 a, Vec2 b) { return std::atan2(std::abs(cross(a, b)), dot(a, b)); }

/// Of the force at a point of a valley; the valley's where that is weak or aside.
Vec2 direction_of(Evaluator& evaluator, const ValleyPoint& point, double order) {
  evaluator.place(point.place);
  const Force force = evaluator.force(order);
  const double size = norm(force.force), forward = dot(force.force, point.tangent);
  if (!(std::abs(forward) > std::max(0.5 * size, 1e-3 * force.potential(order))))
    return point.tangent;
  return ((forward > 0 ? 1 : -1) / size) * force.force;
}

}  // namespace

int adaptive_order(Evaluator& evaluator, double angle, int most) {
  // Orders come in ever larger blocks, since most points need but a few.
  constexpr int first_block = 6;
  std::array<Force, most_searched_order + 2> forces;
  int known = 0;
  const auto turn = [&](int n) {
    if (n > known) {
      const int last = std::clamp(known + std::max(first_block, known / 2), n, most + 1);
      const auto begin = static_cast<std::size_t>(known) + 1;
      evaluator.forces(known + 1,
                       std::span(forces).subspan(begin, static_cast<std::size_t>(last - known)));
      known = last;
    }
    const auto i = static_cast<std::size_t>(n);
    return angle_between(forces[i].force, forces[i - 1].force);
  };
  int order = 2;
  while (order < most && (turn(order) > angle || turn(order + 1) > angle)) ++order;
  return order;
}

Vec2 minimum_near(Evaluator& evaluator, const ValleyPoint& minimum,
                  const SuccessorOptions& options) {
  const double order = options.order > 0 ? options.order : options.most_order;
  Vec2 p = minimum.place;
  for (int i = 0; i < 60; ++i) {
    const double radius = evaluator.place(p).distance;
    if (!(radius > 0) || distance(p, minimum.place) > widest_move * minimum.radius) break;
    const Force force = evaluator.force(order);
    const double determinant = force.determinant();
    const double size = norm(force.force);
    Vec2 move = size > 0 ? (1 / size) * force.force : Vec2{};
    double length = 0.02 * radius;
    if (determinant > 0) {
      const Vec2 newton = {
          -radius * (force.yy * force.force.x - force.xy * force.force.y) / determinant,
          -radius * (force.xx * force.force.y - force.xy * force.force.x) / determinant};
      const double whole = norm(newton);
      if (whole <= 1e-6 * radius) return p;
      length = std::min(whole, length);
      move = (1 / whole) * newton;
    }
    p = p + length * move;
  }
  return minimum.place;
}

std::optional<Vec2> valley_across(Evaluator& evaluator, const ValleyPoint& point, double order,
                                  const SuccessorOptions& options) {
  const Vec2 across = left_of(point.tangent);
  Vec2 p = point.place;
  double radius = evaluator.place(p).distance;
  if (!(radius > 0)) return std::nullopt;
  // The sine between force and valley at which it counts as perpendicular (Section 5).
  constexpr double perpendicular = 0.001;
  const auto projection = [&](const Force& force) {
    const double size = norm(force.force);
    return size > 0 ? dot(force.force, across) / size : 0;
  };
  const Force force = evaluator.force(order);
  const double first = projection(force);
  // On the middle line of a corridor the force is lost in the arithmetic.
  const bool lost = norm(force.force) <= 100 * Evaluator::far_field * force.potential(order);
  if (lost || std::abs(first) <= perpendicular) return p;
  const double way = first > 0 ? 1 : -1;
  // On until the force turns around.
  double before = 0, here = 0, f_before = std::abs(first);
  const double furthest = std::min(widest_move * radius, options.furthest);
  while (before < furthest) {
    here = std::min(before + std::min(options.step, 0.5 * radius), furthest);
    p = point.place + way * here * across;
    radius = evaluator.place(p).distance;
    if (!(radius > 0)) return std::nullopt;
    double f = way * projection(evaluator.force(order));
    if (f > perpendicular) {
      before = here;
      f_before = f;
      continue;
    }
    if (f >= -perpendicular) return p;
    // Between here and before: false position, kept honest by halving.
    double a = before, b = here, fa = f_before;
    for (int k = 0; k < 60 && b - a > options.accuracy; ++k) {
      double m = 0.5 * (a + b);
      if (k % 3 != 2)
        m = std::clamp(a + (b - a) * fa / (fa - f), a + 0.02 * (b - a), b - 0.02 * (b - a));
      p = point.place + way * m * across;
      radius = evaluator.place(p).distance;
      if (!(radius > 0)) break;
      const double fm = way * projection(evaluator.force(order));
      if (std::abs(fm) <= perpendicular) return p;
      if (fm > 0) {
        a = m;
        fa = fm;
      } else {
        b = m;
        f = fm;
      }
    }
    return point.place + way * 0.5 * (a + b) * across;
  }
  return std::nullopt;
}

Vec2 successor(Evaluator& evaluator, const ValleyPoint& point, double order,
               const SuccessorOptions& options) {
  return valley_across(evaluator, point, order, options).value_or(point.place);
}

Successor generalized_successor(Evaluator& evaluator, const ValleyPoint& point,
                                const SuccessorOptions& options) {
  Successor result{point.place, point.radius, 1};
  if (is_fixed(point)) return result;
  ValleyPoint here = point;
  if (options.order > 0) {
    result.order = options.order;
    result.place = successor(evaluator, here, options.order, options);
  } else {
    // The valley's own order says nothing of what a higher one would change.
    double order = ratio * options.least_order;
    if (order < searched_below) {
      evaluator.place(here.place);
      order =
          std::max<double>(order, adaptive_order(evaluator, options.angle, most_searched_order));
    }
    order = std::min(order, options.most_order);
    for (;;) {
      result.place = successor(evaluator, here, order, options);
      result.order = order;
      const bool still = distance(result.place, here.place) <= options.movement;
      here.place = result.place;
      if (order >= options.most_order || still) break;
      here.tangent = direction_of(evaluator, here, order);
      order = std::min(ratio * order, options.most_order);
    }
  }
  result.radius = evaluator.place(result.place).distance;
  return result;
}

}  // namespace medial::potential
