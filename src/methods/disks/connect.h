#pragma once

#include <vector>

#include "methods/disks/exact_sites.h"

namespace medial::disks {

/// Smaller bridges are never left to double.
constexpr double exact_bridges = 0x1p-24;

/// Splices all holes into a boundary, which `exact` is of: so that it has one run for each
/// component. One bridge for each hole (docs/disks.md, step 3). The disk at the furthest point lies
/// beyond it, where the hole has no other point; the loop that it touches has a point further out
/// than the hole has, so no cycle of holes can arise and all loops of a component get connected.
/// Bridges are decided in 256 bits where double leaves open which of several sites they touch,
/// where their radii are up to `exact_bridges`, and in all components that are `in_precise`.
/// O(h log n) expected, for h queries.
void connect_holes(const Shape& shape, double tolerance, const ExactSites& exact,
                   const std::vector<bool>& in_precise, Boundary& boundary);

/// The boundary of a problem with all holes spliced in.
Boundary connected_boundary(const Problem& problem);

}  // namespace medial::disks
