// From features to shapes, planar graphs and axes: fill rules, curves to arcs, repair, noding,
// loose lines, and errors that name the place in the file.

#include "medial/load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "medial/query.h"
#include "support/contours.h"

namespace medial {
namespace {

Ring square(double low, double high, RingRole role = RingRole::any) {
  return {{{low, low}, {high, low}, {high, high}, {low, high}}, role};
}
Ring clockwise(Ring ring) {
  std::reverse(ring.points.begin(), ring.points.end());
  return ring;
}

Feature feature_of(std::vector<Ring> rings) {
  Feature feature;
  feature.rings = std::move(rings);
  return feature;
}
Document<Feature> document_of(std::vector<Feature> features) {
  Document<Feature> document;
  document.items = std::move(features);
  return document;
}

Result<Document<ShapeItem>> load(std::vector<Feature> features, const LoadOptions& options = {},
                                 LoadReport* report = nullptr) {
  return load_shapes(document_of(std::move(features)), options, report);
}

LoadOptions by(RepairRule rule) {
  LoadOptions options;
  options.repair = rule;
  return options;
}

/// The area of one feature's shape; NaN after an error.
double area_of(std::vector<Ring> rings, const LoadOptions& options = {}) {
  const auto loaded = load({feature_of(std::move(rings))}, options);
  EXPECT_TRUE(loaded.ok()) << (loaded ? "" : to_string(loaded.error()));
  return loaded ? area(loaded->items.at(0).shape) : std::numeric_limits<double>::quiet_NaN();
}

/// Two squares of side 4 that share a square of side 2: 28 in their union, 24 without that.
std::vector<Ring> overlapping(RingRole role) { return {square(0, 4, role), square(2, 6, role)}; }

TEST(Load, RingsFollowTheirOwnFillRule) {
  EXPECT_EQ(area_of({square(0, 6), square(1, 5), square(2, 4)}), 36 - 16 + 4);
  const auto winding = RingRole::winding;
  EXPECT_EQ(area_of({square(0, 6, winding), square(1, 5, winding)}), 36);
  EXPECT_EQ(area_of({square(0, 6, winding), clockwise(square(1, 5, winding))}), 36 - 16);
  EXPECT_EQ(area_of({square(0, 6, RingRole::outer), square(1, 5, RingRole::hole)}), 36 - 16);
}

TEST(Load, ARepairDecidesByItsRuleWhatIsInside) {
  const auto repaired = [](RingRole role, RepairRule rule) {
    return area_of(overlapping(role), by(rule));
  };
  EXPECT_EQ(repaired(RingRole::outer, RepairRule::non_zero), 28);
  EXPECT_EQ(repaired(RingRole::outer, RepairRule::even_odd), 24);
  EXPECT_EQ(repaired(RingRole::winding, RepairRule::make_valid), 28);
  EXPECT_EQ(repaired(RingRole::any, RepairRule::make_valid), 24);
}

TEST(Load, ARepairSaysWhatItChangedAndLeavesValidFeaturesAlone) {
  LoadReport report;
  const auto loaded = load({feature_of({square(0, 1)}), feature_of(overlapping(RingRole::any))},
                           by(RepairRule::non_zero), &report);
  ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
  EXPECT_EQ(report.shapes.crossings, 2U);
  ASSERT_EQ(loaded->notes.size(), 1U);
  EXPECT_EQ(
      loaded->notes[0],
      "feature 1 was repaired: its edges cross or overlap in 2 places and are split there; 2 rings "
      "before, 1 loop after");
  EXPECT_EQ(loaded->items[0].shape.points.size(), 4U);
}

TEST(Load, EdgesThatCrossAreNodedAlsoAmongArcs) {
  // Two circles of radius 1 whose centres are 1 apart.
  const auto circle = [](double x) {
    return Ring{{{x - 1, 0}, {x + 1, 0}}, RingRole::outer, {1, 1}};
  };
  const double lens = 2 * std::numbers::pi / 3 - std::numbers::sqrt3 / 2;
  EXPECT_NEAR(area_of({circle(0), circle(1)}, by(RepairRule::non_zero)),
              2 * std::numbers::pi - lens, 1e-12);
  EXPECT_NEAR(area_of({circle(0), circle(1)}, by(RepairRule::even_odd)),
              2 * std::numbers::pi - 2 * lens, 1e-12);
}

TEST(Load, WithoutARepairCrossingsAreErrorsWithTheirPlace) {
  const auto loaded = load({feature_of({square(0, 1)}), feature_of({square(0, 9, RingRole::outer)}),
                            feature_of(overlapping(RingRole::any))});
  ASSERT_FALSE(loaded.ok());
  const Error& error = loaded.error();
  EXPECT_EQ(error.code, ErrorCode::crossing);
  EXPECT_EQ(error.place.feature, 2U);
  EXPECT_TRUE(error.place.ring.has_value() && error.place.vertex.has_value());
  ASSERT_TRUE(error.place.point.has_value());
  EXPECT_TRUE(*error.place.point == (Vec2{4, 2}) || *error.place.point == (Vec2{2, 4}));
}

TEST(Load, ErrorsNameTheFeatureOfTheFileWhereSomeWereLeftOut) {
  auto document = document_of({feature_of({square(0, 1)}), feature_of({{{{0, 0}, {1, 1}}}})});
  document.indices = {3, 8};
  auto loaded = load_shapes(document);
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().code, ErrorCode::too_few_points);
  EXPECT_EQ(loaded.error().place.feature, 8U);
  EXPECT_EQ(loaded.error().place.ring, 0U);

