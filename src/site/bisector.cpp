#include "site/bisector.h"

#include <limits>
#include <optional>

#include "base/pair.h"
#include "base/twofold.h"
#include "site/lanes.h"

namespace medial::site {
namespace {

/// The disk that touches segment `s` at parameter `at` and the vertex.
Disk disk_over(const Site& s, double at, Vec2 vertex) {
  const Vec2 foot = s.point + at * s.direction;
  const Vec2 d = vertex - foot;
  const double r = squared_norm(d) / (2 * dot(s.normal(), d));
  return {foot + r * s.normal(), r};
}

/// A difference of disks, with the inner product of the contact equations.
struct DiskVector {
  Vec2 c;
  double r;
};
double product(const DiskVector& u, const DiskVector& v) { return dot(u.c, v.c) - u.r * v.r; }

Disk middle_of(const Disk& from, const Disk& to) {
  return {midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)};
}

/// The control point of an edge between two vertices. Along the line of centres, the radius is a
/// hyperbola: with h measured from the midpoint of the vertices, r = d cosh u and h = d sinh u. The
/// shoulder point lies at the mean u. Its weight is cosh of half the difference of u, which follows
/// without cancellation from e^u = (r + h) / d = d / (r - h) at both ends.
Control control_of_vertices(Vec2 a, Vec2 b, const Disk& from, const Disk& to) {
  const Disk middle = middle_of(from, to);
  const Vec2 foot = midpoint(a, b), across = 0.5 * (b - a);
  const double squared = squared_norm(across);
  if (!(squared > 0)) return {middle, 1};
  const Vec2 along = (1 / std::sqrt(squared)) * left_of(across);
  const auto exponential = [&](const Disk& disk) {  // times d
    const double h = dot(along, disk.center - foot);
    return h >= 0 ? disk.radius + h : squared / (disk.radius - h);
  };
  const double growth = exponential(to) / exponential(from);
  const double weight_squared = 0.25 * (growth + 1) * (1 / growth + 1);
  return {{foot + (1 / weight_squared) * (middle.center - foot), middle.radius / weight_squared},
          std::sqrt(weight_squared)};
}

/// The control point of an edge between a segment and a vertex, a parabola. The curve is polynomial
/// in the foot's parameter, so the control point is its blossom at the parameters of both ends. If
/// the vertex has the coordinates x and y relative to the segment, r(s) = ((s - x)^2 + y^2) / (2 y)
/// has the blossom ((s - x)(t - x) + y^2) / (2 y).
Control control_of_parabola(const Site& segment, Vec2 vertex, const Disk& from, const Disk& to) {
  const double y = cross(segment.direction, vertex - segment.point);
  const double s = dot(segment.direction, from.center - vertex);
  const double t = dot(segment.direction, to.center - vertex);
  if (!(y > 0)) return {middle_of(from, to), 1};
  // Far from a vertex that is close to the segment, the distance from the vertex follows more
  // accurately from the radius, by (s - x)^2 + y^2 = 2 y r, because the error of y then cancels.
  // The feet stay between those of the ends.
  constexpr double next_to = 0x1p-4;
  const auto by_radius = [&](double way, double radius) {
    return y < next_to * std::abs(way) ? std::copysign(std::sqrt(y * (2 * radius - y)), way) : way;
  };
  const double r = (by_radius(s, from.radius) * by_radius(t, to.radius) + y * y) / (2 * y);
  // Centres lie at height r over the line; the vertex at height y.
  const Vec2 center = vertex + (0.5 * (s + t)) * segment.direction + (r - y) * segment.normal();
  return {{center, r}, 1};
}

/// The control point of an edge with an arc. With P(u, v) = u.v - u_r v_r, a contact equation is
/// round P(d, d) = 2 flat (n.d - r) for the disk relative to the site's point. Its polar form at
/// both ends holds for the control point, which is the pole of the edge's chord: it lies in the
/// plane of the edge, P-perpendicular to the chord above its midpoint. The rounder of the two sites
/// gives the height above the chord and the weight.
Control pole_of_chord(const Site& a, const Site& b, const Disk& from, const Disk& to) {
  const Disk middle = middle_of(from, to);
  // An edge this short relative to its radius, the radii of its arcs, and the distances to their
  // centres (its foci) is straight up to rounding; its plane would be inaccurate.
  constexpr double straight = 1e-8;
  double size = middle.radius;
  for (const Site* s : {&a, &b})
    if (s->is_arc())
      size =
          std::min({size, 1 / std::abs(s->curvature), std::abs(1 / s->curvature - middle.radius)});
  size *= straight;
  if (squared_norm(to.center - from.center) <= size * size) return {middle, 1};
  // Scaled such that |round| + |flat| = 1.
  const auto flat_of = [](const Site& s) {
    return s.is_vertex() ? 0 : 1 / (1 + std::abs(s.curvature));
  };
  const auto round_of = [&](const Site& s) {
    return s.is_vertex() ? 1 : s.curvature / (1 + std::abs(s.curvature));
  };
  const bool by_a = std::abs(round_of(a)) >= std::abs(round_of(b));
  const Site &site = by_a ? a : b, &other = by_a ? b : a;
  const double round = round_of(site), flat = flat_of(site), ratio = round_of(other) / round;
  // The plane of the edge: g.c + s r = constant. Points relative to the middle are accurate.
  const Vec2 p = site.point - middle.center, q = other.point - middle.center;
  const Vec2 g =
      round_of(other) * (q - p) + flat_of(other) * other.normal() - (ratio * flat) * site.normal();
  const double s = ratio * flat - flat_of(other);
  const DiskVector chord{to.center - from.center, to.radius - from.radius};
  // In the plane, and P-perpendicular to the chord.
  const DiskVector across{{-g.y * chord.r - s * chord.c.y, s * chord.c.x + g.x * chord.r},
                          cross(g, chord.c)};
  // The gradient of the site's contact equation, the mean of both ends.
  const DiskVector gradient{round * (middle.center - site.point) - flat * site.normal(),
                            round * middle.radius - flat};
  const double squared = product(chord, chord);
  const double height = round * squared / (4 * product(across, gradient));
  const double weight_squared = squared / (squared + 4 * height * height * product(across, across));
  if (!(std::isfinite(height) && weight_squared > 0 && std::isfinite(weight_squared)))
    return {middle, 1};
  return {{middle.center + height * across.c, middle.radius + height * across.r},
          std::sqrt(weight_squared)};
}

/// The distance of a disk's centre from the centre of an arc, or from a vertex.
double focal_distance(const Site& s, const Disk& disk) {
  return s.is_vertex() ? disk.radius
         : s.is_arc()  ? std::abs(1 / s.curvature - disk.radius)
                       : std::numeric_limits<double>::infinity();
}
/// The smaller distance of an edge's two ends.
double focal_distance(const Site& s, const Disk& from, const Disk& to) {
  return std::min(focal_distance(s, from), focal_distance(s, to));
}

/// A disk relative to the apex of the cone of all disks that touch an arc or a vertex.
struct ConeVector {
  Twofold x, y, r;
};
Twofold product(const ConeVector& u, const ConeVector& v) {
  return u.x * v.x + u.y * v.y - u.r * v.r;
}

/// The left unit normal of a site, in twofold precision.
ConeVector unit_normal(const Site& s) {
  const Vec2 n = s.normal();
  if (s.is_vertex()) return {0.0, 0.0, 0.0};
  const Twofold size = sqrt(Twofold(n.x) * n.x + Twofold(n.y) * n.y);
  return {Twofold(n.x) / size, Twofold(n.y) / size, 0.0};
}

/// The pole in twofold precision, for an edge that is not short relative to its distance from a
/// focus. Let d = (c - q, rho - r), with the arc's centre q and its signed radius rho. The disks
/// that touch the arc form a cone, P(d, d) = 0. So the pole is P-perpendicular to both ends, which
/// gives its direction; its distance follows from the plane of the edge, in which the other site's
/// equation is linear. Each end is off the cone by its rounding relative to its distance from the
/// apex, and so is the curve near this end. Using the mean of both ends would give the near end the
/// error of the far one. None if the equations do not determine the pole.
std::optional<Control> pole_of_cone(const Site& a, const Site& b, const Disk& from,
                                    const Disk& to) {
  const bool by_a = focal_distance(a, from, to) <= focal_distance(b, from, to);
  const Site &site = by_a ? a : b, &other = by_a ? b : a;
  const ConeVector n = unit_normal(site), m = unit_normal(other);
  const Twofold rho = site.is_vertex() ? Twofold(0.0) : Twofold(1.0) / Twofold(site.curvature);
  const Twofold qx = rho * n.x + site.point.x, qy = rho * n.y + site.point.y;
  const auto seen = [&](const Disk& disk) {
    return ConeVector{Twofold(disk.center.x) - qx, Twofold(disk.center.y) - qy, rho - disk.radius};
  };
  const ConeVector first = seen(from), last = seen(to);
  const ConeVector way{first.y * last.r - first.r * last.y, first.r * last.x - first.x * last.r,
                       first.y * last.x - first.x * last.y};
  // The other site's equation relative to q: flat (m.d - r) = round P(d, d) / 2.
  const Twofold flat = other.is_vertex() ? 0.0 : 1.0;
  const Twofold round = other.is_vertex() ? 1.0 : other.curvature;
  const Twofold ex = qx - other.point.x, ey = qy - other.point.y;
  const Twofold slope =
      (m.x - round * ex) * way.x + (m.y - round * ey) * way.y + (flat - round * rho) * way.r;
  const Twofold height =
      m.x * ex + m.y * ey - flat * rho - Twofold(0.5) * round * (ex * ex + ey * ey - rho * rho);
  const Twofold share = -height / slope;
  const Disk pole{
      {static_cast<double>(qx + share * way.x), static_cast<double>(qy + share * way.y)},
      static_cast<double>(rho - share * way.r)};
  const auto weight_squared = static_cast<double>(
      -product(first, last) / (Twofold(2.0) * share * share * product(way, way)));
  if (!(weight_squared > 0 &&
        std::isfinite(weight_squared + pole.center.x + pole.center.y + pole.radius)))
    return std::nullopt;
  return Control{pole, std::sqrt(weight_squared)};
}

/// The largest distance by which the edge with this control point fails to touch its sites.
/// Measured in the middle and next to the ends, where it may be bent most; near a focus, on all
/// scales down to rounding.
double deviation(const Control& control, const Site& a, const Site& b, const Disk& from,
                 const Disk& to, bool near_focus) {
  Pair worst{};
  const auto add = [&](Pair t) {  // two parameters at a time
    const Pair rest = 1 - t, first = rest * rest, last = t * t;
    const Pair middle = 2 * t * rest * control.weight, scale = 1 / (first + middle + last);
    const auto mean = [&](double at_first, double between, double at_last) {
      return scale * (first * at_first + middle * between + last * at_last);
    };
    const Disk& point = control.point;
    const Pair x = mean(from.center.x, point.center.x, to.center.x);
    const Pair y = mean(from.center.y, point.center.y, to.center.y);
    const Pair radius = mean(from.radius, point.radius, to.radius);
    worst = larger(-radius, worst);  // ignores NaN
    for (const Site* s : {&a, &b})
      worst = larger(size_of(carrier_distances(*s, x, y) - radius), worst);
  };
  add(Pair{0.0625, 0.9375});
  add(both(0.5));
  if (near_focus)
    for (double t = 0x1p-6; t > 0x1p-26; t *= 0x1p-2) add(Pair{t, 1 - t});
  return std::max(worst[0], worst[1]);
}

/// The unit tangent (x, y), in either direction, of the bisector of a and b at a disk, with the
/// rate of the radius along it.
DiskVector tangent_at(const Site& a, const Site& b, const Disk& disk) {
  const Vec2 to_a = outward(a, disk.center), to_b = outward(b, disk.center);
  const Vec2 sum = to_a + to_b, difference = left_of(to_a - to_b);
  const Vec2 along = squared_norm(sum) > squared_norm(difference) ? sum : difference;
  const Vec2 unit = (1 / norm(along)) * along;
  return {unit, 0.5 * dot(sum, unit)};
}

/// The same control point as the intersection of the tangents at both ends. The vectors u and v
/// from the ends to the intersection satisfy P(u, u) = P(v, v), and the weight is the square root
/// of P(chord, chord) / (4 P(v, v)). More accurate than the pole if centre and radius change at
/// almost the same rate. None if an end is the centre of an arc, or if the tangents are nearly
/// parallel.
std::optional<Control> meeting_of_tangents(const Site& a, const Site& b, const Disk& from,
                                           const Disk& to) {
  const DiskVector first = tangent_at(a, b, from), last = tangent_at(a, b, to);
  const DiskVector chord{to.center - from.center, to.radius - from.radius};
  // The common perpendicular of the two tangents is short. Solve by least squares, each time
  // without the component along the other tangent, in which digits would cancel.
  const auto inner = [](const DiskVector& u, const DiskVector& v) {
    return dot(u.c, v.c) + u.r * v.r;
  };
  const auto without = [](const DiskVector& u, double share, const DiskVector& v) {
    return DiskVector{u.c - share * v.c, u.r - share * v.r};
  };
  const double aa = inner(first, first), ab = inner(first, last), bb = inner(last, last);
  const double ca = inner(chord, first), cb = inner(chord, last);
  const DiskVector first_across = without(first, ab / bb, last);
  const DiskVector last_across = without(last, ab / aa, first);
  const double s =
      inner(without(chord, cb / bb, last), first_across) / inner(first_across, first_across);
  const double t =
      -inner(without(chord, ca / aa, first), last_across) / inner(last_across, last_across);
  const bool from_first = std::abs(s) * std::sqrt(aa) < std::abs(t) * std::sqrt(bb);
  const Disk& end = from_first ? from : to;
  const DiskVector& along = from_first ? first : last;
  const double way = from_first ? s : t;
  const double weight_squared =
      product(chord, chord) / (4 * way * way * ((1 - along.r) * (1 + along.r)));
  // The intersection must lie between the ends.
  const bool between = s * ca > 0 && t * cb < 0;
  if (!(between && weight_squared > 0 && std::isfinite(weight_squared))) return std::nullopt;
  return Control{{end.center + way * along.c, end.radius + way * along.r},
                 std::sqrt(weight_squared)};
}

/// Whether the edge with this control point turns around a vertex or an arc's centre in the
/// direction opposite to its chord, or its foot on a segment moves back, by more than rounding.
/// deviation() does not detect this if the other site almost passes through the vertex, or almost
/// touches the circle or the line: then disks touch both sites wherever they lie across the edge.
bool turns_back(const Control& control, const Site& a, const Site& b, const Disk& from,
                const Disk& to) {
  constexpr double rounding = 0x1p-50;
  constexpr double beside =
      0x1p-46;  // control points of edges that are nearly straight lose digits
  for (const Site* s : {&a, &b}) {
    if (!s->is_vertex() && !s->is_arc()) {
      const auto [first, last] =
          std::minmax({dot(s->direction, from.center), dot(s->direction, to.center)});
      const double foot = dot(s->direction, control.point.center);
      if (foot < first - beside || foot > last + beside) return true;
      continue;
    }
    const Vec2 focus = focus_of(*s);
    const Vec2 first = from.center - focus, last = to.center - focus;
    const Vec2 between = control.point.center - focus;
    // If the ends are opposite as seen from the focus, the edge may pass it on either side.
    if (s->is_arc() && !(dot(first, last) > 0)) continue;
    // The error of the products by rounding of the centres, or of a distant focus.
    const double longest = std::sqrt(std::max(squared_norm(first), squared_norm(last)));
    const double size = longest * std::max(1.0, longest);
    const auto differ = [&](double u, double v, double least) {
      return std::abs(u) > least * size && std::abs(v) > least * size && (u > 0) != (v > 0);
    };
    const double there = cross(first, between), onward = cross(between, last);
    if (differ(there, onward, beside)) return true;
    const double by_chord = cross(first, last);
    if (differ(by_chord, by_chord + 2 * control.weight * (there + onward), rounding)) return true;
  }
  return false;
}

/// The largest distance by which the ends of an edge fail to touch its sites.
double ends_stray(const Site& a, const Site& b, const Disk& from, const Disk& to) {
  const Pair x{from.center.x, to.center.x}, y{from.center.y, to.center.y};
  const Pair radius{from.radius, to.radius};
  Pair worst{};
  for (const Site* s : {&a, &b})
    worst = larger(size_of(carrier_distances(*s, x, y) - radius), worst);
  return std::max(worst[0], worst[1]);
}

/// The deviation that an edge may have: a few roundings of local coordinates.
constexpr double few_roundings = 0x1p-50;

/// The control point of an edge of two convex arcs that lie on one circle up to less than verify()
/// sees. The edge is a hyperbola with foci at that small distance: either a straight line from the
/// centre, or a line to the centre and another one away from it, with a bend closer to the centre
/// than that. (Any other way past the centre touches both circles, too, but not both arcs.) Empty
/// for other edges, whose control point can be computed accurately.
std::optional<Control> control_at_common_centre(const Site& a, const Site& b, const Disk& from,
                                                const Disk& to) {
  constexpr double rounding = 0x1p-52, apart = 0x1p-47;
  if (!(a.curvature > 0 && b.curvature > 0)) return std::nullopt;
  const double radius = 1 / a.curvature, other_radius = 1 / b.curvature;
  const Vec2 centre = focus_of(a), other_centre = focus_of(b);
  if (std::abs(radius - other_radius) > apart ||
      squared_norm(other_centre - centre) > apart * apart)
    return std::nullopt;
  const Control straight{middle_of(from, to), 1};
  if (deviation(straight, a, b, from, to, true) <= few_roundings + ends_stray(a, b, from, to))
    return straight;
  return Control{{midpoint(centre, other_centre), 0.5 * (radius + other_radius)},
                 std::max(1.0, distance(from.center, to.center) / rounding)};
}

/// The control point of the parabola through the disk halfway along an edge.
Control through_halfway(const Site& a, const Site& b, const Disk& from, const Disk& to) {
  const Bisector bisector(b, a);
  const double middle = 0.5 * (bisector.position(from.center) + bisector.position(to.center));
  const Disk halfway = bisector.disk_at(middle, from), straight = middle_of(from, to);
  return {{2 * halfway.center - straight.center, 2 * halfway.radius - straight.radius}, 1};
}

/// Whether a curve stays within 2^-26 of its chord's length from the chord.
bool hardly_leaves_chord(const Control& control, const Disk& from, const Disk& to) {
  constexpr double hardly = 0x1p-26;
  const Vec2 chord = to.center - from.center;
  const double beside = control.weight * std::abs(cross(chord, control.point.center - from.center));
  return beside <= hardly * (1 + control.weight) * squared_norm(chord);
}

/// The control point of an edge with an arc: the pole, or if this deviates or turns back, the
/// intersection of tangents. If neither is accurate, the edge is either almost straight, for which
/// a parabola through the disk halfway is better, or turns around a focus, for which the pole in
/// twofold precision is better (sites that are nearly tangent would not determine that pole).
Control control_with_arc(const Site& a, const Site& b, const Disk& from, const Disk& to) {
  constexpr double long_enough = 0x1p-7, curved = 0x1p-3, short_line = 0x1p-46;
  Control best = pole_of_chord(a, b, from, to);
  const double length = distance(from.center, to.center);
  const double focal =
      std::min({focal_distance(a, from, to), focal_distance(b, from, to), from.radius, to.radius});
  if (length < long_enough * focal) return best;
  if (const auto control = control_at_common_centre(a, b, from, to)) return *control;
  const bool near_focus = focal < curved * length;
  double strays = deviation(best, a, b, from, to, near_focus);
  // If the sites are nearly tangent, all disks beyond the ends touch both as well, including those
  // of negative radius.
  const Vec2 chord = to.center - from.center;
  const auto is_between = [&](Vec2 center) {
    const double along = dot(center - from.center, chord);
    return along >= 0 && along <= squared_norm(chord);
  };
  const Control straight{middle_of(from, to), 1};
  // A line that deviates no more than the ends do is as good as a curve that passes a focus on the
  // other side, next to joints that are smooth up to a few tolerances; and as good as a curve that
  // hardly leaves its chord, for example if two sites are almost one, because its deviation is only
  // rounding. A very short line need not be measured: distances change by at most the displacement,
  // so it deviates by at most half its length, and 2^-47 is less than verify() allows for size one.
  const bool leads_between = is_between(best.point.center);
  if (!leads_between && length <= short_line) return straight;
  const bool is_doubtful = !leads_between || hardly_leaves_chord(best, from, to);
  const double enough = few_roundings + (is_doubtful ? ends_stray(a, b, from, to) : 0);
  if ((strays > few_roundings || is_doubtful) &&
      deviation(straight, a, b, from, to, near_focus) <= enough)
    return straight;
  bool is_lost = turns_back(best, a, b, from, to);
  // A candidate that does not turn back is better than one that does, unless it deviates by more
  // than that one and than a line may between such ends, or by more than verify() allows: around
  // the tip of a slit narrower than rounding, edges do turn back.
  const double of_line = is_lost ? 2 * ends_stray(a, b, from, to) + few_roundings : 0;
  const auto take_if_better = [&](const Control& control) {
    const double now = deviation(control, a, b, from, to, near_focus);
    const bool is_near = is_lost ? now <= std::max(strays, of_line) : now < strays;
    if (!is_near) return;
    const bool turns = turns_back(control, a, b, from, to);
    if (turns && !(now < strays && (is_lost || strays > 0.5 * short_line))) return;
    strays = now;
    is_lost = turns;
    best = control;
  };
  const auto is_good = [&] { return strays <= few_roundings && !is_lost; };
  if (is_good()) return best;
  if (const auto meeting = meeting_of_tangents(a, b, from, to)) take_if_better(*meeting);
  if (is_good()) return best;
  if (const Control bent = through_halfway(a, b, from, to); is_between(bent.point.center))
    take_if_better(bent);
  take_if_better(straight);
  // The edge would follow an end that a tie has moved. An end that is only rounded may be off by a
  // few roundings, and its measured distance by as many.
  if (is_good() || ends_stray(a, b, from, to) > 4 * few_roundings) return best;
  if (const auto exact = pole_of_cone(a, b, from, to)) take_if_better(*exact);
  return best;
}

}  // namespace

