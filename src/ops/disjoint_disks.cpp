// The largest disjoint disks: each is the deepest disk in the shape minus the previous ones. Branch
// and bound over squares, exact and without an axis: in a square with few sites nearby, the deepest
// disk is one that touches three of them, or two at opposite points.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "axis/sites.h"
#include "base/local_frame.h"
#include "base/tolerance.h"
#include "base/twofold.h"
#include "medial/compute.h"
#include "medial/measure.h"
#include "site/apollonius.h"
#include "site/boundary_tree.h"
#include "site/joint.h"
#include "site/tangent_disk.h"

namespace medial {
namespace {

constexpr double anywhere = 8;           // above all distances in the local frame
constexpr double finest = 0x1p-50;       // local: the rounding of a centre
constexpr std::size_t few_carriers = 8;  // enough to settle a square
constexpr std::size_t few_sites = 16;    // near it; more sites have too many carriers
constexpr double root_of_2 = 1.4142135623730951;

struct Square {
  Vec2 center;
  double half = 0;  ///< of its side
  /// A bound for the distance of points of the square from its centre, with slack for contains().
  double reach() const { return root_of_2 * half * (1 + 0x1p-19) + 4 * finest; }
  bool contains(Vec2 p) const {
    const double most = half * (1 + 0x1p-20) + finest;
    return std::abs(p.x - center.x) <= most && std::abs(p.y - center.y) <= most;
  }
};

/// A shape minus the disks taken from it, in the local frame.
class Region {
 public:
  Region(const Shape& shape, const LocalFrame& frame)
      : edges_(site::edge_sites(shape, frame)),
        loop_begin_(loops(shape)),
        tolerance_(frame.scale * tolerance_for(bounding_box(shape), 0)),
        tree_(edges_, site::BoundaryTree::Chords::none) {}

  double tolerance() const { return tolerance_; }
  void take(const Disk& disk) { taken_.push_back(disk); }

  /// The largest disk around a point.
  struct Room {
    double clearance;    ///< its radius; negative outside the region
    Vec2 foot;           ///< where it touches
    double to_boundary;  ///< the distance to the shape's boundary, from either side
  };
  /// The room around c, whose distance from the shape's boundary is at most `at_most`. The
  /// clearance is a function of c with the Lipschitz constant 1. O(log n) expected, plus one step
  /// per disk taken.
  Room room(Vec2 c, double at_most) const {
    const auto hit = tree_.nearest(c, at_most * (1 + 0x1p-40) + finest);
    const double distance = std::sqrt(hit.squared_distance);
    Room room{is_inside(hit, c) ? distance : -distance, site::foot(edges_[hit.site], c), distance};
    for (const Disk& disk : taken_) {
      const double apart = medial::distance(c, disk.center), clear = apart - disk.radius;
      if (clear >= room.clearance) continue;
      room.clearance = clear;
      room.foot = disk.center + (apart > 0 ? disk.radius / apart : 0) * (c - disk.center);
    }
    return room;
  }

  /// Finds the carriers, within a distance of its centre, that disks centred in a square may touch.
  /// Returns false if there are many.
  bool carriers(const Square& square, double within, std::vector<site::Site>& found) const {
    const Vec2 c = square.center;
    found.clear();
    if (!tree_.few_within(c, within, few_sites, near_)) return false;
    for (const std::uint32_t i : near_) {
      if (faces_edge(edges_[i], square)) found.push_back(edges_[i]);
      if (is_reflex(i) && distance(edges_[i].point, c) <= within && faces_vertex(i, square))
        found.push_back(site::make_vertex(edges_[i].point));
      if (found.size() > few_carriers) return false;
    }
    for (const Disk& disk : taken_)
      if (distance(c, disk.center) - disk.radius <= within) found.push_back(circle(disk));
    return found.size() <= few_carriers;
  }

 private:
  /// The circle of a disk, with the remaining region on its left.
  static site::Site circle(const Disk& disk) {
    return {disk.center + Vec2{disk.radius, 0}, {0, -1}, disk.radius, -1 / disk.radius};
  }

