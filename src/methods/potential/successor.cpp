#include "methods/potential/successor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace medial::potential {
namespace {

/// From this order on, valleys are sharp enough to go to a much higher order at once.
constexpr double searched_below = 24;
/// Between successive orders of one point.
constexpr double ratio = 4;

/// The angle between two forces.
double angle_between(Vec2 a, Vec2 b) { return std::atan2(std::abs(cross(a, b)), dot(a, b)); }

/// The direction of the force at a point of a valley; that of the valley if the force is weak or
/// aside.
Vec2 direction_of(Evaluator& evaluator, const ValleyPoint& point, double order) {
  evaluator.place(point.place);
  const Force force = evaluator.force(order);
  const double size = norm(force.force), forward = dot(force.force, point.tangent);
  if (!(std::abs(forward) > std::max(0.5 * size, 1e-3 * force.potential(order))))
    return point.tangent;
  return ((forward > 0 ? 1 : -1) / size) * force.force;
}

/// The line across a valley at a point of it.
class Section {
 public:
  struct Look {
    double place = 0;   ///< from the point, to the left of the valley
    double radius = 0;  ///< distance to the border
    double aside = 0;   ///< the sine from the valley to the force; decreases across a valley
    double slope = 0;   ///< derivative of that sine
    double way = 0;     ///< the estimated way to its zero
    bool lost = false;  ///< the force is lost in rounding: on the middle line of a corridor
  };

  Section(Evaluator& evaluator, const ValleyPoint& point, double order)
      : evaluator_(evaluator),
        start_(point.place),
        across_(left_of(point.tangent)),
        order_(order) {}

  Vec2 at(double place) const { return start_ + place * across_; }

  Look look(double place) {
    Look result{place, evaluator_.place(at(place)).distance};
    if (!(result.radius > 0)) return result;
    const Force force = evaluator_.force(order_);
    const double size = norm(force.force);
    result.lost = !(size > 100 * Evaluator::far_field * force.potential(order_));
    if (!(size > 0)) return result;
    const Vec2 unit = (1 / size) * force.force;
    const Vec2 change = (1 / (result.radius * size)) * force.derivative(across_);
    result.aside = dot(unit, across_);
    result.slope = dot(change, across_) - result.aside * dot(change, unit);
    result.way = way_to_valley(result);
    return result;
  }

 private:
  /// Between two equal walls, at a way x from the valley, the tangent of the force is t tanh(k x)
  /// with k = n t / (r sqrt(1 + t^2)). Its value and derivative here give t, and so x. Near the
  /// valley this is Newton's step, which is never shorter; where only one wall matters, it still
  /// leads to the valley.
  double way_to_valley(const Look& look) const {
    const double square = 1 - look.aside * look.aside, far = 2 * look.radius;
    if (!(look.slope < 0 && square > 0)) return std::copysign(far, look.aside);
    const double tangent = look.aside / std::sqrt(square);
    const double rest = -look.slope * look.radius / (order_ * square * square);
    const double t = std::sqrt(tangent * tangent + rest), size = t + std::abs(tangent);
    const double rate = order_ * t / (look.radius * std::sqrt(1 + t * t));
    const double way = 0.5 * std::log(size * size / rest) / rate;
    return std::copysign(std::min({way, std::abs(look.aside / look.slope), far}), look.aside);
  }

  Evaluator& evaluator_;
  const Vec2 start_, across_;
  const double order_;
};

}  // namespace

int adaptive_order(Evaluator& evaluator, double angle, int most) {
  // Orders are computed in growing blocks, since most points need only a few.
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
                                  const SuccessorOptions& options, double guess) {
  const double radius = evaluator.place(point.place).distance;
  if (!(radius > 0)) return std::nullopt;
  // The sine between force and valley at which it counts as perpendicular (Section 5).
  constexpr double perpendicular = 0.001;
  constexpr int most_looks = 60;
  const double furthest = std::min(widest_move * radius, options.furthest);
  Section section(evaluator, point, order);
  // Bounds of the valley: the force leads to the left at one, to the right at the other.
  std::optional<Section::Look> right, left;
  double wide = std::numeric_limits<double>::infinity();  // width at the last halving
  int halved = 0;
  double place = std::clamp(guess, -furthest, furthest);
  for (int i = 0; i < most_looks; ++i) {
    const Section::Look here = section.look(place);
    if (!(here.radius > 0)) return std::nullopt;
    if (i == 0 && here.lost) return point.place;
    // On a ridge the sine increases.
    if (std::abs(here.aside) <= perpendicular && !(here.slope > 0)) return section.at(place);
    (here.aside > 0 ? right : left) = here;
    // Across a valley the sine behaves like a hyperbolic tangent, so Newton's step is no shorter
    // than the way.
    if (here.slope < 0 && std::abs(here.aside) <= -0.5 * options.accuracy * here.slope)
      return section.at(place + here.way);
    if (right && left) {
      const double width = left->place - right->place;
      const double share = right->aside / (right->aside - left->aside);
      if (width <= options.accuracy) return section.at(right->place + share * width);
      // False position if that is outside; halving guarantees progress.
      double next = (place + here.way - right->place) / width;
      if (!(next > 0 && next < 1)) next = share;
      if (width <= 0.5 * wide) {
        wide = width;
        halved = i;
      } else if (i - halved > 2) {
        next = 0.5;
      }
      place = right->place + std::clamp(next, 0.02, 0.98) * width;
    } else {
      if (std::abs(place) >= furthest && (place > 0) == (here.aside > 0)) return std::nullopt;
      const double longest = std::min(options.step, 0.5 * here.radius);
      place = std::clamp(place + std::clamp(here.way, -longest, longest), -furthest, furthest);
    }
  }
  return std::nullopt;
}

Vec2 successor(Evaluator& evaluator, const ValleyPoint& point, double order,
               const SuccessorOptions& options, double guess) {
  return valley_across(evaluator, point, order, options, guess).value_or(point.place);
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
    // The valley's own order does not show how a higher order would move the point.
    double order = ratio * options.least_order;
    if (order < searched_below) {
      evaluator.place(here.place);
      order =
          std::max<double>(order, adaptive_order(evaluator, options.angle, most_searched_order));
    }
    order = std::min(order, options.most_order);
    Vec2 move;
    for (;;) {
      // Ways decrease as 1 / n.
      const double guess = dot(move, left_of(here.tangent)) / ratio;
      result.place = successor(evaluator, here, order, options, guess);
      result.order = order;
      move = result.place - here.place;
      const bool still = norm(move) <= options.movement;
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
