#pragma once

#include <memory>
#include <vector>

#include "engines/disks/contacts.h"
#include "medial/axis.h"

namespace medial::disks {

/// A growing list that never moves its elements and frees block by block. The first block is small:
/// a shape may have many components.
template <class T>
class BlockList {
 public:
  void push_back(const T& value) {
    const auto [block, place] = find(size_++);
    if (place == 0)
      blocks_.push_back(std::make_unique_for_overwrite<T[]>(block == 0 ? first_block : block_size));
    blocks_.back()[place] = value;
  }
  std::size_t size() const { return size_; }
  const T& operator[](std::size_t i) const {
    const auto [block, place] = find(i);
    return blocks_[block][place];
  }
  /// Calls take(i, element) for all elements in order and frees each block once it is done.
  template <class Take>
  void drain(Take&& take) {
    std::size_t before = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const auto [block, place] = find(i);
      if (block != before) blocks_[before].reset();
      before = block;
      take(i, blocks_[block][place]);
    }
    blocks_.clear();
    size_ = 0;
  }

 private:
  static constexpr std::size_t first_block = 64;
  static constexpr std::size_t block_size = 1 << 13;
  struct Position {
    std::size_t block, place;
  };
  static Position find(std::size_t i) {
    if (i < first_block) return {0, i};
    return {1 + (i - first_block) / block_size, (i - first_block) % block_size};
  }
  std::vector<std::unique_ptr<T[]>> blocks_;
  std::size_t size_ = 0;
};

/// An edge before its curve is worked out: nodes of the chunk, sites of the boundary.
struct RawEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t right = 0;
  std::uint32_t left = 0;
};

/// Where the axis meets a connecting disk, on one of its two sides.
struct CutEnd {
  static constexpr std::uint32_t no_edge = ~std::uint32_t{0};
  std::uint32_t cut = 0;
  std::uint32_t node = 0;  ///< of the chunk: at the cut's centre
  std::uint32_t edge =
      no_edge;  ///< the edge that leads there; none: the node is a node of the axis
};

/// What one task of the walk found. Node 0 stands for the node of the parent at which the task
/// began.
struct Chunk {
  std::uint32_t component = 0;
  std::uint32_t parent_node = 0;
  BlockList<Disk> nodes;
  BlockList<RawEdge> edges;
  std::vector<CutEnd> cut_ends;
  std::vector<std::unique_ptr<Chunk>> children;  ///< in the order in which they were forked
  Statistics statistics;
};

/// Walks the axis of every run of the boundary (docs/disks.md, step 4), from a convex corner, or
/// from the disk at a smooth place of a component that has no corner: one chunk for each component,
/// whose children were forked at branching nodes. The chunks, their order and their content depend
/// on the boundary only, never on the number of threads. O(n log n) expected.
std::vector<std::unique_ptr<Chunk>> walk(const WalkContext& context);

}  // namespace medial::disks
