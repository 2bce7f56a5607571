#include "methods/curve_axis/curve_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "axis/node_kinds.h"
#include "base/box_tree.h"
#include "base/disjoint_sets.h"
#include "base/in_flight.h"
#include "base/local_frame.h"
#include "medial/shape.h"
#include "methods/curve_axis/bridges.h"
#include "methods/curve_axis/control.h"
#include "methods/curve_axis/fits.h"

namespace medial {
namespace curve_axis {
namespace {

/// The control point of a quadratic in (x, y, r) that has the axis' directions at both ends.
Disk control_between(const AxisPoint& a, const AxisPoint& b) {
  const Vec2 chord = b.disk.center - a.disk.center;
  const Disk middle{midpoint(a.disk.center, b.disk.center), (a.disk.radius + b.disk.radius) / 2};
  const double sine = cross(a.tangent, b.tangent);
  const double ahead = cross(chord, b.tangent) / sine, back = cross(a.tangent, chord) / sine;
  const double length = norm(chord);
  // If the directions are parallel, or there is an inflection in between, the edge is straight.
  if (!(ahead > 0 && back > 0 && ahead < length && back < length)) return middle;
  const double radius =
      (a.disk.radius + ahead * a.radius_rate + b.disk.radius - back * b.radius_rate) / 2;
  return {a.disk.center + ahead * a.tangent, radius};
}

/// The largest deviation of the graph's quadratics from the axis between two points, as a share of
/// the size.
constexpr double between_points = 1e-8;
/// In steps. Points are inserted between points further apart than this.
constexpr double longest_step = 1.5;
/// Points are also inserted if the boundary turns by more than this in between, in radians: next to
/// tips, the scale of the axis is the distance to the tip.
constexpr double largest_turn_between = 0.0125;
/// Points are also inserted if the axis' second derivatives deviate from linear by more than this
/// share: differences of seven points must determine the curvatures of the boundary.
constexpr double bend_between = 1e-4;
/// No points are inserted if those differences would lose more by the rounding of the disks, this
/// share of the size, than they gain.
constexpr double disk_rounding = 3e-16;
/// Points much closer to each other than their neighbours mainly add rounding errors to
/// differences.
constexpr double shortest_step = 0.25;
/// The least number of intervals on a smooth run: jets_along() needs seven points.
constexpr std::size_t smooth_run = 6;
/// Disks whose centres are closer than this share of the size are one node: junctions of more than
/// three branches in symmetric shapes.
constexpr double one_node = 1e-12;
/// How often the interval between two generated points may be halved.
constexpr int most_halvings = 12;
/// The turns with which Generator::first_after() searches for first points after a tip.
constexpr double largest_tip_turn = 0.05, least_tip_turn = 1e-4;

/// The distance of a point of the axis between a and b from the quadratic that connects them, in
/// the plane or in the radius.
double distance_to_quadratic(const AxisPoint& a, const AxisPoint& b, const Disk& between) {
  const Disk control = control_between(a, b);
  const Vec2 chord = b.disk.center - a.disk.center;
  const double length = norm(chord);
  const auto along = [&](Vec2 p) { return dot(p - a.disk.center, chord) / length; };
  // 2 t (1 - t) c + t^2 length = p
  const double c = along(control.center), p = along(between.center);
  const double t = p / (c + std::sqrt(std::max(0.0, c * c + (length - 2 * c) * p)));
  const double u = 1 - t, two = 2 * t * u;
  const Vec2 center = u * u * a.disk.center + two * control.center + t * t * b.disk.center;
  const double radius = u * u * a.disk.radius + two * control.radius + t * t * b.disk.radius;
  return std::max(distance(center, between.center), std::abs(radius - between.radius));
}

/// R_aa + K_A s and R_aa - K_A s, from (7) for the left and for the right foot. Not a number in a
/// tip.
std::array<double, 2> bends_of(const AxisPoint& p) {
  const double square = (1 - p.radius_rate) * (1 + p.radius_rate), radius = p.disk.radius;
  return {-p.left.turn * square / p.left.slack(radius),
          -p.right.turn * square / p.right.slack(radius)};
}

/// Whether second derivatives change too much from a to b for differences of seven points, and
/// closer points would help; `between` is about in the middle. The error of the differences is
/// `disk_rounding` / h^2 for points h apart. If a foot comes close to its centre of curvature, at
/// the distance d, second derivatives grow as d^(-1/2), and the relative error is about 350 x^3,
/// where x is the relative deviation of the middle from linear.
bool bends_unevenly(const AxisPoint& a, const AxisPoint& b, const AxisPoint& between, double size) {
  const auto at_a = bends_of(a), at_b = bends_of(b), here = bends_of(between);
  const double most = std::max({std::abs(here[0]), std::abs(here[1]), 1 / size});
  double x = 0;
  for (const std::size_t side : {0U, 1U})
    x = std::max(x, std::abs(here[side] - 0.5 * (at_a[side] + at_b[side])) / most);
  const double h = 0.5 * distance(a.disk.center, b.disk.center);
  return x > bend_between && 350 * x * x * x * most * h * h > disk_rounding * size;
}

/// Assembles the segments' branches as a graph and as lists of points.
class Assembly {
 public:
  Assembly(const Boundary& boundary, const Control& control, double step)
      : boundary_(boundary), control_(control), generator_(boundary, step), step_(step) {}

