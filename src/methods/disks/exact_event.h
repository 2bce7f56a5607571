#pragma once

#include <cstdint>
#include <optional>

#include "methods/disks/contacts.h"

namespace medial::disks {

/// What ends an edge of the axis, where double cannot tell: the site that the disk touches there,
/// and the disk (docs/exact.md, How `disks` decides).
struct ExactEvent {
  std::uint32_t site = 0;
  Disk disk;
  double error = 0;             ///< of the disk's coordinates together, before they were rounded
  std::optional<bool> is_node;  ///< whether it is the node's disk, if that one is known
  bool in_precise = false;      ///< by 256 bits

  /// Whether the disk is known to the digits of a double: not between sites that are all but
  /// parallel.
  bool is_well_known() const { return error <= 0x1p-52 * disk.radius; }
};

/// The site in a span that a disk touches together with the span's two, and its disk, which keeps
/// clear of all sites in the span. `from`: about the disk of the span's node; `hint`: a site to
/// begin with, if it lies in the span; `is_exact`: whether the node is the one of its three sites.
/// If all disks that touch three such sites reach over something, the first one along the bisector,
/// with an infinite error; none if no disk touches a third site.
std::optional<ExactEvent> next_exactly(const WalkContext& context, const Span& span,
                                       const Disk& from, std::uint32_t hint, bool is_exact);

/// The site that the disk touches first that grows where the ends of a run join smoothly.
std::optional<ExactEvent> start_exactly(const WalkContext& context, const Span& whole,
                                        const Disk& about, std::uint32_t hint);

/// The disk at which an edge ends that leads from a node towards the blunt joint of the edges
/// `before` and `after`; the node's own, if the edge is left out. On the way the radius shrinks,
/// and no edge is needed; but where both are arcs of nearly one circle it may grow first, by more
/// than the tolerance, up to the largest disk of their bisector. If the joint counts as smooth, the
/// edge goes on until its disk touches the joint within the tolerance, as most nodes' do.
Disk end_toward_joint(const WalkContext& context, std::uint32_t before, std::uint32_t after,
                      const Disk& node);

}  // namespace medial::disks
