#include "medial/offset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/arc.h"
#include "base/disjoint_sets.h"
#include "base/in_flight.h"
#include "base/stopwatch.h"
#include "medial/measure.h"
#include "ops/level_walk.h"
#include "ops/summits.h"
#include "shape/around.h"
#include "shape/clean.h"
#include "shape/exterior.h"
#include "voronoi/axis_around.h"

namespace medial {
namespace {

using ops::LevelWalk;
using ops::OffsetRing;

double enclosed_area(const Ring& ring) {
  double doubled = 0;
  const std::size_t count = ring.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 a = ring.points[i], b = ring.points[i + 1 == count ? 0 : i + 1];
    doubled += cross(a - ring.points[0], b - ring.points[0]);
    if (!ring.bulges.empty() && ring.bulges[i] != 0)
      doubled += 2 * area_beside_chord({a, b, ring.bulges[i]});
  }
  return doubled / 2;
}

void reverse(Ring& ring) {
  std::reverse(ring.points.begin(), ring.points.end());
  if (ring.bulges.empty()) return;
  // The bulge of the edge after a point now belongs to the point before.
  std::reverse(ring.bulges.begin(), ring.bulges.end() - 1);
  for (double& bulge : ring.bulges) bulge = -bulge;
}

/// Loops of one level, sorted into regions by a key of each.
class Regions {
 public:
  explicit Regions(std::size_t keys) : region_of_(keys, no_region) {}

  /// Appends the regions of a level to `out`: of the loops with one key the one that encloses most
  /// is the outer ring. `lower` gives for the key of a region one level up its key now.
  template <class KeyOf, class Lower>
  void add(double clearance, std::vector<OffsetRing> loops, const KeyOf& key_of, const Lower& lower,
           std::vector<OffsetRegion>& out) {
    std::vector<std::uint32_t> keys;
    std::vector<double> largest;
    const std::size_t begin = out.size();
    for (OffsetRing& loop : loops) {
      const std::uint32_t key = key_of(loop);
      if (region_of_[key] == no_region || region_of_[key] < begin) {
        region_of_[key] = static_cast<std::uint32_t>(out.size());
        out.push_back({clearance, {}, no_region});
        keys.push_back(key);
        largest.push_back(-std::numeric_limits<double>::infinity());
      }
      OffsetRegion& region = out[region_of_[key]];
      const double enclosed = enclosed_area(loop.ring);
      double& most = largest[region_of_[key] - begin];
      region.rings.push_back(std::move(loop.ring));
      if (enclosed > most) {
        most = enclosed;
        std::swap(region.rings.front(), region.rings.back());
      }
    }
    for (std::size_t i = 0; i < upper_.size(); ++i) {
      const std::uint32_t region = region_of_[lower(upper_[i].key)];
      if (region != no_region && region >= begin) out[upper_[i].region].parent = region;
    }
    upper_.clear();
    for (std::size_t i = 0; i < keys.size(); ++i)
      upper_.push_back({static_cast<std::uint32_t>(begin + i), keys[i]});
  }

  /// The last region of a key, if it had any.
  std::uint32_t region_of(std::uint32_t key) const { return region_of_[key]; }

  /// Replaces the keys of the last level's regions by others.
  template <class Rename>
  void rename(std::size_t keys, const Rename& rename_key) {
    for (Upper& one : upper_) one.key = rename_key(one.key);
    set_keys(keys);
  }
  /// How many keys there are from now on.
  void set_keys(std::size_t keys) { region_of_.assign(keys, no_region); }

