#include "methods/curve_axis/generate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace medial::curve_axis {
namespace {

constexpr int most_rounds = 30;
/// Corrections below this share of the boundary's size are rounding.
constexpr double converged = 1e-15;
/// Close to a tip (14) is flat: rounding moves the feet by more. Corrections below this share that
/// shrink no further have come as near as they can.
constexpr double nearly_converged = 1e-8;
/// A step turns neither foot's normal by more than this: predictions stay within reach of (14).
constexpr double largest_turn = 0.05;
/// Half of the angle between the normals at the first two feet on both sides of a maximum.
constexpr double first_turn = 0.05;

Vec2 right_of(Vec2 v) { return -left_of(v); }

/// Decides by the size of the corrections whether an iteration has converged.
class Convergence {
 public:
  explicit Convergence(double size) : size_(size) {}
  bool reached(double move) {
    const bool stalls = move <= nearly_converged * size_ && 2 * move >= last_;
    last_ = move;
    return move <= converged * size_ || stalls;
  }

 private:
  double size_;
  double last_ = std::numeric_limits<double>::infinity();
};

/// (14) and its derivatives by the lengths of boundary that the feet advance on their sides. On the
/// zero set these are (1 - cos) (1 - K R), with the angle between the two normals.
struct Symmetry {
  double value, by_left, by_right;
};
Symmetry symmetry(const BoundaryPoint& l, const BoundaryPoint& r) {
  const Vec2 chord = l.point - r.point;
  const Vec2 sum = r.tangent - l.tangent;  // the left foot goes against the boundary
  return {dot(chord, sum), -dot(l.tangent, sum) + l.curvature * dot(chord, l.normal()),
          -dot(r.tangent, sum) + r.curvature * dot(chord, r.normal())};
}

}  // namespace

AxisPoint Generator::point_of(const BoundaryPoint& left, const BoundaryPoint& right) const {
  // A = L + R n_l = R + R n_r: where the normals meet.
  const Vec2 chord = left.point - right.point;
  const Vec2 difference = right.normal() - left.normal();
  const double radius = dot(chord, difference) / squared_norm(difference);
  const Vec2 center =
      midpoint(left.point + radius * left.normal(), right.point + radius * right.normal());
  AxisPoint out{left, right, {center, radius}, {}, 0};
  out.tangent = (1 / norm(chord)) * right_of(chord);
  const Vec2 feet = midpoint(left.point, right.point);
  out.radius_rate = dot(center - feet, out.tangent) / radius;
  return out;
}

AxisPoint Generator::at_maximum(double u) const {
  const BoundaryPoint tip = boundary_.at(u);
  const double radius = 1 / tip.curvature;
  return {tip, tip, {tip.point + radius * tip.normal(), radius}, tip.normal(), 1};
}

/// (13) is 0 / 0 in a tip. Where the curvature falls by a l on the left and by b r on the right,
/// the circle tangent at both feet has, to leading order, a x^3 + 3 a x^2 - 3 b x - b = 0 with x =
/// l / r (docs/curve-axis.md): one positive root, 1 where both sides are alike.
std::optional<AxisPoint> Generator::first_after(const AxisPoint& tip, double turn_at_most) const {
  const double u = tip.left.u, peak = tip.left.curvature;
  for (double turn = turn_at_most; turn > first_turn / 1024; turn /= 2) {
    const double way = turn / peak;
    const double a = peak - boundary_.at(boundary_.advanced(u, -way)).curvature;
    const double b = peak - boundary_.at(boundary_.advanced(u, way)).curvature;
    if (!(a > 0 && b > 0)) continue;
    double low = 0, high = 1 + 3 * std::sqrt(b / a);
    while (high - low > 1e-3 * high) {
      const double x = (low + high) / 2;
      (((a * x + 3 * a) * x - 3 * b) * x - b > 0 ? high : low) = x;
    }
    const double left = way * std::min(1.0, low), right = way * std::min(1.0, 1 / low);
    const auto point = with_right(boundary_.advanced(u, -left), boundary_.advanced(u, right));
    if (point && point->left.u < boundary_.advanced(u, -left / 4) &&
        point->left.u > boundary_.advanced(u, -4 * left) && point->disk.radius > 0)
      return point;
  }
  return std::nullopt;
}

