#pragma once

#include <limits>
#include <optional>

#include "methods/disks/contacts.h"
#include "site/bisector.h"

namespace medial::disks {

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
  std::uint32_t site = Contacts::Hit::none;
  Disk disk;
  double position = std::numeric_limits<double>::infinity();
  WideFlag may_grow = false;  ///< of `far`: no neighbour ends the edge

  /// What its disk touches beside a span's two sites.
  std::uint32_t touched(const Span& span) const {
    return kind == Kind::pass_right  ? span.right + 1
           : kind == Kind::pass_left ? span.left - 1
                                     : site;
  }
};

/// Finds what ends an edge of the axis: the first event on the bisector of a span's two sites after
/// the disk `from`. Refers to both.
class EventSearch {
 public:
  EventSearch(Contacts& contacts, const Span& span, const Disk& from)
      : context_(contacts.context),
        boundary_(context_.boundary),
        contacts_(contacts),
        span_(span),
        from_(from),
        bisector_(site(span.right), site(span.left)),
        low_(bisector_.position(from.center)) {}

  /// The first event that the two sites and their neighbours alone tell.
  Event by_neighbors();
  /// The event that follows from it; never `far`. `none` if closed forms do not decide, with the
  /// last disk that they had, if any.
  Event next(const Event& by_neighbors);
  Event next() { return next(by_neighbors()); }
  /// What next() makes of such an event if asked_disk() is empty, and if that is all it asks for.
  std::optional<Event> plain(const Event& by_neighbors);
  Disk asked_disk(const Event& event) const {
    return event.kind == Event::Kind::contact ? beyond(event).disk : event.disk;
  }

 private:
  /// A disk that touches a smooth joint. It does not fit if it is larger than the circle of an arc
  /// there.
  struct JointDisk {
    Disk disk;
    bool fits = true;
  };

  /// One of the two sites, its neighbour to which its foot passes on, and the other one.
  struct Side {
    std::uint32_t own, next, other;
  };
  Side side(bool on_right) const {
    return on_right ? Side{span_.right, span_.right + 1, span_.left}
                    : Side{span_.left, span_.left - 1, span_.right};
  }

  const site::Site& site(std::uint32_t i) const { return boundary_.sites[i]; }
  Element element(std::uint32_t i) const { return boundary_.elements[i]; }
  /// Whether a contact lies on the site itself, not only on its carrier, and on its inner side.
  bool reaches(const Event& event) const {
    return contacts_.reaches(event.site, event.disk) &&
           site::carrier_distance(site(event.site), event.disk.center) >= 0;
  }
  /// Rounding may put a disk a little behind the place where it should be; what is further behind
  /// is another solution.
  double slack() const {
    constexpr double tolerances = 4, of_radius = 1e-12;
    return tolerances * context_.tolerance + of_radius * from_.radius;
  }
  bool is_behind(double position) const { return position < low_ && position < low_ - slack(); }

  /// The event at which the foot leaves `right` or `left` for its neighbour, by the sites alone.
  Event local_event(bool on_right);
  /// A disk of the bisector several times as large as that, where no neighbour ends the edge; the
  /// largest, if the radius is 0. That one at once would reach across walls, over many sites past
  /// which it would have to be shrunk.
  Event far_event(double radius) const;
  Event event_at_smooth_joint(bool on_right);
  /// Across a bridge, the neighbour is touched as a third site.
  Event event_across_bridge(bool on_right);
  Event event_at_corner(bool on_right);
  /// The disk whose foot on the right or left is where a bridge ends the range of a site of a
  /// planar graph: the walk gets no further, as the bridge's disk reaches across.
  Event end_of_range(bool on_right) const;
  /// Whether the foot on the right or left meets a convex corner only after this event. Of two
  /// disks of a bisector that keep clear of a site, so do all in between.
  bool comes_later(bool on_right, const Event& event) const;
  /// The disk where the foot on the right or left passes on to its neighbour, if there is one.
  std::optional<JointDisk> disk_at_joint(bool on_right) const;
  /// Where the sites from `next` on to `other` are arcs of one circle that continue each other and
  /// `other` smoothly, that circle: the axis ends in its centre. Joints so near to each other would
  /// leave the disk that touches both open.
  std::optional<Disk> circle_of_apex(std::uint32_t next, std::uint32_t other) const;
  /// The contact with a site that continues one of the two smoothly: where the two meet. The three
  /// carriers would leave the place to the square root of a rounding error.
  std::optional<Event> contact_at_joint(std::uint32_t third) const;
  /// The disk on the bisector that touches a third site, at or before position `high`; of several
  /// the first one ahead of `from`.
  std::optional<Event> contact_with(const site::Site& touched, std::uint32_t third, double high);
  /// An event that rounding put behind the node happens at the node.
  Event not_behind(const Event& event) const {
    return event.position < low_ ? Event{event.kind, event.site, from_, low_} : event;
  }
  /// Brings a disk's residual below the tolerance: by Newton's method, and where that fails in
  /// higher precision.
  void polish(Disk& disk, const site::Site& third);
  /// What closed forms leave open: none, unless the node's disk touches the smooth neighbour of one
  /// of the two sites as well, within the tolerance. Then the foot may pass on to it at once.
  Event left_open(Event event) const;
  bool is_at_node(std::uint32_t touched) const;
  Event at_node(std::uint32_t touched) const;
  /// Shortens the way to `event` until the disk there is empty: each intruder gives a disk
  /// that comes earlier.
  Event first_contact(Event event);
  /// What the event of an empty disk comes to, if it is one.
  std::optional<Event> of_empty_disk(Event event) const;
  /// A disk on the way from an empty one to an event. Between two rows of vertices that approach
  /// each other, what intrudes most on a disk far ahead lets it come but one vertex earlier.
  Event part_of_way(double empty, const Event& event) const;
  /// Whether an event's disk is as good as a point, with sites between the two. Where edges of a
  /// planar graph meet, it touches them all, and those between reach into the disks before: closed
  /// forms cannot tell which comes first.
  bool is_in_point(const Event& event) const;
  /// The disk a little further, where the touched site intrudes by half of the tolerance. A flat
  /// contact leaves its position open: many neighbours on a circle are touched by one disk within
  /// the tolerance, although each three of them ask for another one. Looking from beyond finds the
  /// sites that settle the position.
  Event beyond(const Event& contact) const;
  /// How fast the disk grows over a third site on its way in the direction `along`.
  double closing(const Disk& disk, const site::Site& third, Vec2 along) const;
  /// A contact with the intruder of a disk that comes earlier: with its carrier, with its neighbour
  /// where the carrier is touched short of it, or with a point of it.
  std::optional<Event> contact_before(const Event& intruded);
  std::optional<Event> contact_with(std::uint32_t third, double high) {
    return contact_with(site(third), third, high);
  }

  const WalkContext& context_;
  const Boundary& boundary_;
  Contacts& contacts_;
  const Span& span_;
  const Disk& from_;
  const site::Bisector bisector_;
  const double low_;  ///< position of `from`
};

}  // namespace medial::disks
