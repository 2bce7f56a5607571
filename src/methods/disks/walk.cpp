#include "methods/disks/walk.h"

#include <array>
#include <optional>

#include "base/threads.h"
#include "methods/disks/certainty.h"
#include "methods/disks/early_starts.h"
#include "methods/disks/events.h"
#include "methods/disks/exact_event.h"
#include "methods/disks/planar_contacts.h"
#include "methods/disks/run_ahead.h"
#include "methods/disks/steps.h"
#include "site/tangent_disk.h"

namespace medial::disks {
namespace {

using site::Site;
using Hit = Contacts::Hit;

/// Spans of at least so many sites become tasks of their own, if another such span is at hand:
/// small enough for the threads to share the work evenly, large enough for the lists of a task.
std::uint32_t fork_size_of(const Boundary& boundary) {
  return std::clamp(static_cast<std::uint32_t>(boundary.sites.size() / 64), 1024u, 8192u);
}

/// A task finds about so many nodes and edges, or more.
constexpr std::size_t in_task = 4096;

/// How a walk is divided into tasks.
struct Sharing {
  TaskGroup& tasks;
  std::uint32_t fork_size;
  const std::vector<EarlyStart>* starts = nullptr;  ///< if any
};

class Walker {
 public:
  Walker(const WalkContext& context, const Sharing& sharing, Chunk& chunk)
      : context_(context),
        sharing_(sharing),
        boundary_(context.boundary),
        chunk_(chunk),
        own_contacts_(contacts_with(context, chunk.statistics)),
        contacts_(*own_contacts_),
        ahead_(context, contacts_, chunk.statistics),
        is_exact_(context.exact.always(chunk.component)),
        keeps_ties_(contacts_.is_polygon() && !context.joins_ties) {}

  /// Walks all of a run: from the convex corner between its last and first site, or from a disk
  /// that touches the boundary where the two join smoothly.
  void walk_run(const Boundary::SiteRange& run) {
    chunk_.nodes.push_back({site(run.first).point, 0});  // stands for no parent
    if (run.at_corner && boundary_.joint(run.last) == site::Joint::blunt) {
      starts_blunt_ = true;
      stack_.push_back({{run.first, run.last, 0}});
    } else if (run.at_corner) {
      const std::uint32_t corner = add_node({site(run.first).point, 0});
      stack_.push_back({{run.first, run.last, corner}});
    } else {
      start_at_smooth_place(run);
    }
    walk_stack();
    if (starts_blunt_ && chunk_.nodes.size() == 1) add_node(disk_between(run));
  }

  /// Walks all of a run from a disk that touches its ends.
  void walk_from(const Boundary::SiteRange& run, const Disk& start, double error) {
    chunk_.nodes.push_back({start.center, 0});  // stands for no parent
    const std::uint32_t node = add_node(start);
    walk_step({{run.first, run.last, node, Hit::none, error}});
  }

  /// Walks one step and all that branches off it.
  void walk_step(const Step& step) {
    stack_.push_back(step);
    walk_stack();
  }

  /// Walks what an early start begins.
  void walk_early(const EarlyStart& start) {
    own_start_ = &start;
    chunk_.nodes.push_back(start.disk);  // stands for the parent, which lies on the same edge
    walk_step({{start.right, start.left, 0, Hit::none, start.error}});
  }

 private:
  void walk_stack() {
    while (!stack_.empty()) {
      if (is_set(context_.cancel)) break;
      follow(stack_.pop_back());
      if (is_full()) put_off_rest();
    }
    report_progress(true);
  }

  bool is_full() const {
    return context_.most_nodes > 0 && chunk_.nodes.size() > context_.most_nodes;
  }
  void put_off_rest() {
    stack_.for_each([&](const Step& step) { fork(step); });
    stack_.clear();
  }

  const Site& site(std::uint32_t i) const { return boundary_.sites[i]; }
  Element element(std::uint32_t i) const { return boundary_.elements[i]; }

  /// The steps into which one divides; more than two are in `many_`.
  struct Parts {
    std::array<Step, 2> step;
    std::size_t count = 0;
  };

