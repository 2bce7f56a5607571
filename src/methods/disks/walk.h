#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <functional>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#include "base/compat.h"
#include "base/memory.h"
#include "base/threads.h"
#include "medial/axis.h"
#include "methods/disks/contacts.h"

namespace medial::disks {

/// A growing list that never moves its elements and frees block by block. Blocks begin small and
/// double: a shape may have many components, each with lists of its own. At most half is unused.
/// A list of at least `expected` elements has fewer small blocks, which an allocator would keep.
template <class T>
class BlockList {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit BlockList(std::size_t expected = 0)
      : least_(std::clamp(std::bit_floor(expected), least, most)),
        doublings_(static_cast<std::size_t>(std::bit_width(most / least_)) - 1) {}

  void push_back(const T& value) {
    if (size_ == capacity_) {
      const std::size_t count = size_of(blocks_.size());
      blocks_.push_back(uninitialized<std::byte[]>(count * sizeof(T)));
      next_ = block(blocks_.size() - 1);
      capacity_ += count;
    }
    new (next_++) T(value);
    ++size_;
  }
  std::size_t size() const { return size_; }
  const T& operator[](std::size_t i) const {
    const std::size_t doubling_end = most - least_;
    if (i >= doubling_end)
      return block(doublings_ + (i - doubling_end) / most)[(i - doubling_end) % most];
    const std::size_t number = static_cast<std::size_t>(std::bit_width(i / least_ + 1)) - 1;
    return block(number)[i - ((least_ << number) - least_)];
  }
  /// Calls take(i, element) for all elements in order and frees each block once it is done.
  /// `gives_back`: whether the system gets its pages before the allocator has a use for them.
  template <class Take>
  void drain(bool gives_back, Take&& take) {
    std::size_t i = 0;
    for (std::size_t number = 0; i < size_; ++number) {
      const T* element = block(number);
      const std::size_t end = std::min(size_, i + size_of(number));
      for (; i < end; ++i) take(i, *element++);
      if (gives_back) give_back_pages(blocks_[number].get(), size_of(number) * sizeof(T));
      blocks_[number].reset();
    }
    *this = BlockList(least_);
  }

 private:
  static constexpr std::size_t least = 16, most = least << 8;  // elements of a block
  /// Block k begins at least_ * (2^k - 1), up to the one from which all are the largest.
  std::size_t size_of(std::size_t number) const { return least_ << std::min(number, doublings_); }
  T* block(std::size_t number) const { return reinterpret_cast<T*>(blocks_[number].get()); }

  std::size_t least_, doublings_;
  /// Bytes: an array of T would write its default values, and so touch pages that stay unused.
  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  T* next_ = nullptr;  ///< where the next element goes, unless the last block is full
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// An edge before its curve is worked out: nodes of the chunk, sites of the boundary.
struct Link {
  std::array<std::uint32_t, 2> node;  ///< from, to
  std::array<std::uint32_t, 2> site;  ///< on the left and on the right
};

/// Where the axis meets a connecting disk, on one of its two sides.
struct BridgeEnd {
  static constexpr std::uint32_t no_edge = ~std::uint32_t{0};
  std::uint32_t bridge = 0;
  std::uint32_t node = 0;        ///< of the chunk: at the bridge's centre
  std::uint32_t edge = no_edge;  ///< that leads there; none: the node is a node of the axis
};

/// What one task of the walk found. Node 0 stands for the node of the parent at which the task
/// began.
struct Chunk {
  explicit Chunk(std::size_t expected = 0) : nodes(expected), links(expected) {}

  std::uint32_t component = 0;
  std::uint32_t parent_node = 0;
  BlockList<Disk> nodes;
  BlockList<Link> links;
  std::vector<BridgeEnd> bridge_ends;
  std::vector<std::uint32_t> lost;  ///< sites at which a step before has turned out to be wrong
  std::vector<std::unique_ptr<Chunk>> children;  ///< in the order in which they were forked
  /// Early starts that the walk has come to: their numbers, and the nodes from which it came.
  std::vector<std::array<std::uint32_t, 2>> early;
  std::uint32_t span = 0;      ///< how many sites were to be walked
  std::function<void()> walk;  ///< walks it, if tasks are deferred
  Statistics statistics;
};

/// Walks the axis of every run of the boundary (docs/disks.md, step 4), from a convex corner, or
/// from the disk at a smooth place of a component that has no corner: one chunk for each component,
/// whose children were forked at branching nodes or walked from early starts (early_starts.h). The
/// chunks, their order and their content depend on the boundary only, never on the number of
/// threads. O(n log n) expected.
std::vector<std::unique_ptr<Chunk>> walk(const WalkContext& context);

/// The same deferred, with WalkContext::most_nodes: chunks that Chunk::walk walks, once and on any
/// thread, and whose children are deferred in turn. The context must outlive them.
std::vector<std::unique_ptr<Chunk>> put_off_walk(const WalkContext& context);

/// Walks a part of a boundary, its one run, from a disk that touches the run's first and last site
/// and is at most `error` off. The disk is node 1 of the chunk, which has no children.
std::unique_ptr<Chunk> walk_part(const WalkContext& context, const Disk& start, double error);

}  // namespace medial::disks