  /// The edge before edge i in its loop.
  std::uint32_t before(std::uint32_t i) const {
    const auto next_loop = std::upper_bound(loop_begin_.begin(), loop_begin_.end(), i);
    return (i == *(next_loop - 1) ? *next_loop : i) - 1;
  }
  /// Whether a point of the square may have its foot on an edge.
  static bool faces_edge(const site::Site& edge, const Square& square) {
    if (edge.is_arc()) return true;
    const double s = dot(edge.direction, square.center - edge.point);
    return s >= -square.reach() && s <= edge.length + square.reach();
  }
  /// Whether a point of the square may lie between the normals of the vertex where edge i begins.
  bool faces_vertex(std::uint32_t i, const Square& square) const {
    const Vec2 d = square.center - edges_[i].point;
    return cross(edges_[before(i)].end_normal(), d) <= square.reach() &&
           cross(edges_[i].normal(), d) >= -square.reach();
  }
  /// Whether the boundary turns right where edge i begins.
  bool is_reflex(std::uint32_t i) const {
    const site::Site &a = edges_[before(i)], &b = edges_[i];
    if (!a.is_arc() && !b.is_arc()) return cross(a.direction, b.direction) < 0;
    return site::joint_of(bulge_arc(a), bulge_arc(b), tolerance_, 0) == site::Joint::reflex;
  }
  static BulgeArc bulge_arc(const site::Site& edge) {
    const double tangent = 0.5 * edge.curvature * edge.length;  // of half of its angle
    return {edge.point, edge.end(), tangent / (1 + std::sqrt(1 + tangent * tangent))};
  }

  /// Whether c, with a known nearest edge, lies inside: on the left of the edge or, if one of its
  /// ends is equally near, in the wedge of that vertex. Where loops touch, this may be the wedge of
  /// another passage through the same point.
  bool is_inside(const site::BoundaryTree::Hit& hit, Vec2 c) const {
    const site::Site& edge = edges_[hit.site];
    const double reach = std::sqrt(hit.squared_distance) * (1 + 0x1p-40) + finest;
    if (distance(edge.point, c) > reach && distance(edge.end(), c) > reach)
      return site::carrier_distance(edge, c) > 0;
    tree_.few_within(c, reach, edges_.size(), near_);
    return std::any_of(near_.begin(), near_.end(), [&](std::uint32_t i) {
      return distance(edges_[i].point, c) <= reach && is_in_wedge(i, c);
    });
  }
  /// Whether c lies in the wedge of interior at the vertex where edge i begins.
  bool is_in_wedge(std::uint32_t i, Vec2 c) const {
    const Vec2 d = c - edges_[i].point;
    const bool left_before = dot(edges_[before(i)].end_normal(), d) > 0;
    const bool left_after = dot(edges_[i].normal(), d) > 0;
    return is_reflex(i) ? left_before || left_after : left_before && left_after;
  }

  static std::vector<std::uint32_t> loops(const Shape& shape) {
    std::vector<std::uint32_t> begin = shape.loop_begin;
    if (shape.bulges.empty()) return begin;
    for (std::size_t i = 0, edges = 0; i < shape.loop_count(); ++i) {
      for (std::uint32_t k = shape.loop_begin[i]; k < shape.loop_begin[i + 1]; ++k)
        edges += std::abs(shape.bulge(k)) > site::largest_bulge ? 2 : 1;
      begin[i + 1] = static_cast<std::uint32_t>(edges);
    }
    return begin;
  }

