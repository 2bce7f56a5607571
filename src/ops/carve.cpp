#include "medial/carve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "base/arc.h"
#include "base/compat.h"
#include "base/in_flight.h"
#include "base/numbers.h"
#include "medial/measure.h"
#include "medial/offset.h"
#include "ops/groove.h"

namespace medial {
namespace {

Error invalid_carving(const char* text) { return {ErrorCode::invalid_option, text, {}}; }

/// The nearest point of an edge to p, as a share of the way (of the angle, of an arc).
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
  double share = 0;  ///< of the way along the edge
  double squared_distance = infinity;
};
RingPlace nearest_place(const Ring& ring, Vec2 p) {
  RingPlace best;
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    const BulgeArc edge = edge_of(ring, i);
    const double share = nearest_share(edge, p);
    const double d = squared_norm(point_at_share(edge, share) - p);
    if (d < best.squared_distance) best = {i, share, d};
  }
  return best;
}

/// A ring as a closed path that starts at a place of it.
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

/// Puts paths one after the other, and joins those that are safely near.
class Planner {
 public:
  explicit Planner(Carving& carving) : carving_(carving) {}

  void begin_pass(std::uint32_t pass) { pass_ = pass; }

  Vec2 at() const {
    return carving_.paths.empty() ? Vec2{} : carving_.paths.back().points.back().point;
  }
  bool started() const { return !carving_.paths.empty(); }

  /// `reach`: up to what length the straight way to the path is inside of what is or may be cut at
  /// its depth; below 0: the tool is lifted.
  void add(ToolPathKind kind, std::vector<ToolPoint> points, double reach) {
    if (points.size() < 2) return;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      carving_.cut_length +=
          arc_length(distance(points[i].point, points[i + 1].point), points[i].bulge);
    if (started()) {
      const double way = distance(at(), points.front().point);
      if (way <= reach) {
        auto& last = carving_.paths.back();
        carving_.cut_length += way;
        if (kind == last.kind) {
          last.points.insert(last.points.end(), points.begin(), points.end());
        } else {
          points.insert(points.begin(), last.points.back());
          points.front().bulge = 0;
          carving_.paths.push_back({kind, std::move(points), pass_});
        }
        return;
      }
      carving_.travel_length += way;
    }
    carving_.paths.push_back({kind, std::move(points), pass_});
  }

 private:
  Carving& carving_;
  std::uint32_t pass_ = 0;
};

/// Flat bottoms: the rings of the offsets from `flat_from` on, inner ones first, the wall last.
class Floors {
 public:
  Floors(const Offsets& offsets, double flat_from, double z, Planner& planner)
      : offsets_(offsets),
        flat_from_(flat_from),
        z_(z),
        planner_(planner),
        children_(offsets.regions.size()) {
    for (std::uint32_t i = 0; i < offsets.regions.size(); ++i)
      if (offsets.regions[i].parent != no_region) children_[offsets.regions[i].parent].push_back(i);
  }
  void cut_all() {
    std::vector<std::uint32_t> roots;
    for (std::uint32_t i = 0; i < offsets_.regions.size(); ++i)
      if (offsets_.regions[i].parent == no_region) roots.push_back(i);
    cut_nearest(roots);
  }

 private:
  /// Cuts trees of regions, always the one whose first ring is nearest.
  void cut_nearest(std::vector<std::uint32_t> roots) {
    while (!roots.empty()) {
      auto next = roots.begin();
      constexpr std::size_t most = 4096;  // this takes the square of it
      if (planner_.started() && roots.size() > 1 && roots.size() <= most) {
        next = std::min_element(roots.begin(), roots.end(), [&](std::uint32_t a, std::uint32_t b) {
          return squared_norm(place(a) - planner_.at()) < squared_norm(place(b) - planner_.at());
        });
      }
      const std::uint32_t root = *next;
      roots.erase(next);
      cut_tree(root);
    }
  }
  Vec2 place(std::uint32_t region) const { return offsets_.regions[region].rings[0].points[0]; }

