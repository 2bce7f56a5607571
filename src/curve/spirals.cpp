#include "curve/spirals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numbers.h"
#include "curve/biarc.h"

namespace medial::curve {
namespace {

/// Arcs turn by at most a quarter turn, so that two of them make at most a half circle: tan(pi /
/// 8).
constexpr double largest_bulge = 0.41421356237309503 + 1e-12;

/// Parts of one curve that are looked at before the rest becomes chords. A curve within a tolerance
/// of rounding has some 1e5; this is what bounds time and memory if a bound here is ever wrong. The
/// report's error then shows it.
constexpr int most_parts = 1 << 21;

/// Bisections after which a part is no larger than rounding, whatever the curve.
constexpr int deepest = 60;

/// Around a cusp the other roots are rounding: a root of multiplicity three is known to about the
/// third root of a double's precision.
constexpr double cusp_neighbourhood = 1e-4;

/// Curvatures that differ by less are the same: roots that are there by rounding only.
constexpr double same_curvature = 1e-8;

/// A part whose curvature changes evenly by d over a chord c is d c^2 / 324 away from its balanced
/// biarc; a little more makes up for what is uneven. From its spiral biarc it is 27/8 times that,
/// so a spiral biarc within a tolerance is 2/3 as long.
constexpr double balanced_error = 1.03 / 324;
constexpr double spiral_length = 2.0 / 3;

/// Between knots where arcs may meet at an angle to the curve, a biarc of that error is this much
/// of a balanced one: by (998 / 324)^(1/3) longer, and a tenth shorter for what is uneven.
constexpr double tilted_parts = 0.78;
/// What a biarc is shorter by, of such a length, at an end whose direction is the curve's: see
/// tilt(). And a single arc there instead; and a biarc whose first arc is the osculating circle.
constexpr double fixed_end = 0.157, single_end = 0.657, osculating_end = 0.38;
/// Numbers of arcs that are tried.
constexpr int tilted_attempts = 3;
/// Beyond so many balanced biarcs, by the ends of a part, one is not tried.
constexpr double hopeless = 2;

/// Places at which a part is looked at to divide it, for each part that it may have and in all; and
/// parts that it is divided into at once.
constexpr double samples_per_part = 2;
constexpr int fewest_samples = 4;
constexpr int most_samples = 32;
constexpr int most_divisions = 64;

/// A curve whose curvature goes monotonically from one value to another that differs by d, over a
/// chord c, is less than d c^2 / 50 away from the arc between the directions at its ends (largest
/// where curvature jumps at two thirds). Below a third of the rounding it is that arc.
constexpr double constant = 16;

/// Whether the less curved arc of a biarc is within its limit.
bool is_limited(const Biarc& biarc, const Station& a, const Station& b, CurvatureLimits limits) {
  const bool forward = std::abs(a.curvature) >= std::abs(b.curvature);
  return std::abs(curvature(forward ? biarc.second : biarc.first)) <=
         (forward ? limits.end : limits.begin);
}

bool is_singular(const Station& station) { return std::isinf(station.curvature); }

double extent(const Bezier& curve) {
  const Vec2 first = curve.point(0);
  double largest = 0;
  for (int i = 1; i <= curve.degree; ++i) {
    const Vec2 d = curve.point(i) - first;
    largest = std::max({largest, std::abs(d.x), std::abs(d.y)});
  }
  return largest;
}

/// The curve turned so that its chord is horizontal: the coefficients of a flat curve's curvature
/// are then small because its ordinates are, and not because large products cancel.
Bezier along_chord(const Bezier& curve) {
  const Vec2 chord = curve.point(curve.degree) - curve.point(0);
  const double length = norm(chord);
  if (!(length > 0)) return curve;
  const Vec2 d = (1 / length) * chord;
  Bezier turned;
  turned.degree = curve.degree;
  turned.rational = curve.rational;
  for (int i = 0; i <= curve.degree; ++i) {
    turned.x[i] = d.x * curve.x[i] + d.y * curve.y[i];
    turned.y[i] = d.x * curve.y[i] - d.y * curve.x[i];
    if (curve.rational) turned.w[i] = curve.w[i];
  }
  return turned;
}

/// Converts one curve: the state that the recursion shares.
class Converter {
 public:
  Converter(const Bezier& curve, const PieceCoordinates& frame, const SpiralOptions& options,
            ArcChain& chain)
      : curve_(curve),
        frame_(frame),
        options_(options),
        chain_(chain),
        parts_per_root_(std::cbrt(balanced_error / options.tolerance)) {}

