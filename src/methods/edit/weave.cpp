#include <algorithm>
#include <utility>

#include "base/predicates.h"
#include "methods/edit/parts.h"
#include "methods/edit/weaver.h"

// Edits that change which edges touch.

namespace medial {

using edit::join;

/// Whether a vertex becomes collinear with its neighbours at a point where its ring may cross
/// itself. A ring may do so at a vertex, but not inside an edge.
bool Editor::Parts::straightens_crossing(const edit::Edit& edit) const {
  if (edit.is_of_loops() || rings.has_arcs()) return false;
  const Rings& own = edited();
  const edit::Detour way = detour_of(edit);
  const auto is_crossing = [&](std::uint32_t v, std::uint32_t Rings::Vertex::*other, Vec2 to) {
    const Vec2 here = own[v].point;
    std::uint32_t u = own[v].*other;
    while (u != v && own[u].point == here) u = own[u].*other;
    const Vec2 from = own[u].point;
    if (orientation(from, here, to) != 0 || !strictly_between(from, here, to)) return false;
    bool has_left = false, has_right = false;
    for (const std::uint32_t one : edit::vertices_at(rings, here))
      for (const std::uint32_t end : {rings[one].before, rings[one].next}) {
        const int side = orientation(from, here, rings[end].point);
        has_left = has_left || side > 0;
        has_right = has_right || side < 0;
      }
    return has_left && has_right && edit::vertices_at(rings, here).size() > 1;
  };
  return is_crossing(edit.before, &Rings::Vertex::before, way.fresh.value_or(way.to)) ||
         is_crossing(edit.after, &Rings::Vertex::next, way.fresh.value_or(way.from));
}

/// The coordinates of an edit of a vertex; equal points of a ring are one.
edit::Detour Editor::Parts::detour_of(const edit::Edit& edit) const {
  const Rings& own = edited();
  edit::Detour way{own[edit.before].point, own[edit.after].point, {}, {}};
  if (edit.old != none) way.old = own[edit.old].point;
  if (edit.fresh != none) way.fresh = edit.place;
  for (std::optional<Vec2>* middle : {&way.old, &way.fresh})
    if (*middle == way.from || *middle == way.to) middle->reset();
  return way;
}

/// Applies an edit of a vertex whose edges begin or cease to touch others. Returns none, and
/// changes nothing, if the whole axis must be recomputed.
std::optional<Step> Editor::Parts::weave(const edit::Edit& edit, const edit::Contacts& contacts) {
  const bool is_first = !touching;
  const edit::Detour way = detour_of(edit);
  const edit::Edit back = edited().inverse(edit);
  const Box old_box = box;
  Box reach = box;
  edited().add_reach(edit, reach);
  if (is_first) touching.emplace(rings);
  const auto take_back = [&] {
    set_box(old_box);
    if (is_first)
      touching.reset();
    else
      touching->rings().apply(back, false);
  };
  touching->apply(edit, rings);
  set_box(reach);
  std::optional<Step> step;
  try {
    edit::Weaver weaver(rings, touching->rings());
    if (contacts.judgement.verdict == Rings::Verdict::keeps_form) step = weave(contacts, weaver);
    if (step)
      note(subject_of(edit), weaver.fresh(), contacts.places);
    else if (way.old && way.fresh)
      step = weave_in_two(edit, way);
  } catch (...) {
    take_back();
    throw;
  }
  if (!step) take_back();
  return step;
}

/// Records which vertices of the rings and of the loops correspond after an edit.
void Editor::Parts::note(std::uint32_t of_rings, std::uint32_t of_loops,
                         const std::vector<Vec2>& places) {
  touching->note(places, rings);
  touching->set_number(of_rings, of_loops);
}

/// Applies an edit to the loops.
std::optional<Step> Editor::Parts::weave(const edit::Contacts& contacts, edit::Weaver& weaver) {
  Seeds seeds;
  seeds.before = rings.sites_at(contacts.places);
  // Disks that contain a part of the new ring touch a site that it touches, or the nearest one.
  if (!contacts.ring.empty()) {
    for (const Rings::Extent& one : seeds.before) seeds.sites.push_back(one.site);
    if (seeds.before.empty()) {
      const std::uint32_t site = rings.around(contacts.ring[0]).site;
      if (site != none) seeds.sites.push_back(site);
    }
  }
  std::optional<Step> step;
  try {
    if (weaver.make(contacts)) {
      touching->make_room(rings);
      seeds.parts = weaver.parts();
      step = repair(seeds, rings.sites_at(contacts.places), weaver.moved());
    }
  } catch (...) {
    weaver.take_back();
    throw;
  }
  if (!step) weaver.take_back();
  return step;
}

/// Removes the vertex, and inserts it again at its new place.
std::optional<Step> Editor::Parts::weave_in_two(const edit::Edit& edit, const edit::Detour& way) {
  const auto keeps_form = [](const edit::Contacts& contacts) {
    return contacts.judgement.verdict == Rings::Verdict::keeps_form;
  };
  const edit::Contacts out = edit::find_contacts(rings, {way.from, way.to, way.old, {}});
  if (!keeps_form(out)) return std::nullopt;
  edit::Weaver first_weaver(rings, touching->rings());
  std::optional<Step> first = weave(out, first_weaver), second;
  if (!first) return std::nullopt;
  const auto take_back = [&] {
    put_back(*first);
    first_weaver.take_back();
  };
  edit::Weaver second_weaver(rings, touching->rings());
  try {
    const edit::Contacts in = edit::find_contacts(rings, {way.from, way.to, {}, way.fresh});
    if (keeps_form(in)) second = weave(in, second_weaver);
    if (second) {
      AxisChange both = first->change;
      join(both, second->change);
      std::vector<Vec2> places = out.places;
      places.insert(places.end(), in.places.begin(), in.places.end());
      note(subject_of(edit), second_weaver.fresh(), places);
      first->change = std::move(both);
      return first;
    }
  } catch (...) {
    if (second) {
      put_back(*second);
      second_weaver.take_back();
    }
    take_back();
    throw;
  }
  take_back();
  return std::nullopt;
}

/// One loop is removed and another one added, each with its contacts.
struct Editor::Parts::LoopWeave {
  Parts& parts;
  const edit::Edit& edit;
  edit::Edit back = {}, come = {};  ///< of the rings
  std::optional<edit::Weaver> first_weaver = std::nullopt, second_weaver = std::nullopt;
  std::optional<Step> first = std::nullopt, second = std::nullopt;
  std::vector<Vec2> places = {};

