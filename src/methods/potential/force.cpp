#include "methods/potential/force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/box_tree.h"
#include "base/wide.h"

namespace medial::potential {
namespace {

/// Adds the force of one piece and its derivatives, from its integral J and r^-order at its ends.
void add_piece(double order, Vec2 t, double x1, double x2, double y, double integral, double p1,
               double p2, Force& sum) {
  const double s1 = p1 / (x1 * x1 + y * y), s2 = p2 / (x2 * x2 + y * y);
  const double along = (p2 - p1) / order, across = y * integral;
  const double a = x2 * s2 - x1 * s1, b = -y * (s2 - s1), c = -order * integral - a;
  // (a, b; b, c) rotated into the frame of the plane.
  const double xx = t.x * t.x, xy = t.x * t.y, yy = t.y * t.y;
  sum.force = sum.force + along * t + across * left_of(t);
  sum.xx += a * xx - 2 * b * xy + c * yy;
  sum.yy += a * yy + 2 * b * xy + c * xx;
  sum.xy += (a - c) * xy + b * (xx - yy);
}

/// atan(v) / v by powers of v^2, for v up to tan(pi / 8): off by less than 4e-17 (Chebyshev's
/// nodes).
constexpr std::array<double, 11> arctangent = {1.0,
                                               -0.3333333333332844,
                                               0.1999999999885511,
                                               -0.14285714180976467,
                                               0.11111106180455946,
                                               -0.09090773074808414,
                                               0.07689953496306857,
                                               -0.06640233930429408,
                                               0.056883492268090106,
                                               -0.04348052215716462,
                                               0.021135373157693246};

using Lanes = std::array<double, Charges::leaf_size>;

/// Forces of many pieces, summed in lanes.
struct LaneForces {
  alignas(32) Lanes x{}, y{}, xx{}, xy{}, yy{};

  void add_to(Force& total) const {
    Force add;
    for (std::size_t k = 0; k < Charges::leaf_size; ++k) {
      add.force = add.force + Vec2{x[k], y[k]};
      add.xx += xx[k];
      add.xy += xy[k];
      add.yy += yy[k];
    }
    total.force = total.force + add.force;
    total.xx += add.xx;
    total.xy += add.xy;
    total.yy += add.yy;
  }
};

/// Raises numbers to half of this power; integer powers by repeated squaring.
MEDIAL_WIDE void raise(Lanes& lanes, std::size_t count, double power) {
  const auto whole = static_cast<unsigned>(power);
  if (whole != power) {
    for (std::size_t k = 0; k < count; ++k) lanes[k] = std::pow(lanes[k], 0.5 * power);
    return;
  }
  Lanes square = lanes;
  for (std::size_t k = 0; k < count; ++k) lanes[k] = whole % 2 == 1 ? std::sqrt(lanes[k]) : 1;
  for (unsigned rest = whole / 2; rest > 0; rest /= 2) {
    if (rest % 2 == 1)
      for (std::size_t k = 0; k < count; ++k) lanes[k] *= square[k];
    if (rest > 1)
      for (std::size_t k = 0; k < count; ++k) square[k] *= square[k];
  }
}

double half_power(double x, double power) {
  Lanes lanes{x};
  raise(lanes, 1, power);
  return lanes[0];
}

/// Some pieces in lanes, with r^-n and r^-2 at both ends and J(n) of each, for an order n that
/// increases by two.
struct Block {
  /// Loads the ends of the pieces relative to a place, in units of the nearest charge's distance.
  MEDIAL_WIDE void load(const Charges& charges, std::uint32_t begin, std::uint32_t end, Vec2 place,
                        double inverse) {
    count = end - begin;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = begin + k;
      tx[k] = charges.tangent_x[i];
      ty[k] = charges.tangent_y[i];
      const double dx = place.x - charges.start_x[i], dy = place.y - charges.start_y[i];
      x1[k] = -(dx * tx[k] + dy * ty[k]) * inverse;
      x2[k] = x1[k] + charges.lengths[i] * inverse;
      y[k] = (dy * tx[k] - dx * ty[k]) * inverse;
    }
  }