  /// After its children. A chain of single children may be long: no recursion along it.
  void cut_tree(std::uint32_t root) {
    std::vector<std::uint32_t> chain{root};
    while (children_[chain.back()].size() == 1) chain.push_back(children_[chain.back()][0]);
    cut_nearest(children_[chain.back()]);
    std::reverse(chain.begin(), chain.end());
    const auto rings = [&](std::uint32_t i) { return offsets_.regions[i].rings.size(); };
    for (auto begin = chain.begin(); begin != chain.end();) {
      const auto end = std::find_if(begin, chain.end(),
                                    [&](std::uint32_t i) { return rings(i) != rings(*begin); });
      cut_rings(span_between(begin, end));
      begin = end;
    }
  }
  /// Regions in each other, inner ones first, that have as many rings: all that follow each other
  /// from one boundary to its wall, then those towards another one.
  void cut_rings(std::span<const std::uint32_t> regions) {
    std::vector<std::vector<const Ring*>> left;
    for (const std::uint32_t i : regions) {
      auto& rings = left.emplace_back();
      for (const Ring& ring : offsets_.regions[i].rings) rings.push_back(&ring);
    }
    while (!left[0].empty())
      for (std::size_t i = 0; i < regions.size(); ++i)
        cut_nearest_ring(offsets_.regions[regions[i]], left[i]);
  }
  void cut_nearest_ring(const OffsetRegion& region, std::vector<const Ring*>& left) {
    const Vec2 from = planner_.started() ? planner_.at() : left[0]->points[0];
    std::size_t next = 0;
    RingPlace nearest;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const RingPlace place = nearest_place(*left[k], from);
      if (place.squared_distance < nearest.squared_distance) nearest = place, next = k;
    }
    // The tool may be where the clearance is at least flat_from: around a place of clearance c
    // within c - flat_from.
    const double reach =
        last_clearance_ < 0 ? -1 : (last_clearance_ - flat_from_) + (region.clearance - flat_from_);
    constexpr double rounding = 1 + 1e-9;
    planner_.add(region.parent == no_region ? ToolPathKind::wall : ToolPathKind::clearing,
                 path_from(*left[next], nearest, z_), rounding * reach);
    last_clearance_ = region.clearance;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
  }

  const Offsets& offsets_;
  double flat_from_, z_;
  Planner& planner_;
  std::vector<std::vector<std::uint32_t>> children_;
  double last_clearance_ = -1;  ///< of the last ring
};

/// Travel where rings and branches are cut as they come.
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

/// Of the axis's sites.
Box box_of(const MedialAxis& axis) {
  Box box{axis.nodes[0].disk.center, axis.nodes[0].disk.center};
  for (const Site& site : axis.sites) {
    box.add(site.start);
    box.add(site.end);
  }
  return box;
}

/// Between the passes that clear a flat bottom of clearances above `flat_from`.
double step_at(const CarveOptions& options, double tip, double flat_from) {
  return options.step > 0 ? options.step : tip > 0 ? tip : flat_from / 20;
}

/// One trail of grooves as a path of the tool. `depth_of` is how deep it may go in a disk.
template <class DepthOf>
std::vector<ToolPoint> path_along(const std::vector<ops::GrooveStep>& trail,
                                  const ops::Grooves& grooves, const DepthOf& depth_of) {
  std::vector<ToolPoint> points;
  for (const ops::GrooveStep& step : trail) {
    const auto& disks = grooves.parts[step.part].disks;
    for (std::size_t k = 0; k < disks.size(); ++k) {
      const Disk& disk = disks[step.forward ? k : disks.size() - 1 - k];
      const ToolPoint point{disk.center, -depth_of(disk), 0};
      if (points.empty() || !(points.back().point == point.point) || points.back().z != point.z)
        points.push_back(point);
    }
  }
  return points;
}

Result<Offsets> floor_rings(const MedialAxis& axis, double flat_from, double step) {
  if (!std::isfinite(flat_from)) return Offsets{};
  auto rings = offset_passes(axis, flat_from, step);
  if (!rings) return std::move(rings).error();
  if (rings->empty()) return Offsets{};
  return inward_offsets(axis, *rings);
}