  std::vector<site::Site> edges_;
  std::vector<std::uint32_t> loop_begin_;  ///< loop i is edges [loop_begin_[i], loop_begin_[i + 1])
  double tolerance_;                       ///< of local coordinates
  site::BoundaryTree tree_;
  std::vector<Disk> taken_;
  mutable std::vector<std::uint32_t> near_;
};

/// The deepest local maximum of the clearance in a square with these carriers. A largest disk
/// touches three carriers, or two at the ends of a diameter, or is an arc's circle.
class LocalMaxima {
 public:
  LocalMaxima(const Region& region, const Square& square, double to_boundary,
              const std::vector<site::Site>& carriers)
      : region_(region), square_(square), to_boundary_(to_boundary) {
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      if (carriers[i].curvature > 0) consider_circle(Circle(carriers[i]));
      for (std::size_t j = 0; j < i; ++j) {
        consider_diameters(carriers[i], carriers[j]);
        for (std::size_t k = 0; k < j; ++k)
          consider_tangent_disks(carriers[i], carriers[j], carriers[k]);
      }
    }
  }
  const Disk& deepest() const { return deepest_; }

 private:
  void consider_tangent_disks(const site::Site& a, const site::Site& b, const site::Site& c) {
    auto found = site::tangent_disks(a, b, c);
    const double tolerance = region_.tolerance();
    std::uint64_t in_high_precision = 0;
    for (std::size_t i = 0; i < found.count; ++i) {
      Disk& disk = found.disk[i];
      if (distance(disk.center, square_.center) > 2 * square_.reach()) continue;
      site::polish(disk, a, b, c, 0.25 * tolerance, tolerance, in_high_precision);
      consider(disk);
    }
  }

  void consider(const Disk& disk) {
    if (!(disk.radius > deepest_.radius) || !square_.contains(disk.center)) return;
    const double clear = region_.room(disk.center, to_boundary_).clearance;
    if (clear > deepest_.radius) deepest_ = {disk.center, clear};
  }

  /// In twofold precision, because the centre of an almost straight arc is far away.
  using Place = site::apollonius::Vector<Twofold>;
  static Place exact(Vec2 p) { return {p.x, p.y}; }
  static Place unit_normal(const site::Site& site) {
    const Place normal = exact(site.normal());
    return (Twofold(1) / sqrt(dot(normal, normal))) * normal;
  }
  /// The circle of an arc, or a vertex.
  struct Circle {
    Place center;
    Twofold radius = 0;
    explicit Circle(const site::Site& site) : center(exact(site.point)) {
      if (site.is_vertex()) return;
      const Twofold signed_radius = Twofold(1) / Twofold(site.curvature);
      center = center + signed_radius * unit_normal(site);
      radius = site.curvature > 0 ? signed_radius : -signed_radius;
    }
  };

  void consider(const Place& center, const Twofold& radius) {
    const double r(radius);
    consider({{double(center.x), double(center.y)}, std::abs(r)});
  }
  void consider_circle(const Circle& circle) { consider(circle.center, circle.radius); }

  /// Considers the disks whose diameter is a common normal of two carriers, unless both are lines;
  /// then a disk that touches a third carrier, too, is equally deep.
  void consider_diameters(const site::Site& a, const site::Site& b) {
    const bool a_is_line = !a.is_vertex() && !a.is_arc(), b_is_line = !b.is_vertex() && !b.is_arc();
    if (a_is_line && b_is_line) return;
    if (a_is_line) return consider_diameters(b, a);
    const Circle first(a);
    if (b_is_line) {
      const Place normal = unit_normal(b);
      consider_along(first, normal, -dot(normal, first.center - exact(b.point)), 0);
      return;
    }
    const Circle second(b);
    const Place to = second.center - first.center;
    const Twofold apart = sqrt(dot(to, to));
    if (double(apart) <= finest) return consider_ring(first, second);
    consider_along(first, (Twofold(1) / apart) * to, apart, second.radius);
  }

  /// Considers the disks between points of two circles on the line of their centres.
  void consider_along(const Circle& first, const Place& along, const Twofold& apart,
                      const Twofold& second_radius) {
    for (const Twofold& p : {first.radius, -first.radius})
      for (const Twofold& q : {apart + second_radius, apart - second_radius})
        consider(first.center + (Twofold(0.5) * (p + q)) * along, Twofold(0.5) * (p - q));
  }

