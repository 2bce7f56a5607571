#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "methods/edit/rings.h"

namespace medial::edit {

/// Where edges touch, the rings that are edited are not the loops of the shape: a loop may go on
/// along another ring there, and has a vertex each time it comes by. This keeps the rings, and
/// which vertex of the loops is which of theirs.
class Touching {
 public:
  /// `loops`: those of a shape that was built from the rings, whose sources name their vertices.
  /// Adds the flat vertices of the rings to them. O(n log n).
  Touching(Rings rings, const Shape& shape, Rings& loops);
  /// Where the rings are the loops as yet. O(n).
  explicit Touching(const Rings& loops);

  Rings& rings() { return rings_; }
  const Rings& rings() const { return rings_; }
  /// The vertex of the rings at which a vertex of the loops lies.
  std::uint32_t vertex_at(std::uint32_t of_loops) const { return of_loops_[of_loops]; }
  /// The first vertex, in the rings, of an edge of the loops.
  std::uint32_t edge_at(std::uint32_t of_loops, const Rings& loops) const;
  /// What an edit of the rings is to the loops. None where its vertex is none of
  /// the loops, or several, or the loops go on in another way.
  std::optional<Edit> of_loops(const Edit& edit, const Rings& loops) const;
  /// Makes the edit of the rings, before the loops follow. Nothing happens where it throws.
  void apply(const Edit& edit, const Rings& loops);
  /// Notes how its new vertices are numbered in the loops, once these have followed.
  void note(const Edit& edit, const Edit& of_loops);
  /// Makes room, so that the next does not throw.
  void make_room(const Rings& loops);
  /// Notes the number in the loops, or none, of a vertex of the rings,
  void set_number(std::uint32_t of_rings, std::uint32_t of_loops);
  /// and which vertices of the rings lie at places where the loops have new ones.
  void note(const std::vector<Vec2>& places, const Rings& loops);
  /// What a ring that comes is among the rings: see Contacts::beside. None where it is not known.
  std::optional<Seat> seat_beside(std::uint32_t of_loops, const Rings& loops) const;

 private:
  void add_flat_vertices(Rings& loops);
  void note(std::uint32_t of_rings, std::uint32_t of_loops);
  std::uint32_t number_of(std::uint32_t v) const {
    return v < numbers_.size() ? numbers_[v] : none;
  }
  std::optional<Edit> of_vertices(const Edit& edit, const Rings& loops) const;
  bool is_loop(const std::vector<Corner>& corners, const Rings& loops) const;

  Rings rings_;
  std::vector<std::uint32_t> numbers_;   ///< in the loops, of the rings' vertices; or none
  std::vector<std::uint32_t> of_loops_;  ///< the other way round
};

}  // namespace medial::edit
