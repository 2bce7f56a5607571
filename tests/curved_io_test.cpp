// Curved inputs and outputs: DXF, fonts, curve geometries, medial's own contours and arcs.
#include "support/curved_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <random>
#include <sstream>

#include "medial/compute.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/verify.h"
#include "support/environment.h"

namespace medial::io {
namespace {

namespace fs = std::filesystem;

/// Tests that need DXF: skipped if medial::io is built without it.
class CurvedDxf : public CurvedIo {
 protected:
  void SetUp() override {
    CurvedIo::SetUp();
    const Result<Document<Feature>> data = read_document(write("empty.dxf", ""));
    if (!data && to_string(data.error()).find("without DXF") != std::string::npos)
      GTEST_SKIP() << "built without DXF";
  }
};

// --- DXF -----------------------------------------------------------------------------------------

/// Groups as "code value" pairs, one a line: "0 LINE\n8 A\n...".
std::string dxf(const std::string& entities, const std::string& blocks = "") {
  std::string pairs = "0 SECTION\n2 BLOCKS\n" + blocks + "0 ENDSEC\n0 SECTION\n2 ENTITIES\n" +
                      entities + "0 ENDSEC\n0 EOF\n";
  std::string text;
  std::istringstream lines(pairs);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t space = line.find(' ');
    text += line.substr(0, space) + "\n" + line.substr(space + 1) + "\n";
  }
  return text;
}

std::string dxf_line(double x0, double y0, double x1, double y1, const std::string& layer = "A") {
  std::ostringstream out;
  out << "0 LINE\n8 " << layer << "\n10 " << x0 << "\n20 " << y0 << "\n11 " << x1 << "\n21 " << y1
      << "\n";
  return out.str();
}

TEST_F(CurvedDxf, JoinsLooseCurves) {
  // A stadium: lines and half circles in any order and direction.
  const Document<Feature> data =
      read("a.dxf", dxf(dxf_line(0, 0, 4, 0) + "0 ARC\n8 A\n10 0\n20 1\n40 1\n50 90\n51 270\n" +
                        dxf_line(0, 2, 4, 2) + "0 ARC\n8 A\n10 4\n20 1\n40 1\n50 270\n51 90\n"));
  ASSERT_EQ(data.items.size(), 1U);
  EXPECT_EQ(data.items[0].attributes[0], (std::pair<std::string, std::string>{"layer", "A"}));
  EXPECT_FALSE(data.y_down);
  EXPECT_EQ(count(data), (Counts{1, 2, 2, 0, 0, 0}));
  const Contour& loop = data.items[0].contours[0];
  EXPECT_EQ(loop.points.front(), loop.points.back());
  double turn = 0;
  for (const CurvePiece& piece : loop.pieces) turn += 4 * std::atan(piece.bulge);
  EXPECT_NEAR(std::fabs(turn), 2 * std::numbers::pi, 1e-14);
}

TEST_F(CurvedDxf, ReadsClosedEntities) {
  const Document<Feature> data = read(
      "a.dxf",
      dxf("0 CIRCLE\n8 A\n10 1\n20 2\n40 3\n"
          "0 ELLIPSE\n8 B\n10 0\n20 0\n11 4\n21 0\n40 0.5\n41 0\n42 6.283185307179586\n"
          "0 LWPOLYLINE\n8 C\n90 2\n70 1\n10 0\n20 0\n42 1\n10 2\n20 0\n42 1\n"
          "0 POLYLINE\n8 D\n66 1\n70 1\n0 VERTEX\n8 D\n10 0\n20 0\n0 VERTEX\n8 D\n10 4\n20 0\n42 "
          "0.5\n0 VERTEX\n8 D\n10 4\n20 4\n0 SEQEND\n"
          "0 SPLINE\n8 E\n70 1\n71 2\n72 8\n73 5\n74 0\n40 0\n40 0\n40 0\n40 1\n40 2\n40 3\n40 "
          "3\n40 3\n10 0\n20 0\n10 4\n20 0\n10 4\n20 4\n10 0\n20 4\n10 0\n20 0\n"
          "0 LWPOLYLINE\n8 F\n90 1\n70 1\n10 0\n20 0\n42 1\n"
          "0 TEXT\n8 A\n1 hello\n0 HATCH\n8 A\n91 99999999\n"));
  ASSERT_EQ(data.items.size(), 5U);
  expect_circle(data.items[0].contours[0], {1, 2}, 3, true);
  EXPECT_EQ(data.items[1].contours[0].points.front(), data.items[1].contours[0].points.back());
  expect_circle(data.items[2].contours[0], {1, 0}, 1, true);
  EXPECT_EQ(data.items[3].contours[0].pieces[1].bulge, 0.5);
  EXPECT_EQ(data.items[3].contours[0].pieces.size(), 3U);
  const Contour& spline = data.items[4].contours[0];
  EXPECT_EQ(spline.pieces.size(), 3U);  // one a knot interval
  EXPECT_EQ(spline.pieces[0].degree, 2U);
  ASSERT_EQ(data.notes.size(), 1U);
  EXPECT_NE(data.notes[0].find("1 HATCH, 1 TEXT"), std::string::npos);
}

TEST_F(CurvedDxf, BlocksAndMirrors) {
  const std::string block =
      "0 BLOCK\n8 0\n2 B\n70 0\n10 1\n20 0\n0 CIRCLE\n8 0\n10 1\n20 0\n40 1\n0 ENDBLK\n8 0\n";
  const Document<Feature> data = read(
      "a.dxf", dxf("0 INSERT\n8 A\n2 B\n10 10\n20 0\n41 2\n42 2\n50 90\n70 2\n71 1\n44 5\n45 0\n"
                   "0 INSERT\n8 B\n2 B\n10 0\n20 0\n41 2\n42 1\n"
                   "0 CIRCLE\n8 C\n10 5\n20 0\n40 1\n210 0\n220 0\n230 -1\n"
                   "0 INSERT\n8 D\n2 missing\n10 0\n20 0\n",
                   block));
  ASSERT_EQ(data.items.size(), 3U);
  // Entities of the drawing itself come before inserted ones.
  expect_circle(data.items[0].contours[0], {-5, 0}, 1, false);
  ASSERT_EQ(data.items[1].contours.size(), 2U);
  expect_circle(data.items[1].contours[0], {10, 0}, 2, true);
  expect_circle(data.items[1].contours[1], {10, 5}, 2, true);
  EXPECT_FALSE(data.items[2].contours[0].weights.empty());  // stretched to an ellipse
}

TEST_F(CurvedDxf, GapsAndOpenCurves) {
  const std::string open = dxf_line(0, 0, 4, 0) + dxf_line(4, 0, 4, 3) + dxf_line(4, 3, 0.01, 0);
  const Error error = refused("a.dxf", dxf(open));
  EXPECT_EQ(error.code, ErrorCode::empty);
  EXPECT_NE(error.text.find("3 curves stay open"), std::string::npos) << error.text;
  ReadOptions options;
  options.close = 0.02;
  EXPECT_EQ(count(read("a.dxf", dxf(open), options)), (Counts{1, 3, 0, 0, 0, 0}));
  options.close = std::numeric_limits<double>::infinity();
  const Document<Feature> closed = read("a.dxf", dxf(open), options);
  EXPECT_EQ(count(closed), (Counts{1, 3, 0, 0, 0, 0}));
  EXPECT_FALSE(closed.items[0].contours[0].points.front() ==
               closed.items[0].contours[0].points.back());
  // Dangling lines do not spoil the loop that they touch.
  const Document<Feature> dangling =
      read("a.dxf", dxf(dxf_line(0, 0, -1, -1) + dxf_line(0, 0, 4, 0) + dxf_line(4, 0, 4, 3) +
                        dxf_line(4, 3, 0, 0)));
  EXPECT_EQ(count(dangling), (Counts{1, 3, 0, 0, 0, 0}));
  EXPECT_NE(dangling.notes[0].find("1 curve stays open"), std::string::npos);
  // Two triangles with a common corner.
  const Document<Feature> touching =
      read("a.dxf", dxf(dxf_line(0, 0, 4, 0) + dxf_line(4, 0, 4, 3) + dxf_line(4, 3, 0, 0) +
                        dxf_line(0, 0, -4, 0) + dxf_line(-4, 0, -4, -3) + dxf_line(-4, -3, 0, 0)));
  EXPECT_EQ(count(touching).lines, 6U);
  EXPECT_TRUE(touching.notes.empty());
}

TEST_F(CurvedDxf, Nets) {
  // A ladder, and a line that leads nowhere: no curve of them closes by itself.
  const std::string net = dxf_line(0, 0, 4, 0) + dxf_line(0, 0, 0, 2) + dxf_line(4, 0, 4, 2) +
                          dxf_line(0, 2, 4, 2) + dxf_line(0, 2, 0, 5) + dxf_line(4, 2, 4, 5) +
                          dxf_line(0, 5, 4, 5) + dxf_line(0, 5, 0, 9) + dxf_line(4, 5, 4, 9) +
                          dxf_line(0, 9, 4, 9) + dxf_line(4, 9, 9, 9);
  Document<Feature> cells = read("a.dxf", dxf(net));
  ASSERT_EQ(cells.items.size(), 3U);
  ASSERT_EQ(cells.notes.size(), 2U);
  EXPECT_EQ(cells.notes[0], "no curve is closed: 10 curves enclose 3 cells, a feature each");
  EXPECT_EQ(cells.notes[1].find("1 curve stays open"), 0U) << cells.notes[1];
  const auto shapes = load_shapes(std::move(cells));
  ASSERT_TRUE(shapes);
  std::vector<double> areas;
  for (const ShapeItem& item : shapes->items) areas.push_back(area(item.shape));
  std::ranges::sort(areas);
  EXPECT_EQ(areas, (std::vector<double>{8, 12, 16}));
  // Where anything is closed, the rest stays open as ever.
  EXPECT_EQ(read("a.dxf", dxf(net + "0 CIRCLE\n8 0\n10 20\n20 0\n40 1\n")).items.size(), 1U);
}

TEST_F(CurvedDxf, Layers) {
  const std::string two = "0 CIRCLE\n8 A\n10 0\n20 0\n40 1\n0 CIRCLE\n8 B\n10 9\n20 0\n40 2\n";
  EXPECT_EQ(read("a.dxf", dxf(two)).items.size(), 2U);
  ReadOptions options;
  options.layer = "B";
  const Document<Feature> one = read("a.dxf", dxf(two), options);
  ASSERT_EQ(one.items.size(), 1U);
  expect_circle(one.items[0].contours[0], {9, 0}, 2, true);
  options.layer = "C";
  EXPECT_EQ(refused("a.dxf", dxf(two), options).code, ErrorCode::invalid_option);
}

TEST_F(CurvedDxf, PointsAreLoose) {
  const std::string points = "0 POINT\n8 A\n10 1\n20 2\n0 POINT\n8 A\n10 4\n20 2\n";
  ReadOptions options;
  options.loose = true;
  const Document<Feature> all = read("a.dxf", dxf(points), options);
  ASSERT_EQ(all.items.size(), 1U);
  ASSERT_EQ(all.items[0].contours.size(), 2U);
  EXPECT_EQ(all.items[0].contours[1].points, (std::vector<Vec2>{{4, 2}}));
  EXPECT_NE(refused("a.dxf", dxf(points)).text.find("2 POINT"), std::string::npos);
}

TEST_F(CurvedDxf, RefusesWhatIsBroken) {
  const auto code = [this](const std::string& text) { return refused("bad.dxf", text).code; };
  const std::string circle = "0 CIRCLE\n8 A\n10 0\n20 0\n40 1\n";
  const std::string whole = dxf(circle);
  EXPECT_EQ(code(""), ErrorCode::malformed);
  EXPECT_EQ(code("nothing of the kind\n"), ErrorCode::malformed);
  for (std::size_t length = 0; length + 5 < whole.size(); length += 7) {
    EXPECT_EQ(code(whole.substr(0, length)), ErrorCode::malformed) << length;
  }
  EXPECT_EQ(code(dxf("0 CIRCLE\n8 A\n10 nan\n20 0\n40 1\n")), ErrorCode::not_finite);
  EXPECT_EQ(code(dxf("0 CIRCLE\n8 A\n10 one\n20 0\n40 1\n")), ErrorCode::malformed);
  EXPECT_EQ(code(dxf("0 LWPOLYLINE\n8 A\n90 1073741825\n70 1\n10 0\n20 0\n")),
            ErrorCode::malformed);
  EXPECT_EQ(code(dxf("0 LWPOLYLINE\n8 A\n90 -1\n70 1\n10 0\n20 0\n")), ErrorCode::malformed);
  EXPECT_EQ(code(dxf("0 SPLINE\n8 A\n71 3\n72 999999999\n73 4\n10 0\n20 0\n")),
            ErrorCode::malformed);
  EXPECT_EQ(code(dxf("0 SPLINE\n8 A\n71 3\n72 2\n73 2\n40 0\n40 1\n10 0\n20 0\n10 1\n20 0\n")),
            ErrorCode::malformed);
  EXPECT_EQ(code("AutoCAD Binary DXF\r\n"), ErrorCode::unsupported);
  const Error error = refused("bad.dxf", dxf("0 CIRCLE\n8 A\n10 0\n20 inf\n40 1\n"));
  EXPECT_EQ(error.place.line, 18U);
}

TEST_F(CurvedDxf, BombsAreBounded) {
  std::string blocks =
      "0 BLOCK\n8 0\n2 B0\n10 0\n20 0\n0 CIRCLE\n8 0\n10 0\n20 0\n40 1\n0 ENDBLK\n";
  for (int i = 1; i < 10; ++i) {
    blocks += "0 BLOCK\n8 0\n2 B" + std::to_string(i) + "\n10 0\n20 0\n0 INSERT\n8 0\n2 B" +
              std::to_string(i - 1) + "\n10 0\n20 0\n70 30000\n71 30000\n44 1\n45 1\n0 ENDBLK\n";
  }
  EXPECT_EQ(refused("bomb.dxf", dxf("0 INSERT\n8 0\n2 B9\n10 0\n20 0\n", blocks)).code,
            ErrorCode::too_large);
  const std::string self =
      "0 BLOCK\n8 0\n2 B\n10 0\n20 0\n0 INSERT\n8 0\n2 B\n10 0\n20 0\n0 ENDBLK\n";
  EXPECT_EQ(refused("bomb.dxf", dxf("0 INSERT\n8 0\n2 B\n10 0\n20 0\n", self)).code,
            ErrorCode::unsupported);
}

TEST_F(CurvedDxf, OfTheDataFolder) {
  const fs::path data = test::data_folder();
  if (!fs::exists(data)) GTEST_SKIP() << data << " is not here";
  // Drawings of open curves or of polygons in tilted planes: there is nothing with an inside.
  const std::vector<std::string> nothing{"dxfparser_splines.dxf", "ezdxf_POLI-ALL210_12.DXF"};
  std::size_t files = 0;
  for (const char* folder : {"packaged/B_dxf", "in_place/B_dxf"}) {
    if (!fs::exists(data / folder)) continue;
    for (const auto& entry : fs::directory_iterator(data / folder)) {
      const std::string name = entry.path().filename().string();
      const Result<Document<Feature>> drawing = read_document(entry.path().string());
      ++files;
      if (std::ranges::find(nothing, name) != nothing.end()) {
        ASSERT_FALSE(drawing.ok()) << name;
        EXPECT_EQ(drawing.error().code, ErrorCode::empty) << name;
      } else {
        EXPECT_TRUE(drawing.ok()) << to_string(drawing.error());
      }
      // A net of hexagons, of which no line closes: Euler's formula counts its cells.
      if (name == "librecad_honeycomb.dxf") {
        EXPECT_EQ(drawing->items.size(), 143U);
      }
    }
  }
  EXPECT_GE(files, 13U);
}

// --- fonts ---------------------------------------------------------------------------------------

TEST_F(CurvedIo, FontOutlines) {
  const std::string font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  if (!fs::exists(font)) GTEST_SKIP() << font << " is not here";
  const Result<Document<Feature>> data = read_text("i \xC3\xA4V", font);
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->items.size(), 3U);
  EXPECT_EQ(data->items[0].contours.size(), 2U);  // the dot
  EXPECT_EQ(data->items[1].contours.size(), 4U);  // two dots, a bowl and its counter
  EXPECT_EQ(data->items[1].attributes[0].second, "\xC3\xA4");
  EXPECT_EQ(data->items[1].attributes[1].second, "2");
  EXPECT_EQ(data->items[0].contours[0].role, RingRole::winding);
  EXPECT_FALSE(data->y_down);
  // Advances place the following glyphs to the right.
  const auto left = [](const Feature& feature) {
    double x = std::numeric_limits<double>::infinity();
    for (const Contour& contour : feature.contours) {
      for (const Vec2 p : contour.points) x = std::min(x, p.x);
    }
    return x;
  };
  EXPECT_GT(left(data->items[1]), left(data->items[0]) + 500);
  // Arcs are within a 64th of a font unit, also of letters of another size, in another unit.
  SourceOptions sized;
  sized.text = "S";
  for (const double size : {0.0, 10.0}) {
    sized.font_size = size;
    sized.units.scale = 3;
    LoadReport report;
    ASSERT_TRUE(load_shapes(font, sized, &report));
    const double unit = 3 * (size > 0 ? size / 2048 : 1);
    EXPECT_NEAR(report.arcs.tolerance, unit / 64, 1e-9 * unit);
    EXPECT_LE(report.arcs.largest_error, unit / 64);
    EXPECT_GT(report.arcs.largest_error, unit / 640);
  }
  sized.load.arcs.tolerance = 1e-6;
  LoadReport fine;
  ASSERT_TRUE(load_shapes(font, sized, &fine));
  EXPECT_LT(fine.arcs.largest_error, 3 * 10.0 / 2048 / 300);
  EXPECT_EQ(read_text("  ", font).error().code, ErrorCode::empty);
  // No UTF-8: a stray byte, a surrogate, a code beyond the last, a letter in more bytes than it
  // takes.
  for (const char* bytes : {"\xFF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xC1\xA1"}) {
    const Result<Document<Feature>> refused = read_text(bytes, font);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().text, "byte 0 of the text is not UTF-8");
  }
  EXPECT_EQ(read_text("a\n", font).error().code, ErrorCode::malformed);
  const Result<Document<Feature>> missing = read_text("\xF0\x93\x80\x80", font);  // a hieroglyph
  ASSERT_TRUE(missing.ok());
  EXPECT_EQ(missing->notes.size(), 1U);
}

