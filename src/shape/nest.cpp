#include "shape/nest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/arc.h"
#include "base/box_tree.h"
#include "base/predicates.h"
#include "shape/errors.h"
#include "shape/monotone_arc.h"

namespace medial {
namespace {

/// Whether the wedge of a ring that opens rightward at its leftmost vertex is interior.
bool inside_is_interior(const Arrangement& arrangement, std::uint32_t ring) {
  const std::vector<Vec2>& points = arrangement.points;
  const std::uint32_t begin = arrangement.begin[ring];
  const std::uint32_t end = arrangement.begin[ring + 1];
  Vec2 leftmost = points[begin];
  for (std::uint32_t v = begin + 1; v < end; ++v) {
    if (lexicographic_less(points[v], leftmost)) leftmost = points[v];
  }
  // The lowest edge there has the wedge above it: on its left, walked away from the vertex.
  std::optional<Ray> lowest;
  const auto consider = [&](const Ray& ray) {
    if (!lowest || !turns_left(leftmost, *lowest, ray)) lowest = ray;
  };
  for (std::uint32_t v = begin; v < end; ++v) {
    if (points[v] == leftmost) consider(ray_from_start(arrangement, v));
    if (points[arrangement.next[v]] == leftmost) consider(ray_from_end(arrangement, v));
  }
  return lowest->outgoing;
}

/// Whether the rings [begin, end) of one polygon have its outer ring among them, though not first:
/// one ring with the interior inside, directly in which all others lie.
bool is_polygon_in_other_order(const Arrangement& arrangement, const SplicedLoops& loops,
                               std::uint32_t begin, std::uint32_t end) {
  const auto component = [&](std::uint32_t ring) {
    return loops.loops[loops.loop_of[arrangement.begin[ring]]].component;
  };
  std::uint32_t outer_rings = 0;
  for (std::uint32_t ring = begin; ring < end; ++ring) {
    if (component(ring) != component(begin)) return false;
    if (inside_is_interior(arrangement, ring)) ++outer_rings;
  }
  return outer_rings == 1;
}

}  // namespace

std::optional<Error> check_roles(std::span<const Ring> rings, const Arrangement& arrangement,
                                 const SplicedLoops& loops) {
  for (std::uint32_t i = 0; i < rings.size(); ++i) {
    const RingRole role = rings[i].role;
    if (role == RingRole::any || role == RingRole::winding) continue;
    if (inside_is_interior(arrangement, i) == (role == RingRole::outer)) continue;
    std::uint32_t begin = i;
    while (begin > 0 && rings[begin].role == RingRole::hole) --begin;
    std::uint32_t end = i + 1;
    while (end < rings.size() && rings[end].role == RingRole::hole) ++end;
    if (is_polygon_in_other_order(arrangement, loops, begin, end)) {
      i = end - 1;
      continue;
    }
    const std::uint32_t first = arrangement.begin[i];
    const bool hole = role == RingRole::hole;
    return error_at(hole ? ErrorCode::hole_outside : ErrorCode::nested_outer,
                    hole ? "the hole does not lie inside an outer ring"
                         : "the outer ring lies inside another outer ring",
                    arrangement.sources[first], arrangement.original(first));
  }
  return std::nullopt;
}

namespace {

/// Finds the edges that stay and lie below vertices.
class EdgesBelow {
 public:
  /// O(n log n).
  explicit EdgesBelow(const Arrangement& arrangement)
      : arrangement_(arrangement), edges_(kept(arrangement)), tree_(boxes()) {}

  /// The highest edge that stays strictly below a vertex and begins further left; no_index if there
  /// is none.
  std::uint32_t of(std::uint32_t vertex) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Vec2 p = arrangement_.points[vertex];
    std::uint32_t highest = no_index;
    Box below{{p.x, -infinity}, p};
    tree_.find(below, [&](std::uint32_t i) {
      const MonotoneArc arc = piece(edges_[i]);
      if (!(arc.left.x < p.x && p.x <= arc.right.x) || arc.right == p) return;
      const double y = arc.y_at(p.x);
      if (!(y < p.y && y > below.low.y)) return;
      below.low.y = y;
      highest = edges_[i];
    });
    return highest;
  }

