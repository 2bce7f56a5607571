#include "medial/carve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "axis/node_kinds.h"
#include "base/arc.h"
#include "base/arc_box.h"
#include "base/box_tree.h"
#include "base/compat.h"
#include "base/in_flight.h"
#include "base/numbers.h"
#include "base/open_boxes.h"
#include "medial/measure.h"
#include "medial/offset.h"
#include "ops/groove.h"
#include "ops/tabs.h"
#include "ops/tool_planner.h"

namespace medial {
namespace {

Error invalid_carving(const char* text) { return {ErrorCode::invalid_option, text, {}}; }

/// The point of an edge nearest to p, as a share of the length (of the angle for an arc).
double nearest_share(const BulgeArc& edge, Vec2 p) {
  if (edge.bulge == 0) {
    const double along = dot(p - edge.start, edge.chord()) / squared_norm(edge.chord());
    return std::clamp(along, 0.0, 1.0);
  }
  const double round = curvature(edge);
  const Vec2 center = edge.start + (1 / round) * left_of(start_tangent(edge));
  const double whole = 4 * std::atan(edge.bulge), sign = edge.bulge > 0 ? 1 : -1;
  double angle = sign * signed_angle(edge.start - center, p - center);
  if (angle < 0) angle += 2 * std::numbers::pi;
  if (angle <= std::abs(whole)) return angle / std::abs(whole);
  return squared_norm(p - edge.start) <= squared_norm(p - edge.end) ? 0 : 1;
}
BulgeArc edge_of(const Ring& ring, std::size_t i) {
  return {ring.points[i], ring.points[i + 1 == ring.points.size() ? 0 : i + 1],
          ring.bulges.empty() ? 0 : ring.bulges[i]};
}

/// The place of a ring that is nearest to a point.
struct RingPlace {
  std::size_t edge = 0;
  double share = 0;  ///< of the edge's length
  double squared_distance = infinity;
};

RingPlace place_on_edge(const Ring& ring, std::size_t i, Vec2 p) {
  const BulgeArc edge = edge_of(ring, i);
  const double share = nearest_share(edge, p);
  return {i, share, squared_norm(point_at_share(edge, share) - p)};
}

RingPlace nearest_place(const Ring& ring, Vec2 p) {
  RingPlace best;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    const RingPlace place = place_on_edge(ring, i, p);
    if (place.squared_distance < best.squared_distance) best = place;
  }
  return best;
}

/// The rings of a region that have not been cut.
class RingsLeft {
 public:
  /// O(n log n) for n edges; O(1) for one ring.
  explicit RingsLeft(std::span<const Ring> rings) : rings_(rings), left_(rings.size()) {
    if (rings.size() == 1) return;
    std::vector<Box> boxes;
    for (std::uint32_t ring = 0; ring < rings.size(); ++ring) {
      begin_.push_back(static_cast<std::uint32_t>(boxes.size()));
      for (std::size_t i = 0; i < rings[ring].points.size(); ++i) {
        boxes.push_back(box_around(edge_of(rings[ring], i)));
        ring_of_.push_back(ring);
      }
    }
    edges_.emplace(std::move(boxes));
  }
  bool empty() const { return left_ == 0; }
  Vec2 first_point() { return (edges_ ? rings_[ring_of_[edges_->first()]] : rings_[0]).points[0]; }
  /// The remaining place nearest to a point, and its ring, which is removed.
  std::pair<const Ring*, RingPlace> take_nearest(Vec2 p) {
    --left_;
    if (!edges_) return {rings_.data(), nearest_place(rings_[0], p)};
    const auto place_of = [&](std::uint32_t i) {
      const std::size_t edge = i - begin_[ring_of_[i]];
      return place_on_edge(rings_[ring_of_[i]], edge, p);
    };
    const std::uint32_t nearest =
        edges_->nearest(p, [&](std::uint32_t i) { return place_of(i).squared_distance; });
    const Ring& ring = rings_[ring_of_[nearest]];
    const std::uint32_t begin = begin_[ring_of_[nearest]];
    for (std::uint32_t i = 0; i < ring.points.size(); ++i) edges_->erase(begin + i);
    return {&ring, place_of(nearest)};
  }