  /// Considers the disks between two concentric circles, which are all equally deep: one that
  /// touches a third carrier, too, or one centred where the circle of centres leaves the square or,
  /// if it does not leave it, anywhere.
  void consider_ring(const Circle& first, const Circle& second) {
    const Place& middle = first.center;
    for (const Twofold& other : {second.radius, -second.radius}) {
      const Twofold ring = Twofold(0.5) * (first.radius + other);
      const Twofold radius = Twofold(0.5) * (first.radius - other);
      consider(middle + Place{ring, 0}, radius);
      for (const double side : {-square_.half, square_.half}) {
        const Place off = exact(square_.center + Vec2{side, side}) - middle;
        // NaN if the circle does not meet the side; consider() ignores that.
        const Twofold x = sqrt(ring * ring - off.y * off.y), y = sqrt(ring * ring - off.x * off.x);
        for (const double sign : {-1.0, 1.0}) {
          consider(middle + Place{Twofold(sign) * x, off.y}, radius);
          consider(middle + Place{off.x, Twofold(sign) * y}, radius);
        }
      }
    }
  }

  const Region& region_;
  const Square& square_;
  double to_boundary_;  ///< a bound of the distance of places in it
  Disk deepest_;
};

/// The state of a square.
struct Candidate {
  Square square;
  double bound = 0;                            ///< of the clearance in it
  double to_boundary = 0;                      ///< of the distance of its places from it, a bound
  std::optional<Disk> deepest = std::nullopt;  ///< of the local maxima in it, once settled
  std::uint32_t quarters = 0;                  ///< the first of its four, once divided
  std::uint32_t version = 0;                   ///< of this state

  double priority() const { return deepest ? deepest->radius : bound; }
};

class Search {
 public:
  /// `most`: squares for the first disk.
  Search(Region& region, const Box& box, double smallest, std::size_t most)
      : region_(region), smallest_(std::max(smallest, finest)), most_(most) {
    const Vec2 size = box.high - box.low;
    add({0.5 * (box.low + box.high), 0.5 * std::max(size.x, size.y)}, anywhere, anywhere);
  }

  /// Returns and takes the deepest disk of the remaining region; none if is_lost(). O(log n)
  /// expected for each square examined; only squares near taken disks are examined again.
  std::optional<Disk> next() {
    while (!heap_.empty() && heap_.front().priority >= smallest_ && !is_lost()) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Entry top = heap_.back();
      heap_.pop_back();
      const Candidate& candidate = candidates_[top.candidate];
      if (candidate.version != top.version) continue;
      if (candidate.deepest) {
        const Disk disk = *candidate.deepest;
        take(disk);
        return disk;
      }
      settle_or_divide(top.candidate);
    }
    return std::nullopt;
  }

  /// Whether, before the first disk, so many squares nearly tie that the axis would be faster.
  bool is_lost() const { return candidates_.size() > most_; }
  /// Removes the limit on the number of squares.
  void persist() { most_ = std::numeric_limits<std::size_t>::max(); }
  void take(const Disk& disk) {
    persist();
    region_.take(disk);
    unsettle(0, disk);
  }

 private:
  struct Entry {
    double priority;
    std::uint32_t candidate;  ///< the lowest one first if bounds are equal
    std::uint32_t version;

    bool operator<(const Entry& other) const {
      return priority != other.priority ? priority < other.priority : candidate > other.candidate;
    }
  };

  void push(std::uint32_t i) {
    const Candidate& candidate = candidates_[i];
    if (!(candidate.bound >= smallest_)) return;
    heap_.push_back({candidate.priority(), i, candidate.version});
    std::push_heap(heap_.begin(), heap_.end());
  }
  void add(const Square& square, double bound, double to_boundary) {
    candidates_.push_back({square, bound, to_boundary});
    push(static_cast<std::uint32_t>(candidates_.size() - 1));
  }
  void settle(std::uint32_t i, double bound, const Disk& deepest) {
    candidates_[i].bound = bound;
    candidates_[i].deepest = deepest;
    push(i);
  }

