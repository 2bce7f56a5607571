#pragma once

// Distances of many points from the boundary of a shape, negative outside.

#include <cmath>

#include "medial/query.h"
#include "medial/voronoi.h"

namespace medial::python {

/// Expected O(log n) per point. The nearest edge decides the side, except at joints of arcs, where
/// clearance() does.
class SignedDistance {
 public:
  explicit SignedDistance(const Shape& shape)
      : shape_(shape), sites_(edges_of(shape)), locator_(sites_) {}

  double at(Vec2 p) const {
    const NearestSite found = locator_.nearest(p);
    if (found.site == no_site) return -found.distance;
    const Site& site = sites_[found.site];
    if (found.foot == site.start) return at_vertex(p, before_[found.site], found);
    if (found.foot == site.end) return at_vertex(p, found.site, found);
    return is_left(site, p) ? found.distance : -found.distance;
  }

 private:
  std::vector<Site> edges_of(const Shape& shape) {
    std::vector<Site> sites(shape.points.size());
    before_.resize(sites.size());
    after_.resize(sites.size());
    for (std::size_t i = 0; i < shape.loop_count(); ++i) {
      const std::uint32_t begin = shape.loop_begin[i], end = shape.loop_begin[i + 1];
      for (std::uint32_t k = begin; k < end; ++k) {
        const std::uint32_t next = k + 1 < end ? k + 1 : begin;
        sites[k] = {shape.points[k], shape.points[next], 0, k, shape.bulge(k)};
        before_[next] = k;
        after_[k] = next;
      }
    }
    return sites;
  }
  static bool is_left(const Site& site, Vec2 p) {
    const Vec2 chord = site.end - site.start;
    if (site.kind() == SiteKind::segment) return cross(chord, p - site.start) > 0;
    const double across = (1 - site.bulge * site.bulge) / (4 * site.bulge);
    const Vec2 center = midpoint(site.start, site.end) + across * left_of(chord);
    const bool inside = distance(p, center) < distance(site.start, center);
    return inside == (site.bulge > 0);
  }
  /// The signed distance of a point whose nearest point is the vertex at the end of the edge `first`.
  double at_vertex(Vec2 p, std::uint32_t first, const NearestSite& found) const {
    const Site &a = sites_[first], &b = sites_[after_[first]];
    if (found.distance == 0) return 0;
    if (a.kind() == SiteKind::arc || b.kind() == SiteKind::arc) return clearance(shape_, p);
    const bool reflex = cross(a.end - a.start, b.end - b.start) < 0;
    return reflex ? found.distance : -found.distance;
  }

  const Shape& shape_;
  std::vector<std::uint32_t> before_, after_;  ///< the edges before and after each edge
  std::vector<Site> sites_;
  SiteLocator locator_;
};

}  // namespace medial::python
