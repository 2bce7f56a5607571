#pragma once

#include <numeric>
#include <utility>

#include "medial/compute.h"

namespace medial {

/// Moves all nodes, edges and sites of an axis into one part; the other members stay.
inline AxisPart whole_part(MedialAxis& axis) {
  AxisPart part;
  part.axis = std::move(axis);
  axis = {};
  axis.method = part.axis.method;
  axis.tolerance = part.axis.tolerance;
  axis.resolution = part.axis.resolution;
  axis.exterior = part.axis.exterior;
  axis.statistics = part.axis.statistics;
  part.nodes.resize(part.axis.nodes.size());
  part.sites.resize(part.axis.sites.size());
  for (auto* numbers : {&part.nodes, &part.sites}) std::iota(numbers->begin(), numbers->end(), 0U);
  return part;
}

}  // namespace medial