  /// Invalidates the local maxima of squares near a disk that has been taken.
  void unsettle(std::uint32_t i, const Disk& disk) {
    Candidate& candidate = candidates_[i];
    const double apart = distance(disk.center, candidate.square.center) - disk.radius;
    if (apart > candidate.bound + candidate.square.reach()) return;
    if (candidate.quarters > 0) {
      for (std::uint32_t k = 0; k < 4; ++k) unsettle(candidate.quarters + k, disk);
    } else if (candidate.deepest) {
      candidate.deepest.reset();
      ++candidate.version;
      push(i);
    }
  }

  void settle_or_divide(std::uint32_t i) {
    const Square square = candidates_[i].square;
    const auto [clearance, foot, distance] =
        region_.room(square.center, candidates_[i].to_boundary);
    const double to_boundary = distance + square.reach();
    double bound = std::min(candidates_[i].bound, clearance + square.reach());
    if (square.half <= finest) return settle(i, bound, {square.center, clearance});
    const bool is_small = clearance > square.reach();
    if (is_small) bound = std::min(bound, bound_by_feet(square, foot, to_boundary));
    if (region_.carriers(square, clearance + 2 * square.reach(), carriers_))
      return settle(i, bound, LocalMaxima(region_, square, to_boundary, carriers_).deepest());
    candidates_[i].bound = bound;
    candidates_[i].quarters = static_cast<std::uint32_t>(candidates_.size());
    const double half = 0.5 * square.half;
    for (const double x : {-half, half})
      for (const double y : {-half, half})
        add({square.center + Vec2{x, y}, half}, bound, to_boundary);
  }

  /// No disk centred in the square contains the boundary points p and q in its interior, so its
  /// radius is at most the root mean square of the distances to them, which is largest at a corner
  /// of the square. Between two walls, this bound has a term of second order where the Lipschitz
  /// bound has one of first order.
  double bound_by_feet(const Square& square, Vec2 p, double to_boundary) const {
    const Vec2 c = square.center;
    const Vec2 beyond = c + (square.reach() / distance(c, p)) * (c - p);
    const Vec2 q = region_.room(beyond, to_boundary).foot;
    const Vec2 off = c - 0.5 * (p + q);
    const Vec2 corner{std::abs(off.x) + square.half, std::abs(off.y) + square.half};
    return std::sqrt(squared_norm(corner) + 0.25 * squared_norm(p - q)) * (1 + 0x1p-50);
  }

  Region& region_;
  double smallest_;
  std::size_t most_;
  std::vector<Candidate> candidates_;  ///< a quadtree
  std::vector<Entry> heap_;
  std::vector<site::Site> carriers_;
};

std::optional<Disk> deepest_by_axis(const Shape& shape, const LocalFrame& frame) {
  const auto axis = compute(shape);
  if (!axis || axis->nodes.empty()) return std::nullopt;
  const Disk disk = deepest_disk(*axis);
  return Disk{frame.to_local(disk.center), frame.scale * disk.radius};
}

}  // namespace

std::vector<Disk> largest_disjoint_disks(const Shape& shape, std::size_t count, double least) {
  std::vector<Disk> disks;
  if (shape.points.empty()) return disks;
  const Box box = bounding_box(shape);
  const LocalFrame frame = frame_of(box);
  Region region(shape, frame);
  constexpr std::size_t squares_a_point = 16, few = 4096;
  Search search(region, {frame.to_local(box.low), frame.to_local(box.high)}, frame.scale * least,
                squares_a_point * shape.points.size() + few);
  while (disks.size() < count) {
    std::optional<Disk> disk = search.next();
    if (search.is_lost()) {
      disk = deepest_by_axis(shape, frame);
      if (!disk) {
        search.persist();
        continue;
      }
      if (disk->radius < frame.scale * least) break;
      search.take(*disk);
    }
    if (!disk) break;
    disks.push_back({frame.to_input(disk->center), frame.inverse * disk->radius});
  }
  return disks;
}

}  // namespace medial
