// Axes that are written while they grow: the same content as by write_axes(), in another order.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <sstream>
#include <tuple>

#include "io/spill.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "support/computed.h"
#include "support/generate.h"
#include "support/generate_arcs.h"
#include "support/nasty.h"
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
    return compute_axes(file).value();
  }

  /// The lines of a table, starting at their lower end, with their rows.
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
  /// Closed branches may begin elsewhere: compares their places, and values that do not depend on
  /// the direction.
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
  auto file = shapes();
  std::string expected, text;
  ASSERT_TRUE(write_axes(&expected, "csv", whole(file)));
  std::vector<std::size_t> parts(file.items.size());
  const auto written =
      write_in_parts(&text, "csv", shapes(), {}, {},
                     [&](std::size_t i, std::uint64_t, const AxisPart&) { ++parts[i]; });
  ASSERT_TRUE(written && *written);
  EXPECT_GT(parts[0], 2U);
  EXPECT_EQ(parts[1], 1U);
  EXPECT_EQ(expected.size(), text.size());
  EXPECT_TRUE(edges_of(expected) == edges_of(text));
}

TEST_F(InParts, BranchesAreWhole) {
  auto file = shapes();
  for (const char* format : {"geojson", "fgb"}) {
    const std::string one = path(std::string("whole.") + format);
    const std::string other = path(std::string("parts.") + format);
    ASSERT_TRUE(write_axes(one, format, whole(file)));
    const auto written = write_in_parts(other, format, Document(file), {});
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

/// The edges of an axis by their values, each from its lower end.
auto graph_of(const MedialAxis& axis) {
  const auto key = [](const Disk& disk) {
    return std::array{disk.center.x, disk.center.y, disk.radius};
  };
  using Key = decltype(key({}));
  std::vector<std::tuple<Key, Key, Key, double, std::uint32_t, std::uint32_t>> edges;
  for (const Edge& edge : axis.edges) {
    Key from = key(axis.nodes[edge.node[0]].disk), to = key(axis.nodes[edge.node[1]].disk);
    auto [left, right] = edge.site;
    if (to < from) {
      std::swap(from, to);
      std::swap(left, right);
    }
    edges.emplace_back(from, to, key(edge.control), edge.weight, left, right);
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::tuple<Key, std::uint32_t, NodeKind>> nodes;
  for (const Node& node : axis.nodes) nodes.emplace_back(key(node.disk), node.component, node.kind);
  std::sort(nodes.begin(), nodes.end());
  return std::pair(edges, nodes);
}

TEST_F(InParts, GraphsAreThoseOfTheWhole) {
  auto file = shapes();
  file.unit = Unit::metre;
  const auto whole_file = whole(file);
  for (const char* format : {"json", "safetensors"}) {
    const std::string one = path(std::string("whole.") + format);
    const std::string other = path(std::string("parts.") + format);
    ASSERT_TRUE(write_axes(one, format, whole_file)) << format;
    const auto written = write_in_parts(other, format, Document(file), {});
    ASSERT_TRUE(written && *written) << format;
    const auto expected = read_native(one), read = read_native(other);
    ASSERT_TRUE(expected && read) << format;
    ASSERT_EQ(read->items.size(), file.items.size());
    EXPECT_EQ(read->unit, Unit::metre);
    for (std::size_t i = 0; i < read->items.size(); ++i) {
      const AxisItem &a = expected->items[i], &b = read->items[i];
      EXPECT_EQ(a.attributes, b.attributes);
      EXPECT_TRUE(a.shape.points == b.shape.points && a.shape.hole == b.shape.hole);
      ASSERT_EQ(a.axis.sites.size(), b.axis.sites.size());
      for (std::size_t k = 0; k < a.axis.sites.size(); ++k) {
        const Site &x = a.axis.sites[k], &y = b.axis.sites[k];
        ASSERT_TRUE(x.start == y.start && x.end == y.end && x.ring == y.ring &&
                    x.vertex == y.vertex && x.kind() == y.kind())
            << format << ' ' << k;
      }
      EXPECT_TRUE(graph_of(a.axis) == graph_of(b.axis)) << format << ' ' << i;
      EXPECT_EQ(a.axis.tolerance, b.axis.tolerance);
      EXPECT_EQ(b.axis.method, "disks");
    }
  }
}

// Their sites are not known before the axis is.
TEST_F(InParts, OfWholeGraphsWithArcsThereAreNone) {
  Document<ShapeItem> file;
  file.items.push_back({test::shape_of(test::Rings{test::gear(5, 0.7)}), {}});
  for (const char* format : {"json", "safetensors"}) {
    const auto written =
        write_in_parts(path(std::string("arcs.") + format), "", Document(file), {});
    ASSERT_TRUE(written) << format;
    EXPECT_FALSE(*written) << format;
  }
}

TEST_F(InParts, AreOfTheFormatsThatAreListed) {
  EXPECT_EQ(formats_of(DocumentKind::axes, true), ".json .safetensors .geojson .shp .fgb .csv");
}

/// Two rings that touch up to rounding, where the walk loses its way, below combs that are walked
/// before.
Shape lost_after_a_part() {
  const auto classes = test::nasty_classes();
  const auto one =
      std::ranges::find_if(classes, [](const auto& known) { return known.name == "rings"; });
  test::Rings rings = test::nasty_shape(*one, 201, false);
  Vec2 corner = rings[0].points[0];
  double right = corner.x;
  for (const Ring& ring : rings)
    for (const Vec2 p : ring.points) {
      corner = {std::min(corner.x, p.x), std::min(corner.y, p.y)};
      right = std::max(right, p.x);
    }
  const double width = right - corner.x;
  const Ring comb = test::comb(100)[0];
  double length = 0;
  for (const Vec2 p : comb.points) length = std::max(length, p.x);
  const double scale = width / length / 2;
  for (int i = 0; i < 40; ++i) {
    Ring& copy = *rings.insert(rings.begin() + i, comb);
    for (Vec2& p : copy.points)
      p = {right + width / 10 + scale * p.x, corner.y + scale * (p.y + 10 * i)};
  }
  return test::shape_of(rings);
}

TEST_F(InParts, BeginAgainWhereTheWalkLosesItsWay) {
  Document<ShapeItem> file;
  file.items.push_back({test::shape_of(test::maze(300)), {{"name", "before"}}});
  file.items.push_back({lost_after_a_part(), {{"name", "lost"}}});
  file.items.push_back({test::shape_of(test::maze(200)), {{"name", "after"}}});
  const auto whole_file = whole(file);
  for (const char* format : {"csv", "geojson", "json", "safetensors"}) {
    const std::string one = path(std::string("whole.") + format);
    const std::string other = path(std::string("parts.") + format);
    ASSERT_TRUE(write_axes(one, format, whole_file));
    std::array<std::vector<bool>, 3> begins;
    const auto written = write_in_parts(other, format, Document(file), {}, {},
                                        [&](std::size_t i, std::uint64_t, const AxisPart& part) {
                                          begins[i].push_back(part.begins);
                                        });
    ASSERT_TRUE(written && *written) << format;
    EXPECT_EQ(begins[0], (std::vector{true, true}));
    EXPECT_EQ(begins[1], (std::vector{true, true})) << "the walk finds its way: take another shape";
    EXPECT_EQ(begins[2], (std::vector{true}));
    if (format == std::string("csv")) {
      EXPECT_TRUE(edges_of(content("whole.csv")) == edges_of(content("parts.csv")));
    } else if (format == std::string("geojson")) {
      EXPECT_EQ(rows_of(one).size(), rows_of(other).size());
    } else {
      const auto expected = read_native(one), read = read_native(other);
      ASSERT_TRUE(expected && read) << format;
      ASSERT_EQ(read->items.size(), 3U);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_TRUE(graph_of(expected->items[i].axis) == graph_of(read->items[i].axis)) << i;
    }
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 8);
}

TEST_F(InParts, WaitInAFileKindByKind) {
  Spill spill(directory_.string(), 2);
  std::array<std::string, 2> expected, found;
  for (int i = 0; i < 100'000; ++i)
    for (const std::size_t kind : {0U, 1U}) {
      const std::string text = std::to_string(i * (kind + 7)) + ' ';
      spill.put(kind, text);
      expected[kind] += text;
    }
  for (const std::size_t kind : {1U, 0U})
    EXPECT_TRUE(spill.read(kind, [&](std::string_view text) { found[kind] += text; }));
  EXPECT_TRUE(expected == found);
  EXPECT_TRUE(std::filesystem::is_empty(directory_));
  spill.clear();
  EXPECT_TRUE(spill.read(0, [&](std::string_view text) { EXPECT_EQ(text, ""); }));
  Spill nowhere(path("none"), 1);
  nowhere.put(0, expected[0]);
  EXPECT_EQ(nowhere.status().error().code, ErrorCode::unwritable);
  EXPECT_FALSE(nowhere.read(0, [](std::string_view) {}));
}

TEST_F(InParts, OfOtherFormatsAndPipesThereAreNone) {
  auto file = shapes();
  for (const char* name : {"a.gpkg", "a.svg", "a.wkt", "-"}) {
    Document given = file;
    const auto written =
        write_in_parts(name == std::string("-") ? name : path(name), "", std::move(given), {});
    ASSERT_TRUE(written) << name;
    EXPECT_FALSE(*written) << name;
    // NOLINTNEXTLINE(bugprone-use-after-move): such shapes stay
    ASSERT_EQ(given.items.size(), file.items.size()) << name;
    for (std::size_t i = 0; i < file.items.size(); ++i) {
      EXPECT_EQ(given.items[i].shape.points, file.items[i].shape.points) << name;
      EXPECT_EQ(given.items[i].attributes, file.items[i].attributes) << name;
    }
  }
  const auto silent = write_in_parts("", "", Document(file), {});
  ASSERT_TRUE(silent && *silent);
  EXPECT_GT((*silent)->statistics.queries, 0U);
}

TEST_F(InParts, BrokenOnesLeaveWhatWasThere) {
  auto file = shapes();
  for (const char* format : {"csv", "geojson", "fgb", "json", "safetensors"}) {
    const std::string name = write(std::string("a.") + format, "as it was");
    std::atomic<bool> cancel = false;
    Options options;
    options.cancel = &cancel;
    const auto stop = [&](std::size_t, std::uint64_t, const AxisPart&) { cancel = true; };
    const auto written = write_in_parts(name, format, Document(file), {options}, {}, stop);
    ASSERT_FALSE(written) << format;
    EXPECT_EQ(written.error().code, ErrorCode::cancelled);
    EXPECT_EQ(content(std::string("a.") + format), "as it was");
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 5);
}

}  // namespace
}  // namespace medial::io
