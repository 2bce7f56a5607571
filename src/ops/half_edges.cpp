#include "ops/half_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "axis/steps.h"
#include "base/arc.h"
#include "base/compat.h"

namespace medial::ops {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

}  // namespace

HalfEdges::HalfEdges(const MedialAxis& axis, Around order)
    : axis_(axis), next_(2 * axis.edges.size()) {
  const Incidence incidence(axis);
  std::vector<HalfEdge> leaving;
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node) {
    const auto edges = incidence.edges(node);
    leaving.clear();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      // An edge from a node to itself stands there twice.
      const bool second =
          axis.edges[edges[i]].node[0] != node || (i > 0 && edges[i - 1] == edges[i]);
      leaving.push_back(2 * edges[i] + (second ? 1 : 0));
    }
    if (leaving.size() <= 2) {
      for (std::size_t i = 0; i < leaving.size(); ++i)
        next_[twin(leaving[i])] = leaving[leaving.size() - 1 - i];
    } else if (order == Around::sites) {
      if (!link_three(leaving)) link_by_site(leaving);
    } else {
      link_by_direction(leaving);
    }
  }
}

void HalfEdges::link_by_direction(std::span<const HalfEdge> leaving) {
  std::vector<std::pair<double, HalfEdge>> ends;
  for (const HalfEdge half : leaving) ends.emplace_back(direction(half), half);
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i < ends.size(); ++i)
    next_[twin(ends[i].second)] = ends[(i + 1) % ends.size()].second;
}

bool HalfEdges::link_three(std::span<const HalfEdge> leaving) {
  if (leaving.size() != 3) return false;
  std::uint32_t site[3], arriving[3];
  for (std::size_t i = 0; i < 3; ++i) {
    site[i] = right_site(leaving[i]);
    arriving[i] = right_site(twin(leaving[i]));
  }
  const auto differ = [](const std::uint32_t(&s)[3]) {
    return s[0] != s[1] && s[1] != s[2] && s[2] != s[0];
  };
  if (!differ(site) || !differ(arriving)) return false;
  std::size_t after[3];
  for (std::size_t i = 0; i < 3; ++i) {
    after[i] = static_cast<std::size_t>(std::find(site, site + 3, arriving[i]) - site);
    if (after[i] == 3) return false;
  }
  for (std::size_t i = 0; i < 3; ++i) next_[twin(leaving[i])] = leaving[after[i]];
  return true;
}

/// Usually, the boundary between a half edge that arrives and the next one that leaves has one
/// site, which pairs them. If it has two, they are ordered like their feet.
void HalfEdges::link_by_site(std::span<const HalfEdge> leaving) {
  struct End {
    double key;  // the site, then the angle of its foot
    HalfEdge half;
  };
  std::vector<End> in, out, in_left, out_left;
  for (const HalfEdge half : leaving) {
    in.push_back({static_cast<double>(right_site(twin(half))), twin(half)});
    out.push_back({static_cast<double>(right_site(half)), half});
  }
  const auto by_key = [](const End& a, const End& b) {
    return a.key < b.key || (a.key == b.key && a.half < b.half);
  };
  std::sort(in.begin(), in.end(), by_key);
  std::sort(out.begin(), out.end(), by_key);
  const auto once = [](const std::vector<End>& ends, std::size_t i) {
    return (i == 0 || ends[i - 1].key != ends[i].key) &&
           (i + 1 == ends.size() || ends[i + 1].key != ends[i].key);
  };
  std::size_t i = 0, j = 0;
  while (i < in.size() || j < out.size()) {
    if (j == out.size() || (i < in.size() && in[i].key < out[j].key)) {
      in_left.push_back(in[i++]);
    } else if (i == in.size() || out[j].key < in[i].key) {
      out_left.push_back(out[j++]);
    } else if (once(in, i) && once(out, j)) {
      next_[in[i++].half] = out[j++].half;
    } else {
      const double key = in[i].key;
      while (i < in.size() && in[i].key == key) in_left.push_back(in[i++]);
      while (j < out.size() && out[j].key == key) out_left.push_back(out[j++]);
    }
  }
  if (in_left.empty()) return;
  const Vec2 center = disk(leaving[0], false).center;
  for (auto* ends : {&in_left, &out_left}) {
    for (End& end : *ends) {
      const Vec2 touch = foot(axis_.sites[right_site(end.half)], center) - center;
      end.key = std::atan2(touch.y, touch.x);
    }
    std::sort(ends->begin(), ends->end(), by_key);
  }
  // The turn of one list against the other that brings the first foot to the next one
  // counter-clockwise: an arc that the disk touches all along may lie between the two.
  const auto ahead = [&](const End& end) {
    constexpr double hardly = 1e-6;  // a backward step caused by rounding
    const double turn = std::remainder(end.key - in_left[0].key, full_turn);
    return std::abs(turn < -hardly ? turn + full_turn : turn);
  };
  const auto following =
      std::min_element(out_left.begin(), out_left.end(),
                       [&](const End& a, const End& b) { return ahead(a) < ahead(b); });
  const auto shift = static_cast<std::size_t>(following - out_left.begin());
  for (std::size_t k = 0; k < in_left.size(); ++k)
    next_[in_left[k].half] = out_left[(k + shift) % out_left.size()].half;
}

