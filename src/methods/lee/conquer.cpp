#include "methods/lee/conquer.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <mutex>

#include "axis/statistics.h"
#include "base/stopwatch.h"
#include "base/threads.h"
#include "methods/lee/fan.h"

namespace medial::lee {
namespace {

/// One task merges all levels of a list of about this many chains, which fits into its cache.
constexpr std::uint32_t block_size = 1024;
/// Lists of at most 2^levels_at_bottom chains are merged level by level.
constexpr int levels_at_bottom = 3;

/// The halving of one loop's chains.
struct Halving {
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  /// On this level, no list has more than one chain.
  int deepest() const { return static_cast<int>(std::bit_width(count - 1)); }
  std::uint32_t boundary(int level, std::uint64_t i) const {
    return first + static_cast<std::uint32_t>((count * i) >> level);
  }
  /// The work of merging some levels, in chains times levels.
  std::uint64_t work(int begin_level, int end_level) const {
    return std::uint64_t{count} * static_cast<std::uint64_t>(end_level - begin_level);
  }
};

/// Disks that may touch all of the next list: the disk that touched the last list solved in closed
/// form, and that of the next such list, if it is known already.
struct RoundDisks {
  std::optional<Disk> last;
  std::optional<Disk> next;
};

/// The lists of the first levels of a halving, numbered level by level.
struct Lists {
  static std::size_t number(int level, std::uint64_t i) { return (std::size_t{1} << level) + i; }
  std::vector<bool> solved;           ///< in closed form, alone or as a part of a larger list
  std::vector<RoundDisks> of_blocks;  ///< of the lists of the last level
};

class Conquest {
 public:
  Conquest(Diagram& diagram, const ConquerContext& context, Statistics& statistics)
      : diagram_(diagram), context_(context), statistics_(statistics) {
    for (const Elements::ChainLoop& loop : diagram.elements.loops) {
      const Halving halving{loop.first_chain, loop.end_chain - loop.first_chain};
      all_work_ += halving.work(0, halving.deepest());
    }
  }

  /// Whether a merge has found that a diagram is broken: the remaining merges are skipped.
  bool is_broken() const { return broken_.load(std::memory_order_relaxed); }

  /// Merges the halves of list i of a level; one half may be empty.
  void merge_halves(const Halving& halving, int level, std::uint64_t i, Statistics& statistics) {
    const std::uint32_t first = halving.boundary(level, i),
                        middle = halving.boundary(level + 1, 2 * i + 1),
                        end = halving.boundary(level, i + 1);
    if (first == middle || middle == end || is_broken()) return;
    const std::uint32_t edge = merge(diagram_, first, middle, end, context_.limits, statistics);
    if (edge == none) broken_.store(true, std::memory_order_relaxed);
    if (level == 0) last_edge_ = edge;
  }

  /// Does all merges below one list.
  void merge_below(const Halving& halving, int level, std::uint64_t i, RoundDisks known) {
    Statistics own;
    merge_parts(halving, level, i, std::max(level, halving.deepest() - levels_at_bottom), known,
                own);
    if (is_broken()) return;
    add(own);
    report(halving.work(level, halving.deepest()) >> level);
  }

  /// Merges one level after another, on this thread.
  std::uint32_t merge_measured(const Halving& halving, std::vector<Level>& levels) {
    const int deepest = halving.deepest();
    levels.resize(std::max(levels.size(), static_cast<std::size_t>(deepest)));
    for (int k = deepest - 1; k >= 0 && !is_stopped(); --k) {
      Statistics own;
      Stopwatch watch;
      for (std::uint64_t j = 0; j < std::uint64_t{1} << k; ++j) merge_halves(halving, k, j, own);
      Level& level = levels[static_cast<std::size_t>(k)];
      level.seconds += watch.lap();
      level.crossings += own.queries;
      add(own);
    }
    return last_edge_;
  }

  std::uint32_t merge_all(const Halving& halving) {
    int block_level = 0;
    while ((halving.count >> block_level) > block_size) ++block_level;
    const Lists lists = solve_fans(halving, block_level);
    parallel_for(std::size_t{1} << block_level, [&](std::uint64_t i) {
      if (!lists.solved[Lists::number(block_level, i)])
        merge_below(halving, block_level, i, lists.of_blocks[i]);
    });
    for (int level = block_level - 1; level >= 0 && !is_stopped(); --level) {
      parallel_for(std::size_t{1} << level, [&](std::uint64_t i) {
        if (lists.solved[Lists::number(level, i)]) return;
        Statistics own;
        merge_halves(halving, level, i, own);
        add(own);
        report(halving.work(level, level + 1) >> level);
      });
    }
    return last_edge_;
  }

