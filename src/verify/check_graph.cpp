#include <cmath>
#include <numbers>
#include <numeric>

#include "base/disjoint_sets.h"
#include "base/predicates.h"
#include "base/tolerance.h"
#include "shape/limits.h"
#include "verify/checks.h"
#include "verify/distance_tree.h"

namespace medial::verify_detail {
namespace {

bool finite(Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// Counts offences and keeps the first one, for one sentence about all.
struct Offences {
  std::size_t count = 0;
  std::size_t first = 0;
  void add(std::size_t i) {
    if (count++ == 0) first = i;
  }
};

const char* plural_s(std::uint64_t count) { return count == 1 ? "" : "s"; }

bool before(Vec2 a, Vec2 b) { return lexicographic_less(a, b); }

Joint joint_between(const BoundaryEdge& before, const BoundaryEdge& after, double tolerance,
                    double corner_angle) {
  if (before.bulge == 0 && after.bulge == 0) {
    const int turn = orientation(before.start, before.end, after.end);
    return turn > 0 ? Joint::corner : turn < 0 ? Joint::reflex : Joint::smooth;
  }
  return site::joint_of({before.start, before.end, before.bulge},
                        {after.start, after.end, after.bulge}, tolerance, corner_angle);
}

/// A corner or a leaf, which must agree.
struct Corner {
  Vec2 point;
  std::uint32_t component;
  friend bool operator<(const Corner& a, const Corner& b) {
    if (!(a.point == b.point)) return before(a.point, b.point);
    return a.component < b.component;
  }
  friend bool operator==(const Corner& a, const Corner& b) {
    return a.point == b.point && a.component == b.component;
  }
};

/// Whether no disk that touches two edges of a boundary, one of them a convex arc, is larger than
/// this one by more than the tolerance.
bool is_largest_between(const BoundaryEdge& before, const BoundaryEdge& after, const Disk& disk,
                        double tolerance) {
  const bool by_first = curvature(before) > curvature(after);
  const BoundaryEdge &rounder = by_first ? before : after, &other = by_first ? after : before;
  if (!(rounder.bulge > 0)) return false;
  const Arc arc(rounder);
  const double radius = 1 / arc.curvature();
  const Vec2 center = rounder.start - radius * arc.from_center(rounder.start);
  // The largest disk touches both at opposite points, on a line through the arc's centre.
  const double away = other.bulge != 0
                          ? Arc(other).carrier_distance(center)
                          : cross(other.chord(), center - other.start) / norm(other.chord());
  return disk.radius >= 0.5 * (radius + away) - tolerance;
}

/// Whether an edge may end with a radius above 0. The last disk must touch the boundary between its
/// two feet, which must be: a convex arc of locally largest curvature (because its circle lies
/// inside); or a blunt joint, whose leaf is omitted; or any joint except a corner, if no disk
/// farther on is larger; or a smooth joint that is convex within rounding, if the disk at the
/// edge's other end does not touch it within the tolerance of a computation (otherwise, the axis
/// would have ended there). Examines at most `budget` boundary edges and subtracts their number: no
/// two leaves of a correct axis examine the same edge.
bool ends_at_arc(const Problem& problem, const Edge& edge, std::size_t end, std::size_t& budget) {
  const auto place = [&](std::size_t side) { return problem.place[edge.site[side]]; };
  const auto is_vertex = [&](std::size_t side) {
    return problem.axis.sites[edge.site[side]].kind() == SiteKind::vertex;
  };
  // Ahead of the end, the boundary runs from the site on the right to the one on the left.
  const std::size_t right = end, left = 1 - end;
  if (place(right) == no_index || place(left) == no_index) return false;
  const Disk& disk = problem.disk(edge.node[end]);
  const std::uint32_t first = is_vertex(right) ? place(right) : problem.next[place(right)];
  const double own_tolerance = std::max(tolerance_for(problem.box, 0), problem.axis.tolerance);
  bool arcs = false, turns = false;
  double farthest = 0;
  OpenAtJoints open(problem, disk.radius);
  const Disk& other_end = problem.disk(edge.node[1 - end]);
  const auto deviation = [&](const BoundaryEdge& on) {
    double worst = 0;
    for (const Vec2 p : {on.start, apex(on), on.end})
      worst = std::max(worst, std::abs(distance(disk.center, p) - disk.radius));
    return worst;
  };
  const auto add_joint = [&](std::uint32_t i) {
    turns = turns || (problem.joint[i] == Joint::smooth &&
                      turn_between(problem.edge(problem.previous[i]), problem.edge(i)) > 0 &&
                      distance(other_end.center, problem.point(i)) - other_end.radius >
                          std::min(problem.tolerance, own_tolerance));
    open.add(i);
  };
  if (!is_vertex(right)) add_joint(first);
  for (std::uint32_t i = first; i != place(left); i = problem.next[i]) {
    if (budget == 0) return false;
    --budget;
    const BoundaryEdge passed = problem.edge(i);
    farthest = std::max(farthest, deviation(passed));
    arcs = arcs || passed.bulge > 0;
    if (problem.next[i] != place(left) || !is_vertex(left)) add_joint(problem.next[i]);
  }
  // Because of rounding, the axis may end on the bisector with the arc itself.
  const double limit = 2 * problem.tolerance + open.value();
  for (const std::size_t side : {right, left}) {
    const BoundaryEdge touched = problem.edge(place(side));
    arcs = arcs || (!is_vertex(side) && touched.bulge > 0 && deviation(touched) <= limit);
  }
  // Two edges that join bluntly have no branch between them, unless the disk touches one of them
  // entirely, or is the largest.
  bool blunt = open.value() > 0, largest = false;
  if (first == place(left) && !is_vertex(left) && !is_vertex(right)) {
    const BoundaryEdge before = problem.edge(place(right)), after = problem.edge(place(left));
    blunt = blunt && (deviation(before) <= limit || deviation(after) <= limit);
    largest = problem.joint[first] != Joint::corner &&
              is_largest_between(before, after, disk, problem.tolerance);
  }
  return (arcs || blunt || turns || largest) && farthest <= limit;
}

}  // namespace

bool check_shape(const Shape& shape, Certificate& certificate) {
  const std::size_t loops = shape.component.size();
  const bool arcs = !shape.bulges.empty();
  bool valid = shape.hole.size() == loops && shape.points.size() < no_index &&
               (!arcs || shape.bulges.size() == shape.points.size()) &&
               (loops == 0 ? shape.points.empty()
                           : shape.loop_begin.size() == loops + 1 && shape.loop_begin[0] == 0 &&
                                 shape.loop_begin[loops] == shape.points.size());
  const std::size_t components = valid ? shape.component_count() : 0;
  for (std::size_t i = 0; valid && i < loops; ++i)
    valid = shape.loop_begin[i] <= shape.loop_begin[i + 1] &&
            shape.loop(i).size() >= (arcs ? 2 : 3) && shape.component[i] < components;
  for (std::size_t i = 0; valid && i < shape.points.size(); ++i)
    valid = finite(shape.points[i]) && std::abs(shape.bulge(i)) <= 1;
  if (!valid)
    certificate.failures.push_back(
        "The shape itself is malformed: loops that do not fit its points or components, "
        "coordinates "
        "that are not finite, or bulges above 1.");
  if (!valid || shape.points.empty()) return valid;
  if (const auto error = beyond_limits(shape)) {
    certificate.failures.push_back("The shape cannot be checked: " + to_string(*error) + ".");
    return false;
  }
  return valid;
}

namespace {

/// Checks the tolerance and resolution that an axis states.
void check_claims(const Box& box, const MedialAxis& axis, Certificate& certificate) {
  constexpr double largest_relative = 1e-3;
  if (!(axis.resolution >= 0 && axis.resolution <= diagonal(box)))
    certificate.failures.push_back(
        sentence("The axis claims a resolution of %.3g, larger than the shape.", axis.resolution));
  // A tolerance is at most the largest one that compute() accepts, or that the spacing of
  // coordinates requires.
  if (!(axis.tolerance >= 0 &&
        axis.tolerance <= std::max(largest_relative * diagonal(box), 4 * spacing_in(box))))
    certificate.failures.push_back(sentence(
        "The axis claims a tolerance of %.3g, which no engine computes with.", axis.tolerance));
}

}  // namespace

bool check_values(const Shape& shape, const Box& box, const MedialAxis& axis,
                  Certificate& certificate) {
  const std::size_t before_count = certificate.failures.size();
  const auto report = [&](const Offences& offences, const char* what, const char* which) {
    if (offences.count > 0)
      certificate.failures.push_back(
          sentence("%zu %s; the first is %s %zu.", offences.count, what, which, offences.first));
  };
  if (axis.nodes.size() >= no_index || axis.edges.size() >= no_index ||
      axis.sites.size() >= no_index) {
    certificate.failures.push_back("The axis has more parts than 32-bit indices can name.");
    return false;
  }
  Offences nodes, radii, components;
  const std::size_t component_count = shape.component_count();
  for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
    const Node& node = axis.nodes[i];
    if (!finite(node.disk.center) || !std::isfinite(node.disk.radius))
      nodes.add(i);
    else if (node.disk.radius < 0)
      radii.add(i);
    if (node.component >= component_count) components.add(i);
  }
  report(nodes, "nodes have a coordinate or radius that is not finite", "node");
  report(radii, "nodes have a negative radius", "node");
  report(components, "nodes name a component that the shape does not have", "node");

