#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/counted.h"
#include "curve/bezier.h"
#include "curve/fit.h"
#include "load/left_out.h"
#include "load/progress.h"
#include "load/suited_arcs.h"
#include "load/threads_of.h"
#include "medial/load.h"
#include "medial/methods.h"
#include "methods/curve_axis/fits.h"
#include "shape/clean.h"

namespace medial {
namespace {

ShapeReport& operator+=(ShapeReport& sum, const ShapeReport& part) {
  for (const auto count :
       {&ShapeReport::input_rings, &ShapeReport::input_points, &ShapeReport::closing_points,
        &ShapeReport::unclosed_rings, &ShapeReport::repeated_points, &ShapeReport::collinear_points,
        &ShapeReport::reversed_rings, &ShapeReport::touching_vertices, &ShapeReport::split_edges,
        &ShapeReport::crossings, &ShapeReport::dropped_rings})
    sum.*count += part.*count;
  return sum;
}

ArcReport& operator+=(ArcReport& sum, const ArcReport& part) {
  for (const auto count :
       {&ArcReport::pieces, &ArcReport::spirals, &ArcReport::arcs, &ArcReport::segments})
    sum.*count += part.*count;
  sum.tolerance = std::max(sum.tolerance, part.tolerance);
  sum.largest_error = std::max(sum.largest_error, part.largest_error);
  return sum;
}

/// Sets the roles of rings for a rule.
void apply_rule(RepairRule rule, std::vector<Ring>& rings) {
  for (Ring& ring : rings) {
    if (rule == RepairRule::non_zero)
      ring.role = RingRole::winding;
    else if (rule == RepairRule::even_odd || ring.role != RingRole::winding)
      ring.role = RingRole::any;
  }
}

/// The boundary as contours: those given, or the rings.
std::vector<Contour> contours_of(const std::vector<Ring>& rings, std::vector<Contour> contours) {
  for (const Ring& ring : rings)
    if (!ring.points.empty()) contours.push_back(contour_of(ring.points, ring.bulges, true));
  return contours;
}

/// Whether a repair may resolve the error.
bool is_tangled(const Error& error) {
  constexpr ErrorCode codes[] = {ErrorCode::crossing,     ErrorCode::overlap,
                                 ErrorCode::hole_outside, ErrorCode::nested_outer,
                                 ErrorCode::no_area,      ErrorCode::too_few_points};
  return std::find(std::begin(codes), std::end(codes), error.code) != std::end(codes);
}

/// The shape of a feature's rings. Frees the rings as soon as they are no longer needed.
Result<Shape> shape_of(Feature& feature, const LoadOptions& options, LoadReport& report) {
  std::vector<Ring> rings = std::move(feature.rings);
  const bool curved = !feature.contours.empty() ||
                      std::any_of(rings.begin(), rings.end(),
                                  [](const Ring& ring) { return !ring.bulges.empty(); });
  if (!feature.contours.empty()) {
    auto approximated = approximate_by_arcs(feature.contours, options.arcs, &report.arcs);
    if (!approximated) return std::move(approximated).error();
    std::move(approximated->begin(), approximated->end(), std::back_inserter(rings));
    feature.contours = {};
  }
  const bool repaired = options.repair != RepairRule::none;
  // A requested rule also applies to rings that do not cross.
  if (repaired && options.repair != RepairRule::make_valid) apply_rule(options.repair, rings);
  if (!repaired || !curved) {
    auto shape = build_shape(rings, {}, &report.shapes);
    if (shape || !(repaired || feature.filled) || !is_tangled(shape.error())) return shape;
  }
  if (options.repair == RepairRule::make_valid) apply_rule(options.repair, rings);
  report.shapes = {};
  return build_shape(rings, {.node_crossings = true}, &report.shapes);
}

/// Replaces the sources, which are indices in the rings, by the feature's own sources.
void keep_sources(Shape& shape, const Feature& feature,
                  const std::vector<std::size_t>& ring_begin) {
  if (feature.sources.empty() || feature.sources.size() != ring_begin.back()) return;
  for (VertexSource& source : shape.sources)
    if (source.ring + 1 < ring_begin.size())  // later rings come from curves
      source = feature.sources[ring_begin[source.ring] + source.vertex];
}

/// The shape bounded by smooth curves instead. If they bound none, the error suggests a fit that
/// works.
Result<Shape> smooth_shape(const std::vector<Contour>& contours, const LoadOptions& options,
                           LoadReport& report) {
  std::vector<std::vector<Vec2>> polygons;
  for (const Contour& contour : contours) polygons.push_back(curve::polygon_of(contour));
  const auto smooth = [&]() -> Result<Shape> {
    const auto curves = curve::fit_loops(polygons, options.fit);
    if (!curves) return curves.error();
    report.specks = contours.size() - curves->size();
    const auto rings = approximate_by_arcs(*curves, options.arcs);
    if (!rings) return rings.error();
    return build_shape(*rings);
  };
  auto shape = smooth();
  if (shape) return shape;
  return curve_axis::with_fit_that_does(std::move(shape).error(), polygons, {.fit = options.fit},
                                        options.cancel);
}

Result<ShapeItem> load_shape(Feature& feature, const LoadOptions& options, LoadReport& report) {
  ShapeItem item;
  item.attributes = std::move(feature.attributes);
  const bool has_contours = options.keep_contours || options.fit > 0;
  if (has_contours) item.contours = contours_of(feature.rings, feature.contours);
  std::vector<std::size_t> ring_begin{0};
  for (const Ring& ring : feature.rings)
    ring_begin.push_back(ring_begin.back() + ring.points.size());
  auto shape = shape_of(feature, options, report);
  if (!shape) return std::move(shape).error();
  keep_sources(*shape, feature, ring_begin);
  const bool is_repaired = report.shapes.crossings + report.shapes.dropped_rings > 0;
  if (has_contours && is_repaired) item.contours = contours_of(rings_of(*shape), {});
  if (options.fit > 0) shape = smooth_shape(item.contours, options, report);
  if (!shape) return std::move(shape).error();
  item.shape = std::move(shape).value();
  if (!options.keep_contours) item.contours = {};
  return item;
}

double weight_of(const Feature& feature) {
  std::size_t points = 1;
  for (const Ring& ring : feature.rings) points += ring.points.size();
  for (const Contour& contour : feature.contours) points += contour.points.size();
  return static_cast<double>(points);
}

std::string note_of_crossings(std::size_t feature, const ShapeReport& report, std::size_t loops) {
  return "feature " + std::to_string(feature) + " was repaired: its edges cross or overlap in " +
         counted(report.crossings, "place") + " and are split there; " +
         counted(report.input_rings, "ring") + " before, " + counted(loops, "loop") + " after";
}

/// One note for all drawings and letters, whose outlines may cross.
std::string note_of_outlines(std::size_t features, std::uint64_t places) {
  return "the outlines of " + counted(features, "feature") + " cross or overlap in " +
         counted(places, "place") + " and are split there";
}

std::string note_of_specks(std::size_t feature, std::uint64_t loops) {
  return "feature " + std::to_string(feature) + ": " + counted(loops, "loop") +
         (loops == 1 ? " within a disk as large as --fit is"
                     : " within disks as large as --fit are") +
         " left out";
}

/// A feature's shape or error, and notes on omitted parts.
struct Attempt {
  ShapeItem item;
  std::optional<Error> error;
  std::vector<std::string> notes;
};

/// Removes the rings of a polygon that enclose no area, with a note each, and their sources, which
/// correspond to points.
void drop_rings_without_area(Feature& feature, std::size_t index, Attempt& attempt) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < feature.rings.size(); ++i) {
    ShapeReport ignored;
    const auto clean_ring = clean(std::span(&feature.rings[i], 1), ignored);
    if (clean_ring || (clean_ring.error().code != ErrorCode::too_few_points &&
                       clean_ring.error().code != ErrorCode::no_area)) {
      rings.push_back(std::move(feature.rings[i]));
      continue;
    }
    Error error = clean_ring.error();
    error.place.feature = index;
    error.place.ring = i;
    attempt.notes.push_back(note_of_left_out(error));
  }
  if (!attempt.notes.empty()) feature.sources.clear();
  feature.rings = std::move(rings);
}