  CurveAxis take() {
    const std::vector<int>& roots = control_.roots();
    if (control_.last_tip()) {
      AxisPoint end = *control_.last_tip();
      if (end.left.u != end.right.u) turn_round(end, 0);
      add(roots[0], node_of(end), end);
    } else {
      // Both branches of a meeting end in its disk, the last point of the first branch.
      const AxisPoint& meeting = segment(roots[0]).branch.back();
      const Segment& other = segment(roots[1]);
      const bool in_bridge = other.from_bridge && other.branch.size() == 1;
      const std::uint32_t node = in_bridge ? node_of_bridge(other) : node_of(meeting);
      add(roots[0], node, meeting);
      AxisPoint backwards = meeting;
      turn_round(backwards, 0);
      if (!in_bridge) add(roots[1], node, backwards);
    }
    while (!waiting_.empty()) {
      const Waiting next = waiting_.back();
      waiting_.pop_back();
      add(next.segment, next.node, next.end);
    }
    result_.rules = control_.rules();
    finish();
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

  /// The node that both branches at a bridge share.
  std::uint32_t node_of_bridge(const Segment& from) {
    const std::size_t bridge = boundary_.piece(from.branch.front().left.u).source;
    if (bridges_.size() <= bridge) bridges_.resize(bridge + 1, no_node);
    if (bridges_[bridge] == no_node) bridges_[bridge] = node_of(from.branch.front());
    return bridges_[bridge];
  }

  /// Adds a segment's branch, from its first point to an existing node.
  void add(int index, std::uint32_t end_node, const AxisPoint& end) {
    const Segment& from = segment(index);
    std::vector<AxisPoint> points;
    for (const AxisPoint& point : from.branch)
      if (distance(point.disk.center, end.disk.center) > one_node * boundary_.size())
        points.push_back(point);
    while (points.size() > 1 && is_close(points[points.size() - 2], points.back(), end))
      points.pop_back();
    points.push_back(end);
    points = refined(points);
    std::vector<CurveAxisPoint> list;
    std::uint32_t before = 0, first = end_node;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const AxisPoint& point = points[i];
      const std::uint32_t node = i + 1 == points.size()       ? end_node
                                 : i == 0 && from.from_bridge ? node_of_bridge(from)
                                                              : node_of(point);
      double length = 0;
      if (i == 0) {
        first = node;
      } else {
        length = list.back().length + distance(points[i - 1].disk.center, point.disk.center);
        result_.axis.edges.push_back(
            {{before, node}, {no_site, no_site}, control_between(points[i - 1], point), 1});
      }
      list.push_back({length, point.disk, boundary_.source_of(point.left.u),
                      boundary_.source_of(point.right.u)});
      before = node;
    }
    if (list.size() > 1) result_.branches.push_back(std::move(list));
    if (from.first_child < 0) return;
    const AxisPoint& junction = from.branch.front();
    waiting_.push_back({from.first_child, first, seen_between(junction, false, from.middle)});
    waiting_.push_back({from.second_child, first, seen_between(junction, true, from.middle)});
  }

  /// Whether the interval from b to c is only the rest of a step, compared with that from a to b.
  static bool is_close(const AxisPoint& a, const AxisPoint& b, const AxisPoint& c) {
    return distance(b.disk.center, c.disk.center) <
           shortest_step * distance(a.disk.center, b.disk.center);
  }

