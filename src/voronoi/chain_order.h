#pragma once

#include <cstdint>
#include <functional>
#include <span>

namespace medial::voronoi {

/// A step along an edge of a diagram.
struct ChainStep {
  std::uint32_t edge : 31;
  std::uint32_t forward : 1;  ///< along the edge
  std::uint32_t from, to;     ///< nodes
};

/// Puts the steps along one site in order: from the one that no other leads to, or where they make
/// a cycle, from any one. False where they are not connected. With `has_arcs` they may come through
/// a node more than once: then what is touched first along the site comes first, by `foot_of`
/// (nothing for a vertex), and what leads back to a node before what leaves it.
bool put_in_order(std::span<ChainStep> steps, bool has_arcs,
                  const std::function<double(const ChainStep&)>& foot_of);

}  // namespace medial::voronoi
