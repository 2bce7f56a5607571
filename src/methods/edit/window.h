#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "methods/disks/boundary.h"
#include "methods/disks/connect.h"
#include "methods/edit/axis_graph.h"
#include "methods/edit/rings.h"

namespace medial::edit {

/// Where what changes of an axis ends: a node that stays, at the end of an edge that changes.
struct Border {
  std::uint32_t node = none;
  std::uint32_t right = none, left = none;  ///< sites of the edge, on the way to the node
};

/// The nodes and edges of an axis that an edit takes away. All other disks stay maximal: they touch
/// no site that has changed, and no new one comes near them.
struct Affected {
  std::vector<std::uint32_t> nodes, edges;
  std::vector<Border> borders;
};

/// Finds what is affected: along the axis from the edges of sites that change. O(k) for k edges.
class Spread {
 public:
  Spread(const AxisGraph& graph, std::vector<std::uint32_t>& marks, std::uint32_t mark)
      : graph_(graph), marks_(marks), mark_(mark) {}

  void add_site(std::uint32_t site);
  void add_node(std::uint32_t node);
  /// Adds a node and others behind it, about so many.
  void add_around(std::uint32_t node, std::size_t count);
  /// Goes on to all disks that come as near as `margin` to one of these sites.
  void spread(const std::vector<site::Site>& fresh, double margin);
  Affected result() const;
  std::size_t size() const { return nodes_.size(); }

 private:
  const AxisGraph& graph_;
  std::vector<std::uint32_t>& marks_;  ///< of nodes
  std::uint32_t mark_;
  std::vector<std::uint32_t> nodes_;
  std::size_t spread_ = 0;  ///< number of them visited
};

/// The part of the boundary whose sites the disks of the new part of the axis can touch, as one
/// run: between the borders' disks, which are its first bridges, and around loops that no border
/// touches, which further bridges connect. It begins behind border 0 and ends before it. Without a
/// border it is a whole component, and holds its loops alone.
struct Window {
  std::vector<Border> borders;
  disks::Boundary boundary;
  std::vector<std::uint32_t> names;  ///< of the boundary's `originals`: the sites in Rings
  std::vector<std::uint32_t> loops;
};
/// One window, or where edges come to touch or part several. `loops`: those that have changed;
/// `parts`: so many more components the axis gets, less cycles. None where all of the axis is
/// affected, where rounding leaves the borders' order open, and where it takes long to connect many
/// loops.
std::optional<std::vector<Window>> windows_of(const Rings& rings, const AxisGraph& graph,
                                              const Affected& affected,
                                              const std::vector<std::uint32_t>& loops, int parts,
                                              double radius_limit);

}  // namespace medial::edit
