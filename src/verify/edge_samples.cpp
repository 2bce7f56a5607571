#include "verify/edge_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "base/wide.h"

namespace medial::verify_detail {
namespace {

/// A site, to measure many disks against.
class NearSite {
 public:
  /// `known`: the site's arc, if it is one of the boundary.
  NearSite(const Site& site, const Arc* known)
      : segment_(site.start, site.end), arc_(known), is_point_(site.start == site.end) {
    if (arc_ == nullptr && !is_point_ && site.bulge != 0) arc_ = &own_.emplace(edge_of(site));
  }
  NearSite(const NearSite&) = delete;
  NearSite& operator=(const NearSite&) = delete;

  /// Negative where a place lies behind an edge, seen from the interior.
  Pair signed_distances(const Pair& x, const Pair& y) const {
    if (is_point_) return segment_.distances_from_start(x, y);
    return arc_ != nullptr ? arc_->signed_distances(x, y) : segment_.signed_distances(x, y);
  }

 private:
  Segment segment_;
  std::optional<Arc> own_;
  const Arc* arc_;
  bool is_point_;
};

/// Two disks of an edge.
struct DiskPair {
  Pair x, y, radius;

  Disk operator[](std::size_t i) const { return {{x[i], y[i]}, radius[i]}; }
};

/// An edge's curve at two parameters at once.
class PairOnCurve {
 public:
  PairOnCurve(const Curve& curve, const Parameters& at)
      : curve_(curve), t_(at.t), s_(at.s), by_start_(at.t <= 0.5) {
    if (curve.weight == 1) {
      std::tie(b0_, b1_, b2_) = std::tie(at.polynomial[0], at.polynomial[1], at.polynomial[2]);
    } else {
      const auto [polynomial, sum] = at.weighted(curve.weight);
      std::tie(b0_, b1_, b2_) = std::tie(polynomial[0], polynomial[1], polynomial[2]);
      scale_ = sum;
    }
    const Vec2 p1 = curve.p1, p2 = curve.p2, back = p2 - p1;
    x_ = from_nearer_end([&] { return b1_ * p1.x + b2_ * p2.x; },
                         [&] { return b0_ * p2.x + b1_ * back.x; });
    y_ = from_nearer_end([&] { return b1_ * p1.y + b2_ * p2.y; },
                         [&] { return b0_ * p2.y + b1_ * back.y; });
  }

  DiskPair disks() const {
    return {
        from_nearer_end([&] { return curve_.origin.x + x_; }, [&] { return curve_.end.x - x_; }),
        from_nearer_end([&] { return curve_.origin.y + y_; }, [&] { return curve_.end.y - y_; }),
        b0_ * curve_.r0 + b1_ * curve_.r1 + b2_ * curve_.r2};
  }

  /// The first and second derivatives of a coordinate with these control points relative to the
  /// first one, which has this value: see Curve::derivatives().
  std::array<Pair, 2> derivatives(double c1, double c2, Pair value) const {
    const double w = curve_.weight;
    if (w == 1) return {2 * (s_ - t_) * c1 + 2 * t_ * c2, both(2 * (c2 - 2 * c1))};
    const Pair scale_first = 2 * (w - 1) * (s_ - t_);
    const Pair first = (2 * (s_ - t_) * w * c1 + 2 * t_ * c2 - scale_first * value) / scale_;
    const double second = -4 * w * c1 + 2 * c2;
    return {first, (second - 2 * scale_first * first - 4 * (1 - w) * value) / scale_};
  }
  std::array<Pair, 2> x() const {
    return derivatives(curve_.p1.x, curve_.p2.x,
                       from_nearer_end([&] { return x_; }, [&] { return curve_.p2.x - x_; }));
  }
  std::array<Pair, 2> y() const {
    return derivatives(curve_.p1.y, curve_.p2.y,
                       from_nearer_end([&] { return y_; }, [&] { return curve_.p2.y - y_; }));
  }
  std::array<Pair, 2> radius() const {
    const double q1 = curve_.r1 - curve_.r0, q2 = curve_.r2 - curve_.r0;
    return derivatives(q1, q2, b1_ * q1 + b2_ * q2);
  }

