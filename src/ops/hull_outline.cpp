#include "ops/hull_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "axis/node_kinds.h"
#include "axis/steps.h"
#include "base/arc.h"
#include "base/compat.h"
#include "base/predicates.h"
#include "base/random.h"
#include "ops/half_edges.h"

namespace medial::ops {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// The common tangent, on the right of a half edge, of the disks at its ends. Requires that neither
/// disk contains the other.
struct Tangent {
  Vec2 normal;      ///< of length 1, out of the disks
  double rate = 0;  ///< the cosine of the angle between the normal and the way
  Vec2 begin, end;
};

Vec2 unit(Vec2 v) { return (1 / norm(v)) * v; }

Tangent tangent_of(const Disk& from, const Disk& to, Vec2 along) {
  const double length = distance(from.center, to.center), less = from.radius - to.radius;
  const double rate = std::clamp(less / length, -1.0, 1.0);
  const Vec2 normal = rate * along - std::sqrt(1 - rate * rate) * left_of(along);
  return {normal, rate, from.center + from.radius * normal, to.center + to.radius * normal};
}

/// The intersection of the interiors of two tangents.
std::optional<Vec2> crossing_of(const Tangent& a, const Tangent& b) {
  const Vec2 u = a.end - a.begin, v = b.end - b.begin, w = b.begin - a.begin;
  const double size = cross(u, v);
  const double s = cross(w, v) / size, t = cross(w, u) / size;
  if (!(s > 0 && s < 1 && t > 0 && t < 1)) return std::nullopt;
  return a.begin + s * u;
}

/// Adds the points around a disk between two normals, without both ends.
void add_arc(const Disk& disk, Vec2 normal, double angle, double chord, double most,
             std::vector<Vec2>& points) {
  constexpr double fewest = 8;  // of a whole circle
  // A disk smaller than the chord gets at most two points.
  const double pieces =
      disk.radius > chord ? std::max(std::numbers::pi / std::acos(1 - chord / disk.radius), fewest)
                          : 2;
  const double count = std::min(std::ceil(angle / turn * pieces), most);
  for (double i = 1; i < count; ++i) {
    const double here = angle * i / count;
    points.push_back(disk.center + disk.radius * turned(normal, std::cos(here), std::sin(here)));
  }
}

/// Whether the points are not all collinear.
bool has_area(const std::vector<Vec2>& points) {
  const Vec2 first = points.front();
  const auto other = ranges::find_if(points, [&](Vec2 p) { return !(p == first); });
  return other != points.end() && std::any_of(other, points.end(), [&](Vec2 p) {
           return orientation(first, *other, p) != 0;
         });
}

/// The transition of the outline from a half edge to the next one around a disk.
struct Turn {
  Tangent here, after;
  double gap = 0;  ///< from tangent to tangent, around the disk; negative where they overlap
  std::optional<Vec2> crossing;

  Turn(const Disk& disk, const Disk& before, const Disk& next, bool same_edge) {
    const Vec2 back = unit(before.center - disk.center), on = unit(next.center - disk.center);
    here = tangent_of(before, disk, -back);
    after = tangent_of(disk, next, on);
    double around = signed_angle(back, on);
    if (around <= 0 || same_edge) around += turn;
    gap = around - std::acos(-here.rate) - std::acos(after.rate);
    // Another turn around the disk would cover nothing new.
    if (gap < -turn / 2) gap += turn;
    if (gap < 0) crossing = crossing_of(here, after);
  }
  bool nearly_straight(const Disk& disk, double off) const {
    constexpr double hardly = 0.01;
    return std::abs(gap) < hardly && disk.radius * gap * gap < 8 * off;
  }
};

/// If tangents of edges around a disk overlap without crossing, gives one of the edges a separate
/// copy of the disk, which the other edges cover. Returns which nodes are such copies.
std::vector<bool> detach(MedialAxis& axis, double off) {
  struct End {
    double angle;
    std::uint32_t edge, side;
  };
  std::vector<bool> detached(axis.nodes.size(), false);
  const Incidence incidence(axis);
  std::vector<End> ends;
  const auto nodes = static_cast<std::uint32_t>(axis.nodes.size());
  for (std::uint32_t node = 0; node < nodes; ++node) {
    if (incidence.degree(node) < 2) continue;
    const Disk disk = axis.nodes[node].disk;
    const auto far = [&](const End& end) -> const Disk& {
      return axis.nodes[axis.edges[end.edge].node[1 - end.side]].disk;
    };
    ends.clear();
    for (const std::uint32_t e : incidence.edges(node)) {
      End end{0, e, axis.edges[e].node[0] == node ? 0U : 1U};
      const Vec2 way = far(end).center - disk.center;
      end.angle = std::atan2(way.y, way.x);
      ends.push_back(end);
    }
    ranges::sort(ends, {}, &End::angle);
    // Around the disk until no two neighbours overlap.
    for (std::size_t i = 0, fine = 0; ends.size() > 1 && fine < ends.size();) {
      const std::size_t k = (i + 1) % ends.size();
      const Disk &before = far(ends[i]), &next = far(ends[k]);
      const Turn turning(disk, before, next, false);
      if (turning.gap >= 0 || turning.crossing || turning.nearly_straight(disk, off)) {
        i = k;
        ++fine;
        continue;
      }
      const auto reach = [&](const Disk& other) {
        return distance(disk.center, other.center) + other.radius;
      };
      const std::size_t shorter = reach(before) < reach(next) ? i : k;
      axis.edges[ends[shorter].edge].node[ends[shorter].side] =
          static_cast<std::uint32_t>(axis.nodes.size());
      axis.nodes.push_back(axis.nodes[node]);
      detached.push_back(true);
      ends.erase(ends.begin() + static_cast<std::ptrdiff_t>(shorter));
      if (shorter == i) {
        i = (i + ends.size() - 1) % ends.size();
        fine -= std::min<std::size_t>(fine, 1);
      } else if (shorter < i) {
        --i;
      }
      fine = std::min(fine, ends.size() - 1);
    }
  }
  return detached;
}

/// The nodes, moved at random by less than `off`: disks in whole numbers have tangents that lie on
/// each other. Without double edges, and edges whose hull is the larger of their disks.
MedialAxis in_general_position(const MedialAxis& whole, double off, Random& random) {
  MedialAxis axis;
  axis.nodes = whole.nodes;
  for (Node& node : axis.nodes) {
    node.disk.center = node.disk.center + off * Vec2{random.share() - 0.5, random.share() - 0.5};
    node.disk.radius += off / 2 * random.share();
  }
  for (Edge edge : whole.edges) {
    if (edge.node[0] > edge.node[1]) std::swap(edge.node[0], edge.node[1]);
    const Disk &a = axis.nodes[edge.node[0]].disk, &b = axis.nodes[edge.node[1]].disk;
    if (distance(a.center, b.center) > std::abs(a.radius - b.radius)) axis.edges.push_back(edge);
  }
  ranges::sort(axis.edges, {}, &Edge::node);
  const auto is_same = [](const Edge& a, const Edge& b) { return a.node == b.node; };
  axis.edges.erase(std::unique(axis.edges.begin(), axis.edges.end(), is_same), axis.edges.end());
  return axis;
}

}  // namespace

