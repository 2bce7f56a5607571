#include "methods/curve_axis/generate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace medial::curve_axis {
namespace {

constexpr int most_rounds = 30;
/// Corrections below this share of the boundary's size are rounding.
constexpr double converged = 1e-15;
/// Close to a tip, (14) is flat: rounding moves the feet by more. Below this share, an iteration
/// has converged when the corrections no longer shrink.
constexpr double nearly_converged = 1e-8;
/// The largest turn of either foot's normal in a step, so that predictions stay in reach of (14).
constexpr double largest_turn = 0.05;
/// Half of the angle between the normals at the first two feet on both sides of a maximum.
constexpr double first_turn = 0.05;
/// No foot of a first point is closer to its tip than this share of the other foot's way.
constexpr double least_share = 0x1p-40;

/// The least step, as a share of the longest.
constexpr double least_step = 1e-7;
/// Feet are equal if they are closer than this share of the boundary's size.
constexpr double same_place = 1e-9;

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

/// (14) and its derivatives by the ways by which the feet advance. On the zero set these are (1 -
/// cos) (1 - K R), with the angle between the two normals, and in fans (1 - cos) R.
struct Symmetry {
  double value, by_left, by_right;
};
Symmetry symmetry(const BoundaryPoint& l, const BoundaryPoint& r) {
  const Vec2 chord = l.point - r.point;
  const Vec2 sum = r.tangent - l.tangent;  // the left foot moves backward along the boundary
  return {dot(chord, sum), -l.along * dot(l.tangent, sum) + l.turn * dot(chord, l.normal()),
          -r.along * dot(r.tangent, sum) + r.turn * dot(chord, r.normal())};
}

/// Whether two feet coincide, the trivial zero of (14): a disk has one point for each normal. Steps
/// towards that zero end with normals up to some 1e-7 apart; at junctions they are 1e-4 or more
/// apart.
bool are_one(const BoundaryPoint& a, const BoundaryPoint& b) {
  constexpr double same_normal = 1e-5;
  return norm(a.tangent - b.tangent) < same_normal;
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
  const BoundaryPoint tip = boundary_.sharper_at(u);
  const double radius = 1 / tip.turn;
  return {tip, tip, {tip.point + radius * tip.normal(), radius}, tip.normal(), 1};
}

AxisPoint Generator::at(const Tip& tip) const {
  if (tip.kind == Tip::Kind::maximum) return at_maximum(tip.u);
  const BoundaryPoint left = boundary_.before(tip.left), right = boundary_.at(tip.right);
  if (tip.kind != Tip::Kind::corner) return point_of(left, right);
  // The axis bisects the angle; R_a is the sine of its half.
  const Vec2 sum = left.normal() + right.normal();
  return {left, right, {left.point, 0}, (1 / norm(sum)) * sum, norm(sum) / 2};
}

std::optional<AxisPoint> Generator::first_after_corner(double u, double share) const {
  const BoundaryPoint left = boundary_.before(u), right = boundary_.at(u);
  // The way of the feet that moves the centre by a step, on the pieces next to the corner.
  const double sine = norm(right.tangent - left.tangent) / 2;
  double way = share * std::min({step_ * sine, left.speed / 4, right.speed / 4});
  for (int halvings = 0; halvings < 8; ++halvings, way /= 2) {
    const auto point = stabilised(boundary_.advanced(u, -way), boundary_.advanced(u, way));
    if (point && point->left.u < u && point->right.u > u && point->disk.radius > 0) return point;
  }
  return std::nullopt;
}

/// (13) is 0 / 0 in a tip. The foot on the side where the curvature decreases less goes first, by a
/// way that turns the normal by the given angle. The other foot is at the first sign change of (14)
/// from the tip: at about the same way if the curvature decreases alike, at the square of it if the
/// curvature jumps. Further away, where the other side turns back, the normals become parallel.
std::optional<AxisPoint> Generator::first_after(const AxisPoint& tip, double turn_at_most) const {
  if (tip.disk.radius == 0) return first_after_corner(tip.left.u, turn_at_most / first_turn);
  const double u = tip.left.u, peak = tip.left.turn;
  for (double turn = turn_at_most; turn > first_turn / 1024; turn /= 2) {
    const double way = turn / peak;
    const BoundaryPoint left = boundary_.before(boundary_.advanced(u, -way));
    const BoundaryPoint right = boundary_.at(boundary_.advanced(u, way));
    if (!(left.turn < peak && right.turn < peak)) continue;
    const bool right_leads = right.turn > left.turn;
    const auto follower = [&](double share) {
      return boundary_.advanced(u, right_leads ? -share * way : share * way);
    };
    const auto is_positive = [&](double share) {
      return (right_leads ? symmetry(boundary_.before(follower(share)), right)
                          : symmetry(left, boundary_.at(follower(share))))
                 .value > 0;
    };
    const bool at_tip = is_positive(0);
    double low = 0, high = least_share;
    while (high <= 2 && is_positive(high) == at_tip) low = std::exchange(high, 2 * high);
    if (high > 2) continue;
    while (high - low > 1e-3 * high) {
      const double share = (low + high) / 2;
      (is_positive(share) == at_tip ? low : high) = share;
    }
    const auto point =
        right_leads ? with_right(follower(high), right.u) : with_left(left.u, follower(high));
    // (10): if the curvature increases again within the way, the branch is shorter than that.
    if (!point || !(point->disk.radius > 0) || !(point->left.slack(point->disk.radius) > 0) ||
        !(point->right.slack(point->disk.radius) > 0))
      continue;
    const double found = std::abs((right_leads ? point->left.u : point->right.u) - u);
    if (point->left.u < u && point->right.u > u && found > std::abs(follower(high / 4) - u) &&
        found < std::abs(follower(4 * high) - u))
      return point;
  }
  return std::nullopt;
}

std::optional<AxisPoint> Generator::next(AxisPoint here) const {
  if (here.left.u == here.right.u) return first_after(here, first_turn);
  // A foot next to a jump of the rates is treated as behind it.
  const double no_way = same_place * boundary_.size();
  if (boundary_.way_to_jump(here.left.u, false) < no_way)
    here.left = boundary_.before(std::ceil(here.left.u) - 1);
  if (boundary_.way_to_jump(here.right.u, true) < no_way)
    here.right = boundary_.at(std::floor(here.right.u) + 1);
  const double radius = here.disk.radius;
  const double s = distance(here.left.point, here.right.point) / (2 * radius);
  const double left_slack = here.left.slack(radius), right_slack = here.right.slack(radius);
  if (!(left_slack > 0 && right_slack > 0)) return std::nullopt;
  const double left_rate = s / left_slack, right_rate = s / right_slack;  // (13)
  double step = step_;
  step = std::min(step, largest_turn / (std::abs(here.left.turn) * left_rate));
  step = std::min(step, largest_turn / (std::abs(here.right.turn) * right_rate));
  step = std::min(
      step, 16 * step_ / std::max(here.left.along * left_rate, here.right.along * right_rate));
  // After a jump, the rates differ: the foot that reaches a jump first stops there.
  const double left_jump = boundary_.way_to_jump(here.left.u, false) / left_rate;
  const double right_jump = boundary_.way_to_jump(here.right.u, true) / right_rate;
  // If the rates exceed every step, the feet are before a twist, where (10) ends the branch.
  for (int halvings = 0; halvings < 8; ++halvings, step /= 2) {
    if (!(step > least_step * step_)) return std::nullopt;
    const double jump = std::min(left_jump, right_jump), way = std::min(step, jump);
    const double left = boundary_.advanced(here.left.u, -way * left_rate);
    const double right = boundary_.advanced(here.right.u, way * right_rate);
    const auto point = jump > step              ? stabilised(left, right)
                       : left_jump < right_jump ? with_left(std::ceil(here.left.u) - 1, right)
                                                : with_right(left, std::floor(here.right.u) + 1);
    // Both feet must advance, and the centre must move by about the step.
    if (point && point->left.u < here.left.u && point->right.u > here.right.u &&
        point->disk.radius > 0 && distance(point->disk.center, here.disk.center) < 2 * way &&
        distance(point->disk.center, here.disk.center) > way / 2)
      return point;
  }
  return std::nullopt;
}

std::optional<AxisPoint> Generator::stabilised(double left, double right) const {
  Convergence convergence(boundary_.size());
  for (int round = 0; round < most_rounds; ++round) {
    const BoundaryPoint l = boundary_.before(left), r = boundary_.at(right);
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
  const BoundaryPoint foot = moves_left ? boundary_.at(fixed) : boundary_.before(fixed);
  Convergence convergence(boundary_.size());
  for (int round = 0; round < most_rounds; ++round) {
    const BoundaryPoint other = moves_left ? boundary_.before(moving) : boundary_.at(moving);
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

/// Solves (14) for the three pairs. By the signs of the derivatives, the three equations are
/// independent at a junction.
std::optional<Generator::Junction> Generator::junction(double left, double middle,
                                                       double right) const {
  Convergence convergence(boundary_.size());
  for (int round = 0; round < most_rounds; ++round) {
    const BoundaryPoint a = boundary_.before(left), b = boundary_.at(middle),
                        c = boundary_.at(right);
    // Derivatives by lengths along increasing u: the left foot moves the other way.
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
      if (are_one(a, b) || are_one(b, c)) break;
      // Each of the three pairs gives the disk; use the pair whose feet are furthest apart.
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
