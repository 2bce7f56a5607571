#include "methods/disks/merge_ties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "base/compat.h"
#include "base/disjoint_sets.h"
#include "base/fill_gaps.h"
#include "base/memory.h"
#include "base/numbers.h"
#include "base/numbers_where.h"
#include "methods/disks/node_distance.h"
#include "site/bisector.h"

namespace medial::disks {
namespace {

using site::Site;

/// The largest residual at the one end of an edge, against the bound, that a contact of its other
/// end may have: with the smallest angle between contacts at some 2^-12, the factors of their
/// dependency differ by no more than its square.
constexpr double steepest = 0x1p24;

/// Contacts that belong to a node of many arcs may be so many tolerances off before it is put
/// right.
constexpr double hub_reach = 4;

/// How near to each other, in tolerances, what becomes one node has to be: the sites of the two
/// ends of an edge to one disk, or, where one of them only passes on, its ends to each other. Where
/// all that is connected by such edges cannot be one node, or does not leave the rest of the graph
/// as it is, it is divided by the next pair; the last one is for what is equal.
struct Nearness {
  double level, length;
};
constexpr std::array<Nearness, 3> nearnesses{{{0.5, 0.25}, {0.25, 0.0625}, {0x1p-20, 0x1p-20}}};

/// Nodes that may become one.
struct Group {
  std::vector<std::uint32_t> nodes;
  Disk disk;  ///< the one that touches all that they touch
  double worst = 0;
  bool contracts = false;
};

class Merger {
 public:
  Merger(const site::BoundaryTree& tree, const ExactSites& exact, double tolerance, Graph& graph)
      : boundary_(exact.boundary),
        tree_(tree),
        exact_(exact),
        tie_sites_{boundary_.sites, &exact},
        tolerance_(tolerance),
        graph_(graph) {}

  void merge() {
    if (boundary_.has_arcs) put_right();
    std::vector<std::uint32_t> open = candidates();
    if (open.empty()) return;
    collect_nodes(open);
    for (const Nearness& nearness : nearnesses) {
      if (open.empty()) break;
      contract(open, nearness);
    }
    if (!contracted_.empty()) remove();
  }

  /// Short edges between branching nodes whose two sites and one more contact of each end could be
  /// touched by one disk. A necessary condition for contraction, and nearly always false.
  std::vector<std::uint32_t> candidates() {
    const WorkVector<std::uint32_t> edges = short_edges();
    if (edges.empty()) return {};
    link_ends(edges);
    return those(edges, [&](std::uint32_t e) {
      return !leads_away(e) && could_be_contracted(graph_.edges[e]);
    });
  }

 private:
  /// Beside arcs, the walk takes what one of its disks touches within the tolerance for one node,
  /// from disk to disk: such a node moves to where it touches all its sites, if it does not
  /// yet. (All of an arc that its disk nearly touches it need not touch.)
  void put_right() {
    const WorkVector<std::uint8_t> degree = degrees_of(graph_);
    const auto is_hub = [&](std::uint32_t node) { return degree[node] > 3; };
    link_ends(numbers_where(graph_.edges.size(), [&](std::size_t e) {
      const auto [from, to] = graph_.edges[e].node;
      return is_hub(from) || is_hub(to);
    }));
    for (std::uint32_t node = 0; node < graph_.nodes.size(); ++node) {
      if (!is_hub(node)) continue;
      Disk& disk = graph_.nodes[node].disk;
      const std::vector<Touch> touched = contacts_of(node);
      if (ranges::all_of(touched, [&](const Touch& one) {
            return std::abs(site::gap(boundary_.sites[one.site], disk)) <= tolerance_;
          }))
        continue;
      TieFit fit(tie_sites_, disk);
      if (fit.fits(touched, tolerance_) && is_empty(fit.disk, graph_.nodes[node].component))
        disk = fit.disk;
    }
  }

  /// What double may leave open when it looks for candidates.
  double bound() const { return 1.25 * nearnesses[0].level * tolerance_; }

