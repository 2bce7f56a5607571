#include "methods/exact/crossing.h"

#include <vector>

#include "axis/sites.h"
#include "base/arc_box.h"
#include "base/box_tree.h"
#include "methods/exact/site_form.h"

namespace medial::exact {
namespace {

using Number = Bounded<Precise>;
using Point = Vector<Number>;

/// The line of places whose way from an origin has this product with a normal.
struct Line {
  Point normal;
  Number product;
};

using Circle = DiskBounds<Precise>;

/// Seen from an origin.
Line line_of(const ExactSite& segment, const Point& origin) {
  const Point normal = normal_of<Number>(segment, false);
  return {normal, dot(normal, exact_vector<Number>(segment.start) - origin)};
}
/// The line through the points that two circles share, seen from the first one's centre.
Line line_of(const Circle& a, const Circle& b) {
  const Point way = b.center - a.center;
  return {way, Number(0.5) * (a.radius * a.radius - b.radius * b.radius + dot(way, way))};
}

/// Where a line that is seen from a circle's centre surely crosses the circle.
std::vector<Point> points_on(const Circle& circle, const Line& line) {
  const Number squared = dot(line.normal, line.normal);
  if (!squared.positive()) return {};
  const Number share = line.product / squared;
  const Number height = circle.radius * circle.radius / squared - share * share;
  if (!height.positive()) return {};
  const Point foot = circle.center + share * line.normal,
              way = root_of(height) * left_of(line.normal);
  return {foot - way, foot + way};
}

std::vector<Point> points_of(const ExactSite& a, const ExactSite& b) {
  if (a.is_arc()) {
    const Circle circle = circle_of<Precise>(a);
    return points_on(
        circle, b.is_arc() ? line_of(circle, circle_of<Precise>(b)) : line_of(b, circle.center));
  }
  if (b.is_arc()) return points_of(b, a);
  const Point start = exact_vector<Number>(a.start), along = exact_vector<Number>(a.end) - start;
  const Line line = line_of(b, start);
  const Number slope = dot(line.normal, along);
  if (!slope.sign() || *slope.sign() == 0) return {};
  return {start + (line.product / slope) * along};
}

/// Whether a place on an edge's carrier surely lies inside the edge. No arc has more than a half
/// circle: it lies on one side of its chord.
bool is_inside(const ExactSite& edge, const Point& place) {
  const Point start = exact_vector<Number>(edge.start), end = exact_vector<Number>(edge.end);
  if (edge.is_arc()) return cross(end - start, place - start).sign() == (edge.bulge > 0 ? -1 : 1);
  return dot(end - start, place - start).positive() && dot(end - start, end - place).positive();
}

/// The edges of a shape in the local frame, by the points in which they begin.
std::vector<ExactSite> edges_of(const Problem& problem) {
  std::vector<ExactSite> edges;
  edges.reserve(problem.shape.points.size());
  for (std::size_t l = 0; l < problem.shape.loop_count(); ++l) {
    const site::LoopEdges loop(problem.shape, l, problem.frame);
    for (std::uint32_t i = 0; i < loop.size(); ++i)
      edges.push_back({loop.local(i), loop.local(loop.next(i)), loop.bulge(i)});
  }
  return edges;
}

/// Where two edges surely cross inside both.
std::optional<Vec2> crossing_of(const ExactSite& a, const ExactSite& b) {
  for (const Point& place : points_of(a, b))
    if (is_inside(a, place) && is_inside(b, place))
      return Vec2{static_cast<double>(place.x.value), static_cast<double>(place.y.value)};
  return std::nullopt;
}

}  // namespace

std::optional<Crossing> find_crossing(const Problem& problem) {
  constexpr std::size_t questions = 1 << 4, least = 1 << 12;  // of each edge, on average
  const std::vector<ExactSite> edges = edges_of(problem);
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (const ExactSite& edge : edges)
    boxes.push_back(box_around({edge.start, edge.end, edge.bulge}));
  const BoxTree tree(boxes);
  std::size_t left = questions * edges.size() + least;
  std::optional<Crossing> found;
  for (std::size_t i = 0; i < edges.size() && !found && left > 0; ++i)
    tree.find(boxes[i], [&](std::uint32_t j) {
      if (j <= i || found || left == 0) return;
      --left;
      if (const auto place = crossing_of(edges[i], edges[j]))
        found = {i, j, problem.frame.to_input(*place)};
    });
  return found;
}

}  // namespace medial::exact
