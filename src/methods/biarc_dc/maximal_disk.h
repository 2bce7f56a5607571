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

/// A point at which a disk certainly touches a sub-shape's boundary: inside an element, or at the
/// joint after it.
struct Place {
  std::size_t element = 0;
  bool at_joint = false;
  double parameter = 0;  ///< inside an element
};

/// A maximal disk and its known contacts.
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
  bool on_circle = false;  ///< the whole element is on the disk's circle
};

/// Data that the divisions of one outline share, and counts and buffers of one task.
struct Context {
  const SiteOutline& outline;
  const site::BoundaryTree& tree;
  double tolerance = 0;     ///< in the local frame
  double radius_limit = 0;  ///< no disk inside the shape is larger
  Statistics statistics{};
  std::optional<Vec2> stuck{};         ///< a place of a sub-shape that no disk divides, if any
  std::vector<std::uint32_t> found{};  ///< of a search
  std::vector<Touch> touches{};        ///< of a disk,
  std::vector<const Touch*> run{};     ///< and of one place
  std::vector<Seam> seams{};

  /// How far disks may reach over an element: a rounding of a coordinate. If it were the whole
  /// tolerance, small errors of disks in adjacent parts would add up on shapes with many near ties.
  double rounding() const { return tolerance / 16; }
  const site::Site& site(const Element& element) const { return outline.sites[element.site]; }
  /// Whether a disk can touch an element and the next one at one point, the joint between them.
  bool joins_smoothly(const Element& element) const {
    if (!element.is_joined()) return false;
    const Joint joint = outline.joints[element.site];
    return joint == Joint::smooth || joint == Joint::reflex;
  }
  /// Whether a site ends at a point of which cutting disks may have made copies. Disks that touch
  /// one copy reach over the other only by rounding.
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

/// Whether a site is further from a point than `reach`, as its start alone shows: a parameter is
/// never less than the arc length.
inline bool is_far(const site::Site& site, Vec2 c, double reach) {
  const double most = reach + site.length;
  return squared_norm(c - site.point) > most * most;
}

/// Sub-shapes of at most this many elements are scanned completely; in larger ones, the tree over
/// the whole boundary finds what disks overlap.
constexpr std::size_t most_scanned = 256;

/// Algorithm 3, maximaldisk: the largest disk that touches the boundary at `place` and overlaps no
/// other element. Each element that the disk still overlaps makes it smaller. Returns two contacts,
/// or one if the arc's own circle is the largest disk.
MaximalDisk maximal_disk(Context& context, const Subshape& subshape, const Place& place,
                         const DiskList& disks);

/// Whether the centre of a disk is in the range of directions of element `k`, a reflex vertex.
bool faces(const Context& context, const Subshape& subshape, std::size_t k, Vec2 center,
           const DiskList& disks);

/// The start of a walk along the axis: a disk that touches two elements. The foot on `right` moves
/// forward along the boundary, and the foot on `left` backward.
struct Gate {
  std::size_t right = 0;
  std::size_t left = 0;
  Disk disk;
};

/// maximaldisk* (Section 3.5): the next disk after a gate that touches its two elements and a third
/// one between them: a branching, or the transition to another element at a joint. None if rounding
/// leaves no such disk.
std::optional<MaximalDisk> branching_disk(Context& context, const Subshape& subshape,
                                          const Gate& gate, const DiskList& disks);

/// Finds all places at which a disk touches the boundary within the tolerance, in boundary order:
/// one for each connected piece of contact, including the known ones. Whole arcs on the disk's
/// circle are cut out (see Seam). Returns false if that is the whole boundary.
bool find_contacts(Context& context, const Subshape& subshape, const MaximalDisk& maximal,
                   const DiskList& disks, std::vector<Seam>& seams);

}  // namespace medial::biarc_dc
