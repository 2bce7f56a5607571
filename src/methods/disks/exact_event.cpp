#include "methods/disks/exact_event.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_set>
#include <utility>
#include <vector>

#include "methods/exact/disk_bounds.h"

namespace medial::disks {

namespace {

using exact::Precise;
using exact::Wide;
using Hit = site::BoundaryTree::Hit;

template <class Real>
Disk rounded(const exact::DiskBounds<Real>& disk) {
  return {{static_cast<double>(disk.center.x.value), static_cast<double>(disk.center.y.value)},
          static_cast<double>(disk.radius.value)};
}

/// The search of one question. By the lemma of docs/exact.md, the disk is the only one that touches
/// the two sites and a third one between them, in this order around it, and keeps clear of all.
template <class Real>
class Search {
 public:
  Search(const WalkContext& context, const Span& span, const Disk& from, bool is_exact)
      : context_(context),
        boundary_(context.boundary),
        outline_(context.exact.outline()),
        span_(span),
        from_(from) {
    if (is_exact) node_ = disk_of_node();
  }

  std::optional<ExactEvent> run(std::uint32_t hint, bool all_around) {
    const std::vector<std::uint32_t> neighbors{span_.right + 1, span_.left - 1, span_.right + 2,
                                               span_.left - 2};
    std::vector<std::uint32_t> candidates{hint};
    double reach = std::max(from_.radius, 0.0) + rounding;
    bool node_asked = false;
    for (;;) {
      for (const std::uint32_t site : candidates)
        if (all_around)
          consider_at_joint(site);
        else
          consider(site);
      candidates = best_ ? intruders(*best_) : neighbors;
      if (best_ && candidates.empty())
        return ExactEvent{site_, rounded(*best_), error_of_best(), is_node(*best_)};
      erase_seen(candidates);
      if (candidates.empty() && !std::exchange(node_asked, true)) {
        candidates = touched_by_node();
        erase_seen(candidates);
      }
      if (!candidates.empty()) continue;
      if (!all_around) {
        if (!are_all_seen()) candidates = reached_before();
        if (!candidates.empty()) continue;
        if (!best_) return std::nullopt;
        return ExactEvent{site_, rounded(*best_), std::numeric_limits<double>::infinity(), {}};
      }
      // Of disks that grow in one place, the best one reaches over all that the others touch.
      if (best_ || !(reach <= furthest)) return std::nullopt;
      reach *= 4;
      context_.tree.within(from_.center, reach, span_.right + 1, span_.left - 1, candidates);
    }
  }

 private:
  using KnownDisk = exact::DiskBounds<Real>;
  using Number = Bounded<Real>;

  /// What distances in double may be off by, and the coordinates of a rounded centre.
  static constexpr double rounding = 0x1p-47;
  /// No two points of the local frame are further apart.
  static constexpr double furthest = 8;
  /// An event nearer to the node than what this leaves of the way is touched by the node's disk. A
  /// shape that is_wide() may have points as near to each other as doubles can be.
  static constexpr int most_halvings = std::is_same_v<Real, Wide> ? 1200 : 128;

  exact::ExactSite exact_site(std::uint32_t i) const { return outline_.sites[name(i)]; }
  std::uint32_t name(std::uint32_t i) const { return boundary_.originals[i]; }
  bool is_bridge(std::uint32_t i) const { return boundary_.elements[i] == Element::bridge; }
  bool is_inside(std::uint32_t i) const { return i > span_.right && i < span_.left; }
  bool is_seen(std::uint32_t i) const {
    return !is_inside(i) || is_bridge(i) || seen_.count(i) > 0;
  }

  /// Whether the span has no site that has not been considered.
  bool are_all_seen() const {
    for (std::uint32_t i = span_.right + 1; i < span_.left; ++i)
      if (!is_seen(i)) return false;
    return true;
  }

  void erase_seen(std::vector<std::uint32_t>& sites) const {
    std::erase_if(sites, [&](std::uint32_t site) { return is_seen(site); });
  }