  Offences sites;
  for (std::size_t i = 0; i < axis.sites.size(); ++i)
    if (!finite(axis.sites[i].start) || !finite(axis.sites[i].end) ||
        !(std::abs(axis.sites[i].bulge) <= 1))
      sites.add(i);
  report(sites, "sites have a coordinate that is not finite or a bulge above 1", "site");

  Offences node_indices, site_indices, curves, weights, twice;
  for (std::size_t i = 0; i < axis.edges.size(); ++i) {
    const Edge& edge = axis.edges[i];
    if (std::max(edge.node[0], edge.node[1]) >= axis.nodes.size()) node_indices.add(i);
    const bool untold = axis.resolution > 0 && edge.site[0] == no_site && edge.site[1] == no_site;
    if (!untold && std::max(edge.site[0], edge.site[1]) >= axis.sites.size()) site_indices.add(i);
    if (!untold && edge.site[0] == edge.site[1]) twice.add(i);
    if (!finite(edge.control.center) || !std::isfinite(edge.control.radius)) curves.add(i);
    if (!(edge.weight > 0) || !std::isfinite(edge.weight)) weights.add(i);
  }
  report(node_indices, "edges name a node that the axis does not have", "edge");
  report(site_indices, "edges name a site that the axis does not have", "edge");
  report(twice, "edges lie between a site and itself", "edge");
  report(curves, "edges have a control point that is not finite", "edge");
  report(weights, "edges have a weight that is not finite or not positive", "edge");
  check_claims(box, axis, certificate);
  return certificate.failures.size() == before_count;
}

namespace {

/// Computes the order of points on the boundary, and the joints.
void read_boundary(Problem& problem, double corner_angle, Certificate& certificate) {
  const Shape& shape = problem.shape;
  const auto count = static_cast<std::uint32_t>(shape.points.size());
  problem.next.resize(count);
  problem.previous.resize(count);
  problem.component.resize(count);
  problem.joint.resize(count);
  if (!shape.bulges.empty()) problem.blunt_angle.assign(count, 0);
  const double tolerance = tolerance_for(problem.box, 0);
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const std::uint32_t begin = shape.loop_begin[i], end = shape.loop_begin[i + 1];
    for (std::uint32_t j = begin; j < end; ++j) {
      problem.next[j] = j + 1 < end ? j + 1 : begin;
      problem.previous[j] = j > begin ? j - 1 : end - 1;
      problem.component[j] = shape.component[i];
    }
    for (std::uint32_t j = begin; j < end; ++j) {
      const std::uint32_t previous = j > begin ? j - 1 : end - 1;
      problem.joint[j] =
          joint_between(problem.edge(previous), problem.edge(j), tolerance, corner_angle);
      if (!problem.is_blunt(j)) continue;
      problem.blunt_angle[j] = turn_between(problem.edge(previous), problem.edge(j));
      ++certificate.blunt_joints;
      certificate.largest_blunt_angle = std::max(certificate.largest_blunt_angle,
                                                 problem.blunt_angle[j] * 180 / std::numbers::pi);
    }
  }
}

/// Finds the boundary points of sites. Sites usually are in boundary order, a vertex before the
/// edge that begins there, so the next points are tried first (several loops may touch at one
/// place). Otherwise, looks points up by their coordinates.
class PlaceFinder {
 public:
  explicit PlaceFinder(const Problem& problem) : problem_(problem), shape_(problem.shape) {}

