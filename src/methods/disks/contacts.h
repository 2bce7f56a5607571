#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/compat.h"
#include "medial/axis.h"
#include "methods/disks/exact_sites.h"
#include "site/boundary_tree.h"

namespace medial::disks {

/// What a walk goes by.
struct WalkContext {
  /// The share of the tolerance to which the walk separates contacts: so fine that it asks for
  /// rounding only. What remains of a tie is merged at the end.
  static constexpr double fine_share = 0.125;

  WalkContext(const ExactSites& sites, const site::BoundaryTree& a_tree)
      : exact(sites),
        boundary(sites.boundary),
        tree(a_tree),
        tolerance(fine_share * sites.fine_tolerance),
        joints(sites.fine_tolerance),
        radius_limit(sites.radius_limit) {}

  const ExactSites& exact;
  const Boundary& boundary;
  const site::BoundaryTree& tree;
  double tolerance;              ///< in the local frame
  double joints;                 ///< joints are smooth to so much
  double radius_limit;           ///< no disk inside the shape is larger
  std::vector<bool> in_precise;  ///< of each component: double is never asked; empty: it is
  const std::vector<bool>* ends_smooth = nullptr;  ///< exact::PartedNumbers::ends_smooth, if parted
  const std::atomic<bool>* cancel = nullptr;
  std::function<void(std::uint64_t)> finished_sites;  ///< gets the number of further finished sites
  /// Above 0, tasks are deferred, and so is the rest of one that has found this many nodes.
  std::uint32_t most_nodes = 0;
  bool joins_ties = true;  ///< whether what one disk touches within the tolerance is one node

  bool is_in_precise(std::uint32_t component) const {
    return !in_precise.empty() && in_precise[component];
  }
  /// Whether an edge ends in a joint that is blunt as the doubles have it, but counts as smooth.
  bool ends_smoothly(std::uint32_t edge) const {
    return ends_smooth != nullptr && (*ends_smooth)[boundary.originals[edge]];
  }
  bool is_cancelled() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
};

/// A flag at the end of a structure that is copied right after it was written: without the bytes
/// behind a bool, loads of the copy would overlap, and wait until several stores are done.
using WideFlag = std::uint64_t;

/// A part of the boundary still to be walked: the sites between `right`, whose foot moves forward,
/// and `left`, whose foot moves backward, both touched by the disk of `node`.
struct Span {
  std::uint32_t right;
  std::uint32_t left;
  std::uint32_t node;
  std::uint32_t third = ~std::uint32_t{0};  ///< another site that the node's disk touches, if known
  double error = 0;                         ///< how far the exact disk is from the node's, at most
  WideFlag is_exact = false;  ///< the node is the one that the shape has for the three sites

  /// Whether a site continues the right one smoothly, or the left one.
  bool continues_right(const Boundary& boundary, std::uint32_t site) const {
    return site == right + 1 && boundary.is_smooth(right);
  }
  bool continues_left(const Boundary& boundary, std::uint32_t site) const {
    return site + 1 == left && boundary.is_smooth(site);
  }
};

/// Which sites of a span a disk touches: searches, and what is left to decide when the tree has
/// answered: joints, and vertices that bridges divide into several copies.
///
/// Around a planar graph, edges stand twice, once for each side. A disk that touches one side is as
/// near to the other, and where several edges meet, to all of them: it touches what faces it, on
/// whose side and in whose range of directions its centre lies.
class Contacts {
 public:
  using Hit = site::BoundaryTree::Hit;

  Contacts(const WalkContext& a_context, Statistics& some_statistics)
      : context(a_context),
        statistics(some_statistics),
        boundary_(context.boundary),
        touching_((is_polygon() ? 2 : 1) * context.tolerance) {}

  const WalkContext& context;
  Statistics& statistics;

  /// Whether the boundary is straight. Then what the walk finds in double is taken only where it is
  /// certain.
  bool is_polygon() const { return !boundary_.has_arcs; }

  const site::Site& site(std::uint32_t i) const { return boundary_.sites[i]; }
  Element element(std::uint32_t i) const { return boundary_.elements[i]; }

  /// The nearest site inside the span that the disk reaches over by more than the tolerance.
  Hit nearest(const Disk& disk, const Span& span) {
    // Where both feet pass on at once, the same is asked again.
    if (span.right >= empty_.right && span.left <= empty_.left &&
        disk.center == empty_disk_.center && disk.radius == empty_disk_.radius)
      return {};
    ++statistics.queries;
    const Hit hit = search(disk.center, disk.radius - context.tolerance, span);
    if (!hit) {
      empty_ = span;
      empty_disk_ = disk;
    }
    return hit;
  }

