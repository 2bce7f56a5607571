#pragma once

#include "methods/curve_axis/curve_axis.h"

namespace medial::curve_axis {

/// Applies the method to contours (curve_axis.cpp). Errors: those of compute_curve_axis().
Result<CurveAxis> follow_all(std::span<const Contour> contours, const method::CurveAxis& options,
                             const std::atomic<bool>* cancel);

/// Applies the method to the contours or, with `options.fit`, to their fit. An error that a fit may
/// avoid suggests one. Errors: those of compute_curve_axis().
Result<CurveAxis> follow_fit(std::span<const Contour> contours, const method::CurveAxis& options,
                             const std::atomic<bool>* cancel);

/// The error for a fit of polygons or, if `options.fit` is 0, for the contours of the polygons. If
/// it is `unsupported` or `too_large` and the method succeeds on another fit, suggests that fit.
/// For a fit that crosses itself, the error is `unsupported`. Errors: cancelled.
Error with_fit_that_does(Error error, std::span<const std::vector<Vec2>> polygons,
                         const method::CurveAxis& options, const std::atomic<bool>* cancel);

}  // namespace medial::curve_axis
