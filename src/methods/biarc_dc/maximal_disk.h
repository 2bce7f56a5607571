#pragma once

#include <optional>
#include <vector>

#include "medial/axis.h"
#include "methods/biarc_dc/outline.h"
#include "methods/biarc_dc/subshape.h"
#include "site/bisector.h"

namespace medial::biarc_dc {

/// A point of a sub-shape's boundary that a disk touches for sure: inside an element, or at the
/// joint after it.
struct Place {
  std::size_t element = 0;
  bool at_joint = false;
  double parameter = 0;  ///< inside an element
};

/// A maximal disk and where it is known to touch the boundary.
struct MaximalDisk {
  Disk disk;
  std::vector<Place> contacts;
};

/// What all divisions of one outline share, and what they count.
struct Context {
  const SiteOutline& outline;
  double tolerance = 0;     ///< in the local frame
  double radius_limit = 0;  ///< no disk inside the shape is larger
  Statistics statistics{};

  /// What disks may reach over an element: a rounding of a coordinate. Were it all of the
  /// tolerance, the small errors of disks in each other's parts would add up on shapes with many
  /// near ties.
  double rounding() const { return tolerance / 16; }
  const site::Site& site(const Element& element) const { return outline.sites[element.site]; }
  /// Whether a disk can touch an element and the next one in one point, where they are joined.
  bool joins_smoothly(const Element& element) const {
    if (!element.is_joined()) return false;
    const Joint joint = outline.joints[element.site];
    return joint == Joint::smooth || joint == Joint::reflex;
  }
  bool coincide(const Disk& a, const Disk& b) const {
    return squared_norm(a.center - b.center) <= tolerance * tolerance &&
           std::abs(a.radius - b.radius) <= tolerance;
  }
};

/// Algorithm 3, maximaldisk: the disk that touches the boundary at `place`, as large as all other
/// elements let it be. A linear scan, in which each element that the disk still overlaps makes it
/// smaller. Two contacts, or one where the arc's own circle is the largest disk.
MaximalDisk maximal_disk(Context& context, const Subshape& subshape, const Place& place);

/// maximaldisk* (Section 3.5): beginning with the dividing disk on the artificial arc after element
/// `i`, the next disk that touches the two elements beside that arc and a third one: a branching,
/// or the passage to another element at a joint. A linear scan as well. None where rounding leaves
/// no such disk.
std::optional<MaximalDisk> branching_disk(Context& context, const Subshape& subshape, std::size_t i,
                                          const std::vector<Disk>& disks);

/// All places, in boundary order, where a disk touches the boundary within the tolerance, one for
/// each connected piece of contact, `sure` ones among them; whole arcs on the disk's circle are cut
/// out (see Seam). Nothing if that is all of the boundary.
std::optional<std::vector<Seam>> contacts_of(const Context& context, const Subshape& subshape,
                                             const MaximalDisk& maximal);

}  // namespace medial::biarc_dc
