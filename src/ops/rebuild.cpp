#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "axis/steps.h"
#include "base/arc.h"
#include "base/compat.h"
#include "base/numbers.h"
#include "base/random.h"
#include "medial/compute.h"
#include "medial/query.h"
#include "medial/sides.h"
#include "methods/raster/disks.h"
#include "ops/half_edges.h"
#include "ops/hull_outline.h"

namespace medial {
namespace {

using ops::HalfEdge;
constexpr double pi = std::numbers::pi;

/// An axis of straight edges between places on the branches of another one, whose ends, branching
/// points and lone nodes stay.
class Thinner {
 public:
  Thinner(const MedialAxis& axis, double resolution)
      : axis_(axis), index_(axis.nodes.size(), none) {
    out_.method = axis.method;
    out_.tolerance = axis.tolerance;
    out_.resolution = resolution;
  }
  /// A place inside an edge.
  std::uint32_t add(const Disk& disk) {
    out_.nodes.push_back({disk, 0, NodeKind::site_change});
    return static_cast<std::uint32_t>(out_.nodes.size() - 1);
  }
  std::uint32_t node(std::uint32_t i) {
    if (index_[i] == none) index_[i] = add(axis_.nodes[i].disk);
    return index_[i];
  }
  void connect(std::uint32_t from, std::uint32_t to) {
    out_.edges.push_back(straight_edge(out_, from, to));
  }
  MedialAxis take() {
    const std::vector<std::uint32_t> degree = degrees_of(axis_);
    for (std::uint32_t i = 0; i < degree.size(); ++i)
      if (degree[i] == 0) node(i);
    return std::move(out_);
  }

