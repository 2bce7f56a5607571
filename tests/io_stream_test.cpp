// Files read, computed and written part by part.

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "medial/io/write.h"
#include "support/scratch_folder.h"

namespace medial::io {
namespace {

constexpr std::size_t many = 4000;  // several parts

class Stream : public test::ScratchFolder {
 protected:
  /// L-shapes on a grid; those that are named have no area, or cross themselves.
  std::string footprints(std::size_t flat = many, std::size_t crossing = many) {
    std::mt19937 random(1);
    std::string text;
    const auto put = [&text](double x, double y) {
      text += std::to_string(x) + " " + std::to_string(y) + ", ";
    };
    for (std::size_t i = 0; i < many; ++i) {
      const double x = static_cast<double>(30 * (i % 60)), y = static_cast<double>(30 * (i / 60));
      const auto size = [&random] { return 3 + 1e-2 * static_cast<double>(random() % 500); };
      const double a = 8 + size(), b = 8 + size(), c = size(), d = size();
      text += "POLYGON ((";
      put(x, y);
      put(x + a, i == flat ? y : y + (i == crossing ? b : 0));
      if (i != flat) put(x + a, i == crossing ? y : y + c);
      if (i != flat && i != crossing) put(x + d, y + c);
      if (i != flat && i != crossing) put(x + d, y + b);
      if (i != flat) put(x, y + b);
      if (i == flat) put(x + a + d, y);
      text += std::to_string(x) + " " + std::to_string(y) + "))\n";
    }
    return write("f.wkt", text);
  }

  StreamOptions options(int threads, bool skip = false) const {
    StreamOptions result;
    result.threads = threads;
    result.least_bytes = 1;
    result.source.read.skip_invalid = skip;
    result.compute = [](Document<ShapeItem> shapes, int own,
                        AxesReport& report) -> Result<StreamItems> {
      Options how;
      how.threads = own;
      auto axes = compute_axes(std::move(shapes), {how}, &report);
      if (!axes) return std::move(axes).error();
      return StreamItems(std::move(*axes));
    };
    return result;
  }

  Result<Document<AxisItem>> whole(const std::string& file, bool skip = false) const {
    SourceOptions source;
    source.read.skip_invalid = skip;
    auto shapes = load_shapes(file, source);
    if (!shapes) return std::move(shapes).error();
    return compute_axes(std::move(shapes).value());
  }
};

TEST_F(Stream, BytesAreThoseOfTheWhole) {
  const std::string file = footprints();
  const auto axes = whole(file);
  ASSERT_TRUE(axes);
  for (const char* format : {"csv", "wkt", "json", "geojson"}) {
    std::string expected;
    ASSERT_TRUE(write_axes(&expected, format, *axes));
    for (const int threads : {1, 2, 4}) {
      std::string text;
      std::size_t seen = 0, parts = 0;
      StreamOptions how = options(threads);
      how.visit = [&](const StreamItems& part) {
        seen += std::get<Document<AxisItem>>(part).items.size();
        ++parts;
      };
      const auto report = stream(file, &text, format, how);
      ASSERT_TRUE(report) << to_string(report.error());
      ASSERT_TRUE(*report);
      EXPECT_TRUE(text == expected) << format << ", " << threads << " threads";
      EXPECT_EQ(seen, many);
      EXPECT_GT(parts, 2U);
      EXPECT_EQ((*report)->load.features, many);
    }
  }
}

TEST_F(Stream, LayersHoldTheRowsOfTheWhole) {
  const std::string file = footprints();
  const auto axes = whole(file);
  ASSERT_TRUE(axes);
  for (const char* format : {"gpkg", "fgb", "shp"}) {
    const std::string one = path("whole." + std::string(format));
    ASSERT_TRUE(write_axes(one, format, *axes)) << format;
    const std::string other = path("parts." + std::string(format));
    const auto report = stream(file, other, format, options(2));
    ASSERT_TRUE(report) << to_string(report.error());
    ASSERT_TRUE(*report);
    ReadOptions loose;
    loose.loose = true;
    auto a = read_document(one, loose), b = read_document(other, loose);
    ASSERT_TRUE(a);
    ASSERT_TRUE(b);
    ASSERT_EQ(a->items.size(), b->items.size()) << format;
    // A FlatGeobuf with an index has its rows in the order of that.
    const auto by_branch = [](const Feature& f) {
      return std::pair(std::stoull(f.attributes[0].second), std::stoull(f.attributes[1].second));
    };
    std::ranges::sort(a->items, {}, by_branch);
    std::ranges::sort(b->items, {}, by_branch);
    for (std::size_t i = 0; i < a->items.size(); ++i) {
      EXPECT_EQ(a->items[i].attributes, b->items[i].attributes);
      EXPECT_EQ(a->items[i].chains[0].points, b->items[i].chains[0].points);
    }
  }
}

TEST_F(Stream, ErrorsAreThoseOfTheWholeAndLeaveNothing) {
  const std::string file = footprints(3000, 3500);
  const auto axes = whole(file);
  ASSERT_FALSE(axes);
  for (const int threads : {1, 4}) {
    for (const char* format : {"geojson", "gpkg"}) {
      const auto report =
          stream(file, path("out." + std::string(format)), format, options(threads));
      ASSERT_FALSE(report);
      EXPECT_EQ(report.error().code, axes.error().code);
      EXPECT_EQ(report.error().place.feature, 3000U);
      EXPECT_EQ(report.error().text, axes.error().text);
      EXPECT_FALSE(std::filesystem::exists(path("out." + std::string(format))));
    }
  }
  const auto unwritable = stream(file, path("none/out.csv"), "csv", options(2));
  ASSERT_FALSE(unwritable);
  EXPECT_EQ(unwritable.error().code, ErrorCode::unwritable);
}

TEST_F(Stream, InvalidFeaturesAreLeftOutWithTheNotesOfTheWhole) {
  const std::string file = footprints(3000, 3500);
  const auto axes = whole(file, true);
  ASSERT_TRUE(axes) << to_string(axes.error());
  std::string expected, text;
  ASSERT_TRUE(write_axes(&expected, "geojson", *axes));
  const auto report = stream(file, &text, "geojson", options(2, true));
  ASSERT_TRUE(report) << to_string(report.error());
  ASSERT_TRUE(*report);
  EXPECT_TRUE(text == expected);
  EXPECT_EQ((*report)->document.notes, axes->notes);
  EXPECT_EQ((*report)->load.left_out, 2U);
}

TEST_F(Stream, WhatNeedsAllFeaturesIsNotDoneInParts) {
  const std::string file = footprints();
  StreamOptions large = options(1);
  large.least_bytes = std::uint64_t{1} << 30;
  StreamOptions projected = options(1);
  projected.source.read.project = true;
  for (const StreamOptions& how : {large, projected}) {
    const auto report = stream(file, path("a.csv"), "csv", how);
    ASSERT_TRUE(report);
    EXPECT_FALSE(*report);
  }
  const auto picture = stream(file, path("a.svg"), "svg", options(1));
  ASSERT_TRUE(picture);
  EXPECT_FALSE(*picture);
}

}  // namespace
}  // namespace medial::io
