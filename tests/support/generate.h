#pragma once

// Shapes for tests and benchmarks: fixed families, random polygons from a seed, and symmetries.
//
// Everything is deterministic: the random numbers are a generator of our own, and no distribution
// of the standard library (whose results differ between implementations) is used. Unless said
// otherwise, what is returned is valid input for medial::build_shape().

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "medial/planar_graph.h"
#include "medial/shape.h"

namespace medial::test {

using Rings = std::vector<Ring>;

/// splitmix64 (Steele, Lea, Flood 2014): every seed gives an independent stream.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// Uniform in [0, 1), a multiple of 2^-53.
  double unit();
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Uniform in low..high, both included.
  std::int64_t integer(std::int64_t low, std::int64_t high);
  /// 10^u, u uniform in [low, high].
  double power_of_ten(double low, double high);
  bool chance(double probability) { return unit() < probability; }

 private:
  std::uint64_t state_;
};

Ring ring_of(std::vector<Vec2> points);

// ---- Fixed families. Rectilinear ones have integer coordinates where the arguments are integers.

/// [0, width] x [0, height].
Rings rectangle(double width, double height);
/// The square [0, 2a]^2 less its upper right quarter: both arms are a wide.
Rings l_shape(double a);
/// A bar [0, 3a] x [2a, 3a] on a stem [a, 2a] x [0, 2a].
Rings t_shape(double a);
/// [0, 3a] x [0, 2a] less [a, 2a] x [a, 2a].
Rings u_shape(double a);
/// Plus sign in [0, 3a]^2; every arm is a wide and a long.
Rings cross_shape(double a);
/// A back [0, 2 teeth - 1] x [0, back] with teeth of width 1 and the given length on it, gaps of 1;
/// 4 teeth vertices.
Rings comb(std::size_t teeth, double back = 1, double length = 5);
Rings triangle(Vec2 a, Vec2 b, Vec2 c);
/// Regular n-gon around the origin, the first vertex at (radius, 0).
Rings regular_polygon(std::size_t n, double radius = 1);
/// A smooth star: n points of r = 1 + 0.3 cos 5t + 0.05 cos 13t: near-cocircular sites everywhere.
Rings blob(std::size_t n);
/// 2n vertices, alternately far from and near to the centre, with noise.
Rings jagged_star(std::size_t n, std::uint64_t seed = 1);
/// The corridors of a random spanning tree of a square grid, 6 wide in cells of 10, with walls
/// between them: one simple polygon of about n vertices (within 3 percent for n >= 1e4) with
/// integer coordinates.
Rings maze(std::size_t n, std::uint64_t seed = 1);
/// A square with k x k unit square holes at distance 1 from each other and from the border.
Rings hole_grid(std::size_t k);
/// Squares around each other at distance 1: every second one is a hole.
Rings nested_squares(std::size_t rings);
/// A band along an Archimedean spiral of the given number of turns; 2n vertices.
Rings spiral(std::size_t n, double turns = 4);
/// A triangle of length 1 with the given angle (radians) at its tip.
Rings needle(double angle);

// ---- Random polygons.

/// A simple polygon through n random points of the integer grid [0, grid)^2, untangled by 2-opt
/// moves. O(n^3) expected; for n <= 60 and grid >= n.
Rings untangled(Random& random, std::size_t n, std::int64_t grid);

struct StarOptions {
  double inner = 0.3;         ///< radii are uniform in [inner, 1]
  double spikes = 0;          ///< probability that a vertex gets a spike (half outwards)
  double spike_angle = 1e-6;  ///< half of a spike's angle as seen from the centre
  double bumps = 0;           ///< probability that a vertex gets a bump
  double bump_size = 1e-9;    ///< of a bump
  int runs = 0;               ///< points put on every edge,
  double run_noise = 1e-12;   ///< each moved by this fraction towards or from the centre
};
/// A polygon that is star-shaped around the origin; n >= 4 corners before spikes and runs.
Ring star(Random& random, std::size_t n, const StarOptions& options = {});

struct LatticeOptions {
  bool touching = true;     ///< cells may meet in a corner only, so that rings touch in vertices
  bool equal_steps = true;  ///< unit cells; otherwise rows and columns of random integer widths
  bool keep_collinear = false;  ///< keep the vertices in the inside of straight runs
};
/// The outline of a random edge-connected set of lattice cells with all its holes; integers.
Rings lattice_cells(Random& random, std::size_t cells, const LatticeOptions& options = {});

/// A star with a grid of star-shaped holes in it, none touching.
Rings star_with_holes(Random& random, std::size_t n, std::size_t holes_per_side);
/// Outer ring, lake, island in the lake, lake on the island ...: `depth` rings.
Rings nested(Random& random, std::size_t n, std::size_t depth);
/// A square with holes that come as near as `gap` to it and to each other, with vertices and edges.
Rings near_touching(Random& random, double gap);
/// A square of k x k cells of size 4 with holes that touch it, and each other, in vertices and with
/// vertices in the inside of edges; the interior stays connected. Integers.
Rings touching_holes(Random& random, std::size_t k);

/// A random shape of any of the kinds above; one seed, one shape, for ever.
struct RandomShape {
  std::string kind;
  Rings rings;
  /// Nothing about its axis depends on the last digits of a coordinate: no flat corners, needles or
  /// exact contacts inside of edges.
  bool rigid = false;
};
RandomShape random_shape(std::uint64_t seed);
/// The same on integer coordinates below 2^22 (for peers that know no others).
RandomShape random_integer_shape(std::uint64_t seed);

// ---- Symmetries.

/// p -> (xx x + xy y + dx, yx x + yy y + dy), then the order of the points.
struct Symmetry {
  std::string name;
  double xx = 1, xy = 0, yx = 0, yy = 1, dx = 0, dy = 0;
  bool reverse = false;
  std::size_t restart = 0;  ///< rotates the points of every ring, and the order of the rings
  bool exact = true;        ///< commits no rounding on coordinates that are small integers

  Vec2 operator()(Vec2 p) const { return {xx * p.x + xy * p.y + dx, yx * p.x + yy * p.y + dy}; }
  /// By how much lengths grow.
  double scale() const;
};

/// Rotated, turned by a quarter, scaled by 1e-6 and 1e9, shifted by 1e7, mirrored, reversed,
/// re-started, and all together. The first is the identity.
const std::vector<Symmetry>& symmetries();
Rings transformed(const Rings& rings, const Symmetry& symmetry);
/// The same of chains; open ones keep their first point, or begin with the last one.
std::vector<Chain> transformed(const std::vector<Chain>& chains, const Symmetry& symmetry);
/// transformed(rings, symmetries()[i]).
Rings symmetric(const Rings& rings, std::size_t i);

/// The rings as one WKT POLYGON, the outer ring first, each coordinate in 17 digits.
std::string to_wkt(const Rings& rings);

std::size_t vertex_count(const Rings& rings);

}  // namespace medial::test
