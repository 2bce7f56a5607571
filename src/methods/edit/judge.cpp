#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "methods/edit/rings.h"
#include "methods/edit/segments.h"

// Decides whether an edit keeps the form of a shape's loops.

namespace medial::edit {
namespace {

/// In tolerances. Edges closer than this to an arc may touch it.
constexpr double nearness = 64;

/// How two segments with a common end `shared` meet: there only, or along each other.
Meeting meeting_at(Vec2 shared, Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Vec2 one = a == shared ? b : a, other = c == shared ? d : c;
  const bool is_along =
      orientation(one, shared, other) == 0 && !strictly_between(one, shared, other);
  return is_along ? Meeting::touch : Meeting::apart;
}

/// Decides whether segments and arcs of at most a half circle stay further apart than a margin,
/// except at an end that they share. Answers no if it would take too long to decide.
class Apartness {
 public:
  explicit Apartness(double margin) : margin_(margin) {}

  bool apart(const BulgeArc& a, const BulgeArc& b) {
    steps_ = 0;
    return keep_apart(a, b);
  }
  /// Whether two segments cross, rather than only touch within the margin.
  bool cross(const BulgeArc& a, const BulgeArc& b) const {
    return a.bulge == 0 && b.bulge == 0 &&
           meeting(a.start, a.end, b.start, b.end) == Meeting::cross &&
           end_distance(a, b) > margin_;
  }
  /// The same for two edges that start at one point.
  bool apart_after_start(const BulgeArc& a, const BulgeArc& b) {
    steps_ = 0;
    return part(a, b);
  }

 private:
  static constexpr int most_steps = 256;
  static double sagitta(const BulgeArc& arc) {
    return 0.5 * std::abs(arc.bulge) * norm(arc.chord());
  }
  static std::array<BulgeArc, 2> halves(const BulgeArc& arc) {
    const Vec2 middle = arc.bulge == 0 ? midpoint(arc.start, arc.end) : apex(arc);
    const double bulge = half_bulge(arc.bulge);
    return {{{arc.start, middle, bulge}, {middle, arc.end, bulge}}};
  }
  static double squared_distance(const BulgeArc& segment, Vec2 p) {
    const Vec2 d = segment.chord(), q = p - segment.start;
    const double share = std::clamp(dot(d, q) / squared_norm(d), 0.0, 1.0);
    return squared_norm(q - share * d);
  }
  /// The distance between the chords.
  static double chord_distance(const BulgeArc& a, const BulgeArc& b) {
    return meeting(a.start, a.end, b.start, b.end) != Meeting::apart ? 0 : end_distance(a, b);
  }
  /// The least distance from an end of one segment to the other segment.
  static double end_distance(const BulgeArc& a, const BulgeArc& b) {
    return std::sqrt(std::min({squared_distance(a, b.start), squared_distance(a, b.end),
                               squared_distance(b, a.start), squared_distance(b, a.end)}));
  }

  bool keep_apart(const BulgeArc& a, const BulgeArc& b) {
    const double of_a = sagitta(a), of_b = sagitta(b);
    if (chord_distance(a, b) > of_a + of_b + margin_) return true;
    if (++steps_ > most_steps || of_a + of_b <= margin_) return false;
    const auto [first, second] = halves(of_a > of_b ? a : b);
    const BulgeArc& other = of_a > of_b ? b : a;
    return keep_apart(first, other) && keep_apart(second, other);
  }

  /// The chord from the start to a point of an arc makes with the start tangent half of the angle
  /// by which the arc turns up to there. If the turns add up to less than the angle between the
  /// tangents, no two such chords coincide.
  bool part(const BulgeArc& a, const BulgeArc& b) {
    constexpr double least = 1e-9;
    const double angle = std::abs(signed_angle(start_tangent(a), start_tangent(b)));
    const double turns = 2 * (std::atan(std::abs(a.bulge)) + std::atan(std::abs(b.bulge)));
    if (angle > turns + least) return true;
    if (++steps_ > most_steps || angle < least) return false;
    const auto of_a = halves(a), of_b = halves(b);
    return part(of_a[0], of_b[0]) && keep_apart(of_a[0], of_b[1]) && keep_apart(of_a[1], of_b[0]) &&
           keep_apart(of_a[1], of_b[1]);
  }

