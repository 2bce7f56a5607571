#pragma once

#include <cstdint>
#include <vector>

#include "base/local_frame.h"
#include "medial/axis.h"
#include "methods/biarc_dc/divide.h"

namespace medial::biarc_dc {

/// The axis before its curves are computed: nodes, and edges between two sites of the outline.
struct Skeleton {
  struct Bone {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t right = 0;  ///< site
    std::uint32_t left = 0;
  };
  std::vector<Disk> nodes;
  std::vector<std::uint32_t> component;  ///< of each node
  std::vector<Bone> edges;
};

/// The conquer step: evaluates the base cases and connects them at the dividing disks. Merges disks
/// that coincide, and removes those that only divide an edge.
Skeleton conquer(Context& context, const Division& division);

/// Adds the edges, with or without their conics, and the nodes with their kinds, in units of the
/// input.
void add_edges(const Skeleton& skeleton, const Context& context, const LocalFrame& frame,
               bool curves, MedialAxis& axis);

}  // namespace medial::biarc_dc