  /// The edges for which a slow test holds.
  template <class Edges, class Holds>
  static std::vector<std::uint32_t> those(const Edges& edges, const Holds& holds) {
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t i :
         numbers_where<64>(edges.size(), [&](std::size_t k) { return holds(edges[k]); }))
      kept.push_back(edges[i]);
    return kept;
  }
  /// The edges that are short, or may be so but for the rounding of their nodes.
  WorkVector<std::uint32_t> short_edges() const {
    const double rounding = boundary_.has_arcs ? 0 : NodeDistance::rounding;
    return numbers_where(graph_.edges.size(), [&](std::size_t e) {
      const auto [from, to] = graph_.edges[e].node;
      return NodeDistance::is_short(graph_.nodes[from].disk, graph_.nodes[to].disk, rounding);
    });
  }

  /// Whether an edge leads through a bridge's disk that is not near to its ends.
  bool leads_away(std::uint32_t e) const {
    const Disk& from = graph_.nodes[graph_.edges[e].node[0]].disk;
    const auto passed = ranges::lower_bound(graph_.passages, e, {}, &Graph::Passage::edge);
    return passed != graph_.passages.end() && passed->edge == e &&
           !NodeDistance::is_short(from, passed->disk, tolerance_);
  }

  /// Lists the ends of all edges at the nodes of these ones, the last edge first.
  void link_ends(const WorkVector<std::uint32_t>& edges) {
    std::vector<bool> is_listed(graph_.nodes.size());
    for (const std::uint32_t e : edges)
      for (const std::uint32_t node : graph_.edges[e].node) is_listed[node] = true;
    const WorkVector<std::uint32_t> linked = numbers_where(graph_.edges.size(), [&](std::size_t e) {
      const auto [from, to] = graph_.edges[e].node;
      return is_listed[from] || is_listed[to];
    });
    ends_begin_.assign(graph_.nodes.size() + 1, 0);
    const auto for_each_end = [&](const auto& visit) {
      for (const std::uint32_t e : linked)
        for (const std::uint32_t k : {0u, 1u})
          if (const std::uint32_t node = graph_.edges[e].node[k]; is_listed[node])
            visit(node, 2 * e + k);
    };
    for_each_end([&](std::uint32_t node, std::uint32_t) { ++ends_begin_[node]; });
    std::uint32_t count = 0;
    for (std::uint32_t& begin : ends_begin_) begin = count += begin;
    ends_.resize(count);
    for_each_end([&](std::uint32_t node, std::uint32_t end) { ends_[--ends_begin_[node]] = end; });
  }
  /// The ends of edges at a node of a short one: end 2 e + k is node[k] of edge e.
  std::span<const std::uint32_t> ends_at(std::uint32_t node) const {
    return std::span(ends_).subspan(ends_begin_[node], ends_begin_[node + 1] - ends_begin_[node]);
  }
  bool is_branching(std::uint32_t node) const { return ends_at(node).size() > 2; }
  /// The node at the other end of an edge.
  std::uint32_t other_node(std::uint32_t end) const {
    return graph_.edges[end / 2].node[1 - end % 2];
  }

  bool could_be_contracted(const Edge& edge) const {
    const Disk &from = graph_.nodes[edge.node[0]].disk, &to = graph_.nodes[edge.node[1]].disk;
    if (squared_norm(to.center - from.center) <= tolerance_ * tolerance_) return true;
    if (!is_branching(edge.node[0]) || !is_branching(edge.node[1]))
      return boundary_.has_arcs && could_be_at_hub(edge);
    // Seen from both ends, so that it does not matter from which one the walk came.
    const std::uint32_t after = other_contact(edge, edge.node[1], from);
    const std::uint32_t before = after == none ? none : other_contact(edge, edge.node[0], to);
    if (before == none) return false;
    const Disk middle{midpoint(from.center, to.center), 0.5 * (from.radius + to.radius)};
    std::array<ContactOf<double>, 4> contacts;
    bool curved = false;
    for (std::size_t i = 0; const std::uint32_t k : {edge.site[0], edge.site[1], before, after}) {
      contacts[i++] = near_contact(k, middle);
      curved = curved || boundary_.sites[k].is_vertex() || boundary_.sites[k].is_arc();
    }
    // From the middle on, distances to vertices deviate from their tangents by so much.
    const double bend = curved ? 0.125 * squared_norm(to.center - from.center) / middle.radius : 0;
    return std::abs(Dependency<double>(contacts).level) <= bound() + bend;
  }

