#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "axis/sites.h"
#include "base/arc.h"
#include "base/local_frame.h"
#include "base/numbers.h"
#include "base/predicates.h"
#include "medial/axis.h"
#include "medial/error.h"
#include "medial/shape.h"
#include "methods/edit/box_levels.h"
#include "site/site.h"

namespace medial::edit {

/// A vertex of a whole loop, and the edge that begins there.
struct Corner {
  std::uint32_t number = none;
  Vec2 point;  ///< in units of the input
  double bulge = 0;
};

/// The position of a loop among the others.
struct Seat {
  std::uint32_t loop = none, first = none, component = 0;
  bool hole = false;
  bool is_old = false;  ///< the loop existed before, with its corners in the same order
};

/// One edit: the vertex `fresh` replaces the vertex `old` between `before` and `after`; either may
/// be none. Or the loop `in` replaces the loop `out`; either may be empty.
struct Edit {
  std::uint32_t before = none, after = none;
  std::uint32_t old = none, fresh = none;
  Vec2 place;                     ///< of `fresh`, in units of the input
  std::array<double, 2> bulge{};  ///< of the edges that begin at `before` and at `fresh`
  std::vector<Corner> out, in;
  /// The position of the loop that changes or is added, if known; undoing an edit restores it.
  std::optional<Seat> seat = std::nullopt;
  double bulge_before = 0;  ///< of the edge that begins at `before`, if this undoes an edit

  bool is_of_loops() const { return !out.empty() || !in.empty(); }
};

Box box_of(const BulgeArc& edge);

/// The loops of a shape as linked lists of vertices, whose numbers stay the same while other
/// vertices are added and removed. A vertex's number is also the number of the edge that begins
/// there. A vertex between two collinear straight edges is flat: the shape has no vertex there.
/// Sites are numbered, too: 2 v is the vertex v, which is a site if it is reflex, and 2 v + 1 is
/// the site that begins there and ends at the next vertex that is not flat.
class Rings {
 public:
  struct Vertex {
    Vec2 point;  ///< in units of the input
    double bulge = 0;
    std::uint32_t next = none, before = none;
    std::uint32_t loop = none;  ///< none: the vertex does not exist
    site::Joint joint = site::Joint::corner;
    bool flat = false;
    /// Another vertex has the same coordinates: see find_touches(). Such a vertex is not flat.
    bool touches = false;
  };
  /// The options that decide how edges join next to arcs: in units of the input, and in degrees.
  struct Joining {
    double tolerance = 0, corner_angle = 0;
  };

  Rings() = default;
  /// The vertices have the numbers of the shape's points.
  Rings(const Shape& shape, const LocalFrame& frame, const Joining& joining);
  /// Adopts the order, directions and nesting of a shape that was built from rings(), and whose
  /// sources name vertices by their numbers. Returns false, and changes nothing, if its loops
  /// differ.
  bool adopt(const Shape& shape, const LocalFrame& frame, const Joining& joining);

  std::size_t size() const { return vertices_.size(); }
  const Vertex& operator[](std::uint32_t v) const { return vertices_[v]; }
  bool has(std::uint32_t v) const { return v < vertices_.size() && vertices_[v].loop != none; }
  std::uint32_t loop_size(std::uint32_t loop) const { return loops_[loop].size; }
  std::uint32_t component(std::uint32_t loop) const { return loops_[loop].component; }
  bool is_hole(std::uint32_t loop) const { return loops_[loop].hole; }
  bool has_arcs() const { return arcs_ > 0; }
  /// The same for the rings after an edit.
  bool has_arcs_after(const Edit& edit) const;
  bool is_reflex(std::uint32_t v) const { return vertices_[v].joint == site::Joint::reflex; }
  /// A vertex of a hole in an outer loop; none if the loop has no hole.
  std::uint32_t hole_in(std::uint32_t loop) const;
  Seat seat_of(std::uint32_t loop) const;
  /// The seat of a loop that is added to the interior next to the edge that begins at a vertex;
  /// none: of a new outer loop.
  Seat seat_beside(std::uint32_t vertex) const;
  /// The first vertex of a loop that is not flat.
  std::uint32_t first_of(std::uint32_t loop) const { return corner_to(loops_[loop].first); }
  const LocalFrame& frame() const { return frame_; }
  const Joining& joining() const { return joining_; }
  /// The next vertex that is not flat.
  std::uint32_t corner_after(std::uint32_t v) const {
    do v = vertices_[v].next;
    while (vertices_[v].flat);
    return v;
  }
  std::uint32_t corner_before(std::uint32_t v) const { return corner_to(vertices_[v].before); }

