#pragma once

#include <vector>

#include "medial/axis.h"
#include "methods/disks/boundary.h"

namespace medial::disks {

/// A maximal disk that connects a hole to another loop: it touches the hole in its furthest point
/// in the direction `outreach`, a vertex or a place inside an arc, and the other loop further out.
struct Bridge {
  Disk disk;
  std::uint32_t hole = 0;  ///< loop
  std::uint32_t site = 0;  ///< touched site, in the loops' boundary
};

class ExactSites;

/// Smaller bridges are never left to double.
constexpr double exact_bridges = 0x1p-24;

/// One bridge for each hole (docs/disks.md, step 3). The disk at the furthest point lies beyond it,
/// where the hole has no other point; the loop that it touches has a point further out than the
/// hole has, so no cycle of holes can arise and all loops of a component get connected. `queries`
/// counts nearest-site queries. With `exact`, bridges are decided in 256 bits where double leaves
/// open which of several sites they touch, where their radii are up to `exact_bridges`, and in all
/// components that are `in_precise`. O(h log n) expected.
std::vector<Bridge> connecting_disks(const Shape& shape, const Boundary& loops, double tolerance,
                                     const ExactSites& exact, const std::vector<bool>& in_precise,
                                     std::uint64_t& queries);

/// The boundary with all holes spliced in: one run for each component.
Boundary connect(const Shape& shape, const Boundary& loops, const std::vector<Bridge>& bridges);

/// The boundary of a problem with all holes spliced in; of straight edges, bridges that double
/// leaves open are decided in 256 bits where the build has them.
Boundary connected_boundary(const Problem& problem, std::vector<Bridge>& bridges);

}  // namespace medial::disks
