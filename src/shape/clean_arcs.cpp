#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "base/arc.h"
#include "base/predicates.h"
#include "base/tolerance.h"
#include "shape/clean.h"

namespace medial {
namespace {

/// The relative error of bulges and of sums of angles.
constexpr double slack = 64 * std::numeric_limits<double>::epsilon();

/// The point of an arc halfway between its ends; bitwise equal for both directions.
Vec2 middle_of(const BulgeArc& arc) {
  return 0.5 * arc.start + 0.5 * arc.end - (arc.bulge / 2) * left_of(arc.chord());
}

/// The edges of one ring with arcs.
class Cleaner {
 public:
  Cleaner(std::vector<RingEdge>& edges, const RingSurroundings& around, ShapeReport& report)
      : edges_(edges), around_(around), report_(report) {
    measure();
  }

  void run() {
    straighten();
    // Do not merge edges in a ring of two, which would vanish.
    if (edges_.size() > 2) drop_collinear();
    split_long_arcs();
    measure();  // again, with the current vertices, as another cleaning would measure them
    merge_cocircular();
  }

 private:
  void measure() {
    Box box{edges_[0].point, edges_[0].point};
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Vec2 middle = middle_of(arc(i));  // arcs may reach farther than their vertices
      box.add(edges_[i].point);
      if (std::isfinite(middle.x) && std::isfinite(middle.y)) box.add(middle);
    }
    rounding_ = spacing_in(box);
    play_ = std::max(4 * rounding_, tolerance_for(box, 0));
    middle_ = 0.5 * box.low + 0.5 * box.high;
  }

  BulgeArc arc(std::size_t i) const {
    return {edges_[i].point, edges_[next(i)].point, edges_[i].bulge};
  }
  std::size_t next(std::size_t i) const { return i + 1 < edges_.size() ? i + 1 : 0; }
  std::size_t previous(std::size_t i) const { return (i == 0 ? edges_.size() : i) - 1; }

  /// An arc is straight if its sagitta is half a spacing of the coordinates, or less.
  void straighten() {
    straightened_.assign(edges_.size(), false);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const double sagitta = std::abs(edges_[i].bulge) / 2 * norm(arc(i).chord());
      if (edges_[i].bulge == 0 || !(sagitta <= rounding_ / 2)) continue;
      edges_[i].bulge = 0;
      straightened_[i] = true;
    }
  }

