// Readers and writers: what goes in comes out, whatever the bytes are.
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>
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
#include <tuple>

#include "medial/io/projection.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/query.h"

namespace medial::io {
namespace {

namespace fs = std::filesystem;

/// A fresh directory for each test, gone after it.
class Io : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "medial_io_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    directory_ = name;
  }
  void TearDown() override { fs::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }
  std::string content(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_), {}));
  }

  fs::path directory_;
};

ErrorCode code_of(const Result<Dataset>& result) {
  EXPECT_FALSE(result.ok());
  return result.ok() ? ErrorCode::internal : result.error().code;
}

Shape shape_of(const std::vector<std::vector<Vec2>>& loops) {
  Shape shape;
  shape.loop_begin.push_back(0);
  std::uint32_t ring = 0;
  for (const auto& loop : loops) {
    for (std::uint32_t k = 0; k < loop.size(); ++k) {
      shape.points.push_back(loop[k]);
      shape.sources.push_back({ring, k});
    }
    shape.loop_begin.push_back(static_cast<std::uint32_t>(shape.points.size()));
    shape.component.push_back(0);
    shape.hole.push_back(ring++ > 0);
  }
  return shape;
}

Disk middle(const Disk& a, const Disk& b) {
  return {midpoint(a.center, b.center), a.radius + 0.5 * (b.radius - a.radius)};
}

/// The rectangle [0, 4] x [0, 2]: four leaves, two branching nodes, five edges.
NativeItem rectangle() {
  NativeItem item;
  item.shape = shape_of({{{0, 0}, {4, 0}, {4, 2}, {0, 2}}});
  MedialAxis& axis = item.axis;
  axis.method = "hand";
  axis.tolerance = 1e-15;
  const auto& p = item.shape.points;
  for (std::uint32_t i = 0; i < 4; ++i) {
    axis.sites.push_back({p[i], p[(i + 1) % 4], 0, i, SiteKind::segment});
    axis.nodes.push_back({{p[i], 0}, 0, NodeKind::leaf});
  }
  axis.nodes.push_back({{{1, 1}, 1}, 0, NodeKind::branching});
  axis.nodes.push_back({{{3, 1}, 1}, 0, NodeKind::branching});
  const auto add = [&axis](std::uint32_t from, std::uint32_t to, std::uint32_t left,
                           std::uint32_t right) {
    axis.edges.push_back(
        {{from, to}, {left, right}, middle(axis.nodes[from].disk, axis.nodes[to].disk), 1});
  };
  add(0, 4, 3, 0);
  add(1, 5, 0, 1);
  add(2, 5, 1, 2);
  add(3, 4, 2, 3);
  add(4, 5, 2, 0);
  axis.statistics.queries = 12;
  axis.statistics.seconds = 0.1;
  axis.statistics.threads = 2;
  return item;
}

/// One parabola, between the vertex (0, 1) of a notch and the line below it. Not the whole axis.
NativeItem parabola() {
  NativeItem item;
  item.shape = shape_of({{{-2, 0}, {2, 0}, {2, 2}, {0, 1}, {-2, 2}}});
  MedialAxis& axis = item.axis;
  axis.method = "hand";
  axis.sites.push_back({{-2, 0}, {2, 0}, 0, 0, SiteKind::segment});
  axis.sites.push_back({{0, 1}, {0, 1}, 0, 3, SiteKind::vertex});
  axis.nodes.push_back({{{-1, 1}, 1}, 0, NodeKind::site_change});
  axis.nodes.push_back({{{1, 1}, 1}, 0, NodeKind::site_change});
  axis.edges.push_back({{0, 1}, {1, 0}, {{0, 0}, 0}, 1});
  item.attributes = {{"name", "notch \"1\""}, {"height", "2.5"}, {"code", "007"}, {"count", "3"}};
  return item;
}

NativeFile two_items() {
  NativeFile file;
  file.items = {rectangle(), parabola()};
  return file;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same(Vec2 a, Vec2 b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y); }
bool same(const Disk& a, const Disk& b) {
  return same(a.center, b.center) && same_bits(a.radius, b.radius);
}

void expect_same(const NativeItem& a, const NativeItem& b) {
  EXPECT_EQ(a.attributes, b.attributes);
  ASSERT_EQ(a.shape.points.size(), b.shape.points.size());
  for (std::size_t i = 0; i < a.shape.points.size(); ++i) {
    EXPECT_TRUE(same(a.shape.points[i], b.shape.points[i]));
    EXPECT_EQ(a.shape.sources[i].ring, b.shape.sources[i].ring);
    EXPECT_EQ(a.shape.sources[i].vertex, b.shape.sources[i].vertex);
  }
  EXPECT_EQ(a.shape.loop_begin, b.shape.loop_begin);
  EXPECT_EQ(a.shape.component, b.shape.component);
  EXPECT_EQ(a.shape.hole, b.shape.hole);
  EXPECT_EQ(a.axis.method, b.axis.method);
  EXPECT_TRUE(same_bits(a.axis.tolerance, b.axis.tolerance));
  EXPECT_TRUE(same_bits(a.axis.resolution, b.axis.resolution));
  ASSERT_EQ(a.axis.sites.size(), b.axis.sites.size());
  for (std::size_t i = 0; i < a.axis.sites.size(); ++i) {
    const Site& s = a.axis.sites[i];
    const Site& t = b.axis.sites[i];
    EXPECT_TRUE(same(s.start, t.start) && same(s.end, t.end));
    EXPECT_TRUE(s.ring == t.ring && s.vertex == t.vertex && s.kind == t.kind);
  }
  ASSERT_EQ(a.axis.nodes.size(), b.axis.nodes.size());
  for (std::size_t i = 0; i < a.axis.nodes.size(); ++i) {
    EXPECT_TRUE(same(a.axis.nodes[i].disk, b.axis.nodes[i].disk));
    EXPECT_EQ(a.axis.nodes[i].kind, b.axis.nodes[i].kind);
    EXPECT_EQ(a.axis.nodes[i].component, b.axis.nodes[i].component);
  }
  ASSERT_EQ(a.axis.edges.size(), b.axis.edges.size());
  for (std::size_t i = 0; i < a.axis.edges.size(); ++i) {
    EXPECT_EQ(a.axis.edges[i].node, b.axis.edges[i].node);
    EXPECT_EQ(a.axis.edges[i].site, b.axis.edges[i].site);
    EXPECT_TRUE(same(a.axis.edges[i].control, b.axis.edges[i].control));
    EXPECT_TRUE(same_bits(a.axis.edges[i].weight, b.axis.edges[i].weight));
  }
  EXPECT_EQ(a.axis.statistics.queries, b.axis.statistics.queries);
  EXPECT_EQ(a.axis.statistics.threads, b.axis.statistics.threads);
  EXPECT_TRUE(same_bits(a.axis.statistics.seconds, b.axis.statistics.seconds));
}

