#include "engines/disks/walk.h"

#include <tbb/task_group.h>

#include <limits>
#include <optional>

#include "geometry/bisector.h"
#include "geometry/tangent_disk.h"

namespace medial::disks {
namespace {

using geometry::Bisector;
using geometry::Site;
using Hit = index::BoundaryTree::Hit;

/// A part of the boundary still to be walked: the sites between `right`, whose foot moves forward,
/// and `left`, whose foot moves backward, both touched by the disk of `node`.
struct Span {
  std::uint32_t right;
  std::uint32_t left;
  std::uint32_t node;
};

constexpr double nowhere = std::numeric_limits<double>::infinity();

/// What happens next on a bisector.
struct Event {
  enum class Kind : std::uint8_t {
    none,
    pass_right,  ///< the foot passes from `right` on to the next site
    pass_left,   ///< the foot passes from `left` on to the site before
    contact,     ///< the disk touches `site`
    at_node,     ///< the disk of the current node touches `site`
    far,         ///< the disk has outgrown the shape
  };
  Kind kind = Kind::none;
  std::uint32_t site = Hit::none;
  Disk disk;
  double position = nowhere;
};

/// Spans of at least so many sites become tasks of their own, if another such span is at hand.
constexpr std::uint32_t fork_size = 8192;

/// Halving an interval of doubles more often than this cannot change it.
constexpr int bracket_steps = 128;

class Walker {
 public:
  Walker(const WalkContext& context, tbb::task_group& tasks, Chunk& chunk)
      : context_(context), boundary_(context.boundary), tasks_(tasks), chunk_(chunk) {}

  /// Walks all of a run: from the convex corner between its last and first site, or from a disk
  /// that touches the boundary where the two join smoothly.
  void walk_run(const Boundary::Run& run) {
    chunk_.nodes.push_back({site(run.first).point, 0});  // stands for no parent
    if (run.at_corner) {
      const std::uint32_t corner = add_node({site(run.first).point, 0});
      stack_.push_back({run.first, run.last, corner});
    } else {
      start_at_smooth_place(run);
    }
    walk_stack();
  }

  /// Walks one span and all that branches off it.
  void walk_span(const Span& span) {
    stack_.push_back(span);
    walk_stack();
  }

 private:
  void walk_stack() {
    while (!stack_.empty()) {
      const Span next = stack_.back();
      stack_.pop_back();
      if (context_.cancel != nullptr && context_.cancel->load(std::memory_order_relaxed)) break;
      follow(next);
    }
    report_progress(true);
  }

  const Site& site(std::uint32_t i) const { return boundary_.sites[i]; }
  Element element(std::uint32_t i) const { return boundary_.elements[i]; }

  /// Follows the bisectors from one node until the axis branches or ends.
  void follow(Span span) {
    if (!is_open(span)) return;
    for (;;) {
      const Bisector bisector(site(span.right), site(span.left));
      const Disk from = chunk_.nodes[span.node];
      const Event event = next_event(bisector, from, span);
      switch (event.kind) {
        case Event::Kind::pass_right:
        case Event::Kind::pass_left: {
          span.node = arrive(span, from, event.disk);
          event.kind == Event::Kind::pass_right ? ++span.right : --span.left;
          if (!is_open(span)) return;
          break;
        }
        case Event::Kind::at_node:
          split_at_node(span, from, event.site);
          return;
        default: {
          const std::uint32_t node = arrive(span, from, event.disk);
          push({event.site, span.left, node}, {span.right, event.site, node});
          return;
        }
      }
    }
  }

