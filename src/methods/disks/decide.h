#pragma once

#include <optional>

#include "methods/disks/exact_event.h"
#include "methods/disks/run_ahead.h"
#include "methods/disks/steps.h"
#include "methods/disks/walk.h"

namespace medial::disks {

/// Decides what ends the edges of a task's steps: in double where that is certain, else with more
/// digits (docs/exact.md, How `disks` decides). Notes in the task's chunk where the shape as its
/// doubles say does not continue: what led to a span was wrong, or arcs join so that rounding alone
/// decides.
class Decider {
 public:
  Decider(Contacts& contacts, Chunk& chunk)
      : is_exact(contacts.context.is_in_precise(chunk.component)),
        keeps_ties(contacts.is_polygon() && !contacts.context.joins_ties),
        context_(contacts.context),
        boundary_(context_.boundary),
        contacts_(contacts),
        chunk_(chunk),
        ahead_(contacts) {}

  const bool is_exact;    ///< double is never asked
  const bool keeps_ties;  ///< nodes of a polygon are one only if their disks are

  /// In tolerances: the disks of a tie are as far off as rounding leaves each three of its contacts
  /// open.
  static constexpr double spread = 16;

  /// What ends the edge of a step's span, in double, and whether that is certain.
  void propose(Step& step, const Disk& from);
  /// The same where that is not certain: a tie, or what 256 bits tell. Whether anything has
  /// changed.
  bool decide(Step& step, const Disk& from);
  /// Whether what a step's disk may have missed is searched for before it is taken.
  bool looks_ahead(const Step& step) const {
    return !is_exact && !(boundary_.has_arcs && step.joins_node);
  }
  /// The disk that grows where a run begins, in 256 bits; `about` and `hint` are what double takes
  /// for it.
  std::optional<ExactEvent> start(const Span& whole, const Disk& about, std::uint32_t hint);
  /// Passes on to the last piece of an arc that the boundary has in several, which are one site of
  /// the shape. Whether there were any.
  bool joins_pieces(Span& span) const;
  void lose(const Span& span, std::uint32_t third);

 private:
  const site::Site& site(std::uint32_t i) const { return boundary_.sites[i]; }
  Element element(std::uint32_t i) const { return boundary_.elements[i]; }
  bool is_taken(const Step& step, const Disk& from, const Certainty& certainty);
  void take(Step& step);
  bool both_pass(const Span& span, const Event& event) const;
  bool decide_exactly(Step& step, const Disk& from);
  void count(const std::optional<ExactEvent>& found) {
    ++(found && !found->in_precise ? chunk_.statistics.exact_twofold
                                   : chunk_.statistics.exact_precise);
  }
  bool is_wrong(const Span& span, const Disk& disk) const;
  bool reaches_over(std::uint32_t i, const Disk& disk, double slack) const;
  bool is_beyond(std::uint32_t i, bool at_end, Vec2 center) const;
  void stay_on_pieces(const Span& last, Vec2 center, Span& span) const;
  std::uint32_t piece_below(Vec2 center, std::uint32_t i, const Span& span) const;
  bool stays_on_arc(const Span& span, const Event& event) const;

  const WalkContext& context_;
  const Boundary& boundary_;
  Contacts& contacts_;
  Chunk& chunk_;
  RunAhead ahead_;
};

}  // namespace medial::disks
