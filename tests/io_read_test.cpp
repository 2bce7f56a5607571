// Readers: written data is read back, and no bytes break a reader.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <thread>
#include <tuple>

#include "io/gis/back_to_input.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/methods.h"
#include "medial/query.h"
#include "medial/verify.h"
#include "support/environment.h"
#include "support/native_items.h"

namespace medial::io {
namespace {

namespace fs = std::filesystem;

TEST_F(Io, ReadsEveryKindOfWellKnownText) {
  const Result<Document<Feature>> data =
      read_document(write("a.wkt",
                          "SRID=4326;polygon z((0 0 9,1 0 9,1 1e0 9,0 0 9))\r\n"
                          "MULTIPOLYGON M (((0 0 1,+1 0 2,.5 -1. 3)),EMPTY,"
                          "((2 2,3 2,3 3),(2.1 2.1,2.2 2.1,2.2 2.2)))\n\n"
                          "GeometryCollection(POINT(1 2),GEOMETRYCOLLECTION("
                          "POLYGONZM((0 0 1 2,1 0 1 2,1 1 1 2))),"
                          "LINESTRING(0 0,1 1))\n"
                          "POLYGON EMPTY\n"));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->items.size(), 3U);
  EXPECT_TRUE(data->geographic);
  EXPECT_NE(data->crs_wkt.find("WGS 84"), std::string::npos);
  EXPECT_EQ(data->items[0].rings.size(), 1U);
  EXPECT_EQ(data->items[0].rings[0].points.size(), 4U);
  EXPECT_TRUE(same(data->items[0].rings[0].points[2], {1, 1}));
  ASSERT_EQ(data->items[1].rings.size(), 3U);
  EXPECT_EQ(data->items[1].rings[1].role, RingRole::outer);
  EXPECT_EQ(data->items[1].rings[2].role, RingRole::hole);
  EXPECT_TRUE(same(data->items[1].rings[0].points[2], {0.5, -1}));
  EXPECT_EQ(data->items[2].id, 2);
  ASSERT_EQ(data->notes.size(), 3U);
  EXPECT_NE(data->notes[0].find("2 geometries are not polygons"), std::string::npos);
  EXPECT_NE(data->notes[1].find("1 feature is empty"), std::string::npos);
  EXPECT_NE(data->notes[2].find("were closed by straight edges"), std::string::npos);
}

TEST_F(Io, ReadsPlainCoordinates) {
  const Result<Document<Feature>> data = read_document(
      write("a.txt", "# outer\n0 0\n4,0\n 4 ; 3 # corner\r\n\t0\t3\n\n\n# hole\n1 1\n2 1\n2 2"));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->items.size(), 1U);
  ASSERT_EQ(data->items[0].rings.size(), 2U);
  EXPECT_EQ(data->items[0].rings[0].points.size(), 4U);
  EXPECT_TRUE(same(data->items[0].rings[0].points[2], {4, 3}));
  EXPECT_EQ(data->items[0].rings[1].role, RingRole::any);
  EXPECT_EQ(data->items[0].rings[1].points.size(), 3U);
}

TEST_F(Io, NumbersAreRoundedCorrectly) {
  std::mt19937_64 random(7);
  std::ostringstream text;
  text.precision(17);
  std::vector<double> values;
  for (int i = 0; i < 3000; ++i) {
    double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) value = 0.1;
    values.push_back(value);
    text << value << (i % 2 == 0 ? " " : "\n");
  }
  const Result<Document<Feature>> data = read_document(write("a.xy", text.str()));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  const auto& points = data->items[0].rings[0].points;
  ASSERT_EQ(points.size(), values.size() / 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(same(points[i], {values[2 * i], values[2 * i + 1]})) << values[2 * i];
  }
}

TEST_F(Io, NumbersMayStandAcrossTheWindowsOfTheReader) {
  std::string text = "POLYGON((";
  for (int i = 0; i < 60000; ++i) {
    text += std::to_string(i) + ".123456789 " + std::string(static_cast<std::size_t>(i % 5), ' ') +
            "-7.5e-1,";
  }
  text += "0 0))";
  const Result<Document<Feature>> data = read_document(write("a.wkt", text));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  const auto& points = data->items[0].rings[0].points;
  ASSERT_EQ(points.size(), 60001U);
  for (std::size_t i = 0; i < 60000; ++i) {
    ASSERT_TRUE(same(points[i], {std::stod(std::to_string(i) + ".123456789"), -0.75})) << i;
  }
}

