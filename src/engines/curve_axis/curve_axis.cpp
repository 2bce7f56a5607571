#include "medial/curve_axis.h"

#include <cmath>

#include "base/in_flight.h"
#include "engines/curve_axis/control.h"
#include "medial/shape.h"

namespace medial {
namespace curve_axis {
namespace {

/// The control point of a quadratic in x, y and r that has the axis's directions at both ends.
Disk control_between(const AxisPoint& a, const AxisPoint& b) {
  const Vec2 chord = b.disk.center - a.disk.center;
  const Disk middle{midpoint(a.disk.center, b.disk.center), (a.disk.radius + b.disk.radius) / 2};
  const double sine = cross(a.tangent, b.tangent);
  const double ahead = cross(chord, b.tangent) / sine, back = cross(a.tangent, chord) / sine;
  const double length = norm(chord);
  // Parallel, or an inflection in between: straight.
  if (!(ahead > 0 && back > 0 && ahead < length && back < length)) return middle;
  const double radius =
      (a.disk.radius + ahead * a.radius_rate + b.disk.radius - back * b.radius_rate) / 2;
  return {a.disk.center + ahead * a.tangent, radius};
}

/// The segments' branches as a graph and as lists of points.
class Assembly {
 public:
  Assembly(const SmoothBoundary& boundary, const Control& control)
      : boundary_(boundary), control_(control) {}

  CurveAxis take(double step) {
    const std::vector<int>& roots = control_.roots();
    if (control_.last_tip()) {
      add(roots[0], node_of(*control_.last_tip()), *control_.last_tip());
    } else {
      // Both branches of a meeting end in its disk, which is the last point of the first.
      const AxisPoint& meeting = segment(roots[0]).branch.back();
      const std::uint32_t node = node_of(meeting);
      add(roots[0], node, meeting);
      AxisPoint backwards = meeting;
      backwards.tangent = -meeting.tangent;
      backwards.radius_rate = -meeting.radius_rate;
      std::swap(backwards.left, backwards.right);
      add(roots[1], node, backwards);
    }
    while (!waiting_.empty()) {
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      add(next.segment, next.node, next.end);
    }
    result_.rules = control_.rules();
    finish(step);
    return std::move(result_);
  }

 private:
  struct Waiting {
    int segment;
    std::uint32_t node;
    AxisPoint end;
  };
  const Segment& segment(int i) const { return control_.segments()[static_cast<std::size_t>(i)]; }

  std::uint32_t node_of(const AxisPoint& point) {
    result_.axis.nodes.push_back({point.disk, 0, NodeKind::leaf});
    return static_cast<std::uint32_t>(result_.axis.nodes.size() - 1);
  }

  /// A segment's branch from its first point to a node that is there already.
  void add(int index, std::uint32_t end_node, const AxisPoint& end) {
    const Segment& from = segment(index);
    std::vector<CurveAxisPoint> list;
    std::uint32_t before = 0;
    const AxisPoint* previous = nullptr;
    const auto append = [&](const AxisPoint& point, std::uint32_t node) {
      double length = 0;
      if (previous != nullptr) {
        length = list.back().length + distance(previous->disk.center, point.disk.center);
        result_.axis.edges.push_back(
            {{before, node}, {no_site, no_site}, control_between(*previous, point), 1});
      }
      list.push_back({length, point.disk, boundary_.above(point.left.u, 0),
                      boundary_.above(point.right.u, 0)});
      before = node;
      previous = &point;
    };
    for (const AxisPoint& point : from.branch)
      if (!(point.disk.center == end.disk.center)) append(point, node_of(point));
    const std::uint32_t first =
        list.empty() ? end_node : before - static_cast<std::uint32_t>(list.size() - 1);
    append(end, end_node);
    if (list.size() > 1) result_.branches.push_back(std::move(list));
    if (from.first_child < 0) return;
    const AxisPoint& junction = from.branch.front();
    for (const int child : {from.first_child, from.second_child})
      waiting_.push_back({child, first, seen_from(child, junction)});
  }

