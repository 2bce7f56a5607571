#include "methods/disks/decide.h"

#include <cmath>

namespace medial::disks {

void Decider::propose(Step& step, const Disk& from) {
  step.is_proposed = true;
  if (is_exact) return;
  const Span& span = step.span;
  const RunAhead::Found* const found = ahead_.find(span, from);
  if (found != nullptr && found->is_certain) {
    step.event = found->event;
    step.error = found->error;
    take(step);
    return;
  }
  const std::uint64_t queries = chunk_.statistics.queries;
  EventSearch search(contacts_, span, from);
  step.event = found != nullptr ? search.next(found->event) : search.next();
  ahead_.note(chunk_.statistics.queries - queries <= 1);
  if (step.event.kind == Event::Kind::none) return;
  const Certainty certainty(boundary_, context_.tolerance, span, from, step.event);
  step.error = certainty.error();
  if (is_taken(step, from, certainty)) take(step);
  step.joins_node = step.is_certain && certainty.is_tie();
}

/// Whether a step's event is taken as double has it.
bool Decider::is_taken(const Step& step, const Disk& from, const Certainty& certainty) {
  if (certainty.is_tie() && !context_.joins_ties) return false;
  if (boundary_.has_arcs) return certainty.is_certain();
  if (const auto settled = is_settled(contacts_, from, step.event, certainty)) return *settled;
  const std::uint32_t fourth = step.event.touched(step.span);
  if (!certainty.is_tie()) return !contacts_.may_touch_more(step.span, from, fourth);
  return contacts_.passes_at(step.span, from, fourth) ||
         contacts_.is_clean_tie(step.span, from, fourth);
}

void Decider::take(Step& step) {
  step.is_certain = true;
  if (keeps_ties) step.is_node = false;
  ++chunk_.statistics.exact_filtered;
}

bool Decider::decide(Step& step, const Disk& from) {
  Event& event = step.event;
  if (contacts_.is_polygon() && context_.joins_ties && !is_exact &&
      event.kind != Event::Kind::at_node && event.site < step.span.left) {
    // Contacts that are near to each other leave open where they meet.
    const auto disk = contacts_.clean_tie(step.span, event.disk, event.site);
    if (disk && distance(disk->center, from.center) > spread * context_.tolerance) {
      event.disk = *disk;
      return step.is_tie = true;
    }
  }
  return decide_exactly(step, from);
}

/// Whether both feet pass a joint at once that is smooth up to rounding, so that by 256 bits either
/// seems to pass first.
bool Decider::both_pass(const Span& span, const Event& event) const {
  const std::uint32_t touched = event.touched(span);
  return boundary_.has_arcs && event.kind != Event::Kind::none &&
         (touched == span.right + 1 || touched + 1 == span.left) &&
         contacts_.passes_at(span, event.disk, span.right + 1) &&
         contacts_.passes_at(span, event.disk, span.left - 1);
}

/// By 256 bits. What these do not find is noted, and double's event taken, if there is one.
bool Decider::decide_exactly(Step& step, const Disk& from) {
  using Kind = Event::Kind;
  Event& event = step.event;
  Span& span = step.span;
  Span asked = span;
  // Where nothing but pieces of one arc is left, the foot passes on over them.
  if (joins_pieces(asked) && asked.left - asked.right == 1 && stays_on_arc(span, event))
    return false;
  const bool from_exact = is_exact || (span.is_exact && !boundary_.has_arcs);
  const auto found = next_exactly(context_, asked, from, event.touched(span), from_exact);
  count(found);
  // What 256 bits leave open is measured in the end.
  if (!found || !(found->error <= context_.tolerance)) {
    if (both_pass(span, event)) return false;
    lose(span, found ? found->site : event.touched(span));
  }
  if (!found) {
    if (is_exact) event = EventSearch(contacts_, span, from).next();
    return is_exact;
  }
  Span ahead = span;
  stay_on_pieces(asked, found->disk.center, ahead);
  const bool passes = ahead.right != span.right || ahead.left != span.left;
  if (passes && !is_exact && stays_on_arc(span, event)) return false;
  if (boundary_.has_arcs && is_wrong(span, found->disk)) lose(span, span.third);
  span = ahead;
  step.joins_node = false;
  if (keeps_ties) step.is_node = found->is_node;
  step.error = Certainty::rounding + found->error;
  event.disk = found->disk;
  event.site = piece_below(event.disk.center, found->site, span);
  event.kind = span.continues_right(boundary_, event.site)  ? Kind::pass_right
               : span.continues_left(boundary_, event.site) ? Kind::pass_left
                                                            : Kind::contact;
  return true;
}

std::optional<ExactEvent> Decider::start(const Span& whole, const Disk& about, std::uint32_t hint) {
  auto found = start_exactly(context_, whole, about, hint);
  count(found);
  if (found)
    found->site = piece_below(found->disk.center, found->site, whole);
  else
    lose(whole, hint);
  return found;
}

void Decider::lose(const Span& span, std::uint32_t third) {
  ++chunk_.statistics.exact_changes;
  for (const std::uint32_t i : {span.right, span.left, span.third, third})
    if (i < boundary_.sites.size() && element(i) != Element::bridge) chunk_.lost.push_back(i);
}

/// Whether an exact disk shows that a step before was wrong, beside arcs. If it reaches over the
/// site that the span has left, by more than what counts as touched, the exact axis has no edge in
/// the span: ties that double takes for certain may lead there. If it reaches over one of the
/// span's own sites, by more than joints are smooth, it is the circle of an arc that joins it, and
/// not empty.
bool Decider::is_wrong(const Span& span, const Disk& disk) const {
  return reaches_over(span.third, disk, context_.tolerance) ||
         reaches_over(span.right, disk, context_.joints) ||
         reaches_over(span.left, disk, context_.joints);
}
bool Decider::reaches_over(std::uint32_t i, const Disk& disk, double slack) const {
  if (i >= boundary_.sites.size() || element(i) == Element::bridge) return false;
  const double reach = disk.radius - slack;
  return reach > 0 && site::squared_distance(site(i), disk.center) < reach * reach;
}

bool Decider::joins_pieces(Span& span) const {
  const Span before = span;
  while (span.left - span.right > 1 && boundary_.is_same(span.right, span.right + 1)) ++span.right;
  while (span.left - span.right > 1 && boundary_.is_same(span.left - 1, span.left)) --span.left;
  return span.right != before.right || span.left != before.left;
}

/// Whether the foot lies beyond one end of a piece of an arc. Half a circle on the parameter is
/// infinite, of either sign: what is more than a quarter turn behind a piece is ahead of it.
bool Decider::is_beyond(std::uint32_t i, bool at_end, Vec2 center) const {
  const double s = site::carrier_parameter(site(i), center), length = site(i).length;
  const double turn = std::max(length, 2 / std::abs(site(i).curvature));
  return at_end ? s >= length || s < -turn : s <= 0 || s > length + turn;
}

/// Of the sites of two spans that differ by pieces of one arc, those on which the foot lies.
void Decider::stay_on_pieces(const Span& last, Vec2 center, Span& span) const {
  while (span.right < last.right && is_beyond(span.right, true, center)) ++span.right;
  while (span.left > last.left && is_beyond(span.left, false, center)) --span.left;
}

/// Of the pieces of one arc inside a span, the one on which the foot lies.
std::uint32_t Decider::piece_below(Vec2 center, std::uint32_t i, const Span& span) const {
  while (i - 1 > span.right && boundary_.is_same(i - 1, i) && is_beyond(i, false, center)) --i;
  while (i + 1 < span.left && boundary_.is_same(i, i + 1) && is_beyond(i, true, center)) ++i;
  return i;
}

/// Whether the event is that a foot passes on to the next piece of the same arc.
bool Decider::stays_on_arc(const Span& span, const Event& event) const {
  using Kind = Event::Kind;
  if (event.kind != Kind::pass_right && event.kind != Kind::pass_left) return false;
  const std::uint32_t i = event.kind == Kind::pass_right ? span.right : span.left - 1;
  return boundary_.is_same(i, i + 1);
}

}  // namespace medial::disks