  /// Halves the way along the bisector ahead of the node, whose disk keeps clear of the span: by
  /// the lemma the event comes before any disk that reaches over something. Returns the first sites
  /// that such disks reach over and that have not been considered; none if there is no event.
  std::vector<std::uint32_t> reached_before() {
    if (!way_) way_ = way_ahead();
    auto& [low, high] = *way_;
    for (; halvings_ < most_halvings; ++halvings_) {
      const Real middle = (low + high) / 2;
      if (const auto disk = possible_at(Number(middle, 0))) {
        std::vector<std::uint32_t> found = intruders(*disk);
        if (found.empty()) {
          low = middle;
          continue;
        }
        erase_seen(found);
        if (!found.empty()) {
          high = middle;
          few_ *= 2;  // if none of these is touched, all are asked for in O(log n) rounds
          return found;
        }
      }
      high = middle;
    }
    return {};
  }

  /// Places on the bisector, from the node to the last one that a disk may have: by the share at
  /// which its foot is on the right site, or, if that is none but the left one is an edge, on that;
  /// between two vertices by the way from their middle, against their distance.
  std::array<Real, 2> way_ahead() const {
    const exact::ExactSite right = exact_site(span_.right), left = exact_site(span_.left);
    exact::Vector<Real> from{Real(from_.center.x), Real(from_.center.y)};
    if (node_) from = {node_->center.x.value, node_->center.y.value};
    const Real first(1.0), last(-1.0);
    if (!right.is_vertex()) return {std::clamp(exact::share_of(right, from), last, first), last};
    if (!left.is_vertex()) return {std::clamp(exact::share_of(left, from), last, first), first};
    const Real x = left.start.x - Real(right.start.x), y = left.start.y - Real(right.start.y);
    const Real squared = x * x + y * y, dx = from.x - right.start.x, dy = from.y - right.start.y;
    return {Real((y * dx - x * dy) / squared), Real(context_.radius_limit / sqrt(squared))};
  }

  /// The disk at a place, if it touches the two sites and comes before the best one, as far as the
  /// numbers can tell.
  std::optional<KnownDisk> possible_at(const Number& place) const {
    auto disk = disk_at(place);
    const bool is_possible =
        disk && !is_too_large(*disk) && (!best_ || comes_before(*disk, *best_)) &&
        is_touched(span_.right, *disk, false) && is_touched(span_.left, *disk, false);
    return is_possible ? disk : std::nullopt;
  }
  static exact::DiskBounds<Twofold> twofold_of(const KnownDisk& disk) {
    return {{exact::twofold_of(disk.center.x), exact::twofold_of(disk.center.y)},
            exact::twofold_of(disk.radius)};
  }

  std::optional<KnownDisk> disk_at(const Number& way) const {
    const exact::ExactSite right = exact_site(span_.right), left = exact_site(span_.left);
    const Number half(0.5);
    if (!right.is_vertex()) return exact::disk_along(exact::spoke_at(right, way), left);
    if (!left.is_vertex()) return exact::disk_along(exact::spoke_at(left, way), right);
    const auto start = exact::exact_vector<Number>(right.start),
               chord = exact::exact_vector<Number>(left.start) - start;
    const auto center = start + half * chord - way * exact::left_of(chord);
    return KnownDisk{center, root_of((half * half + way * way) * dot(chord, chord))};
  }

  /// Sites that the node's disk touches, as far as it is known.
  std::vector<std::uint32_t> touched_by_node() const {
    std::vector<std::uint32_t> found;
    context_.tree.within(from_.center, from_.radius + 2 * slack() + rounding, span_.right + 1,
                         span_.left - 1, found);
    return found;
  }

  /// Whether one disk of the bisector comes before another one: by the foot on an edge, or between
  /// two vertices by the centre.
  bool comes_before(const KnownDisk& a, const KnownDisk& b) const {
    const exact::ExactSite &right = exact_site(span_.right), &left = exact_site(span_.left);
    int forward = 0;
    if (!right.is_vertex()) forward = exact::further_along(right, a, b).value_or(0);
    if (forward == 0 && !left.is_vertex()) forward = exact::further_along(left, b, a).value_or(0);
    if (right.is_vertex() && left.is_vertex()) {
      const auto chord =
          exact::exact_vector<Number>(left.start) - exact::exact_vector<Number>(right.start);
      forward = cross(b.center - a.center, chord).sign().value_or(0);
    }
    return forward > 0;
  }