Result<Carving> plan(const MedialAxis& axis, const CarveOptions& options) {
  const double radius = options.tool > 0 ? options.tool / 2 : infinity;
  const bool mill = options.angle == 0;
  Carving carving;
  carving.slope = mill ? 0 : std::tan(options.angle * std::numbers::pi / 360);
  carving.tip_radius = mill ? radius : options.tip / 2;
  const double tip = carving.tip_radius, slope = carving.slope;
  double depth = options.depth > 0 ? options.depth : infinity;
  if (!mill) depth = std::min(depth, (radius - tip) / slope);
  carving.flat_from = mill ? tip : tip + depth * slope;  // infinite where nothing limits the depth
  const double chord = options.chord > 0 ? options.chord : 1e-5 * diagonal(box_of(axis));
  if (std::isfinite(carving.flat_from)) carving.step = step_at(options, tip, carving.flat_from);

  // As deep as the widest place lets the tool go.
  double lowest = depth;
  if (!mill) lowest = std::min(depth, std::max(deepest_disk(axis).radius - tip, 0.0) / slope);
  constexpr double most_passes = 1e4, rounding = 1e-9;
  const double passes =
      options.pass_depth > 0 ? std::max(1.0, std::ceil(lowest / options.pass_depth - rounding)) : 1;
  if (!(passes <= most_passes))
    return Error{ErrorCode::too_large, "there would be more than 1e4 passes in depth", {}};

  Planner planner(carving);
  double cleared = tip;  // the clearance up to which grooves are cut
  for (std::uint32_t pass = 0; pass < static_cast<std::uint32_t>(passes); ++pass) {
    const bool last = pass + 1 == static_cast<std::uint32_t>(passes);
    const double floor = last ? depth : (pass + 1) * options.pass_depth;
    const double flat_from = last ? carving.flat_from : mill ? tip : tip + floor * slope;
    planner.begin_pass(pass);
    const auto offsets = floor_rings(axis, flat_from, step_at(options, tip, flat_from));
    if (!offsets) return offsets.error();
    if (!offsets->regions.empty()) {
      carving.deepest = std::max(carving.deepest, floor);
      Floors(*offsets, flat_from, -floor, planner).cut_all();
    }
    // An end mill needs the axis only where it is just as wide.
    const ops::Grooves grooves = ops::grooves_of(axis, cleared, flat_from, chord);
    const Vec2 start = planner.started() || grooves.parts.empty()
                           ? planner.at()
                           : grooves.parts[0].disks[0].center;
    const auto depth_of = [&](const Disk& disk) {
      // Chords are lifted, in narrow places above the surface.
      const double deep = mill ? floor : std::min((disk.radius - tip) / slope, floor);
      carving.deepest = std::max(carving.deepest, deep);
      return deep;
    };
    for (const auto& trail : ops::trails_of(grooves, start))
      planner.add(ToolPathKind::groove, path_along(trail, grooves, depth_of), -1);
    carving.travel_unordered += unordered_travel(*offsets, grooves);
    if (!mill) cleared = flat_from;
  }
  return carving;
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
  for (const double value :
       {options.depth, options.tool, options.tip, options.pass_depth, options.step, options.chord})
    if (!(value >= 0) || !std::isfinite(value))
      return invalid_carving("depths, diameters, step and chord must be finite and not negative");
  if (options.angle == 0 && !(options.depth > 0 && options.tool > 0))
    return invalid_carving("an end mill (angle 0) needs a depth and a diameter");
  if (options.angle > 0 && options.angle < 1)
    return invalid_carving("the angle must be 0 or in [1, 170]");
  if (options.angle > 0 && options.tool > 0 && !(options.tip < options.tool))
    return invalid_carving("the tip must be smaller than the tool");
  constexpr double smallest_chord = 1e-8;  // the moves grow as the root of one over it
  if (options.chord > 0 && options.chord < smallest_chord * diagonal(box_of(axis)))
    return invalid_carving("the chord must be at least 1e-8 of the diagonal of the axis's sites");
  try {
    return plan(axis, options);
  } catch (...) {
    return error_in_flight();
  }
}

CarveOptions scaled(CarveOptions options, double factor) {
  for (double* length : {&options.depth, &options.tool, &options.tip, &options.pass_depth,
                         &options.step, &options.chord})
    *length *= factor;
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
                         &carving.cut_length, &carving.travel_length, &carving.travel_unordered})
    *length *= factor;
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
    // Half of the angle of a piece whose chord, or the meeting point of whose tangents, is as far
    // away as may be.
    const double quarter = std::atan(std::abs(arc.bulge));
    const double share = std::min(chord * std::abs(curvature(arc)), 1.0);
    const double half = arc.bulge > 0 ? 2 * std::asin(std::sqrt(0.5 * share))
                                      : std::atan(std::sqrt(share * (2 + share)));
    constexpr double most = 1e6;
    const double pieces = std::clamp(std::ceil(2 * quarter / half), 1.0, most);
    const bool tangents = arc.bulge < 0;
    const double apart = 2 * quarter / pieces;  // half of the angle of each piece
    for (double k = tangents ? 0.5 : 1; k < pieces; k += 1) {
      // In the direction of the chord up to there; a meeting of tangents is further out.
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