  /// Whether an edge of which not both ends are branching nodes may be due to rounding: it is not
  /// longer than rounding leaves its end open, and the disk of one end nearly touches all that is
  /// touched at the other.
  bool could_be_at_hub(const Edge& edge) const {
    const Disk &from = graph_.nodes[edge.node[0]].disk, &to = graph_.nodes[edge.node[1]].disk;
    const double open = hub_reach * tolerance_ * play(edge, from);
    if (!(squared_norm(to.center - from.center) <= open * open)) return false;
    const bool first = is_branching(edge.node[0]), second = is_branching(edge.node[1]);
    return (!second && nearly_touches(edge.node[0], edge.node[1])) ||
           (!first && nearly_touches(edge.node[1], edge.node[0]));
  }

  /// How far a disk may move, at most, that stays as near to the edge's two sites: against that
  /// distance. The bisector moves sideways by its inverse sine; where the disk touches an arc all
  /// along, it may move ahead by the inverse of 1 - cos of half of the arc's angle.
  double play(const Edge& edge, const Disk& disk) const {
    const Site &a = boundary_.sites[edge.site[0]], &b = boundary_.sites[edge.site[1]];
    double result = 2 / norm(site::outward(a, disk.center) - site::outward(b, disk.center));
    for (const Site* site : {&a, &b}) {
      if (!site->is_arc() || !touches_all(*site, disk)) continue;
      result = std::max(result, 8 / squared_norm(site->normal() - site->end_normal()));
    }
    return result;
  }
  bool nearly_touches(std::uint32_t hub, std::uint32_t node) const {
    const Disk& disk = graph_.nodes[hub].disk;
    return all_contacts(node, [&](std::uint32_t site) {
      const double away = site::squared_distance(boundary_.sites[site], disk.center);
      return std::abs(std::sqrt(away) - disk.radius) <= hub_reach * tolerance_;
    });
  }

  /// Of a site that bridges divide, the piece that is nearest to a disk: an edge that leads across
  /// a bridge is named after a piece on one side of it.
  std::uint32_t nearest_piece(std::uint32_t site, const Disk& disk) const {
    if (boundary_.bridges.empty()) return site;
    const auto away = [&](std::uint32_t i) {
      return site::squared_distance(boundary_.sites[i], disk.center);
    };
    for (const bool forward : {true, false})
      for (;;) {
        const std::uint32_t beside = forward ? site + 1 : site - 1;
        if (beside >= boundary_.sites.size() || boundary_.elements[beside] != Element::bridge)
          break;
        const std::uint32_t next = boundary_.across(beside, site);
        if (boundary_.originals[next] != boundary_.originals[site] || !(away(next) < away(site)))
          break;
        site = next;
      }
    return site;
  }

  /// Whether something holds for all sites that are touched in a node: those of its edges, and
  /// those on the way around it from each edge to the next.
  template <class Holds>
  bool all_contacts(std::uint32_t node, const Holds& holds) const {
    const std::span<const std::uint32_t> ends = ends_at(node);
    const Boundary::SiteRange& run = boundary_.runs[graph_.nodes[node].component];
    const auto name_of = [&](std::uint32_t site) {
      return std::pair{boundary_.elements[site], boundary_.originals[site]};
    };
    const auto leaves_on = [&](std::uint32_t end) {
      return name_of(graph_.edges[end / 2].site[1 - end % 2]);
    };
    // A hub has thousands of ends.
    constexpr std::size_t few = 16;
    std::vector<std::pair<Element, std::uint32_t>> sorted;
    if (ends.size() > few) {
      for (const std::uint32_t end : ends) sorted.push_back(leaves_on(end));
      std::sort(sorted.begin(), sorted.end());
    }
    const auto is_left_on = [&](std::uint32_t site) {
      const auto name = name_of(site);
      if (ends.size() > few) return ranges::binary_search(sorted, name);
      return ranges::any_of(ends, [&](std::uint32_t end) { return leaves_on(end) == name; });
    };
    for (const std::uint32_t end : ends) {
      const auto& sites = graph_.edges[end / 2].site;
      for (const std::uint32_t site : sites)
        if (!holds(nearest_piece(site, graph_.nodes[node].disk))) return false;
      // Seen from the node, the boundary comes in to it on site[end % 2].
      std::uint32_t site = sites[end % 2], steps = run.last - run.first;
      while (!is_left_on(site) && steps-- > 0) {
        if (site != sites[end % 2] && !holds(site)) return false;
        site = next_on_loop(site, run);
      }
    }
    return true;
  }
  /// What follows a site on its loop, if holes are connected there, too.
  std::uint32_t next_on_loop(std::uint32_t site, const Boundary::SiteRange& run) const {
    const std::uint32_t next = run.after(site);
    return boundary_.elements[next] == Element::bridge ? boundary_.across(next, site) : next;
  }

