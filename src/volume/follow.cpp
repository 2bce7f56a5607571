#include "volume/follow.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/vec3.h"
#include "volume/predicates.h"

namespace medial::volume {
namespace {

/// Voxels tested between two looks at the stack, and so between two answers to the caller. It does
/// not depend on the number of threads, nor does the result on it.
constexpr std::size_t batch_size = 4096;

MedialVoxel describe(std::uint64_t rank, Vec3 center, const Feet& feet) {
  MedialVoxel voxel{rank, feet.radius, feet.quality, feet.face, MedialVoxel::no_axis};
  if (!feet.medial()) return voxel;
  // The distances to the two feet differ most along the difference of the directions to them.
  const Vec3 a = feet.foot[0] - center, b = feet.foot[1] - center;
  voxel.across = static_cast<std::uint8_t>(longest_axis(1 / norm(a) * a - 1 / norm(b) * b));
  return voxel;
}

}  // namespace

RidgeFollower::RidgeFollower(const Grid& grid, const VoxelSet& interior, const FeetFinder& finder,
                             Control& control)
    : grid_(grid),
      interior_(interior),
      finder_(finder),
      control_(control),
      checked_(grid.size),
      medial_(grid.size) {}

const std::vector<Feet>& RidgeFollower::test(const std::vector<Candidate>& batch) {
  control_.check(bytes());
  feet_.resize(batch.size());
  constexpr std::size_t grain = 64;
  parallel_ranges(batch.size(), grain, [&](std::size_t begin, std::size_t end) {
    scratch_.with_one([&](FeetFinder::Scratch& scratch) {
      for (std::size_t i = begin; i < end; ++i)
        feet_[i] =
            finder_.feet(center_of(cell_of(batch[i].rank, grid_.size)), batch[i].hint, scratch);
    });
  });
  tested_ += batch.size();
  return feet_;
}

void RidgeFollower::keep(const Candidate& candidate, const Feet& feet) {
  const Cell cell = cell_of(candidate.rank, grid_.size);
  voxels_.push_back(describe(candidate.rank, center_of(cell), feet));
  medial_.insert(cell);
  push_neighbours(cell, feet.face[0]);
}

void RidgeFollower::push_neighbours(Cell cell, std::uint32_t hint) {
  Neighbourhood fresh = interior_.around(cell) & ~checked_.around(cell);
  for (; fresh != 0; fresh &= fresh - 1) {
    const Cell next = neighbour(cell, std::countr_zero(fresh));
    checked_.insert(next);
    stack_.push_back({rank_of(next, grid_.size), hint});
  }
}

bool RidgeFollower::is_firm(const Candidate& candidate) {
  bool firm = false;
  scratch_.with_one([&](FeetFinder::Scratch& scratch) {
    const auto ray =
        finder_.ray(center_of(cell_of(candidate.rank, grid_.size)), candidate.hint, scratch);
    firm = finder_.axis_point(ray, ray.length + finder_.reach(), scratch).has_value();
  });
  return firm;
}

void RidgeFollower::find_first(const BoundedSet& set) {
  if (!find_first(set, true)) find_first(set, false);
}

bool RidgeFollower::find_first(const BoundedSet& set, bool firm) {
  const std::uint32_t middle = set.low + (set.high - set.low) / 2;
  std::uint32_t hint = 0;
  for (std::uint32_t step = 0; step <= 2 * (set.high - set.low) + 1; ++step) {
    const std::uint32_t away = (step + 1) / 2;
    if (step % 2 == 1 ? middle + away > set.high : away > middle - set.low) continue;
    const std::uint32_t layer = step % 2 == 1 ? middle + away : middle - away;
    auto run = std::lower_bound(set.runs.begin(), set.runs.end(), layer,
                                [](const CellRun& r, std::uint32_t z) { return r.z < z; });
    std::uint32_t x = run == set.runs.end() ? 0 : run->begin;
    while (run != set.runs.end() && run->z == layer) {
      batch_.clear();
      while (batch_.size() < batch_size && run != set.runs.end() && run->z == layer) {
        const Cell cell = {x, run->y, run->z};
        if (checked_.insert(cell)) batch_.push_back({rank_of(cell, grid_.size), hint});
        if (++x < run->end) continue;
        if (++run != set.runs.end()) x = run->begin;
      }
      const std::vector<Feet>& feet = test(batch_);
      if (!feet.empty()) hint = feet.back().face[0];
      std::vector<std::size_t> found;
      for (std::size_t i = 0; i < batch_.size(); ++i) {
        if (!feet[i].medial()) continue;
        if (!firm || is_firm(batch_[i]))
          found.push_back(i);
        else
          checked_.erase(cell_of(batch_[i].rank, grid_.size));
      }
      for (const std::size_t i : found) keep(batch_[i], feet[i]);
      if (!found.empty()) return true;
    }
  }
  return false;
}

std::optional<Cell> RidgeFollower::missed(Cell outer, std::uint32_t& hint,
                                          FeetFinder::Scratch& scratch) const {
  const FeetFinder::Ray ray = finder_.ray(center_of(outer), hint, scratch);
  hint = ray.face;
  const auto cell_at = [](Vec3 p) {
    return Cell{static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y),
                static_cast<std::uint32_t>(p.z)};
  };
  // A ball inside that touches the foot is no wider than the way to the other side.
  double length = ray.length;
  for (;; ++length) {
    const Cell cell = cell_at(ray.foot + length * ray.up);
    if (medial_.contains(cell)) return std::nullopt;
    if (!interior_.contains(cell)) break;
  }
  const auto point = finder_.axis_point(ray, 0.5 * length + 2, scratch);
  if (!point || !interior_.contains(cell_at(*point))) return std::nullopt;
  return cell_at(*point);
}