  /// A branch with additional points: between points that are too far apart for quadratics, and
  /// where a foot passes from one piece of the boundary to the next, since the axis' third
  /// derivative jumps there. Each run between two such points has enough points for differences
  /// within the run.
  std::vector<AxisPoint> refined(const std::vector<AxisPoint>& points) const {
    std::vector<AxisPoint> out{points.front()};
    std::vector<AxisPoint> run{points.front()};
    const auto end_run = [&] {
      if (run.size() == 1) return;
      int halvings = 0;
      while ((run.size() - 1) << halvings < smooth_run) ++halvings;
      for (std::size_t i = 0; i + 1 < run.size(); ++i) {
        halve(run[i], run[i + 1], 0, halvings, out);
        out.push_back(run[i + 1]);
      }
      run = {run.back()};
    };
    for (std::size_t i = 1; i < points.size(); ++i) {
      const AxisPoint& next = points[i];
      const double near = shortest_step * distance(points[i - 1].disk.center, next.disk.center);
      const auto is_near = [&](const AxisPoint& a, const AxisPoint& b) {
        return distance(a.disk.center, b.disk.center) < near;
      };
      AxisPoint here = points[i - 1];
      while (const auto joint = next_joint(here, next)) {
        here = *joint;
        if (run.size() > 1 && is_near(run.back(), here)) run.pop_back();
        if (is_near(run.back(), here) || is_near(here, points.back())) continue;
        run.push_back(here);
        end_run();
      }
      if (i + 1 < points.size() && run.size() == 1 && is_near(run.back(), next)) continue;
      run.push_back(next);
    }
    end_run();
    return out;
  }

  /// The first point between a and b with a foot at a joint of two pieces.
  std::optional<AxisPoint> next_joint(const AxisPoint& a, const AxisPoint& b) const {
    const double left = left_of_end(a, b), right = right_of_end(a, b);
    const double left_joint = std::ceil(a.left.u) - 1, right_joint = std::floor(a.right.u) + 1;
    std::optional<AxisPoint> by_left, by_right;
    if (left_joint > left) {
      const double share = (a.left.u - left_joint) / (a.left.u - left);
      by_left = generator_.with_left(left_joint, a.right.u + share * (right - a.right.u));
      if (!is_between(by_left, a, b)) by_left = {};
    }
    if (right_joint < right) {
      const double share = (right_joint - a.right.u) / (right - a.right.u);
      by_right = generator_.with_right(a.left.u + share * (left - a.left.u), right_joint);
      if (!is_between(by_right, a, b)) by_right = {};
    }
    return by_left && by_right ? (by_left->right.u < by_right->right.u ? by_left : by_right)
           : by_left           ? by_left
                               : by_right;
  }

  /// The feet of b, in the period of the parameter in which a leads to b.
  double left_of_end(const AxisPoint& a, const AxisPoint& b) const {
    return -boundary_.above(-b.left.u, -a.left.u);
  }
  double right_of_end(const AxisPoint& a, const AxisPoint& b) const {
    return boundary_.above(b.right.u, a.right.u);
  }

  /// Whether a point is between a and b.
  bool is_between(const std::optional<AxisPoint>& p, const AxisPoint& a, const AxisPoint& b) const {
    const double most = longest_step * distance(a.disk.center, b.disk.center);
    return p && p->left.u < a.left.u && p->left.u > left_of_end(a, b) && p->right.u > a.right.u &&
           p->right.u < right_of_end(a, b) && p->disk.radius > 0 &&
           distance(p->disk.center, a.disk.center) <= most &&
           distance(p->disk.center, b.disk.center) <= most;
  }

  /// Appends points between a and b until the quadratics are within the tolerance of the axis,
  /// after at least `wanted` halvings. If no point is found, the interval stays.
  void halve(const AxisPoint& a, const AxisPoint& b, int done, int wanted,
             std::vector<AxisPoint>& out) const {
    if (done == most_halvings) return;
    const auto middle = point_between(a, b);
    if (!middle) return;
    const bool is_short = distance(a.disk.center, b.disk.center) <= longest_step * step_ &&
                          std::abs(cross(a.left.tangent, b.left.tangent)) <= largest_turn_between &&
                          std::abs(cross(a.right.tangent, b.right.tangent)) <= largest_turn_between;
    if (done >= wanted && is_short && !bends_unevenly(a, b, *middle, boundary_.size()) &&
        distance_to_quadratic(a, b, middle->disk) <= between_points * boundary_.size())
      return;
    halve(a, *middle, done + 1, wanted, out);
    out.push_back(*middle);
    halve(*middle, b, done + 1, wanted, out);
  }

