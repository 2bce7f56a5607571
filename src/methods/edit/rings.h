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
/// others come and go. A vertex's number is also that of the edge that begins there. A vertex is
/// flat where its edges go on straight: the shape has no vertex there. Sites have numbers too: 2 v
/// is the vertex v, which is a site where it is reflex, and 2 v + 1 the site that begins there and
/// ends at the next vertex that is not flat.
class Rings {
 public:
  struct Vertex {
    Vec2 point;  ///< in units of the input
    std::uint32_t next = none, before = none;
    std::uint32_t loop = none;  ///< none: there is no such vertex
    bool reflex = false, flat = false;
  };

  Rings() = default;
  /// The vertices have the numbers of the shape's points.
  Rings(const Shape& shape, const LocalFrame& frame);
  /// Takes over the order, directions and nesting of a shape that was built from rings(), whose
  /// sources name vertices by their numbers. False, and nothing happens, where its loops are
  /// others.
  bool adopt(const Shape& shape, const LocalFrame& frame);

  std::size_t size() const { return vertices_.size(); }
  const Vertex& operator[](std::uint32_t v) const { return vertices_[v]; }
  bool has(std::uint32_t v) const { return v < vertices_.size() && vertices_[v].loop != none; }
  std::uint32_t loop_size(std::uint32_t loop) const { return loops_[loop].size; }
  std::uint32_t component(std::uint32_t loop) const { return loops_[loop].component; }
  /// A vertex of a loop that is not flat.
  std::uint32_t first_of(std::uint32_t loop) const { return corner_to(loops_[loop].first); }
  const LocalFrame& frame() const { return frame_; }
  void set_frame(const LocalFrame& frame) { frame_ = frame; }
  /// The next vertex, and the one before, that is not flat.
  std::uint32_t corner_after(std::uint32_t v) const {
    do v = vertices_[v].next;
    while (vertices_[v].flat);
    return v;
  }
  std::uint32_t corner_before(std::uint32_t v) const { return corner_to(vertices_[v].before); }

  static std::uint32_t vertex_of(std::uint32_t site) { return site / 2; }
  static bool is_edge(std::uint32_t site) { return site % 2 == 1; }
  bool is_site(std::uint32_t site) const {
    return has(site / 2) && !vertices_[site / 2].flat &&
           (is_edge(site) || vertices_[site / 2].reflex);
  }
  std::uint32_t next_site(std::uint32_t site) const {
    if (!is_edge(site)) return site + 1;
    const std::uint32_t after = corner_after(site / 2);
    return 2 * after + (vertices_[after].reflex ? 0 : 1);
  }
  Vec2 local(std::uint32_t v) const { return frame_.to_local(vertices_[v].point); }
  site::Site site(std::uint32_t site) const {
    if (!is_edge(site)) return site::make_vertex(local(site / 2));
    return site::make_segment(local(site / 2), local(corner_after(site / 2)));
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

  /// A site and where it ends.
  struct Extent {
    std::uint32_t site, end;
  };
  /// The sites that an edit can change, before or after apply().
  std::vector<Extent> sites_around(const Edit& edit) const;
  void apply(const Edit& edit);  ///< nothing happens where it throws
  /// The edit that takes this one back. Before apply().
  Edit inverse(const Edit& edit) const;
  /// A number for a new vertex.
  std::uint32_t unused() const { return static_cast<std::uint32_t>(vertices_.size()); }

  /// Calls visit(site) for all sites, loop after loop, as the result of compute() lists them.
  template <class Visit>
  void for_sites(const Visit& visit) const {
    for (const Loop& loop : loops_) {
      const std::uint32_t corner = corner_to(loop.first);
      const std::uint32_t first = 2 * corner + (vertices_[corner].reflex ? 0 : 1);
      std::uint32_t site = first;
      do {
        visit(site);
        site = next_site(site);
      } while (site != first);
    }
  }
  Shape shape() const;
  /// The loops as rings, in their order, and the numbers of their vertices.
  std::vector<Ring> rings(std::vector<std::vector<std::uint32_t>>& numbers) const;

 private:
  struct Loop {
    std::uint32_t first = 0, size = 0, component = 0;
    bool hole = false;
  };
  std::uint32_t corner_to(std::uint32_t v) const {
    while (vertices_[v].flat) v = vertices_[v].before;
    return v;
  }
  bool is_flat(std::uint32_t v) const;
  bool is_reflex(std::uint32_t v) const;
  void set_box(std::uint32_t v);

  LocalFrame frame_;
  std::vector<Vertex> vertices_;
  std::vector<Loop> loops_;
  BoxLevels boxes_;  ///< of edges, in units of the input
};

}  // namespace medial::edit
