#include "methods/edit/weaver.h"

#include <algorithm>

#include "methods/edit/segments.h"

namespace medial::edit {

Weaver::Vertex& Weaver::vertex(std::uint32_t v) {
  old_vertices_.emplace_back(v, loops_.vertices_[v]);
  return loops_.vertices_[v];
}

Weaver::Loop& Weaver::loop(std::uint32_t l) {
  old_loops_.emplace_back(l, loops_.loops_[l]);
  return loops_.loops_[l];
}

std::uint32_t Weaver::new_vertex() {
  const std::uint32_t v = loops_.unused();
  loops_.boxes_.set(v, Box::nothing());
  loops_.vertices_.emplace_back();
  return v;
}

void Weaver::link(std::uint32_t before, std::uint32_t after) {
  vertex(before).next = after;
  vertex(after).before = before;
}

void Weaver::insert_after(std::uint32_t before, std::uint32_t v, Vec2 place) {
  const std::uint32_t after = loops_[before].next, own = loops_[before].loop;
  Vertex& fresh = vertex(v);
  fresh.point = place;
  fresh.loop = own;
  link(before, v);
  link(v, after);
  ++loop(own).size;
  loops_.set_box(before);
  loops_.set_box(v);
}

void Weaver::drop(std::uint32_t v) {
  const std::uint32_t before = loops_[v].before, own = loops_[v].loop;
  link(before, loops_[v].next);
  vertex(v) = {};
  loops_.boxes_.set(v, Box::nothing());
  loops_.set_box(before);
  Loop& changed = loop(own);
  --changed.size;
  if (changed.first == v) changed.first = before;
}

bool Weaver::make(const Contacts& contacts) {
  const Detour& way = contacts.detour;
  places_ = contacts.places;
  if (contacts.is_ring) return contacts.ring.empty() ? take_out(contacts) : put_in(contacts);
  if (!way.old && !way.fresh) return true;

  for (std::size_t i = 1; i < contacts.chain.size(); ++i) {
    const std::uint32_t before = contacts.chain[i - 1], after = contacts.chain[i];
    if (loops_[before].next != after && !exchange(before, loops_[after].before, false))
      return false;
  }
  part(contacts);
  set_middle(contacts);
  std::vector<std::uint32_t> joined;
  std::uint32_t last = contacts.chain[0];
  for (std::size_t i = 0; i < contacts.touched.size(); ++i) {
    if (i == contacts.touched_on_first && way.fresh) last = fresh_;
    const std::uint32_t v = new_vertex();
    insert_after(last, v, contacts.touched[i]);
    joined.push_back(last = v);
  }
  if (way.fresh) joined.push_back(fresh_);
  for (const std::uint32_t v : joined)
    if (!join_at(v)) return false;
  judge_places();
  return true;
}

/// Separates the old edges from all that they touch.
void Weaver::part(const Contacts& contacts) {
  for (std::size_t i = 1; i < contacts.chain.size(); ++i) {
    const std::uint32_t own = contacts.chain[i];
    const Vec2 place = loops_[own].point;
    if (i == contacts.middle && contacts.detour.fresh)
      fresh_ = moved_ = own;
    else
      drop(own);
    make_whole(place, own);
  }
}

/// Joins the two halves of an edge that was divided only for other edges, which no longer touch it.
void Weaver::make_whole(Vec2 place, std::uint32_t own) {
  std::vector<std::uint32_t> others = vertices_at(loops_, place);
  others.erase(std::remove(others.begin(), others.end(), own), others.end());
  if (others.size() == 1 && vertices_at(drawn_, place).empty()) drop(others[0]);
}

/// Inserts a vertex into the edge inside which a point lies, if any.
void Weaver::divide_at(Vec2 place) {
  std::uint32_t divided = none;
  loops_.for_edges_in({place, place}, [&](std::uint32_t s) {
    if (lies_inside(place, loops_[s].point, loops_[loops_[s].next].point)) divided = s;
  });
  if (divided != none) insert_after(divided, new_vertex(), place);
}

/// Separates a ring from all that it touches, and removes it.
bool Weaver::take_out(const Contacts& contacts) {
  const std::vector<std::uint32_t>& chain = contacts.chain;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const std::uint32_t before = chain[(i > 0 ? i : chain.size()) - 1], after = chain[i];
    if (loops_[before].next != after && !exchange(before, loops_[after].before, false))
      return false;
  }
  const std::uint32_t own = loops_[chain[0]].loop;
  if (loops_.loop_size(own) != chain.size()) return false;
  parts_ += loops_.is_hole(own) ? 1 : -1;
  loop(own) = {};
  for (const std::uint32_t v : chain) {
    vertex(v) = {};
    loops_.boxes_.set(v, Box::nothing());
  }
  for (const Vec2 place : places_) make_whole(place, none);
  judge_places();
  return true;
}

