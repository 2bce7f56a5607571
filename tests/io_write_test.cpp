// Writers: every file has the content that its format defines, and no failure leaves a partial
// file.
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
#include <numbers>
#include <random>
#include <sstream>
#include <tuple>

#include "io/output.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/query.h"
#include "support/native_items.h"

namespace medial::io {
namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& directory) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory), {}));
}

// -------------------------------------------------------------------------------------- writers

TEST_F(Io, NativeFilesLoseNothing) {
  Document<AxisItem> file = two_items();
  file.crs_wkt = "LOCAL_CS[\"any\"]";
  std::mt19937_64 random(11);
  const auto any = [&random] {
    for (;;) {
      const double value = std::bit_cast<double>(random());
      if (std::isfinite(value)) return value;
    }
  };
  AxisItem wild = rectangle();  // numbers of any size, sites that are no edges of the shape
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
  const Result<Document<AxisItem>> read = read_native(path("a.json"));
  ASSERT_TRUE(read.ok()) << to_string(read.error());
  EXPECT_EQ(read->crs_wkt, file.crs_wkt);
  ASSERT_EQ(read->items.size(), file.items.size());
  for (std::size_t i = 0; i < file.items.size(); ++i) expect_same(file.items[i], read->items[i]);

  ASSERT_TRUE(write_axes(path("b.json"), "", *read).ok());
  EXPECT_EQ(content("a.json"), content("b.json"));

  const Result<Document<Feature>> data = read_document(path("a.json"));
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  EXPECT_EQ(data->items.size(), 3U);
  EXPECT_EQ(data->items[0].rings[0].points, file.items[0].shape.points);
}

TEST_F(Io, NativeFilesAreChecked) {
  const auto refused = [this](const std::string& text) {
    const Result<Document<AxisItem>> file = read_native(write("a.json", text));
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

  const Result<Document<AxisItem>> file =
      read_native(write("a.json", with("[0,4,3,0]", "[0,4,3,0,x]")));
  ASSERT_FALSE(file.ok());
  EXPECT_TRUE(file.error().place.line.has_value());
}

TEST_F(Io, AnAxisThatIsNotFiniteIsNotWritten) {
  Document<AxisItem> file = two_items();
  file.items[0].axis.nodes[2].disk.radius = std::numeric_limits<double>::infinity();
  const Status status = write_axes(path("a.json"), "", file);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::internal);
  EXPECT_EQ(entries(directory_), 0U);
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
  Document<AxisItem> file = two_items();
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
  EXPECT_EQ(entries(directory_), 0U);
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
  EXPECT_EQ(entries(directory_), 1U);
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
    EXPECT_EQ(entries(directory_), 1U) << format;
    fs::remove(path(name));
  }
}

TEST_F(Io, LinksAndDevicesStayWhatTheyAre) {
  write("real.csv", "old");
  fs::create_symlink(path("real.csv"), path("link.csv"));
  ASSERT_TRUE(write_axes(path("link.csv"), "", two_items()).ok());
  EXPECT_TRUE(fs::is_symlink(path("link.csv")));
  EXPECT_TRUE(content("real.csv").starts_with("edge,x,y,r\n"));
  EXPECT_EQ(entries(directory_), 2U);

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
        Document<AxisItem> file;
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
  EXPECT_EQ(entries(directory_), 0U);
}

// --------------------------------------------------------------------------------- read by GDAL

/// The content that a program without knowledge of medial finds in a file.
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

