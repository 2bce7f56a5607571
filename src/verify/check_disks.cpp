#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "axis/curve.h"
#include "base/wide.h"
#include "medial/query.h"
#include "verify/checks.h"
#include "verify/distance_tree.h"

namespace medial::verify_detail {
namespace {

/// Fails the certificate if something of `which` parts is `what`, over a limit in words.
void report_worst(const Worst& worst, const char* what, const char* which, const std::string& limit,
                  Certificate& certificate) {
  if (worst.over > 0)
    certificate.failures.push_back(
        sentence("%llu %s; the worst by %.3g at %s %zu near (%.17g, %.17g)%s.",
                 static_cast<unsigned long long>(worst.over), what, worst.value, which, worst.index,
                 worst.where.x, worst.where.y, limit.c_str()));
}

/// The most points inside an edge that are checked.
constexpr int most_samples = 1 << 20;

/// What the disks of nodes, or those inside edges, are measured against the boundary for.
struct Measured {
  Worst residual, intrusion, negative;
  std::uint64_t disks = 0;

  /// Whether two disks are no worse than what is known.
  bool are_better(const Problem& problem, Pair radius, Pair distance) const {
    const auto within = [&](Pair amount, const Worst& worst) {
      return amount <= both(std::min(worst.value, problem.tolerance));
    };
    return all(within(size_of(distance - radius), residual) & within(radius - distance, intrusion) &
               within(-radius, negative));
  }
  void add(const Problem& problem, const Disk& disk, double distance, std::size_t index) {
    ++disks;
    residual.add(std::abs(distance - disk.radius), problem.tolerance, disk.center, index);
    intrusion.add(disk.radius - distance, problem.tolerance, disk.center, index);
    negative.add(-disk.radius, problem.tolerance, disk.center, index);
  }
  void add(const Measured& other) {
    residual.add(other.residual);
    intrusion.add(other.intrusion);
    negative.add(other.negative);
    disks += other.disks;
  }
};

struct Findings {
  Measured nodes, inside;
  Worst contact, legality, turned;

  void add(const Findings& other) {
    nodes.add(other.nodes);
    inside.add(other.inside);
    contact.add(other.contact);
    legality.add(other.legality);
    turned.add(other.turned);
  }
};

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

/// The arc of a site, if it is one of the boundary.
const Arc* arc_of(const Problem& problem, std::uint32_t site) {
  const std::uint32_t place = problem.place[site];
  const bool is_known = place != no_index && problem.axis.sites[site].kind() == SiteKind::arc;
  return is_known ? &problem.arcs[place] : nullptr;
}

/// As far as the boundary is expected from the centre of a disk.
double expected_distance(const Problem& problem, const Disk& disk) {
  return std::max(0.0, disk.radius) + problem.tolerance;
}

void measure_node(const Problem& problem, const DistanceTree& boundary, std::size_t node,
                  Measured& measured) {
  const Disk& disk = problem.axis.nodes[node].disk;
  measured.add(problem, disk, boundary.distance(disk.center, expected_distance(problem, disk)),
               node);
}

/// Two disks of an edge.
struct DiskPair {
  Pair x, y, radius;

  Disk operator[](std::size_t i) const { return {{x[i], y[i]}, radius[i]}; }
};

/// Two parameters of a curve, and the Bernstein polynomials there for curves of weight 1, which
/// most edges are.
struct Parameters {
  Pair t, s;
  std::array<Pair, 3> polynomial;
  std::size_t count;  ///< 1 where both are the same

