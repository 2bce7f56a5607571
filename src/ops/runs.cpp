#include "ops/runs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "axis/curve.h"
#include "base/arc.h"
#include "base/numbers.h"

namespace medial::ops {
namespace {

/// Gauss and Legendre's rule of four points on [0, 1].
constexpr std::array<double, 4> abscissa{0.06943184420297371, 0.3300094782075719,
                                         0.6699905217924281, 0.9305681557970263};
constexpr std::array<double, 4> factor{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                       0.1739274225687269};

/// At how many places inside an edge of arcs the signs of derivatives are sampled.
constexpr int probes = 16;
/// A derivative below this times its own scale is zero: rounding of control points far below it.
constexpr double zero_share = 1e-7;
/// In tolerances: the direction of a piece of so little length is rounding's.
constexpr double rounding = 64;

/// Whether radius and direction are linear along an edge: two segments, or samples.
bool is_linear(const MedialAxis& axis, const Edge& edge) {
  if (axis.resolution > 0) return true;
  const std::size_t count = axis.sites.size();
  if (edge.site[0] >= count || edge.site[1] >= count) return false;
  return axis.sites[edge.site[0]].kind() == SiteKind::segment &&
         axis.sites[edge.site[1]].kind() == SiteKind::segment;
}

/// Whether an edge's second derivatives may change their sign inside: not on lines and parabolas.
bool is_conic(const Edge& edge, bool straight) { return edge.weight != 1 && !straight; }

/// Whether an edge runs straight: between vertices, or by its control points.
bool is_straight(const MedialAxis& axis, const Edge& edge, const Curve& curve) {
  const std::size_t count = axis.sites.size();
  if (edge.site[0] < count && edge.site[1] < count &&
      axis.sites[edge.site[0]].kind() == SiteKind::vertex &&
      axis.sites[edge.site[1]].kind() == SiteKind::vertex)
    return true;
  return curve.straight();
}

/// Signs of the second derivative of the radius and of the derivative of |K|, by the length; both
/// made free of scale by the disk's radius and by the curvature.
struct Signs {
  int bend = 0;
  int spiral = 0;
};

int sign_of(double value) { return value > zero_share ? 1 : value < -zero_share ? -1 : 0; }

Signs signs_at(const Curve& curve, double t) {
  const Curve::Derivatives d = curve.derivatives(t);
  const double speed = norm(d.first);
  if (!(speed > 0)) return {};
  const double along = dot(d.first, d.second) / (speed * speed);
  const double bend = (d.radius_second - along * d.radius_first) / (speed * speed);
  // The third derivative of N / W, whose numerator and denominator are quadratic.
  const double w = curve.weight;
  const double denominator = 1 + 2 * (w - 1) * t * (1 - t);
  const double first = 2 * (w - 1) * (1 - 2 * t), second = -4 * (w - 1);
  const Vec2 third = (-3 / denominator) * (first * d.second + second * d.first);
  const double turn = cross(d.first, d.second);
  // K = turn / speed^3, so (K' / K) / (K speed) = (cross(C', C''') / turn - 3 along) speed^2 /
  // turn.
  const double growth =
      (cross(d.first, third) / turn - 3 * along) * (speed * speed / std::abs(turn));
  const double scale = curve.at(t).radius;
  return {sign_of(scale * bend), turn == 0 ? 0 : sign_of(turn > 0 ? growth : -growth)};
}

/// The places in (0, 1) where the radius is level: there, its derivative's numerator is 0. One
/// beside an end is that end, to rounding: a piece between them would have no direction.
void add_level_places(const Curve& curve, std::vector<double>& out) {
  add_roots(curve.weight * (curve.r1 - curve.r0), 0.5 * (curve.r2 - curve.r0),
            curve.weight * (curve.r2 - curve.r1), out);
  std::erase_if(out, [](double t) { return t <= zero_share || t >= 1 - zero_share; });
}

void add_sign_changes(const Curve& curve, std::vector<double>& out) {
  const auto differ = [](int a, int b) { return a * b < 0; };
  double before = 0.5 / probes;
  Signs last = signs_at(curve, before);
  for (int i = 1; i < probes; ++i) {
    const double t = (i + 0.5) / probes;
    const Signs here = signs_at(curve, t);
    for (const auto member : {&Signs::bend, &Signs::spiral}) {
      if (!differ(last.*member, here.*member)) continue;
      double low = before, high = t;
      for (double middle = 0.5 * (low + high); low < middle && middle < high;
           middle = 0.5 * (low + high)) {
        (differ(last.*member, signs_at(curve, middle).*member) ? high : low) = middle;
      }
      out.push_back(high);
    }
    // Where one is zero the last sign is kept, so that a change is found behind it.
    if (here.bend != 0) last.bend = here.bend;
    if (here.spiral != 0) last.spiral = here.spiral;
    before = t;
  }
}

/// Of two runs one after the other, the first of which has this share of the length.
Moments joined(const Moments& a, const Moments& b, double share) {
  const double rest = 1 - share;
  const double first = share * b.zero + rest * b.first;  // of b, by the u of both
  const double second = share * (share * b.zero + 2 * rest * b.first) + rest * rest * b.second;
  return {share * a.zero + rest * b.zero, share * share * a.first + rest * first,
          share * share * share * a.second + rest * second, share * a.square + rest * b.square};
}

/// Of f + c instead of f.
Moments raised(const Moments& m, double c) {
  return {m.zero + c, m.first + c / 2, m.second + c / 3, m.square + c * (2 * m.zero + c)};
}

/// A linear edge as a run, in its own direction.
Run linear_run(const Disk& from, const Disk& to) {
  Run run;
  const Vec2 d = to.center - from.center;
  const double length = std::hypot(d.x, d.y);
  run.length = length;
  if (!(length > 0)) return run;
  const double rise = to.radius - from.radius;
  run.radius = raised({rise / 2, rise / 3, rise / 4, rise * rise / 3}, from.radius);
  run.first_tangent = run.last_tangent = (1 / length) * d;
  return run;
}

/// The direction of a velocity of a curve.
Vec2 tangent_of(const Curve& curve, Vec2 velocity) {
  const double speed = norm(velocity);
  if (speed > 0) return (1 / speed) * velocity;
  const double chord = norm(curve.p2);
  return chord > 0 ? (1 / chord) * curve.p2 : Vec2{0, 0};
}

/// A curve as a run, in its own direction, by one application of Gauss's rule. `first`, `last`: its
/// velocities at the ends.
Run smooth_run(const Curve& curve, bool straight, Vec2 first, Vec2 last) {
  Run run;
  run.length = straight ? norm(curve.p2) : curve.length();
  if (!(run.length > 0)) return run;
  run.first_tangent = tangent_of(curve, first);
  run.last_tangent = tangent_of(curve, last);
  for (std::size_t i = 0; i < abscissa.size(); ++i) {
    const double t = abscissa[i];
    const Vec2 velocity = curve.velocity(t);
    const double du = factor[i] * norm(velocity) / run.length;
    const double u = (straight ? norm(curve.offset(t)) : curve.length(t)) / run.length;
    const double radius = curve.at(t).radius;
    const double angle = straight ? 0 : signed_angle(run.first_tangent, velocity);
    for (auto [moments, value] :
         {std::pair(&run.radius, radius), std::pair(&run.direction, angle)}) {
      moments->zero += du * value;
      moments->first += du * u * value;
      moments->second += du * u * u * value;
      moments->square += du * value * value;
    }
  }
  run.direction_change = straight ? 0 : signed_angle(run.first_tangent, run.last_tangent);
  run.bending = std::abs(run.direction_change);
  return run;
}

/// The same, halved until the velocity by the parameter is nearly even along a part: then four
/// points are exact to some 1e-4, far below every threshold.
Run curved_run(const Curve& curve, bool straight, int depth = 0) {
  constexpr double even = 2;
  constexpr int deepest = 30;
  const Vec2 first = curve.velocity(0), last = curve.velocity(1);
  const auto [low, high] = std::minmax({norm(first), norm(curve.velocity(0.5)), norm(last)});
  if (high <= even * low || depth == deepest || !(high > 0))
    return smooth_run(curve, straight, first, last);
  const Run a = curved_run(curve.part(0, 0.5), straight, depth + 1);
  const Run b = curved_run(curve.part(0.5, 1), straight, depth + 1);
  if (!(a.length > 0)) return b;
  if (!(b.length > 0)) return a;
  Run both = joined(a, b);
  both.piece_count = 1;
  return both;
}

/// Whether runs differ in a sign: one opens and the other closes, sides bulge and are hollow, one
/// turns to the left and the other to the right, one spirals in and the other out. Where they meet
/// is a cut, however well one function fits both.
bool opposed(const Run& a, const Run& b) {
  const auto sign = [](bool positive, bool negative) { return positive ? 1 : negative ? -1 : 0; };
  const auto opening = [&](const Run& r) {
    using enum Primitive;
    return sign(
        r.primitive == opening_wedge || r.primitive == opening_cup || r.primitive == opening_flare,
        r.primitive != worm);
  };
  const auto bulging = [&](const Run& r) {
    using enum Primitive;
    return sign(r.primitive == opening_cup || r.primitive == closing_cup,
                r.primitive == opening_flare || r.primitive == closing_flare);
  };
  const auto left = [&](const Run& r) {
    return sign(r.variation<Variation::straight, r.variation> Variation::straight);
  };
  const auto inwards = [&](const Run& r) {
    using enum Variation;
    return sign(r.variation == spiral_in_left || r.variation == spiral_in_right,
                r.variation == spiral_out_left || r.variation == spiral_out_right);
  };
  return opening(a) * opening(b) < 0 || bulging(a) * bulging(b) < 0 || left(a) * left(b) < 0 ||
         inwards(a) * inwards(b) < 0;
}

/// The same run walked from its other end.
Run reversed(const Run& run) {
  Run back = run;
  std::swap(back.from, back.to);
  const auto mirror = [](const Moments& m) {
    return Moments{m.zero, m.zero - m.first, m.zero - 2 * m.first + m.second, m.square};
  };
  back.radius = mirror(run.radius);
  // The angle against the tangent at the new start: angle(s) - direction_change.
  back.direction = raised(mirror(run.direction), -run.direction_change);
  back.direction_change = -run.direction_change;
  back.first_tangent = -run.last_tangent;
  back.last_tangent = -run.first_tangent;
  return back;
}

}  // namespace

Fit fit(const Moments& m) {
  // Legendre's polynomials on [0, 1]: 1, 2 u - 1, 6 u^2 - 6 u + 1.
  const double c0 = m.zero, c1 = 3 * (2 * m.first - m.zero);
  const double c2 = 5 * (6 * (m.second - m.first) + m.zero);
  const double square = m.square - c0 * c0 - c1 * c1 / 3 - c2 * c2 / 5;
  return {2 * c1, 12 * c2, std::sqrt(std::max(square, 0.0))};
}

void classify(Run& run, const FeatureOptions& options) {
  const Fit radius = fit(run.radius);
  const Fit angle = fit(run.direction);
  const bool opening = radius.slope > 0;
  const double rise = std::abs(radius.slope), bend = radius.bend / run.length;
  if (bend < -options.bend) {
    run.primitive = opening ? Primitive::opening_cup : Primitive::closing_cup;
  } else if (bend > options.bend) {
    run.primitive = opening ? Primitive::opening_flare : Primitive::closing_flare;
  } else if (rise <= options.parallel * run.length && rise <= options.even * run.mean_radius()) {
    run.primitive = Primitive::worm;
  } else {
    run.primitive = opening ? Primitive::opening_wedge : Primitive::closing_wedge;
  }
  const bool left = angle.slope > 0;
  if (std::abs(angle.slope) <= options.turn) {
    run.variation = Variation::straight;
  } else if (std::abs(angle.bend) <= options.spiral * std::abs(angle.slope)) {
    run.variation = left ? Variation::left_circular : Variation::right_circular;
  } else if ((angle.bend > 0) == left) {
    run.variation = left ? Variation::spiral_in_left : Variation::spiral_in_right;
  } else {
    run.variation = left ? Variation::spiral_out_left : Variation::spiral_out_right;
  }
}

Run joined(const Run& a, const Run& b) {
  Run run = a;
  const double turn = signed_angle(a.last_tangent, b.first_tangent);
  const double start = a.direction_change + turn;
  run.to = b.to;
  run.length = a.length + b.length;
  run.piece_count = a.piece_count + b.piece_count;
  const double share = a.length / run.length;
  run.radius = joined(a.radius, b.radius, share);
  run.direction = joined(a.direction, raised(b.direction, start), share);
  run.direction_change = start + b.direction_change;
  run.bending = a.bending + std::abs(turn) + b.bending;
  run.last_tangent = b.last_tangent;
  return run;
}

void RunCutter::add_pieces(const Step& step) {
  const Edge& edge = axis_.edges[step.edge];
  const Disk &from = axis_.nodes[edge.node[0]].disk, &to = axis_.nodes[edge.node[1]].disk;
  smallest_ = std::min({smallest_, from.radius, to.radius});
  const auto add = [&](Run run, double t0, double t1) {
    if (!(run.length > rounding * axis_.tolerance)) return;
    run.from = {step.edge, t0};
    run.to = {step.edge, t1};
    runs_.push_back(step.forward ? run : reversed(run));
  };
  if (is_linear(axis_, edge)) {
    add(linear_run(from, to), 0, 1);
    return;
  }
  const Curve curve = curve_of(axis_, edge);
  cuts_.clear();
  add_level_places(curve, cuts_);
  for (const double t : cuts_) smallest_ = std::min(smallest_, curve.at(t).radius);
  const bool straight = is_straight(axis_, edge, curve);
  if (is_conic(edge, straight)) add_sign_changes(curve, cuts_);
  cuts_.push_back(0);
  cuts_.push_back(1);
  std::sort(cuts_.begin(), cuts_.end());
  for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
    const std::size_t i = step.forward ? k : cuts_.size() - 2 - k;
    if (cuts_[i] < cuts_[i + 1])
      add(curved_run(curve.part(cuts_[i], cuts_[i + 1]), straight), cuts_[i], cuts_[i + 1]);
  }
}