  /// A contact's equation where the residual is small against the radius, without roots.
  ContactOf<double> near_contact(std::uint32_t i, const Disk& disk) const {
    const Site& site = boundary_.sites[i];
    if (!site.is_vertex()) return contact_of(site, disk);
    const Vec2 to = (1 / disk.radius) * (disk.center - site.point);
    return {to.x, to.y, 0.5 * disk.radius * (squared_norm(to) - 1)};
  }

  /// A site that is touched in a node of the edge, but is not the edge's own; none where one of
  /// them is too far from the disk of the edge's other node.
  std::uint32_t other_contact(const Edge& edge, std::uint32_t node, const Disk& other) const {
    std::uint32_t found = none;
    for (const std::uint32_t end : ends_at(node))
      for (const std::uint32_t site : graph_.edges[end / 2].site) {
        if (site == edge.site[0] || site == edge.site[1] || site == found) continue;
        if (!(std::abs(near_contact(site, other).residual) <= steepest * bound())) return none;
        found = site;
      }
    return found;
  }

  /// The nodes of the edges, increasing, and what each of them touches.
  void collect_nodes(const std::vector<std::uint32_t>& edges) {
    for (const std::uint32_t e : edges)
      for (const std::uint32_t node : graph_.edges[e].node) nodes_.push_back(node);
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    group_.assign(nodes_.size(), none);
    contacts_.resize(nodes_.size());
    parallel_ranges(nodes_.size(), 256, [&](std::size_t i, std::size_t end) {
      for (; i < end; ++i) contacts_[i] = contacts_of(nodes_[i]);
    });
  }
  std::vector<Touch> contacts_of(std::uint32_t node) const {
    std::vector<Touch> contacts;
    const std::span<const std::uint32_t> ends = ends_at(node);
    const auto is_between = [&](std::uint32_t site) {
      if (ends.size() != 1) return false;
      const auto& own = graph_.edges[ends[0] / 2].site;
      return site != own[0] && site != own[1];
    };
    all_contacts(node, [&](std::uint32_t site) {
      add_contact(site, graph_.nodes[node].disk, is_between(site), contacts);
      return true;
    });
    sort_unique(contacts);
    return contacts;
  }
  /// Contacts of several nodes as those of one disk.
  void join(const Disk& disk, std::vector<Touch>& contacts) const {
    for (Touch& contact : contacts)
      if (contact.part == Touch::Part::site) contact.site = nearest_piece(contact.site, disk);
    sort_unique(contacts);
  }
  static void sort_unique(std::vector<Touch>& contacts) {
    std::sort(contacts.begin(), contacts.end());
    contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
  }
  /// The place of a node in `nodes_`; none where it is in no candidate.
  std::uint32_t place_of(std::uint32_t node) const {
    const auto place = std::lower_bound(nodes_.begin(), nodes_.end(), node);
    if (place == nodes_.end() || *place != node) return none;
    return static_cast<std::uint32_t>(place - nodes_.begin());
  }

  /// What a disk near to a given one has to do in order to touch a site. The disk at a leaf stands
  /// for all of a convex arc between its feet: one that touches the arc's ends leaves out the rest.
  void add_contact(std::uint32_t site, const Disk& disk, bool is_between,
                   std::vector<Touch>& contacts) const {
    using Part = Touch::Part;
    const Site& own = boundary_.sites[site];
    if (own.is_arc() && ((is_between && own.curvature > 0) || touches_all(own, disk))) {
      for (const Part part : {Part::start, Part::middle, Part::end})
        contacts.push_back({site, part});
      return;
    }
    contacts.push_back({site});
  }