  /// Follows the bisectors from one node until the axis ends, and of two branches one. Steps stay
  /// where they are made: to copy what was just written takes long.
  void follow(const Step& first) {
    if (!is_open(first.span, first.is_proposed)) return;
    std::array<Parts, 2> made;
    Step* step = &made[0].step[0];
    *step = first;
    Disk from = chunk_.nodes[first.span.node];
    for (Parts* parts = &made[1];; parts = parts == &made[0] ? &made[1] : &made[0]) {
      if (leave_to_early_walk(step->span)) return;
      if (is_exact_ && joins_pieces(step->span) && !is_open(step->span)) return;
      if (!step->is_proposed) propose(*step, from);
      const bool in_double = step->is_certain;
      if (!in_double) decide(*step, from);
      find_parts(*step, from, *parts);
      // What double leaves open next to its disk may have come before it; but not beside arcs where
      // the disk and the node are one tie.
      if (in_double && looks_ahead(*step) && !are_certain(*parts) && decide(*step, from))
        find_parts(*step, from, *parts);
      step = next_after(*step, from, *parts);
      if (step == nullptr || !is_open(step->span, step->is_proposed)) return;
      if (is_full()) return stack_.push_back(*step);
    }
  }

  /// Ends a step's edge in its node. Returns the part to be followed from there, if any, and queues
  /// the others.
  Step* next_after(const Step& step, Disk& from, Parts& parts) {
    if (parts.count == 0 && many_.empty()) return nullptr;
    const bool stays = step.event.kind == Event::Kind::at_node;
    const std::uint32_t node = stays ? step.span.node : arrive(step, from);
    if (node != step.span.node) from = step.event.disk;
    if (!many_.empty()) {
      many_.set_node(node);
      stack_.append(many_);
    }
    auto& [first, second] = parts.step;
    first.span.node = second.span.node = node;
    if (parts.count < 2) return parts.count == 0 ? nullptr : &first;
    if (stays) {
      stack_.push_back(first);
      stack_.push_back(second);
      return nullptr;
    }
    const bool first_larger = size(first) > size(second);
    Step &larger = first_larger ? first : second, &smaller = first_larger ? second : first;
    if (!smaller.is_proposed && looks_ahead(step)) {
      is_open(smaller.span);  // ends there
      return &larger;
    }
    return is_set(context_.cancel) ? nullptr : queue_one(larger, smaller);
  }

  /// Leaves a span to the walk from its early start, if it has one, whose parent its node becomes.
  /// The walk always comes from before the early start's disk: past it, the node's disk would lie
  /// beyond the two feet but for what is in the early disk, so that what it touches behind would be
  /// in that, or across sites ahead, over which it does not reach.
  bool leave_to_early_walk(const Span& span) {
    if (sharing_.starts == nullptr || span.left - span.right < sharing_.fork_size) return false;
    const EarlyStart* const start = early_start_of(span, *sharing_.starts);
    if (start == nullptr || start == own_start_) return false;
    chunk_.early.push_back(
        {static_cast<std::uint32_t>(start - sharing_.starts->data()), span.node});
    return true;
  }

  bool are_certain(const Parts& parts) const {
    for (std::size_t i = 0; i < parts.count; ++i)
      if (parts.step[i].is_proposed && !parts.step[i].is_certain) return false;
    return many_.are_certain();
  }

  /// The steps into which an event divides its own; looked ahead at, if asked for.
  void find_parts(const Step& step, const Disk& from, Parts& parts) {
    const Event& event = step.event;
    const bool looks = looks_ahead(step);
    // What double takes for the event after their node.
    const auto look_ahead = [&](Step& part) {
      if (looks && contacts_.needs_walk(part.span)) propose(part, event.disk);
      return part.is_proposed;
    };
    many_.clear();
    for (Step& part : parts.step) part = Step{};
    if (step.is_tie || event.kind == Event::Kind::at_node) {
      split(step.span, step.is_tie ? event.disk : from, event.site, false);
      many_.propose(look_ahead);
      parts.count = many_.size() <= 2 ? many_.size() : 0;
      for (std::size_t i = parts.count; i-- > 0;) parts.step[i] = many_.pop_back();
      return;
    }
    // Also where it is the same: that is known then.
    const bool is_exact = step.is_node.has_value() || event.disk.center != from.center ||
                          event.disk.radius != from.radius;
    auto& [first, second] = parts.step;
    parts.count = divide(step.span, event, step.error, is_exact, first.span, second.span);
    for (std::size_t i = 0; i < parts.count; ++i) look_ahead(parts.step[i]);
  }