  /// The squared distances to the nearest points of the pieces.
  MEDIAL_WIDE void squared_distances(Lanes& squares) const {
    for (std::size_t k = 0; k < count; ++k) {
      const double beyond = std::max(std::max(x1[k], -x2[k]), 0.0);
      squares[k] = beyond * beyond + y[k] * y[k];
    }
  }

  /// Starts at order 1, with (6) without cancellation.
  MEDIAL_WIDE void start_at_one() {
    for (std::size_t k = 0; k < count; ++k) {
      const double length = x2[k] - x1[k], square = y[k] * y[k];
      const double r1 = std::sqrt(x1[k] * x1[k] + square);
      const double r2 = std::sqrt(x2[k] * x2[k] + square);
      const double size1 = std::abs(x1[k]) + r1, size2 = std::abs(x2[k]) + r2;
      const double before = x1[k] < 0 ? square / size1 : size1;
      const double behind = x2[k] > 0 ? square / size2 : size2;
      const double excess = before + behind;
      p1[k] = 1 / r1;
      p2[k] = 1 / r2;
      j[k] = 2 * length * (p1[k] + p2[k]) / (excess * (excess + 2 * length));
      q1[k] = p1[k] * p1[k];
      q2[k] = p2[k] * p2[k];
      inverse_square[k] = 1 / std::max(square, 1e-300);
    }
  }

  /// Starts at order 0, with the angle that each piece subtends: four times the angle with the
  /// tangent v, or two right angles less that.
  MEDIAL_WIDE void start_at_zero() {
    for (std::size_t k = 0; k < count; ++k) {
      const double square = y[k] * y[k];
      const double square1 = x1[k] * x1[k] + square, square2 = x2[k] * x2[k] + square;
      const double size = std::abs(y[k]), scalar = square + x1[k] * x2[k];
      // area / whole is the tangent of half the angle; that of a quarter needs no further division.
      const double area = (x2[k] - x1[k]) * size, product = square1 * square2;
      const double root = std::sqrt(product), whole = root + std::abs(scalar);
      const double v = area / (whole + std::sqrt(2 * root * whole)), z = v * v;
      double sum = arctangent.back();
      for (std::size_t i = arctangent.size() - 1; i-- > 0;) sum = sum * z + arctangent[i];
      const double angle = 4 * v * sum, other = std::numbers::pi - angle;
      const double bounded = std::max(size, 1e-150), shared = 1 / (product * bounded);
      const double inverse = shared * product, both = shared * bounded;
      j[k] = (scalar >= 0 ? angle : other) * inverse;
      p1[k] = p2[k] = 1;
      q1[k] = both * square2;
      q2[k] = both * square1;
      inverse_square[k] = inverse * inverse;
    }
  }

  /// Starts with r^-n, without J.
  MEDIAL_WIDE void start_at_powers(double n) {
    // No piece is further away, so no power is below the normal range.
    const double least = std::pow(1e-60, 1 / n);
    for (std::size_t k = 0; k < count; ++k) {
      const double square = y[k] * y[k];
      q1[k] = 1 / (x1[k] * x1[k] + square);
      q2[k] = 1 / (x2[k] * x2[k] + square);
      p1[k] = std::max(q1[k], least);
      p2[k] = std::max(q2[k], least);
    }
    raise(p1, count, n);
    raise(p2, count, n);
  }