  /// The point that a site is, or at which its edge begins; no_index if there is none.
  std::uint32_t place_of(const Site& site) {
    const auto count = static_cast<std::uint32_t>(shape_.points.size());
    std::uint32_t place = no_index;
    for (std::uint32_t i = next_; i < std::min(next_ + 2, count) && place == no_index; ++i)
      if (fits(site, i)) place = i;
    if (place == no_index) place = look_up(site);
    if (place != no_index) next_ = site.kind() == SiteKind::vertex ? place : place + 1;
    return place;
  }

 private:
  bool fits(const Site& site, std::uint32_t i) const {
    if (!(shape_.points[i] == site.start)) return false;
    if (site.kind() == SiteKind::vertex)
      return problem_.joint[i] == Joint::reflex || problem_.joint[i] == Joint::smooth;
    return shape_.points[problem_.next[i]] == site.end && shape_.bulge(i) == site.bulge;
  }

  std::uint32_t look_up(const Site& site) {
    if (sorted_.empty()) {
      sorted_.resize(shape_.points.size());
      std::iota(sorted_.begin(), sorted_.end(), 0U);
      std::sort(sorted_.begin(), sorted_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return before(shape_.points[a], shape_.points[b]);
      });
    }
    std::uint32_t place = no_index;
    auto found = std::lower_bound(
        sorted_.begin(), sorted_.end(), site.start,
        [&](std::uint32_t a, Vec2 point) { return before(shape_.points[a], point); });
    for (; found != sorted_.end() && shape_.points[*found] == site.start; ++found)
      if (fits(site, *found)) place = *found;
    return place;
  }