  bool take_out() {
    const edit::Contacts contacts = edit::contacts_before(parts.rings, edit.out);
    if (contacts.judgement.verdict != Rings::Verdict::keeps_form) return false;
    edit::Edit gone;
    gone.out = edit.out;
    edit::Edit own = parts.edited().inverse(gone);
    parts.touching->apply(gone, parts.rings);
    back = std::move(own);
    first_weaver.emplace(parts.rings, parts.touching->rings());
    first = parts.weave(contacts, *first_weaver);
    places = contacts.places;
    return first.has_value();
  }
  bool put_in(std::optional<Error>& refused) {
    const edit::Contacts contacts = edit::contacts_after(parts.rings, edit.in);
    if (contacts.judgement.verdict == Rings::Verdict::crosses ||
        contacts.judgement.verdict == Rings::Verdict::overlaps)
      refused = parts.refusal(contacts.judgement);
    if (contacts.judgement.verdict != Rings::Verdict::keeps_form) return false;
    edit::Edit own;
    own.in = edit.in;
    own.seat = edit.seat ? edit.seat : parts.touching->seat_beside(contacts.beside, parts.rings);
    parts.touching->apply(own, parts.rings);
    come = std::move(own);
    second_weaver.emplace(parts.rings, parts.touching->rings());
    second = parts.weave(contacts, *second_weaver);
    places.insert(places.end(), contacts.places.begin(), contacts.places.end());
    return second.has_value();
  }
  Step result() const {
    Step both;
    if (first) both = *first;
    if (second) join(both.change, second->change);
    edit::Touching& touching = *parts.touching;
    touching.note(places, parts.rings);
    for (std::size_t i = 0; i < edit.in.size(); ++i)
      touching.set_number(edit.in[i].number, second_weaver->corners()[i]);
    return both;
  }
  void take_back() {
    if (second) {
      parts.put_back(*second);
      second_weaver->take_back();
    }
    std::swap(come.in, come.out);
    if (!come.out.empty()) parts.touching->rings().apply(come, false);
    if (first) {
      parts.put_back(*first);
      first_weaver->take_back();
    }
    if (!back.in.empty()) parts.touching->rings().apply(back, false);
  }
};

/// Removes a loop and adds one, both of which may touch others. Returns none, and changes nothing,
/// if the whole axis must be recomputed, or if the new loop crosses others.
std::optional<Step> Editor::Parts::weave_loops(const edit::Edit& edit,
                                               std::optional<Error>& refused) {
  const bool is_first = !touching;
  const Box old_box = box;
  Box reach = box;
  edited().add_reach(edit, reach);
  if (is_first) touching.emplace(rings);
  set_box(reach);
  LoopWeave loops{*this, edit};
  const auto take_back = [&] {
    loops.take_back();
    set_box(old_box);
    if (is_first) touching.reset();
  };
  try {
    if ((edit.out.empty() || loops.take_out()) && (edit.in.empty() || loops.put_in(refused)))
      return loops.result();
  } catch (...) {
    take_back();
    throw;
  }
  take_back();
  return std::nullopt;
}

/// Applies an edit of a vertex that changes the form of a small loop, by replacing the loop.
/// Returns none, and changes nothing, if the whole axis must be recomputed.
std::optional<Step> Editor::Parts::replace_loop(const edit::Edit& edit) {
  constexpr std::size_t small = 64, share = 16;
  const std::uint32_t loop = edited()[edit.before].loop, size = edited().loop_size(loop);
  if (size > small && share * size > edited().size()) return std::nullopt;
  edit::Edit replaced;
  replaced.out = corners_of(edit.before);
  replaced.in = {{edit.before, edited()[edit.before].point, edit.bulge[0]}};
  if (edit.fresh != none) replaced.in.push_back({edit.fresh, edit.place, edit.bulge[1]});
  for (const edit::Corner& corner : replaced.out)
    if (corner.number != edit.before && corner.number != edit.old) replaced.in.push_back(corner);
  replaced.seat = edited().seat_of(loop);
  replaced.seat->first = edit.before;
  if (!touching)
    if (auto step = follow(replaced, Rings::Verdict::unclear); step && *step)
      return std::move(*step);
  std::optional<Error> refused;
  return rings.has_arcs() ? std::nullopt : weave_loops(replaced, refused);
}

}  // namespace medial