  Parameters(Pair at, std::size_t the_count) : t(at), s(1 - at), count(the_count) {
    polynomial = weighted(1).first;
  }
  /// The weighted polynomials, divided by their sum, and that.
  std::pair<std::array<Pair, 3>, Pair> weighted(double weight) const {
    const Pair sum = s * s + 2 * s * t * weight + t * t;
    return {{s * s / sum, 2 * s * t * weight / sum, t * t / sum}, sum};
  }
};

/// The parameters of `samples` disks inside an edge.
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
  return (speed > 0) & (error < 0.1) ? worse : both(0);
}

/// Whether the feet lie on the sides that the edge says, seen from its middle: how far the left
/// foot lies on the right. The feet's chord is perpendicular to the edge; where the edge or the
/// chord is not longer than a few tolerances, or than rounding moves the feet, its direction means
/// nothing.
double turned_by(const Problem& problem, const Edge& edge, const Curve& curve, Vec2 center) {
  constexpr double few = 64;
  const Vec2 tangent = curve.derivatives(0.5).first;
  const Site& left = problem.axis.sites[edge.site[0]];
  const Site& right = problem.axis.sites[edge.site[1]];
  const Vec2 chord = foot(left, center) - foot(right, center);
  const double speed = norm(tangent);
  double slack = problem.tolerance;
  for (const std::uint32_t site : edge.site)
    if (problem.axis.sites[site].kind() == SiteKind::arc)
      slack = std::max(slack, with_arc(problem, site, [&](const Arc& arc) {
                         return arc.foot_slack(center, problem.tolerance);
                       }));
  if (speed <= few * problem.tolerance || norm(chord) <= few * slack) return 0;
  return -cross(tangent, chord) / speed;
}

/// By how much a disk misses the lines of its segments: where its foot lies beyond the end of one,
/// the vertex there is touched instead. Not of arcs: next to the centre of one, the foot may be
/// anywhere, and it may have a smooth joint at its end.
double missed_beyond_ends(const Problem& problem, const Edge& edge, Vec2 center) {
  double most = 0;
  for (const std::uint32_t i : edge.site) {
    const Site& site = problem.axis.sites[i];
    if (site.kind() != SiteKind::segment) continue;
    const BoundaryEdge whole = edge_of(site);
    most = std::max(most,
                    distance_to_edge(center, whole) - std::abs(distance_to_carrier(center, whole)));
  }
  return most;
}

/// Whether turned_by() and missed_beyond_ends() are 0, or due to rounding: seen from the middle of
/// the edge, whose tangent has the direction of its chord there, each site has its foot inside it
/// and on the side that the edge says.
bool feet_are_right(const Problem& problem, const Edge& edge, Vec2 chord, Vec2 center) {
  for (std::size_t side = 0; side < 2; ++side) {
    const Site& site = problem.axis.sites[edge.site[side]];
    const Vec2 to = site.start - center, along = site.end - site.start;
    const Vec2 ahead = side == 0 ? chord : -chord;
    if (site.kind() == SiteKind::vertex) {
      if (!(cross(ahead, to) > 0)) return false;
    } else if (site.kind() == SiteKind::segment) {
      if (!(dot(ahead, along) < 0 && cross(along, to) < 0 && dot(along, to) < 0 &&
            dot(along, site.end - center) > 0))
        return false;
    } else {
      const Arc* const arc = arc_of(problem, edge.site[side]);
      if (arc == nullptr || !arc->is_beside(center)) return false;
      const Vec2 from = arc->from_center(center);  // the way to the foot
      const bool in_front = (squared_norm(from) < 1) == (site.bulge > 0);
      if (!(in_front && cross(ahead, from) > 0)) return false;
    }
  }
  return true;
}

/// The checks of one edge. A node is measured with the first of its edges.
class EdgeCheck {
 public:
  EdgeCheck(const Problem& problem, const DistanceTree& boundary, std::uint32_t index,
            Findings& findings)
      : problem_(problem),
        boundary_(boundary),
        index_(index),
        edge_(problem.axis.edges[index]),
        curve_(curve_of(problem.axis, edge_)),
        left_(problem.axis.sites[edge_.site[0]], arc_of(problem, edge_.site[0])),
        right_(problem.axis.sites[edge_.site[1]], arc_of(problem, edge_.site[1])),
        findings_(findings) {
    places_.hull = {problem.disk(edge_.node[0]), edge_.control, problem.disk(edge_.node[1])};
    places_.tolerance = problem.tolerance;
    places_.known.fill(Places::no_edge);
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t place = problem.place[edge_.site[side]];
      on_boundary_[side] = place != no_index;
      if (!on_boundary_[side]) continue;
      if (problem.axis.sites[edge_.site[side]].kind() != SiteKind::vertex) {
        places_.known[side] = place;
        continue;
      }
      // From behind its normal at the vertex, nothing of an edge next to it is nearer.
      if (is_behind(problem.edge(place))) places_.known[side] = place;
      const std::uint32_t before = problem.before(place);
      if (is_behind(problem.edge(before).reversed())) places_.known[2 + side] = before;
    }
  }

  MEDIAL_WIDE void run(std::span<const Parameters> samples,
                       const std::vector<std::uint32_t>& first_edge) {
    const Disk &from = problem_.disk(edge_.node[0]), &to = problem_.disk(edge_.node[1]);
    const DiskPair ends{
        {from.center.x, to.center.x}, {from.center.y, to.center.y}, {from.radius, to.radius}};
    const Pair known = measure_contacts(ends, 2);
    for (std::size_t end = 0; end < 2; ++end) {
      const std::uint32_t node = edge_.node[end];
      const bool is_first = first_edge[node] == index_ && (end == 0 || node != edge_.node[0]);
      if (is_first) add(ends, known, end, node);
    }
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
    const Vec2 middle = curve_.at(0.5).center;
    if (feet_are_right(problem_, edge_, curve_.p2, middle)) return;
    findings_.turned.add(turned_by(problem_, edge_, curve_, middle), problem_.tolerance, middle,
                         index_);
    findings_.contact.add(missed_beyond_ends(problem_, edge_, middle), problem_.tolerance, middle,
                          index_);
  }

