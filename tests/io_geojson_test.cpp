// GeoJSON is read as GDAL reads it, which is asked where a layer is chosen.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "io/formats/geojson.h"
#include "medial/io/read.h"
#include "support/environment.h"
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
  for (const std::string& name : file->text_attributes) text += name + '|';
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
  expect_same(collected(geo_feature(R"({"id":70,"a":1})") + "," + geo_feature(R"({"id":7,"a":2})") +
                        "," + geo_feature(R"({"id":7,"a":3})")));
  expect_same(collected(geo_feature(R"({"id":"x"})") + "," + geo_feature(R"({"id":"7"})")));
  expect_same(collected(geo_feature(R"({"a":1})", geo_square, R"("id":"7",)") + "," +
                        geo_feature(R"({"a":2})", geo_square, R"("id":"way/7",)")));
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

// Input that the reader passes on to GDAL, since the two might read it differently.
TEST_F(Geojson, ThatIsUnusualIsThatOfGdal) {
  for (const char* properties :
       {R"({"d":"2020-01-31"})", R"({"t":"12:30"})", R"({"o":{"a":1}})", R"({"l":[1,2]})",
        R"({"n":1e20})", R"({"n":12345678901234567890.0})", R"({"n":1e300})", "null",
        R"({"a":1,"a":2})"})
    expect_same(collected(geo_feature(properties)));
  expect_same(collected(geo_feature(R"({"a":1})") + "," + geo_feature(R"({"a":"x"})")));
  expect_same(collected(geo_feature(R"({"a":1,"b":2})") + "," + geo_feature(R"({"b":3,"a":4})")));
  expect_same(collected(geo_feature("{}", geo_square, R"("id":5,)")));
  expect_same(collected(geo_feature("{}"), R"("bbox":[1,,2],)"));
  expect_same(collected(geo_feature("{}"), R"("\u0063rs":{"type":"name"},)"));
  expect_same(collected(geo_feature(
      "{}", R"({"coordinates":[[[0,0],[1,0],[1,1],[0,0]]],)" + std::string(geo_square).substr(1))));
  expect_same(collected(geo_feature(R"({"id":7})", geo_square, R"("id":"x",)")));
  expect_same(collected(geo_feature("{}", geo_square, R"("id":"x",)") + "," +
                        geo_feature("{}", geo_square, R"("id":5,)")));
  expect_same(collected(geo_feature("{}", geo_square, R"("id":"x",)") + "," + geo_feature("{}")));
  expect_same(collected(geo_feature("{}", geo_square, R"("id":"2020-01-31",)")));
  for (const char* geometry :
       {"null", R"({"type":"Point","coordinates":[1,2]})", R"({"type":"Polygon","coordinates":[]})",
        R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,3]]]})",
        R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,null],[0,0]]]})"})
    expect_same(collected(geo_feature("{}") + "," + geo_feature("{}", geometry)));
  expect_same(collected(""));
  expect_same(collected(geo_feature("{}"), "\"crs\":null,"));
  expect_same(collected(geo_feature("{}")).substr(0, 90));
}

/// The strings, numbers, words, brackets and spaces that a text is made of.
std::vector<std::string> json_words(const std::string& text) {
  constexpr const char* single = "{}[]:, \n";
  std::vector<std::string> words;
  for (std::size_t i = 0, end = 0; i < text.size(); i = end) {
    end = i + 1;
    if (text[i] == '"') {
      for (; text[end] != '"'; ++end)
        if (text[end] == '\\') ++end;
      ++end;
    } else if (std::string_view(single).find(text[i]) == std::string_view::npos) {
      end = std::min(text.find_first_of(single, i), text.size());
    }
    words.push_back(text.substr(i, end - i));
  }
  return words;
}

/// Collections with odd members, in any order, and with odd numbers.
class OddCollections {
 public:
  explicit OddCollections(std::uint64_t seed) : random_(seed) {}