  /// Whether what a step's disk may have missed is searched for before it is taken.
  bool looks_ahead(const Step& step) const {
    return !is_exact_ && !(boundary_.has_arcs && step.joins_node);
  }

  /// Whether a step's event is taken as double has it.
  bool is_taken(const Step& step, const Disk& from, const Certainty& certainty) {
    if (certainty.is_tie() && !context_.joins_ties) return false;
    if (boundary_.has_arcs) return certainty.is_certain();
    if (const auto settled = is_settled(contacts_, from, step.event, certainty)) return *settled;
    const std::uint32_t fourth = certainty.fourth();
    if (!certainty.is_tie()) return !contacts_.may_touch_more(step.span, from, fourth);
    return contacts_.passes_at(step.span, from, fourth) ||
           contacts_.is_clean_tie(step.span, from, fourth);
  }

  /// What ends the edge of a step's span where that is not certain in double: a tie, or what 256
  /// bits tell. Whether anything has changed.
  bool decide(Step& step, const Disk& from) {
    using Kind = Event::Kind;
    Event& event = step.event;
    if (contacts_.is_polygon() && context_.joins_ties && !is_exact_ &&
        event.kind == Kind::contact) {
      // Contacts that are near to each other leave open where they meet: in a tie of the node's
      // own disk, there; but where one only passes on to the next, that may be anywhere.
      const bool passes =
          (event.site == step.span.right + 1 && boundary_.is_smooth(event.site - 1)) ||
          (event.site + 1 == step.span.left && boundary_.is_smooth(event.site));
      if (!passes && contacts_.is_clean_tie(step.span, from, event.site)) {
        event.disk = from;
        return step.is_tie = true;
      }
      const auto disk = contacts_.clean_tie(step.span, event.disk, event.site);
      if (disk && distance(disk->center, from.center) > spread * context_.tolerance) {
        event.disk = *disk;
        return step.is_tie = true;
      }
    }
    return decide_exactly(step, from);
  }

  /// The disk between two arcs that are the whole boundary and join bluntly: the largest one.
  Disk disk_between(const Boundary::SiteRange& run) const {
    const auto middle_from = [&](std::uint32_t first) {
      std::uint32_t last = first;
      while (last < run.last && boundary_.is_same(last + 1, first)) ++last;
      return last > first ? site(last).point : site(first).at(0.5 * site(first).length);
    };
    std::uint32_t second = run.first;
    while (second < run.last && boundary_.is_same(second, run.first)) ++second;
    const Vec2 a = middle_from(run.first), b = middle_from(second);
    return {midpoint(a, b), 0.5 * distance(a, b)};
  }

  static bool is_set(const std::atomic<bool>* flag) {
    return flag != nullptr && flag->load(std::memory_order_relaxed);
  }

  /// Passes on to the last piece of an arc that the boundary has in several, which are one site of
  /// the shape. Whether there were any.
  bool joins_pieces(Span& span) const {
    const Span before = span;
    while (span.left - span.right > 1 && boundary_.is_same(span.right, span.right + 1))
      ++span.right;
    while (span.left - span.right > 1 && boundary_.is_same(span.left - 1, span.left)) --span.left;
    return span.right != before.right || span.left != before.left;
  }