  /// The node's disk as the sites have it, where all three that it touches are known.
  std::optional<KnownDisk> disk_of_node() const {
    if (span_.third >= boundary_.sites.size()) return std::nullopt;
    const std::uint32_t right = name(span_.right), left = name(span_.left),
                        third = name(span_.third);
    if (third == right || third == left || right == left) return std::nullopt;
    return exact::disk_bounds<Real>(outline_, {right, left, third});
  }

  /// Whether a disk lies behind that of the node, by more than that is off.
  bool is_behind(const KnownDisk& disk) const {
    if (node_) return comes_before(disk, *node_);
    const KnownDisk from{exact::exact_vector<Number>(from_.center), Number(from_.radius)};
    const auto away = disk.center - from.center;
    return (dot(away, away) - Number(slack()) * Number(slack())).positive() &&
           comes_before(disk, from);
  }

  /// Whether a disk that is not behind the node's is that one, as far as the numbers can tell; none
  /// where the node's is not known.
  std::optional<bool> is_node(const KnownDisk& disk) const {
    if (!node_) return std::nullopt;
    return !comes_before(*node_, disk);
  }

  bool is_too_large(const KnownDisk& disk) const {
    return (Number(context_.radius_limit) - disk.radius).sign() == -1;
  }

  /// How far the node's disk may be off.
  double slack() const {
    constexpr double clear = 0x1p-8;  // of the radius: more than any node is off
    return std::min(span_.error, clear * from_.radius) +
           std::min(8 * context_.joints, clear * from_.radius) + 0x1p-50;
  }

  /// Makes a site the best if it is touched before the best so far.
  void consider(std::uint32_t site) {
    if (is_seen(site)) return;
    seen_.insert(site);
    const std::uint32_t right = name(span_.right), left = name(span_.left), third = name(site);
    if (third == right || third == left) return;
    const auto disk = exact::disk_bounds<Real>(outline_, {right, third, left});
    if (!disk) return;
    if (is_too_large(*disk)) return;
    if (is_behind(*disk) || (best_ && !comes_before(*disk, *best_))) return;
    // At a joint of two of them the disk touches both, whichever normal it is on.
    const bool joins_right = outline_.joined(right, third),
               joins_left = outline_.joined(third, left);
    if (!is_touched(span_.right, *disk, joins_right)) return;
    if (!is_touched(site, *disk, joins_right || joins_left)) return;
    if (!is_touched(span_.left, *disk, joins_left)) return;
    best_ = disk;
    site_ = site;
  }

  /// Makes a site the best if the disk that grows where the span's ends join touches it before the
  /// best so far.
  void consider_at_joint(std::uint32_t site) {
    if (is_seen(site)) return;
    seen_.insert(site);
    const std::uint32_t before = name(span_.left), after = name(span_.right), third = name(site);
    const auto disk = exact::disk_bounds<Real>(outline_, {before, after, third});
    if (!disk || is_too_large(*disk)) return;
    if (best_ && !(best_->radius - disk->radius).positive()) return;
    if (!is_touched(site, *disk, false)) return;
    best_ = disk;
    site_ = site;
  }

  double error_of_best() const {
    return static_cast<double>(best_->center.x.error + best_->center.y.error + best_->radius.error);
  }