TEST_F(Io, ErrorsOfTextsNameTheLine) {
  const auto refused = [this](const std::string& name, const std::string& text) {
    const Result<Document<Feature>> data = read_document(write(name, text));
    EXPECT_FALSE(data.ok()) << text;
    return data.ok() ? Error{} : data.error();
  };
  Error error = refused("a.wkt", "POLYGON((0 0,1 0,1 1))\nPOLYGON((0 0,1 0,\n1 x))");
  EXPECT_EQ(error.code, ErrorCode::malformed);
  EXPECT_EQ(error.place.line, 3U);
  EXPECT_EQ(error.place.feature, 1U);
  EXPECT_EQ(error.place.file, path("a.wkt"));
  EXPECT_EQ(error.text, "expected a number but found 'x'");

  EXPECT_EQ(refused("a.wkt", "POLYGON((0 0,nan 0,1 1))").code, ErrorCode::not_finite);
  EXPECT_EQ(refused("a.wkt", "POLYGON((0 0,1e999 0,1 1))").code, ErrorCode::not_finite);
  EXPECT_EQ(refused("a.wkt", "POLYGON((0 0,-inf 0,1 1))").code, ErrorCode::not_finite);
  const Error nan = refused("a.wkt", "POLYGON((0 0,9 0,9 9),(1 1,2 nan,3 3))");
  EXPECT_EQ(nan.place.feature, 0U);
  EXPECT_EQ(nan.place.ring, 1U);
  EXPECT_EQ(nan.place.vertex, 1U);
  EXPECT_EQ(refused("a.wkt", "POLYGON((0 0,1 0,1))").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.wkt", "POLYGON((0 0,1 0,1 1 2 3 4))").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.wkt", "POLYGON((0 0,1-1 0,1 1))").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.wkt", "POLYGON((0 0,+-1 0,1 1))").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.wkt", "POLYGON(())").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.wkt", "POLYGUN((0 0,1 0,1 1))").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.wkt", "POLYGON((0 0,1 0,1 1)))").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.wkt", "SRID=x;POLYGON((0 0,1 0,1 1))").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.wkt", "LINESTRING(0 0,1 0,1 1)").code, ErrorCode::unsupported);
  EXPECT_EQ(refused("a.wkt", "").code, ErrorCode::empty);
  EXPECT_EQ(refused("a.wkt", "POLYGON EMPTY").code, ErrorCode::empty);
  EXPECT_EQ(refused("a.wkt", std::string("\0\x01\xff", 3)).code, ErrorCode::malformed);

  error = refused("a.txt", "0 0\n1 0\n1 one\n");
  EXPECT_EQ(error.code, ErrorCode::malformed);
  EXPECT_EQ(error.place.line, 3U);
  EXPECT_EQ(refused("a.txt", "0 0\n1\n").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.txt", "0 0 0\n").code, ErrorCode::malformed);
  EXPECT_EQ(refused("a.txt", "0 NaN\n").code, ErrorCode::not_finite);
  const Error inf_in_line = refused("a.txt", "0 0\n9 0\n9 9\n\n1 1\ninf 2\n");
  EXPECT_EQ(inf_in_line.place.ring, 1U);
  EXPECT_EQ(inf_in_line.place.vertex, 1U);
  EXPECT_EQ(inf_in_line.place.line, 6U);
  EXPECT_EQ(refused("a.txt", "# nothing\n\n").code, ErrorCode::empty);
  EXPECT_EQ(refused("a.txt", std::string(100000, '1') + " 2").code, ErrorCode::malformed);
}

