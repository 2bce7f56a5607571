#include "methods/problem.h"

#include <cmath>
#include <utility>

#include "base/tolerance.h"

namespace medial {

std::function<void(double)> part_of_progress(const std::function<void(double)>& tell, double begin,
                                             double length) {
  if (!tell) return {};
  return [&tell, begin, length](double share) { tell(begin + length * share); };
}

Problem::Problem(const Shape& a_shape, const Options& some_options,
                 std::span<const Contour> some_contours)
    : shape(a_shape),
      options(some_options),
      contours(some_contours),
      box(bounding_box(a_shape)),
      frame(frame_of(box)),
      tolerance(tolerance_for(box, options.tolerance)),
      joint_tolerance(tolerance_for(box, 0)),
      fine_tolerance(tolerance_for(local_box(), options.tolerance)),
      radius_limit(medial::radius_limit(box, frame)) {}

const site::SiteNumbers& Problem::numbers() const& {
  if (!numbers_) numbers_ = site::number_sites(shape, frame, joint_tolerance, options.corner_angle);
  return *numbers_;
}

site::SiteNumbers Problem::numbers() && {
  numbers();
  return std::move(*numbers_);
}

std::function<void(double)> Problem::progress_of_attempt(int before) const {
  const double left = std::pow(1 - attempt_share, before);
  return part_of_progress(options.progress, 1 - left, attempt_share * left);
}

}  // namespace medial
