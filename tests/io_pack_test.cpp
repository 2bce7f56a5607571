// Packs as files: round trips, checksums, and bytes that no pack has.
#include <gtest/gtest.h>

#include <cmath>

#include "medial/compute.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "support/random_shapes.h"

namespace medial {
namespace {

using test::Random;

io::PackFile pack_of(const test::Rings& rings, double share) {
  const auto shape = build_shape(rings);
  EXPECT_TRUE(shape.ok());
  const auto axis = compute(*shape);
  EXPECT_TRUE(axis.ok());
  const std::array<MedialAxis, 1> axes{*axis};
  io::PackFile file;
  auto code = encode_axes(axes, {share * diagonal(bounding_box(*shape))});
  EXPECT_TRUE(code.ok());
  file.code = std::move(code).value();
  return file;
}

TEST(PackFiles, GoThereAndBack) {
  io::PackFile file = pack_of(test::blob(2000), 1e-4);
  file.y_down = true;
  for (const std::string crs : {"", "LOCAL_CS[\"here\"]"}) {
    file.crs_wkt = crs;
    file.unit = crs.empty() ? Unit::unknown : Unit::inch;
    const auto bytes = io::pack_bytes(file);
    ASSERT_TRUE(bytes.ok());
    const auto back = io::unpack_bytes(*bytes);
    ASSERT_TRUE(back.ok()) << back.error().text;
    EXPECT_EQ(back->code, file.code);
    EXPECT_EQ(back->crs_wkt, crs);
    EXPECT_EQ(back->unit, file.unit);
    EXPECT_TRUE(back->y_down);
    EXPECT_EQ(back->kind, io::PackKind::axes);
  }
}

TEST(PackFiles, HoldTheirShapes) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto random = test::random_any(seed);
    const auto shape = build_shape(random.rings);
    ASSERT_TRUE(shape.ok());
    SCOPED_TRACE(random.kind + " " + std::to_string(seed));
    std::vector<std::string> notes;
    const auto native = io::native_of(pack_of(random.rings, 1e-4), &notes);
    ASSERT_TRUE(native.ok());
    EXPECT_TRUE(notes.empty()) << notes.front();
    ASSERT_EQ(native->items.size(), 1U);
    // The symmetric difference is at most a band of the error's width along the boundary.
    const double size = diagonal(bounding_box(*shape));
    double boundary = 0;
    for (std::size_t k = 0; k < shape->points.size(); ++k) {
      const auto loop = std::upper_bound(shape->loop_begin.begin(), shape->loop_begin.end(), k) - 1;
      const std::size_t next = k + 1 == *(loop + 1) ? *loop : k + 1;
      boundary += 2 * distance(shape->points[k], shape->points[next]);
    }
    EXPECT_NEAR(area(native->items[0].shape), area(*shape), 1e-4 * size * (2 * boundary));
  }
}

TEST(PackFiles, DamageIsTold) {
  Random random(11);
  const auto bytes = io::pack_bytes(pack_of(test::blob(300), 1e-3));
  ASSERT_TRUE(bytes.ok());
  ASSERT_GT(bytes->size(), 100U);
  for (std::size_t length = 0; length < bytes->size(); ++length) {
    const auto cut = io::unpack_bytes(std::span(*bytes).first(length));
    ASSERT_FALSE(cut.ok()) << length;
  }
  for (std::uint64_t i = 0; i < test::shape_count(1); ++i) {
    std::vector<std::uint8_t> damaged = *bytes;
    const std::uint64_t changes = 1 + random.next() % 3;
    for (std::uint64_t k = 0; k < changes; ++k)
      damaged[random.next() % damaged.size()] = static_cast<std::uint8_t>(random.next());
    const auto file = io::unpack_bytes(damaged);
    if (file.ok()) {
      (void)decode_axes(file->code);
      continue;
    }
    const ErrorCode code = file.error().code;
    ASSERT_TRUE(code == ErrorCode::malformed || code == ErrorCode::unsupported ||
                code == ErrorCode::too_large)
        << file.error().text;
  }
  // A flipped bit behind the header never passes: zstd's checksum.
  for (std::size_t i = 6; i < bytes->size(); ++i) {
    std::vector<std::uint8_t> damaged = *bytes;
    damaged[i] ^= 0x10;
    const auto file = io::unpack_bytes(damaged);
    EXPECT_FALSE(file.ok() && file->code != io::unpack_bytes(*bytes)->code) << i;
  }
}

TEST(PackFiles, AreNoBombs) {
  // A frame that says that it grows to a terabyte.
  std::vector<std::uint8_t> bytes{'m', 'p', 'k', 1, 0, 0, 0x28, 0xB5, 0x2F, 0xFD, 0xE0,
                                  0,   0,   0,   0, 0, 1, 0,    0,    1,    0,    0};
  const auto file = io::unpack_bytes(bytes);
  ASSERT_FALSE(file.ok());
  EXPECT_TRUE(file.error().code == ErrorCode::too_large ||
              file.error().code == ErrorCode::malformed);
  // Data that would compress too well is stored uncompressed, and is restored.
  io::PackFile large;
  large.code[1].assign(50'000'000, 0);
  const auto packed = io::pack_bytes(large);
  ASSERT_TRUE(packed.ok());
  const auto back = io::unpack_bytes(*packed);
  ASSERT_TRUE(back.ok()) << back.error().text;
  EXPECT_EQ(back->code, large.code);
}

}  // namespace
}  // namespace medial