TEST_F(Io, BracketsNestWithoutRecursion) {
  const std::string deep(std::size_t{100} << 20, '(');
  EXPECT_EQ(code_of(read_document(write("a.wkt", deep))), ErrorCode::malformed);
  EXPECT_EQ(code_of(read_document(write("b.wkt", "POLYGON" + deep.substr(0, 1 << 20)))),
            ErrorCode::malformed);
  EXPECT_EQ(code_of(read_document(write("c.wkt", "POINT" + deep.substr(0, 1 << 20)))),
            ErrorCode::malformed);
  std::string collections;
  for (int i = 0; i < 200000; ++i) collections += "GEOMETRYCOLLECTION(";
  collections += "POLYGON((0 0,1 0,1 1))";
  EXPECT_EQ(code_of(read_document(write("d.wkt", collections))), ErrorCode::malformed);
  collections += std::string(200000, ')');
  EXPECT_TRUE(read_document(write("e.wkt", collections)).ok());
  EXPECT_EQ(code_of(read_document(
                write("f.wkt", "CURVEPOLYGON" + std::string(1000, '(') + std::string(1000, ')')))),
            ErrorCode::malformed);
  EXPECT_EQ(code_of(read_document(write("g.json", std::string(std::size_t{1} << 20, '[')))),
            ErrorCode::malformed);
  EXPECT_FALSE(
      read_document(write("h.json", "{\"medial\":1,\"items\":" + std::string(1 << 20, '['))).ok());
}

TEST_F(Io, MissingFilesAndDirectoriesAreUnreadable) {
  for (const char* name :
       {"none.wkt", "none.txt", "none.json", "none.geojson", "none.gpkg", "none"}) {
    EXPECT_EQ(code_of(read_document(path(name))), ErrorCode::unreadable) << name;
  }
  fs::create_directory(path("folder.wkt"));
  EXPECT_EQ(code_of(read_document(path("folder.wkt"))), ErrorCode::unreadable);
  EXPECT_FALSE(read_native(path("none.json")).ok());
  EXPECT_FALSE(is_native(path("none.json")));
}

TEST_F(Io, FormatsWithoutAttributesRefuseFilters) {
  const std::string file = write("a.wkt", "POLYGON((0 0,1 0,1 1))");
  ReadOptions options;
  options.where = "a = 1";
  EXPECT_EQ(code_of(read_document(file, options)), ErrorCode::invalid_option);
}

// ------------------------------------------------------------------------------------ any prefix

/// Every prefix of a file is read or refused, by a typed error that names the file.
void expect_typed_errors(const std::string& name, const std::string& content, std::size_t whole) {
  for (std::size_t size = 0; size <= content.size(); ++size) {
    std::ofstream(name, std::ios::binary | std::ios::trunc) << content.substr(0, size);
    const Result<Document<Feature>> data = read_document(name);
    if (size >= whole) {
      EXPECT_TRUE(data.ok()) << size << " " << to_string(data.error());
    } else {
      ASSERT_FALSE(data.ok()) << size << ": " << content.substr(0, size);
      EXPECT_NE(data.error().code, ErrorCode::internal) << size;
      EXPECT_EQ(data.error().place.file, name);
      EXPECT_FALSE(data.error().text.empty());
    }
  }
}

TEST_F(Io, EveryPrefixOfWellKnownTextIsRefused) {
  const std::string text = "MULTIPOLYGON (((0 0,1 0,1 1.5e1,0 0),(0.1 0.1,0.2 0.1,0.2 0.2)))";
  expect_typed_errors(path("a.wkt"), text, text.size());
}

TEST_F(Io, EveryPrefixOfGeoJsonIsRefused) {
  const std::string text =
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"a":"b"},)"
      R"("geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}}]})";
  expect_typed_errors(path("a.geojson"), text, text.size());
}

TEST_F(Io, EveryPrefixOfNativeFilesIsRefused) {
  ASSERT_TRUE(write_axes(path("a.json"), "", two_items()).ok());
  std::string text = content("a.json");
  expect_typed_errors(path("b.json"), text, text.size() - 1);  // the last byte ends the line
  EXPECT_FALSE(read_native(write("c.json", text + "]")).ok());
  EXPECT_FALSE(read_native(write("c.json", text + text)).ok());
}

TEST_F(Io, EveryDamagedByteOfNativeFilesIsReadOrRefused) {
  ASSERT_TRUE(write_axes(path("a.json"), "", two_items()).ok());
  const std::string text = content("a.json");
  std::mt19937 random(3);
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string damaged = text;
    damaged[i] = static_cast<char>(random());
    const Result<Document<AxisItem>> file = read_native(write("b.json", damaged));
    if (file.ok()) {
      for (const AxisItem& item : file->items) {
        for (const Edge& edge : item.axis.edges) EXPECT_LT(edge.node[0], item.axis.nodes.size());
      }
    } else {
      EXPECT_NE(file.error().code, ErrorCode::internal);
    }
  }
}