  /// A junction as the end of one of its two older branches: with that branch's feet and direction.
  AxisPoint seen_from(int child, const AxisPoint& junction) const {
    const AxisPoint& last = segment(child).branch.back();
    // It shares one foot with the third branch; the other one is the middle foot.
    AxisPoint out = junction;
    const double n = boundary_.period();
    const auto apart = [&](double a, double b) {
      return std::abs(a - b - n * std::round((a - b) / n));
    };
    const bool keeps_left =
        apart(last.left.u, junction.left.u) <= apart(last.right.u, junction.right.u);
    if (keeps_left) {
      out.right = foot_beside(last.right.u, junction.disk);
    } else {
      out.left = foot_beside(last.left.u, junction.disk);
    }
    const Vec2 chord = out.left.point - out.right.point;
    out.tangent = (1 / norm(chord)) * -left_of(chord);
    out.radius_rate =
        dot(junction.disk.center - midpoint(out.left.point, out.right.point), out.tangent) /
        junction.disk.radius;
    return out;
  }

  /// Where a disk touches the boundary next to u: a few of Newton's steps.
  BoundaryPoint foot_beside(double u, const Disk& disk) const {
    for (int round = 0; round < 8; ++round) {
      const BoundaryPoint p = boundary_.at(u);
      const Vec2 d = disk.center - p.point;
      u += dot(d, p.tangent) / ((1 - p.curvature * dot(d, p.normal())) * p.speed);
    }
    return boundary_.at(u);
  }

  void finish(double step) {
    MedialAxis& axis = result_.axis;
    axis.method = "curve-axis";
    axis.resolution = step;
    axis.tolerance = 0;
    std::vector<int> degree(axis.nodes.size(), 0);
    for (const Edge& edge : axis.edges)
      for (const std::uint32_t node : edge.node) ++degree[node];
    for (std::size_t i = 0; i < axis.nodes.size(); ++i)
      axis.nodes[i].kind = degree[i] == 1   ? NodeKind::leaf
                           : degree[i] == 2 ? NodeKind::site_change
                                            : NodeKind::branching;
  }

  const SmoothBoundary& boundary_;
  const Control& control_;
  CurveAxis result_;
  std::vector<Waiting> waiting_;
};

std::optional<Error> refuse(std::span<const Contour> contours, const CurveAxisOptions& options) {
  if (!(options.step >= 1e-6 && options.step <= 0.1))
    return Error{ErrorCode::invalid_option, "the step must be in [1e-6, 0.1]", {}};
  if (contours.size() != 1)
    return Error{ErrorCode::unsupported,
                 "the method curve-axis takes one boundary without holes: use the method disks",
                 {}};
  if (contours[0].pieces.empty()) return Error{ErrorCode::empty, "the contour is empty", {}};
  // Segments are looked up one by one: the time grows with the square of the maxima.
  constexpr std::size_t most_pieces = 20000;
  if (contours[0].pieces.size() > most_pieces)
    return Error{ErrorCode::too_large, "the contour has more than 20,000 pieces", {}};
  if (Status rough = find_roughness(normalized(contours[0])); !rough) return rough.error();
  // Crossings, and whatever else makes no shape.
  const auto rings = approximate_by_arcs(contours, {.tolerance = 1e-4});
  if (!rings) return rings.error();
  const auto shape = build_shape(*rings);
  if (!shape) return shape.error();
  return std::nullopt;
}

}  // namespace
}  // namespace curve_axis

Result<CurveAxis> compute_curve_axis(std::span<const Contour> contours,
                                     const CurveAxisOptions& options) {
  using namespace curve_axis;
  try {
    if (auto error = refuse(contours, options)) return std::move(*error);
    const SmoothBoundary boundary(normalized(contours[0]));
    const double step = options.step * boundary.size();
    Control control(boundary, options, step);
    if (Status done = control.run(); !done) return std::move(done).error();
    return Assembly(boundary, control).take(step);
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