  const Problem& problem_;
  const Shape& shape_;
  std::vector<std::uint32_t> sorted_;  ///< points by their coordinates; made when first needed
  std::uint32_t next_ = 0;
};

void locate_sites(Problem& problem, Certificate& certificate) {
  const MedialAxis& axis = problem.axis;
  PlaceFinder finder(problem);
  Offences foreign;
  problem.place.resize(axis.sites.size());
  for (std::size_t s = 0; s < axis.sites.size(); ++s) {
    problem.place[s] = finder.place_of(axis.sites[s]);
    if (problem.place[s] == no_index) foreign.add(s);
  }
  if (foreign.count == 0) return;
  const Site& site = axis.sites[foreign.first];
  certificate.failures.push_back(sentence(
      "%zu sites are neither an edge nor a reflex vertex of the shape; the first is site %zu from "
      "(%.17g, %.17g) to (%.17g, %.17g).",
      foreign.count, foreign.first, site.start.x, site.start.y, site.end.x, site.end.y));
}

}  // namespace

void prepare(Problem& problem, double corner_angle, Certificate& certificate) {
  problem.arcs = arcs_of(problem.shape);
  read_boundary(problem, corner_angle, certificate);
  problem.degree.assign(problem.axis.nodes.size(), 0);
  for (const Edge& edge : problem.axis.edges)
    for (const std::uint32_t node : edge.node) ++problem.degree[node];
  locate_sites(problem, certificate);
}

