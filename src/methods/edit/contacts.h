#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "methods/edit/rings.h"

namespace medial::edit {

/// An edit of straight edges, given by coordinates: new edges from `from` to `to` replace the old
/// ones. Old and new edges meet at `old` and `fresh`, or are a single edge if there is none.
struct Detour {
  Vec2 from, to;
  std::optional<Vec2> old, fresh;
};

/// How the edges of a detour touch other edges before and after the edit. Nothing meets them on the
/// way: the vertex moves straight to its place. Also used for a ring that is added or removed as a
/// whole.
struct Contacts {
  Rings::Judgement judgement;
  Detour detour;  ///< in the direction of the loops
  bool is_ring = false;
  std::vector<std::uint32_t> chain;  ///< vertices of the loops: where pieces of the old edges begin
  std::size_t middle = 0;            ///< index of the old vertex in `chain`; 0: none
  std::vector<Vec2> touched;         ///< places of vertices inside the new edges, along them
  std::size_t touched_on_first = 0;  ///< how many of them are on the first edge
  std::vector<Vec2> ring;            ///< to add: its corners and the points that it touches
  std::vector<std::uint32_t> corners;  ///< indices in `ring` of the corners
  /// The first vertex of an edge that bounds the part of the interior to which a ring is added.
  /// None: the ring becomes an outer loop.
  std::uint32_t beside = none;
  std::vector<Vec2> places;  ///< where the edit can change sites
};
/// The vertices at a place.
std::vector<std::uint32_t> vertices_at(const Rings& rings, Vec2 place);
Contacts find_contacts(const Rings& loops, const Detour& detour);
/// The contacts of a ring to remove. It must have no other rings inside and must not touch itself.
Contacts contacts_before(const Rings& loops, const std::vector<Corner>& ring);
/// The contacts of a ring to add, with the same requirements.
Contacts contacts_after(const Rings& loops, const std::vector<Corner>& ring);

}  // namespace medial::edit