/// The range of rings of the polygon that a ring belongs to, beginning with its outer ring; all
/// rings if they have no roles.
std::pair<std::size_t, std::size_t> polygon_around(const std::vector<Ring>& rings,
                                                   std::size_t ring) {
  const auto is = [&rings](std::size_t i, RingRole role) { return rings[i].role == role; };
  if (!is(0, RingRole::outer)) return {0, rings.size()};
  std::size_t begin = ring, end = ring + 1;
  while (begin > 0 && !is(begin, RingRole::outer)) --begin;
  while (end < rings.size() && is(end, RingRole::hole)) ++end;
  return {begin, end};
}

/// The shape of a feature without its invalid polygons: while there is an error, removes the
/// polygon that it names. O(n log n) for each.
Result<ShapeItem> load_valid_polygons(Feature left, std::size_t index, const LoadOptions& options,
                                      LoadReport& report, Attempt& attempt) {
  std::vector<std::size_t> numbers(left.rings.size());  // of the rings that are left
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  constexpr std::size_t most = 1000;
  for (std::size_t dropped = 0;; ++dropped) {
    Feature feature = left;
    report = {};
    auto item = load_shape(feature, options, report);
    if (item || dropped == most || !item.error().place.ring) return item;
    const auto [begin, end] = polygon_around(left.rings, *item.error().place.ring);
    if (begin == 0 && end == left.rings.size()) return item;
    left.sources.clear();  // which count points
    Error error = std::move(item).error();
    error.place.feature = index;
    error.place.ring = numbers[*error.place.ring];
    attempt.notes.push_back("left out with its polygon: " + to_string(error));
    const auto drop = [begin = begin, end = end](auto& list) {
      const auto at = [&](std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
      list.erase(at(begin), at(end));
    };
    drop(left.rings);
    drop(numbers);
  }
}

/// Collects the valid items. Leaves out the features with an error, with a note for each and one
/// with their number.
Status take_valid(std::vector<Attempt> attempts, const Document<Feature>& features,
                  const LoadOptions& options, Document<ShapeItem>& shapes) {
  std::vector<std::size_t> kept;
  std::optional<Error> first;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    Attempt& attempt = attempts[i];
    std::move(attempt.notes.begin(), attempt.notes.end(), std::back_inserter(shapes.notes));
    shapes.items.push_back(std::move(attempt.item));
    if (!attempt.error) {
      kept.push_back(i);
      continue;
    }
    attempt.error->place.feature = features.index_of(i);
    shapes.notes.push_back(note_of_left_out(*attempt.error));
    if (!first) first = std::move(attempt.error);
  }
  const std::size_t dropped = attempts.size() - kept.size();
  if (dropped == 0) return success();
  shapes.keep(kept);
  if (shapes.items.empty() && !options.part && !options.skip_invalid) {
    first->text += "; no feature is valid, so nothing is left";
    return *first;
  }
  if (options.part) return success();
  shapes.notes.push_back(invalid_left_out(dropped, attempts.size()) +
                         (is_tangled(*first) ? "; --repair repairs such rings" : ""));
  return success();
}

}  // namespace

