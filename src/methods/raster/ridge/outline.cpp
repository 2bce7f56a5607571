#include "methods/raster/ridge/outline.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/arc.h"

namespace medial::ridge {
namespace {

using site::Joint;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A vertex of a loop, with the edge that begins there.
struct Vertex {
  Vec2 point;
  double radius;  ///< of the edge; see EdgeOutline
  std::uint32_t site;
  Joint joint;
  double bulge = 0;  ///< of the edge
  bool curved() const { return bulge != 0; }
};

/// Appends the vertices that cut an arc into pieces of at most this sagitta, the arc's start first.
void add_pieces(const BulgeArc& arc, std::uint32_t site, Joint joint, double sagitta,
                std::vector<Vertex>& out) {
  if (arc.bulge == 0) {
    out.push_back({arc.start, infinity, site, joint});
    return;
  }
  const double round = curvature(arc), angle = 4 * std::atan(arc.bulge);
  // A chord over the angle a of a circle of radius R departs from it by 2 R sin^2(a / 4). A site
  // turns by a quarter at most: sin^2(pi / 8) > 0.14.
  const double sine = std::sqrt(std::min(0.14, 0.5 * sagitta * std::abs(round)));
  const double count = std::max(1.0, std::ceil(std::abs(angle) / (4 * std::asin(sine))));
  const Vec2 tangent = start_tangent(arc);
  const double radius = round > 0 ? 1 / round : infinity;
  const double bulge = std::tan(angle / (4 * count));
  for (double k = 0; k < count; ++k) {
    const double half = 0.5 * angle * (k / count);
    const Vec2 way = turned(tangent, std::cos(half), std::sin(half));
    out.push_back({arc.start + (2 * std::sin(half) / round) * way, radius, site,
                   k == 0 ? joint : Joint::smooth, bulge});
  }
}

/// The directions, as seen from an anchor, in which a line passes within a distance of some points:
/// an interval of angles around the first of them.
class Directions {
 public:
  Directions(Vec2 anchor, double distance) : anchor_(anchor), distance_(distance) {}
  bool allow(Vec2 p) const {
    if (!narrowed_) return true;
    const Vec2 d = p - anchor_;
    return cross(low_, d) >= 0 && cross(d, high_) >= 0 && dot(d, low_) > 0;
  }
  void pass(Vec2 p) {
    const Vec2 d = p - anchor_;
    const double squared = squared_norm(d);
    if (squared <= distance_ * distance_) return;  // every line through the anchor
    const double sine = distance_ / std::sqrt(squared), cosine = std::sqrt(1 - sine * sine);
    const Vec2 low = turned(d, cosine, -sine), high = turned(d, cosine, sine);
    if (!narrowed_ || cross(low_, low) > 0) low_ = low;
    if (!narrowed_ || cross(high, high_) > 0) high_ = high;
    narrowed_ = true;
  }

