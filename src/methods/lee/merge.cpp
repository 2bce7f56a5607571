#include "methods/lee/merge.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "site/bisector.h"
#include "site/tangent_disk.h"

namespace medial::lee {
namespace {

/// Traces the merge curve through two diagrams (Section II). The current bisector is B(e_a, e_b),
/// with a on side 0, the earlier list, and b on side 1. On side s, the stack of the current
/// element, in which it is element[1 - s], holds the edges that the curve may still cross.
template <bool with_arcs>
class MergeCurve {
 public:
  MergeCurve(Diagram& diagram, FreePlaces& free, const MergeLimits& limits, Statistics& statistics)
      : diagram_(diagram),
        free_(free),
        limits_(limits),
        statistics_(statistics),
        contacts_(diagram.elements, limits, statistics) {}

  std::uint32_t follow(std::uint32_t first, std::uint32_t middle, std::uint32_t end) {
    const auto gate = diagram_.gate(middle);
    current_ = gate.element;
    middle_ = middle;
    may_undo_ = end - first;
    disk_ = gate.disk;
    std::uint32_t edge = add_edge();
    while (edge != none) {
      const Along bisector = along(current_[0], current_[1]);
      const double reached = bisector.position(disk_.center);
      State state = drop_covered(0);
      if (state == State::inside) state = drop_covered(1);
      if (state == State::outside) return edge;
      if (state == State::broken) return none;
      if (state == State::tied_wrongly) {
        edge = go_back(edge);
        continue;
      }
      const auto crossing = first_crossing(bisector, reached);
      if (!crossing) return edge;
      ++statistics_.queries;
      const std::size_t side = crossing->side;
      const std::uint32_t crossed = top(side);
      if (!is_same(disk_, crossing->disk))
        is_stored_ = is_same(diagram_.edges[crossed].inner, crossing->disk);
      disk_ = crossing->disk;
      // While its disks are inside the shape, the curve runs below an edge or crosses it.
      if (top(1 - side) != none && is_behind(1 - side, diagram_.edges[top(1 - side)])) return edge;
      current_[side] = diagram_.edges[crossed].element[side];
      if (diagram_.top[current_[side]][side] != crossed) return none;  // two edges cross
      edge = add_edge();
    }
    return none;
  }

 private:
  /// The parameter that orders the disks on a bisector.
  struct Straight {
    Vec2 direction;
    double position(Vec2 center) const { return dot(direction, center); }
  };
  using Along = std::conditional_t<with_arcs, site::Bisector, Straight>;

  /// The bisector B(e_i, e_j), i < j, outward.
  Along along(std::uint32_t i, std::uint32_t j) const {
    if constexpr (with_arcs)
      return contacts_.bisector(i, j);
    else
      return {direction_along(site(j), site(i))};
  }

  /// The point where the merge curve leaves a Voronoi polygon.
  struct Crossing {
    Disk disk;
    double position = 0;   ///< on the current bisector
    std::size_t side = 0;  ///< of the edge that it crosses
  };

  /// The state of the current disk, according to the other edges.
  enum class State {
    inside,
    tied_wrongly,  ///< a stored disk, taken for a tie, reaches over the boundary
    outside,       ///< not inside the shape: the merge curve ends
    broken         ///< two Voronoi edges cross
  };

  const site::Site& site(std::uint32_t i) const { return diagram_.elements.sites[i]; }
  std::uint32_t& top(std::size_t side) { return diagram_.top[current_[side]][1 - side]; }
  /// Begins the edge between the current elements. Returns `none` if there is no free place.
  std::uint32_t add_edge() {
    const std::uint32_t place = free_.first;
    if (place == none) return none;
    ListEdge& edge = diagram_.edges[place];
    free_.first = edge.inward[0];
    edge = {current_, {}, disk_};
    for (const std::size_t k : {0u, 1u}) {
      std::uint32_t& outermost = diagram_.top[current_[k]][k];
      edge.inward[k] = outermost;
      outermost = place;
    }
    return place;
  }

