#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
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

struct Findings {
  Worst residual, intrusion, contact, legality, turned, negative;
  std::uint64_t disks = 0;
  // Scratch of one edge: its sampled disks, and the boundary near them.
  std::vector<Disk> samples;
  std::vector<std::uint32_t> near;

  void add(const Findings& other) {
    residual.add(other.residual);
    intrusion.add(other.intrusion);
    contact.add(other.contact);
    legality.add(other.legality);
    turned.add(other.turned);
    negative.add(other.negative);
    disks += other.disks;
  }
};

/// Distance from p to a site; negative where p lies behind an edge, seen from the interior.
double signed_distance(const Site& site, Vec2 p) {
  if (site.start == site.end) return distance(site.start, p);
  const BoundaryEdge edge = edge_of(site);
  const double d = distance_to_edge(p, edge);
  return distance_to_carrier(p, edge) < 0 ? -d : d;
}

/// As far as the boundary is expected from the centre of a disk.
double expected_distance(const Problem& problem, const Disk& disk) {
  return std::max(0.0, disk.radius) + problem.tolerance;
}

/// Measures one disk against the whole boundary. `near`: as DistanceTree::distance() takes it.
void measure(const Problem& problem, const DistanceTree& boundary, const Disk& disk,
             std::size_t index, Findings& findings, std::span<const std::uint32_t> near = {}) {
  const double distance = boundary.distance(disk.center, expected_distance(problem, disk), near);
  ++findings.disks;
  findings.residual.add(std::abs(distance - disk.radius), problem.tolerance, disk.center, index);
  findings.intrusion.add(disk.radius - distance, problem.tolerance, disk.center, index);
  findings.negative.add(-disk.radius, problem.tolerance, disk.center, index);
}

/// The edges of the boundary that disks of one edge may touch; none if they are many.
void find_near(const Problem& problem, const DistanceTree& boundary, std::span<const Disk> disks,
               std::vector<std::uint32_t>& near) {
  constexpr std::size_t many = 16;
  near.clear();
  if (disks.empty()) return;
  const Vec2 middle = disks[disks.size() / 2].center;
  double reach = 0;
  for (const Disk& disk : disks)
    reach = std::max(reach, expected_distance(problem, disk) + distance(middle, disk.center));
  boundary.near(middle, reach, many, near);
}

void measure_contact(const Problem& problem, const Edge& edge, const Disk& disk, std::size_t index,
                     Findings& findings) {
  for (const std::uint32_t site : edge.site) {
    const double gap = signed_distance(problem.axis.sites[site], disk.center) - disk.radius;
    findings.contact.add(std::abs(gap), problem.tolerance, disk.center, index);
  }
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
  const Curve::Derivatives d = curve.derivatives(t);
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
  const Vec2 tangent = curve.derivatives(t).first;
  const Vec2 center = curve.at(t).center;
  const Site& left = problem.axis.sites[edge.site[0]];
  const Site& right = problem.axis.sites[edge.site[1]];
  const Vec2 chord = foot(left, center) - foot(right, center);
  const double speed = norm(tangent);
  double slack = problem.tolerance;
  for (const Site& site : {left, right})
    if (site.kind == SiteKind::arc)
      slack = std::max(slack, foot_slack(edge_of(site), center, problem.tolerance));
  if (speed <= few * problem.tolerance || norm(chord) <= few * slack) return 0;
  return -cross(tangent, chord) / speed;
}

}  // namespace

void check_sampled_disks(const Problem& problem, Certificate& certificate) {
  const DistanceTree boundary(problem.shape);
  Findings nodes;
  for (const Findings& run : in_blocks<Findings>(
           problem.axis.nodes.size(), block_size, [&](std::size_t i, Findings&findings) {
             measure(problem, boundary, problem.axis.nodes[i].disk, i, findings);
           }))
    nodes.add(run);
  certificate.disks_checked = nodes.disks;
  certificate.largest_residual = nodes.residual.value;
  certificate.worst = nodes.residual.where;
  certificate.largest_intrusion = nodes.intrusion.value;
  const Worst& worst = nodes.residual;
  report_worst(worst, "nodes have a radius that is not the distance to the boundary", "node",
               sentence(", over half a pixel's diagonal, %.3g", problem.tolerance), certificate);
}

void check_disks(const Problem& problem, int samples_per_edge, Certificate& certificate) {
  const MedialAxis& axis = problem.axis;
  const double tolerance = problem.tolerance;
  const DistanceTree boundary(problem.shape);
  const int samples = std::clamp(samples_per_edge, 0, most_samples);

  Findings nodes, edges;
  for (const Findings& run :
       in_blocks<Findings>(axis.nodes.size(), block_size, [&](std::size_t i, Findings&findings) {
         measure(problem, boundary, axis.nodes[i].disk, i, findings);
       }))
    nodes.add(run);
  for (const Findings& run :
       in_blocks<Findings>(axis.edges.size(), block_size, [&](std::size_t i, Findings&findings) {
         const Edge& edge = axis.edges[i];
         const Curve curve = curve_of(axis, edge);
         for (const std::uint32_t node : edge.node)
           measure_contact(problem, edge, problem.disk(node), i, findings);
         std::vector<Disk>& disks = findings.samples;
         disks.clear();
         for (int k = 1; k <= samples; ++k)
           disks.push_back(curve.at(static_cast<double>(k) / (samples + 1)));
         find_near(problem, boundary, disks, findings.near);
         for (int k = 1; k <= samples; ++k) {
           const double t = static_cast<double>(k) / (samples + 1);
           const Disk& disk = disks[static_cast<std::size_t>(k - 1)];
           measure(problem, boundary, disk, i, findings, findings.near);
           measure_contact(problem, edge, disk, i, findings);
           findings.legality.add(illegality(curve, t, disk.radius, tolerance), 0, disk.center, i);
         }
         findings.turned.add(turned_by(problem, edge, curve), tolerance, curve.at(0.5).center, i);
       }))
    edges.add(run);

  Worst residual = nodes.residual;
  residual.add(edges.residual);
  certificate.disks_checked = nodes.disks + edges.disks;
  certificate.largest_residual = residual.value;
  certificate.worst = residual.where;
  certificate.largest_intrusion = std::max(nodes.intrusion.value, edges.intrusion.value);
  certificate.largest_contact_gap = edges.contact.value;
  certificate.worst_legality = edges.legality.value;

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
  report(edges.contact, "disks of edges do not touch a site of their edge", "edge");
  report(edges.turned, "edges have their sites on the wrong sides", "edge");
  report_worst(edges.legality,
               "points inside edges break Shaked and Bruckstein's conditions on a branch", "edge",
               "", certificate);
}

}  // namespace medial::verify_detail
