#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "methods/disks/certainty.h"
#include "methods/disks/contacts.h"
#include "methods/disks/events.h"

namespace medial::disks {

/// The spans into which an event divides its own: one where a foot passes on, two at a contact,
/// none where nothing is left to touch, as on a shape that crosses itself. Not at a node. Returns
/// how many; `second` is set only if there are two.
std::size_t divide(const Span& span, const Event& event, double error, bool is_exact, Span& first,
                   Span& second);

/// Whether an event of a polygon is certain and nothing within the tolerance may come before it;
/// none where only a search decides.
std::optional<bool> is_settled(const Contacts& contacts, const Disk& from, const Event& event,
                               const Certainty& certainty);

/// Events of a polygon's walk that follow each other, found ahead by the sites next to the feet
/// alone. Whether their disks are empty is asked once for all: what lies ahead of the last one and
/// is not in that is in none before it, where no holes are connected.
///
/// Proof. Let D come before the last disk L, and s be what is nearest to D's centre of all that
/// lies ahead of L, inside D. The way to s crosses a spoke of L, as the two divide the shape, and
/// leaves L between its feet, ahead. D holds neither foot of L, so what it holds of L's circle is
/// one piece between them: that one, ahead. Then D's own spokes lead out of L there; but its feet
/// are behind.
///
/// The same is true of the shape and its disks grown by some tolerances: what D may touch ahead of
/// L, L may touch. So of short ways, on which a disk may reach over a site all along by less than
/// double sees, two things are asked: what the last disk may touch, twice as far, and whether a
/// disk may touch what its feet pass after it.
///
/// What is taken for certain does not depend on this: a walk that gets around is right
/// (docs/exact.md).
class RunAhead {
 public:
  explicit RunAhead(Contacts& contacts);

  struct Found {
    Span span;
    Disk from;
    Event event;  ///< if it is not certain, what the neighbours tell
    bool is_certain = false;
    double error = 0;
    Disk asked{};  ///< the disk that has to be empty

    std::uint32_t fourth() const { return event.touched(span); }
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
  void run(const Span& begin, const Disk& start, std::size_t most);
  /// Whether the disks of the first `count` are empty.
  bool are_empty(std::size_t count) const;

  Contacts& contacts_;
  const bool is_possible_;
  std::vector<Found> found_;
  std::size_t next_ = 0;
  std::size_t streak_ = 0;  ///< of events that neighbours decide
};

}  // namespace medial::disks
