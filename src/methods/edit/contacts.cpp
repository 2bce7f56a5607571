#include "methods/edit/contacts.h"

#include <algorithm>
#include <array>

#include "methods/edit/segments.h"

namespace medial::edit {
namespace {

using Judgement = Rings::Judgement;
using Verdict = Rings::Verdict;

/// Adds the vertices of the loops at which the pieces of the edge `from`-`to` begin. Returns false
/// if the pieces do not lead from start to end.
bool add_pieces(const Rings& loops, Vec2 from, Vec2 to, std::vector<std::uint32_t>& chain) {
  while (!(from == to)) {
    std::uint32_t piece = none;
    loops.for_edges_in({from, from}, [&](std::uint32_t s) {
      if (!(loops[s].point == from)) return;
      const Vec2 end = loops[loops[s].next].point;
      if (end == to || lies_inside(end, from, to)) piece = s;
    });
    if (piece == none) return false;
    chain.push_back(piece);
    from = loops[loops[piece].next].point;
  }
  return true;
}

/// Contacts are compared pairwise. Above this number, computing the whole axis is as fast.
bool takes_long(const Rings& loops, std::size_t contacts) {
  constexpr std::size_t few = 64, share = 16;
  return contacts > few && contacts * contacts > share * loops.size();
}

/// Sorts the places inside an edge along it and removes duplicates.
void put_in_order(Vec2 from, Vec2 to, std::vector<Vec2>& places) {
  std::sort(places.begin(), places.end(), lexicographic_less);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (lexicographic_less(to, from)) std::reverse(places.begin(), places.end());
}

struct Side {
  Vec2 from, to;
  bool has(Vec2 p) const { return p == from || p == to || lies_inside(p, from, to); }
};

/// The area that the edges of a detour sweep while the vertex moves straight to its place, or to or
/// from the inside of an edge. Only the edges at the beginning and at the end may touch other
/// edges.
struct Sweep {
  Triangle triangle;
  std::vector<Side> sides;  ///< the edges at the beginning and at the end

  bool has(Vec2 p) const { return triangle.has(p); }
  bool passes(Vec2 p) const {
    return has(p) &&
           std::none_of(sides.begin(), sides.end(), [&](const Side& side) { return side.has(p); });
  }
};

/// Finds the contacts of a detour.
class Finder {
 public:
  Finder(const Rings& loops, const Detour& detour) : loops_(loops) { contacts_.detour = detour; }

  Contacts run() {
    contacts_.judgement.verdict = Verdict::unclear;
    const Detour& way = contacts_.detour;
    if (way.from == way.to || !find_chain()) return contacts_;
    contacts_.judgement.verdict = Verdict::keeps_form;
    contacts_.places = {way.from, way.to};
    if (!way.old && !way.fresh) return contacts_;
    prepare();
    Box query = box_of(way.from, way.to);
    if (way.old) query.add(*way.old);
    if (way.fresh) query.add(*way.fresh);
    std::vector<std::uint32_t> own = contacts_.chain;
    std::sort(own.begin(), own.end());
    loops_.for_edges_in(query, [&](std::uint32_t s) {
      if (!is_refused() && !std::binary_search(own.begin(), own.end(), s)) meet(s);
    });
    const std::size_t count = own.size() + touched_[0].size() + touched_[1].size();
    if (!is_refused() && takes_long(loops_, count)) leave_open();
    for (std::size_t i = 0; i < fresh_.size(); ++i) {
      std::vector<Vec2>& touched = touched_[i];
      put_in_order(fresh_[i].from, fresh_[i].to, touched);
      contacts_.touched.insert(contacts_.touched.end(), touched.begin(), touched.end());
    }
    contacts_.touched_on_first = touched_[0].size();
    std::vector<Vec2>& places = contacts_.places;
    for (const std::uint32_t v : contacts_.chain) places.push_back(loops_[v].point);
    places.insert(places.end(), contacts_.touched.begin(), contacts_.touched.end());
    if (way.fresh) places.push_back(*way.fresh);
    return contacts_;
  }

 private:
  bool is_refused() const {
    const Verdict verdict = contacts_.judgement.verdict;
    return verdict == Verdict::crosses || verdict == Verdict::overlaps;
  }
  void leave_open() { contacts_.judgement.verdict = Verdict::unclear; }
  void refuse(Verdict verdict, std::uint32_t edge, Vec2 point) {
    contacts_.judgement = {verdict, edge, point};
  }

  /// Finds the pieces of the old edges; the loops may traverse them in the other direction.
  bool find_chain() {
    Detour& way = contacts_.detour;
    for (int turn = 0; turn < 2; ++turn) {
      contacts_.chain.clear();
      contacts_.middle = 0;
      if (way.old) {
        if (add_pieces(loops_, way.from, *way.old, contacts_.chain)) {
          contacts_.middle = contacts_.chain.size();
          if (add_pieces(loops_, *way.old, way.to, contacts_.chain)) return true;
        }
      } else if (add_pieces(loops_, way.from, way.to, contacts_.chain)) {
        return true;
      }
      std::swap(way.from, way.to);
    }
    return false;
  }