 private:
  /// Solves the lists of the first levels that have a closed form, the largest first. A block of a
  /// circle with very many sides turns too little to determine its disk by itself.
  Lists solve_fans(const Halving& halving, int block_level) {
    const std::uint64_t blocks = std::uint64_t{1} << block_level;
    Lists lists{std::vector<bool>(2 * blocks), std::vector<RoundDisks>(blocks)};
    auto& disks = lists.of_blocks;
    for (int level = 1; level <= block_level; ++level)
      for (std::uint64_t i = 0; i < std::uint64_t{1} << level; ++i) {
        const std::size_t list = Lists::number(level, i);
        lists.solved[list] = lists.solved[list / 2];
        if (lists.solved[list]) continue;
        const std::uint64_t begin = i << (block_level - level), end = (i + 1)
                                                                      << (block_level - level);
        RoundDisks known;
        if (begin > 0) known.last = disks[begin - 1].last;
        if (end < blocks) known.next = disks[end].last;
        lists.solved[list] = is_fan(halving, level, i, known);
        if (!lists.solved[list]) continue;
        for (std::uint64_t j = begin; j < end; ++j) disks[j].last = known.last;
      }
    for (std::uint64_t i = 1; i < blocks; ++i) {
      if (!disks[i].last) disks[i].last = disks[i - 1].last;
    }
    for (std::uint64_t i = blocks - 1; i-- > 0;) {
      const bool is_next = lists.solved[Lists::number(block_level, i + 1)];
      disks[i].next = is_next ? disks[i + 1].last : disks[i + 1].next;
    }
    for (std::uint64_t i = 0; i < blocks; ++i) {
      const std::size_t block = Lists::number(block_level, i);
      RoundDisks& known = lists.of_blocks[i];
      if (!lists.solved[block] && (known.last || known.next))
        lists.solved[block] = is_fan(halving, block_level, i, known);
    }
    return lists;
  }

  /// Merges a list from its parts at level `bottom`. Merges two lists as soon as both are ready,
  /// while they are in the cache.
  void merge_parts(const Halving& halving, int level, std::uint64_t i, int bottom,
                   RoundDisks& known, Statistics& statistics) {
    for (std::uint64_t j = i << (bottom - level);
         j < (i + 1) << (bottom - level) && !is_stopped();) {
      // The next list to solve, and its level: the largest one that has a closed form.
      int k = std::max(level, bottom - std::countr_zero(j));
      while (k < bottom && !is_fan(halving, k, j >> (bottom - k), known)) ++k;
      if (k == bottom) merge_bottom(halving, bottom, j, known, statistics);
      std::uint64_t list = j >> (bottom - k);
      j = (list + 1) << (bottom - k);
      for (; k > level && list % 2 == 1; list /= 2, --k)
        merge_halves(halving, k - 1, list / 2, statistics);
    }
  }

  /// Does all merges below one short list, level by level, except for parts that a disk next to the
  /// list touches.
  void merge_bottom(const Halving& halving, int level, std::uint64_t i, RoundDisks& known,
                    Statistics& statistics) {
    const int deepest = halving.deepest();
    if ((known.last || known.next) && level < deepest) {
      if (!is_fan(halving, level, i, known))
        merge_parts(halving, level, i, deepest, known, statistics);
      return;
    }
    for (int k = deepest - 1; k >= level; --k)
      for (std::uint64_t j = i << (k - level); j < (i + 1) << (k - level); ++j)
        merge_halves(halving, k, j, statistics);
  }

  bool is_fan(const Halving& halving, int level, std::uint64_t i, RoundDisks& known) {
    constexpr double slack = 0.0625;  // see merge.cpp
    if (halving.boundary(level, i + 1) - halving.boundary(level, i) < 2) return false;
    const auto is_fan_around = [&](std::optional<Disk>& disk) {
      return fan_of(diagram_, halving.boundary(level, i), halving.boundary(level, i + 1),
                    context_.limits.radius_limit, slack * context_.limits.tolerance, disk) != none;
    };
    if (is_fan_around(known.last)) return true;
    if (!known.next || !is_fan_around(known.next)) return false;
    known.last = known.next;
    return true;
  }

  void report(std::uint64_t work) {
    if (!context_.progress) return;
    const auto done = static_cast<double>(done_ += work);
    context_.progress(std::min(1.0, done / static_cast<double>(all_work_)));
  }
  bool is_stopped() const {
    return is_broken() ||
           (context_.cancel != nullptr && context_.cancel->load(std::memory_order_relaxed));
  }
  void add(const Statistics& own) {
    const std::scoped_lock lock(mutex_);
    statistics_ += own;
  }
  Diagram& diagram_;
  const ConquerContext& context_;
  Statistics& statistics_;
  std::mutex mutex_;
  std::uint64_t all_work_ = 0;
  std::atomic<std::uint64_t> done_ = 0;
  std::atomic<bool> broken_ = false;
  std::uint32_t last_edge_ = none;
};

}  // namespace

std::optional<std::vector<std::uint32_t>> conquer(Diagram& diagram, const ConquerContext& context,
                                                  Statistics& statistics,
                                                  std::vector<Level>* levels) {
  std::vector<std::uint32_t> last_edges;
  Conquest conquest(diagram, context, statistics);
  for (const Elements::ChainLoop& loop : diagram.elements.loops) {
    const Halving halving{loop.first_chain, loop.end_chain - loop.first_chain};
    std::optional<Disk> known;
    const std::uint32_t edge =
        fan_of(diagram, loop.first_chain, loop.end_chain, context.limits.radius_limit,
               0.5 * context.tie_tolerance, known);
    if (edge != none)
      last_edges.push_back(edge);
    else
      last_edges.push_back(levels != nullptr ? conquest.merge_measured(halving, *levels)
                                             : conquest.merge_all(halving));
    if (conquest.is_broken()) return std::nullopt;
  }
  return last_edges;
}

}  // namespace medial::lee
