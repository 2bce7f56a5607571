#pragma once

#include <cstdint>

namespace medial {

/// What an engine counted and how long it took.
struct Statistics {
  std::uint64_t queries = 0;            ///< nearest-site queries
  std::uint64_t apollonius = 0;         ///< disks computed from three sites
  std::uint64_t brackets = 0;           ///< nodes found by bracketing, where the closed form failed
  std::uint64_t precision_retries = 0;  ///< nodes recomputed in higher precision
  std::uint64_t bridges = 0;            ///< disks that connected a hole
  std::uint64_t exact_filtered = 0;     ///< of Options::exact: decided in double with error bounds,
  std::uint64_t exact_precise = 0;      ///< in 256 bits with error bounds,
  std::uint64_t exact_rational = 0;     ///< in rational arithmetic with square roots;
  std::uint64_t exact_ties = 0;         ///< sites beyond three that a node's disk touches exactly
  std::uint64_t exact_changes = 0;      ///< places where double precision had decided otherwise
  double largest_residual = 0;          ///< largest |distance - radius| over the nodes' contacts
  double seconds_sites = 0;
  double seconds_tree = 0;
  double seconds_connect = 0;
  double seconds_walk = 0;
  double seconds_collect = 0;
  double seconds_exact = 0;
  double seconds = 0;  ///< all of compute()
  int threads = 1;

  /// Adds what another part of the work has counted and taken; `threads` stays.
  Statistics& operator+=(const Statistics& part);
};

}  // namespace medial
