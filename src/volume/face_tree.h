#pragma once

// A tree of boxes over triangles, for nearest triangles and for pairs that may intersect.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "medial/geometry.h"

namespace medial::volume {

struct Box3 {
  Vec3 low, high;

  void include(Vec3 p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  void include(const Box3& other) {
    include(other.low);
    include(other.high);
  }
  bool meets(const Box3& other) const {
    for (int axis = 0; axis < 3; ++axis)
      if (low[axis] > other.high[axis] || other.low[axis] > high[axis]) return false;
    return true;
  }
};

/// The smallest box around points. Requires one.
Box3 box_of(std::span<const Vec3> points);

struct Triangle {
  Vec3 corner[3];

  Box3 box() const { return box_of(corner); }
};

using Face = std::array<std::uint32_t, 3>;

inline Triangle triangle_of(std::span<const Vec3> vertices, const Face& face) {
  return {{vertices[face[0]], vertices[face[1]], vertices[face[2]]}};
}

/// The square of the distance from p to the nearest point of a box, rounded; 0 inside.
inline double squared_distance(Vec3 p, const Box3& box) {
  const double x = std::max({box.low.x - p.x, p.x - box.high.x, 0.0});
  const double y = std::max({box.low.y - p.y, p.y - box.high.y, 0.0});
  const double z = std::max({box.low.z - p.z, p.z - box.high.z, 0.0});
  return x * x + y * y + z * z;
}

/// A tree of boxes with a few faces per leaf, split at the median along the longest side.
class FaceTree {
 public:
  struct Node {
    Box3 box;
    std::uint32_t first = 0;  ///< of a leaf: of its faces in order(); else the right child
    std::uint32_t count = 0;  ///< of a leaf's faces; 0: the left child is the next node
  };

  /// O(n log n). Requires fewer than 2^31 faces.
  FaceTree(std::span<const Vec3> vertices, std::span<const Face> faces);

  const std::vector<Node>& nodes() const { return nodes_; }
  /// The faces' indices, those of each leaf together.
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// Calls take(k) for each face order()[k] of the leaves whose boxes enter(box) accepts, until it
  /// returns false. Returns whether it never did.
  template <class Enter, class Take>
  bool visit(const Enter& enter, const Take& take) const {
    // A tree of 2^31 faces split at the median has fewer levels.
    std::array<std::uint32_t, 64> stack{0};
    for (std::size_t size = 1; size > 0;) {
      const std::uint32_t at = stack[--size];
      const Node& node = nodes_[at];
      if (!enter(node.box)) continue;
      if (node.count == 0) {
        stack[size++] = node.first;
        stack[size++] = at + 1;
      }
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
        if (!take(k)) return false;
    }
    return true;
  }

  /// Calls take(i, j) for all pairs of faces i < j whose boxes meet, until it returns false.
  /// Returns whether it never did. `box_of_face` gives the box of a face by index.
  template <class BoxOfFace, class Take>
  bool each_pair(const BoxOfFace& box_of_face, const Take& take) const {
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
      const Box3 box = box_of_face(order_[i]);
      const auto take_pair = [&](std::uint32_t k) {
        // Visit each pair once, from the face that comes first in the order.
        return k <= i || !box_of_face(order_[k]).meets(box) ||
               take(std::min(order_[i], order_[k]), std::max(order_[i], order_[k]));
      };
      if (!visit([&](const Box3& other) { return other.meets(box); }, take_pair)) return false;
    }
    return true;
  }

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace medial::volume