// ----------------------------------------------------------------------------------------- GDAL

constexpr const char* collection =
    R"({"type":"FeatureCollection","features":[
{"type":"Feature","id":5,"properties":{"name":"a","n":1,"x":0.1},"geometry":{"type":"Polygon",
 "coordinates":[[[10,50],[10.1,50],[10.1,50.1],[10,50]]]}},
{"type":"Feature","id":6,"properties":{"name":"b","n":2,"x":null},"geometry":{"type":"GeometryCollection",
 "geometries":[{"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,4],[0,0]],[[2,1],[3,1],[3,2],[2,1]]],
 [[[8,8],[9,8],[9,9],[8,8]]]]},{"type":"Point","coordinates":[1,1]}]}},
{"type":"Feature","id":7,"properties":{"name":"c","n":3},"geometry":null}]})";

TEST_F(Io, ReadsFeaturesWithAttributes) {
  const Result<Document<Feature>> data = read_document(write("a.geojson", collection));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->items.size(), 2U);
  EXPECT_TRUE(data->geographic);
  EXPECT_EQ(data->items[0].id, 5);
  const std::vector<std::pair<std::string, std::string>> expected{
      {"name", "a"}, {"n", "1"}, {"x", "0.1"}};
  EXPECT_EQ(data->items[0].attributes, expected);
  EXPECT_EQ(data->items[1].attributes.size(), 2U);
  ASSERT_EQ(data->items[1].rings.size(), 3U);
  EXPECT_EQ(data->items[1].rings[1].role, RingRole::hole);
  EXPECT_EQ(data->items[1].rings[2].role, RingRole::outer);
  EXPECT_EQ(data->notes.size(), 2U);

  ReadOptions options;
  options.where = "n = 2";
  const Result<Document<Feature>> filtered = read_document(path("a.geojson"), options);
  ASSERT_TRUE(filtered.ok());
  EXPECT_EQ(filtered->items.size(), 1U);
  options.where = "n = 9";
  EXPECT_EQ(code_of(read_document(path("a.geojson"), options)), ErrorCode::empty);
  options.where = "no such thing";
  EXPECT_EQ(code_of(read_document(path("a.geojson"), options)), ErrorCode::invalid_option);
  options.where.clear();
  options.layer = "none";
  EXPECT_EQ(code_of(read_document(path("a.geojson"), options)), ErrorCode::invalid_option);
}

TEST_F(Io, FilesThatHoldNoPolygonsAreUnsupported) {
  EXPECT_EQ(code_of(read_document(write("a.geojson", R"({"type":"Point","coordinates":[1,2]})"))),
            ErrorCode::unsupported);
  EXPECT_EQ(code_of(read_document(write("a.bin", std::string("\x7f\x45\x4c\x46 garbage", 12)))),
            ErrorCode::unsupported);
  EXPECT_EQ(code_of(read_document(write("a.gpkg", "garbage"))), ErrorCode::malformed);
  EXPECT_EQ(code_of(read_document(write("a.shp", "garbage"))), ErrorCode::malformed);
  EXPECT_EQ(code_of(read_document(write("a.fgb", "fgb"))), ErrorCode::malformed);
}

TEST_F(Io, APipeThatWasReadIsOpenedAgain) {
  const std::string name = path("pipe");
  ASSERT_EQ(mkfifo(name.c_str(), S_IRUSR | S_IWUSR), 0);
  const auto read_what_comes = [&name](const std::string& text) {
    std::thread writer([&] { std::ofstream(name) << text; });
    auto document = read_document(name);
    writer.join();
    return document;
  };
  EXPECT_EQ(code_of(read_what_comes("")), ErrorCode::empty);
  EXPECT_EQ(code_of(read_what_comes("POLYGON ((0 0, 1 0, x")), ErrorCode::malformed);
  const auto document = read_what_comes("POLYGON ((0 0, 1 0, 1 1))");
  ASSERT_TRUE(document.ok()) << to_string(document.error());
  EXPECT_EQ(document->items.size(), 1U);
}