  std::string next() {
    number_kinds_ = one_in(4) ? numbers.size() : 7;
    const std::vector<std::string> kinds{
        R"({"a":1,"b":"x"})",         R"({"a":7,"b":null})",
        R"({"b":"y","a":2})",         R"({"a":)" + number() + R"(,"b":"\u00e4\"\\ {[,:"})",
        R"({"a":true,"b":"x"})",      R"({"id":3,"b":"x"})",
        R"({"id":"3","b":"x"})",      "null",
        R"({"a":1,"b":"2020-01-01"})"};
    const std::size_t some = one_in(4) ? kinds.size() : 2;
    std::string list;
    const bool named = one_in(6);
    for (std::size_t count = 1 + below(3); count > 0; --count)
      list += feature(kinds[below(some)], named) + (count > 1 ? "," : "");
    std::vector<std::string> members{R"("type":"FeatureCollection")",
                                     "\"features\":[" + list + "]"};
    add_some(members, {R"("name":"x")", R"("bbox":[0,0,4,4])",
                       R"("crs":{"type":"name","properties":{"name":"EPSG:3857"}})",
                       R"("more":{"a":[1,{"b":null}]})", R"("type":"Feature")"});
    const std::string text = object(members);
    return one_in(3) ? changed(json_words(text)) : text;
  }

 private:
  static inline const std::array<std::string, 22> numbers{"0",
                                                          "4",
                                                          "-3.5",
                                                          "1e1",
                                                          "2.50E-1",
                                                          "-0",
                                                          "-0.0",
                                                          "9007199254740993",
                                                          "9223372036854775807",
                                                          "9223372036854775808",
                                                          "123456789012345678901234567890",
                                                          "0.1234567890123456789012345678901",
                                                          "1e400",
                                                          "-1e-400",
                                                          "NaN",
                                                          "Infinity",
                                                          "01",
                                                          "1.",
                                                          ".5",
                                                          "+1",
                                                          "1e",
                                                          "\"1\""};
  static inline const std::array<std::string, 30> odd{
      "{",
      "}",
      "[",
      "]",
      ":",
      ",",
      "\"",
      "\\",
      "\r\n",
      "\t",
      "\v",
      std::string(1, '\0'),
      "\xef\xbb\xbf",
      "\xff",
      "\xc3\xa4",
      "null",
      "nul",
      "True",
      "nan",
      "0x10",
      "1/*x*/",
      "//x\n",
      "'x'",
      R"("\u0000")",
      R"("\ud800")",
      R"("\u00zz")",
      R"("type")",
      R"("id":1,)",
      R"("\u0061":1,)",
      std::string(1200, '[') + std::string(1200, ']')};

  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  std::string number() { return numbers[below(number_kinds_)]; }
  void add_some(std::vector<std::string>& members, const std::vector<std::string>& more) {
    if (one_in(3)) members.push_back(more[below(more.size())]);
  }
  std::string object(std::vector<std::string> members) {
    std::shuffle(members.begin(), members.end(), random_);
    std::string text;
    for (const std::string& member : members) text += (text.empty() ? "" : ",") + member;
    return (one_in(4) ? "\r\n{ " : "{") + text + "}";
  }
  std::string ring() {
    std::string text;
    const std::string first = "[0," + number() + "]";
    for (std::size_t count = 1 + below(12); count > 0; --count)
      text += ",[" + number() + "," + number() + (one_in(60) ? "," + number() : "") + "]";
    return "[" + first + text + "," + (one_in(20) ? "[0,9]" : first) + "]";
  }
  std::string geometry() {
    if (one_in(20)) return "null";
    if (one_in(20))
      return object({R"("type":"GeometryCollection")",
                     "\"geometries\":[" + (one_in(3) ? "" : geometry()) + "]"});
    if (one_in(20)) return object({R"("type":"LineString")", "\"coordinates\":" + ring()});
    const std::string rings = "[" + ring() + (one_in(3) ? "," + ring() : "") + "]";
    const bool several = one_in(3);
    std::vector<std::string> members{several ? R"("type":"MultiPolygon")" : R"("type":"Polygon")",
                                     "\"coordinates\":" + (several ? "[" + rings + "]" : rings)};
    if (one_in(6)) add_some(members, {R"("bbox":[0,0,4,4])", R"("coordinates":[])", R"("x":1)"});
    return object(members);
  }
  std::string feature(const std::string& properties, bool named) {
    std::vector<std::string> members{R"("type":"Feature")", "\"properties\":" + properties,
                                     "\"geometry\":" + geometry()};
    if (named && !one_in(8)) members.push_back(one_in(4) ? R"("id":"12")" : R"("id":"way/1")");
    if (one_in(3))
      add_some(members, {R"("id":5)", R"("bbox":[0,0,4,4])", R"("bbox":[0,,NaN])", R"("x":1)",
                         R"("type":"x")", R"("geometry":null)"});
    return object(members);
  }

  /// A word or two are missing, doubled, swapped or odd, or the text ends too soon or goes on.
  std::string changed(std::vector<std::string> words) {
    for (std::size_t changes = 1 + below(2); changes > 0 && !words.empty(); --changes) {
      const std::size_t i = below(words.size()), j = below(words.size());
      const auto place = words.begin() + static_cast<std::ptrdiff_t>(i);
      switch (below(7)) {
        case 0:
          words.erase(place);
          break;
        case 1:
          words.insert(place, std::string(words[j]));
          break;
        case 2:
          std::swap(words[i], words[j]);
          break;
        case 3:
          *place = odd[below(odd.size())];
          break;
        case 4:
          words.insert(place, odd[below(odd.size())]);
          break;
        case 5:
          words.push_back(words[i]);
          break;
        default:
          words.resize(i);
      }
    }
    std::string text;
    for (const std::string& word : words) text += word;
    return text;
  }

  std::mt19937_64 random_;
  std::size_t number_kinds_ = 0;
};

// GDAL has laxer rules: input that this reader accepts must have the same meaning for GDAL.
TEST_F(Geojson, OddFilesAreThoseOfGdal) {
  const auto count = static_cast<int>(test::number_from("MEDIAL_PROPERTY_COUNT", 1000));
  OddCollections collections(7);
  ReadOptions by_gdal;
  by_gdal.where = "1=1";
  int taken = 0;
  for (int i = 0; i < count; ++i) {
    const std::string text = collections.next(), file = write("odd.geojson", text);
    if (!read_geojson(file)) continue;
    ++taken;
    EXPECT_EQ(geo_told(read_document(file)), geo_told(read_document(file, by_gdal))) << text;
  }
  EXPECT_GT(taken, count / 10);
  EXPECT_LT(taken, count / 2);
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