  static std::uint32_t vertex_of(std::uint32_t site) { return site / 2; }
  static bool is_edge(std::uint32_t site) { return site % 2 == 1; }
  bool is_site(std::uint32_t site) const {
    return has(site / 2) && !vertices_[site / 2].flat && (is_edge(site) || is_reflex(site / 2));
  }
  std::uint32_t next_site(std::uint32_t site) const {
    if (!is_edge(site)) return site + 1;
    const std::uint32_t after = corner_after(site / 2);
    return first_site(after);
  }
  std::uint32_t site_before(std::uint32_t site) const {
    const bool follows_vertex = is_edge(site) && is_reflex(site / 2);
    return follows_vertex ? site - 1 : 2 * corner_before(site / 2) + 1;
  }
  Vec2 local(std::uint32_t v) const { return frame_.to_local(vertices_[v].point); }
  /// A site in the local frame: two pieces if it is an arc of more than a quarter circle.
  site::Pieces pieces(std::uint32_t site) const {
    const std::uint32_t v = site / 2;
    if (!is_edge(site)) return {{site::make_vertex(local(v))}, 1};
    return site::pieces_of(local(v), local(corner_after(v)), vertices_[v].bulge);
  }
  /// The piece of a site that is nearest to a point.
  site::Site site_near(std::uint32_t site, Vec2 local) const;
  /// Appends the pieces of a site.
  void add_pieces(std::uint32_t site, std::vector<site::Site>& pieces) const;

  enum class Verdict : std::uint8_t {
    keeps_form,  ///< the loops can move there without touching each other on the way
    crosses,     ///< edges would cross
    overlaps,    ///< edges would run along each other; only of find_contacts()
    unclear,     ///< only build_shape() can tell what the shape becomes
  };
  struct Judgement {
    Verdict verdict = Verdict::keeps_form;
    std::uint32_t edge = none;  ///< the edge that a new one crosses,
    Vec2 point;                 ///< and where
  };
  Judgement judge(const Edit& edit) const;
  /// Extends a box by the edges that are added.
  void add_reach(const Edit& edit, Box& box) const;

  /// A site and its ends.
  struct Extent {
    std::uint32_t site, end;
    double bulge;
    bool operator==(const Extent&) const = default;
  };
  /// The sites that an edit can change; call it before or after apply().
  std::vector<Extent> sites_around(const Edit& edit) const;
  /// The sites at some places.
  std::vector<Extent> sites_at(const std::vector<Vec2>& places) const;
  /// Calls visit(vertex) for the edges whose boxes meet `box`.
  template <class Visit>
  void for_edges_in(const Box& box, const Visit& visit) const {
    boxes_.find(box, visit);
  }
  /// The site nearest to a place in the interior, none where the place is not inside, and how far
  /// away the boundary is. Without arcs, whether it is inside is exact; with arcs it is certain
  /// some tolerances from the boundary.
  struct Around {
    std::uint32_t site = none;
    double away = 0;
  };
  Around around(Vec2 place) const;
  /// The arc that lies on this circle, given as a disk in the local frame; none if there is none.
  std::uint32_t arc_of(const Disk& circle) const;
  /// Applies an edit. If it throws, nothing has changed, except that where one loop replaces
  /// another the old one has been removed. With `is_followed` false, loops stay as input for
  /// build_shape(): a new loop may touch others, which then have the wrong direction, and it takes
  /// O(n).
  void apply(const Edit& edit, bool is_followed = true);
  /// The edit that undoes this one; call it before apply(). Applying it restores the old order,
  /// without a search or allocation, as long as no shape is adopted in between or the seat is
  /// reset. Loops that a Weaver changes may begin elsewhere afterwards.
  Edit inverse(const Edit& edit) const;
  /// The box of all edges.
  Box box() const { return boxes_.all(); }
  /// Finds which vertices have the same coordinates, if `any` do, and updates which are flat. O(n
  /// log n).
  void find_touches(bool any = true);
  /// The number for a new vertex.
  std::uint32_t unused() const { return static_cast<std::uint32_t>(vertices_.size()); }

