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

/// Of a sum of angles, relative.
constexpr double slack = 64 * std::numeric_limits<double>::epsilon();

/// Of an arc of at most a half circle.
double bulge_of_angle(double angle) {
  return angle >= std::numbers::pi * (1 - slack) ? 1 : std::tan(angle / 4);
}

/// The edges of one ring with arcs.
class Cleaner {
 public:
  Cleaner(std::vector<RingEdge>& edges, ShapeReport& report) : edges_(edges), report_(report) {
    Box box{edges[0].point, edges[0].point};
    for (const RingEdge& edge : edges) box.add(edge.point);
    rounding_ = spacing_in(box);
    play_ = std::max(4 * rounding_, tolerance_for(box, 0));
  }

  void run() {
    straighten();
    // Nothing is merged in a ring of two edges: it would vanish.
    if (edges_.size() > 2) drop_collinear();
    split_long_arcs();
    merge_cocircular();
  }

 private:
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
        const Vec2 middle = apex(arc(i));
        edge.bulge = std::clamp(half_bulge(edge.bulge), -1.0, 1.0);
        result.push_back(edge);
        edge.point = middle;
      }
      result.push_back(edge);
    }
    edges_ = std::move(result);
  }

  /// As for rings without arcs: dropping a vertex changes no direction. Where arcs became straight,
  /// it changes it within the play: what joined smoothly is no corner now.
  void drop_collinear() {
    const std::size_t count = edges_.size();
    std::vector<bool> dropped(count);
    // Runs of straight edges begin behind an arc.
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
    std::vector<RingEdge> result;
    for (std::size_t i = 0; i < count; ++i) {
      if (dropped[i])
        ++report_.collinear_points;
      else
        result.push_back(edges_[i]);
    }
    if (result.size() >= 2) edges_ = std::move(result);
  }

  /// Whether the vertices between two others, few, lie between them in one line, within the play.
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

  /// Whether an arc may continue the one before it on the same circle.
  bool continues(std::size_t i) const {
    const BulgeArc first = arc(previous(i));
    const BulgeArc second = arc(i);
    if (!(first.bulge * second.bulge > 0)) return false;
    const double length = norm(second.chord());
    const double expected = bulge_of(end_tangent(first), second.chord());
    if (!(std::abs(expected - second.bulge) * length <= play_)) return false;
    const double shorter = std::min(length, norm(first.chord()));
    return std::abs(curvature(first) - curvature(second)) * shorter * shorter <= 8 * play_;
  }

  /// Replaces each run of arcs on one circle by one arc, or by two if it is more than a half
  /// circle.
  void merge_cocircular() {
    const std::size_t count = edges_.size();
    std::vector<bool> smooth(count);
    std::size_t corner = count;
    for (std::size_t i = 0; i < count; ++i) {
      smooth[i] = continues(i);
      if (!smooth[i] && corner == count) corner = i;
    }
    if (std::none_of(smooth.begin(), smooth.end(), [](bool value) { return value; })) return;
    if (corner == count) {
      // A full circle. It begins at its lowest vertex.
      corner = 0;
      for (std::size_t i = 1; i < count; ++i) {
        if (lexicographic_less(edges_[i].point, edges_[corner].point)) corner = i;
      }
    }
    std::rotate(edges_.begin(), edges_.begin() + static_cast<std::ptrdiff_t>(corner), edges_.end());
    std::rotate(smooth.begin(), smooth.begin() + static_cast<std::ptrdiff_t>(corner), smooth.end());
    std::vector<RingEdge> result;
    for (std::size_t i = 0; i < count;) {
      std::size_t end = i + 1;
      while (end < count && smooth[end]) ++end;
      append_run(i, end, result);
      i = end;
    }
    // Back to the old start, where it is still a vertex, so that all else stays in its order.
    edges_ = std::move(result);
    const auto lowest = std::min_element(
        edges_.begin(), edges_.end(),
        [](const RingEdge& a, const RingEdge& b) { return a.source.vertex < b.source.vertex; });
    if (!smooth[0]) std::rotate(edges_.begin(), lowest, edges_.end());
  }

  /// Appends the run of edges [begin, end) to the result, merged if its vertices allow it, or else
  /// its two halves.
  void append_run(std::size_t begin, std::size_t end, std::vector<RingEdge>& result) {
    const auto keep = [&] {
      if (end - begin <= 2) {
        for (std::size_t i = begin; i < end; ++i) result.push_back(edges_[i]);
        return;
      }
      const std::size_t half = begin + (end - begin) / 2;
      append_run(begin, half, result);
      append_run(half, end, result);
    };
    const std::size_t last = end < edges_.size() ? end : 0;
    const Vec2 start = edges_[begin].point;
    const Vec2 stop = edges_[last].point;
    constexpr double pi = std::numbers::pi;
    const double sign = edges_[begin].bulge > 0 ? 1 : -1;
    const double angle = angle_of_run(begin, end);
    if (end - begin == 1 || angle > 2 * pi * (1 + slack)) return keep();
    if (angle <= pi * (1 + slack) && start != stop) {
      const double bulge = sign * bulge_of_angle(angle);
      if (!follows({start, stop, bulge}, begin, end)) return keep();
      report_.collinear_points += end - begin - 1;
      result.push_back({start, bulge, edges_[begin].source});
      return;
    }
    auto [middle, angle_to_middle] = middle_of_run(begin, end, angle);
    const bool divides = std::max(angle_to_middle, angle - angle_to_middle) <= pi * (1 + slack);
    if (divides && end - begin == 2) return keep();
    RingEdge second = edges_[middle];
    std::size_t end_of_first = middle;
    if (!divides) {
      // No vertex divides it into two parts of at most a half circle: a new one does.
      if (start == stop) {
        const BulgeArc part{start, second.point, sign * std::tan(angle_to_middle / 4)};
        const double height = (1 - part.bulge * part.bulge) / (4 * part.bulge);
        second.point = start + part.chord() + 2 * height * left_of(part.chord());
      } else {
        second.point = apex({start, stop, sign * std::tan(angle / 4)});
      }
      if (angle_to_middle > angle / 2) --middle;
      second.source = edges_[middle].source;
      end_of_first = middle + 1;
      angle_to_middle = angle / 2;
    }
    const double first_bulge = sign * bulge_of_angle(angle_to_middle);
    second.bulge = sign * bulge_of_angle(angle - angle_to_middle);
    if (second.point == start || second.point == stop ||
        !follows({start, second.point, first_bulge}, begin, end_of_first) ||
        !follows({second.point, stop, second.bulge}, middle, end)) {
      return keep();
    }
    report_.collinear_points += end - begin > 2 ? end - begin - 2 : 0;
    result.push_back({start, first_bulge, edges_[begin].source});
    result.push_back(second);
  }

  /// The vertex next to the middle of a run that turns by `angle`, and the angle up to it.
  std::pair<std::size_t, double> middle_of_run(std::size_t begin, std::size_t end,
                                               double angle) const {
    std::pair<std::size_t, double> middle{begin + 1, 0};
    double sum = 0;
    for (std::size_t i = begin; i + 1 < end; ++i) {
      sum += 4 * std::atan(std::abs(edges_[i].bulge));
      if (i == begin || std::abs(sum - angle / 2) < std::abs(middle.second - angle / 2))
        middle = {i + 1, sum};
    }
    return middle;
  }

  /// The angle that a run of arcs turns by: twice that between the chords to and from a vertex in
  /// its inside. The arcs' own angles add up to it, too, but so do their errors; they say how many
  /// times the run goes around.
  double angle_of_run(std::size_t begin, std::size_t end) const {
    constexpr double once_around = 2 * std::numbers::pi, same = 1e-6;
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += 4 * std::atan(std::abs(edges_[i].bulge));
    if (end - begin == 1) return sum;
    const Vec2 start = edges_[begin].point, stop = edges_[end < edges_.size() ? end : 0].point;
    const Vec2 inside = edges_[begin + (end - begin) / 2].point;
    const Vec2 to = inside - start, from = stop - inside;
    const double angle =
        start == stop ? once_around : 2 * std::abs(std::atan2(cross(to, from), dot(to, from)));
    return std::abs(angle - sum) <= same ? angle : sum;
  }

  /// Whether all edges of a run lie on the arc, within the play: their ends and their middles.
  bool follows(const BulgeArc& whole, std::size_t begin, std::size_t end) const {
    const Vec2 normal = left_of(start_tangent(whole));
    const double half_curvature = curvature(whole) / 2;
    const auto is_on = [&](Vec2 p) {
      const Vec2 q = p - whole.start;
      return std::abs(dot(normal, q) - half_curvature * squared_norm(q)) <= play_;
    };
    for (std::size_t i = begin; i < end; ++i)
      if (!is_on(edges_[i].point) || !is_on(apex(arc(i)))) return false;
    return true;
  }

  std::vector<RingEdge>& edges_;
  ShapeReport& report_;
  std::vector<bool>
      straightened_;     ///< of each edge: whether it was an arc, as straight as rounding
  double rounding_ = 0;  ///< the spacing of doubles at the largest coordinate, about
  /// Arcs this near to one circle become one: the tolerance cannot separate them.
  double play_ = 0;
};

}  // namespace

void clean_arcs(std::vector<RingEdge>& edges, ShapeReport& report) { Cleaner(edges, report).run(); }

}  // namespace medial