  /// Drops the outermost edges of one side that have no disk inside the shape: those whose inner
  /// disk reaches over the element on the other side, and those behind, in the part that the
  /// current disk cuts off. Drops nothing if it is the current disk that is not inside the shape:
  /// the first edge that is not behind decides.
  State drop_covered(std::size_t side) {
    std::uint32_t kept = top(side);
    for (; kept != none; kept = diagram_.edges[kept].inward[1 - side]) {
      const ListEdge& edge = diagram_.edges[kept];
      const double distance_to_third = gap(edge.element[side], disk_);
      if (is_stored_ && may_undo_ > 0 && distance_to_third < -tie() &&
          distance_to_third >= -vagueness())
        return State::tied_wrongly;
      if (edge.inner.radius > 0 && gap(current_[1 - side], edge.inner) < -tie()) continue;
      if (distance_to_third < -vagueness()) return State::outside;
      if (distance_to_third <= vagueness() || !is_behind(side, edge)) break;
    }
    return drop_while(side, [&] { return top(side) != kept; }) ? State::inside : State::broken;
  }

  /// Takes the merge curve back, from its last edge to before a stored disk, and drops the edges
  /// that begin in that disk. Returns the edge that is then the last one, or `none` if edges cross.
  /// O(1) per dropped edge; there are no more of them than elements in both lists.
  std::uint32_t go_back(std::uint32_t last) {
    const Disk wrong = disk_;
    is_stored_ = false;
    for (;;) {
      // An edge of the merge curve begins where the one before crosses an edge of a list.
      const ListEdge& edge = diagram_.edges[last];
      const std::size_t side = diagram_.edges[edge.inward[0]].element[1] < middle_ ? 0 : 1;
      const std::uint32_t crossed = edge.inward[side], before = edge.inward[1 - side];
      if (!drop(last)) return none;
      may_undo_ -= may_undo_ > 0 ? 1 : 0;
      current_ = diagram_.edges[before].element;
      disk_ = diagram_.edges[before].inner;
      last = before;
      if (!is_same(diagram_.edges[crossed].inner, wrong)) continue;
      const auto is_wrong = [&] {
        return top(side) != none && is_same(diagram_.edges[top(side)].inner, wrong);
      };
      return drop_while(side, is_wrong) ? last : none;
    }
  }

  /// Drops the outermost edges of one side while `is_to_go` holds. Returns false if edges cross.
  template <class IsToGo>
  bool drop_while(std::size_t side, const IsToGo& is_to_go) {
    while (is_to_go())
      if (!drop(top(side))) return false;
    return true;
  }

  /// Drops an edge that is the outermost one of both its elements. Returns false if it is not.
  bool drop(std::uint32_t place) {
    ListEdge& edge = diagram_.edges[place];
    for (const std::size_t k : {0u, 1u}) {
      std::uint32_t& outermost = diagram_.top[edge.element[k]][k];
      if (outermost != place) return false;
      outermost = edge.inward[k];
    }
    edge.inward[0] = free_.first;
    free_.first = place;
    return true;
  }

  /// A bound on the error of Voronoi points that their three elements hardly determine: a rounding
  /// divided by the square of the angle between their feet, for up to 1e6 of them around a disk.
  double vagueness() const {
    constexpr double in_radii = 1e-5;
    return limits_.tolerance + in_radii * disk_.radius;
  }

  /// The distance by which a disk's foot on its element of one side has passed an edge's inner end,
  /// and so all of the edge; negative if it has not. No edge passes the ends of its elements.
  double passed(std::size_t side, const Disk& disk, const ListEdge& edge) const {
    if (edge.inner.radius == 0) return -disk.radius;
    const site::Site& own = site(current_[side]);
    const Vec2 way = edge.inner.center - disk.center;
    const double ahead = own.is_vertex() ? cross(way, disk.center - own.point) / edge.inner.radius
                                         : along_edge(own, disk.center, edge.inner.center);
    return side == 0 ? ahead : -ahead;
  }
  static double along_edge(const site::Site& edge, Vec2 from, Vec2 to) {
    if constexpr (with_arcs)
      return advance(edge, from, to);
    else
      return dot(edge.direction, to - from);
  }
  bool is_behind(std::size_t side, const ListEdge& edge) const {
    return passed(side, disk_, edge) > vagueness();
  }