/// Adds a ring, and joins it to all that it touches.
bool Weaver::put_in(const Contacts& contacts) {
  for (const std::uint32_t corner : contacts.corners) divide_at(contacts.ring[corner]);
  Edit come;
  come.seat = loops_.seat_beside(contacts.beside);
  for (const Vec2 p : contacts.ring) {
    const std::uint32_t v = new_vertex();
    vertex(v);
    come.in.push_back({v, p});
  }
  for (const std::uint32_t corner : contacts.corners) corners_.push_back(come.in[corner].number);
  if (come.seat->loop == loops_.loops_.size()) loops_.loops_.emplace_back();
  loop(come.seat->loop);
  loops_.put_in(come, true);
  parts_ += come.seat->hole ? -1 : 1;
  for (const Corner& one : come.in)
    if (!join_at(one.number)) return false;
  judge_places();
  return true;
}

/// Moves the fresh vertex to its place, and inserts a vertex into the edge that it touches there.
void Weaver::set_middle(const Contacts& contacts) {
  if (!contacts.detour.fresh) return;
  const Vec2 place = *contacts.detour.fresh;
  if (fresh_ == none) {
    fresh_ = new_vertex();
    insert_after(contacts.chain[0], fresh_, place);
  } else {
    vertex(fresh_).point = place;
    vertex(loops_[fresh_].before);  // saved for take_back(), as its edge changes
    loops_.set_box(loops_[fresh_].before);
    loops_.set_box(fresh_);
  }
  divide_at(place);
}

/// Joins the edges at a vertex with others at its place: if they lie in a wedge of the interior,
/// they divide it.
bool Weaver::join_at(std::uint32_t own) {
  const Vec2 place = loops_[own].point;
  const auto start_of = [&](std::uint32_t v) { return loops_[loops_[v].before].point; };
  const auto end_of = [&](std::uint32_t v) { return loops_[loops_[v].next].point; };
  for (const std::uint32_t v : vertices_at(loops_, place)) {
    if (v == own) continue;
    const auto is_inside = [&](Vec2 p) { return is_in_wedge(place, end_of(v), start_of(v), p); };
    const bool has_start = is_inside(start_of(own)), has_end = is_inside(end_of(own));
    if (has_start != has_end) return false;
    // If each of two wedges contains the other's edges, their intersection is interior.
    if (has_start && is_in_wedge(place, end_of(own), start_of(own), start_of(v)))
      return exchange(loops_[own].before, loops_[v].before, true);
  }
  return true;
}

/// Updates all vertices at once: how a vertex joins its edges depends on which neighbours are flat.
void Weaver::judge_places() {
  std::vector<std::uint32_t> all;
  for (const Vec2 place : places_) {
    const std::vector<std::uint32_t> here = vertices_at(loops_, place);
    for (const std::uint32_t v : here) vertex(v).touches = here.size() > 1;
    all.insert(all.end(), here.begin(), here.end());
  }
  loops_.judge(all);
}

/// Exchanges the successors of two edges that end at the same point.
bool Weaver::exchange(std::uint32_t first, std::uint32_t second, bool joins) {
  const std::uint32_t after_first = loops_[first].next, after_second = loops_[second].next;
  link(first, after_second);
  link(second, after_first);
  parts_ += joins ? 1 : -1;
  const std::uint32_t loop_of_first = loops_[first].loop, loop_of_second = loops_[second].loop;
  if (loop_of_first == loop_of_second) return split(first, second, joins);
  return merge(loop_of_first, loop_of_second, joins);
}