// ---------------------------------------------------------------------------------- reading text

TEST_F(Io, ReadsEveryKindOfWellKnownText) {
  const Result<Dataset> data =
      read_dataset(write("a.wkt",
                         "SRID=4326;polygon z((0 0 9,1 0 9,1 1e0 9,0 0 9))\r\n"
                         "MULTIPOLYGON M (((0 0 1,+1 0 2,.5 -1. 3)),EMPTY,"
                         "((2 2,3 2,3 3),(2.1 2.1,2.2 2.1,2.2 2.2)))\n\n"
                         "GeometryCollection(POINT(1 2),GEOMETRYCOLLECTION("
                         "POLYGONZM((0 0 1 2,1 0 1 2,1 1 1 2))),"
                         "LINESTRING(0 0,1 1))\n"
                         "POLYGON EMPTY\n"));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->features.size(), 3U);
  EXPECT_TRUE(data->geographic);
  EXPECT_NE(data->crs_wkt.find("WGS 84"), std::string::npos);
  EXPECT_EQ(data->features[0].rings.size(), 1U);
  EXPECT_EQ(data->features[0].rings[0].points.size(), 4U);
  EXPECT_TRUE(same(data->features[0].rings[0].points[2], {1, 1}));
  ASSERT_EQ(data->features[1].rings.size(), 3U);
  EXPECT_EQ(data->features[1].rings[1].role, RingRole::outer);
  EXPECT_EQ(data->features[1].rings[2].role, RingRole::hole);
  EXPECT_TRUE(same(data->features[1].rings[0].points[2], {0.5, -1}));
  EXPECT_EQ(data->features[2].id, 2);
  ASSERT_EQ(data->notes.size(), 2U);
  EXPECT_NE(data->notes[0].find("2 geometries are no polygons"), std::string::npos);
  EXPECT_NE(data->notes[1].find("1 features are empty"), std::string::npos);
}

TEST_F(Io, ReadsPlainCoordinates) {
  const Result<Dataset> data = read_dataset(
      write("a.txt", "# outer\n0 0\n4,0\n 4 ; 3 # corner\r\n\t0\t3\n\n\n# hole\n1 1\n2 1\n2 2"));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->features.size(), 1U);
  ASSERT_EQ(data->features[0].rings.size(), 2U);
  EXPECT_EQ(data->features[0].rings[0].points.size(), 4U);
  EXPECT_TRUE(same(data->features[0].rings[0].points[2], {4, 3}));
  EXPECT_EQ(data->features[0].rings[1].role, RingRole::any);
  EXPECT_EQ(data->features[0].rings[1].points.size(), 3U);
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
  const Result<Dataset> data = read_dataset(write("a.xy", text.str()));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  const auto& points = data->features[0].rings[0].points;
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
  const Result<Dataset> data = read_dataset(write("a.wkt", text));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  const auto& points = data->features[0].rings[0].points;
  ASSERT_EQ(points.size(), 60001U);
  for (std::size_t i = 0; i < 60000; ++i) {
    ASSERT_TRUE(same(points[i], {std::stod(std::to_string(i) + ".123456789"), -0.75})) << i;
  }
}

