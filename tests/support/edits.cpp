#include "support/edits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "medial/verify.h"
#include "support/computed.h"
#include "support/same_graph.h"

namespace medial::test {

std::string fault_of(const Editor& editor) {
  const Shape shape = editor.shape();
  const auto expected = compute(shape, {.threads = 1});
  if (!expected) return to_string(expected.error());
  const MedialAxis axis = editor.axis();
  const std::string different = difference(shape, axis, *expected, expected->tolerance);
  if (!different.empty()) return different;
  const Certificate certificate = verify(shape, axis, {.threads = 1});
  return certificate.passed ? "" : "verify() refuses it";
}

Rings shape_to_edit(std::uint64_t seed) {
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
  const double way = distance(place, *editor.vertex(neighbour)) * random_.power_of_ten(-2, 0.5);
  const double angle = 2 * std::numbers::pi * random_.unit();
  Vec2 to = place + way * Vec2{std::cos(angle), std::sin(angle)};
  if (on_grid_) to = {std::round(to.x), std::round(to.y)};
  const auto kind = random_.integer(0, 9);
  if (kind == 1) return editor.remove(vertex);
  auto change = kind == 0   ? editor.insert(vertex, to)
                : kind == 2 ? editor.undo()
                            : editor.move(vertex, to);
  if (change) vertices = std::max(vertices, change->vertex + 1);
  return change;
}

std::optional<std::string> fault_of_edits(std::uint64_t seed, int count) {
  const auto shape = build_shape(shape_to_edit(seed));
  constexpr std::size_t largest = 200;
  if (!shape || shape->points.size() > largest) return std::nullopt;
  auto editor = Editor::make(*shape);
  if (!editor) return to_string(editor.error());
  Edits edits(seed);
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
