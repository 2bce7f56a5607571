#include <utility>

#include "base/in_flight.h"
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

/// Polygons take the exact path, shapes with arcs or crossings the one with a tolerance.
Result<Arrangement> arrange(CleanRings cleaned, const ShapeOptions& options, ShapeReport& report) {
  if (options.node_crossings) cleaned.bulges.resize(cleaned.points.size());
  if (!cleaned.bulges.empty()) {
    Result<SweptArcs> swept = sweep_arcs(cleaned, options.node_crossings);
    if (!swept) return std::move(swept).error();
    report.crossings = swept->crossings;
    report.touching_vertices = swept->sweep.place_count;
    report.split_edges = swept->split_edges;
    return arrange_arcs(std::move(swept).value());
  }
  Result<Sweep> swept = sweep(cleaned);
  if (!swept) return std::move(swept).error();
  report.touching_vertices = swept->place_count;
  report.split_edges = swept->splits.size();
  return insert_splits(std::move(cleaned), std::move(swept).value());
}

Result<Shape> build_once(std::span<const Ring> rings, const ShapeOptions& options,
                         ShapeReport& report) {
  Result<CleanRings> cleaned = clean(rings, report);
  if (!cleaned) return std::move(cleaned).error();
  if (!options.node_crossings)
    if (auto shape = simple_polygon(rings, *cleaned, report)) return *std::move(shape);

  Result<Arrangement> arranged = arrange(std::move(cleaned).value(), options, report);
  if (!arranged) return std::move(arranged).error();
  Arrangement& arrangement = *arranged;
  report.dropped_rings = apply_winding(rings, arrangement);
  report.reversed_rings = count_reversed(arrangement);

  Result<SplicedLoops> loops = splice(rings, arrangement);
  if (!loops) return std::move(loops).error();
  if (auto error = nest(arrangement, *loops)) return std::move(*error);
  if (auto error = check_roles(rings, arrangement, *loops)) return std::move(*error);
  Shape shape = assemble(arrangement, *loops);
  if (shape.points.empty())
    return error_of_ring(ErrorCode::no_area, "the ring encloses no area", 0);
  return shape;
}

/// Whether rings that are cut into a planar graph may still make a shape.
bool may_be_filled(const Error& error) {
  return error.code != ErrorCode::not_finite && error.code != ErrorCode::too_large &&
         error.code != ErrorCode::empty && error.code != ErrorCode::out_of_memory;
}

Result<Shape> build(std::span<const Ring> rings, const ShapeOptions& options, ShapeReport& report) {
  Result<Shape> shape = build_once(rings, options, report);
  if (shape || !options.node_crossings || !may_be_filled(shape.error())) return shape;
  report = {};
  const Result<FilledRings> filled = fill(rings, report);
  if (!filled) return filled.error();
  ShapeReport of_filled;
  shape = build_once(filled->rings, options, of_filled);
  if (!shape) return shape;
  for (VertexSource& source : shape->sources) source = filled->sources[source.ring][source.vertex];
  return shape;
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