 private:
  /// What one of these makes, for each parameter that of its nearer end. Mostly it is the same one.
  template <class FromStart, class FromEnd>
  Pair from_nearer_end(const FromStart& from_start, const FromEnd& from_end) const {
    if (all(by_start_)) return from_start();
    if (!any(by_start_)) return from_end();
    return by_start_ ? from_start() : from_end();
  }

  const Curve& curve_;
  Pair t_, s_;
  Pairwise by_start_;  ///< whether the start is the nearer end
  Pair scale_;         ///< the sum of the weighted Bernstein polynomials, unless the weight is 1
  Pair b0_, b1_, b2_;  ///< these, divided by it
  Pair x_, y_;         ///< from the nearer end
};

/// The derivatives of an edge's curve at two parameters.
struct Derivatives {
  std::array<Pair, 2> x, y, radius;  ///< first, second
  Pair square;                       ///< of the speed
  Pair cross, along;                 ///< of the first and the second ones

  explicit Derivatives(const PairOnCurve& curve)
      : x(curve.x()), y(curve.y()), radius(curve.radius()) {
    square = x[0] * x[0] + y[0] * y[0];
    cross = x[0] * y[1] - y[0] * x[1];
    along = x[0] * x[1] + y[0] * y[1];
  }
};

/// Whether illegality() is 0, by its main terms, multiplied by powers of the speed.
bool is_legal(const Derivatives& d, Pair radius, double delta) {
  const Pair speed = root_of(d.square), slope = d.radius[0], first_error = both(8 * delta);
  const Pair rest = d.square - slope * slope, height = larger(rest, both(0));
  const Pair bend = d.square * d.radius[1] - slope * d.along;
  const Pair bound = d.square * (rest + 4 * first_error * speed) - radius * bend;
  const Pair turn = d.cross * radius;
  return all((size_of(slope) <= speed + first_error) & (bound > 0) &
             (turn * turn * height < bound * bound));
}

/// By how much an edge breaks Shaked and Bruckstein's conditions (9) and (10),
///   |R'| <= 1   and   1 - R'^2 - R R'' >= |K| R sqrt(1 - R'^2),
/// with the derivatives by arc length and the curvature K at a parameter, beyond what the tolerance
/// leaves open.
///
/// At a vertex (10) is an equation, so what remains is rounding: control points that are `delta`
/// off change R' by about delta / speed, and R'' and K by delta / speed^2. Where that is not small
/// against 1, the edge is too short for its derivatives to mean anything.
Pair illegality(const Derivatives& d, Pair radius, double delta) {
  const Pair speed = root_of(d.square), first_error = 8 * delta / speed;
  const Pair second_error = 8 * delta / (speed * speed);
  const Pair slope = d.radius[0] / speed;
  // The root is the less certain the closer it is to 0: sqrt(x + e) - sqrt(x) <= sqrt(e).
  const Pair root_error = root_of(4 * first_error);
  const Pair root = root_of(larger((1 - slope) * (1 + slope), both(0)));
  const Pair curvature = size_of(d.cross) / (speed * speed * speed);
  const Pair error = 4 * first_error + 2 * radius * second_error +
                     curvature * radius * smaller(4 * first_error / root, root_error);
  const Pair along = d.along / speed;
  const Pair bend = (d.radius[1] - slope * along) / (speed * speed);
  const Pair cauchy = size_of(slope) - 1;
  const Pair balance = curvature * radius * root - ((1 - slope) * (1 + slope) - radius * bend);
  const Pair worse = larger(balance - error, larger(cauchy - first_error, both(0)));
  return ((speed > 0) & (error < 0.1)) ? worse : both(0);
}

class EdgeSamples {
 public:
  EdgeSamples(const Problem& problem, const DistanceTree& boundary, std::uint32_t index,
              const NearEdges* near, Findings& findings)
      : problem_(problem),
        boundary_(boundary),
        index_(index),
        edge_(problem.axis.edges[index]),
        curve_(curve_of(problem.axis, edge_)),
        left_(problem.axis.sites[edge_.site[0]], arc_of(problem, edge_.site[0])),
        right_(problem.axis.sites[edge_.site[1]], arc_of(problem, edge_.site[1])),
        near_(near),
        findings_(findings) {
    places_.tolerance = problem.tolerance;
  }

