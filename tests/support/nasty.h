#pragma once

// Shapes on which rounding decides what the axis looks like, by classes: see generate.h for milder
// ones. One seed, one shape, for ever; most are valid input for build_shape(), some of them have
// gaps that rounding closed.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "medial/planar_graph.h"
#include "support/generate.h"

namespace medial::test {

struct NastyClass {
  std::string_view name;
  /// Of about a dozen sites if `small`, and of tens otherwise.
  Rings (*generate)(Random& random, bool small);
  bool has_arcs = false;
};

/// strips: of height 1 and length 1e6 to 1e14, with notches and bumps.
/// slits: clusters of slits of 0.5 to 10 tolerances, as far apart, in a unit square.
/// stretched: holes, slits and cells, their x multiplied by 1e6 to 1e15.
/// needles: triangles thinner than rounding.
/// polygons: narrow ones of four to six vertices.
/// rings: that all but touch each other, or themselves.
/// grids: cells of integers, and polygons on them.
/// splinters: polygons with edges of 1e-16 to 1e-12.
/// rounds: regular polygons, their vertices off by 1e-16 to 1e-10 of the radius.
/// groups: two to four of one of these classes, a quadrant each, as components or as holes.
/// circles: as rounds, of arcs.
/// bars: with rounded ends of one to five arcs, off by as much.
/// tangents: random arcs that join smoothly but for an angle of 1e-16 to 1e-7.
/// gears: turned by any angle, their vertices off by 1e-16 to 1e-10, half of them with holes.
/// plates: with round holes and slots around the middle, off by as much.
/// sides: straight ones with points on them, which round to either side of the line.
/// And nasty_arc_classes().
std::span<const NastyClass> nasty_classes();

/// Outlines of arcs, whose points and bulges are off by 1e-16 to 1e-3, some with edges as short as
/// that, some far from the origin. Some are no valid input.
/// rows: of circles, joined by necks of 1e-14 to 0.1.
/// belts: around pulleys, on their outside and inside. slots: between two arcs of one centre.
/// lenses: of two arcs, often of one circle, with sides of 1e-14 to 0.1 at their ends.
/// rosettes: arcs over the sides of a regular polygon. sectors: stairs around one centre.
/// dimples: a dent, bump or slit on a circle, bar or polygon.
/// fillets: corners rounded by as much as fits, or by very little. bows: hardly bent edges.
/// offsets: of these, and offsets of offsets; made by the library, so that another version of it
/// may make another shape of a seed.
std::span<const NastyClass> nasty_arc_classes();

Rings nasty_shape(const NastyClass& one, std::uint64_t seed, bool small);
/// The same with some of the edges left out.
std::vector<Chain> nasty_chains(const NastyClass& one, std::uint64_t seed, bool small);
/// The same, and beside some of the edges points, 1e-15 to 1e-9 of the size away.
std::vector<Chain> nasty_chains_and_points(const NastyClass& one, std::uint64_t seed, bool small);

/// Planar graphs of arcs with points in, or next to, where these end, join and have their centres,
/// up to 1e-9 of the size away: as an attack made them. Some are no valid input.
struct NastyGraphClass {
  std::string_view name;
  std::vector<Chain> (*generate)(Random& random);
};
std::span<const NastyGraphClass> nasty_graph_classes();
std::vector<Chain> nasty_graph(const NastyGraphClass& one, std::uint64_t seed);

/// Slots, strips, wedges and rings as near to each other as 1e-14 to 1e-6 of the size.
Rings narrow_gaps(Random& random);

}  // namespace medial::test