  /// Sites that a disk reaches over, with their neighbours; none if there are none.
  std::vector<std::uint32_t> intruders(const KnownDisk& exact_disk) {
    const Disk disk = rounded(exact_disk);
    std::vector<std::uint32_t> found;
    const auto add = [&](std::uint32_t site) {
      for (const std::uint32_t i : {site, site - 1, site + 1}) found.push_back(i);
    };
    const Hit hit =
        context_.tree.nearest(disk.center, disk.radius - rounding, span_.right + 1, span_.left - 1);
    if (hit && !is_seen(hit.site)) {
      add(hit.site);
      return found;
    }
    std::vector<std::uint32_t> near;
    context_.tree.within(disk.center, disk.radius + rounding, span_.right + 1, span_.left - 1,
                         near);
    const std::vector<Vec2> vertices = touched_vertices();
    std::erase_if(near, [&](std::uint32_t site) {
      if (is_bridge(site) || (best_ && site == site_)) return true;
      const double gap = site::gap(boundary_.sites[site], disk);
      if (gap >= -context_.joints && continues_touched(site)) return true;
      if (gap < -rounding) return false;
      return clearance(exact_site(site), exact_disk, vertices) >= 0;
    });
    // Of many that are new, a few take the place of most others.
    std::vector<std::uint32_t> fresh = near;
    std::erase_if(fresh, [&](std::uint32_t site) {
      return is_seen(site) && is_seen(site - 1) && is_seen(site + 1);
    });
    const std::vector<std::uint32_t>& some = fresh.empty() ? near : fresh;
    for (std::size_t i = 0; i < some.size(); i += some.size() / few_ + 1) add(some[i]);
    return found;
  }

  /// exact::clearance(): a disk in the centre of arcs all but touches thousands of sites, most of
  /// which fewer digits tell apart.
  static int clearance(const exact::ExactSite& site, const KnownDisk& disk,
                       std::span<const Vec2> touched) {
    if constexpr (!std::is_same_v<Real, Twofold>) {
      const std::uint64_t before = Bounded<Twofold>::open_signs;
      const int sign = exact::clearance(site, twofold_of(disk), touched);
      if (sign != 0 && Bounded<Twofold>::open_signs == before) return sign;
    }
    return exact::clearance(site, disk, touched);
  }

  /// Vertices among what the best disk touches: beside one of them, it neither keeps clear of an
  /// edge that ends there nor reaches over that end.
  std::vector<Vec2> touched_vertices() const {
    std::vector<Vec2> found;
    if (!best_) return found;
    for (const std::uint32_t i : {span_.right, site_, span_.left})
      if (exact_site(i).is_vertex()) found.push_back(exact_site(i).start);
    return found;
  }

  /// Whether a site continues one that the disk touches, at a joint that is smooth up to
  /// rounding: beside the one normal there, a disk reaches over the other edge by less than the
  /// tolerance.
  bool continues_touched(std::uint32_t site) const {
    const auto joins = [&](std::uint32_t a, std::uint32_t b) {
      return outline_.joined(a, b) && !outline_.sites[a].is_vertex() &&
             !outline_.sites[b].is_vertex();
    };
    const auto is_joined = [&](std::uint32_t touched) {
      return joins(name(touched), name(site)) || joins(name(site), name(touched));
    };
    return boundary_.has_arcs &&
           (is_joined(span_.right) || is_joined(span_.left) || (best_ && is_joined(site_)));
  }

  /// Whether a disk that touches a site's carrier, or its joint, touches the site, in the part of
  /// it that bridges leave between them.
  bool is_touched(std::uint32_t site, const KnownDisk& disk, bool at_joint) const {
    if (!at_joint && !has_foot(site, disk)) return false;
    if (stands_between_bridges(site)) return lies_between_bridges(site, disk);
    // Pieces of one arc between two bridges are one site.
    std::uint32_t first = site, last = site;
    while (first > 0 && boundary_.is_same(first - 1, site)) --first;
    while (last + 1 < boundary_.sites.size() && boundary_.is_same(last + 1, site)) ++last;
    const bool too_early = first > 0 && is_bridge(first - 1) && beyond(first - 1, site, disk) == -1;
    const bool too_late = last + 1 < boundary_.sites.size() && is_bridge(last + 1) &&
                          beyond(last + 1, site, disk) == 1;
    return !too_early && !too_late;
  }

  /// Whether the foot of a disk's centre on the carrier of a site may lie on the site. Where two
  /// edges join smoothly up to rounding, one normal ends the first one and begins the second.
  bool has_foot(std::uint32_t site, const KnownDisk& disk) const {
    const std::uint32_t own = name(site);
    const exact::ExactSite own_site = exact_site(site);
    const auto before = context_.exact.joined_before(own);
    const bool passes_on = outline_.joined(own, outline_.next_of(own));
    if ((!before && !passes_on) || own_site.is_vertex())
      return exact::may_have_foot(own_site, disk);
    const auto begin = before ? outline_.template spoke_after<Number>(*before)
                              : exact::spoke_of<Number>(own_site, false);
    const auto end = passes_on ? outline_.template spoke_after<Number>(own)
                               : exact::spoke_of<Number>(own_site, true);
    return cross(disk.center - begin.foot, begin.normal).sign() != -1 &&
           cross(disk.center - end.foot, end.normal).sign() != 1;
  }

