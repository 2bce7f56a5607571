#pragma once

#include <cstdint>
#include <vector>

#include "base/quarter_map.h"
#include "medial/axis.h"
#include "medial/error.h"
#include "medial/shape.h"
#include "methods/problem.h"

namespace medial::disks {

/// The image of a shape that all its images under quarter maps have in common, whatever the order
/// of their loops and the points where these begin. Where a walk's order decides about ties, it
/// decides alike for all of them.
class Pose {
 public:
  /// O(n), and more only where loops touch.
  explicit Pose(const Shape& shape);

  const Shape& shape() const { return image_; }
  /// The numbers of the image's sites: joints are alike.
  site::SiteNumbers to_image(const site::SiteNumbers& numbers) const;
  /// Makes the axis of the image, whose sites have these numbers, and its edges, which may stand
  /// apart, those of the shape.
  template <class E>
  void to_input(const Problem& problem, const site::SiteNumbers& numbers, MedialAxis& axis,
                std::vector<E>& edges) const;
  Error to_input(Error error) const;

 private:
  QuarterMap map_;
  Shape image_;
  std::vector<std::uint32_t> point_, edge_;  ///< the shape's, of each of the image's
  std::vector<std::uint32_t> component_;     ///< the shape's, of each of the image's

  Pose(const Shape& shape, const QuarterMap& map);
};

}  // namespace medial::disks
