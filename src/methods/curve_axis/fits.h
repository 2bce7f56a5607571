#pragma once

#include "methods/curve_axis/curve_axis.h"

namespace medial::curve_axis {

/// The method on contours as they are (curve_axis.cpp). Errors: those of compute_curve_axis().
Result<CurveAxis> follow_all(std::span<const Contour> contours, const method::CurveAxis& options,
                             const std::atomic<bool>* cancel);

/// The method on the contours or, if `options.fit` asks for it, on their fit. An error that a fit
/// may mend names one. Errors: those of compute_curve_axis().
Result<CurveAxis> follow_fit(std::span<const Contour> contours, const method::CurveAxis& options,
                             const std::atomic<bool>* cancel);

/// The error of a fit of polygons, or, where `options.fit` is 0, of the contours that they stand
/// for; with a fit that the method follows, if it is `unsupported` or `too_large` and one of some
/// fits does. A fit that crosses itself is `unsupported`. Errors: cancelled.
Error with_fit_that_does(Error error, std::span<const std::vector<Vec2>> polygons,
                         const method::CurveAxis& options, const std::atomic<bool>* cancel);

}  // namespace medial::curve_axis
