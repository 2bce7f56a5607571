#include "methods/exact/certify.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/compat.h"
#include "base/local_frame.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "medial/query.h"
#include "methods/exact/contact_graph.h"
#include "methods/exact/disk_bounds.h"
#include "methods/exact/divide.h"
#include "methods/exact/replace_nodes.h"

namespace medial::exact {
namespace {

/// Blocks whose counts are added up in order.
constexpr std::size_t block = 1 << 10;

void sort_unique(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

template <class Work>
Decisions sum_in_blocks(std::size_t count, const Work& work) {
  Decisions all;
  for (const Decisions& part : in_blocks<Decisions>(count, block, work)) all.add(part);
  return all;
}

class Certifier {
 public:
  Certifier(const SiteLoops& outline, const LocalFrame& frame, MedialAxis& axis,
            ContactGraph& graph)
      : outline_(outline), frame_(frame), axis_(axis), graph_(graph), links_(graph.links) {}

  /// The place of a failure, or none.
  std::optional<Vec2> run() {
    check_nodes();
    std::vector<std::uint32_t> doubtful = doubtful_links();
    std::vector<std::uint32_t> apart;
    for (std::uint32_t node = 0; node < states_.size(); ++node)
      if (states_[node].divides) apart.push_back(node);
    // What is put in order may ask for its neighbours to be so, too.
    constexpr int most_rounds = 64;
    for (int round = 0; !doubtful.empty() || !apart.empty(); ++round) {
      if (round == most_rounds)
        return place_of(doubtful.empty() ? apart[0] : links_[doubtful[0]].node[0]);
      std::vector<std::uint32_t> changed;
      if (const auto failed = resolve(doubtful, apart, changed)) return place_of(*failed);
      apart.clear();
      const std::vector<std::uint32_t> around = doubtful_around(changed);
      doubtful.insert(doubtful.end(), around.begin(), around.end());
      sort_unique(doubtful);
    }
    std::vector<std::span<const Contact>> alive;
    for (std::uint32_t node = 0; node < states_.size(); ++node)
      if (!states_[node].gone) alive.push_back(graph_.contacts(node));
    if (const auto left_out = find_site_left_out(alive, outline_))
      return frame_.to_input(outline_.sites[*left_out].start);
    if (changes_ > 0) replace_nodes(outline_, frame_, graph_, replaced(), axis_);
    return std::nullopt;
  }

  const Decisions& decisions() const { return decisions_; }
  std::uint64_t changes() const { return changes_; }

 private:
  struct State {
    std::optional<DiskBounds<double>> bounds;
    /// The nodes that more than three contacts are divided into where no one disk touches them.
    std::vector<std::vector<std::uint32_t>> divided;
    bool divides = false;
    bool gone = false;
    bool added = false;
  };

  Replaced replaced() const {
    Replaced replaced;
    for (const State& state : states_) {
      replaced.gone.push_back(state.gone);
      replaced.added.push_back(state.added);
    }
    replaced.gone_edges = gone_edges_;
    return replaced;
  }

  Vec2 place_of(std::uint32_t node) const { return axis_.nodes[node].disk.center; }
  Disk local(std::uint32_t node) const {
    const Disk& disk = axis_.nodes[node].disk;
    return {frame_.to_local(disk.center), frame_.scale * disk.radius};
  }

  std::vector<std::uint32_t> sites_of(std::span<const Contact> contacts) const {
    std::vector<std::uint32_t> sites;
    for (const Contact& contact : contacts) sites.push_back(contact.site);
    return sites;
  }

  /// Three contacts of a node that settle its disk well: where two are joined, these and the one
  /// that is seen furthest from them, otherwise three in directions far apart.
  std::optional<std::array<std::uint32_t, 3>> three_of(std::span<const Contact> contacts,
                                                       const Disk& disk) const {
    const std::size_t count = contacts.size();
    if (count < 3) return std::nullopt;
    if (count == 3) return std::array{contacts[0].site, contacts[1].site, contacts[2].site};
    std::vector<Vec2> toward(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Site& site = axis_.sites[contacts[i].site];
      const Vec2 local_foot = frame_.to_local(medial::foot(site, frame_.to_input(disk.center)));
      toward[i] = local_foot - disk.center;
    }
    const auto joined = [&](std::size_t i) {
      return outline_.joined(contacts[i].site, contacts[(i + 1) % count].site);
    };
    std::size_t a = 0;
    while (a < count && !joined(a)) ++a;
    if (a < count) {
      const std::size_t b = (a + 1) % count;
      if (joined(b) && outline_.sites[contacts[b].site].bulge > 0)
        return std::array{contacts[a].site, contacts[b].site, contacts[(b + 1) % count].site};
      std::size_t far = count;
      for (std::size_t i = 0; i < count; ++i) {
        if (i == a || i == b || outline_.joined(contacts[b].site, contacts[i].site) ||
            outline_.joined(contacts[i].site, contacts[a].site))
          continue;
        if (far == count ||
            squared_norm(toward[i] - toward[a]) > squared_norm(toward[far] - toward[a]))
          far = i;
      }
      if (far == count) return std::nullopt;
      return std::array{contacts[a].site, contacts[b].site, contacts[far].site};
    }
    std::size_t second = 1;
    for (std::size_t i = 2; i < count; ++i)
      if (squared_norm(toward[i] - toward[0]) > squared_norm(toward[second] - toward[0]))
        second = i;
    std::size_t third = 0;
    double largest = -1;
    for (std::size_t i = 1; i < count; ++i) {
      const double size = std::abs(cross(toward[second] - toward[0], toward[i] - toward[0]));
      if (i == second || !(size > largest)) continue;
      largest = size;
      third = i;
    }
    return std::array{contacts[0].site, contacts[std::min(second, third)].site,
                      contacts[std::max(second, third)].site};
  }

  template <class Real>
  std::optional<DiskBounds<Real>> bounds_of(std::uint32_t node) const {
    return bounds_of<Real>(graph_.contacts(node), local(node));
  }
  template <class Real>
  std::optional<DiskBounds<Real>> bounds_of(std::span<const Contact> contacts,
                                            const Disk& near) const {
    if (is_corner(contacts, outline_)) {
      const std::uint32_t before = contacts[0].half == no_half ? 0 : 1;
      const Vec2 corner = outline_.sites[contacts[before].site].end;
      return DiskBounds<Real>{exact_vector<Bounded<Real>>(corner), Bounded<Real>(0.0)};
    }
    const auto three = three_of(contacts, near);
    if (!three) return std::nullopt;
    return disk_bounds<Real>(outline_, *three, near);
  }

  void check_nodes() {
    states_.resize(graph_.node_count());
    decisions_.add(sum_in_blocks(states_.size(), [&](std::size_t i, Decisions& decisions) {
      const auto node = static_cast<std::uint32_t>(i);
      const auto contacts = graph_.contacts(node);
      if (contacts.size() > 3 && axis_.nodes[node].disk.radius > 0) {
        auto nodes = divide(outline_, sites_of(contacts), decisions);
        states_[i].divides = nodes.size() > 1;
        if (states_[i].divides) states_[i].divided = std::move(nodes);
      }
      states_[i].bounds = bounds_of<double>(node);
    }));
  }

  /// Whether a link runs forward on the site on its right and backward on that on its left: 1, -1
  /// for the opposite, none where that is open.
  template <class Real>
  std::optional<int> direction_of(std::uint32_t link, const std::optional<DiskBounds<Real>>& from,
                                  const std::optional<DiskBounds<Real>>& to) const {
    if (!from || !to) return std::nullopt;
    // A corner is where both sites begin.
    for (const std::uint32_t node : links_[link].node)
      if (is_corner(graph_.contacts(node), outline_)) return 1;
    const auto [left, right] = links_[link].site;
    const auto forward = further_along(outline_.sites[right], *from, *to);
    if (forward && *forward != 0) return forward;
    const auto backward = further_along(outline_.sites[left], *to, *from);
    if (backward && *backward != 0) return backward;
    return std::nullopt;
  }

  std::optional<int> direction_in_precise(std::uint32_t link) const {
    const auto [from, to] = links_[link].node;
    return direction_of(link, bounds_of<Precise>(from), bounds_of<Precise>(to));
  }

  std::vector<std::uint32_t> doubtful_links() {
    std::vector<std::vector<std::uint32_t>> found((links_.size() + block - 1) / block);
    decisions_.add(sum_in_blocks(links_.size(), [&](std::size_t i, Decisions& decisions) {
      const auto link = static_cast<std::uint32_t>(i);
      const auto [from, to] = links_[i].node;
      if (states_[from].divides || states_[to].divides) {
        found[i / block].push_back(link);
        return;
      }
      auto direction = direction_of(link, states_[from].bounds, states_[to].bounds);
      if (direction) {
        ++decisions.filtered;
      } else {
        direction = direction_in_precise(link);
        if (direction) ++decisions.precise;
      }
      if (direction != 1) found[i / block].push_back(link);
    }));
    std::vector<std::uint32_t> doubtful;
    for (const auto& some : found) {
      for (const std::uint32_t link : some) {
        const auto [from, to] = links_[link].node;
        // Nodes that are divided first: their links are looked at again when that is done.
        if (!states_[from].divides && !states_[to].divides) doubtful.push_back(link);
      }
    }
    return doubtful;
  }

  /// The links at new nodes that do not run forward for certain.
  std::vector<std::uint32_t> doubtful_around(const std::vector<std::uint32_t>& nodes) {
    std::vector<std::uint32_t> links;
    for (const std::uint32_t node : nodes)
      for (const Contact& contact : graph_.contacts(node))
        if (contact.half != no_half) links.push_back(contact.half / 2);
    sort_unique(links);
    std::erase_if(links, [&](std::uint32_t link) {
      const auto [from, to] = links_[link].node;
      auto direction = direction_of(link, states_[from].bounds, states_[to].bounds);
      if (direction) {
        ++decisions_.filtered;
      } else {
        direction = direction_in_precise(link);
        ++decisions_.precise;
      }
      // Links between new nodes have been decided already.
      const bool inner = link >= link_count_;
      return inner ? direction != -1 : direction == 1;
    });
    return links;
  }

  /// Puts nodes and the links between them in their true order. `changed` gets the new nodes,
  /// `links` those of clusters that have to be larger.
  std::optional<std::uint32_t> resolve(std::vector<std::uint32_t>& links,
                                       const std::vector<std::uint32_t>& apart,
                                       std::vector<std::uint32_t>& changed) {
    inner_.resize(links_.size(), false);
    parent_.clear();
    const auto find = [&](std::uint32_t node) {
      while (parent_.at(node) != node) node = parent_[node] = parent_.at(parent_.at(node));
      return node;
    };
    for (const std::uint32_t node : apart) parent_.emplace(node, node);
    for (const std::uint32_t link : links) {
      inner_[link] = true;
      const auto [from, to] = links_[link].node;
      parent_.emplace(from, from);
      parent_.emplace(to, to);
      const std::uint32_t a = find(from), b = find(to);
      if (a == b) return from;  // a cycle around nothing
      parent_[std::max(a, b)] = std::min(a, b);
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> clusters;
    for (const auto& [node, parent] : parent_) clusters[find(node)].push_back(node);
    std::vector<std::uint32_t> wider;
    for (const auto& [first, nodes] : clusters)
      if (!resolve_cluster(nodes, changed) && !widen(nodes, wider)) return first;
    for (const std::uint32_t link : links) inner_[link] = false;
    links = std::move(wider);
    return std::nullopt;
  }

  /// Where no disk touches what a cluster is divided into, it is part of a larger one, with the
  /// links that leave its nodes, but for those to corners. False if there are none.
  bool widen(const std::vector<std::uint32_t>& nodes, std::vector<std::uint32_t>& wider) const {
    bool grows = false;
    for (const std::uint32_t node : nodes) {
      for (const Contact& contact : graph_.contacts(node)) {
        if (contact.half == no_half) continue;
        if (is_corner(graph_.contacts(from_node(links_, twin(contact.half))), outline_)) continue;
        wider.push_back(contact.half / 2);
        grows = grows || !inner_[contact.half / 2];
      }
    }
    return grows;
  }

  /// Where a half stands among the contacts of the node that it leaves.
  struct Position {
    std::uint32_t node, index;
  };
  Position position_of(Half half) const {
    const std::uint32_t node = from_node(links_, half);
    const auto contacts = graph_.contacts(node);
    for (std::uint32_t i = 0; i < contacts.size(); ++i)
      if (contacts[i].half == half) return {node, i};
    return {node, 0};
  }

  /// The contacts around a cluster of nodes as if they were one node.
  std::vector<Contact> outer_contacts(const std::vector<std::uint32_t>& nodes) const {
    std::size_t count = 0;
    std::optional<Position> begin;
    for (const std::uint32_t node : nodes) {
      const auto contacts = graph_.contacts(node);
      for (std::uint32_t i = 0; i < contacts.size(); ++i) {
        const Half half = contacts[i].half;
        if (half != no_half && inner_[half / 2]) continue;
        ++count;
        if (!begin) begin = Position{node, i};
      }
    }
    std::vector<Contact> outer;
    if (!begin) return outer;
    Position at = *begin;
    do {
      const auto contacts = graph_.contacts(at.node);
      const Contact& contact = contacts[at.index];
      if (contact.half != no_half && inner_[contact.half / 2]) {
        at = position_of(twin(contact.half));
      } else {
        outer.push_back(contact);
      }
      at.index = (at.index + 1) % static_cast<std::uint32_t>(graph_.contacts(at.node).size());
    } while ((at.node != begin->node || at.index != begin->index) && outer.size() <= count);
    return outer;
  }

  /// Whether the nodes touch the same sites as those they would be divided into.
  bool is_divided_so(const std::vector<std::uint32_t>& nodes, const std::vector<Contact>& outer,
                     const std::vector<std::vector<std::uint32_t>>& divided) const {
    if (nodes.size() != divided.size()) return false;
    std::vector<std::vector<std::uint32_t>> before, after;
    for (const std::uint32_t node : nodes) before.push_back(sites_of(graph_.contacts(node)));
    for (const auto& places : divided) {
      auto& sites = after.emplace_back();
      for (const std::uint32_t place : places) sites.push_back(outer[place].site);
    }
    for (auto* all : {&before, &after}) {
      for (auto& sites : *all) std::sort(sites.begin(), sites.end());
      std::sort(all->begin(), all->end());
    }
    return before == after;
  }

  bool resolve_cluster(const std::vector<std::uint32_t>& nodes,
                       std::vector<std::uint32_t>& changed) {
    const std::vector<Contact> outer = outer_contacts(nodes);
    if (outer.size() < 3) return false;
    // A node alone has been looked at already; its contacts stand in the same order.
    const bool known = nodes.size() == 1 && states_[nodes[0]].divides;
    const auto divided = known ? std::move(states_[nodes[0]].divided)
                               : divide(outline_, sites_of(outer), decisions_);
    if (is_divided_so(nodes, outer, divided)) return true;
    const std::uint32_t old = nodes.front();
    std::vector<Placed> placed;
    for (const auto& places : divided) {
      std::vector<Contact> contacts;
      for (const std::uint32_t place : places) contacts.push_back({outer[place].site, no_half});
      auto one = place(contacts, local(old));
      if (!one) return false;
      placed.push_back(*one);
    }
    ++changes_;
    for (const std::uint32_t node : nodes) {
      states_[node].gone = true;
      for (const Contact& contact : graph_.contacts(node))
        if (contact.half != no_half && inner_[contact.half / 2])
          for (const Link::End end : links_[contact.half / 2].end) gone_edges_.push_back(end.edge);
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, Half> chords;  // left half for the other node
    for (std::size_t k = 0; k < divided.size(); ++k) {
      const auto& places = divided[k];
      const auto node = static_cast<std::uint32_t>(axis_.nodes.size());
      axis_.nodes.push_back(axis_.nodes[old]);
      axis_.nodes.back().disk = placed[k].disk;
      std::vector<Contact> contacts;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const std::uint32_t here = places[i], next = places[(i + 1) % places.size()];
        Contact contact{outer[here].site, no_half};
        if (next == (here + 1) % outer.size()) {
          contact.half = outer[here].half;
          if (contact.half != no_half) begin_at(contact.half, node);
        } else if (const auto chord = chords.find({next, here}); chord != chords.end()) {
          contact.half = twin(chord->second);
          begin_at(contact.half, node);
        } else {
          contact.half = 2 * static_cast<Half>(links_.size());
          const auto edge = static_cast<std::uint32_t>(axis_.edges.size());
          const std::array nodes_so_far{node, node};
          const std::array sites{outer[next].site, outer[here].site};
          axis_.edges.push_back({nodes_so_far, sites, {}, 1});
          links_.push_back({nodes_so_far, sites, {Link::End{edge, 0}, Link::End{edge, 1}}});
          inner_.push_back(false);
          chords.emplace(std::pair{here, next}, contact.half);
        }
        contacts.push_back(contact);
      }
      graph_.append(contacts);
      states_.push_back({placed[k].bounds, {}, false, false, true});
      changed.push_back(node);
    }
    return true;
  }

  void begin_at(Half half, std::uint32_t node) {
    Link& link = links_[half / 2];
    link.node[half % 2] = node;
    const Link::End end = link.end[half % 2];
    axis_.edges[end.edge].node[end.which] = node;
  }

  /// A new node's disk, and its bounds in double.
  struct Placed {
    std::optional<DiskBounds<double>> bounds;
    Disk disk;
  };
  /// None where no disk near to the given one touches all contacts.
  std::optional<Placed> place(std::span<const Contact> contacts, const Disk& near) const {
    const auto rough = bounds_of<double>(contacts, near);
    // Where double knows the disk to its last digits.
    if (rough && rough->center.x.error + rough->center.y.error + rough->radius.error <
                     0x1p-50 * rough->radius.value)
      return Placed{rough, input_disk(*rough)};
    const auto bounds = bounds_of<Precise>(contacts, near);
    if (!bounds) return std::nullopt;
    return Placed{rough, input_disk(*bounds)};
  }
  template <class Real>
  Disk input_disk(const DiskBounds<Real>& bounds) const {
    const Vec2 center{static_cast<double>(bounds.center.x.value),
                      static_cast<double>(bounds.center.y.value)};
    return {frame_.to_input(center), frame_.inverse * static_cast<double>(bounds.radius.value)};
  }

  const SiteLoops& outline_;
  const LocalFrame& frame_;
  MedialAxis& axis_;
  ContactGraph& graph_;
  Links& links_;
  const std::size_t link_count_ = links_.size();
  std::vector<State> states_;
  std::vector<bool> inner_;  ///< edges inside of clusters
  std::map<std::uint32_t, std::uint32_t> parent_;
  std::vector<std::uint32_t> gone_edges_;
  Decisions decisions_;
  std::uint64_t changes_ = 0;
};

}  // namespace

Status certify(const Problem& problem, MedialAxis& axis) {
  Stopwatch watch;
  const SiteLoops outline = outline_of(problem, problem.numbers());
  ContactGraph graph;
  // Arcs that join smoothly only to within the tolerance, on one circle but for that, may have no
  // disk that touches all around them (docs/exact.md, Limits). Between segments nothing is rounded.
  const bool has_arcs = !problem.shape.bulges.empty();
  const auto failure = [has_arcs](Vec2 place) {
    Error error{ErrorCode::internal,
                "the axis could not be made certain here: please report this shape",
                {}};
    if (has_arcs)
      error = {ErrorCode::unsupported,
               "the axis could not be made certain here, because arcs lie on one circle "
               "up to rounding; it can be computed without `exact`",
               {}};
    error.place.point = place;
    return error;
  };
  if (const auto node = ContactGraph::build(axis, outline, graph))
    return failure(axis.nodes[*node].disk.center);
  Certifier certifier(outline, problem.frame, axis, graph);
  if (const auto place = certifier.run()) return failure(*place);
  Statistics& statistics = axis.statistics;
  const Decisions& decisions = certifier.decisions();
  statistics.exact_filtered = decisions.filtered;
  statistics.exact_twofold = decisions.twofold;
  statistics.exact_precise = decisions.precise;
  statistics.exact_rational = decisions.rational;
  statistics.exact_ties = decisions.ties;
  statistics.exact_changes = certifier.changes();
  statistics.seconds_exact = watch.lap();
  statistics.seconds += statistics.seconds_exact;
  return success();
}

}  // namespace medial::exact
