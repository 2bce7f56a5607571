#include "methods/edit/rings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/predicates.h"
#include "methods/edit/segments.h"

namespace medial::edit {

Box box_of(const BulgeArc& edge) {
  Box box{edge.start, edge.start};
  box.add(edge.end);
  if (edge.bulge == 0) return box;
  for (const Vec2 direction : {Vec2{1, 0}, Vec2{0, 1}})
    if (const auto p = parallel_point(edge, direction)) box.add(*p);
  return box;
}

namespace {

/// Whether a ring that does not cross itself runs counter-clockwise.
bool turns_left(const std::vector<Corner>& corners) {
  const auto is_arc = [](const Corner& corner) { return corner.bulge != 0; };
  if (std::none_of(corners.begin(), corners.end(), is_arc)) {
    std::vector<Vec2> ring;
    for (const Corner& corner : corners) ring.push_back(corner.point);
    return is_counter_clockwise(ring);
  }
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner &from = corners[i], &to = corners[i + 1 < corners.size() ? i + 1 : 0];
    area += cross(from.point - corners[0].point, to.point - corners[0].point);
    if (from.bulge != 0) area += 2 * area_beside_chord({from.point, to.point, from.bulge});
  }
  return area > 0;
}

}  // namespace

Rings::Rings(const Shape& shape, const LocalFrame& frame, const Joining& joining)
    : frame_(frame), joining_(joining), vertices_(shape.points.size()) {
  for (std::uint32_t l = 0; l < shape.loop_count(); ++l) {
    const std::uint32_t begin = shape.loop_begin[l], end = shape.loop_begin[l + 1];
    loops_.push_back({begin, end - begin, shape.component[l], shape.hole[l]});
    for (std::uint32_t i = begin; i < end; ++i) {
      vertices_[i].point = shape.points[i];
      vertices_[i].next = i + 1 < end ? i + 1 : begin;
      vertices_[i].before = i > begin ? i - 1 : end - 1;
      vertices_[i].loop = l;
      set_bulge(i, shape.bulge(i));
    }
  }
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    vertices_[v].joint = joint_at(v);
    set_box(v);
  }
}

bool Rings::adopt(const Shape& shape, const LocalFrame& frame, const Joining& joining) {
  std::vector<Vertex> vertices = vertices_;
  std::vector<Loop> loops;
  std::size_t left = 0;
  for (const Loop& loop : loops_) left += loop.size;
  for (std::uint32_t l = 0; l < shape.loop_count(); ++l) {
    const std::uint32_t begin = shape.loop_begin[l], end = shape.loop_begin[l + 1];
    const std::uint32_t first = shape.sources[begin].vertex,
                        second = shape.sources[begin + 1].vertex;
    if (vertices_[first].flat) return false;
    const bool forward =
        corner_after(first) == second &&
        (corner_before(first) != second || vertices_[first].bulge == shape.bulge(begin));
    std::uint32_t point = begin, size = 0, v = first;
    do {
      const Vertex& old = vertices_[v];
      Vertex& now = vertices[v];
      now.next = forward ? old.next : old.before;
      now.before = forward ? old.before : old.next;
      now.bulge = forward ? old.bulge : -vertices_[old.before].bulge;
      now.loop = l;
      if (!old.flat) {
        if (point == end || shape.sources[point].vertex != v || shape.points[point] != old.point ||
            shape.bulge(point) != now.bulge)
          return false;
        ++point;
      }
      ++size;
      v = now.next;
    } while (v != first);
    if (point != end || size > left) return false;
    left -= size;
    loops.push_back({first, size, shape.component[l], shape.hole[l]});
  }
  if (left > 0) return false;
  vertices_ = std::move(vertices);
  loops_ = std::move(loops);
  frame_ = frame;
  joining_ = joining;
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    if (!has(v)) continue;
    vertices_[v].joint = joint_at(v);
    set_box(v);
  }
  return true;
}

site::Site Rings::site_near(std::uint32_t site, Vec2 local) const {
  const site::Pieces all = pieces(site);
  const bool is_last = all.count > 1 && site::squared_distance(all.last(), local) <
                                            site::squared_distance(all.first(), local);
  return is_last ? all.last() : all.first();
}