 private:
  std::span<const Ring> rings_;
  std::size_t left_;
  std::vector<std::uint32_t> begin_;    ///< of each ring: its first edge
  std::vector<std::uint32_t> ring_of_;  ///< of each edge
  std::optional<OpenBoxes> edges_;
};

/// A ring as a closed path that starts at this place.
std::vector<ToolPoint> path_from(const Ring& ring, const RingPlace& place, double z) {
  const std::size_t count = ring.points.size(), best = place.edge;
  const double share = place.share;
  const BulgeArc first = edge_of(ring, best);
  const auto bulge_of_share = [&](double part) { return std::tan(part * std::atan(first.bulge)); };
  std::vector<ToolPoint> path;
  path.reserve(count + 2);
  const Vec2 start = point_at_share(first, share);
  if (share < 1) path.push_back({start, z, bulge_of_share(1 - share)});
  for (std::size_t k = 1; k < count + (share < 1 ? 0 : 1); ++k) {
    const std::size_t i = (best + k) % count;
    path.push_back({ring.points[i], z, edge_of(ring, i).bulge});
  }
  if (share > 0 && share < 1) path.push_back({first.start, z, bulge_of_share(share)});
  path.push_back({start, z, 0});
  return path;
}

/// The area that another tool has cleared: within `reach` of the rings of a region, or inside it.
class ClearedBefore {
 public:
  ClearedBefore() = default;
  /// `least`: the clearance of the rings.
  ClearedBefore(const Offsets& rings, double least, double reach, const Tabs& tabs,
                double beside_tabs)
      : least_(least), reach_(reach) {
    if (!tabs.lines.empty()) tabs_.emplace(tabs, beside_tabs);
    std::vector<Box> boxes;
    for (const OffsetRegion& region : rings.regions)
      for (const Ring& ring : region.rings)
        for (std::size_t i = 0; i < ring.points.size(); ++i) {
          edges_.push_back(edge_of(ring, i));
          boxes.push_back(box_around(edges_.back()));
        }
    if (!boxes.empty()) tree_.emplace(boxes);
  }

  bool is_nothing() const { return !tree_; }
  /// Whether the surroundings of a ring of this clearance have been cut.
  bool contains_ring(double clearance) const { return tree_ && !tabs_ && clearance >= least_; }
  /// Whether the surroundings of a place have been cut, by its clearance or by the nearest rings.
  bool contains(Vec2 p, double clearance) const {
    if (!tree_ || (tabs_ && tabs_->reaches(p))) return false;
    if (clearance >= least_) return true;
    if (!(reach_ > 0)) return false;
    bool near = false;
    const Vec2 wide = reach_ * Vec2{1, 1};
    tree_->find({p - wide, p + wide}, [&](std::uint32_t i) {
      const Vec2 q = point_at_share(edges_[i], nearest_share(edges_[i], p));
      near = near || distance(p, q) <= reach_;
    });
    return near;
  }

 private:
  std::vector<BulgeArc> edges_;
  std::optional<BoxTree> tree_;
  double least_ = 0, reach_ = 0;
  std::optional<ops::TabTree> tabs_;  ///< the other tool did not cut next to these
};

/// The parts of a path at one clearance that have not been cleared, sampled every `spacing`.
std::vector<std::vector<ToolPoint>> parts_left(std::vector<ToolPoint> path, double clearance,
                                               const ClearedBefore& cleared, double spacing) {
  if (cleared.is_nothing()) return {std::move(path)};
  std::vector<std::vector<ToolPoint>> parts;
  bool open = false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const BulgeArc edge{path[i].point, path[i + 1].point, path[i].bulge};
    constexpr double most = 1e5;
    const double pieces =
        std::clamp(std::ceil(arc_length(norm(edge.chord()), edge.bulge) / spacing), 1.0, most);
    const auto at = [&](double k) {
      return k < pieces ? point_at_share(edge, k / pieces) : edge.end;
    };
    double begun = 0;
    bool at_start = cleared.contains(at(0), clearance);
    const auto add = [&](double end) {
      if (!open || !(end > begun)) return;
      parts.back().back().bulge = std::tan(std::atan(edge.bulge) * (end - begun) / pieces);
      parts.back().push_back({at(end), path[i].z, 0});
    };
    for (double k = 0; k < pieces; k += 1) {
      const bool at_end = cleared.contains(at(k + 1), clearance);
      const bool needed = !at_start || !at_end;
      at_start = at_end;
      if (needed && !open) {
        parts.push_back({{at(k), path[i].z, 0}});
        begun = k;
      } else if (!needed) {
        add(k);
      }
      open = needed;
    }
    add(pieces);
  }
  return parts;
}