  bool stands_between_bridges(std::uint32_t site) const {
    return site > 0 && is_bridge(site - 1) && site + 1 < boundary_.sites.size() &&
           is_bridge(site + 1) && exact_site(site).is_vertex();
  }
  /// Whether a disk's centre may lie in the part of a vertex that two bridges leave: more than a
  /// half turn at a lone point, all of it where both are one.
  bool lies_between_bridges(std::uint32_t site, const KnownDisk& disk) const {
    const std::uint32_t before = boundary_.originals[site - 1],
                        after = boundary_.originals[site + 1];
    if (before == after) return true;
    const auto from = bridge_disk(before), to = bridge_disk(after);
    if (!from || !to) return true;
    const auto point = exact::exact_vector<Number>(exact_site(site).start);
    const auto toward = disk.center - point, first = from->center - point,
               last = to->center - point;
    const bool begun = cross(first, toward).sign() != 1, left = cross(toward, last).sign() != 1;
    return cross(first, last).sign() == -1 ? begun && left : begun || left;
  }

  /// Whether a disk's foot on a site lies further along than that of the bridge beside it.
  int beyond(std::uint32_t place, std::uint32_t site, const KnownDisk& disk) const {
    const auto bridge = bridge_disk(boundary_.originals[place]);
    if (!bridge) return 0;
    return exact::further_along(exact_site(site), *bridge, disk).value_or(0);
  }

  std::optional<KnownDisk> bridge_disk(std::uint32_t bridge) const {
    if (!context_.exact.reaches_out) return std::nullopt;
    const std::uint32_t first = boundary_.bridges[bridge].places[0];
    // The hole begins after the first place, where the bridge's disk touches it.
    return exact::disk_from<Real>(boundary_.sites[first + 1].point, outreach,
                                  exact_site(first - 1));
  }

