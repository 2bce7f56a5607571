#pragma once

// The experiment on Lee's divide and conquer: its time against the number of vertices, the share of
// each level of merges, and the paper's figures.

#include <cstdint>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/common.h"

namespace medial::cli {

/// One shape of one size; processor time of one thread, the least of some rounds.
struct LeeRow {
  std::string shape;
  std::uint64_t vertices = 0;
  std::uint64_t elements = 0;  ///< segments and reflex vertices: the paper's N
  double lee = 0;              ///< seconds
  double disks = 0;            ///< seconds of the method disks
  double crossings = 0;        ///< of merge curves with Voronoi edges, an element
  std::vector<double> levels;  ///< seconds of the merges, from the last one down
  double bytes = 0;            ///< at the peak, of compute(), an element; 0 where nobody tells
  std::string failure;         ///< an error, or what verify() refused; empty: verified
};

/// Sizes 1e2 to 10^largest of a coast, a maze, a blob, an ellipse and a regular polygon. `progress`
/// is told each row's name before it is measured.
std::vector<LeeRow> run_lee_experiment(int largest, int rounds,
                                       void (*progress)(const std::string&));

/// The paper's Figs. 1 to 6 as SVG files in a directory. Errors: unwritable.
Status write_lee_figures(const std::string& directory);

/// `medial bench lee`.
Command add_lee_bench(CLI::App& bench);

}  // namespace medial::cli