 private:
  struct Upper {
    std::uint32_t region, key;
  };
  std::vector<Upper> upper_;              ///< the regions of the level before
  std::vector<std::uint32_t> region_of_;  ///< of each key, the last one
};

/// The edges that come to count at each level, last level first or first level first.
std::vector<std::vector<std::uint32_t>> bins_of(const LevelWalk& walk, std::size_t edges,
                                                std::span<const double> levels, bool inside) {
  std::vector<std::vector<std::uint32_t>> bins(levels.size());
  for (std::uint32_t e = 0; e < edges; ++e) {
    const auto at = static_cast<std::size_t>(
        std::lower_bound(levels.begin(), levels.end(), walk.lowest(e)) - levels.begin());
    if (inside && at > 0) bins[at - 1].push_back(e);
    if (!inside && at < levels.size()) bins[at].push_back(e);
  }
  return bins;
}

/// Regions are numbered in 32 bits, and none has less than two points.
Status check_size(const LevelWalk& walk, std::span<const double> levels) {
  if (walk.points_at(levels) < no_region) return success();
  return Error{ErrorCode::too_large, "the offsets would have more than 2^32 points", {}};
}

/// Appends the regions above each level, last level first, which are connected along the axis.
/// Leaves nodes of the axis as keys.
Status add_inward(const MedialAxis& axis, std::span<const double> levels, Regions& regions,
                  std::vector<OffsetRegion>& out) {
  LevelWalk walk(axis);
  if (Status fits = check_size(walk, levels); !fits) return fits;
  const auto bins = bins_of(walk, axis.edges.size(), levels, true);
  DisjointSets sets(axis.nodes.size());
  walk.run(levels, [&](std::size_t k, std::vector<OffsetRing> loops) {
    for (const std::uint32_t e : bins[k]) sets.join(axis.edges[e].node[0], axis.edges[e].node[1]);
    regions.add(
        levels[k], std::move(loops), [&](const OffsetRing& loop) { return sets.find(loop.node); },
        [&](std::uint32_t node) { return sets.find(node); }, out);
  });
  return success();
}

/// Which components of the shape the exterior's sites belong to.
struct Surroundings {
  static constexpr std::uint32_t enclosure = 0xFFFFFFFF;
  std::vector<std::uint32_t> of_site;  ///< of each site: the component, or `enclosure`
  std::vector<std::uint32_t> of_part;  ///< of each component of the exterior: one that it touches
  /// Components of the shape that touch: neighbours along the boundary of the exterior.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> touching;
  std::size_t components = 0;                ///< of the shape
  std::vector<std::uint32_t> of_point = {};  ///< of a planar graph's points: their components
};

/// Sites are numbered in the order of the points, a vertex before the edge that starts there.
Surroundings surroundings_of(const Shape& shape, const Exterior& exterior, const MedialAxis& axis) {
  const auto component_at = [&](std::size_t point) {
    return exterior.of_enclosure[point] ? Surroundings::enclosure
                                        : shape.component[exterior.of_loop[point]];
  };
  Surroundings around;
  around.components = shape.component_count();
  around.of_site.reserve(axis.sites.size());
  std::size_t point = 0;
  for (const Site& site : axis.sites) {
    around.of_site.push_back(component_at(point));
    if (site.kind() != SiteKind::vertex) ++point;
  }
  around.of_part.resize(exterior.shape.component_count());
  for (std::size_t i = 0; i < exterior.shape.loop_count(); ++i) {
    const std::uint32_t begin = exterior.shape.loop_begin[i],
                        end = exterior.shape.loop_begin[i + 1];
    around.of_part[exterior.shape.component[i]] = component_at(begin);
    for (std::uint32_t p = begin + 1; p < end; ++p)
      if (component_at(p) != component_at(p - 1))
        around.touching.emplace_back(component_at(p - 1), component_at(p));
  }
  return around;
}

/// Appends the regions of the shape grown by each level, first level first: its components, which
/// are connected where the exterior's axis between two of them is below the level. Returns, of each
/// of `around.of_point`, the region of the first level that it lies in.
Result<std::vector<std::uint32_t>> add_outward(const MedialAxis& axis, const Surroundings& around,
                                               std::span<const double> levels, Regions& regions,
                                               std::vector<OffsetRegion>& out) {
  const auto component_of = [&](const OffsetRing& loop) {
    return loop.site != no_site ? around.of_site[loop.site]
                                : around.of_part[axis.nodes[loop.node].component];
  };
  LevelWalk walk(axis);
  if (Status fits = check_size(walk, levels); !fits) return std::move(fits).error();
  std::vector<std::vector<OffsetRing>> loops(levels.size());
  walk.run(levels,
           [&](std::size_t k, std::vector<OffsetRing> found) { loops[k] = std::move(found); });
  const auto bins = bins_of(walk, axis.edges.size(), levels, false);
  DisjointSets sets(around.components);
  for (const auto& [one, other] : around.touching) sets.join(one, other);
  std::vector<std::uint32_t> region_of_point;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    for (const std::uint32_t e : bins[k]) {
      const std::uint32_t left = around.of_site[axis.edges[e].site[0]];
      const std::uint32_t right = around.of_site[axis.edges[e].site[1]];
      if (left != Surroundings::enclosure && right != Surroundings::enclosure)
        sets.join(left, right);
    }
    std::vector<OffsetRing> own;
    for (OffsetRing& loop : loops[k]) {
      if (component_of(loop) == Surroundings::enclosure) continue;  // the enclosure's own offset
      reverse(loop.ring);
      own.push_back(std::move(loop));
    }
    regions.add(
        -levels[k], std::move(own),
        [&](const OffsetRing& loop) { return sets.find(component_of(loop)); },
        [&](std::uint32_t component) { return sets.find(component); }, out);
    if (k > 0) continue;
    for (const std::uint32_t component : around.of_point)
      region_of_point.push_back(regions.region_of(sets.find(component)));
  }
  return region_of_point;
}