 private:
  Vec2 anchor_;
  double distance_;
  Vec2 low_, high_;
  bool narrowed_ = false;
};

/// Drops vertices between straight edges that turn hardly (step 4 of A.3), where the one edge
/// instead stays within `distance` of all that it replaces: without that, a fine polygon around a
/// disk would vanish altogether.
std::vector<Vertex> combined(const std::vector<Vertex>& loop, double straight, double distance) {
  const std::size_t n = loop.size();
  const auto at = [&](std::size_t i) -> const Vertex& { return loop[i % n]; };
  const auto is_collinear = [&](std::size_t i) {
    const Vertex &before = at(i + n - 1), &vertex = at(i), &after = at(i + 1);
    return !before.curved() && !vertex.curved() &&
           vertex_type(before.point, vertex.point, after.point, straight) == VertexType::collinear;
  };
  // Begin at a vertex that stays.
  std::size_t start = 0;
  while (start < n && is_collinear(start)) ++start;
  if (start == n) start = 0;
  std::vector<Vertex> kept{at(start)};
  Directions directions(at(start).point, distance);
  for (std::size_t i = start + 1; i < start + n; ++i) {
    // Vertex i goes if the edge from the last one kept may run to the next.
    Directions further = directions;
    further.pass(at(i).point);
    if (is_collinear(i) && further.allow(at(i + 1).point)) {
      directions = further;
      continue;
    }
    kept.push_back(at(i));
    directions = Directions(at(i).point, distance);
  }
  return kept.size() < 3 ? loop : kept;
}

void fill_least_radius(EdgeOutline& outline) {
  if (std::all_of(outline.radius.begin(), outline.radius.end(),
                  [](double r) { return r == infinity; }))
    return;
  outline.least_radius.push_back(outline.radius);
  for (std::size_t run = 1; 2 * run <= outline.radius.size(); run *= 2) {
    const std::vector<double>& half = outline.least_radius.back();
    std::vector<double> whole(half.size() - run);
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = std::min(half[i], half[i + run]);
    outline.least_radius.push_back(std::move(whole));
  }
}

/// Finds the vertices in which rings touch. O(edges log edges).
void fill_arriving(EdgeOutline& outline) {
  const auto start = [&](std::uint32_t e) { return outline.edges[e].point; };
  std::vector<std::uint32_t> order(outline.edges.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t e, std::uint32_t f) {
    const Vec2 a = start(e), b = start(f);
    if (a.x != b.x) return a.x < b.x;
    return a.y != b.y ? a.y < b.y : e < f;
  });
  const auto touch = [&](std::uint32_t e, std::uint32_t f) { return start(e) == start(f); };
  if (std::adjacent_find(order.begin(), order.end(), touch) == order.end()) return;
  std::vector<std::uint32_t> before(order.size());
  for (std::uint32_t e = 0; e < before.size(); ++e) before[outline.next[e]] = e;
  outline.arriving = before;
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    for (end = i + 1; end < order.size() && touch(order[i], order[end]);) ++end;
    for (std::size_t k = i; k < end; ++k)
      outline.arriving[order[k]] = before[order[k + 1 < end ? k + 1 : i]];
  }
}

/// A loop's edges and the joints between them. Joints between edges that were combined follow from
/// the edges' own directions.
struct VertexLoop {
  std::vector<Vertex> vertices;

  std::size_t size() const { return vertices.size(); }
  const Vertex& at(std::size_t i) const { return vertices[i % size()]; }
  BulgeArc edge(std::size_t i) const { return {at(i).point, at(i + 1).point, at(i).bulge}; }
  double turn(std::size_t i) const {
    const Vec2 arriving = end_tangent(edge(i + size() - 1)), leaving = start_tangent(edge(i));
    return std::atan2(cross(arriving, leaving), dot(arriving, leaving));
  }
  /// Where an arc is involved, a joint may be smooth or blunt; elsewhere combined edges may turn to
  /// the side that those they replace do not.
  bool is_corner(std::size_t i) const {
    const bool straight = !at(i).curved() && !at(i + size() - 1).curved();
    return straight ? turn(i) > 0 : at(i).joint == Joint::corner;
  }
  /// Begins with the first corner; false where there is none.
  bool begin_at_corner() {
    std::size_t first = 0;
    while (first < size() && !is_corner(first)) ++first;
    if (first == size()) return false;
    std::rotate(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(first),
                vertices.end());
    return true;
  }
};

