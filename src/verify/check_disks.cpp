#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "axis/curve.h"
#include "medial/query.h"
#include "verify/checks.h"
#include "verify/distance_tree.h"
#include "verify/edge_samples.h"
#include "verify/whole_edge.h"

namespace medial::verify_detail {
namespace {

/// Fails the certificate if the worst value is over the limit, with a sentence made of these words.
void report_worst(const Worst& worst, const char* what, const char* which, const std::string& limit,
                  Certificate& certificate) {
  if (worst.over > 0)
    certificate.failures.push_back(
        sentence("%llu %s; the worst by %.3g at %s %zu near (%.17g, %.17g)%s.",
                 static_cast<unsigned long long>(worst.over), what, worst.value, which, worst.index,
                 worst.where.x, worst.where.y, limit.c_str()));
}

/// The largest number of points checked inside an edge.
constexpr int most_samples = 1 << 20;

/// The expected distance of the boundary from the centre of a disk.
double expected_distance(const Problem& problem, const Disk& disk) {
  return std::max(0.0, disk.radius) + problem.tolerance;
}

void measure_node(const Problem& problem, const DistanceTree& boundary, std::size_t node,
                  Measured& measured) {
  const Disk& disk = problem.axis.nodes[node].disk;
  measured.add(problem, disk, boundary.distance(disk.center, expected_distance(problem, disk)),
               node);
}

/// Checks, in the middle of an edge, that the feet are on the sides that the edge states: returns
/// the distance by which the left foot is on the right. The chord of the feet is perpendicular to
/// the edge. If the edge or the chord is not longer than a few tolerances, or than the rounding
/// error of the feet, its direction is meaningless.
double turned_by(const Problem& problem, const Edge& edge, const Curve& curve, Vec2 center) {
  constexpr double few = 64;
  const Vec2 tangent = curve.velocity(0.5);
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

/// Whether a foot on an arc may be anywhere, as for a disk next to its centre; or at an end where
/// the arc joins the next edge smoothly, so that either edge may have the foot. In the centre of
/// half a circle, both ends are equally near.
bool has_open_foot(const Problem& problem, std::uint32_t site, const BoundaryEdge& arc,
                   Vec2 center) {
  constexpr double few = 64;
  const std::uint32_t place = problem.place[site];
  if (place == no_index) return true;
  const double start = distance(center, arc.start), end = distance(center, arc.end);
  const auto may_pass_on = [&](double away, double other, std::uint32_t at) {
    return away <= other + problem.tolerance && problem.joint[at] != Joint::reflex;
  };
  return may_pass_on(start, end, place) || may_pass_on(end, start, problem.next[place]) ||
         few * problem.arcs[place].foot_slack(center, problem.tolerance) >= length_of(arc);
}

/// The largest amount by which the distance from a segment or arc exceeds the distance from its
/// carrier. If it is positive, the foot lies beyond an end, and a correct disk would touch the
/// vertex there instead.
double missed_beyond_ends(const Problem& problem, const Edge& edge, Vec2 center) {
  double most = 0;
  for (const std::uint32_t i : edge.site) {
    const Site& site = problem.axis.sites[i];
    if (site.kind() == SiteKind::vertex) continue;
    const BoundaryEdge whole = edge_of(site);
    if (site.kind() == SiteKind::arc && has_open_foot(problem, i, whole, center)) continue;
    most = std::max(most,
                    distance_to_edge(center, whole) - std::abs(distance_to_carrier(center, whole)));
  }
  return most;
}

/// Whether turned_by() and missed_beyond_ends() are 0 up to rounding: seen from the middle of the
/// edge, where the tangent is parallel to the chord, each site has its foot in its interior and on
/// the side that the edge states.
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

/// Predicts places where very many boundary edges are near disks, such as the centre of a round
/// polygon.
class Crowd {
 public:
  /// Whether the next edge is assumed to be in a crowd. The more previous edges were in it, the
  /// more are assumed to be.
  bool is_expected() { return left_ > 0 && left_-- > 0; }
  void found(bool here) {
    seen_ = here ? std::min(2 * seen_ + 1, 64) : 0;
    left_ = here ? seen_ - 1 : 0;
  }

 private:
  int seen_ = 0, left_ = 0;
};

/// Caches whether the disk of a node reaches over a boundary edge by more than the tolerance,
/// because in a crowd, very many edges of the axis may share a node.
class Depths {
 public:
  explicit Depths(std::size_t nodes) : is_shallow_(nodes) {}

  void set(std::uint32_t node, bool is_shallow) {
    is_shallow_[node].store(is_shallow ? 1 : -1, std::memory_order_relaxed);
  }
  template <class Find>
  bool is_shallow(std::uint32_t node, const Find& find) {
    if (const int known = is_shallow_[node].load(std::memory_order_relaxed); known != 0)
      return known > 0;
    const bool found = find();
    set(node, found);
    return found;
  }

 private:
  std::vector<std::atomic<std::int8_t>> is_shallow_;  ///< 0: not known
};

/// The findings of consecutive edges.
struct Block {
  Findings findings;
  Crowd crowd;
};

/// The checks of one edge. A node is measured with the first of its edges.
class EdgeCheck {
 public:
  EdgeCheck(const Problem& problem, const DistanceTree& boundary, std::uint32_t index,
            Depths& depths, Block& block)
      : problem_(problem),
        boundary_(boundary),
        index_(index),
        edge_(problem.axis.edges[index]),
        hull_{problem.disk(edge_.node[0]), edge_.control, problem.disk(edge_.node[1])},
        findings_(block.findings),
        crowd_(block.crowd),
        depths_(depths) {
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t at = problem.place[edge_.site[side]];
      if (at == no_index) continue;
      const bool vertex = problem.axis.sites[edge_.site[side]].kind() == SiteKind::vertex;
      own_[side] = {at, vertex ? problem.before(at) : no_index, vertex ? at : problem.next[at]};
    }
  }

  void run(int samples, std::span<const Parameters> parameters,
           const std::vector<std::uint32_t>& first_edge) {
    std::array<std::uint32_t, 2> counted{no_index, no_index};
    for (std::size_t end = 0; end < 2; ++end) {
      const std::uint32_t node = edge_.node[end];
      if (first_edge[node] == index_ && (end == 0 || node != edge_.node[0])) counted[end] = node;
    }
    if (is_in_crowd()) {
      measure_in_crowd(parameters, counted);
    } else if (leave_nearer(); is_proven()) {
      for (const std::uint32_t node : counted) findings_.nodes.disks += node != no_index ? 1 : 0;
      findings_.inside.disks += static_cast<std::uint64_t>(samples);
    } else {
      measure_samples(problem_, boundary_, index_, parameters, &near_, counted, findings_);
    }
    const Curve curve = curve_of(problem_.axis, edge_);
    const Vec2 middle = curve.at(0.5).center;
    if (feet_are_right(problem_, edge_, curve.p2, middle)) return;
    findings_.turned.add(turned_by(problem_, edge_, curve, middle), problem_.tolerance, middle,
                         index_);
    findings_.contact.add(missed_beyond_ends(problem_, edge_, middle), problem_.tolerance, middle,
                          index_);
  }

 private:
  /// Whether too many boundary edges are near disks; otherwise, finds them.
  bool is_in_crowd() {
    if (crowd_.is_expected()) return true;
    const bool found = boundary_.find_near(hull_, problem_.tolerance, near_);
    crowd_.found(!found);
    return !found;
  }
  /// Measures samples if too many boundary edges are near disks. If both disks at the ends reach
  /// over none by more than the tolerance, only the edges between their feet matter.
  void measure_in_crowd(std::span<const Parameters> parameters,
                        const std::array<std::uint32_t, 2>& counted) {
    bool is_shallow = edge_.weight > 0;
    for (std::size_t end = 0; end < 2; ++end)
      is_shallow &= measure_end(edge_.node[end], counted[end] != no_index);
    near_.size = 0;
    const bool found =
        is_shallow && boundary_.find_near_between_feet(hull_, problem_.tolerance, near_);
    if (found) leave_nearer();
    measure_samples(problem_, boundary_, index_, parameters, found ? &near_ : nullptr,
                    {no_index, no_index}, findings_);
  }
  /// Whether the disk of a node reaches over no boundary edge by more than the tolerance.
  bool measure_end(std::uint32_t node, bool counted) {
    const Disk& disk = problem_.disk(node);
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * diagonal(problem_.box);
    const double least = disk.radius - problem_.tolerance + rounding;
    if (!counted)
      return depths_.is_shallow(
          node, [&] { return least < 0 || boundary_.is_farther(disk.center, least); });
    const double distance = boundary_.distance(disk.center, expected_distance(problem_, disk));
    findings_.nodes.add(problem_, disk, distance, node);
    depths_.set(node, distance > least);
    return distance > least;
  }
  /// Keeps only those near edges that may be nearer than the sites.
  void leave_nearer() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < near_.size; ++i) {
      if (is_no_nearer(near_.index[i])) continue;
      near_.place[kept] = near_.place[i];
      near_.index[kept++] = near_.index[i];
    }
    near_.size = kept;
  }
  /// Whether a boundary edge is a site, or is straight and entirely behind its end, which is a
  /// site.
  bool is_no_nearer(std::uint32_t place) const {
    for (const Own& own : own_) {
      if (place == own.at && (!own.is_vertex() || is_behind(problem_.edge(place)))) return true;
      if (place == own.before && is_behind(problem_.edge(place).reversed())) return true;
    }
    return false;
  }
  /// Whether the whole edge of the axis lies behind the start of a straight boundary edge, which is
  /// then its nearest point.
  bool is_behind(const BoundaryEdge& edge) const {
    return edge.bulge == 0 && std::all_of(hull_.begin(), hull_.end(), [&](const Disk& disk) {
             return dot(edge.chord(), disk.center - edge.start) <= 0;
           });
  }