  /// The tolerance for what a stored disk touches: far smaller than that of ties.h, which joins
  /// such disks later.
  double tie() const {
    if constexpr (with_arcs)
      return contacts_.tie();
    else
      return 0.0625 * limits_.tolerance;
  }
  /// Whether a stored disk touches an element, possibly from behind, rather than only the end of a
  /// segment.
  bool is_tied(std::uint32_t i, const Disk& disk) const {
    return std::abs(gap(i, disk)) <= tie() &&
           std::abs(carrier_distance(site(i), disk.center) - disk.radius) <= limits_.tolerance;
  }
  double gap(std::uint32_t i, const Disk& disk) const { return site::gap(site(i), disk); }

  /// The crossing of the current bisector with the outermost edge on one side, if any.
  std::optional<Crossing> crossing_with(std::size_t side, const Along& bisector, double reached) {
    const ListEdge& edge = diagram_.edges[top(side)];
    const std::uint32_t third = edge.element[side], other = current_[1 - side];
    // A disk that is behind only by rounding counts as not behind: ties.h handles it.
    const auto not_behind = [&](const Disk& disk) -> std::optional<Crossing> {
      const double position = bisector.position(disk.center);
      if (position > reached) return Crossing{disk, position, side};
      if (disk_.radius > 0 && distance(disk.center, disk_.center) <= vagueness())
        return Crossing{is_tied(third, disk_) ? disk_ : disk, reached, side};
      return std::nullopt;
    };
    if constexpr (with_arcs) return crossing_with_arcs(side, edge, not_behind);
    if (diagram_.is_spoke(edge)) {
      const bool own_vertex = site(current_[side]).is_vertex();
      const site::Site& vertex = site(own_vertex ? current_[side] : third);
      const site::Site& segment = site(own_vertex ? third : current_[side]);
      const Vec2 normal = segment.normal();
      const double radius = tangent_radius(vertex.point, normal, site(other));
      if (!(radius <= limits_.radius_limit)) return std::nullopt;
      const Disk disk{vertex.point + radius * normal, radius};
      if (!touches(other, disk)) return std::nullopt;
      return not_behind(disk);
    }
    if (edge.inner.radius > 0 && is_tied(other, edge.inner)) return not_behind(edge.inner);
    if (disk_.radius > 0 && is_tied(third, disk_)) return not_behind(disk_);

    ++statistics_.apollonius;
    const std::uint32_t own = current_[side];
    const auto disks = tangent_disks(site(current_[1]), site(current_[0]), site(third));
    std::optional<Crossing> best;
    for (std::size_t i = 0; i < disks.count; ++i) {
      Disk disk = disks.disk[i];
      if (!(disk.radius <= limits_.radius_limit)) continue;
      refine(disk, own, other, third);
      const auto crossing = not_behind(disk);
      if (!crossing || (best && best->position <= crossing->position)) continue;
      if (!touches(third, disk) || !touches(own, disk) || !touches(other, disk)) continue;
      if (!is_outward(edge, disk)) continue;
      best = crossing;
    }
    return best;
  }

  template <class NotBehind>
  std::optional<Crossing> crossing_with_arcs(std::size_t side, const ListEdge& edge,
                                             const NotBehind& not_behind) {
    const std::uint32_t third = edge.element[side], other = current_[1 - side];
    const bool is_spoke = diagram_.is_spoke(edge);
    if (!is_spoke && edge.inner.radius > 0 && is_tied(other, edge.inner))
      return not_behind(edge.inner);
    if (!is_spoke && disk_.radius > 0 && is_tied(third, disk_)) return not_behind(disk_);
    const auto found = contacts_.disks_of({current_[1], current_[0], third});
    std::optional<Crossing> best;
    for (std::size_t i = 0; i < found.count; ++i) {
      const auto crossing = not_behind(found.disk[i]);
      if (!crossing || (best && best->position <= crossing->position)) continue;
      if (is_spoke || is_outward(edge, found.disk[i])) best = crossing;
    }
    return best;
  }