  /// The disk that grows at the smooth place where a run begins and ends, until it touches
  /// something: a node of the axis, from which all of the run is walked. A circle has no more.
  void start_at_smooth_place(const Boundary::Run& run) {
    const Vec2 foot = site(run.first).point;
    const Vec2 normal = element(run.first) == Element::vertex ? site(run.last).end_normal()
                                                              : site(run.first).normal();
    double radius = context_.radius_limit;
    for (const std::uint32_t i : {run.first, run.last})
      if (site(i).curvature > 0) radius = std::min(radius, 1 / site(i).curvature);
    const auto disk_of = [&](double r) { return Disk{foot + r * normal, r}; };
    const Span whole{run.first, run.last, 0};
    std::uint32_t touched = Hit::none;
    while (const Hit hit = nearest(disk_of(radius), whole)) {
      const double smaller = geometry::touching_radius(foot, normal, site(hit.site));
      touched = hit.site;
      if (!(smaller < radius)) break;
      radius = smaller;
    }
    const Disk disk = disk_of(radius);
    const std::uint32_t node = add_node(disk);
    if (touched != Hit::none) touched = owner(touched, disk.center, whole);
    split_at_node({run.first, run.last, node}, disk, touched, true);
  }

  /// Whether a walk is needed between the two sites; where they are neighbours, ends the axis
  /// there.
  bool is_open(const Span& span) {
    const std::uint32_t between = span.left - span.right;
    if (between == 1) {
      if (boundary_.is_corner(span.right)) {
        const std::uint32_t leaf = add_node({site(span.left).point, 0});
        add_edge(span, leaf);
      }
      finished(2);
      return false;
    }
    if (between == 2 && element(span.right + 1) == Element::cut) {
      end_at_cut(span, boundary_.originals[span.right + 1]);
      finished(2);
      return false;
    }
    return !(between <= longest_flat_chain && is_reflex_chain(span));
  }

  /// Whether the span is a chain of segments and reflex vertices that turns by less than half a
  /// turn: no disk touches such a chain in two places. Rounding may ask for one where the chain is
  /// flat.
  bool is_reflex_chain(const Span& span) const {
    if (site(span.right).curvature > 0) return false;
    double turned = 0;
    Vec2 before = site(span.right).end_normal();
    for (std::uint32_t i = span.right; i < span.left; ++i) {
      if (!boundary_.is_smooth(i)) return false;
      const Site& next = site(i + 1);
      if (next.curvature > 0) return false;
      if (next.is_vertex()) continue;
      if (!site(span.right).is_vertex() || i > span.right) turned += turn(before, next.normal());
      before = next.end_normal();
      if (i + 1 < span.left) turned += turn(next.normal(), before);
    }
    return turned < 3;
  }
  /// The angle from one direction to another, clockwise.
  static double turn(Vec2 from, Vec2 to) { return std::atan2(-cross(from, to), dot(from, to)); }

  void end_at_cut(const Span& span, std::uint32_t cut) {
    const Disk& disk = context_.cuts[cut].disk;
    if (coincide(chunk_.nodes[span.node], disk)) {
      chunk_.cut_ends.push_back({cut, span.node, CutEnd::no_edge});
      return;
    }
    const auto edge = static_cast<std::uint32_t>(chunk_.edges.size());
    const std::uint32_t node = add_node(disk);
    add_edge(span, node);
    chunk_.cut_ends.push_back({cut, node, edge});
  }

  bool coincide(const Disk& a, const Disk& b) const {
    return squared_norm(a.center - b.center) <= context_.tolerance * context_.tolerance &&
           std::abs(a.radius - b.radius) <= context_.tolerance;
  }

  std::uint32_t add_node(const Disk& disk) {
    chunk_.nodes.push_back(disk);
    return static_cast<std::uint32_t>(chunk_.nodes.size() - 1);
  }

  void add_edge(const Span& span, std::uint32_t to) {
    chunk_.edges.push_back({span.node, to, span.right, span.left});
  }

  /// The node of `disk`, with the edge that leads there; the old node where that edge has no
  /// length.
  std::uint32_t arrive(const Span& span, const Disk& from, const Disk& disk) {
    // A corner stays a leaf, however thin the shape is there.
    if (from.radius > 0 && coincide(from, disk)) return span.node;
    double& largest = chunk_.statistics.largest_residual;
    for (const std::uint32_t i : {span.right, span.left})
      largest = std::max(largest,
                         std::abs(geometry::carrier_distance(site(i), disk.center) - disk.radius));
    const std::uint32_t node = add_node(disk);
    add_edge(span, node);
    return node;
  }

