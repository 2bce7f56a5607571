#include <array>
#include <cmath>

#include "axis/curve.h"
#include "medial/query.h"
#include "verify/checks.h"

namespace medial::verify_detail {
namespace {

/// The stretch of a boundary edge that the disks of one axis edge touch.
struct Stretch {
  double begin, end;                   ///< parameters along the boundary edge, in units of length
  std::uint32_t begin_node, end_node;  ///< whose disks touch there
};

/// The stretches of all boundary edges, grouped by edge and ordered along each.
struct Stretches {
  std::vector<std::uint32_t> first;  ///< of each boundary edge, in `all`
  std::vector<Stretch> all;
};

Stretches collect(const Problem& problem) {
  const MedialAxis& axis = problem.axis;
  const std::size_t count = problem.shape.points.size();
  Stretches out;
  out.first.assign(count + 1, 0);
  const auto place_of = [&](std::uint32_t site) {
    return axis.sites[site].kind == SiteKind::segment ? problem.place[site] : kNone;
  };
  for (const Edge& edge : axis.edges)
    for (const std::uint32_t site : edge.site)
      if (place_of(site) != kNone) ++out.first[place_of(site) + 1];
  for (std::size_t i = 1; i <= count; ++i) out.first[i] += out.first[i - 1];
  out.all.resize(out.first[count]);
  std::vector<std::uint32_t> next(out.first.begin(), out.first.end() - 1);
  for (const Edge& edge : axis.edges) {
    for (const std::uint32_t site : edge.site) {
      const std::uint32_t place = place_of(site);
      if (place == kNone) continue;
      const Vec2 start = problem.point(place), d = problem.point(problem.next[place]) - start;
      const double length = norm(d);
      const auto parameter = [&](std::uint32_t node) {
        return std::clamp(dot(problem.disk(node).center - start, d) / length, 0.0, length);
      };
      Stretch stretch{parameter(edge.node[0]), parameter(edge.node[1]), edge.node[0], edge.node[1]};
      if (stretch.begin > stretch.end) {
        std::swap(stretch.begin, stretch.end);
        std::swap(stretch.begin_node, stretch.end_node);
      }
      out.all[next[place]++] = stretch;
    }
  }
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    std::sort(out.all.begin() + out.first[i], out.all.begin() + out.first[i + 1],
              [](const Stretch& a, const Stretch& b) {
                return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
              });
  });
  return out;
}

/// How far p lies outside a disk; negative inside.
double outside(const Disk& disk, Vec2 p) { return distance(disk.center, p) - disk.radius; }

/// The largest distance from a point of the segment p q to the union of two disks.
///
/// With f and g the distances outside of each, both convex along the segment, the largest min(f, g)
/// is at an end or where f = g. Where f <= g at both ends, or g <= f, an end is largest, because
/// min(f, g) <= f <= its larger end there; otherwise f - g changes its sign and is bisected.
double uncovered(const Disk& a, const Disk& b, Vec2 p, Vec2 q) {
  const auto f = [&](double t) { return outside(a, p + t * (q - p)); };
  const auto g = [&](double t) { return outside(b, p + t * (q - p)); };
  const double f0 = f(0), f1 = f(1), g0 = g(0), g1 = g(1);
  const double ends = std::max(std::min(f0, g0), std::min(f1, g1));
  if ((f0 - g0 <= 0) == (f1 - g1 <= 0)) return std::max(0.0, ends);
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) - g(middle) <= 0) == (f0 - g0 <= 0) ? low : high) = middle;
  }
  return std::max({0.0, ends, std::min(f(low), g(low))});
}

/// Where disks touch last before a gap in the boundary: parameter `at` of boundary edge `edge`.
struct Foot {
  std::uint32_t edge;
  double at;
  std::uint32_t node;
};

Vec2 point_of(const Problem& problem, const Foot& foot) {
  const Vec2 a = problem.point(foot.edge), b = problem.point(problem.next[foot.edge]);
  const double length = distance(a, b);
  return foot.at <= 0 ? a : foot.at >= length ? b : a + (foot.at / length) * (b - a);
}

struct Uncovered {
  double value = 0;
  Vec2 where;
};