  /// Notes that the shape as its doubles say does not continue here: what led to a span was wrong,
  /// or arcs join so that rounding alone decides.
  void lose(const Span& span, std::uint32_t third) {
    ++chunk_.statistics.exact_changes;
    for (const std::uint32_t i : {span.right, span.left, span.third, third})
      if (i < boundary_.sites.size() && element(i) != Element::bridge) chunk_.lost.push_back(i);
  }

  /// Whether an exact disk shows that a step before was wrong, beside arcs. If it reaches over the
  /// site that the span has left, by more than what counts as touched, the exact axis has no edge
  /// in the span: ties that double takes for certain may lead there. If it reaches over one of the
  /// span's own sites, by more than joints are smooth, it is the circle of an arc that joins it,
  /// and not empty.
  bool is_wrong(const Span& span, const Disk& disk) const {
    return reaches_over(span.third, disk, context_.tolerance) ||
           reaches_over(span.right, disk, context_.joints) ||
           reaches_over(span.left, disk, context_.joints);
  }
  bool reaches_over(std::uint32_t i, const Disk& disk, double slack) const {
    if (i >= boundary_.sites.size() || element(i) == Element::bridge) return false;
    const double reach = disk.radius - slack;
    return reach > 0 && site::squared_distance(site(i), disk.center) < reach * reach;
  }

  /// Whether the foot lies beyond one end of a piece of an arc. Half a circle on the parameter is
  /// infinite, of either sign: what is more than a quarter turn behind a piece is ahead of it.
  bool is_beyond(std::uint32_t i, bool at_end, Vec2 center) const {
    const double s = site::carrier_parameter(site(i), center), length = site(i).length;
    const double turn = std::max(length, 2 / std::abs(site(i).curvature));
    return at_end ? s >= length || s < -turn : s <= 0 || s > length + turn;
  }

  /// Of the sites of two spans that differ by pieces of one arc, those on which the foot lies.
  void stay_on_pieces(const Span& last, Vec2 center, Span& span) const {
    while (span.right < last.right && is_beyond(span.right, true, center)) ++span.right;
    while (span.left > last.left && is_beyond(span.left, false, center)) --span.left;
  }

  /// Of the pieces of one arc inside a span, the one on which the foot lies.
  std::uint32_t piece_below(Vec2 center, std::uint32_t i, const Span& span) const {
    while (i - 1 > span.right && boundary_.is_same(i - 1, i) && is_beyond(i, false, center)) --i;
    while (i + 1 < span.left && boundary_.is_same(i, i + 1) && is_beyond(i, true, center)) ++i;
    return i;
  }

  /// Whether the event is that a foot passes on to the next piece of the same arc.
  bool stays_on_arc(const Span& span, const Event& event) const {
    using Kind = Event::Kind;
    if (event.kind != Kind::pass_right && event.kind != Kind::pass_left) return false;
    const std::uint32_t i = event.kind == Kind::pass_right ? span.right : span.left - 1;
    return boundary_.is_same(i, i + 1);
  }

  Event event_in_double(const Span& span, const Disk& from) {
    return EventSearch(context_, contacts_, chunk_.statistics, span, from).next();
  }

  /// What ends the edge of a step's span, in double, and whether that is certain.
  void propose(Step& step, const Disk& from) {
    step.is_proposed = true;
    if (is_exact_) return;
    const Span& span = step.span;
    const RunAhead::Found* const found = ahead_.find(span, from);
    if (found != nullptr && found->is_certain) {
      step.event = found->event;
      step.error = found->error;
      take(step);
      return;
    }
    const std::uint64_t queries = chunk_.statistics.queries;
    EventSearch search(context_, contacts_, chunk_.statistics, span, from);
    step.event = found != nullptr ? search.next(found->event) : search.next();
    ahead_.note(chunk_.statistics.queries - queries <= 1);
    const Certainty certainty(boundary_, context_.tolerance, span, from, step.event);
    step.error = certainty.error();
    if (is_taken(step, from, certainty)) take(step);
    step.joins_node = step.is_certain && certainty.is_tie();
  }

  /// Takes an event as double has it.
  void take(Step& step) {
    step.is_certain = true;
    if (keeps_ties_) step.is_node = false;
    ++chunk_.statistics.exact_filtered;
  }

