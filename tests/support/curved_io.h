#pragma once

// What the tests of curved inputs and outputs have in common.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <ostream>
#include <string>

#include "medial/io/read.h"
#include "support/curve_check.h"
#include "support/scratch_folder.h"

namespace medial::io {

class CurvedIo : public test::ScratchFolder {
 protected:
  Document<Feature> read(const std::string& name, const std::string& text,
                         const ReadOptions& options = {}) const {
    Result<Document<Feature>> data = read_document(write(name, text), options);
    EXPECT_TRUE(data.ok()) << to_string(data.error());
    return data ? *data : Document<Feature>{};
  }
  Document<Feature> svg(const std::string& body, const std::string& attributes = "") const {
    return read("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' " + attributes + ">\n" + body +
                             "\n</svg>");
  }
  Error refused(const std::string& name, const std::string& text,
                const ReadOptions& options = {}) const {
    const Result<Document<Feature>> data = read_document(write(name, text), options);
    EXPECT_FALSE(data.ok()) << text.substr(0, 200);
    if (data) return {};
    EXPECT_EQ(data.error().place.file, path(name));
    return data.error();
  }
};

struct Counts {
  std::size_t contours = 0, lines = 0, arcs = 0, quadratics = 0, cubics = 0, rationals = 0;
  bool operator==(const Counts&) const = default;
};

inline std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << c.contours << " contours, " << c.lines << " lines, " << c.arcs << " arcs, "
             << c.quadratics << " quadratics, " << c.cubics << " cubics, " << c.rationals
             << " rationals";
}

inline Counts count(const Document<Feature>& data) {
  Counts counts;
  for (const Feature& feature : data.items) {
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

inline void expect_near(Vec2 a, Vec2 b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

/// Points of a circle: pieces are arcs of that circle, turning left or right throughout.
inline void expect_circle(const Contour& contour, Vec2 center, double radius, bool left) {
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

}  // namespace medial::io