 private:
  static std::vector<std::uint32_t> kept(const Arrangement& arrangement) {
    std::vector<std::uint32_t> edges;
    for (std::uint32_t e = 0; e < arrangement.points.size(); ++e)
      if (!arrangement.is_dropped(e)) edges.push_back(e);
    return edges;
  }
  MonotoneArc piece(std::uint32_t edge) const {
    const Vec2 from = arrangement_.points[edge], to = arrangement_.points[arrangement_.next[edge]];
    const double bulge = arrangement_.bulges.empty() ? 0 : arrangement_.bulges[edge];
    return lexicographic_less(from, to) ? monotone_arc(from, to, bulge)
                                        : monotone_arc(to, from, -bulge);
  }
  std::vector<Box> boxes() const {
    std::vector<Box> boxes;
    for (const std::uint32_t edge : edges_) {
      const MonotoneArc arc = piece(edge);
      boxes.push_back({{arc.left.x, arc.low()}, {arc.right.x, arc.high()}});
    }
    return boxes;
  }

  const Arrangement& arrangement_;
  std::vector<std::uint32_t> edges_;
  BoxTree tree_;
};

}  // namespace

std::optional<Error> nest(const Arrangement& arrangement, SplicedLoops& loops) {
  // A hole's leftmost vertex has the interior on the left: no edge ends there. So the sweep has
  // noted the edge below, whose loop began further left and borders the same component.
  std::vector<std::uint32_t> outer;
  std::unordered_map<std::uint32_t, std::uint32_t> hole_at;
  for (std::uint32_t i = 0; i < loops.loops.size(); ++i) {
    if (loops.loops[i].hole) {
      hole_at.emplace(loops.loops[i].leftmost, i);
    } else {
      outer.push_back(i);
    }
  }
  std::sort(outer.begin(), outer.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(loops.loops[a].first_vertex, a) < std::tie(loops.loops[b].first_vertex, b);
  });
  for (std::uint32_t i = 0; i < outer.size(); ++i) loops.loops[outer[i]].component = i;
  if (!hole_at.empty()) {
    for (const LeftEnd& end : arrangement.left_ends) {
      const auto hole = hole_at.find(end.vertex);
      if (hole == hole_at.end() || end.below == no_index) continue;
      const std::uint32_t below =
          arrangement.is_dropped(end.below) ? arrangement.stands_for[end.below] : end.below;
      if (below == no_index) continue;
      loops.loops[hole->second].component = loops.loops[loops.loop_of[below]].component;
    }
  }
  // Unless dropped edges end there, with the interior on both sides.
  std::vector<std::uint32_t> lost;
  for (std::uint32_t i = 0; i < loops.loops.size(); ++i)
    if (loops.loops[i].component == no_index) lost.push_back(i);
  std::sort(lost.begin(), lost.end(), [&](std::uint32_t a, std::uint32_t b) {
    return lexicographic_less(arrangement.points[loops.loops[a].leftmost],
                              arrangement.points[loops.loops[b].leftmost]);
  });
  if (lost.empty()) return std::nullopt;
  const EdgesBelow edges(arrangement);
  for (const std::uint32_t i : lost) {
    const std::uint32_t below = edges.of(loops.loops[i].leftmost);
    if (below != no_index) loops.loops[i].component = loops.loops[loops.loop_of[below]].component;
  }
  for (const SplicedLoop& loop : loops.loops) {
    if (loop.component != no_index) continue;
    // As in splice(): of arcs that cross by little more than the tolerance, none may be around it.
    if (!arrangement.bulges.empty())
      return error_at(ErrorCode::crossing, "edges cross next to this vertex",
                      arrangement.sources[loop.leftmost], arrangement.original(loop.leftmost));
    return error_without_place(ErrorCode::internal, "a hole has no component");
  }
  return std::nullopt;
}

