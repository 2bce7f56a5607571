#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "methods/disks/boundary.h"
#include "methods/exact/disk_bounds.h"
#include "methods/exact/outline.h"

namespace medial::disks {

/// The sites of a boundary as the shape has them, for what double cannot decide: made by the first
/// question. Thread-safe.
class ExactSites {
 public:
  /// `own`: with holes connected or not, by whose normals joints are decided.
  ExactSites(const Problem& problem, const SiteNumbers& numbers, const Boundary& own)
      : boundary(own),
        fine_tolerance(problem.fine_tolerance),
        radius_limit(problem.radius_limit),
        make_([&problem, &numbers] { return exact::outline_of(problem, numbers); }) {}
  /// Those of a part of a boundary, whose bridges are any disks.
  ExactSites(std::function<exact::SiteLoops()> make, double own_tolerance, double own_limit,
             const Boundary& part)
      : boundary(part),
        fine_tolerance(own_tolerance),
        radius_limit(own_limit),
        reaches_out(false),
        make_(std::move(make)) {}

  const Boundary& boundary;
  const double fine_tolerance;
  const double radius_limit;
  const bool reaches_out = true;  ///< whether bridges are those of connect_holes()

  const exact::SiteLoops& outline() const;
  /// The site from which a foot passes on to a site at its start; none where it does not.
  std::optional<std::uint32_t> joined_before(std::uint32_t site) const;
  /// A site of the boundary as the shape has it.
  exact::ExactSite site(std::uint32_t i) const { return outline().sites[boundary.originals[i]]; }
  /// The disk that three sites of the boundary touch in their order; none where it is not known.
  template <class Real>
  std::optional<exact::DiskBounds<Real>> disk_of(const std::array<std::uint32_t, 3>& sites) const {
    const auto name = [&](std::uint32_t i) { return boundary.originals[i]; };
    return exact::disk_bounds<Real>(outline(), {name(sites[0]), name(sites[1]), name(sites[2])});
  }

  /// Of some sites of the boundary, the one that a disk touches first that grows at a point in the
  /// direction `outreach`, and the disk. None where it touches none.
  struct Touch {
    std::uint32_t site = 0;
    double radius = 0;
  };
  std::optional<Touch> first_touch(Vec2 foot, std::span<const std::uint32_t> sites) const;

 private:
  template <class Real>
  std::optional<Touch> first_touch_in(Vec2 foot, std::span<const std::uint32_t> sites) const;

  std::function<exact::SiteLoops()> make_;
  mutable std::once_flag once_;
  mutable exact::SiteLoops outline_;
  mutable std::vector<std::uint32_t> before_;  ///< of each site on the loop, if `next` is stored
};

}  // namespace medial::disks