  /// Whether a disk near to the given one may touch an arc all along.
  bool touches_all(const Site& arc, const Disk& disk) const {
    for (const double s : {0.0, 0.5 * arc.length, arc.length})
      if (!(std::abs(distance(arc.at(s), disk.center) - disk.radius) <= hub_reach * tolerance_))
        return false;
    return true;
  }

  /// Contracts what is so near to each other, and leaves the other edges in `open`.
  void contract(std::vector<std::uint32_t>& open, const Nearness& nearness) {
    const std::size_t first = groups_.size();
    find_groups(open, nearness);
    std::vector<std::uint8_t> fit(groups_.size() - first);
    parallel_ranges(fit.size(), 32, [&](std::size_t i, std::size_t end) {
      for (; i < end; ++i) fit[i] = fits(groups_[first + i]) ? 1 : 0;
    });
    for (std::size_t i = 0; i < fit.size(); ++i) groups_[first + i].contracts = fit[i] != 0;
    // What would turn an edge around is left for the next pair, and so may others be then; what was
    // contracted before stays.
    std::vector<std::uint32_t> backward;
    do {
      backward.clear();
      for (std::size_t i = first; i < groups_.size(); ++i)
        if (groups_[i].contracts) find_backward(groups_[i], first, backward);
      for (const std::uint32_t i : backward) groups_[i].contracts = false;
    } while (!backward.empty());
    std::erase_if(open, [&](std::uint32_t e) {
      const Group* group = group_of(graph_.edges[e].node[0]);
      if (group == nullptr || group != group_of(graph_.edges[e].node[1])) return false;
      contracted_.push_back(e);
      return true;
    });
  }

