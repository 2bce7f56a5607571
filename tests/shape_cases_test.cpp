// The verdicts of build_shape() on published collections of degenerate polygons, against those of
// GEOS that stand in the tables. The collections are optional.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "medial/shape.h"
#include "support/environment.h"
#include "support/wkt.h"

namespace medial {
namespace {

struct ShapeCase {
  std::string id;
  std::string geos;
  std::string wkt;
};

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == '\t') {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

std::vector<ShapeCase> read_table(const std::filesystem::path& file) {
  std::vector<ShapeCase> cases;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = fields_of(line);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  const std::size_t id = column("id");
  const std::size_t geos = column("geos");
  const std::size_t wkt = column("wkt");
  while (std::getline(stream, line)) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() == header.size()) cases.push_back({fields[id], fields[geos], fields[wkt]});
  }
  return cases;
}

struct Table {
  const char* name;
  std::size_t rows;
  std::size_t legal_touching;  ///< rejected by GEOS, valid here
};
void PrintTo(const Table& table, std::ostream* out) { *out << table.name; }

/// The verdicts of GEOS that rings deserve by touching themselves or each other only.
bool rejects_touching(const std::string& geos) {
  return geos.starts_with("Ring Self-intersection") || geos.starts_with("Interior is disconnected");
}

/// Whether our error is of a kind that GEOS words like this.
bool same_kind(const std::string& geos, ErrorCode code) {
  const bool points = code == ErrorCode::too_few_points || code == ErrorCode::no_area;
  if (geos.starts_with("Hole")) return code == ErrorCode::hole_outside;
  if (geos.starts_with("Nested shells")) {
    return code == ErrorCode::nested_outer || code == ErrorCode::hole_outside;
  }
  if (geos.starts_with("Too few points") || geos.starts_with("unreadable")) return points;
  return points || code == ErrorCode::crossing || code == ErrorCode::overlap;
}

class Cases : public testing::TestWithParam<Table> {};

TEST_P(Cases, AgreeWithGeosExceptThatTouchingIsLegal) {
  const std::filesystem::path file =
      test::data_folder() / "in_place/E_degenerate" / (std::string(GetParam().name) + ".tsv");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const std::vector<ShapeCase> cases = read_table(file);
  EXPECT_EQ(cases.size(), GetParam().rows);
  std::size_t legal_touching = 0;
  for (const ShapeCase& row : cases) {
    SCOPED_TRACE(row.id + ": " + row.geos);
    const bool geos_accepts = row.geos == "Valid Geometry";
    const auto rings = test::rings_of_wkt(row.wkt);
    if (!rings) {
      EXPECT_FALSE(geos_accepts);
      continue;
    }
    ShapeReport report;
    const Result<Shape> shape = build_shape(*rings, {}, &report);
    if (geos_accepts) {
      // An empty polygon is valid to GEOS, and nothing to us.
      const bool empty = rings->empty();
      EXPECT_EQ(shape.ok(), !empty) << to_string(shape.error());
      if (!shape) {
        EXPECT_EQ(shape.error().code, ErrorCode::empty);
      }
      continue;
    }
    if (shape) {
      EXPECT_TRUE(rejects_touching(row.geos));
      EXPECT_GT(report.touching_vertices, 0U);
      ++legal_touching;
    } else {
      EXPECT_TRUE(same_kind(row.geos, shape.error().code)) << to_string(shape.error());
    }
  }
  EXPECT_EQ(legal_touching, GetParam().legal_touching);
}

INSTANTIATE_TEST_SUITE_P(Published, Cases,
                         testing::Values(Table{"jts_valid_cases", 191, 9},
                                         Table{"earcut_cases", 26, 2},
                                         Table{"clipper2_polygons", 98, 1},
                                         Table{"geo_booleanop_cases", 23, 0}),
                         [](const auto& named) { return std::string(named.param.name); });

}  // namespace
}  // namespace medial