void RidgeFollower::find_islands() {
  // A quarter of the outermost layer. In a layer along any plane the sum takes all values.
  std::vector<Cell> outer;
  each_voxel(interior_, [&](Cell cell) {
    if ((cell.x + 2 * cell.y + 3 * cell.z) % 4 == 0 && interior_.around(cell) != all_bits)
      outer.push_back(cell);
  });
  constexpr std::size_t grain = 64;
  constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> found;
  std::vector<std::uint64_t> ranks;
  for (std::size_t first = 0; first < outer.size(); first += batch_size) {
    control_.check(bytes() + outer.capacity() * sizeof(Cell));
    const std::size_t count = std::min(batch_size, outer.size() - first);
    found.assign(count, none);
    parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
      scratch_.with_one([&](FeetFinder::Scratch& scratch) {
        std::uint32_t hint = 0;
        for (std::size_t i = begin; i < end; ++i) {
          const auto cell = missed(outer[first + i], hint, scratch);
          if (cell) found[i] = rank_of(*cell, grid_.size);
        }
      });
    });
    for (const std::uint64_t rank : found)
      if (rank != none) ranks.push_back(rank);
  }
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  // A sheet may pass between the voxel and one next to it.
  for (const std::uint64_t rank : ranks) push_neighbours(cell_of(rank, grid_.size), 0);
}

void RidgeFollower::follow() {
  // What is still to come is not known; a sheet of about six voxels for each on the stack is a
  // guess.
  while (!stack_.empty()) {
    const std::size_t count = std::min(batch_size, stack_.size());
    batch_.assign(stack_.end() - static_cast<std::ptrdiff_t>(count), stack_.end());
    stack_.resize(stack_.size() - count);
    const std::vector<Feet>& feet = test(batch_);
    for (std::size_t i = 0; i < batch_.size(); ++i)
      if (feet[i].medial()) keep(batch_[i], feet[i]);
    const auto done = static_cast<double>(tested_);
    control_.report(0.1 + 0.6 * done / (done + 6 * static_cast<double>(stack_.size()) + 1e5));
  }
}

bool RidgeFollower::add_bridges(const std::vector<std::uint64_t>& ranks) {
  bool found = false;
  std::vector<Candidate> batch;
  for (std::size_t begin = 0; begin < ranks.size(); begin += batch_size) {
    const std::size_t end = std::min(ranks.size(), begin + batch_size);
    batch.clear();
    for (std::size_t i = begin; i < end; ++i) batch.push_back({ranks[i], 0});
    const std::vector<Feet>& feet = test(batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      checked_.insert(cell_of(batch[i].rank, grid_.size));
      if (feet[i].medial()) {
        found = true;
        keep(batch[i], feet[i]);
      } else {
        voxels_.push_back(describe(batch[i].rank, {}, feet[i]));
      }
    }
  }
  return found;
}

std::uint64_t RidgeFollower::distances() const {
  std::uint64_t total = 0;
  for (const FeetFinder::Scratch& scratch : scratch_.all()) total += scratch.distances;
  return total;
}

std::uint64_t RidgeFollower::bytes() const {
  return interior_.bytes() + checked_.bytes() + medial_.bytes() +
         voxels_.capacity() * sizeof(MedialVoxel) + stack_.capacity() * sizeof(Candidate) +
         grid_.faces.size() * 400;
}

}  // namespace medial::volume