TEST_F(Io, ErrorsOfTextsNameTheLine) {
  const auto refused = [this](const std::string& name, const std::string& text) {
    const Result<Dataset> data = read_dataset(write(name, text));
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
  EXPECT_EQ(code_of(read_dataset(write("a.wkt", deep))), ErrorCode::malformed);
  EXPECT_EQ(code_of(read_dataset(write("b.wkt", "POLYGON" + deep.substr(0, 1 << 20)))),
            ErrorCode::malformed);
  EXPECT_EQ(code_of(read_dataset(write("c.wkt", "POINT" + deep.substr(0, 1 << 20)))),
            ErrorCode::malformed);
  std::string collections;
  for (int i = 0; i < 200000; ++i) collections += "GEOMETRYCOLLECTION(";
  collections += "POLYGON((0 0,1 0,1 1))";
  EXPECT_EQ(code_of(read_dataset(write("d.wkt", collections))), ErrorCode::malformed);
  collections += std::string(200000, ')');
  EXPECT_TRUE(read_dataset(write("e.wkt", collections)).ok());
  EXPECT_EQ(code_of(read_dataset(
                write("f.wkt", "CURVEPOLYGON" + std::string(1000, '(') + std::string(1000, ')')))),
            ErrorCode::unsupported);
  EXPECT_EQ(code_of(read_dataset(write("g.json", std::string(std::size_t{1} << 20, '[')))),
            ErrorCode::malformed);
  EXPECT_FALSE(
      read_dataset(write("h.json", "{\"medial\":1,\"items\":" + std::string(1 << 20, '['))).ok());
}

TEST_F(Io, MissingFilesAndDirectoriesAreUnreadable) {
  for (const char* name :
       {"none.wkt", "none.txt", "none.json", "none.geojson", "none.gpkg", "none"}) {
    EXPECT_EQ(code_of(read_dataset(path(name))), ErrorCode::unreadable) << name;
  }
  fs::create_directory(path("folder.wkt"));
  EXPECT_EQ(code_of(read_dataset(path("folder.wkt"))), ErrorCode::unreadable);
  EXPECT_FALSE(read_native(path("none.json")).ok());
  EXPECT_FALSE(is_native(path("none.json")));
}

TEST_F(Io, FormatsWithoutAttributesRefuseFilters) {
  const std::string file = write("a.wkt", "POLYGON((0 0,1 0,1 1))");
  ReadOptions options;
  options.where = "a = 1";
  EXPECT_EQ(code_of(read_dataset(file, options)), ErrorCode::invalid_option);
}

// ------------------------------------------------------------------------------------ any prefix

/// Every prefix of a file is read or refused, by a typed error that names the file.
void expect_typed_errors(const std::string& name, const std::string& content, std::size_t whole) {
  for (std::size_t size = 0; size <= content.size(); ++size) {
    std::ofstream(name, std::ios::binary | std::ios::trunc) << content.substr(0, size);
    const Result<Dataset> data = read_dataset(name);
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
    const Result<NativeFile> file = read_native(write("b.json", damaged));
    if (file.ok()) {
      for (const NativeItem& item : file->items) {
        for (const Edge& edge : item.axis.edges) EXPECT_LT(edge.node[0], item.axis.nodes.size());
      }
    } else {
      EXPECT_NE(file.error().code, ErrorCode::internal);
    }
  }
}

// ----------------------------------------------------------------------------------------- GDAL

constexpr const char* kCollection =
    R"({"type":"FeatureCollection","features":[
{"type":"Feature","id":5,"properties":{"name":"a","n":1,"x":0.1},"geometry":{"type":"Polygon",
 "coordinates":[[[10,50],[10.1,50],[10.1,50.1],[10,50]]]}},
{"type":"Feature","id":6,"properties":{"name":"b","n":2,"x":null},"geometry":{"type":"GeometryCollection",
 "geometries":[{"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,4],[0,0]],[[2,1],[3,1],[3,2],[2,1]]],
 [[[8,8],[9,8],[9,9],[8,8]]]]},{"type":"Point","coordinates":[1,1]}]}},
{"type":"Feature","id":7,"properties":{"name":"c","n":3},"geometry":null}]})";

TEST_F(Io, ReadsFeaturesWithAttributes) {
  const Result<Dataset> data = read_dataset(write("a.geojson", kCollection));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->features.size(), 2U);
  EXPECT_TRUE(data->geographic);
  EXPECT_EQ(data->features[0].id, 5);
  const std::vector<std::pair<std::string, std::string>> expected{
      {"name", "a"}, {"n", "1"}, {"x", "0.1"}};
  EXPECT_EQ(data->features[0].attributes, expected);
  EXPECT_EQ(data->features[1].attributes.size(), 2U);
  ASSERT_EQ(data->features[1].rings.size(), 3U);
  EXPECT_EQ(data->features[1].rings[1].role, RingRole::hole);
  EXPECT_EQ(data->features[1].rings[2].role, RingRole::outer);
  EXPECT_EQ(data->notes.size(), 2U);

  ReadOptions options;
  options.where = "n = 2";
  const Result<Dataset> filtered = read_dataset(path("a.geojson"), options);
  ASSERT_TRUE(filtered.ok());
  EXPECT_EQ(filtered->features.size(), 1U);
  options.where = "n = 9";
  EXPECT_EQ(code_of(read_dataset(path("a.geojson"), options)), ErrorCode::empty);
  options.where = "no such thing";
  EXPECT_EQ(code_of(read_dataset(path("a.geojson"), options)), ErrorCode::invalid_option);
  options.where.clear();
  options.layer = "none";
  EXPECT_EQ(code_of(read_dataset(path("a.geojson"), options)), ErrorCode::invalid_option);
}

TEST_F(Io, FilesThatHoldNoPolygonsAreUnsupported) {
  EXPECT_EQ(code_of(read_dataset(write("a.geojson", R"({"type":"Point","coordinates":[1,2]})"))),
            ErrorCode::unsupported);
  EXPECT_EQ(code_of(read_dataset(write("a.bin", std::string("\x7f\x45\x4c\x46 garbage", 12)))),
            ErrorCode::unsupported);
  EXPECT_EQ(code_of(read_dataset(write("a.gpkg", "garbage"))), ErrorCode::malformed);
  EXPECT_EQ(code_of(read_dataset(write("a.shp", "garbage"))), ErrorCode::malformed);
  EXPECT_EQ(code_of(read_dataset(write("a.fgb", "fgb"))), ErrorCode::malformed);
}

// -------------------------------------------------------------------------------------- writers

TEST_F(Io, NativeFilesLoseNothing) {
  NativeFile file = two_items();
  file.crs_wkt = "LOCAL_CS[\"any\"]";
  std::mt19937_64 random(11);
  const auto any = [&random] {
    for (;;) {
      const double value = std::bit_cast<double>(random());
      if (std::isfinite(value)) return value;
    }
  };
  NativeItem wild = rectangle();  // numbers of any size, sites that are no edges of the shape
  wild.shape.points[1].x = -0.0;
  for (Site& site : wild.axis.sites) site.start = {any(), any()};
  for (Node& node : wild.axis.nodes) node.disk = {{any(), any()}, std::fabs(any())};
  for (Edge& edge : wild.axis.edges) {
    edge.control = {{any(), any()}, any()};
    edge.weight = 1.5;
  }
  wild.attributes = {{"\xC3\xA4\n", "\"\\ \t\x01"}};
  file.items.push_back(wild);
  file.items.push_back({});

  const Status written = write_axes(path("a.json"), "", file);
  ASSERT_TRUE(written.ok()) << to_string(written.error());
  EXPECT_TRUE(is_native(path("a.json")));
  const Result<NativeFile> read = read_native(path("a.json"));
  ASSERT_TRUE(read.ok()) << to_string(read.error());
  EXPECT_EQ(read->crs_wkt, file.crs_wkt);
  ASSERT_EQ(read->items.size(), file.items.size());
  for (std::size_t i = 0; i < file.items.size(); ++i) expect_same(file.items[i], read->items[i]);

  ASSERT_TRUE(write_axes(path("b.json"), "", *read).ok());
  EXPECT_EQ(content("a.json"), content("b.json"));

  const Result<Dataset> data = read_dataset(path("a.json"));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  EXPECT_EQ(data->features.size(), 3U);
  EXPECT_EQ(data->features[0].rings[0].points, file.items[0].shape.points);
}

