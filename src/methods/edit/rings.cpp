#include "methods/edit/rings.h"

#include <algorithm>
#include <array>

#include "base/predicates.h"

namespace medial::edit {
namespace {

Box box_of(Vec2 a, Vec2 b) {
  Box box{a, a};
  box.add(b);
  return box;
}

bool holds(const Box& box, Vec2 p) {
  return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y;
}

struct Triangle {
  std::array<Vec2, 3> corner;

  /// Whether a point lies inside or on the border; a little too often where the corners lie on one
  /// line.
  bool has(Vec2 p) const {
    Box box = box_of(corner[0], corner[1]);
    box.add(corner[2]);
    if (!holds(box, p)) return false;
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int side = orientation(corner[i], corner[(i + 1) % 3], p);
      left += side > 0 ? 1 : 0;
      right += side < 0 ? 1 : 0;
    }
    return left == 0 || right == 0;
  }
};

/// Where two segments cross.
Vec2 crossing_of(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double share = cross(c - a, d - c) / cross(b - a, d - c);
  return a + std::clamp(share, 0.0, 1.0) * (b - a);
}

enum class Meeting : std::uint8_t { none, touch, cross };

/// How two closed segments meet.
Meeting meeting(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const int of_a = orientation(c, d, a), of_b = orientation(c, d, b);
  if (of_a * of_b > 0) return Meeting::none;
  const int of_c = orientation(a, b, c), of_d = orientation(a, b, d);
  if (of_c * of_d > 0) return Meeting::none;
  if (of_a * of_b < 0 && of_c * of_d < 0) return Meeting::cross;
  const Box first = box_of(a, b), second = box_of(c, d);
  const bool apart = first.low.x > second.high.x || second.low.x > first.high.x ||
                     first.low.y > second.high.y || second.low.y > first.high.y;
  return apart ? Meeting::none : Meeting::touch;
}

}  // namespace

Rings::Rings(const Shape& shape, const LocalFrame& frame)
    : frame_(frame), vertices_(shape.points.size()) {
  for (std::uint32_t l = 0; l < shape.loop_count(); ++l) {
    const std::uint32_t begin = shape.loop_begin[l], end = shape.loop_begin[l + 1];
    loops_.push_back({begin, end - begin, shape.component[l], shape.hole[l]});
    for (std::uint32_t i = begin; i < end; ++i)
      vertices_[i] = {shape.points[i], i + 1 < end ? i + 1 : begin, i > begin ? i - 1 : end - 1, l};
  }
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    vertices_[v].reflex = is_reflex(v);
    set_box(v);
  }
}

bool Rings::adopt(const Shape& shape, const LocalFrame& frame) {
  std::vector<Vertex> vertices = vertices_;
  std::vector<Loop> loops;
  std::size_t left = 0;
  for (const Loop& loop : loops_) left += loop.size;
  for (std::uint32_t l = 0; l < shape.loop_count(); ++l) {
    const std::uint32_t begin = shape.loop_begin[l], end = shape.loop_begin[l + 1];
    const std::uint32_t first = shape.sources[begin].vertex;
    if (vertices_[first].flat) return false;
    const bool forward = corner_after(first) == shape.sources[begin + 1].vertex;
    std::uint32_t point = begin, size = 0, v = first;
    do {
      const Vertex& old = vertices_[v];
      if (!old.flat && (point == end || shape.sources[point++].vertex != v)) return false;
      vertices[v].next = forward ? old.next : old.before;
      vertices[v].before = forward ? old.before : old.next;
      vertices[v].loop = l;
      ++size;
      v = vertices[v].next;
    } while (v != first);
    if (point != end || size > left) return false;
    left -= size;
    loops.push_back({first, size, shape.component[l], shape.hole[l]});
  }
  if (left > 0) return false;
  vertices_ = std::move(vertices);
  loops_ = std::move(loops);
  frame_ = frame;
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    if (!has(v)) continue;
    vertices_[v].reflex = is_reflex(v);
    set_box(v);
  }
  return true;
}

bool Rings::is_flat(std::uint32_t v) const {
  const Vec2 before = vertices_[vertices_[v].before].point, here = vertices_[v].point,
             after = vertices_[vertices_[v].next].point;
  return orientation(before, here, after) == 0 && strictly_between(before, here, after);
}

bool Rings::is_reflex(std::uint32_t v) const {
  const Vertex& vertex = vertices_[v];
  return orientation(vertices_[vertex.before].point, vertex.point, vertices_[vertex.next].point) <=
         0;
}

void Rings::set_box(std::uint32_t v) {
  boxes_.set(v, box_of(vertices_[v].point, vertices_[vertices_[v].next].point));
}

