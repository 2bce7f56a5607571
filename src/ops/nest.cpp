// Bays paired with peninsulas, as Volkmann and St. Clair (1987, Section I) propose for nesting.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "axis/inside.h"
#include "axis/sites.h"
#include "base/convex_hull.h"
#include "base/local_frame.h"
#include "medial/compute.h"
#include "medial/features.h"
#include "medial/query.h"
#include "site/boundary_tree.h"

namespace medial {
namespace {

/// The tip of a peninsula or the bottom of a bay. Two that fit look in opposite directions.
struct BranchTip {
  Vec2 place;
  Vec2 way;          ///< out of the bay; towards the peninsula's tip
  double score = 0;  ///< how far the branch and all beyond it reach
};

/// What is asked of a shape again and again.
struct Part {
  const Shape& shape;
  double size = 0;
  std::vector<Disk> disks;  ///< that cover it except for dents below a thousandth, large ones first
  std::vector<Vec2> hull;
  std::vector<BranchTip> bays, peninsulas;
};

constexpr std::size_t most_tips = 10;
constexpr double disk_step = 0.02;  ///< from disk to disk along the axis, as a share of the size

double area_of(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return twice / 2;
}

/// The tips of the branches that reach furthest, at their shallower ends. Bays look to where a
/// branch is deep, peninsulas away from it. Branches on cycles and between them have no tip.
std::vector<BranchTip> tips_of(const MedialAxis& axis, double size, bool bays) {
  std::vector<BranchTip> tips;
  const std::vector<Branch> all = branches(axis);
  for (const BranchFeatures& one : describe(axis).branches) {
    if (!std::isfinite(one.significance)) continue;
    const Disk &base = axis.nodes[one.from].disk, &tip = axis.nodes[one.to].disk;
    // As far along the branch as its direction is to count.
    Vec2 towards = base.center;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Step& step : all[one.branch].steps) {
      const Vec2 p = disk_at(axis, axis.edges[step.edge], 0.5).center;
      const double off = std::abs(distance(p, tip.center) - 0.1 * size);
      if (off < nearest && distance(p, tip.center) > 0.02 * size) towards = p, nearest = off;
    }
    const Vec2 way = towards - tip.center;
    const double length = norm(way), reach = one.significance * base.radius;
    if (!(length > 0 && reach > 0.01 * size)) continue;
    tips.push_back({tip.center, ((bays ? 1 : -1) / length) * way, reach});
  }
  std::stable_sort(tips.begin(), tips.end(),
                   [](const BranchTip& a, const BranchTip& b) { return a.score > b.score; });
  tips.resize(std::min(tips.size(), most_tips));
  return tips;
}

Result<Part> part_of(const Shape& shape) {
  const auto inner = compute(shape);
  if (!inner) return inner.error();
  Options around;
  around.exterior = true;
  const auto outer = compute(shape, around);
  if (!outer) return outer.error();
  const Box box = bounding_box(shape);
  Part part{shape, distance(box.low, box.high), {}, {}, {}, {}};
  std::vector<Vec2> points(shape.points.begin(), shape.points.end());
  for (const Node& node : inner->nodes) part.disks.push_back(node.disk);
  for (const Edge& edge : inner->edges)
    for (const Disk& disk : sample_by_step(*inner, edge, disk_step * part.size))
      part.disks.push_back(disk);
  if (!shape.bulges.empty())  // what bulges out lies on disks
    for (const Disk& disk : part.disks)
      for (int i = 0; i < 32; ++i) {
        const double angle = 2 * std::numbers::pi * i / 32;
        points.push_back(disk.center + disk.radius * Vec2{std::cos(angle), std::sin(angle)});
      }
  std::stable_sort(part.disks.begin(), part.disks.end(),
                   [](const Disk& a, const Disk& b) { return a.radius > b.radius; });
  part.hull = convex_hull(std::move(points));
  part.bays = tips_of(*outer, part.size, true);
  part.peninsulas = tips_of(*inner, part.size, false);
  return part;
}

/// How a placement moves points.
class Motion {
 public:
  explicit Motion(const Placement& at)
      : cosine_(std::cos(at.angle)),
        sine_(std::sin(at.angle)),
        flip_(at.mirrored ? -1 : 1),
        move_(at.move) {}
  Vec2 turned(Vec2 p) const {
    p.x *= flip_;
    return {cosine_ * p.x - sine_ * p.y, sine_ * p.x + cosine_ * p.y};
  }
  Vec2 of(Vec2 p) const { return turned(p) + move_; }
  Vec2 back(Vec2 p) const {
    const Vec2 q = p - move_;
    return {flip_ * (cosine_ * q.x + sine_ * q.y), cosine_ * q.y - sine_ * q.x};
  }