TEST_F(Io, SpatialIndexesMadeLaterAreWholeAndFindWhatIsThere) {
  // A node of the index holds 51 features: one node, two levels, three levels.
  for (const int corners : {8, 100, 4000}) {
    SCOPED_TRACE(corners);
    Ring star;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners, radius = i % 2 == 0 ? 1 : 0.9;
      star.points.push_back({-radius * std::cos(angle), radius * std::sin(angle)});
    }
    Document<AxisItem> file;
    AxisItem& item = file.items.emplace_back();
    item.shape = build_shape(std::vector<Ring>{star}).value();
    item.axis = compute(item.shape).value();
    const std::string name = path("index.gpkg");
    const Status status = write_axes(name, "", file, {.overwrite = true});
    ASSERT_TRUE(status.ok()) << to_string(status.error());
    const GDALDatasetUniquePtr data(
        GDALDataset::Open(name.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE));
    ASSERT_TRUE(data);
    const auto answer = [&data](const std::string& query) {
      OGRLayer* rows = data->ExecuteSQL(query.c_str(), nullptr, nullptr);
      const OGRFeatureUniquePtr row(rows == nullptr ? nullptr : rows->GetNextFeature());
      std::string text = row ? row->GetFieldAsString(0) : "";
      data->ReleaseResultSet(rows);
      return text;
    };
    for (const std::string layer : {"axis", "nodes"}) {
      OGRLayer* const features = data->GetLayerByName(layer.c_str());
      ASSERT_NE(features, nullptr);
      EXPECT_EQ(answer("SELECT CreateSpatialIndex('" + layer + "', 'geom')"), "1");
      EXPECT_EQ(answer("SELECT rtreecheck('rtree_" + layer + "_geom')"), "ok");
      const auto indexed = [&] { return answer("SELECT count(*) FROM rtree_" + layer + "_geom"); };
      EXPECT_EQ(indexed(), std::to_string(features->GetFeatureCount()));
      // A query by window gives the same features by the index and one by one.
      std::size_t inside = 0, found = 0;
      OGREnvelope window;
      window.MinX = 0.1, window.MaxX = 1.5, window.MinY = -0.3, window.MaxY = 0.4;
      for (const auto& feature : *features) {
        OGREnvelope box;
        feature->GetGeometryRef()->getEnvelope(&box);
        if (window.Intersects(box)) ++inside;
      }
      features->SetSpatialFilterRect(window.MinX, window.MinY, window.MaxX, window.MaxY);
      for (const auto& feature : *features) found += feature->GetFID() > 0 ? 1 : 0;
      features->SetSpatialFilter(nullptr);
      EXPECT_GT(found, 0U);
      EXPECT_LE(found, inside);
      const std::string ids = answer("SELECT count(*) FROM rtree_" + layer +
                                     "_geom WHERE maxx>=0.1 AND minx<=1.5 AND maxy>=-0.3 AND "
                                     "miny<=0.4");
      EXPECT_EQ(ids, std::to_string(inside));
      // Later changes reach the index.
      EXPECT_EQ(features->DeleteFeature(1), OGRERR_NONE);
      OGRFeature added(features->GetLayerDefn());
      if (layer == "nodes") added.SetGeometryDirectly(new OGRPoint(0.5, 0.5));
      EXPECT_EQ(features->CreateFeature(&added), OGRERR_NONE);
      EXPECT_EQ(indexed(), std::to_string(features->GetFeatureCount() - (layer == "axis" ? 1 : 0)));
      EXPECT_EQ(answer("SELECT rtreecheck('rtree_" + layer + "_geom')"), "ok");
    }
  }
}