LoadReport& LoadReport::operator+=(const LoadReport& part) {
  shapes += part.shapes;
  arcs += part.arcs;
  features += part.features;
  left_out += part.left_out;
  specks += part.specks;
  return *this;
}

Result<Document<ShapeItem>> load_shapes(Document<Feature> features, const LoadOptions& options,
                                        LoadReport* report) {
  const std::size_t count = features.items.size();
  Document<ShapeItem> shapes{features, {}};
  std::vector<LoadReport> reports(count);
  std::vector<double> weights;
  for (const Feature& feature : features.items) weights.push_back(weight_of(feature));
  SharedProgress progress(options.progress, std::accumulate(weights.begin(), weights.end(), 0.0));
  std::vector<Attempt> attempts(count);
  const auto load = [&](std::size_t i, int threads) -> Status {
    LoadOptions own = options;
    own.arcs = suited_arcs(own.arcs, features);
    own.arcs.threads = threads;
    Attempt& attempt = attempts[i];
    Feature& feature = features.items[i];
    const bool filled = feature.filled;
    if (options.skip_invalid) drop_rings_without_area(feature, features.index_of(i), attempt);
    const bool by_polygon =
        options.skip_invalid && feature.rings.size() > 1 && feature.contours.empty();
    auto item = by_polygon ? load_valid_polygons(std::move(feature), features.index_of(i), own,
                                                 reports[i], attempt)
                           : load_shape(feature, own, reports[i]);
    if (const auto done = progress.part(weights[i])) done(1);
    if (item) attempt.item = std::move(item).value();
    if (item) return success();
    // A drawing may paint nothing.
    const bool paints_nothing = filled && item.error().code == ErrorCode::no_area;
    if (!options.skip_invalid && !(paints_nothing && count > 1)) return std::move(item).error();
    attempt.error = std::move(item).error();
    return success();
  };
  const auto loaded = for_each_feature(features, weights, threads_of(weights, options), load,
                                       nullptr, options.cancel);
  if (!loaded) return loaded.error();
  LoadReport sum;
  std::size_t outlines = 0, places = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const ShapeReport& one = reports[i].shapes;
    if (const Attempt& attempt = attempts[i]; one.crossings > 0 && !attempt.error) {
      if (features.items[i].filled && options.repair == RepairRule::none)
        ++outlines, places += one.crossings;
      else
        shapes.notes.push_back(
            note_of_crossings(features.index_of(i), one, attempt.item.shape.loop_count()));
    }
    if (reports[i].specks > 0 && !attempts[i].error)
      shapes.notes.push_back(note_of_specks(features.index_of(i), reports[i].specks));
    sum.shapes += one;
    sum.specks += reports[i].specks;
    sum.arcs += reports[i].arcs;
  }
  if (outlines > 0) shapes.notes.push_back(note_of_outlines(outlines, places));
  if (Status taken = take_valid(std::move(attempts), features, options, shapes); !taken)
    return std::move(taken).error();
  sum.features = count;
  sum.left_out = count - shapes.items.size();
  if (report != nullptr) *report = sum;
  return shapes;
}

}  // namespace medial