  document.items[1] = feature_of({square(0, 1)});
  loaded = load_shapes(document);
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(loaded->indices, document.indices);
  loaded->items[1].shape.points[0] = {0.5, 0.5};  // no shape of build_shape() any more
  loaded->items[1].shape.loop_begin = {0, 9};
  const auto axes = compute_axes(std::move(*loaded));
  ASSERT_FALSE(axes.ok());
  EXPECT_EQ(axes.error().code, ErrorCode::malformed);
  EXPECT_EQ(axes.error().place.feature, 8U);
}

TEST(Load, ErrorsOfNoFeatureNameNone) {
  DocumentInfo file;
  file.indices = {3, 8};
  const std::vector<double> weights(2, 1.0);
  const auto kept = for_each_feature(
      file, weights, 1, [](std::size_t, int) -> Status { throw std::bad_alloc(); }, nullptr);
  ASSERT_FALSE(kept.ok());
  EXPECT_EQ(kept.error().code, ErrorCode::out_of_memory);
  EXPECT_FALSE(kept.error().place.feature);
}

TEST(Load, CurvesBecomeArcsWithinTheTolerance) {
  Feature feature;
  feature.contours = {test::ellipse(2, 1)};
  LoadReport report;
  LoadOptions options;
  options.arcs = {.tolerance = 1e-4, .relative = false};
  const auto loaded = load({feature}, options, &report);
  ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
  EXPECT_GT(report.arcs.arcs, 8U);
  EXPECT_EQ(report.arcs.pieces, feature.contours[0].pieces.size());
  EXPECT_LE(report.arcs.largest_error, 1e-4);
  EXPECT_NEAR(area(loaded->items[0].shape), 2 * std::numbers::pi, 1e-3);
  EXPECT_TRUE(loaded->items[0].contours.empty());

  options.keep_contours = true;
  const auto kept = load({feature}, options);
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->items[0].contours.size(), 1U);
}

TEST(Load, AFitFollowsTheBoundaryAsRepaired) {
  // As read, the two boundaries cross, and so would curves along them.
  LoadOptions options = by(RepairRule::non_zero);
  options.fit = 0.01;
  options.keep_contours = true;
  const auto loaded = load({feature_of(overlapping(RingRole::any))}, options);
  ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
  EXPECT_EQ(loaded->items[0].contours.size(), 1U);
  EXPECT_NEAR(area(loaded->items[0].shape), 28, 0.01 * 24);
}

