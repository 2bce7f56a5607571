#include "methods/edit/touching.h"

#include <algorithm>
#include <utility>

#include "methods/edit/axis_graph.h"
#include "methods/edit/segments.h"

namespace medial::edit {

Touching::Touching(Rings rings, const Shape& shape, Rings& loops)
    : rings_(std::move(rings)), numbers_(rings_.size(), none) {
  const auto count = static_cast<std::uint32_t>(shape.points.size());
  std::vector<bool> is_several(rings_.size(), false);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t v = shape.sources[i].vertex;
    of_loops_.push_back(v);
    if (numbers_[v] != none) is_several[v] = true;
    numbers_[v] = i;
  }
  loops.find_touches();
  for (std::uint32_t v = 0; v < numbers_.size(); ++v)
    if (is_several[v] || (numbers_[v] != none && !(rings_[v].point == shape.points[numbers_[v]])))
      numbers_[v] = none;
  add_flat_vertices(loops);
}

Touching::Touching(const Rings& loops) : rings_(loops) {
  for (std::uint32_t v = 0; v < loops.size(); ++v) numbers_.push_back(loops.has(v) ? v : none);
  of_loops_ = numbers_;
}

void Touching::add_flat_vertices(Rings& loops) {
  for (std::uint32_t v = 0; v < numbers_.size(); ++v) {
    if (!rings_.has(v) || !rings_[v].flat || numbers_[v] != none) continue;
    const Vec2 place = rings_[v].point;
    Edit edit;
    loops.for_edges_in({place, place}, [&](std::uint32_t s) {
      const std::uint32_t next = loops[s].next;
      if (loops[s].bulge != 0 || !lies_inside(place, loops[s].point, loops[next].point)) return;
      edit.before = s;
      edit.after = next;
    });
    if (edit.before == none) continue;
    edit.fresh = loops.unused();
    edit.place = place;
    loops.apply(edit);
    note(v, edit.fresh);
  }
}

void Touching::note(std::uint32_t of_rings, std::uint32_t of_loops) {
  if (of_rings >= numbers_.size()) numbers_.resize(of_rings + 1, none);
  if (of_loops >= of_loops_.size()) of_loops_.resize(of_loops + 1, none);
  numbers_[of_rings] = of_loops;
  of_loops_[of_loops] = of_rings;
}

std::uint32_t Touching::edge_at(std::uint32_t of_loops, const Rings& loops) const {
  const std::uint32_t start = vertex_at(of_loops), end = vertex_at(loops[of_loops].next);
  return rings_.has(end) && rings_[end].next == start ? end : start;
}

std::optional<Seat> Touching::seat_beside(std::uint32_t of_loops, const Rings& loops) const {
  if (of_loops == none) return rings_.seat_beside(none);
  const std::uint32_t drawn = edge_at(of_loops, loops);
  if (!rings_.has(drawn)) return std::nullopt;
  return rings_.seat_beside(drawn);
}

/// No two edges have the same ends and bulges, so these identify the edge of the loops that is an
/// edge of the rings.
std::optional<Edit> Touching::of_vertices(const Edit& edit, const Rings& loops) const {
  const auto number_there = [&](std::uint32_t v) {
    const std::uint32_t number = number_of(v);
    return number != none && loops.has(number) ? number : none;
  };
  const auto is_at = [&](std::uint32_t of_loops, std::uint32_t of_rings) {
    return loops[of_loops].point == rings_[of_rings].point;
  };
  const bool has_old = edit.old != none;
  Edit own = edit;
  own.seat.reset();
  bool is_turned = false;
  if (has_old) {
    own.old = number_there(edit.old);
    if (own.old == none) return std::nullopt;
    own.before = loops[own.old].before;
    own.after = loops[own.old].next;
    is_turned = !is_at(own.before, edit.before);
  } else if (const std::uint32_t before = number_there(edit.before); before != none) {
    is_turned = !is_at(loops[before].next, edit.after);
    own.before = is_turned ? loops[before].before : before;
    own.after = loops[own.before].next;
  } else if (const std::uint32_t after = number_there(edit.after); after != none) {
    is_turned = !is_at(loops[after].before, edit.before);
    own.before = is_turned ? after : loops[after].before;
    own.after = loops[own.before].next;
  } else {
    return std::nullopt;
  }
  const auto is_edge = [&](std::uint32_t of_loops, std::uint32_t of_rings) {
    return loops[of_loops].bulge == (is_turned ? -1 : 1) * rings_[of_rings].bulge;
  };
  const std::uint32_t last = has_old ? edit.old : edit.before;
  if (!is_at(own.before, is_turned ? edit.after : edit.before) ||
      !is_at(own.after, is_turned ? edit.before : edit.after) ||
      !is_edge(own.before, is_turned ? last : edit.before) ||
      (has_old && !is_edge(own.old, is_turned ? edit.before : last)))
    return std::nullopt;
  if (is_turned) {
    const auto [first, second] = edit.bulge;
    if (edit.fresh != none)
      own.bulge = {0 - second, 0 - first};
    else
      own.bulge[0] = 0 - first;
  }
  if (edit.fresh != none) {
    own.fresh = edit.fresh == edit.old ? own.old : number_of(edit.fresh);
    if (own.fresh == none) own.fresh = loops.unused();
  }
  return own;
}

