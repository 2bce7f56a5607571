#include "volume/feet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace medial::volume {
namespace {

/// Squared distances of voxels, at least 1/4, are known to this share: the feet are off by 1e-11.
constexpr double rounding = 1e-10;

}  // namespace

FeetFinder::FeetFinder(const Grid& grid, const FaceTree& tree, FaceSearch search, double angle,
                       double tolerance)
    : grid_(grid),
      tree_(tree),
      search_(search),
      cosine_(std::cos(angle * std::numbers::pi / 180)),
      sine_(std::sin(angle * std::numbers::pi / 180)),
      tolerance_(tolerance),
      beside_(3 * grid.faces.size()),
      around_begin_(grid.vertices.size() + 1, 0),
      around_(3 * grid.faces.size()) {
  triangles_.reserve(grid.faces.size());
  for (const Face& face : grid.faces) {
    triangles_.push_back(triangle_of(grid.vertices, face));
    for (const std::uint32_t vertex : face) ++around_begin_[vertex + 1];
  }
  for (std::size_t i = 1; i < around_begin_.size(); ++i) around_begin_[i] += around_begin_[i - 1];
  std::vector<std::uint32_t> next(around_begin_.begin(), around_begin_.end() - 1);
  for (std::uint32_t f = 0; f < grid.faces.size(); ++f)
    for (const std::uint32_t vertex : grid.faces[f]) around_[next[vertex]++] = f;
  for (std::uint32_t f = 0; f < grid.faces.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = grid.faces[f][k], to = grid.faces[f][(k + 1) % 3];
      beside_[3 * f + k] = f;
      for (std::uint32_t i = around_begin_[from]; i < around_begin_[from + 1]; ++i) {
        const Face& other = grid.faces[around_[i]];
        if (around_[i] != f && std::find(other.begin(), other.end(), to) != other.end())
          beside_[3 * f + k] = around_[i];
      }
    }
  }
}

bool FeetFinder::is_foot(Vec3 p, std::uint32_t face, const Closest& there, Scratch& scratch) const {
  const double bound = there.squared_distance * (1 - rounding);
  const auto nearer = [&](std::uint32_t other) {
    return closest(p, other, scratch).squared_distance < bound;
  };
  switch (there.feature) {
    case Feature::inside:
      return true;
    case Feature::side01:
      return !nearer(beside_[3 * face]);
    case Feature::side12:
      return !nearer(beside_[3 * face + 1]);
    case Feature::side20:
      return !nearer(beside_[3 * face + 2]);
    case Feature::corner0:
    case Feature::corner1:
    case Feature::corner2:
      break;
  }
  const std::uint32_t vertex = grid_.faces[face][static_cast<std::size_t>(there.feature)];
  for (std::uint32_t i = around_begin_[vertex]; i < around_begin_[vertex + 1]; ++i)
    if (around_[i] != face && nearer(around_[i])) return false;
  return true;
}

/// Whether all of a box lies within the angle around `direction` as seen from p: what is in there
/// is no second foot.
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

/// Calls take(node) for nodes near p first: it tells whether to look inside of it. Then take(face)
/// for the faces of leaves.
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

Feet FeetFinder::feet(Vec3 p, std::uint32_t hint, Scratch& scratch) const {
  // First foot: the lowest (squared distance, face).
  struct Nearest {
    const FeetFinder& finder;
    Vec3 p;
    Scratch& scratch;
    std::uint32_t at;
    Closest best;

    bool node(const Box3&, double bound) const {
      return bound * (1 - rounding) <= best.squared_distance;
    }
    void face(std::uint32_t index) {
      const Closest there = finder.closest(p, index, scratch);
      if (there.squared_distance < best.squared_distance ||
          (there.squared_distance == best.squared_distance && index < at)) {
        best = there;
        at = index;
      }
    }
  };
  Nearest first{*this, p, scratch, hint, closest(p, hint, scratch)};
  const bool by_tree = search_ == FaceSearch::tree;
  if (by_tree) {
    visit_tree<Nearest&>(p, scratch, first);
  } else {
    sort_list(p, scratch);
    for (const auto& [bound, face] : scratch.list) {
      if (!first.node({}, bound)) break;
      first.face(face);
    }
  }

  Feet result;
  result.radius = std::sqrt(first.best.squared_distance);
  result.foot[0] = first.best.point;
  result.face[0] = first.at;

  // Second foot, nearer than the tolerance allows.
  struct Second {
    const FeetFinder& finder;
    Vec3 p;
    Scratch& scratch;
    Vec3 direction;  ///< to the first foot, of length 1
    Vec3 first_foot;
    double limit;  ///< squared distance
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
      // With an angle of zero, feet that differ by rounding alone.
      if (medial::squared_norm(there.point - first_foot) < rounding) return;
      if (!finder.is_foot(p, index, there, scratch)) return;
      best = there;
      at = index;
      limit = there.squared_distance;
    }
  };
  const double reach = result.radius + tolerance_;
  Second second{*this,        p, scratch, 1 / result.radius * (result.foot[0] - p), result.foot[0],
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

}  // namespace medial::volume