  /// Queues two spans, the larger to be walked later, so that the stack stays as shallow as log n;
  /// large ones apart, as tasks of their own.
  void push(const Span& a, const Span& b) {
    const bool a_larger = a.left - a.right > b.left - b.right;
    const Span& larger = a_larger ? a : b;
    const Span& smaller = a_larger ? b : a;
    if (smaller.left - smaller.right >= fork_size)
      fork(larger);
    else
      stack_.push_back(larger);
    stack_.push_back(smaller);
  }

  void fork(const Span& span) {
    chunk_.children.push_back(std::make_unique<Chunk>());
    Chunk& child = *chunk_.children.back();
    child.component = chunk_.component;
    child.parent_node = span.node;
    child.nodes.push_back(chunk_.nodes[span.node]);
    tasks_.run([&context = context_, &tasks = tasks_, &child, span] {
      Walker(context, tasks, child).walk_span({span.right, span.left, 0});
    });
  }

  Hit nearest(const Disk& disk, const Span& span) {
    ++chunk_.statistics.queries;
    return context_.tree.nearest(disk.center, disk.radius - context_.tolerance, span.right + 1,
                                 span.left - 1);
  }

  /// The site that a disk around `center` really touches where the search found site i: a segment's
  /// end that is a vertex site of its own belongs to the vertex, and a vertex that cuts divide into
  /// several copies is touched by the copy in whose range of directions the centre lies.
  std::uint32_t owner(std::uint32_t i, Vec2 center, const Span& span) const {
    if (element(i) == Element::edge) {
      const double s = geometry::foot_parameter(site(i), center);
      if (s <= 0 && i - 1 > span.right && element(i - 1) == Element::vertex)
        --i;
      else if (s >= site(i).length && i + 1 < span.left && element(i + 1) == Element::vertex)
        ++i;
    }
    if (element(i) != Element::vertex || context_.cuts.empty()) return i;
    // Normals turn to the right along a vertex. A vertex with several cuts takes several steps.
    std::uint32_t copy = i;
    for (std::size_t step = 0; step <= context_.cuts.size(); ++step) {
      const Vec2 to = center - site(copy).point;
      std::uint32_t next = copy;
      if (element(copy - 1) == Element::cut && cross(cut_direction(copy, copy - 1), to) > 0)
        next = other_copy(copy - 1, copy);
      else if (element(copy + 1) == Element::cut && cross(to, cut_direction(copy, copy + 1)) > 0)
        next = other_copy(copy + 1, copy);
      if (next == copy) break;
      copy = next;
    }
    return copy > span.right && copy < span.left ? copy : i;
  }

  /// From a vertex towards the centre of the cut beside it.
  Vec2 cut_direction(std::uint32_t vertex, std::uint32_t cut) const {
    return context_.cuts[boundary_.originals[cut]].disk.center - site(vertex).point;
  }

  /// The copy of a vertex on the other side of the cut at place `cut`, next to which it stands.
  std::uint32_t other_copy(std::uint32_t cut, std::uint32_t vertex) const {
    const auto [first, second] = boundary_.cut_places[boundary_.originals[cut]];
    const bool on_hole = vertex > first && vertex < second;
    if (cut == first) return on_hole ? second - 1 : second + 1;
    return on_hole ? first + 1 : first - 1;
  }

  /// Whether a disk that reaches site i from inside touches it there: not in the end of a segment,
  /// where its neighbour would be nearer.
  bool touches(std::uint32_t i, const Disk& disk, double slack) const {
    if (std::abs(std::sqrt(geometry::squared_distance(site(i), disk.center)) - disk.radius) > slack)
      return false;
    if (site(i).is_vertex()) return true;
    const double s = geometry::carrier_parameter(site(i), disk.center);
    if (s > 0 && s < site(i).length) return true;
    // At a smooth joint both touch.
    const std::uint32_t end = s > 0 ? i : i - 1;
    return boundary_.has_arcs && element(end) == element(end + 1) && boundary_.is_smooth(end);
  }