  void count(const std::optional<ExactEvents::Found>& found) {
    ++(found && !found->in_precise ? chunk_.statistics.exact_twofold
                                   : chunk_.statistics.exact_precise);
  }

  /// The same exactly. Where that finds nothing, double's event is taken and noted. Whether
  /// anything has changed.
  bool decide_exactly(Step& step, const Disk& from) {
    Event& event = step.event;
    Span& span = step.span;
    Span asked = span;
    // Where nothing but pieces of one arc is left, the foot passes on over them.
    if (joins_pieces(asked) && asked.left - asked.right == 1 && stays_on_arc(span, event))
      return false;
    const bool from_exact = is_exact_ || (span.is_exact && !boundary_.has_arcs);
    const std::uint32_t hint = event.kind == Event::Kind::pass_right  ? span.right + 1
                               : event.kind == Event::Kind::pass_left ? span.left - 1
                                                                      : event.site;
    const auto found = context_.exact.next(asked, from, hint, from_exact);
    count(found);
    if (!found) {
      if (is_exact_) event = event_in_double(span, from);
      lose(span, event.site);
      return is_exact_;
    }
    // Between sites that are all but parallel, double's disk is as good as any that is so near.
    const bool is_tie = event.kind == Event::Kind::at_node && !context_.joins_ties;
    const double apart = distance(event.disk.center, found->disk.center) +
                         std::abs(event.disk.radius - found->disk.radius);
    if (!found->is_well_known() && event.site == found->site && !is_tie &&
        apart <= found->error + spread * context_.tolerance)
      return false;
    // What 256 bits leave open is measured in the end.
    if (!(found->error <= context_.tolerance)) lose(span, found->site);
    Span ahead = span;
    stay_on_pieces(asked, found->disk.center, ahead);
    const bool passes = ahead.right != span.right || ahead.left != span.left;
    if (passes && !is_exact_ && stays_on_arc(span, event)) return false;
    if (boundary_.has_arcs && is_wrong(span, found->disk)) lose(span, span.third);
    span = ahead;
    step.joins_node = false;
    if (keeps_ties_) step.is_node = found->is_node;
    step.error = Certainty::rounding + found->error;
    event.disk = found->disk;
    event.site = piece_below(event.disk.center, found->site, span);
    event.kind =
        event.site == span.right + 1 && boundary_.is_smooth(span.right)  ? Event::Kind::pass_right
        : event.site + 1 == span.left && boundary_.is_smooth(event.site) ? Event::Kind::pass_left
                                                                         : Event::Kind::contact;
    return true;
  }

  /// The disk that grows at the smooth place where a run begins and ends, until it touches
  /// something: a node of the axis, from which all of the run is walked. A circle has no more.
  void start_at_smooth_place(const Boundary::SiteRange& run) {
    const auto place = boundary_.smooth_place(run.last, run.first);
    const Vec2 foot = place.point, normal = place.normal;
    double radius = context_.radius_limit;
    for (const std::uint32_t i : {run.first, run.last})
      if (site(i).curvature > 0) radius = std::min(radius, 1 / site(i).curvature);
    const auto disk_of = [&](double r) { return Disk{foot + r * normal, r}; };
    const Span whole{run.first, run.last, 0};
    // The edge behind the vertex at which the run begins, behind the holes connected there, if any.
    std::uint32_t behind = Hit::none;
    if (element(run.first) == Element::vertex)
      for (behind = run.first + 1; element(behind) == Element::bridge;)
        behind = boundary_.bridge_places[boundary_.originals[behind]][1] + 2;
    std::uint32_t touched = Hit::none;
    while (const Hit hit = contacts_.nearest(disk_of(radius), whole)) {
      // The edge behind a reflex vertex bends into the disk, if at all, up to its end.
      const Site& hindrance = site(hit.site);
      const double smaller = site::touching_radius(
          foot, normal, hit.site == behind ? site::make_vertex(hindrance.end()) : hindrance);
      touched = hit.site;
      if (!(smaller < radius)) break;
      radius = smaller;
    }
    const Disk disk = disk_of(radius);
    if (is_uncertain(run, touched, disk) && start_exactly(whole, disk, touched)) return;
    const std::uint32_t node = add_node(disk);
    if (touched != Hit::none) touched = contacts_.owner(touched, disk.center, whole);
    split({run.first, run.last, node}, disk, touched, true);
    stack_.append(many_);
  }