TEST_F(CurvedIo, FontsThatAreNone) {
  EXPECT_EQ(read_text("a", path("missing.ttf")).error().code, ErrorCode::unreadable);
  EXPECT_EQ(read_text("a", write("a.ttf", "no font")).error().code, ErrorCode::unsupported);
  EXPECT_EQ(read_text("a", write("b.ttf", std::string("\0\1\0\0\0\4", 6))).error().place.file,
            path("b.ttf"));
}

// --- curve geometries ----------------------------------------------------------------------------

TEST_F(CurvedIo, CurveGeometriesAreArcs) {
  const Document<Feature> data =
      read("a.wkt",
           "CURVEPOLYGON(CIRCULARSTRING(0 0,1 1,2 0,1 -1,0 0),(0.5 0,1 0.2,1 0,0.5 0))\n"
           "MULTISURFACE(CURVEPOLYGON(COMPOUNDCURVE((0 0,4 0),CIRCULARSTRING(4 0,5 1,4 2),(4 2,0 "
           "2),CIRCULARSTRING(0 2,-1 1,0 0))),((9 0,10 0,10 1,9 0)))\n"
           "CURVEPOLYGON(CIRCULARSTRING(0 0,6 8,0 0))\n"
           "CURVEPOLYGON(CIRCULARSTRING(0 0,1 0,2 0,3 3,0 0))\n");
  ASSERT_EQ(data.items.size(), 4U);
  const Ring& circle = data.items[0].rings[0];
  ASSERT_EQ(circle.points.size(), 3U);
  ASSERT_EQ(circle.bulges.size(), 3U);
  EXPECT_DOUBLE_EQ(circle.bulges[0], -1);
  EXPECT_DOUBLE_EQ(circle.bulges[1], -1);
  EXPECT_EQ(data.items[0].rings[1].role, RingRole::hole);
  EXPECT_TRUE(data.items[0].rings[1].bulges.empty());
  const Ring& stadium = data.items[1].rings[0];
  ASSERT_EQ(stadium.points.size(), 5U);
  EXPECT_EQ(stadium.bulges[0], 0);
  EXPECT_DOUBLE_EQ(stadium.bulges[1], 1);
  EXPECT_EQ(stadium.bulges[2], 0);
  EXPECT_DOUBLE_EQ(stadium.bulges[3], 1);
  EXPECT_EQ(data.items[1].rings.size(), 2U);
  EXPECT_EQ(data.items[2].rings[0].bulges, (std::vector<double>{1, 1, 0}));
  EXPECT_EQ(data.items[2].rings[0].points[1], (Vec2{6, 8}));
  EXPECT_EQ(data.items[3].rings[0].bulges[0], 0);  // three points in a row
  EXPECT_TRUE(data.notes.empty());
}