  /// Computes J(n) of the pieces that are steeply aside; -1 for others.
  MEDIAL_WIDE void integrate_steep(const SteepTail& tail, Lanes& integrals) const {
    const double widest = tail.widest();
    for (std::size_t k = 0; k < count; ++k) {
      const double far1 = std::max(std::abs(x1[k]), 1e-100),
                   far2 = std::max(std::abs(x2[k]), 1e-100);
      const double w1 = y[k] * y[k] / (far1 * far1), w2 = y[k] * y[k] / (far2 * far2);
      const double first = tail(far1, std::min(w1, widest), p1[k]);
      const double last = tail(far2, std::min(w2, widest), p2[k]);
      const bool steep = (x1[k] > 0) == (x2[k] > 0) && std::max(w1, w2) <= widest;
      integrals[k] = steep ? std::abs(first - last) : -1;
    }
  }

  /// Starts at the order of `series`.
  void start_at(const LowOrder& series) {
    for (std::size_t k = 0; k < count; ++k) {
      const double square = y[k] * y[k];
      q1[k] = 1 / (x1[k] * x1[k] + square);
      q2[k] = 1 / (x2[k] * x2[k] + square);
      p1[k] = std::pow(q1[k], 0.5 * series.order());
      p2[k] = std::pow(q2[k], 0.5 * series.order());
      inverse_square[k] = 1 / std::max(square, 1e-300);
    }
    const auto of = [&](Lanes& lane) { return std::span<double>(lane).first(count); };
    series.integrals(of(x1), of(x2), of(y), of(p1), of(p2), of(j));
  }

  /// Adds (5) of order n and its derivatives, for all pieces.
  MEDIAL_WIDE void add_force(double n, LaneForces& total) const {
    const double inverse_n = 1 / n;
    for (std::size_t k = 0; k < count; ++k) {
      const double along = (p2[k] - p1[k]) * inverse_n, across = y[k] * j[k];
      total.x[k] += tx[k] * along - ty[k] * across;
      total.y[k] += ty[k] * along + tx[k] * across;
      const double s1 = p1[k] * q1[k], s2 = p2[k] * q2[k];
      const double a = x2[k] * s2 - x1[k] * s1;
      const double b = -y[k] * (s2 - s1);
      const double c = -n * j[k] - a;
      // (a, b; b, c) rotated into the frame of the plane.
      const double xx = tx[k] * tx[k], xy = tx[k] * ty[k], yy = ty[k] * ty[k];
      total.xx[k] += a * xx - 2 * b * xy + c * yy;
      total.yy[k] += a * yy + 2 * b * xy + c * xx;
      total.xy[k] += (a - c) * xy + b * (xx - yy);
    }
  }

  void start_from(double n, const LowOrder* series) {
    if (n == 0) {
      start_at_zero();
    } else if (n == 1) {
      start_at_one();
    } else {
      start_at(*series);
    }
  }

  /// (9): from order n to n + 2.
  MEDIAL_WIDE void rise_from(double n) {
    const double inverse_next = 1 / (n + 2);
    for (std::size_t k = 0; k < count; ++k) {
      p1[k] *= q1[k];
      p2[k] *= q2[k];
      j[k] = inverse_square[k] * (x2[k] * p2[k] - x1[k] * p1[k] + (n + 1) * j[k]) * inverse_next;
    }
  }

  /// (9), from order `start` on.
  void climb(double start, double order, const LowOrder* series) {
    const Lanes powers1 = p1, powers2 = p2;
    start_from(start, series);
    for (double n = start; n + 2 < order + 0.5; n += 2) rise_from(n);
    p1 = powers1;
    p2 = powers2;
  }

  std::size_t count = 0;
  alignas(32) Lanes x1, x2, y, tx, ty, j, p1, p2, q1, q2, inverse_square;
};

/// Four numbers in lanes (GCC and clang), also if the processor has narrower vectors.
using Four = double __attribute__((vector_size(32)));
constexpr std::size_t four = 4;

double sum_of(const Four& v) { return v[0] + v[1] + (v[2] + v[3]); }

/// x^n, for integer n by repeated squaring, which takes a fraction of the time of std::pow.
double power_of(double x, double n) {
  auto rest = static_cast<unsigned>(n);
  if (rest != n) return std::pow(x, n);
  double result = 1;
  for (; rest > 0; rest /= 2, x *= x)
    if (rest % 2 == 1) result *= x;
  return result;
}

/// Four complex numbers.
struct FourComplex {
  Four x, y;

