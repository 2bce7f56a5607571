// Axes that are written while they grow: what write_axes() writes, in another order.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "medial/io/write.h"
#include "support/computed.h"
#include "support/generate.h"
#include "support/scratch_folder.h"

namespace medial::io {
namespace {

using Line = std::vector<std::pair<double, double>>;

class InParts : public test::ScratchFolder {
 protected:
  /// Two shapes, one of several parts with a hole, and one point of an axis.
  static Document<ShapeItem> shapes() {
    Document<ShapeItem> file;
    file.items.push_back({test::shape_of(test::maze(40000)), {{"name", "a"}, {"height", "3"}}});
    file.items.push_back({test::shape_of(test::hole_grid(8)), {{"name", "b"}, {"height", "4"}}});
    file.items.push_back({test::shape_of(test::regular_polygon(8)), {{"name", "c"}}});
    return file;
  }
  static Document<AxisItem> whole(const Document<ShapeItem>& file) {
    return compute_axes(file, {}).value();
  }

  /// The lines of a table, begun at their lower end, with what their rows say.
  struct Row {
    Line line;
    std::map<std::string, std::string> values;
    bool turned = false;
  };
  static std::vector<Row> rows_of(const std::string& path) {
    SourceOptions source;
    source.read.loose = true;
    const auto file = read_features(path, source);
    std::vector<Row> rows;
    if (!file) return rows;
    for (const Feature& feature : file->items) {
      Row& row = rows.emplace_back();
      for (const Vec2 p : feature.chains.at(0).points) row.line.emplace_back(p.x, p.y);
      row.turned = row.line.back() < row.line.front();
      if (row.turned) std::reverse(row.line.begin(), row.line.end());
      row.values.insert(feature.attributes.begin(), feature.attributes.end());
    }
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.line < b.line; });
    return rows;
  }
  /// Closed branches may begin elsewhere: their places, and what does not depend on the direction.
  static std::string difference(const Row& a, const Row& b) {
    for (const char* name : {"feature", "name", "height"})
      if (a.values.count(name) != b.values.count(name) ||
          (a.values.count(name) > 0 && a.values.at(name) != b.values.at(name)))
        return name;
    for (const char* name : {"length", "r_min", "r_max"}) {
      const double x = std::stod(a.values.at(name)), y = std::stod(b.values.at(name));
      if (!(std::abs(x - y) <= 1e-9 * std::abs(x))) return name;
    }
    return a.line == b.line ? "" : "the line";
  }
};

std::vector<Line> edges_of(const std::string& csv) {
  std::map<std::string, Line> edges;
  std::istringstream text(csv);
  std::string row, id;
  std::getline(text, row);
  while (std::getline(text, row)) {
    std::istringstream cells(row);
    double x = 0, y = 0;
    char comma = 0;
    std::getline(cells, id, ',');
    cells >> x >> comma >> y;
    edges[id].emplace_back(x, y);
  }
  std::vector<Line> lines;
  for (auto& [number, line] : edges) {
    if (line.back() < line.front()) std::reverse(line.begin(), line.end());
    lines.push_back(std::move(line));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST_F(InParts, EdgesAreThoseOfTheWhole) {
  const auto file = shapes();
  std::string expected, text;
  ASSERT_TRUE(write_axes(&expected, "csv", whole(file)));
  std::vector<std::size_t> parts(file.items.size());
  const auto written = write_in_parts(&text, "csv", file, {}, {},
                                      [&](std::size_t i, const AxisPart&) { ++parts[i]; });
  ASSERT_TRUE(written && *written);
  EXPECT_GT(parts[0], 2U);
  EXPECT_EQ(parts[1], 1U);
  EXPECT_EQ(expected.size(), text.size());
  EXPECT_TRUE(edges_of(expected) == edges_of(text));
}

TEST_F(InParts, BranchesAreWhole) {
  const auto file = shapes();
  for (const char* format : {"geojson", "fgb"}) {
    const std::string one = path(std::string("whole.") + format);
    const std::string other = path(std::string("parts.") + format);
    ASSERT_TRUE(write_axes(one, format, whole(file)));
    const auto written = write_in_parts(other, format, file, {});
    ASSERT_TRUE(written && *written) << format;
    const auto expected = rows_of(one), rows = rows_of(other);
    ASSERT_FALSE(expected.empty()) << format;
    ASSERT_EQ(rows.size(), expected.size()) << format;
    std::map<std::pair<std::string, std::string>, std::pair<double, double>> places;
    std::map<std::string, std::size_t> branches;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_EQ(difference(rows[i], expected[i]), "") << format << ' ' << i;
      EXPECT_EQ(rows[i].values.at("branch").empty(), false);
      ++branches[rows[i].values.at("feature") + '/' + rows[i].values.at("branch")];
      for (const bool at_end : {false, true}) {
        const auto place = at_end != rows[i].turned ? rows[i].line.back() : rows[i].line.front();
        const auto node = rows[i].values.at(at_end ? "to_node" : "from_node");
        const auto [known, is_new] = places.try_emplace({"", node}, place);
        EXPECT_EQ(known->second, place) << format << " node " << node;
      }
    }
    EXPECT_EQ(branches.size(), rows.size()) << format;
  }
}

TEST_F(InParts, OfOtherFormatsAndPipesThereAreNone) {
  const auto file = shapes();
  for (const char* name : {"a.json", "a.gpkg", "a.svg", "a.wkt", "-"}) {
    const auto written = write_in_parts(name == std::string("-") ? name : path(name), "", file, {});
    ASSERT_TRUE(written) << name;
    EXPECT_FALSE(*written) << name;
  }
  const auto silent = write_in_parts("", "", file, {});
  ASSERT_TRUE(silent && *silent);
  EXPECT_GT((*silent)->statistics.queries, 0U);
}

TEST_F(InParts, BrokenOnesLeaveWhatWasThere) {
  const auto file = shapes();
  for (const char* format : {"csv", "geojson", "fgb"}) {
    const std::string name = write(std::string("a.") + format, "as it was");
    std::atomic<bool> cancel = false;
    Options options;
    options.cancel = &cancel;
    const auto stop = [&](std::size_t, const AxisPart&) { cancel = true; };
    const auto written = write_in_parts(name, format, file, options, {}, stop);
    ASSERT_FALSE(written) << format;
    EXPECT_EQ(written.error().code, ErrorCode::cancelled);
    EXPECT_EQ(content(std::string("a.") + format), "as it was");
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 3);
}

}  // namespace
}  // namespace medial::io