  /// A point of the axis about halfway from a to b.
  std::optional<AxisPoint> point_between(const AxisPoint& a, const AxisPoint& b) const {
    const double left = left_of_end(a, b), right = right_of_end(a, b);
    // At a tip, the feet separate like the square root of the way.
    const bool from_tip = a.left.u == a.right.u, to_tip = b.left.u == b.right.u;
    const double share = from_tip ? std::numbers::sqrt2 / 2
                         : to_tip ? 1 - std::numbers::sqrt2 / 2
                                  : 0.5;
    auto middle = generator_.stabilised(a.left.u + share * (left - a.left.u),
                                        a.right.u + share * (right - a.right.u));
    if (is_between(middle, a, b)) return middle;
    // The ways of the feet differ too much: take a step from one end instead.
    if (!from_tip && !to_tip)
      middle = Generator(boundary_, distance(a.disk.center, b.disk.center) / 2).next(a);
    if (from_tip)
      for (double turn = largest_tip_turn; turn > least_tip_turn && !is_between(middle, a, b);
           turn /= 2)
        middle = generator_.first_after(a, turn);
    if (to_tip)
      for (double turn = largest_tip_turn; turn > least_tip_turn && !is_between(middle, a, b);
           turn /= 2) {
        AxisPoint tip = b;
        tip.left.u = tip.right.u = right;
        middle = generator_.first_after(tip, turn);
        if (middle) turn_round(*middle, left - right);
      }
    return is_between(middle, a, b) ? middle : std::nullopt;
  }

  /// The same point, seen along the axis in the other direction. Adds `turns` to the parameter of
  /// its left foot.
  static void turn_round(AxisPoint& point, double turns) {
    std::swap(point.left, point.right);
    point.left.u += turns;
    point.tangent = -point.tangent;
    point.radius_rate = -point.radius_rate;
  }

  /// A junction as the end of one of its two older branches: with the feet of that branch, one of
  /// them the middle foot, and with its direction.
  AxisPoint seen_between(const AxisPoint& junction, bool is_second, double middle) const {
    AxisPoint out = generator_.point_of(is_second ? boundary_.at(middle) : junction.left,
                                        is_second ? junction.right : boundary_.at(middle));
    out.disk = junction.disk;
    return out;
  }

  void finish() {
    MedialAxis& axis = result_.axis;
    axis.method = "curve-axis";
    axis.resolution = step_;
    axis.tolerance = 0;
    set_node_kinds(axis);
  }