  /// The site that a disk around `center` really touches where the search found site i: a segment's
  /// end that is a vertex site of its own belongs to the vertex, and a vertex that bridges divide
  /// into several copies is touched by the copy in whose range of directions the centre lies.
  std::uint32_t owner(std::uint32_t i, Vec2 center, const Span& span) const;

  /// Whether a disk around c that reaches a site may touch it from where it lies: one inside a
  /// shape does.
  bool faces(std::uint32_t i, Vec2 c) const { return !has_both_sides() || faces_side(i, c); }

  /// What a disk that reaches across a site has touched before, if that has another side.
  std::optional<site::Site> other_side(std::uint32_t i) const {
    return has_both_sides() ? std::optional(site::reversed(site(i))) : std::nullopt;
  }

  /// Whether a disk that reaches site i from inside touches it there: not in the end of an edge,
  /// where its neighbour would be nearer.
  bool touches(std::uint32_t i, const Disk& disk, double slack) const {
    return !(std::abs(away(i, disk)) > slack) && (site(i).is_vertex() || touches_inside(i, disk));
  }

  /// Whether a disk touches both the site and its carrier: as touches(), but where the foot is next
  /// to an end, on either side, as far as the disk can tell.
  bool touches_carrier(std::uint32_t i, const Disk& disk, double slack) const {
    return std::abs(site::carrier_distance(site(i), disk.center) - disk.radius) <= slack &&
           (site(i).is_vertex() || std::abs(away(i, disk)) <= slack);
  }

  /// Whether a disk touches all of an arc: it is the arc's circle, as far as the arc can tell.
  bool touches_all(std::uint32_t i, const Disk& disk) const;

  /// Whether a disk that touches the site's carrier touches the site itself.
  bool reaches(std::uint32_t i, const Disk& disk) const {
    const double reach = disk.radius + 2 * context.tolerance;
    return site::squared_distance(site(i), disk.center) <= reach * reach;
  }

  /// Whether the span is a short chain of smooth joints, nowhere convex, that turns by less than
  /// half a turn: no disk touches such a chain in two places. Rounding may ask for one where the
  /// chain is flat.
  bool is_reflex_chain(const Span& span) const {
    return span.left - span.right <= longest_flat_chain && is_short_reflex_chain(span);
  }

  /// Whether nothing but a bridge lies between the two sites.
  bool is_at_bridge(const Span& span) const {
    return span.left - span.right == 2 && element(span.right + 1) == Element::bridge;
  }
  /// Whether a walk is needed between the two sites.
  bool needs_walk(const Span& span) const {
    return span.left - span.right > 1 && !is_at_bridge(span) && !is_reflex_chain(span);
  }

  /// The sites strictly inside the span that a disk touches in places of their own, in order; until
  /// the next call. `all_around`: both ends of the span are touched in one point.
  const std::vector<std::uint32_t>& touched_between(const Span& span, const Disk& disk,
                                                    bool all_around = false);

  /// Splits the span at its node's own disk, at all sites that the disk touches, `sure` if no other
  /// (none: not at all): a node of high degree is found with one query. `all_around` as above.
  void split(const Span& span, const Disk& disk, std::uint32_t sure, bool all_around,
             std::vector<Span>& parts);

  /// Whether what a disk touches in the span, within the tolerance, `sure` among it, is a tie
  /// beside which nothing else is: no other site is near, and no foot is near to a joint without
  /// being in it. Such contacts become one node in whichever order they are found.
  bool is_clean_tie(const Span& span, const Disk& disk, std::uint32_t sure);
  /// Whether a disk may touch a site of the span's boundary in a place of its own, give or take
  /// so many times what double leaves open.
  bool may_touch(std::uint32_t i, const Span& span, const Disk& disk, double times = 1) const;
  /// Whether it may touch one inside the span beside `next`.
  bool may_touch_more(const Span& span, const Disk& disk, std::uint32_t next, double times = 1);
  /// Whether a foot of a disk, which is known well, is where it passes on to the next site.
  bool passes_at(const Span& span, const Disk& disk, std::uint32_t next) const;
  /// The disk of such a tie near to a given one.
  std::optional<Disk> clean_tie(const Span& span, const Disk& near, std::uint32_t sure);

