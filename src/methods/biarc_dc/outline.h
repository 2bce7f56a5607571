#pragma once

#include <cstdint>
#include <vector>

#include "axis/sites.h"
#include "base/local_frame.h"
#include "medial/shape.h"
#include "site/joint.h"
#include "site/site.h"

namespace medial::biarc_dc {

using site::Joint;

/// The boundary of a shape without holes as sites in boundary order, in the local frame. Reflex
/// vertices are sites, "arcs of length zero" in the paper's words.
struct Outline {
  struct Loop {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };
  std::vector<site::Site> sites;
  std::vector<Joint> joints;             ///< of a site with the next one of its loop
  std::vector<std::uint32_t> originals;  ///< index among the result's sites
  std::vector<Loop> loops;               ///< one for each component
};

Outline outline_of(const Shape& shape, const sites::SiteNumbers& numbers, const LocalFrame& frame);

}  // namespace medial::biarc_dc