 private:
  const MedialAxis& axis_;
  MedialAxis out_;
  std::vector<std::uint32_t> index_;  ///< of each node: the same in the result
};

/// The points of an axis that the tangents start from: along each branch about `step` apart.
MedialAxis sampled(const MedialAxis& axis, double step) {
  Thinner out(axis, step);
  for (const Branch& branch : branches(axis)) {
    double total = 0;
    std::vector<double> lengths;
    for (const Step& s : branch.steps) {
      lengths.push_back(length(axis, axis.edges[s.edge]));
      total += lengths.back();
    }
    // A closed branch needs points to be more than one.
    const double fewest = branch.from == branch.to ? 3 : 1;
    const auto pieces = static_cast<std::uint64_t>(std::max(std::round(total / step), fewest));
    std::uint32_t last = out.node(branch.from);
    std::size_t k = 0;
    double walked = 0;
    for (std::uint64_t i = 1; i < pieces; ++i) {
      const double at = total * (static_cast<double>(i) / static_cast<double>(pieces));
      while (k + 1 < lengths.size() && walked + lengths[k] < at) walked += lengths[k++];
      const Curve curve = curve_of(axis, axis.edges[branch.steps[k].edge]);
      const double along = std::clamp(at - walked, 0.0, lengths[k]);
      const double from_start = branch.steps[k].forward ? along : lengths[k] - along;
      // One of Newton's steps: places need not be exact.
      double t = lengths[k] > 0 ? from_start / lengths[k] : 0;
      const double speed = norm(curve.velocity(t));
      if (speed > 0) t = std::clamp(t + (from_start - curve.length(t)) / speed, 0.0, 1.0);
      const std::uint32_t here = out.add(curve.at(t));
      out.connect(last, here);
      last = here;
    }
    out.connect(last, out.node(branch.to));
  }
  return out.take();
}

/// The axis of pixels with fewer of them along its branches. The disks of two that are h apart and
/// touch one reflex vertex have a hull that reaches past it by h^2 / 8 r, and between two that
/// touch a boundary curved by 1 / R, R > r, as much is missed: half a pixel.
MedialAxis spaced(const MedialAxis& axis) {
  Thinner out(axis, axis.resolution);
  for (const Branch& branch : branches(axis)) {
    std::uint32_t last = branch.from;
    bool alone = branch.from == branch.to;  // a closed branch needs points to be more than one
    const auto go_to = [&](std::uint32_t node) {
      const std::uint32_t from = out.node(last);
      out.connect(from, out.node(node));
      last = node;
      alone = false;
    };
    for (std::size_t k = 0; k + 1 < branch.steps.size(); ++k) {
      const std::uint32_t here = head_of(axis, branch.steps[k]);
      const Disk &from = axis.nodes[last].disk, &to = axis.nodes[here].disk;
      const double apart = distance(from.center, to.center);
      if (alone || apart * apart >= 4 * axis.resolution * std::min(from.radius, to.radius))
        go_to(here);
    }
    go_to(branch.to);
  }
  return out.take();
}

/// How far the disks reach, about.
double extent_of(const MedialAxis& axis) {
  double size = 0;
  for (const Node& node : axis.nodes)
    size = std::max(
        {size, node.disk.radius, distance(node.disk.center, axis.nodes.front().disk.center)});
  return size;
}

/// The axis with one node for all that are joined by disks within `slack` of it: shorter ways have
/// no direction but that of rounding.
MedialAxis contracted(const MedialAxis& axis, double slack) {
  const Incidence incidence(axis);
  std::vector<std::uint32_t> order(axis.nodes.size()), waiting;
  std::iota(order.begin(), order.end(), 0U);
  ranges::stable_sort(order, std::greater<>(),
                      [&](std::uint32_t i) { return axis.nodes[i].disk.radius; });
  MedialAxis out;
  out.tolerance = axis.tolerance;
  out.resolution = axis.resolution;
  std::vector<std::uint32_t> index(axis.nodes.size(), no_site);
  for (const std::uint32_t first : order) {
    if (index[first] != no_site) continue;
    const auto here = static_cast<std::uint32_t>(out.nodes.size());
    const Disk& disk = out.nodes.emplace_back(axis.nodes[first]).disk;
    index[first] = here;
    waiting.assign(1, first);
    while (!waiting.empty()) {
      const std::uint32_t at = waiting.back();
      waiting.pop_back();
      for (const std::uint32_t e : incidence.edges(at)) {
        const std::uint32_t other = other_end(axis.edges[e], at);
        const Disk& next = axis.nodes[other].disk;
        if (index[other] != no_site || distance(next.center, disk.center) > slack ||
            std::abs(next.radius - disk.radius) > slack)
          continue;
        index[other] = here;
        waiting.push_back(other);
      }
    }
  }
  for (Edge edge : axis.edges) {
    for (std::uint32_t& node : edge.node) node = index[node];
    if (edge.node[0] != edge.node[1]) out.edges.push_back(edge);
  }
  return out;
}

/// The point on the right of a disk where its tangent is parallel to the line that touches the
/// disks `before` and `after` on the right of the way between them.
Vec2 tangent_point(const Disk& disk, const Disk& before, const Disk& after) {
  const Vec2 way = after.center - before.center;
  const double size = norm(way);
  if (!(size > 0)) return disk.center;
  const Vec2 along = (1 / size) * way;
  const double rate = std::clamp((after.radius - before.radius) / size, -1.0, 1.0);
  return disk.center - disk.radius * (rate * along + std::sqrt(1 - rate * rate) * left_of(along));
}

/// The corners of a polygon around a disk from one of its points to another, counter-clockwise,
/// without the last one. Enough of them that chords stay within 0.2% of the radius.
void add_corners(const Disk& disk, Vec2 begin, double angle, std::vector<Vec2>& points) {
  constexpr double longest = pi / 24;
  const double count = std::max(1.0, std::ceil(angle / longest));
  for (double i = 0; i < count; ++i) {
    const double turn = angle * i / count;
    points.push_back(disk.center + turned(begin - disk.center, std::cos(turn), std::sin(turn)));
  }
}

std::vector<Ring> rings_by_tangents(const MedialAxis& samples) {
  const ops::HalfEdges halves(samples);
  const Incidence incidence(samples);
  std::vector<Ring> rings;
  halves.each_walk([&](std::span<const HalfEdge> walk) {
    Ring ring;
    for (const HalfEdge half : walk) {
      const HalfEdge next = halves.next(half);
      const Disk &before = halves.disk(half, false), &here = halves.disk(half, true);
      const Disk& after = halves.disk(next, true);
      const std::size_t degree = incidence.degree(halves.to(half));
      if (degree == 2) {  // a normal point
        ring.points.push_back(tangent_point(here, before, after));
      } else if (degree == 1) {  // an end: around it, from tangent to tangent
        const Vec2 begin = tangent_point(here, before, here),
                   end = tangent_point(here, here, after);
        const double angle = left_turn(begin - here.center, end - here.center);
        if (here.radius > 0) add_corners(here, begin, angle, ring.points);
        ring.points.push_back(end);
      }  // a branching point does nothing
    }
    if (ring.points.size() >= 3) rings.push_back(std::move(ring));
  });
  for (std::uint32_t i = 0; i < samples.nodes.size(); ++i) {
    if (incidence.degree(i) > 0) continue;
    const Disk& disk = samples.nodes[i].disk;
    add_corners(disk, disk.center + Vec2{disk.radius, 0}, 2 * pi, rings.emplace_back().points);
  }
  return rings;
}

/// The ring with its arcs as chords within a distance.
Ring polygon_of(const Ring& ring, double chord) {
  if (ring.bulges.empty()) return ring;
  Ring out;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    const Vec2 start = ring.points[i], end = ring.points[i + 1 < ring.points.size() ? i + 1 : 0];
    out.points.push_back(start);
    const double bulge = ring.bulges[i];
    if (bulge == 0 || start == end) continue;
    // The sagitta of an n-th of an arc of the angle a: r (1 - cos(a / 2 n)).
    const double angle = 4 * std::atan(bulge);
    const double radius = distance(start, end) / (2 * std::sin(std::abs(angle) / 2));
    const double most = 2 * std::acos(std::max(1 - chord / radius, -1.0));
    constexpr double most_pieces = 100000;
    const double count = std::clamp(std::ceil(std::abs(angle) / most), 1.0, most_pieces);
    const Vec2 tangent = start_tangent({start, end, bulge});
    for (double k = 1; k < count; ++k) {
      const double half = angle * k / count / 2;
      const double reach = 2 * radius * std::abs(std::sin(half));
      out.points.push_back(start + reach * turned(tangent, std::cos(half), std::sin(half)));
    }
  }
  return out;
}

/// The ring without points nearer than `step` to the one before, and without spikes as thin as
/// that, where it runs back on itself.
Ring calmed(const Ring& ring, double step) {
  Ring out;
  std::vector<Vec2>& points = out.points;
  for (const Vec2 p : ring.points) {
    while (points.size() >= 2) {
      const Vec2 u = points.back() - points[points.size() - 2], v = p - points.back();
      if (dot(u, v) >= 0 || std::abs(cross(u, v)) > step * std::max(norm(u), norm(v))) break;
      points.pop_back();
    }
    if (points.empty() || distance(points.back(), p) > step) points.push_back(p);
  }
  return out;
}

/// The nodes whose disks do not lie within that of a neighbour of this kind, up to `slack`.
std::vector<std::uint32_t> uncovered(const MedialAxis& axis, double slack) {
  const Incidence incidence(axis);
  std::vector<std::uint32_t> order(axis.nodes.size()), kept;
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return axis.nodes[a].disk.radius > axis.nodes[b].disk.radius;
  });
  std::vector<bool> keeps(axis.nodes.size(), false);
  for (const std::uint32_t i : order) {
    const Disk& disk = axis.nodes[i].disk;
    bool covered = false;
    for (const std::uint32_t e : incidence.edges(i)) {
      const std::uint32_t other = other_end(axis.edges[e], i);
      const Disk& larger = axis.nodes[other].disk;
      covered = covered || (keeps[other] && distance(disk.center, larger.center) + disk.radius <=
                                                larger.radius + slack);
    }
    if (covered) continue;
    keeps[i] = true;
    kept.push_back(i);
  }
  return kept;
}