  /// The event at which the foot leaves `right` or `left` for its neighbour, by the sites alone.
  Event local_event(const Bisector& bisector, const Disk& from, const Span& span, bool on_right) {
    const std::uint32_t own = on_right ? span.right : span.left;
    const std::uint32_t next = on_right ? own + 1 : own - 1;
    const std::uint32_t other = on_right ? span.left : span.right;
    Event event;
    if (boundary_.is_smooth(on_right ? own : next)) {
      const double low = bisector.position(from.center);
      const auto joint = disk_at_joint(span, on_right);
      if (!joint) return event;
      const double position = bisector.position(joint->disk.center);
      // On a parabola the foot's normal may turn that far only on the way back.
      if (position < low - slack(from)) return event;
      event = {on_right ? Event::Kind::pass_right : Event::Kind::pass_left, Hit::none, joint->disk,
               position};
      if (!joint->fits) event.kind = Event::Kind::far;
      return not_behind(event, from, low);
    }
    // Across a cut, the neighbour is touched as a third site.
    if (element(next) == Element::cut) {
      const std::uint32_t across = on_right ? own + 2 : own - 2;
      const bool continues_other = (on_right ? across + 1 : across - 1) == other &&
                                   boundary_.is_smooth(std::min(across, other));
      if (continues_other) return event;  // the other foot's own event
      // Another copy of what is touched already is no third site.
      const Vec2 foot = geometry::foot(site(across), from.center);
      for (const std::uint32_t touched : {span.right, span.left})
        if (distance(foot, geometry::foot(site(touched), from.center)) <
            distinct_contacts * from.radius)
          return event;
      const auto contact = contact_with(bisector, from, across, nowhere);
      return contact && reaches(*contact) ? *contact : event;
    }
    // At a convex corner too, before the foot gets to the corner: the disk there is not empty,
    // unless the corner is so flat that it touches both sides within the tolerance.
    const Vec2 foot = on_right ? site(next).point : site(own).point;
    const Vec2 normal = on_right ? site(own).end_normal() : site(own).normal();
    const Vec2 turned = on_right ? site(next).normal() : site(next).end_normal();
    const double radius = geometry::tangent_radius(foot, normal, site(other));
    const bool in_reach = radius <= context_.radius_limit;
    const double intrusion = 0.5 * radius * squared_norm(normal - turned);
    const bool flat = in_reach && intrusion <= 0.5 * context_.tolerance;
    if (!flat) {
      const auto contact = contact_with(bisector, from, next, nowhere);
      if (contact && reaches(*contact)) return *contact;
    }
    if (!in_reach) return event;
    event.kind = flat ? Event::Kind::contact : Event::Kind::far;
    event.site = next;
    event.disk = {foot + radius * normal, radius};
    event.position = bisector.position(event.disk.center);
    return event;
  }

  /// Whether a contact lies on the site itself, not only on its carrier.
  bool reaches(const Event& event) const { return reaches(event.site, event.disk); }
  bool reaches(std::uint32_t i, const Disk& disk) const {
    const double reach = disk.radius + 2 * context_.tolerance;
    return geometry::squared_distance(site(i), disk.center) <= reach * reach;
  }

  /// The disk at the smooth joint where the foot on the right or left passes on to its neighbour, if
  /// there is one. It does not fit if it is larger than the circle of an arc that it touches.
  struct JointDisk {
    Disk disk;
    bool fits = true;
  };
  std::optional<JointDisk> disk_at_joint(const Span& span, bool on_right) const {
    const std::uint32_t own = on_right ? span.right : span.left;
    const std::uint32_t next = on_right ? own + 1 : own - 1;
    const std::uint32_t other = on_right ? span.left : span.right;
    if (const auto circle = circle_of_apex(next, other)) return JointDisk{*circle};
    const auto [foot, normal] = boundary_.smooth_place(std::min(own, next));
    const double radius = geometry::tangent_radius(foot, normal, site(other));
    if (!(radius <= context_.radius_limit)) return std::nullopt;
    const double largest = std::max(site(own).curvature, site(next).curvature);
    return JointDisk{{foot + radius * normal, radius}, radius * largest <= 1 + widest_window};
  }