  /// Contacts of one disk at a smaller angle count as one at a node.
  static constexpr double distinct_contacts = 1e-6;
  /// Whether a disk can touch both sites in one place only, as they are nearer to each other than
  /// contacts are distinguished: copies of a point or of an edge, or neighbours. Two points are
  /// distinct at any distance.
  bool in_one_place(std::uint32_t i, std::uint32_t j, Vec2 center, double radius) const {
    const site::Site &a = site(i), &b = site(j);
    if (a.is_vertex() && b.is_vertex()) return a.point == b.point;
    const double apart = distinct_contacts * radius;
    return squared_norm(site::foot(a, center) - site::foot(b, center)) < apart * apart;
  }

  /// Whether a centre is past the normals beside a vertex: of vertices that double does not tell
  /// apart one is touched, between them.
  bool is_past_vertex(std::uint32_t i, Vec2 center) const {
    return element(i) == Element::vertex && beyond_ends(i, center) > context.tolerance;
  }
  /// Whether two disks are so near to each other that on the way a disk may reach over a site all
  /// along by less than double sees.
  bool is_short_way(const Disk& from, const Disk& to) const {
    constexpr double many = 1 << 10;
    return !(squared_norm(to.center - from.center) > many * context.tolerance * from.radius);
  }

  /// How far a disk's centre lies beyond the nearer of the normals at the ends of a site, where
  /// another site or a bridge takes over: negative between them.
  double beyond_ends(std::uint32_t i, Vec2 center) const {
    const auto [at_start, at_end] = beyond_each(i, center);
    return std::max(at_start, at_end);
  }