void Rings::add_pieces(std::uint32_t site, std::vector<site::Site>& pieces) const {
  const site::Pieces all = this->pieces(site);
  pieces.insert(pieces.end(), all.site.begin(),
                all.site.begin() + static_cast<std::ptrdiff_t>(all.count));
}

void Rings::set_bulge(std::uint32_t v, double bulge) {
  arcs_ += (bulge != 0 ? 1U : 0U) - (vertices_[v].bulge != 0 ? 1U : 0U);
  vertices_[v].bulge = bulge;
}

bool Rings::is_flat(std::uint32_t v) const {
  if (vertices_[v].touches) return false;
  if (vertices_[v].bulge != 0 || vertices_[vertices_[v].before].bulge != 0) return false;
  const Vec2 before = vertices_[vertices_[v].before].point, here = vertices_[v].point,
             after = vertices_[vertices_[v].next].point;
  return orientation(before, here, after) == 0 && strictly_between(before, here, after);
}

void Rings::find_touches(bool any) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    if (!has(v)) continue;
    if (any)
      order.push_back(v);
    else
      set_touches(v, false);
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return lexicographic_less(vertices_[a].point, vertices_[b].point);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vec2 here = vertices_[order[i]].point;
    set_touches(order[i], (i > 0 && vertices_[order[i - 1]].point == here) ||
                              (i + 1 < order.size() && vertices_[order[i + 1]].point == here));
  }
}

void Rings::set_touches(std::uint32_t v, bool touches) {
  if (std::exchange(vertices_[v].touches, touches) != touches) vertices_[v].flat = is_flat(v);
}

site::Joint Rings::joint_at(std::uint32_t v) const {
  // From corner to corner, as in the shape: the lengths of the edges decide how smooth a joint is.
  const std::uint32_t from = corner_before(v), to = corner_after(v);
  const BulgeArc before{vertices_[from].point, vertices_[v].point, vertices_[from].bulge},
      after{vertices_[v].point, vertices_[to].point, vertices_[v].bulge};
  if (before.bulge == 0 && after.bulge == 0)
    return orientation(before.start, after.start, after.end) > 0 ? site::Joint::corner
                                                                 : site::Joint::reflex;
  return site::joint_of(before, after, joining_.tolerance,
                        joining_.corner_angle * std::numbers::pi / 180);
}

void Rings::judge(std::span<const std::uint32_t> vertices) {
  for (const std::uint32_t v : vertices) vertices_[v].flat = is_flat(v);
  for (const std::uint32_t v : vertices) vertices_[v].joint = joint_at(v);
}

void Rings::set_box(std::uint32_t v) { boxes_.set(v, box_of(edge(v))); }

bool Rings::has_arcs_after(const Edit& edit) const {
  const auto count = [](const std::vector<Corner>& corners) {
    return std::count_if(corners.begin(), corners.end(),
                         [](const Corner& corner) { return corner.bulge != 0; });
  };
  auto arcs = static_cast<std::ptrdiff_t>(arcs_) + count(edit.in) - count(edit.out);
  for (const std::uint32_t gone : {edit.before, edit.old})
    if (gone != none && vertices_[gone].bulge != 0) --arcs;
  for (const double bulge : edit.bulge)
    if (bulge != 0) ++arcs;
  return arcs > 0;
}

std::uint32_t Rings::hole_in(std::uint32_t loop) const {
  if (loops_[loop].hole) return none;
  for (const Loop& other : loops_)
    if (other.size > 0 && other.hole && other.component == loops_[loop].component)
      return other.first;
  return none;
}

void Rings::add_reach(const Edit& edit, Box& box) const {
  for (std::size_t i = 0; i < edit.in.size(); ++i) {
    const Corner &from = edit.in[i], &to = edit.in[i + 1 < edit.in.size() ? i + 1 : 0];
    box.add(box_of(BulgeArc{from.point, to.point, from.bulge}));
  }
  if (edit.is_of_loops()) return;
  const Vec2 start = vertices_[edit.before].point, end = vertices_[edit.after].point;
  const Vec2 middle = edit.fresh != none ? edit.place : end;
  box.add(box_of(BulgeArc{start, middle, edit.bulge[0]}));
  if (edit.fresh != none) box.add(box_of(BulgeArc{middle, end, edit.bulge[1]}));
}

