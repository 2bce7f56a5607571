#pragma once

// Errors of biarcs by other ways than src/curve takes, and derivatives of curvature.

#include "curve/biarc.h"

namespace medial::test {

/// Algorithm 2: the largest normal distance at `samples` inner parameters for each arc. An estimate
/// from below.
double sampled_error(const curve::Bezier& curve, const curve::Biarc& biarc, int samples);
/// The alternative of the paper's footnote 2: the largest distance at all zeros of the distance's
/// derivative. Exact up to rounding.
double extremal_error(const curve::Bezier& curve, const curve::Biarc& biarc);
/// The derivative of the curvature by the parameter at t, from the numerator polynomials.
double curvature_derivative(const curve::Bezier& curve, double t);

}  // namespace medial::test