 private:
  bool touches_inside(std::uint32_t edge, const Disk& disk) const;
  bool has_both_sides() const { return boundary_.sides == Sides::both; }
  bool is_short_reflex_chain(const Span& span) const;
  bool faces_side(std::uint32_t i, Vec2 c) const;
  std::uint32_t owner_on_sides(std::uint32_t i, Vec2 center, const Span& span) const;
  /// From a vertex towards the centre of the bridge beside it.
  Vec2 bridge_direction(std::uint32_t vertex, std::uint32_t bridge) const {
    return boundary_.bridge_at(bridge).disk.center - site(vertex).point;
  }
  /// The nearest site inside a span, if one is nearer than `reach`.
  Hit search(Vec2 center, double reach, const Span& span) const {
    const std::uint32_t first = span.right + 1, last = span.left - 1;
    return has_both_sides() ? context.tree.nearest_facing(center, reach, first, last)
                            : context.tree.nearest(center, reach, first, last);
  }
  /// Whether no more than a half turn of directions lies between the normals beside any vertex, so
  /// that is_beside() knows them; a point of a planar graph may have all directions to itself.
  bool has_narrow_wedges() const { return is_polygon() && !has_both_sides(); }
  /// Whether a disk touches two sites in two places, that of the second one by this angle further
  /// around it: narrow slots have walls that a large disk touches next to each other.
  bool are_distinct(std::uint32_t first, std::uint32_t second, double angle,
                    const Disk& disk) const;
  /// The same for each end, and for one.
  std::array<double, 2> beyond_each(std::uint32_t i, Vec2 center) const {
    if (site(i).is_vertex())
      return {beyond_vertex(i, false, center), beyond_vertex(i, true, center)};
    const double s = site::carrier_parameter(site(i), center);
    return {-s, s - site(i).length};
  }
  double beyond_end(std::uint32_t i, bool at_end, Vec2 center) const {
    return site(i).is_vertex() ? beyond_vertex(i, at_end, center) : beyond_edge(i, at_end, center);
  }
  double beyond_edge(std::uint32_t i, bool at_end, Vec2 center) const {
    const double s = site::carrier_parameter(site(i), center);
    return at_end ? s - site(i).length : -s;
  }
  double beyond_vertex(std::uint32_t i, bool at_end, Vec2 center) const {
    if (at_end ? i + 1 >= boundary_.sites.size() : i == 0) return 0;  // where a run begins
    const std::uint32_t beside = at_end ? i + 1 : i - 1;
    return element(beside) == Element::bridge ? beyond_bridge(i, at_end, center)
                                              : -beyond_edge(beside, !at_end, center);
  }
  double beyond_bridge(std::uint32_t i, bool at_end, Vec2 center) const;
  /// How far a site is from a disk: negative where the disk reaches over it.
  double away(std::uint32_t i, const Disk& disk) const { return site::gap(site(i), disk); }
  const Boundary::SiteRange& run_of(const Span& span) const {
    return *ranges::lower_bound(boundary_.runs, span.left, {}, &Boundary::SiteRange::last);
  }
  /// Whether another site, or none, is nearer than site i of a run to a disk that is next to it,
  /// and to all disks so near to that.
  bool is_beside(std::uint32_t i, Vec2 center, const Boundary::SiteRange& run, double clear) const {
    return is_beside(i, center, run, clear, beyond_each(i, center));
  }
  bool is_beside(std::uint32_t i, Vec2 center, const Boundary::SiteRange& run) const {
    return is_beside(i, center, run, clearance());
  }
  /// The same by what beyond_each() says.
  bool is_beside(std::uint32_t i, Vec2 center, const Boundary::SiteRange& run, double clear,
                 const std::array<double, 2>& beyond) const {
    if (element(i) == Element::bridge) return true;
    const site::Site& own = site(i);
    const bool is_vertex = own.is_vertex();
    // From behind, at the tip of a needle, the end of an edge is touched, which is a vertex.
    if (!is_vertex && !own.is_arc() && site::carrier_distance(own, center) < -clear) return true;
    const auto [at_start, at_end] = beyond;
    if (!(std::max(at_start, at_end) > clear)) return false;
    if (is_vertex) return true;
    return at_end > at_start ? i < run.last && boundary_.is_smooth(i)
                             : i > run.first && boundary_.is_smooth(i - 1);
  }
  /// A site that a disk touches or is near to.
  struct Neighbor {
    std::uint32_t site;
    double away;        ///< how far it is from the disk
    double beyond;      ///< see beyond_ends()
    Vec2 foot, toward;  ///< the unit vector from there to the disk's centre
  };
  /// Whether no disk that touches three sites of a tie, and reaches over no other one of it, each
  /// within `touching_`, touches anything else.
  bool is_alone(const std::vector<Neighbor>& tie, const Span& span, const Disk& disk);
  /// What a disk touches or is near to on all of a span's boundary, in order; until the next call.
  /// The spans that begin at one node ask for the same disk.
  const std::vector<Neighbor>& around(const Span& span, const Disk& disk);
  bool is_around(const Boundary::SiteRange& run, const Disk& disk) const {
    return &run == around_run_ && disk.center == around_.center && disk.radius == around_.radius;
  }
  /// How far a disk may be from the one that it should be, at most, against the residuals of its
  /// contacts with some of these sites (docs/exact.md).
  double spread_of(const std::vector<Neighbor>& sites, const Span& span, Vec2 center) const;
  /// How far away a site is that has nothing to do with a tie.
  double clearance() const {
    constexpr double tolerances = 64;
    return tolerances * context.tolerance;
  }

  /// Of the radius: ties are contracted along edges shorter than half of this only.
  static constexpr double short_way = 0x1p-6;
  /// Feet further apart than so many tolerances are not two copies of one place.
  static constexpr double distinct_feet = 16;
  /// Longer chains need no check: their ends are distinct.
  static constexpr std::uint32_t longest_flat_chain = 8;

  const Boundary& boundary_;
  /// How near a disk has to be to what it touches in a tie: what double leaves open of the disk,
  /// and of the site.
  const double touching_;
  std::vector<std::uint32_t> touched_;
  /// The last disk that nearest() has found to be empty, and of which span.
  Disk empty_disk_{{0, 0}, -1};
  Span empty_{0, 0, 0};
  /// The last disk and boundary that around() was asked for, and the answer.
  Disk around_{{0, 0}, -1};
  const Boundary::SiteRange* around_run_ = nullptr;
  double around_reach_ = 0;  ///< how far from that disk `within_` goes
  /// How many times as far as clearance() that is, so that is_alone() mostly finds there what it
  /// asks for; less, from then on, where that would be hundreds of sites.
  double further_ = 1 << 16;
  std::vector<std::uint32_t> within_;
  std::vector<Neighbor> near_;      ///< of those within clearance(), what is not beside the disk
  std::vector<std::uint32_t> tie_;  ///< of is_alone()
  std::vector<Vec2> toward_;
  std::vector<std::array<double, 3>> shares_;
};

}  // namespace medial::disks
