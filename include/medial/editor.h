#pragma once

#include "medial/compute.h"

namespace medial {

/// What an edit has changed. Apply removals first: new nodes and edges may get their numbers.
struct AxisChange {
  std::vector<std::uint32_t> removed_nodes, removed_edges, added_nodes, added_edges;
  std::uint32_t vertex = 0;  ///< the vertex moved, inserted or removed; of a loop its first one
  bool everything = false;   ///< all was computed again, and all earlier nodes and edges removed
};

/// A shape and its medial axis, kept up to date while vertices, edges and loops change. The axis is
/// the graph of compute(); an edit repairs it where it changes, in O(k log n) for k changed edges.
/// Vertices keep their numbers; so do sites, nodes and edges, unless AxisChange::everything is set.
/// A new editor numbers vertices as the shape does.
/// An edit that fails changes nothing. Errors: crossing (with the place, and an edge's first
/// vertex), not_finite, too_few_points (of a loop), invalid_option (an unknown vertex), those of
/// build_shape() and compute(). All is computed again if arcs or many edges begin or cease to
/// touch, or the whole axis changes; docs/editor.md lists it all.
class Editor {
 public:
  /// Errors: unsupported (other methods, Options::exact and Options::exterior), and those of
  /// compute(). Only make() uses `progress` and `cancel`.
  static Result<Editor> make(const Shape& shape, const Options& options = {});
  Editor(const Editor& other);
  Editor(Editor&&) noexcept;
  Editor& operator=(Editor other) noexcept;
  ~Editor();

  Result<AxisChange> move(std::uint32_t vertex, Vec2 to);
  /// Inserts a vertex on the edge that begins at `before`; an arc becomes two of one circle.
  Result<AxisChange> insert(std::uint32_t before, Vec2 point);
  Result<AxisChange> remove(std::uint32_t vertex);  ///< two arcs become one that turns by as much
  Result<AxisChange> set_bulge(std::uint32_t vertex, double bulge);  ///< of the edge after it
  /// Inserts a hole or an outer loop, by where it lies; its vertices get consecutive numbers.
  Result<AxisChange> insert_loop(const Ring& ring);
  Result<AxisChange> remove_loop(std::uint32_t vertex);  ///< the loop that the vertex lies on
  Result<AxisChange> move_loop(std::uint32_t vertex, Vec2 by);
  Result<AxisChange> undo();  ///< the last edit that changed something and is not undone yet

  std::optional<Vec2> vertex(std::uint32_t number) const;
  std::optional<double> bulge(std::uint32_t vertex) const;
  std::optional<Node> node(std::uint32_t number) const;
  std::optional<Edge> edge(std::uint32_t number) const;  ///< names nodes and sites by number
  std::optional<Site> site(std::uint32_t number) const;  ///< Site::vertex: where it begins
  /// The whole shape or axis, in O(n). The shape's sources give the numbers of vertices; nodes,
  /// edges and sites of the axis count from 0 without gaps.
  Shape shape() const;
  MedialAxis axis() const;

 private:
  struct Parts;
  explicit Editor(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace medial
