#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "axis/curve.h"
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
  explicit NearSite(const Site& site)
      : edge_(edge_of(site)), segment_(site.start, site.end), is_point_(site.start == site.end) {}

  /// Negative where p lies behind an edge, seen from the interior.
  double signed_distance(Vec2 p) const {
    if (is_point_) return distance(edge_.start, p);
    if (edge_.bulge == 0) return segment_.signed_distance(p);
    const double d = distance_to_edge(p, edge_);
    return distance_to_carrier(p, edge_) < 0 ? -d : d;
  }

 private:
  BoundaryEdge edge_;
  Segment segment_;
  bool is_point_;
};

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

/// Curve::derivatives(), by fewer steps where the curve is a polynomial.
Curve::Derivatives derivatives_of(const Curve& curve, double t) {
  if (curve.weight != 1) return curve.derivatives(t);
  const double s = 1 - t, q1 = curve.r1 - curve.r0, q2 = curve.r2 - curve.r0;
  return {2 * (s - t) * curve.p1 + 2 * t * curve.p2, 2 * (curve.p2 - 2 * curve.p1),
          2 * (s - t) * q1 + 2 * t * q2, 2 * (q2 - 2 * q1)};
}

/// By how much an edge breaks Shaked and Bruckstein's conditions (9) and (10),
///   |R'| <= 1   and   1 - R'^2 - R R'' >= |K| R sqrt(1 - R'^2),
/// with the derivatives by arc length and the curvature K at parameter t, beyond what the tolerance
/// leaves open.
///
/// At a vertex (10) is an equation, so what remains is rounding: control points that are `delta`
/// off change R' by about delta / speed, and R'' and K by delta / speed^2. Where that is not small
/// against 1, the edge is too short for its derivatives to mean anything.
double illegality(const Curve& curve, double t, double radius, double delta) {
  const Curve::Derivatives d = derivatives_of(curve, t);
  const double speed = norm(d.first);
  if (!(speed > 0)) return 0;
  const double first_error = 8 * delta / speed;
  const double second_error = 8 * delta / (speed * speed);
  const double slope = d.radius_first / speed;
  // The root is the less certain the closer it is to 0: sqrt(x + e) - sqrt(x) <= sqrt(e).
  const double root_error = std::sqrt(4 * first_error);
  const double root = std::sqrt(std::max(0.0, (1 - slope) * (1 + slope)));
  const double curvature = std::abs(cross(d.first, d.second)) / (speed * speed * speed);
  const double error = 4 * first_error + 2 * radius * second_error +
                       curvature * radius * std::min(root_error, 4 * first_error / root);
  if (!(error < 0.1)) return 0;
  const double along = dot(d.first, d.second) / speed;
  const double bend = (d.radius_second - slope * along) / (speed * speed);
  const double cauchy = std::abs(slope) - 1;
  const double balance = curvature * radius * root - ((1 - slope) * (1 + slope) - radius * bend);
  return std::max({0.0, cauchy - first_error, balance - error});
}

/// Whether the feet lie on the sides that the edge says, seen from its middle: how far the left
/// foot lies on the right. The feet's chord is perpendicular to the edge; where the edge or the
/// chord is not longer than a few tolerances, or than rounding moves the feet, its direction means
/// nothing.
double turned_by(const Problem& problem, const Edge& edge, const Curve& curve) {
  constexpr double few = 64;
  const double t = 0.5;
  const Vec2 tangent = derivatives_of(curve, t).first;
  const Vec2 center = curve.at(t).center;
  const Site& left = problem.axis.sites[edge.site[0]];
  const Site& right = problem.axis.sites[edge.site[1]];
  const Vec2 chord = foot(left, center) - foot(right, center);
  const double speed = norm(tangent);
  double slack = problem.tolerance;
  for (const Site& site : {left, right})
    if (site.kind() == SiteKind::arc)
      slack = std::max(slack, foot_slack(edge_of(site), center, problem.tolerance));
  if (speed <= few * problem.tolerance || norm(chord) <= few * slack) return 0;
  return -cross(tangent, chord) / speed;
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
        sites_{NearSite(problem.axis.sites[edge_.site[0]]),
               NearSite(problem.axis.sites[edge_.site[1]])},
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

  void run(int samples, const std::vector<std::uint32_t>& first_edge) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::uint32_t node = edge_.node[end];
      const double known = measure_contacts(problem_.disk(node));
      const bool is_first = first_edge[node] == index_ && (end == 0 || node != edge_.node[0]);
      if (is_first) add(problem_.disk(node), known, node);
    }
    for (int k = 1; k <= samples; ++k) {
      const double t = static_cast<double>(k) / (samples + 1);
      const Disk disk = curve_.at(t);
      add(disk, measure_contacts(disk), no_index);
      findings_.legality.add(illegality(curve_, t, disk.radius, problem_.tolerance), 0, disk.center,
                             index_);
    }
    measure_places();
    findings_.turned.add(turned_by(problem_, edge_, curve_), problem_.tolerance,
                         curve_.at(0.5).center, index_);
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

  /// Measures a disk against both sites. The distance to the nearer one on the boundary.
  double measure_contacts(const Disk& disk) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t side = 0; side < 2; ++side) {
      const double distance = sites_[side].signed_distance(disk.center);
      findings_.contact.add(std::abs(distance - disk.radius), problem_.tolerance, disk.center,
                            index_);
      if (on_boundary_[side]) nearest = std::min(nearest, std::abs(distance));
    }
    return nearest;
  }
  void add(const Disk& disk, double known, std::uint32_t node) {
    if (places_.size == Places::most) measure_places();
    const std::size_t i = places_.size++;
    places_.x[i] = disk.center.x;
    places_.y[i] = disk.center.y;
    places_.radius[i] = disk.radius;
    places_.distance[i] = known;
    node_[i] = node;
  }
  void measure_places() {
    boundary_.find_distances(places_);
    for (std::size_t i = 0; i < places_.size; ++i) {
      const bool inside = node_[i] == no_index;
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
  const std::array<NearSite, 2> sites_;
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
  const DistanceTree boundary(problem.shape);
  const std::vector<std::uint32_t> first_edge = first_edges(axis);
  const auto blocks =
      in_blocks<Findings>(axis.edges.size(), block_size, [&](std::size_t i, Findings& findings) {
        EdgeCheck(problem, boundary, static_cast<std::uint32_t>(i), findings)
            .run(samples, first_edge);
      });
  Findings all;
  for (const Findings& block : blocks) all.add(block);
  for (std::size_t i = 0; i < axis.nodes.size(); ++i)
    if (first_edge[i] == no_index) measure_node(problem, boundary, i, all.nodes);
  return all;
}

}  // namespace

void check_sampled_disks(const Problem& problem, Certificate& certificate) {
  const DistanceTree boundary(problem.shape);
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

  const std::string limit = sentence(", over %.3g", tolerance);
  const auto report = [&](const Worst& worst, const char* what, const char* which) {
    report_worst(worst, what, which, limit, certificate);
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