  /// Whether double leaves open what the disk touches that grows where a run begins.
  bool is_uncertain(const Boundary::SiteRange& run, std::uint32_t touched, const Disk& disk) const {
    if (is_exact_) return true;
    return touched != Hit::none &&
           !(Certainty::error_at_joint(boundary_, run.last, run.first, touched, disk) <=
             spread * context_.tolerance);
  }

  /// start_at_smooth_place() in 256 bits; `about` and `hint` are what double takes for it. Whether
  /// there is such a disk.
  bool start_exactly(const Span& whole, const Disk& about, std::uint32_t hint) {
    const auto found = context_.exact.start(whole, about, hint);
    count(found);
    if (!found) {
      lose(whole, hint);
      return false;
    }
    const std::uint32_t node = add_node(found->disk);
    const std::uint32_t touched = piece_below(found->disk.center, found->site, whole);
    Step first{{whole.right, touched, node, whole.left, Certainty::rounding, true}},
        second{{touched, whole.left, node, whole.right, Certainty::rounding, true}};
    const bool first_larger = size(first) > size(second);
    stack_.push_back(*queue_one(first_larger ? first : second, first_larger ? second : first));
    return true;
  }

  /// Whether a walk is needed; where the two sites are neighbours, ends the axis there. What is
  /// known of a proposed step is not asked again.
  bool is_open(const Span& span, bool is_proposed = false) {
    const std::uint32_t between = span.left - span.right;
    const bool at_bridge = contacts_.is_at_bridge(span);
    const bool ends =
        between == 1 || (!at_bridge && !is_proposed && contacts_.is_reflex_chain(span));
    if (ends && boundary_.has_arcs && !is_exact_ &&
        !Certainty::ends(boundary_, context_.tolerance, span, chunk_.nodes[span.node]))
      lose(span, span.left);
    if (between == 1) {
      if (boundary_.is_corner(span.right)) {
        const std::uint32_t leaf = add_node({site(span.left).point, 0});
        add_edge(span, leaf);
      }
      finished(2);
      return false;
    }
    if (at_bridge) {
      end_at_bridge(span);
      finished(2);
      return false;
    }
    return !ends;
  }

  /// A bridge's disk is a node where a hole begins and ends at a smooth joint: its two sides touch
  /// different sites there.
  void end_at_bridge(const Span& span) {
    const std::uint32_t place = span.right + 1, bridge = boundary_.originals[place];
    const auto goes_on = [&](std::uint32_t i) {
      return boundary_.originals[boundary_.across(place, i)] == boundary_.originals[i];
    };
    const bool is_node = !goes_on(span.right) || !goes_on(span.left);
    const Disk& disk = context_.bridges[bridge].disk;
    if (!keeps_ties_ && coincide(chunk_.nodes[span.node], disk)) {
      chunk_.bridge_ends.push_back({bridge, span.node, BridgeEnd::no_edge});
      return;
    }
    const auto edge = static_cast<std::uint32_t>(chunk_.links.size());
    const std::uint32_t node = add_node(disk);
    add_edge(span, node);
    const bool added = chunk_.links.size() > edge;
    chunk_.bridge_ends.push_back({bridge, node, added && !is_node ? edge : BridgeEnd::no_edge});
  }

  /// How far an arc's own circle may be off in double.
  static double rounding_of_arcs(const Disk& circle) {
    constexpr double slack = 4 * std::numeric_limits<double>::epsilon();
    return slack * std::max({circle.radius, std::abs(circle.center.x), std::abs(circle.center.y)});
  }

