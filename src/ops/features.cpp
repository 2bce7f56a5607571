#include "medial/features.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "axis/curve.h"
#include "axis/node_kinds.h"
#include "axis/steps.h"
#include "base/arc.h"
#include "base/disjoint_sets.h"
#include "base/memory.h"
#include "medial/query.h"
#include "medial/sides.h"
#include "ops/burn.h"
#include "ops/half_edges.h"
#include "ops/runs.h"

namespace medial {
namespace {

using ops::Fuse;
using ops::Run;
using ops::RunCutter;

/// The points at which the disks at both ends of a step touch the boundary.
struct Feet {
  std::array<Vec2, 2> left;  ///< at the step's start and end
  std::array<Vec2, 2> right;
};

/// The site on one side of a step, if the axis is exact and has sites.
const Site* site_beside(const MedialAxis& axis, const Step& step, Side side) {
  const Edge& edge = axis.edges[step.edge];
  const std::uint32_t site = edge.site[(side == Side::left) == step.forward ? 0 : 1];
  return axis.resolution == 0 && site < axis.sites.size() ? &axis.sites[site] : nullptr;
}

/// The direction in which a step begins or ends.
Vec2 tangent_at(const MedialAxis& axis, const Step& step, bool end) {
  const Vec2 tangent = jet_at(axis, axis.edges[step.edge], step.forward == end ? 1 : 0).tangent;
  return step.forward ? tangent : -tangent;
}

Feet feet_of(const MedialAxis& axis, const Step& step) {
  const bool by_sites = site_beside(axis, step, Side::left) != nullptr &&
                        site_beside(axis, step, Side::right) != nullptr;
  Feet feet;
  for (const std::size_t end : {0U, 1U}) {
    const std::uint32_t node = end == 1 ? head_of(axis, step) : tail_of(axis, step);
    const auto [first, second] =
        ops::feet_at(axis, axis.edges[step.edge], step.forward == (end == 1) ? 1 : 0,
                     axis.nodes[node].disk, by_sites);
    feet.left[end] = step.forward ? first : second;
    feet.right[end] = step.forward ? second : first;
  }
  return feet;
}

/// The part of the boundary between two feet on one site: its length, and the area between it and
/// its chord.
struct Way {
  double length = 0;
  double area = 0;
};

Way way_between(const Site* site, Vec2 from, Vec2 to) {
  const double chord = distance(from, to);
  if (site == nullptr || site->kind() != SiteKind::arc || !(chord > 0)) return {chord, 0};
  const BulgeArc whole{site->start, site->end, site->bulge};
  const BulgeArc part{from, to, partial_bulge(whole, from, to)};
  return {arc_length(chord, part.bulge), area_beside_chord(part)};
}

class Describer {
 public:
  Describer(const MedialAxis& axis, const FeatureOptions& options)
      : axis_(axis), cutter_(axis, options) {}

  AxisFeatures run() {
    find_points();
    const std::vector<Branch> all = branches(axis_);
    reserve_large(features_.branches, all.size());
    reserve_large(features_.runs, axis_.edges.size());  // hardly ever more
    for (std::uint32_t i = 0; i < all.size(); ++i) add_branch(i, all[i]);
    add_significance(all);
    add_whole();
    return std::move(features_);
  }

 private:
  void find_points() {
    degree_ = degrees_of(axis_);
    features_.points.reserve(degree_.size());
    for (const std::uint32_t d : degree_) {
      const PointKind kind = d < 2    ? PointKind::end
                             : d == 2 ? PointKind::normal
                                      : PointKind::branching;
      features_.points.push_back(kind);
      features_.ends += kind == PointKind::end ? 1 : 0;
      features_.branchings += kind == PointKind::branching ? 1 : 0;
    }
    covered_.assign(axis_.nodes.size(), 0);
  }