double RunCutter::relative_length(std::uint32_t i) const {
  const Run& run = runs_[i];
  return run.mean_radius() > 0 ? run.length / run.mean_radius() : infinity;
}

/// Makes a chain of all runs.
void RunCutter::link(bool cyclic) {
  const auto count = static_cast<std::uint32_t>(runs_.size());
  next_.resize(count);
  previous_.resize(count);
  version_.assign(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    next_[i] = i + 1 < count ? i + 1 : cyclic ? 0 : none;
    previous_[i] = i > 0 ? i - 1 : cyclic ? count - 1 : none;
  }
}

/// Joins a run with the one behind it.
void RunCutter::absorb_next(std::uint32_t i, const Run& both) {
  const std::uint32_t other = next_[i];
  runs_[i] = both;
  next_[i] = next_[other];
  if (next_[other] != none) previous_[next_[other]] = i;
  ++version_[i];
  version_[other] = none;
}

/// The shortest run, by its radius, is merged with that neighbour which is the shorter one, until
/// none is too short.
void RunCutter::merge_short(bool cyclic) {
  const auto count = static_cast<std::uint32_t>(runs_.size());
  link(cyclic);
  const auto consider = [&](std::uint32_t i) {
    const double key = relative_length(i);
    if (key < options_.shortest) heap_.push({key, i, version_[i]});
  };
  for (std::uint32_t i = 0; i < count; ++i) consider(i);
  for (std::uint32_t left = count; !heap_.empty() && left > 1;) {
    const Entry entry = heap_.top();
    heap_.pop();
    std::uint32_t i = entry.run;
    if (version_[i] != entry.version) continue;
    std::uint32_t other = next_[i];
    const std::uint32_t before = previous_[i];
    if (other == none || (before != none && relative_length(before) < relative_length(other))) {
      other = i;
      i = before;
    }
    absorb_next(i, joined(runs_[i], runs_[other]));
    --left;
    consider(i);
  }
  heap_ = {};
  compact();
}