TEST_F(Io, NativeFilesAreChecked) {
  const auto refused = [this](const std::string& text) {
    const Result<NativeFile> file = read_native(write("a.json", text));
    EXPECT_FALSE(file.ok()) << text;
    return file.ok() ? ErrorCode::internal : file.error().code;
  };
  ASSERT_TRUE(write_axes(path("good.json"), "", two_items()).ok());
  const std::string good = content("good.json");
  const auto with = [&good](const std::string& old, const std::string& by) {
    std::string text = good;
    EXPECT_NE(text.find(old), std::string::npos) << old;
    return text.replace(text.find(old), old.size(), by);
  };
  EXPECT_EQ(refused(with("\"medial\":1", "\"medial\":3")), ErrorCode::unsupported);
  EXPECT_EQ(refused(with("\"medial\":1", "\"medial\":0")), ErrorCode::malformed);
  EXPECT_EQ(refused(with("[0,4,3,0]", "[0,6,3,0]")), ErrorCode::malformed);          // node
  EXPECT_EQ(refused(with("[0,4,3,0]", "[0,4,4,0]")), ErrorCode::malformed);          // site
  EXPECT_EQ(refused(with("[0,4,3,0]", "[0,4,3,0,1]")), ErrorCode::malformed);        // short row
  EXPECT_EQ(refused(with("[0,4,3,0]", "[0,4,3,0,1,1,1,0]")), ErrorCode::malformed);  // weight
  EXPECT_EQ(refused(with("[0,4,3,0]", "[0,4,3,0,1,1,1,1,1]")), ErrorCode::malformed);
  EXPECT_EQ(refused(with("[0,4,3,0]", "[0,4,3,-1]")), ErrorCode::malformed);
  EXPECT_EQ(refused(with("[0,4,3,0]", "[0,4,3,4294967296]")), ErrorCode::malformed);
  EXPECT_EQ(refused(with("[1,1,1,0,2]", "[1,1,-1,0,2]")), ErrorCode::malformed);  // radius
  EXPECT_EQ(refused(with("[1,1,1,0,2]", "[1,1,1,1,2]")), ErrorCode::malformed);   // component
  EXPECT_EQ(refused(with("[1,1,1,0,2]", "[1,1,1,0,3]")), ErrorCode::malformed);   // kind
  EXPECT_EQ(refused(with("[1,1,1,0,2]", "[1,1,1e999,0,2]")), ErrorCode::malformed);
  EXPECT_EQ(refused(with("\"loop_begin\":[0,4]", "\"loop_begin\":[0,5]")), ErrorCode::malformed);
  EXPECT_EQ(refused(with("\"loop_begin\":[0,4]", "\"loop_begin\":[0,2,4]")), ErrorCode::malformed);
  EXPECT_EQ(refused(with("\"hole\":[false]", "\"hole\":[]")), ErrorCode::malformed);
  EXPECT_EQ(refused("{\"medial\":1}"), ErrorCode::malformed);
  EXPECT_EQ(refused("{\"type\":\"FeatureCollection\"}"), ErrorCode::malformed);

  const Result<NativeFile> file = read_native(write("a.json", with("[0,4,3,0]", "[0,4,3,0,x]")));
  ASSERT_FALSE(file.ok());
  EXPECT_TRUE(file.error().place.line.has_value());
}

TEST_F(Io, AnAxisThatIsNotFiniteIsNotWritten) {
  NativeFile file = two_items();
  file.items[0].axis.nodes[2].disk.radius = std::numeric_limits<double>::infinity();
  const Status status = write_axes(path("a.json"), "", file);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::internal);
  EXPECT_EQ(entries(), 0U);
}

TEST_F(Io, CsvHoldsEveryEdgeWithNodesPrintedAlike) {
  ASSERT_TRUE(write_axes(path("a.csv"), "", two_items()).ok());
  std::istringstream lines(content("a.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, "edge,x,y,r");
  std::vector<std::vector<Disk>> edges;
  std::vector<std::string> rows;
  while (std::getline(lines, line)) {
    std::size_t edge = 0;
    Disk disk;
    ASSERT_EQ(std::sscanf(line.c_str(), "%zu,%lf,%lf,%lf", &edge, &disk.center.x, &disk.center.y,
                          &disk.radius),
              4);
    ASSERT_LE(edge, edges.size());
    if (edge == edges.size()) edges.emplace_back();
    edges[edge].push_back(disk);
    rows.push_back(line.substr(line.find(',')));
  }
  ASSERT_EQ(edges.size(), 6U);  // five of the rectangle and one parabola
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(edges[i].size(), 2U);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), ",1,1,1"),
            4);  // three edges, and the parabola's end
  const std::vector<Disk>& curve = edges[5];
  const double chord = 1e-3 * std::hypot(4.0, 2.0);
  EXPECT_GT(curve.size(), 5U);
  EXPECT_TRUE(same(curve.front(), {{-1, 1}, 1}));
  EXPECT_TRUE(same(curve.back(), {{1, 1}, 1}));
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    EXPECT_NEAR(curve[i].center.y, 0.5 * (1 + curve[i].center.x * curve[i].center.x), 1e-12);
    const double width = curve[i + 1].center.x - curve[i].center.x;
    EXPECT_LE(width * width / 8, chord);  // how far y = (x^2 + 1) / 2 lies below a chord
  }
}