/// The shape that rings stand for by the non-zero rule, split where they cross.
Result<Shape> shape_of_crossing(std::vector<Ring>& rings, ShapeReport& report) {
  for (Ring& ring : rings) ring.role = RingRole::winding;
  return build_shape(rings, {.node_crossings = true}, &report);
}

Result<Shape> shape_of_hulls(const MedialAxis& axis, double resolution,
                             const RebuildOptions& options, RebuildReport& report) {
  const double size = extent_of(axis);
  constexpr double of_size = 1e-6, least = 5e-11;
  double chord = of_size * size;
  if (resolution > 0) chord = ops::chord_share * resolution;
  if (options.chord > 0) chord = std::min(chord, options.chord);
  chord = std::max(chord, least * size);
  if (!(chord > 0)) return Error{ErrorCode::no_area, "the disks are points", {}};
  report.medial_points = axis.nodes.size();
  // What is nearer than disks are moved by is one.
  const double near = chord / 16;
  const MedialAxis disks = contracted(axis, near);
  constexpr std::uint64_t tries = 8;
  for (std::uint64_t seed = 0;; ++seed) {
    std::vector<Ring> rings = ops::outline_of_hulls(disks, chord - near, seed);
    ShapeReport shaping;
    auto shape = shape_of_crossing(rings, shaping);
    report.crossings = shaping.crossings;
    if (shape || seed + 1 == tries) return shape;
  }
}

