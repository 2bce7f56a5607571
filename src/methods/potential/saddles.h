#pragma once

#include <span>
#include <vector>

#include "methods/potential/force_lines.h"

namespace medial::potential {

/// Connects a skeleton through the saddles of the potential.
class SaddleSearch {
 public:
  SaddleSearch(const Region& region, ValleyGraph& graph, ForceLines& lines);

  /// Whether the skeleton is connected, with one cycle for each hole.
  bool complete() const { return graph_.parts() <= 1 && graph_.cycles() >= region_.holes(); }

  /// Connects the parts that lines leave apart: searches along ways of the exact axis, given as the
  /// limit of high orders, for lines that diverge at a saddle.
  void connect(const Skeleton& axis);

  /// Adds lines to both sides of a point in a valley to the skeleton, if they connect two parts, or
  /// close a cycle that a hole requires.
  void pass(const ValleyPoint& point);

  /// Follows the valleys that leave each minimum without a known line, up to a saddle and down on
  /// its other side, and keeps them as pass() does ([ahuja1997], Section 4.1.3, Step 3).
  void traverse();

  /// Adds lines through the necks ahead of reflex corners to the skeleton, as pass() does: their
  /// valleys may lead down to other valleys, which are not minima.
  void pass_necks(const Charges& charges);

 private:
  /// Whether a line between two points of the skeleton would connect two parts, or close a cycle
  /// around some holes that is not a sum of known cycles. `cycle` receives the holes of such a
  /// cycle.
  bool is_new(std::uint32_t from, std::span<const Vec2> between, std::uint32_t to,
              std::vector<bool>& cycle);
  /// The holes around which such a cycle leads; none is set if it is not a new one.
  std::vector<bool> new_cycle(std::uint32_t from, std::span<const Vec2> between, std::uint32_t to);
  /// The same as is_new(). Requires that the line is kept if the result is true.
  bool wanted(std::uint32_t from, std::span<const ValleyPoint> between, std::uint32_t to);

  /// The line that the force leads along; its first point is the place.
  Trail line_from(Vec2 place);
  /// Whether lines from both ends of a way lead to places that are not connected, or around a hole.
  bool lead_apart(std::span<const Vec2> way, const Trail& first, const Trail& last);
  void part_lines(std::span<const Vec2> way, const Trail& first, const Trail& last);
  /// Connects the lines from two adjacent places at the point where they diverge.
  void join(Vec2 at_one, Trail one, Vec2 at_two, Trail two);
  /// Adds both lines from a point to the skeleton, if they are wanted.
  void keep(const ValleyPoint& point, const Trail& one, const Trail& two);

  const Region& region_;
  ValleyGraph& graph_;
  ForceLines& lines_;
  std::uint32_t traversed_ = 0;  ///< number of points of the skeleton that traverse() has visited
  std::vector<std::uint32_t> holes_;       ///< by the height of the point inside, ascending
  std::vector<std::vector<bool>> cycles_;  ///< the holes around them; in echelon form
};

}  // namespace medial::potential
