#include "ops/half_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/arc.h"

namespace medial::ops {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// The angle from u to v counter-clockwise, in [0, 2 pi).
double angle_between(Vec2 u, Vec2 v) {
  const double angle = std::atan2(cross(u, v), dot(u, v));
  return angle < 0 ? angle + full_turn : angle;
}

}  // namespace

HalfEdges::HalfEdges(const MedialAxis& axis) : axis_(axis), next_(2 * axis.edges.size()) {
  const Incidence incidence(axis);
  std::vector<std::pair<double, HalfEdge>> leaving;
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node) {
    const auto edges = incidence.edges(node);
    leaving.clear();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      // An edge from a node to itself stands there twice.
      const bool second =
          axis.edges[edges[i]].node[0] != node || (i > 0 && edges[i - 1] == edges[i]);
      const HalfEdge half = 2 * edges[i] + (second ? 1 : 0);
      leaving.push_back({edges.size() > 2 ? direction(half) : 0, half});
    }
    std::sort(leaving.begin(), leaving.end());
    for (std::size_t i = 0; i < leaving.size(); ++i)
      next_[leaving[i].second ^ 1U] = leaving[(i + 1) % leaving.size()].second;
  }
}

AxisFrame HalfEdges::frame(HalfEdge half, bool at_end) const {
  const bool forward = half % 2 == 0;
  AxisFrame frame = frame_at(axis_, edge(half), forward == at_end ? 1 : 0);
  if (!forward) {
    frame.tangent = -frame.tangent;
    frame.radius_rate = -frame.radius_rate;
    frame.curvature = -frame.curvature;
  }
  return frame;
}

Vec2 HalfEdges::touch(HalfEdge half, bool at_end) const {
  if (exact(half))
    return touch_of(axis_, axis_.sites[right_site(half)], disk(half, at_end).center, at_end);
  return boundary_at(frame(half, at_end), Side::right).point;
}

double HalfEdges::direction(HalfEdge half) const {
  // Halfway between the feet: they are far apart also where the edge is too short to have a
  // direction of its own.
  constexpr double apart = 1e-6;  // of the radius
  const Disk& at = disk(half, false);
  if (exact(half) && exact(half ^ 1U)) {
    const Vec2 right = touch(half, false) - at.center, left = touch(half ^ 1U, true) - at.center;
    if (distance(left, right) > apart * at.radius)
      return std::remainder(std::atan2(right.y, right.x) + angle_between(right, left) / 2,
                            full_turn);
    // Both feet in one place: straight towards it where the radius shrinks, or away from it.
    const Disk& other = disk(half, true);
    if (distance(other.center, at.center) <= apart * at.radius) {
      const Vec2 out = other.radius <= at.radius ? right + left : -(right + left);
      return std::atan2(out.y, out.x);
    }
  }
  const Vec2 tangent = frame(half, false).tangent;
  return std::atan2(tangent.y, tangent.x);
}

double HalfEdges::gap(HalfEdge half) const {
  const HalfEdge after = next_[half];
  // Along one site, the boundary just goes on.
  if (exact(half) && right_site(half) == right_site(after) && (half ^ 1U) != after) return 0;
  const Disk& at = disk(half, true);
  const Vec2 begin = touch(half, true), end = touch(after, false);
  const double slack = std::max(4 * axis_.tolerance, 1e-9 * at.radius);
  if (at.radius <= slack) return 0;
  const double angle = angle_between(begin - at.center, end - at.center);
  const bool around_an_end = (half ^ 1U) == after;
  constexpr double hardly = 1e-6;
  if (around_an_end && distance(begin, end) <= hardly * at.radius) {
    // Both feet in one place: in front, where the radius shrinks along the edge, and all around is
    // open; or behind, where it grows.
    if (!(disk(after, true).radius < at.radius))
      return distance(begin, end) <= slack || angle > std::numbers::pi ? 0 : angle;
    return angle > std::numbers::pi ? angle : full_turn;
  }
  // A disk that touches all around but for one point is a step backwards by rounding.
  if (distance(begin, end) <= slack || full_turn - angle < hardly) return 0;
  if (angle <= std::numbers::pi || exact(half) || around_an_end) return angle;
  // Samples: a step backwards, or more than a half circle? The tangents and rates decide: a foot
  // is acos(-R_a) away from the direction in which the axis leaves.
  const AxisFrame back = frame(half ^ 1U, false), on = frame(after, false);
  const auto to_foot = [](const AxisFrame& f) {
    return std::acos(std::clamp(-f.radius_rate, -1.0, 1.0));
  };
  const double expected = angle_between(back.tangent, on.tangent) - to_foot(back) - to_foot(on);
  return expected > 0 ? angle : 0;
}

Vec2 touch_of(const MedialAxis& axis, const Site& site, Vec2 center, bool ends) {
  if (site.kind == SiteKind::arc && site.bulge > 0) {
    const BulgeArc arc{site.start, site.end, site.bulge};
    const Vec2 middle = arc.start + (1 / curvature(arc)) * left_of(start_tangent(arc));
    if (distance(middle, center) <= 64 * axis.tolerance) return ends ? site.end : site.start;
  }
  return foot(site, center);
}

void add_arc(const Disk& disk, Vec2 begin, Vec2 end, double angle, Contour& contour) {
  if (angle <= std::numbers::pi) return contour.arc_to(end, std::tan(angle / 4));
  const Vec2 middle =
      disk.center + turned(begin - disk.center, std::cos(angle / 2), std::sin(angle / 2));
  contour.arc_to(middle, std::tan(angle / 8));
  contour.arc_to(end, std::tan(angle / 8));
}

}  // namespace medial::ops
