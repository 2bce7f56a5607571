#pragma once

// The walk around an axis, with the axis on the left and the boundary on the right.

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

/// How the half edges around a node are ordered.
enum class Around : std::uint8_t {
  directions,  ///< by the directions in which they leave
  /// By the sites on their right, for exact axes, because the direction of a short edge is
  /// rounding.
  sites,
};

/// Keeps a reference to the axis, which must outlive it.
class HalfEdges {
 public:
  /// O(edges log(degree)).
  explicit HalfEdges(const MedialAxis& axis, Around order = Around::directions);

  HalfEdge count() const { return static_cast<HalfEdge>(next_.size()); }
  /// The half edge that follows one that arrives at a node: the next one to the right.
  HalfEdge next(HalfEdge half) const { return next_[half]; }
  const Edge& edge(HalfEdge half) const { return axis_.edges[half / 2]; }
  std::uint32_t from(HalfEdge half) const { return edge(half).node[half % 2]; }
  std::uint32_t to(HalfEdge half) const { return edge(half).node[1 - half % 2]; }
  const Disk& disk(HalfEdge half, bool at_end) const {
    return axis_.nodes[at_end ? to(half) : from(half)].disk;
  }
  /// Calls visit(walk) for each closed walk around the axis, by increasing first half edge. A walk
  /// is a span of half edges.
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

  /// Whether the right side is an exact site.
  bool exact(HalfEdge half) const {
    return axis_.resolution == 0 && right_site(half) < axis_.sites.size();
  }
  std::uint32_t right_site(HalfEdge half) const { return edge(half).site[1 - half % 2]; }

  /// The jet at the beginning or end of a half edge, in its direction.
  AxisJet jet(HalfEdge half, bool at_end) const;
  /// The point at which the disk at an end of a half edge touches the boundary on the right.
  Vec2 touch(HalfEdge half, bool at_end) const;
  /// The angle of the disk's arc, counter-clockwise, from the end of the right side of a half edge
  /// to the beginning of the right side of the next one, in [0, 2 pi]. 0 if the two points are
  /// equal up to rounding, or if the sides of samples overlap.
  double gap(HalfEdge half) const;

 private:
  void link_by_direction(std::span<const HalfEdge> leaving);
  /// Links three edges if each pair of them shares a site of its own, the usual case; otherwise
  /// does nothing.
  bool link_three(std::span<const HalfEdge> leaving);
  void link_by_site(std::span<const HalfEdge> leaving);
  /// The direction in which a half edge leaves.
  double direction(HalfEdge half) const;

  const MedialAxis& axis_;
  std::vector<HalfEdge> next_;
};

/// The boundary of an axis as closed contours with the interior on the left, by increasing lowest
/// edge: segments and arcs for an exact axis, straight pieces between the points of (3) for a
/// sampled one, a circle around a node without edges. Arcs of disks close gaps. `corner_angle`, in
/// degrees, is the one that the axis was computed with. O(edges log(degree)).
std::vector<Contour> boundary_of(const MedialAxis& axis, double corner_angle);

/// The sites from one to another along the boundary, both included, if each `goes_on` from the
/// previous one and all inner ones `may_lie_between`; else none.
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
  // The numbers of a loop may wrap around anywhere in between.
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

/// The distance up to which two feet of one disk count as equal.
double slack_of(const MedialAxis& axis, const Disk& disk);

/// The feet of the disk at t of an edge, on the left and on the right: on the edge's sites, or by
/// the change of the radius.
std::array<Vec2, 2> feet_at(const MedialAxis& axis, const Edge& edge, double t, const Disk& disk,
                            bool by_sites);

/// The point at which a disk around `center` touches a site whose part of the boundary begins or
/// ends there. A disk around the centre of an arc, up to rounding, touches the whole arc; then it
/// is the arc's start or end.
Vec2 touch_of(const MedialAxis& axis, const Site& site, Vec2 center, bool ends);

/// The arc of a disk from one point to another, counter-clockwise, as one piece or two.
void add_arc(const Disk& disk, Vec2 begin, Vec2 end, double angle, Contour& contour);

/// A contour of segments and arcs as a ring, without its pieces up to `step` long.
Ring ring_of(const Contour& contour, double step = 0);

}  // namespace medial::ops
