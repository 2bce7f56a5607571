#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "axis/curve.h"
#include "axis/steps.h"
#include "base/compat.h"
#include "medial/query.h"
#include "verify/arc_feet.h"
#include "verify/checks.h"

namespace medial::verify_detail {
namespace {

/// Twice the area of the polygon c p q.
double doubled_triangle(Vec2 c, Vec2 p, Vec2 q) { return cross(p - c, q - c); }

/// A compensated sum (Neumaier), whose rounding error does not grow with the number of terms.
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

/// The point at which the disk of an edge's end touches one of its sites.
struct FootPoint {
  Vec2 foot;
  double at = 0;  ///< of an arc: the way along it
};

FootPoint foot_point_of(const Problem& problem, const ArcFeet& feet, const Edge& edge,
                        std::size_t side, std::size_t end) {
  const std::uint32_t index = edge.site[side];
  const Vec2 center = problem.disk(edge.node[end]).center;
  const Site& site = problem.axis.sites[index];
  if (!is_on_arc(site)) return {foot(site, center)};
  const double at = feet.at(edge, side, end);
  return with_arc(problem, index, [&](const Arc& arc) -> FootPoint {
    return {arc.point_at(at), at};
  });
}

/// A bound for its rounding error along the boundary.
double slack_of(const Problem& problem, const Edge& edge, std::size_t side, std::size_t end) {
  if (!is_on_arc(problem.axis.sites[edge.site[side]])) return 0;
  return with_arc(problem, edge.site[side], [&](const Arc& arc) {
    return arc.foot_slack(problem.disk(edge.node[end]).center, problem.tolerance);
  });
}

/// The same for the disks of both ends of an edge.
std::array<FootPoint, 2> foot_points_of(const Problem& problem, const ArcFeet& feet,
                                        const Edge& edge, std::size_t side) {
  const Site& site = problem.axis.sites[edge.site[side]];
  const Disk &from = problem.disk(edge.node[0]), &to = problem.disk(edge.node[1]);
  if (site.kind() != SiteKind::segment)
    return {foot_point_of(problem, feet, edge, side, 0),
            foot_point_of(problem, feet, edge, side, 1)};
  // foot() for two places at once.
  const Vec2 d = site.end - site.start;
  const Pair x{from.center.x, to.center.x}, y{from.center.y, to.center.y};
  const Pair place = ((x - site.start.x) * d.x + (y - site.start.y) * d.y) / squared_norm(d);
  const Pair t = smaller(larger(place, both(0)), both(1)), back = 1 - t;
  const Pairwise by_start = t <= 0.5;
  const Pair foot_x = by_start ? site.start.x + t * d.x : site.end.x - back * d.x;
  const Pair foot_y = by_start ? site.start.y + t * d.y : site.end.y - back * d.y;
  return {FootPoint{{foot_x[0], foot_y[0]}}, FootPoint{{foot_x[1], foot_y[1]}}};
}

/// The area between the boundary and its chord, from one contact to the next.
double area_beside(const Site& site, const FootPoint& from, const FootPoint& to) {
  if (site.kind() != SiteKind::arc || from.foot == to.foot) return 0;
  const double quarter = 0.25 * curvature(edge_of(site));
  const double a = quarter * from.at, b = quarter * to.at;
  return area_beside_chord({from.foot, to.foot, (b - a) / (1 + a * b)});
}

/// The areas on both sides of an edge, between the curve and the feet of its disks: the polygon of
/// centres and feet, plus the areas between the curve or the boundary and their chords.
struct Sides {
  double left = 0, right = 0;
};
using FootPoints = std::array<std::array<FootPoint, 2>, 2>;  ///< by side (left, right) and end
Sides swept(const MedialAxis& axis, const Edge& edge, const FootPoints& contacts) {
  const Curve curve = curve_of(axis, edge);
  const Vec2 a = curve.origin, b = curve.end;
  const auto& [left, right] = contacts;
  // If the control point is on the right, the curve bulges to the right, and the left side is
  // larger.
  const double sliver = curve.area_beside_chord();
  return {0.5 * (doubled_triangle(a, b, left[1].foot) +
                 doubled_triangle(a, left[1].foot, left[0].foot)) +
              sliver + area_beside(axis.sites[edge.site[0]], left[1], left[0]),
          0.5 * (doubled_triangle(b, a, right[0].foot) +
                 doubled_triangle(b, right[0].foot, right[1].foot)) -
              sliver + area_beside(axis.sites[edge.site[1]], right[0], right[1])};
}

/// The end of a side of an edge at a node: its foot there, on a site.
struct Spoke {
  std::uint32_t site;
  const Edge* edge;
  std::size_t side, end;
  bool counter_clockwise;  ///< whether the swept area lies on the foot's counter-clockwise side
  Vec2 foot{};
};

/// Up to this number, spokes are compared pairwise.
constexpr std::size_t few_spokes = 8;

/// Adds a spoke, or removes the one on the other side of the same foot. Spokes of one site have the
/// same foot, which need not be known.
void add_spoke(std::vector<Spoke>& spokes, const Spoke& spoke) {
  const auto other =
      spokes.size() > few_spokes ? spokes.end() : ranges::find_if(spokes, [&](const Spoke& s) {
        return s.site == spoke.site && s.counter_clockwise != spoke.counter_clockwise;
      });
  if (other == spokes.end()) return spokes.push_back(spoke);
  *other = spokes.back();
  spokes.pop_back();
}

/// Whether all spokes form pairs on both sides of one foot, so that there is nothing between the
/// swept areas around a node, as usual. O(k log k).
bool all_paired(std::vector<Spoke>& spokes) {
  if (spokes.size() <= few_spokes) {
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
  // Compare feet by their bits, which orders even NaN; -0 becomes 0.
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

/// Feet nearly coincide if their angle, seen from the disk's centre, is smaller than this.
constexpr double nearly_one = 1e-3;

/// The angle at an edge's end between its feet, on the side of the edge: about 0 if the feet nearly
/// coincide, else in (0, 2 pi).
double angle_between_feet(Vec2 center, Vec2 right, Vec2 left) {
  const double sine = doubled_triangle(center, right, left);
  const double cosine = dot(right - center, left - center);
  const double angle = std::atan2(sine, cosine);
  return angle <= -nearly_one ? angle + 2 * std::numbers::pi : angle;
}

/// A shape's area and perimeter. Each loop's area is computed relative to a point of the loop; for
/// a distant origin, the rounding error could exceed the area of a small loop.
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

/// The areas that the edges' disks sweep.
struct Swept {
  Sum area;
  std::size_t backward = 0, first = 0;  ///< edges that run backward along a site

  void add(const Swept& other) {
    area.add(other.area);
    if (backward == 0) first = other.first;
    backward += other.backward;
  }
};
Swept swept_by_edges(const Problem& problem, const ArcFeet& feet, double limit) {
  const MedialAxis& axis = problem.axis;
  const auto runs_backward = [&](const Edge& edge, double least) {
    if (!(least < -limit)) return false;  // nearly always
    double slack = limit;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t end = 0; end < 2; ++end)
        slack += slack_of(problem, edge, side, end) * problem.disk(edge.node[end]).radius;
    return least < -slack;
  };
  Swept all;
  for (const Swept& block :
       in_blocks<Swept>(axis.edges.size(), block_size, [&](std::size_t i, Swept&found) {
         const Edge& edge = axis.edges[i];
         FootPoints contacts;
         for (std::size_t side = 0; side < 2; ++side)
           contacts[side] = foot_points_of(problem, feet, edge, side);
         const Sides sides = swept(axis, edge, contacts);
         found.area.add(sides.left);
         found.area.add(sides.right);
         if (runs_backward(edge, std::min(sides.left, sides.right)) && found.backward++ == 0)
           found.first = i;
       }))
    all.add(block);
  return all;
}

/// The sectors of the nodes' disks that the edges do not sweep. Every spoke of an edge ends one
/// swept area; the spokes around each node bound the areas in between.
///
/// The rest of the full angle consists of sectors of the disk at its contacts with arcs, or of gaps
/// by rounding: if the axis passes from a segment to the vertex at its end, or several sites touch
/// within the tolerance, the feet differ slightly.
class Slices {
 public:
  Slices(const Problem& problem, const ArcFeet& feet)
      : problem_(problem), feet_(feet), incidence_(problem.axis) {}

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
      // A loop edge occurs twice, first with its beginning.
      const bool again = k > 0 && around[k - 1] == around[k];
      visit(edge, edge.node[0] == node && !again ? 0 : 1);
    }
  }
  Vec2 foot_on(const Edge& edge, std::size_t side, std::size_t end) const {
    return foot_point_of(problem_, feet_, edge, side, end).foot;
  }
  /// Whether swept areas adjoin all around a node. Seen from the node, an edge's area begins on its
  /// right side and ends on its left side.
  bool nothing_between(std::uint32_t node, std::vector<Spoke>& spokes) const {
    spokes.clear();
    for_each_end(node, [&](const Edge& edge, std::size_t end) {
      for (std::size_t side = 0; side < 2; ++side)
        add_spoke(spokes, {edge.site[side], &edge, side, end, (side == 1) == (end == 0)});
    });
    for (Spoke& spoke : spokes) spoke.foot = foot_on(*spoke.edge, spoke.side, spoke.end);
    return all_paired(spokes);
  }
  /// The angle that they do not cover. If feet nearly coincide, their edge covers either almost
  /// nothing or almost the full angle. At most one edge covers the full angle, and then nothing is
  /// left.
  double angle_between(std::uint32_t node) const {
    constexpr double whole = 2 * std::numbers::pi;
    const Vec2 center = problem_.disk(node).center;
    double angle = whole, open = 0;
    for_each_end(node, [&](const Edge& edge, std::size_t end) {
      const double one =
          angle_between_feet(center, foot_on(edge, 1 - end, end), foot_on(edge, end, end));
      open += std::abs(one) < nearly_one ? nearly_one : 0;
      angle -= one;
    });
    const bool is_open = angle >= whole - std::min(open, std::numbers::pi);
    return is_open && goes_on_around(node) ? angle - whole : angle;
  }
  /// The beginning of a swept area.
  struct Begin {
    std::size_t place;
    Vec2 foot;
  };
  /// Whether, from each foot at which a swept area ends, the boundary continues to a foot at which
  /// an area begins, both at one place as seen from the node.
  bool goes_on_around(std::uint32_t node) const {
    const auto place_of = [&](std::uint32_t site) {
      const bool is_edge = problem_.axis.sites[site].kind() != SiteKind::vertex;
      return 2 * std::size_t{problem_.place[site]} + (is_edge ? 1 : 0);
    };
    std::vector<Begin> begins;
    for_each_end(node, [&](const Edge& edge, std::size_t end) {
      begins.push_back({place_of(edge.site[1 - end]), foot_on(edge, 1 - end, end)});
    });
    ranges::sort(begins, {}, &Begin::place);
    const double near = nearly_one * problem_.disk(node).radius;
    bool goes_on = true;
    for_each_end(node, [&](const Edge& edge, std::size_t end) {
      goes_on =
          goes_on && goes_on_from(place_of(edge.site[end]), foot_on(edge, end, end), near, begins);
    });
    return goes_on;
  }
  /// Whether the boundary leads from a foot to one of several others near it, past vertices near
  /// it. Vertices and the edges that begin there are numbered alternately.
  bool goes_on_from(std::size_t place, Vec2 foot, double near,
                    const std::vector<Begin>& others) const {
    constexpr int most_vertices = 64;
    for (int vertices = 0; vertices < most_vertices;) {
      for (auto other = ranges::lower_bound(others, place, {}, &Begin::place);
           other != others.end() && other->place == place; ++other)
        if (distance(other->foot, foot) <= near) return true;
      const auto point = static_cast<std::uint32_t>(place / 2);
      if (point >= problem_.next.size()) return false;
      if (place % 2 == 0) {
        ++place;
        continue;
      }
      const std::uint32_t next = problem_.next[point];
      if (!(distance(problem_.point(next), foot) <= near)) return false;
      place = 2 * std::size_t{next};
      ++vertices;
    }
    return false;
  }

  const Problem& problem_;
  const ArcFeet& feet_;
  Incidence incidence_;
};

}  // namespace

void check_area(const Problem& problem, const ArcFeet& feet, double open,
                Certificate& certificate) {
  if (problem.shape.points.empty()) return;

  const Extent extent = extent_of(problem);
  certificate.shape_area = extent.area;
  const double limit = 4 * problem.tolerance * extent.perimeter;
  Swept edges = swept_by_edges(problem, feet, limit);
  edges.area.add(Slices(problem, feet).area());
  certificate.disks_area = edges.area.value();

  // Neighbouring areas share their spokes, so the error of the sum is only the rounding of the
  // feet, a part of the tolerance along the whole boundary, in either direction; and as much again
  // for the rounding of the terms.
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