  /// Whether a branch must be reversed to run from its deeper end.
  bool runs_backwards(const Branch& branch) const {
    const double from = axis_.nodes[branch.from].disk.radius;
    const double to = axis_.nodes[branch.to].disk.radius;
    if (from != to) return from < to;
    return features_.points[branch.from] == PointKind::end &&
           features_.points[branch.to] == PointKind::branching;
  }

  void add_branch(std::uint32_t index, const Branch& branch) {
    BranchFeatures out;
    out.branch = index;
    out.reversed = runs_backwards(branch);
    way_.assign(branch.steps.begin(), branch.steps.end());
    if (out.reversed) reverse(way_);
    out.from = out.reversed ? branch.to : branch.from;
    out.to = out.reversed ? branch.from : branch.to;
    out.from_kind = features_.points[out.from];
    out.to_kind = features_.points[out.to];
    out.closed = out.from == out.to && out.from_kind == PointKind::normal;
    const std::span<const Run> runs = cutter_.cut(way_, out.closed);
    if (out.closed && !runs.empty()) start_at(runs.front().from.edge, out);
    out.length = cutter_.length();
    out.smallest_radius = cutter_.smallest_radius();
    for (const Step& step : way_)
      for (const std::uint32_t node : axis_.edges[step.edge].node)
        out.largest_radius = std::max(out.largest_radius, axis_.nodes[node].disk.radius);
    out.mean_width = out.length > 0 ? 2 * cutter_.radius_integral() / out.length
                                    : 2 * axis_.nodes[out.from].disk.radius;
    out.turning = cutter_.turning();
    out.absolute_turning = cutter_.bending();
    out.first_run = static_cast<std::uint32_t>(features_.runs.size());
    out.run_count = static_cast<std::uint32_t>(runs.size());
    for (const Run& run : runs) add_run(run);
    add_sides(out);
    features_.closed_branches += out.closed ? 1 : 0;
    radius_integral_ += cutter_.radius_integral();
    features_.branches.push_back(out);
  }

  /// Makes a closed branch start with this edge.
  void start_at(std::uint32_t edge, BranchFeatures& out) {
    const auto first = std::find_if(way_.begin(), way_.end(),
                                    [edge](const Step& step) { return step.edge == edge; });
    std::rotate(way_.begin(), first, way_.end());
    out.from = out.to = tail_of(axis_, way_.front());
  }

  AxisPlace place_of(const EdgePlace& place) const {
    return {place, disk_at(axis_, axis_.edges[place.edge], place.t)};
  }

  void add_run(const Run& run) {
    PrimitiveRun out;
    out.primitive = run.primitive;
    out.variation = run.variation;
    out.from = place_of(run.from);
    out.to = place_of(run.to);
    out.length = run.length;
    out.mean_radius = run.mean_radius();
    const ops::Fit radius = ops::fit(run.radius);
    const ops::Fit angle = ops::fit(run.direction);
    out.slope = radius.slope / run.length;
    out.bend = radius.bend / run.length;
    out.turning = axis_.resolution > 0 ? angle.slope : run.direction_change;
    if (run.variation != Variation::straight) out.spiral = angle.bend / angle.slope;
    features_
        .share[static_cast<std::size_t>(run.primitive)][static_cast<std::size_t>(run.variation)] +=
        run.length;
    features_.runs.push_back(out);
  }