/// Arcs of degrees become curves of metres, as far from each point's own image as the tolerance
/// says.
TEST_F(CurvedIo, ProjectsCurves) {
  for (const double radius : {0.001, 0.3, 5.0}) {
    std::ostringstream points, text;
    points.precision(17);
    text.precision(17);
    const Vec2 center{11, 48};
    const Contour circle = [&] {
      Contour contour;
      contour.start_at(center + Vec2{radius, 0});
      contour.arc_to(center - Vec2{radius, 0}, 1);
      contour.arc_to(center + Vec2{radius, 0}, 1);
      return contour;
    }();
    for (int i = 0; i <= 64; ++i) {
      const Vec2 point =
          test::point_of(circle, circle.pieces[i < 32 ? 0 : 1], i < 32 ? i / 32.0 : i / 32.0 - 1);
      points << (i > 0 ? "," : "") << point.x << " " << point.y;
    }
    text << "CURVEPOLYGON(CIRCULARSTRING(" << center.x + radius << " 48," << center.x - radius
         << " 48," << center.x + radius << " 48))\nPOLYGON((" << points.str() << "))";
    ReadOptions options;
    options.project = true;
    const Document<Feature> data = read("round.wkt", text.str(), options);
    ASSERT_EQ(data.items.size(), 2U);
    ASSERT_EQ(data.items[0].contours.size(), 1U);
    ASSERT_EQ(data.items[1].rings.size(), 1U);
    ArcReport report;
    const auto rings = approximate_by_arcs(data.items[0].contours, {.tolerance = 1e-9}, &report);
    ASSERT_TRUE(rings.ok());
    double furthest = 0;
    for (const Vec2 point : data.items[1].rings[0].points) {
      double nearest = 1e300;
      for (const auto& edge : test::edges_of((*rings)[0]))
        nearest = std::min(nearest, edge.distance_to(point));
      furthest = std::max(furthest, nearest);
    }
    EXPECT_LE(furthest, report.tolerance + 3e-8) << radius;
    const auto shape = build_shape(*rings);
    ASSERT_TRUE(shape.ok());
    const auto axis = compute(*shape);
    ASSERT_TRUE(axis.ok());
    EXPECT_TRUE(verify(*shape, *axis).passed);
    EXPECT_EQ(std::ranges::count(axis->nodes, NodeKind::leaf, &Node::kind), 2)
        << radius;  // an oval
  }
}