  double margin_;
  int steps_ = 0;
};

/// The winding number of a closed curve around a point that is not on it.
int turns_around(std::span<const BulgeArc> curve, Vec2 p) {
  double sum = 0;
  for (const BulgeArc& arc : curve) {
    const Vec2 from = arc.start - p, to = arc.end - p;
    // Points on the line of the chord count as on its right: there an arc may enclose them.
    const int side = orientation(arc.start, arc.end, p) > 0 ? 1 : -1;
    sum += side * std::atan2(std::abs(cross(from, to)), dot(from, to));
    if (arc.bulge == 0 || (side < 0) != (arc.bulge > 0)) continue;
    const Vec2 q = p - arc.start;
    const double height =
        dot(left_of(start_tangent(arc)), q) - 0.5 * curvature(arc) * squared_norm(q);
    if ((height > 0) == (arc.bulge > 0)) sum += std::copysign(2 * std::numbers::pi, arc.bulge);
  }
  return static_cast<int>(std::lround(sum / (2 * std::numbers::pi)));
}

Box box_around(std::span<const BulgeArc> curve, double margin) {
  Box box = Box::nothing();
  for (const BulgeArc& arc : curve) {
    const double reach = margin + 0.5 * std::abs(arc.bulge) * norm(arc.chord());
    const Box chord = box_of(arc.start, arc.end);
    box.add({chord.low - Vec2{reach, reach}, chord.high + Vec2{reach, reach}});
  }
  return box;
}

/// Whether build_shape() may merge adjacent edges, or drop or replace an edge.
class Cleaning {
 public:
  explicit Cleaning(double tolerance) : tolerance_(tolerance) {}

  bool changes(const BulgeArc& edge) const {
    constexpr double shortest = 2048, flattest = 64;  // tolerances
    const double length = norm(edge.chord()), bulge = std::abs(edge.bulge);
    if (!(length > 0) || bulge > 1) return true;
    return bulge > 0 &&
           (!(length > shortest * tolerance_) || !(bulge * length > flattest * tolerance_));
  }
  bool may_join(const BulgeArc& before, const BulgeArc& after) const {
    constexpr double alike = 1e-9, play = 1024;
    if (!(before.bulge * after.bulge > 0)) return false;
    const double shorter = std::min(norm(before.chord()), norm(after.chord()));
    return std::abs(signed_angle(end_tangent(before), start_tangent(after))) < alike &&
           std::abs(curvature(before) - curvature(after)) * shorter * shorter <= play * tolerance_;
  }