  /// Adds the boundary on both sides and the area between. With the spokes to their feet, the edges
  /// tile the shape, except for sectors of disks that touch a whole arc.
  void add_sides(BranchFeatures& out) {
    Feet before, first;
    for (std::size_t i = 0; i < way_.size(); ++i) {
      const Step& step = way_[i];
      const Feet feet = feet_of(axis_, step);
      const Site* left = site_beside(axis_, step, Side::left);
      const Site* right = site_beside(axis_, step, Side::right);
      const Disk& from = axis_.nodes[tail_of(axis_, step)].disk;
      const Vec2 along = axis_.nodes[head_of(axis_, step)].disk.center - from.center;
      const Vec2 r0 = feet.right[0] - from.center, r1 = feet.right[1] - from.center;
      const Vec2 l0 = feet.left[0] - from.center, l1 = feet.left[1] - from.center;
      const Way way_right = way_between(right, feet.right[0], feet.right[1]);
      const Way way_left = way_between(left, feet.left[1], feet.left[0]);
      out.area += 0.5 * (cross(r0, r1) + cross(r1, along) + cross(along, l1) + cross(l1, l0)) +
                  way_right.area + way_left.area;
      out.side[0].length += way_left.length;
      out.side[1].length += way_right.length;
      if (i == 0) {
        first = feet;
      } else {
        add_gap(from, before.right[1], feet.right[0], out.side[1], out);
        add_gap(from, feet.left[0], before.left[1], out.side[0], out);
      }
      before = feet;
    }
    const Step &start = way_.front(), &end = way_.back();
    const auto set = [](BoundarySection& section, const Site* from, const Site* to, Vec2 a,
                        Vec2 b) {
      section.from = a;
      section.to = b;
      if (from == nullptr || to == nullptr) return;
      section.ring = from->ring;
      section.first_vertex = from->vertex;
      section.last_vertex = to->vertex;
    };
    set(out.side[0], site_beside(axis_, end, Side::left), site_beside(axis_, start, Side::left),
        before.left[1], first.left[0]);
    set(out.side[1], site_beside(axis_, start, Side::right), site_beside(axis_, end, Side::right),
        first.right[0], before.right[1]);
    if (out.closed) {
      const Disk& disk = axis_.nodes[out.from].disk;
      add_gap(disk, before.right[1], first.right[0], out.side[1], out);
      add_gap(disk, first.left[0], before.left[1], out.side[0], out);
    }
    cover(out.from, tangent_at(axis_, start, false), first.right[0], first.left[0], out);
    cover(out.to, -tangent_at(axis_, end, true), before.left[1], before.right[1], out);
    features_.boundary += out.side[0].length + out.side[1].length;
    features_.area += out.area;
  }

  /// Adds the part of an arc, counter-clockwise from one foot to the next, that a single disk
  /// inside a branch touches.
  void add_gap(const Disk& disk, Vec2 from, Vec2 to, BoundarySection& section,
               BranchFeatures& out) const {
    if (from == to || distance(from, to) <= ops::slack_of(axis_, disk)) return;
    const double angle = signed_angle(from - disk.center, to - disk.center);
    section.length += std::max(angle, 0.0) * disk.radius;
    out.area += 0.5 * angle * disk.radius * disk.radius;
  }

  /// Records the angle of the disk at a branch's end that the branch covers: from the right foot,
  /// as seen from the disk, across the branch's direction to the left foot. At an end point, the
  /// rest of the disk belongs to the branch, too.
  void cover(std::uint32_t node, Vec2 direction, Vec2 right, Vec2 left, BranchFeatures& out) {
    const Disk& disk = axis_.nodes[node].disk;
    const PointKind kind = features_.points[node];
    if (kind == PointKind::normal || !(disk.radius > 0)) return;
    const auto opening = [&](Vec2 point) {
      const Vec2 u = point - disk.center;
      return std::atan2(std::abs(cross(u, direction)), dot(u, direction));
    };
    double angle = opening(right) + opening(left);
    if (direction == Vec2{0, 0})  // an edge without length
      angle = left_turn(right - disk.center, left - disk.center);
    if (kind == PointKind::branching) {
      covered_[node] += angle;
      return;
    }
    angle = 2 * std::numbers::pi - angle;
    if (angle * disk.radius <= ops::slack_of(axis_, disk)) return;
    out.area += 0.5 * angle * disk.radius * disk.radius;
    features_.boundary += angle * disk.radius;
  }

  void add_significance(const std::vector<Branch>& all) {
    std::vector<Fuse> fuses;
    fuses.reserve(all.size());
    for (const BranchFeatures& branch : features_.branches)
      fuses.push_back({{branch.from, branch.to}, branch.length});
    const auto start = ops::burn(axis_, fuses);
    for (std::size_t i = 0; i < all.size(); ++i) {
      BranchFeatures& branch = features_.branches[i];
      branch.burn = start[i];
      branch.significance = significance_of(branch, all[i]);
    }
  }

