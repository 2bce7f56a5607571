#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial/document.h"
#include "medial/error.h"
#include "medial/image.h"
#include "medial/pack.h"

namespace medial::io {

/// What a pack holds.
enum class PackKind : std::uint8_t { axes, squares };

/// A pack: a code, and what its picture needs. docs/pack.md describes the bytes.
struct PackFile {
  PackKind kind = PackKind::axes;
  ShapeCode code;
  std::string crs_wkt;
  bool y_down = false;
};

/// The streams of a code compressed by zstd, one frame for all or one for each, whichever is
/// shorter. Errors: internal.
Result<std::vector<std::uint8_t>> pack_bytes(const PackFile& file);
/// Errors: malformed (a wrong checksum included), unsupported (another version), too_large. Memory
/// at most 256 times that of the bytes, and 64 KiB.
Result<PackFile> unpack_bytes(std::span<const std::uint8_t> bytes);

/// Writes never a partial file; `-` is standard output. Errors: unwritable.
Status write_pack(const std::string& path, const std::vector<std::uint8_t>& bytes);
/// `-` is standard input. Errors: unreadable, malformed, unsupported, too_large.
Result<PackFile> read_pack(const std::string& path);

/// The shapes and axes of a pack of axes: each shape is what its disks cover. `notes` (may be null)
/// names the shapes that could not be built: those stay without points. Errors: malformed,
/// unsupported.
Result<Document<AxisItem>> native_of(const PackFile& file,
                                     std::vector<std::string>* notes = nullptr);

/// How many bytes zstd makes of a text or of a code, each at the level that packs have: to compare.
std::size_t compressed_size(std::span<const std::uint8_t> bytes);
std::size_t compressed_size(const ShapeCode& code);

}  // namespace medial::io
