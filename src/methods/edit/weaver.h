#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "methods/edit/contacts.h"

namespace medial::edit {

/// Applies an edit with contacts to the loops: separates the old edges from all that they touch,
/// and joins the new ones to all that they touch, so that the wedges of the interior around each
/// point follow each other. O(k log n), and O(m) if a loop of m vertices is cut off another one or
/// merged into a larger one.
class Weaver {
 public:
  /// `drawn` are the edited rings, after the edit.
  Weaver(Rings& loops, const Rings& drawn) : loops_(loops), drawn_(drawn), size_(loops.size()) {}

  /// Returns false if it would take too long to find out which loops contain which. Then, and if it
  /// throws, call take_back().
  bool make(const Contacts& contacts);
  /// Restores the state before make().
  void take_back();
  /// The vertex of the loops that is the fresh one, and the one that has moved; or none.
  std::uint32_t fresh() const { return fresh_; }
  std::uint32_t moved() const { return moved_; }
  /// The vertices of the loops that are the corners of the ring that was added.
  const std::vector<std::uint32_t>& corners() const { return corners_; }
  /// The change of the number of components less holes.
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
  bool take_out(const Contacts& contacts);
  bool put_in(const Contacts& contacts);
  void part(const Contacts& contacts);
  void make_whole(Vec2 place, std::uint32_t own);
  void divide_at(Vec2 place);
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
  const std::size_t size_;  ///< the number of vertices before
  std::vector<Vec2> places_;
  std::uint32_t fresh_ = none, moved_ = none;
  std::vector<std::uint32_t> corners_;
  int parts_ = 0;
  // The previous values, in the order of the changes.
  std::vector<std::pair<std::uint32_t, Vertex>> old_vertices_;
  std::vector<std::pair<std::uint32_t, Loop>> old_loops_;
};

}  // namespace medial::edit
