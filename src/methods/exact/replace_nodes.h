#pragma once

#include <cstdint>
#include <vector>

#include "base/local_frame.h"
#include "methods/exact/contact_graph.h"

namespace medial::exact {

/// What exact decisions have changed: nodes are added behind the others, with edges of their own.
struct Replaced {
  std::vector<bool> gone, added;          ///< of each node
  std::vector<std::uint32_t> gone_edges;  ///< and what inner nodes of links join to them
};

/// Takes what is gone out of an axis, and works out the new edges' curves and the nodes' kinds.
void replace_nodes(const SiteLoops& outline, const LocalFrame& frame, const ContactGraph& graph,
                   Replaced replaced, MedialAxis& axis);

}  // namespace medial::exact
