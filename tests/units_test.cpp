// Units of length: documents of features in other units.
#include <gtest/gtest.h>

#include "medial/document.h"

namespace medial {
namespace {

Document<Feature> document_of(Unit unit) {
  Document<Feature> file;
  file.unit = unit;
  file.items.resize(1);
  file.items[0].rings.push_back({.points = {{0, 0}, {96, 0}, {96, 48}}, .bulges = {0, 0.5, 0}});
  file.items[0].chains.push_back({.points = {{1, 2}}});
  return file;
}

TEST(Units, NamesLeadBack) {
  for (const Unit unit : {Unit::micrometre, Unit::millimetre, Unit::inch, Unit::css_pixel}) {
    EXPECT_EQ(unit_of(name_of(unit)), unit);
    EXPECT_EQ(unit_of_length(millimetres(unit)), unit);
  }
  EXPECT_FALSE(unit_of("degree").has_value());
  EXPECT_EQ(unit_of_length(304.8006096), Unit::us_foot);  // the foot of US surveys
}

TEST(Units, PixelsOfADrawingAre96ToTheInch) {
  auto file = document_of(Unit::css_pixel);
  ASSERT_TRUE(convert_units(file, {.wanted = Unit::inch}).ok());
  EXPECT_EQ(file.unit, Unit::inch);
  EXPECT_NEAR(file.items[0].rings[0].points[1].x, 1, 1e-15);
  EXPECT_EQ(file.items[0].rings[0].bulges[1], 0.5);
  EXPECT_NEAR(file.items[0].chains[0].points[0].y, 2.0 / 96, 1e-15);
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_NE(file.notes[0].find("96"), std::string::npos);
}

TEST(Units, GivenUnitsAndScale) {
  auto file = document_of(Unit::unknown);
  ASSERT_TRUE(
      convert_units(file, {.given = Unit::inch, .scale = 2, .wanted = Unit::millimetre}).ok());
  EXPECT_NEAR(file.items[0].rings[0].points[1].x, 2 * 96 * 25.4, 1e-10);
  EXPECT_TRUE(file.notes.empty());
  file = document_of(Unit::unknown);
  ASSERT_TRUE(convert_units(file, {.assumed = Unit::millimetre, .wanted = Unit::millimetre}).ok());
  EXPECT_EQ(file.items[0].rings[0].points[1].x, 96);
  EXPECT_EQ(file.notes.size(), 1U);
}

TEST(Units, PixelsOfAnImage) {
  auto file = document_of(Unit::pixel);
  file.pixel = 1;
  EXPECT_FALSE(convert_units(file, {.wanted = Unit::millimetre}).ok());
  ASSERT_TRUE(convert_units(file, {.given = Unit::micrometre, .pixel_size = 0.5}).ok());
  EXPECT_EQ(file.unit, Unit::micrometre);
  EXPECT_EQ(file.pixel, 0.5);
  EXPECT_EQ(file.items[0].rings[0].points[1].x, 48);
  file = document_of(Unit::pixel);
  file.pixel = 1;
  file.dots_per_inch = 96;
  ASSERT_TRUE(convert_units(file, {.wanted = Unit::inch}).ok());
  EXPECT_NEAR(file.items[0].rings[0].points[1].x, 1, 1e-15);
  EXPECT_EQ(file.notes.size(), 1U);
}

TEST(Units, WhatHasNoLengthIsRefused) {
  auto file = document_of(Unit::unknown);
  EXPECT_EQ(convert_units(file, {.wanted = Unit::inch}).error().code, ErrorCode::invalid_option);
  EXPECT_EQ(convert_units(file, {.pixel_size = 2}).error().code, ErrorCode::invalid_option);
  file = document_of(Unit::degree);
  file.geographic = true;
  EXPECT_EQ(convert_units(file, {.given = Unit::inch}).error().code, ErrorCode::invalid_option);
  EXPECT_TRUE(convert_units(file, {}).ok());
}

TEST(Units, AReferenceSystemHoldsInItsOwnUnitsOnly) {
  auto file = document_of(Unit::metre);
  file.crs_wkt = "PROJCRS";
  ASSERT_TRUE(convert_units(file, {.wanted = Unit::metre}).ok());
  EXPECT_EQ(file.crs_wkt, "PROJCRS");
  ASSERT_TRUE(convert_units(file, {.wanted = Unit::kilometre}).ok());
  EXPECT_TRUE(file.crs_wkt.empty());
  EXPECT_EQ(file.notes.size(), 1U);
}

}  // namespace
}  // namespace medial
