#pragma once

// The experiments of [aichholzer2009], Section 5, as values. No printing here.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "medial/contour.h"

namespace medial::cli {

/// The least of some rounds, of the processor and of the clock on the wall.
struct Timing {
  double processor = 0;
  double wall = 0;
};

/// One shape at one tolerance: a line of Table 1, a point in Figs. 12, 15 and 16. All on one
/// thread.
struct BiarcRow {
  std::string shape;
  double tolerance = 0;     ///< relative to the diagonal
  std::uint64_t edges = 0;  ///< of the shape: arcs, and the straight edges beside them
  std::uint64_t straight = 0;
  double error = 0;   ///< certified Hausdorff distance, relative to the diagonal
  Timing conversion;  ///< approximate_by_arcs(), the paper's first column of times
  Timing building;    ///< build_shape(): crossings, nesting; the paper has no such step
  Timing axis;        ///< compute(), the paper's column of double
  /// compute() with Options::exact, the paper's column of Gmpq; without a value where
  /// `exact_note` says why.
  std::optional<Timing> exact;
  std::string exact_note;
  std::uint64_t exact_changes = 0;  ///< where it decided otherwise
  std::uint64_t leaves = 0;
  std::uint64_t branchings = 0;
  std::string failure;  ///< an error, or what verify() refused; empty: verified

  /// The paper's own method (`biarc-dc`); without a value where `published_note` says why.
  std::optional<Timing> published;
  double published_conquer = 0;           ///< seconds of `published` in base cases and curves
  std::vector<std::uint64_t> base_cases;  ///< how many of (a), (b), ..., (m), Figs. 5 and 6
  std::string published_note;
};

/// The same shape by arcs and by a polygon of as many edges (Fig. 13).
struct PolygonComparison {
  std::string shape;
  std::uint64_t edges = 0;
  std::uint64_t arc_leaves = 0;
  std::uint64_t polygon_leaves = 0;
  double arc_error = 0;      ///< certified, relative to the diagonal
  double polygon_error = 0;  ///< sampled: at least this, relative to the diagonal
  std::string failure;
};

struct BiarcOptions {
  int rounds = 5;   ///< of which the least time counts
  int finest = 9;   ///< tolerances 1e-3 to 1e-(2 + finest) of the diagonal
  int largest = 6;  ///< the series by size ends at about 10^largest arcs
  bool published = true;
  std::uint64_t published_limit = 200000;  ///< edges of the largest shape for the paper's method
};

struct BiarcReport {
  std::vector<BiarcRow> by_tolerance;  ///< shape after shape, by falling tolerance
  std::vector<BiarcRow> by_size;       ///< shape after shape, growing, tolerance 1e-6
  std::vector<PolygonComparison> polygons;
  bool passed() const;
};

/// A shape's name and its contours, for every shape of the series by tolerance.
std::vector<std::pair<std::string, std::vector<Contour>>> biarc_shapes();

/// `progress` is told each row's name before it is measured.
BiarcReport run_biarc_experiments(const BiarcOptions& options,
                                  void (*progress)(const std::string&));

/// The exponent p of y ~ x^p that fits best (least squares of the logarithms). Requires two
/// different x.
double fitted_exponent(const std::vector<std::pair<double, double>>& points);

}  // namespace medial::cli