Vec2 Bisector::tangent(Vec2 center) const {
  if (!right.is_vertex() && !left.is_vertex() && reference == nullptr) return direction;
  const Vec2 along = left_of(outward(left, center) - outward(right, center));
  const double size = norm(along);
  return (reference == nullptr && dot(along, direction) < 0 ? -1 / size : 1 / size) * along;
}

Disk Bisector::disk_at(double position, const Disk& near) const {
  if (reference != nullptr) {
    const double s = position / scale;
    const Vec2 foot = reference->at(s), normal = reference->normal_at(s);
    const double radius = tangent_radius(foot, normal, reference == &right ? left : right);
    return {foot + radius * normal, radius};
  }
  if (right.is_vertex() && left.is_vertex()) {
    const Vec2 middle = midpoint(right.point, left.point);
    const Vec2 center = middle + (position - dot(direction, middle)) * direction;
    return {center, distance(center, right.point)};
  }
  if (left.is_vertex())
    return disk_over(right, dot(right.direction, position * direction - right.point), left.point);
  if (right.is_vertex())
    return disk_over(left, dot(left.direction, position * direction - left.point), right.point);
  const Vec2 center = near.center + (position - dot(direction, near.center)) * direction;
  return {center, carrier_distance(right, center)};
}

double Bisector::last_position(const Disk& near, double limit) const {
  if (reference != nullptr) {
    const double end = reference == &right ? scale * right.length : 0;
    double low = position(near.center), high = end;
    if (!(low < high) || disk_at(end, near).radius <= limit) return end;
    constexpr int halvings = 40;  // the remaining interval is negligible
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (disk_at(middle, near).radius <= limit ? low : high) = middle;
    }
    return low;
  }
  if (right.is_vertex() && left.is_vertex()) {
    const double half = 0.5 * distance(right.point, left.point);
    const double height = std::sqrt(std::max(0.0, limit * limit - half * half));
    return dot(direction, midpoint(right.point, left.point)) + height;
  }
  if (right.is_vertex() || left.is_vertex()) {
    const Site& segment = right.is_vertex() ? left : right;
    const Vec2 vertex = right.is_vertex() ? right.point : left.point;
    // A disk over the segment's line touches a vertex at height y if r = (x^2 + y^2) / (2 y).
    const double y = cross(segment.direction, vertex - segment.point);
    const double x = std::sqrt(std::max(0.0, (2 * limit - y) * y));
    return dot(direction, vertex) + x;
  }
  // Two segments: the radius and the feet are linear along the bisector, and the feet eventually
  // leave their segments.
  const double slope = dot(right.normal(), direction);
  const double drift = std::abs(dot(right.direction, direction));
  double reach = (right.length + left.length) / drift;
  if (slope > 0) reach = std::min(reach, (limit - near.radius) / slope);
  if (slope < 0) reach = std::min(reach, near.radius / -slope);
  return position(near.center) + std::max(0.0, reach);
}

Control control_of(const Site& a, const Site& b, const Disk& from, const Disk& to) {
  if (a.is_arc() || b.is_arc()) return control_with_arc(a, b, from, to);
  if (!a.is_vertex() && !b.is_vertex()) return {middle_of(from, to), 1};
  const Control control = a.is_vertex() && b.is_vertex()
                              ? control_of_vertices(a.point, b.point, from, to)
                          : a.is_vertex() ? control_of_parabola(b, a.point, from, to)
                                          : control_of_parabola(a, b.point, from, to);
  // If no double lies between the sites, the radii are only rounding errors.
  const Disk& point = control.point;
  return std::isfinite(point.center.x + point.center.y + point.radius + control.weight) &&
                 control.weight > 0
             ? control
             : Control{middle_of(from, to), 1};
}

}  // namespace medial::site
