#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/local_frame.h"
#include "medial/axis.h"
#include "medial/shape.h"
#include "site/joint.h"
#include "site/site.h"

// Makes sites from a shape's loops. All engines with exact axes start with these functions, so they
// number sites in the same way.

namespace medial::site {

/// An edge of the shape as one site, or as two if it is an arc of more than a quarter of a circle.
struct Pieces {
  std::array<Site, 2> site;
  std::size_t count = 1;
  const Site& first() const { return site[0]; }
  const Site& last() const { return site[count - 1]; }
};
Pieces pieces_of(Vec2 start, Vec2 end, double bulge);

/// The edges of one loop, in the frame.
class LoopEdges {
 public:
  LoopEdges(const Shape& shape, std::size_t loop, const LocalFrame& frame)
      : shape_(shape),
        frame_(frame),
        begin_(shape.loop_begin[loop]),
        size_(shape.loop_begin[loop + 1] - begin_) {}

  std::uint32_t begin() const { return begin_; }
  std::uint32_t size() const { return size_; }
  std::uint32_t next(std::uint32_t i) const { return i + 1 == size_ ? 0 : i + 1; }
  std::uint32_t before(std::uint32_t i) const { return i == 0 ? size_ - 1 : i - 1; }
  Vec2 point(std::uint32_t i) const { return shape_.points[begin_ + i]; }
  Vec2 local(std::uint32_t i) const { return frame_.to_local(point(i)); }
  double bulge(std::uint32_t i) const { return shape_.bulge(begin_ + i); }
  /// Whether the loop returns there along the same edge: at a point or an open end of a planar
  /// graph (see shape/around.h).
  bool turns_back(std::uint32_t i) const {
    return point(before(i)) == point(next(i)) && bulge(before(i)) == -bulge(i);
  }
  Pieces edge(std::uint32_t i) const { return pieces_of(local(i), local(next(i)), bulge(i)); }

 private:
  const Shape& shape_;
  const LocalFrame& frame_;
  std::uint32_t begin_, size_;
};

/// The edges of all loops in the frame, in boundary order.
std::vector<site::Site> edge_sites(const Shape& shape, const LocalFrame& frame);

/// Which vertices are sites, and how the result numbers its sites: in the order of the shape's
/// points, the vertex before the edge that starts there. A loop of one point has no edge.
struct SiteNumbers {
  std::vector<std::uint32_t> edge;  ///< of each point; the vertex's number is one less
  std::vector<Joint> joints;        ///< at each point
  std::uint32_t count = 0;
  bool is_site(std::size_t point) const { return joints[point] == Joint::reflex; }
  /// The first of the sites that begin at a point.
  std::uint32_t first(std::size_t point) const { return edge[point] - (is_site(point) ? 1 : 0); }
};
/// `tolerance` in units of the input, `corner_angle` in degrees; see Options.
SiteNumbers number_sites(const Shape& shape, const LocalFrame& frame, double tolerance,
                         double corner_angle);
/// Numbers the sites again after a change of the joints.
void count_sites(const Shape& shape, SiteNumbers& numbers);

/// The point at which a site of the result begins. Fast if it is close to the point `near`.
std::size_t point_of(const SiteNumbers& numbers, std::uint32_t site, std::size_t near);

/// The result's site with this number, which begins at this point, in units of the input.
medial::Site result_site(const Shape& shape, const SiteNumbers& numbers, std::uint32_t site,
                         std::size_t point);

/// The result's sites, in units of the input: all, or those of the points [first, last).
std::vector<medial::Site> result_sites(const Shape& shape, const SiteNumbers& numbers);
std::vector<medial::Site> result_sites(const Shape& shape, const SiteNumbers& numbers,
                                       std::size_t first, std::size_t last);

}  // namespace medial::site