// --- medial's own format -------------------------------------------------------------------------

TEST_F(CurvedIo, NativeContours) {
  const std::string text = R"({"medial":2,"items":[{"attributes":[["name","a"]],"contours":[
    {"role":"hole","start":[0,0],"pieces":[["line",4,0],["arc",4,4,1],["bezier",3,5,2,5,1,4],
     ["rational",0,4,0.5,0,3,1]]}]}]})";
  const Result<Document<AxisItem>> file = read_native(write("a.json", text));
  ASSERT_TRUE(file.ok()) << to_string(file.error());
  ASSERT_EQ(file->items.size(), 1U);
  const Contour& contour = file->items[0].contours[0];
  EXPECT_EQ(contour.role, RingRole::hole);
  EXPECT_EQ(contour.pieces.size(), 4U);
  EXPECT_EQ(contour.pieces[1].bulge, 1);
  EXPECT_EQ(contour.pieces[2].degree, 3U);
  EXPECT_EQ(contour.weights.back(), 1);
  EXPECT_EQ(contour.weights[contour.weights.size() - 2], 0.5);
  const Document<Feature> data = read("a.json", text);
  EXPECT_EQ(data.items[0].contours.size(), 1U);
  const auto bad = [this](const std::string& contours) {
    const Result<Document<AxisItem>> broken =
        read_native(write("b.json", R"({"medial":2,"items":[{"contours":[)" + contours + "]}]}"));
    EXPECT_FALSE(broken.ok()) << contours;
    return broken.ok() ? ErrorCode::internal : broken.error().code;
  };
  for (const char* contours :
       {R"({"pieces":[]})", R"({"start":[0]})", R"({"start":[0,0],"pieces":[["line",1]]})",
        R"({"start":[0,0],"pieces":[["bow",1,2]]})", R"({"start":[0,0],"pieces":[[1,2]]})",
        R"({"start":[0,0],"pieces":[["bezier",1,2,3]]})", R"({"start":[0,0],"role":"x"})",
        R"({"start":[0,0],"pieces":[["rational",1,2,0]]})", R"({"start":[0,0],"pieces":[[]]})",
        R"({"start":[0,0],"pieces":[["bezier"]]})", R"({"start":[0,1e999]})"}) {
    EXPECT_EQ(bad(contours), ErrorCode::malformed) << contours;
  }
}