namespace {

/// Counts of one component's part of the graph.
struct Count {
  std::uint64_t parts = 0, nodes = 0, edges = 0, holes = 0;
  std::uint64_t cycles() const { return edges + parts - nodes; }
};

struct Tally {
  std::vector<Count> counts;  ///< of each component
  Offences kinds;             ///< nodes whose kind does not fit the number of their edges
  Offences strangers;         ///< nodes connected with nodes of another component
  Offences foreign_sites;     ///< edges with a site of another component
};

Tally tally(const Problem& problem) {
  const Shape& shape = problem.shape;
  const MedialAxis& axis = problem.axis;
  Tally result;
  auto& [counts, kinds, strangers, foreign_sites] = result;
  const auto node_count = static_cast<std::uint32_t>(axis.nodes.size());
  DisjointSets sets(node_count);
  for (const Edge& edge : axis.edges) sets.join(edge.node[0], edge.node[1]);

  counts.resize(shape.component_count());
  for (std::size_t i = 0; i < shape.loop_count(); ++i)
    if (shape.hole[i]) ++counts[shape.component[i]].holes;
  std::vector<std::uint64_t> nodes_of(counts.size());
  for (const Node& node : axis.nodes) ++nodes_of[node.component];
  for (std::uint32_t i = 0; i < node_count; ++i) {
    const Node& node = axis.nodes[i];
    Count& count = counts[node.component];
    ++count.nodes;
    if (sets.find(i) == i) ++count.parts;
    if (axis.nodes[sets.find(i)].component != node.component) strangers.add(i);
    const std::uint32_t degree = problem.degree[i];
    // The axis of a circle is one node without edges; a single pixel may be a part.
    const bool alone =
        degree == 0 && (nodes_of[node.component] == 1 || axis.resolution > 0 || axis.exterior > 0);
    const bool fits = node.kind == NodeKind::leaf          ? degree == 1 || alone
                      : node.kind == NodeKind::site_change ? degree == 2
                      : node.kind == NodeKind::branching   ? degree >= 3
                                                           : false;
    if (!fits) kinds.add(i);
  }
  for (std::size_t i = 0; i < axis.edges.size(); ++i) {
    const Edge& edge = axis.edges[i];
    const std::uint32_t component = axis.nodes[edge.node[0]].component;
    ++counts[component].edges;
    for (const std::uint32_t site : edge.site) {
      if (site == no_site) continue;
      const std::uint32_t place = problem.place[site];
      if (place != no_index && problem.component[place] != component) foreign_sites.add(i);
    }
  }
  return result;
}

}  // namespace

void check_graph(const Problem& problem, bool part, Certificate& certificate) {
  const MedialAxis& axis = problem.axis;
  const auto [counts, kinds, strangers, foreign_sites] = tally(problem);
  certificate.components = counts.size();
  Offences torn, cycles;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Count& count = counts[i];
    certificate.graph_parts += count.parts;
    certificate.holes += count.holes;
    certificate.cycles += count.cycles();
    if (count.parts != 1 && !part) torn.add(i);
    if (part ? count.cycles() > count.holes : count.cycles() != count.holes) cycles.add(i);
  }
  auto& failures = certificate.failures;
  const std::string sampled =
      axis.resolution > 0 ? sentence("At the resolution %.6g, ", axis.resolution) : std::string();
  const std::string beginning = axis.resolution > 0 ? sampled + "t" : "T";
  const std::size_t before = failures.size();
  if (torn.count > 0 && axis.exterior == 0)
    failures.push_back(sentence(
        "%she graph has %llu connected parts for %llu component%s; component %zu has %llu of them.",
        beginning.c_str(), static_cast<unsigned long long>(certificate.graph_parts),
        static_cast<unsigned long long>(certificate.components), plural_s(counts.size()),
        torn.first, static_cast<unsigned long long>(counts[torn.first].parts)));
  if (cycles.count > 0 && axis.exterior == 0) {
    const Count& count = counts[cycles.first];
    const std::string others =
        cycles.count == 1 ? std::string()
                          : sentence(", and %zu more component%s too few or too many",
                                     cycles.count - 1, cycles.count == 2 ? " has" : "s have");
    failures.push_back(sentence(
        "%somponent %zu has %llu independent cycle%s for %llu hole%s%s.",
        (axis.resolution > 0 ? sampled + "c" : "C").c_str(), cycles.first,
        static_cast<unsigned long long>(count.cycles()), plural_s(count.cycles()),
        static_cast<unsigned long long>(count.holes), plural_s(count.holes), others.c_str()));
  }
  if (axis.resolution > 0) certificate.unresolved = failures.size() - before;
  if (strangers.count > 0)
    failures.push_back(
        sentence("%zu nodes are connected with nodes of another component; the first is node %zu.",
                 strangers.count, strangers.first));
  if (foreign_sites.count > 0)
    failures.push_back(
        sentence("%zu edges have a site of another component; the first is edge %zu.",
                 foreign_sites.count, foreign_sites.first));
  if (kinds.count > 0)
    failures.push_back(sentence(
        "%zu nodes have a kind that does not fit the number of their edges; the first is node %zu "
        "with %u edges.",
        kinds.count, kinds.first, problem.degree[kinds.first]));
}