/// The boundary from one foot on to another, against the two disks that touch there.
void cross_gap(const Problem& problem, const Foot& from, const Foot& to, bool wrapped,
               Uncovered& worst) {
  const Disk& a = problem.disk(from.node);
  const Disk& b = problem.disk(to.node);
  Vec2 p = point_of(problem, from);
  const auto advance = [&](Vec2 q) {
    const double amount = uncovered(a, b, p, q);
    if (!(amount <= worst.value)) worst = {amount, midpoint(p, q)};
    p = q;
  };
  std::uint32_t edge = from.edge;
  if (edge != to.edge || wrapped) {
    do {
      edge = problem.next[edge];
      advance(problem.point(edge));
    } while (edge != to.edge);
  }
  advance(point_of(problem, to));
}

/// Walks once around a loop, from stretch to stretch.
void walk_loop(const Problem& problem, const Stretches& stretches, std::size_t loop,
               Uncovered& worst) {
  const std::uint32_t begin = problem.shape.loop_begin[loop],
                      end = problem.shape.loop_begin[loop + 1];
  bool any = false;
  Foot first{}, reach{};
  for (std::uint32_t i = begin; i < end; ++i) {
    for (std::uint32_t j = stretches.first[i]; j < stretches.first[i + 1]; ++j) {
      const Stretch& stretch = stretches.all[j];
      if (!any) {
        first = {i, stretch.begin, stretch.begin_node};
        any = true;
      } else if (reach.edge != i || stretch.begin > reach.at) {
        cross_gap(problem, reach, {i, stretch.begin, stretch.begin_node}, false, worst);
      } else if (stretch.end <= reach.at) {
        continue;
      }
      reach = {i, stretch.end, stretch.end_node};
    }
  }
  if (any)
    cross_gap(problem, reach, first, true, worst);
  else
    worst = {problem.diagonal, problem.point(begin)};
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
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

/// The areas on both sides of an edge, between the curve and the feet of its disks: the polygon of
/// centres and feet, and the sliver between the curve and its chord, which is two thirds of the
/// control triangle for a parabola and nothing for the other, straight, edges.
struct Sides {
  double left = 0, right = 0;
};
Sides swept(const Curve& curve, const std::array<Vec2, 2>& left, const std::array<Vec2, 2>& right) {
  const Vec2 a = curve.origin, b = curve.end;
  const double sliver = curve.weight == 1 ? cross(curve.p1, curve.p2) / 3 : 0;
  // The curve bulges to the right where the control point does: then the left side has more.
  return {
      0.5 * (doubled_triangle(a, b, left[1]) + doubled_triangle(a, left[1], left[0])) + sliver,
      0.5 * (doubled_triangle(b, a, right[0]) + doubled_triangle(b, right[0], right[1])) - sliver};
}

/// Where a side of an edge ends at a node: its foot there.
struct Spoke {
  std::uint32_t site;
  Vec2 foot;
  bool counter_clockwise;  ///< whether the swept area lies on the foot's counter-clockwise side
};

/// The slices of a node's disk between neighbouring edges. Mostly neighbours share a site and so
/// the foot, and nothing lies between them. Where the axis passes from a segment to the vertex at
/// its end, or several sites touch within the tolerance, the feet differ a little: the triangle of
/// the centre and both feet belongs to the disk.
double slices(Vec2 center, const std::vector<Spoke>& spokes) {
  std::vector<Spoke> left;
  for (const Spoke& spoke : spokes) {
    bool paired = false;
    for (std::size_t j = 0; j < left.size() && !paired; ++j) {
      if (left[j].site == spoke.site && left[j].counter_clockwise != spoke.counter_clockwise) {
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(j));
        paired = true;
      }
    }
    if (!paired) left.push_back(spoke);
  }
  if (left.empty()) return 0;
  // Where one area ends, the next begins at the nearest foot.
  double doubled = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i].counter_clockwise) continue;
    std::size_t best = left.size();
    double turn = 0;
    for (std::size_t j = 0; j < left.size(); ++j) {
      if (!left[j].counter_clockwise) continue;
      const double sine = doubled_triangle(center, left[i].foot, left[j].foot);
      const double cosine = dot(left[i].foot - center, left[j].foot - center);
      const double angle = std::abs(std::atan2(sine, cosine));
      if (best == left.size() || angle < turn) {
        best = j;
        turn = angle;
      }
    }
    if (best < left.size()) doubled += doubled_triangle(center, left[i].foot, left[best].foot);
  }
  return 0.5 * doubled;
}

}  // namespace