/// Flat bottoms: the rings of the offsets from `flat_from` on, inner ones first, the wall last.
class Floors {
 public:
  Floors(const Offsets& offsets, const ClearedBefore& cleared, const Carving& carving, double z,
         ops::Planner& planner)
      : offsets_(offsets),
        cleared_(cleared),
        flat_from_(carving.flat_from),
        step_(carving.step),
        z_(z),
        planner_(planner),
        children_(offsets.regions.size()) {
    for (std::uint32_t i = 0; i < offsets.regions.size(); ++i)
      if (offsets.regions[i].parent != no_region) children_[offsets.regions[i].parent].push_back(i);
  }
  /// Always takes the tree of regions whose first ring is nearest. Cuts each region after its
  /// children.
  void cut_all() {
    std::vector<std::uint32_t> roots;
    for (std::uint32_t i = 0; i < offsets_.regions.size(); ++i)
      if (offsets_.regions[i].parent == no_region) roots.push_back(i);
    std::vector<Choice> open;  // trees may be deep: no recursion
    open.emplace_back(*this, std::move(roots));
    while (!open.empty()) {
      cut_chain(std::exchange(open.back().chain, {}));
      if (open.back().left.empty()) {
        open.pop_back();
        continue;
      }
      std::vector<std::uint32_t>& chain = open.back().chain;
      chain = {open.back().take_nearest(*this)};
      while (children_[chain.back()].size() == 1) chain.push_back(children_[chain.back()][0]);
      if (!children_[chain.back()].empty()) open.emplace_back(*this, children_[chain.back()]);
    }
  }

 private:
  Vec2 place(std::uint32_t region) const { return offsets_.regions[region].rings[0].points[0]; }

  /// Trees to choose from.
  struct Choice {
    Choice(const Floors& floors, std::vector<std::uint32_t> trees)
        : roots(std::move(trees)), left(boxes_of(floors, roots)) {}
    std::uint32_t take_nearest(const Floors& floors) {
      const auto& planner = floors.planner_;
      const Vec2 from = planner.started() ? planner.at() : floors.place(roots[left.first()]);
      const std::uint32_t next = left.nearest(
          from, [&](std::uint32_t i) { return squared_norm(floors.place(roots[i]) - from); });
      left.erase(next);
      return roots[next];
    }
    static std::vector<Box> boxes_of(const Floors& floors,
                                     const std::vector<std::uint32_t>& regions) {
      std::vector<Box> boxes;
      for (const std::uint32_t i : regions) boxes.push_back({floors.place(i), floors.place(i)});
      return boxes;
    }
    std::vector<std::uint32_t> roots;
    OpenBoxes left;
    std::vector<std::uint32_t> chain;  ///< from the current root to the first branching
  };

