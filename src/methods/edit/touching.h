#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "methods/edit/rings.h"

namespace medial::edit {

/// Where edges touch, the edited rings differ from the loops of the shape: a loop may continue
/// along another ring, and has a vertex each time it passes the point. This class keeps the rings
/// and the correspondence between their vertices and those of the loops.
class Touching {
 public:
  /// `loops` are the loops of a shape that was built from the rings, whose sources name their
  /// vertices. Adds the flat vertices of the rings to the loops. O(n log n).
  Touching(Rings rings, const Shape& shape, Rings& loops);
  /// Starts with rings that equal the loops. O(n).
  explicit Touching(const Rings& loops);

  Rings& rings() { return rings_; }
  const Rings& rings() const { return rings_; }
  /// The vertex of the rings that corresponds to a vertex of the loops.
  std::uint32_t vertex_at(std::uint32_t of_loops) const { return of_loops_[of_loops]; }
  /// The first vertex, in the rings, of an edge of the loops.
  std::uint32_t edge_at(std::uint32_t of_loops, const Rings& loops) const;
  /// The edit of the loops that corresponds to an edit of the rings. None if its vertex corresponds
  /// to no vertex of the loops, or to several, or if the loops connect the edges in another way.
  std::optional<Edit> of_loops(const Edit& edit, const Rings& loops) const;
  /// Applies an edit to the rings; call it before the loops change. If it throws, nothing has
  /// changed.
  void apply(const Edit& edit, const Rings& loops);
  /// Records the numbers of the new vertices in the loops, once these have changed.
  void note(const Edit& edit, const Edit& of_loops);
  /// Reserves memory, so that the next edit does not throw.
  void make_room(const Rings& loops);
  /// Records the number in the loops, or none, of a vertex of the rings.
  void set_number(std::uint32_t of_rings, std::uint32_t of_loops);
  /// Records the vertices of the rings at places where the loops have new vertices.
  void note(const std::vector<Vec2>& places, const Rings& loops);
  /// The seat among the rings of a ring that is added: see Contacts::beside. None if it is unknown.
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
  std::vector<std::uint32_t> numbers_;   ///< the rings' vertices in the loops; or none
  std::vector<std::uint32_t> of_loops_;  ///< the inverse
};

}  // namespace medial::edit
