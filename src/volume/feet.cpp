#include "volume/feet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "base/vec3.h"

namespace medial::volume {
namespace {

/// Squared distances of voxels, at least 1/4, are known to this share: the feet are off by 1e-11.
constexpr double rounding = 1e-10;

}  // namespace

FeetFinder::FeetFinder(const Grid& grid, const FaceTree& tree, bool sorted_list, double angle,
                       double tolerance)
    : tree_(tree),
      sorted_list_(sorted_list),
      cosine_(std::cos(angle * std::numbers::pi / 180)),
      sine_(std::sin(angle * std::numbers::pi / 180)),
      strong_(std::cos(std::min(1.5 * angle, 0.5 * (angle + 180)) * std::numbers::pi / 180)),
      tolerance_(tolerance),
      reach_(tolerance / (2 * std::sin(angle * std::numbers::pi / 360))) {
  triangles_.reserve(grid.faces.size());
  for (std::uint32_t face = 0; face < grid.faces.size(); ++face)
    triangles_.push_back(grid.triangle(face));
}

/// Whether a box lies within the angle around `direction` as seen from p, so that it contains no
/// second foot.
bool FeetFinder::in_cone(Vec3 p, Vec3 direction, const Box3& box) const {
  const Vec3 middle = 0.5 * (box.low + box.high) - p;
  const double radius2 = 0.25 * medial::squared_norm(box.high - box.low);
  const double distance2 = medial::squared_norm(middle);
  const double along = dot(middle, direction);
  // The ball around the box spans the angle beta, with sin(beta) = radius / distance. It is within
  // if middle and direction differ by less than angle - beta.
  if (!(radius2 < distance2 * sine_ * sine_)) return false;
  const double across = std::sqrt(radius2), reach = std::sqrt(distance2 - radius2);
  return along > cosine_ * reach + sine_ * across + rounding * (reach + across);
}

/// Calls take(node) for nodes near p first: it returns whether to look inside it. Then
/// take(face) for the faces of leaves.
template <class Take>
void FeetFinder::visit_tree(Vec3 p, Scratch& scratch, Take take) const {
  const std::vector<FaceTree::Node>& nodes = tree_.nodes();
  scratch.stack.assign(1, 0);
  while (!scratch.stack.empty()) {
    const std::uint32_t at = scratch.stack.back();
    scratch.stack.pop_back();
    const FaceTree::Node& node = nodes[at];
    const double bound = squared_distance(p, node.box);
    if (!take.node(node.box, bound)) continue;
    if (node.count > 0) {
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
        take.face(tree_.order()[k]);
      continue;
    }
    const std::uint32_t left = at + 1, right = node.first;
    const bool left_first =
        squared_distance(p, nodes[left].box) <= squared_distance(p, nodes[right].box);
    scratch.stack.push_back(left_first ? right : left);
    scratch.stack.push_back(left_first ? left : right);
  }
}

/// Gives every face its lower bound and sorts them, which is little work where the last voxel was
/// near (report, Section A.6 and Fig. 18).
void FeetFinder::sort_list(Vec3 p, Scratch& scratch) const {
  auto& list = scratch.list;
  if (list.empty()) {
    list.resize(triangles_.size());
    for (std::uint32_t f = 0; f < list.size(); ++f) list[f].face = f;
  }
  for (auto& [squared, face] : list) {
    double bound = 0;
    const auto& [a, b, c] = triangles_[face].corner;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = std::min({a[axis], b[axis], c[axis]}) - p[axis];
      const double high = p[axis] - std::max({a[axis], b[axis], c[axis]});
      bound = std::max({bound, low, high});
    }
    squared = bound * bound;
  }
  const auto less = [](const Scratch::Bound& a, const Scratch::Bound& b) {
    return a.squared < b.squared;
  };
  std::size_t moves = 8 * list.size();
  for (std::size_t i = 1; i < list.size(); ++i) {
    if (!less(list[i], list[i - 1])) continue;
    const Scratch::Bound moved = list[i];
    std::size_t to = i;
    for (; to > 0 && less(moved, list[to - 1]) && moves > 0; --to, --moves) list[to] = list[to - 1];
    list[to] = moved;
    if (moves == 0) {  // far from sorted
      std::sort(list.begin(), list.end(), less);
      return;
    }
  }
}