  /// Cuts a chain, beginning with the innermost region.
  void cut_chain(std::vector<std::uint32_t> chain) {
    std::reverse(chain.begin(), chain.end());
    const auto rings = [&](std::uint32_t i) { return offsets_.regions[i].rings.size(); };
    for (auto begin = chain.begin(); begin != chain.end();) {
      const auto end = std::find_if(begin, chain.end(),
                                    [&](std::uint32_t i) { return rings(i) != rings(*begin); });
      cut_rings(span_between(begin, end));
      begin = end;
    }
  }
  /// Cuts nested regions with equal numbers of rings, inner ones first: all rings from one boundary
  /// to its wall, then those towards the next one.
  void cut_rings(std::span<const std::uint32_t> regions) {
    std::vector<RingsLeft> left;
    for (const std::uint32_t i : regions) left.emplace_back(offsets_.regions[i].rings);
    while (!left[0].empty())
      for (std::size_t i = 0; i < regions.size(); ++i)
        cut_nearest_ring(offsets_.regions[regions[i]], left[i]);
  }
  void cut_nearest_ring(const OffsetRegion& region, RingsLeft& left) {
    const auto [ring, nearest] =
        left.take_nearest(planner_.started() ? planner_.at() : left.first_point());
    const bool wall = region.parent == no_region;
    if (!wall && cleared_.contains_ring(region.clearance)) return;
    auto path = path_from(*ring, nearest, z_);
    if (wall) return add(ToolPathKind::wall, std::move(path), region.clearance);
    for (auto& part : parts_left(std::move(path), region.clearance, cleared_, 0.5 * step_))
      add(ToolPathKind::clearing, std::move(part), region.clearance);
  }
  /// Adds a path of constant clearance.
  void add(ToolPathKind kind, std::vector<ToolPoint> path, double clearance) {
    // The tool may be at places with a clearance of at least flat_from, so within c - flat_from of
    // a place of clearance c.
    constexpr double rounding = 1 + 1e-9;
    const double reach =
        last_clearance_ < 0 ? -1 : (last_clearance_ - flat_from_) + (clearance - flat_from_);
    planner_.add(kind, std::move(path), rounding * reach);
    last_clearance_ = clearance;
  }

  const Offsets& offsets_;
  const ClearedBefore& cleared_;
  double flat_from_, step_, z_;
  ops::Planner& planner_;
  std::vector<std::vector<std::uint32_t>> children_;
  double last_clearance_ = -1;  ///< of the last ring
};

/// The travel if rings and branches are cut in the order of the axis.
double unordered_travel(const Offsets& offsets, const ops::Grooves& grooves) {
  double sum = 0;
  bool started = false;
  Vec2 at;
  const auto visit = [&](Vec2 from, Vec2 to) {
    if (started) sum += distance(at, from);
    started = true;
    at = to;
  };
  for (const OffsetRegion& region : offsets.regions)
    for (const Ring& ring : region.rings) visit(ring.points[0], ring.points[0]);
  for (const ops::Groove& part : grooves.parts)
    visit(part.disks.front().center, part.disks.back().center);
  return sum;
}

/// The box around the axis's sites.
Box box_of(const MedialAxis& axis) {
  Box box{axis.nodes[0].disk.center, axis.nodes[0].disk.center};
  for (const Site& site : axis.sites) {
    box.add(site.start);
    box.add(site.end);
  }
  return box;
}

/// The distance between the passes that clear a flat bottom with clearances above `flat_from`.
double step_at(const CarveOptions& options, double tip, double flat_from) {
  return options.step > 0 ? options.step : tip > 0 ? tip : flat_from / 20;
}

/// One trail of grooves as a path of the tool, down to `floor`. `depth_of` gives the largest depth
/// in a disk.
template <class DepthOf>
std::vector<ToolPoint> path_along(const std::vector<ops::GrooveStep>& trail,
                                  const ops::Grooves& grooves, const DepthOf& depth_of,
                                  double floor) {
  std::size_t most = 0;
  for (const ops::GrooveStep& step : trail) most += grooves.parts[step.part].disks.size();
  std::vector<ToolPoint> points;
  points.reserve(most);
  const auto add = [&](Vec2 p, double deep) {
    const ToolPoint point{p, 0 - std::min(deep, floor), 0};  // 0, not -0, at the surface
    if (points.empty() || !(points.back().point == p) || points.back().z != point.z)
      points.push_back(point);
  };
  for (const ops::GrooveStep& step : trail) {
    const auto& disks = grooves.parts[step.part].disks;
    const auto disk = [&](std::size_t k) { return disks[step.forward ? k : disks.size() - 1 - k]; };
    for (std::size_t k = 0; k < disks.size(); ++k) {
      const double deep = depth_of(disk(k));
      if (k > 0) {
        const double before = depth_of(disk(k - 1));
        if ((before < floor) != (deep < floor) && before != deep) {
          const Vec2 from = disk(k - 1).center, to = disk(k).center;
          add(from + (floor - before) / (deep - before) * (to - from), floor);
        }
      }
      add(disk(k).center, deep);
    }
  }
  return points;
}