TEST_F(Io, WktHoldsALineForEachItem) {
  WriteOptions options;
  options.chord = 1;
  NativeFile file = two_items();
  file.items.push_back({});
  ASSERT_TRUE(write_axes(path("a.wkt"), "", file, options).ok());
  const std::string text = content("a.wkt");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_TRUE(text.starts_with("MULTILINESTRING ((0 0, 1 1), "));
  EXPECT_NE(text.find("\nMULTILINESTRING ((-1 1, 1 1))\n"), std::string::npos);
  EXPECT_TRUE(text.ends_with("MULTILINESTRING EMPTY\n"));
}

TEST_F(Io, TheChordIsChecked) {
  for (const double chord : {0.0, -1.0, std::nan("")}) {
    WriteOptions options;
    options.chord = chord;
    const Status status = write_axes(path("a.csv"), "", two_items(), options);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::invalid_option);
  }
}

// ------------------------------------------------------------------------------ files of a system

TEST_F(Io, UnknownFormatsAreUnsupported) {
  for (const char* name : {"a.xyz", "a", "a.json.bak"}) {
    const Status status = write_axes(path(name), "", two_items());
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::unsupported);
  }
  EXPECT_EQ(entries(), 0U);
  EXPECT_TRUE(write_axes(path("a.xyz"), "csv", two_items()).ok());
}

TEST_F(Io, TargetsThatCannotBeWrittenAreUnwritable) {
  fs::create_directory(path("folder.json"));
  for (const char* name : {"none/a.json", "none/a.gpkg", "folder.json", "none/a.svg"}) {
    const Status status = write_axes(path(name), "", two_items());
    ASSERT_FALSE(status.ok()) << name;
    EXPECT_EQ(status.error().code, ErrorCode::unwritable);
    EXPECT_EQ(status.error().place.file, path(name));
  }
  EXPECT_EQ(entries(), 1U);
}

/// Lets files grow to a size only, for as long as the object lives: a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t size) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{size, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit limit_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(Io, FullDisksLeaveTheOldFile) {
  for (const char* format :
       {"json", "csv", "wkt", "svg", "pdf", "png", "ps", "geojson", "gpkg", "shp", "fgb"}) {
    const std::string name = std::string("a.") + format;
    write(name, "old");
    {
      const FullDisk full(64);
      const Status status = write_axes(path(name), "", two_items());
      ASSERT_FALSE(status.ok()) << format;
      EXPECT_EQ(status.error().code, ErrorCode::unwritable) << format;
    }
    EXPECT_EQ(content(name), "old") << format;
    EXPECT_EQ(entries(), 1U) << format;
    fs::remove(path(name));
  }
}

TEST_F(Io, LinksAndDevicesStayWhatTheyAre) {
  write("real.csv", "old");
  fs::create_symlink(path("real.csv"), path("link.csv"));
  ASSERT_TRUE(write_axes(path("link.csv"), "", two_items()).ok());
  EXPECT_TRUE(fs::is_symlink(path("link.csv")));
  EXPECT_TRUE(content("real.csv").starts_with("edge,x,y,r\n"));
  EXPECT_EQ(entries(), 2U);

  ASSERT_TRUE(write_axes("/dev/null", "csv", two_items()).ok());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const Status full = write_axes("/dev/full", "csv", two_items());
  ASSERT_FALSE(full.ok());
  EXPECT_EQ(full.error().code, ErrorCode::unwritable);
}

TEST_F(Io, InterruptedWritesLeaveNothing) {
  EXPECT_EXIT(
      {
        // A signal in the midst of a large write.
        NativeFile file;
        file.items.assign(50000, parabola());
        std::signal(SIGALRM, [](int) {
          remove_partial_files();
          _exit(3);
        });
        ualarm(20000, 0);
        const Status status = write_axes(path("a.csv"), "", file);
        _exit(status.ok() ? 0 : 1);
      },
      testing::ExitedWithCode(3), "");
  EXPECT_EQ(entries(), 0U);
}

/// Runs an action with a file as standard input and gives what it wrote to standard output.
std::string in_child(const std::string& input, const std::function<void()>& action) {
  int output[2];
  EXPECT_EQ(pipe(output), 0);
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
      const Result<Dataset> data = read_dataset("-");
      std::printf(
          "%d %s", native ? 1 : 0,
          data.ok() ? std::to_string(data->features.size()).c_str() : name_of(data.error().code));
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

// --------------------------------------------------------------------------------- read by GDAL

/// What a program that knows nothing of medial finds in a file.
struct Layer {
  std::string name;
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::vector<Vec2>> lines;
  bool has_crs = false;
};

std::vector<Layer> layers_of(const std::string& file) {
  GDALAllRegister();
  std::vector<Layer> result;
  const GDALDatasetUniquePtr source(GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR));
  if (!source) return result;
  for (OGRLayer* layer : source->GetLayers()) {
    Layer& found = result.emplace_back();
    found.name = layer->GetName();
    found.has_crs = layer->GetSpatialRef() != nullptr;
    for (const OGRFeatureUniquePtr& feature : layer) {
      auto& row = found.rows.emplace_back();
      for (int i = 0; i < feature->GetFieldCount(); ++i) {
        if (!feature->IsFieldSetAndNotNull(i)) continue;
        row[feature->GetFieldDefnRef(i)->GetNameRef()] = feature->GetFieldAsString(i);
      }
      auto& line = found.lines.emplace_back();
      const OGRGeometry* geometry = feature->GetGeometryRef();
      if (geometry != nullptr && wkbFlatten(geometry->getGeometryType()) == wkbLineString) {
        for (const OGRPoint& point : geometry->toLineString())
          line.push_back({point.getX(), point.getY()});
      }
    }
  }
  return result;
}