FeetFinder::Foot FeetFinder::nearest(Vec3 p, std::uint32_t start, bool by_tree,
                                     Scratch& scratch) const {
  struct Nearest {
    const FeetFinder& finder;
    Vec3 p;
    Scratch& scratch;
    Foot best;

    bool node(const Box3&, double bound) const {
      return bound * (1 - rounding) <= best.at.squared_distance;
    }
    void face(std::uint32_t index) {
      const Closest there = finder.closest(p, index, scratch);
      const double squared = there.squared_distance, least = best.at.squared_distance;
      if (squared < least || (squared == least && index < best.face)) best = {index, there};
    }
  };
  Nearest first{*this, p, scratch, {start, closest(p, start, scratch)}};
  if (by_tree) {
    visit_tree<Nearest&>(p, scratch, first);
  } else {
    sort_list(p, scratch);
    for (const auto& [bound, face] : scratch.list) {
      if (!first.node({}, bound)) break;
      first.face(face);
    }
  }
  return first.best;
}

Feet FeetFinder::feet(Vec3 p, std::uint32_t hint, Scratch& scratch) const {
  const bool by_tree = !sorted_list_;
  const Foot first = nearest(p, hint, by_tree, scratch);
  Feet result;
  result.radius = std::sqrt(first.at.squared_distance);
  result.foot[0] = first.at.point;
  result.face[0] = first.face;

  // Second foot, nearer than the tolerance allows.
  struct Second {
    const FeetFinder& finder;
    Vec3 p;
    Scratch& scratch;
    Vec3 direction;  ///< to the first foot, of length 1
    double radius;   ///< its distance
    double limit;    ///< squared distance
    std::uint32_t at = Voxel::no_face;
    Closest best = {};

    bool node(const Box3& box, double bound) const {
      return bound * (1 - rounding) <= limit && !finder.in_cone(p, direction, box);
    }
    void face(std::uint32_t index) {
      const Closest there = finder.closest(p, index, scratch);
      const bool better =
          at == Voxel::no_face
              ? there.squared_distance < limit
              : there.squared_distance < limit || (there.squared_distance == limit && index < at);
      if (!better) return;
      const double along = dot(there.point - p, direction);
      if (along > finder.cosine_ * std::sqrt(there.squared_distance)) return;
      const double lag = there.squared_distance - radius * radius;
      if (!(lag <= 2 * finder.reach_ * (radius - along))) return;
      best = there;
      at = index;
      limit = there.squared_distance;
    }
  };
  const double reach = result.radius + tolerance_;
  Second second{*this,        p, scratch, 1 / result.radius * (result.foot[0] - p), result.radius,
                reach * reach};
  if (by_tree) {
    visit_tree<Second&>(p, scratch, second);
  } else {
    for (const auto& [bound, face] : scratch.list) {
      if (!(bound * (1 - rounding) <= second.limit)) break;
      second.face(face);
    }
  }
  if (second.at != Voxel::no_face) {
    const double distance = std::sqrt(second.best.squared_distance);
    result.quality = distance - result.radius;
    result.foot[1] = second.best.point;
    result.face[1] = second.at;
  }
  return result;
}

FeetFinder::Ray FeetFinder::ray(Vec3 p, std::uint32_t hint, Scratch& scratch) const {
  const Foot foot = nearest(p, hint, true, scratch);
  const double length = std::sqrt(foot.at.squared_distance);
  return {foot.at.point, 1 / length * (p - foot.at.point), length, foot.face};
}

std::optional<Vec3> FeetFinder::axis_point(const Ray& ray, double largest, Scratch& scratch) const {
  const auto& [foot, up, least, first] = ray;
  double radius = largest;
  std::uint32_t face = first;
  // Each ball touches a face that the one before reaches into; the ball around p is empty.
  constexpr int most_steps = 64;
  double cosine = 1;
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 center = foot + radius * up;
    const Foot other = nearest(center, face, true, scratch);
    const double distance = std::sqrt(other.at.squared_distance);
    if (!(distance < radius * (1 - rounding))) {
      if (step == 0 || cosine > strong_) return std::nullopt;
      return center;
    }
    const Vec3 across = other.at.point - foot;
    const double smaller = squared_norm(across) / (2 * dot(up, across));
    if (!(smaller >= least && smaller < radius)) return std::nullopt;
    radius = smaller;
    face = other.face;
    cosine = 1 - 0.5 * squared_norm(across) / (radius * radius);
  }
  return std::nullopt;
}

}  // namespace medial::volume