AxisJet HalfEdges::jet(HalfEdge half, bool at_end) const {
  const bool forward = half % 2 == 0;
  const AxisJet jet = jet_at(axis_, edge(half), forward == at_end ? 1 : 0);
  return forward ? jet : reversed(jet);
}

Vec2 HalfEdges::touch(HalfEdge half, bool at_end) const {
  if (exact(half))
    return touch_of(axis_, axis_.sites[right_site(half)], disk(half, at_end).center, at_end);
  return boundary_at(jet(half, at_end), Side::right).point;
}

double HalfEdges::direction(HalfEdge half) const {
  // Halfway between the feet: they are far apart also where the edge is too short to have a
  // direction of its own.
  constexpr double apart = 1e-6;  // of the radius
  const Disk& at = disk(half, false);
  if (exact(half) && exact(twin(half))) {
    const Vec2 right = touch(half, false) - at.center, left = touch(twin(half), true) - at.center;
    if (distance(left, right) > apart * at.radius)
      return std::remainder(std::atan2(right.y, right.x) + left_turn(right, left) / 2, full_turn);
    // If both feet coincide, the direction is towards them if the radius shrinks, or else away.
    const Disk& other = disk(half, true);
    if (distance(other.center, at.center) <= apart * at.radius) {
      const Vec2 out = other.radius <= at.radius ? right + left : -(right + left);
      return std::atan2(out.y, out.x);
    }
  }
  const Vec2 tangent = jet(half, false).tangent;
  return std::atan2(tangent.y, tangent.x);
}

double HalfEdges::gap(HalfEdge half) const {
  const HalfEdge after = next_[half];
  // Along one site, there is no gap.
  if (exact(half) && right_site(half) == right_site(after) && twin(half) != after) return 0;
  const Disk& at = disk(half, true);
  const Vec2 begin = touch(half, true), end = touch(after, false);
  const double slack = slack_of(axis_, at);
  if (at.radius <= slack) return 0;
  const double angle = left_turn(begin - at.center, end - at.center);
  const bool around_an_end = twin(half) == after;
  constexpr double hardly = 1e-6;
  if (around_an_end && distance(begin, end) <= hardly * at.radius) {
    // Both feet in one place: in front, where the radius shrinks along the edge, and all around is
    // open; or behind, where it grows.
    if (!(disk(after, true).radius < at.radius))
      return distance(begin, end) <= slack || angle > std::numbers::pi ? 0 : angle;
    return angle > std::numbers::pi ? angle : full_turn;
  }
  // A full turn up to rounding is a backward step.
  if (distance(begin, end) <= slack || full_turn - angle < hardly) return 0;
  if (angle <= std::numbers::pi || exact(half) || around_an_end) return angle;
  // Samples: a step backwards, or more than a half circle? The tangents and rates decide: a foot
  // is acos(-R_a) away from the direction in which the axis leaves.
  const AxisJet back = jet(twin(half), false), on = jet(after, false);
  const auto to_foot = [](const AxisJet& f) {
    return std::acos(std::clamp(-f.radius_rate, -1.0, 1.0));
  };
  const double expected = left_turn(back.tangent, on.tangent) - to_foot(back) - to_foot(on);
  return expected > 0 ? angle : 0;
}

double slack_of(const MedialAxis& axis, const Disk& disk) {
  return std::max(4 * axis.tolerance, 1e-9 * disk.radius);
}

std::array<Vec2, 2> feet_at(const MedialAxis& axis, const Edge& edge, double t, const Disk& disk,
                            bool by_sites) {
  if (by_sites)
    return {foot(axis.sites[edge.site[0]], disk.center),
            foot(axis.sites[edge.site[1]], disk.center)};
  const AxisJet jet = jet_at(axis, edge, t);
  return {boundary_at(jet, Side::left).point, boundary_at(jet, Side::right).point};
}

Vec2 touch_of(const MedialAxis& axis, const Site& site, Vec2 center, bool ends) {
  if (site.kind() == SiteKind::arc && site.bulge > 0) {
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

Ring ring_of(const Contour& contour, double step) {
  Ring ring;
  const auto add = [&](Vec2 start, Vec2 end, double bulge) {
    if (distance(start, end) <= step) return;
    ring.points.push_back(start);
    ring.bulges.push_back(bulge);
  };
  for (const CurvePiece& piece : contour.pieces)
    add(contour.points[piece.first], contour.points[piece.first + 1], piece.bulge);
  add(contour.points.back(), contour.points.front(), 0);
  if (ranges::all_of(ring.bulges, [](double bulge) { return bulge == 0; })) ring.bulges.clear();
  return ring;
}

}  // namespace medial::ops
