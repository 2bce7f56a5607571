#pragma once

// The way around an axis: with the axis on the left and the boundary on the right.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial/axis.h"
#include "medial/query.h"
#include "medial/shape.h"
#include "medial/sides.h"

namespace medial::ops {

/// An edge seen from one of its ends: half edge 2 e leaves edge e's node[0], 2 e + 1 its node[1].
using HalfEdge = std::uint32_t;
constexpr HalfEdge twin(HalfEdge half) { return half ^ 1U; }

/// By what the half edges around a node are put in order.
enum class Around : std::uint8_t {
  directions,  ///< in which they leave
  /// The sites on their right, of exact axes: short edges have no direction but that of rounding.
  sites,
};

/// Keeps a reference to the axis, which must live longer.
class HalfEdges {
 public:
  /// O(edges log(degree)).
  explicit HalfEdges(const MedialAxis& axis, Around order = Around::directions);

  HalfEdge count() const { return static_cast<HalfEdge>(next_.size()); }
  /// The half edge after one that arrives: the one that leaves next, to the right.
  HalfEdge next(HalfEdge half) const { return next_[half]; }
  const Edge& edge(HalfEdge half) const { return axis_.edges[half / 2]; }
  std::uint32_t from(HalfEdge half) const { return edge(half).node[half % 2]; }
  std::uint32_t to(HalfEdge half) const { return edge(half).node[1 - half % 2]; }
  const Disk& disk(HalfEdge half, bool at_end) const {
    return axis_.nodes[at_end ? to(half) : from(half)].disk;
  }
  /// Calls visit(walk) for each closed walk around the axis, a span of its half edges, by
  /// increasing first half edge.
  template <class Visit>
  void each_walk(const Visit& visit) const {
    std::vector<bool> done(count(), false);
    std::vector<HalfEdge> walk;
    for (HalfEdge start = 0; start < count(); ++start) {
      walk.clear();
      for (HalfEdge half = start; !done[half]; half = next_[half]) {
        done[half] = true;
        walk.push_back(half);
      }
      if (!walk.empty()) visit(std::span<const HalfEdge>(walk));
    }
  }

  /// Whether the right side is known as a site, exactly.
  bool exact(HalfEdge half) const {
    return axis_.resolution == 0 && right_site(half) < axis_.sites.size();
  }
  std::uint32_t right_site(HalfEdge half) const { return edge(half).site[1 - half % 2]; }

  /// The jet where a half edge begins, or where it ends; in its direction.
  AxisJet jet(HalfEdge half, bool at_end) const;
  /// Where the disk at an end of a half edge touches the boundary on the right.
  Vec2 touch(HalfEdge half, bool at_end) const;
  /// The angle of the disk's arc, counter-clockwise, from where the right side of a half edge ends
  /// to where that of the next one begins; in [0, 2 pi]. 0 where the two are one point to rounding,
  /// and where the sides of samples overlap.
  double gap(HalfEdge half) const;

 private:
  void link_by_direction(std::span<const HalfEdge> leaving);
  /// Links three edges where each pair of ends has a site of its own, as a rule; else changes
  /// nothing.
  bool link_three(std::span<const HalfEdge> leaving);
  void link_by_site(std::span<const HalfEdge> leaving);
  /// The direction in which a half edge leaves.
  double direction(HalfEdge half) const;

  const MedialAxis& axis_;
  std::vector<HalfEdge> next_;
};

/// The boundary of an axis as closed contours with the interior on the left, by increasing lowest
/// edge: segments and arcs of an exact axis, straight pieces between the points of (3) of a sampled
/// one, a circle around a node without edges. Arcs of its disks close gaps. `corner_angle` in
/// degrees, that which the axis was computed with. O(edges log(degree)).
std::vector<Contour> boundary_of(const MedialAxis& axis, double corner_angle);

/// The sites from one to another along the boundary, both included, if each `goes_on` from the one
/// before it and all others `may_lie_between`; else none.
template <class GoesOn, class MayLieBetween>
std::vector<std::uint32_t> sites_between(const MedialAxis& axis, std::uint32_t before,
                                         std::uint32_t after, const GoesOn& goes_on,
                                         const MayLieBetween& may_lie_between) {
  const std::size_t count = axis.sites.size();
  const auto joined = [&](std::uint32_t a, std::uint32_t b) {
    return std::max(a, b) < count && goes_on(a, b);
  };
  const auto passes = [&](std::uint32_t site) {
    return site < count && may_lie_between(axis.sites[site]);
  };
  // A loop's numbers may begin anywhere in between.
  std::vector<std::uint32_t> chain{before}, back{after};
  const auto met = [&] { return joined(chain.back(), back.back()); };
  while (!met() && joined(chain.back(), chain.back() + 1) && passes(chain.back() + 1))
    chain.push_back(chain.back() + 1);
  while (!met() && joined(back.back() - 1, back.back()) && passes(back.back() - 1))
    back.push_back(back.back() - 1);
  if (!met()) return {};
  chain.insert(chain.end(), back.rbegin(), back.rend());
  return chain;
}

/// The same jet in the other direction.
AxisJet reversed(AxisJet jet);

/// Feet of one disk that are apart by no more than this are one.
double slack_of(const MedialAxis& axis, const Disk& disk);

/// The feet of the disk at t of an edge, on the left and on the right: on the edge's sites, or by
/// the change of the radius.
std::array<Vec2, 2> feet_at(const MedialAxis& axis, const Edge& edge, double t, const Disk& disk,
                            bool by_sites);

/// Where a disk around `center` touches a site whose stretch of the boundary begins or ends there.
/// Around the centre of an arc, within rounding, it touches all of it: that is its start or end.
Vec2 touch_of(const MedialAxis& axis, const Site& site, Vec2 center, bool ends);

/// The arc of a disk from one point to another, counter-clockwise, as one piece or two.
void add_arc(const Disk& disk, Vec2 begin, Vec2 end, double angle, Contour& contour);

/// A contour of segments and arcs as a ring, without its pieces up to `step` long.
Ring ring_of(const Contour& contour, double step = 0);

}  // namespace medial::ops
