// Axes as columns, in the format safetensors.
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "medial/compute.h"
#include "support/native_items.h"

namespace medial::io {
namespace {

class Columns : public Io {
 protected:
  /// With the statistics of `read`, which columns do not hold.
  static AxisItem as_read(AxisItem item, const AxisItem& read) {
    item.axis.statistics = read.axis.statistics;
    return item;
  }
  static std::string with_header(const std::string& file, const std::string& header) {
    std::string text(8, '\0');
    for (std::size_t i = 0; i < 8; ++i) text[i] = static_cast<char>(header.size() >> 8 * i & 0xFF);
    return text + header + file.substr(8 + header_size(file));
  }
  static std::size_t header_size(const std::string& file) {
    std::uint64_t size = 0;
    std::memcpy(&size, file.data(), sizeof size);
    return size;
  }
  static std::string header_of(const std::string& file) {
    return file.substr(8, header_size(file));
  }
};

AxisItem of_arcs() {
  AxisItem item;
  const Ring slot{{{0, 0}, {4, 0}, {4, 2}, {0, 2}}, RingRole::outer, {0, 1, 0, 1}};
  const Ring hole{{{1.5, 0.5}, {1.5, 1.5}, {2.5, 1.0}}, RingRole::hole};
  item.shape = build_shape(std::array{slot, hole}).value();
  item.axis = compute(item.shape).value();
  item.attributes = {{"\xC3\xA4\n", "\"\\ \t\x01"}, {"", ""}};
  item.part = true;
  return item;
}

TEST_F(Columns, LoseNothing) {
  Document<AxisItem> file = two_items();
  file.items.push_back(of_arcs());
  file.items.push_back({});
  file.unit = Unit::inch;
  file.y_down = true;
  file.items[0].shape.points[1].x = -0.0;
  file.items[1].axis.nodes[0].disk.center.x = std::numeric_limits<double>::denorm_min();
  ASSERT_TRUE(write_axes(path("a.safetensors"), "", file).ok());
  EXPECT_TRUE(is_native(path("a.safetensors")));
  const auto read = read_native(path("a.safetensors"));
  ASSERT_TRUE(read.ok()) << to_string(read.error());
  EXPECT_EQ(read->unit, Unit::inch);
  EXPECT_TRUE(read->y_down);
  ASSERT_EQ(read->items.size(), file.items.size());
  for (std::size_t i = 0; i + 1 < file.items.size(); ++i) {
    expect_same(as_read(file.items[i], read->items[i]), read->items[i]);
    EXPECT_EQ(read->items[i].shape.bulges, file.items[i].shape.bulges);
    EXPECT_EQ(read->items[i].part, file.items[i].part);
  }
  EXPECT_TRUE(read->items[3].shape.points.empty());
  ASSERT_TRUE(write_axes(path("b.safetensors"), "", *read).ok());
  EXPECT_EQ(content("a.safetensors"), content("b.safetensors"));
  file.crs_wkt = "LOCAL_CS[\"any\"]";
  ASSERT_TRUE(write_axes(path("c.safetensors"), "", file).ok());
  EXPECT_EQ(read_native(path("c.safetensors")).value().crs_wkt, file.crs_wkt);
  const auto features = read_document(path("a.safetensors"));
  ASSERT_TRUE(features.ok()) << to_string(features.error());
  EXPECT_EQ(features->items[0].rings[0].points, file.items[0].shape.points);
}

/// Reads the file by the format's definition, as any other program would.
TEST_F(Columns, FollowEachOtherWithoutGaps) {
  ASSERT_TRUE(write_axes(path("a.safetensors"), "", two_items()).ok());
  const std::string file = content("a.safetensors");
  const std::size_t size = header_size(file);
  EXPECT_EQ(size % 8, 0U);
  const auto header = nlohmann::ordered_json::parse(header_of(file));
  std::uint64_t end = 0;
  const std::map<std::string, std::uint64_t> bytes{{"F64", 8}, {"U64", 8}, {"U32", 4}, {"U8", 1}};
  for (const auto& [name, column] : header.items()) {
    if (name == "__metadata__") {
      for (const auto& text : column) EXPECT_TRUE(text.is_string());
      continue;
    }
    std::uint64_t expected = bytes.at(column["dtype"]);
    for (const auto& count : column["shape"]) expected *= count.get<std::uint64_t>();
    EXPECT_EQ(column["data_offsets"][0], end) << name;
    EXPECT_EQ(column["data_offsets"][1], end + expected) << name;
    EXPECT_EQ(end % bytes.at(column["dtype"]), 0U) << name;
    end += expected;
  }
  EXPECT_EQ(8 + size + end, file.size());
}

TEST_F(Columns, AreRefusedWhereTheyAreDamaged) {
  Document<AxisItem> file = two_items();
  file.items.push_back(of_arcs());
  ASSERT_TRUE(write_axes(path("a.safetensors"), "", file).ok());
  const std::string good = content("a.safetensors");
  const std::size_t data = 8 + header_size(good);
  const auto read = [](const std::string& bytes) { return read_native_text(bytes); };
  ASSERT_TRUE(read(good).ok());
  for (std::size_t length = 0; length < good.size(); length += length < data ? 3 : 17)
    EXPECT_FALSE(read(good.substr(0, length)).ok()) << length;
  std::mt19937 random(5);
  for (std::size_t place = data; place < good.size(); place += 5) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ (1U << random() % 8));
    const auto result = read(bad);
    ASSERT_FALSE(result.ok()) << place;
    EXPECT_EQ(result.error().code, ErrorCode::malformed);
  }
  // Without checksums the rows are checked all the same: nothing but errors, or axes to be written.
  const std::string header = header_of(good);
  const auto begin = header.find("\"crc32\""), end = header.find("},\"points\"");
  ASSERT_LT(begin, end);
  const std::string bare = with_header(good, header.substr(0, begin - 1) + header.substr(end));
  ASSERT_TRUE(read(bare).ok()) << to_string(read(bare).error());
  for (std::size_t i = 0; i < 400; ++i) {
    std::string bad = bare;
    bad[8 + random() % (bad.size() - 8)] = static_cast<char>(random());
    const auto result = read(bad);
    EXPECT_TRUE(!result || write_axes(path("b.json"), "", *result).ok());
  }
}