 private:
  /// Whether the whole edge of the axis lies behind where a straight boundary edge begins, so that
  /// this is its nearest point.
  bool is_behind(const BoundaryEdge& edge) const {
    return edge.bulge == 0 &&
           std::all_of(places_.hull.begin(), places_.hull.end(), [&](const Disk& disk) {
             return dot(edge.chord(), disk.center - edge.start) <= 0;
           });
  }

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
      if (on_boundary_[side]) nearest = smaller(size_of(distance), nearest);
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
    boundary_.find_distances(places_);
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
  Findings& findings_;
  std::array<bool, 2> on_boundary_;
  Places places_;
  std::array<std::uint32_t, Places::most> node_;  ///< or no_index
};

/// The first edge of each node, or no_index.
std::vector<std::uint32_t> first_edges(const MedialAxis& axis) {
  std::vector<std::uint32_t> first(axis.nodes.size(), no_index);
  for (std::size_t i = axis.edges.size(); i-- > 0;)
    for (const std::uint32_t node : axis.edges[i].node) first[node] = static_cast<std::uint32_t>(i);
  return first;
}

/// All disks of an axis.
Findings measure_all(const Problem& problem, int samples) {
  const MedialAxis& axis = problem.axis;
  const DistanceTree boundary(problem.shape, problem.box, problem.arcs);
  const std::vector<std::uint32_t> first_edge = first_edges(axis);
  const std::vector<Parameters> parameters = parameters_of(samples);
  const auto blocks =
      in_blocks<Findings>(axis.edges.size(), block_size, [&](std::size_t i, Findings& findings) {
        EdgeCheck(problem, boundary, static_cast<std::uint32_t>(i), findings)
            .run(parameters, first_edge);
      });
  Findings all;
  for (const Findings& block : blocks) all.add(block);
  for (std::size_t i = 0; i < axis.nodes.size(); ++i)
    if (first_edge[i] == no_index) measure_node(problem, boundary, i, all.nodes);
  return all;
}

}  // namespace

void check_sampled_disks(const Problem& problem, Certificate& certificate) {
  const DistanceTree boundary(problem.shape, problem.box, problem.arcs);
  Measured nodes;
  for (const Measured& block : in_blocks<Measured>(
           problem.axis.nodes.size(), block_size,
           [&](std::size_t i, Measured&measured) { measure_node(problem, boundary, i, measured); }))
    nodes.add(block);
  certificate.disks_checked = nodes.disks;
  certificate.largest_residual = nodes.residual.value;
  certificate.worst = nodes.residual.where;
  certificate.largest_intrusion = nodes.intrusion.value;
  const Worst& worst = nodes.residual;
  report_worst(worst, "nodes have a radius that is not the distance to the boundary", "node",
               sentence(", over the tolerance, %.3g", problem.tolerance), certificate);
}

void check_disks(const Problem& problem, int samples_per_edge, Certificate& certificate) {
  const double tolerance = problem.tolerance;
  const Findings found = measure_all(problem, std::clamp(samples_per_edge, 0, most_samples));
  const Measured &nodes = found.nodes, &edges = found.inside;

  Worst residual = nodes.residual;
  residual.add(edges.residual);
  certificate.disks_checked = nodes.disks + edges.disks;
  certificate.largest_residual = residual.value;
  certificate.worst = residual.where;
  certificate.largest_intrusion = std::max(nodes.intrusion.value, edges.intrusion.value);
  certificate.largest_contact_gap = found.contact.value;
  certificate.worst_legality = found.legality.value;

  const auto report = [&](const Worst& worst, const char* what, const char* which) {
    if (worst.over > 0)
      report_worst(worst, what, which, sentence(", over %.3g", tolerance), certificate);
  };
  report(nodes.intrusion, "nodes have disks that reach over the boundary", "node");
  report(nodes.residual, "nodes have a radius that is not the distance to the boundary", "node");
  report(edges.negative, "points inside edges have a negative radius", "edge");
  report(edges.intrusion, "points inside edges have disks that reach over the boundary", "edge");
  report(edges.residual,
         "points inside edges have a radius that is not the distance to the boundary", "edge");
  report(found.contact, "disks of edges do not touch a site of their edge", "edge");
  report(found.turned, "edges have their sites on the wrong sides", "edge");
  report_worst(found.legality,
               "points inside edges break Shaked and Bruckstein's conditions on a branch", "edge",
               "", certificate);
}

}  // namespace medial::verify_detail
