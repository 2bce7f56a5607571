#include "shape/splice.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "base/compat.h"
#include "base/predicates.h"
#include "shape/errors.h"
#include "shape/monotone_arc.h"

namespace medial {

std::uint32_t Arrangement::ring_of(std::uint32_t vertex) const {
  const auto after = std::upper_bound(begin.begin(), begin.end(), vertex);
  return static_cast<std::uint32_t>(after - begin.begin()) - 1;
}

std::uint32_t Arrangement::previous(std::uint32_t vertex) const {
  if (vertex > 0 && next[vertex - 1] == vertex) return vertex - 1;
  const std::uint32_t ring = ring_of(vertex);
  return (vertex == begin[ring] ? begin[ring + 1] : vertex) - 1;
}

namespace {

/// The touches of the sweep name vertices of the outline, the `split_count` after them those of the
/// arrangement: all do then, in the order of their places.
void renumber_touches(Arrangement& result, const std::vector<std::uint32_t>& new_vertex,
                      std::uint32_t split_count) {
  const std::size_t whole = result.touches.size() - split_count;
  for (std::size_t i = 0; i < whole; ++i)
    result.touches[i].vertex = new_vertex[result.touches[i].vertex];
  std::stable_sort(result.touches.begin(), result.touches.end(),
                   [](const Touch& a, const Touch& b) { return a.place < b.place; });
}

/// The splits of each edge one after another, from left to right.
std::vector<std::uint32_t> in_order_of_edges(const std::vector<Split>& splits) {
  std::vector<std::uint32_t> order(splits.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return splits[a].edge < splits[b].edge;
  });
  return order;
}

Arrangement with_room(std::size_t vertices, std::size_t rings) {
  Arrangement result;
  result.points.reserve(vertices);
  result.sources.reserve(vertices);
  result.begin.reserve(rings);
  result.next.resize(vertices);
  result.interior_left.reserve(vertices);
  return result;
}

/// Links each vertex to the next one of its ring.
void link_rings(Arrangement& arrangement) {
  const auto& begin = arrangement.begin;
  std::iota(arrangement.next.begin(), arrangement.next.end(), 1U);
  for (std::size_t ring = 0; ring + 1 < begin.size(); ++ring)
    arrangement.next[begin[ring + 1] - 1] = begin[ring];
}

}  // namespace

Arrangement insert_splits(CleanRings cleaned, Sweep sweep) {
  const auto edge_count = static_cast<std::uint32_t>(cleaned.points.size());
  const auto split_count = static_cast<std::uint32_t>(sweep.splits.size());
  const std::size_t total = cleaned.points.size() + sweep.splits.size();
  const std::vector<std::uint32_t> order = in_order_of_edges(sweep.splits);

  Arrangement result = with_room(total, cleaned.begin.size());
  result.place_count = sweep.place_count;
  result.touches = std::move(sweep.touches);
  std::vector<std::uint32_t> new_vertex(edge_count);
  std::vector<std::uint32_t> new_edge_of_split(split_count);

  std::uint32_t done = 0;  // of the splits
  const auto append = [&](std::uint32_t vertex, std::uint32_t piece, bool rightward) {
    result.points.push_back(cleaned.points[vertex]);
    result.sources.push_back(cleaned.sources[vertex]);
    result.interior_left.push_back(sweep.interior_above[piece] == rightward);
  };
  for (std::uint32_t e = 0; e < edge_count; ++e) {
    const auto index = static_cast<std::uint32_t>(result.points.size());
    if (e == cleaned.begin[result.begin.size()]) result.begin.push_back(index);
    new_vertex[e] = index;
    const bool rightward = lexicographic_less(cleaned.points[e], cleaned.points[cleaned.next(e)]);
    std::uint32_t end = done;
    while (end < split_count && sweep.splits[order[end]].edge == e) ++end;
    const std::uint32_t count = end - done;
    // Walked leftward, an edge begins with its last piece, and each split with the piece before it.
    append(e, rightward || count == 0 ? e : edge_count + order[end - 1], rightward);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t split = order[rightward ? done + i : end - 1 - i];
      const std::uint32_t leftward_piece = i + 1 < count ? edge_count + order[end - 2 - i] : e;
      const auto vertex = static_cast<std::uint32_t>(result.points.size());
      append(sweep.splits[split].vertex, rightward ? edge_count + split : leftward_piece,
             rightward);
      result.touches.push_back({sweep.splits[split].place, vertex});
      new_edge_of_split[split] = rightward ? vertex : vertex - 1;
    }
    done = end;
  }
  result.begin.push_back(static_cast<std::uint32_t>(total));
  link_rings(result);
  renumber_touches(result, new_vertex, split_count);
  const auto new_edge = [&](std::uint32_t piece) {
    if (piece == no_index) return no_index;
    if (piece >= edge_count) return new_edge_of_split[piece - edge_count];
    // The leftmost piece is the last one of an edge walked leftward.
    if (lexicographic_less(cleaned.points[piece], cleaned.points[cleaned.next(piece)]))
      return new_vertex[piece];
    const std::uint32_t after =
        piece + 1 < edge_count ? new_vertex[piece + 1] : static_cast<std::uint32_t>(total);
    return after - 1;
  };
  result.left_ends = std::move(sweep.left_ends);
  for (LeftEnd& end : result.left_ends) {
    end.vertex = new_vertex[end.vertex];
    end.below = new_edge(end.below);
  }
  return result;
}