TEST_F(Io, AttributesNeverHideTheFieldsOfTheAxis) {
  Document<AxisItem> file;
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

TEST_F(Io, ReferenceSystemsAndKindsOfNumbersComeBackFromGeojsonAndGeoPackages) {
  Document<AxisItem> file = two_items();
  OGRSpatialReference reference;
  ASSERT_EQ(reference.importFromEPSG(32633), OGRERR_NONE);
  char* wkt = nullptr;
  ASSERT_EQ(reference.exportToWkt(&wkt), OGRERR_NONE);
  file.crs_wkt = wkt;
  CPLFree(wkt);
  file.items[0].attributes = {{"name", "\"a\" \\ \xC3\xA4 \t"}};
  GDALAllRegister();
  for (const char* name : {"a.geojson", "a.gpkg"}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(write_axes(path(name), "", file).ok());
    const GDALDatasetUniquePtr data(GDALDataset::Open(path(name).c_str(), GDAL_OF_VECTOR));
    ASSERT_TRUE(data);
    OGRLayer* const layer = data->GetLayer(0);
    ASSERT_NE(layer->GetSpatialRef(), nullptr);
    EXPECT_STREQ(layer->GetSpatialRef()->GetAuthorityCode(nullptr), "32633");
    const OGRFeatureDefn* fields = layer->GetLayerDefn();
    const auto type = [&](const char* field) {
      return fields->GetFieldDefn(fields->GetFieldIndex(field))->GetType();
    };
    EXPECT_EQ(type("r_max"), OFTReal);
    EXPECT_NE(type("branch"), OFTReal);
    const OGRFeatureUniquePtr first(layer->GetNextFeature());
    EXPECT_STREQ(first->GetFieldAsString("name"), file.items[0].attributes[0].second.c_str());
    OGREnvelope box;
    ASSERT_EQ(layer->GetExtent(&box, TRUE), OGRERR_NONE);
    EXPECT_EQ(box.MinX, -1);  // of the parabola, and of the rectangle
    EXPECT_EQ(box.MaxX, 4);
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
    const Result<Document<Feature>> data = read_document(path("a.gpkg"), options);
    ASSERT_TRUE(data.ok()) << to_string(data.error());
    ASSERT_EQ(data->items.size(), 1U);
    EXPECT_FALSE(data->geographic);
    EXPECT_NE(data->crs_wkt.find("32633"), std::string::npos);
    for (const Vec2 p : data->items[0].rings.at(0).points) {
      EXPECT_NEAR(norm(p), options.layer == "two" ? 2 : 1, 1e-12);
    }
    EXPECT_FALSE(data->items[0].rings[0].bulges.empty());
    EXPECT_EQ(data->notes.size(), options.layer.empty() ? 1U : 0U);
  }
}

TEST_F(Io, GisFormatsOfProjectedAxesAreInDegreesWithRadiiInMetres) {
  ReadOptions options;
  options.project = true;
  const Result<Document<Feature>> data =
      read_document(write("a.wkt", degrees(10, 50, 0.1)), options);
  ASSERT_TRUE(data.ok());
  Document<AxisItem> file = two_items();  // its units are metres around the middle of the triangle
  file.crs_wkt = data->crs_wkt;
  ASSERT_TRUE(write_axes(path("a.json"), "", file).ok());
  const Result<Document<AxisItem>> again = read_native(path("a.json"));
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
  Document<AxisItem> file;
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

/// Short edges in a row, whose radii alternate, and every other node is `aside`. First come the
/// even edges, then the odd ones.
AxisItem short_edges(std::uint32_t count, double aside) {
  AxisItem row;
  row.axis.resolution = 1;
  for (std::uint32_t i = 0; i <= count; ++i)
    row.axis.nodes.push_back({{{i + 0.0, i % 2 == 0 ? 0 : aside}, i % 2 == 0 ? 1.0 : 1000.0}});
  for (const std::uint32_t first : {0U, 1U}) {
    for (std::uint32_t i = first; i < count; i += 2) {
      Edge& edge = row.axis.edges.emplace_back();
      edge.node = {i, i + 1};
      edge.control = {{i + 0.5, 0.5 * aside}, 500.5};
    }
  }
  return row;
}

TEST_F(Io, PicturesDrawShortEdgesInFewPieces) {
  const auto lines = [this](std::uint32_t count, double aside) {
    Document<AxisItem> file;
    file.items = {short_edges(count, aside)};
    WriteOptions options;
    options.shape = false;
    EXPECT_TRUE(write_axes(path("a.svg"), "", file, options).ok());
    const std::string text = content("a.svg");
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(" L ", at)) != std::string::npos; ++at) ++found;
    return found;
  };
  // Edges too short to be seen are not cut where their shade changes, one is drawn for many in the
  // same place, and those in line are one line.
  EXPECT_GT(lines(20000, 20), 20000U / 8);
  EXPECT_LE(lines(20000, 20), 20000U);
  EXPECT_LE(lines(20000, 3), 20000U / 8);
  EXPECT_EQ(lines(20000, 0), 1U);
  // Three times as long as lines are wide: cut into pieces as long, and no line of one shade.
  EXPECT_GT(lines(200, 0), 200U * 2);
}

/// A file that another program writes in its place meanwhile stays.
TEST_F(Io, ANewFileForLayersReplacesNone) {
  const auto new_file = [this](const char* text) {
    Result<PendingFile> file = PendingFile::create(path("a.gpkg"));
    EXPECT_TRUE(file);
    std::ofstream(file->path()) << text;
    return file;
  };
  Result<PendingFile> first = new_file("one"), second = new_file("two");
  EXPECT_TRUE(first->commit_new().ok());
  const Status late = second->commit_new();
  ASSERT_FALSE(late.ok());
  EXPECT_EQ(late.error().code, ErrorCode::unwritable);
  std::ifstream kept(path("a.gpkg"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), "one");
}

TEST_F(Io, PicturesOfAnythingAreDrawn) {
  Document<AxisItem> empty;
  Document<AxisItem> point;
  point.items.emplace_back();
  point.items[0].shape = shape_of({{{1, 1}, {1, 1}, {1, 1}}});
  Document<AxisItem> needle;
  needle.items = {rectangle()};
  for (Vec2& p : needle.items[0].shape.points) p.y *= 1e9;
  Document<AxisItem> large;
  large.items = {rectangle()};
  for (Vec2& p : large.items[0].shape.points) p = 1e300 * p;
  WriteOptions options;
  options.disks = 5;
  for (const Document<AxisItem>& file : {empty, point, needle, large}) {
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

}  // namespace
}  // namespace medial::io
