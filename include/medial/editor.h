#pragma once

#include "medial/compute.h"

namespace medial {

/// What an edit has changed. Take out what is removed first: new nodes and edges may get the
/// numbers of removed ones.
struct AxisChange {
  std::vector<std::uint32_t> removed_nodes, removed_edges, added_nodes, added_edges;
  std::uint32_t vertex = 0;  ///< that was moved, inserted or removed
  bool everything = false;   ///< computed again as a whole: all nodes and edges before are removed
};

/// A shape of straight edges with its medial axis, which follows when vertices are moved, inserted
/// or removed: the graph of compute(), repaired where an edit changes it, in O(k log n) for k
/// changed edges. Vertices keep their numbers; so do sites, nodes and edges, except where
/// AxisChange::everything is set. A new editor counts vertices as the shape does.
///
/// An edit that is an error changes nothing. Errors: crossing (with the place, and an edge's first
/// vertex), not_finite, too_few_points (a loop of three vertices), invalid_option (no such vertex),
/// those of build_shape() and compute(). Where edges come to touch, where a loop turns
/// inside out, and where the whole axis changes, all is computed again.
class Editor {
 public:
  /// Errors: unsupported (arcs, other methods, Options::exact and Options::exterior), and those of
  /// compute(). `progress` and `cancel` are for make() alone.
  static Result<Editor> make(const Shape& shape, const Options& options = {});
  Editor(const Editor& other);
  Editor(Editor&&) noexcept;
  Editor& operator=(Editor other) noexcept;
  ~Editor();

  Result<AxisChange> move(std::uint32_t vertex, Vec2 to);
  /// On the edge that begins at the vertex `before`.
  Result<AxisChange> insert(std::uint32_t before, Vec2 point);
  Result<AxisChange> remove(std::uint32_t vertex);
  /// Takes the last edit back, and those before, one by one; nothing where there is none.
  Result<AxisChange> undo();

  std::optional<Vec2> vertex(std::uint32_t number) const;
  std::optional<Node> node(std::uint32_t number) const;
  std::optional<Edge> edge(std::uint32_t number) const;  ///< names nodes and sites by their numbers
  std::optional<Site> site(std::uint32_t number) const;  ///< Site::vertex: where it begins
  /// As a whole, in O(n). The shape's sources name vertices by their numbers; nodes, edges and
  /// sites count from 0, without gaps.
  Shape shape() const;
  MedialAxis axis() const;

 private:
  struct Parts;
  explicit Editor(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace medial