/// Whether a ring is also a loop.
bool Touching::is_loop(const std::vector<Corner>& corners, const Rings& loops) const {
  bool is_forward = true, is_backward = true;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t v = number_of(corners[i].number);
    const std::uint32_t after = number_of(corners[i + 1 < corners.size() ? i + 1 : 0].number);
    if (v == none || after == none || !loops.has(v) || !loops.has(after)) return false;
    if (loops[v].touches) return false;  // a vertex that touches it may become flat
    const double bulge = corners[i].bulge;
    is_forward = is_forward && loops[v].next == after && loops[v].bulge == bulge;
    is_backward = is_backward && loops[after].next == v && loops[after].bulge == -bulge;
  }
  return is_forward || is_backward;
}

std::optional<Edit> Touching::of_loops(const Edit& edit, const Rings& loops) const {
  if (!edit.is_of_loops()) return of_vertices(edit, loops);
  if (!edit.out.empty() && !is_loop(edit.out, loops)) return std::nullopt;
  Edit own = edit;
  own.seat.reset();
  std::uint32_t unused = loops.unused();
  for (std::vector<Corner>* corners : {&own.out, &own.in})
    for (Corner& corner : *corners) {
      corner.number = number_of(corner.number);
      if (corner.number == none) corner.number = unused++;
    }
  return own;
}

void Touching::apply(const Edit& edit, const Rings& loops) {
  const std::size_t fresh = edit.in.size() + 1;
  edit::make_room(numbers_, rings_.size() + fresh);
  edit::make_room(of_loops_, loops.size() + fresh);
  if (edit.out.empty() || edit.in.empty()) return rings_.apply(edit, false);
  // In two steps, as memory may run out.
  Edit out = edit, in = edit;
  out.in.clear();
  in.out.clear();
  const Edit back = rings_.inverse(out);
  rings_.apply(out, false);
  try {
    rings_.apply(in, false);
  } catch (...) {
    rings_.apply(back, false);
    throw;
  }
}

void Touching::make_room(const Rings& loops) {
  edit::make_room(of_loops_, loops.size());
  of_loops_.resize(loops.size(), none);
  if (numbers_.size() < rings_.size()) {
    edit::make_room(numbers_, rings_.size());
    numbers_.resize(rings_.size(), none);
  }
}

void Touching::set_number(std::uint32_t of_rings, std::uint32_t of_loops) {
  numbers_[of_rings] = of_loops;
  if (of_loops != none) of_loops_[of_loops] = of_rings;
}

void Touching::note(const std::vector<Vec2>& places, const Rings& loops) {
  for (const Vec2 place : places) {
    std::uint32_t drawn = none;
    const auto find = [&](std::uint32_t v) {
      if (rings_[v].point == place) drawn = v;
    };
    rings_.for_edges_in({place, place}, find);
    loops.for_edges_in({place, place}, [&](std::uint32_t v) {
      if (!(loops[v].point == place)) return;
      const std::uint32_t old = of_loops_[v];
      if (old == none || !rings_.has(old) || !(rings_[old].point == place)) of_loops_[v] = drawn;
    });
  }
}

void Touching::note(const Edit& edit, const Edit& of_loops) {
  for (std::size_t i = 0; i < edit.in.size(); ++i) note(edit.in[i].number, of_loops.in[i].number);
  if (edit.fresh != none) note(edit.fresh, of_loops.fresh);
}

}  // namespace medial::edit
