#include "medial/sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "axis/curve.h"
#include "axis/steps.h"
#include "ops/half_edges.h"
#include "ops/power_series.h"

namespace medial {
namespace {

using ops::PowerSeries;

/// The jet of a curve with these derivatives by any parameter.
/// Control points that are `tolerance` off change R_a by about tolerance / speed, R_aa and K_A by
/// tolerance / speed^2; a curve has four of them, each of three numbers.
AxisJet jet_of(const Disk& disk, const Curve::Derivatives& d, double tolerance) {
  AxisJet jet{disk, {0, 0}, 0, 0, 0, 0, 0};
  const double speed = norm(d.first);
  if (!(speed > 0)) return jet;
  jet.tangent = (1 / speed) * d.first;
  jet.radius_rate = d.radius_first / speed;
  jet.radius_bend =
      (d.radius_second - jet.radius_rate * dot(jet.tangent, d.second)) / (speed * speed);
  jet.curvature = cross(jet.tangent, d.second) / (speed * speed);
  jet.rate_error = 8 * tolerance / speed;
  jet.bend_error = jet.rate_error / speed;
  return jet;
}

/// The derivatives of the parabola through three disks, by the length of its chords, in the middle.
Curve::Derivatives through(const Disk& before, const Disk& here, const Disk& after) {
  const double h0 = distance(before.center, here.center);
  const double h1 = distance(here.center, after.center);
  const double w0 = h1 / (h0 + h1), w1 = h0 / (h0 + h1);
  const Vec2 slope0 = (1 / h0) * (here.center - before.center);
  const Vec2 slope1 = (1 / h1) * (after.center - here.center);
  const double rate0 = (here.radius - before.radius) / h0;
  const double rate1 = (after.radius - here.radius) / h1;
  return {w0 * slope0 + w1 * slope1, (2 / (h0 + h1)) * (slope1 - slope0), w0 * rate0 + w1 * rate1,
          2 * (rate1 - rate0) / (h0 + h1)};
}

/// What disks that are off by `error`, as a pack's are, leave open of the differences across two
/// steps: 2 error / h of each first one, 4 error / (h0 h1) of the second.
void leave_open(AxisJet& jet, double h0, double h1, double error) {
  jet.rate_error = 4 * error / std::min(h0, h1);
  jet.bend_error = 8 * error / (h0 * h1);
}

/// The derivatives of the polynomial through some disks, by the length of the chords between them,
/// at the one of index `at`: Lagrange's weights. Requires different centres one after another.
Curve::Derivatives through(std::span<const Disk* const> disks, std::size_t at) {
  std::vector<double> t(disks.size(), 0);
  for (std::size_t i = 1; i < disks.size(); ++i)
    t[i] = t[i - 1] + distance(disks[i - 1]->center, disks[i]->center);
  const double origin = t[at];
  for (double& one : t) one -= origin;
  Curve::Derivatives sum{};
  for (std::size_t i = 0; i < disks.size(); ++i) {
    if (i == at) continue;  // differences from it: its own weights are minus the others' sums
    // Of L_i(x) = product over k of (x - t_k) / (t_i - t_k), at 0, where t_at = 0.
    double scale = t[i], product = 1, inverses = 0;
    for (std::size_t k = 0; k < disks.size(); ++k) {
      if (k == i || k == at) continue;
      scale *= t[i] - t[k];
      product *= -t[k];
      inverses -= 1 / t[k];
    }
    const double first = product / scale, second = 2 * first * inverses;
    const Vec2 d = disks[i]->center - disks[at]->center;
    const double r = disks[i]->radius - disks[at]->radius;
    sum.first = sum.first + first * d;
    sum.second = sum.second + second * d;
    sum.radius_first += first * r;
    sum.radius_second += second * r;
  }
  return sum;
}

/// How rough a run of disks is: the size of its highest divided difference over chords. Large where
/// a derivative of the branch jumps, as the third does where the boundary's curvature has a corner.
double roughness(std::span<const Disk* const> disks) {
  std::array<double, 8> t{};
  std::array<std::array<double, 3>, 8> values{};
  const std::size_t count = std::min(disks.size(), t.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) t[i] = t[i - 1] + distance(disks[i - 1]->center, disks[i]->center);
    const Vec2 d = disks[i]->center - disks[0]->center;
    values[i] = {d.x, d.y, disks[i]->radius - disks[0]->radius};
  }
  for (std::size_t order = 1; order < count; ++order)
    for (std::size_t i = 0; i + order < count; ++i)
      for (double& value : values[i]) {
        const auto which = static_cast<std::size_t>(&value - values[i].data());
        value = (values[i + 1][which] - value) / (t[i + order] - t[i]);
      }
  return std::hypot(values[0][0], values[0][1], values[0][2]);
}

/// How much a run's roughness counts at its disk `at`: the error of polynomials has the product of
/// the ways to the other disks as a factor, but where a derivative jumps that product is too small
/// in the middle; its root lies between.
double weight_at(std::span<const Disk* const> disks, std::size_t at) {
  double product = 1;
  for (std::size_t k = 0; k < disks.size(); ++k)
    if (k != at) product *= distance(disks[k]->center, disks[at]->center);
  return std::sqrt(product);
}

/// The jets at the inner nodes of a branch whose nodes are exact, from seven nodes each: those
/// around it whose roughness counts least, for differences across a jump of the third derivative
/// are off by the step times it.
std::vector<AxisJet> jets_of_exact_nodes(const MedialAxis& axis, const Branch& branch) {
  std::vector<const Disk*> disks = {&axis.nodes[branch.from].disk};
  for (const Step& step : branch.steps) {
    const Disk* next = &axis.nodes[head_of(axis, step)].disk;
    if (!(next->center == disks.back()->center)) disks.push_back(next);
  }
  std::vector<AxisJet> jets;
  constexpr std::size_t window = 7, aside = window / 2;
  const std::size_t count = disks.size(), width = std::min(window, count);
  std::vector<double> rough(count - width + 1);
  for (std::size_t first = 0; first < rough.size(); ++first)
    rough[first] = roughness(std::span(disks.data() + first, width));
  // Roughness estimates the size of errors only.
  constexpr double far_less = 0.3;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const std::size_t middle = std::min(i > aside ? i - aside : 0, count - width);
    const auto error_of = [&](std::size_t from) {
      return rough[from] * weight_at(std::span(disks.data() + from, width), i - from);
    };
    std::size_t first = middle;
    double least = far_less * error_of(middle);
    for (std::size_t from = i + 1 > width ? i + 1 - width : 0; from < std::min(i + 1, rough.size());
         ++from) {
      const double error = error_of(from);
      if (error < least) first = from;
      least = std::min(least, error);
    }
    const std::span<const Disk* const> near(disks.data() + first, width);
    jets.push_back(jet_of(*disks[i], through(near, i - first), 0));
  }
  return jets;
}