Rings::Extent Rings::extent_of(std::uint32_t site) const {
  const std::uint32_t v = site / 2;
  return {site, is_edge(site) ? corner_after(v) : v, is_edge(site) ? vertices_[v].bulge : 0};
}

std::vector<Rings::Extent> Rings::sites_around(const Edit& edit) const {
  std::vector<Extent> sites;
  const auto add = [&](std::uint32_t site) { sites.push_back(extent_of(site)); };
  if (edit.is_of_loops()) {
    for (const auto* corners : {&edit.out, &edit.in})
      if (!corners->empty() && has(corners->front().number))
        for_sites_of(vertices_[corners->front().number].loop, add);
    return sites;
  }
  std::uint32_t v = vertices_[edit.before].before;
  const std::size_t count =
      (edit.old != none && has(edit.old)) || (edit.fresh != none && has(edit.fresh)) ? 4 : 3;
  for (std::size_t i = 0; i < count; ++i, v = vertices_[v].next) {
    const std::uint32_t corner = corner_to(v);
    if (sites.empty() || sites.back().site != 2 * corner + 1) add(2 * corner + 1);
    if (!vertices_[v].flat && is_reflex(v)) add(2 * v);
  }
  for (const std::uint32_t corner : {corner_before(edit.before), corner_after(edit.after)})
    if (is_reflex(corner)) add(2 * corner);
  return sites;
}

std::vector<Rings::Extent> Rings::sites_at(const std::vector<Vec2>& places) const {
  std::vector<std::uint32_t> numbers;
  for (const Vec2 p : places)
    boxes_.find({p, p}, [&](std::uint32_t s) {
      const Vec2 a = vertices_[s].point, b = vertices_[vertices_[s].next].point;
      if (orientation(a, b, p) != 0) return;
      numbers.push_back(2 * corner_to(s) + 1);
      if (a == p && !vertices_[s].flat && is_reflex(s)) numbers.push_back(2 * s);
    });
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<Extent> sites;
  for (const std::uint32_t site : numbers) sites.push_back(extent_of(site));
  return sites;
}

std::uint32_t Rings::opening_to(std::uint32_t v, Vec2 p) const {
  std::uint32_t others = 0, open = none;
  const Vec2 here = vertices_[v].point;
  boxes_.find({here, here}, [&](std::uint32_t u) {
    if (!(vertices_[u].point == here)) return;
    ++others;
    const std::uint32_t before = vertices_[u].before, next = vertices_[u].next;
    if (vertices_[u].bulge == 0 && vertices_[before].bulge == 0) {
      if (is_in_wedge(here, vertices_[next].point, vertices_[before].point, p)) open = u;
      return;
    }
    const Vec2 from = start_tangent(edge(u)), to = -end_tangent(edge(before));
    const auto angle_to = [&](Vec2 way) {
      const double angle = signed_angle(from, way);
      return angle > 0 ? angle : angle + 2 * std::numbers::pi;
    };
    if (angle_to(p - here) < angle_to(to)) open = u;
  });
  return others > 1 ? open : v;
}

double Rings::squared_distance(std::uint32_t v, Vec2 place) const {
  const Vec2 p = frame_.to_local(place);
  const BulgeArc arc = local_edge(v);
  const site::Pieces pieces = site::pieces_of(arc.start, arc.end, arc.bulge);
  const double first = site::squared_distance(pieces.first(), p);
  const double least =
      pieces.count == 1 ? first : std::min(first, site::squared_distance(pieces.last(), p));
  return frame_.inverse * frame_.inverse * least;
}

std::uint32_t Rings::component_around(Vec2 place) const {
  std::vector<std::uint32_t> crossed;  // the components whose edges the ray to the right crosses
  boxes_.find({place, {box().high.x, place.y}}, [&](std::uint32_t v) {
    if (crosses_ray(vertices_[v].point, vertices_[vertices_[v].next].point, place))
      crossed.push_back(loops_[vertices_[v].loop].component);
  });
  std::sort(crossed.begin(), crossed.end());
  for (auto from = crossed.begin(), to = from; from != crossed.end(); from = to) {
    to = std::upper_bound(from, crossed.end(), *from);
    if ((to - from) % 2 != 0) return *from;
  }
  return none;
}