  /// Calls visit(site) for all sites, loop after loop, as the result of compute() lists them.
  template <class Visit>
  void for_sites(const Visit& visit) const {
    for (const std::uint32_t loop : loops()) for_sites_of(loop, visit);
  }
  template <class Visit>
  void for_sites_of(std::uint32_t loop, const Visit& visit) const {
    const std::uint32_t first = first_site(first_of(loop));
    std::uint32_t site = first;
    do {
      visit(site);
      site = next_site(site);
    } while (site != first);
  }
  Shape shape() const;
  /// The shape of the loops of one component, as if there were no others.
  Shape shape_of(std::vector<std::uint32_t> loops) const;
  /// The numbers of the components in shape().
  std::vector<std::uint32_t> component_numbers() const;
  /// The loops as rings, in their order, and the numbers of their vertices.
  std::vector<Ring> rings(std::vector<std::vector<std::uint32_t>>& numbers) const;

 private:
  friend class Weaver;
  struct Loop {
    std::uint32_t first = none, size = 0, component = 0;
    bool hole = false;
  };
  std::uint32_t corner_to(std::uint32_t v) const {
    while (vertices_[v].flat) v = vertices_[v].before;
    return v;
  }
  std::uint32_t first_site(std::uint32_t corner) const {
    return 2 * corner + (is_reflex(corner) ? 0 : 1);
  }
  /// All existing loops: component after component, the outer loop first.
  std::vector<std::uint32_t> loops() const;
  template <class Visit>
  void for_vertices(std::uint32_t loop, const Visit& visit) const {
    std::uint32_t v = loops_[loop].first;
    do {
      const std::uint32_t next = vertices_[v].next;
      visit(v);
      v = next;
    } while (v != loops_[loop].first);
  }
  /// Of the vertices at the same point as `v`, the one whose interior angle contains a nearby
  /// point; or none.
  std::uint32_t opening_to(std::uint32_t v, Vec2 p) const;
  /// The result of around() if the edge that begins at `v` is the nearest one, up to rounding.
  Around beside(std::uint32_t v, Vec2 place) const;
  /// The squared distance of a point from the edge that begins at a vertex, in units of the input.
  double squared_distance(std::uint32_t v, Vec2 place) const;
  bool is_on_left(std::uint32_t v, Vec2 place) const {
    return orientation(vertices_[v].point, vertices_[vertices_[v].next].point, place) > 0;
  }
  /// The component whose interior contains a point, or none. Exact without arcs. O(n).
  std::uint32_t component_around(Vec2 place) const;
  Extent extent_of(std::uint32_t site) const;
  void append(std::uint32_t loop, std::uint32_t ring, std::uint32_t component, Shape& shape) const;
  BulgeArc edge(std::uint32_t v) const {
    return {vertices_[v].point, vertices_[vertices_[v].next].point, vertices_[v].bulge};
  }
  BulgeArc local_edge(std::uint32_t v) const {
    return {local(v), local(vertices_[v].next), vertices_[v].bulge};
  }
  void set_bulge(std::uint32_t v, double bulge);
  bool is_flat(std::uint32_t v) const;
  void set_touches(std::uint32_t v, bool touches);
  site::Joint joint_at(std::uint32_t v) const;
  /// Updates which of these vertices are flat, and how the edges join at the others.
  void judge(std::span<const std::uint32_t> vertices);
  void set_box(std::uint32_t v);
  void take_out(std::uint32_t loop);
  void put_in(const Edit& edit, bool is_followed);
  /// The seat of a loop that is added, from a point of it at which it touches no other loop.
  Seat find_seat(Vec2 place) const;
  /// The same from a corner or the middle of an edge: the first one that is more than 64 tolerances
  /// from all other loops, or else the furthest one. The directions of the loops do not matter.
  Seat find_seat_anew(const std::vector<Corner>& corners) const;

  Judgement judge_straight(const Edit& edit) const;
  Judgement judge_with_arcs(const Edit& edit) const;
  Judgement judge_out(const Edit& edit) const;
  Judgement judge_in(const Edit& edit) const;
  /// One vertex of each loop, except `but`, whose boundary is close to a box.
  std::vector<std::uint32_t> loops_near(const Box& box, std::uint32_t but) const;

  LocalFrame frame_;
  Joining joining_;
  std::size_t arcs_ = 0;  ///< edges with a bulge
  std::vector<Vertex> vertices_;
  std::vector<Loop> loops_;  ///< size 0: the loop does not exist
  BoxLevels boxes_;          ///< of edges, in units of the input
};

}  // namespace medial::edit
