#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "methods/exact/outline.h"

namespace medial::exact {

/// What lies between two nodes where the contacts change: an edge of the axis, or several in a
/// chain whose inner nodes only divide it, because the curve of an edge on a long arc has several
/// pieces.
struct Link {
  std::array<std::uint32_t, 2> node;  ///< from, to
  std::array<std::uint32_t, 2> site;  ///< on the left and on the right
  /// Where the axis names the nodes: edge and which of its ends.
  struct End {
    std::uint32_t edge = 0;
    std::uint32_t which = 0;
  };
  std::array<End, 2> end;
};

/// A direction along a link: twice its index, and one more from its second node to its first. It
/// has a site on its right and one on its left.
using Half = std::uint32_t;
constexpr Half no_half = ~Half{0};
inline Half twin(Half half) { return half ^ 1; }

using Links = std::vector<Link>;
inline std::uint32_t from_node(const Links& links, Half half) {
  return links[half / 2].node[half % 2];
}
inline std::uint32_t right_site(const Links& links, Half half) {
  return links[half / 2].site[1 - half % 2];
}
inline std::uint32_t left_site(const Links& links, Half half) {
  return links[half / 2].site[half % 2];
}

/// A site that a node's disk touches, and what lies between it and the next one around the disk,
/// counter-clockwise, which is forward along the boundary: a link that leaves there, or none where
/// the two sites are joined, or meet in the corner where the node is.
struct Contact {
  std::uint32_t site = 0;
  Half half = no_half;
};

/// The contacts of every node in order: the axis as the dual of a division of the boundary's sites.
class ContactGraph {
 public:
  Links links;

  /// Fails with the node where the edges around it do not follow each other along the boundary.
  static std::optional<std::uint32_t> build(const MedialAxis& axis, const SiteLoops& outline,
                                            ContactGraph& graph);

  /// None for an inner node of a link.
  std::span<const Contact> contacts(std::uint32_t node) const {
    return std::span(contacts_).subspan(begin_[node], begin_[node + 1] - begin_[node]);
  }
  std::size_t node_count() const { return begin_.size() - 1; }
  /// One more node.
  void append(std::span<const Contact> contacts) {
    contacts_.insert(contacts_.end(), contacts.begin(), contacts.end());
    begin_.push_back(contacts_.size());
  }

 private:
  std::vector<Contact> contacts_;
  std::vector<std::size_t> begin_{0};
};

/// A convex corner, where the axis ends with radius 0.
inline bool is_corner(std::span<const Contact> contacts, const SiteLoops& outline) {
  if (contacts.size() != 2) return false;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::uint32_t before = contacts[i].site;
    if (contacts[i].half == no_half && outline.next_of(before) == contacts[1 - i].site &&
        (!outline.passes[before] || outline.blunt[before]))
      return true;
  }
  return false;
}

/// Whether going along the axis, with the boundary on the right, leads along every loop once: each
/// site is come to once from the one before it. Otherwise a site where it is not so.
std::optional<std::uint32_t> find_site_left_out(std::span<const std::span<const Contact>> nodes,
                                                const SiteLoops& outline);

}  // namespace medial::exact