  /// Where the sites from `next` on to `other` are arcs of one circle that continue each other and
  /// `other` smoothly, that circle: the axis ends in its centre. Joints so near to each other would
  /// leave the disk that touches both open.
  std::optional<Disk> circle_of_apex(std::uint32_t next, std::uint32_t other) const {
    const Site& arc = site(next);
    if (!(arc.curvature > 0) || !(1 / arc.curvature <= context_.radius_limit)) return std::nullopt;
    for (std::uint32_t i = std::min(next, other); i < std::max(next, other); ++i) {
      const Site& inner = next < other ? site(i) : site(i + 1);
      if (element(i) != Element::edge || !boundary_.is_smooth(i) ||
          std::abs(inner.curvature - arc.curvature) > same_curvature * arc.curvature)
        return std::nullopt;
    }
    const double radius = 1 / arc.curvature;
    return Disk{arc.point + radius * arc.normal(), radius};
  }

  /// The contact with a site that continues one of the two smoothly: where the two meet. The three
  /// carriers would leave the place to the square root of a rounding error.
  std::optional<Event> contact_at_joint(const Bisector& bisector, const Disk& from,
                                        const Span& span, std::uint32_t third) const {
    for (const bool on_right : {true, false}) {
      const std::uint32_t own = on_right ? span.right : span.left;
      if (third != (on_right ? own + 1 : own - 1) || !boundary_.is_smooth(std::min(own, third)))
        continue;
      const auto joint = disk_at_joint(span, on_right);
      if (!joint || !joint->fits) continue;
      const Disk& disk = joint->disk;
      return not_behind({Event::Kind::contact, third, disk, bisector.position(disk.center)}, from,
                        bisector.position(from.center));
    }
    return std::nullopt;
  }

  /// The disk on the bisector that touches a third site, at or before position `high`; of several
  /// the first one ahead of `from`.
  std::optional<Event> contact_with(const Bisector& bisector, const Disk& from, std::uint32_t third,
                                    double high) {
    return contact_with(bisector, from, site(third), third, high);
  }
  std::optional<Event> contact_with(const Bisector& bisector, const Disk& from, const Site& touched,
                                    std::uint32_t third, double high) {
    ++chunk_.statistics.apollonius;
    const double low = bisector.position(from.center);
    const geometry::TangentDisks disks =
        geometry::tangent_disks(bisector.right, bisector.left, touched);
    Event best;
    double best_violation = nowhere;
    for (std::size_t i = 0; i < static_cast<std::size_t>(disks.count); ++i) {
      const Disk& disk = disks.disk[i];
      if (disk.radius > context_.radius_limit) continue;
      const double position = bisector.position(disk.center);
      const double violation = std::max({0.0, low - position, position - high});
      // Of two, the one where the disk begins to reach over the site, not where it ceases to.
      const bool better = violation != best_violation ? violation < best_violation
                                                      : closing(bisector, disk, touched) >
                                                            closing(bisector, best.disk, touched);
      if (better) {
        best_violation = violation;
        best = {Event::Kind::contact, third, disk, position};
      }
    }
    if (best_violation > slack(from)) return std::nullopt;
    polish(best, bisector, touched);
    best.position = bisector.position(best.disk.center);
    return not_behind(best, from, low);
  }

  /// An event that rounding put behind the node happens at the node.
  static Event not_behind(Event event, const Disk& from, double low) {
    if (event.position < low) {
      event.disk = from;
      event.position = low;
    }
    return event;
  }

  /// Brings a disk's residual below the tolerance: by Newton's method, and where that fails in
  /// higher precision.
  void polish(Event& event, const Bisector& bisector, const Site& third) {
    const auto error_of = [&](const Disk& disk) {
      return geometry::residual(disk, bisector.right, bisector.left, third);
    };
    const double furthest = polish_reach * event.disk.radius;
    double error = error_of(event.disk);
    const auto take_if_better = [&](const Disk& better) {
      const double better_error = error_of(better);
      if (!(better_error < error && distance(better.center, event.disk.center) <= furthest))
        return false;
      event.disk = better;
      error = better_error;
      return true;
    };
    for (int step = 0; step < 2 && error > 0.25 * context_.tolerance; ++step)
      if (!take_if_better(geometry::improve(event.disk, bisector.right, bisector.left, third)))
        break;
    if (error <= context_.tolerance) return;
    ++chunk_.statistics.precision_retries;
    Disk precise;
    if (geometry::tangent_disk_in_high_precision(bisector.right, bisector.left, third, event.disk,
                                                 precise))
      take_if_better(precise);
  }

