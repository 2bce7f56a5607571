// The largest disks without overlap: each the deepest of what those before it leave. Branch and
// bound over squares, exact without an axis: a square near which few sites lie is settled by the
// disks that touch three of these, or two in opposite points.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "axis/sites.h"
#include "base/local_frame.h"
#include "medial/measure.h"
#include "site/boundary_tree.h"
#include "site/tangent_disk.h"

namespace medial {
namespace {

constexpr double anywhere = 8;           // no two places of the local frame are further apart
constexpr double finest = 0x1p-50;       // local: the rounding of a centre
constexpr std::size_t few_carriers = 8;  // enough to settle a square
constexpr double root_of_2 = 1.4142135623730951;

struct Square {
  Vec2 center;
  double half = 0;  ///< of its side
  /// How far points of the square are from its centre, with room for contains().
  double reach() const { return root_of_2 * half * (1 + 0x1p-19) + 4 * finest; }
  bool contains(Vec2 p) const {
    return std::max(std::abs(p.x - center.x), std::abs(p.y - center.y)) <=
           half * (1 + 0x1p-20) + finest;
  }
};

/// A shape less the disks taken from it, in the local frame.
class Region {
 public:
  Region(const Shape& shape, const LocalFrame& frame)
      : edges_(site::edge_sites(shape, frame)), loop_of_(loops(shape, frame)), tree_(edges_) {}

  void take(const Disk& disk) { taken_.push_back(disk); }
  bool is_simple() const { return edges_.size() <= 4 * few_carriers; }

  /// The radius of the largest disk around c in the region; negative outside it. As a function
  /// of c it has the Lipschitz constant 1. O(log n) expected, and one step for each disk taken.
  double clearance(Vec2 c) const {
    const auto hit = tree_.nearest_lowest(c, anywhere);
    const double distance = std::sqrt(hit.squared_distance);
    double clearance = is_inside(hit, c) ? distance : -distance;
    for (const Disk& disk : taken_)
      clearance = std::min(clearance, medial::distance(c, disk.center) - disk.radius);
    return clearance;
  }

  /// The carriers that disks centred in a square may touch, within a distance of its centre; false
  /// if there are many.
  bool carriers(const Square& square, double within, std::vector<site::Site>& found) const {
    const Vec2 c = square.center;
    found.clear();
    tree_.within(c, within, 0, static_cast<std::uint32_t>(edges_.size() - 1), near_);
    for (const std::uint32_t i : near_) {
      if (faces_edge(edges_[i], square)) found.push_back(edges_[i]);
      for (const std::uint32_t k : {i, next(i)})
        if (is_reflex(k) && distance(edges_[k].point, c) <= within && faces_vertex(k, square))
          found.push_back(site::make_vertex(edges_[k].point));
      if (found.size() > few_carriers) return false;
    }
    for (const Disk& disk : taken_)
      if (distance(c, disk.center) - disk.radius <= within) found.push_back(circle(disk));
    return found.size() <= few_carriers;
  }

  /// The point of the boundary nearest to c.
  Vec2 foot(Vec2 c) const {
    const auto hit = tree_.nearest_lowest(c, anywhere);
    Vec2 nearest = site::foot(edges_[hit.site], c);
    double least = std::sqrt(hit.squared_distance);
    for (const Disk& disk : taken_) {
      const double apart = distance(c, disk.center);
      if (apart - disk.radius >= least || apart == 0) continue;
      least = apart - disk.radius;
      nearest = disk.center + (disk.radius / apart) * (c - disk.center);
    }
    return nearest;
  }

 private:
  struct LoopRange {
    std::uint32_t first, last;  ///< edges
  };

  /// The circle of a disk, with what the disk leaves on its left.
  static site::Site circle(const Disk& disk) {
    return {disk.center + Vec2{disk.radius, 0}, {0, -1}, disk.radius, -1 / disk.radius};
  }

  std::uint32_t next(std::uint32_t i) const {
    return i == loop_of_[i].last ? loop_of_[i].first : i + 1;
  }
  std::uint32_t before(std::uint32_t i) const {
    return i == loop_of_[i].first ? loop_of_[i].last : i - 1;
  }
  /// Whether a place of the square may have its foot on an edge.
  static bool faces_edge(const site::Site& edge, const Square& square) {
    if (edge.is_arc()) return true;
    const double s = dot(edge.direction, square.center - edge.point);
    return s >= -square.reach() && s <= edge.length + square.reach();
  }
  /// Whether one may lie between the normals of the vertex where edge i begins.
  bool faces_vertex(std::uint32_t i, const Square& square) const {
    const Vec2 d = square.center - edges_[i].point;
    return cross(edges_[before(i)].end_normal(), d) <= square.reach() &&
           cross(edges_[i].normal(), d) >= -square.reach();
  }
  /// Whether the boundary turns right where edge i begins.
  bool is_reflex(std::uint32_t i) const {
    return cross(edges_[before(i)].end_normal(), edges_[i].normal()) < 0;
  }