Rings::Around Rings::around(Vec2 place) const {
  const std::uint32_t v =
      boxes_.nearest(place, [&](std::uint32_t edge) { return squared_distance(edge, place); });
  if (v == none) return {};
  Around found = beside(v, place);
  if (has_arcs()) return found;
  // The place is inside if it is on the left of the nearest edge. If several edges are equally near
  // up to rounding, the order does not matter as long as they agree.
  constexpr double endless = std::numeric_limits<double>::infinity();
  const auto distance_if = [&](bool is_asked, std::uint32_t edge) {
    return is_asked ? squared_distance(edge, place) : endless;
  };
  const double reach = found.away + joining_.tolerance;
  const std::uint32_t contrary = boxes_.nearest(
      place,
      [&](std::uint32_t edge) {
        return distance_if(is_on_left(edge, place) != (found.site != none), edge);
      },
      reach * reach);
  if (contrary == none) return found;
  found.site = none;
  const std::uint32_t own = component_around(place);
  if (own == none) return found;
  const std::uint32_t facing = boxes_.nearest(place, [&](std::uint32_t edge) {
    const bool is_own = loops_[vertices_[edge].loop].component == own;
    return distance_if(is_own && is_on_left(edge, place), edge);
  });
  if (facing == none) return found;  // the loops do not have the directions of a shape's
  found.site = beside(facing, place).site;
  if (found.site == none) found.site = 2 * corner_to(facing) + 1;
  return found;
}

Rings::Around Rings::beside(std::uint32_t v, Vec2 place) const {
  const Vec2 p = frame_.to_local(place);
  const BulgeArc arc = local_edge(v);
  const site::Pieces pieces = site::pieces_of(arc.start, arc.end, arc.bulge);
  const bool is_last = pieces.count > 1 && site::squared_distance(pieces.last(), p) <
                                               site::squared_distance(pieces.first(), p);
  const site::Site& piece = is_last ? pieces.last() : pieces.first();
  const double away = frame_.inverse * std::sqrt(site::squared_distance(piece, p));
  const double s = site::foot_parameter(piece, p);
  for (const bool at_end : {false, true}) {
    if (s != (at_end ? piece.length : 0) || (pieces.count > 1 && is_last != at_end)) continue;
    const std::uint32_t end = opening_to(at_end ? vertices_[v].next : v, place);
    if (end == none) return {none, away};
    if (vertices_[end].flat || vertices_[end].joint == site::Joint::smooth) break;
    return {is_reflex(end) ? 2 * end : none, away};
  }
  return {site::carrier_distance(piece, p) > 0 ? 2 * corner_to(v) + 1 : none, away};
}

std::uint32_t Rings::arc_of(const Disk& circle) const {
  constexpr double near = 1 << 12;  // tolerances: the rounding error of the circle's arcs
  const double slack = near * joining_.tolerance;
  // Short segments may join the arcs, so a search at one point of the circle could miss them.
  const Vec2 center = frame_.to_input(circle.center);
  const double reach = frame_.inverse * circle.radius + slack;
  std::uint32_t arc = none;
  double least = std::numeric_limits<double>::infinity();  // deviation of a circle so far
  boxes_.find({center - Vec2{reach, reach}, center + Vec2{reach, reach}}, [&](std::uint32_t v) {
    const BulgeArc edge = local_edge(v);
    const site::Site piece = site::pieces_of(edge.start, edge.end, edge.bulge).first();
    if (!(piece.curvature > 0)) return;
    const double radius = 1 / piece.curvature;
    const double off = std::abs(radius - circle.radius) +
                       distance(piece.point + radius * piece.normal(), circle.center);
    if (off >= least) return;
    arc = 2 * v + 1;
    least = off;
  });
  return arc;
}