  FourComplex conjugate() const { return {x, -y}; }
  friend FourComplex operator+(const FourComplex& a, const FourComplex& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend FourComplex operator*(const FourComplex& a, const FourComplex& b) {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
  }
  friend FourComplex operator*(const Four& a, const FourComplex& b) { return {a * b.x, a * b.y}; }
  friend FourComplex operator*(double a, const FourComplex& b) { return {a * b.x, a * b.y}; }
};

/// Sets of distant charges in lanes, by their moments up to one degree. Empty lanes have no
/// moments.
struct FarSets {
  void load(std::size_t i, const Charges& charges, std::uint32_t node, Vec2 place, double inverse) {
    moments[i] = &charges.moments[node];
    const Vec2 way = place - charges.nodes[node].center, z = inverse * way;
    const double square = squared_norm(way);
    to_place.x[i] = z.x;
    to_place.y[i] = z.y;
    inverse_way.x[i] = way.x / square;
    inverse_way.y[i] = -way.y / square;
    inverse_square[i] = 1 / square;
    scaled_square[i] = squared_norm(z);
    unit = inverse;
  }
  FourComplex moment(std::size_t l, std::size_t k) const {
    const Vec2 a = (*moments[0])(l, k), b = (*moments[1])(l, k), c = (*moments[2])(l, k),
               d = (*moments[3])(l, k);
    return {Four{a.x, b.x, c.x, d.x}, Four{a.y, b.y, c.y, d.y}};
  }

  /// With z from the charges' centre, h half of the order and c_j the coefficients of (1 - x)^-h,
  /// the force as a complex number is the sum of (1 + k / h) c_j c_k M_jk z^(-h - j) conj(z)^(-h -
  /// 1 - k). Its derivative by z is half the trace of its derivatives by the coordinates.
  MEDIAL_WIDE void add_force(double h, const std::array<double, Moments::degree + 1>& c,
                             Force& total) const {
    FourComplex force{}, derivative{}, power{};
    power.x += 1.0;
    Four trace{};
    for (std::size_t l = 0; l <= degree; ++l) {
      FourComplex sum{}, first{}, second{};
      Four scale{};
      scale += 1.0;
      for (std::size_t k = 0; l + 2 * k <= degree; ++k) {
        const auto i = static_cast<double>(k);
        const FourComplex term = (c[k] * c[l + k] * scale) * moment(l, k);
        sum = sum + term;
        first = first + i * term;
        second = second + (i * i) * term;
        scale = scale * inverse_square;
      }
      sum = power * sum;
      first = power * first;
      second = power * second;
      power = power * inverse_way;
      const double g = h + static_cast<double>(l), twice = l == 0 ? 1 : 2;
      force = force + h * sum + first;
      derivative = derivative + (h * (h + 1)) * sum + (2 * h + 1) * first + second;
      trace = trace + twice * ((h * g) * sum.x + (h + g) * first.x + second.x);
      if (l == 0) continue;
      // With j and k exchanged.
      force = force + (g * sum + first).conjugate();
      derivative = derivative + ((g * (g + 1)) * sum + (2 * g + 1) * first + second).conjugate();
    }
    Four factor{}, turning{};
    for (std::size_t i = 0; i < four; ++i) {
      factor[i] = unit * power_of(1 / std::sqrt(scaled_square[i]), 2 * h + 2) / h;
      turning[i] = factor[i] / scaled_square[i];
    }
    force = factor * to_place * force;
    derivative = turning * to_place * to_place * derivative;
    const double half_trace = sum_of(factor * trace), turned = sum_of(derivative.x);
    total.force = total.force + Vec2{sum_of(force.x), sum_of(force.y)};
    total.xx -= half_trace + turned;
    total.xy -= sum_of(derivative.y);
    total.yy -= half_trace - turned;
  }

