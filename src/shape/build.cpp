#include <algorithm>
#include <cmath>
#include <utility>

#include "base/in_flight.h"
#include "base/predicates.h"
#include "base/tolerance.h"
#include "medial/shape.h"
#include "shape/clean.h"
#include "shape/errors.h"
#include "shape/fill.h"
#include "shape/nest.h"
#include "shape/simple_polygon.h"
#include "shape/splice.h"
#include "shape/sweep.h"
#include "shape/winding.h"

namespace medial {
namespace {

std::uint64_t count_reversed(const Arrangement& arrangement) {
  std::uint64_t count = 0;
  for (std::size_t ring = 0; ring + 1 < arrangement.begin.size(); ++ring) {
    const std::uint32_t first = arrangement.begin[ring];
    if (!arrangement.interior_left[first] && !arrangement.is_dropped(first)) ++count;
  }
  return count;
}

/// Uses exact decisions for polygons, and a tolerance for shapes with arcs or crossings. Sets
/// `may_merge` if consecutive arcs of one circle are possible, because rings touch or edges were
/// divided or dropped.
Result<Arrangement> arrange(CleanRings cleaned, const ShapeOptions& options, ShapeReport& report,
                            bool& may_merge) {
  may_merge = false;
  if (options.node_crossings) cleaned.bulges.resize(cleaned.points.size());
  if (!cleaned.bulges.empty()) {
    Result<SweptArcs> swept = sweep_arcs(cleaned, options.node_crossings);
    if (!swept) return std::move(swept).error();
    report.crossings = swept->crossings;
    report.touching_vertices = swept->sweep.place_count;
    report.split_edges = swept->split_edges;
    may_merge = swept->is_changed || swept->sweep.place_count > 0;
    return arrange_arcs(std::move(swept).value());
  }
  Result<Sweep> swept = sweep(cleaned);
  if (!swept) return std::move(swept).error();
  report.touching_vertices = swept->place_count;
  report.split_edges = swept->splits.size();
  return insert_splits(std::move(cleaned), std::move(swept).value());
}

Result<Shape> build_once(std::span<const Ring> rings, const ShapeOptions& options,
                         ShapeReport& report, bool& may_merge) {
  may_merge = false;
  Result<CleanRings> cleaned = clean(rings, report);
  if (!cleaned) return std::move(cleaned).error();
  if (!options.node_crossings)
    if (auto shape = simple_polygon(rings, *cleaned, report)) return *std::move(shape);

  Result<Arrangement> arranged = arrange(std::move(cleaned).value(), options, report, may_merge);
  if (!arranged) return std::move(arranged).error();
  Arrangement& arrangement = *arranged;
  report.dropped_rings = apply_winding(rings, arrangement);
  report.reversed_rings = count_reversed(arrangement);

  Result<SplicedLoops> loops = splice(rings, arrangement);
  if (!loops) return std::move(loops).error();
  if (auto error = nest(arrangement, *loops)) return std::move(*error);
  if (auto error = check_roles(rings, arrangement, *loops)) return std::move(*error);
  Result<Shape> shape = assemble(arrangement, *loops);
  if (shape && shape->points.empty())
    return error_of_ring(ErrorCode::no_area, "the ring encloses no area", 0);
  return shape;
}

/// Whether rings that are cut into a planar graph may still make a shape.
bool may_be_filled(const Error& error) {
  return error.code != ErrorCode::not_finite && error.code != ErrorCode::too_large &&
         error.code != ErrorCode::empty && error.code != ErrorCode::out_of_memory;
}

/// Builds the shape again, which merges consecutive arcs of one circle. A merged arc may touch
/// more, so this is repeated until nothing changes, at most a fixed number of times. Errors:
/// no_area (a loop vanishes); crossing (edges cross by little more than the tolerance, so the
/// result is no shape); those of build_once().
Result<Shape> with_arcs_merged(Shape shape) {
  constexpr int most_rounds = 16;
  bool may_merge = true;
  for (int round = 0; may_merge && round < most_rounds; ++round) {
    const std::vector<Ring> rings = rings_of(shape);
    ShapeReport report;
    Result<Shape> again = build_once(rings, {}, report, may_merge);
    const auto source_of = [&shape](std::size_t ring, std::size_t vertex) {
      return shape.sources[shape.loop_begin[ring] + vertex];
    };
    if (!again) {
      const Place& place = again.error().place;
      const std::size_t ring = place.ring.value_or(0), vertex = place.vertex.value_or(0);
      const VertexSource source = source_of(ring, vertex);
      if (again.error().code == ErrorCode::no_area)
        return error_of_ring(ErrorCode::no_area, "the ring encloses no area", source.ring);
      if (may_be_filled(again.error()))
        return error_at(ErrorCode::crossing, "edges cross next to this vertex", source,
                        rings[ring].points[vertex]);
      return std::move(again).error();
    }
    may_merge = may_merge && (again->points != shape.points || again->bulges != shape.bulges);
    for (VertexSource& source : again->sources) source = source_of(source.ring, source.vertex);
    shape = *std::move(again);
  }
  return shape;
}

/// Finds vertices on straight lines that are corners only because noding rounded them or a
/// neighbour: noding split a straight edge there, and the crossing edge is now inside. Each such
/// corner would have a branch of the axis.
class FlatVertices {
 public:
  FlatVertices(std::span<const Ring> rings, const Shape& shape)
      : rings_(rings), shape_(shape), points_(shape.points), flat_(shape.points.size()) {
    Box box = Box::nothing();
    for (const Vec2 p : points_) box.add(p);
    tolerance_ = tolerance_for(box, 0);
    std::sort(points_.begin(), points_.end(), lexicographic_less);
    for (std::size_t i = 0; i < shape.loop_count(); ++i) find_in_loop(i);
  }
  bool operator[](std::size_t vertex) const { return flat_[vertex]; }

