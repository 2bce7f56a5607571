#pragma once

// Diagnostics: counts and times of computations, in seconds. No result depends on them.

#include <cstdint>

namespace medial {

/// Statistics of compute().
struct Statistics {
  std::uint64_t queries = 0;            ///< nearest-site queries
  std::uint64_t apollonius = 0;         ///< disks computed from three sites
  std::uint64_t brackets = 0;           ///< nodes found by bracketing, where the closed form failed
  std::uint64_t precision_retries = 0;  ///< nodes recomputed in higher precision
  std::uint64_t bridges = 0;            ///< disks that connected a hole
  /// Decisions that are certain in double, in twice its digits and in 256 bits, by their bounds.
  std::uint64_t exact_filtered = 0, exact_twofold = 0, exact_precise = 0;
  std::uint64_t exact_changes = 0;  ///< decisions in double that later ones contradict
  double largest_residual = 0;      ///< largest |distance - radius| over the nodes' contacts
  double seconds_sites = 0, seconds_tree = 0, seconds_connect = 0;
  double seconds_walk = 0, seconds_collect = 0, seconds = 0;  ///< last: total
  int threads = 1;
};

/// Statistics of compute_voxels().
struct VoxelStatistics {
  std::uint64_t surface_voxels = 0, interior_voxels = 0;
  std::uint64_t bounded_sets = 0;  ///< of interior voxels
  std::uint64_t tested_voxels = 0, face_distances = 0;
  std::uint64_t medial_voxels = 0;  ///< below the tolerance, before thinning
  std::uint64_t bridge_voxels = 0;  ///< added to keep the topology
  double seconds_tree = 0, seconds_digitize = 0, seconds_first = 0;
  double seconds_follow = 0, seconds_bridge = 0, seconds_thin = 0, seconds = 0;  ///< last: total
  int threads = 1;
};

}  // namespace medial
