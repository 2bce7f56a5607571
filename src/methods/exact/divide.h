#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/exact/in_disk.h"

namespace medial::exact {

/// The nodes among sites that nearly one disk touches, in this counter-clockwise order: each as the
/// places of its sites in the list, increasing. Two nodes that have two places in common which are
/// no neighbours in the list are joined by an edge. All of them touch one disk, exactly, where
/// there is one node only. That the nodes' disks exist is left to disk_bounds().
///
/// From one side of the list on: the first site that a disk touching the two of that side meets is
/// found by comparing it with the others, and splits the list; O(k log k) decisions for k sites in
/// random order, O(k) if all are one, O(k^2) at most.
std::vector<std::vector<std::uint32_t>> divide(const SiteLoops& outline,
                                               std::span<const std::uint32_t> sites,
                                               Decisions& decisions);

}  // namespace medial::exact
