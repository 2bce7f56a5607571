#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "methods/disks/boundary.h"
#include "methods/disks/connect.h"
#include "methods/edit/axis_graph.h"
#include "methods/edit/rings.h"

namespace medial::edit {

/// A border of the changed part of an axis: a node that stays, at the end of an edge that changes.
struct Border {
  std::uint32_t node = none;
  std::uint32_t right = none, left = none;  ///< sites of the edge, seen towards the node
};

/// The nodes and edges of an axis that an edit removes. All other disks stay maximal: they touch no
/// site that has changed, and no new site comes near them.
struct Affected {
  std::vector<std::uint32_t> nodes, edges;
  std::vector<Border> borders;
};

/// Finds the affected part: searches along the axis from the edges of changed sites. O(k) for k
/// edges.
class Spread {
 public:
  Spread(const AxisGraph& graph, std::vector<std::uint32_t>& marks, std::uint32_t mark)
      : graph_(graph), marks_(marks), mark_(mark) {}

  void add_site(std::uint32_t site);
  void add_node(std::uint32_t node);
  /// Adds a node and about `count` others around it.
  void add_around(std::uint32_t node, std::size_t count);
  /// Extends the search to leaves, and to all disks that come closer than `margin` to one of these
  /// sites.
  void spread(const std::vector<site::Site>& fresh, double margin);
  Affected result() const;
  std::size_t size() const { return nodes_.size(); }

 private:
  const AxisGraph& graph_;
  std::vector<std::uint32_t>& marks_;  ///< of nodes
  std::uint32_t mark_;
  std::vector<std::uint32_t> nodes_;
  std::size_t spread_ = 0;  ///< number of nodes visited
};

/// The part of the boundary whose sites the new part of the axis can touch, as one run. It is
/// bounded by the borders' disks, which are its first bridges, and contains the loops that no
/// border touches, which further bridges connect. It begins after border 0 and ends before it.
/// Without a border it is a whole component, and has only the loops of that component.
struct Window {
  std::vector<Border> borders;
  disks::Boundary boundary;
  std::vector<std::uint32_t> names;  ///< maps the boundary's `originals` to the sites in Rings
  std::vector<std::uint32_t> loops;
};
/// One window, or several if edges begin or cease to touch. `loops` are those that have changed;
/// `parts` is the change of the number of the axis' parts less cycles. Returns none if the whole
/// axis is affected, if rounding does not decide the order of the borders, or if connecting many
/// loops takes too long.
std::optional<std::vector<Window>> windows_of(const Rings& rings, const AxisGraph& graph,
                                              const Affected& affected,
                                              const std::vector<std::uint32_t>& loops, int parts,
                                              double radius_limit);

}  // namespace medial::edit