namespace {

/// The boundary point at which one site ends and another one begins, or no_index.
std::uint32_t joint_between_sites(const Problem& problem, std::uint32_t before,
                                  std::uint32_t after) {
  const std::uint32_t a = problem.place[before], b = problem.place[after];
  return a != no_index && b != no_index && problem.next[a] == b ? b : no_index;
}

void report_leaves(const Problem& problem, const Offences& raised, const Offences& turned,
                   std::vector<std::string>& failures) {
  const auto report = [&](const char* what, const Offences& found) {
    if (found.count == 0) return;
    const Disk& disk = problem.disk(static_cast<std::uint32_t>(found.first));
    failures.push_back(
        sentence("%zu leaves %s; the first is node %zu at (%.17g, %.17g), r = %.17g.", found.count,
                 what, found.first, disk.center.x, disk.center.y, disk.radius));
  };
  report("have a radius above 0 and are at no arc of largest curvature", raised);
  report("have their edge's sites on the wrong sides", turned);
}

Corner corner_at(const Problem& problem, std::uint32_t i) {
  return {problem.point(i), problem.component[i]};
}

/// Compares sorted lists of corners and leaves: an entry in only one list is an offence. Nearly all
/// leaves are matched with the corners of their sites directly, and are in no list.
void check_leaves(const Problem& problem, Certificate& certificate) {
  const MedialAxis& axis = problem.axis;
  const auto count = static_cast<std::uint32_t>(problem.shape.points.size());
  auto& failures = certificate.failures;
  std::vector<Corner> corners, leaves;
  std::vector<bool> has_leaf(count, false);
  Offences raised, turned;
  const auto add_leaf = [&](const Edge& edge, std::size_t end, std::uint32_t node) {
    const Corner leaf{axis.nodes[node].disk.center, axis.nodes[node].component};
    const auto are_joined = [&](std::uint32_t i) {
      return i != no_index && corner_at(problem, i) == leaf;
    };
    // Ahead of the end, the boundary runs from the site on the right to the one on the left.
    const std::uint32_t right = edge.site[end], left = edge.site[1 - end];
    const std::uint32_t i = joint_between_sites(problem, right, left);
    if (are_joined(i) && problem.joint[i] == Joint::corner && !has_leaf[i])
      has_leaf[i] = true;
    else
      leaves.push_back(leaf);
    if (!are_joined(i) && are_joined(joint_between_sites(problem, left, right))) turned.add(node);
  };
  std::size_t budget = count;
  for (const Edge& edge : axis.edges) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::uint32_t i = edge.node[end];
      if (problem.degree[i] != 1) continue;
      if (!(axis.nodes[i].disk.radius > 0))
        add_leaf(edge, end, i);
      else if (ends_at_arc(problem, edge, end, budget))
        ++certificate.curvature_leaves;
      else
        raised.add(i);
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool is_corner = problem.joint[i] == Joint::corner;
    certificate.convex_corners += is_corner ? 1 : 0;
    if (is_corner && !has_leaf[i]) corners.push_back(corner_at(problem, i));
  }
  std::sort(corners.begin(), corners.end());
  std::sort(leaves.begin(), leaves.end());
  std::vector<Corner> bare, extra;
  std::set_difference(corners.begin(), corners.end(), leaves.begin(), leaves.end(),
                      std::back_inserter(bare));
  std::set_difference(leaves.begin(), leaves.end(), corners.begin(), corners.end(),
                      std::back_inserter(extra));
  certificate.corners_without_leaf = bare.size();
  if (!bare.empty())
    failures.push_back(sentence(
        "%zu of %llu convex corners are not leaves of radius 0; the first is (%.17g, %.17g).",
        bare.size(), static_cast<unsigned long long>(certificate.convex_corners), bare[0].point.x,
        bare[0].point.y));
  if (!extra.empty())
    failures.push_back(sentence("%zu leaves are not convex corners; the first is (%.17g, %.17g).",
                                extra.size(), extra[0].point.x, extra[0].point.y));
  report_leaves(problem, raised, turned, failures);
}