/// A series of a Bezier curve's coordinate at t + u, from its three weighted control values.
PowerSeries quadratic(double c0, double c1, double c2, double t, std::size_t size) {
  PowerSeries out(size);
  const double s = 1 - t;
  out.terms[0] = s * s * c0 + 2 * s * t * c1 + t * t * c2;
  if (size > 1) out.terms[1] = 2 * (s * (c1 - c0) + t * (c2 - c1));
  if (size > 2) out.terms[2] = c0 - 2 * c1 + c2;
  return out;
}

}  // namespace

AxisJet ops::reversed(AxisJet jet) {
  jet.tangent = -jet.tangent;
  jet.radius_rate = -jet.radius_rate;
  jet.curvature = -jet.curvature;
  return jet;
}

AxisJet jet_at(const MedialAxis& axis, const Edge& edge, double t) {
  const Curve curve = curve_of(axis, edge);
  return jet_of(curve.at(t), curve.derivatives(t), axis.resolution > 0 ? 0 : axis.tolerance);
}

BoundaryJet boundary_at(const AxisJet& jet, Side side) {
  // One side is the other one's mirror image: the normal and the curvature change their signs.
  const double sign = side == Side::left ? 1 : -1;
  const double radius = jet.disk.radius;
  const double rate = std::clamp(jet.radius_rate, -1.0, 1.0);
  const double s = std::sqrt((1 - rate) * (1 + rate));
  const Vec2 normal = sign * left_of(jet.tangent);
  const Vec2 outwards = s * normal - rate * jet.tangent;
  const double turn = sign * jet.curvature;

  BoundaryJet boundary;
  boundary.point = jet.disk.center + radius * outwards;
  boundary.tangent = s * jet.tangent + rate * normal;
  // l_a s = 1 - R_a^2 - R (R_aa + K_A s): the numerator of (6) and the denominator of (7).
  const double bend = jet.radius_bend + turn * s;
  const double shrink = s * s - radius * bend;
  boundary.rate = shrink / s;
  boundary.curvature = -bend / shrink;
  return boundary;
}

