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

/// What a loop is among the others.
struct Seat {
  std::uint32_t loop = none, first = none, component = 0;
  bool hole = false;
  bool is_old = false;  ///< the loop was there before, as its corners are listed
};

/// One edit: the vertex `old` between `before` and `after` gives way to the vertex `fresh` at a
/// place; either may be none. Or a whole loop gives way to another one; either may be empty.
struct Edit {
  std::uint32_t before = none, after = none;
  std::uint32_t old = none, fresh = none;
  Vec2 place;                     ///< of `fresh`, in units of the input
  std::array<double, 2> bulge{};  ///< of the edges that begin at `before` and at `fresh`
  std::vector<Corner> out, in;
  /// What the loop that changes or comes shall be, if known: so all comes back as it was.
  std::optional<Seat> seat = std::nullopt;
  double bulge_before = 0;  ///< of the edge that begins at `before`, where this takes an edit back

  bool is_of_loops() const { return !out.empty() || !in.empty(); }
};

Box box_of(const BulgeArc& edge);

/// The loops of a shape as linked lists of vertices, whose numbers stay while others come and go. A
/// vertex's number is also that of the edge that begins there. A vertex is flat where its edges are
/// straight and go on in one line: the shape has no vertex there. Sites have numbers too: 2 v is
/// the vertex v, which is a site where it is reflex, and 2 v + 1 the site that begins there and
/// ends at the next vertex that is not flat.
class Rings {
 public:
  struct Vertex {
    Vec2 point;  ///< in units of the input
    double bulge = 0;
    std::uint32_t next = none, before = none;
    std::uint32_t loop = none;  ///< none: there is no such vertex
    site::Joint joint = site::Joint::corner;
    bool flat = false;
    /// Another vertex lies there: see find_touches(). Such a one is not flat.
    bool touches = false;
  };
  /// What decides how edges join with arcs: in units of the input, and in degrees.
  struct Joining {
    double tolerance = 0, corner_angle = 0;
  };

  Rings() = default;
  /// The vertices have the numbers of the shape's points.
  Rings(const Shape& shape, const LocalFrame& frame, const Joining& joining);
  /// Takes over the order, directions and nesting of a shape that was built from rings(), whose
  /// sources name vertices by their numbers. False, and nothing happens, where its loops are
  /// others.
  bool adopt(const Shape& shape, const LocalFrame& frame, const Joining& joining);

  std::size_t size() const { return vertices_.size(); }
  const Vertex& operator[](std::uint32_t v) const { return vertices_[v]; }
  bool has(std::uint32_t v) const { return v < vertices_.size() && vertices_[v].loop != none; }
  std::uint32_t loop_size(std::uint32_t loop) const { return loops_[loop].size; }
  std::uint32_t component(std::uint32_t loop) const { return loops_[loop].component; }
  bool is_hole(std::uint32_t loop) const { return loops_[loop].hole; }
  bool has_arcs() const { return arcs_ > 0; }
  /// The same after an edit.
  bool has_arcs_after(const Edit& edit) const;
  bool is_reflex(std::uint32_t v) const { return vertices_[v].joint == site::Joint::reflex; }
  /// A vertex of a hole in an outer loop; none if it has no hole.
  std::uint32_t hole_in(std::uint32_t loop) const;
  Seat seat_of(std::uint32_t loop) const;
  /// Of a loop that comes into the interior beside the edge that begins at a vertex; or none: of an
  /// outer one.
  Seat seat_beside(std::uint32_t vertex) const;
  /// A vertex of a loop that is not flat.
  std::uint32_t first_of(std::uint32_t loop) const { return corner_to(loops_[loop].first); }
  const LocalFrame& frame() const { return frame_; }
  const Joining& joining() const { return joining_; }
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
  /// A site in the local frame: in two pieces where it is an arc of more than a quarter of a
  /// circle.
  site::Pieces pieces(std::uint32_t site) const {
    const std::uint32_t v = site / 2;
    if (!is_edge(site)) return {{site::make_vertex(local(v))}, 1};
    return site::pieces_of(local(v), local(corner_after(v)), vertices_[v].bulge);
  }
  /// The piece nearest to a place.
  site::Site site_near(std::uint32_t site, Vec2 local) const;
  /// Adds the pieces of a site to a list.
  void add_pieces(std::uint32_t site, std::vector<site::Site>& pieces) const;