Arrangement arrange_arcs(SweptArcs swept) {
  NodedRings& noded = swept.noded;
  std::vector<double> bulges = noded.cleaned.bulges;
  Arrangement result = insert_splits(std::move(noded.cleaned), std::move(swept.sweep));
  result.sources = std::move(noded.sources);
  result.bulges = std::move(bulges);
  result.edge_bulges = std::move(noded.edge_bulges);
  result.originals = std::move(noded.originals);
  result.passing = std::move(noded.passing);
  result.tolerance = swept.tolerance;
  return result;
}

Ray ray_from_start(const Arrangement& arrangement, std::uint32_t edge) {
  const double bulge = arrangement.bulges.empty() ? 0 : arrangement.bulges[edge];
  return {arrangement.points[arrangement.next[edge]], edge, bulge, arrangement.interior_left[edge],
          true};
}

Ray ray_from_end(const Arrangement& arrangement, std::uint32_t edge) {
  const double bulge = arrangement.bulges.empty() ? 0 : arrangement.bulges[edge];
  return {arrangement.points[edge], edge, -bulge, !arrangement.interior_left[edge], false};
}

bool turns_left(Vec2 center, const Ray& a, const Ray& b) {
  if (a.bulge == 0 && b.bulge == 0) return orientation(center, a.far, b.far) > 0;
  if (lexicographic_less(center, a.far)) {
    return is_below(monotone_arc(center, a.far, a.bulge), monotone_arc(center, b.far, b.bulge));
  }
  // Turned by a half turn, which changes no order.
  return is_below(monotone_arc(-center, -a.far, a.bulge), monotone_arc(-center, -b.far, b.bulge));
}

void rays_around(const Arrangement& arrangement, std::span<const Touch> touches,
                 std::vector<Ray>& rays) {
  const Vec2 center = arrangement.points[touches[0].vertex];
  rays.clear();
  for (const Touch& touch : touches) {
    const std::uint32_t vertex = touch.vertex;
    rays.push_back(ray_from_end(arrangement, arrangement.previous(vertex)));
    rays.push_back(ray_from_start(arrangement, vertex));
  }
  const auto comes_before = [&](const Ray& a, const Ray& b) {
    const bool a_right = lexicographic_less(center, a.far);
    const bool b_right = lexicographic_less(center, b.far);
    if (a_right != b_right) return a_right;
    return turns_left(center, a, b);
  };
  // Of a few, as nearly always, one by one: std::stable_sort() would allocate.
  constexpr std::size_t few = 16;
  if (rays.size() > few) return std::stable_sort(rays.begin(), rays.end(), comes_before);
  for (auto ray = rays.begin(); ray != rays.end(); ++ray)
    std::rotate(std::upper_bound(rays.begin(), ray, *ray, comes_before), ray, ray + 1);
}

