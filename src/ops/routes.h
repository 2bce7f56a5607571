#pragma once

// Searches on the graph of an axis, and parts of its edges.

#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <vector>

#include "axis/steps.h"
#include "base/numbers.h"
#include "medial/axis.h"
#include "medial/centreline.h"
#include "medial/measure.h"
#include "medial/query.h"

namespace medial::ops {

/// The cost of a part of an edge; never negative.
double cost_of(const MedialAxis& axis, const PathPiece& piece, Route route);

/// A start of a search: a node with its initial cost.
struct Start {
  std::uint32_t node = 0;
  double cost = 0;
};

/// How the cost of a path follows from the cost up to an edge and the cost of that edge.
enum class Adding : std::uint8_t { sum, most };

/// Shortest paths from a set of starts (Dijkstra's algorithm with a heap), along edges of finite
/// cost. Reuse the object: then a search takes time only for the nodes that it visits.
class Search {
 public:
  Search(const MedialAxis& axis, const Incidence& incidence, std::span<const double> costs,
         Adding adding = Adding::sum)
      : axis_(axis),
        incidence_(incidence),
        edge_costs_(costs),
        adding_(adding),
        cost_(axis.nodes.size(), std::numeric_limits<double>::infinity()),
        via_(axis.nodes.size(), none) {}

  void run(std::span<const Start> starts);
  /// Infinite if there is no path.
  double cost(std::uint32_t node) const { return cost_[node]; }
  /// All nodes reached, by increasing cost.
  std::span<const std::uint32_t> reached() const { return reached_; }
  /// The path from a start to a node.
  std::vector<Step> way_to(std::uint32_t node) const;

 private:
  const MedialAxis& axis_;
  const Incidence& incidence_;
  std::span<const double> edge_costs_;
  Adding adding_;
  std::vector<double> cost_;
  std::vector<std::uint32_t> via_;
  std::vector<std::uint32_t> reached_;
  std::priority_queue<std::pair<double, std::uint32_t>,
                      std::vector<std::pair<double, std::uint32_t>>, std::greater<>>
      heap_;
};

/// Makes parts of an axis, without its sites. Reuse the object: then a part takes time in
/// proportion to its size.
class PartMaker {
 public:
  explicit PartMaker(const MedialAxis& axis) : axis_(axis), node_of_(axis.nodes.size(), none) {}
  /// Like part_of(), without sites. O(pieces log(pieces)).
  MedialAxis part(std::span<const PathPiece> pieces);

 private:
  const MedialAxis& axis_;
  std::vector<std::uint32_t> node_of_;  ///< in the part, of each node of the axis
};

/// Whole edges as a path, with its length and narrowest radius.
AxisPath path_of(const MedialAxis& axis, std::span<const Step> steps);
/// Sets the length and the narrowest radius from the pieces.
void measure(const MedialAxis& axis, AxisPath& path);

/// The place of the smallest or largest radius on an edge; the middle if it is constant. O(1).
EdgePlace narrowest_place(const MedialAxis& axis, std::uint32_t edge);
EdgePlace widest_place(const MedialAxis& axis, std::uint32_t edge);

/// The smallest radius on a part of an edge.
double narrowest_radius(const MedialAxis& axis, const PathPiece& piece);

/// The parts of an edge with a radius of at least `clearance`, in order: at most two, none of them
/// a single point.
std::vector<PathPiece> wide_pieces(const MedialAxis& axis, std::uint32_t edge, double clearance);

/// The width at a place, with the feet as seen along the edge or against it.
LocalWidth width_at(const MedialAxis& axis, EdgePlace place, bool forward = true);

}  // namespace medial::ops
