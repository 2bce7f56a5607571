#pragma once

#include <cstdint>
#include <optional>

#include "medial/axis.h"
#include "methods/problem.h"

namespace medial::ridge {

/// The measurements of the report's experiments: the four phases of Section IV, in seconds of the
/// thread's processor time, and sizes.
struct Report {
  double seconds_start = 0;   ///< digitising, vertex types, combining edges, lines
  double seconds_first = 0;   ///< inner points and first medial pixels
  double seconds_follow = 0;  ///< the rest of them
  double seconds_thin = 0;
  double seconds_necks = 0;  ///< finding them; not one of the report's phases
  std::uint64_t columns = 0, rows = 0;
  std::uint64_t sets = 0;              ///< bounded sets of interior pixels
  std::uint64_t empty_sets = 0;        ///< without a medial pixel
  std::uint64_t gates = 0;             ///< that the axis passes; see Necks
  std::uint64_t hidden = 0, torn = 0;  ///< see Necks
  std::uint64_t found = 0;             ///< medial pixels before thinning
  std::uint64_t kept = 0;              ///< and after
  std::uint64_t queries = 0;           ///< pixels whose nearest edge was sought
  std::uint64_t distances = 0;         ///< computed by the sorted list
};

/// The error if the method does not support the options.
std::optional<Error> refuse(const Problem& problem);

/// The method `ridge` (docs/ridge.md): ridge following after Volkmann and St. Clair [volkmann1987].
/// Requires what compute() and refuse() have checked. Cut short where the caller cancels.
///
/// Memory: five bits for each pixel of the grid, and some hundred bytes for each medial pixel.
MedialAxis run(const Problem& problem, Report* report = nullptr);

}  // namespace medial::ridge