namespace {

/// The edges at one touching place, counter-clockwise, beginning downward.
class Star {
 public:
  /// Takes all vertices at the place.
  void assign(const Arrangement& arrangement, std::span<const Touch> touches) {
    rays_around(arrangement, touches, rays_);
    if (arrangement.dropped.empty()) return;
    std::erase_if(rays_, [&](const Ray& ray) { return arrangement.dropped[ray.edge]; });
  }

  /// Interior lies clockwise of an incoming ray, so the loop leaves by the ray before it.
  bool join(std::vector<std::uint32_t>& successor) const {
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (rays_[i].outgoing) continue;
      const Ray& leave = rays_[(i == 0 ? rays_.size() : i) - 1];
      if (!leave.outgoing) return false;
      successor[rays_[i].edge] = leave.edge;
    }
    return true;
  }

  /// A vertex at which a ring with a role passes from one side of another ring to the other side.
  std::optional<std::uint32_t> crossing_vertex(std::span<const Ring> rings,
                                               const Arrangement& arrangement,
                                               std::span<const Touch> touches) {
    const auto has_role = [&](const Touch& touch) {
      const RingRole role = rings[arrangement.ring_of(touch.vertex)].role;
      return role != RingRole::any && role != RingRole::winding;
    };
    if (std::none_of(touches.begin(), touches.end(), has_role)) return std::nullopt;
    // Of the rays between the two of a vertex, those of other rings are all less those of its own;
    // the ring crosses others where their number is odd.
    std::vector<std::uint32_t> own(rays_.size());  // rank among the rays of the same ring
    std::vector<std::uint32_t> ring;
    for (const Ray& ray : rays_) ring.push_back(arrangement.ring_of(ray.edge));
    std::vector<std::size_t> order(rays_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return ring[a] < ring[b]; });
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (ring[order[i]] == ring[order[i - 1]]) own[order[i]] = own[order[i - 1]] + 1;
    }
    // The number of foreign rays before a ray, even or odd; by edge, as an edge has one end here.
    std::vector<std::pair<std::uint32_t, bool>> foreign(rays_.size());
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      foreign[i] = {rays_[i].edge, ((i - own[i]) & 1) != 0};
    }
    std::sort(foreign.begin(), foreign.end());
    const auto parity_of = [&](std::uint32_t edge) {
      return std::lower_bound(foreign.begin(), foreign.end(), std::pair(edge, false))->second;
    };
    for (const Touch& touch : touches) {
      if (!has_role(touch)) continue;
      if (parity_of(arrangement.previous(touch.vertex)) != parity_of(touch.vertex)) {
        return touch.vertex;
      }
    }
    return std::nullopt;
  }

 private:
  std::vector<Ray> rays_;
};

/// The next edge of each in its loop, as long as no other ring touches.
std::vector<std::uint32_t> successors_in_rings(const Arrangement& arrangement) {
  std::vector<std::uint32_t> successor(arrangement.points.size());
  for (std::uint32_t e = 0; e < successor.size(); ++e) {
    const std::uint32_t next = arrangement.next[e];
    if (arrangement.interior_left[e]) successor[e] = next;
    if (!arrangement.interior_left[next]) successor[next] = e;
  }
  return successor;
}

/// The ray of an edge from its end, and from its beginning, when walked with the interior on the
/// left.
Ray ray_into(const Arrangement& arrangement, std::uint32_t edge) {
  return arrangement.interior_left[edge] ? ray_from_end(arrangement, edge)
                                         : ray_from_start(arrangement, edge);
}
Ray ray_out_of(const Arrangement& arrangement, std::uint32_t edge) {
  return arrangement.interior_left[edge] ? ray_from_start(arrangement, edge)
                                         : ray_from_end(arrangement, edge);
}

