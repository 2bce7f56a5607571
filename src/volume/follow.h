#pragma once

// Ridge following in space: the first medial voxel of a bounded set, then all that are connected
// with it over neighbours (report, Section V.B.3).

#include <cstdint>
#include <optional>
#include <vector>

#include "base/threads.h"
#include "volume/control.h"
#include "volume/digitize.h"
#include "volume/feet.h"
#include "volume/voxel_set.h"

namespace medial::volume {

/// A voxel of the axis and what is known of it.
struct MedialVoxel {
  std::uint64_t rank = 0;
  double radius = 0;   ///< in units of the grid
  double quality = 0;  ///< infinite for a bridge
  std::array<std::uint32_t, 2> face = {Voxel::no_face, Voxel::no_face};
  std::uint8_t across = no_axis;  ///< the axis nearest to the normal of the sheet it lies on

  static constexpr std::uint8_t no_axis = 3;
};

class RidgeFollower {
 public:
  /// Keeps references to all.
  RidgeFollower(const Grid& grid, const VoxelSet& interior, const FeetFinder& finder,
                Control& control);

  /// Finds the first medial voxel of a bounded set, plane by plane from its middle layer outwards.
  /// The report searches one plane and trusts that the axis meets it, which does not hold: the axis
  /// of a ball is a point. A set may have no medial voxel at all; peel() leaves one of it.
  /// Beside convex edges, where the surface turns by less than the angle, voxels next to the
  /// surface have feet at the angle, too; they come first only where there is nothing else.
  void find_first(const BoundedSet& set);
  /// Finds what else of the axis has voxels: starts where the largest balls that touch the surface
  /// below the outermost interior voxels have their centres. What the report trusts in, that the
  /// axis is connected, does not hold for the part of it where feet lie at the angle or more.
  void find_islands();
  /// Finds the rest, by a stack.
  void follow();
  /// Tests voxels that may be medial: those that are not count as bridges. Whether some are medial;
  /// then follow() goes on from them. Requires voxels that are no medial ones yet.
  bool add_bridges(const std::vector<std::uint64_t>& ranks);

  /// The voxels below the tolerance.
  const VoxelSet& medial() const { return medial_; }
  /// They and what was kept or added beside them, in no order to rely on.
  std::vector<MedialVoxel>& voxels() { return voxels_; }
  std::uint64_t tested() const { return tested_; }
  std::uint64_t distances() const;
  std::uint64_t bytes() const;

 private:
  struct Candidate {
    std::uint64_t rank = 0;
    std::uint32_t hint = 0;  ///< a face that is near
  };

  bool find_first(const BoundedSet& set, bool firm);
  /// Whether the exact axis beside a medial voxel has feet at the angle and a half or more.
  bool is_firm(const Candidate& candidate);
  /// Where the axis meets the ray from the surface through an outer voxel, if nothing of it is
  /// found on the way there.
  std::optional<Cell> missed(Cell outer, std::uint32_t& hint, FeetFinder::Scratch& scratch) const;
  /// The feet of voxels, in their order; in parallel.
  const std::vector<Feet>& test(const std::vector<Candidate>& batch);
  void keep(const Candidate& candidate, const Feet& feet);
  /// Puts the interior neighbours that were not tested on the stack.
  void push_neighbours(Cell cell, std::uint32_t hint);

  const Grid& grid_;
  const VoxelSet& interior_;
  const FeetFinder& finder_;
  Control& control_;
  VoxelSet checked_;
  VoxelSet medial_;
  std::vector<MedialVoxel> voxels_;
  std::vector<Candidate> stack_;
  std::vector<Candidate> batch_;
  std::vector<Feet> feet_;
  std::uint64_t tested_ = 0;
  Pool<FeetFinder::Scratch> scratch_;
};

}  // namespace medial::volume