TEST_F(Io, EveryGisFormatIsReadBackByGdal) {
  for (const char* format : {"geojson", "gpkg", "shp", "fgb"}) {
    SCOPED_TRACE(format);
    const std::string file = path(std::string("out.") + format);
    const Status status = write_axes(file, "", two_items());
    ASSERT_TRUE(status.ok()) << to_string(status.error());
    const std::vector<Layer> layers = layers_of(file);
    ASSERT_EQ(layers.size(), format == std::string("gpkg") ? 2U : 1U);
    ASSERT_EQ(layers[0].rows.size(), 6U);
    // FlatGeobuf stores features in an order of its own.
    std::size_t bend = 6;
    std::size_t middle = 6;
    for (std::size_t i = 0; i < 6; ++i) {
      if (layers[0].rows[i].at("feature") == "1") bend = i;
      if (layers[0].rows[i].at("feature") == "0" && layers[0].rows[i].at("branch") == "4")
        middle = i;
    }
    ASSERT_LT(middle, 6U);
    EXPECT_EQ(std::stod(layers[0].rows[middle].at("length")), 2);
    EXPECT_EQ(std::stod(layers[0].rows[middle].at("r_from")), 1);
    EXPECT_EQ(layers[0].rows[middle].at("site_left"), "0/2");
    EXPECT_EQ(layers[0].rows[middle].at("site_right"), "0/0");
    EXPECT_EQ(layers[0].lines[middle], (std::vector<Vec2>{{1, 1}, {3, 1}}));

    ASSERT_LT(bend, 6U);
    const auto& row = layers[0].rows[bend];
    EXPECT_EQ(std::stod(row.at("r_min")), 0.5);
    EXPECT_EQ(std::stod(row.at("r_max")), 1);
    EXPECT_NEAR(std::stod(row.at("length")), std::sqrt(2) + std::asinh(1.0), 1e-12);
    EXPECT_EQ(row.at("name"), "notch \"1\"");
    EXPECT_EQ(row.at("code"), "007");
    EXPECT_EQ(std::stod(row.at("height")), 2.5);
    EXPECT_EQ(row.at("count"), "3");
    EXPECT_GT(layers[0].lines[bend].size(), 5U);
    if (layers.size() == 2) {
      EXPECT_EQ(layers[1].name, "nodes");
      ASSERT_EQ(layers[1].rows.size(), 8U);
      EXPECT_EQ(layers[1].rows[4].at("kind"), "branching");
      EXPECT_EQ(std::stod(layers[1].rows[4].at("r")), 1);
    }
  }
}

TEST_F(Io, AttributesNeverHideTheFieldsOfTheAxis) {
  NativeFile file;
  file.items = {parabola()};
  file.items[0].attributes = {{"length", "far"}, {"FID", "9"}, {"length_1", "x"}};
  for (const char* name : {"a.gpkg", "a.geojson"}) {
    ASSERT_TRUE(write_axes(path(name), "", file).ok());
    const std::vector<Layer> layers = layers_of(path(name));
    ASSERT_FALSE(layers.empty());
    EXPECT_NEAR(std::stod(layers[0].rows.at(0).at("length")), std::sqrt(2) + std::asinh(1.0),
                1e-12);
    EXPECT_EQ(layers[0].rows[0].at("length_1"), "far");
    EXPECT_EQ(layers[0].rows[0].at("length_1_1"), "x");
    EXPECT_EQ(layers[0].rows[0].at("FID_1"), "9");
  }
}