  double run();

 private:
  /// What a part of the curve has to meet at its ends.
  struct Demands {
    CurvatureLimits limits;
    bool apex = false;  ///< its more curved end is that of the whole spiral
  };
  using Knots = Fixed<Station, most_divisions + 1>;

  void convert(const Bezier& part, const Station& a, const Station& b, Demands demands, int depth);
  template <class Leaf>
  bool visit_between(const Bezier& part, Knots& knots, int first, int last, Demands demands,
                     const Leaf& leaf);
  /// How many balanced biarcs there are up to some places along a part, evenly spaced in the
  /// parameter.
  struct Shares {
    int samples;
    Fixed<double, most_samples + 1> sum;

    double total() const { return sum[samples]; }
    bool even() const { return !(total() > 0 && total() <= std::numeric_limits<double>::max()); }
    double parameter_at(double share) const;
  };
  Shares shares_of(const Bezier& part, const Station& a, const Station& b) const;
  void place_knots(const Shares& shares, const Station& a, const Station& b, int count,
                   double saved_begin, double saved_end, Knots& knots) const;
  bool try_tilted(const Bezier& part, const Shares& shares, const Station& a, const Station& b,
                  Demands demands);
  static void tilt(Knots& knots, int count);
  static void align(Station& knot, const Station& end);
  bool try_arc(const Bezier& part, const Station& a, const Station& b, Demands demands);
  /// What is there to go back to.
  struct Emitted {
    std::size_t arcs;
    double last_bulge, error;
    bool merge, ends_osculating;
  };
  Emitted emitted() const {
    return {chain_.bulges.size(), chain_.bulges.empty() ? 0 : chain_.bulges.back(), error_, merge_,
            ends_osculating_};
  }
  void restore(const Emitted& before) {
    chain_.points.resize(before.arcs);
    chain_.bulges.resize(before.arcs);
    if (before.arcs > 0) chain_.bulges.back() = before.last_bulge;
    error_ = before.error;
    merge_ = before.merge;
    ends_osculating_ = before.ends_osculating;
  }
  /// How many balanced biarcs there are on a short part. The error of one grows with the change of
  /// curvature and the square of the length; its cube root adds up along a curve.
  double parts_between(const Station& a, const Station& b) const {
    return parts_per_root_ *
           std::cbrt(std::abs(b.curvature - a.curvature) * squared_norm(b.point - a.point));
  }
  bool try_single_arc(const Bezier& part, const Station& a, const Station& b);
  bool try_singular_end(const Bezier& part, const Station& a, const Station& b,
                        CurvatureLimits limits);
  bool try_biarc(const Bezier& part, const Station& a, const Station& b, Demands demands);
  Biarc biarc_of(const Station& a, const Station& b, Demands demands) const;
  bool is_spiral(const Biarc& biarc, const Station& a, const Station& b, Demands demands) const;
  Vec2 settled(Vec2 joint, const JointCircle& circle, Vec2 chord) const;
  Station snapped(Station station) const {
    station.point = frame_.snap(station.point);
    return station;
  }
  void emit(Vec2 begin, double bulge, double error) {
    chain_.points.push_back(frame_.to_input(begin));
    chain_.bulges.push_back(bulge);
    error_ = std::max(error_, error);
  }