/// Around the outline of an exact axis, which crosses itself by rounding only.
Result<Shape> shape_of_outline(const MedialAxis& axis, const RebuildOptions& options,
                               RebuildReport& report) {
  std::vector<Ring> rings;
  for (const Contour& contour : ops::boundary_of(axis, options.corner_angle))
    rings.push_back(ops::ring_of(contour));
  if (options.chord > 0)
    for (Ring& ring : rings) ring = polygon_of(ring, options.chord);
  ShapeReport shaping;
  auto shape = build_shape(rings, {}, &shaping);
  if (!shape) shape = shape_of_crossing(rings, shaping);
  report.crossings = shaping.crossings;
  return shape;
}

void drop_thin(std::vector<Ring>& rings) {
  std::erase_if(rings, [](const Ring& ring) { return ring.points.size() < 3; });
}

Result<Shape> shape_of_tangents(const MedialAxis& axis, const RebuildOptions& options,
                                RebuildReport& report) {
  constexpr std::uint64_t usual = 1000;
  const std::uint64_t points = options.points > 0 ? options.points : usual;
  const double step = total_length(axis) / static_cast<double>(points), size = extent_of(axis);
  const bool as_it_is = axis.resolution > 0 && options.points == 0;
  constexpr double hardly = 1e-9, one_place = 1e-8, nearly_straight = 1e-6;  // of the size
  const MedialAxis all = as_it_is || !(step > 0) ? axis : sampled(axis, step);
  const MedialAxis samples = contracted(all, hardly * size);
  // Tangents of what rounding has left mean nothing; the disks are nearly one.
  if (2 * samples.nodes.size() < all.nodes.size())
    return shape_of_hulls(samples, 0, options, report);
  report.medial_points = samples.nodes.size();
  std::vector<Ring> rings = rings_by_tangents(samples);
  // Around a reflex vertex all tangents end in one place to rounding.
  for (Ring& ring : rings) ring = calmed(ring, one_place * size);
  drop_thin(rings);
  ShapeReport shaping;
  auto shape = shape_of_crossing(rings, shaping);
  // Where the boundary is nearly straight, corners of samples may run back over each other: off by
  // nearly nothing they do not.
  Random random(0);
  for (int tries = 0; !shape && tries < 4; ++tries) {
    for (Ring& ring : rings) ring = calmed(ring, nearly_straight * size);
    for (Ring& ring : rings)
      for (Vec2& p : ring.points)
        p = p + nearly_straight * size / 8 * Vec2{random.share() - 0.5, random.share() - 0.5};
    drop_thin(rings);
    shape = shape_of_crossing(rings, shaping);
  }
  report.crossings = shaping.crossings;
  return shape;
}

}  // namespace