TEST_F(Io, LayersOfAFileAreChosenByName) {
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  {
    const GDALDatasetUniquePtr target(
        driver->Create(path("a.gpkg").c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    OGRSpatialReference reference;
    reference.importFromEPSG(32633);
    for (const double size : {1.0, 2.0}) {
      OGRLayer* layer =
          target->CreateLayer(size == 1 ? "one" : "two", &reference, wkbCurvePolygon, nullptr);
      OGRFeature feature(layer->GetLayerDefn());
      OGRGeometry* geometry = nullptr;
      const std::string r = std::to_string(size);
      OGRGeometryFactory::createFromWkt(("CURVEPOLYGON(CIRCULARSTRING(-" + r + " 0,0 " + r + "," +
                                         r + " 0,0 -" + r + ",-" + r + " 0))")
                                            .c_str(),
                                        nullptr, &geometry);
      feature.SetGeometryDirectly(geometry);
      ASSERT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
    }
  }
  ReadOptions options;
  for (const char* layer : {"", "one", "two"}) {
    options.layer = layer;
    const Result<Dataset> data = read_dataset(path("a.gpkg"), options);
    ASSERT_TRUE(data.ok()) << to_string(data.error());
    ASSERT_EQ(data->features.size(), 1U);
    EXPECT_FALSE(data->geographic);
    EXPECT_NE(data->crs_wkt.find("32633"), std::string::npos);
    for (const Vec2 p : data->features[0].rings.at(0).points) {
      EXPECT_NEAR(norm(p), options.layer == "two" ? 2 : 1, 1e-12);
    }
    EXPECT_FALSE(data->features[0].rings[0].bulges.empty());
    EXPECT_EQ(data->notes.size(), options.layer.empty() ? 1U : 0U);
  }
}

// ------------------------------------------------------------------------------------ projection

/// One triangle of longitudes and latitudes.
std::string degrees(double x, double y, double size) {
  std::ostringstream text;
  text << "SRID=4326;POLYGON((" << x << ' ' << y << ',' << x + size << ' ' << y << ',' << x << ' '
       << y + size << "))";
  return text.str();
}

TEST_F(Io, LocalProjectionsMeasureMetresAndGoBack) {
  ReadOptions options;
  options.project = true;
  for (const auto& [x, y, size] : {std::tuple{10.0, 50.0, 0.1},
                                   {-179.9, -40.0, 0.01},
                                   {20.0, 10.0, 30.0},
                                   {100.0, 89.0, 0.5}}) {
    const std::string file = write("a.wkt", degrees(x, y, size));
    const Result<Dataset> plain = read_dataset(file);
    const Result<Dataset> data = read_dataset(file, options);
    ASSERT_TRUE(data.ok()) << to_string(data.error());
    EXPECT_FALSE(data->geographic);
    EXPECT_TRUE(is_local_projection(data->crs_wkt));
    ASSERT_EQ(data->notes.size(), 1U);
    std::vector<Vec2> points = data->features[0].rings[0].points;
    if (size < 1) {
      const double meridian = distance(points[0], points[2]);
      EXPECT_NEAR(meridian / size, 111200, 600);  // metres a degree of latitude, on the ellipsoid
    }
    Result<BackToGeographic> back = BackToGeographic::make(data->crs_wkt);
    ASSERT_TRUE(back.ok());
    EXPECT_NE(back->crs_wkt().find("WGS 84"), std::string::npos);
    ASSERT_TRUE(back->transform(points).ok());
    for (std::size_t i = 0; i < points.size(); ++i) {
      // 2 mm, in degrees: as good as the series of the equal-area projection.
      EXPECT_NEAR(points[i].x, plain->features[0].rings[0].points[i].x, 2e-8);
      EXPECT_NEAR(points[i].y, plain->features[0].rings[0].points[i].y, 2e-8);
    }
  }
  EXPECT_FALSE(BackToGeographic::make("").ok());
}

TEST_F(Io, GisFormatsOfProjectedAxesAreInDegreesWithRadiiInMetres) {
  ReadOptions options;
  options.project = true;
  const Result<Dataset> data = read_dataset(write("a.wkt", degrees(10, 50, 0.1)), options);
  ASSERT_TRUE(data.ok());
  NativeFile file = two_items();  // its units are metres around the middle of the triangle
  file.crs_wkt = data->crs_wkt;
  ASSERT_TRUE(write_axes(path("a.json"), "", file).ok());
  const Result<NativeFile> again = read_native(path("a.json"));
  ASSERT_TRUE(again.ok());
  for (const char* name : {"a.geojson", "a.gpkg"}) {
    ASSERT_TRUE(write_axes(path(name), "", *again).ok());
    const std::vector<Layer> layers = layers_of(path(name));
    ASSERT_FALSE(layers.empty());
    EXPECT_TRUE(layers[0].has_crs);
    EXPECT_NEAR(layers[0].lines.at(0).at(0).x, 10.05, 0.1);
    EXPECT_NEAR(layers[0].lines.at(0).at(0).y, 50.05, 0.1);
    EXPECT_EQ(std::stod(layers[0].rows[4].at("length")), 2);
  }
}

TEST_F(Io, WhatIsNotGeographicIsNotProjected) {
  ReadOptions options;
  options.project = true;
  EXPECT_EQ(code_of(read_dataset(write("a.wkt", "POLYGON((0 0,1000 0,1000 1000))"), options)),
            ErrorCode::invalid_option);
  const Result<Dataset> utm =
      read_dataset(write("b.wkt", "SRID=32633;POLYGON((0 0,1000 0,1000 1000))"), options);
  ASSERT_TRUE(utm.ok());
  EXPECT_TRUE(same(utm->features[0].rings[0].points[2], {1000, 1000}));
  EXPECT_EQ(utm->notes.size(), 1U);
  const Result<Dataset> bare = read_dataset(write("c.wkt", "POLYGON((0 0,1 0,1 1))"), options);
  ASSERT_TRUE(bare.ok());
  EXPECT_EQ(bare->notes.size(), 2U);  // taken as degrees; projected
}

// ---------------------------------------------------------------------------------------- repair

double area_of(const Feature& feature) {
  const Result<Shape> shape = build_shape(feature.rings);
  EXPECT_TRUE(shape.ok()) << to_string(shape.error());
  return shape.ok() ? area(*shape) : -1;
}

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
      ReadOptions options;
      options.repair = rule;
      const Result<Dataset> data = read_dataset(file, options);
      ASSERT_TRUE(data.ok()) << to_string(data.error());
      EXPECT_NEAR(area_of(data->features[0]), expected, 1e-12) << static_cast<int>(rule);
    }
  }
}

TEST_F(Io, RepairTellsWhatItChangedAndLeavesTheRest) {
  ReadOptions options;
  options.repair = RepairRule::make_valid;
  const Result<Dataset> data = read_dataset(
      write("a.wkt", "POLYGON((0.1 0,1 0,1 1.7,0.1 0))\nPOLYGON((0 0,2 2,2 0,0 2,0 0))"), options);
  ASSERT_TRUE(data.ok());
  EXPECT_EQ(data->features[0].rings[0].points,
            (std::vector<Vec2>{{0.1, 0}, {1, 0}, {1, 1.7}, {0.1, 0}}));
  ASSERT_EQ(data->notes.size(), 1U);
  EXPECT_EQ(data->notes[0],
            "feature 1 was repaired by MakeValid: 1 rings, 4 vertices, area 0 before; 2 rings, 6 "
            "vertices, "
            "area 2 after");
  EXPECT_EQ(code_of(read_dataset(write("b.wkt", "POLYGON((0 0,1 1,2 2,0 0))"), options)),
            ErrorCode::no_area);

  options.repair = RepairRule::even_odd;
  const Result<Dataset> loose =
      read_dataset(write("c.txt", "0 0\n4 0\n4 4\n0 4\n\n1 1\n2 1\n2 2\n1 2\n"), options);
  ASSERT_TRUE(loose.ok());
  EXPECT_NEAR(area_of(loose->features[0]), 15, 1e-12);
}

