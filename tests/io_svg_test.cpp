// Curved inputs: SVG.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "medial/compute.h"
#include "support/curved_io.h"
#include "support/random_shapes.h"

namespace medial::io {
namespace {

namespace fs = std::filesystem;

TEST_F(CurvedIo, SvgReadsEveryPathCommand) {
  const Document<Feature> data = svg(
      "<path id='p' d='M0 0 L10 0 l10 0 H30 h10 V10 v10 C40 30 30 40 20 40 c-5 0 -5 0 -10 -5"
      " S5 30 5 25 s-1 -1 -2 -2 Q2 20 2 18 q0 -2 -1 -4 T1 10 t-1 -2 A4 4 0 0 1 0 4 a2 2 0 0 0 0 -2"
      " z m50 50 1 0 0 1z'/>");
  ASSERT_EQ(data.items.size(), 1U);
  EXPECT_EQ(count(data), (Counts{2, 6 + 2, 2, 4, 4, 0}));
  EXPECT_EQ(data.items[0].attributes,
            (std::vector<std::pair<std::string, std::string>>{{"id", "p"}}));
  EXPECT_TRUE(data.y_down);
  const Contour& contour = data.items[0].contours[0];
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
  expect_near(data.items[0].contours[1].points[0], {50, 50});
}

TEST_F(CurvedIo, SvgReadsBasicShapes) {
  const Document<Feature> data =
      svg("<rect x='1' y='2' width='10' height='5'/><rect width='8' height='4' rx='1'/>"
          "<circle cx='5' cy='6' r='2'/><ellipse cx='1' cy='1' rx='4' ry='2'/>"
          "<polygon points='0,0 4,0 4,3'/><polyline points='0,0 4,0 4,3'/>"
          "<line x1='0' y1='0' x2='1' y2='1'/><path d=''/><circle r='0'/>");
  ASSERT_EQ(data.items.size(), 6U);
  EXPECT_EQ(data.items[0].contours[0].points.front(), (Vec2{1, 2}));
  for (const CurvePiece& piece : data.items[1].contours[0].pieces) {
    if (piece.bulge == 0) continue;
    EXPECT_NEAR(piece.bulge, std::tan(std::numbers::pi / 8), 1e-15);
  }
  expect_circle(data.items[2].contours[0], {5, 6}, 2, true);
  const Contour& ellipse = data.items[3].contours[0];
  ASSERT_EQ(ellipse.weights.size(), ellipse.points.size());
  EXPECT_EQ(ellipse.points.front(), ellipse.points.back());
  EXPECT_EQ(data.items[5].contours[0].pieces.size(), 2U);  // closed by definition
}

TEST_F(CurvedIo, SvgArcsAreExact) {
  // Large and small, both ways round; radii too small are enlarged; zero radii are a line.
  const Document<Feature> data =
      svg("<path d='M0 0A5 5 0 1 1 6 8Z'/><path d='M0 0A5 5 0 0 0 6 8Z'/>"
          "<path d='M0 0A1 1 0 0 1 6 8Z'/><path d='M0 0A0 1 0 0 1 6 8L9 0Z'/>"
          "<path d='M0 0A6 3 30 1 0 5 5Z'/>");
  ASSERT_EQ(data.items.size(), 5U);
  for (int i = 0; i < 3; ++i) {
    for (const CurvePiece& piece : data.items[static_cast<std::size_t>(i)].contours[0].pieces) {
      EXPECT_NEAR(std::fabs(piece.bulge), 1, 1e-15);  // the chord is a diameter
      EXPECT_EQ(piece.bulge > 0, i != 1);
    }
  }
  EXPECT_EQ(data.items[3].contours[0].pieces[0].bulge, 0);
  EXPECT_FALSE(data.items[4].contours[0].weights.empty());
}

TEST_F(CurvedIo, SvgTransformsViewBoxAndUse) {
  const Document<Feature> data =
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
  ASSERT_EQ(data.items.size(), 6U);
  expect_circle(data.items[0].contours[0], {130, 30}, 10, true);
  expect_circle(data.items[1].contours[0], {-10, 10}, 10, true);
  expect_circle(data.items[2].contours[0], {30, 40}, 20, false);
  EXPECT_FALSE(data.items[3].contours[0].weights.empty());  // an ellipse now
  expect_circle(data.items[4].contours[0], {70, 70}, 30, true);
  expect_circle(data.items[5].contours[0], {10, 10}, 10, true);
}

TEST_F(CurvedIo, SvgStyleSheets) {
  const Document<Feature> data = svg(
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
  for (const Feature& feature : data.items) widths.push_back(feature.contours[0].points[1].x);
  EXPECT_EQ(widths, (std::vector<double>{1, 3, 4, 8, 10, 11}));
  EXPECT_EQ(data.items[0].contours[0].role, RingRole::any);
  EXPECT_EQ(data.items[5].contours[0].role, RingRole::any);
  ASSERT_EQ(data.notes.size(), 2U);
  EXPECT_NE(data.notes[1].find("1 unsupported selector of a style sheet was ignored"),
            std::string::npos)
      << data.notes[1];
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
  read("deep.svg", text + "</svg>");  // no g is in a b, as the nearest b shows
  std::string hard = text;
  hard.replace(hard.find("g g "), 4, "b g ");
  hard.replace(hard.find(" b rect"), 7, " rect");
  EXPECT_EQ(refused("hard.svg", hard + "</svg>").code, ErrorCode::too_large);
}

TEST_F(CurvedIo, SvgSizesThatAViewBoxTells) {
  const std::string circle = "<circle cx='4' cy='3' r='2'/>";
  expect_circle(svg(circle, "viewBox='0 0 24 12'").items[0].contours[0], {4, 3}, 2, true);
  expect_circle(svg(circle, "viewBox='2 1 24 12' width='100%'").items[0].contours[0], {2, 2}, 2,
                true);
  expect_circle(svg(circle, "viewBox='0 0 24 12' width='48'").items[0].contours[0], {8, 6}, 4,
                true);
  const Document<Feature> inches = svg(circle, "viewBox='0 0 24 12' height='3in'");
  EXPECT_EQ(inches.unit, Unit::inch);
  expect_circle(inches.items[0].contours[0], {1, 0.75}, 0.5, true);
  expect_circle(svg(circle).items[0].contours[0], {4, 3}, 2, true);
}

TEST_F(CurvedIo, SvgFillRulesAndWhatIsPainted) {
  const Document<Feature> data = svg(
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
  for (const Feature& feature : data.items) {
    widths.push_back(feature.contours[0].points[1].x);
    roles.push_back(feature.contours[0].role);
  }
  EXPECT_EQ(widths, (std::vector<double>{2, 3, 4, 8, 10}));
  EXPECT_EQ(roles, (std::vector<RingRole>{RingRole::winding, RingRole::any, RingRole::winding,
                                          RingRole::winding, RingRole::winding}));
  ASSERT_EQ(data.notes.size(), 2U);
  EXPECT_NE(data.notes[0].find("2 shapes are not filled"), std::string::npos);
  EXPECT_EQ(data.notes[1], "1 text or picture was left out: convert texts to paths");
}

TEST_F(CurvedIo, SvgOfStrokesAloneIsWhatTheyEnclose) {
  // As CAD writes a plate with a hole; a line stays open, a ring closes by its ends.
  const std::string plate =
      "<g fill='none' stroke='black'><rect width='10' height='6'/><circle cx='3' cy='3' r='1'/>"
      "<path d='M6 2L8 2L8 4L6 4L6 2'/><path d='M0 0L10 6'/></g>";
  const Document<Feature> data = svg(plate);
  ASSERT_EQ(data.items.size(), 1U);
  EXPECT_EQ(data.items[0].contours.size(), 3U);
  ASSERT_EQ(data.notes.size(), 1U);
  EXPECT_NE(data.notes[0].find("closed strokes are used as outlines"), std::string::npos);
  const auto rings = approximate_by_arcs(data.items[0].contours);
  ASSERT_TRUE(rings);
  const auto shape = build_shape(*rings);
  ASSERT_TRUE(shape);
  EXPECT_NEAR(area(*shape), 60 - std::numbers::pi - 4, 1e-12);
  EXPECT_EQ(shape->hole_count(), 2U);
  // Where anything is filled, strokes are left out.
  EXPECT_EQ(svg(plate + "<rect width='1' height='1'/>").items[0].contours.size(), 1U);
}

TEST_F(CurvedIo, SvgWithoutNamespaceAndCompressedNames) {
  EXPECT_EQ(read("a.svg", "<svg><rect width='1' height='1'/></svg>").items.size(), 1U);
  EXPECT_EQ(read("a.svgz", "<svg><rect width='1' height='1'/></svg>").items.size(), 1U);
}

TEST_F(CurvedIo, SvgRefusesWhatIsBroken) {
  const auto code = [this](const std::string& text) { return refused("bad.svg", text).code; };
  EXPECT_EQ(code(""), ErrorCode::malformed);
  EXPECT_EQ(code("<svg><rect width='1'"), ErrorCode::malformed);
  EXPECT_EQ(code("<html/>"), ErrorCode::malformed);
  EXPECT_EQ(code("<svg/>"), ErrorCode::empty);
  EXPECT_EQ(code("<svg><path d='M0 0H1V1' fill='none'/></svg>"), ErrorCode::empty);
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
          .items[0]
          .contours[0]
          .points[1],
      (Vec2{3, 0}));
  write("secret.txt", "3");
  refused("file.svg", "<!DOCTYPE svg [<!ENTITY w SYSTEM '" + path("secret.txt") +
                          "'>]><svg><rect width='&w;' height='1'/></svg>");
}

TEST_F(CurvedIo, SvgCopiesOfCopiesAreBounded) {
  if (test::sanitized) GTEST_SKIP() << "a million elements";
  std::string doubled = "<svg><defs><rect id='u0' width='1' height='1'/>";
  for (int i = 1; i <= 30; ++i) {
    const std::string before = std::to_string(i - 1);
    doubled += "<g id='u" + std::to_string(i) + "'><use href='#u" + before + "'/><use href='#u" +
               before + "'/></g>";
  }
  EXPECT_EQ(refused("bomb.svg", doubled + "</defs><use href='#u30'/></svg>").code,
            ErrorCode::too_large);
}

TEST_F(CurvedIo, SvgOfTheDataFolderCountsAsListed) {
  const fs::path folder = test::data_folder() / "packaged/B_svg";
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
    const Result<Document<Feature>> data = read_document((folder / name).string());
    ASSERT_TRUE(data.ok()) << to_string(data.error());
    ++files;
    if (!data->notes.empty()) continue;  // something is not filled
    const Counts counts = count(*data);
    EXPECT_EQ(data->items.size(), paths) << name;
    EXPECT_EQ(counts.cubics, cubics) << name;
    EXPECT_EQ(counts.quadratics, quadratics) << name;
    EXPECT_GE(counts.arcs + counts.rationals, arcs) << name;  // over half a turn makes two
    // The list counts points after the first of an `m` as subpaths; they are lines.
    const std::size_t gone = fewer.contains(name) ? 1 : 0;
    EXPECT_EQ(counts.contours + counts.lines + gone, subpaths + lines) << name;
  }
  EXPECT_EQ(files, 145U);
}

}  // namespace
}  // namespace medial::io
