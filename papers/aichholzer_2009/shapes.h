#pragma once

// Shapes of the kinds that [aichholzer2009] measures, made here: a tree, a snowflake, CAD
// lettering, a country's border. All boundaries are lines and cubic Bezier curves, and the same on
// every machine but for the last digits of sines.

#include <string>
#include <vector>

#include "medial/contour.h"

namespace medial::papers {

/// A closed uniform cubic B-spline whose control polygon is a twig with three twigs on it, `depth`
/// times over: 2 (3^(depth + 1) - 1) cubics, nowhere a corner.
std::vector<Contour> tree(int depth);

/// The closed uniform cubic B-spline that has Koch's curve of this order as its control polygon:
/// 3 * 4^order cubics, nowhere a corner; six-fold symmetry up to rounding.
std::vector<Contour> snowflake(int order);

/// The word CAD, `lines` lines of `lines` words: strokes of lines and cubics that meet in corners,
/// with holes in A and D; 14 cubics a word.
std::vector<Contour> lettering(int lines);

/// A coast with 2^level control points around the origin, displaced at random and less at each
/// level, as 8 clamped B-splines end to end: corners where they meet.
std::vector<Contour> border(int level);

/// The contours as one SVG path of M, L, C and Z.
std::string svg_document(const std::vector<Contour>& contours);

}  // namespace medial::papers
