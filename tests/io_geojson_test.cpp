// GeoJSON is read as GDAL reads it, which is asked where a layer is chosen.

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "medial/io/read.h"
#include "support/scratch_folder.h"

namespace medial::io {
namespace {

constexpr const char* geo_square =
    R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,3.5],[0,3.5],[0,0]]]})";
constexpr const char* geo_frame =
    R"({"coordinates" : [[[[0,0,7],[9,0,7],[9,9,7],[0,9,7],[0,0,7]],
 [[1,1],[1,2],[2,2],[1e0,1]]], [[[20,0],[30,0],[30,1.25e1],[20,0]]]] , "type":"MultiPolygon"})";

std::string geo_feature(const std::string& properties, const std::string& geometry = geo_square,
                        const std::string& more = "") {
  return R"({"type":"Feature",)" + more + R"("properties":)" + properties + R"(,"geometry":)" +
         geometry + "}";
}
std::string collected(const std::string& features, const std::string& more = "") {
  return R"({"type":"FeatureCollection","name":"things",)" + more + "\n\"features\" : [" +
         features + "]}\n";
}

/// All that a reader says of a file.
std::string geo_told(const Result<Document<Feature>>& file) {
  if (!file) return "error " + std::string(name_of(file.error().code));
  std::string text = file->crs_wkt + '|' + name_of(file->unit) + '|';
  for (const std::string& note : file->notes) text += note + '|';
  for (const Feature& feature : file->items) {
    text += "\n" + std::to_string(feature.id);
    for (const auto& [name, value] : feature.attributes) text += ' ' + name + '=' + value;
    for (const Ring& ring : feature.rings) {
      text += "\n" + std::to_string(static_cast<int>(ring.role));
      for (const Vec2 p : ring.points)
        text += ' ' + std::to_string(p.x) + ' ' + std::to_string(p.y);
    }
  }
  return text;
}

class Geojson : public test::ScratchFolder {
 protected:
  /// By its own reader, if that takes it, and by GDAL.
  void expect_same(const std::string& text) const {
    const std::string file = write("a.geojson", text);
    ReadOptions by_gdal;
    by_gdal.layer = "things";
    EXPECT_EQ(geo_told(read_document(file)), geo_told(read_document(file, by_gdal))) << text;
  }
};

TEST_F(Geojson, IsThatOfGdal) {
  expect_same(collected(geo_feature("{}")));
  expect_same(collected(geo_feature(R"({"a":1,"b":"x"})") + ",\n" +
                        geo_feature(R"({"a":2,"b":null})", geo_frame)));
  expect_same(collected(geo_feature(R"({"n":100000,"x":1})") + "," +
                        geo_feature(R"({"n":200000,"x":100000.5})") + "," +
                        geo_feature(R"({"n":null,"x":100000})")));
  expect_same(collected(geo_feature(R"({"on":true,"code":"007","w":"\u00e4\"\\ {[,:"})") + "," +
                        geo_feature(R"({"on":false,"code":"5","w":""})")));
  for (const char* name : {"urn:ogc:def:crs:EPSG::25832", "EPSG:3857",
                           "urn:ogc:def:crs:OGC:1.3:CRS84", "urn:ogc:def:crs:EPSG::4326"})
    expect_same(collected(geo_feature("{}"), R"("crs":{"type":"name","properties":{"name":")" +
                                                 std::string(name) + R"("}},)"));
}

TEST_F(Geojson, LongNumbersAreTheNearestDoubles) {
  std::mt19937_64 random(41);
  std::vector<std::string> numbers;
  for (int i = 0; i < 4000; ++i) {
    std::string number = random() % 2 == 0 ? "0." : "-12.";
    for (std::size_t digits = 14 + random() % 26; digits > 0; --digits)
      number += static_cast<char>('0' + random() % 10);
    numbers.push_back(random() % 4 == 0 ? number + "e3" : number);
  }
  std::string ring;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    ring += "[" + numbers[i] + "," + numbers[i + 1] + "],";
  ring += "[" + numbers[0] + "," + numbers[1] + "]";
  const std::string file =
      write("long.geojson",
            collected(geo_feature("{}", R"({"type":"Polygon","coordinates":[[)" + ring + "]]}")));
  const Result<Document<Feature>> read = read_document(file);
  ASSERT_TRUE(read.ok());
  const std::vector<Vec2>& points = read->items.at(0).rings.at(0).points;
  ASSERT_GE(points.size(), numbers.size() / 2);
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    EXPECT_EQ(points[i / 2].x, std::strtod(numbers[i].c_str(), nullptr)) << numbers[i];
    EXPECT_EQ(points[i / 2].y, std::strtod(numbers[i + 1].c_str(), nullptr)) << numbers[i + 1];
  }
}

// What the reader leaves to GDAL, or would not read alike.
TEST_F(Geojson, ThatIsUnusualIsThatOfGdal) {
  for (const char* properties :
       {R"({"d":"2020-01-31"})", R"({"t":"12:30"})", R"({"o":{"a":1}})", R"({"l":[1,2]})",
        R"({"n":1e20})", R"({"n":12345678901234567890.0})", R"({"n":1e300})", "null", R"({"id":7})",
        R"({"a":1,"a":2})"})
    expect_same(collected(geo_feature(properties)));
  expect_same(collected(geo_feature(R"({"a":1})") + "," + geo_feature(R"({"a":"x"})")));
  expect_same(collected(geo_feature(R"({"a":1,"b":2})") + "," + geo_feature(R"({"b":3,"a":4})")));
  expect_same(collected(geo_feature("{}", geo_square, R"("id":5,)")));
  expect_same(collected(geo_feature("{}"), R"("bbox":[1,,2],)"));
  expect_same(collected(geo_feature("{}"), R"("\u0063rs":{"type":"name"},)"));
  expect_same(collected(geo_feature(
      "{}", R"({"coordinates":[[[0,0],[1,0],[1,1],[0,0]]],)" + std::string(geo_square).substr(1))));
  expect_same(collected(geo_feature("{}", geo_square, R"("id":"x",)")));
  for (const char* geometry :
       {"null", R"({"type":"Point","coordinates":[1,2]})", R"({"type":"Polygon","coordinates":[]})",
        R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,3]]]})",
        R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,null],[0,0]]]})"})
    expect_same(collected(geo_feature("{}") + "," + geo_feature("{}", geometry)));
  expect_same(collected(""));
  expect_same(collected(geo_feature("{}"), "\"crs\":null,"));
  expect_same(collected(geo_feature("{}")).substr(0, 90));
}

TEST_F(Geojson, OfManyFeaturesComesInParts) {
  std::string features;
  for (int i = 0; i < 3000; ++i)
    features += (i > 0 ? "," : "") + geo_feature("{\"i\":" + std::to_string(i) + "}");
  const auto file = read_document(write("many.geojson", collected(features)));
  ASSERT_TRUE(file);
  ASSERT_EQ(file->items.size(), 3000U);
  EXPECT_EQ(file->items[2999].attributes[0].second, "2999");
  EXPECT_EQ(file->items[2999].id, 2999);
}

}  // namespace
}  // namespace medial::io
