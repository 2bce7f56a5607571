#include "support/edits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "medial/verify.h"
#include "support/computed.h"
#include "support/generate_arcs.h"
#include "support/same_graph.h"

namespace medial::test {

std::string fault_of(const Editor& editor) {
  const Shape shape = editor.shape();
  const auto expected = compute(shape, {.threads = 1});
  if (!expected) return to_string(expected.error());
  const MedialAxis axis = editor.axis();
  // The editor's tolerance is that of the shape when all was last computed.
  const double tolerance = std::max(axis.tolerance, expected->tolerance);
  const std::string different = difference(shape, axis, *expected, tolerance);
  if (!different.empty()) return different;
  const auto passes = [&](const MedialAxis& one) {
    return verify(shape, one, {.threads = 1}).passed;
  };
  return passes(axis) || !passes(*expected) ? "" : "verify() refuses it";
}

Rings shape_to_edit(std::uint64_t seed, EditKinds kinds) {
  if (kinds == EditKinds::arcs && seed % 2 == 0) return random_arc_shape(seed).rings;
  switch (seed % 8) {
    case 0:
      return hole_grid(2 + seed % 4);
    case 1:
      return maze(60 + seed % 90, seed);
    case 2:
      return comb(3 + seed % 15);
    case 3:
      return blob(20 + seed % 50);
    default:
      return random_shape(seed).rings;
  }
}

Result<AxisChange> Edits::next(Editor& editor, std::uint32_t& vertices) {
  std::uint32_t vertex = 0;
  do vertex = static_cast<std::uint32_t>(random_.integer(0, std::int64_t{vertices} - 1));
  while (!editor.vertex(vertex));
  std::uint32_t neighbour = vertex;
  do neighbour = (neighbour + 1) % vertices;
  while (!editor.vertex(neighbour));
  const Vec2 place = *editor.vertex(vertex);
  const double length = distance(place, *editor.vertex(neighbour)) * random_.power_of_ten(-2, 0.5);
  const double angle = 2 * std::numbers::pi * random_.unit();
  const Vec2 way = length * Vec2{std::cos(angle), std::sin(angle)};
  Vec2 to = place + way;
  if (on_grid_) to = {std::round(to.x), std::round(to.y)};
  const std::int64_t last = kinds_ == EditKinds::vertices ? 9
                            : kinds_ == EditKinds::loops  ? 13
                                                          : 16;
  const auto kind = random_.integer(0, last);
  if (kind == 1) return editor.remove(vertex);
  auto change = kind == 0    ? editor.insert(vertex, to)
                : kind == 2  ? editor.undo()
                : kind < 10  ? editor.move(vertex, to)
                : kind == 13 ? insert_loop(editor)
                : kind < 13  ? of_loop(editor, vertex, to - place)
                             : editor.set_bulge(vertex, random_.unit() * 2 - 1);
  if (change)
    for (vertices = std::max(vertices, change->vertex + 1); editor.vertex(vertices);) ++vertices;
  return change;
}

/// Moves a loop more often than it removes it.
Result<AxisChange> Edits::of_loop(Editor& editor, std::uint32_t vertex, Vec2 way) {
  return random_.integer(0, 3) == 0 ? editor.remove_loop(vertex) : editor.move_loop(vertex, way);
}

/// A polygon or a circle about a disk of the axis, mostly a hole inside it; or beside the shape.
Result<AxisChange> Edits::insert_loop(Editor& editor) {
  const MedialAxis axis = editor.axis();
  const auto i = random_.integer(0, static_cast<std::int64_t>(axis.nodes.size()) - 1);
  const Disk& disk = axis.nodes[static_cast<std::size_t>(i)].disk;
  const Box box = bounding_box(editor.shape());
  const bool is_beside = random_.integer(0, 4) == 0;
  const Vec2 center =
      is_beside ? box.high + Vec2{0.1 * diagonal(box) * random_.unit(), 0} : disk.center;
  const double radius =
      (is_beside ? 0.1 * diagonal(box) : disk.radius) * random_.power_of_ten(-1, 0.1);
  Ring ring;
  if (kinds_ == EditKinds::arcs && random_.integer(0, 1) == 0) {
    ring = {{center - Vec2{radius, 0}, center + Vec2{radius, 0}}, RingRole::any, {1, 1}};
  } else {
    const auto sides = static_cast<std::size_t>(random_.integer(3, 7));
    ring = regular_polygon(sides, radius)[0];
    for (Vec2& p : ring.points) p = p + center;
  }
  if (on_grid_)
    for (Vec2& p : ring.points) p = {std::round(p.x), std::round(p.y)};
  return editor.insert_loop(ring);
}

std::optional<std::string> fault_of_edits(std::uint64_t seed, int count, EditKinds kinds) {
  const auto shape = build_shape(shape_to_edit(seed, kinds));
  constexpr std::size_t largest = 200;
  if (!shape || shape->points.size() > largest) return std::nullopt;
  auto editor = Editor::make(*shape);
  if (!editor) return to_string(editor.error());
  Edits edits(seed, kinds);
  auto vertices = static_cast<std::uint32_t>(shape->points.size());
  for (int i = 0; i < count; ++i) {
    const auto change = edits.next(*editor, vertices);
    if (!change && change.error().code == ErrorCode::internal) return to_string(change.error());
    if (!change) continue;
    if (const std::string fault = fault_of(*editor); !fault.empty())
      return "edit " + std::to_string(i) + ": " + fault;
  }
  return std::nullopt;
}

}  // namespace medial::test