  /// The first point at which the curve leaves a polygon. If the positions are not certain, the
  /// element of the other side decides: it must not reach into the disk.
  std::optional<Crossing> first_crossing(const Along& bisector, double reached) {
    std::array<std::optional<Crossing>, 2> crossing;
    const auto reach_over = [&](std::size_t side) {
      const std::uint32_t third = diagram_.edges[top(1 - side)].element[1 - side];
      return -gap(third, crossing[side]->disk);
    };
    for (const std::size_t side : {0u, 1u}) {
      if (top(side) == none) continue;
      crossing[side] = crossing_with(side, bisector, reached);
      if (side == 1 || !crossing[0] || top(1) == none) continue;
      // Mostly, the other edge has clearly not been reached: then its disk need not be computed.
      const ListEdge& edge = diagram_.edges[top(1)];
      if (!diagram_.is_spoke(edge) && reach_over(0) <= -tie() &&
          passed(1, crossing[0]->disk, edge) <= 0)
        return crossing[0];
    }
    if (!crossing[0] || !crossing[1]) return crossing[0] ? crossing[0] : crossing[1];
    const std::size_t first = crossing[1]->position < crossing[0]->position ? 1 : 0;
    return reach_over(first) > tie() && reach_over(1 - first) <= tie() ? crossing[1 - first]
                                                                       : crossing[first];
  }

  /// Whether a disk that touches an edge's elements is outward of its inner end, up to rounding.
  bool is_outward(const ListEdge& edge, const Disk& disk) const {
    if constexpr (with_arcs)
      if (edge.inner.radius == 0) return true;
    const Along bisector = along(edge.element[0], edge.element[1]);
    return bisector.position(disk.center) >= bisector.position(edge.inner.center) ||
           distance(disk.center, edge.inner.center) <= vagueness();
  }

  /// Whether a disk that touches an element's carrier touches the element: its foot is on a
  /// segment, in the wedge of a reflex vertex, or beyond it within the tolerance.
  bool touches(std::uint32_t i, const Disk& disk) const {
    const site::Site& s = site(i);
    if (!s.is_vertex()) {
      const double foot = dot(s.direction, disk.center - s.point);
      if (foot >= 0 && foot <= s.length) return true;
      return std::abs(gap(i, disk)) <= limits_.tolerance;
    }
    const Vec2 d = disk.center - s.point;
    if (dot(site(i - 1).direction, d) >= 0 && dot(site(i + 1).direction, d) <= 0) return true;
    return gap(i - 1, disk) >= -limits_.tolerance && gap(i + 1, disk) >= -limits_.tolerance;
  }

  void refine(Disk& disk, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    polish(disk, site(a), site(b), site(c), tie(), limits_.tolerance,
           statistics_.precision_retries);
  }

  Diagram& diagram_;
  FreePlaces& free_;
  const MergeLimits& limits_;
  Statistics& statistics_;
  ArcContacts contacts_;
  std::array<std::uint32_t, 2> current_{};
  std::uint32_t middle_ = 0;  ///< the first element of the later list
  Disk disk_;
  bool is_stored_ = false;      ///< the current disk is one of a crossed edge
  std::uint32_t may_undo_ = 0;  ///< number of edges that may still be taken back
};

}  // namespace

std::uint32_t merge(Diagram& diagram, std::uint32_t first, std::uint32_t middle, std::uint32_t end,
                    const MergeLimits& limits, Statistics& statistics) {
  auto& free = diagram.free[first];
  const auto& more = diagram.free[middle];
  // A chain of k elements has k - 1 edges and k + 1 free places: some are always left.
  diagram.edges[free.last].inward[0] = more.first;
  free.last = more.last;
  const auto& chains = diagram.elements.chains;
  const std::uint32_t begin = chains[first], half = chains[middle], last = chains[end];
  if (diagram.elements.have_arcs())
    return MergeCurve<true>(diagram, free, limits, statistics).follow(begin, half, last);
  return MergeCurve<false>(diagram, free, limits, statistics).follow(begin, half, last);
}

}  // namespace medial::lee
