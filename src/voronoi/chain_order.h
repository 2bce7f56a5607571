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

/// Orders the steps along one site: from the step that no other leads to, or from any step of a
/// cycle. Returns false if the steps are not connected. With `has_arcs`, they may pass through a
/// node more than once. Then steps are ordered by their feet along the site (`foot_of`; nothing for
/// a vertex), and a step that returns to a node comes before a step that leaves it.
bool put_in_order(std::span<ChainStep> steps, bool has_arcs,
                  const std::function<double(const ChainStep&)>& foot_of);

}  // namespace medial::voronoi