  void prepare() {
    const auto& [from, to, old, fresh] = contacts_.detour;
    if (fresh)
      fresh_ = {{from, *fresh}, {*fresh, to}};
    else
      fresh_ = {{from, to}};
    if (old && fresh)
      sweeps_ = {{{{from, *old, *fresh}}, {{from, *old}, {from, *fresh}}},
                 {{{*old, to, *fresh}}, {{*old, to}, {*fresh, to}}}};
    else if (old)
      sweeps_ = {{{{from, *old, to}}, {{from, *old}, {*old, to}, {from, to}}}};
    else
      sweeps_ = {{{{from, *fresh, to}}, {{from, *fresh}, {*fresh, to}, {from, to}}}};
    if (old && fresh && (sweeps_[0].has(to) || sweeps_[1].has(from))) leave_open();
    if (fresh && orientation(from, *fresh, to) == 0 && !strictly_between(from, *fresh, to))
      refuse(Verdict::overlaps, contacts_.chain[0], *fresh);
  }

  bool is_corner(Vec2 p) const {
    const Detour& way = contacts_.detour;
    return p == way.from || p == way.to || p == way.old || p == way.fresh;
  }

  void meet(std::uint32_t s) {
    const auto& [from, to, old, fresh] = contacts_.detour;
    const Vec2 a = loops_[s].point, b = loops_[loops_[s].next].point;
    for (std::size_t i = 0; i < fresh_.size(); ++i) {
      const Side& edge = fresh_[i];
      const Meeting how = meeting(edge.from, edge.to, a, b);
      if (how == Meeting::apart) continue;
      if (how == Meeting::cross)
        return refuse(Verdict::crosses, s, crossing_of(edge.from, edge.to, a, b));
      if (run_along(edge.from, edge.to, a, b)) return refuse(Verdict::overlaps, s, a);
      if (!lies_inside(a, edge.from, edge.to)) continue;
      if (loops_[s].flat) return refuse(Verdict::crosses, s, a);  // both points lie inside an edge
      touched_[i].push_back(a);
    }
    const bool is_divided = fresh && lies_inside(*fresh, a, b);
    // An edge that reaches from one side of a swept triangle to another is passed, too.
    const auto is_in = [&](const Sweep& sweep, Vec2 p, Vec2 q) {
      return sweep.has(p) && sweep.has(q);
    };
    for (const Sweep& sweep : sweeps_)
      if ((!is_corner(a) && sweep.passes(a)) ||
          (is_divided ? is_in(sweep, a, *fresh) || is_in(sweep, *fresh, b) : is_in(sweep, a, b)))
        leave_open();
    if (!old || !fresh) return;
    const Meeting on_the_way = meeting(*old, *fresh, a, b);
    if (on_the_way == Meeting::cross ||
        (on_the_way == Meeting::touch &&
         (run_along(*old, *fresh, a, b) || lies_inside(a, *old, *fresh) ||
          lies_inside(b, *old, *fresh))))
      leave_open();
  }

  const Rings& loops_;
  Contacts contacts_;
  std::vector<Side> fresh_;  ///< the new edges
  std::array<std::vector<Vec2>, 2> touched_;
  std::vector<Sweep> sweeps_;
};

/// Whether a ring that crosses no loop encloses a part of one, apart from the edges in `own`. Also
/// returns true if finding out takes too long.
bool encloses_any(const Rings& loops, const std::vector<Vec2>& ring,
                  const std::vector<std::uint32_t>& own) {
  constexpr std::size_t most = std::size_t{1} << 20;
  const std::size_t size = ring.size();
  const bool is_left = is_counter_clockwise(ring);
  Box box = Box::nothing();
  for (const Vec2 p : ring) box.add(p);
  std::size_t looks = 0;
  bool found = false;
  loops.for_edges_in(box, [&](std::uint32_t s) {
    if (found || std::binary_search(own.begin(), own.end(), s)) return;
    looks += size;
    const Vec2 p = loops[s].point, end = loops[loops[s].next].point;
    const auto at = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), p) - ring.begin());
    bool is_inside = false;
    if (at < size) {
      const Vec2 after = ring[at + 1 < size ? at + 1 : 0], before = ring[(at > 0 ? at : size) - 1];
      is_inside = is_left ? is_in_wedge(p, after, before, end) : is_in_wedge(p, before, after, end);
    } else {
      for (std::size_t i = 0; i < size; ++i)
        if (crosses_ray(ring[i], ring[i + 1 < size ? i + 1 : 0], p)) is_inside = !is_inside;
    }
    found = is_inside || looks > most;
  });
  return found;
}

