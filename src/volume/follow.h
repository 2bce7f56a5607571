#pragma once

// Ridge following in space: finds the first medial voxel of a bounded set, then all that are
// connected to it through neighbours (report, Section V.B.3).

#include <cstdint>
#include <optional>
#include <vector>

#include "base/threads.h"
#include "volume/control.h"
#include "volume/digitize.h"
#include "volume/feet.h"
#include "volume/voxel_set.h"

namespace medial::volume {

/// A voxel of the axis and its properties.
struct MedialVoxel {
  std::uint64_t rank = 0;
  double radius = 0;   ///< in units of the grid
  double quality = 0;  ///< infinite for a bridge
  std::array<std::uint32_t, 2> face = {Voxel::no_face, Voxel::no_face};
  std::uint8_t across = no_axis;  ///< the coordinate axis nearest to the normal of its sheet

  static constexpr std::uint8_t no_axis = 3;
};

class RidgeFollower {
 public:
  /// Keeps references to all arguments.
  RidgeFollower(const Grid& grid, const VoxelSet& interior, const FeetFinder& finder,
                Control& control);

  /// Finds the first medial voxel of a bounded set, plane by plane from its middle layer outwards.
  /// The report searches only one plane and assumes that the axis meets it, but the axis of a ball
  /// is a point. A set may have no medial voxel at all; then peel() leaves one of its voxels. Next
  /// to convex edges at which the surface turns by less than the angle, voxels next to the surface
  /// have feet at the angle, too; they are used only if there is no other voxel.
  void find_first(const BoundedSet& set);
  /// Finds further parts of the axis, starting from the centres of the largest balls that touch the
  /// surface below the outermost interior voxels. The report assumes that the axis is connected,
  /// but the part of it with feet at the angle or more need not be.
  void find_islands();
  /// Finds all voxels that are connected to those found, with a stack.
  void follow();
  /// Tests whether voxels are medial, and adds the others as bridges. Returns whether some are
  /// medial; follow() then continues from them. Requires voxels that are not medial voxels yet.
  bool add_bridges(const std::vector<std::uint64_t>& ranks);

  /// The voxels below the tolerance.
  const VoxelSet& medial() const { return medial_; }
  /// The medial voxels and those kept or added in addition, in unspecified order.
  std::vector<MedialVoxel>& voxels() { return voxels_; }
  std::uint64_t tested() const { return tested_; }
  std::uint64_t distances() const;
  std::uint64_t bytes() const;

 private:
  struct Candidate {
    std::uint64_t rank = 0;
    std::uint32_t hint = 0;  ///< a nearby face
  };

  bool find_first(const BoundedSet& set, bool firm);
  /// Whether the exact axis next to a medial voxel has feet at 1.5 times the angle or more.
  bool is_firm(const Candidate& candidate);
  /// The voxel in which the axis meets the ray from the surface through an outer voxel, if no
  /// medial voxel has been found along the ray up to there.
  std::optional<Cell> missed(Cell outer, std::uint32_t& hint, FeetFinder::Scratch& scratch) const;
  /// Computes the feet of voxels in parallel; the result is in their order.
  const std::vector<Feet>& test(const std::vector<Candidate>& batch);
  void keep(const Candidate& candidate, const Feet& feet);
  /// Pushes the interior neighbours that have not been tested.
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