/// Joins neighbours as long as `judge` gives a finite number for a pair, smallest numbers first.
template <class Judge>
void RunCutter::agglomerate(bool cyclic, const Judge& judge) {
  if (runs_.size() == 1) return;
  link(cyclic);
  const auto consider = [&](std::uint32_t i) {
    const std::uint32_t other = next_[i];
    if (other == none || other == i) return;
    const double key = judge(runs_[i], runs_[other]);
    if (std::isfinite(key)) heap_.push({key, i, version_[i]});
  };
  for (std::uint32_t i = 0; i < runs_.size(); ++i) consider(i);
  bool changed = false;
  while (!heap_.empty()) {
    const Entry entry = heap_.top();
    heap_.pop();
    const std::uint32_t i = entry.run;
    if (version_[i] != entry.version) continue;
    Run both = joined(runs_[i], runs_[next_[i]]);
    classify(both, options_);
    absorb_next(i, both);
    changed = true;
    consider(i);
    const std::uint32_t before = previous_[i];
    if (before != none && before != i) {
      ++version_[before];  // its pair has changed
      consider(before);
    }
  }
  if (changed) compact();
}

/// Neighbours are taken together as long as quadratic functions fit, best fits first: so the cuts
/// that stay lie where radius or direction have a corner.
void RunCutter::join_fitting(bool cyclic) {
  // Of samples, half a step in the radius, and in the direction what it turns by from sample to
  // sample, are noise; and these shares, of the radius and in radians, what nobody sees.
  const bool samples = axis_.resolution > 0;
  constexpr double radius_share = 0.002;
  const double turns = samples ? bending_ / static_cast<double>(runs_.size()) : 0;
  const double angle_share = samples ? 0.02 : 0.005;
  agglomerate(cyclic, [&](const Run& a, const Run& b) {
    if (!samples && opposed(a, b)) return infinity;
    const Run both = joined(a, b);
    const double radius =
        fit(both.radius).residual / (radius_share * both.mean_radius() + 0.5 * axis_.resolution);
    const double angle = fit(both.direction).residual / (angle_share + turns);
    const double worst = std::max(radius, angle);
    return worst <= 1 ? worst : infinity;
  });
}