  /// Whether bounds prove, without samples, that all disks of the edge touch its sites and reach
  /// over no other boundary edge, within the tolerance. Then they are legal, too.
  bool is_proven() {
    if (!(edge_.weight > 0) || own_[0].at == no_index || own_[1].at == no_index) return false;
    for (const Disk& disk : hull_)
      if (!(disk.radius >= 0)) return false;
    const double tolerance = problem_.tolerance;
    const WholeEdge whole(hull_, edge_.weight);
    double gap = 0, intrusion = 0;
    for (const std::uint32_t site : edge_.site)
      gap = std::max(gap, whole.contact_gap(problem_.axis.sites[site], arc_of(problem_, site)));
    if (!(gap <= tolerance)) return false;
    for (std::size_t i = 0; i < near_.size; ++i) {
      intrusion = std::max(intrusion, intrusion_of(whole, near_.index[i]));
      if (!(gap + intrusion <= tolerance)) return false;
    }
    findings_.contact.add(gap, tolerance, hull_[0].center, index_);
    findings_.inside.residual.add(gap + intrusion, tolerance, hull_[0].center, index_);
    findings_.inside.intrusion.add(gap + intrusion, tolerance, hull_[0].center, index_);
    return true;
  }
  /// A bound for the distance by which disks that touch the sites reach over a boundary edge.
  double intrusion_of(const WholeEdge& whole, std::uint32_t place) const {
    const BoundaryEdge edge = problem_.edge(place);
    const Arc* const arc = edge.bulge != 0 ? &problem_.arcs[place] : nullptr;
    double least = std::numeric_limits<double>::infinity();
    const auto is_found = [&](double bound) {
      least = std::min(least, bound);
      return least <= problem_.tolerance;
    };
    // Its nearest point may be an end of a site, an interior point, or another end.
    const bool at_start = is_end_of_site(place), at_end = is_end_of_site(problem_.next[place]);
    if ((at_start && is_found(whole.nearer_than_end(edge, arc, true))) ||
        (at_end && is_found(whole.nearer_than_end(edge, arc, false))) ||
        is_found(whole.intrusion(edge, arc)) ||
        is_found(whole.nearer_than_end(edge, arc, true) + whole.intrusion(edge.start)))
      return least;
    is_found(whole.nearer_than_end(edge, arc, false) + whole.intrusion(edge.end));
    return least;
  }
  /// Whether a point is a site or an end of a site.
  bool is_end_of_site(std::uint32_t point) const {
    const auto ends_there = [&](const Own& own) { return point == own.at || point == own.end; };
    return ends_there(own_[0]) || ends_there(own_[1]);
  }

  const Problem& problem_;
  const DistanceTree& boundary_;
  const std::uint32_t index_;
  const Edge& edge_;
  const DiskHull hull_;
  Findings& findings_;
  Crowd& crowd_;
  Depths& depths_;
  /// The place of a site on the boundary, or no_index.
  struct Own {
    std::uint32_t at = no_index;      ///< the vertex, or where the edge begins
    std::uint32_t before = no_index;  ///< of a vertex: the edge that ends there
    std::uint32_t end = no_index;     ///< of an edge
    bool is_vertex() const { return before != no_index; }
  };
  std::array<Own, 2> own_;
  NearEdges near_;
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
  Depths depths(axis.nodes.size());
  const auto blocks =
      in_blocks<Block>(axis.edges.size(), block_size, [&](std::size_t i, Block& block) {
        EdgeCheck(problem, boundary, static_cast<std::uint32_t>(i), depths, block)
            .run(samples, parameters, first_edge);
      });
  Findings all;
  for (const Block& block : blocks) all.add(block.findings);
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