  const WalkContext& context_;
  const Boundary& boundary_;
  const exact::SiteLoops& outline_;
  const Span span_;
  const Disk from_;
  std::optional<KnownDisk> node_;  ///< of the span, where it is asked for
  std::unordered_set<std::uint32_t> seen_;
  std::size_t few_ = 8;  ///< intruders that are considered at a time
  std::optional<KnownDisk> best_;
  std::optional<std::array<Real, 2>>
      way_;  ///< where the event may be; asked for where none is near
  int halvings_ = 0;
  std::uint32_t site_ = 0;
};

/// In numbers of twice double's digits; where these leave a sign open, or find nothing, in 256
/// bits, or in as many as the shape's coordinates need.
std::optional<ExactEvent> search(const WalkContext& context, const Span& span, const Disk& from,
                                 std::uint32_t hint, bool is_exact, bool all_around) {
  const std::uint64_t before = Bounded<Twofold>::open_signs;
  auto found = Search<Twofold>(context, span, from, is_exact).run(hint, all_around);
  if (found && found->is_well_known() && Bounded<Twofold>::open_signs == before) return found;
  if (found) hint = found->site;
  found = context.exact.outline().is_wide
              ? Search<Wide>(context, span, from, is_exact).run(hint, all_around)
              : Search<Precise>(context, span, from, is_exact).run(hint, all_around);
  if (found) found->in_precise = true;
  return found;
}

/// The largest disk that touches two edges, one of them a convex arc at least: in opposite places,
/// on a line through the arc's centre. None where the feet do not get there on the way from a
/// node's disk to the joint of the edges.
template <class Real>
std::optional<Disk> largest_on_way(const exact::ExactSite& first, const exact::ExactSite& second,
                                   const Disk& node) {
  using Number = Bounded<Real>;
  const auto curvature_of = [](const exact::ExactSite& edge) {
    return curvature(BulgeArc{edge.start, edge.end, edge.bulge});
  };
  const bool by_first = curvature_of(first) > curvature_of(second);
  const exact::ExactSite &arc = by_first ? first : second, &other = by_first ? second : first;
  if (!(arc.bulge > 0)) return std::nullopt;
  const auto own = exact::circle_of<Real>(arc);
  // Away from the other edge, and by how much the centre is.
  auto away = exact::normal_of<Number>(other, false);
  Number distance = dot(away, own.center - exact::exact_vector<Number>(other.start));
  Number size = root_of(dot(away, away));
  if (other.is_arc()) {
    const auto circle = exact::circle_of<Real>(other);
    away = other.bulge > 0 ? circle.center - own.center : own.center - circle.center;
    size = root_of(dot(away, away));
    distance = circle.radius + (other.bulge > 0 ? -size : size);
  } else {
    distance = distance / size;
  }
  const Number radius = Number(0.5) * (own.radius + distance);
  const exact::DiskBounds<Real> largest{own.center + ((own.radius - radius) / size) * away, radius};
  if (!exact::may_have_foot(first, largest) || !exact::may_have_foot(second, largest))
    return std::nullopt;
  const exact::DiskBounds<Real> from{exact::exact_vector<Number>(node.center), Number(node.radius)};
  const auto onward = by_first ? exact::further_along(arc, from, largest)
                               : exact::further_along(arc, largest, from);
  if (onward != 1) return std::nullopt;
  return rounded(largest);
}

/// On the bisector of two edges, the first disk tried, halving the way from a node's, that touches
/// their joint within half of the tolerance.
template <class Real>
std::optional<Disk> next_to_joint(const WalkContext& context, const exact::ExactSite& first,
                                  const exact::ExactSite& second, const Disk& node) {
  using Number = Bounded<Real>;
  constexpr int enough = 64;  // halvings, after which feet are in one place to rounding
  const auto away = [&](const Disk& disk) {
    return std::abs(distance(disk.center, first.end) - disk.radius);
  };
  if (away(node) <= context.joints) return std::nullopt;
  const Real begin(1.0), end(-1.0);
  Real share = std::clamp(exact::share_of<Real>(first, {node.center.x, node.center.y}), end, begin);
  for (int halvings = 0; halvings < enough; ++halvings) {
    share = (share + end) / 2;
    const auto found = exact::disk_along(exact::spoke_at(first, Number(share, 0)), second);
    if (found && away(rounded(*found)) <= 0.5 * context.joints) return rounded(*found);
  }
  return std::nullopt;
}

template <class Real>
Disk end_toward_joint(const WalkContext& context, std::uint32_t before, std::uint32_t after,
                      const Disk& node) {
  const exact::ExactSite first = context.exact.site(before), second = context.exact.site(after);
  Disk end = node;
  if (const auto largest = largest_on_way<Real>(first, second, node))
    if (largest->radius > node.radius + context.joints) end = *largest;
  if (!context.ends_smoothly(before)) return end;
  return next_to_joint<Real>(context, first, second, end).value_or(end);
}

}  // namespace

std::optional<ExactEvent> next_exactly(const WalkContext& context, const Span& span,
                                       const Disk& from, std::uint32_t hint, bool is_exact) {
  return search(context, span, from, hint, is_exact, false);
}

std::optional<ExactEvent> start_exactly(const WalkContext& context, const Span& whole,
                                        const Disk& about, std::uint32_t hint) {
  return search(context, whole, about, hint, false, true);
}

Disk end_toward_joint(const WalkContext& context, std::uint32_t before, std::uint32_t after,
                      const Disk& node) {
  // Ahead of feet that are less than a half turn apart the radius shrinks.
  constexpr double clear = 0x1p-20;
  const site::Site &first = context.boundary.sites[before], &second = context.boundary.sites[after];
  const bool shrinks =
      cross(site::outward(first, node.center), site::outward(second, node.center)) > clear;
  if (shrinks && !context.ends_smoothly(before)) return node;
  return context.exact.outline().is_wide ? end_toward_joint<Wide>(context, before, after, node)
                                         : end_toward_joint<Precise>(context, before, after, node);
}

}  // namespace medial::disks
