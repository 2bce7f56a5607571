#pragma once

#include <cstdint>
#include <vector>

#include "medial/axis.h"
#include "methods/problem.h"
#include "site/joint.h"
#include "site/site.h"

namespace medial::biarc_dc {

using site::Joint;

/// No disk, or no site.
constexpr std::uint32_t none = ~std::uint32_t{0};

/// The boundary of a shape as sites in boundary order, in the local frame: one cycle for each
/// component. Reflex vertices are sites, "arcs of length zero" in the paper. Holes are spliced in
/// by initial cutting disks. Each such disk touches a hole and another loop; one artificial arc of
/// it leads into the boundary of the hole, and another one back. A site that such a disk touches in
/// its inside is stored in two parts, a reflex vertex twice.
struct SiteOutline {
  struct SiteRange {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };
  std::vector<site::Site> sites;
  std::vector<Joint> joints;              ///< of a site with the next one in its cycle
  std::vector<std::uint32_t> disk_after;  ///< the cutting disk whose arc follows a site, or none
  std::vector<std::uint32_t> originals;   ///< index among the result's sites
  std::vector<SiteRange> cycles;          ///< one for each component
  std::vector<Disk> cutting_disks;
  std::vector<std::uint32_t> component;  ///< of each cutting disk

  /// Whether a cutting disk's arc is next to a site, which is then mostly a part of one.
  bool is_cut(std::uint32_t site) const {
    return disk_after[site] != none || (site > 0 && disk_after[site - 1] != none);
  }
};

SiteOutline outline_of(const Problem& problem, Statistics& statistics);

}  // namespace medial::biarc_dc
