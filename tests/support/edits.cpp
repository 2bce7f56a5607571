#include "support/edits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/arc.h"
#include "medial/verify.h"
#include "methods/edit/parts.h"
#include "support/computed.h"
#include "support/generate_arcs.h"
#include "support/same_graph.h"

namespace medial::test {
namespace {

/// How far a disk is from touching the line or circle through a point with this unit tangent, on
/// whose left it lies.
double gap_to(const Disk& disk, Vec2 point, Vec2 tangent, double curvature) {
  const Vec2 normal = left_of(tangent), away = disk.center - point;
  return (2 * dot(normal, away) - curvature * squared_norm(away)) /
             (1 + norm(normal - curvature * away)) -
         disk.radius;
}

/// Gives edges other names where their disks touch several sites in their common end, within the
/// tolerance, so that the name of any is right: always the same one.
class Names {
 public:
  Names(const Shape& shape, const MedialAxis& axis, double tolerance)
      : axis_(axis), tolerance_(tolerance), next_(next_sites(shape, axis.sites)) {
    before_.resize(next_.size());
    for (std::uint32_t i = 0; i < next_.size(); ++i) before_[next_[i]] = i;
  }

  MedialAxis renamed() const {
    MedialAxis result = axis_;
    for (Edge& edge : result.edges)
      for (std::size_t side = 0; side < 2; ++side)
        edge.site[side] = name_of(edge, edge.site[side], edge.site[1 - side]);
    return result;
  }

 private:
  /// Of sites that continue each other, the first one's. A vertex has its own, which a neighbour's
  /// line or circle that goes on touches only near to it.
  std::uint32_t name_of(const Edge& edge, std::uint32_t site, std::uint32_t other) const {
    if (is_vertex(site)) return site;
    for (std::size_t left = next_.size(); left > 0; --left) {
      const std::uint32_t first = before_[site];  // `other`: they meet in a convex corner
      if (is_vertex(first) || first == other || !touch(edge, axis_.sites[site].start)) break;
      site = first;
    }
    const Site& own = axis_.sites[site];
    const BulgeArc arc{own.start, own.end, own.bulge};
    const auto goes_on = [&](Vec2 end, Vec2 tangent) {
      return touch(edge, end) && of_both(edge, [&](const Disk& disk) {
               return gap_to(disk, end, tangent, curvature(arc));
             });
    };
    if (is_vertex(before_[site]) && goes_on(own.start, start_tangent(arc))) return before_[site];
    if (is_vertex(next_[site]) && goes_on(own.end, end_tangent(arc))) return next_[site];
    return site;
  }

  bool is_vertex(std::uint32_t site) const { return axis_.sites[site].kind() == SiteKind::vertex; }
  template <class Gap>
  bool of_both(const Edge& edge, const Gap& gap) const {
    return std::all_of(edge.node.begin(), edge.node.end(), [&](std::uint32_t node) {
      return std::abs(gap(axis_.nodes[node].disk)) <= tolerance_;
    });
  }
  bool touch(const Edge& edge, Vec2 point) const {
    return of_both(edge,
                   [&](const Disk& disk) { return distance(disk.center, point) - disk.radius; });
  }

  const MedialAxis& axis_;
  double tolerance_;
  std::vector<std::uint32_t> next_, before_;
};

}  // namespace

std::string fault_of(const Editor& editor) {
  const Shape shape = editor.shape();
  auto expected = compute(shape, {.threads = 1});
  const MedialAxis axis = editor.axis();
  // The editor's tolerance is that of the shape when all was last computed. It decides, too, which
  // joints are sites.
  if (expected && expected->sites.size() != axis.sites.size())
    expected = edit::local_axis(shape, {.threads = 1}, axis.tolerance);
  if (!expected) return to_string(expected.error());
  const double tolerance = std::max(axis.tolerance, expected->tolerance);
  std::string different = difference(shape, axis, *expected, tolerance);
  if (!different.empty())
    different = difference(shape, Names(shape, axis, tolerance).renamed(),
                           Names(shape, *expected, tolerance).renamed(), tolerance);
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