/// Neighbours of one class whose union is of that class become one, the shortest unions first; and
/// circular ones, and spirals, of one primitive and side whose union is nearly a spiral: so arcs
/// that approximate a spiral are one.
void RunCutter::join_equal(bool cyclic) {
  constexpr double spiral_share = 0.03;  // of the turning: what a spiral's direction may miss
  agglomerate(cyclic, [&](const Run& a, const Run& b) {
    const bool same = a.variation == b.variation;
    if (a.primitive != b.primitive || (!same && opposed(a, b))) return infinity;
    const auto is_straight = [](const Run& r) { return r.variation == Variation::straight; };
    if (!same && (is_straight(a) || is_straight(b))) return infinity;
    Run both = joined(a, b);
    classify(both, options_);
    if (both.primitive != a.primitive || is_straight(both) != is_straight(a)) return infinity;
    if (same && both.variation == a.variation) return both.length;
    const Fit angle = fit(both.direction);
    return angle.residual <= spiral_share * std::abs(angle.slope) ? both.length : infinity;
  });
}

/// Cuts runs of samples where their radius is level inside, at the nearest sample.
void RunCutter::split_level() {
  constexpr double margin = 0.05;  // of a run: nearer to its ends there is nothing to cut off
  std::vector<Run> out;
  for (const Run& run : runs_) {
    const Fit radius = fit(run.radius);
    const double level = 0.5 - radius.slope / radius.bend;
    const bool bent = std::abs(radius.bend) > options_.bend * run.length;
    if (!bent || !(level > margin && level < 1 - margin) || run.piece_count < 2) {
      out.push_back(run);
      continue;
    }
    const auto piece = [&](std::uint32_t i) -> const Run& {
      return pieces_[(run.first_piece + i) % pieces_.size()];
    };
    Run first = piece(0);
    std::uint32_t i = 1;
    while (i + 1 < run.piece_count && first.length + 0.5 * piece(i).length < level * run.length)
      first = joined(first, piece(i++));
    Run second = piece(i++);
    while (i < run.piece_count) second = joined(second, piece(i++));
    for (Run* part : {&first, &second}) {
      classify(*part, options_);
      out.push_back(*part);
    }
  }
  runs_ = std::move(out);
}

