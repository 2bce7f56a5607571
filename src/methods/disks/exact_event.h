#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "methods/disks/contacts.h"
#include "methods/exact/disk_bounds.h"
#include "methods/exact/outline.h"

namespace medial::disks {

/// The sites as the shape has them, for what double cannot decide: made by the first question.
/// Thread-safe.
class ExactSites {
 public:
  /// `boundary`: with holes connected or not, by whose normals joints are decided.
  ExactSites(const Problem& problem, const SiteNumbers& numbers, const Boundary& boundary)
      : fine_tolerance_(problem.fine_tolerance),
        radius_limit_(problem.radius_limit),
        boundary_(boundary) {
    make_ = [&problem, &numbers] { return exact::outline_of(problem, numbers); };
  }
  /// Those of a part of a boundary, whose bridges are any disks.
  ExactSites(std::function<exact::SiteLoops()> make, double fine_tolerance, double radius_limit,
             const Boundary& part)
      : make_(std::move(make)),
        fine_tolerance_(fine_tolerance),
        radius_limit_(radius_limit),
        reach_out_(false),
        boundary_(part) {}

  /// Of the sites of a boundary, the one that a disk touches first that grows at a point in the
  /// direction `outreach`, and the disk. None where it touches none.
  struct Touch {
    std::uint32_t site = 0;
    double radius = 0;
  };
  std::optional<Touch> first_touch(Vec2 foot, const Boundary& boundary,
                                   std::span<const std::uint32_t> sites) const;
  /// A site of the boundary as the shape has it.
  exact::ExactSite site(std::uint32_t i) const { return outline().sites[boundary_.originals[i]]; }
  /// The disk that three sites of the boundary touch in their order; none where it is not known.
  template <class Real>
  std::optional<exact::DiskBounds<Real>> disk_of(const std::array<std::uint32_t, 3>& sites) const {
    const auto name = [&](std::uint32_t i) { return boundary_.originals[i]; };
    return exact::disk_bounds<Real>(outline(), {name(sites[0]), name(sites[1]), name(sites[2])});
  }

 private:
  friend class ExactEvents;
  std::function<exact::SiteLoops()> make_;
  double fine_tolerance_, radius_limit_;
  bool reach_out_ = true;  ///< whether bridges are those of connecting_disks()
  const Boundary& boundary_;
  const exact::SiteLoops& outline() const;
  template <class Real>
  std::optional<Touch> first_touch_in(Vec2 foot, const Boundary& boundary,
                                      std::span<const std::uint32_t> sites) const;
  /// The site from which a foot passes on to a site at its start; none where it does not.
  std::optional<std::uint32_t> joined_before(std::uint32_t site) const;
  mutable std::once_flag once_;
  mutable exact::SiteLoops outline_;
  mutable std::vector<std::uint32_t> before_;  ///< of each site on the loop, if `next` is stored
};

/// Answers exactly what ends an edge of the axis where double cannot tell (docs/exact.md, How
/// `disks` decides).
class ExactEvents {
 public:
  /// `in_precise`: of each component, whether double is never asked; empty: it always is.
  ExactEvents(const ExactSites& sites, const Boundary& boundary, const site::BoundaryTree& tree,
              const std::vector<bool>& in_precise)
      : sites_(sites), boundary_(boundary), tree_(tree), in_precise_(in_precise) {}

  bool always(std::uint32_t component) const {
    return !in_precise_.empty() && in_precise_[component];
  }

  struct Found {
    std::uint32_t site = 0;
    Disk disk;
    double error = 0;             ///< of the disk's coordinates together, before they were rounded
    std::optional<bool> is_node;  ///< whether it is the node's disk, if that one is known
    bool in_precise = false;      ///< by 256 bits

    /// Whether the disk is known to the digits of a double: not between sites that are all but
    /// parallel.
    bool is_well_known() const { return error <= 0x1p-52 * disk.radius; }
  };
  /// The site in a span that a disk touches together with the span's two, and its disk, which
  /// keeps clear of all sites in the span. `from`: about the disk of the span's node; `hint`: a
  /// site to begin with, if it lies in the span; `is_exact`: whether the node is the one of its
  /// three sites. None where the span has no such disk.
  std::optional<Found> next(const Span& span, const Disk& from, std::uint32_t hint,
                            bool is_exact) const;
  /// The site that the disk touches first that grows where the ends of a run join smoothly.
  std::optional<Found> start(const Span& whole, const Disk& about, std::uint32_t hint) const;

 private:
  const ExactSites& sites_;
  const Boundary& boundary_;
  const site::BoundaryTree& tree_;
  const std::vector<bool>& in_precise_;
  template <class Real>
  class Search;
  /// In numbers of twice double's digits; where these leave a sign open, or find nothing, in 256
  /// bits.
  std::optional<Found> search(const Span& span, const Disk& from, std::uint32_t hint, bool is_exact,
                              bool all_around) const;
};

}  // namespace medial::disks