/// See Contacts::beside. The edge of the ring after the first point at which it touches a loop
/// decides.
std::uint32_t find_beside(const Rings& loops, const std::vector<Vec2>& ring) {
  bool touches = false;
  std::uint32_t beside = none;
  for (std::size_t i = 0; i < ring.size() && !touches; ++i) {
    const Vec2 p = ring[i], to = ring[i + 1 < ring.size() ? i + 1 : 0];
    loops.for_edges_in({p, p}, [&](std::uint32_t s) {
      const Vec2 a = loops[s].point, b = loops[loops[s].next].point;
      const bool is_corner = a == p;
      if (!is_corner && !lies_inside(p, a, b)) return;
      touches = true;
      if (is_corner ? is_in_wedge(p, b, loops[loops[s].before].point, to)
                    : orientation(a, b, to) > 0)
        beside = s;
    });
  }
  if (touches) return beside;
  const std::uint32_t site = loops.around(ring[0]).site;
  return site == none ? none : Rings::vertex_of(site);
}

/// Whether a ring is a simple loop, except that vertices may lie between two collinear edges.
bool is_simple(const std::vector<Corner>& corners) {
  Ring ring;
  for (const Corner& corner : corners) ring.points.push_back(corner.point);
  const auto shape = build_shape({&ring, 1});
  if (!shape || shape->loop_count() != 1) return false;
  std::size_t flat = 0;
  for (std::size_t i = 0, size = corners.size(); i < size; ++i)
    if (lies_inside(corners[i].point, corners[(i > 0 ? i : size) - 1].point,
                    corners[i + 1 < size ? i + 1 : 0].point))
      ++flat;
  return shape->points.size() + flat == corners.size();
}

}  // namespace

Contacts contacts_before(const Rings& loops, const std::vector<Corner>& ring) {
  Contacts contacts;
  contacts.is_ring = true;
  contacts.judgement.verdict = Verdict::unclear;
  std::vector<Corner> corners = ring;
  bool is_found = false;
  for (int turn = 0; turn < 2 && !is_found; ++turn) {
    contacts.chain.clear();
    is_found = true;
    for (std::size_t i = 0; i < corners.size() && is_found; ++i)
      is_found = add_pieces(loops, corners[i].point,
                            corners[i + 1 < corners.size() ? i + 1 : 0].point, contacts.chain);
    std::reverse(corners.begin(), corners.end());
  }
  const std::size_t pieces = contacts.chain.size();
  if (!is_found || takes_long(loops, pieces - std::min(pieces, ring.size()))) return contacts;
  for (const std::uint32_t v : contacts.chain) contacts.places.push_back(loops[v].point);
  std::vector<Vec2> sorted = contacts.places;
  std::sort(sorted.begin(), sorted.end(), lexicographic_less);
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return contacts;
  std::vector<std::uint32_t> own = contacts.chain;
  std::sort(own.begin(), own.end());
  if (!encloses_any(loops, contacts.places, own)) contacts.judgement.verdict = Verdict::keeps_form;
  return contacts;
}

Contacts contacts_after(const Rings& loops, const std::vector<Corner>& ring) {
  Contacts contacts;
  contacts.is_ring = true;
  contacts.judgement.verdict = Verdict::unclear;
  if (!is_simple(ring)) return contacts;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 from = ring[i].point, to = ring[i + 1 < ring.size() ? i + 1 : 0].point;
    std::vector<Vec2> touched;
    Rings::Judgement refused;
    loops.for_edges_in(box_of(from, to), [&](std::uint32_t s) {
      const Vec2 a = loops[s].point, b = loops[loops[s].next].point;
      const Meeting how = meeting(from, to, a, b);
      if (how == Meeting::apart) return;
      if (how == Meeting::cross) refused = {Verdict::crosses, s, crossing_of(from, to, a, b)};
      if (how == Meeting::touch && run_along(from, to, a, b)) refused = {Verdict::overlaps, s, a};
      if (!lies_inside(a, from, to)) return;
      if (loops[s].flat) refused = {Verdict::crosses, s, a};  // both points lie inside an edge
      touched.push_back(a);
    });
    if (refused.edge != none) {
      contacts.judgement = refused;
      return contacts;
    }
    put_in_order(from, to, touched);
    contacts.corners.push_back(static_cast<std::uint32_t>(contacts.ring.size()));
    contacts.ring.push_back(from);
    contacts.ring.insert(contacts.ring.end(), touched.begin(), touched.end());
  }
  contacts.places = contacts.ring;
  contacts.beside = find_beside(loops, contacts.ring);
  if (!takes_long(loops, contacts.ring.size() - ring.size()) &&
      !encloses_any(loops, contacts.ring, {}))
    contacts.judgement.verdict = Verdict::keeps_form;
  return contacts;
}

std::vector<std::uint32_t> vertices_at(const Rings& rings, Vec2 place) {
  std::vector<std::uint32_t> all;
  rings.for_edges_in({place, place}, [&](std::uint32_t v) {
    if (rings[v].point == place) all.push_back(v);
  });
  return all;
}

Contacts find_contacts(const Rings& loops, const Detour& detour) {
  return Finder(loops, detour).run();
}

}  // namespace medial::edit
