#include "methods/disks/walk.h"

#include <array>
#include <optional>

#include "base/threads.h"
#include "methods/disks/decide.h"
#include "methods/disks/early_starts.h"
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
  TaskGroup* tasks;  ///< none where they are deferred, or there are none
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
        contacts_(context, chunk.statistics),
        decider_(contacts_, chunk) {}

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
      if (context_.is_cancelled()) break;
      follow(stack_.pop_back());
      if (!is_full()) continue;
      stack_.for_each([&](const Step& step) { fork(step); });
      stack_.clear();
    }
    report_progress(true);
  }

  bool is_full() const {
    return context_.most_nodes > 0 && chunk_.nodes.size() > context_.most_nodes;
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
      if (decider_.is_exact && decider_.joins_pieces(step->span) && !is_open(step->span)) return;
      if (!step->is_proposed) decider_.propose(*step, from);
      const bool in_double = step->is_certain;
      if (!in_double) decider_.decide(*step, from);
      find_parts(*step, from, *parts);
      // What double leaves open next to its disk may have come before it; but not beside arcs where
      // the disk and the node are one tie.
      if (in_double && decider_.looks_ahead(*step) && !are_certain(*parts) &&
          decider_.decide(*step, from))
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
    if (!smaller.is_proposed && decider_.looks_ahead(step)) {
      is_open(smaller.span);  // ends there
      return &larger;
    }
    return context_.is_cancelled() ? nullptr : queue_one(larger, smaller);
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

  /// A step proposed beyond a tie, before its turn comes.
  struct Ahead {
    Step step;
    Disk from;
    bool is_of(const Span& span, const Disk& disk) const {
      return step.span.right == span.right && step.span.left == span.left &&
             step.span.third == span.third && step.span.error == span.error &&
             from.center == disk.center && from.radius == disk.radius;
    }
  };

  /// What double takes for the event after a part's node. On a polygon, a foot that passes on
  /// within the node's disk is certain only if what follows is: else what double leaves open there
  /// may have come before that disk.
  void look_ahead(Step& part, const Disk& from) {
    if (!ahead_.empty() && ahead_.back().is_of(part.span, from)) {
      const Span span = part.span;
      part = ahead_.back().step;
      part.span = span;
      ahead_.pop_back();
      return;
    }
    ahead_.clear();
    decider_.propose(part, from);
    if (contacts_.is_polygon() && part.joins_node && !passes_certainly(part))
      part.is_certain = part.joins_node = false;
  }

  /// Whether the events after one that passes on are certain, up to one that does more than pass
  /// on: that one is looked ahead at in its turn. They are kept as the next steps.
  bool passes_certainly(const Step& tie) {
    // A longer chain would be proposed again for each of its steps.
    constexpr std::size_t longest = 16;
    const Step* step = &tie;
    while (step->joins_node && ahead_.size() < longest) {
      Span after, none;
      if (divide(step->span, step->event, step->error, true, after, none) != 1) break;
      if (!contacts_.needs_walk(after)) break;
      Ahead& next = ahead_.emplace_back(Ahead{{after}, step->event.disk});
      decider_.propose(next.step, next.from);
      if (!next.step.is_certain) {
        ahead_.clear();
        return false;
      }
      step = &next.step;
    }
    std::reverse(ahead_.begin(), ahead_.end());
    return true;
  }

  /// The steps into which an event divides its own; looked ahead at, if asked for.
  void find_parts(const Step& step, const Disk& from, Parts& parts) {
    const Event& event = step.event;
    const bool looks = decider_.looks_ahead(step);
    // What double takes for the event after their node.
    const auto propose_part = [&](Step& part) {
      if (looks && contacts_.needs_walk(part.span)) look_ahead(part, event.disk);
      return part.is_proposed;
    };
    many_.clear();
    for (Step& part : parts.step) part = Step{};
    if (step.is_tie || event.kind == Event::Kind::at_node) {
      split(step.span, step.is_tie ? event.disk : from, event.site, false);
      many_.propose(propose_part);
      parts.count = many_.size() <= 2 ? many_.size() : 0;
      for (std::size_t i = parts.count; i-- > 0;) parts.step[i] = many_.pop_back();
      return;
    }
    // Also where it is the same: that is known then.
    const bool is_exact = step.is_node.has_value() || event.disk.center != from.center ||
                          event.disk.radius != from.radius;
    auto& [first, second] = parts.step;
    parts.count = divide(step.span, event, step.error, is_exact, first.span, second.span);
    for (std::size_t i = 0; i < parts.count; ++i) propose_part(parts.step[i]);
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
        behind = boundary_.bridge_at(behind).places[1] + 2;
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
    if (is_uncertain(run, touched, disk))
      if (const auto found = decider_.start(whole, disk, touched)) return begin_at(*found, run);
    const std::uint32_t node = add_node(disk);
    if (touched != Hit::none) touched = contacts_.owner(touched, disk.center, whole);
    split({run.first, run.last, node}, disk, touched, true);
    stack_.append(many_);
  }

  /// Whether double leaves open what the disk touches that grows where a run begins.
  bool is_uncertain(const Boundary::SiteRange& run, std::uint32_t touched, const Disk& disk) const {
    if (decider_.is_exact) return true;
    return touched != Hit::none &&
           !(Certainty::error_at_joint(boundary_, run.last, run.first, touched, disk) <=
             Decider::spread * context_.tolerance);
  }

  /// Begins in a disk that touches the place where a run begins, and a site.
  void begin_at(const ExactEvent& found, const Boundary::SiteRange& run) {
    const std::uint32_t node = add_node(found.disk), touched = found.site;
    Step first{{run.first, touched, node, run.last, Certainty::rounding, true}},
        second{{touched, run.last, node, run.first, Certainty::rounding, true}};
    const bool first_larger = size(first) > size(second);
    stack_.push_back(*queue_one(first_larger ? first : second, first_larger ? second : first));
  }

  /// Whether a walk is needed; where the two sites are neighbours, ends the axis there. What is
  /// known of a proposed step is not asked again.
  bool is_open(const Span& span, bool is_proposed = false) {
    const bool is_long = span.left - span.right > 2;
    if (is_long && (is_proposed || !contacts_.is_reflex_chain(span))) return true;
    return !ends_at_once(span, is_proposed);
  }
  /// Ends the axis where the two sites are neighbours, or nothing but a bridge or a chain that no
  /// disk touches lies between them.
  bool ends_at_once(const Span& span, bool is_proposed) {
    const std::uint32_t between = span.left - span.right;
    const bool at_bridge = contacts_.is_at_bridge(span);
    const bool ends =
        between == 1 || (!at_bridge && !is_proposed && contacts_.is_reflex_chain(span));
    if (ends && boundary_.has_arcs && !decider_.is_exact &&
        !Certainty::ends(boundary_, context_.tolerance, span, chunk_.nodes[span.node]))
      decider_.lose(span, span.left);
    if (between == 1) {
      if (boundary_.is_corner(span.right)) {
        const std::uint32_t leaf = add_node({site(span.left).point, 0});
        add_edge(span, leaf);
      } else {
        end_at_blunt_joint(span);
      }
      finished(2);
      return true;
    }
    if (at_bridge) {
      end_at_bridge(span);
      finished(2);
      return true;
    }
    return ends;
  }

  /// A bridge's disk is a node where a hole begins and ends at a smooth joint: its two sides touch
  /// different sites there.
  void end_at_bridge(const Span& span) {
    const std::uint32_t place = span.right + 1, bridge = boundary_.originals[place];
    const auto goes_on = [&](std::uint32_t i) {
      return boundary_.originals[boundary_.across(place, i)] == boundary_.originals[i];
    };
    const bool is_node = !goes_on(span.right) || !goes_on(span.left);
    const Disk& disk = boundary_.bridges[bridge].disk;
    if (!decider_.keeps_ties && coincide(chunk_.nodes[span.node], disk)) {
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
    std::uint32_t from = span.node;
    if (starts_blunt_ && from == 0) {  // no edge ends in a blunt joint; one may lead towards it
      const auto leaf = blunt_leaf(span.left, span.right, chunk_.nodes[to]);
      if (!leaf) return;
      from = add_node(*leaf);
    }
    chunk_.links.push_back({{from, to}, {span.left, span.right}});
  }

  /// An edge between two blunt joints leads towards both, or is left out: what was found on the way
  /// to one of them need not be the largest disk.
  void end_at_blunt_joint(const Span& span) {
    const auto leaf = blunt_leaf(span.right, span.left, chunk_.nodes[span.node]);
    const bool begins_at_joint = starts_blunt_ && span.node == 0;
    if (leaf && (!begins_at_joint || blunt_leaf(span.left, span.right, *leaf)))
      add_edge(span, add_node(*leaf));
  }

  /// Where an edge ends that leads from a node towards the joint of two edges, if that is blunt and
  /// the edge is not left out. The node of a run that begins there is the joint. In 256 bits also
  /// towards a smooth joint: two arcs of nearly one circle have their largest disk on the way.
  std::optional<Disk> blunt_leaf(std::uint32_t before, std::uint32_t after,
                                 const Disk& node) const {
    if (element(before) != Element::edge || element(after) != Element::edge) return std::nullopt;
    const site::Joint joint = boundary_.joint(before);
    if (joint != site::Joint::blunt && !(decider_.is_exact && joint == site::Joint::smooth))
      return std::nullopt;
    const Disk end = end_toward_joint(context_, before, after, node);
    return coincide(node, end) ? std::nullopt : std::optional(end);
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
    Span rest = span;
    if (const auto middle = middle_of_half_ellipse(span, from, disk))
      add_edge(span, rest.node = add_node(*middle));
    const std::uint32_t node = add_node(disk);
    add_edge(rest, node);
    return node;
  }

  /// The disk in the middle of an edge that leads around half of an ellipse, which is no single
  /// Bézier curve: both foci lie on its chord, up to rounding. In double, the two pieces of a half
  /// circle divide such an edge.
  std::optional<Disk> middle_of_half_ellipse(const Span& span, const Disk& from,
                                             const Disk& to) const {
    constexpr double rounding = 0x1p-48;
    const bool by_right = site(span.right).curvature > 0;
    const Site &arc = site(by_right ? span.right : span.left),
               &other = site(by_right ? span.left : span.right);
    const Vec2 chord = to.center - from.center;
    const auto is_on_chord = [&](Vec2 focus) {
      return std::abs(cross(focus - from.center, chord)) <= rounding * norm(chord) &&
             dot(focus - from.center, focus - to.center) < 0;
    };
    const bool is_ellipse =
        arc.curvature > 0 && (other.is_vertex() || (other.is_arc() && other.curvature < 0));
    if (!is_ellipse || !is_on_chord(focus_of(arc)) || !is_on_chord(focus_of(other)))
      return std::nullopt;
    const Vec2 normal = ((by_right ? 1 : -1) / norm(chord)) * left_of(chord);
    const Vec2 foot = focus_of(arc) - (1 / arc.curvature) * normal;
    const double radius = site::tangent_radius(foot, normal, other);
    return Disk{foot + radius * normal, radius};
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
      sharing_.tasks->run(std::move(walk));
  }

  /// The parts of a span whose node touches more sites, in `many_`.
  void split(const Span& span, const Disk& disk, std::uint32_t sure, bool all_around) {
    many_.clear();
    contacts_.split(span, disk, sure, all_around, many_.spans());
    for (Span& part : many_.spans()) {
      part.error = span.error + Decider::spread * context_.tolerance;
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

  const WalkContext& context_;
  const Sharing sharing_;
  const EarlyStart* own_start_ = nullptr;  ///< at which this walk begins, if at one
  const Boundary& boundary_;
  Chunk& chunk_;
  Contacts contacts_;
  Decider decider_;
  bool starts_blunt_ = false;  ///< the run begins at a blunt joint, node 0
  Steps stack_, many_;         ///< `many_`: parts of the last step, where they are more than two
  std::vector<Ahead> ahead_;   ///< beyond the last tie that was looked ahead at, in reverse order
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
  const Sharing sharing{&tasks, fork_size, &starts};
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

std::vector<std::unique_ptr<Chunk>> put_off_walk(const WalkContext& context) {
  std::vector<std::unique_ptr<Chunk>> chunks;
  for (const Boundary::SiteRange& run : context.boundary.runs) {
    Chunk& chunk = *chunks.emplace_back(std::make_unique<Chunk>());
    chunk.component = static_cast<std::uint32_t>(chunks.size() - 1);
    chunk.span = run.last - run.first;
    chunk.walk = [&context, &chunk, &run] {
      Walker(context, {nullptr, fork_size_of(context.boundary)}, chunk).walk_run(run);
    };
  }
  return chunks;
}

std::unique_ptr<Chunk> walk_part(const WalkContext& context, const Disk& start, double error) {
  auto chunk = std::make_unique<Chunk>();
  Walker(context, {nullptr, Hit::none}, *chunk).walk_from(context.boundary.runs[0], start, error);
  return chunk;
}

}  // namespace medial::disks