/// Drops the runs that were merged into others.
void RunCutter::compact() {
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < runs_.size(); ++i)
    if (version_[i] != none) runs_[kept++] = runs_[i];
  runs_.resize(kept);
}

std::span<const Run> RunCutter::cut(std::span<const Step> steps, bool cyclic) {
  runs_.clear();
  length_ = radius_integral_ = turning_ = bending_ = 0;
  smallest_ = infinity;
  for (const Step& step : steps) add_pieces(step);
  if (runs_.empty()) return {};
  const Run* before = cyclic ? &runs_.back() : nullptr;
  for (const Run& run : runs_) {
    length_ += run.length;
    radius_integral_ += run.length * run.mean_radius();
    double turn = run.direction_change, bending = run.bending;
    if (before != nullptr) {
      const double jump = signed_angle(before->last_tangent, run.first_tangent);
      turn += jump;
      bending += std::abs(jump);
    }
    turning_ += turn;
    bending_ += bending;
    before = &run;
  }
  const bool samples = axis_.resolution > 0;
  if (samples) {
    for (std::uint32_t i = 0; i < runs_.size(); ++i) runs_[i].first_piece = i;
    pieces_ = runs_;
    join_fitting(cyclic);
  }
  merge_short(cyclic);
  for (Run& run : runs_) classify(run, options_);
  if (!samples) join_fitting(cyclic);
  join_equal(cyclic);
  if (samples) split_level();
  if (cyclic && runs_.size() > 1) {
    const auto longest = std::max_element(
        runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.length < b.length; });
    std::rotate(runs_.begin(), longest, runs_.end());
  }
  return runs_;
}

}  // namespace medial::ops
