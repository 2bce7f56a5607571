#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "methods/edit/rings.h"

namespace medial::edit {

/// An edit of straight edges by its places: the edges between two of them give way to others; by an
/// old vertex, and by a fresh one, or by none.
struct Detour {
  Vec2 from, to;
  std::optional<Vec2> old, fresh;
};

/// How the edges of a detour touch others, before it or after it, while nothing meets them on the
/// way: the vertex moves straight to its place. Or how a whole ring does, that goes or comes.
struct Contacts {
  Rings::Judgement judgement;
  Detour detour;  ///< in the direction of the loops
  bool is_ring = false;
  std::vector<std::uint32_t> chain;  ///< vertices of the loops: where pieces of the old edges begin
  std::size_t middle = 0;            ///< which of them is the old one; 0: none
  std::vector<Vec2> touched;         ///< places of vertices inside the new edges, along them
  std::size_t touched_on_first = 0;  ///< how many of them are on the first edge
  std::vector<Vec2> ring;            ///< that comes: its corners and what its edges touch, along it
  std::vector<std::uint32_t> corners;  ///< of a ring that comes: places in `ring`
  /// A vertex of the loops at the beginning of an edge of the interior around a ring that comes;
  /// none: it comes as an outer loop.
  std::uint32_t beside = none;
  std::vector<Vec2> places;  ///< where the edit can change sites
};
/// The vertices at a place.
std::vector<std::uint32_t> vertices_at(const Rings& rings, Vec2 place);
Contacts find_contacts(const Rings& loops, const Detour& detour);
/// Of a ring that has no others inside and does not touch itself: that goes,
Contacts contacts_before(const Rings& loops, const std::vector<Corner>& ring);
/// and that comes.
Contacts contacts_after(const Rings& loops, const std::vector<Corner>& ring);

}  // namespace medial::edit