/// A lens of two arcs, with an axis that names its sites in every way there is.
Document<AxisItem> lens() {
  AxisItem item;
  item.shape.points = {{0, 0}, {2, 0}};
  item.shape.bulges = {0.3, 0.1 + 0.2};
  item.shape.sources = {{0, 0}, {0, 5}};
  item.shape.loop_begin = {0, 2};
  item.shape.component = {0};
  item.shape.hole = {false};
  item.axis.method = "disks";
  item.axis.sites = {{{0, 0}, {2, 0}, 0, 0, 0.3},
                     {{2, 0}, {0, 0}, 0, 5, 0.1 + 0.2},
                     {{2, 0}, {0.5, 0.25}, 0, 5, 0.125}};
  item.axis.nodes = {{{{0, 0}, 0}, 0, NodeKind::leaf}, {{{2, 0}, 0}, 0, NodeKind::leaf}};
  item.axis.edges = {{{0, 1}, {0, 1}, {{1, 0}, 0.7}, 1.25}};
  Document<AxisItem> file;
  file.items.push_back(item);
  return file;
}

TEST_F(CurvedIo, NativeArcsWithoutLoss) {
  Document<AxisItem> file = lens();
  file.y_down = true;
  ASSERT_TRUE(write_axes(path("a.json"), "", file).ok());
  const Result<Document<AxisItem>> again = read_native(path("a.json"));
  ASSERT_TRUE(again.ok()) << to_string(again.error());
  EXPECT_TRUE(again->y_down);
  const AxisItem& item = again->items[0];
  EXPECT_EQ(item.shape.bulges, file.items[0].shape.bulges);
  ASSERT_EQ(item.axis.sites.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(item.axis.sites[i].bulge, file.items[0].axis.sites[i].bulge);
    EXPECT_EQ(item.axis.sites[i].kind(), SiteKind::arc);
    EXPECT_EQ(item.axis.sites[i].end, file.items[0].axis.sites[i].end);
  }
  ASSERT_TRUE(write_axes(path("b.json"), "", *again).ok());
  EXPECT_EQ(content("a.json"), content("b.json"));
  EXPECT_NE(content("a.json").find("[2,0]"), std::string::npos);  // an arc by its vertex
  EXPECT_EQ(content("a.json").find("\"medial\":2"), 1U);
  const Document<Feature> data = read("c.json", content("a.json"));
  EXPECT_EQ(data.items[0].rings[0].bulges, file.items[0].shape.bulges);
  EXPECT_TRUE(data.y_down);
}

