#pragma once

#include <cstdint>
#include <vector>

#include "methods/problem.h"
#include "site/joint.h"
#include "site/site.h"

namespace medial::biarc_dc {

using site::Joint;

/// The boundary of a shape without holes as sites in boundary order, in the local frame. Reflex
/// vertices are sites, "arcs of length zero" in the paper's words.
struct SiteOutline {
  struct SiteRange {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };
  std::vector<site::Site> sites;
  std::vector<Joint> joints;             ///< of a site with the next one of its loop
  std::vector<std::uint32_t> originals;  ///< index among the result's sites
  std::vector<SiteRange> loops;          ///< one for each component
};

SiteOutline outline_of(const Problem& problem);

}  // namespace medial::biarc_dc