  /// Whether c, whose nearest edge is known, lies inside: on the left of the edge, or in the wedge
  /// of a vertex, where loops touch maybe that of another passage through the same point.
  bool is_inside(const site::BoundaryTree::Hit& hit, Vec2 c) const {
    const site::Site& edge = edges_[hit.site];
    const double s = site::foot_parameter(edge, c);
    if (s > 0 && s < edge.length) return site::carrier_distance(edge, c) > 0;
    const double reach = std::sqrt(hit.squared_distance) * (1 + 0x1p-40) + finest;
    tree_.within(c, reach, 0, static_cast<std::uint32_t>(edges_.size() - 1), near_);
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

  std::vector<LoopRange> loops(const Shape& shape, const LocalFrame& frame) const {
    std::vector<LoopRange> loop_of(edges_.size());
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < shape.loop_count(); ++i) {
      const site::LoopEdges loop(shape, i, frame);
      std::uint32_t count = loop.size();
      if (!shape.bulges.empty())
        for (std::uint32_t k = 0; k < loop.size(); ++k)
          count += static_cast<std::uint32_t>(loop.edge(k).count - 1);
      std::fill_n(loop_of.begin() + first, count, LoopRange{first, first + count - 1});
      first += count;
    }
    return loop_of;
  }

  std::vector<site::Site> edges_;
  std::vector<LoopRange> loop_of_;  ///< of each edge
  site::BoundaryTree tree_;
  std::vector<Disk> taken_;
  mutable std::vector<std::uint32_t> near_;
};

/// The deepest of the local maxima of the clearance in a square that these carriers explain. A
/// largest disk touches three carriers, or two in the ends of a diameter, or is an arc's circle.
class LocalMaxima {
 public:
  LocalMaxima(const Region& region, const Square& square, const std::vector<site::Site>& carriers)
      : region_(region), square_(square) {
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      if (carriers[i].curvature > 0) consider({center_of(carriers[i]), 1 / carriers[i].curvature});
      for (std::size_t j = 0; j < i; ++j) {
        consider_diameters(carriers[i], carriers[j]);
        for (std::size_t k = 0; k < j; ++k) {
          const auto found = site::tangent_disks(carriers[i], carriers[j], carriers[k]);
          for (std::size_t m = 0; m < found.count; ++m) consider(found.disk[m]);
        }
      }
    }
  }
  const Disk& deepest() const { return deepest_; }

 private:
  static Vec2 center_of(const site::Site& site) {
    return site.is_vertex() ? site.point : site.point + (1 / site.curvature) * site.normal();
  }

  void consider(const Disk& disk) {
    if (!(disk.radius > deepest_.radius) || !square_.contains(disk.center)) return;
    const double clear = region_.clearance(disk.center);
    if (clear > deepest_.radius) deepest_ = {disk.center, clear};
  }

  /// The disks whose diameter is a common normal of two carriers, unless both are lines: then one
  /// that touches a third carrier, too, is as deep.
  void consider_diameters(const site::Site& a, const site::Site& b) {
    const bool a_is_line = !a.is_vertex() && !a.is_arc(), b_is_line = !b.is_vertex() && !b.is_arc();
    if (a_is_line && b_is_line) return;
    if (a_is_line) return consider_diameters(b, a);
    const Vec2 from = center_of(a);
    Vec2 to = b_is_line ? from - site::carrier_distance(b, from) * b.normal() : center_of(b);
    if (norm(to - from) <= finest) to = square_.center;  // concentric: all normals are common ones
    const double apart = norm(to - from);
    if (apart == 0) return;
    const Vec2 along = (1 / apart) * (to - from);
    const double first = radius_of(a), second = b_is_line ? 0 : radius_of(b);
    const Vec2 end = b_is_line ? to : center_of(b);
    for (const double s : {first, -first})
      for (const double t : {second, -second}) {
        const Vec2 p = from + s * along, q = end + t * along;
        consider({0.5 * (p + q), 0.5 * distance(p, q)});
      }
  }
  static double radius_of(const site::Site& site) {
    return site.is_vertex() ? 0 : std::abs(1 / site.curvature);
  }

