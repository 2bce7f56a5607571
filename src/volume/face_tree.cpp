#include "volume/face_tree.h"

#include <numeric>

#include "base/vec3.h"

namespace medial::volume {

Box3 box_of(std::span<const Vec3> points) {
  Box3 box{points[0], points[0]};
  for (const Vec3 point : points.subspan(1)) box.include(point);
  return box;
}

FaceTree::FaceTree(std::span<const Vec3> vertices, std::span<const Face> faces)
    : order_(faces.size()) {
  constexpr std::uint32_t leaf_size = 4;
  std::iota(order_.begin(), order_.end(), 0U);
  if (order_.empty()) return;
  nodes_.reserve(faces.size());
  // Twice the middle of a face's box along an axis.
  const auto middle = [&](std::uint32_t face, int axis) {
    const auto& [a, b, c] = faces[face];
    const double x = vertices[a][axis], y = vertices[b][axis], z = vertices[c][axis];
    return std::min({x, y, z}) + std::max({x, y, z});
  };
  struct Range {
    std::uint32_t begin, end;
    std::uint32_t parent;  ///< whose right child this is, or none
  };
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<Range> stack = {{0, static_cast<std::uint32_t>(order_.size()), none}};
  while (!stack.empty()) {
    const Range range = stack.back();
    stack.pop_back();
    const auto here = static_cast<std::uint32_t>(nodes_.size());
    if (range.parent != none) nodes_[range.parent].first = here;
    Node node;
    node.box = triangle_of(vertices, faces[order_[range.begin]]).box();
    for (std::uint32_t i = range.begin + 1; i < range.end; ++i)
      node.box.include(triangle_of(vertices, faces[order_[i]]).box());
    if (range.end - range.begin <= leaf_size) {
      node.first = range.begin;
      node.count = range.end - range.begin;
      nodes_.push_back(node);
      continue;
    }
    nodes_.push_back(node);
    const Vec3 size = node.box.high - node.box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = range.begin + (range.end - range.begin) / 2;
    std::nth_element(order_.begin() + range.begin, order_.begin() + half,
                     order_.begin() + range.end, [&](std::uint32_t i, std::uint32_t j) {
                       const double at_i = middle(i, axis), at_j = middle(j, axis);
                       return at_i < at_j || (at_i == at_j && i < j);
                     });
    stack.push_back({half, range.end, here});
    stack.push_back({range.begin, half, none});
  }
}

}  // namespace medial::volume
