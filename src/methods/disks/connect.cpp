#include "methods/disks/connect.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "base/numbers.h"
#include "base/threads.h"
#include "site/first_touch.h"

namespace medial::disks {
namespace {

using site::Site;

/// A loose segment is a run of two ends and two sides.
constexpr std::uint32_t loose_sites = 4;

/// Cuts are kept where no query finds them.
const Site far_away = site::make_vertex({1e30, 1e30});

/// The loop that a site belongs to. Loops that are neighbours in the plane mostly have
/// about the same number of sites, so a guess saves most of the search.
std::size_t loop_of(const Boundary& loops, std::uint32_t site) {
  const auto count = static_cast<std::uint64_t>(loops.runs.size());
  const auto guess = static_cast<std::size_t>(count * site / loops.sites.size());
  constexpr std::size_t around = 32;
  const auto begin = loops.runs.begin();
  auto from = begin, to = loops.runs.end();
  if (guess >= around && begin[static_cast<std::ptrdiff_t>(guess - around)].first <= site)
    from = begin + static_cast<std::ptrdiff_t>(guess - around);
  if (guess + around < count && site < begin[static_cast<std::ptrdiff_t>(guess + around)].first)
    to = begin + static_cast<std::ptrdiff_t>(guess + around);
  const auto run = std::upper_bound(
      from, to, site, [](std::uint32_t s, const Boundary::SiteRange& r) { return s < r.first; });
  return static_cast<std::size_t>(run - begin) - 1;
}

Boundary::SiteRange run_of(const Boundary& loops, std::uint32_t site) {
  return loops.runs[loop_of(loops, site)];
}

/// Of a segment touched in an end that is a vertex site, that vertex.
std::uint32_t owner_of_foot(const Boundary& loops, const Boundary::SiteRange& run,
                            std::uint32_t site, Vec2 center) {
  if (loops.elements[site] != Element::edge) return site;
  const double s = site::foot_parameter(loops.sites[site], center);
  const std::uint32_t before = run.before(site), after = run.after(site);
  if (s <= 0 && loops.elements[before] == Element::vertex) return before;
  if (s >= loops.sites[site].length && loops.elements[after] == Element::vertex) return after;
  return site;
}

/// Of the sites that a disk touches in the same place as the given one, the one that it touches
/// from inside: on its left, in its own range of directions.
std::uint32_t facing_site(const Boundary& loops, const site::FirstTouch& first_touch,
                          std::uint32_t group, std::uint32_t site, Vec2 center) {
  const auto faces = [&](std::uint32_t i, const Boundary::SiteRange& run) {
    if (loops.elements[i] == Element::edge) return faces_edge(loops.sites[i], center);
    if (run.first == run.last) return true;
    return in_wedge(loops.sites[run.before(i)].end_normal(), loops.sites[run.after(i)].normal(),
                    center - loops.sites[i].point);
  };
  if (loops.elements[site] == Element::edge && faces_edge(loops.sites[site], center)) return site;
  const Vec2 foot = site::foot(loops.sites[site], center);
  constexpr double same_place = 0x1p-46;
  const auto is_it = [&](std::uint32_t i, const Boundary::SiteRange& run) {
    return site::squared_distance(loops.sites[i], foot) <= same_place * same_place && faces(i, run);
  };
  const Boundary::SiteRange own = run_of(loops, site);
  if (own.last - own.first < loose_sites)
    for (std::uint32_t i = own.first; i <= own.last; ++i)
      if (is_it(i, own)) return i;
  std::uint32_t found = site;
  first_touch.near(foot, same_place, group, [&](std::uint32_t i) {
    const Boundary::SiteRange run = run_of(loops, i);
    // A vertex is the end of the edge before it.
    for (const std::uint32_t candidate : {i, run.after(i), i - (i > run.first ? 1 : 0)})
      if (is_it(candidate, run)) found = candidate;
  });
  return found;
}

/// Finds the disks that connect holes to others, for a run of holes that lie near to each other.
class Connector {
 public:
  Connector(const Shape& shape, const site::FirstTouch& first_touch, double furthest,
            double typical, double tolerance, const ExactSites& exact,
            const std::vector<bool>& in_precise)
      : shape_(shape),
        loops_(exact.boundary),
        first_touch_(first_touch),
        furthest_(furthest),
        typical_(typical),
        tolerance_(tolerance),
        exact_(exact),
        in_precise_(in_precise) {}

