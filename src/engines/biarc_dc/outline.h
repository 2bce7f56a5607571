#pragma once

#include <cstdint>
#include <vector>

#include "axis/sites.h"
#include "base/frame.h"
#include "geometry/joint.h"
#include "geometry/site.h"
#include "medial/shape.h"

namespace medial::biarc_dc {

using geometry::Joint;

/// The boundary of a shape without holes as sites in boundary order, in the local frame. Reflex
/// vertices are sites, "arcs of length zero" in the paper's words.
struct Outline {
  struct Loop {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };
  std::vector<geometry::Site> sites;
  std::vector<Joint> joints;             ///< of a site with the next one of its loop
  std::vector<std::uint32_t> originals;  ///< index among the result's sites
  std::vector<Loop> loops;               ///< one for each component
};

Outline outline_of(const Shape& shape, const sites::SiteNumbers& numbers, const Frame& frame);

}  // namespace medial::biarc_dc