  const Boundary& boundary_;
  const Control& control_;
  const Generator generator_;
  double step_;
  CurveAxis result_;
  std::vector<Waiting> waiting_;
  static constexpr std::uint32_t no_node = 0xFFFFFFFF;
  std::vector<std::uint32_t> bridges_;  ///< the node of each
};

/// A component's loops as normalized() gives them, the outer one first.
using Loops = std::vector<Contour>;

/// Assigns contours to components. Errors: see compute_curve_axis().
Result<std::vector<Loops>> loops_of(std::span<const Contour> contours,
                                    const method::CurveAxis& options) {
  if (!(options.step >= 1e-6 && options.step <= 0.1))
    return Error{ErrorCode::invalid_option, "the step must be in [1e-6, 0.1]", {}};
  // Segments are searched linearly: the time grows with the square of the number of tips.
  constexpr std::size_t most_pieces = 20000;
  std::size_t pieces = 0;
  for (const Contour& contour : contours) pieces += contour.pieces.size();
  if (pieces == 0) return Error{ErrorCode::empty, "the contour is empty", {}};
  if (pieces > most_pieces)
    return Error{ErrorCode::too_large, "the contours have more than 20,000 pieces", {}};
  std::vector<Contour> normal;
  for (const Contour& contour : contours) {
    if (contour.pieces.empty()) return Error{ErrorCode::empty, "a contour is empty", {}};
    normal.push_back(normalized(contour));
    if (Status cusp = find_cusp(normal.back()); !cusp) return cusp.error();
  }
  // Finds crossings, and other errors of the shape.
  const auto rings = approximate_by_arcs(contours);
  if (!rings) return rings.error();
  const auto shape = build_shape(*rings);
  if (!shape) return shape.error();
  std::vector<Loops> all(shape->component_count());
  for (const bool hole : {false, true})
    for (std::size_t l = 0; l < shape->loop_count(); ++l) {
      if (shape->hole[l] != hole) continue;
      const std::uint32_t ring = shape->sources[shape->loop_begin[l]].ring;
      for (std::size_t i = shape->loop_begin[l]; i < shape->loop_begin[l + 1]; ++i)
        if (shape->sources[i].ring != ring || shape->loop_count() != contours.size())
          return Error{ErrorCode::unsupported,
                       "the method curve-axis does not take boundaries that touch: use disks",
                       {}};
      all[shape->component[l]].push_back(normal[ring]);
    }
  return all;
}

/// Checks that no point of the boundary, at distances of `spacing` of the size, is deeper inside a
/// node's disk than `slack` of the size, as happens if a branch took a wrong turn or is missing.
/// The distance of generation and graph from the axis is far less. O((n + points) log n), except
/// for points in the box of a disk but not in the disk.
Status check_disks(const Boundary& boundary, const MedialAxis& axis) {
  constexpr double spacing = 1e-3, slack = 1e-5;
  const std::vector<Vec2> points = boundary.samples(spacing * boundary.size());
  std::vector<Box> boxes;
  for (const Vec2 p : points) boxes.push_back({p, p});
  const BoxTree tree(boxes);
  for (const Node& node : axis.nodes) {
    const Vec2 center = node.disk.center;
    const double reach = node.disk.radius - slack * boundary.size();
    if (!(reach > 0)) continue;
    bool reached = false;
    tree.find({center - Vec2{reach, reach}, center + Vec2{reach, reach}},
              [&](std::uint32_t i) { reached = reached || distance(points[i], center) < reach; });
    if (!reached) continue;
    Error error{ErrorCode::unsupported,
                "curve-axis goes astray here, where the boundary reaches into a disk: use "
                "the method disks",
                {}};
    error.place.point = center;
    return error;
  }
  return success();
}

/// The axis of a circle: a boundary without a tip has the same curvature everywhere.
CurveAxis centre_of(const Boundary& boundary, double step) {
  CurveAxis result;
  result.axis.method = "curve-axis";
  result.axis.resolution = step;
  const BoundaryPoint foot = boundary.at(0);
  const double radius = 1 / foot.turn;
  result.axis.nodes.push_back({{foot.point + radius * foot.normal(), radius}, 0, NodeKind::leaf});
  return result;
}

/// How often the method restarts after a failed attempt.
constexpr int most_attempts = 5;

Result<CurveAxis> attempt(const Boundary& boundary, const method::CurveAxis& options,
                          const std::atomic<bool>* cancel) {
  const double step = options.step * boundary.size();
  if (boundary.tips().empty()) return centre_of(boundary, step);
  Control control(boundary, options, step, {}, cancel);
  if (Status done = control.run(); !done) return std::move(done).error();
  CurveAxis result = Assembly(boundary, control, step).take();
  if (Status right = check_disks(boundary, result.axis); !right) return std::move(right).error();
  return result;
}

/// The direction of the bridges in an attempt: one that drawings hardly contain.
Vec2 direction_of(int round) {
  const double angle = 2.9 + 1.7 * round;
  return {std::cos(angle), std::sin(angle)};
}

/// Applies the method to one component; if it fails, again with shorter steps and other bridges.
Result<CurveAxis> follow(const Loops& loops, const method::CurveAxis& options,
                         const std::atomic<bool>* cancel) {
  Result<CurveAxis> result =
      Error{ErrorCode::unsupported,
            "the loops around the holes cannot be entered: no disk connects them; use disks",
            {}};
  // Failures occur only with some steps, and from some tips.
  method::CurveAxis again = options;
  std::uint64_t spent = 0;
  std::uint64_t failures = 0;
  for (int round = 0; round <= most_attempts; ++round) {
    std::vector<Piece> pieces = bridged(loops, direction_of(round));
    if (pieces.empty()) continue;
    const Boundary boundary(std::move(pieces), spent);
    Result<CurveAxis> next = attempt(boundary, again, cancel);
    if (next.ok())
      if (Status right = check_cycles(next->axis, loops.size() - 1); !right) next = right.error();
    spent = boundary.evaluations();
    // Report the first error, which is the most useful one.
    if (next.ok()) next->rules.restarts = failures;
    if (failures == 0 || next.ok() || next.error().code == ErrorCode::cancelled)
      result = std::move(next);
    if (result.ok() || result.error().code != ErrorCode::unsupported) break;
    ++failures;
    again.step /= 2;
    ++again.first_maximum;
  }
  return result;
}

/// Adds a component's axis, found with `origin` at (0, 0).
void append(CurveAxis& all, std::uint32_t component, Vec2 origin, CurveAxis part) {
  const auto bring_back = [&](Disk& disk) { disk.center = disk.center + origin; };
  for (Node& node : part.axis.nodes) {
    node.component = component;
    bring_back(node.disk);
  }
  for (Edge& edge : part.axis.edges) bring_back(edge.control);
  for (auto& branch : part.branches)
    for (CurveAxisPoint& point : branch) bring_back(point.disk);
  const auto first = static_cast<std::uint32_t>(all.axis.nodes.size());
  for (Edge& edge : part.axis.edges)
    for (std::uint32_t& node : edge.node) node += first;
  MedialAxis& axis = all.axis;
  axis.nodes.insert(axis.nodes.end(), part.axis.nodes.begin(), part.axis.nodes.end());
  axis.edges.insert(axis.edges.end(), part.axis.edges.begin(), part.axis.edges.end());
  axis.resolution = std::max(axis.resolution, part.axis.resolution);
  std::move(part.branches.begin(), part.branches.end(), std::back_inserter(all.branches));
  all.rules += part.rules;
}

/// Moves loops close to the origin, where fewer digits are lost; no point is rounded. Returns the
/// point that is then at the origin.
Vec2 take_home(Loops& loops) {
  Box box = Box::nothing();
  for (const Contour& loop : loops)
    for (const Vec2 p : loop.points) box.add(p);
  const Vec2 origin = frame_of(box).origin;
  for (Contour& loop : loops)
    for (Vec2& p : loop.points) p = p - origin;
  return origin;
}

}  // namespace

Result<CurveAxis> follow_all(std::span<const Contour> contours, const method::CurveAxis& options,
                             const std::atomic<bool>* cancel) {
  auto components = loops_of(contours, options);
  if (!components) return components.error();
  CurveAxis all;
  all.axis.method = "curve-axis";
  for (std::uint32_t i = 0; i < components->size(); ++i) {
    const Vec2 origin = take_home((*components)[i]);
    Result<CurveAxis> part = follow((*components)[i], options, cancel);
    if (!part) {
      Error error = part.error();
      if (error.place.point) error.place.point = *error.place.point + origin;
      return error;
    }
    append(all, i, origin, std::move(part).value());
  }
  return all;
}

Status check_cycles(const MedialAxis& axis, std::size_t holes) {
  DisjointSets parts(axis.nodes.size());
  for (const Edge& edge : axis.edges) parts.join(edge.node[0], edge.node[1]);
  if (parts.count() == 1 && axis.edges.size() + 1 == axis.nodes.size() + holes) return success();
  Error error{ErrorCode::unsupported,
              "curve-axis goes astray: it does not go once around each hole; use the "
              "method disks",
              {}};
  if (!axis.nodes.empty()) error.place.point = axis.nodes.front().disk.center;
  return error;
}

Result<MedialAxis> run(const Problem& problem) {
  std::vector<Contour> loops;
  const Shape& shape = problem.shape;
  for (std::size_t l = 0; l < shape.loop_count() && problem.contours.empty(); ++l) {
    const std::span<const double> bulges(shape.bulges);
    loops.push_back(contour_of(
        shape.loop(l),
        bulges.empty() ? bulges : bulges.subspan(shape.loop_begin[l], shape.loop(l).size()), true));
  }
  auto result = compute_curve_axis(problem.contours.empty() ? loops : problem.contours,
                                   problem.own<method::CurveAxis>(), problem.options.cancel);
  if (!result) return std::move(result).error();
  return std::move(result->axis);
}

}  // namespace curve_axis

CurveAxisRules& CurveAxisRules::operator+=(const CurveAxisRules& other) {
  maxima += other.maxima;
  skipped += other.skipped;
  larger += other.larger;
  smaller += other.smaller;
  junctions += other.junctions;
  dissolved += other.dissolved;
  abandoned += other.abandoned;
  retreats += other.retreats;
  outside_box += other.outside_box;
  resumed += other.resumed;
  ends += other.ends;
  meetings += other.meetings;
  restarts += other.restarts;
  return *this;
}

Result<CurveAxis> compute_curve_axis(std::span<const Contour> contours,
                                     const method::CurveAxis& options,
                                     const std::atomic<bool>* cancel) {
  using namespace curve_axis;
  try {
    return follow_fit(contours, options, cancel);
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