void Rings::take_out(std::uint32_t loop) {
  for_vertices(loop, [&](std::uint32_t v) {
    set_bulge(v, 0);
    vertices_[v] = {};
    boxes_.set(v, Box::nothing());
  });
  loops_[loop] = {};
}

Seat Rings::seat_of(std::uint32_t loop) const {
  const Loop& own = loops_[loop];
  return {loop, own.first, own.component, own.hole};
}

Seat Rings::seat_beside(std::uint32_t vertex) const {
  Seat seat;
  for (const Loop& other : loops_)
    if (other.size > 0) seat.component = std::max(seat.component, other.component + 1);
  const auto empty =
      std::find_if(loops_.begin(), loops_.end(), [](const Loop& one) { return one.size == 0; });
  seat.loop = static_cast<std::uint32_t>(empty - loops_.begin());
  if (vertex == none) return seat;
  seat.hole = true;
  seat.component = loops_[vertices_[vertex].loop].component;
  return seat;
}

Seat Rings::find_seat(Vec2 place) const {
  const std::uint32_t site = around(place).site;
  return seat_beside(site == none ? none : site / 2);
}

void Rings::put_in(const Edit& edit, bool is_followed) {
  const std::vector<Corner>& corners = edit.in;
  std::uint32_t room = 0;
  for (const Corner& corner : corners) room = std::max(room, corner.number + 1);
  while (vertices_.size() < room) {  // first, as memory may run out
    boxes_.set(static_cast<std::uint32_t>(vertices_.size()), Box::nothing());
    vertices_.emplace_back();
  }
  const Seat seat = edit.seat     ? *edit.seat
                    : is_followed ? find_seat(corners[0].point)
                                  : find_seat_anew(corners);
  if (seat.loop == loops_.size()) loops_.emplace_back();
  const std::size_t size = corners.size();
  loops_[seat.loop] = {seat.first != none ? seat.first : corners[0].number,
                       static_cast<std::uint32_t>(size), seat.component, seat.hole};
  const bool turns = !seat.is_old && turns_left(corners) == seat.hole;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t v = corners[i].number;
    const Corner &after = corners[i + 1 < size ? i + 1 : 0],
                 &before = corners[(i > 0 ? i : size) - 1];
    vertices_[v].point = corners[i].point;
    vertices_[v].next = (turns ? before : after).number;
    vertices_[v].before = (turns ? after : before).number;
    vertices_[v].loop = seat.loop;
    set_bulge(v, turns ? -before.bulge : corners[i].bulge);
  }
  std::vector<std::uint32_t> numbers;
  for (const Corner& corner : corners) numbers.push_back(corner.number);
  judge(numbers);
  for (const std::uint32_t v : numbers) set_box(v);
}

void Rings::apply(const Edit& edit, bool is_followed) {
  if (edit.is_of_loops()) {
    if (!edit.out.empty()) take_out(vertices_[edit.out.front().number].loop);
    if (!edit.in.empty()) put_in(edit, is_followed);
    return;
  }
  if (edit.fresh == vertices_.size()) {  // first, as memory may run out
    boxes_.set(edit.fresh, Box::nothing());
    vertices_.emplace_back();
  }
  const std::uint32_t loop = vertices_[edit.before].loop;
  if (edit.old != none && edit.old != edit.fresh) {
    set_bulge(edit.old, 0);
    vertices_[edit.old] = {};
    boxes_.set(edit.old, Box::nothing());
    --loops_[loop].size;
  }
  if (edit.fresh != none) {
    if (edit.fresh != edit.old) ++loops_[loop].size;
    Vertex& fresh = vertices_[edit.fresh];
    fresh.point = edit.place;
    fresh.next = edit.after;
    fresh.before = edit.before;
    fresh.loop = loop;
    set_bulge(edit.fresh, edit.bulge[1]);
  }
  set_bulge(edit.before, edit.bulge[0]);
  vertices_[edit.before].next = edit.fresh != none ? edit.fresh : edit.after;
  vertices_[edit.after].before = edit.fresh != none ? edit.fresh : edit.before;
  loops_[loop].first = edit.seat ? edit.seat->first : edit.before;
  std::vector<std::uint32_t> judged;
  for (const std::uint32_t v : {edit.before, edit.fresh, edit.after})
    if (v != none) judged.push_back(v);
  judge(judged);
  // The lengths of the edges beyond `before` and `after` depend on whether these are flat.
  for (const std::uint32_t v : {corner_before(edit.before), corner_after(edit.after)})
    vertices_[v].joint = joint_at(v);
  for (const std::uint32_t v : judged) set_box(v);
}

