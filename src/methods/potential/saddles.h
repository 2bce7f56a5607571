#pragma once

#include <span>
#include <vector>

#include "methods/potential/force_lines.h"

namespace medial::potential {

/// Connects a skeleton through the saddles of the potential.
class SaddleSearch {
 public:
  SaddleSearch(const Region& region, ValleyGraph& graph, ForceLines& lines)
      : region_(region), graph_(graph), lines_(lines) {}

  /// Connected, with one cycle for each hole.
  bool complete() const { return graph_.parts() <= 1 && graph_.cycles() >= region_.holes(); }

  /// Looks for saddles where neighbouring places of the border belong to different minima.
  /// `corner_labels`: to what the corners of the region belong.
  void connect(const std::vector<Label>& corner_labels);

  /// Makes lines to both sides of a point in a valley part of the skeleton, if they connect what
  /// was not, or close a cycle that a hole asks for.
  void pass(const ValleyPoint& point, ForceLines::Start start);

  /// Follows the valleys out of every minimum that no line is known in, up to a saddle and down on
  /// its other side, and keeps them as pass() does ([ahuja1997], Section 4.1.3, Step 3).
  void traverse();

  /// Makes lines through the necks that lie ahead of reflex corners part of the skeleton, as pass()
  /// does: their valleys may lead down to others that are no minima.
  void pass_necks(const Charges& charges);

  /// A line from the border: what it belongs to.
  Label probe(std::uint32_t piece, double share, Trail& trail);

 private:
  /// Whether a line between two points of the skeleton connects what was not, or closes a cycle
  /// around a hole, or some, that no others make up. Requires that it is kept if so.
  bool wanted(std::uint32_t from, std::span<const ValleyPoint> between, std::uint32_t to);
  /// A saddle, and to what its two lines lead.
  struct Pass {
    Vec2 place;
    Label one, two;
  };
  /// A place on a loop: piece + share of its length.
  struct Sample {
    double place = 0;
    Label label;
  };

  /// The saddle at this place, known or new.
  const Pass& pass_at(const ValleyPoint& saddle);
  void part_lines(const Region::PieceLoop& loop, const Sample& first, const Sample& second,
                  bool sides, int depth);
  Label probe_at(const Region::PieceLoop& loop, double place, Trail& trail);
  std::vector<Sample> samples_of(std::size_t loop, int round,
                                 const std::vector<Label>& corner_labels);

  const Region& region_;
  ValleyGraph& graph_;
  ForceLines& lines_;
  std::uint32_t traversed_ = 0;  ///< points of the skeleton that traverse() has been at
  std::vector<Pass> saddles_;
  std::vector<std::vector<bool>> cycles_;  ///< around which holes; in echelon form
};

}  // namespace medial::potential