 private:
  double tolerance_;
};

/// The triangles that the edges from p to n by v sweep while v moves straight to its place, or to
/// or from the inside of an edge.
std::vector<Triangle> swept_by(const Edit& edit, Vec2 p, Vec2 v, Vec2 n) {
  const Vec2 x = edit.place;
  if (edit.old == none) return {{{p, x, n}}};
  if (edit.fresh == none) return {{{p, v, n}}};
  return {{{p, v, x}}, {{v, n, x}}};
}

struct NewEdge {
  Vec2 from, to;
  std::uint32_t start, end;
};

/// The edges that an edit makes between p and n.
std::vector<NewEdge> edges_of(const Edit& edit, Vec2 p, Vec2 n) {
  if (edit.fresh == none) return {{p, n, edit.before, edit.after}};
  return {{p, edit.place, edit.before, none}, {edit.place, n, none, edit.after}};
}

}  // namespace

Rings::Judgement Rings::judge_straight(const Edit& edit) const {
  const Vec2 p = vertices_[edit.before].point, n = vertices_[edit.after].point, x = edit.place;
  const bool has_old = edit.old != none, has_fresh = edit.fresh != none;
  const Vec2 v = has_old ? vertices_[edit.old].point : p;
  const auto turns_back = [](Vec2 a, Vec2 b, Vec2 c) {
    return orientation(a, b, c) == 0 && !strictly_between(a, b, c);
  };
  const Judgement unclear{Verdict::unclear, none, {}};
  const Vec2 outer[2] = {vertices_[vertices_[edit.before].before].point,
                         vertices_[vertices_[edit.after].next].point};
  if (edit.before == edit.after || (has_fresh && turns_back(p, x, n)) ||
      turns_back(outer[0], p, has_fresh ? x : n) || turns_back(has_fresh ? x : p, n, outer[1]))
    return unclear;

  const bool is_moving = has_old && has_fresh;
  const std::vector<Triangle> swept = swept_by(edit, p, v, n);
  const std::vector<NewEdge> edges = edges_of(edit, p, n);
  Box query = box_of(p, n);
  if (has_old) query.add(v);
  if (has_fresh) query.add(x);
  Judgement result;
  if (is_moving && (swept[0].has(n) || swept[1].has(p))) result.verdict = Verdict::unclear;
  const auto is_shared = [&](Vec2 end) {
    return (end == p && vertices_[edit.before].touches) ||
           (end == n && vertices_[edit.after].touches);
  };
  boxes_.find(query, [&](std::uint32_t s) {
    if (result.verdict == Verdict::crosses) return;
    const std::uint32_t t = vertices_[s].next;
    const Vec2 a = vertices_[s].point, b = vertices_[t].point;
    const bool is_own = s == edit.before || (has_old && s == edit.old);
    if (is_own) return;
    for (const NewEdge& edge : edges) {
      if (s == edge.end || t == edge.start) continue;  // they meet there only
      const Vec2 end = a == edge.from || a == edge.to ? a : b;
      const Meeting how = is_shared(end) && (end == edge.from || end == edge.to)
                              ? meeting_at(end, edge.from, edge.to, a, b)
                              : meeting(edge.from, edge.to, a, b);
      if (how == Meeting::cross)
        result = {Verdict::crosses, s, crossing_of(edge.from, edge.to, a, b)};
      if (how == Meeting::touch) result.verdict = Verdict::unclear;
    }
    if (result.verdict == Verdict::crosses) return;
    if (is_moving && meeting(v, x, a, b) != Meeting::apart) result.verdict = Verdict::unclear;
    // An edge that touches a new one at an end stays clear of the swept area if its other end does.
    if (s == edit.after || is_shared(a)) return;
    for (const Triangle& triangle : swept)
      if (triangle.has(a)) result.verdict = Verdict::unclear;
  });
  return result;
}

Rings::Judgement Rings::judge(const Edit& edit) const {
  if (!edit.out.empty() && !edit.in.empty()) return {Verdict::unclear, none, {}};  // in two steps
  if (!edit.out.empty()) return judge_out(edit);
  if (!edit.in.empty()) return judge_in(edit);
  const bool is_straight = !has_arcs() && edit.bulge[0] == 0 && edit.bulge[1] == 0;
  return is_straight ? judge_straight(edit) : judge_with_arcs(edit);
}

namespace {

/// A new edge, whose ends are vertices of the shape or none.
struct FreshEdge {
  BulgeArc arc;
  std::uint32_t start, end;
};

}  // namespace

/// With arcs, edges within a few tolerances of each other may touch.
Rings::Judgement Rings::judge_with_arcs(const Edit& edit) const {
  const Judgement unclear{Verdict::unclear, none, {}};
  if (edit.before == edit.after) return unclear;
  const Vec2 p = vertices_[edit.before].point, n = vertices_[edit.after].point, x = edit.place;
  std::vector<FreshEdge> fresh;
  std::vector<BulgeArc> old{edge(edit.before)};
  if (edit.old != none) old.push_back(edge(edit.old));
  std::vector<BulgeArc> swept = old;  // the boundary of the area between old and new edges
  if (edit.fresh != none) {
    fresh = {{{p, x, edit.bulge[0]}, edit.before, none}, {{x, n, edit.bulge[1]}, none, edit.after}};
  } else {
    fresh = {{{p, n, edit.bulge[0]}, edit.before, edit.after}};
  }
  for (std::size_t i = fresh.size(); i-- > 0;) swept.push_back(fresh[i].arc.reversed());
  const Cleaning cleaning(joining_.tolerance);
  Apartness apartness(nearness * joining_.tolerance);
  std::vector<BulgeArc> chain{edge(vertices_[edit.before].before)};
  for (const FreshEdge& one : fresh) chain.push_back(one.arc);
  chain.push_back(edge(edit.after));
  for (std::size_t i = 0; i + 1 < chain.size(); ++i)
    if (cleaning.changes(chain[i]) || cleaning.may_join(chain[i], chain[i + 1])) return unclear;
  if (fresh.size() == 2 && !apartness.apart_after_start(fresh[0].arc.reversed(), fresh[1].arc))
    return unclear;

  Judgement result;
  boxes_.find(box_around(swept, nearness * joining_.tolerance), [&](std::uint32_t s) {
    if (result.verdict == Verdict::crosses || s == edit.before || s == edit.old) return;
    const std::uint32_t t = vertices_[s].next;
    const BulgeArc other = edge(s);
    for (const FreshEdge& one : fresh) {
      const bool at_start = t == one.start, at_end = s == one.end;
      const bool is_apart = at_start && at_end ? false
                            : at_start ? apartness.apart_after_start(one.arc, other.reversed())
                            : at_end   ? apartness.apart_after_start(one.arc.reversed(), other)
                                       : apartness.apart(one.arc, other);
      if (is_apart) continue;
      result.verdict = Verdict::unclear;
      if (!at_start && !at_end && apartness.cross(one.arc, other)) {
        result = {Verdict::crosses, s,
                  crossing_of(one.arc.start, one.arc.end, other.start, other.end)};
        return;
      }
    }
    // Edges that touched the old edges may change their form without them.
    for (std::size_t i = 0; i < old.size(); ++i) {
      const bool meets = (i == 0 && t == edit.before) || (i + 1 == old.size() && s == edit.after);
      if (!meets && !apartness.apart(old[i], other)) result.verdict = Verdict::unclear;
    }
    if (result.verdict != Verdict::keeps_form) return;
    if ((s != edit.after && turns_around(swept, other.start) != 0) ||
        turns_around(swept, apex(other)) != 0)
      result.verdict = Verdict::unclear;
  });
  return result;
}

std::vector<std::uint32_t> Rings::loops_near(const Box& box, std::uint32_t but) const {
  std::vector<std::uint32_t> vertices;
  boxes_.find(box, [&](std::uint32_t s) {
    if (vertices_[s].loop != but) vertices.push_back(s);
  });
  const auto loop_of = [&](std::uint32_t v) { return vertices_[v].loop; };
  std::sort(vertices.begin(), vertices.end(),
            [&](std::uint32_t a, std::uint32_t b) { return loop_of(a) < loop_of(b); });
  vertices.erase(
      std::unique(vertices.begin(), vertices.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return loop_of(a) == loop_of(b); }),
      vertices.end());
  return vertices;
}

