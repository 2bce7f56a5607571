#include <algorithm>
#include <limits>
#include <vector>

#include "axis/sites.h"
#include "base/local_frame.h"
#include "base/spatial_order.h"
#include "medial/query.h"
#include "medial/voronoi.h"
#include "site/boundary_tree.h"
#include "site/site.h"

namespace medial {

/// The sites in spatial order; arcs as two where they are longer than a quarter of a circle.
struct SiteLocator::Index {
  LocalFrame frame;
  std::vector<Site> sites;
  std::vector<site::Site> pieces;
  std::vector<std::uint32_t> site_of;  ///< of each piece
  std::unique_ptr<site::BoundaryTree> tree;
};

SiteLocator::SiteLocator(std::span<const Site> sites) {
  const auto own = std::make_shared<Index>();
  index_ = own;
  Index& index = *own;
  index.sites.assign(sites.begin(), sites.end());
  if (sites.empty()) return;
  Box box{sites[0].start, sites[0].start};
  std::vector<Vec2> middle;
  middle.reserve(sites.size());
  for (const Site& site : sites) {
    const double reach = distance(site.start, site.end);  // of an arc, at most half beside it
    for (const Vec2 p : {site.start, site.end}) {
      const double pad = site.kind() == SiteKind::arc ? reach : 0;
      box.add({{p.x - pad, p.y - pad}, {p.x + pad, p.y + pad}});
    }
    middle.push_back(midpoint(site.start, site.end));
  }
  // Enlarge the box by its size on all sides, because queries may lie outside it.
  const double size = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  index.frame = frame_of({box.low - Vec2{size, size}, box.high + Vec2{size, size}});
  for (const std::uint32_t i : z_order(middle)) {
    const Site& site = sites[i];
    const Vec2 from = index.frame.to_local(site.start), to = index.frame.to_local(site.end);
    if (site.kind() == SiteKind::vertex) {
      index.pieces.push_back(site::make_vertex(from));
      index.site_of.push_back(i);
      continue;
    }
    const site::Pieces pieces = site::pieces_of(from, to, site.bulge);
    for (std::size_t k = 0; k < pieces.count; ++k) {
      index.pieces.push_back(pieces.site[k]);
      index.site_of.push_back(i);
    }
  }
  index.tree = std::make_unique<site::BoundaryTree>(index.pieces);
}

NearestSite SiteLocator::nearest(Vec2 p) const {
  NearestSite result;
  result.distance = std::numeric_limits<double>::infinity();
  const Index& index = *index_;
  if (index.pieces.empty()) return result;
  const Vec2 c = index.frame.to_local(p);
  const auto take = [&](std::uint32_t piece) {
    const std::uint32_t site = index.site_of[piece];
    const Vec2 foot = medial::foot(index.sites[site], p);
    const double away = distance(foot, p);
    if (away < result.distance || (away == result.distance && site < result.site))
      result = {site, foot, away};
  };
  // The tree's boxes are in single precision near the sites; from far away all are looked at.
  constexpr double near = 2;
  if (!(std::abs(c.x) <= near && std::abs(c.y) <= near)) {
    for (std::uint32_t i = 0; i < index.pieces.size(); ++i) take(i);
    return result;
  }
  const auto hit = index.tree->nearest(c, 2 * near * near);
  if (!hit) return result;
  // Of those at equal distance, up to rounding, the lowest of the diagram's.
  constexpr double rounding = 0x1p-50;
  std::vector<std::uint32_t> ties;
  index.tree->within(c, std::sqrt(hit.squared_distance) * (1 + rounding) + rounding, 0,
                     static_cast<std::uint32_t>(index.pieces.size() - 1), ties);
  for (const std::uint32_t piece : ties) take(piece);
  return result;
}

}  // namespace medial