/// Runs an action with a file as standard input, and returns its standard output.
std::string in_child(const std::string& input, const std::function<void()>& action) {
  int output[2];
  EXPECT_EQ(pipe(output), 0);
  std::fflush(stdout);  // otherwise the child writes the output of earlier tests
  const pid_t child = fork();
  if (child == 0) {
    std::FILE* file = std::freopen(input.c_str(), "rb", stdin);
    dup2(output[1], STDOUT_FILENO);
    close(output[0]);
    close(output[1]);
    if (file != nullptr) action();
    std::fflush(stdout);
    _exit(0);
  }
  close(output[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t got; (got = read(output[0], buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(got));
  }
  close(output[0]);
  waitpid(child, nullptr, 0);
  return text;
}

TEST_F(Io, StandardInputIsRecognised) {
  ASSERT_TRUE(write_axes(path("native"), "json", two_items()).ok());
  const std::map<std::string, std::string> inputs{
      {"wkt", " Polygon((0 0,1 0,1 1))"},
      {"xy", "0 0\n1 0\n1 1\n"},
      {"geojson", R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]})"},
      {"native", content("native")},
      {"garbage", "what is this"},
      {"nothing", ""}};
  for (const auto& [name, text] : inputs) {
    const std::string result = in_child(write(name, text), [] {
      const bool native = is_native("-");
      const Result<Document<Feature>> data = read_document("-");
      std::printf(
          "%d %s", native ? 1 : 0,
          data.ok() ? std::to_string(data->items.size()).c_str() : name_of(data.error().code));
    });
    if (name == "garbage") {
      EXPECT_EQ(result, "0 unsupported");
    } else if (name == "nothing") {
      EXPECT_EQ(result, "0 empty");
    } else {
      EXPECT_EQ(result, name == "native" ? "1 2" : "0 1") << name;
    }
  }
}

TEST_F(Io, StandardOutputTakesEveryFormatOfOneFile) {
  const std::string nothing = write("nothing", "");
  for (const char* format :
       {"", "json", "geojson", "gpkg", "fgb", "wkt", "csv", "svg", "pdf", "png", "ps"}) {
    const std::string text =
        in_child(nothing, [&] { (void)write_axes("-", format, two_items()).ok(); });
    EXPECT_GT(text.size(), 100U) << format;
    EXPECT_EQ(text.starts_with("{\"medial\":1,"), *format == '\0' || format == std::string("json"));
  }
  EXPECT_EQ(
      in_child(nothing, [] { std::puts(write_axes("-", "shp", two_items()).ok() ? "1" : "0"); }),
      "0\n");
}

// ------------------------------------------------------------------------------------ projection

TEST_F(Io, LocalProjectionsMeasureMetresAndGoBack) {
  ReadOptions options;
  options.project = true;
  for (const auto& [x, y, size] : {std::tuple{10.0, 50.0, 0.1},
                                   {-179.9, -40.0, 0.01},
                                   {20.0, 10.0, 30.0},
                                   {100.0, 89.0, 0.5}}) {
    const std::string file = write("a.wkt", degrees(x, y, size));
    const Result<Document<Feature>> plain = read_document(file);
    const Result<Document<Feature>> data = read_document(file, options);
    ASSERT_TRUE(data.ok()) << to_string(data.error());
    EXPECT_FALSE(data->geographic);
    EXPECT_TRUE(is_local_projection(data->crs_wkt));
    ASSERT_EQ(data->notes.size(), 2U);  // closed; projected
    std::vector<Vec2> points = data->items[0].rings[0].points;
    if (size < 1) {
      const double meridian = distance(points[0], points[2]);
      EXPECT_NEAR(meridian / size, 111200, 600);  // metres a degree of latitude, on the ellipsoid
    }
    Result<BackToInput> back = BackToInput::make(data->crs_wkt);
    ASSERT_TRUE(back.ok());
    EXPECT_NE(back->crs_wkt().find("WGS 84"), std::string::npos);
    ASSERT_TRUE(back->transform(points).ok());
    for (std::size_t i = 0; i < points.size(); ++i) {
      // 2 mm, in degrees: as good as the series of the equal-area projection.
      EXPECT_NEAR(points[i].x, plain->items[0].rings[0].points[i].x, 2e-8);
      EXPECT_NEAR(points[i].y, plain->items[0].rings[0].points[i].y, 2e-8);
    }
  }
  EXPECT_FALSE(BackToInput::make("").ok());
}