void check_coverage(const Problem& problem, Certificate& certificate) {
  const Stretches stretches = collect(problem);
  Uncovered worst;
  for (std::size_t i = 0; i < problem.shape.loop_count(); ++i)
    walk_loop(problem, stretches, i, worst);
  certificate.largest_uncovered = worst.value;
  // A foot may lie the tolerance outside its disk; between the feet of different nodes a gap of
  // width g, which rises by g^2 / (8 r) over their disks, may add as much again.
  const double limit = 2 * problem.tolerance;
  if (!(worst.value <= limit))
    certificate.failures.push_back(sentence(
        "A stretch of the boundary is touched by no disk: near (%.17g, %.17g) it lies %.3g "
        "outside the union of the disks, over %.3g.",
        worst.where.x, worst.where.y, worst.value, limit));
}

void check_area(const Problem& problem, Certificate& certificate) {
  const Shape& shape = problem.shape;
  const MedialAxis& axis = problem.axis;
  if (shape.points.empty()) return;

  // The shape's own area and perimeter, from a point of it.
  const Vec2 origin = shape.points[0];
  Sum own, perimeter;
  for (std::uint32_t i = 0; i < shape.points.size(); ++i) {
    own.add(0.5 * doubled_triangle(origin, problem.point(i), problem.point(problem.next[i])));
    perimeter.add(distance(problem.point(i), problem.point(problem.next[i])));
  }
  certificate.shape_area = own.value();

  // Every spoke of an edge ends one swept area; the spokes around each node say what lies between.
  struct Swept {
    Sides sides;
    std::array<std::array<Vec2, 2>, 2> foot;  ///< by side (left, right) and end
  };
  std::vector<Swept> edges(axis.edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    const Edge& edge = axis.edges[i];
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t end = 0; end < 2; ++end)
        edges[i].foot[side][end] =
            foot(axis.sites[edge.site[side]], problem.disk(edge.node[end]).center);
    edges[i].sides = swept(curve_of(axis, edge), edges[i].foot[0], edges[i].foot[1]);
  });
  const double limit = 4 * problem.tolerance * perimeter.value();
  Sum all;
  std::size_t backward = 0, first = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Sides& sides = edges[i].sides;
    all.add(sides.left);
    all.add(sides.right);
    if (std::min(sides.left, sides.right) < -limit && backward++ == 0) first = i;
  }
  const Incidence incidence(axis);
  std::vector<Spoke> spokes;
  for (std::uint32_t n = 0; n < axis.nodes.size(); ++n) {
    spokes.clear();
    const auto around = incidence.edges(n);
    for (std::size_t k = 0; k < around.size(); ++k) {
      const Edge& edge = axis.edges[around[k]];
      // An edge from the node to itself stands here twice, first with its beginning.
      const bool again = k > 0 && around[k - 1] == around[k];
      const std::size_t end = edge.node[0] == n && !again ? 0 : 1;
      // Seen from the centre, an edge's area begins on its right side and ends on its left.
      for (std::size_t side = 0; side < 2; ++side)
        spokes.push_back(
            {edge.site[side], edges[around[k]].foot[side][end], (side == 1) == (end == 0)});
    }
    all.add(slices(problem.disk(n).center, spokes));
  }
  certificate.disks_area = all.value();

  // Neighbouring areas share their spokes, so only the feet's rounding, a part of the tolerance
  // along the whole boundary, is left in the sum, on either side of it; and as much again for the
  // terms'.
  const double difference = certificate.disks_area - certificate.shape_area;
  if (!(std::abs(difference) <= limit))
    certificate.failures.push_back(
        sentence("The disks cover an area of %.17g, which differs from the shape's area of %.17g "
                 "by %.3g, over "
                 "%.3g.",
                 certificate.disks_area, certificate.shape_area, difference, limit));
  if (backward > 0)
    certificate.failures.push_back(
        sentence("%zu edges run backward along a site: what they sweep there has a negative area; "
                 "the first is "
                 "edge %zu.",
                 backward, first));
}

}  // namespace medial::verify_detail