  /// What edges that are near enough connect, as new groups; leaves those edges in `open`: what is
  /// too far apart now is so for the next pair.
  void find_groups(std::vector<std::uint32_t>& open, const Nearness& nearness) {
    open = those(open, [&](std::uint32_t e) { return is_near(graph_.edges[e], nearness); });
    DisjointSets sets(nodes_.size());
    std::vector<std::uint32_t> places;
    for (const std::uint32_t e : open) {
      const auto [from, to] = graph_.edges[e].node;
      places.insert(places.end(), {place_of(from), place_of(to)});
      sets.join(places.back(), places[places.size() - 2]);
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (const std::uint32_t place : places) {
      const std::uint32_t lowest = sets.find(place);
      if (lowest == place) groups_.emplace_back();
      group_[place] =
          lowest == place ? static_cast<std::uint32_t>(groups_.size() - 1) : group_[lowest];
      groups_[group_[place]].nodes.push_back(nodes_[place]);
    }
  }

  bool is_near(const Edge& edge, const Nearness& nearness) const {
    const auto [from, to] = edge.node;
    const NodeDistance apart(exact_, {graph_.nodes[from].disk, contacts_[place_of(from)]},
                             {graph_.nodes[to].disk, contacts_[place_of(to)]});
    if (!apart.is_short()) return false;
    const double length = nearness.length * tolerance_;
    const auto in_double = apart.is_within_in_double(length, tolerance_);
    if (in_double.value_or(false) || touch_alike(edge, nearness)) return true;
    return in_double ? false : apart.is_within(length);
  }
  /// Whether the disk of one end of an edge or one next to it touches all that is touched at both.
  bool touch_alike(const Edge& edge, const Nearness& nearness) const {
    const auto [from, to] = edge.node;
    const Disk &a = graph_.nodes[from].disk, &b = graph_.nodes[to].disk;
    if (!is_branching(from) || !is_branching(to))
      return nearness.level == nearnesses[0].level && boundary_.has_arcs && could_be_at_hub(edge);
    const std::vector<Touch>&at_from = contacts_[place_of(from)], &at_to = contacts_[place_of(to)];
    std::vector<Touch> both = at_from;
    both.insert(both.end(), at_to.begin(), at_to.end());
    const Disk middle{midpoint(a.center, b.center), 0.5 * (a.radius + b.radius)};
    const Disk& start = at_from.size() == at_to.size()  ? middle
                        : at_from.size() > at_to.size() ? a
                                                        : b;
    join(start, both);
    TieFit fit(tie_sites_, start);
    return fit.fits(both, nearness.level * tolerance_);
  }

  /// Whether one disk touches all that a group's nodes touch, and nothing reaches into it. Around a
  /// hole a group is no tree, and the hole stays.
  bool fits(Group& group) const {
    std::vector<Touch> contacts;
    std::size_t ends = 0;
    Disk mean;  // wherever the walk began
    for (const std::uint32_t node : group.nodes) {
      const std::vector<Touch>& own = contacts_[place_of(node)];
      contacts.insert(contacts.end(), own.begin(), own.end());
      const Disk& disk = graph_.nodes[node].disk;
      mean = {mean.center + disk.center, mean.radius + disk.radius};
      for (const std::uint32_t end : ends_at(node))
        ends += group_of(other_node(end), false) == &group ? 1 : 0;
    }
    if (ends != 2 * (group.nodes.size() - 1)) return false;
    const double share = 1 / static_cast<double>(group.nodes.size());
    mean = {share * mean.center, share * mean.radius};
    join(mean, contacts);
    TieFit fit(tie_sites_, mean);
    if (!fit.fits(contacts, nearnesses[0].level * tolerance_)) return false;
    if (!boundary_.has_arcs) fit.settle(contacts);
    group.disk = fit.disk;
    group.worst = fit.worst;
    return is_empty(fit.disk, graph_.nodes[group.nodes[0]].component);
  }

  /// The group that a node is contracted with, or, if asked so, may be.
  const Group* group_of(std::uint32_t node, bool contracts = true) const {
    const std::uint32_t place = place_of(node);
    if (place == none || group_[place] == none) return nullptr;
    const Group& group = groups_[group_[place]];
    return group.contracts || !contracts ? &group : nullptr;
  }

  bool is_empty(const Disk& disk, std::uint32_t component) const {
    const Boundary::SiteRange& run = boundary_.runs[component];
    return !tree_.nearest(disk.center, disk.radius - tolerance_, run.first, run.last);
  }

  /// Adds the groups, from the first of these on, at both ends of edges that lead elsewhere and no
  /// longer lead forward when the group's nodes have its disk.
  void find_backward(const Group& group, std::size_t first,
                     std::vector<std::uint32_t>& backward) const {
    for (const std::uint32_t node : group.nodes) {
      for (const std::uint32_t end : ends_at(node)) {
        const std::uint32_t node_there = other_node(end);
        const Group* there = group_of(node_there);
        if (there == &group || leads_forward(end / 2)) continue;
        backward.push_back(group_[place_of(node)]);
        if (there != nullptr && group_[place_of(node_there)] >= first)
          backward.push_back(group_[place_of(node_there)]);
      }
    }
  }

  bool leads_forward(std::uint32_t e) const {
    const Edge& edge = graph_.edges[e];
    const site::Bisector bisector(boundary_.sites[edge.site[1]], boundary_.sites[edge.site[0]]);
    return bisector.position(disk_of(edge.node[0]).center) <
               bisector.position(disk_of(edge.node[1]).center) &&
           advances(edge);
  }

  const Disk& disk_of(std::uint32_t node) const {
    const Group* group = group_of(node);
    return group != nullptr ? group->disk : graph_.nodes[node].disk;
  }

  /// Whether the feet move forward on the right site and backward on the left one, but for what
  /// the tolerance leaves open, and the edge still lies on the bisector of the two carriers: its
  /// ends, and the disk halfway, which reaches over nothing else. With the pole of its chord, three
  /// places determine a conic.
  bool advances(const Edge& edge) const {
    const double slack = 4 * tolerance_;
    const Site &left = boundary_.sites[edge.site[0]], &right = boundary_.sites[edge.site[1]];
    const Disk &start = disk_of(edge.node[0]), &end = disk_of(edge.node[1]);
    const Vec2 from = start.center, to = end.center;
    const site::Control control = site::control_of(left, right, start, end);
    // Where an end is off a curved bisector by much against its length, the curve would fold back.
    const Vec2 chord = to - from, bend = control.point.center - from;
    if (!(dot(bend, chord) >= 0 && dot(bend, chord) <= squared_norm(chord))) return false;
    const double share = 0.5 / (1 + control.weight), middle = control.weight / (1 + control.weight);
    const Vec2 halfway = share * (from + to) + middle * control.point.center;
    const double radius = share * (start.radius + end.radius) + middle * control.point.radius;
    // Near an arc's centre, a disk may touch the arc's end although the circle is far away there.
    const auto strays = [&](const Disk& disk, double bound) {
      return !(std::abs(site::carrier_distance(left, disk.center) - disk.radius) <= bound &&
               std::abs(site::carrier_distance(right, disk.center) - disk.radius) <= bound);
    };
    if (strays({halfway, radius}, tolerance_) || strays(start, 2 * tolerance_) ||
        strays(end, 2 * tolerance_))
      return false;
    if (!is_empty({halfway, radius}, graph_.nodes[edge.node[0]].component)) return false;
    const auto moves_forward = [&](const Site& site, Vec2 a, Vec2 b) {
      if (!site.is_vertex())
        return site::carrier_parameter(site, b) - site::carrier_parameter(site, a) >= -slack;
      // Round a vertex, normals turn to the right; that of the nearer disk may be off the most.
      const double furthest = std::max(distance(site.point, a), distance(site.point, b));
      return cross(b - site.point, a - site.point) >= -slack * furthest;
    };
    // From both ends to the pole, too: between sites that are nearly parallel, an end that is off
    // the bisector by rounding may turn the curve so far that a foot first goes back.
    const Vec2 pole = control.point.center;
    const auto moves_all_along = [&](const Site& site, Vec2 a, Vec2 b) {
      return moves_forward(site, a, pole) && moves_forward(site, pole, b);
    };
    return moves_all_along(right, from, to) && moves_all_along(left, to, from);
  }

  /// Takes the contracted edges and the nodes that became others out of the graph; the last ones
  /// take their places.
  void remove() {
    std::vector<std::uint32_t> gone;
    for (const Group& group : groups_) {
      if (!group.contracts) continue;
      double& residual = graph_.statistics.largest_residual;
      residual = std::max(residual, group.worst);
      graph_.nodes[group.nodes[0]].disk = group.disk;
      gone.insert(gone.end(), group.nodes.begin() + 1, group.nodes.end());
      for (const std::uint32_t node : group.nodes)
        for (const std::uint32_t end : ends_at(node))
          graph_.edges[end / 2].node[end % 2] = group.nodes[0];
    }
    std::sort(gone.begin(), gone.end());
    const std::size_t kept = graph_.nodes.size() - gone.size();
    std::vector<std::uint32_t> place(gone.size());
    fill_gaps(graph_.nodes, gone,
              [&](std::uint32_t from, std::uint32_t to) { place[from - kept] = to; });
    for (Edge& edge : graph_.edges)
      for (std::uint32_t& node : edge.node)
        if (node >= kept) node = place[node - kept];
    std::sort(contracted_.begin(), contracted_.end());
    fill_gaps(graph_.edges, contracted_, [](std::uint32_t, std::uint32_t) {});
  }

  const Boundary& boundary_;
  const site::BoundaryTree& tree_;
  const ExactSites& exact_;
  TieSites tie_sites_;
  double tolerance_;
  Graph& graph_;
  /// Of each node, where its ends begin in `ends_`, which has those of short edges' nodes only.
  WorkVector<std::uint32_t> ends_begin_, ends_;
  std::vector<std::uint32_t> nodes_;          ///< of candidates, increasing
  std::vector<std::vector<Touch>> contacts_;  ///< of each of nodes_
  std::vector<std::uint32_t> group_;          ///< of each of nodes_
  std::vector<Group> groups_;
  std::vector<std::uint32_t> contracted_;  ///< edges
};

}  // namespace

void merge_ties(const site::BoundaryTree& tree, const ExactSites& exact, double tolerance,
                Graph& graph) {
  Merger(tree, exact, tolerance, graph).merge();
}

std::vector<std::uint32_t> tie_candidates(const site::BoundaryTree& tree, const ExactSites& exact,
                                          double tolerance, Graph& graph) {
  return Merger(tree, exact, tolerance, graph).candidates();
}

}  // namespace medial::disks