  const Region& region_;
  const Square& square_;
  Disk deepest_;
};

/// What is known of a square.
struct Candidate {
  Square square;
  double bound = 0;                            ///< of the clearance in it
  std::optional<Disk> deepest = std::nullopt;  ///< of the local maxima in it, once settled
  std::uint32_t quarters = 0;                  ///< the first of its four, once divided
  std::uint32_t version = 0;                   ///< of what is known

  double priority() const { return deepest ? deepest->radius : bound; }
};

class Search {
 public:
  Search(Region& region, const Box& box, double smallest)
      : region_(region), smallest_(std::max(smallest, finest)) {
    const Vec2 size = box.high - box.low;
    add({0.5 * (box.low + box.high), 0.5 * std::max(size.x, size.y)}, anywhere);
  }

  /// The deepest disk of what is left, which is then taken. O(log n) expected for each square that
  /// this looks at; only those near disks that were taken are looked at again.
  std::optional<Disk> next() {
    while (!heap_.empty() && heap_.front().priority >= smallest_) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Entry top = heap_.back();
      heap_.pop_back();
      const Candidate& candidate = candidates_[top.candidate];
      if (candidate.version != top.version) continue;
      if (candidate.deepest) {
        const Disk disk = *candidate.deepest;
        region_.take(disk);
        unsettle(0, disk);
        return disk;
      }
      settle_or_divide(top.candidate);
    }
    return std::nullopt;
  }

 private:
  struct Entry {
    double priority;
    std::uint32_t candidate;  ///< of equal ones the first goes first
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
  void add(const Square& square, double bound) {
    candidates_.push_back({square, bound});
    push(static_cast<std::uint32_t>(candidates_.size() - 1));
  }
  void settle(std::uint32_t i, double bound, const Disk& deepest) {
    candidates_[i].bound = bound;
    candidates_[i].deepest = deepest;
    push(i);
  }

  /// Squares that a disk comes near have other local maxima once it is taken.
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
    const double clearance = region_.clearance(square.center);
    double bound = std::min(candidates_[i].bound, clearance + square.reach());
    if (square.half <= finest) return settle(i, bound, {square.center, clearance});
    const bool is_small = clearance > square.reach();
    if (is_small) bound = std::min(bound, bound_by_feet(square));
    // Around larger squares lie too many sites to count, but for shapes of few edges.
    if ((is_small || region_.is_simple()) &&
        region_.carriers(square, clearance + 2 * square.reach(), carriers_))
      return settle(i, bound, LocalMaxima(region_, square, carriers_).deepest());
    candidates_[i].bound = bound;
    candidates_[i].quarters = static_cast<std::uint32_t>(candidates_.size());
    const double half = 0.5 * square.half;
    for (const double x : {-half, half})
      for (const double y : {-half, half}) add({square.center + Vec2{x, y}, half}, bound);
  }

  /// No disk centred in the square reaches beyond two points of the boundary p and q, so its radius
  /// is at most the root mean square of the distances to them: largest at a corner of the square.
  /// Between two walls that leaves a term of second order where the Lipschitz bound has one of
  /// first order.
  double bound_by_feet(const Square& square) const {
    const Vec2 c = square.center, p = region_.foot(c);
    const double apart = distance(c, p);
    const Vec2 q = region_.foot(c + (square.reach() / apart) * (c - p));
    const Vec2 off = c - 0.5 * (p + q);
    const Vec2 corner{std::abs(off.x) + square.half, std::abs(off.y) + square.half};
    return std::sqrt(squared_norm(corner) + 0.25 * squared_norm(p - q)) * (1 + 0x1p-50);
  }

  Region& region_;
  double smallest_;
  std::vector<Candidate> candidates_;  ///< a quadtree
  std::vector<Entry> heap_;
  std::vector<site::Site> carriers_;
};

}  // namespace

std::vector<Disk> largest_disjoint_disks(const Shape& shape, std::size_t count, double least) {
  std::vector<Disk> disks;
  if (shape.points.empty()) return disks;
  const Box box = bounding_box(shape);
  const LocalFrame frame = frame_of(box);
  Region region(shape, frame);
  Search search(region, {frame.to_local(box.low), frame.to_local(box.high)}, frame.scale * least);
  while (disks.size() < count) {
    const std::optional<Disk> disk = search.next();
    if (!disk) break;
    disks.push_back({frame.to_input(disk->center), frame.inverse * disk->radius});
  }
  return disks;
}

}  // namespace medial
