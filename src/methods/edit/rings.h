#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/local_frame.h"
#include "medial/error.h"
#include "medial/shape.h"
#include "methods/edit/box_levels.h"
#include "site/site.h"

namespace medial::edit {

constexpr std::uint32_t none = ~std::uint32_t{0};

/// One edit: the vertex `old` between `before` and `after` gives way to the vertex `fresh` at a
/// place; either may be none.
struct Edit {
  std::uint32_t before = none, after = none;
  std::uint32_t old = none, fresh = none;
  Vec2 place;  ///< of `fresh`, in units of the input
};

/// The loops of a shape of straight edges as linked lists of vertices, whose numbers stay while
/// others come and go. A vertex's number is also that of the edge that begins there. Sites have
/// numbers too: 2 v is the vertex v, which is a site where it is reflex, and 2 v + 1 its edge.
class Rings {
 public:
  struct Vertex {
    Vec2 point;  ///< in units of the input
    std::uint32_t next = none, before = none;
    std::uint32_t loop = none;  ///< none: there is no such vertex
    bool reflex = false;
  };

  Rings() = default;
  /// `numbers`: those of the shape's points, of `size` that have been in use.
  Rings(const Shape& shape, const LocalFrame& frame, const std::vector<std::uint32_t>& numbers,
        std::size_t size);

  std::size_t size() const { return vertices_.size(); }
  const Vertex& operator[](std::uint32_t v) const { return vertices_[v]; }
  bool has(std::uint32_t v) const { return v < vertices_.size() && vertices_[v].loop != none; }
  std::uint32_t loop_size(std::uint32_t loop) const { return loops_[loop].size; }
  bool is_hole(std::uint32_t loop) const { return loops_[loop].hole; }
  std::uint32_t component(std::uint32_t loop) const { return loops_[loop].component; }
  /// A vertex of a loop.
  std::uint32_t first_of(std::uint32_t loop) const { return loops_[loop].first; }
  std::size_t loop_count() const { return loops_.size(); }
  const LocalFrame& frame() const { return frame_; }
  /// Leaves all else as it is.
  void set_frame(const LocalFrame& frame) { frame_ = frame; }

  static std::uint32_t vertex_of(std::uint32_t site) { return site / 2; }
  static bool is_edge(std::uint32_t site) { return site % 2 == 1; }
  bool is_site(std::uint32_t site) const {
    return has(site / 2) && (is_edge(site) || vertices_[site / 2].reflex);
  }
  std::uint32_t next_site(std::uint32_t site) const {
    if (!is_edge(site)) return site + 1;
    const std::uint32_t after = vertices_[site / 2].next;
    return 2 * after + (vertices_[after].reflex ? 0 : 1);
  }
  Vec2 local(std::uint32_t v) const { return frame_.to_local(vertices_[v].point); }
  site::Site site(std::uint32_t site) const {
    if (!is_edge(site)) return site::make_vertex(local(site / 2));
    return site::make_segment(local(site / 2), local(vertices_[site / 2].next));
  }

  enum class Verdict : std::uint8_t {
    keeps_form,  ///< the loops can move there without touching each other on the way
    crosses,     ///< edges would cross
    unclear,     ///< what becomes of the shape is for build_shape() to find out
  };
  struct Judgement {
    Verdict verdict = Verdict::keeps_form;
    std::uint32_t edge = none;  ///< that a new one crosses,
    Vec2 point;                 ///< where
  };
  Judgement judge(const Edit& edit) const;

  /// Sites that an edit takes away, or gives other neighbours to so that they change. Before
  /// apply().
  std::vector<std::uint32_t> changed_sites(const Edit& edit) const;
  void apply(const Edit& edit);
  /// The edit that takes this one back. Before apply().
  Edit inverse(const Edit& edit) const;
  /// A number for a new vertex.
  std::uint32_t unused() const { return static_cast<std::uint32_t>(vertices_.size()); }

  /// Calls visit(site) for all sites, loop after loop, as the result of compute() lists them.
  template <class Visit>
  void for_sites(const Visit& visit) const {
    for (const Loop& loop : loops_) {
      const std::uint32_t first = 2 * loop.first + (vertices_[loop.first].reflex ? 0 : 1);
      std::uint32_t site = first;
      do {
        visit(site);
        site = next_site(site);
      } while (site != first);
    }
  }
  Shape shape() const;
  /// The numbers of the points of a shape whose sources name them; empty where its loops are not
  /// these, but for their directions.
  std::vector<std::uint32_t> numbers_in(const Shape& shape) const;
  /// The loops as rings, in their order, and the numbers of their vertices.
  std::vector<Ring> rings(std::vector<std::vector<std::uint32_t>>& numbers) const;

 private:
  struct Loop {
    std::uint32_t first = 0, size = 0, component = 0;
    bool hole = false;
  };
  Vec2 place_of(const Edit& edit, std::uint32_t v) const {
    return v == edit.fresh ? edit.place : vertices_[v].point;
  }
  bool is_reflex(std::uint32_t v) const;
  void set_box(std::uint32_t v);

  LocalFrame frame_;
  std::vector<Vertex> vertices_;
  std::vector<Loop> loops_;
  BoxLevels boxes_;  ///< of edges, in units of the input
};

}  // namespace medial::edit