  double significance_of(const BranchFeatures& branch, const Branch& chain) const {
    const auto thickness = [](double time, const Disk& disk) {
      return std::max(time - disk.radius, 0.0) / disk.radius;
    };
    const auto [from, to] = branch.burn;
    if (from == ops::not_burnt && to == ops::not_burnt) return ops::not_burnt;
    if (from == ops::not_burnt) return thickness(to + branch.length, axis_.nodes[branch.from].disk);
    if (to == ops::not_burnt) return thickness(from + branch.length, axis_.nodes[branch.to].disk);
    // Fires from both ends meet here, in the middle of the component.
    const double way = std::clamp(0.5 * (to + branch.length - from), 0.0, branch.length);
    double left = branch.reversed ? branch.length - way : way;
    for (const Step& step : chain.steps) {
      const Edge& edge = axis_.edges[step.edge];
      const Curve curve = curve_of(axis_, edge);
      const double length = curve.length();
      if (left > length && &step != &chain.steps.back()) {
        left -= length;
        continue;
      }
      const double t = curve.at_length(step.forward ? left : length - left);
      return thickness(from + way, curve.at(t));
    }
    return 0;
  }

  void add_whole() {
    DisjointSets parts(axis_.nodes.size());
    for (const Edge& edge : axis_.edges) parts.join(edge.node[0], edge.node[1]);
    features_.components = parts.count();
    features_.cycles = axis_.edges.size() + features_.components - axis_.nodes.size();
    for (std::size_t i = 0; i < axis_.nodes.size(); ++i) {
      const Disk& disk = axis_.nodes[i].disk;
      features_.largest_radius = std::max(features_.largest_radius, disk.radius);
      const double angle = 2 * std::numbers::pi - covered_[i];
      // The remaining sectors of disks at branching points, and shapes that are one disk.
      if (degree_[i] == 1 || degree_[i] == 2) continue;
      if (angle * disk.radius <= ops::slack_of(axis_, disk)) continue;
      features_.area += 0.5 * angle * disk.radius * disk.radius;
      features_.boundary += angle * disk.radius;
    }
    for (const BranchFeatures& branch : features_.branches) features_.length += branch.length;
    if (!(features_.length > 0)) {
      features_.mean_width = 2 * features_.largest_radius;
      return;
    }
    features_.mean_width = 2 * radius_integral_ / features_.length;
    double total = 0;
    for (const PrimitiveRun& run : features_.runs) total += run.length;
    for (auto& row : features_.share)
      for (double& share : row) share /= total;
  }

  const MedialAxis& axis_;
  RunCutter cutter_;
  AxisFeatures features_;
  std::vector<Step> way_;
  std::vector<std::uint32_t> degree_;  ///< of each node
  std::vector<double> covered_;        ///< of each branching node: the angle that branches cover
  double radius_integral_ = 0;
};

constexpr std::array<const char*, 3> point_names{"end", "normal", "branching"};
constexpr std::array<const char*, primitive_count> primitives{
    "worm",        "opening_wedge", "closing_wedge", "opening_cup",
    "closing_cup", "opening_flare", "closing_flare"};
constexpr std::array<const char*, variation_count> variations{
    "spiral_in_left",   "left_circular",  "spiral_out_left", "straight",
    "spiral_out_right", "right_circular", "spiral_in_right"};

}  // namespace

const char* name_of(PointKind kind) { return point_names[static_cast<std::size_t>(kind)]; }
const char* name_of(Primitive primitive) { return primitives[static_cast<std::size_t>(primitive)]; }
const char* name_of(Variation variation) { return variations[static_cast<std::size_t>(variation)]; }

AxisFeatures describe(const MedialAxis& axis, const FeatureOptions& options) {
  return Describer(axis, options).run();
}

}  // namespace medial