/// Disks that are the whole axis of a part, such as a circle, with radii in [least, most]. The tool
/// goes straight down there.
std::vector<Disk> lone_disks(const MedialAxis& axis, double least, double most) {
  constexpr double rounding = 1e-9;
  const std::vector<std::uint32_t> degree = degrees_of(axis);
  std::vector<Disk> disks;
  for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
    const Disk& disk = axis.nodes[i].disk;
    if (degree[i] == 0 && disk.radius >= (1 - rounding) * least &&
        disk.radius <= (1 + rounding) * most)
      disks.push_back(disk);
  }
  return disks;
}

Result<Offsets> floor_rings(const MedialAxis& axis, double flat_from, double step) {
  if (!std::isfinite(flat_from)) return Offsets{};
  auto rings = offset_passes(axis, flat_from, step);
  if (!rings && rings.error().code == ErrorCode::too_large)
    return Error{ErrorCode::too_large,
                 "the flat bottoms take " + rings.error().text +
                     "; a larger step, tool or depth takes fewer",
                 {}};
  if (!rings) return std::move(rings).error();
  if (rings->empty()) return Offsets{};
  return inward_offsets(axis, *rings);
}

/// A tool and its largest depth.
struct Tool {
  bool mill;
  double depth;  ///< infinite if unlimited
};
Tool tool_of(const CarveOptions& options, Carving& carving) {
  const double radius = options.tool > 0 ? options.tool / 2 : infinity;
  const Tool tool{options.angle == 0, options.depth > 0 ? options.depth : infinity};
  carving.slope = tool.mill ? 0 : std::tan(options.angle * std::numbers::pi / 360);
  carving.tip_radius = tool.mill ? radius : options.tip / 2;
  const double tip = carving.tip_radius;
  const double depth =
      tool.mill ? tool.depth : std::min(tool.depth, (radius - tip) / carving.slope);
  carving.flat_from = tool.mill ? tip + options.allowance : tip + depth * carving.slope;
  if (std::isfinite(carving.flat_from)) carving.step = step_at(options, tip, carving.flat_from);
  return {tool.mill, depth};
}

/// The area cleared by the mill of options.cleared, in flat bottoms that begin at the clearance
/// `floor`.
Result<ClearedBefore> cleared_before(const MedialAxis& axis, const CarveOptions& options,
                                     const Carving& carving) {
  const double radius = options.cleared / 2;
  if (!(radius > 0) || !std::isfinite(carving.flat_from)) return ClearedBefore{};
  const double least = radius + carving.flat_from - carving.tip_radius;
  auto rings = inward_offsets(axis, std::vector<double>{least});
  if (!rings) return std::move(rings).error();
  constexpr double rounding = 1 - 1e-9;
  const double reach = rounding * (radius - std::max(carving.step, carving.tip_radius));
  return ClearedBefore(*rings, least, reach, options.tabs, radius + std::max(reach, 0.0));
}