  Event next_event(const Bisector& bisector, const Disk& from, const Span& span) {
    Event event = local_event(bisector, from, span, true);
    const Event on_left = local_event(bisector, from, span, false);
    if (on_left.position < event.position) event = on_left;
    if (event.kind == Event::Kind::none) {
      event.kind = Event::Kind::far;
      event.position = bisector.last_position(from, context_.radius_limit);
      event.disk = bisector.disk_at(event.position, from);
    }
    if (event.kind == Event::Kind::contact) {
      if (from.radius > 0 && touches(event.site, from, context_.tolerance))
        return at_node(bisector, from, event.site);
      // The only site in between is the one found.
      if (span.left - span.right == 2) return event;
    }
    return first_contact(bisector, from, span, event);
  }

  Event at_node(const Bisector& bisector, const Disk& from, std::uint32_t touched) const {
    return {Event::Kind::at_node, touched, from, bisector.position(from.center)};
  }

  /// Shortens the way to `event` until the disk there is empty: each intruder gives a disk
  /// that comes earlier.
  Event first_contact(const Bisector& bisector, const Disk& from, const Span& span, Event event) {
    Event intruded = event;
    bool look_beyond = true;
    // Every round but one that looked beyond comes earlier; rounding could make rounds repeat.
    for (int round = 0; round < most_rounds; ++round) {
      Event asked = event;
      if (event.kind == Event::Kind::contact && look_beyond) asked = beyond(bisector, event);
      const Hit hit = nearest(asked.disk, span);
      if (!hit) {
        // Only the carrier was touched, short of the site.
        if (event.kind == Event::Kind::contact && !reaches(event))
          return bracket(bisector, event.disk, span, intruded);
        // The disk at a corner, where the neighbour is too short to reach into it.
        const bool at_corner = event.kind == Event::Kind::far && event.site != Hit::none;
        if (at_corner && reaches(event)) event.kind = Event::Kind::contact;
        // A foot has left its site: events on flat corners come in doubtful order.
        if (event.kind == Event::Kind::far || !reaches(span.right, event.disk) ||
            !reaches(span.left, event.disk))
          return bracket(bisector, from, span, event);
        if (event.kind == Event::Kind::contact)
          event.site = owner(event.site, event.disk.center, span);
        return event;
      }
      const std::uint32_t intruder = owner(hit.site, asked.disk.center, span);
      if (from.radius > 0 && touches(intruder, from, context_.tolerance))
        return at_node(bisector, from, intruder);
      asked.site = intruder;
      intruded = asked;
      const std::optional<Event> earlier = contact_before(bisector, from, span, asked);
      if (!earlier || !(earlier->position < asked.position)) {
        // A disk that is empty, and touched by what is beyond it, will do.
        if (event.kind == Event::Kind::contact && look_beyond) {
          look_beyond = false;
          continue;
        }
        return bracket(bisector, from, span, asked);
      }
      look_beyond = earlier->position < event.position;
      event = *earlier;
    }
    return bracket(bisector, from, span, intruded);
  }

  /// The disk a little further, where the touched site intrudes by half of the tolerance. A flat
  /// contact leaves its position open: many neighbours on a circle are touched by one disk within
  /// the tolerance, although each three of them ask for another one. Looking from beyond finds the
  /// sites that settle the position.
  Event beyond(const Bisector& bisector, const Event& contact) const {
    const double speed = closing(bisector, contact.disk, site(contact.site));
    const double furthest = widest_window * contact.disk.radius;
    const double step = speed > 0 ? std::min(furthest, 0.5 * context_.tolerance / speed) : 0;
    Event event = contact;
    if (!(step > 0)) return event;
    const Vec2 along = bisector.tangent(contact.disk.center);
    event.disk.center = contact.disk.center + step * along;
    event.disk.radius = std::min(geometry::carrier_distance(bisector.right, event.disk.center),
                                 geometry::carrier_distance(bisector.left, event.disk.center));
    event.position = bisector.position(event.disk.center);
    return event;
  }