Edit Rings::inverse(const Edit& edit) const {
  Edit back;
  if (edit.is_of_loops()) {
    back.out = edit.in;
    if (edit.out.empty()) return back;
    back.seat = seat_of(vertices_[edit.out.front().number].loop);
    back.seat->is_old = true;
    for_vertices(back.seat->loop, [&](std::uint32_t v) {
      back.in.push_back({v, vertices_[v].point, vertices_[v].bulge});
    });
    return back;
  }
  back.seat = seat_of(vertices_[edit.before].loop);
  back.before = edit.before;
  back.after = edit.after;
  back.old = edit.fresh;
  back.fresh = edit.old;
  back.bulge[0] = vertices_[edit.before].bulge;
  back.bulge_before = edit.bulge[0];
  if (edit.old == none) return back;
  back.place = vertices_[edit.old].point;
  back.bulge[1] = vertices_[edit.old].bulge;
  return back;
}

std::vector<std::uint32_t> Rings::loops() const {
  std::vector<std::uint32_t> all;
  for (std::uint32_t l = 0; l < loops_.size(); ++l)
    if (loops_[l].size > 0) all.push_back(l);
  const auto comes_first = [&](std::uint32_t a, std::uint32_t b) {
    const Loop &x = loops_[a], &y = loops_[b];
    return x.component != y.component ? x.component < y.component : !x.hole && y.hole;
  };
  if (!std::is_sorted(all.begin(), all.end(), comes_first))
    std::stable_sort(all.begin(), all.end(), comes_first);
  return all;
}

std::vector<std::uint32_t> Rings::component_numbers() const {
  std::vector<std::uint32_t> numbers;
  std::uint32_t count = 0;
  for (const std::uint32_t l : loops()) {
    const std::uint32_t component = loops_[l].component;
    if (component >= numbers.size()) numbers.resize(component + 1, none);
    if (numbers[component] == none) numbers[component] = count++;
  }
  return numbers;
}

void Rings::append(std::uint32_t loop, std::uint32_t ring, std::uint32_t component,
                   Shape& shape) const {
  if (shape.loop_begin.empty()) shape.loop_begin.push_back(0);
  std::uint32_t v = first_of(loop);
  do {
    shape.points.push_back(vertices_[v].point);
    shape.sources.push_back({ring, v});
    if (has_arcs()) shape.bulges.push_back(vertices_[v].bulge);
    v = corner_after(v);
  } while (v != first_of(loop));
  shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
  shape.component.push_back(component);
  shape.hole.push_back(loops_[loop].hole);
}

Shape Rings::shape() const {
  Shape shape;
  const std::vector<std::uint32_t> components = component_numbers();
  for (const std::uint32_t l : loops()) append(l, l, components[loops_[l].component], shape);
  return shape;
}

Shape Rings::shape_of(std::vector<std::uint32_t> loops) const {
  Shape shape;
  std::stable_partition(loops.begin(), loops.end(), [&](std::uint32_t l) { return !is_hole(l); });
  for (const std::uint32_t l : loops) append(l, l, 0, shape);
  return shape;
}

std::vector<Ring> Rings::rings(std::vector<std::vector<std::uint32_t>>& numbers) const {
  std::vector<Ring> rings;
  for (const std::uint32_t l : loops()) {
    Ring& ring = rings.emplace_back();
    ring.role = loops_[l].hole ? RingRole::hole : RingRole::outer;
    std::vector<std::uint32_t>& own = numbers.emplace_back();
    for_vertices(l, [&](std::uint32_t v) {
      ring.points.push_back(vertices_[v].point);
      if (has_arcs()) ring.bulges.push_back(vertices_[v].bulge);
      own.push_back(v);
    });
  }
  return rings;
}

}  // namespace medial::edit