/// Appends a loop.
void add_loop(VertexLoop loop, std::uint32_t component, EdgeOutline& outline) {
  const std::size_t n = loop.size();
  const bool closed = !loop.begin_at_corner();

  const auto begin = static_cast<std::uint32_t>(outline.edges.size());
  double left = 0, right = 0;
  // A curve that goes on smoothly turns a little at least, so that its radius counts.
  const auto add_turn = [&](std::size_t i, double angle) {
    constexpr double a_little = 1e-12;
    const bool curves = loop.at(i).radius < infinity || loop.at(i + n - 1).radius < infinity;
    if (loop.at(i).joint == Joint::smooth)
      left += curves ? a_little : 0;
    else
      (angle > 0 ? left : right) += std::abs(angle);
  };
  std::uint32_t chain_begin = begin;
  const auto finish_chain = [&](std::uint32_t edges) {
    outline.closed.push_back(edges);
    outline.chain_begin.push_back(chain_begin);
    chain_begin = static_cast<std::uint32_t>(outline.edges.size());
    outline.all_left.push_back(left);
    outline.all_right.push_back(right);
    left = right = 0;
    if (edges > 0) add_turn(0, loop.turn(0));
    outline.closing_left.push_back(left);
    outline.closing_right.push_back(right);
    left = right = 0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Vertex& vertex = loop.at(i);
    const double angle = loop.turn(i);
    const bool corner = loop.is_corner(i);
    if (corner && i > 0) finish_chain(0);
    if (!corner && i > 0) add_turn(i, angle);
    const Vec2 end = loop.at(i + 1).point;
    outline.edges.push_back(vertex.curved() ? site::make_arc(vertex.point, end, vertex.bulge)
                                            : site::make_segment(vertex.point, end));
    outline.site.push_back(vertex.site);
    outline.component.push_back(component);
    outline.type.push_back(corner || (angle > 0 && vertex.joint == Joint::smooth)
                               ? VertexType::convex
                               : VertexType::concave);
    outline.next.push_back(begin + static_cast<std::uint32_t>(i + 1 == n ? 0 : i + 1));
    outline.radius.push_back(vertex.radius);
    outline.chain.push_back(static_cast<std::uint32_t>(outline.closed.size()));
    outline.left.push_back(left);
    outline.right.push_back(right);
    const double own = 4 * std::atan(vertex.bulge);
    (own > 0 ? left : right) += std::abs(own);
    outline.left_end.push_back(left);
    outline.right_end.push_back(right);
  }
  finish_chain(closed ? static_cast<std::uint32_t>(n) : 0);
}

}  // namespace

VertexType vertex_type(Vec2 before, Vec2 vertex, Vec2 after, double straight) {
  const Vec2 back = before - vertex, on = after - vertex;
  const double size = norm(back) * norm(on);
  // The report's boundaries run clockwise; here the interior lies on the left of the way.
  const double sine = -cross(back, on) / size, cosine = dot(back, on) / size;
  const double limit = cosine > 0 ? 0 : straight;
  return sine > limit    ? VertexType::convex
         : sine < -limit ? VertexType::concave
                         : VertexType::collinear;
}

bool EdgeOutline::meet_concavely(std::uint32_t e, std::uint32_t f) const {
  return (next[e] == f && type[f] != VertexType::convex) ||
         (next[f] == e && type[e] != VertexType::convex);
}

bool EdgeOutline::touch_one_vertex(const Touch& a, const Touch& b) const {
  const auto vertex = [this](const Touch& touch) -> const Vec2* {
    const site::Site& edge = edges[touch.edge];
    const double at = site::foot_parameter(edge, touch.center);
    if (at <= 0) return &edge.point;
    return at >= edge.length ? &edges[next[touch.edge]].point : nullptr;
  };
  const Vec2* of_a = vertex(a);
  if (of_a == nullptr) return false;
  const Vec2* of_b = vertex(b);
  return of_b != nullptr && *of_a == *of_b;
}

std::uint32_t EdgeOutline::seen_edge(const Touch& touch) const {
  if (arriving.empty()) return touch.edge;
  const double at = site::foot_parameter(edges[touch.edge], touch.center);
  if (at > 0 && at < edges[touch.edge].length) return touch.edge;
  const std::uint32_t start = at <= 0 ? touch.edge : next[touch.edge];
  if (next[arriving[start]] == start) return touch.edge;
  const Vec2 to = touch.center - edges[start].point;
  // The interior lies, to the left, between the way on and the way back.
  const auto lies_between = [&](std::uint32_t before, std::uint32_t after) {
    const Vec2 on = edges[after].direction, back = left_of(edges[before].end_normal());
    const bool left_of_on = cross(on, to) >= 0, right_of_back = cross(to, back) >= 0;
    return cross(on, back) > 0 ? left_of_on && right_of_back : left_of_on || right_of_back;
  };
  std::uint32_t before = arriving[start];
  while (next[before] != start && !lies_between(before, next[before]))
    before = arriving[next[before]];
  const std::uint32_t after = next[before];
  return touch.edge == before || touch.edge == after ? touch.edge : std::min(before, after);
}

