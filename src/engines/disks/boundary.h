#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/frame.h"
#include "geometry/site.h"
#include "medial/axis.h"
#include "medial/shape.h"

namespace medial::disks {

/// The direction in which the disks that connect holes reach out: that of the angle 0.6 + pi. An
/// angle of no meaning to anybody who draws, so that no such disk comes to lie where others are,
/// for instance on a node of the axis.
constexpr Vec2 outreach{-0.825335614909678297, -0.564642473395035357};

enum class Element : std::uint8_t {
  segment,
  vertex,  ///< reflex, or a straight passage through a touching vertex
  cut,     ///< the dividing disk between a hole and what it was connected to; touches nothing
};

/// The boundary as sites in boundary order, in the local frame: what the walk goes along. Every
/// component is one run of sites that begins and ends at a convex corner of its outer loop; its
/// holes are spliced in where their connecting disks touch, so the run is the boundary of a simply
/// connected shape.
struct Boundary {
  struct Run {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
  };

  std::vector<geometry::Site> sites;
  std::vector<Element> elements;         ///< of each site
  std::vector<std::uint32_t> originals;  ///< index among the result's sites; of a cut: its number
  std::vector<Run> runs;                 ///< of each component
  /// Of each cut, its two places in the order: before and after the hole.
  std::vector<std::array<std::uint32_t, 2>> cut_places;

  void add(const geometry::Site& site, Element element, std::uint32_t original) {
    sites.push_back(site);
    elements.push_back(element);
    originals.push_back(original);
  }
  bool is_corner(std::uint32_t i) const {  ///< whether i and i + 1 are segments at a convex corner
    return elements[i] == Element::segment && elements[i + 1] == Element::segment;
  }
};

/// Which vertices are sites, and how the result numbers its sites: in the order of the shape's
/// points, the vertex before the segment that starts there.
struct SiteNumbers {
  std::vector<std::uint32_t> segment;  ///< of each point; the vertex's number is one less
  std::vector<bool> is_site;           ///< whether the point is a vertex site
  std::uint32_t count = 0;
};
SiteNumbers number_sites(const Shape& shape);

/// The result's sites, in units of the input.
std::vector<Site> result_sites(const Shape& shape, const SiteNumbers& numbers);

/// The boundary before holes are connected: every loop a run of its own in the order of the shape's
/// loops (so `runs` are per loop here). An outer loop begins at a convex corner, a hole at its
/// furthest reflex vertex in the direction `outreach`.
Boundary loops_boundary(const Shape& shape, const SiteNumbers& numbers, const Frame& frame);

}  // namespace medial::disks