/// The same for a planar graph: what its points and edges connect is a component.
Surroundings surroundings_of(const PlanarGraph& planar_graph, const Shape& surroundings,
                             const MedialAxis& axis) {
  DisjointSets sets(planar_graph.points.size());
  for (const PlanarGraphEdge& edge : planar_graph.edges) sets.join(edge.from, edge.to);
  Surroundings around;
  around.components = planar_graph.points.size();
  const auto component_of = [&](std::uint32_t point) {
    return point == no_index ? Surroundings::enclosure : sets.find(point);
  };
  for (std::uint32_t point = 0; point < planar_graph.points.size(); ++point)
    around.of_point.push_back(sets.find(point));
  around.of_site.reserve(axis.sites.size());
  for (const Site& site : axis.sites) around.of_site.push_back(component_of(site.ring));
  around.of_part.resize(surroundings.component_count());
  for (std::size_t i = 0; i < surroundings.loop_count(); ++i)
    around.of_part[surroundings.component[i]] =
        component_of(surroundings.sources[surroundings.loop_begin[i]].ring);
  return around;
}

/// Puts regions in the order of increasing clearance, and gives rings their roles.
void finish(Offsets& offsets) {
  auto& regions = offsets.regions;
  std::reverse(regions.begin(), regions.end());
  for (std::uint32_t& region : offsets.region_of_point)
    if (region != no_region) region = static_cast<std::uint32_t>(regions.size() - 1) - region;
  for (OffsetRegion& region : regions) {
    if (region.parent != no_region)
      region.parent = static_cast<std::uint32_t>(regions.size() - 1) - region.parent;
    for (Ring& ring : region.rings) ring.role = RingRole::hole;
    region.rings.front().role = RingRole::outer;
  }
}

std::vector<double> increasing(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// No distance is larger than that, in diagonals.
constexpr double farthest = 1e5;
/// How many times the largest distance the enclosure is away: more than twice, so that no curve is
/// nearer to it.
constexpr double reach = 2.5;

Error not_exact() {
  return {ErrorCode::unsupported, "offsets are walked along exact axes only", {}};
}
Error invalid_offset(const char* text) { return {ErrorCode::invalid_option, text, {}}; }

/// Offsets in the making, axis by axis.
struct Making {
  Offsets offsets;
  Regions regions{0};
  Stopwatch watch;

  /// Takes an axis, and prepares it for the walk.
  Status take(Result<MedialAxis>& axis) {
    if (!axis) return std::move(axis).error();
    if (axis->resolution > 0) return not_exact();
    offsets.seconds_axis += watch.lap();
    offsets.tolerance = std::max(offsets.tolerance, axis->tolerance);
    ops::divide_at_summits(*axis);
    return success();
  }
  Offsets done() {
    finish(offsets);
    offsets.seconds_curves += watch.lap();
    return std::move(offsets);
  }
};

Result<Offsets> offset_both_sides(const Shape& shape, std::span<const double> clearances,
                                  const Options& options) {
  std::vector<double> inside, outside;
  if (shape.points.empty()) return Error{ErrorCode::empty, "the shape is empty", {}};
  const Box box = bounding_box(shape);
  for (const double c : clearances) {
    if (!std::isfinite(c) || c == 0) return invalid_offset("a distance must be finite and not 0");
    if (-c > farthest * diagonal(box))
      return invalid_offset("a distance outwards is above 1e5 diagonals");
    (c > 0 ? inside : outside).push_back(std::abs(c));
  }
  inside = increasing(std::move(inside));
  outside = increasing(std::move(outside));
  Options own = options;
  own.exterior = false;
  Making making;
  if (!inside.empty()) {
    auto axis = compute(shape, own);
    if (Status taken = making.take(axis); !taken) return std::move(taken).error();
    making.regions.set_keys(axis->nodes.size());
    if (Status added = add_inward(*axis, inside, making.regions, making.offsets.regions); !added)
      return std::move(added).error();
    making.regions.rename(0, [&](std::uint32_t node) { return axis->nodes[node].component; });
    making.offsets.seconds_curves += making.watch.lap();
  }
  if (!outside.empty()) {
    const double margin = std::max(reach * outside.back(), 0.1 * margin_for(box, 0));
    auto exterior = exterior_of(shape, margin);
    if (!exterior) return std::move(exterior).error();
    auto axis = compute(exterior->shape, own);
    if (Status taken = making.take(axis); !taken) return std::move(taken).error();
    making.regions.set_keys(shape.component_count());
    const auto added = add_outward(*axis, surroundings_of(shape, *exterior, *axis), outside,
                                   making.regions, making.offsets.regions);
    if (!added) return added.error();
  }
  return making.done();
}

Result<Offsets> buffers_of(const PlanarGraph& planar_graph, std::span<const double> given,
                           const Options& options) {
  if (planar_graph.points.empty()) return Error{ErrorCode::empty, "there is no point", {}};
  const Box box = bounding_box(planar_graph);
  const double size = diagonal(box);
  for (const double d : given) {
    if (!(d > 0) || !std::isfinite(d))
      return invalid_offset("a distance must be positive and finite");
    if (size > 0 && d > farthest * size) return invalid_offset("a distance is above 1e5 diagonals");
  }
  if (given.empty()) return Offsets{};
  const std::vector<double> distances = increasing({given.begin(), given.end()});
  Making making;
  const double margin = std::max(reach * distances.back(), 0.1 * size);
  const Shape surroundings =
      around(planar_graph, {box.low - Vec2{margin, margin}, box.high + Vec2{margin, margin}});
  auto axis = axis_around(planar_graph, surroundings, options);
  if (Status taken = making.take(axis); !taken) return std::move(taken).error();
  making.regions.set_keys(planar_graph.points.size());
  auto added = add_outward(*axis, surroundings_of(planar_graph, surroundings, *axis), distances,
                           making.regions, making.offsets.regions);
  if (!added) return std::move(added).error();
  making.offsets.region_of_point = std::move(added).value();
  return making.done();
}

}  // namespace

