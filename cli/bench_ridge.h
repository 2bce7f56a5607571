#pragma once

// The experiments of [volkmann1987], Section IV, as values. No printing here.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "cli/common.h"
#include "medial/compute.h"
#include "medial/shape.h"

namespace medial::cli {

/// The four phases that the report times, and what they had to do. Seconds of one thread, each the
/// least of some rounds.
struct RidgeTimes {
  double start = 0;   ///< digitising, vertex types, combined edges, lines: steps 1 to 6 of Table I
  double first = 0;   ///< inner point and first medial pixel: 7 and 8
  double follow = 0;  ///< the rest of the medial pixels: 9
  double thin = 0;    ///< 10
  std::uint64_t checked = 0;  ///< pixels of which the nearest edges were sought
  std::uint64_t found = 0;    ///< medial pixels before thinning
  std::uint64_t kept = 0;     ///< and after
  double total() const { return start + first + follow + thin; }
};

/// One shape: a point in each plot of its series.
struct RidgeRow {
  std::string series;       ///< "edges", "area", "holes", "concave"
  double value = 0;         ///< what varies: edges, area, holes, concave vertices
  std::uint64_t run = 0;    ///< of "concave": concave vertices next to each other
  std::uint64_t edges = 0;  ///< of the shape
  double area = 0;
  std::uint64_t concave = 0;  ///< vertices
  RidgeTimes list;            ///< the report's method: sorted list, difference, 5 degrees
  RidgeTimes tree;            ///< the same with the tree
  RidgeTimes crossing;        ///< the tree and the rule `crossing`, every edge kept
  std::string refused;        ///< what build_shape() says of a shape that is none
  std::string failure;        ///< list and tree differ, or an axis has other cycles than holes
};

struct RidgeBenchOptions {
  int rounds = 5;
  double per_unit = 20;  ///< pixels along a unit of length
  bool quick = false;    ///< a few shapes of each series
};

/// Polygons, as rings, in the report's series.
Ring regular_polygon_of_area(int edges, double area);
/// A square with teeth along its border; each hole takes the place of three teeth (Fig. 29). At
/// most 20 holes; edges, convex and concave vertices are as many for any number of holes.
std::vector<Ring> toothed_square(int holes);
/// The regular polygon of 20 edges of which `sets` runs of `run` vertices are reflected about the
/// line through their neighbours (Fig. 31).
Ring flipped_polygon(int sets, int run);

std::vector<RidgeRow> run_ridge_experiments(const RidgeBenchOptions& options,
                                            void (*progress)(const std::string&));

/// The correlation of two series of numbers, as the report gives it for Figs. 19, 20 and 25.
double correlation(const std::vector<std::pair<double, double>>& points);

/// Adds the experiment `ridge` to the command `bench`.
Command add_ridge_bench(CLI::App& bench);

}  // namespace medial::cli