/// Divides the loop of two vertices, which exchange() has made two.
bool Weaver::split(std::uint32_t first, std::uint32_t second, bool joins) {
  std::uint32_t count = 0, u = first, v = second;
  do {
    u = loops_[u].next;
    v = loops_[v].next;
    ++count;
  } while (u != first && v != second);
  const std::uint32_t small = u == first ? first : second, large = u == first ? second : first;
  const std::uint32_t old = loops_[small].loop;
  const Seat seat = loops_.seat_beside(none);
  if (seat.loop == loops_.loops_.size()) loops_.loops_.emplace_back();
  // Below the lowest edge at its leftmost point is the outside of a loop, whatever is joined there
  // later: an outer loop leaves along that edge, a hole arrives.
  bool is_hole = false;
  Vec2 leftmost = loops_[small].point;
  std::optional<Vec2> lowest;
  u = small;
  for (std::uint32_t i = 0; i < count; ++i, u = loops_[u].next) {
    vertex(u).loop = seat.loop;
    const Vec2 here = loops_[u].point;
    if (lexicographic_less(leftmost, here)) continue;
    if (!(here == leftmost)) lowest.reset();
    leftmost = here;
    for (const bool arrives : {false, true}) {
      const Vec2 end = loops_[arrives ? loops_[u].before : loops_[u].next].point;
      if (lowest && orientation(here, end, *lowest) <= 0) continue;
      lowest = end;
      is_hole = arrives;
    }
  }
  Loop& whole = loop(old);
  const bool was_hole = whole.hole;
  whole.size -= count;
  whole.first = large;
  loop(seat.loop) = {small, count, whole.component, is_hole};
  if (joins == was_hole) {  // an outer loop and a hole
    whole.hole = !is_hole;
    if (!joins) return true;
    return move_holes(is_hole ? old : seat.loop, seat.component, is_hole ? seat.loop : old);
  }
  loops_.loops_[seat.loop].hole = was_hole;
  return !joins || move_holes(seat.loop, seat.component, none);
}

bool Weaver::is_place(Vec2 p) const {
  return std::find(places_.begin(), places_.end(), p) != places_.end();
}

/// Makes an outer loop and the holes inside it a new component; `but` is not one of these holes.
bool Weaver::move_holes(std::uint32_t outer, std::uint32_t component, std::uint32_t but) {
  constexpr std::size_t most = std::size_t{1} << 20;
  const std::uint32_t old = loops_.component(outer);
  loop(outer).component = component;
  std::size_t looks = 0;
  for (std::uint32_t l = 0; l < loops_.loops_.size(); ++l) {
    const Loop& hole = loops_.loops_[l];
    if (hole.size == 0 || !hole.hole || hole.component != old || l == but) continue;
    looks += loops_.loop_size(outer) + places_.size();
    if (looks > most) return false;
    // Avoid points at which loops are yet to be joined.
    std::uint32_t free = hole.first;
    for (std::uint32_t i = 0; i < hole.size && is_place(loops_[free].point); ++i)
      free = loops_[free].next;
    const Vec2 p = loops_[free].point;
    if (is_place(p)) return false;
    bool is_inside = false;
    loops_.for_vertices(outer, [&](std::uint32_t v) {
      const Vec2 a = loops_[v].point, b = loops_[loops_[v].next].point;
      if (crosses_ray(a, b, p)) is_inside = !is_inside;
    });
    if (is_inside) loop(l).component = component;
  }
  return true;
}

/// Merges two loops, which exchange() has made one. If edges join, the loops belong to one
/// component before; if they part, they become one component.
bool Weaver::merge(std::uint32_t first, std::uint32_t second, bool joins) {
  const bool is_first_larger = loops_.loop_size(first) > loops_.loop_size(second);
  const std::uint32_t large = is_first_larger ? first : second,
                      small = is_first_larger ? second : first;
  const Loop gone = loops_.loops_[small];
  if ((gone.component == loops_.component(large)) != joins) return false;
  std::uint32_t v = gone.first;
  // The smaller loop's vertices are consecutive in the new loop; the walk skips those of the other.
  while (loops_[loops_[v].before].loop == small) v = loops_[v].before;
  for (; loops_[v].loop == small; v = loops_[v].next) vertex(v).loop = large;
  loop(small) = {};
  Loop& whole = loop(large);
  whole.size += gone.size;
  std::uint32_t from = gone.component, to = whole.component;
  if (whole.hole != gone.hole) {
    if (!joins && gone.hole) std::swap(from, to);  // from the hole's component
    whole.hole = !joins;
  }
  whole.component = to;
  if (from == to) return true;
  for (std::uint32_t l = 0; l < loops_.loops_.size(); ++l)
    if (loops_.loops_[l].size > 0 && loops_.loops_[l].component == from) loop(l).component = to;
  return true;
}

void Weaver::take_back() {
  for (auto i = old_loops_.rbegin(); i != old_loops_.rend(); ++i)
    loops_.loops_[i->first] = i->second;
  for (auto i = old_vertices_.rbegin(); i != old_vertices_.rend(); ++i)
    loops_.vertices_[i->first] = i->second;
  loops_.vertices_.resize(size_);
  for (const auto& [v, old] : old_vertices_) {
    if (loops_.has(v))
      loops_.set_box(v);
    else
      loops_.boxes_.set(v, Box::nothing());
  }
}

}  // namespace medial::edit
