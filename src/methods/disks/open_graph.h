#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "medial/compute.h"
#include "methods/disks/collect.h"
#include "methods/disks/exact_sites.h"
#include "site/boundary_tree.h"

namespace medial::disks {

/// What a deferred walk has found and not yet handed out (docs/parts.md).
///
/// A node is open while a task that begins there waits, or while the other side of its bridge has
/// not been reached: it may get more edges. It stays, its neighbours stay, and so does what may be
/// contracted with them, and what lies next to that. All others are final.
class OpenGraph {
 public:
  struct Task {
    std::unique_ptr<Chunk> chunk;
    std::uint32_t node;  ///< at which it begins
  };

  OpenGraph(const Problem& problem, const SiteNumbers& numbers, const site::BoundaryTree& tree,
            const ExactSites& exact);

  /// Adds the tasks at which the walk begins.
  void begin(std::vector<std::unique_ptr<Chunk>> roots);
  /// The last tasks, as many as will find about this many nodes together.
  std::vector<Task> take(std::size_t nodes);
  bool has_tasks() const { return !tasks_.empty(); }
  /// Adds what a task found, and the tasks that it has deferred.
  void add(Task task);
  /// Whether enough is new to look for what is final.
  bool is_full(std::size_t nodes) const;

  /// Hands out what is final; at the end, all that is left.
  AxisPart next_part();

  /// Whether the parts so far have one cycle for each hole of each component: connected they are,
  /// since each chunk is a tree that begins at a node.
  bool has_right_cycles() const;
  bool is_lost() const { return lost_; }  ///< the walk has found that a step was wrong
  const Statistics& statistics() const { return statistics_; }

 private:
  /// One of the two ends that meet at a bridge.
  struct End {
    std::uint32_t node = ~std::uint32_t{0}, link = ~std::uint32_t{0};
  };
  /// A part under way: the open graph's nodes in it.
  struct Cut {
    Graph graph;
    std::vector<std::uint32_t> place;     ///< of each open node in the part
    std::vector<std::uint32_t> rim;       ///< the open nodes that come first in the part
    std::size_t known = 0;                ///< number of them in earlier parts
    std::vector<std::uint32_t> stays;     ///< links that do
    std::vector<std::uint8_t> more_ends;  ///< of each of `rim`: how many ends of these
    bool has_ties = false;
  };

  template <class Use>
  void for_each_begun(const Use& use);
  std::uint32_t target(std::uint32_t node);
  void meet(std::uint32_t bridge, End end);
  void resolve();
  std::vector<std::uint8_t> held_nodes(const std::vector<std::uint32_t>& ties) const;
  void hold_ties(const std::vector<std::uint32_t>& ties, std::vector<std::uint8_t>& held) const;
  Cut cut();
  void complete_part(Cut& cut, AxisPart& part);
  bool keeps_rim(const Cut& cut) const;
  void name_nodes(const Cut& cut, AxisPart& part);
  void name_sites(AxisPart& part);
  void keep(const Cut& cut);

  const Problem& problem_;
  const SiteNumbers& numbers_;
  const Boundary& boundary_;
  const site::BoundaryTree& tree_;
  const ExactSites& exact_;
  double slack_;
  Graph graph_;
  std::vector<std::uint32_t> number_;  ///< of each node: in the whole axis, once it is final
  std::vector<std::int32_t> waiting_;  ///< of each node: tasks and bridges that wait for it
  std::vector<std::uint32_t> moved_;   ///< of each node: the one that it has become at a bridge
  std::vector<Task> tasks_;
  std::vector<End> ends_;                  ///< of each bridge, the end that was reached first
  std::vector<std::uint32_t> half_met_;    ///< bridges
  std::vector<std::uint32_t> gone_links_;  ///< since resolve()
  std::size_t last_held_ = 0;              ///< nodes that the last part has left, and tasks at them
  std::uint32_t given_ = 0;                ///< nodes
  bool glued_ = false, lost_ = false, begins_ = true;
  std::vector<std::int64_t> balance_;  ///< of each component: nodes less edges so far
  Statistics statistics_;
};

}  // namespace medial::disks