  /// How fast, along the walk, the disk grows over a third site.
  static double closing(const Bisector& bisector, const Disk& disk, const Site& third) {
    return dot(
        geometry::outward(bisector.right, disk.center) - geometry::outward(third, disk.center),
        bisector.tangent(disk.center));
  }

  /// The contact with the intruder of a disk, ahead of it: with its carrier, or with the nearer end
  /// if the carrier is touched beyond a vertex site or not at all.
  std::optional<Event> contact_before(const Bisector& bisector, const Disk& from, const Span& span,
                                      const Event& intruded) {
    const std::uint32_t i = intruded.site;
    const Site& segment = site(i);
    if (const auto at_joint = contact_at_joint(bisector, from, span, i)) return at_joint;
    std::optional<Event> contact = contact_with(bisector, from, i, intruded.position);
    if (segment.is_vertex() || (contact && reaches(*contact))) return contact;
    const Vec2 center = contact ? contact->disk.center : intruded.disk.center;
    const bool at_end = geometry::foot_parameter(segment, center) > 0.5 * segment.length;
    const std::uint32_t next = at_end ? i + 1 : i - 1;
    const bool is_site = next > span.right && next < span.left && element(next) == Element::vertex;
    // Beyond a smooth end the neighbour goes on.
    if (next > span.right && next < span.left && element(next) == Element::edge &&
        boundary_.is_smooth(std::min(i, next))) {
      const auto on_next = contact_with(bisector, from, next, intruded.position);
      if (on_next && reaches(*on_next)) return on_next;
    }
    // At a convex end the neighbour is nearer, and the carrier's disk comes late enough to find it.
    if (contact && !is_site) return contact;
    const Site end = geometry::make_vertex(at_end ? segment.end() : segment.point);
    const auto on_end = contact_with(bisector, from, end, is_site ? next : i, intruded.position);
    return on_end ? on_end : contact;
  }

  /// The site that keeps a disk of the bisector from being a maximal one: an intruder, or the
  /// neighbour to which a foot has passed on. None for a maximal disk.
  std::uint32_t obstacle(const Disk& disk, const Span& span) {
    if (!(disk.radius <= context_.radius_limit)) return neighbor(span, true);
    const Hit hit = nearest(disk, span);
    if (hit) return owner(hit.site, disk.center, span);
    if (!reaches(span.right, disk)) return neighbor(span, true);
    if (!reaches(span.left, disk)) return neighbor(span, false);
    return Hit::none;
  }

  /// The next site in the span after the right one or before the left one, across a cut if need be.
  std::uint32_t neighbor(const Span& span, bool of_right) const {
    if (of_right) return span.right + (element(span.right + 1) == Element::cut ? 2 : 1);
    return span.left - (element(span.left - 1) == Element::cut ? 2 : 1);
  }

  /// Where closed forms fail: halves the way from the node's disk, which is maximal, to that of
  /// `event`, which is not, until nothing is left in between. Always ends.
  Event bracket(const Bisector& bisector, const Disk& from, const Span& span, const Event& event) {
    ++chunk_.statistics.brackets;
    Event found{Event::Kind::contact, event.site, from, bisector.position(from.center)};
    if (found.site == Hit::none || found.site <= span.right || found.site >= span.left)
      found.site = neighbor(span, true);
    double high = event.position;
    for (int step = 0; step < bracket_steps; ++step) {
      const double middle = 0.5 * (found.position + high);
      if (!(found.position < middle && middle < high)) break;
      const Disk disk = bisector.disk_at(middle, from);
      const std::uint32_t site = obstacle(disk, span);
      if (site == Hit::none) {
        found.position = middle;
        found.disk = disk;
      } else {
        high = middle;
        found.site = site;
      }
    }
    Event polished = found;
    polish(polished, bisector, site(found.site));
    polished.position = bisector.position(polished.disk.center);
    const bool holds = polished.position >= bisector.position(from.center) && reaches(polished) &&
                       reaches(span.right, polished.disk) && reaches(span.left, polished.disk) &&
                       !nearest(polished.disk, span);
    return holds ? polished : found;
  }

