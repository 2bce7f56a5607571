#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <tuple>

#include "axis/curve.h"
#include "axis/steps.h"
#include "base/compat.h"
#include "medial/query.h"
#include "verify/checks.h"

namespace medial::verify_detail {
namespace {

/// The stretch of a boundary edge that the disks of one axis edge touch; a vertex is a stretch
/// without length at the start of the edge that begins there.
struct Stretch {
  double begin, end;                   ///< parameters along the boundary edge, in units of length
  std::uint32_t begin_node, end_node;  ///< whose disks touch there
  /// Of disks around a vertex, which touch it one after the other: turn_of() the clockwise angle of
  /// the first from the normal where the vertex is arrived at; an edge's come after them.
  double turn = std::numeric_limits<double>::infinity();
};

/// Where one disk touches a boundary edge. Next to the centre of an arc, rounding alone decides
/// where the foot lies: the disk touches all of the arc where it may lie.
Stretch touched_by(const Problem& problem, const Track& on, std::uint32_t node) {
  const Vec2 center = problem.disk(node).center;
  const double foot = on.foot_at(center);
  if (on.is_straight()) return {foot, foot, node, node};
  const double slack = on.foot_slack(center, problem.tolerance);
  return {std::max(0.0, foot - slack), std::min(on.length(), foot + slack), node, node};
}

/// Grows with the angle that has this sine and cosine, times one number, in [-1, 3): 1 for a
/// quarter. What rounding puts before 0 is no full turn behind it.
double turn_of(double sine, double cosine) {
  const double size = std::abs(sine) + std::abs(cosine);
  const double beside = size > 0 ? cosine / size : 1;
  if (sine >= 0) return 1 - beside;
  return cosine >= 0 ? beside - 1 : beside + 3;
}

/// The stretch of a boundary edge, or of the vertex it begins in, that an edge of the axis touches
/// with the site on one of its sides.
Stretch stretch_of(const Problem& problem, std::uint32_t place, std::uint32_t before,
                   const Edge& edge, std::size_t side) {
  const auto [from, to] = edge.node;
  if (problem.axis.sites[edge.site[side]].kind() == SiteKind::vertex) {
    const Vec2 arriving = end_tangent(problem.edge(before));
    const auto turn = [&](std::uint32_t node) {
      const Vec2 off = problem.disk(node).center - problem.point(place);
      return turn_of(dot(arriving, off), cross(arriving, off));
    };
    const double first = turn(from), last = turn(to);
    return last < first ? Stretch{0, 0, to, from, last} : Stretch{0, 0, from, to, first};
  }
  const Track on = problem.track(place);
  Stretch all = touched_by(problem, on, from);
  const Stretch other = touched_by(problem, on, to);
  if (other.begin < all.begin) {
    all.begin = other.begin;
    all.begin_node = to;
  }
  if (other.end >= all.end) {
    all.end = other.end;
    all.end_node = to;
  }
  return all;
}

/// The edges of the axis that touch each boundary edge, or the vertex that it begins in.
class Touching {
 public:
  explicit Touching(const Problem& problem) : problem_(problem) {
    begin_.assign(problem.shape.points.size() + 1, 0);
    for_each_contact([&](std::uint32_t, std::uint32_t place) { ++begin_[place + 1]; });
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    edges_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for_each_contact(
        [&](std::uint32_t edge, std::uint32_t place) { edges_[next[place]++] = edge; });
  }

  /// The stretches of one boundary edge, in order along it. `before` is the edge before it.
  void stretches(std::uint32_t place, std::uint32_t before, std::vector<Stretch>& found) const {
    found.clear();
    for (std::uint32_t k = begin_[place]; k < begin_[place + 1]; ++k) {
      const Edge& edge = problem_.axis.edges[edges_[k]];
      // An edge that touches it with both sites stands here twice.
      const bool again = k > begin_[place] && edges_[k - 1] == edges_[k];
      const std::size_t side = problem_.place[edge.site[0]] == place && !again ? 0 : 1;
      found.push_back(stretch_of(problem_, place, before, edge, side));
    }
    std::sort(found.begin(), found.end(), [](const Stretch& a, const Stretch& b) {
      return std::tie(a.begin, a.turn, a.end) < std::tie(b.begin, b.turn, b.end);
    });
  }