std::optional<AxisPoint> Generator::next(const AxisPoint& here) const {
  if (here.left.u == here.right.u) return first_after(here, first_turn);
  const double radius = here.disk.radius;
  const double s = distance(here.left.point, here.right.point) / (2 * radius);
  const double left_slack = 1 - here.left.curvature * radius;
  const double right_slack = 1 - here.right.curvature * radius;
  if (!(left_slack > 0 && right_slack > 0)) return std::nullopt;
  const double left_rate = s / left_slack, right_rate = s / right_slack;  // (13)
  double step = step_;
  step = std::min(step, largest_turn / (std::abs(here.left.curvature) * left_rate));
  step = std::min(step, largest_turn / (std::abs(here.right.curvature) * right_rate));
  step = std::min(step, 16 * step_ / std::max(left_rate, right_rate));
  // Where the rates outgrow every step the feet stand before a twist: (10) ends there.
  for (int halvings = 0; halvings < 8; ++halvings, step /= 2) {
    if (!(step > 1e-7 * step_)) return std::nullopt;
    const auto point = stabilised(boundary_.advanced(here.left.u, -step * left_rate),
                                  boundary_.advanced(here.right.u, step * right_rate));
    // Both feet advance, and the centre moves on about as far as it should.
    if (point && point->left.u < here.left.u && point->right.u > here.right.u &&
        point->disk.radius > 0 && distance(point->disk.center, here.disk.center) < 2 * step &&
        distance(point->disk.center, here.disk.center) > step / 2)
      return point;
  }
  return std::nullopt;
}

std::optional<AxisPoint> Generator::stabilised(double left, double right) const {
  Convergence convergence(boundary_.size());
  for (int round = 0; round < most_rounds; ++round) {
    const BoundaryPoint l = boundary_.at(left), r = boundary_.at(right);
    const Symmetry f = symmetry(l, r);
    const double square = f.by_left * f.by_left + f.by_right * f.by_right;
    if (!(square > 0)) return std::nullopt;
    const double move = -f.value / square;
    const double move_left = move * f.by_left, move_right = move * f.by_right;
    if (convergence.reached(std::max(std::abs(move_left), std::abs(move_right))))
      return point_of(l, r);
    left = boundary_.advanced(left, -move_left);
    right = boundary_.advanced(right, move_right);
    if (!std::isfinite(left) || !std::isfinite(right)) break;
  }
  return std::nullopt;
}

std::optional<AxisPoint> Generator::with_one_foot(double fixed, double moving,
                                                  bool moves_left) const {
  const BoundaryPoint foot = boundary_.at(fixed);
  Convergence convergence(boundary_.size());
  for (int round = 0; round < most_rounds; ++round) {
    const BoundaryPoint other = boundary_.at(moving);
    const BoundaryPoint &l = moves_left ? other : foot, &r = moves_left ? foot : other;
    const Symmetry f = symmetry(l, r);
    const double move = -f.value / (moves_left ? f.by_left : f.by_right);
    if (!(std::abs(move) < boundary_.size())) break;
    if (convergence.reached(std::abs(move))) return point_of(l, r);
    moving = boundary_.advanced(moving, moves_left ? -move : move);
    if (!std::isfinite(moving)) break;
  }
  return std::nullopt;
}

/// (14) for the three pairs. By the signs of the derivatives above the three equations are
/// independent at a junction.
std::optional<Generator::Junction> Generator::junction(double left, double middle,
                                                       double right) const {
  Convergence convergence(boundary_.size());
  for (int round = 0; round < most_rounds; ++round) {
    const BoundaryPoint a = boundary_.at(left), b = boundary_.at(middle), c = boundary_.at(right);
    // Derivatives by lengths along increasing u: a left foot counts the other way.
    const Symmetry ab = symmetry(a, b), bc = symmetry(b, c), ac = symmetry(a, c);
    const double m[3][3] = {{-ab.by_left, ab.by_right, 0},
                            {0, -bc.by_left, bc.by_right},
                            {-ac.by_left, 0, ac.by_right}};
    const double v[3] = {-ab.value, -bc.value, -ac.value};
    const double det = m[0][0] * m[1][1] * m[2][2] + m[0][1] * m[1][2] * m[2][0];
    const double da =
        (v[0] * m[1][1] * m[2][2] - m[0][1] * (v[1] * m[2][2] - m[1][2] * v[2])) / det;
    const double db =
        (m[0][0] * (v[1] * m[2][2] - m[1][2] * v[2]) + v[0] * m[1][2] * m[2][0]) / det;
    const double dc = (v[2] - m[2][0] * da) / m[2][2];
    const double largest = std::max({std::abs(da), std::abs(db), std::abs(dc)});
    if (!(largest < boundary_.size())) break;
    if (convergence.reached(largest)) {
      // The middle one of three radii of one disk: from the pair that is farthest apart.
      const AxisPoint whole = point_of(a, c), first = point_of(a, b), second = point_of(b, c);
      const double ab_apart = distance(a.point, b.point), bc_apart = distance(b.point, c.point);
      const double ac_apart = distance(a.point, c.point);
      const AxisPoint& best = ac_apart >= std::max(ab_apart, bc_apart) ? whole
                              : ab_apart >= bc_apart                   ? first
                                                                       : second;
      return Junction{left, middle, right, best.disk};
    }
    left = boundary_.advanced(left, da);
    middle = boundary_.advanced(middle, db);
    right = boundary_.advanced(right, dc);
  }
  return std::nullopt;
}

}  // namespace medial::curve_axis
