// The formats of medial::text, in memory: this program is linked without GDAL, GEOS and Cairo.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/compat.h"
#include "io/output.h"
#include "medial/io/write.h"
#include "medial/query.h"

namespace medial::io {
namespace {

Document<ShapeItem> shapes_of(const std::string& text) {
  auto features = read_document_text(text);
  EXPECT_TRUE(features) << to_string(features.error());
  auto shapes = load_shapes(std::move(features).value());
  EXPECT_TRUE(shapes) << to_string(shapes.error());
  return std::move(shapes).value();
}

Document<AxisItem> axes_of(const std::string& text) {
  auto axes = compute_axes(shapes_of(text));
  EXPECT_TRUE(axes);
  return std::move(axes).value();
}

TEST(TextFormats, NativeFilesAreReadBackFromMemory) {
  const auto axes = axes_of("POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))");
  std::string text;
  ASSERT_TRUE(write_axes(&text, "json", axes));
  const auto again = read_native_text(text);
  ASSERT_TRUE(again) << to_string(again.error());
  ASSERT_EQ(again->items.size(), 1U);
  EXPECT_EQ(again->items[0].axis.nodes.size(), axes.items[0].axis.nodes.size());
  EXPECT_EQ(total_length(again->items[0].axis), total_length(axes.items[0].axis));
  std::string twice;
  ASSERT_TRUE(write_axes(&twice, "json", *again));
  EXPECT_EQ(text, twice);
  EXPECT_FALSE(read_native_text(text.substr(0, text.size() / 2)));
}

TEST(TextFormats, CurvesOfWellKnownTextAreExact) {
  const auto disk = shapes_of("CURVEPOLYGON(CIRCULARSTRING(1 0, 0 1, -1 0, 0 -1, 1 0))");
  EXPECT_NEAR(area(disk.items[0].shape), std::numbers::pi, 1e-12);
  const auto both = shapes_of(
      "MULTISURFACE Z(CURVEPOLYGON(COMPOUNDCURVE(CIRCULARSTRING(0 0 1, 1 1 1, 2 0 1), (2 0 1, 0 0 "
      "1))), EMPTY, ((5 0 0, 6 0 0, 6 1 0, 5 0 0)))");
  EXPECT_NEAR(area(both.items[0].shape), std::numbers::pi / 2 + 0.5, 1e-12);
}

TEST(TextFormats, BrokenCurvesAreRefused) {
  for (const char* text :
       {"CURVEPOLYGON(CIRCULARSTRING(1 0, 0 1))", "CURVEPOLYGON(POINT(1 0))",
        "CURVEPOLYGON(COMPOUNDCURVE((0 0, 1 0), CIRCULARSTRING(2 0, 1 1, 0 0)))",
        "CURVEPOLYGON(NOTHING(1 0, 0 1))", "MULTISURFACE(CIRCULARSTRING(1 0, 0 1, 1 0))",
        "CURVEPOLYGON(COMPOUNDCURVE(COMPOUNDCURVE((0 0, 1 0))))"}) {
    const auto read = read_document_text(text);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, ErrorCode::malformed) << text;
    EXPECT_TRUE(read.error().place.line) << text;
  }
}

TEST(TextFormats, PathsOfSvgBecomeContours) {
  const auto contours = read_path_data("M0 0h4v2H0z m10 0a1 1 0 1 0 2 0 1 1 0 1 0-2 0z");
  ASSERT_TRUE(contours) << to_string(contours.error());
  ASSERT_EQ(contours->size(), 2U);
  EXPECT_EQ((*contours)[0].pieces.size(), 3U);
  EXPECT_EQ((*contours)[0].role, RingRole::winding);
  EXPECT_EQ((*contours)[1].points.front(), (Vec2{10, 0}));
  for (const char* text : {"0 0", "M0 0 L", "M0 0 X4"}) {
    const auto refused = read_path_data(text);
    ASSERT_FALSE(refused) << text;
    EXPECT_EQ(refused.error().code, ErrorCode::malformed);
  }
}

TEST(TextFormats, SvgIsReadAndWritten) {
  const auto shapes = shapes_of(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 9 9'><path d='M0 0h4v2H0z'/></svg>");
  EXPECT_EQ(shapes.unit, Unit::css_pixel);
  std::string text;
  ASSERT_TRUE(write_shapes(&text, "svg", shapes));
  EXPECT_EQ(shapes_of(text).items[0].shape.points.size(), 4U);
}

TEST(TextFormats, WhatNeedsAnotherLibraryIsRefused) {
  EXPECT_EQ(formats_of(DocumentKind::axes).find(".gpkg"), std::string::npos);
  const auto axes = axes_of("SRID=25832;POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))");
  EXPECT_EQ(axes.crs_wkt, "EPSG:25832");
  std::string text;
  const Status written = write_axes(&text, "gpkg", axes);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::unsupported);
  const auto read = read_document_text("this is no format");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::unsupported);
}

TEST(OutputStream, PutsTheShortestDigitsOfQuartersToo) {
  std::string text, expected;
  OutputStream out = OutputStream::to(text);
  const auto put = [&](double value) {
    out.put(value);
    out.put('\n');
    expected += shortest_text(value) + '\n';
  };
  for (int eighths = -900'000; eighths <= 900'000; ++eighths) put(eighths / 8.0);
  for (const double value : {-0.0, 99'999.75, 1e5, -1e5, 1e5 + 0.25, 0.1, 1e-300}) put(value);
  EXPECT_TRUE(out.finish());
  EXPECT_EQ(text, expected);
}

TEST(OutputStream, PutsALongTextInPieces) {
  std::string text, together;
  TextPieces pieces;
  OutputStream whole = OutputStream::to(text), parted = OutputStream::to(pieces);
  const std::string longer(3'000'000, 'x');  // than a piece
  for (OutputStream* const out : {&whole, &parted}) {
    for (int i = 0; i < 400'000; ++i) out->put(i / 7.0);
    out->put(longer);
    out->put('.');
    EXPECT_TRUE(out->finish());
  }
  for (const TextPiece& piece : pieces) together += piece.text();
  EXPECT_GT(pieces.size(), 3U);
  EXPECT_EQ(together, text);
}

}  // namespace
}  // namespace medial::io