// --- drawings and pictures -----------------------------------------------------------------------

/// The values of a group code in an entity, in order.
std::vector<double> values(const std::string& drawing, const std::string& entity, int code) {
  std::istringstream lines(drawing);
  std::vector<double> result;
  std::string name;
  for (std::string group, value; std::getline(lines, group) && std::getline(lines, value);) {
    if (std::stoi(group) == 0) name = value;
    if (name == entity && std::stoi(group) == code) result.push_back(std::stod(value));
  }
  return result;
}

TEST_F(CurvedDxf, DrawingsHoldExactEdges) {
  Document<AxisItem> file = lens();
  ASSERT_TRUE(write_axes(path("a.dxf"), "", file).ok());
  const std::string flat = content("a.dxf");
  EXPECT_EQ(values(flat, "SPLINE", 10), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(values(flat, "SPLINE", 30), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(values(flat, "SPLINE", 41), (std::vector<double>{1, 1.25, 1}));
  WriteOptions options;
  options.radius_as_z = true;
  ASSERT_TRUE(write_axes(path("b.dxf"), "", file, options).ok());
  EXPECT_EQ(values(content("b.dxf"), "SPLINE", 30), (std::vector<double>{0, 0.7, 0}));

  for (Site& site : file.items[0].axis.sites) site.bulge = 0;
  ASSERT_TRUE(write_axes(path("c.dxf"), "", file).ok());
  EXPECT_EQ(values(content("c.dxf"), "LWPOLYLINE", 10), (std::vector<double>{0, 2}));
  EXPECT_TRUE(content("c.dxf").ends_with("0\nEOF\n"));
  file.items[0].axis.edges[0].control.center.x = std::nan("");
  EXPECT_EQ(write_axes(path("d.dxf"), "", file, options).error().code, ErrorCode::internal);
  EXPECT_FALSE(fs::exists(path("d.dxf")));
}

TEST_F(CurvedIo, PicturesOfArcs) {
  Document<AxisItem> file = lens();
  ASSERT_TRUE(write_axes(path("a.svg"), "", file).ok());
  const std::string arcs = content("a.svg");
  EXPECT_NE(arcs.find(" C "), std::string::npos);
  // A shape whose y axis points down, and its mirror image, whose does not, look alike.
  Document<AxisItem> mirrored = lens();
  AxisItem& item = mirrored.items[0];
  for (Vec2& p : item.shape.points) p.y = -p.y;
  for (double& bulge : item.shape.bulges) bulge = -bulge;
  file.y_down = true;
  ASSERT_TRUE(write_axes(path("b.svg"), "", file).ok());
  ASSERT_TRUE(write_axes(path("c.svg"), "", mirrored).ok());
  const auto without_id = [](const std::string& svg) {  // Cairo counts its surfaces
    return svg.substr(0, svg.find("<g id=")) + svg.substr(svg.find("<rect"));
  };
  EXPECT_EQ(without_id(content("b.svg")), without_id(content("c.svg")));
}

TEST_F(CurvedIo, PicturesAreReadBackAsCircles) {
  // A disk's outline in a vector picture stays within 1e-6 of the circle.
  Document<AxisItem> file = lens();
  file.items[0].shape.points = {{-1, 0}, {0, -1}, {1, 0}, {0, 1}};
  file.items[0].shape.bulges.assign(4, std::tan(std::numbers::pi / 8));
  file.items[0].shape.sources.resize(4);
  file.items[0].shape.loop_begin = {0, 4};
  file.items[0].axis = {};
  file.items[0].axis.nodes = {{{{0, 0}, 1}, 0, NodeKind::leaf}};
  WriteOptions options;
  options.width = 1000;
  ASSERT_TRUE(write_axes(path("a.svg"), "", file, options).ok());
  const Result<Document<Feature>> picture = read_document(path("a.svg"));
  ASSERT_TRUE(picture.ok()) << to_string(picture.error());
  const Contour* outline = nullptr;
  for (const Feature& feature : picture->items) {
    for (const Contour& contour : feature.contours) {
      if (contour.pieces.size() >= 16) outline = &contour;
    }
  }
  ASSERT_NE(outline, nullptr);
  for (const CurvePiece& piece : outline->pieces) {
    if (piece.degree != 3) continue;
    const auto p = [&](std::uint32_t i) { return outline->points[piece.first + i]; };
    for (double t = 0; t <= 1; t += 0.125) {
      const double s = 1 - t;
      const Vec2 at =
          s * s * s * p(0) + 3 * s * s * t * p(1) + 3 * s * t * t * p(2) + t * t * t * p(3);
      // The picture is 1,000 points wide, of 25.4 / 72 mm each; Cairo writes coordinates rounded to
      // some millionths.
      EXPECT_NEAR(distance(72 / 25.4 * at, {500, 500}), 470, 2e-3);
    }
  }
}

// --- whatever the bytes are ----------------------------------------------------------------------

TEST_F(CurvedIo, DamagedFilesAreReadOrRefused) {
  const std::map<std::string, std::string> files{
      {"a.svg",
       "<?xml version='1.0'?><!DOCTYPE svg [<!ENTITY w '3'>]><svg viewBox='0 0 9 9' "
       "xmlns='http://www.w3.org/2000/svg'><style>.a{fill:red}</style><g transform='rotate(3 1 2)'>"
       "<path id='p' d='M0 0L4,0A2 2 1 1 0 4 4C1 2 3 4 5 6q1 1 2 2z'/><rect width='&w;' "
       "height='50%' rx='1'/></g><use href='#p' x='1'/></svg>"},
      {"a.dxf",
       dxf("0 LWPOLYLINE\n8 C\n90 2\n70 1\n10 0\n20 0\n42 1\n10 2\n20 0\n42 1\n0 SPLINE\n8 E\n70 "
           "1\n71 2\n72 6\n73 3\n74 0\n40 0\n40 0\n40 0\n40 1\n40 1\n40 1\n10 0\n20 0\n10 4\n20 "
           "0\n10 0\n20 0\n0 INSERT\n8 A\n2 B\n10 1\n20 0\n41 2\n50 9\n70 2\n71 3\n44 5\n",
           "0 BLOCK\n8 0\n2 B\n10 1\n20 0\n0 CIRCLE\n8 0\n10 1\n20 0\n40 1\n0 ENDBLK\n8 0\n")},
      {"a.json",
       R"({"medial":2,"items":[{"contours":[{"role":"any","start":[0,0],"pieces":[["line",4,0],
          ["arc",4,4,1],["rational",0,4,0.5,0,3,1]]}]}]})"},
      {"a.wkt", "CURVEPOLYGON(COMPOUNDCURVE((0 0,4 0),CIRCULARSTRING(4 0,5 1,4 2),(4 2,0 0)))"}};
  std::mt19937_64 random(3);
  std::size_t read = 0;
  std::size_t refusals = 0;
  for (const auto& [name, original] : files) {
    for (int round = 0; round < 400; ++round) {
      std::string text = original;
      const auto changes = 1 + random() % 4;
      for (std::uint64_t i = 0; i < changes && !text.empty(); ++i) {
        const std::size_t at = random() % text.size();
        switch (random() % 4) {
          case 0:
            text[at] = static_cast<char>(random());
            break;
          case 1:
            text.erase(at, 1 + random() % 8);
            break;
          case 2:
            text.insert(at, std::to_string(random() % 1'000'000));
            break;
          default:
            text.resize(random() % 8 == 0 ? at : text.size());
        }
      }
      const Result<Document<Feature>> data = read_document(write(name, text));
      ++(data ? read : refusals);
      if (data) continue;
      EXPECT_NE(data.error().code, ErrorCode::internal) << to_string(data.error());
    }
  }
  EXPECT_GT(read, 50U);
  EXPECT_GT(refusals, 50U);
}

}  // namespace
}  // namespace medial::io