TEST(Load, AFitNotesTheSpecksThatItLeavesOut) {
  LoadOptions options;
  options.fit = 1;
  const Ring speck{{{0.5, 0.5}, {0.5, 1}, {1, 1}, {1, 0.5}}};
  const auto loaded = load({feature_of({square(0, 10), speck})}, options);
  ASSERT_TRUE(loaded.ok()) << to_string(loaded.error());
  EXPECT_EQ(loaded->items[0].shape.loop_count(), 1U);
  ASSERT_EQ(loaded->notes.size(), 1U);
  EXPECT_EQ(loaded->notes[0], "feature 0: 1 loop within a disk as large as --fit is left out");
}

TEST(Load, SourcesOfAFeatureReplaceThoseOfItsRings) {
  Feature feature = feature_of({square(0, 1)});
  feature.sources = {{7, 4}, {7, 5}, {7, 6}, {7, 7}};
  const auto loaded = load({feature});
  ASSERT_TRUE(loaded.ok());
  for (const VertexSource& source : loaded->items[0].shape.sources) {
    EXPECT_EQ(source.ring, 7U);
    EXPECT_GE(source.vertex, 4U);
  }
}

TEST(Load, NothingStaysNothing) {
  const auto nothing = load({});
  ASSERT_TRUE(nothing.ok());
  EXPECT_TRUE(nothing->items.empty());
}

TEST(Load, CancelledIsAnError) {
  const std::atomic<bool> cancel = true;
  LoadOptions options;
  options.cancel = &cancel;
  EXPECT_EQ(load({feature_of({square(0, 1)})}, options).error().code, ErrorCode::cancelled);
}

TEST(Load, LooseLinesKeepTheirFeatureAndWhetherTheyAreClosed) {
  Feature lines, curve;
  lines.chains = {{{{0, 0}, {4, 0}}}, {{{1, 1}}}};
  lines.rings = {square(6, 8)};
  curve.contours = {test::ellipse(2, 1)};
  curve.contours[0].open = true;
  const auto pieces = load_loose(document_of({lines, curve}));
  ASSERT_TRUE(pieces.ok()) << to_string(pieces.error());
  EXPECT_EQ(pieces->feature, (std::vector<std::uint32_t>{0, 0, 0, 1}));
  EXPECT_FALSE(pieces->chains[0].closed);
  EXPECT_TRUE(pieces->chains[2].closed);
  EXPECT_FALSE(pieces->chains[3].bulges.empty());
  const auto graph = planar_graph_of(*pieces);
  ASSERT_TRUE(graph.ok()) << to_string(graph.error());
  EXPECT_EQ(graph->lone_points.size(), 1U);
  EXPECT_EQ(graph->face_count, 3U);
}

TEST(Load, LooseLinesThatCrossNameFeatureAndChain) {
  Feature first, second;
  first.chains = {{{{9, 9}}}};
  second.chains = {{{{0, 0}, {2, 2}}}, {{{0, 2}, {2, 0}}}};
  auto document = document_of({first, second});
  document.indices = {0, 4};
  const auto pieces = load_loose(document);
  ASSERT_TRUE(pieces.ok());
  const auto graph = planar_graph_of(*pieces);
  ASSERT_FALSE(graph.ok());
  EXPECT_EQ(graph.error().code, ErrorCode::crossing);
  EXPECT_EQ(graph.error().place.feature, 4U);
  EXPECT_LE(graph.error().place.ring.value(), 1U);
  const auto noded = planar_graph_of(*pieces, {.node_crossings = true});
  ASSERT_TRUE(noded.ok());
  EXPECT_EQ(noded->edges.size(), 4U);
}

TEST(Load, ThingsThatRoundingCannotSeparateAreMadeToTouch) {
  Feature feature;
  feature.chains = {{{{0, 0}, {1, 0}}}, {{{0.5, 1e-13}}}};
  const auto pieces = load_loose(document_of({feature}));
  ASSERT_TRUE(pieces.ok());
  int calls = 0;
  const auto reach = with_planar_graph(*pieces, false, [&](PlanarGraph& graph) -> Status {
    ++calls;
    if (graph.lone_points.empty()) return success();
    Error error{ErrorCode::unsupported, "too near", {}};
    error.place.ring = 1;
    error.place.point = Vec2{0.5, 0};
    return error;
  });
  ASSERT_TRUE(reach.ok()) << to_string(reach.error());
  EXPECT_GT(calls, 1);
  EXPECT_GT(*reach, 1e-13);
}

