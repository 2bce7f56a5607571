#include "methods/problem.h"

#include <utility>

#include "base/tolerance.h"

namespace medial {

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

std::function<void(double)> Problem::progress_of_attempt() const {
  if (!options.progress) return {};
  constexpr double most = 0.9;  // the rest is for what comes after it, as for another attempt
  const double begin = attempted, length = most * (1 - begin);
  attempted += length;
  return [&tell = options.progress, begin, length](double share) { tell(begin + length * share); };
}

}  // namespace medial