 private:
  double cosine_, sine_, flip_;
  Vec2 move_;
};

std::vector<Ring> rings_at(const Shape& shape, const Placement& at) {
  const Motion motion(at);
  std::vector<Ring> rings = rings_of(shape);
  for (Ring& ring : rings) {
    for (Vec2& p : ring.points) p = motion.of(p);
    if (at.mirrored)
      for (double& bulge : ring.bulges) bulge = -bulge;
  }
  return rings;
}

/// The boundary of a shape as something to keep away from.
class Border {
 public:
  explicit Border(const Shape& shape)
      : frame_(frame_of(bounding_box(shape))),
        edges_(site::edge_sites(shape, frame_)),
        tree_(edges_),
        inside_(shape) {}

  /// Whether it comes nearer to a place than `reach`. O(log n).
  bool is_within(double reach, Vec2 p) const {
    const auto last = static_cast<std::uint32_t>(edges_.size() - 1);
    return static_cast<bool>(tree_.nearest(frame_.to_local(p), frame_.scale * reach, 0, last));
  }
  bool encloses(Vec2 p) const { return inside_.holds(p); }

 private:
  LocalFrame frame_;
  std::vector<site::Site> edges_;
  site::BoundaryTree tree_;
  Inside inside_;
};

class Nesting {
 public:
  Nesting(const Part& fixed, const Part& moving, double gap)
      : fixed_(fixed),
        moving_(moving),
        gap_(gap),
        fixed_border_(fixed.shape),
        moving_border_(moving.shape) {}

  /// The least distance between the shapes: disks tell, as their union is the shape.
  double distance_at(const Placement& at) const {
    const Motion motion(at);
    double least = std::numeric_limits<double>::infinity();
    for (const Disk& disk : moving_.disks)
      least = std::min(least, -clearance(fixed_.shape, motion.of(disk.center)) - disk.radius);
    for (const Vec2 p : fixed_.shape.points)
      least = std::min(least, -clearance(moving_.shape, motion.back(p)));
    return least;
  }

  /// Whether that is the gap at least: no disk comes nearer to the fixed border, and all are
  /// outside; and no fixed vertex lies in a dent between disks. A disk that is larger than the step
  /// from disk to disk holds its neighbours' centres, which are on its side of the border then.
  bool fits(const Placement& at) const {
    const Motion motion(at);
    const auto is_free = [&](const Disk& disk) {
      return !fixed_border_.is_within(disk.radius + gap_, motion.of(disk.center));
    };
    // What was in the way last is often so again.
    if (last_ < moving_.disks.size() && !is_free(moving_.disks[last_])) return false;
    for (std::size_t i = 0; i < moving_.disks.size(); ++i) {
      if (is_free(moving_.disks[i])) continue;
      last_ = i;
      return false;
    }
    const double dent = std::max(gap_, 0.01 * moving_.size);
    for (const Vec2 p : fixed_.shape.points) {
      const Vec2 place = motion.back(p);
      if (moving_border_.is_within(dent, place) &&
          (moving_border_.is_within(gap_, place) || moving_border_.encloses(place)))
        return false;
    }
    // The largest disk comes first, the small ones last.
    const auto is_outside = [&](const Disk& disk) {
      return !fixed_border_.encloses(motion.of(disk.center));
    };
    const auto small = std::partition_point(
        moving_.disks.begin(), moving_.disks.end(),
        [&](const Disk& disk) { return disk.radius > disk_step * moving_.size; });
    return is_outside(moving_.disks.front()) &&
           std::all_of(small, moving_.disks.end(), is_outside) && !crosses(at);
  }

  double saved_at(const Placement& at) const {
    const Motion motion(at);
    std::vector<Vec2> points = fixed_.hull;
    for (const Vec2 p : moving_.hull) points.push_back(motion.of(p));
    return area_of(fixed_.hull) + area_of(moving_.hull) - area_of(convex_hull(std::move(points)));
  }

  /// The peninsula laid into the bay, and drawn out until the shapes do not overlap.
  std::optional<Placement> start(const BranchTip& own, const BranchTip& other,
                                 bool mirrored) const {
    Placement at;
    at.mirrored = mirrored;
    const Vec2 way = Motion(at).turned(other.way);
    at.angle = std::atan2(cross(way, -own.way), dot(way, -own.way));
    at.move = own.place - Motion(at).turned(other.place);
    at.bay = own.place;
    const Vec2 first = at.move;
    const double furthest = fixed_.size + moving_.size, step = 0.02 * moving_.size;
    for (double far = 0; far < furthest; far += step) {
      at.move = first + far * own.way;
      if (fits(at)) return at;
    }
    return std::nullopt;
  }