  const Bezier& curve_;
  const PieceCoordinates& frame_;
  const SpiralOptions& options_;
  ArcChain& chain_;
  const double parts_per_root_;
  double error_ = 0;
  int parts_ = 0;
  bool ends_osculating_ = false;  ///< the last arc is the osculating circle where it ends
  bool merge_ = false;            ///< and the next one may go on along it
};

double Converter::run() {
  const Splits splits = find_splits(curve_);
  const auto station = [&](double t, Side side, bool inflection) {
    Station at = station_at(curve_, t, side);
    if (inflection) at.curvature = 0;
    return t > 0 && t < 1 ? snapped(at) : at;
  };
  Station a = station(0, Side::after, false);
  Bezier rest = curve_;
  Station before_a;
  for (int i = 0; i <= splits.count; ++i) {
    const bool last = i == splits.count;
    const Split next = last ? Split{1, Split::Kind::apex} : splits.at[i];
    const bool inflection = next.kind == Split::Kind::inflection;
    const Station b = station(next.t, Side::before, inflection);
    Bezier part;
    if (last) {
      part = rest;
    } else {
      split(rest, (next.t - a.t) / (1 - a.t), part, rest);
    }
    const CurvatureLimits limits{i == 0 ? options_.limits.begin : infinity,
                                 last ? options_.limits.end : infinity};
    merge_ = i > 0 && !is_singular(a) && std::abs(before_a.curvature) < std::abs(a.curvature) &&
             std::abs(b.curvature) < std::abs(a.curvature);
    ++chain_.spirals;
    convert(part, a, b, {limits, true}, 0);
    before_a = a;
    a = next.kind == Split::Kind::cusp ? station(next.t, Side::after, false) : b;
  }
  return error_;
}

void Converter::convert(const Bezier& part, const Station& a, const Station& b, Demands demands,
                        int depth) {
  const Vec2 chord = b.point - a.point;
  if (!(a.point == b.point)) {
    if (is_singular(a) || is_singular(b)) {
      if (try_singular_end(part, a, b, demands.limits)) return;
    } else if (std::abs(a.curvature - b.curvature) * squared_norm(chord) <=
               constant * options_.rounding) {
      if (try_single_arc(part, a, b)) return;
    } else if (parts_between(a, b) <= hopeless && try_biarc(part, a, b, demands)) {
      return;
    }
  }
  const double size = extent(part);
  if (depth >= deepest || ++parts_ > most_parts || size <= options_.rounding) {
    // Too small to have a direction.
    if (!(a.point == b.point)) emit(a.point, 0, size);
    merge_ = ends_osculating_ = false;
    error_ = std::max(error_, size);
    return;
  }
  const Shares shares = shares_of(part, a, b);
  if (try_tilted(part, shares, a, b, demands)) return;
  // Into parts that all have about the tolerance as their error.
  const bool forward = std::abs(a.curvature) >= std::abs(b.curvature);
  const double saved = demands.apex && !shares.even() ? 1 - spiral_length : 0;
  const double wanted = std::ceil(shares.total() + saved);
  // More are made in blocks that have many parts each: one of few is rounded up to one more.
  const double fitting =
      wanted <= most_divisions ? wanted : std::ceil(wanted / (0.5 * most_divisions));
  const int count =
      shares.even() ? 2 : static_cast<int>(std::clamp(fitting, 2.0, double{most_divisions}));
  Knots knots;
  place_knots(shares, a, b, count, forward ? saved : 0, forward ? 0 : saved, knots);
  visit_between(part, knots, 0, count, demands,
                [&](const Bezier& piece, const Station& from, const Station& to, Demands own) {
                  convert(piece, from, to, own, depth + 1);
                  return true;
                });
}

/// The parts between some knots of a part, which is cut in the middle again and again: that rounds
/// control points less often than cutting off one after the other. As long as `leaf` can take them.
template <class Leaf>
bool Converter::visit_between(const Bezier& part, Knots& knots, int first, int last,
                              Demands demands, const Leaf& leaf) {
  const Station& a = knots[first];
  const Station& b = knots[last];
  if (last == first + 1) return leaf(part, a, b, demands);
  const int middle = (first + last) / 2;
  Station& m = knots[middle];
  Bezier left, right;
  split(part, (m.t - a.t) / (b.t - a.t), left, right);
  const bool forward = std::abs(a.curvature) >= std::abs(b.curvature);
  if (!visit_between(left, knots, first, middle,
                     {{demands.limits.begin, infinity}, demands.apex && forward}, leaf))
    return false;
  if (is_singular(m)) m = snapped(station_at(curve_, m.t, Side::after));
  return visit_between(right, knots, middle, last,
                       {{infinity, demands.limits.end}, demands.apex && !forward}, leaf);
}

Converter::Shares Converter::shares_of(const Bezier& part, const Station& a,
                                       const Station& b) const {
  Shares shares;
  const double expected = std::min(parts_between(a, b), double{most_samples});
  shares.samples = std::clamp(static_cast<int>(std::ceil(samples_per_part * expected)),
                              fewest_samples, most_samples);
  shares.sum[0] = 0;
  Station from = a;
  for (int i = 1; i <= shares.samples; ++i) {
    Station to = b;
    if (i < shares.samples) {
      const Jet jet = evaluate(part, static_cast<double>(i) / shares.samples);
      to.point = jet.point;
      to.curvature = curvature(jet);
    }
    shares.sum[i] = shares.sum[i - 1] + parts_between(from, to);
    from = to;
  }
  return shares;
}

double Converter::Shares::parameter_at(double share) const {
  if (even()) return share;
  const double place = share * total();
  int sample = 0;
  while (sample + 1 < samples && sum[sample + 1] < place) ++sample;
  const double step = sum[sample + 1] - sum[sample];
  const double along = step > 0 ? std::min((place - sum[sample]) / step, 1.0) : 0.5;
  return (sample + along) / samples;
}

/// Knots between parts of equal shares, except for the first and the last part, whose shares are
/// smaller.
void Converter::place_knots(const Shares& shares, const Station& a, const Station& b, int count,
                            double saved_begin, double saved_end, Knots& knots) const {
  knots[0] = a;
  for (int i = 1; i < count; ++i) {
    const double t = shares.parameter_at((i - saved_begin) / (count - saved_begin - saved_end));
    knots[i] = snapped(station_at(curve_, a.t + t * (b.t - a.t), Side::before));
  }
  knots[count] = b;
}

/// A part as the fewest arcs of equal error: biarcs between knots, and where their number is odd a
/// single arc at the flatter end.
bool Converter::try_tilted(const Bezier& part, const Shares& shares, const Station& a,
                           const Station& b, Demands demands) {
  if (shares.even() || is_singular(a) || is_singular(b)) return false;
  const bool forward = std::abs(a.curvature) >= std::abs(b.curvature);
  const double curved_end = demands.apex ? osculating_end : fixed_end;
  const double needed = tilted_parts * shares.total() + curved_end;
  if (!(needed + 1 <= most_divisions)) return false;
  // Where the flatter end is limited, and a balanced arc would break that, there is a biarc that
  // osculates there.
  const double limit = forward ? demands.limits.end : demands.limits.begin;
  const double low = std::abs((forward ? b : a).curvature),
               high = std::abs((forward ? a : b).curvature);
  const bool limited = low + (high - low) / (6 * (needed + fixed_end)) > limit;
  const double biarcs = std::ceil(needed + (limited ? osculating_end : fixed_end));
  const bool is_odd = !limited && needed + single_end <= biarcs;
  int arcs = std::max(limited ? 4 : 3, 2 * static_cast<int>(biarcs) - (is_odd ? 1 : 0));
  const Emitted before = emitted();
  for (int attempt = 0; attempt < tilted_attempts && arcs <= 2 * most_divisions;
       ++attempt, arcs += std::max(limited ? 2 : 1, arcs / 32 * 2)) {
    const int count = (arcs + 1) / 2;
    const bool single = arcs % 2 == 1;
    const double flat_end = limited ? osculating_end : single ? single_end : fixed_end;
    Knots knots;
    place_knots(shares, a, b, count, forward ? curved_end : flat_end,
                forward ? flat_end : curved_end, knots);
    tilt(knots, count);
    Station& last = knots[forward ? count - 1 : 1];
    if (single) align(last, forward ? b : a);
    const auto try_one = [&](const Bezier& piece, const Station& from, const Station& to,
                             Demands own) {
      const bool is_last = &(forward ? from : to) == &last;
      return single && is_last ? try_arc(piece, from, to, own) : try_biarc(piece, from, to, own);
    };
    if (visit_between(part, knots, 0, count, demands, try_one)) return true;
    restore(before);
  }
  return false;
}

/// Turns the tangents of the knots between the ends from the curve's. Where curvature changes
/// evenly by d over an arc of length h, an arc between two points of the curve is off its direction
/// at both ends by angles that add up to d h / 6: least where they are alike.
void Converter::tilt(Knots& knots, int count) {
  Fixed<double, most_divisions> angle;
  for (int i = 1; i < count; ++i) {
    const Station &before = knots[i - 1], &after = knots[i + 1];
    const double arcs =  // four of them
        distance(before.point, knots[i].point) + distance(knots[i].point, after.point);
    angle[i] = (after.curvature - before.curvature) / 4 * (arcs / 4) / 12;
  }
  for (int i = 1; i < count; ++i) {
    const Vec2 along = knots[i].tangent;
    knots[i].tilt = angle[i];
    knots[i].tangent = std::sqrt(1 - angle[i] * angle[i]) * along - angle[i] * left_of(along);
  }
}

/// Turns the tangent of a knot to that of the arc from there to an end, or back, along its tangent.
void Converter::align(Station& knot, const Station& end) {
  const Vec2 chord = end.point - knot.point;
  const Vec2 tangent = (2 * dot(end.tangent, chord) / squared_norm(chord)) * chord - end.tangent;
  knot.tilt += cross(tangent, knot.tangent);
  knot.tangent = tangent;
}

/// One arc, to whose ends the tangents fit.
bool Converter::try_arc(const Bezier& part, const Station& a, const Station& b, Demands demands) {
  const bool forward = std::abs(a.curvature) >= std::abs(b.curvature);
  const Station &high = forward ? a : b, &low = forward ? b : a;
  const Vec2 chord = b.point - a.point;
  const double bulge = forward ? bulge_arriving(chord, b.tangent) : bulge_leaving(a.tangent, chord);
  if (!(std::abs(bulge) <= largest_bulge)) return false;
  const Arc arc{a.point, b.point, bulge};
  const double sign = std::copysign(1.0, high.curvature), amount = sign * curvature(arc);
  const double limit = forward ? demands.limits.end : demands.limits.begin;
  if (!(sign * low.curvature <= amount && amount <= std::min(limit, sign * high.curvature)))
    return false;
  const double error = certified_error(part, arc, options_.rounding);
  if (!(error <= options_.tolerance)) return false;
  emit(a.point, bulge, error);
  merge_ = ends_osculating_ = false;
  return true;
}

/// Where curvature is constant up to rounding: one arc, between the directions at both ends.
bool Converter::try_single_arc(const Bezier& part, const Station& a, const Station& b) {
  const Vec2 chord = b.point - a.point;
  const double leaving = bulge_leaving(a.tangent, chord);
  const double arriving = bulge_arriving(chord, b.tangent);
  const double bulge = 0.5 * (leaving + arriving);
  if (!(std::abs(bulge) <= largest_bulge)) return false;
  if (std::abs(leaving - arriving) * norm(chord) > constant * options_.rounding) return false;
  const double error = certified_error(part, Arc{a.point, b.point, bulge}, options_.rounding);
  if (error > options_.tolerance) return false;
  emit(a.point, bulge, error);
  merge_ = ends_osculating_ = false;
  return true;
}

/// Where curvature grows beyond all bounds towards one end: one arc that keeps the direction at the
/// other.
bool Converter::try_singular_end(const Bezier& part, const Station& a, const Station& b,
                                 CurvatureLimits limits) {
  if (is_singular(a) && is_singular(b)) return false;
  const Station& low = is_singular(a) ? b : a;
  const double limit = is_singular(a) ? limits.end : limits.begin;
  const Vec2 chord = b.point - a.point;
  const double bulge =
      is_singular(a) ? bulge_arriving(chord, b.tangent) : bulge_leaving(a.tangent, chord);
  if (!(std::abs(bulge) <= largest_bulge)) return false;
  const Arc arc{a.point, b.point, bulge};
  const double amount = std::copysign(1.0, low.curvature) * curvature(arc);
  const double slack = options_.rounding / squared_norm(chord);
  if (amount < std::abs(low.curvature) - slack || amount > limit) return false;
  const double error = certified_error(part, arc, options_.rounding);
  if (error > options_.tolerance) return false;
  emit(a.point, bulge, error);
  merge_ = ends_osculating_ = false;
  return true;
}

/// A joint on the input's grid, as near to the joint circle as can be.
Vec2 Converter::settled(Vec2 joint, const JointCircle& circle, Vec2 chord) const {
  // Sliding along the joint circle by this part of the chord changes the arcs' curvatures by no
  // more than about this part of their difference.
  constexpr double slide = 0x1p-20;
  const double reach = slide * std::max(std::abs(chord.x), std::abs(chord.y));
  const Vec2 snapped = frame_.snap(joint);
  return frame_.snap(settle_joint(circle, snapped, frame_.spacing(snapped), reach));
}

/// The biarc of least error that keeps what curvature is limited to at its less curved end: at the
/// joint that balances its arcs, or the one whose arc there is the osculating circle.
Biarc Converter::biarc_of(const Station& a, const Station& b, Demands demands) const {
  const JointCircle circle = joint_circle(a, b);
  const auto at = [&](Vec2 joint) {
    return make_biarc(a, settled(joint, circle, b.point - a.point), b);
  };
  if (demands.apex) return at(spiral_joint(a, b));
  const Biarc balanced = at(balanced_joint(a, b, circle));
  return is_limited(balanced, a, b, demands.limits) ? balanced : at(flat_joint(a, b));
}

bool Converter::try_biarc(const Bezier& part, const Station& a, const Station& b, Demands demands) {
  const Biarc biarc = biarc_of(a, b, demands);
  if (!is_spiral(biarc, a, b, demands)) return false;
  const double error = certified_error(part, biarc, options_.rounding);
  if (!(error <= options_.tolerance)) return false;

  const bool forward = std::abs(a.curvature) >= std::abs(b.curvature);
  if (merge_ && ends_osculating_ && forward) {
    // Two arcs of one circle are one. It leaves the arc before along its tangent, and the joint
    // ahead has to move by some roundings.
    Station from = a;
    from.point = frame_.to_local(chain_.points.back());
    from.tangent = tangent_at_begin({from.point, a.point, chain_.bulges.back()});
    const Vec2 joint = settled(biarc.first.end, joint_circle(from, b), b.point - from.point);
    const Biarc merged = make_biarc(from, joint, b);
    chain_.bulges.back() = merged.first.bulge;
    emit(merged.second.begin, merged.second.bulge, error);
  } else {
    emit(a.point, biarc.first.bulge, error);
    emit(biarc.second.begin, biarc.second.bulge, error);
  }
  merge_ = false;
  ends_osculating_ = demands.apex && !forward;
  return true;
}

/// Whether the curvatures of the arcs go from one of the curve's ends to the other, as they do for
/// a spiral that is short enough, and are below the limit.
bool Converter::is_spiral(const Biarc& biarc, const Station& a, const Station& b,
                          Demands demands) const {
  if (!(std::abs(biarc.first.bulge) <= largest_bulge) ||
      !(std::abs(biarc.second.bulge) <= largest_bulge)) {
    return false;
  }
  const bool forward = std::abs(a.curvature) >= std::abs(b.curvature);
  const double sign = std::copysign(1.0, forward ? a.curvature : b.curvature);
  const double highest = sign * (forward ? a.curvature : b.curvature);
  const double lowest = std::max(0.0, sign * (forward ? b.curvature : a.curvature));
  // At an apex it is the highest by construction, except for how far the joint has slid.
  const double high =
      demands.apex ? highest : sign * curvature(forward ? biarc.first : biarc.second);
  const double low = sign * curvature(forward ? biarc.second : biarc.first);
  const double shorter = std::min(squared_norm(biarc.first.end - biarc.first.begin),
                                  squared_norm(biarc.second.end - biarc.second.begin));
  // The rounding of the arcs' end points, as seen by their curvature.
  const double slack = options_.rounding / shorter;
  return lowest <= low + slack && low <= high + slack && high <= highest + slack &&
         std::abs(low) <= (forward ? demands.limits.end : demands.limits.begin);
}

/// Leaves out roots that rounding has doubled, and apices next to an end: nothing happens to the
/// curvature between them, and an arc there would be too short to have a direction. Gives how many
/// stay, at the beginning.
int drop_doubled(const Bezier& curve, Split* begin, const Split* end) {
  const auto is_same = [](double t, double k, double other_t, double other_k) {
    return std::abs(t - other_t) <= cusp_neighbourhood && std::isfinite(other_k) &&
           std::abs(k - other_k) <= same_curvature * std::max(std::abs(k), std::abs(other_k));
  };
  const double end_curvature = curvature(evaluate(curve, 1));
  int kept = 0;
  double last_curvature = curvature(evaluate(curve, 0)), last_t = 0;
  for (const Split* split = begin; split != end; ++split) {
    const double k =
        split->kind == Split::Kind::inflection ? 0 : curvature(evaluate(curve, split->t));
    const bool apex = split->kind == Split::Kind::apex;
    if ((kept > 0 || apex) && split->kind != Split::Kind::cusp &&
        is_same(split->t, k, last_t, last_curvature)) {
      continue;
    }
    if (apex && is_same(split->t, k, 1, end_curvature)) continue;
    last_curvature = k;
    last_t = split->t;
    begin[kept++] = *split;
  }
  return kept;
}

}  // namespace

Splits find_splits(const Bezier& curve) {
  const CurvaturePolynomials polynomials = curvature_polynomials(along_chord(curve));
  Splits found;
  const auto add_roots = [&](const Polynomial& polynomial, Split::Kind kind) {
    const Roots all = roots(polynomial);
    for (int i = 0; i < all.count; ++i) {
      if (all.t[i] > 0 && all.t[i] < 1) found.add({all.t[i], kind});
    }
  };
  add_roots(polynomials.inflection, Split::Kind::inflection);
  add_roots(polynomials.apex, Split::Kind::apex);

  // Cusps: where the speed is stationary and zero. Rare, so tested only where a split is slow
  // or an end is singular.
  const double size = extent(curve);
  double cusps[max_degree + 2];
  int cusp_count = 0;
  for (double t : {0.0, 1.0}) {
    if (is_singular(station_at(curve, t, t == 0 ? Side::after : Side::before))) {
      cusps[cusp_count++] = t;
    }
  }
  const auto near_cusp = [&](double t) {
    return std::any_of(cusps, cusps + cusp_count,
                       [&](double cusp) { return std::abs(t - cusp) <= cusp_neighbourhood; });
  };
  constexpr double slow = 1e-2;
  const bool any_slow = std::any_of(
      found.at.begin(), found.at.begin() + found.count,
      [&](const Split& split) { return norm(evaluate(curve, split.t).first) < slow * size; });
  if (any_slow) {
    const Roots stationary = roots(derivative(polynomials.speed));
    for (int i = 0; i < stationary.count; ++i) {
      const double t = stationary.t[i];
      const bool known = near_cusp(t) || t <= cusp_neighbourhood || t >= 1 - cusp_neighbourhood;
      if (!known && cusp_count <= max_degree && is_singular(station_at(curve, t, Side::after))) {
        cusps[cusp_count++] = t;
        found.add({t, Split::Kind::cusp});
      }
    }
  }
  Split* const begin = found.at.data();
  Split* end = std::remove_if(begin, begin + found.count, [&](const Split& split) {
    return split.kind != Split::Kind::cusp && near_cusp(split.t);
  });
  std::sort(begin, end, [](const Split& a, const Split& b) { return a.t < b.t; });

  found.count = drop_doubled(curve, begin, end);
  return found;
}

double append_spirals(const Bezier& curve, const PieceCoordinates& frame,
                      const SpiralOptions& options, ArcChain& chain) {
  return Converter(curve, frame, options, chain).run();
}

}  // namespace medial::curve
