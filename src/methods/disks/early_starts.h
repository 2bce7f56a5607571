#pragma once

#include <cstdint>
#include <vector>

#include "methods/disks/contacts.h"

namespace medial::disks {

/// A disk inside an edge of the axis: it touches two edges of the boundary, far apart along it, and
/// nothing else. The walk comes to the span between the two sooner or later, so the span can be
/// walked from here at the same time as what comes before it.
struct EarlyStart {
  std::uint32_t component;
  std::uint32_t right, left;
  Disk disk;
  double error;  ///< at most how far the axis' own disk is from it
};

/// Some early starts in the runs of a boundary, each with at least `least` sites on either side of
/// it, ordered by `right` and `left`. None beside arcs, around planar graphs, and in
/// components in which double is never asked. They depend on the boundary only. At most a dozen
/// disks are tried for every 2 `least` sites, each with a few searches.
std::vector<EarlyStart> early_starts(const WalkContext& context, std::uint32_t least);

/// The one with the sites of a span, if any.
const EarlyStart* early_start_of(const Span& span, const std::vector<EarlyStart>& starts);

}  // namespace medial::disks