bool EdgeOutline::are_one(const Touch& a, const Touch& b, double disk) const {
  const Touch of_a{seen_edge(a), a.center}, of_b{seen_edge(b), b.center};
  return lie_on_one_curve(of_a, of_b, disk) || touch_one_vertex(of_a, of_b);
}

bool EdgeOutline::lie_on_one_curve(const Touch& a, const Touch& b, double disk) const {
  const std::uint32_t c = chain[a.edge];
  if (chain[b.edge] != c) return false;
  const Touch &low = a.edge < b.edge ? a : b, &high = a.edge < b.edge ? b : a;
  const std::uint32_t i = low.edge, j = high.edge;
  if (closed[c] > 0 && all_left[c] + closing_left[c] == 0) return true;  // a convex hole
  const auto least = [&](std::uint32_t from, std::uint32_t end) {
    if (from >= end) return infinity;
    const auto level = static_cast<std::size_t>(std::bit_width(end - from) - 1);
    const std::vector<double>& radius_of = least_radius[level];
    return std::min(radius_of[from], radius_of[end - (std::uint32_t{1} << level)]);
  };
  // Edges that are touched in the vertex on the side of the other one are none between.
  const auto at_start = [&](const Touch& touch) -> std::uint32_t {
    return site::foot_parameter(edges[touch.edge], touch.center) <= 0 ? 1 : 0;
  };
  const auto at_end = [&](const Touch& touch) -> std::uint32_t {
    const site::Site& edge = edges[touch.edge];
    return site::foot_parameter(edge, touch.center) >= edge.length ? 1 : 0;
  };
  constexpr double half_turn = std::numbers::pi;
  const double lefts = left[j] - left_end[i], rights = right[j] - right_end[i];
  if (lefts <= half_turn && rights <= half_turn &&
      (lefts == 0 ||
       (!least_radius.empty() && disk + margin < least(i + at_end(low), j + 1 - at_start(high)))))
    return true;
  if (closed[c] == 0) return false;
  // The other way round the loop; chains of a loop without a corner begin with its first edge.
  const double other_lefts = (all_left[c] - left_end[j]) + closing_left[c] + left[i];
  const double other_rights = (all_right[c] - right_end[j]) + closing_right[c] + right[i];
  if (other_lefts > half_turn || other_rights > half_turn) return false;
  const std::uint32_t first = chain_begin[c], end = first + closed[c];
  return other_lefts == 0 || least_radius.empty() ||
         disk + margin <
             std::min(least(first, i + 1 - at_start(low)), least(j + at_end(high), end));
}

EdgeOutline outline_of(const Problem& problem, double step) {
  const Shape& shape = problem.shape;
  const site::SiteNumbers& numbers = problem.numbers();
  constexpr double chord_share = 1.0 / 16, combined_share = 1.0 / 4;
  EdgeOutline outline;
  if (!shape.bulges.empty()) outline.sagitta = chord_share * step;
  outline.margin = step * (std::numbers::sqrt2 / 2 + 1.01 * chord_share);
  const double straight = std::sin(problem.own<method::Ridge>().collinear * std::numbers::pi / 180);
  for (std::size_t l = 0; l < shape.loop_count(); ++l) {
    const site::LoopEdges loop(shape, l, problem.frame);
    std::vector<Vertex> vertices;
    for (std::uint32_t i = 0; i < loop.size(); ++i)
      add_pieces({loop.local(i), loop.local(loop.next(i)), loop.bulge(i)},
                 numbers.edge[loop.begin() + i], numbers.joints[loop.begin() + i],
                 chord_share * step, vertices);
    if (straight > 0) vertices = combined(vertices, straight, combined_share * step);
    add_loop({std::move(vertices)}, shape.component[l], outline);
  }
  fill_least_radius(outline);
  fill_arriving(outline);
  return outline;
}

}  // namespace medial::ridge