  /// Prepares for these holes.
  void begin(std::span<const std::uint32_t> holes) {
    if (!found_.empty()) {
      constexpr double a_little_more = 1.0625;
      expected_ = a_little_more * *std::max_element(found_.begin(), found_.end());
    }
    found_.clear();
    site::Extent around;
    for (const std::uint32_t hole : holes) {
      const Vec2 foot = loops_.sites[loops_.runs[hole].first].point;
      const double radius = first_radius(hole);
      const Vec2 center = foot + radius * outreach;
      around.add(center - Vec2{radius, radius});
      around.add(center + Vec2{radius, radius});
    }
    first_touch_.look_around(around, region_);
  }

  /// The disk meets its own component first. Other components can only have vertices in common with
  /// it, and are left out: a bridge must not end there.
  Bridge connecting_disk(std::uint32_t hole) {
    const Boundary::SiteRange own = loops_.runs[hole];
    const std::uint32_t component = shape_.component[hole];
    const Vec2 foot = loops_.sites[own.first].point;
    const double largest = largest_radius(foot);
    double radius = first_radius(hole);
    auto touch =
        region_.holds(foot + radius * outreach, radius)
            ? first_touch_.find(foot, outreach, radius, component, own.first, own.last, region_)
            : first_touch_.find(foot, outreach, radius, component, own.first, own.last);
    while (!touch && radius < largest) {
      radius = std::min(largest, 8 * radius);
      touch = first_touch_.find(foot, outreach, radius, component, own.first, own.last);
    }
    if (touch) radius = touch->radius;
    Bridge bridge{{foot + radius * outreach, radius}, hole, touch ? touch->site : own.first};
    if (loops_.sides == Sides::both && touch)
      bridge.site = facing_site(loops_, first_touch_, component, bridge.site, bridge.disk.center);
    bridge.site =
        owner_of_foot(loops_, run_of(loops_, bridge.site), bridge.site, bridge.disk.center);
    const bool is_precise = !in_precise_.empty() && in_precise_[component];
    const bool is_clear = radius > exact_bridges && touch && touches_alone(bridge, *touch);
    if (is_precise || !is_clear)
      if (const auto exact = exact_bridge(hole, foot, radius)) return *exact;
    found_.push_back(radius);
    return bridge;
  }