  bool coincide(const Disk& a, const Disk& b) const {
    // Where a shape is hardly wider than the tolerance, that is no tie.
    constexpr double of_radius = 0x1p-10;
    if (contacts_.is_polygon()) return a.center == b.center && a.radius == b.radius;
    const double radius = std::max(a.radius, b.radius);
    const double slack = std::min(context_.tolerance,
                                  context_.joins_ties ? of_radius * radius : rounding_of_arcs(a));
    return squared_norm(a.center - b.center) <= slack * slack &&
           std::abs(a.radius - b.radius) <= slack;
  }

  std::uint32_t add_node(const Disk& disk) {
    chunk_.nodes.push_back(disk);
    return static_cast<std::uint32_t>(chunk_.nodes.size() - 1);
  }

  void add_edge(const Span& span, std::uint32_t to) {
    if (starts_blunt_ && span.node == 0) return;  // no edge leads to a blunt joint
    chunk_.links.push_back({{span.node, to}, {span.left, span.right}});
  }

  /// The node of a step's event, with the edge that leads there; the old node where it is that one.
  std::uint32_t arrive(const Step& step, const Disk& from) {
    const Span& span = step.span;
    const Disk& disk = step.event.disk;
    // A corner stays a leaf, however thin the shape is there.
    if (from.radius > 0 && step.is_node.value_or(coincide(from, disk))) return span.node;
    double& largest = chunk_.statistics.largest_residual;
    for (const std::uint32_t i : {span.right, span.left})
      largest =
          std::max(largest, std::abs(site::carrier_distance(site(i), disk.center) - disk.radius));
    const std::uint32_t node = add_node(disk);
    add_edge(span, node);
    return node;
  }

  static std::uint32_t size(const Step& step) { return step.span.left - step.span.right; }

  /// Queues one of two steps: the larger, so that the stack holds at most log n of them. But a
  /// large one is walked before the smaller, so that other threads can soon share it: it becomes a
  /// task once the spans left behind add up to one task's work, or the smaller is one. Returns the
  /// other.
  Step* queue_one(Step& larger, Step& smaller) {
    const bool large = size(larger) >= sharing_.fork_size && context_.most_nodes == 0;
    if (large) left_behind_ += size(smaller);
    if (size(smaller) >= sharing_.fork_size || (large && left_behind_ >= sharing_.fork_size)) {
      left_behind_ = 0;
      fork(larger);
      return &smaller;
    }
    stack_.push_back(large ? smaller : larger);
    return large ? &larger : &smaller;
  }

  void fork(const Step& step) {
    // A deferred task has few nodes of its own.
    const std::size_t expected = context_.most_nodes > 0 ? 0 : in_task;
    Chunk& child = *chunk_.children.emplace_back(std::make_unique<Chunk>(expected));
    child.component = chunk_.component;
    child.parent_node = step.span.node;
    child.nodes.push_back(chunk_.nodes[step.span.node]);
    child.span = step.span.left - step.span.right;
    auto walk = [&context = context_, sharing = sharing_, &child, step] {
      Step first = step;
      first.span.node = 0;
      Walker(context, sharing, child).walk_step(first);
    };
    if (context_.most_nodes > 0)
      child.walk = std::move(walk);
    else
      sharing_.tasks.run(std::move(walk));
  }

  /// The parts of a span whose node touches more sites, in `many_`.
  void split(const Span& span, const Disk& disk, std::uint32_t sure, bool all_around) {
    many_.clear();
    contacts_.split(span, disk, sure, all_around, many_.spans());
    for (Span& part : many_.spans()) {
      part.error = span.error + spread * context_.tolerance;
      part.third = part.right != span.right ? span.right : span.left;
    }
  }

  void finished(std::uint32_t sites) {
    finished_ += sites;
    if (finished_ >= 1 << 14) report_progress(false);
  }

  void report_progress(bool all) {
    if ((all || finished_ > 0) && context_.finished_sites) context_.finished_sites(finished_);
    finished_ = 0;
  }

  /// In tolerances: the disks of a tie are as far off as rounding leaves each three of its contacts
  /// open.
  static constexpr double spread = 16;

