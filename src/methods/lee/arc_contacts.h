#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "medial/axis.h"
#include "methods/lee/elements.h"
#include "site/bisector.h"
#include "site/smooth_place.h"

namespace medial::lee {

/// The limits that all merges of a shape share.
struct MergeLimits {
  double tolerance = 0;     ///< in the local frame
  double radius_limit = 0;  ///< no disk inside the shape is larger
};

/// Answers what disks touch in a shape with arcs (docs/lee.md, Arcs), for the two or three elements
/// of a merge curve.
class ArcContacts {
 public:
  ArcContacts(const Elements& elements, const MergeLimits& limits, Statistics& statistics)
      : elements_(elements), limits_(limits), statistics_(statistics) {}

  /// B(e_i, e_j), i < j, outward.
  site::Bisector bisector(std::uint32_t i, std::uint32_t j) const;

  /// Disks that touch three elements.
  struct Disks {
    std::array<Disk, 5> disk;  ///< two, and the own circles of three arcs
    std::size_t count = 0;
    void add(const Disk& one) { disk[count++] = one; }
  };
  Disks disks_of(const std::array<std::uint32_t, 3>& three);

  /// Whether a disk that touches an element's carrier touches the element: its foot is on the edge,
  /// in the wedge of a reflex vertex, or beyond it within the tolerance. A disk larger than a
  /// convex arc's circle does not touch the inside of the arc.
  bool touches(std::uint32_t i, const Disk& disk) const;

  /// Whether a known disk touches an element, rather than only the end of an edge. Disks next to
  /// arcs are less accurate than others, since bulges are rounded, too.
  bool is_tied(std::uint32_t i, const Disk& disk) const;
  double tie() const { return 0.25 * limits_.tolerance; }

 private:
  const site::Site& site(std::uint32_t i) const { return elements_.sites[i]; }
  bool are_joined(std::uint32_t a, std::uint32_t b) const;
  site::SmoothPlace joint_of(std::uint32_t a, std::uint32_t b) const;
  std::optional<site::SmoothPlace> flat_corner(std::uint32_t a, std::uint32_t b) const;
  Disk own_circle(std::uint32_t arc) const;
  std::optional<Disk> disk_at(const site::SmoothPlace& place, std::uint32_t other,
                              double limit) const;
  bool add_at_joint(const std::array<std::uint32_t, 3>& three, Disks& found) const;
  void add_tangent_disks(const std::array<std::uint32_t, 3>& three, Disks& found);
  void add_if_touching(Disk disk, const std::array<std::uint32_t, 3>& three, Disks& found);

  const Elements& elements_;
  const MergeLimits& limits_;
  Statistics& statistics_;
};

}  // namespace medial::lee