 private:
  /// Whether nothing but a bridge's site is touched, as far as double can tell: one edge, or the
  /// vertex where all edges end that the disk reaches, away from where these begin.
  bool touches_alone(const Bridge& bridge, const site::FirstTouch::Touch& touch) const {
    const std::uint32_t site = bridge.site;
    const Boundary::SiteRange run = run_of(loops_, site);
    if (loops_.elements[site] == Element::edge || run.first == run.last) return touch.count == 1;
    const Site &before = loops_.sites[run.before(site)], &after = loops_.sites[run.after(site)];
    const bool is_loose_end = site::are_two_sides(before, after);
    const double slack = site::FirstTouch::distance_rounding + 2 * touch.error;
    // Near the centre of an arc, its foot moves by more than the disk's centre.
    const Vec2 center = bridge.disk.center;
    const auto beyond = [&](const Site& edge, double by) {
      return by * (edge.is_arc() ? site::view_of_arc(edge, center).size : 1) >= slack;
    };
    return touch.count == (is_loose_end ? 1 : 2) &&
           beyond(before, site::carrier_parameter(before, center) - before.length) &&
           beyond(after, -site::carrier_parameter(after, center));
  }
  /// The bridge among all sites that a disk from `foot` reaches, which has about this radius in
  /// double. Where it touches none of them after all, among those that larger ones reach.
  std::optional<Bridge> exact_bridge(std::uint32_t hole, Vec2 foot, double radius) const {
    constexpr double first_margin = 0x1p-46, growth = 64;
    const Boundary::SiteRange own = loops_.runs[hole];
    const double largest = largest_radius(foot);
    for (double margin = first_margin;; margin *= growth) {
      const double reach = std::min(largest, radius + margin);
      const std::vector<std::uint32_t> near = sites_in(foot, reach, shape_.component[hole], own);
      const auto touch = exact_.first_touch(foot, near);
      if (touch && touch->radius <= reach)
        return Bridge{{foot + touch->radius * outreach, touch->radius}, hole, touch->site};
      if (!(reach < largest)) return std::nullopt;
    }
  }
  /// The sites that the disk from `foot` with this radius reaches, or all but reaches, but for a
  /// hole's own.
  std::vector<std::uint32_t> sites_in(Vec2 foot, double radius, std::uint32_t component,
                                      const Boundary::SiteRange& own) const {
    std::vector<std::uint32_t> near;
    const auto add = [&](std::uint32_t site, const Boundary::SiteRange& run) {
      if (site < own.first || site > own.last) near.push_back(site);
      // Searches find edges only.
      const std::uint32_t after = run.after(site);
      if (loops_.elements[after] == Element::vertex && (after < own.first || after > own.last))
        near.push_back(after);
    };
    const double reach = radius + site::FirstTouch::distance_rounding;
    first_touch_.near(foot + radius * outreach, reach, component, [&](std::uint32_t site) {
      const Boundary::SiteRange run = run_of(loops_, site);
      if (run.last - run.first < loose_sites) {  // searches find one of a segment's sides
        for (std::uint32_t i = run.first; i <= run.last; ++i) add(i, run);
        return;
      }
      add(site, run);
      add(run.before(site), run);
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    return near;
  }
  /// A disk that reaches beyond the furthest point of all crosses the boundary, however its centre
  /// is rounded.
  double largest_radius(Vec2 foot) const {
    return 0.5 * (furthest_ - dot(outreach, foot)) + tolerance_;
  }
  /// Most holes have others at about the distance at which those before had some, or at first of
  /// their own detail.
  double first_radius(std::uint32_t hole) const {
    const Boundary::SiteRange own = loops_.runs[hole];
    const std::uint32_t edge =
        std::min(own.last, own.first + (loops_.elements[own.first] == Element::vertex ? 1 : 0));
    const double detail = loops_.sites[edge].length;
    return std::min(largest_radius(loops_.sites[own.first].point), expected_ > 0 ? expected_
                                                                   : detail > 0  ? detail
                                                                                 : typical_);
  }

  const Shape& shape_;
  const Boundary& loops_;
  const site::FirstTouch& first_touch_;
  const double furthest_, typical_, tolerance_;
  const ExactSites& exact_;
  const std::vector<bool>& in_precise_;
  site::FirstTouch::Region region_;
  double expected_ = 0;        ///< radius: above those of the last run; 0 before the first
  std::vector<double> found_;  ///< radii of the run under way
};

/// Where along its site a bridge touches that begins at `foot`: the parameter on a segment; on a
/// vertex, the angle by which the boundary's normal has turned to the right since the site before.
/// The bridge's centre may be rounded by more than it is large.
double place_on_site(const Boundary& loops, std::uint32_t site, std::uint32_t site_before,
                     Vec2 foot, const Disk& disk) {
  const Site& s = loops.sites[site];
  if (!s.is_vertex()) return site::foot_parameter(s, disk.center);
  const Vec2 to = (foot - s.point) + disk.radius * outreach;
  if (site_before == site) return clockwise_turn(outreach, to);
  const Vec2 from = loops.sites[site_before].end_normal();
  // It lies between 0 and half a turn; rounding may add a little on both sides.
  const double angle = std::atan2(-cross(from, to), dot(from, to));
  return angle < -0.5 * std::numbers::pi ? angle + 2 * std::numbers::pi : angle;
}

/// Splices loops into runs, without recursion: chains of holes can be long.
class Splicer {
 public:
  Splicer(const Shape& shape, const Boundary& loops, std::vector<Bridge> bridges)
      : shape_(shape), loops_(loops), places_(bridges.size()) {
    result_.bridges = std::move(bridges);
    std::vector<std::uint32_t> loop(bridges_.size());
    std::vector<Place> found(bridges_.size());
    parallel_for(bridges_.size(), [&](std::size_t i) {
      loop[i] = static_cast<std::uint32_t>(loop_of(loops, bridges_[i].site));
      found[i] = place_of(static_cast<std::uint32_t>(i), loop[i]);
    });
    // One place further, so that while the lists are filled, each grows to where the next begins.
    first_place_.resize(loops.runs.size() + 2);
    for (const std::uint32_t l : loop) ++first_place_[l + 2];
    for (std::size_t l = 2; l < first_place_.size(); ++l) first_place_[l] += first_place_[l - 1];
    for (std::size_t i = 0; i < bridges_.size(); ++i)
      places_[first_place_[loop[i] + 1]++] = found[i];
    for (std::size_t l = 0; l < loops.runs.size(); ++l)
      std::sort(places_.begin() + first_place_[l], places_.begin() + first_place_[l + 1],
                [](const Place& p, const Place& q) {
                  return p.site != q.site     ? p.site < q.site
                         : p.place != q.place ? p.place < q.place
                                              : p.bridge < q.bridge;
                });
  }

  Boundary splice() {
    result_.has_arcs = loops_.has_arcs;
    result_.sides = loops_.sides;
    result_.reserve(loops_.sites.size() + 4 * bridges_.size());
    for (std::uint32_t loop = 0; loop < loops_.runs.size(); ++loop) {
      if (shape_.hole[loop]) continue;
      const auto first = static_cast<std::uint32_t>(result_.sites.size());
      add_component(loop);
      result_.runs.push_back({first, static_cast<std::uint32_t>(result_.sites.size() - 1),
                              loops_.runs[loop].at_corner});
    }
    return std::move(result_);
  }

 private:
  /// Where a bridge touches.
  struct Place {
    std::uint32_t site, bridge;
    double place;
  };
  /// A loop under way: the next site, the next place on the loop, where the next copy of a segment
  /// starts, and the bridge that led here.
  struct Cursor {
    std::uint32_t loop, site, place, bridge;
    double from = 0;
  };

  Place place_of(std::uint32_t bridge, std::uint32_t loop) const {
    const Boundary::SiteRange run = loops_.runs[loop];
    const auto& [disk, hole, site, places] = bridges_[bridge];
    const std::uint32_t before = run.before(site);
    const Vec2 foot = loops_.sites[loops_.runs[hole].first].point;
    const double place = place_on_site(loops_, site, before, foot, disk);
    // A hole's run starts in the middle of its first vertex: what is touched earlier on that
    // vertex comes at the very end. A point's run starts and ends there, and an outer loop's at
    // the beginning of a vertex.
    const bool at_end =
        shape_.hole[loop] && site == run.first && run.first < run.last &&
        loops_.elements[site] == Element::vertex &&
        place < place_on_site(loops_, site, before, loops_.sites[site].point, {{}, 1});
    return {at_end ? run.last + 1 : site, bridge, place};
  }

  Cursor begin(std::uint32_t loop, std::uint32_t bridge) const {
    return {loop, loops_.runs[loop].first, first_place_[loop], bridge};
  }

  void add_bridge(std::uint32_t bridge, std::size_t side) {
    result_.bridges[bridge].places[side] = static_cast<std::uint32_t>(result_.sites.size());
    result_.add(far_away, Element::bridge, bridge);
  }

  /// A copy of the cursor's site up to `to` (a segment's parameter).
  void add_piece(const Cursor& at, double to) {
    const std::uint32_t site =
        at.site <= loops_.runs[at.loop].last ? at.site : loops_.runs[at.loop].first;
    const Site& whole = loops_.sites[site];
    const bool all = whole.is_vertex() || (at.from == 0 && to == whole.length);
    result_.add(all ? whole : site::part_of(whole, at.from, to), loops_.elements[site],
                loops_.originals[site], loops_.joint(site));
  }

  void add_component(std::uint32_t outer) {
    std::vector<Cursor> stack{begin(outer, none)};
    while (!stack.empty()) {
      Cursor& at = stack.back();
      const Boundary::SiteRange run = loops_.runs[at.loop];
      const bool here = at.place < first_place_[at.loop + 1] && places_[at.place].site == at.site;
      if (here) {
        const Place place = places_[at.place++];
        add_piece(at, place.place);
        at.from = place.place;
        add_bridge(place.bridge, 0);
        stack.push_back(begin(bridges_[place.bridge].hole, place.bridge));
        continue;
      }
      // A hole that began at a vertex ends with a second copy of it; a point has nothing between.
      const bool closes = shape_.hole[at.loop] && loops_.elements[run.first] == Element::vertex &&
                          run.first < run.last;
      if (at.site <= run.last || closes)
        add_piece(at, at.site <= run.last ? loops_.sites[at.site].length : 0);
      at.from = 0;
      const std::uint32_t end = closes ? run.last + 1 : run.last;
      if (at.site < end) {
        ++at.site;
        continue;
      }
      const std::uint32_t bridge = at.bridge;
      stack.pop_back();
      if (!stack.empty()) add_bridge(bridge, 1);
    }
  }

  const Shape& shape_;
  const Boundary& loops_;
  std::vector<Place> places_;               ///< loop after loop, in the order of each
  std::vector<std::uint32_t> first_place_;  ///< of each loop
  Boundary result_;
  const std::vector<Bridge>& bridges_ = result_.bridges;
};

/// The bridges of these holes.
std::vector<Bridge> connecting_disks(const Shape& shape, double tolerance, const ExactSites& exact,
                                     const std::vector<bool>& in_precise,
                                     const std::vector<std::uint32_t>& holes) {
  const Boundary& loops = exact.boundary;
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Site& site : loops.sites) {
    furthest = std::max(furthest, dot(outreach, site.point));
    if (site.is_arc()) furthest = std::max(furthest, dot(outreach, site.apex()));
  }
  WorkVector<std::uint32_t> components(loops.sites.size());
  for (std::uint32_t loop = 0; loop < loops.runs.size(); ++loop)
    std::fill(components.begin() + loops.runs[loop].first,
              components.begin() + loops.runs[loop].last + 1, shape.component[loop]);
  // Between that many holes spread evenly over a square of side 1.
  const double typical = 1 / std::sqrt(static_cast<double>(holes.size()));
  // A vertex ends an edge, so edges are enough, but for vertices without any.
  WorkVector<std::uint32_t> edges;
  edges.reserve(loops.sites.size());
  for (const Boundary::SiteRange& run : loops.runs) {
    // Of a loose segment or arc, one side is enough, too: a run of two ends and two sides.
    const std::uint32_t side = run.first + 1, other = run.first + 3;
    const bool is_loose = run.last == other && loops.elements[run.first] == Element::vertex &&
                          loops.elements[side + 1] == Element::vertex &&
                          site::are_two_sides(loops.sites[side], loops.sites[other]);
    for (std::uint32_t i = run.first; i <= run.last; ++i) {
      if (loops.elements[i] != Element::edge && run.first < run.last) continue;
      edges.push_back(i);
      if (is_loose) break;
    }
  }
  const site::FirstTouch first_touch(loops.sites, edges, components);

  std::vector<Bridge> bridges(holes.size());
  constexpr std::size_t together = 8;
  parallel_ranges(holes.size(), 4 * together, [&](std::size_t begin, std::size_t last) {
    Connector connector(shape, first_touch, furthest, typical, tolerance, exact, in_precise);
    for (; begin < last; begin += together) {
      const std::size_t end = std::min(begin + together, last);
      connector.begin(std::span(holes).subspan(begin, end - begin));
      for (std::size_t i = begin; i < end; ++i) bridges[i] = connector.connecting_disk(holes[i]);
    }
  });
  return bridges;
}

}  // namespace

void connect_holes(const Shape& shape, double tolerance, const ExactSites& exact,
                   const std::vector<bool>& in_precise, Boundary& boundary) {
  std::vector<std::uint32_t> holes;
  for (std::uint32_t loop = 0; loop < shape.loop_count(); ++loop)
    if (shape.hole[loop]) holes.push_back(loop);
  if (holes.empty()) return;
  auto bridges = connecting_disks(shape, tolerance, exact, in_precise, holes);
  boundary = Splicer(shape, boundary, std::move(bridges)).splice();
}

Boundary connected_boundary(const Problem& problem) {
  Boundary boundary = loops_boundary(problem, problem.numbers(), Sides::one);
  const ExactSites sites(problem, problem.numbers(), boundary);
  connect_holes(problem.shape, problem.fine_tolerance, sites, {}, boundary);
  return boundary;
}

}  // namespace medial::disks