  /// Splits the span at its node's own disk, at all sites that the disk touches, `sure` if
  /// no other: a node of high degree is found with one query. `all_around`: both ends of the span
  /// are touched in one point.
  void split_at_node(const Span& span, const Disk& disk, std::uint32_t sure,
                     bool all_around = false) {
    ++chunk_.statistics.queries;
    context_.tree.within(disk.center, disk.radius + context_.tolerance, span.right + 1,
                         span.left - 1, touched_);
    // Along the boundary the contacts go around the disk counter-clockwise. What comes out of order
    // is another copy of a vertex that was touched before.
    const Vec2 start = geometry::foot(site(span.right), disk.center) - disk.center;
    const auto angle_of = [&](std::uint32_t i) {
      const Vec2 to = geometry::foot(site(i), disk.center) - disk.center;
      const double angle = std::atan2(cross(start, to), dot(start, to));
      return angle > 0 ? angle : angle + 2 * std::acos(-1.0);
    };
    const double end_angle = all_around ? 2 * std::acos(-1.0) : angle_of(span.left);
    double angle_before = 0;
    std::uint32_t before = span.right;
    std::vector<Span> parts;
    for (const std::uint32_t hit : touched_) {
      const std::uint32_t i = owner(hit, disk.center, span);
      if (i <= before || i >= span.left || !touches(i, disk, context_.tolerance)) continue;
      const double angle = angle_of(i);
      if (angle - angle_before < distinct_contacts || end_angle - angle < distinct_contacts)
        continue;
      parts.push_back({before, i, span.node});
      before = i;
      angle_before = angle;
    }
    if (parts.empty()) {
      if (sure == Hit::none) return;
      parts.push_back({span.right, sure, span.node});
      before = sure;
    }
    parts.push_back({before, span.left, span.node});
    for (const Span& part : parts) stack_.push_back(part);
  }

  void finished(std::uint32_t sites) {
    finished_ += sites;
    if (finished_ >= 1 << 14) report_progress(false);
  }

  void report_progress(bool all) {
    if ((all || finished_ > 0) && context_.finished_sites) context_.finished_sites(finished_);
    finished_ = 0;
  }

  /// Rounding may put a disk a little behind the place where it should be; what is further behind
  /// is another solution.
  double slack(const Disk& from) const { return 4 * context_.tolerance + 1e-9 * from.radius; }

  /// Correcting a disk moves it by no more, against the radius; what is further is another
  /// solution.
  static constexpr double polish_reach = 1e-3;
  /// Longer chains are not looked at: their ends are told apart well enough.
  static constexpr std::uint32_t longest_flat_chain = 8;
  /// Of shrinking a disk by closed forms before the bracket takes over; some three are usual.
  static constexpr int most_rounds = 200;
  /// How far beyond() may look, against the radius: there the bisector is still straight.
  static constexpr double widest_window = 1e-7;
  /// Arcs of one circle: their curvatures differ by rounding at most.
  static constexpr double same_curvature = 1e-9;
  /// Contacts of one disk at a smaller angle are not told apart at a node.
  static constexpr double distinct_contacts = 1e-6;

  const WalkContext& context_;
  const Boundary& boundary_;
  tbb::task_group& tasks_;
  Chunk& chunk_;
  std::vector<Span> stack_;
  std::vector<std::uint32_t> touched_;
  std::uint64_t finished_ = 0;
};

}  // namespace

std::vector<std::unique_ptr<Chunk>> walk(const WalkContext& context) {
  std::vector<std::unique_ptr<Chunk>> chunks;
  tbb::task_group tasks;
  // Small components share a task.
  std::size_t next = 0;
  const auto& runs = context.boundary.runs;
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
    tasks.run([&context, &tasks, &chunks, &runs, begin, end = next] {
      for (std::size_t i = begin; i < end; ++i)
        Walker(context, tasks, *chunks[i]).walk_run(runs[i]);
    });
  }
  tasks.wait();
  return chunks;
}

}  // namespace medial::disks