Seat Rings::find_seat_anew(const std::vector<Corner>& corners) const {
  constexpr double clear = 64;  // tolerances
  Vec2 place;
  double away = -1;
  for (std::size_t i = 0; i < corners.size() && !(away > clear * joining_.tolerance); ++i) {
    const Corner &from = corners[i], &to = corners[i + 1 < corners.size() ? i + 1 : 0];
    const BulgeArc arc{from.point, to.point, from.bulge};
    for (const Vec2 p : {from.point, arc.bulge == 0 ? midpoint(arc.start, arc.end) : apex(arc)})
      if (const double here = around(p).away; here > away) {
        place = p;
        away = here;
      }
  }
  Seat seat = seat_beside(none);
  std::uint32_t component_around = seat.component;
  double narrowest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t loop : loops()) {
    std::vector<BulgeArc> curve;
    for_vertices(loop, [&](std::uint32_t v) { curve.push_back(edge(v)); });
    if (turns_around(curve, place) == 0) continue;
    seat.hole = !seat.hole;
    const double width = diagonal(box_around(curve, 0));
    if (is_hole(loop) || width >= narrowest) continue;
    narrowest = width;
    component_around = component(loop);
  }
  if (seat.hole) seat.component = component_around;
  return seat;
}

/// A loop can be removed if it encloses no other loop.
Rings::Judgement Rings::judge_out(const Edit& edit) const {
  const std::uint32_t loop = vertices_[edit.out.front().number].loop;
  std::vector<BulgeArc> curve;
  bool touches = false;  // edges that touch the loop may change their form without it
  Apartness apartness(nearness * joining_.tolerance);
  for_vertices(loop, [&](std::uint32_t v) {
    const BulgeArc one = edge(v);
    curve.push_back(one);
    touches = touches || vertices_[v].touches;
    if (!has_arcs() || touches) return;
    boxes_.find(box_around({&one, 1}, nearness * joining_.tolerance), [&](std::uint32_t s) {
      touches = touches || (vertices_[s].loop != loop && !apartness.apart(one, edge(s)));
    });
  });
  if (touches) return {Verdict::unclear, none, {}};
  for (const std::uint32_t v : loops_near(box_around(curve, 0), loop))
    if (turns_around(curve, vertices_[v].point) != 0) return {Verdict::unclear, none, {}};
  const bool is_only = loops_.size() == 1 || loops().size() == 1;
  return {is_only ? Verdict::unclear : Verdict::keeps_form, none, {}};
}

