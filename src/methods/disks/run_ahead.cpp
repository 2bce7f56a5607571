#include "methods/disks/run_ahead.h"

#include <algorithm>

namespace medial::disks {
namespace {

/// The sites that a run passes are tested with each of its disks: so they stay few.
constexpr std::size_t longest_run = 16;

}  // namespace

std::size_t divide(const Span& span, const Event& event, double error, bool is_exact, Span& first,
                   Span& second) {
  using Kind = Event::Kind;
  if (event.kind == Kind::pass_right || event.kind == Kind::pass_left) {
    first = {span.right, span.left, span.node, 0, error, is_exact};
    first.third = event.kind == Kind::pass_right ? first.right++ : first.left--;
    return 1;
  }
  if (event.kind == Kind::none || event.site <= span.right || event.site >= span.left) return 0;
  first = {event.site, span.left, span.node, span.right, error, is_exact};
  second = {span.right, event.site, span.node, span.left, error, is_exact};
  return 2;
}

std::optional<bool> is_settled(const Contacts& contacts, const Disk& from, const Event& event,
                               const Certainty& certainty) {
  if (!certainty.is_certain() || (event.kind == Event::Kind::contact &&
                                  contacts.is_past_vertex(event.site, event.disk.center)))
    return false;
  if (certainty.is_tie() || contacts.is_short_way(from, event.disk)) return std::nullopt;
  return true;
}

RunAhead::RunAhead(Contacts& contacts)
    : contacts_(contacts),
      is_possible_(contacts.is_polygon() && contacts.context.boundary.bridges.empty() &&
                   contacts.context.boundary.sides == Sides::one) {}

const RunAhead::Found* RunAhead::find_or_run(const Span& span, const Disk& from) {
  const auto is_next = [&] {
    if (next_ == found_.size()) return false;
    const Found& next = found_[next_];
    return next.span.right == span.right && next.span.left == span.left &&
           next.span.third == span.third && next.from.center == from.center &&
           next.from.radius == from.radius;
  };
  if (is_next()) return &found_[next_++];
  found_.clear();
  next_ = 0;
  const std::size_t most = std::min(streak_ / patience, longest_run);
  if (most < 2) return nullptr;
  run(span, from, most);
  const bool has_open = !found_.back().is_certain;
  const std::size_t certain = found_.size() - (has_open ? 1 : 0);
  std::size_t count = certain;
  while (count > 0 && !are_empty(count)) count /= 2;
  streak_ = count == certain && count > 1 ? streak_ + count : 0;
  if (count < certain) found_.resize(count);
  return is_next() ? &found_[next_++] : nullptr;
}

void RunAhead::run(const Span& begin, const Disk& start, std::size_t most) {
  Span span = begin;
  Disk from = start;
  while (found_.size() < most) {
    EventSearch search(contacts_, span, from);
    Found& found = found_.emplace_back(Found{span, from, search.by_neighbors()});
    const auto event = search.plain(found.event);
    if (!event) return;
    const Certainty certainty(contacts_.context.boundary, contacts_.context.tolerance, span, from,
                              *event);
    // Of short ways, are_empty() asks for all.
    if (certainty.is_tie() || is_settled(contacts_, from, *event, certainty) == false) return;
    found = {span, from, *event, true, certainty.error(), search.asked_disk(*event)};
    Span first, second;
    const std::size_t count = divide(span, *event, certainty.error(), true, first, second);
    const bool first_open = count > 0 && contacts_.needs_walk(first),
               second_open = count > 1 && contacts_.needs_walk(second);
    if (first_open == second_open) return;
    span = first_open ? first : second;
    from = event->disk;
  }
}

bool RunAhead::are_empty(std::size_t count) const {
  const Found& last = found_[count - 1];
  if (contacts_.nearest(last.asked, last.span)) return false;
  const auto is_short = [&](const Found& found) {
    return contacts_.is_short_way(found.from, found.event.disk);
  };
  if (std::any_of(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(count), is_short) &&
      contacts_.may_touch_more(last.span, last.event.disk, last.fourth(), 2))
    return false;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const Span& span = found_[i].span;
    const Disk& disk = found_[i].asked;
    const auto reaches_over = [&](std::uint32_t first, std::uint32_t end) {
      return first < end &&
             contacts_.context.tree.nearest(disk.center, disk.radius - contacts_.context.tolerance,
                                            first, end - 1);
    };
    if (reaches_over(span.right + 1, last.span.right + 1) ||
        reaches_over(last.span.left, span.left))
      return false;
    if (!is_short(found_[i])) continue;
    const auto may_touch = [&](std::uint32_t site) {
      return site != found_[i].fourth() && contacts_.may_touch(site, span, found_[i].from);
    };
    if (may_touch(last.fourth())) return false;
    for (std::uint32_t site = span.right + 1; site <= last.span.right; ++site)
      if (may_touch(site)) return false;
    for (std::uint32_t site = last.span.left; site < span.left; ++site)
      if (may_touch(site)) return false;
  }
  return true;
}

}  // namespace medial::disks