Result<Offsets> inward_offsets(const MedialAxis& axis, std::span<const double> clearances) {
  if (axis.resolution > 0) return not_exact();
  if (axis.exterior > 0)
    return Error{ErrorCode::unsupported, "the axis is one of the exterior", {}};
  for (const double c : clearances)
    if (!(c > 0) || !std::isfinite(c))
      return invalid_offset("a distance must be positive and finite");
  return guarded([&]() -> Result<Offsets> {
    Stopwatch walking;
    MedialAxis divided;
    if (ops::has_summits(axis)) {
      divided = axis;
      ops::divide_at_summits(divided);
    }
    const MedialAxis& own = divided.nodes.empty() ? axis : divided;
    Offsets offsets;
    offsets.tolerance = own.tolerance;
    Regions regions(own.nodes.size());
    Status added = add_inward(own, increasing({clearances.begin(), clearances.end()}), regions,
                              offsets.regions);
    if (!added) return std::move(added).error();
    finish(offsets);
    offsets.seconds_curves = walking.lap();
    return offsets;
  });
}

Result<Offsets> offset_curves(const Shape& shape, std::span<const double> clearances,
                              const Options& options) {
  return guarded([&] { return offset_both_sides(shape, clearances, options); });
}

Result<Offsets> offset_curves(const PlanarGraph& planar_graph, std::span<const double> distances,
                              const Options& options) {
  return guarded([&] { return buffers_of(planar_graph, distances, options); });
}

Result<std::vector<double>> offset_passes(const MedialAxis& axis, double first, double step) {
  constexpr double most = 1e6;
  if (!(first > 0 && step > 0 && std::isfinite(first) && std::isfinite(step)))
    return invalid_offset("a step must be positive and finite");
  std::vector<double> passes;
  const double deepest = axis.nodes.empty() ? 0 : deepest_disk(axis).radius - axis.tolerance;
  if ((deepest - first) / step > most)
    return Error{ErrorCode::too_large, "more than 1e6 passes: the step is too small", {}};
  for (double c = first; c < deepest; c = first + static_cast<double>(passes.size()) * step)
    passes.push_back(c);
  return passes;
}

double length(const OffsetRegion& region) {
  double sum = 0;
  for (const Ring& ring : region.rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const Vec2 chord = ring.points[i + 1 == ring.points.size() ? 0 : i + 1] - ring.points[i];
      sum += arc_length(norm(chord), ring.bulges.empty() ? 0 : ring.bulges[i]);
    }
  }
  return sum;
}

double area(const OffsetRegion& region) {
  double sum = 0;
  for (const Ring& ring : region.rings) sum += enclosed_area(ring);
  return sum;
}

}  // namespace medial
