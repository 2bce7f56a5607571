// Curved inputs and outputs: SVG, DXF, fonts, curve geometries, medial's own contours and arcs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
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
#include "support/curve_check.h"
#include "support/scratch_folder.h"

namespace medial::io {
namespace {

namespace fs = std::filesystem;

class CurvedIo : public test::ScratchFolder {
 protected:
  Dataset read(const std::string& name, const std::string& text,
               const ReadOptions& options = {}) const {
    Result<Dataset> data = read_dataset(write(name, text), options);
    EXPECT_TRUE(data.ok()) << to_string(data.error());
    return data ? *data : Dataset{};
  }
  Dataset svg(const std::string& body, const std::string& attributes = "") const {
    return read("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' " + attributes + ">\n" + body +
                             "\n</svg>");
  }
  Error refused(const std::string& name, const std::string& text,
                const ReadOptions& options = {}) const {
    const Result<Dataset> data = read_dataset(write(name, text), options);
    EXPECT_FALSE(data.ok()) << text.substr(0, 200);
    if (data) return {};
    EXPECT_EQ(data.error().place.file, path(name));
    return data.error();
  }
};

/// What needs DXF: skipped where medial::io is built without.
class CurvedDxf : public CurvedIo {
 protected:
  void SetUp() override {
    CurvedIo::SetUp();
    const Result<Dataset> data = read_dataset(write("empty.dxf", ""));
    if (!data && to_string(data.error()).find("without DXF") != std::string::npos)
      GTEST_SKIP() << "built without DXF";
  }
};

struct Counts {
  std::size_t contours = 0, lines = 0, arcs = 0, quadratics = 0, cubics = 0, rationals = 0;
  bool operator==(const Counts&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << c.contours << " contours, " << c.lines << " lines, " << c.arcs << " arcs, "
             << c.quadratics << " quadratics, " << c.cubics << " cubics, " << c.rationals
             << " rationals";
}

Counts count(const Dataset& data) {
  Counts counts;
  for (const Feature& feature : data.features) {
    for (const Contour& contour : feature.contours) {
      ++counts.contours;
      for (const CurvePiece& piece : contour.pieces) {
        if (piece.degree == 1) {
          ++(piece.bulge == 0 ? counts.lines : counts.arcs);
        } else if (piece.degree == 3) {
          ++counts.cubics;
        } else {
          ++(contour.weights.empty() ? counts.quadratics : counts.rationals);
        }
      }
    }
  }
  return counts;
}

void expect_near(Vec2 a, Vec2 b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

/// Points of a circle: pieces are arcs of that circle, turning left or right throughout.
void expect_circle(const Contour& contour, Vec2 center, double radius, bool left) {
  double turn = 0;
  for (const CurvePiece& piece : contour.pieces) {
    ASSERT_EQ(piece.degree, 1U);
    const Vec2 a = contour.points[piece.first];
    const Vec2 b = contour.points[piece.first + 1];
    EXPECT_NEAR(distance(a, center), radius, 1e-12 * radius);
    const Vec2 apex = midpoint(a, b) - 0.5 * piece.bulge * left_of(b - a);
    EXPECT_NEAR(distance(apex, center), radius, 1e-12 * radius);
    turn += 4 * std::atan(piece.bulge);
  }
  EXPECT_NEAR(turn, (left ? 2 : -2) * std::numbers::pi, 1e-12);
  EXPECT_EQ(contour.points.front(), contour.points.back());
}

// --- SVG -----------------------------------------------------------------------------------------

TEST_F(CurvedIo, SvgReadsEveryPathCommand) {
  const Dataset data = svg(
      "<path id='p' d='M0 0 L10 0 l10 0 H30 h10 V10 v10 C40 30 30 40 20 40 c-5 0 -5 0 -10 -5"
      " S5 30 5 25 s-1 -1 -2 -2 Q2 20 2 18 q0 -2 -1 -4 T1 10 t-1 -2 A4 4 0 0 1 0 4 a2 2 0 0 0 0 -2"
      " z m50 50 1 0 0 1z'/>");
  ASSERT_EQ(data.features.size(), 1U);
  EXPECT_EQ(count(data), (Counts{2, 6 + 2, 2, 4, 4, 0}));
  EXPECT_EQ(data.features[0].attributes,
            (std::vector<std::pair<std::string, std::string>>{{"id", "p"}}));
  EXPECT_TRUE(data.y_down);
  const Contour& contour = data.features[0].contours[0];
  EXPECT_EQ(contour.role, RingRole::winding);
  const std::vector<Vec2> ends{{10, 0},  {20, 0},  {30, 0}, {40, 0}, {40, 10}, {40, 20},
                               {20, 40}, {10, 35}, {5, 25}, {3, 23}, {2, 18},  {1, 14},
                               {1, 10},  {0, 8},   {0, 4},  {0, 2}};
  ASSERT_EQ(contour.pieces.size(), ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    expect_near(contour.points[contour.pieces[i].first + contour.pieces[i].degree], ends[i]);
  }
  // S mirrors the control point before it: (15, 40) about (10, 35).
  expect_near(contour.points[contour.pieces[8].first + 1], {5, 30});
  // T mirrors, too: (2, 16) about (1, 14).
  expect_near(contour.points[contour.pieces[12].first + 1], {0, 12});
  // A relative move after z counts from the start of the subpath.
  expect_near(data.features[0].contours[1].points[0], {50, 50});
}

TEST_F(CurvedIo, SvgReadsBasicShapes) {
  const Dataset data =
      svg("<rect x='1' y='2' width='10' height='5'/><rect width='8' height='4' rx='1'/>"
          "<circle cx='5' cy='6' r='2'/><ellipse cx='1' cy='1' rx='4' ry='2'/>"
          "<polygon points='0,0 4,0 4,3'/><polyline points='0,0 4,0 4,3'/>"
          "<line x1='0' y1='0' x2='1' y2='1'/><path d=''/><circle r='0'/>");
  ASSERT_EQ(data.features.size(), 6U);
  EXPECT_EQ(data.features[0].contours[0].points.front(), (Vec2{1, 2}));
  for (const CurvePiece& piece : data.features[1].contours[0].pieces) {
    if (piece.bulge == 0) continue;
    EXPECT_NEAR(piece.bulge, std::tan(std::numbers::pi / 8), 1e-15);
  }
  expect_circle(data.features[2].contours[0], {5, 6}, 2, true);
  const Contour& ellipse = data.features[3].contours[0];
  ASSERT_EQ(ellipse.weights.size(), ellipse.points.size());
  EXPECT_EQ(ellipse.points.front(), ellipse.points.back());
  EXPECT_EQ(data.features[5].contours[0].pieces.size(), 2U);  // closed by definition
}

TEST_F(CurvedIo, SvgArcsAreExact) {
  // Large and small, both ways round; radii too small are enlarged; zero radii are a line.
  const Dataset data =
      svg("<path d='M0 0A5 5 0 1 1 6 8Z'/><path d='M0 0A5 5 0 0 0 6 8Z'/>"
          "<path d='M0 0A1 1 0 0 1 6 8Z'/><path d='M0 0A0 1 0 0 1 6 8L9 0Z'/>"
          "<path d='M0 0A6 3 30 1 0 5 5Z'/>");
  ASSERT_EQ(data.features.size(), 5U);
  for (int i = 0; i < 3; ++i) {
    for (const CurvePiece& piece : data.features[static_cast<std::size_t>(i)].contours[0].pieces) {
      EXPECT_NEAR(std::fabs(piece.bulge), 1, 1e-15);  // the chord is a diameter
      EXPECT_EQ(piece.bulge > 0, i != 1);
    }
  }
  EXPECT_EQ(data.features[3].contours[0].pieces[0].bulge, 0);
  EXPECT_FALSE(data.features[4].contours[0].weights.empty());
}

TEST_F(CurvedIo, SvgTransformsViewBoxAndUse) {
  const Dataset data =
      svg("<defs><g id='d'><circle id='c' cx='1' cy='1' r='1'/></g>"
          "<symbol id='s' viewBox='0 0 2 2'><circle cx='1' cy='1' r='1'/></symbol></defs>"
          "<use href='#d' x='12' y='2'/>"
          "<use xmlns:xlink='http://www.w3.org/1999/xlink' xlink:href='#c' transform='rotate(90)'/>"
          "<g transform='translate(3 4)'><circle transform='scale(2 -2)' r='1'/></g>"
          "<circle transform='scale(2 1)' r='1'/>"
          "<use href='#s' x='4' y='4' width='6' height='6'/>"
          "<svg x='1' y='1' width='4' height='4' viewBox='0 0 8 8'><circle r='2'/></svg>"
          "<use href='#nowhere'/>",
          "width='200' height='100' viewBox='0 0 20 10'");
  ASSERT_EQ(data.features.size(), 6U);
  expect_circle(data.features[0].contours[0], {130, 30}, 10, true);
  expect_circle(data.features[1].contours[0], {-10, 10}, 10, true);
  expect_circle(data.features[2].contours[0], {30, 40}, 20, false);
  EXPECT_FALSE(data.features[3].contours[0].weights.empty());  // an ellipse now
  expect_circle(data.features[4].contours[0], {70, 70}, 30, true);
  expect_circle(data.features[5].contours[0], {10, 10}, 10, true);
}

TEST_F(CurvedIo, SvgStyleSheets) {
  const Dataset data = svg(
      "<style type='text/css'><![CDATA[ /* a } */ @import url('x;y.css'); @media print "
      "{.a{fill:red}}"
      " .hole, .other { fill-rule: evenodd; stroke: 'a;b' }"
      " .none{fill:none} rect.none.shown{fill:blue} #i5 {fill:none}"
      " g > .child {display:none} g.far rect {visibility:hidden}"
      " .strong{fill:none!important} .weak{fill:none} rect:hover{fill:none} [x]{stroke:red} ]]>"
      "</style><style type='text/less'>rect{fill:none}</style>"
      "<style media='print'>rect{fill:none}</style>"
      "<rect class='hole' width='1' height='1'/><rect class='none' width='2' height='2'/>"
      "<rect class='none shown' width='3' height='3'/><rect class='nonesuch' width='4' height='4'/>"
      "<rect id='i5' width='5' height='5' fill='red'/>"
      "<g class='far'><g><rect width='6' height='6'/></g></g>"
      "<g><rect class='child' width='7' height='7'/><a><rect class='child' width='8' "
      "height='8'/></a>"
      "</g><rect class='strong' style='fill:red' width='9' height='9'/>"
      "<rect class='weak' style='fill:red' width='10' height='10'/>"
      "<defs><rect id='d' class='other' width='11' height='11'/></defs><use href='#d'/>"
      "<rect style='display:none' width='12' height='12'/>");
  std::vector<double> widths;
  for (const Feature& feature : data.features) widths.push_back(feature.contours[0].points[1].x);
  EXPECT_EQ(widths, (std::vector<double>{1, 3, 4, 8, 10, 11}));
  EXPECT_EQ(data.features[0].contours[0].role, RingRole::any);
  EXPECT_EQ(data.features[5].contours[0].role, RingRole::any);
  ASSERT_EQ(data.notes.size(), 2U);
  EXPECT_NE(data.notes[1].find("1 selectors"), std::string::npos) << data.notes[1];
}

TEST_F(CurvedIo, SvgStyleSheetsEnd) {
  for (const char* sheet :
       {"rect{", "}rect{fill:none}", "rect{fill:none", "/* rect{", "{", "a > ", "\\"})
    svg(std::string("<style>") + sheet + "</style><rect width='1' height='1'/><circle r='1'/>");
  std::string text = "<svg><style>";
  for (int i = 0; i < 40; ++i) text += "g ";
  text += "b rect{fill:none}</style>";
  for (int i = 0; i < 300; ++i) text += "<g>";
  text += "<rect width='1' height='1'/>";
  for (int i = 0; i < 300; ++i) text += "</g>";
  read("deep.svg", text + "</svg>");  // no g is in a b, which the nearest b tells
  std::string hard = text;
  hard.replace(hard.find("g g "), 4, "b g ");
  hard.replace(hard.find(" b rect"), 7, " rect");
  EXPECT_EQ(refused("hard.svg", hard + "</svg>").code, ErrorCode::too_large);
}

TEST_F(CurvedIo, SvgSizesThatAViewBoxTells) {
  const std::string circle = "<circle cx='4' cy='3' r='2'/>";
  expect_circle(svg(circle, "viewBox='0 0 24 12'").features[0].contours[0], {4, 3}, 2, true);
  expect_circle(svg(circle, "viewBox='2 1 24 12' width='100%'").features[0].contours[0], {2, 2}, 2,
                true);
  expect_circle(svg(circle, "viewBox='0 0 24 12' width='48'").features[0].contours[0], {8, 6}, 4,
                true);
  expect_circle(svg(circle, "viewBox='0 0 24 12' height='1in'").features[0].contours[0], {32, 24},
                16, true);
  expect_circle(svg(circle).features[0].contours[0], {4, 3}, 2, true);
}

TEST_F(CurvedIo, SvgFillRulesAndWhatIsPainted) {
  const Dataset data = svg(
      "<g fill='none'><rect width='1' height='1'/><rect width='2' height='2' fill='red'/></g>"
      "<g fill-rule='evenodd'><rect width='3' height='3'/>"
      "<rect width='4' height='4' style='fill-rule:nonzero;fill:url(#g)'/></g>"
      "<rect width='5' height='5' style='fill:none'/><g display='none'><rect width='6' height='6'/>"
      "</g><g visibility='hidden'><rect width='7' height='7'/>"
      "<rect width='8' height='8' visibility='visible'/></g>"
      "<clipPath><rect width='9' height='9'/></clipPath><mask><rect width='9' height='9'/></mask>"
      "<defs><rect width='9' height='9'/></defs><symbol><rect width='9' height='9'/></symbol>"
      "<text>no</text><unheard-of/><rect width='10' height='10' style='fill:oddity(3)'/>");
  std::vector<double> widths;
  std::vector<RingRole> roles;
  for (const Feature& feature : data.features) {
    widths.push_back(feature.contours[0].points[1].x);
    roles.push_back(feature.contours[0].role);
  }
  EXPECT_EQ(widths, (std::vector<double>{2, 3, 4, 8, 10}));
  EXPECT_EQ(roles, (std::vector<RingRole>{RingRole::winding, RingRole::any, RingRole::winding,
                                          RingRole::winding, RingRole::winding}));
  ASSERT_EQ(data.notes.size(), 1U);
  EXPECT_NE(data.notes[0].find("2 shapes are not filled"), std::string::npos);
}

TEST_F(CurvedIo, SvgWithoutNamespaceAndCompressedNames) {
  EXPECT_EQ(read("a.svg", "<svg><rect width='1' height='1'/></svg>").features.size(), 1U);
  EXPECT_EQ(read("a.svgz", "<svg><rect width='1' height='1'/></svg>").features.size(), 1U);
}

TEST_F(CurvedIo, SvgRefusesWhatIsBroken) {
  const auto code = [this](const std::string& text) { return refused("bad.svg", text).code; };
  EXPECT_EQ(code(""), ErrorCode::malformed);
  EXPECT_EQ(code("<svg><rect width='1'"), ErrorCode::malformed);
  EXPECT_EQ(code("<html/>"), ErrorCode::malformed);
  EXPECT_EQ(code("<svg/>"), ErrorCode::empty);
  EXPECT_EQ(code("<svg><rect width='1' height='1' fill='none'/></svg>"), ErrorCode::empty);
  EXPECT_EQ(code("<svg><path d='M0 0 X 1 2'/></svg>"), ErrorCode::malformed);
  EXPECT_EQ(code("<svg><path d='M nan 0 L1 1 L0 1'/></svg>"), ErrorCode::malformed);
  EXPECT_EQ(code("<svg><path d='M1e999 0L1 1L0 1Z'/></svg>"), ErrorCode::malformed);
  EXPECT_EQ(code("<svg><path d='M1e300 0L1 1L0 1Z' transform='scale(1e300)'/></svg>"),
            ErrorCode::not_finite);
  EXPECT_EQ(code("<svg><circle r='-1'/></svg>"), ErrorCode::malformed);
  EXPECT_EQ(code("<svg><circle r='one'/></svg>"), ErrorCode::malformed);
  EXPECT_EQ(code("<svg><g id='a'><use href='#a'/></g></svg>"), ErrorCode::unsupported);
  const Error error = refused("bad.svg", "<svg>\n<g>\n<path d='M0 0 X'/></g></svg>");
  EXPECT_EQ(error.place.line, 3U);
}

TEST_F(CurvedIo, SvgBombsAreBounded) {
  std::string lol = "<!DOCTYPE svg [<!ENTITY a0 'aaaaaaaaaa'>";
  for (int i = 1; i < 12; ++i) {
    lol += "<!ENTITY a" + std::to_string(i) + " '";
    for (int k = 0; k < 10; ++k) lol += "&a" + std::to_string(i - 1) + ";";
    lol += "'>";
  }
  EXPECT_EQ(refused("bomb.svg", lol + "]><svg><title>&a11;</title></svg>").code,
            ErrorCode::malformed);
  std::string doubled = "<svg><defs><rect id='u0' width='1' height='1'/>";
  for (int i = 1; i <= 30; ++i) {
    const std::string before = std::to_string(i - 1);
    doubled += "<g id='u" + std::to_string(i) + "'><use href='#u" + before + "'/><use href='#u" +
               before + "'/></g>";
  }
  EXPECT_EQ(refused("bomb.svg", doubled + "</defs><use href='#u30'/></svg>").code,
            ErrorCode::too_large);
  std::string deep = "<svg>";
  for (int i = 0; i < 100'000; ++i) deep += "<g>";
  // Stopped long before the file's end: a small compressed file may open very many elements.
  const std::string deep_text = refused("deep.svg", deep).text;
  EXPECT_NE(deep_text.find("deep"), std::string::npos) << deep_text;
  for (int i = 0; i < 100'000; ++i) deep += "</g>";
  EXPECT_NE(refused("deep.svg", deep + "</svg>").code, ErrorCode::internal);
  // Entities of the usual kind work; files are not read.
  EXPECT_EQ(
      read("ok.svg", "<!DOCTYPE svg [<!ENTITY w '3'>]><svg><rect width='&w;' height='1'/></svg>")
          .features[0]
          .contours[0]
          .points[1],
      (Vec2{3, 0}));
  write("secret.txt", "3");
  refused("file.svg", "<!DOCTYPE svg [<!ENTITY w SYSTEM '" + path("secret.txt") +
                          "'>]><svg><rect width='&w;' height='1'/></svg>");
}

TEST_F(CurvedIo, SvgOfTheDataFolderCountsAsListed) {
  const fs::path folder = fs::path(MEDIAL_SOURCE_DIR) / "../shared/data/packaged/B_svg";
  if (!fs::exists(folder / "LIST.tsv")) GTEST_SKIP() << folder << " is not here";
  // A subpath of one point, which encloses nothing, and shapes without fill.
  const std::map<std::string, int> fewer{{"mdi/cloud-check-variant-outline.svg", 1}};
  std::ifstream list(folder / "LIST.tsv");
  std::string line;
  std::getline(list, line);
  std::size_t files = 0;
  while (std::getline(list, line)) {
    std::istringstream fields(line);
    std::string name;
    std::size_t paths = 0, subpaths = 0, lines = 0, arcs = 0, cubics = 0, quadratics = 0;
    fields >> name >> paths >> subpaths >> lines >> arcs >> cubics >> quadratics;
    const Result<Dataset> data = read_dataset((folder / name).string());
    ASSERT_TRUE(data.ok()) << to_string(data.error());
    ++files;
    if (!data->notes.empty()) continue;  // something is not filled
    const Counts counts = count(*data);
    EXPECT_EQ(data->features.size(), paths) << name;
    EXPECT_EQ(counts.cubics, cubics) << name;
    EXPECT_EQ(counts.quadratics, quadratics) << name;
    EXPECT_GE(counts.arcs + counts.rationals, arcs) << name;  // over half a turn makes two
    // The list counts points after the first of an `m` as subpaths; they are lines.
    const std::size_t gone = fewer.contains(name) ? 1 : 0;
    EXPECT_EQ(counts.contours + counts.lines + gone, subpaths + lines) << name;
  }
  EXPECT_EQ(files, 145U);
}

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
  const Dataset data =
      read("a.dxf", dxf(dxf_line(0, 0, 4, 0) + "0 ARC\n8 A\n10 0\n20 1\n40 1\n50 90\n51 270\n" +
                        dxf_line(0, 2, 4, 2) + "0 ARC\n8 A\n10 4\n20 1\n40 1\n50 270\n51 90\n"));
  ASSERT_EQ(data.features.size(), 1U);
  EXPECT_EQ(data.features[0].attributes[0], (std::pair<std::string, std::string>{"layer", "A"}));
  EXPECT_FALSE(data.y_down);
  EXPECT_EQ(count(data), (Counts{1, 2, 2, 0, 0, 0}));
  const Contour& loop = data.features[0].contours[0];
  EXPECT_EQ(loop.points.front(), loop.points.back());
  double turn = 0;
  for (const CurvePiece& piece : loop.pieces) turn += 4 * std::atan(piece.bulge);
  EXPECT_NEAR(std::fabs(turn), 2 * std::numbers::pi, 1e-14);
}

TEST_F(CurvedDxf, ReadsClosedEntities) {
  const Dataset data = read(
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
  ASSERT_EQ(data.features.size(), 5U);
  expect_circle(data.features[0].contours[0], {1, 2}, 3, true);
  EXPECT_EQ(data.features[1].contours[0].points.front(),
            data.features[1].contours[0].points.back());
  expect_circle(data.features[2].contours[0], {1, 0}, 1, true);
  EXPECT_EQ(data.features[3].contours[0].pieces[1].bulge, 0.5);
  EXPECT_EQ(data.features[3].contours[0].pieces.size(), 3U);
  const Contour& spline = data.features[4].contours[0];
  EXPECT_EQ(spline.pieces.size(), 3U);  // one a knot interval
  EXPECT_EQ(spline.pieces[0].degree, 2U);
  ASSERT_EQ(data.notes.size(), 1U);
  EXPECT_NE(data.notes[0].find("1 HATCH, 1 TEXT"), std::string::npos);
}

TEST_F(CurvedDxf, BlocksAndMirrors) {
  const std::string block =
      "0 BLOCK\n8 0\n2 B\n70 0\n10 1\n20 0\n0 CIRCLE\n8 0\n10 1\n20 0\n40 1\n0 ENDBLK\n8 0\n";
  const Dataset data = read(
      "a.dxf", dxf("0 INSERT\n8 A\n2 B\n10 10\n20 0\n41 2\n42 2\n50 90\n70 2\n71 1\n44 5\n45 0\n"
                   "0 INSERT\n8 B\n2 B\n10 0\n20 0\n41 2\n42 1\n"
                   "0 CIRCLE\n8 C\n10 5\n20 0\n40 1\n210 0\n220 0\n230 -1\n"
                   "0 INSERT\n8 D\n2 missing\n10 0\n20 0\n",
                   block));
  ASSERT_EQ(data.features.size(), 3U);
  // What stands in the drawing itself comes before what is inserted.
  expect_circle(data.features[0].contours[0], {-5, 0}, 1, false);
  ASSERT_EQ(data.features[1].contours.size(), 2U);
  expect_circle(data.features[1].contours[0], {10, 0}, 2, true);
  expect_circle(data.features[1].contours[1], {10, 5}, 2, true);
  EXPECT_FALSE(data.features[2].contours[0].weights.empty());  // stretched to an ellipse
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
  const Dataset closed = read("a.dxf", dxf(open), options);
  EXPECT_EQ(count(closed), (Counts{1, 3, 0, 0, 0, 0}));
  EXPECT_FALSE(closed.features[0].contours[0].points.front() ==
               closed.features[0].contours[0].points.back());
  // Dangling lines do not spoil the loop that they touch.
  const Dataset dangling = read("a.dxf", dxf(dxf_line(0, 0, -1, -1) + dxf_line(0, 0, 4, 0) +
                                             dxf_line(4, 0, 4, 3) + dxf_line(4, 3, 0, 0)));
  EXPECT_EQ(count(dangling), (Counts{1, 3, 0, 0, 0, 0}));
  EXPECT_NE(dangling.notes[0].find("1 curves stay open"), std::string::npos);
  // Two triangles with a common corner.
  const Dataset touching =
      read("a.dxf", dxf(dxf_line(0, 0, 4, 0) + dxf_line(4, 0, 4, 3) + dxf_line(4, 3, 0, 0) +
                        dxf_line(0, 0, -4, 0) + dxf_line(-4, 0, -4, -3) + dxf_line(-4, -3, 0, 0)));
  EXPECT_EQ(count(touching).lines, 6U);
  EXPECT_TRUE(touching.notes.empty());
}

TEST_F(CurvedDxf, Layers) {
  const std::string two = "0 CIRCLE\n8 A\n10 0\n20 0\n40 1\n0 CIRCLE\n8 B\n10 9\n20 0\n40 2\n";
  EXPECT_EQ(read("a.dxf", dxf(two)).features.size(), 2U);
  ReadOptions options;
  options.layer = "B";
  const Dataset one = read("a.dxf", dxf(two), options);
  ASSERT_EQ(one.features.size(), 1U);
  expect_circle(one.features[0].contours[0], {9, 0}, 2, true);
  options.layer = "C";
  EXPECT_EQ(refused("a.dxf", dxf(two), options).code, ErrorCode::invalid_option);
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
  const fs::path data = fs::path(MEDIAL_SOURCE_DIR) / "../shared/data";
  if (!fs::exists(data)) GTEST_SKIP() << data << " is not here";
  // Drawings of open curves or of polygons in tilted planes: there is nothing with an inside.
  const std::vector<std::string> nothing{"librecad_honeycomb.dxf", "dxfparser_splines.dxf",
                                         "ezdxf_POLI-ALL210_12.DXF"};
  std::size_t files = 0;
  for (const char* folder : {"packaged/B_dxf", "in_place/B_dxf"}) {
    if (!fs::exists(data / folder)) continue;
    for (const auto& entry : fs::directory_iterator(data / folder)) {
      const std::string name = entry.path().filename().string();
      const Result<Dataset> drawing = read_dataset(entry.path().string());
      ++files;
      if (std::ranges::find(nothing, name) != nothing.end()) {
        ASSERT_FALSE(drawing.ok()) << name;
        EXPECT_EQ(drawing.error().code, ErrorCode::empty) << name;
      } else {
        EXPECT_TRUE(drawing.ok()) << to_string(drawing.error());
      }
    }
  }
  EXPECT_GE(files, 13U);
}

// --- fonts ---------------------------------------------------------------------------------------

TEST_F(CurvedIo, FontOutlines) {
  const std::string font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  if (!fs::exists(font)) GTEST_SKIP() << font << " is not here";
  const Result<Dataset> data = read_text("i \xC3\xA4V", font);
  ASSERT_TRUE(data.ok()) << to_string(data.error());
  ASSERT_EQ(data->features.size(), 3U);
  EXPECT_EQ(data->features[0].contours.size(), 2U);  // the dot
  EXPECT_EQ(data->features[1].contours.size(), 4U);  // two dots, a bowl and its counter
  EXPECT_EQ(data->features[1].attributes[0].second, "\xC3\xA4");
  EXPECT_EQ(data->features[1].attributes[1].second, "2");
  EXPECT_EQ(data->features[0].contours[0].role, RingRole::winding);
  EXPECT_FALSE(data->y_down);
  // Advances place what follows to the right.
  const auto left = [](const Feature& feature) {
    double x = std::numeric_limits<double>::infinity();
    for (const Contour& contour : feature.contours) {
      for (const Vec2 p : contour.points) x = std::min(x, p.x);
    }
    return x;
  };
  EXPECT_GT(left(data->features[1]), left(data->features[0]) + 500);
  EXPECT_EQ(read_text("  ", font).error().code, ErrorCode::empty);
  EXPECT_EQ(read_text("\xFF", font).error().code, ErrorCode::malformed);
  EXPECT_EQ(read_text("a\n", font).error().code, ErrorCode::malformed);
  const Result<Dataset> missing = read_text("\xF0\x93\x80\x80", font);  // a hieroglyph
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
  const Dataset data =
      read("a.wkt",
           "CURVEPOLYGON(CIRCULARSTRING(0 0,1 1,2 0,1 -1,0 0),(0.5 0,1 0.2,1 0,0.5 0))\n"
           "MULTISURFACE(CURVEPOLYGON(COMPOUNDCURVE((0 0,4 0),CIRCULARSTRING(4 0,5 1,4 2),(4 2,0 "
           "2),CIRCULARSTRING(0 2,-1 1,0 0))),((9 0,10 0,10 1,9 0)))\n"
           "CURVEPOLYGON(CIRCULARSTRING(0 0,6 8,0 0))\n"
           "CURVEPOLYGON(CIRCULARSTRING(0 0,1 0,2 0,3 3,0 0))\n");
  ASSERT_EQ(data.features.size(), 4U);
  const Ring& circle = data.features[0].rings[0];
  ASSERT_EQ(circle.points.size(), 3U);
  ASSERT_EQ(circle.bulges.size(), 3U);
  EXPECT_DOUBLE_EQ(circle.bulges[0], -1);
  EXPECT_DOUBLE_EQ(circle.bulges[1], -1);
  EXPECT_EQ(data.features[0].rings[1].role, RingRole::hole);
  EXPECT_TRUE(data.features[0].rings[1].bulges.empty());
  const Ring& stadium = data.features[1].rings[0];
  ASSERT_EQ(stadium.points.size(), 5U);
  EXPECT_EQ(stadium.bulges[0], 0);
  EXPECT_DOUBLE_EQ(stadium.bulges[1], 1);
  EXPECT_EQ(stadium.bulges[2], 0);
  EXPECT_DOUBLE_EQ(stadium.bulges[3], 1);
  EXPECT_EQ(data.features[1].rings.size(), 2U);
  EXPECT_EQ(data.features[2].rings[0].bulges, (std::vector<double>{1, 1, 0}));
  EXPECT_EQ(data.features[2].rings[0].points[1], (Vec2{6, 8}));
  EXPECT_EQ(data.features[3].rings[0].bulges[0], 0);  // three points in a row
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
    const Dataset data = read("round.wkt", text.str(), options);
    ASSERT_EQ(data.features.size(), 2U);
    ASSERT_EQ(data.features[0].contours.size(), 1U);
    ASSERT_EQ(data.features[1].rings.size(), 1U);
    ArcReport report;
    const auto rings = approximate_by_arcs(data.features[0].contours, {.tolerance = 1e-9}, &report);
    ASSERT_TRUE(rings.ok());
    double furthest = 0;
    for (const Vec2 point : data.features[1].rings[0].points) {
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
  const Result<NativeFile> file = read_native(write("a.json", text));
  ASSERT_TRUE(file.ok()) << to_string(file.error());
  ASSERT_EQ(file->items.size(), 1U);
  const Contour& contour = file->items[0].contours[0];
  EXPECT_EQ(contour.role, RingRole::hole);
  EXPECT_EQ(contour.pieces.size(), 4U);
  EXPECT_EQ(contour.pieces[1].bulge, 1);
  EXPECT_EQ(contour.pieces[2].degree, 3U);
  EXPECT_EQ(contour.weights.back(), 1);
  EXPECT_EQ(contour.weights[contour.weights.size() - 2], 0.5);
  const Dataset data = read("a.json", text);
  EXPECT_EQ(data.features[0].contours.size(), 1U);
  const auto bad = [this](const std::string& contours) {
    const Result<NativeFile> broken =
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
NativeFile lens() {
  NativeItem item;
  item.shape.points = {{0, 0}, {2, 0}};
  item.shape.bulges = {0.3, 0.1 + 0.2};
  item.shape.sources = {{0, 0}, {0, 5}};
  item.shape.loop_begin = {0, 2};
  item.shape.component = {0};
  item.shape.hole = {false};
  item.axis.method = "disks";
  item.axis.sites = {{{0, 0}, {2, 0}, 0, 0, SiteKind::arc, 0.3},
                     {{2, 0}, {0, 0}, 0, 5, SiteKind::arc, 0.1 + 0.2},
                     {{2, 0}, {0.5, 0.25}, 0, 5, SiteKind::arc, 0.125}};
  item.axis.nodes = {{{{0, 0}, 0}, 0, NodeKind::leaf}, {{{2, 0}, 0}, 0, NodeKind::leaf}};
  item.axis.edges = {{{0, 1}, {0, 1}, {{1, 0}, 0.7}, 1.25}};
  NativeFile file;
  file.items.push_back(item);
  return file;
}

TEST_F(CurvedIo, NativeArcsWithoutLoss) {
  NativeFile file = lens();
  file.y_down = true;
  ASSERT_TRUE(write_axes(path("a.json"), "", file).ok());
  const Result<NativeFile> again = read_native(path("a.json"));
  ASSERT_TRUE(again.ok()) << to_string(again.error());
  EXPECT_TRUE(again->y_down);
  const NativeItem& item = again->items[0];
  EXPECT_EQ(item.shape.bulges, file.items[0].shape.bulges);
  ASSERT_EQ(item.axis.sites.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(item.axis.sites[i].bulge, file.items[0].axis.sites[i].bulge);
    EXPECT_EQ(item.axis.sites[i].kind, SiteKind::arc);
    EXPECT_EQ(item.axis.sites[i].end, file.items[0].axis.sites[i].end);
  }
  ASSERT_TRUE(write_axes(path("b.json"), "", *again).ok());
  EXPECT_EQ(content("a.json"), content("b.json"));
  EXPECT_NE(content("a.json").find("[2,0]"), std::string::npos);  // an arc told by its vertex
  EXPECT_EQ(content("a.json").find("\"medial\":2"), 1U);
  const Dataset data = read("c.json", content("a.json"));
  EXPECT_EQ(data.features[0].rings[0].bulges, file.items[0].shape.bulges);
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
  NativeFile file = lens();
  ASSERT_TRUE(write_axes(path("a.dxf"), "", file).ok());
  const std::string flat = content("a.dxf");
  EXPECT_EQ(values(flat, "SPLINE", 10), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(values(flat, "SPLINE", 30), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(values(flat, "SPLINE", 41), (std::vector<double>{1, 1.25, 1}));
  WriteOptions options;
  options.radius_as_z = true;
  ASSERT_TRUE(write_axes(path("b.dxf"), "", file, options).ok());
  EXPECT_EQ(values(content("b.dxf"), "SPLINE", 30), (std::vector<double>{0, 0.7, 0}));

  for (Site& site : file.items[0].axis.sites) site.kind = SiteKind::segment;
  ASSERT_TRUE(write_axes(path("c.dxf"), "", file).ok());
  EXPECT_EQ(values(content("c.dxf"), "LWPOLYLINE", 10), (std::vector<double>{0, 2}));
  EXPECT_TRUE(content("c.dxf").ends_with("0\nEOF\n"));
  file.items[0].axis.edges[0].control.center.x = std::nan("");
  EXPECT_EQ(write_axes(path("d.dxf"), "", file, options).error().code, ErrorCode::internal);
  EXPECT_FALSE(fs::exists(path("d.dxf")));
}

TEST_F(CurvedIo, PicturesOfArcs) {
  NativeFile file = lens();
  ASSERT_TRUE(write_axes(path("a.svg"), "", file).ok());
  const std::string arcs = content("a.svg");
  EXPECT_NE(arcs.find(" C "), std::string::npos);
  // A shape whose y axis points down, and its mirror image, whose does not, look alike.
  NativeFile mirrored = lens();
  NativeItem& item = mirrored.items[0];
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
  NativeFile file = lens();
  file.items[0].shape.points = {{-1, 0}, {0, -1}, {1, 0}, {0, 1}};
  file.items[0].shape.bulges.assign(4, std::tan(std::numbers::pi / 8));
  file.items[0].shape.sources.resize(4);
  file.items[0].shape.loop_begin = {0, 4};
  file.items[0].axis = {};
  file.items[0].axis.nodes = {{{{0, 0}, 1}, 0, NodeKind::leaf}};
  WriteOptions options;
  options.width = 1000;
  ASSERT_TRUE(write_axes(path("a.svg"), "", file, options).ok());
  const Result<Dataset> picture = read_dataset(path("a.svg"));
  ASSERT_TRUE(picture.ok()) << to_string(picture.error());
  const Contour* outline = nullptr;
  for (const Feature& feature : picture->features) {
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
      // The picture is 1,000 points wide, of 4/3 pixels each; Cairo writes coordinates rounded to
      // some millionths.
      EXPECT_NEAR(distance(0.75 * at, {500, 500}), 470, 2e-3);
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
      const Result<Dataset> data = read_dataset(write(name, text));
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