TEST_F(Columns, AreThoseOfAnAxis) {
  ASSERT_TRUE(write_axes(path("a.safetensors"), "", two_items()).ok());
  const std::string good = content("a.safetensors");
  const auto with = [&](const std::string& old, const std::string& by) {
    std::string header = header_of(good);
    EXPECT_NE(header.find(old), std::string::npos) << old;
    return read_native_text(with_header(good, header.replace(header.find(old), old.size(), by)));
  };
  EXPECT_EQ(with("\"medial\":\"1\"", "\"medial\":\"2\"").error().code, ErrorCode::unsupported);
  EXPECT_EQ(with("\"medial\":\"1\"", "\"other\":\"1\"").error().code, ErrorCode::malformed);
  EXPECT_EQ(with("\"F64\"", "\"F32\"").error().code, ErrorCode::malformed);
  EXPECT_EQ(with("\"node_disk\"", "\"node_disc\"").error().code, ErrorCode::malformed);
  EXPECT_EQ(with("[9,2]", "[2,9]").error().code, ErrorCode::malformed);
  EXPECT_EQ(with("[9,2]", "[4611686018427387913,2]").error().code, ErrorCode::malformed);
}

TEST_F(Columns, AreFinite) {
  Document<AxisItem> file = two_items();
  file.items[0].axis.nodes[2].disk.radius = std::numeric_limits<double>::infinity();
  const Status status = write_axes(path("a.safetensors"), "", file);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::internal);
}

}  // namespace
}  // namespace medial::io