  /// Moves and turns while that saves area, by ever smaller steps.
  void improve(Placement& at) const {
    at.saved = saved_at(at);
    for (double share = 0.08; share > 5e-4; share /= 2) {
      for (int moved = 1; moved > 0;) {
        moved = 0;
        for (const Placement& next : neighbours(at, share)) {
          const double saved = saved_at(next);
          if (!(saved > at.saved) || !fits(next)) continue;
          at = next;
          at.saved = saved;
          ++moved;
        }
      }
    }
  }

 private:
  /// Whether the borders cross, as those of two tips may between the disks, with no vertex inside
  /// the other shape. O(n log n), so asked last.
  bool crosses(const Placement& at) const {
    std::vector<Ring> rings = rings_of(fixed_.shape);
    for (Ring& ring : rings_at(moving_.shape, at)) rings.push_back(std::move(ring));
    return !build_shape(rings);
  }

  std::array<Placement, 6> neighbours(const Placement& at, double share) const {
    std::array<Placement, 6> next;
    next.fill(at);
    const double step = share * moving_.size;
    next[0].move.x += step;
    next[1].move.x -= step;
    next[2].move.y += step;
    next[3].move.y -= step;
    const Vec2 middle = Motion(at).of(moving_.disks.front().center);
    for (const std::size_t i : {4U, 5U}) {  // about the largest disk
      next[i].angle += i == 4 ? share : -share;
      next[i].move = next[i].move + middle - Motion(next[i]).of(moving_.disks.front().center);
    }
    return next;
  }

  const Part& fixed_;
  const Part& moving_;
  double gap_;
  Border fixed_border_, moving_border_;
  mutable std::size_t last_ = 0;
};

bool is_near(const Placement& a, const Placement& b, double size) {
  return a.mirrored == b.mirrored && distance(a.move, b.move) < 0.05 * size &&
         std::abs(std::remainder(a.angle - b.angle, 2 * std::numbers::pi)) < 0.05;
}

}  // namespace

Result<Shape> placed(const Shape& shape, const Placement& at) {
  return build_shape(rings_at(shape, at));
}

Result<std::vector<Placement>> nest(const Shape& fixed, const Shape& moving, double gap,
                                    bool mirror, std::size_t best) {
  if (!(gap >= 0) || !std::isfinite(gap))
    return Error{ErrorCode::invalid_option, "the gap must be finite and not negative", {}};
  const auto error_of = [](std::size_t feature, Error error) {
    error.place.feature = feature;
    return error;
  };
  for (const std::size_t i : {0U, 1U})
    if ((i == 0 ? fixed : moving).component_count() != 1)
      return error_of(i, {ErrorCode::unsupported, "only single parts can be nested", {}});
  const auto one = part_of(fixed);
  if (!one) return error_of(0, one.error());
  const auto two = part_of(moving);
  if (!two) return error_of(1, two.error());
  // Disks that are sampled leave dents.
  const Nesting nesting(*one, *two, gap + 1e-4 * std::min(one->size, two->size));
  std::vector<Placement> found;
  const auto pair = [&](const std::vector<BranchTip>& own, const std::vector<BranchTip>& other) {
    for (const BranchTip& a : own)
      for (const BranchTip& b : other)
        for (const bool mirrored : {false, true}) {
          if (mirrored && !mirror) continue;
          auto at = nesting.start(a, b, mirrored);
          if (!at) continue;
          at->saved = nesting.saved_at(*at);
          found.push_back(*at);
        }
  };
  pair(one->bays, two->peninsulas);
  pair(one->peninsulas, two->bays);
  const auto more = [](const Placement& a, const Placement& b) { return a.saved > b.saved; };
  std::stable_sort(found.begin(), found.end(), more);
  constexpr std::size_t most_improved = 12;
  found.resize(std::min(found.size(), std::max(most_improved, best)));
  for (Placement& at : found) nesting.improve(at);
  std::stable_sort(found.begin(), found.end(), more);
  std::vector<Placement> kept;
  const double size = two->size;
  for (Placement& at : found) {
    if (kept.size() == best || !(at.saved > 0)) break;
    if (std::any_of(kept.begin(), kept.end(),
                    [&](const Placement& other) { return is_near(at, other, size); }))
      continue;
    at.gap = nesting.distance_at(at);
    kept.push_back(at);
  }
  return kept;
}

}  // namespace medial