std::vector<double> boundary_curvatures(const MedialAxis& axis, const Edge& edge, double t,
                                        Side side, int order) {
  const std::size_t wanted = static_cast<std::size_t>(std::max(order, 0)) + 1;
  const std::size_t size = wanted + 3;  // (3) takes one derivative, a curvature two more
  const Curve c = curve_of(axis, edge);
  const double w = c.weight;
  const PowerSeries d = quadratic(1, w, 1, t, size);
  const PowerSeries x = quadratic(0, w * c.p1.x, c.p2.x, t, size) / d;
  const PowerSeries y = quadratic(0, w * c.p1.y, c.p2.y, t, size) / d;
  const PowerSeries r = quadratic(c.r0, w * c.r1, c.r2, t, size) / d;
  const PowerSeries speed_x = x.derivative(), speed_y = y.derivative();
  const PowerSeries speed = sqrt(speed_x * speed_x + speed_y * speed_y);
  const PowerSeries tx = speed_x / speed, ty = speed_y / speed, rate = r.derivative() / speed;
  PowerSeries one(size);
  one.terms[0] = 1;
  PowerSeries s = sqrt(one - rate * rate);
  if (side == Side::right)
    for (double& term : s.terms) term = -term;
  // (3), with s the component to the left.
  const PowerSeries bx = x - r * (rate * tx + s * ty), by = y - r * (rate * ty - s * tx);
  const PowerSeries b1x = bx.derivative(), b1y = by.derivative();
  const PowerSeries length = sqrt(b1x * b1x + b1y * b1y);
  // The boundary on the left has the shape on its right: convex where it turns to the right.
  PowerSeries curvature =
      (b1y * b1x.derivative() - b1x * b1y.derivative()) / (length * length * length);
  if (side == Side::right)
    for (double& term : curvature.terms) term = -term;
  std::vector<double> out;
  for (std::size_t k = 0; k < wanted; ++k) {
    out.push_back(curvature.value());
    curvature = curvature.derivative() / length;
  }
  return out;
}

std::vector<AxisJet> jets_along(const MedialAxis& axis, const Branch& branch, int samples) {
  std::vector<AxisJet> jets;
  if (axis.resolution > 0 && axis.method == "curve-axis") return jets_of_exact_nodes(axis, branch);
  if (axis.resolution > 0) {
    const auto end_of = [&](Step step) -> const Disk& {
      return axis.nodes[head_of(axis, step)].disk;
    };
    const Disk* before = &axis.nodes[branch.from].disk;
    for (std::size_t i = 0; i + 1 < branch.steps.size(); ++i) {
      const Disk& here = end_of(branch.steps[i]);
      const Disk& after = end_of(branch.steps[i + 1]);
      if (!(before->center == here.center) && !(here.center == after.center)) {
        jets.push_back(jet_of(here, through(*before, here, after), 0));
        if (axis.method == "pack")
          leave_open(jets.back(), distance(before->center, here.center),
                     distance(here.center, after.center), axis.resolution);
      }
      before = &here;
    }
    return jets;
  }
  for (const Step& step : branch.steps) {
    const Edge& edge = axis.edges[step.edge];
    for (int i = 1; i <= samples; ++i) {
      const double t = static_cast<double>(i) / (samples + 1);
      const AxisJet jet = jet_at(axis, edge, step.forward ? t : 1 - t);
      if (!(jet.tangent == Vec2{0, 0})) jets.push_back(step.forward ? jet : ops::reversed(jet));
    }
  }
  return jets;
}

std::vector<Legality> legality(const MedialAxis& axis, int samples_per_edge) {
  constexpr double lowest = -std::numeric_limits<double>::infinity();
  constexpr double most_error = 0.1;  // where rounding weighs more against 1, nothing is known
  std::vector<Legality> all;
  for (const Branch& branch : branches(axis)) {
    Legality one{lowest, lowest, 0, {}, {}};
    for (const AxisJet& jet : jets_along(axis, branch, samples_per_edge)) {
      const double rate = jet.radius_rate, radius = jet.disk.radius;
      const double square = (1 - rate) * (1 + rate);
      const double s = std::sqrt(std::max(square, 0.0));
      // A root is the less certain the closer it is to 0: sqrt(x + e) - sqrt(x) <= sqrt(e).
      const double square_error = 4 * jet.rate_error;
      const double root_error = std::min(std::sqrt(square_error), square_error / s);
      const double turn = std::abs(jet.curvature) * radius;
      const double error = square_error + 2 * radius * jet.bend_error + turn * root_error;
      if (!(error < most_error)) continue;
      ++one.jets;
      const double steepness = std::abs(rate) - 1 - jet.rate_error;
      const double bend = turn * s - (square - radius * jet.radius_bend) - error;
      if (steepness > one.steepness) one.steepness = steepness, one.steepest = jet;
      if (bend > one.bend) one.bend = bend, one.sharpest = jet;
    }
    all.push_back(one);
  }
  return all;
}

}  // namespace medial