  void split_long_arcs() {
    const auto is_long = [](const RingEdge& edge) { return std::abs(edge.bulge) > 1; };
    if (std::none_of(edges_.begin(), edges_.end(), is_long)) return;
    std::vector<RingEdge> result;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      RingEdge edge = edges_[i];
      if (is_long(edge)) {
        const Vec2 middle = middle_of(arc(i));
        edge.bulge = std::clamp(half_bulge(edge.bulge), -1.0, 1.0);
        result.push_back(edge);
        edge.point = middle;
      }
      result.push_back(edge);
    }
    edges_ = std::move(result);
  }

  /// As in rings without arcs, dropping a vertex changes no direction, except that directions may
  /// change within `play_` where arcs became straight; a smooth joint must not become a corner
  /// there.
  void drop_collinear() {
    const std::size_t count = edges_.size();
    std::vector<bool> dropped(count);
    // Runs of straight edges begin after an arc.
    std::size_t first = 0;
    while (first < count && edges_[previous(first)].bulge == 0) ++first;
    std::size_t kept = first % count;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = (first + k) % count, before = previous(i);
      const bool straight = edges_[before].bulge == 0 && edges_[i].bulge == 0;
      const Vec2 a = edges_[before].point, b = edges_[next(i)].point;
      const bool exact = straight && orientation(a, edges_[i].point, b) == 0 &&
                         strictly_between(a, edges_[i].point, b);
      dropped[i] =
          exact || (straight && first < count && (straightened_[before] || straightened_[i]) &&
                    is_one_line(kept, next(i)));
      if (!dropped[i]) kept = i;
    }
    const auto gone = static_cast<std::size_t>(std::count(dropped.begin(), dropped.end(), true));
    report_.collinear_points += gone;
    if (gone == 0 || count - gone < 2) return;
    std::size_t stay = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (!dropped[i]) edges_[stay++] = edges_[i];
    edges_.resize(stay);
  }

  /// Whether the few vertices between two others lie between them on one line, within `play_`.
  bool is_one_line(std::size_t from, std::size_t to) const {
    constexpr int most = 16;
    const Vec2 start = edges_[from].point, way = edges_[to].point - start;
    const double length = norm(way);
    int vertices = 0;
    for (std::size_t i = next(from); i != to; i = next(i)) {
      const Vec2 d = edges_[i].point - start;
      const double along = dot(way, d);
      if (++vertices > most || !(std::abs(cross(way, d)) <= play_ * length) || !(along > 0) ||
          !(along < length * length))
        return false;
    }
    return true;
  }

  /// Whether an arc may continue the previous one on the same circle. The accuracy of the shorter
  /// arc's direction and curvature is limited by its length.
  bool continues(std::size_t i) const {
    const BulgeArc first = arc(previous(i)), second = arc(i);
    if (!(first.bulge * second.bulge > 0)) return false;
    const double shorter = std::min(norm(first.chord()), norm(second.chord()));
    if (!(std::abs(curvature(first) - curvature(second)) * shorter * shorter <= 8 * play_))
      return false;
    const Vec2 arriving = end_tangent(first), leaving = start_tangent(second);
    return dot(arriving, leaving) > 0 && std::abs(cross(arriving, leaving)) * shorter <= 2 * play_;
  }

  /// Replaces each run of arcs on one circle by one arc, or by two if it exceeds a half circle.
  /// Keeps a vertex where another ring also has one, because they touch there. All tests are
  /// bitwise independent of the starting point, the direction, reflections, quarter turns and
  /// scaling by powers of two, and so is the result.
  void merge_cocircular() {
    const std::size_t count = edges_.size();
    std::vector<std::size_t> ends;  // of runs
    ends.reserve(count);
    bool is_touched = false;  // another ring touches inside a run
    for (std::size_t i = 0; i < count; ++i) {
      const bool goes_on = continues(i);
      if (goes_on && !around_.is_shared(edges_[i].point)) continue;
      ends.push_back(i);
      is_touched = is_touched || goes_on;
    }
    if (count <= 2 || ends.size() == count) return;
    if (ends.size() <= 1 && merge_circle(is_touched ? ends : furthest_from(middle_))) return;
    if (ends.empty()) ends = furthest_from(middle_);
    std::vector<RingEdge> result;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const std::size_t end = k + 1 < ends.size() ? ends[k + 1] : ends[0] + count;
      append_run({ends[k], end - ends[k]}, result);
    }
    replace_edges(std::move(result));
  }

  void replace_edges(std::vector<RingEdge> edges) {
    // Return to the old start, if it is still a vertex, so that the order is unchanged.
    const auto lowest = std::min_element(
        edges.begin(), edges.end(),
        [](const RingEdge& a, const RingEdge& b) { return a.source.vertex < b.source.vertex; });
    std::rotate(edges.begin(), lowest, edges.end());
    report_.collinear_points += edges_.size() - edges.size();
    edges_ = std::move(edges);
  }

  /// The vertices farthest from a point, usually one.
  std::vector<std::size_t> furthest_from(Vec2 p) const {
    std::vector<std::size_t> result;
    double furthest = 0;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const double away = squared_norm(edges_[i].point - p);
      if (away > furthest) result.clear();
      furthest = std::max(furthest, away);
      if (away == furthest) result.push_back(i);
    }
    return result;
  }

  /// Consecutive arcs. Indices continue past the ring's end.
  struct Run {
    std::size_t begin, count;
  };
  const RingEdge& edge(std::size_t i) const { return edges_[i % edges_.size()]; }
  double angle_of(Run run) const {
    double sum = 0;
    for (std::size_t i = run.begin; i < run.begin + run.count; ++i)
      sum += 4 * std::atan(std::abs(edge(i).bulge));
    return sum;
  }

  /// Appends one arc, or two equal ones, if the run allows it; otherwise its halves, and the arc
  /// between them, if there is one.
  void append_run(Run run, std::vector<RingEdge>& result) {
    RingEdge first = edge(run.begin);
    const Vec2 stop = edge(run.begin + run.count).point;
    const double sign = first.bulge > 0 ? 1 : -1;
    Bulges bulges(first.point, stop, play_);
    add_run(run, sign, false, bulges);
    const double bulge = bulges.middle();
    const bool is_arc = first.point != stop && bulges.allows(bulge) &&
                        angle_of(run) <= 2 * std::numbers::pi * (1 + slack);
    if (run.count > 1 && is_arc && bulges.allows(std::min(bulge, 1.0))) {
      first.bulge = sign * std::min(bulge, 1.0);
      result.push_back(first);
    } else if (run.count <= 2) {
      for (std::size_t i = 0; i < run.count; ++i) result.push_back(edge(run.begin + i));
    } else if (is_arc) {
      std::size_t before = run.begin;  // the last vertex in the first half
      while (squared_norm(edge(before + 1).point - first.point) <=
             squared_norm(edge(before + 1).point - stop))
        ++before;
      const Vec2 top = middle_of({first.point, stop, sign * bulge});
      first.bulge = sign * half_bulge(bulge);
      result.push_back(first);
      result.push_back({top, first.bulge, edge(before).source});
    } else {
      const std::size_t half = run.count / 2, rest = run.count - half;
      append_run({run.begin, half}, result);
      if (half < rest) result.push_back(edge(run.begin + half));
      append_run({run.begin + rest, half}, result);
    }
  }

  /// Two half circles, with the position of their common diameter, whose extents are the same in
  /// every image.
  struct Halves {
    std::vector<RingEdge> edges;
    double longer = 0, shorter = 0;  ///< the diameter's extents in x and y
    /// The distance from the diameter to its mirror image, unless that is a quarter turn of it; the
    /// sign distinguishes the two.
    double aside = 0;
  };

  /// Replaces a ring that is one circle by two half circles that start at one of some vertices. The
  /// graph depends on where they meet, up to quarter turns. So the vertex is chosen in the same way
  /// in every image; if a mirror image would have another one, the ring is not replaced.
  bool merge_circle(const std::vector<std::size_t>& starts) {
    constexpr double twice_around = 4 * std::numbers::pi;
    if (angle_of({0, edges_.size()}) > 0.75 * twice_around) return false;
    std::vector<Halves> places;
    for (const std::size_t from : starts)
      for (const std::size_t to : furthest_from(edges_[from].point))
        if (Halves halves = half_circles(from, to); !halves.edges.empty())
          places.push_back(std::move(halves));
    const auto extents = [](const Halves& h) { return std::pair(h.longer, h.shorter); };
    const auto is_before = [&](const Halves& a, const Halves& b) {
      if (extents(a) != extents(b)) return extents(a) > extents(b);
      const std::size_t k = a.edges[0].point == b.edges[0].point ? 1 : 0;
      const QuarterMap map = around_.map();
      return lexicographic_less(map.to_image(a.edges[k].point), map.to_image(b.edges[k].point));
    };
    std::sort(places.begin(), places.end(), is_before);
    for (auto first = places.begin(), last = first; first != places.end(); first = last) {
      double left = 0, right = 0;
      for (; last != places.end() && extents(*last) == extents(*first); ++last) {
        left = std::max(left, last->aside);
        right = std::max(right, -last->aside);
      }
      if (std::min(left, right) > play_) continue;
      replace_edges(std::move(first->edges));
      return true;
    }
    return false;
  }

  /// Two half circles that start at one vertex, on the circle through it, through another vertex
  /// and, within `play_`, through all others; none if there is no such circle.
  Halves half_circles(std::size_t from, std::size_t to) const {
    RingEdge first = edges_[from], second = edges_[to];
    const double sign = first.bulge > 0 ? 1 : -1;
    const std::size_t count = (to + edges_.size() - from) % edges_.size();
    // The arc on one side of the chord, independent of the ring's direction.
    const bool is_second = (sign > 0) == around_.map().mirrors();
    Bulges bulges = is_second ? Bulges(second.point, first.point, play_)
                              : Bulges(first.point, second.point, play_);
    add_run({from, count}, sign, is_second, bulges);
    add_run({to, edges_.size() - count}, sign, !is_second, bulges);
    const double bulge = bulges.middle();
    if (!bulges.allows(bulge)) return {};
    if (bulge != 1) {
      const double share = (is_second ? -1 : 1) * (1 - bulge * bulge) / (2 * bulge);
      second.point = second.point + (sign * share) * left_of(second.point - first.point);
      if (share < 0) second.source = edges_[previous(to)].source;
    }
    first.bulge = second.bulge = sign;
    const Vec2 diameter = second.point - first.point;
    const double x = std::abs(diameter.x), y = std::abs(diameter.y);
    const double turned = (x - y) / norm(diameter) * (diameter.x / norm(diameter)) * diameter.y;
    return {{first, second}, std::max(x, y), std::min(x, y), turned};
  }

  /// The bulges of the arcs from one point to another that pass others within a distance, if these
  /// turn to the left.
  class Bulges {
   public:
    Bulges(Vec2 from, Vec2 to, double play) : from_(from), to_(to), play_(play) {}

    /// An arc through p turns by twice the angle between the chord to p and the chord from p. That
    /// angle changes at the rate |to - from| / (|p - from| |to - p|) if p is moved. `beyond`: p is
    /// on the arc from `to` to `from`.
    void add(Vec2 p, double sign, bool beyond) {
      const Vec2 before = p - from_, after = to_ - p;
      const double lengths = norm(before) * norm(after);
      if (std::min(norm(before), norm(after)) <= play_) return;
      const double sine = (beyond ? -sign : sign) * cross(before, after);
      const double cosine = dot(before, after);
      const bool wide = cosine <= 0;
      if (!(sine > 0) && (wide || beyond)) {
        most_ = -1;
        return;
      }
      const double through = wide ? (lengths - cosine) / sine : sine / (lengths + cosine);
      const double bulge = beyond ? 1 / through : through;
      const double open = 0.5 * (1 + bulge * bulge) * play_ * norm(to_ - from_) / lengths;
      least_ = std::max(least_, bulge - open);
      most_ = std::min(most_, bulge + open);
    }

    bool allows(double bulge) const { return bulge > 0 && least_ <= bulge && bulge <= most_; }
    /// The middle of the interval; 1 if it is 1 up to rounding.
    double middle() const {
      const double bulge = 0.5 * (least_ + most_);
      return std::abs(bulge - 1) <= slack && allows(1) ? 1 : bulge;
    }

   private:
    Vec2 from_, to_;
    double play_;
    double least_ = -std::numeric_limits<double>::infinity();
    double most_ = std::numeric_limits<double>::infinity();
  };

  /// Adds the inner vertices of a run and the midpoints of its arcs.
  void add_run(Run run, double sign, bool beyond, Bulges& bulges) const {
    for (std::size_t i = run.begin; i < run.begin + run.count; ++i) {
      const RingEdge& one = edge(i);
      if (i > run.begin) bulges.add(one.point, sign, beyond);
      bulges.add(middle_of({one.point, edge(i + 1).point, one.bulge}), sign, beyond);
    }
  }

  std::vector<RingEdge>& edges_;
  const RingSurroundings& around_;
  ShapeReport& report_;
  std::vector<bool>
      straightened_;     ///< of each edge: whether it was an arc that is straight up to rounding
  double rounding_ = 0;  ///< about the spacing of doubles at the largest coordinate
  /// Arcs this near to one circle become one: the tolerance cannot separate them.
  double play_ = 0;
  Vec2 middle_;  ///< of the vertices' box
};

}  // namespace

void clean_arcs(std::vector<RingEdge>& edges, const RingSurroundings& around, ShapeReport& report) {
  // A merged arc may continue the next one, within the play of another box.
  for (;;) {
    const std::uint64_t dropped = report.collinear_points;
    Cleaner(edges, around, report).run();
    if (report.collinear_points == dropped) return;
  }
}

}  // namespace medial
