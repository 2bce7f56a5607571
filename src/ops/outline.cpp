#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/arc.h"
#include "medial/sides.h"

namespace medial {
namespace {

/// An edge seen from one of its ends: half edge 2 e leaves edge e's node[0], 2 e + 1 its node[1].
using HalfEdge = std::uint32_t;
constexpr HalfEdge kNone = 0xFFFFFFFF;

/// Walks around the axis with the axis on its left and the boundary on its right.
class Outliner {
 public:
  explicit Outliner(const MedialAxis& axis) : axis_(axis), next_(2 * axis.edges.size(), kNone) {
    const Incidence incidence(axis);
    for (std::uint32_t node = 0; node < axis.nodes.size(); ++node)
      link_around(node, incidence.edges(node));
  }

  std::vector<Contour> run() {
    std::vector<Contour> contours;
    std::vector<bool> done(next_.size(), false);
    std::vector<bool> has_edge(axis_.nodes.size(), false);
    for (HalfEdge start = 0; start < next_.size(); ++start) {
      has_edge[from(start)] = true;
      if (done[start]) continue;
      Contour contour;
      HalfEdge half = start;
      do {
        done[half] = true;
        add_side(half, contour);
        add_gap(half, next_[half], contour);
        half = next_[half];
      } while (half != start);
      if (!contour.pieces.empty()) contours.push_back(std::move(contour));
    }
    for (std::uint32_t node = 0; node < axis_.nodes.size(); ++node)
      if (!has_edge[node]) contours.push_back(circle(axis_.nodes[node].disk));
    return contours;
  }

 private:
  const Edge& edge(HalfEdge half) const { return axis_.edges[half / 2]; }
  std::uint32_t from(HalfEdge half) const { return edge(half).node[half % 2]; }
  std::uint32_t to(HalfEdge half) const { return edge(half).node[1 - half % 2]; }

  /// The frame at the end of a half edge where it begins, or where it ends; in its direction.
  AxisFrame frame(HalfEdge half, bool at_end) const {
    const bool forward = half % 2 == 0;
    AxisFrame frame = frame_at(axis_, edge(half), forward == at_end ? 1 : 0);
    if (!forward) {
      frame.tangent = -frame.tangent;
      frame.radius_rate = -frame.radius_rate;
      frame.curvature = -frame.curvature;
    }
    return frame;
  }

  /// After a half edge that arrives, the walk goes on along the one that leaves next, to the right.
  void link_around(std::uint32_t node, std::span<const std::uint32_t> edges) {
    leaving_.clear();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Edge& e = axis_.edges[edges[i]];
      // An edge from a node to itself stands there twice.
      const bool second = e.node[0] != node || (i > 0 && edges[i - 1] == edges[i]);
      const HalfEdge half = 2 * edges[i] + (second ? 1 : 0);
      const Vec2 direction = frame(half, false).tangent;
      leaving_.push_back({std::atan2(direction.y, direction.x), half});
    }
    std::sort(leaving_.begin(), leaving_.end());
    for (std::size_t i = 0; i < leaving_.size(); ++i) {
      const HalfEdge arriving = leaving_[i].second ^ 1U;
      next_[arriving] = leaving_[(i + 1) % leaving_.size()].second;
    }
  }

  bool exact(HalfEdge half) const {
    const std::uint32_t site = edge(half).site[half % 2 == 0 ? 1 : 0];
    return axis_.resolution == 0 && site < axis_.sites.size();
  }
  const Site& right_site(HalfEdge half) const {
    return axis_.sites[edge(half).site[half % 2 == 0 ? 1 : 0]];
  }

  /// Where the disk at an end of a half edge touches the boundary on the right.
  Vec2 touch(HalfEdge half, bool at_end) const {
    const Disk& disk = axis_.nodes[at_end ? to(half) : from(half)].disk;
    if (exact(half)) return foot(right_site(half), disk.center);
    return boundary_at(frame(half, at_end), Side::right).point;
  }

  static void move_to(Vec2 point, Contour& contour) {
    if (contour.points.empty()) contour.start_at(point);
  }

  void add_side(HalfEdge half, Contour& contour) const {
    const Vec2 begin = touch(half, false), end = touch(half, true);
    move_to(begin, contour);
    if (begin == end) return;
    const bool arc = exact(half) && right_site(half).kind == SiteKind::arc;
    if (!arc) return contour.line_to(end);
    const Site& site = right_site(half);
    contour.arc_to(end, partial_bulge({site.start, site.end, site.bulge}, begin, end));
  }

  /// The arc of the disk between two half edges, counter-clockwise: the gap in (3).
  void add_gap(HalfEdge before, HalfEdge after, Contour& contour) const {
    const Disk& disk = axis_.nodes[to(before)].disk;
    const Vec2 begin = touch(before, true), end = touch(after, false);
    if (begin == end) return;
    const double step = distance(begin, end);
    const Vec2 u = begin - disk.center, v = end - disk.center;
    double angle = std::atan2(cross(u, v), dot(u, v));
    // Around an end the arc may be more than a half circle. Elsewhere a step backwards is rounding,
    // or two samples whose sides overlap where the axis bends.
    const bool around_an_end = (before ^ 1U) == after;
    const double slack = std::max(4 * axis_.tolerance, 1e-9 * disk.radius);
    if (step <= slack || disk.radius <= slack || (angle < 0 && !around_an_end))
      return contour.line_to(end);
    if (angle < 0) angle += 2 * std::numbers::pi;
    if (angle <= std::numbers::pi) return contour.arc_to(end, std::tan(angle / 4));
    const Vec2 middle = disk.center + turned(u, std::cos(angle / 2), std::sin(angle / 2));
    contour.arc_to(middle, std::tan(angle / 8));
    contour.arc_to(end, std::tan(angle / 8));
  }

  static Contour circle(const Disk& disk) {
    Contour contour;
    const Vec2 east{disk.radius, 0};
    contour.start_at(disk.center + east);
    contour.arc_to(disk.center - east, 1);
    contour.arc_to(disk.center + east, 1);
    return contour;
  }

  const MedialAxis& axis_;
  std::vector<HalfEdge> next_;
  std::vector<std::pair<double, HalfEdge>> leaving_;
};

}  // namespace

std::vector<Contour> boundary_of(const MedialAxis& axis) { return Outliner(axis).run(); }

}  // namespace medial
