#pragma once

// Shapes with circular edges for tests: see generate.h. All is valid input for build_shape().

#include <cstddef>
#include <cstdint>

#include "medial/contour.h"
#include "support/generate.h"

namespace medial::test {

/// Two half circles, counter-clockwise, the first one beginning at the given angle.
Ring circle(Vec2 center, double radius, double angle = 0);

/// Two half circles and two segments around the segment from a to b.
Ring stadium(Vec2 a, Vec2 b, double radius);

/// A regular n-gon with edges of the given bulge; n = 3 and tan(pi / 12): Reuleaux's triangle. n
/// may be 2, which gives a lens.
Ring bulged_polygon(std::size_t n, double bulge, double radius = 1);

/// A gear: 4 edges a tooth, arcs around the origin of radius 1 and `root` and straight flanks.
Ring gear(std::size_t teeth, double root);

/// Replaces each corner by an arc tangent to its edges, of the given radius or as large as half of
/// the shorter edge allows. Smooth to rounding.
Ring rounded(const Ring& polygon, double radius);

/// Bends every edge at random, not far enough to meet another. O(n^2). `keep_straight` and `slight`
/// are the probabilities of no bend, and of one between 1e-14 and 1e-3.
Rings bent(Random& random, const Rings& rings, double keep_straight = 0.2, double slight = 0.2);

/// A smooth closed curve r(angle) of up to `waves` waves, as n biarcs (2 n arcs), tangent
/// continuous to rounding. n >= 16 waves.
Ring smooth_biarcs(Random& random, std::size_t n, int waves);

/// k x k circular holes of one radius in the unit grid's cells in a square. Radius 1 / 2: they
/// touch each other and the square.
Rings circle_grid(std::size_t k, double radius);

/// The vertices of a regular n-gon in the unit circle, joined by the arcs of the circle.
Ring arcs_of_circle(int n);
Ring with_digits(Ring ring, int point_digits, int bulge_digits);

/// Circles of 3 to 59 arcs as files have them: of few digits, and with points, bulges or both off
/// at random by 1e-3 to 1e-14 of the radius.
constexpr int near_circles_of_each_count = 66, near_circles = 57 * near_circles_of_each_count;
Ring near_circle(int index);

/// A random shape with arcs of any of the kinds above, some with contacts; one seed, one shape.
RandomShape random_arc_shape(std::uint64_t seed);

/// A smooth closed B-spline of degree 2 to 5 with up to four such holes; one seed, one shape. No
/// two curves meet.
std::vector<Contour> random_splines(std::uint64_t seed);

}  // namespace medial::test