Result<Carving> plan(const MedialAxis& axis, const CarveOptions& options) {
  Carving carving;
  const Tool tool = tool_of(options, carving);
  const double tip = carving.tip_radius, slope = carving.slope;
  const double chord = options.chord > 0 ? options.chord : 1e-5 * diagonal(box_of(axis));

  // The depth that the widest place allows.
  double lowest = tool.depth;
  if (!tool.mill) lowest = std::min(lowest, std::max(deepest_disk(axis).radius - tip, 0.0) / slope);
  constexpr double most_passes = 1e4, rounding = 1e-9;
  const double passes =
      options.pass_depth > 0 ? std::max(1.0, std::ceil(lowest / options.pass_depth - rounding)) : 1;
  if (!(passes <= most_passes))
    return Error{ErrorCode::too_large, "there would be more than 1e4 passes in depth", {}};
  carving.passes = static_cast<std::uint32_t>(passes);

  const auto offsets = floor_rings(axis, carving.flat_from, carving.step);
  if (!offsets) return offsets.error();
  const auto before = cleared_before(axis, options, carving);
  if (!before) return before.error();
  const double straight = 90;
  ops::Planner planner(
      carving, options.ramp < straight ? std::tan(options.ramp * std::numbers::pi / 180) : infinity,
      chord);
  double cleared = tool.mill ? carving.flat_from : tip;  // everything is cut up to this clearance
  for (std::uint32_t pass = 0; pass < carving.passes; ++pass) {
    const bool last = pass + 1 == carving.passes;
    const double floor = last ? tool.depth : (pass + 1) * options.pass_depth;
    const double level = 0 - pass * options.pass_depth;
    planner.begin_pass(pass, level);
    if (!offsets->regions.empty()) {
      carving.deepest = std::max(carving.deepest, floor);
      Floors(*offsets, *before, carving, -floor, planner).cut_all();
    }
    // An end mill follows the axis only where the shape is exactly as wide as the mill.
    const ops::Grooves grooves = ops::grooves_of(axis, cleared, carving.flat_from, chord);
    const Vec2 start = planner.started() || grooves.parts.empty()
                           ? planner.at()
                           : grooves.parts[0].disks[0].center;
    const auto depth_of = [&](const Disk& disk) {
      // Chords are lifted; in narrow places, they are above the surface.
      const double deep = tool.mill ? floor : (disk.radius - tip) / slope;
      carving.deepest = std::max(carving.deepest, std::min(deep, floor));
      return deep;
    };
    for (const auto& trail : ops::trails_of(grooves, start))
      planner.add(ToolPathKind::groove, path_along(trail, grooves, depth_of, floor), -1);
    for (const Disk& disk : lone_disks(axis, cleared, carving.flat_from))
      planner.add(ToolPathKind::plunge,
                  {{disk.center, level, 0}, {disk.center, -std::min(depth_of(disk), floor), 0}},
                  -1);
    carving.travel_unordered += unordered_travel(*offsets, grooves);
    if (!tool.mill) cleared = tip + floor * slope;
  }
  carving.tabs = options.tabs;
  ops::spare_tabs(carving);
  return carving;
}

Tabs scaled(Tabs tabs, double factor) {
  for (TabLine& line : tabs.lines)
    for (Vec2& p : line) p = factor * p;
  tabs.width *= factor;
  tabs.top *= factor;
  return tabs;
}

}  // namespace

Result<Carving> carve(const MedialAxis& axis, const CarveOptions& options) {
  if (axis.resolution > 0)
    return Error{ErrorCode::unsupported, "carving follows exact axes only", {}};
  if (axis.exterior > 0)
    return Error{ErrorCode::unsupported, "the axis is one of the exterior", {}};
  if (axis.nodes.empty()) return Error{ErrorCode::empty, "the axis is empty", {}};
  if (!(options.angle >= 0 && options.angle <= 170))
    return invalid_carving("the angle must be in [0, 170]");
  for (const double value : {options.depth, options.tool, options.tip, options.pass_depth,
                             options.step, options.chord, options.allowance, options.cleared})
    if (!(value >= 0) || !std::isfinite(value))
      return invalid_carving("depths, diameters, step and chord must be finite and not negative");
  if (options.angle == 0 && !(options.depth > 0 && options.tool > 0))
    return invalid_carving("an end mill (angle 0) needs a depth and a diameter");
  if (options.angle > 0 && options.angle < 1)
    return invalid_carving("the angle must be 0 or in [1, 170]");
  if (options.angle > 0 && options.tool > 0 && !(options.tip < options.tool))
    return invalid_carving("the tip must be smaller than the tool");
  if (!(options.ramp > 0 && options.ramp <= 90))
    return invalid_carving("the ramp must be in (0, 90] degrees");
  if (!options.tabs.lines.empty() && !(options.tabs.width > 0 && options.tabs.top >= 0))
    return invalid_carving("tabs need a width above 0, and a top below the surface");
  constexpr double smallest_chord = 1e-8;  // the number of moves grows as 1 / sqrt(chord)
  if (options.chord > 0 && options.chord < smallest_chord * diagonal(box_of(axis)))
    return invalid_carving(
        "the path tolerance (chord) must be at least 1e-8 of the diagonal of the axis's sites");
  return guarded([&] { return plan(axis, options); });
}