  FourComplex to_place{}, inverse_way{};  ///< in units of the nearest charge's distance
  Four inverse_square{};
  Four scaled_square = Four{} + 1.0;
  double unit = 1;
  std::size_t degree = 0;
  std::array<const Moments*, four> moments{&nothing, &nothing, &nothing, &nothing};
  static const Moments nothing;
};
const Moments FarSets::nothing;

/// Up to this order the recurrence is short, and distant charges contribute much.
constexpr double least_alone = 12;

}  // namespace

Charges::Nearest Evaluator::place(Vec2 p) {
  place_ = p;
  const Charges::Nearest nearest = charges_.nearest(p);
  inverse_ = 1 / nearest.distance;
  return nearest;
}

void Evaluator::gather(double low, double high) {
  near_.clear();
  for (auto& sets : far_) sets.clear();
  work_ += cost_of_force;
  // The error allowed per unit of charge, and the distance beyond which charges add less than that
  // for any of the orders.
  const double share = error_ / (charges_.length() * inverse_);
  const double reach = std::pow(share, -1 / (low + 1));
  // The remainder of Taylor's expansion to the degree p, of 1 / (1 - x)^(n + 1), is at most
  // (n + p + 1 over p + 1) x^(p + 1) / (1 - x)^(n + p + 2).
  std::array<double, Moments::degree + 1> binomial{high + 1};
  for (std::size_t p = 1; p <= Moments::degree; ++p) {
    const auto next = static_cast<double>(p + 1);
    binomial[p] = binomial[p - 1] * (high + next) / next;
  }
  const auto add_set = [&](std::uint32_t index, double ratio, double gap) {
    const double first = power_of(1 / gap, low + 1) * ratio;
    // The bound may first rise with the degree, and then falls.
    const double last = binomial.back() * power_of(ratio, Moments::degree);
    if (!(first * std::min(binomial[0], last) < share)) return false;
    std::size_t p = 0;
    for (double remainder = first; p < Moments::degree && !(binomial[p] * remainder < share); ++p)
      remainder *= ratio;
    far_[p].push_back(index);
    work_ += cost_of_set;
    return true;
  };
  std::array<std::uint32_t, 64> stack{};
  std::size_t depth = 1;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Charges::Node& node = charges_.nodes[index];
    const double distance = medial::distance(place_, node.center) * inverse_;
    const double radius = node.radius * inverse_;
    // No charge of the node is nearer than this.
    const double gap = distance - radius;
    if (gap > 1) {
      if (gap > reach) continue;
      if (radius < gap && add_set(index, radius / gap, gap)) continue;
    }
    if (node.right != 0) {
      stack[depth++] = node.right;
      stack[depth++] = index + 1;
    } else if (squared_distance(node.box, place_) * inverse_ * inverse_ <= reach * reach) {
      near_.push_back({node.begin, node.end});
      work_ += node.end - node.begin;
    }
  }
}

void Evaluator::add_far(double order, Force& total) const {
  // The binomial coefficients of (1 - x)^-h.
  const double h = 0.5 * order;
  std::array<double, Moments::degree + 1> c{1};
  for (std::size_t j = 1; j <= Moments::degree; ++j) {
    const auto i = static_cast<double>(j);
    c[j] = c[j - 1] * (h + i - 1) / i;
  }
  FarSets sets;
  std::size_t count = 0;
  const auto add = [&] {
    sets.add_force(h, c, total);
    sets = {};
    count = 0;
  };
  for (std::size_t degree = far_.size(); degree-- > 0;)
    for (const std::uint32_t node : far_[degree]) {
      sets.degree = std::max(sets.degree, degree);
      sets.load(count++, charges_, node, place_, inverse_);
      if (count == four) add();
    }
  if (count > 0) add();
}