/// Whether a loop goes straight on from one edge to the next: built again, it has no vertex there
/// until others touch it.
bool goes_straight_on(const Arrangement& arrangement, std::uint32_t edge, std::uint32_t next,
                      std::uint32_t end) {
  if (!arrangement.bulges.empty() &&
      (arrangement.bulges[edge] != 0 || arrangement.bulges[next] != 0))
    return false;
  const Vec2 from = arrangement.original(tail(arrangement, edge)),
             here = arrangement.original(tail(arrangement, next)), to = arrangement.original(end);
  return orientation(from, here, to) == 0 && strictly_between(from, here, to);
}

/// Walks the loop of an edge and notes what it is.
SplicedLoop walk(const Arrangement& arrangement, SplicedLoops& result, std::uint32_t start) {
  const std::vector<Vec2>& points = arrangement.points;
  const auto index = static_cast<std::uint32_t>(result.loops.size());
  SplicedLoop loop{.first_edge = start, .size = 0, .leftmost = tail(arrangement, start)};
  std::uint32_t edge = start;
  std::uint32_t vertex = tail(arrangement, result.successor[edge]);
  do {
    result.loop_of[edge] = index;
    ++loop.size;
    const std::uint32_t edge_before = edge;
    edge = result.successor[edge];
    const std::uint32_t after = tail(arrangement, result.successor[edge]);
    const Vec2 here = points[vertex];
    if (vertex < loop.first_vertex && !goes_straight_on(arrangement, edge_before, edge, after)) {
      loop.first_vertex = vertex;
      loop.first_edge = edge;
    }
    if (!lexicographic_less(points[loop.leftmost], here)) {
      // At its leftmost vertex a hole has the interior on the left, and turns to the right.
      const bool turns_right =
          turns_left(here, ray_into(arrangement, edge_before), ray_out_of(arrangement, edge));
      if (here != points[loop.leftmost]) loop.hole = false;
      if (turns_right || here != points[loop.leftmost]) loop.leftmost = vertex;
      loop.hole = loop.hole || turns_right;
    }
    vertex = after;
  } while (edge != start);
  return loop;
}

}  // namespace

Result<SplicedLoops> splice(std::span<const Ring> rings, const Arrangement& arrangement) {
  SplicedLoops result;
  result.successor = successors_in_rings(arrangement);
  Star star;
  for (auto first = arrangement.touches.begin(); first != arrangement.touches.end();) {
    auto last = first;
    while (last != arrangement.touches.end() && last->place == first->place) ++last;
    const std::span<const Touch> touches = span_between(first, last);
    star.assign(arrangement, touches);
    if (!star.join(result.successor)) {
      // Edges that cross by little more than the tolerance can end in the wrong order.
      if (!arrangement.bulges.empty()) {
        const std::uint32_t vertex = touches[0].vertex;
        return error_at(ErrorCode::crossing, "edges cross next to this vertex",
                        arrangement.sources[vertex], arrangement.original(vertex));
      }
      return error_without_place(ErrorCode::internal, "the interior has no border");
    }
    if (const auto vertex = star.crossing_vertex(rings, arrangement, touches)) {
      // Where an edge was split, this names the vertex that split it.
      return error_at(ErrorCode::crossing, "two rings cross in this vertex",
                      arrangement.sources[*vertex], arrangement.original(*vertex));
    }
    first = last;
  }

  result.loop_of.assign(arrangement.points.size(), no_index);
  for (std::uint32_t e = 0; e < result.loop_of.size(); ++e) {
    if (result.loop_of[e] == no_index && !arrangement.is_dropped(e))
      result.loops.push_back(walk(arrangement, result, e));
  }
  return result;
}

}  // namespace medial