  MEDIAL_WIDE void run(std::span<const Parameters> samples,
                       const std::array<std::uint32_t, 2>& counted) {
    const Disk &from = problem_.disk(edge_.node[0]), &to = problem_.disk(edge_.node[1]);
    const DiskPair ends{
        {from.center.x, to.center.x}, {from.center.y, to.center.y}, {from.radius, to.radius}};
    const Pair known = measure_contacts(ends, 2);
    for (std::size_t end = 0; end < 2; ++end)
      if (counted[end] != no_index) add(ends, known, end, counted[end]);
    for (const Parameters& at : samples) {
      const PairOnCurve place(curve_, at);
      const DiskPair disks = place.disks();
      const Pair nearest = measure_contacts(disks, at.count);
      if (const Derivatives d(place); !is_legal(d, disks.radius, problem_.tolerance))
        add_worst(findings_.legality, illegality(d, disks.radius, problem_.tolerance), 0, disks,
                  at.count);
      for (std::size_t i = 0; i < at.count; ++i) add(disks, nearest, i, no_index);
    }
    measure_places();
  }

 private:
  /// Of the first `count` of two disks.
  void add_worst(Worst& worst, Pair amount, double tolerance, const DiskPair& disks,
                 std::size_t count) {
    if (all(amount <= both(std::min(worst.value, tolerance)))) return;  // nearly always
    for (std::size_t i = 0; i < count; ++i)
      worst.add(amount[i], tolerance, disks[i].center, index_);
  }
  /// Measures the first `count` of two disks against both sites. The distances to the nearer one on
  /// the boundary.
  Pair measure_contacts(const DiskPair& disks, std::size_t count) {
    Pair nearest = both(std::numeric_limits<double>::infinity());
    for (std::size_t side = 0; side < 2; ++side) {
      const NearSite& site = side == 0 ? left_ : right_;
      const Pair distance = site.signed_distances(disks.x, disks.y);
      add_worst(findings_.contact, size_of(distance - disks.radius), problem_.tolerance, disks,
                count);
      if (problem_.place[edge_.site[side]] != no_index)
        nearest = smaller(size_of(distance), nearest);
    }
    return nearest;
  }
  void add(const DiskPair& disks, Pair known, std::size_t which, std::uint32_t node) {
    if (places_.size == Places::most) measure_places();
    const std::size_t i = places_.size++;
    places_.x[i] = disks.x[which];
    places_.y[i] = disks.y[which];
    places_.radius[i] = disks.radius[which];
    places_.distance[i] = known[which];
    node_[i] = node;
  }
  void measure_places() {
    if (places_.size % 2 == 1) places_.repeat_last();
    boundary_.find_distances(near_, places_);
    for (std::size_t i = 0; i < places_.size; ++i) {
      const bool inside = node_[i] == no_index, two = inside && i + 1 < places_.size;
      if (two && node_[i + 1] == no_index &&
          findings_.inside.are_better(problem_, pair_at(&places_.radius[i]),
                                      pair_at(&places_.distance[i]))) {
        findings_.inside.disks += 2;
        ++i;
        continue;
      }
      (inside ? findings_.inside : findings_.nodes)
          .add(problem_, {places_.place(i), places_.radius[i]}, places_.distance[i],
               inside ? index_ : node_[i]);
    }
    places_.size = 0;
  }

  const Problem& problem_;
  const DistanceTree& boundary_;
  const std::uint32_t index_;
  const Edge& edge_;
  const Curve curve_;
  const NearSite left_, right_;
  const NearEdges* near_;
  Findings& findings_;
  Places places_;
  std::array<std::uint32_t, Places::most> node_;  ///< or no_index
};

}  // namespace

std::vector<Parameters> parameters_of(int samples) {
  std::vector<Parameters> all;
  all.reserve(static_cast<std::size_t>(samples + 1) / 2);
  const auto parts = static_cast<double>(samples + 1);
  for (int k = 1; k <= samples; k += 2) {
    const bool two = k < samples;
    all.emplace_back(Pair{static_cast<double>(k), static_cast<double>(k + (two ? 1 : 0))} / parts,
                     two ? 2 : 1);
  }
  return all;
}

void measure_samples(const Problem& problem, const DistanceTree& boundary, std::uint32_t edge,
                     std::span<const Parameters> samples, const NearEdges* near,
                     const std::array<std::uint32_t, 2>& counted, Findings& findings) {
  EdgeSamples(problem, boundary, edge, near, findings).run(samples, counted);
}

}  // namespace medial::verify_detail
