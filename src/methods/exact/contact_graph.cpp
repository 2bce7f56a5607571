#include "methods/exact/contact_graph.h"

#include <algorithm>
#include <numeric>

#include "axis/steps.h"
#include "medial/query.h"

namespace medial::exact {
namespace {

/// Whether a node only divides the way between two others: its two edges have the same two sites.
bool divides_link(const MedialAxis& axis, const Incidence& incidence, std::uint32_t node) {
  if (incidence.degree(node) != 2) return false;
  const Edge &a = axis.edges[incidence.edges(node)[0]], &b = axis.edges[incidence.edges(node)[1]];
  if (&a == &b) return false;
  const bool a_leaves = a.node[0] == node, b_leaves = b.node[0] == node;
  return a_leaves == b_leaves ? a.site[0] == b.site[1] && a.site[1] == b.site[0] : a.site == b.site;
}

/// The axis' links, in the order of their first edges.
Links links_of(const MedialAxis& axis, const Incidence& incidence, const std::vector<bool>& inner) {
  Links links;
  links.reserve(axis.edges.size());
  std::vector<bool> used(axis.edges.size(), false);
  for (std::uint32_t first = 0; first < axis.edges.size(); ++first) {
    const Edge& edge = axis.edges[first];
    if (used[first] || (inner[edge.node[0]] && inner[edge.node[1]])) continue;
    // From an end that is no inner node on.
    const std::uint32_t begin = inner[edge.node[0]] ? 1 : 0;
    std::uint32_t last = first, end = 1 - begin;
    used[first] = true;
    while (inner[axis.edges[last].node[end]]) {
      const std::uint32_t node = axis.edges[last].node[end];
      const auto around = incidence.edges(node);
      last = around[0] == last ? around[1] : around[0];
      end = axis.edges[last].node[0] == node ? 1 : 0;
      used[last] = true;
    }
    links.push_back({{edge.node[begin], axis.edges[last].node[end]},
                     {edge.site[begin], edge.site[1 - begin]},
                     {Link::End{first, begin}, Link::End{last, end}}});
  }
  return links;
}

/// The halves that leave a node, by the sites on their right, and from there the contacts in order.
class NodeReader {
 public:
  NodeReader(const Links& links, const SiteLoops& outline) : links_(links), outline_(outline) {}

  /// Requires a half.
  bool read(std::span<const Half> halves, std::vector<Contact>& contacts) {
    halves_.assign(halves.begin(), halves.end());
    std::sort(halves_.begin(), halves_.end(),
              [&](Half a, Half b) { return right_site(links_, a) < right_site(links_, b); });
    contacts.clear();
    const std::size_t most = outline_.sites.size() + halves_.size();
    std::size_t left = halves_.size();
    for (Half half = halves_[0];;) {
      contacts.push_back({right_site(links_, half), half});
      --left;
      // The next one leaves at the same site or at one that is joined to it.
      std::uint32_t site = left_site(links_, half);
      Half next = leaving_at(site);
      while (next == no_half) {
        contacts.push_back({site, no_half});
        const bool corner = !outline_.passes[site];
        if (contacts.size() > most || (corner && halves_.size() > 1)) return false;
        site = outline_.next_of(site);
        next = leaving_at(site);
      }
      if (next == halves_[0]) return left == 0;
      if (left == 0) return false;
      half = next;
    }
  }

 private:
  Half leaving_at(std::uint32_t site) const {
    const auto found =
        std::lower_bound(halves_.begin(), halves_.end(), site,
                         [&](Half half, std::uint32_t s) { return right_site(links_, half) < s; });
    return found != halves_.end() && right_site(links_, *found) == site ? *found : no_half;
  }

  const Links& links_;
  const SiteLoops& outline_;
  std::vector<Half> halves_;
};

}  // namespace

std::optional<std::uint32_t> ContactGraph::build(const MedialAxis& axis, const SiteLoops& outline,
                                                 ContactGraph& graph) {
  const Incidence incidence(axis);
  graph.begin_.assign(1, 0);
  graph.begin_.reserve(axis.nodes.size() + 1);
  graph.contacts_.clear();
  graph.contacts_.reserve(4 * axis.edges.size());
  std::vector<bool> inner(axis.nodes.size());
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node)
    inner[node] = divides_link(axis, incidence, node);
  graph.links = links_of(axis, incidence, inner);
  std::vector<std::size_t> leaving_begin(axis.nodes.size() + 1, 0);
  for (const Link& link : graph.links)
    for (const std::uint32_t node : link.node) ++leaving_begin[node + 1];
  std::partial_sum(leaving_begin.begin(), leaving_begin.end(), leaving_begin.begin());
  std::vector<Half> leaving(leaving_begin.back());
  std::vector<std::size_t> next_leaving(leaving_begin.begin(), leaving_begin.end() - 1);
  for (Half half = 0; half < 2 * graph.links.size(); ++half)
    leaving[next_leaving[from_node(graph.links, half)]++] = half;
  NodeReader reader(graph.links, outline);
  std::vector<Contact> contacts;
  std::uint32_t loop = 0;
  for (std::uint32_t node = 0; node < axis.nodes.size(); ++node) {
    const auto halves = std::span(leaving).subspan(leaving_begin[node],
                                                   leaving_begin[node + 1] - leaving_begin[node]);
    contacts.clear();
    if (inner[node]) {
      // Nothing changes here.
    } else if (halves.empty()) {
      // A disk: the next loop that is smooth all around.
      const auto is_round = [&](std::uint32_t l) {
        return std::all_of(outline.passes.begin() + outline.loop_begin[l],
                           outline.passes.begin() + outline.loop_begin[l + 1],
                           [](bool passes) { return passes; }) &&
               outline.component[l] == axis.nodes[node].component;
      };
      while (loop + 1 < outline.loop_begin.size() && !is_round(loop)) ++loop;
      if (loop + 1 >= outline.loop_begin.size()) return node;
      std::uint32_t site = outline.loop_begin[loop];
      do {
        contacts.push_back({site, no_half});
        site = outline.next_of(site);
      } while (site != outline.loop_begin[loop]);
      ++loop;
    } else if (!reader.read(halves, contacts)) {
      return node;
    }
    graph.append(contacts);
  }
  return std::nullopt;
}

std::optional<std::uint32_t> find_site_left_out(std::span<const std::span<const Contact>> nodes,
                                                const SiteLoops& outline) {
  std::vector<std::uint8_t> entered(outline.sites.size(), 0);
  for (const auto contacts : nodes) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (contacts[i].half != no_half) continue;
      std::uint8_t& count = entered[contacts[i + 1 < contacts.size() ? i + 1 : 0].site];
      count = static_cast<std::uint8_t>(std::min(2, count + 1));
    }
  }
  const auto wrong =
      std::find_if(entered.begin(), entered.end(), [](std::uint8_t n) { return n != 1; });
  if (wrong == entered.end()) return std::nullopt;
  return static_cast<std::uint32_t>(wrong - entered.begin());
}

}  // namespace medial::exact