TEST_F(Io, WhatIsNotGeographicIsNotProjected) {
  ReadOptions options;
  options.project = true;
  EXPECT_EQ(code_of(read_document(write("a.wkt", "POLYGON((0 0,1000 0,1000 1000))"), options)),
            ErrorCode::invalid_option);
  const Result<Document<Feature>> utm =
      read_document(write("b.wkt", "SRID=32633;POLYGON((0 0,1000 0,1000 1000,0 0))"), options);
  ASSERT_TRUE(utm.ok());
  EXPECT_TRUE(same(utm->items[0].rings[0].points[2], {1000, 1000}));
  EXPECT_EQ(utm->notes.size(), 1U);
  const Result<Document<Feature>> bare =
      read_document(write("c.wkt", "POLYGON((0 0,1 0,1 1,0 0))"), options);
  ASSERT_TRUE(bare.ok());
  EXPECT_EQ(bare->notes.size(), 2U);  // taken as degrees; projected
}

// ---------------------------------------------------------------------------------------- repair

TEST_F(Io, RepairFollowsTheRule) {
  struct Case {
    const char* text;
    double valid, odd, nonzero;
  };
  const Case cases[] = {
      // a bow tie
      {"POLYGON((0 0,2 2,2 0,0 2,0 0))", 2, 2, 2},
      // two squares that overlap by one
      {"MULTIPOLYGON(((0 0,2 0,2 2,0 2,0 0)),((1 1,3 1,3 3,1 3,1 1)))", 7, 6, 7},
      // a ring that runs around a square twice, the second time narrower
      {"POLYGON((0 0,4 0,4 4,0 4,0 0,1 1,3 1,3 3,1 3,1 1,0 0))", 16, 12, 16},
      // a hole that sticks out
      {"POLYGON((0 0,4 0,4 4,0 4,0 0),(3 1,5 1,5 2,3 2,3 1))", 15, 16, 17},
      // a hole that runs as its outer ring does
      {"POLYGON((0 0,4 0,4 4,0 4,0 0),(1 1,2 1,2 2,1 2,1 1))", 15, 15, 16},
      // a ring with a slit to its hole: one ring, as circuit boards store it
      {"POLYGON((0 0,4 0,4 4,0 4,0 1,1 1,1 2,2 2,2 1,1 1,0 1,0 0))", 15, 15, 15},
      // a needle without area, and a ring of two points
      {"MULTIPOLYGON(((0 0,1 0,1 1,0 0)),((5 5,6 6,7 7,5 5)),((8 8,9 9,8 8)))", 0.5, 0.5, 0.5}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const std::string file = write("a.wkt", c.text);
    for (const auto& [rule, expected] : {std::pair{RepairRule::make_valid, c.valid},
                                         {RepairRule::even_odd, c.odd},
                                         {RepairRule::non_zero, c.nonzero}}) {
      SourceOptions options;
      options.read.repair = rule;
      const Result<Document<ShapeItem>> data = load_shapes(file, options);
      ASSERT_TRUE(data.ok()) << to_string(data.error());
      EXPECT_NEAR(area(data->items[0].shape), expected, 1e-12) << static_cast<int>(rule);
    }
  }
}

