#include "voronoi/enclosure_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "axis/sites.h"
#include "base/local_frame.h"
#include "base/numbers.h"
#include "site/bisector.h"
#include "site/site.h"

namespace medial::voronoi {
namespace {

template <class Mirrored>
site::Control control_over_arc(Vec2 from, Vec2 to, double bulge, const Disk& first,
                               const Disk& last, const Mirrored& mirrored) {
  // The half of the arc that is touched, seen from the enclosure.
  const Vec2 middle = midpoint(first.center, last.center);
  const site::Pieces pieces = site::pieces_of(from, to, bulge);
  site::Site arc = pieces.first();
  if (pieces.count == 2 &&
      site::squared_distance(pieces.last(), middle) < site::squared_distance(arc, middle))
    arc = pieces.last();
  if (site::carrier_distance(arc, middle) < 0) arc = site::reversed(arc);
  const Vec2 direction = mirrored(arc.direction);
  // A mirror image turns the other way: the same arc backward.
  const site::Site image =
      site::reversed({mirrored(arc.point), direction, arc.length, -arc.curvature});
  Box box = Box::nothing();
  for (const Vec2 p : {arc.point, image.point, first.center, last.center}) box.add(p);
  const LocalFrame frame = frame_of(box);
  const auto local = [&](const site::Site& s) -> site::Site {
    return {frame.to_local(s.point), s.direction, frame.scale * s.length,
            frame.inverse * s.curvature};
  };
  const auto local_disk = [&](const Disk& disk) -> Disk {
    return {frame.to_local(disk.center), frame.scale * disk.radius};
  };
  site::Control control =
      site::control_of(local(arc), local(image), local_disk(first), local_disk(last));
  control.point = {frame.to_input(control.point.center), frame.inverse * control.point.radius};
  return control;
}

}  // namespace

void EnclosureCut::add_crossing(const Disk& disk, std::array<std::uint32_t, 2> site,
                                std::uint32_t edge, std::uint32_t end) {
  // Outward, the edge has one site on its left, which comes after it along the enclosure.
  Vec2 on_border = onto_border(enclosure_, disk.center);
  double place = place_on_border(enclosure_, on_border);
  // On which side of a corner is rounding, too, within the tolerance.
  const double nearest = std::round(place) < 4 ? std::round(place) : 0;
  const Vec2 corner = corner_of(enclosure_, static_cast<std::size_t>(nearest));
  if (distance(on_border, corner) <= tolerance_) {
    on_border = corner;
    place = nearest;
  }
  crossings_.push_back({place, {on_border, disk.radius}, site[end], site[1 - end], edge, end});
}

std::uint32_t EnclosureCut::add_node(const Disk& disk, NodeKind kind) {
  diagram_.nodes.push_back({disk, 0, kind});
  return static_cast<std::uint32_t>(diagram_.nodes.size() - 1);
}

Status EnclosureCut::close() {
  std::sort(crossings_.begin(), crossings_.end(),
            [](const Crossing& a, const Crossing& b) { return a.place < b.place; });
  settle_ties();
  first_crossing_ = static_cast<std::uint32_t>(diagram_.nodes.size());
  for (const Crossing& crossing : crossings_) {
    const std::uint32_t node = add_node(crossing.disk, NodeKind::branching);
    diagram_.edges[crossing.edge].node[crossing.end] = node;
  }
  std::array<std::uint32_t, 4> corner{none, none, none, none};
  const auto add_corner = [&](std::size_t k, std::uint32_t site) {
    const Vec2 p = corner_of(enclosure_, k);
    if (corner[k] == none) corner[k] = add_node({p, distance_to(site, p)}, NodeKind::site_change);
    return corner[k];
  };
  if (crossings_.empty()) {
    whole_enclosure_ = nearest_to(corner_of(enclosure_, 0));
    for (std::size_t k = 0; k < 4; ++k) add_corner(k, whole_enclosure_);
    enclosure_begin_.push_back(static_cast<std::uint32_t>(diagram_.edges.size()));
    for (std::size_t k = 0; k < 4; ++k)
      add_enclosure_edge(corner[k], corner[(k + 1) % 4], whole_enclosure_);
    return success();
  }
  // The edges before each crossing, from the one before.
  const std::size_t count = crossings_.size();
  for (std::size_t i = 0; i < count; ++i) {
    enclosure_begin_.push_back(static_cast<std::uint32_t>(diagram_.edges.size()));
    const std::size_t previous = i == 0 ? count - 1 : i - 1;
    const std::uint32_t site = crossings_[i].before;
    if (crossings_[previous].after != site)
      return Error{ErrorCode::internal, "the enclosure's edges do not close a Voronoi face", {}};
    double from = crossings_[previous].place;
    const double to = crossings_[i].place + (i == 0 ? 4 : 0);
    std::uint32_t node = first_crossing_ + static_cast<std::uint32_t>(previous);
    for (double k = std::floor(from) + 1; k < to; k += 1) {
      const std::uint32_t next = add_corner(static_cast<std::size_t>(k) % 4, site);
      add_enclosure_edge(node, next, site);
      node = next;
    }
    add_enclosure_edge(node, first_crossing_ + static_cast<std::uint32_t>(i), site);
  }
  enclosure_begin_.push_back(static_cast<std::uint32_t>(diagram_.edges.size()));
  return success();
}

/// Where several edges cross the enclosure in one place, puts them in an order in which each site
/// that ends there does so where it began.
void EnclosureCut::settle_ties() {
  const double together =
      8 * tolerance_ /
      std::min(enclosure_.high.x - enclosure_.low.x, enclosure_.high.y - enclosure_.low.y);
  const std::size_t count = crossings_.size();
  const auto crossing = [&](std::size_t i) -> Crossing& { return crossings_[i % count]; };
  const auto begins_place = [&](std::size_t i) {
    return i % count == 0 ? crossing(0).place + 4 - crossing(count - 1).place > together
                          : crossing(i).place - crossing(i - 1).place > together;
  };
  std::size_t start = 0;
  while (start < count && !begins_place(start)) ++start;
  for (std::size_t begin = start, end; begin < start + count; begin = end) {
    end = begin + 1;
    while (end < start + count && !begins_place(end)) ++end;
    // The first is the one whose site does not end at this place.
    std::size_t first = begin;
    const auto ends_here = [&](std::uint32_t site) {
      for (std::size_t i = begin; i < end; ++i)
        if (crossing(i).after == site) return true;
      return false;
    };
    while (first < end && ends_here(crossing(first).before)) ++first;
    std::uint32_t site = crossing(first < end ? first : begin).before;
    for (std::size_t i = begin; i < end; ++i) {
      std::size_t next = i;
      while (next < end && crossing(next).before != site) ++next;
      if (next == end) break;
      std::swap(crossing(i), crossing(next));
      std::swap(crossing(i).place, crossing(next).place);
      site = crossing(i).after;
    }
  }
}

double EnclosureCut::distance_to(std::uint32_t site, Vec2 p) const {
  if (site < point_count_) return distance(p, planar_graph_.points[site]);
  const PlanarGraphEdge& edge = planar_graph_.edges[site - point_count_];
  double nearest = std::numeric_limits<double>::infinity();
  const site::Pieces pieces =
      site::pieces_of(planar_graph_.points[edge.from], planar_graph_.points[edge.to], edge.bulge);
  for (std::size_t i = 0; i < pieces.count; ++i)
    nearest = std::min(nearest, std::sqrt(site::squared_distance(pieces.site[i], p)));
  return nearest;
}
std::uint32_t EnclosureCut::nearest_to(Vec2 p) const {
  std::uint32_t nearest = 0;
  for (std::uint32_t s = 1; s < point_count_ + planar_graph_.edges.size(); ++s)
    if (distance_to(s, p) < distance_to(nearest, p)) nearest = s;
  return nearest;
}

/// A straight edge whose radius is the distance to the site: the bisector of the site and its
/// mirror image in the enclosure.
void EnclosureCut::add_enclosure_edge(std::uint32_t from, std::uint32_t to, std::uint32_t site) {
  const Disk &a = diagram_.nodes[from].disk, &b = diagram_.nodes[to].disk;
  const bool upright = std::abs(b.center.x - a.center.x) < std::abs(b.center.y - a.center.y);
  const Vec2 origin = a.center;
  const auto mirrored = [&](Vec2 p) { return upright ? Vec2{-p.x, p.y} : Vec2{p.x, -p.y}; };
  const Disk first{{0, 0}, a.radius}, last{b.center - origin, b.radius};
  site::Control control{{midpoint(first.center, last.center), 0.5 * (a.radius + b.radius)}, 1};
  if (a.center != b.center) {
    if (site < point_count_) {
      const Vec2 p = planar_graph_.points[site] - origin;
      control = site::control_of(site::make_vertex(p), site::make_vertex(mirrored(p)), first, last);
    } else if (const PlanarGraphEdge& edge = planar_graph_.edges[site - point_count_];
               edge.bulge != 0) {
      control = control_over_arc(planar_graph_.points[edge.from] - origin,
                                 planar_graph_.points[edge.to] - origin, edge.bulge, first, last,
                                 mirrored);
    }
  }
  diagram_.edges.push_back({{{from, to},
                             {site, no_site},
                             {control.point.center + origin, control.point.radius},
                             control.weight},
                            false,
                            true});
}

void EnclosureCut::add_enclosure_edges(std::uint32_t node, std::vector<std::uint32_t>& face) const {
  if (node >= first_crossing_ + crossings_.size()) return;
  const std::uint32_t crossing = node - first_crossing_;
  for (std::uint32_t f = enclosure_begin_[crossing + 1]; f-- > enclosure_begin_[crossing];)
    face.push_back(f);
}

void EnclosureCut::end_face(std::uint32_t site, std::vector<std::uint32_t>& face) const {
  if (!crossings_.empty() || site != whole_enclosure_) return;
  for (std::uint32_t e = 4; e-- > 0;) face.push_back(enclosure_begin_[0] + e);
}

}  // namespace medial::voronoi