CarveOptions clearing_before(const CarveOptions& v, double diameter, double pass_depth) {
  const double slope = std::tan(v.angle * std::numbers::pi / 360);
  double depth = v.depth > 0 ? v.depth : infinity;
  if (v.tool > 0) depth = std::min(depth, (v.tool - v.tip) / 2 / slope);
  CarveOptions mill = v;
  mill.angle = mill.tip = mill.step = mill.cleared = 0;
  mill.depth = std::isfinite(depth) ? depth : 0;
  mill.tool = diameter;
  mill.pass_depth = pass_depth;
  mill.allowance = mill.depth * slope;
  return mill;
}

CarveOptions scaled(CarveOptions options, double factor) {
  for (double* length : {&options.depth, &options.tool, &options.tip, &options.pass_depth,
                         &options.step, &options.chord, &options.allowance, &options.cleared})
    *length *= factor;
  options.tabs = scaled(std::move(options.tabs), factor);
  return options;
}

Carving scaled(Carving carving, double factor) {
  for (ToolPath& path : carving.paths) {
    for (ToolPoint& point : path.points) {
      point.point = factor * point.point;
      point.z *= factor;
    }
  }
  for (double* length : {&carving.deepest, &carving.flat_from, &carving.tip_radius, &carving.step,
                         &carving.own_length, &carving.cut_length, &carving.travel_length,
                         &carving.travel_unordered})
    *length *= factor;
  carving.tabs = scaled(std::move(carving.tabs), factor);
  return carving;
}

Carving placed(Carving carving, Vec2 zero, bool mirrored) {
  const double up = mirrored ? -1 : 1;
  const auto moved = [&](Vec2 p) { return Vec2{p.x - zero.x, up * (p.y - zero.y)}; };
  for (ToolPath& path : carving.paths) {
    for (ToolPoint& point : path.points) {
      point.point = moved(point.point);
      point.bulge *= up;
    }
  }
  for (TabLine& line : carving.tabs.lines)
    for (Vec2& p : line) p = moved(p);
  return carving;
}

std::vector<ToolPoint> without_arcs(const ToolPath& path, double chord) {
  std::vector<ToolPoint> out;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const ToolPoint& from = path.points[i];
    out.push_back({from.point, from.z, 0});
    if (from.bulge == 0 || i + 1 == path.points.size()) continue;
    const BulgeArc arc{from.point, path.points[i + 1].point, from.bulge};
    if (arc.start == arc.end) continue;
    // Half of the angle of a piece whose chord, or the intersection of whose tangents, is as far
    // away as allowed.
    const double quarter = std::atan(std::abs(arc.bulge));
    const double share = std::min(chord * std::abs(curvature(arc)), 1.0);
    const double half = arc.bulge > 0 ? 2 * std::asin(std::sqrt(0.5 * share))
                                      : std::atan(std::sqrt(share * (2 + share)));
    constexpr double most = 1e6;
    const double pieces = std::clamp(std::ceil(2 * quarter / half), 1.0, most);
    const bool tangents = arc.bulge < 0;
    const double apart = 2 * quarter / pieces;  // half of the angle of each piece
    for (double k = tangents ? 0.5 : 1; k < pieces; k += 1) {
      // In the direction of the chord to that point; an intersection of tangents is farther out.
      const double turn = apart * k;
      const Vec2 on_arc = point_at_share(arc, k / pieces);
      if (!tangents) {
        out.push_back({on_arc, from.z, 0});
        continue;
      }
      const Vec2 along = turned(start_tangent(arc), std::cos(2 * turn), -std::sin(2 * turn));
      const double out_by = (1 / std::cos(apart) - 1) / std::abs(curvature(arc));
      out.push_back({on_arc + out_by * left_of(along), from.z, 0});
    }
  }
  return out;
}

}  // namespace medial