TEST_F(Io, RepairTellsWhatItChangedAndLeavesTheRest) {
  ReadOptions options;
  options.repair = RepairRule::make_valid;
  const Result<Document<Feature>> data = read_document(
      write("a.wkt", "POLYGON((0.1 0,1 0,1 1.7,0.1 0))\nPOLYGON((0 0,2 2,2 0,0 2,0 0))"), options);
  ASSERT_TRUE(data.ok());
  EXPECT_EQ(data->items[0].rings[0].points,
            (std::vector<Vec2>{{0.1, 0}, {1, 0}, {1, 1.7}, {0.1, 0}}));
  ASSERT_EQ(data->notes.size(), 1U);
  EXPECT_EQ(data->notes[0],
            "feature 1 was repaired by MakeValid: 1 ring, 4 vertices, area 0 before; 2 rings, 6 "
            "vertices, "
            "area 2 after");
  EXPECT_EQ(code_of(read_document(write("b.wkt", "POLYGON((0 0,1 1,2 2,0 0))"), options)),
            ErrorCode::no_area);

  const std::string loose = write("c.txt", "0 0\n4 0\n4 4\n0 4\n\n1 1\n2 1\n2 2\n1 2\n");
  for (const auto& [rule, expected] : {std::pair{RepairRule::make_valid, 15.0},
                                       {RepairRule::even_odd, 15.0},
                                       {RepairRule::non_zero, 16.0}}) {
    SourceOptions by_rule;
    by_rule.read.repair = rule;
    const Result<Document<ShapeItem>> shapes = load_shapes(loose, by_rule);
    ASSERT_TRUE(shapes.ok()) << to_string(shapes.error());
    EXPECT_NEAR(area(shapes->items[0].shape), expected, 1e-12);
  }
}

// -------------------------------------------------------------------------------------- real data

TEST_F(Io, CompressedTextIsReadAndItsTruncationNoticed) {
  const fs::path file = test::data_folder() / "packaged" / "A_gis" / "gshhg" / "sao_tome.wkt.gz";
  if (!fs::exists(file)) GTEST_SKIP() << "no data folder: set MEDIAL_DATA";
  const Result<Document<Feature>> data = read_document(file.string());
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->items.size(), 1U);
  EXPECT_EQ(data->items[0].rings.at(0).points.size(), 999U);

  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t size = 0; size < bytes.size(); size += size < 64 ? 1 : 97) {
    const Result<Document<Feature>> part = read_document(write("a.wkt.gz", bytes.substr(0, size)));
    ASSERT_FALSE(part.ok()) << size;
    EXPECT_TRUE(part.error().code == ErrorCode::malformed || part.error().code == ErrorCode::empty)
        << size;
  }
  std::string damaged = bytes;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x55);
  EXPECT_EQ(code_of(read_document(write("b.wkt.gz", damaged))), ErrorCode::malformed);
}

/// Lakes, islands, and clearances around the pads of boards.
TEST_F(Io, LeeAgreesWithDisksOnRealHoles) {
  const fs::path folder = test::data_folder() / "packaged";
  if (!fs::exists(folder)) GTEST_SKIP() << "no data folder: set MEDIAL_DATA";
  for (const char* name :
       {"A_gis/gshhg/amazon_islands.wkt.gz", "A_gis/repos/cgal_bee.wkt",
        "B_pcb/StickHub_B.Cu_unfractured.wkt.gz", "B_pcb/ecc83-pp_v2_B.Cu_unfractured.wkt.gz"}) {
    const auto shapes = load_shapes((folder / name).string());
    ASSERT_TRUE(shapes.ok()) << name;
    for (const auto& item : shapes->items) {
      const auto lee = compute(item.shape, {.method = method::Lee{}}), disks = compute(item.shape);
      ASSERT_TRUE(lee.ok() && disks.ok()) << name;
      EXPECT_TRUE(verify(item.shape, *lee).passed) << name;
      EXPECT_NEAR(total_length(*lee) / total_length(*disks), 1, 1e-9) << name;
    }
  }
}

TEST_F(Io, EveryFileOfTheDataFolderIsReadOrRefused) {
  if (!fs::exists(test::data_folder())) GTEST_SKIP() << "no data folder: set MEDIAL_DATA";
  std::size_t read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(test::data_folder())) {
    if (!entry.is_regular_file() || entry.file_size() > (std::uintmax_t{2} << 20)) continue;
    const Result<Document<Feature>> data = read_document(entry.path().string());
    if (data.ok()) {
      ++read;
    } else {
      EXPECT_NE(data.error().code, ErrorCode::internal) << to_string(data.error());
    }
    if (entry.path().filename().string().find(".wkt") != std::string::npos) {
      EXPECT_TRUE(data.ok() || data.error().code == ErrorCode::unsupported)  // lines, no polygons
          << to_string(data.error());
    }
  }
  EXPECT_GT(read, 30U);
}

}  // namespace
}  // namespace medial::io