  enum class Verdict : std::uint8_t {
    keeps_form,  ///< the loops can move there without touching each other on the way
    crosses,     ///< edges would cross
    overlaps,    ///< edges would run along each other; only of find_contacts()
    unclear,     ///< what becomes of the shape is for build_shape() to find out
  };
  struct Judgement {
    Verdict verdict = Verdict::keeps_form;
    std::uint32_t edge = none;  ///< that a new one crosses,
    Vec2 point;                 ///< where
  };
  Judgement judge(const Edit& edit) const;
  /// Adds what the edges that come reach to a box.
  void add_reach(const Edit& edit, Box& box) const;

  /// A site and where it ends.
  struct Extent {
    std::uint32_t site, end;
    double bulge;
    bool operator==(const Extent&) const = default;
  };
  /// The sites that an edit can change, before or after apply().
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
  /// The arc of the circle that is this disk of the local frame; none where there is none.
  std::uint32_t arc_of(const Disk& circle) const;
  /// Nothing happens where it throws, but that what goes out is gone where a loop comes as well.
  /// An edit that is not followed leaves loops as build_shape() is to take them: a loop that comes
  /// may touch others, and these have the wrong direction. O(n) then.
  void apply(const Edit& edit, bool is_followed = true);
  /// The edit that takes this one back. Before apply(). While no shape is adopted, or as long as
  /// its seat is reset then, all comes back in its old order; and without a search or new memory.
  /// Not so of loops that a Weaver changes: they may begin elsewhere.
  Edit inverse(const Edit& edit) const;
  /// The box of all edges.
  Box box() const { return boxes_.all(); }
  /// Notes at which vertices others lie, if any do, and which are flat then. O(n log n).
  void find_touches(bool any = true);
  /// A number for a new vertex.
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
  /// The same of the loops of one component, as if there were no others.
  Shape shape_of(std::vector<std::uint32_t> loops) const;
  /// How the components count in shape().
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
  /// The loops that there are: component after component, the outer one first.
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
  /// Of the vertices at the place of one, that whose interior a place nearby lies in, or none.
  std::uint32_t opening_to(std::uint32_t v, Vec2 p) const;
  /// See around(), where the edge that begins at a vertex is nearest: up to rounding.
  Around beside(std::uint32_t v, Vec2 place) const;
  /// The squared distance of a place from the edge that begins at a vertex, in units of the input.
  double squared_distance(std::uint32_t v, Vec2 place) const;
  bool is_on_left(std::uint32_t v, Vec2 place) const {
    return orientation(vertices_[v].point, vertices_[vertices_[v].next].point, place) > 0;
  }
  /// The component whose interior a place lies in, or none. Exact without arcs. O(n).
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
  /// Which of these are flat, and how the others join.
  void judge(std::span<const std::uint32_t> vertices);
  void set_box(std::uint32_t v);
  void take_out(std::uint32_t loop);
  void put_in(const Edit& edit, bool is_followed);
  /// Of a loop that comes, by a place of it, where it keeps clear of all others.
  Seat find_seat(Vec2 place) const;
  /// The same by the place of it that is furthest from all others, whatever their directions.
  Seat find_seat_anew(const std::vector<Corner>& corners) const;

  Judgement judge_straight(const Edit& edit) const;
  Judgement judge_with_arcs(const Edit& edit) const;
  Judgement judge_out(const Edit& edit) const;
  Judgement judge_in(const Edit& edit) const;
  /// The loops other than this one whose boundary comes near to a box, each with a vertex.
  std::vector<std::uint32_t> loops_near(const Box& box, std::uint32_t but) const;

  LocalFrame frame_;
  Joining joining_;
  std::size_t arcs_ = 0;  ///< edges with a bulge
  std::vector<Vertex> vertices_;
  std::vector<Loop> loops_;  ///< of size 0: there is none
  BoxLevels boxes_;          ///< of edges, in units of the input
};

}  // namespace medial::edit