TEST(Load, AxesOfManyShapesSumTheirStatistics) {
  auto shapes = load({feature_of({square(0, 2)}), feature_of({square(0, 6), square(1, 5)})});
  ASSERT_TRUE(shapes.ok());
  AxesReport report;
  const auto axes = compute_axes(std::move(*shapes), {{.threads = 2}}, &report);
  ASSERT_TRUE(axes.ok()) << to_string(axes.error());
  EXPECT_EQ(branch_count(axes->items[0].axis), 4U);
  EXPECT_EQ(report.unresolved, 0U);
  EXPECT_GE(report.statistics.bridges, 1U);
}

Status fail_at_some(std::size_t i, int) {
  if (i % 7 == 5) return Error{ErrorCode::empty, "nothing", {}};
  return success();
}

TEST(Load, ItemsRunSideBySideAndTheLowestErrorWins) {
  const std::vector<double> weights(20, 1.0);
  std::vector<std::size_t> doubled(weights.size());
  const auto twice = [&](std::size_t i, int) -> Status {
    doubled[i] = 2 * i;
    return success();
  };
  ASSERT_TRUE(for_each_item(weights, 4, twice).ok());
  for (std::size_t i = 0; i < doubled.size(); ++i) EXPECT_EQ(doubled[i], 2 * i);
  const Status failed = for_each_item(weights, 4, fail_at_some);
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().place.feature, 5U);
}

TEST(Load, FeaturesWithAnErrorOfTheirOwnAreLeftOut) {
  const std::vector<double> weights(10, 1.0);
  Document<int> file;
  file.indices = {0, 1, 2, 3, 4, 15, 16, 17, 18, 19};
  file.items = {0, 10, 20, 30, 40, 50, 60, 70, 80, 90};
  const auto none = for_each_feature(file, weights, 4, fail_at_some, nullptr);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().place.feature, 15U);

  std::vector<std::string> left_out;
  const auto kept = for_each_feature(file, weights, 4, fail_at_some, &left_out);
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(*kept, (std::vector<std::size_t>{0, 1, 2, 3, 4, 6, 7, 8, 9}));
  file.keep(*kept);
  EXPECT_EQ(file.indices, (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 16, 17, 18, 19}));
  EXPECT_EQ(file.items, (std::vector<int>{0, 10, 20, 30, 40, 60, 70, 80, 90}));
  EXPECT_EQ(left_out, std::vector<std::string>{"left out: feature 15: nothing [empty]"});

  // An error that would stop all features stops everything.
  for (const ErrorCode code : {ErrorCode::cancelled, ErrorCode::out_of_memory,
                               ErrorCode::invalid_option, ErrorCode::internal}) {
    const auto stop = [&](std::size_t, int) -> Status { return Error{code, "stop", {}}; };
    EXPECT_FALSE(for_each_feature(file, weights, 2, stop, &left_out).ok());
  }
}

TEST(Load, WhereAllStayThereAreNoNumbers) {
  Document<int> file{{}, {1, 2}};
  file.keep({0, 1});
  EXPECT_TRUE(file.indices.empty());
  file.keep({1});
  EXPECT_EQ(file.indices, std::vector<std::uint64_t>{1});
  EXPECT_EQ(file.items, std::vector<int>{2});
}

TEST(Load, NoFeatureIsLeftOutWithoutATrace) {
  const Document<ShapeItem> empty{{}, {ShapeItem{}}};
  AxesReport report;
  const auto axes = compute_axes(empty, {{}, true}, &report);
  ASSERT_TRUE(axes.ok());
  EXPECT_TRUE(axes->items.empty());
  EXPECT_EQ(report.left_out.size(), 1U);
  EXPECT_EQ(compute_axes(empty, {{}, true}).error().code, ErrorCode::empty);
}

}  // namespace
}  // namespace medial
