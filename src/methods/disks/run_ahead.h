#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "methods/disks/certainty.h"
#include "methods/disks/contacts.h"
#include "methods/disks/events.h"

namespace medial::disks {

/// The spans into which an event divides its own: one where a foot passes on, two at a contact,
/// none where nothing is left to touch, as on a shape that crosses itself. Not at a node.
struct Division {
  Division(const Span& span, const Event& event, double error, bool moves);

  std::array<Span, 2> part;
  std::size_t count = 0;
};

/// Events of a polygon's walk that follow each other, found ahead by the sites next to the feet
/// alone. Whether their disks are empty is asked once for all: of disks along the axis, what lies
/// ahead of the last one and is not in that is in none before it (docs/disks.md, step 4).
class RunAhead {
 public:
  RunAhead(const WalkContext& context, Contacts& contacts, Statistics& statistics);

  struct Found {
    Span span;
    Disk from;
    Event event;  ///< if it is not certain, what the neighbours tell
    bool is_certain = false;
    double error = 0;
    Disk asked{};  ///< the disk that has to be empty
  };

  /// What ends the edge that leads from a disk into a span, if it was found ahead; until the next
  /// call.
  const Found* find(const Span& span, const Disk& from) {
    return next_ == found_.size() && streak_ < 2 * patience ? nullptr : find_or_run(span, from);
  }
  /// Notes whether an event that was not found ahead is the one that its neighbours tell.
  void note(bool by_neighbors) { streak_ = by_neighbors && is_possible_ ? streak_ + 1 : 0; }

 private:
  /// So many events in turn that neighbours decide let one more be found ahead: where the axis
  /// branches often, most of what is found ahead is in vain.
  static constexpr std::size_t patience = 8;

  const Found* find_or_run(const Span& span, const Disk& from);
  /// Events in turn that could be the next ones.
  void run(const Span& span, const Disk& from, std::size_t most);
  /// Whether the disks of the first `count` are empty.
  bool are_empty(std::size_t count) const;

  const WalkContext& context_;
  Contacts& contacts_;
  Statistics& statistics_;
  const bool is_possible_;
  std::vector<Found> found_;
  std::size_t next_ = 0;
  std::size_t streak_ = 0;  ///< of events that neighbours decide
};

}  // namespace medial::disks