namespace {

/// Twice the area of the loop that a shape ends with, and what rounding may add to it.
struct LoopArea {
  double doubled = 0, rounding = 0;
};
LoopArea area_from(const Shape& shape, std::size_t first) {
  LoopArea area;
  const std::size_t end = shape.points.size();
  for (std::size_t i = first; i < end; ++i) {
    const Vec2 p = shape.points[i], q = shape.points[i + 1 < end ? i + 1 : first];
    const Vec2 a = p - shape.points[first], b = q - shape.points[first];
    area.doubled += cross(a, b) + 2 * area_beside_chord({p, q, shape.bulges[i]});
    area.rounding += std::abs(a.x * b.y) + std::abs(a.y * b.x);
  }
  area.rounding *= static_cast<double>(end - first) * std::numeric_limits<double>::epsilon();
  return area;
}

/// Takes pairs of edges of which the second leads back along the first, within the tolerance, out
/// of the loop that a shape ends with: they have nothing between them. (Where they are longer than
/// some tolerances, they overlap.)
void drop_needles(Shape& shape, double tolerance) {
  const std::size_t first = shape.loop_begin.back(), end = shape.points.size();
  const auto is_needle = [&](std::size_t before, std::size_t tip, std::size_t after) {
    const Vec2 p = shape.points[before];
    const double width =
        std::abs(shape.bulges[before] + shape.bulges[tip]) / 2 * distance(p, shape.points[tip]);
    return p == shape.points[after] && width <= tolerance;
  };
  const auto move = [&](std::size_t from, std::size_t to) {
    shape.points[to] = shape.points[from];
    shape.sources[to] = shape.sources[from];
    shape.bulges[to] = shape.bulges[from];
  };
  std::size_t low = first, high = first;  // what is kept, so far
  for (std::size_t v = first; v < end; ++v) {
    while (high - low >= 2 && is_needle(high - 2, high - 1, v)) high -= 2;
    move(v, high++);
  }
  while (high - low >= 2) {
    if (is_needle(high - 2, high - 1, low))
      high -= 2;
    else if (is_needle(high - 1, low, low + 1))
      ++low, --high;
    else
      break;
  }
  if (high - low == end - first) return;
  for (std::size_t v = low; low > first && v < high; ++v) move(v, v - (low - first));
  shape.points.resize(first + (high - low));
  shape.sources.resize(shape.points.size());
  shape.bulges.resize(shape.points.size());
}

}  // namespace

Result<Shape> assemble(const Arrangement& arrangement, const SplicedLoops& loops) {
  std::vector<std::uint32_t> order(loops.loops.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const SplicedLoop& la = loops.loops[a];
    const SplicedLoop& lb = loops.loops[b];
    return std::tie(la.component, la.hole, la.first_vertex, a) <
           std::tie(lb.component, lb.hole, lb.first_vertex, b);
  });

  Shape shape;
  shape.points.reserve(arrangement.points.size());
  shape.sources.reserve(arrangement.points.size());
  const bool with_arcs = !arrangement.bulges.empty();
  if (with_arcs) shape.bulges.reserve(arrangement.points.size());
  std::uint32_t components = 0;
  std::uint32_t gone = ~std::uint32_t{0};  // the component whose outer loop was nothing but needles
  for (const std::uint32_t i : order) {
    const SplicedLoop& loop = loops.loops[i];
    if (loop.hole && loop.component == gone) continue;
    shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
    std::uint32_t edge = loop.first_edge;
    do {
      const std::uint32_t vertex = tail(arrangement, edge);
      if (!with_arcs) {
        shape.points.push_back(arrangement.points[vertex]);
        shape.sources.push_back(arrangement.sources[vertex]);
      } else if (!arrangement.passing[vertex]) {
        const double bulge = arrangement.edge_bulges[edge];
        shape.points.push_back(arrangement.originals[vertex]);
        shape.sources.push_back(arrangement.sources[vertex]);
        shape.bulges.push_back(arrangement.interior_left[edge] ? bulge : 0 - bulge);
      }
      edge = loops.successor[edge];
    } while (edge != loop.first_edge);
    if (with_arcs) {
      const std::size_t first = shape.loop_begin.back();
      drop_needles(shape, arrangement.tolerance);
      if (shape.points.size() == first) {
        shape.loop_begin.pop_back();
        if (!loop.hole) gone = loop.component;
        continue;
      }
      // Edges that cross within the tolerance may enclose more between them than the loop does.
      const LoopArea area = area_from(shape, first);
      if ((loop.hole ? area.doubled : -area.doubled) > area.rounding)
        return error_at(ErrorCode::crossing, "edges cross next to this vertex",
                        shape.sources[first], shape.points[first]);
    }
    components += loop.hole ? 0 : 1;
    shape.component.push_back(components - 1);
    shape.hole.push_back(loop.hole);
  }
  shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
  return shape;
}

}  // namespace medial