Result<Shape> rebuild(const MedialAxis& axis, const RebuildOptions& options,
                      RebuildReport* report) {
  if (axis.nodes.empty()) return Error{ErrorCode::empty, "an axis without nodes", {}};
  if (!(options.chord >= 0))
    return Error{ErrorCode::invalid_option, "the chord must not be negative", {}};
  const bool by_outline = options.by == RebuildBy::outline;
  const bool of_pixels =
      by_outline && axis.resolution > 0 && options.points == 0 && is_of_pixels(axis.method);
  const bool by_hulls = options.by == RebuildBy::hulls || (by_outline && axis.method == "pack");
  RebuildReport own;
  const auto shape_by_options = [&] {
    if (of_pixels) return shape_of_hulls(spaced(axis), axis.resolution, options, own);
    if (by_hulls) return shape_of_hulls(axis, axis.resolution, options, own);
    if (options.by == RebuildBy::tangents || axis.resolution > 0)
      return shape_of_tangents(axis, options, own);
    return shape_of_outline(axis, options, own);
  };
  Result<Shape> shape = shape_by_options();
  if (report != nullptr) *report = own;
  return shape;
}

Result<PlacedImage> rebuild_image(const MedialAxis& axis, std::uint32_t pixels, bool y_down) {
  constexpr std::uint32_t most = 32768;
  if (pixels == 0 || pixels > most)
    return Error{ErrorCode::invalid_option, "the number of pixels is not in 1 to 32768", {}};
  if (axis.nodes.empty()) return Error{ErrorCode::empty, "an axis without nodes", {}};
  const Box box = box_of_disks(axis);
  const Vec2 low = box.low, high = box.high;
  const double size = std::max(high.x - low.x, high.y - low.y);
  if (!std::isfinite(2 * size * size))
    return Error{
        ErrorCode::unsupported, "the axis is so large that squares of lengths overflow", {}};
  const double pixel = size > 0 ? size / pixels : 1;
  const Vec2 corner = low - pixel * Vec2{1, 1};
  const auto cells = [&](double extent) {
    return static_cast<std::uint32_t>(std::ceil(extent / pixel * (1 - 1e-12))) + 2;
  };
  const std::uint32_t width = cells(high.x - low.x), height = cells(high.y - low.y);
  constexpr double slack = 0.05;  // of a pixel
  std::vector<Disk> disks;
  const auto add = [&](const Disk& disk) {
    Vec2 center = (1 / pixel) * (disk.center - corner);
    if (!y_down) center.y = height - center.y;
    disks.push_back({center, std::max(disk.radius, 0.0) / pixel});
  };
  // All of an axis lies between its disks' extremes. The curve of a forged one may leave it,
  // however far, or be no number; what lies there is not refined.
  const auto in_picture = [&](const Disk& disk) {
    const Vec2 c = disk.center;
    return low.x <= c.x && c.x <= high.x && low.y <= c.y && c.y <= high.y;
  };
  for (const std::uint32_t i : uncovered(axis, slack * pixel)) add(axis.nodes[i].disk);
  for (const Edge& edge : axis.edges) {
    // Between two disks of radius r at a distance d, d^2 / 8 r is missed.
    const auto suffice = [&](const Disk& a, const Disk& b) {
      const double radius = std::max(std::min(a.radius, b.radius), 0.0);
      return distance(a.center, b.center) <=
             std::max(pixel / 2, std::sqrt(8 * slack * pixel * radius));
    };
    const Curve curve = curve_of(axis, edge);
    const auto halve = [&](const auto& self, double t0, const Disk& a, double t1, const Disk& b,
                           int depth) -> void {
      constexpr int deepest = 24;
      if (!in_picture(a) || !in_picture(b) || suffice(a, b) || depth == deepest) return;
      const double t = 0.5 * (t0 + t1);
      const Disk middle = curve.at(t);
      add(middle);
      self(self, t0, a, t, middle, depth + 1);
      self(self, t, middle, t1, b, depth + 1);
    };
    halve(halve, 0, axis.nodes[edge.node[0]].disk, 1, axis.nodes[edge.node[1]].disk, 0);
  }
  const double x = corner.x, y = corner.y, top = y + pixel * height;
  return PlacedImage{union_of_disks(width, height, disks),
                     y_down ? PixelPlacement{x, pixel, 0, y, 0, pixel}
                            : PixelPlacement{x, pixel, 0, top, 0, -pixel}};
}

}  // namespace medial
