#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
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
/// way: the vertex moves straight to its place.
struct Contacts {
  Rings::Judgement judgement;
  Detour detour;                     ///< in the direction of the loops
  std::vector<std::uint32_t> chain;  ///< vertices of the loops: where pieces of the old edges begin
  std::size_t middle = 0;            ///< which of them is the old one; 0: none
  std::vector<Vec2> touched;         ///< places of vertices inside the new edges, along them
  std::size_t touched_on_first = 0;  ///< how many of them are on the first edge
  std::vector<Vec2> places;          ///< where the edit can change sites
};
/// The vertices at a place.
std::vector<std::uint32_t> vertices_at(const Rings& rings, Vec2 place);
Contacts find_contacts(const Rings& loops, const Detour& detour);

/// Makes such an edit of the loops: parts the old edges from all that they touch, and joins the new
/// ones to all that they touch, so that the interior's wedges around each place follow each other.
/// In O(k log n), and O(m) where a loop of m vertices is cut off another one or joins a larger one.
class Weaver {
 public:
  /// `drawn`: the rings that are edited, as they are after the edit.
  Weaver(Rings& loops, const Rings& drawn) : loops_(loops), drawn_(drawn), size_(loops.size()) {}

  /// False where it takes long to find out which loops are in which. Then, and where it throws,
  /// take_back() is to be called.
  bool make(const Contacts& contacts);
  /// Everything becomes as it was.
  void take_back();
  /// The vertex of the loops that is the fresh one, and the one that has moved; or none.
  std::uint32_t fresh() const { return fresh_; }
  std::uint32_t moved() const { return moved_; }
  /// So many more components the interior has now, less holes.
  int parts() const { return parts_; }

 private:
  using Vertex = Rings::Vertex;
  using Loop = Rings::Loop;

  Vertex& vertex(std::uint32_t v);
  Loop& loop(std::uint32_t l);
  std::uint32_t new_vertex();
  void link(std::uint32_t before, std::uint32_t after);
  void insert_after(std::uint32_t before, std::uint32_t v, Vec2 place);
  void drop(std::uint32_t v);
  void part(const Contacts& contacts);
  void set_middle(const Contacts& contacts);
  bool join_at(std::uint32_t own);
  void judge_places();
  bool exchange(std::uint32_t first, std::uint32_t second, bool joins);
  bool split(std::uint32_t first, std::uint32_t second, bool joins);
  bool merge(std::uint32_t first, std::uint32_t second, bool joins);
  bool is_place(Vec2 p) const;
  bool move_holes(std::uint32_t outer, std::uint32_t component, std::uint32_t but);

  Rings& loops_;
  const Rings& drawn_;
  const std::size_t size_;  ///< how many vertices there were before
  std::vector<Vec2> places_;
  std::uint32_t fresh_ = none, moved_ = none;
  int parts_ = 0;
  // What was there before, in the order of the changes.
  std::vector<std::pair<std::uint32_t, Vertex>> old_vertices_;
  std::vector<std::pair<std::uint32_t, Loop>> old_loops_;
};

}  // namespace medial::edit
