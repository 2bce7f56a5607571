#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/numbers.h"
#include "methods/problem.h"
#include "site/site.h"

namespace medial::lee {

/// How an element joins a neighbour, if disks can touch both only at one point.
enum class Beside : std::uint8_t {
  no,
  smooth,  ///< with one tangent, or a vertex: along a spoke
  blunt,   ///< at a convex angle too small for a leaf of the axis
};

/// The elements of a shape, in the local frame: the list e_1, ..., e_N of Section II for every
/// component. These are segments, arcs and reflex vertices in boundary order, from a convex vertex
/// on, or if there is none, from a smooth joint. Holes are spliced in where bridges touch
/// (methods/disks/connect.h), so that a list is the boundary of a simply connected shape; an
/// element that a bridge touches is divided into pieces.
struct Elements {
  /// The chains of one component (Definition 9). A bridge also ends a chain and begins another, and
  /// a convex arc is a chain by itself.
  struct ChainLoop {
    std::uint32_t first_chain = 0;
    std::uint32_t end_chain = 0;
    std::uint32_t component = 0;
    std::uint32_t size = 0;  ///< elements, without those that represent bridges
  };
  /// A place where a list passes from one loop to another, along a bridge. Two additional elements
  /// represent the bridge's disk: halves of its tangents at both feet, so that a vertex that it
  /// touches has neighbours like any other.
  struct Passage {
    std::uint32_t begin = 0;  ///< the second of these, which begins a chain
    std::uint32_t bridge = 0;
  };
  std::vector<site::Site> sites;
  std::vector<std::uint32_t> originals;  ///< index among the result's sites; none: part of a bridge
  /// The first element of every chain: an edge that begins at a convex vertex, a convex arc or the
  /// element after one, or the second element of a passage. The last entry is the number of
  /// elements.
  std::vector<std::uint32_t> chains;
  std::vector<ChainLoop> loops;
  std::vector<Passage> passages;  ///< in the order of the lists, two per bridge
  std::vector<Disk> disks_of_passages;
  /// For a shape with arcs: how each element joins the next one; and how the first and the last
  /// element of a list join.
  std::vector<Beside> joints, around;

  std::uint32_t size() const { return static_cast<std::uint32_t>(sites.size()); }
  bool is_vertex(std::uint32_t i) const { return sites[i].is_vertex(); }
  bool is_of_bridge(std::uint32_t i) const { return originals[i] == none; }
  bool have_arcs() const { return !joints.empty(); }
  bool is_convex_arc(std::uint32_t i) const { return sites[i].curvature > 0; }
  /// How two elements of a shape with arcs join, i before j.
  Beside beside(std::uint32_t i, std::uint32_t j) const {
    if (j - i == 1) return joints[i];
    return around[i] == around[j] ? around[i] : Beside::no;
  }

  /// The element before a vertex.
  std::uint32_t before(std::uint32_t vertex) const {
    if (!have_arcs() || around[vertex] == Beside::no) return vertex - 1;
    const auto loop = std::find_if(loops.begin(), loops.end(), [&](const ChainLoop& one) {
      return chains[one.first_chain] == vertex;
    });
    return chains[loop->end_chain] - 1;
  }

  /// The first passage that begins at an element or later.
  const Passage& passage_from(std::uint32_t element) const {
    return *std::lower_bound(
        passages.begin(), passages.end(), element,
        [](const Passage& passage, std::uint32_t e) { return passage.begin < e; });
  }
};

/// Returns none if an outer loop of straight edges has no convex vertex; every simple polygon has
/// one. O(n), and expected O(h log n) with h holes.
std::optional<Elements> elements_of(const Problem& problem);

}  // namespace medial::lee
