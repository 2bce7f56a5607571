#pragma once

#include <span>
#include <vector>

#include "methods/potential/force_lines.h"

namespace medial::potential {

/// Connects a skeleton through the saddles of the potential.
class SaddleSearch {
 public:
  SaddleSearch(const Region& region, ValleyGraph& graph, ForceLines& lines);

  /// Connected, with one cycle for each hole.
  bool complete() const { return graph_.parts() <= 1 && graph_.cycles() >= region_.holes(); }

  /// Connects what lines leave apart: along ways of the exact axis, given as the limit of high
  /// orders, lines are sought that part at a saddle.
  void connect(const Skeleton& axis);

  /// Makes lines to both sides of a point in a valley part of the skeleton, if they connect what
  /// was not, or close a cycle that a hole asks for.
  void pass(const ValleyPoint& point);

  /// Follows the valleys out of every minimum that no line is known in, up to a saddle and down on
  /// its other side, and keeps them as pass() does ([ahuja1997], Section 4.1.3, Step 3).
  void traverse();

  /// Makes lines through the necks that lie ahead of reflex corners part of the skeleton, as pass()
  /// does: their valleys may lead down to others that are no minima.
  void pass_necks(const Charges& charges);

 private:
  /// Whether a line between two points of the skeleton would connect what was not, or close a cycle
  /// around a hole, or some, that no others make up.
  /// `cycle`: in the latter case around which holes.
  bool is_new(std::uint32_t from, std::span<const Vec2> between, std::uint32_t to,
              std::vector<bool>& cycle);
  /// Around which holes such a cycle leads that others do not make up; none set: it is none.
  std::vector<bool> new_cycle(std::uint32_t from, std::span<const Vec2> between, std::uint32_t to);
  /// The same. Requires that the line is kept if so.
  bool wanted(std::uint32_t from, std::span<const ValleyPoint> between, std::uint32_t to);

  /// As the force leads; its first point is the place.
  Trail line_from(Vec2 place);
  /// Whether lines from both ends of a way lead to places that are not connected, or around a hole.
  bool lead_apart(std::span<const Vec2> way, const Trail& first, const Trail& last);
  void part_lines(std::span<const Vec2> way, const Trail& first, const Trail& last);
  /// Connects lines from two places side by side where they part.
  void join(Vec2 at_one, Trail one, Vec2 at_two, Trail two);
  /// Makes both lines from a point part of the skeleton, if they are wanted.
  void keep(const ValleyPoint& point, const Trail& one, const Trail& two);

  const Region& region_;
  ValleyGraph& graph_;
  ForceLines& lines_;
  std::uint32_t traversed_ = 0;            ///< points of the skeleton that traverse() has been at
  std::vector<std::uint32_t> holes_;       ///< by the height of the point inside, ascending
  std::vector<std::vector<bool>> cycles_;  ///< around which holes; in echelon form
};

}  // namespace medial::potential