/// A loop can be added if build_shape() takes it as it is, and it touches and encloses no other
/// loop.
Rings::Judgement Rings::judge_in(const Edit& edit) const {
  const Judgement unclear{Verdict::unclear, none, {}};
  std::vector<BulgeArc> curve;
  Ring ring;
  for (std::size_t i = 0; i < edit.in.size(); ++i) {
    const Corner &from = edit.in[i], &to = edit.in[i + 1 < edit.in.size() ? i + 1 : 0];
    curve.push_back({from.point, to.point, from.bulge});
    ring.points.push_back(from.point);
    ring.bulges.push_back(from.bulge);
  }
  const auto alone = build_shape({&ring, 1});
  if (!alone || alone->loop_count() != 1 || alone->points.size() != edit.in.size()) return unclear;
  for (std::size_t i = 0; i < alone->points.size(); ++i)
    if (alone->points[i] != edit.in[alone->sources[i].vertex].point ||
        std::abs(alone->bulge(i)) > 1)
      return unclear;
  const Cleaning cleaning(joining_.tolerance);
  const bool has_curves = has_arcs() || !alone->bulges.empty();
  Apartness apartness(has_curves ? nearness * joining_.tolerance : 0);
  Judgement result;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const BulgeArc& one = curve[i];
    if (cleaning.changes(one) || cleaning.may_join(one, curve[i + 1 < curve.size() ? i + 1 : 0]))
      return unclear;
    boxes_.find(box_around({&one, 1}, nearness * joining_.tolerance), [&](std::uint32_t s) {
      if (result.verdict == Verdict::crosses) return;
      const BulgeArc other = edge(s);
      const bool meets =
          has_curves ? !apartness.apart(one, other)
                     : meeting(one.start, one.end, other.start, other.end) != Meeting::apart;
      if (apartness.cross(one, other))
        result = {Verdict::crosses, s, crossing_of(one.start, one.end, other.start, other.end)};
      else if (meets)
        result.verdict = Verdict::unclear;
    });
    if (result.verdict == Verdict::crosses) return result;
  }
  for (const std::uint32_t v : loops_near(box_around(curve, 0), none))
    if (turns_around(curve, vertices_[v].point) != 0) return unclear;
  return result;
}

}  // namespace medial::edit