 private:
  template <class Visitor>
  void for_each_contact(const Visitor& visit) const {
    for (std::uint32_t i = 0; i < problem_.axis.edges.size(); ++i)
      for (const std::uint32_t site : problem_.axis.edges[i].site)
        if (problem_.place[site] != no_index) visit(i, problem_.place[site]);
  }

  const Problem& problem_;
  std::vector<std::uint32_t> begin_;  ///< of each boundary edge, in edges_
  std::vector<std::uint32_t> edges_;
};

/// How far p lies outside a disk; negative inside.
double outside(const Disk& disk, Vec2 p) { return distance(disk.center, p) - disk.radius; }

/// The largest distance from a point of an edge between two lengths along it to the union of two
/// disks.
///
/// With f and g the distances outside each: along a line or a circle, each rises and falls
/// between the point next to the disk's centre and the one opposite to it. Between two such points
/// min(f, g) is largest at an end, or where f = g if one of them rises and the other falls.
double uncovered(const Disk& a, const Disk& b, const Track& edge, double from, double to) {
  struct Outside {
    double a, b;
    double least() const { return std::min(a, b); }
  };
  const auto outside_at = [&](double length) {
    const Vec2 p = edge.point_at(length);
    return Outside{outside(a, p), outside(b, p)};
  };
  if (!(from < to)) return std::max(0.0, outside_at(from).least());
  std::array<double, 6> bound;
  std::size_t bounds = 0;
  bound[bounds++] = from;
  const auto turns_at = [&](double length) {
    if (!(length > from && length < to)) return;
    std::size_t place = bounds++;
    for (; bound[place - 1] > length; --place) bound[place] = bound[place - 1];
    bound[place] = length;
  };
  for (const Disk& disk : {a, b}) {
    turns_at(edge.foot_at(disk.center));
    if (!edge.is_straight()) turns_at(edge.opposite_at(disk.center));
  }
  bound[bounds++] = to;
  double worst = 0;
  Outside before = outside_at(from);
  for (std::size_t i = 1; i < bounds; ++i) {
    const Outside after = outside_at(bound[i]);
    worst = std::max({worst, before.least(), after.least()});
    const bool a_first = before.a <= before.b;
    if (a_first != (after.a <= after.b)) {
      double low = bound[i - 1], high = bound[i];
      for (int halvings = 0; halvings < 60; ++halvings) {
        const double middle = 0.5 * (low + high);
        const Outside here = outside_at(middle);
        ((here.a <= here.b) == a_first ? low : high) = middle;
      }
      worst = std::max(worst, outside_at(low).least());
    }
    before = after;
  }
  return worst;
}

/// Where disks touch last before a gap in the boundary: parameter `at` of boundary edge `edge`.
struct Foot {
  std::uint32_t edge;
  double at;
  std::uint32_t node;
};

/// The largest distance of the boundary from the disks, above what blunt joints leave open.
struct Uncovered {
  double value = 0;
  Vec2 where;
  double excess = 0;  ///< above what is allowed there
  double open = 0;    ///< area that blunt joints may leave open