 private:
  void find_in_loop(std::size_t loop) {
    const std::size_t first = shape_.loop_begin[loop], size = shape_.loop(loop).size();
    const auto at = [&](std::size_t k) { return first + k % size; };
    std::size_t start = 0;
    while (start < size && is_flat(at(start + size - 1), at(start), at(start + 1))) ++start;
    std::size_t before = at(start), left = size;
    for (std::size_t k = start + 1; k < start + size; ++k) {
      constexpr std::size_t fewest = 3;
      flat_[at(k)] = left > fewest && is_flat(before, at(k), at(k + 1));
      if (flat_[at(k)])
        --left;
      else
        before = at(k);
    }
  }
  bool is_flat(std::size_t before, std::size_t vertex, std::size_t after) const {
    if (shape_.bulge(before) != 0 || shape_.bulge(vertex) != 0 || is_shared(vertex)) return false;
    if (!is_new(before) && !is_new(vertex) && !is_new(after)) return false;
    const Vec2 from = shape_.points[before], chord = shape_.points[after] - from,
               way = shape_.points[vertex] - from;
    return std::abs(cross(chord, way)) <= tolerance_ * norm(chord) && dot(chord, way) > 0 &&
           dot(chord, chord - way) > 0;
  }
  /// Whether noding made the vertex, or moved it.
  bool is_new(std::size_t vertex) const {
    const VertexSource source = shape_.sources[vertex];
    return rings_[source.ring].points[source.vertex] != shape_.points[vertex];
  }
  /// Whether loops touch there.
  bool is_shared(std::size_t vertex) const {
    const auto [low, high] =
        std::equal_range(points_.begin(), points_.end(), shape_.points[vertex], lexicographic_less);
    return high - low > 1;
  }

  std::span<const Ring> rings_;
  const Shape& shape_;
  std::vector<Vec2> points_;  ///< sorted
  std::vector<bool> flat_;
  double tolerance_ = 0;
};

Shape without_flat_vertices(std::span<const Ring> rings, Shape shape) {
  const FlatVertices flat(rings, shape);
  std::vector<std::uint32_t> begin{0};
  std::uint32_t kept = 0;
  for (std::size_t loop = 0; loop < shape.loop_count(); ++loop) {
    for (std::size_t v = shape.loop_begin[loop]; v < shape.loop_begin[loop + 1]; ++v) {
      if (flat[v]) continue;
      shape.points[kept] = shape.points[v];
      shape.sources[kept] = shape.sources[v];
      if (!shape.bulges.empty()) shape.bulges[kept] = shape.bulges[v];
      ++kept;
    }
    begin.push_back(kept);
  }
  shape.loop_begin = std::move(begin);
  shape.points.resize(kept);
  shape.sources.resize(kept);
  if (!shape.bulges.empty()) shape.bulges.resize(kept);
  return shape;
}

Result<Shape> build(std::span<const Ring> rings, const ShapeOptions& options, ShapeReport& report) {
  bool may_merge = false;
  Result<Shape> shape = build_once(rings, options, report, may_merge);
  if (shape && may_merge && !shape->bulges.empty())
    shape = with_arcs_merged(std::move(shape).value());
  if (shape && report.crossings > 0) return without_flat_vertices(rings, std::move(shape).value());
  if (shape || !options.node_crossings || !may_be_filled(shape.error())) return shape;
  report = {};
  const Result<FilledRings> filled = fill(rings, report);
  if (!filled) return filled.error();
  ShapeReport of_filled;
  shape = build_once(filled->rings, options, of_filled, may_merge);
  if (!shape) return shape;
  for (VertexSource& source : shape->sources) source = filled->sources[source.ring][source.vertex];
  return without_flat_vertices(rings, std::move(shape).value());
}

}  // namespace

Result<Shape> build_shape(std::span<const Ring> rings, const ShapeOptions& options,
                          ShapeReport* report) {
  try {
    ShapeReport counted;
    Result<Shape> shape = build(rings, options, counted);
    if (report) *report = counted;
    return shape;
  } catch (...) {
    return error_in_flight();
  }
}

}  // namespace medial
