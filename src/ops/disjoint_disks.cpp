// The largest disks without overlap: each the deepest of what those before leave.

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/compat.h"
#include "medial/compute.h"
#include "medial/measure.h"
#include "medial/query.h"

namespace medial {
namespace {

/// A connected part of what is left, and its deepest disk.
struct LeftPart {
  std::vector<Ring> rings;
  Disk deepest;
  bool operator<(const LeftPart& other) const { return deepest.radius < other.deepest.radius; }
};

Ring circle(const Disk& disk) {
  const Vec2 east{disk.radius, 0};
  return {{disk.center + east, disk.center - east}, RingRole::any, {1, 1}};
}

/// The parts of a shape and their deepest disks.
void add_parts(const Shape& shape, const MedialAxis& axis, double smallest,
               std::priority_queue<LeftPart>& parts) {
  std::vector<LeftPart> found(shape.component_count());
  const auto consider = [&found](const Disk& disk, std::uint32_t component) {
    LeftPart& part = found[component];
    if (disk.radius > part.deepest.radius) part.deepest = disk;
  };
  for (const Node& node : axis.nodes) consider(node.disk, node.component);
  for (std::uint32_t i = 0; i < axis.edges.size(); ++i) {
    const Edge& edge = axis.edges[i];
    consider(disk_at(axis, edge, widest_place(axis, i).t), axis.nodes[edge.node[0]].component);
  }
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    LeftPart& part = found[shape.component[i]];
    if (part.deepest.radius < smallest) continue;
    part.rings.push_back(ring_of(shape, i));
    part.rings.back().role = RingRole::any;
  }
  for (LeftPart& part : found)
    if (part.deepest.radius >= smallest && !part.rings.empty()) parts.push(std::move(part));
}

/// The same of a region that may have nothing inside.
Status add_parts_of(const std::vector<Ring>& rings, double smallest,
                    std::priority_queue<LeftPart>& parts) {
  auto shape = build_shape(rings);
  if (!shape) {
    if (shape.error().code == ErrorCode::no_area || shape.error().code == ErrorCode::empty)
      return success();
    return std::move(shape).error();
  }
  const auto axis = compute(*shape);
  if (!axis) return axis.error();
  add_parts(*shape, *axis, smallest, parts);
  return success();
}

}  // namespace

Result<std::vector<Disk>> largest_disjoint_disks(const Shape& shape, std::size_t count,
                                                 double smallest, const MedialAxis* axis) {
  std::priority_queue<LeftPart> parts;
  const auto is_of_shape = [&](const Node& node) {
    return node.component < shape.component_count();
  };
  if (axis != nullptr && axis->resolution == 0 && axis->exterior == 0 &&
      ranges::all_of(axis->nodes, is_of_shape)) {
    add_parts(shape, *axis, smallest, parts);
  } else {
    const auto own = compute(shape);
    if (!own) return own.error();
    add_parts(shape, *own, smallest, parts);
  }
  std::vector<Disk> disks;
  while (disks.size() < count && !parts.empty()) {
    LeftPart part = parts.top();
    parts.pop();
    disks.push_back(part.deepest);
    part.rings.push_back(circle(part.deepest));
    if (disks.size() == count) break;
    if (Status added = add_parts_of(part.rings, smallest, parts); !added) {
      // The shape itself was fine: what the disk leaves is at fault, which touches its sides.
      Error error{ErrorCode::unsupported,
                  "this disk leaves a region that is too thin for the tolerance",
                  {}};
      if (added.error().code == ErrorCode::out_of_memory) return std::move(added).error();
      error.place.point = part.deepest.center;
      return error;
    }
  }
  return disks;
}

}  // namespace medial
