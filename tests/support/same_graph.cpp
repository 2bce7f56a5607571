#include "support/same_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "base/local_frame.h"
#include "medial/query.h"
#include "methods/exact/contact_graph.h"

namespace medial::test {
namespace {

using exact::ContactGraph;
using exact::Link;
using SitePair = std::array<std::uint32_t, 2>;

/// One axis, and which of its nodes are one after contraction.
class Contracted {
 public:
  Contracted(const MedialAxis& axis, const exact::SiteLoops& outline)
      : axis_(axis), parent_(axis.nodes.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    if (const auto node = ContactGraph::build(axis, outline, graph_))
      failure_ = "the edges around node " + std::to_string(*node) + " are out of order";
    for (Link& link : graph_.links) {
      if (link.site[0] <= link.site[1]) continue;
      std::swap(link.site[0], link.site[1]);
      std::swap(link.node[0], link.node[1]);
    }
  }

  const std::string& failure() const { return failure_; }
  const exact::Links& links() const { return graph_.links; }
  Vec2 end(const Link& link, std::size_t which) const {
    return axis_.nodes[link.node[which]].disk.center;
  }
  std::uint32_t node(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void contract(const Link& link) { parent_[node(link.node[0])] = node(link.node[1]); }

  /// The nodes that have become one, by the one that stands for them.
  std::map<std::uint32_t, std::vector<std::uint32_t>> clusters() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> result;
    for (std::uint32_t i = 0; i < parent_.size(); ++i)
      if (!graph_.contacts(i).empty()) result[node(i)].push_back(i);
    return result;
  }
  const Disk& disk(std::uint32_t i) const { return axis_.nodes[i].disk; }
  /// Whether a disk touches all that the nodes' disks touch.
  bool touched(const std::vector<std::uint32_t>& nodes, const Disk& disk, double tolerance) const {
    return std::all_of(nodes.begin(), nodes.end(), [&](std::uint32_t i) {
      const auto contacts = graph_.contacts(i);
      return std::all_of(contacts.begin(), contacts.end(), [&](const exact::Contact& contact) {
        const Vec2 nearest = foot(axis_.sites[contact.site], disk.center);
        return std::abs(distance(nearest, disk.center) - disk.radius) <= tolerance;
      });
    });
  }

 private:
  const MedialAxis& axis_;
  ContactGraph graph_;
  std::vector<std::uint32_t> parent_;
  std::string failure_;
};

std::string name_of(const Link& link) {
  return "the edge between the sites " + std::to_string(link.site[0]) + " and " +
         std::to_string(link.site[1]);
}

}  // namespace

std::string difference(const Shape& shape, const MedialAxis& a, const MedialAxis& b,
                       double tolerance) {
  const exact::SiteLoops outline = exact::outline_of(Problem(shape, Options{}));
  if (a.sites.size() != b.sites.size()) return "the sites differ";
  Contracted first(a, outline), second(b, outline);
  for (const Contracted* one : {&first, &second})
    if (!one->failure().empty()) return one->failure();

  std::map<SitePair, std::vector<const Link*>> by_sites;
  for (const Link& link : second.links()) by_sites[link.site].push_back(&link);
  std::vector<std::pair<const Link*, const Link*>> common;
  for (const Link& link : first.links()) {
    auto& others = by_sites[link.site];
    const auto off = [&](const Link* other) {
      return distance(first.end(link, 0), second.end(*other, 0)) +
             distance(first.end(link, 1), second.end(*other, 1));
    };
    const auto nearest =
        std::min_element(others.begin(), others.end(),
                         [&](const Link* x, const Link* y) { return off(x) < off(y); });
    if (nearest != others.end()) {
      common.emplace_back(&link, *nearest);
      others.erase(nearest);
    } else {
      first.contract(link);
    }
  }
  for (const auto& [pair, others] : by_sites)
    for (const Link* link : others) second.contract(*link);

  std::map<std::uint32_t, std::uint32_t> forth, back;
  for (const auto& [x, y] : common) {
    for (std::size_t i = 0; i < 2; ++i) {
      const std::uint32_t u = first.node(x->node[i]), v = second.node(y->node[i]);
      if (forth.emplace(u, v).first->second != v || back.emplace(v, u).first->second != u)
        return name_of(*x) + " ends in different nodes";
    }
  }

  const auto those = first.clusters(), these = second.clusters();
  if (those.size() != these.size()) return "the numbers of nodes differ";
  for (const auto& entry : those) {
    const std::vector<std::uint32_t>& nodes = entry.second;
    const auto other = forth.find(entry.first);
    if (other == forth.end()) continue;  // the centre of a disk: no edge leads there
    const std::vector<std::uint32_t>& others = these.at(other->second);
    if (nodes.size() == 1 && others.size() == 1) continue;
    const auto touches_all = [&](const Disk& disk) {
      return first.touched(nodes, disk, tolerance) && second.touched(others, disk, tolerance);
    };
    if (!std::any_of(nodes.begin(), nodes.end(),
                     [&](std::uint32_t i) { return touches_all(first.disk(i)); }) &&
        !std::any_of(others.begin(), others.end(),
                     [&](std::uint32_t i) { return touches_all(second.disk(i)); }))
      return "no disk touches all sites around node " + std::to_string(nodes[0]);
  }
  return {};
}

}  // namespace medial::test
