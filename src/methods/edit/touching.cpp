#include "methods/edit/touching.h"

#include <algorithm>
#include <utility>

#include "methods/edit/axis_graph.h"

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
  if (!loops.has_arcs()) add_flat_vertices(loops);
}

/// Those between two corners that follow each other in the loops as well.
void Touching::add_flat_vertices(Rings& loops) {
  const auto size = static_cast<std::uint32_t>(rings_.size());
  for (std::uint32_t from = 0; from < size; ++from) {
    if (!rings_.has(from) || rings_[from].flat || !rings_[rings_[from].next].flat) continue;
    const std::uint32_t start = numbers_[from], end = numbers_[rings_.corner_after(from)];
    if (start == none || end == none) continue;
    const auto is_edge = [&](std::uint32_t a, std::uint32_t b) {
      return loops[a].next == b && loops[a].bulge == 0;
    };
    const bool is_turned = !is_edge(start, end);
    if (is_turned && !is_edge(end, start)) continue;
    std::uint32_t last = start;
    for (std::uint32_t v = rings_[from].next; rings_[v].flat; v = rings_[v].next) {
      if (numbers_[v] != none) break;
      Edit edit;
      edit.before = is_turned ? end : last;
      edit.after = is_turned ? last : end;
      edit.fresh = last = loops.unused();
      edit.place = rings_[v].point;
      loops.apply(edit);
      note(v, last);
    }
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

std::optional<Edit> Touching::of_vertices(const Edit& edit, const Rings& loops) const {
  const auto is_there = [&](std::uint32_t v) {
    return number_of(v) != none && loops.has(number_of(v));
  };
  const bool has_old = edit.old != none;
  if (!is_there(edit.before) || !is_there(edit.after) || (has_old && !is_there(edit.old)))
    return std::nullopt;
  Edit own = edit;
  own.seat.reset();
  own.before = number_of(edit.before);
  own.after = number_of(edit.after);
  own.old = has_old ? number_of(edit.old) : none;
  if (edit.fresh != none) {
    own.fresh = edit.fresh == edit.old ? own.old : number_of(edit.fresh);
    if (own.fresh == none) own.fresh = loops.unused();
  }
  const auto is_edge = [&](std::uint32_t from, std::uint32_t to, double bulge) {
    return loops[from].next == to && loops[from].bulge == bulge;
  };
  const std::uint32_t middle = has_old ? own.old : own.after;
  const double first = rings_[edit.before].bulge, second = has_old ? rings_[edit.old].bulge : 0;
  if (is_edge(own.before, middle, first) && (!has_old || is_edge(middle, own.after, second)))
    return own;
  if (!is_edge(middle, own.before, -first) || (has_old && !is_edge(own.after, middle, -second)))
    return std::nullopt;
  std::swap(own.before, own.after);
  own.bulge = {-edit.bulge[edit.fresh != none ? 1 : 0], -edit.bulge[0]};
  if (edit.fresh == none) own.bulge[1] = 0;
  return own;
}

/// Whether a ring is a loop.
bool Touching::is_loop(const std::vector<Corner>& corners, const Rings& loops) const {
  bool is_forward = true, is_backward = true;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t v = number_of(corners[i].number);
    const std::uint32_t after = number_of(corners[i + 1 < corners.size() ? i + 1 : 0].number);
    if (v == none || after == none || !loops.has(v) || !loops.has(after)) return false;
    if (loops[v].touches) return false;  // what touches it may be flat then
    is_forward = is_forward && loops[v].next == after && loops[v].bulge == corners[i].bulge;
    is_backward = is_backward && loops[after].next == v && loops[after].bulge == -corners[i].bulge;
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
  make_room(numbers_, rings_.size() + fresh);
  make_room(of_loops_, loops.size() + fresh);
  if (edit.out.empty() || edit.in.empty()) return rings_.apply(edit, false);
  // One by one, as memory may run out.
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

void Touching::note(const Edit& edit, const Edit& of_loops) {
  for (std::size_t i = 0; i < edit.in.size(); ++i) note(edit.in[i].number, of_loops.in[i].number);
  if (edit.fresh != none) note(edit.fresh, of_loops.fresh);
}

}  // namespace medial::edit