void Evaluator::sum(double start, double low, std::span<Force> forces) {
  if (start != 0 && start != 1 && !(start_ && start_->order() == start)) start_.emplace(start);
  const double high = low + static_cast<double>(forces.size()) - 1;
  // Upward, the recurrence multiplies errors by 1 / |y| per order: a total of 1e7 is acceptable.
  const double flat = start == 1 && high < 3 ? 0 : std::pow(1e-7, 1 / high);
  Block block;
  std::vector<LaneForces> lanes(forces.size());
  for (const Range& range : near_) {
    block.load(charges_, range.begin, range.end, place_, inverse_);
    for (std::size_t k = 0; flat > 0 && k < block.count; ++k) {
      if (std::abs(block.y[k]) >= flat) continue;
      if (block.x1[k] < 0 && block.x2[k] > 0) continue;  // as close as the nearest charge: |y| >= 1
      sum_steep(static_cast<std::uint32_t>(range.begin + k), start, low, forces);
      block.x1[k] = block.x2[k] = block.y[k] = 1;  // contributes nothing
    }
    block.start_from(start, start_ ? &*start_ : nullptr);
    for (double n = start;; n += 2) {
      if (n > low - 0.5 && n > 0)
        block.add_force(n, lanes[static_cast<std::size_t>(std::lround(n - low))]);
      if (n + 2 > high + 0.5) break;
      block.rise_from(n);
    }
  }
  for (std::size_t i = 0; i < forces.size(); ++i) lanes[i].add_to(forces[i]);
}

void Evaluator::sum_steep(std::uint32_t piece, double start, double low,
                          std::span<Force> forces) const {
  const double high = low + static_cast<double>(forces.size()) - 1;
  const Vec2 t = charges_.tangent(piece), d = place_ - charges_.start(piece);
  const double first = -dot(d, t) * inverse_;
  const double last = first + charges_.lengths[piece] * inverse_;
  const double y = cross(t, d) * inverse_, square = y * y;
  const bool ahead = first >= 0;
  const double x1 = ahead ? first : -last, x2 = ahead ? last : -first;
  const double square1 = x1 * x1 + square, square2 = x2 * x2 + square;
  double n = start;
  while (n + 2 < high + 0.5) n += 2;
  double p1 = half_power(1 / square1, n), p2 = half_power(1 / square2, n);
  const SteepTail tail(n);
  double j = tail(x1, square / (x1 * x1), p1) - tail(x2, square / (x2 * x2), p2);
  // Mirrored if the piece is behind.
  const Vec2 forward = ahead ? t : -t;
  for (;;) {
    if (n > 0)
      add_piece(n, forward, x1, x2, ahead ? y : -y, j, p1, p2,
                forces[static_cast<std::size_t>(std::lround(n - low))]);
    if (n - 2 < low - 0.5) return;
    // Downward, the recurrence is stable.
    p1 *= square1;
    p2 *= square2;
    n -= 2;
    j = ((n + 2) * square * j + x1 * p1 / square1 - x2 * p2 / square2) / (n + 1);
  }
}