/// The boundary points that disks touch. The disks of its own edges touch a reflex vertex; or, if
/// all of these edges have shrunk to a node, the last disk on one of the segments that end there.
std::vector<bool> touched_points(const Problem& problem) {
  const MedialAxis& axis = problem.axis;
  std::vector<bool> touched(problem.shape.points.size(), false);
  for (const Edge& edge : axis.edges) {
    for (const std::uint32_t site : edge.site) {
      const std::uint32_t place = problem.place[site];
      if (place == no_index) continue;
      if (axis.sites[site].kind() == SiteKind::vertex) {
        touched[place] = true;
        continue;
      }
      for (const std::uint32_t end : {place, problem.next[place]}) {
        if (touched[end]) continue;
        for (const std::uint32_t node : edge.node) {
          const Disk& disk = problem.disk(node);
          if (std::abs(distance(disk.center, problem.point(end)) - disk.radius) <=
              problem.tolerance)
            touched[end] = true;
        }
      }
    }
  }
  return touched;
}

void check_reflex_vertices(const Problem& problem, Certificate& certificate) {
  const std::vector<bool> touched = touched_points(problem);
  // If an axis has shrunk almost to a point, as for a circle of many arcs, try any disk.
  constexpr std::size_t most_looks = 64;
  std::size_t looks = most_looks * (problem.axis.nodes.size() + touched.size());
  const auto touched_by_any = [&](std::uint32_t i) {
    for (const Node& node : problem.axis.nodes) {
      if (looks == 0) return false;
      --looks;
      if (node.component == problem.component[i] &&
          std::abs(distance(node.disk.center, problem.point(i)) - node.disk.radius) <=
              problem.tolerance)
        return true;
    }
    return false;
  };
  std::uint32_t first = no_index;
  for (std::uint32_t i = 0; i < touched.size(); ++i) {
    if (problem.joint[i] != Joint::reflex) continue;
    ++certificate.reflex_vertices;
    if (touched[i] || touched_by_any(i)) continue;
    if (certificate.reflex_without_contact++ == 0) first = i;
  }
  if (first != no_index)
    certificate.failures.push_back(sentence(
        "%llu of %llu reflex vertices are touched by no disk; the first is (%.17g, %.17g).",
        static_cast<unsigned long long>(certificate.reflex_without_contact),
        static_cast<unsigned long long>(certificate.reflex_vertices), problem.point(first).x,
        problem.point(first).y));
}

}  // namespace

void check_vertices(const Problem& problem, Certificate& certificate) {
  check_leaves(problem, certificate);
  check_reflex_vertices(problem, certificate);
}

}  // namespace medial::verify_detail
