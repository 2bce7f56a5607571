#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>

#include "methods/disks/contacts.h"
#ifdef MEDIAL_HAS_EXACT
#include "methods/exact/outline.h"
#endif

namespace medial::disks {

/// Who decides what ends an edge: double where it is certain and else 256 bits, 256 bits always,
/// or double always.
enum class Decides : std::uint8_t { in_stages, in_precise, in_double };

/// The sites as the shape has them, for what double cannot decide: made by the first question.
/// Thread-safe.
class ExactSites {
 public:
  explicit ExactSites(const Problem& problem) : problem_(problem) {}

  /// Of the sites of a boundary, the one that a disk touches first that grows at a point in the
  /// direction `outreach`, and the disk. None where it touches none.
  struct Touch {
    std::uint32_t site = 0;
    double radius = 0;
  };
  std::optional<Touch> first_touch(Vec2 foot, const Boundary& boundary,
                                   std::span<const std::uint32_t> sites) const;

 private:
  friend class ExactEvents;
  const Problem& problem_;
#ifdef MEDIAL_HAS_EXACT
  const exact::SiteLoops& outline() const;
  mutable std::once_flag once_;
  mutable exact::SiteLoops outline_;
#endif
};

/// Answers in 256 bits what ends an edge of the axis where double cannot tell (docs/disks.md, How
/// it is decided).
class ExactEvents {
 public:
  /// `is_always`: whether double is never asked.
  ExactEvents(const ExactSites& sites, const Boundary& boundary, const site::BoundaryTree& tree,
              bool is_always)
      : always(is_always), sites_(sites), boundary_(boundary), tree_(tree) {}

  const bool always;

  struct Found {
    std::uint32_t site = 0;
    Disk disk;
    bool well_known = true;  ///< the disk: to all of its digits
  };
  /// The site in a span that a disk touches together with the span's two, and its disk, which
  /// keeps clear of all sites in the span. `from`: about the disk of the span's node; `hint`: a
  /// site to begin with, if it lies in the span. None where the span has no such disk.
  std::optional<Found> next(const Span& span, const Disk& from, std::uint32_t hint) const;

 private:
  const ExactSites& sites_;
  const Boundary& boundary_;
  const site::BoundaryTree& tree_;
  class Search;
};

}  // namespace medial::disks