  const WalkContext& context_;
  const Sharing sharing_;
  const EarlyStart* own_start_ = nullptr;  ///< at which this walk begins, if at one
  const Boundary& boundary_;
  Chunk& chunk_;
  const std::unique_ptr<Contacts> own_contacts_;
  Contacts& contacts_;
  RunAhead ahead_;
  const bool is_exact_;        ///< double is never asked
  const bool keeps_ties_;      ///< nodes of a polygon are one only if their disks are
  bool starts_blunt_ = false;  ///< the run begins at a blunt joint, node 0
  Steps stack_, many_;         ///< `many_`: parts of the last step, where they are more than two
  std::uint32_t left_behind_ = 0;  ///< sites of spans in the stack, about
  std::uint64_t finished_ = 0;
};

/// What was walked from early starts becomes children of the chunks whose walks came there.
void join_early(Chunk& root, std::vector<std::unique_ptr<Chunk>>& early) {
  std::vector<Chunk*> stack{&root};
  while (!stack.empty()) {
    Chunk& chunk = *stack.back();
    stack.pop_back();
    for (const auto& [start, node] : chunk.early) {
      early[start]->parent_node = node;
      chunk.children.push_back(std::move(early[start]));
    }
    for (const auto& child : chunk.children) stack.push_back(child.get());
  }
}

}  // namespace

std::vector<std::unique_ptr<Chunk>> walk(const WalkContext& context) {
  const std::uint32_t fork_size = fork_size_of(context.boundary);
  const std::vector<EarlyStart> starts = early_starts(context, fork_size);
  std::vector<std::unique_ptr<Chunk>> chunks, early;
  TaskGroup tasks;
  const Sharing sharing{tasks, fork_size, &starts};
  for (const EarlyStart& start : starts) {
    Chunk& chunk = *early.emplace_back(std::make_unique<Chunk>(in_task));
    chunk.component = start.component;
    tasks.run(
        [&context, sharing, &chunk, &start] { Walker(context, sharing, chunk).walk_early(start); });
  }
  // Small components share a task.
  std::size_t next = 0;
  const auto& runs = context.boundary.runs;
  chunks.reserve(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    chunks.push_back(std::make_unique<Chunk>());
    chunks.back()->component = static_cast<std::uint32_t>(i);
  }
  while (next < runs.size()) {
    const std::size_t begin = next;
    std::uint64_t sites = 0;
    while (next < runs.size() && sites < fork_size) {
      sites += runs[next].last - runs[next].first + 1;
      ++next;
    }
    const auto walk_some = [&context, sharing, &chunks, &runs, begin, end = next] {
      for (std::size_t i = begin; i < end; ++i)
        Walker(context, sharing, *chunks[i]).walk_run(runs[i]);
    };
    if (next < runs.size())
      tasks.run(walk_some);
    else
      walk_some();
  }
  tasks.wait();
  for (const auto& chunk : chunks) join_early(*chunk, early);
  return chunks;
}

std::vector<std::unique_ptr<Chunk>> put_off_walk(const WalkContext& context, TaskGroup& none) {
  std::vector<std::unique_ptr<Chunk>> chunks;
  for (const Boundary::SiteRange& run : context.boundary.runs) {
    Chunk& chunk = *chunks.emplace_back(std::make_unique<Chunk>());
    chunk.component = static_cast<std::uint32_t>(chunks.size() - 1);
    chunk.span = run.last - run.first;
    chunk.walk = [&context, &none, &chunk, &run] {
      Walker(context, {none, fork_size_of(context.boundary)}, chunk).walk_run(run);
    };
  }
  return chunks;
}

std::unique_ptr<Chunk> walk_part(const WalkContext& context, const Disk& start, double error) {
  auto chunk = std::make_unique<Chunk>();
  TaskGroup tasks;
  Walker(context, {tasks, Hit::none}, *chunk).walk_from(context.boundary.runs[0], start, error);
  tasks.wait();
  return chunk;
}

}  // namespace medial::disks
