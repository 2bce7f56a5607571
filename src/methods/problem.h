#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "axis/sites.h"
#include "base/local_frame.h"
#include "medial/axis.h"
#include "medial/compute.h"
#include "medial/shape.h"

namespace medial {

/// The share of the remaining progress that one attempt gets; the rest is for later attempts.
inline constexpr double attempt_share = 0.9;

/// A callback that maps 0..1 to a part of the progress bar. Empty if `tell` is; `tell` must outlive
/// it.
std::function<void(double)> part_of_progress(const std::function<void(double)>& tell, double begin,
                                             double length);

/// A shape prepared once for every method. Lengths are in units of the input unless called local.
/// The shape and the options must outlive it.
struct Problem {
  Problem(const Shape& a_shape, const Options& some_options,
          std::span<const Contour> some_contours = {});

  const Shape& shape;
  const Options& options;
  std::span<const Contour> contours;  ///< the smooth boundary, if the caller has it
  Box box;                            ///< of the shape
  LocalFrame frame;
  double tolerance = 0;        ///< a disk whose residual is below it touches
  double joint_tolerance = 0;  ///< the same for joints; independent of the options
  /// The local tolerance that the local coordinates alone allow. Far from the origin it is finer
  /// than local_tolerance(), since only the conversion back to input coordinates rounds.
  double fine_tolerance = 0;
  double radius_limit = 0;  ///< local; no disk inside the shape is larger

  double local_tolerance() const { return frame.scale * tolerance; }
  Box local_box() const { return {frame.to_local(box.low), frame.to_local(box.high)}; }
  /// The numbers of the sites; the first call computes them. Not thread-safe. O(n).
  const site::SiteNumbers& numbers() const&;
  site::SiteNumbers numbers() &&;
  /// The sites as the result lists them.
  std::vector<Site> result_sites() const { return site::result_sites(shape, numbers()); }
  /// The options of the method. Requires that this method was chosen.
  template <class Own>
  const Own& own() const {
    return std::get<Own>(options.method);
  }
  bool is_cancelled() const { return options.cancel != nullptr && options.cancel->load(); }
  /// A progress callback for an attempt that `before` others precede. It maps 0..1 to the part of
  /// the progress bar that these left, and keeps a tenth of it for later attempts. Empty if the
  /// caller wants no progress.
  std::function<void(double)> progress_of_attempt(int before) const;

 private:
  mutable std::optional<site::SiteNumbers> numbers_;
};

/// Whether compute_in_parts() hands out parts of the axis, rather than the whole axis at once.
bool comes_in_parts(const Shape& shape, const Options& options);

/// The result of a method.
struct Outcome {
  MedialAxis axis;
  /// Whether compute() must check that the graph has one part for each component and one cycle for
  /// each hole. False if the method has checked it, or if it need not hold.
  bool to_check = true;
};

inline Result<Outcome> outcome_of(Result<MedialAxis> axis, bool to_check = true) {
  if (!axis) return std::move(axis).error();
  return Outcome{std::move(axis).value(), to_check};
}

}  // namespace medial
