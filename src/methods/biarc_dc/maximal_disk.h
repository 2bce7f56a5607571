#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "methods/biarc_dc/outline.h"
#include "methods/biarc_dc/subshape.h"
#include "site/boundary_tree.h"

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
  std::array<Place, 3> place{};
  std::size_t count = 0;

  std::span<const Place> contacts() const { return {place.data(), count}; }
  void add(const Place& contact) { place[count++] = contact; }
};

/// An element that a disk touches within the tolerance.
struct Touch {
  std::size_t element = 0;
  double parameter = 0;    ///< of the nearest point
  double distance = 0;     ///< to it
  bool on_circle = false;  ///< all of the element lies on the disk's circle
};

/// What the divisions of one outline share, and what one task counts and keeps for reuse.
struct Context {
  const SiteOutline& outline;
  const site::BoundaryTree& tree;
  double tolerance = 0;     ///< in the local frame
  double radius_limit = 0;  ///< no disk inside the shape is larger
  Statistics statistics{};
  std::optional<Vec2> stuck{};         ///< a place of a sub-shape that no disk divides, if any
  std::vector<std::uint32_t> found{};  ///< of a search
  std::vector<Touch> touches{};        ///< of a disk,
  std::vector<const Touch*> run{};     ///< and those of one place
  std::vector<Seam> seams{};

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
  /// Whether a site has an end in a place that cutting disks may have made several of. Disks that
  /// touch the one reach over the other by rounding only.
  bool ends_at(std::uint32_t i, Vec2 place) const {
    if (outline.cutting_disks.empty()) return false;
    const site::Site& one = outline.sites[i];
    return site::is_same_place(one.point, place) || site::is_same_place(one.end(), place);
  }
  bool coincide(const Disk& a, const Disk& b) const {
    return squared_norm(a.center - b.center) <= tolerance * tolerance &&
           std::abs(a.radius - b.radius) <= tolerance;
  }
};

/// Whether a site lies further away from a point than `reach`, as its start alone can tell: a
/// parameter is never less than the arc length.
inline bool is_far(const site::Site& site, Vec2 c, double reach) {
  const double most = reach + site.length;
  return squared_norm(c - site.point) > most * most;
}

/// Sub-shapes of at most this many elements are scanned from end to end; in larger ones, disks are
/// tested by the tree over the whole boundary.
constexpr std::size_t most_scanned = 256;

/// Algorithm 3, maximaldisk: the disk that touches the boundary at `place`, as large as all other
/// elements let it be. Each element that the disk still overlaps makes it smaller. Two contacts, or
/// one where the arc's own circle is the largest disk.
MaximalDisk maximal_disk(Context& context, const Subshape& subshape, const Place& place,
                         const DiskList& disks);

/// Whether a disk around `center` lies in the range of directions of element `k`, a reflex vertex.
bool faces(const Context& context, const Subshape& subshape, std::size_t k, Vec2 center,
           const DiskList& disks);

/// Where a walk along the axis begins: a disk that touches two elements, from where the foot on
/// `right` moves forward along the boundary and the foot on `left` backward.
struct Gate {
  std::size_t right = 0;
  std::size_t left = 0;
  Disk disk;
};

/// maximaldisk* (Section 3.5): the next disk from a gate that touches its two elements and a third
/// one between them: a branching, or the passage to another element at a joint. None where rounding
/// leaves no such disk.
std::optional<MaximalDisk> branching_disk(Context& context, const Subshape& subshape,
                                          const Gate& gate, const DiskList& disks);

/// All places, in boundary order, where a disk touches the boundary within the tolerance, one for
/// each connected piece of contact, the known ones among them; whole arcs on the disk's circle are
/// cut out (see Seam). False if that is all of the boundary.
bool find_contacts(Context& context, const Subshape& subshape, const MaximalDisk& maximal,
                   const DiskList& disks, std::vector<Seam>& seams);

}  // namespace medial::biarc_dc