  /// At a length along an edge.
  void add(double amount, double allowed, const Track& edge, double length) {
    if (std::isnan(amount)) amount = std::numeric_limits<double>::infinity();
    value = std::max(value, amount);
    if (amount - allowed <= excess) return;
    excess = amount - allowed;
    where = edge.point_at(length);
  }
};

/// The boundary from one foot on to another, against the two disks that touch there. Where a blunt
/// joint lies in between, the disks of its dropped leaf would have covered what is left open: less
/// than the larger radius times the joint's angle, as their edge ends where a disk touches both
/// edges of the joint, at directions that differ by no more.
void cross_gap(const Problem& problem, const Foot& from, const Foot& to, bool wrapped,
               Uncovered& worst) {
  const Disk& a = problem.disk(from.node);
  const Disk& b = problem.disk(to.node);
  const bool around = from.edge != to.edge || wrapped;
  double allowed = 0;
  if (!problem.blunt_angle.empty() && around) {
    double angle = 0;
    std::uint32_t edge = from.edge;
    do {
      edge = problem.next[edge];
      angle += problem.blunt_angle[edge];
    } while (edge != to.edge);
    allowed = angle * std::max(a.radius, b.radius);
  }
  const auto advance = [&](const Track& on, double begin, double end) {
    worst.open += allowed * (end - begin);
    worst.add(uncovered(a, b, on, begin, end), allowed, on, 0.5 * (begin + end));
  };
  const Track first = problem.track(from.edge);
  if (!around) {
    advance(first, from.at, to.at);
    return;
  }
  advance(first, from.at, first.length());
  for (std::uint32_t edge = problem.next[from.edge]; edge != to.edge; edge = problem.next[edge]) {
    const Track whole = problem.track(edge);
    advance(whole, 0, whole.length());
  }
  advance(problem.track(to.edge), 0, to.at);
}

/// Walks once around a loop, from stretch to stretch. `lone_node` is a node without edges of each
/// component, or no_index.
void walk_loop(const Problem& problem, const Touching& touching,
               const std::vector<std::uint32_t>& lone_node, std::size_t loop, Uncovered& worst) {
  const std::uint32_t begin = problem.shape.loop_begin[loop],
                      end = problem.shape.loop_begin[loop + 1];
  bool any = false;
  Foot first{}, reach{};
  std::vector<Stretch> stretches;
  for (std::uint32_t i = begin; i < end; ++i) {
    touching.stretches(i, i > begin ? i - 1 : end - 1, stretches);
    for (const Stretch& stretch : stretches) {
      if (!any) {
        first = {i, stretch.begin, stretch.begin_node};
        any = true;
      } else if (reach.edge != i || stretch.begin > reach.at) {
        cross_gap(problem, reach, {i, stretch.begin, stretch.begin_node}, false, worst);
      } else if (stretch.end < reach.at) {
        continue;
      }
      reach = {i, stretch.end, stretch.end_node};
    }
  }
  if (any) {
    cross_gap(problem, reach, first, true, worst);
    return;
  }
  // No edge touches it: a circle, which one disk fills.
  const std::uint32_t lone = lone_node[problem.component[begin]];
  if (lone == no_index)
    worst.add(diagonal(problem.box), 0, problem.track(begin), 0);
  else
    cross_gap(problem, {begin, 0, lone}, {begin, 0, lone}, true, worst);
}

/// Twice the area of the polygon c p q.
double doubled_triangle(Vec2 c, Vec2 p, Vec2 q) { return cross(p - c, q - c); }

/// A sum whose rounding does not grow with the number of its terms (Neumaier).
class Sum {
 public:
  void add(double term) {
    const double next = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  void add(const Sum& other) {
    add(other.sum_);
    add(other.lost_);
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

/// Where the disk of an edge's end touches one of its sites.
struct FootPoint {
  Vec2 foot;
  double at = 0;     ///< of an arc: length along it
  double slack = 0;  ///< how far rounding may move it along the boundary
};

FootPoint foot_point_of(const Problem& problem, std::uint32_t index, const Disk& disk) {
  const Site& site = problem.axis.sites[index];
  if (site.kind() != SiteKind::arc || site.start == site.end) return {foot(site, disk.center)};
  return with_arc(problem, index, [&](const Arc& arc) -> FootPoint {
    const double at = arc.foot_at(disk.center);
    return {arc.point_at(at), at, arc.foot_slack(disk.center, problem.tolerance)};
  });
}

/// The same for the disks of both ends of an edge.
std::array<FootPoint, 2> foot_points_of(const Problem& problem, std::uint32_t index,
                                        const Edge& edge) {
  const Site& site = problem.axis.sites[index];
  const Disk &from = problem.disk(edge.node[0]), &to = problem.disk(edge.node[1]);
  if (site.kind() != SiteKind::segment)
    return {foot_point_of(problem, index, from), foot_point_of(problem, index, to)};
  // foot() of two places at once.
  const Vec2 d = site.end - site.start;
  const Pair x{from.center.x, to.center.x}, y{from.center.y, to.center.y};
  const Pair place = ((x - site.start.x) * d.x + (y - site.start.y) * d.y) / squared_norm(d);
  const Pair t = smaller(larger(place, both(0)), both(1)), back = 1 - t;
  const Pairwise by_start = t <= 0.5;
  const Pair foot_x = by_start ? site.start.x + t * d.x : site.end.x - back * d.x;
  const Pair foot_y = by_start ? site.start.y + t * d.y : site.end.y - back * d.y;
  return {FootPoint{{foot_x[0], foot_y[0]}}, FootPoint{{foot_x[1], foot_y[1]}}};
}

/// The area between the boundary and the chord from one contact forward to another.
double area_beside(const Site& site, const FootPoint& from, const FootPoint& to) {
  if (site.kind() != SiteKind::arc || from.foot == to.foot) return 0;
  const double angle = (to.at - from.at) * curvature(edge_of(site));
  return area_beside_chord({from.foot, to.foot, std::tan(0.25 * angle)});
}

/// The areas on both sides of an edge, between the curve and the feet of its disks: the polygon of
/// centres and feet, and what the curve and the boundary add to it beside their chords.
struct Sides {
  double left = 0, right = 0;
};
using FootPoints = std::array<std::array<FootPoint, 2>, 2>;  ///< by side (left, right) and end
Sides swept(const MedialAxis& axis, const Edge& edge, const FootPoints& contacts) {
  const Curve curve = curve_of(axis, edge);
  const Vec2 a = curve.origin, b = curve.end;
  const auto& [left, right] = contacts;
  // The curve bulges to the right where the control point does: then the left side has more.
  const double sliver = curve.area_beside_chord();
  return {0.5 * (doubled_triangle(a, b, left[1].foot) +
                 doubled_triangle(a, left[1].foot, left[0].foot)) +
              sliver + area_beside(axis.sites[edge.site[0]], left[1], left[0]),
          0.5 * (doubled_triangle(b, a, right[0].foot) +
                 doubled_triangle(b, right[0].foot, right[1].foot)) -
              sliver + area_beside(axis.sites[edge.site[1]], right[0], right[1])};
}

/// Where a side of an edge ends at a node: its foot there, on a site.
struct Spoke {
  std::uint32_t site;
  bool counter_clockwise;  ///< whether the swept area lies on the foot's counter-clockwise side
  Vec2 foot{};
};

/// So many spokes are simply compared with each other.
constexpr std::size_t few = 8;

/// Adds a spoke, or drops the one on the other side of the same foot: those of one site have one
/// foot, which need not be known.
void add_spoke(std::vector<Spoke>& spokes, const Spoke& spoke) {
  const auto other =
      spokes.size() > few ? spokes.end() : ranges::find_if(spokes, [&](const Spoke& s) {
        return s.site == spoke.site && s.counter_clockwise != spoke.counter_clockwise;
      });
  if (other == spokes.end()) return spokes.push_back(spoke);
  *other = spokes.back();
  spokes.pop_back();
}

/// Whether all spokes stand in pairs on both sides of one foot, so that nothing lies between the
/// swept areas around a node. That is the rule. O(k log k).
bool all_paired(std::vector<Spoke>& spokes) {
  if (spokes.size() <= few) {
    while (!spokes.empty()) {
      const Spoke last = spokes.back();
      spokes.pop_back();
      const auto other = ranges::find_if(spokes, [&](const Spoke& spoke) {
        return spoke.foot == last.foot && spoke.counter_clockwise != last.counter_clockwise;
      });
      if (other == spokes.end()) return false;
      *other = spokes.back();
      spokes.pop_back();
    }
    return true;
  }
  // By their bits feet have an order, whatever numbers they are; -0 becomes 0.
  const auto place = [](const Spoke& spoke) {
    return std::pair(bit_cast<std::uint64_t>(spoke.foot.x + 0.0),
                     bit_cast<std::uint64_t>(spoke.foot.y + 0.0));
  };
  ranges::sort(spokes, {}, place);
  std::int64_t unpaired = 0;
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    unpaired += spokes[i].counter_clockwise ? 1 : -1;
    const bool last_here = i + 1 == spokes.size() || place(spokes[i]) != place(spokes[i + 1]);
    if (last_here && unpaired != 0) return false;
  }
  return true;
}

/// Feet nearly coincide that are seen under a smaller angle from the disk's centre.
constexpr double nearly_one = 1e-3;

/// The angle at an edge's end between its feet, on the side of the edge, in [0, 2 pi]. Feet that
/// nearly coincide lie ahead of the edge or behind it.
double angle_between_feet(Vec2 center, Vec2 right, Vec2 left, bool ahead) {
  const double sine = doubled_triangle(center, right, left);
  const double cosine = dot(right - center, left - center);
  const double angle = std::atan2(sine, cosine);
  if (std::abs(angle) < nearly_one) return ahead ? angle : angle + 2 * std::numbers::pi;
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

/// A shape's own area and perimeter. Each loop's area is seen from a point of it: what lies far
/// from a small loop would add more rounding than the loop has area.
struct Extent {
  double area = 0, perimeter = 0;
};
Extent extent_of(const Problem& problem) {
  const std::vector<std::uint32_t>& begin = problem.shape.loop_begin;
  Sum area, perimeter;
  for (std::size_t loop = 0; loop < problem.shape.loop_count(); ++loop)
    for (std::uint32_t i = begin[loop]; i < begin[loop + 1]; ++i) {
      const BoundaryEdge edge = problem.edge(i);
      area.add(0.5 * doubled_triangle(problem.point(begin[loop]), edge.start, edge.end));
      if (edge.bulge != 0) area.add(area_beside_chord(edge));
      perimeter.add(length_of(edge));
    }
  return {area.value(), perimeter.value()};
}

/// What the edges' disks sweep.
struct Swept {
  Sum area;
  std::size_t backward = 0, first = 0;  ///< edges that run backward along a site

  void add(const Swept& other) {
    area.add(other.area);
    if (backward == 0) first = other.first;
    backward += other.backward;
  }
};
Swept swept_by_edges(const Problem& problem, double limit) {
  const MedialAxis& axis = problem.axis;
  Swept all;
  for (const Swept& block :
       in_blocks<Swept>(axis.edges.size(), block_size, [&](std::size_t i, Swept&found) {
         const Edge& edge = axis.edges[i];
         FootPoints contacts;
         double slack = limit;
         for (std::size_t side = 0; side < 2; ++side) {
           contacts[side] = foot_points_of(problem, edge.site[side], edge);
           for (std::size_t end = 0; end < 2; ++end)
             slack += contacts[side][end].slack * problem.disk(edge.node[end]).radius;
         }
         const Sides sides = swept(axis, edge, contacts);
         found.area.add(sides.left);
         found.area.add(sides.right);
         if (std::min(sides.left, sides.right) < -slack && found.backward++ == 0) found.first = i;
       }))
    all.add(block);
  return all;
}

/// What the edges leave of the nodes' disks: every spoke of an edge ends one swept area, and
/// the spokes around each node say what lies between.
///
/// What is left of the full angle are slices of the disk, at its contacts with arcs. Or they are
/// due to rounding: where the axis passes from a segment to the vertex at its end, or several sites
/// touch within the tolerance, the feet differ a little.
class Slices {
 public:
  explicit Slices(const Problem& problem) : problem_(problem), incidence_(problem.axis) {}

  Sum area() const {
    struct Findings {
      Sum area;
      std::vector<Spoke> spokes;
    };
    const auto look = [&](std::size_t i, Findings& found) {
      const auto node = static_cast<std::uint32_t>(i);
      const double radius = problem_.disk(node).radius;
      if (incidence_.degree(node) == 0)
        found.area.add(std::numbers::pi * radius * radius);
      else if (!nothing_between(node, found.spokes))
        found.area.add(0.5 * radius * radius * angle_between(node));
    };
    Sum sum;
    for (const Findings& block : in_blocks<Findings>(problem_.axis.nodes.size(), block_size, look))
      sum.add(block.area);
    return sum;
  }

 private:
  /// Calls `visit` with each edge that ends at a node, and with the number of that end.
  template <class Visitor>
  void for_each_end(std::uint32_t node, const Visitor& visit) const {
    const auto around = incidence_.edges(node);
    for (std::size_t k = 0; k < around.size(); ++k) {
      const Edge& edge = problem_.axis.edges[around[k]];
      // An edge from the node to itself stands here twice, first with its beginning.
      const bool again = k > 0 && around[k - 1] == around[k];
      visit(edge, edge.node[0] == node && !again ? 0 : 1);
    }
  }
  Vec2 foot_on(std::uint32_t site, std::uint32_t node) const {
    return foot_point_of(problem_, site, problem_.disk(node)).foot;
  }
  /// Whether swept areas meet all around a node. Seen from there, an edge's area begins on its
  /// right side and ends on its left.
  bool nothing_between(std::uint32_t node, std::vector<Spoke>& spokes) const {
    spokes.clear();
    for_each_end(node, [&](const Edge& edge, std::size_t end) {
      for (std::size_t side = 0; side < 2; ++side)
        add_spoke(spokes, {edge.site[side], (side == 1) == (end == 0)});
    });
    for (Spoke& spoke : spokes) spoke.foot = foot_on(spoke.site, node);
    return all_paired(spokes);
  }
  /// Whether feet of an edge's end that nearly coincide lie ahead of the edge. They do where the
  /// boundary passes on from the right one to the left one, and elsewhere where the radius shrinks
  /// along the tangent, which points to the control point: through a gap it shrinks and grows
  /// again.
  bool leads_to_feet(const Edge& edge, std::size_t end, const Disk& disk) const {
    const std::uint32_t right = edge.site[1 - end], left = edge.site[end];
    const bool forward = passes_on(right, left, disk), backward = passes_on(left, right, disk);
    return forward != backward ? forward : edge.control.radius < disk.radius;
  }
  /// Whether the boundary leads from one edge to another past few vertices, which all lie where the
  /// disk's feet on the two nearly coincide.
  bool passes_on(std::uint32_t site, std::uint32_t other, const Disk& disk) const {
    constexpr int most_vertices = 4;
    for (const std::uint32_t i : {site, other})
      if (problem_.axis.sites[i].kind() == SiteKind::vertex || problem_.place[i] == no_index)
        return false;
    const Vec2 foot = foot_point_of(problem_, site, disk).foot;
    std::uint32_t point = problem_.place[site];
    for (int k = 0; k < most_vertices; ++k) {
      point = problem_.next[point];
      if (!(distance(problem_.point(point), foot) <= nearly_one * disk.radius)) return false;
      if (point == problem_.place[other]) return true;
    }
    return false;
  }
  /// What they leave of the full angle.
  double angle_between(std::uint32_t node) const {
    const Disk& disk = problem_.disk(node);
    double angle = 2 * std::numbers::pi;
    for_each_end(node, [&](const Edge& edge, std::size_t end) {
      angle -= angle_between_feet(disk.center, foot_on(edge.site[1 - end], node),
                                  foot_on(edge.site[end], node), leads_to_feet(edge, end, disk));
    });
    return angle;
  }

  const Problem& problem_;
  Incidence incidence_;
};

}  // namespace

double check_coverage(const Problem& problem, Certificate& certificate) {
  const Touching touching(problem);
  std::vector<std::uint32_t> lone_node(problem.shape.component_count(), no_index);
  for (std::uint32_t i = 0; i < problem.axis.nodes.size(); ++i)
    if (problem.degree[i] == 0) lone_node[problem.axis.nodes[i].component] = i;
  Uncovered worst;
  for (std::size_t i = 0; i < problem.shape.loop_count(); ++i)
    walk_loop(problem, touching, lone_node, i, worst);
  certificate.largest_uncovered = worst.value;
  // A foot may lie the tolerance outside its disk; between the feet of different nodes a gap of
  // width g, which rises by g^2 / (8 r) over their disks, may add as much again.
  const double limit = 2 * problem.tolerance;
  if (!(worst.excess <= limit))
    certificate.failures.push_back(sentence(
        "A stretch of the boundary is touched by no disk: near (%.17g, %.17g) it lies %.3g "
        "outside the union of the disks, over %.3g.",
        worst.where.x, worst.where.y, worst.excess, limit));
  return worst.open;
}

void check_area(const Problem& problem, double open, Certificate& certificate) {
  if (problem.shape.points.empty()) return;

  const Extent extent = extent_of(problem);
  certificate.shape_area = extent.area;
  const double limit = 4 * problem.tolerance * extent.perimeter;
  Swept edges = swept_by_edges(problem, limit);
  edges.area.add(Slices(problem).area());
  certificate.disks_area = edges.area.value();

  // Neighbouring areas share their spokes, so only the feet's rounding, a part of the tolerance
  // along the whole boundary, is left in the sum, on either side of it; and as much again for the
  // terms'.
  const double difference = certificate.disks_area - certificate.shape_area;
  if (!(std::abs(difference) <= limit + open))
    certificate.failures.push_back(
        sentence("The disks cover an area of %.17g, which differs from the shape's area of %.17g "
                 "by %.3g, over "
                 "%.3g.",
                 certificate.disks_area, certificate.shape_area, difference, limit));
  if (edges.backward > 0)
    certificate.failures.push_back(
        sentence("%zu edges run backward along a site: what they sweep there has a negative area; "
                 "the first is "
                 "edge %zu.",
                 edges.backward, edges.first));
}

}  // namespace medial::verify_detail