void Evaluator::sum_one(double order, Force& total) {
  if (!(tail_ && tail_->order() == order)) {
    tail_.emplace(order);
    if (order >= HighOrder::least_order) high_.emplace(order);
  }
  const bool is_high = order >= HighOrder::least_order;
  const double start = std::fmod(order, 2);
  if (!is_high && start != 0 && start != 1 && !(start_ && start_->order() == start))
    start_.emplace(start);
  // Charges further away than the square root of this add less than the far field's error.
  const double nothing = std::pow(charges_.length() * inverse_ / error_, 2 / (order + 1));
  Block block;
  LaneForces lanes;
  Lanes squares, steep;
  for (const Range& range : near_) {
    block.load(charges_, range.begin, range.end, place_, inverse_);
    block.squared_distances(squares);
    const auto end = squares.begin() + static_cast<std::ptrdiff_t>(block.count);
    if (*std::min_element(squares.begin(), end) > nothing) continue;
    block.start_at_powers(order);
    block.integrate_steep(*tail_, steep);
    bool recurrence = false;
    for (std::size_t k = 0; k < block.count; ++k) {
      if (squares[k] > nothing) {
        steep[k] = block.p1[k] = block.p2[k] = 0;
      } else if (steep[k] < 0 && is_high) {
        steep[k] = high_->integral(block.x1[k], block.x2[k], block.y[k], block.p1[k], block.p2[k]);
      }
      recurrence = recurrence || steep[k] < 0;
    }
    if (recurrence) block.climb(start, order, start_ ? &*start_ : nullptr);
    for (std::size_t k = 0; k < block.count; ++k)
      if (steep[k] >= 0) block.j[k] = steep[k];
    block.add_force(order, lanes);
  }
  lanes.add_to(total);
}

Force Evaluator::force(double order) {
  Force result;
  gather(order, order);
  if (order >= least_alone) {
    sum_one(order, result);
  } else {
    sum(std::fmod(order, 2), order, std::span(&result, 1));
  }
  add_far(order, result);
  return result;
}

Force Evaluator::direction(double order) {
  if (order >= least_alone) return force(order);
  error_ = rough_field;
  Force rough = force(order);
  const double least = norm(rough.force) - rough_field;  // a lower bound, whatever the error
  if (rough_share * least < rough_field) {
    error_ = std::max(rough_share * least, far_field);
    rough = force(order);
  }
  error_ = far_field;
  return rough;
}

void Evaluator::forces(int first, std::span<Force> forces) {
  const int last = first + static_cast<int>(forces.size()) - 1;
  std::fill(forces.begin(), forces.end(), Force{});
  gather(first, last);
  sum(1, first, forces);
  if (last > 1) sum(0, first, forces);
  for (int order = first; order <= last; ++order)
    add_far(order, forces[static_cast<std::size_t>(order - first)]);
}

Evaluator::Field Evaluator::field(double order) {
  if (order <= 2) return {force(order), low_log_potential(order)};
  // The potential follows from the derivatives of the force of two orders less.
  Field result;
  Force lower;
  if (order < HighOrder::least_order) {
    std::array<Force, 3> both;
    gather(order - 2, order);
    sum(std::fmod(order, 2), order - 2, both);
    result.force = both[2];
    lower = both[0];
    add_far(order, result.force);
    add_far(order - 2, lower);
  } else {
    lower = force(order - 2);
    result.force = force(order);
  }
  result.log_potential = std::log(lower.potential(order - 2)) - (1 - order) * std::log(inverse_);
  return result;
}

double Evaluator::low_log_potential(double order) const {
  double total = 0;
  for (std::size_t i = 0; i < charges_.size(); ++i) {
    const Vec2 t = charges_.tangent(i), d = place_ - charges_.start(i);
    const double x1 = -dot(d, t) * inverse_, x2 = x1 + charges_.lengths[i] * inverse_;
    const double y = cross(t, d) * inverse_;
    if (order == 1) {
      total += first_potential(x1, x2, y);
    } else if (order == 2) {
      total += segment_integral(0, x1, x2, y);
    } else {
      // (9) gives (n - 1) J(n - 2) from the next order.
      const double r1 = std::hypot(x1, y), r2 = std::hypot(x2, y);
      total += (order * y * y * segment_integral(order, x1, x2, y) - x2 * std::pow(r2, -order) +
                x1 * std::pow(r1, -order)) /
               (order - 1);
    }
  }
  return std::log(total) - (1 - order) * std::log(inverse_);
}

}  // namespace medial::potential