Rings::Judgement Rings::judge(const Edit& edit) const {
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

  // What the edges sweep while the vertex moves straight to its place, from or to an edge's inside.
  std::vector<Triangle> swept;
  if (has_old && has_fresh) {
    swept = {{{p, v, x}}, {{v, n, x}}};
    if (swept[0].has(n) || swept[1].has(p)) return unclear;
  } else {
    swept = {{{p, has_old ? v : x, n}}};
  }
  struct NewEdge {
    Vec2 from, to;
    std::uint32_t start, end;
  };
  std::vector<NewEdge> edges;
  if (has_fresh)
    edges = {{p, x, edit.before, none}, {x, n, none, edit.after}};
  else
    edges = {{p, n, edit.before, edit.after}};

  Box query = box_of(p, n);
  if (has_old) query.add(v);
  if (has_fresh) query.add(x);
  Judgement result;
  boxes_.find(query, [&](std::uint32_t s) {
    if (result.verdict == Verdict::crosses) return;
    const std::uint32_t t = vertices_[s].next;
    const Vec2 a = vertices_[s].point, b = vertices_[t].point;
    const bool is_own = s == edit.before || (has_old && s == edit.old);
    if (is_own) return;
    for (const NewEdge& edge : edges) {
      if (s == edge.end || t == edge.start) continue;  // they meet there only
      const Meeting how = meeting(edge.from, edge.to, a, b);
      if (how == Meeting::cross)
        result = {Verdict::crosses, s, crossing_of(edge.from, edge.to, a, b)};
      if (how == Meeting::touch) result.verdict = Verdict::unclear;
    }
    if (result.verdict == Verdict::crosses) return;
    const bool is_moving = has_old && has_fresh;
    if (is_moving && meeting(v, x, a, b) != Meeting::none) result.verdict = Verdict::unclear;
    if (s == edit.after) return;
    for (const Triangle& triangle : swept)
      if (triangle.has(a)) result.verdict = Verdict::unclear;
  });
  return result;
}

std::vector<Rings::Extent> Rings::sites_around(const Edit& edit) const {
  std::vector<Extent> sites;
  std::uint32_t v = vertices_[edit.before].before;
  const std::size_t count =
      (edit.old != none && has(edit.old)) || (edit.fresh != none && has(edit.fresh)) ? 4 : 3;
  for (std::size_t i = 0; i < count; ++i, v = vertices_[v].next) {
    const std::uint32_t corner = corner_to(v);
    if (sites.empty() || sites.back().site != 2 * corner + 1)
      sites.push_back({2 * corner + 1, corner_after(corner)});
    if (!vertices_[v].flat && vertices_[v].reflex) sites.push_back({2 * v, v});
  }
  return sites;
}

void Rings::apply(const Edit& edit) {
  if (edit.fresh == vertices_.size()) {  // first, as memory may run out
    boxes_.set(edit.fresh, Box::nothing());
    vertices_.emplace_back();
  }
  const std::uint32_t loop = vertices_[edit.before].loop;
  if (edit.old != none && edit.old != edit.fresh) {
    vertices_[edit.old] = {};
    boxes_.set(edit.old, Box::nothing());
    --loops_[loop].size;
  }
  if (edit.fresh != none) {
    if (edit.fresh != edit.old) ++loops_[loop].size;
    vertices_[edit.fresh] = {edit.place, edit.after, edit.before, loop};
  }
  vertices_[edit.before].next = edit.fresh != none ? edit.fresh : edit.after;
  vertices_[edit.after].before = edit.fresh != none ? edit.fresh : edit.before;
  loops_[loop].first = edit.before;
  for (const std::uint32_t v : {edit.before, edit.fresh, edit.after}) {
    if (v == none) continue;
    vertices_[v].flat = is_flat(v);
    vertices_[v].reflex = is_reflex(v);
    set_box(v);
  }
}

Edit Rings::inverse(const Edit& edit) const {
  return {edit.before, edit.after, edit.fresh, edit.old,
          edit.old != none ? vertices_[edit.old].point : Vec2{}};
}

Shape Rings::shape() const {
  Shape shape;
  shape.loop_begin.push_back(0);
  for (std::uint32_t l = 0; l < loops_.size(); ++l) {
    std::uint32_t v = first_of(l);
    do {
      shape.points.push_back(vertices_[v].point);
      shape.sources.push_back({l, v});
      v = corner_after(v);
    } while (v != first_of(l));
    shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
    shape.component.push_back(loops_[l].component);
    shape.hole.push_back(loops_[l].hole);
  }
  return shape;
}

std::vector<Ring> Rings::rings(std::vector<std::vector<std::uint32_t>>& numbers) const {
  std::vector<Ring> rings;
  for (const Loop& loop : loops_) {
    Ring& ring = rings.emplace_back();
    ring.role = loop.hole ? RingRole::hole : RingRole::outer;
    std::vector<std::uint32_t>& own = numbers.emplace_back();
    std::uint32_t v = loop.first;
    do {
      ring.points.push_back(vertices_[v].point);
      own.push_back(v);
      v = vertices_[v].next;
    } while (v != loop.first);
  }
  return rings;
}

}  // namespace medial::edit