// -------------------------------------------------------------------------------------- pictures

TEST_F(Io, PicturesAreOfTheirKindAndSize) {
  WriteOptions options;
  options.disks = 12;
  options.contacts = true;
  options.nodes = true;
  const std::map<std::string, std::string> begins{
      {"svg", "<?xml"}, {"pdf", "%PDF"}, {"ps", "%!PS"}, {"png", "\x89PNG"}};
  for (const auto& [format, begin] : begins) {
    const Status status = write_axes(path("a." + format), "", two_items(), options);
    ASSERT_TRUE(status.ok()) << to_string(status.error());
    EXPECT_TRUE(content("a." + format).starts_with(begin)) << format;
  }
  const std::string png = content("a.png");  // width and height stand at byte 16, high byte first
  const auto number = [&png](std::size_t at) {
    return static_cast<unsigned char>(png[at + 2]) * 256 + static_cast<unsigned char>(png[at + 3]);
  };
  EXPECT_EQ(number(16), 1024);
  EXPECT_NEAR(number(20), 1024 * 0.94 * 2 / 6 + 1024 * 0.06, 1);  // the box is 6 by 2
}

TEST_F(Io, VectorPicturesHoldTheParabolaAsCubics) {
  NativeFile file;
  file.items = {parabola()};
  WriteOptions options;
  options.shape = false;
  ASSERT_TRUE(write_axes(path("a.svg"), "", file, options).ok());
  const std::string text = content("a.svg");
  // The parabola y = (x^2 + 1) / 2, x from -1 to 1, in a picture of the box [-2, 2] x [0, 2].
  const double scale = 1024 * 0.94 / 4;
  std::size_t cubics = 0;
  for (std::size_t at = 0; (at = text.find(" d=\"M ", at)) != std::string::npos; ++at) {
    std::istringstream path_data(text.substr(at + 6));
    double number[8];
    std::string letter;
    while (path_data >> number[0] >> number[1] >> letter && letter == "C") {
      for (int i = 2; i < 8; ++i) ASSERT_TRUE(path_data >> number[i]);
      ++cubics;
      for (int k = 0; k <= 10; ++k) {
        const double t = 0.1 * k;
        const double s = 1 - t;
        const double b[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
        double px = 0;
        double py = 0;
        for (int i = 0; i < 4; ++i) {
          px += b[i] * number[2 * i];
          py += b[i] * number[2 * i + 1];
        }
        const double x = (px - 512) / scale;
        const double height = std::ceil(2 * scale + 0.06 * 1024);
        const double y = 1 - (py - 0.5 * height) / scale;
        EXPECT_NEAR(y, 0.5 * (1 + x * x), 2.0 / 256 / scale);  // Cairo counts in 1/256 of a unit
      }
      if (!(path_data >> letter) || letter != "M") break;
    }
  }
  EXPECT_GE(cubics, 8U);
}

TEST_F(Io, PicturesOfAnythingAreDrawn) {
  NativeFile empty;
  NativeFile point;
  point.items.emplace_back();
  point.items[0].shape = shape_of({{{1, 1}, {1, 1}, {1, 1}}});
  NativeFile needle;
  needle.items = {rectangle()};
  for (Vec2& p : needle.items[0].shape.points) p.y *= 1e9;
  NativeFile large;
  large.items = {rectangle()};
  for (Vec2& p : large.items[0].shape.points) p = 1e300 * p;
  WriteOptions options;
  options.disks = 5;
  for (const NativeFile& file : {empty, point, needle, large}) {
    for (const char* name : {"a.png", "a.svg", "a.pdf", "a.ps"}) {
      const Status status = write_axes(path(name), "", file, options);
      EXPECT_TRUE(status.ok()) << name << to_string(status.error());
    }
  }
  for (const double width : {0.0, -1.0, 1e9, std::nan("")}) {
    options.width = width;
    const Status status = write_axes(path("b.png"), "", two_items(), options);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::invalid_option);
  }
}

// -------------------------------------------------------------------------------------- real data

/// The folder of real inputs: the environment's MEDIAL_DATA, or beside the sources.
fs::path data_folder() {
  const char* named = std::getenv("MEDIAL_DATA");
  return named != nullptr ? fs::path(named)
                          : fs::path(MEDIAL_SOURCE_DIR) / ".." / "shared" / "data";
}

TEST_F(Io, CompressedTextIsReadAndItsTruncationNoticed) {
  const fs::path file = data_folder() / "packaged" / "A_gis" / "gshhg" / "sao_tome.wkt.gz";
  if (!fs::exists(file)) GTEST_SKIP() << "no data folder: set MEDIAL_DATA";
  const Result<Dataset> data = read_dataset(file.string());
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->features.size(), 1U);
  EXPECT_EQ(data->features[0].rings.at(0).points.size(), 999U);

  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t size = 0; size < bytes.size(); size += size < 64 ? 1 : 97) {
    const Result<Dataset> part = read_dataset(write("a.wkt.gz", bytes.substr(0, size)));
    ASSERT_FALSE(part.ok()) << size;
    EXPECT_TRUE(part.error().code == ErrorCode::malformed || part.error().code == ErrorCode::empty)
        << size;
  }
  std::string damaged = bytes;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x55);
  EXPECT_EQ(code_of(read_dataset(write("b.wkt.gz", damaged))), ErrorCode::malformed);
}

TEST_F(Io, EveryFileOfTheDataFolderIsReadOrRefused) {
  if (!fs::exists(data_folder())) GTEST_SKIP() << "no data folder: set MEDIAL_DATA";
  std::size_t read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(data_folder())) {
    if (!entry.is_regular_file() || entry.file_size() > (std::uintmax_t{2} << 20)) continue;
    const Result<Dataset> data = read_dataset(entry.path().string());
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