std::vector<Ring> outline_of_hulls(const MedialAxis& whole, double chord, std::uint64_t seed) {
  const double off = chord / 16;
  Random random(seed << 32);
  chord -= 3 * off;  // of moving disks, and of angles that are left out below
  MedialAxis axis = in_general_position(whole, off, random);
  // Of an edge, the hull is what its tangents and the four radii to their ends enclose, and what
  // its disks add; of a node, the edges leave gaps between their tangents on its disk, whose
  // sectors cover what is not in a neighbour's. So the sum of all these parts, each of them
  // counter-clockwise, is the union. Its boundary runs along a tangent, around the gap, and on;
  // where tangents overlap instead, it goes on from where they cross.
  const double most = std::max(4096.0, 0x1p18 / static_cast<double>(axis.nodes.size()));
  const std::vector<bool> detached = detach(axis, off);
  const HalfEdges halves(axis);
  const auto add_turn = [&](HalfEdge half, std::vector<Vec2>& points) {
    const HalfEdge next = halves.next(half);
    const Disk& disk = halves.disk(half, true);
    const Turn turning(disk, halves.disk(half, false), halves.disk(next, true), next == twin(half));
    const Tangent &here = turning.here, &after = turning.after;
    if (detached[halves.to(half)]) {
      // Not all the way to the feet: others may be there, on the same line to rounding.
      const double most_way = std::sqrt(off * disk.radius);
      const auto short_of = [&](Vec2 foot, Vec2 other) {
        const double length = distance(foot, other), way = (0.5 + random.share()) * most_way;
        return length > 0 ? foot + std::min(way / length, 0.5) * (other - foot) : foot;
      };
      points.push_back(short_of(here.end, here.begin));
      points.push_back(short_of(after.begin, after.end));
    } else if (turning.nearly_straight(disk, off)) {
      const Vec2 between = here.normal + after.normal;
      points.push_back(disk.center + (disk.radius / norm(between)) * between);
    } else if (turning.gap >= 0) {
      points.push_back(here.end);
      add_arc(disk, here.normal, turning.gap, chord, most, points);
      points.push_back(after.begin);
    } else if (turning.crossing) {
      points.push_back(*turning.crossing);
    } else {
      points.insert(points.end(), {here.end, disk.center, after.begin});
    }
  };
  std::vector<Ring> rings;
  halves.each_walk([&](std::span<const HalfEdge> walk) {
    Ring ring{{}, RingRole::winding};
    for (const HalfEdge half : walk) add_turn(half, ring.points);
    if (has_area(ring.points)) rings.push_back(std::move(ring));
  });
  const std::vector<std::uint32_t> degree = degrees_of(axis);
  for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
    const Disk& disk = axis.nodes[i].disk;
    if (degree[i] > 0 || !(disk.radius > 0)) continue;
    Ring& ring = rings.emplace_back();
    ring.role = RingRole::winding;
    ring.points.push_back(disk.center + Vec2{disk.radius, 0});
    add_arc(disk, {1, 0}, turn, std::min(chord, disk.radius / 8), most, ring.points);
  }
  return rings;
}

}  // namespace medial::ops
