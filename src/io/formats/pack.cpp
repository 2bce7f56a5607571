#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <new>
#include <optional>

#include "io/formats/json.h"
#include "io/guarded.h"
#include "io/text_source.h"
#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/sides.h"
#include "ops/code_bytes.h"

namespace medial::io {

namespace {

using ops::ByteReader;
using ops::Bytes;

// A file: magic, version, kind and flags, a byte each; the name of the unit; then the frames. Text
// and streams stand before their bytes with their lengths.
constexpr std::array<std::uint8_t, 3> magic{'m', 'p', 'k'};
constexpr std::uint8_t code_version = 1;
constexpr std::uint8_t down_bit = 1, crs_bit = 2, apart_bit = 4, stored_bit = 8, unit_bit = 16;
constexpr int level = 19;

/// No frame may grow by more: what does is stored as it is.
constexpr std::size_t most_ratio = 256, always = 65536;

Error malformed(const char* text) { return {ErrorCode::malformed, text, {}}; }

/// A zstd frame with a checksum; nothing where zstd fails.
Bytes compressed(std::span<const std::uint8_t> bytes) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                     &ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  Bytes out(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress2(context.get(), out.data(), out.size(), bytes.data(), bytes.size());
  out.resize(ZSTD_isError(size) != 0 ? 0 : size);
  return out;
}

Result<Bytes> expanded(std::span<const std::uint8_t> frame) {
  const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN)
    return malformed("the pack holds no zstd frame of known size");
  if (size > always + most_ratio * frame.size())
    return Error{ErrorCode::too_large, "the pack would grow too large", {}};
  Bytes out(static_cast<std::size_t>(size));
  const std::size_t got = ZSTD_decompress(out.data(), out.size(), frame.data(), frame.size());
  if (ZSTD_isError(got) != 0 || got != out.size())
    return malformed("the pack is damaged: its checksum is wrong");
  return out;
}

void append(Bytes& out, std::span<const std::uint8_t> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

/// Takes bytes that stand behind their length off the rest; nothing where that is too short.
std::optional<std::span<const std::uint8_t>> take(std::span<const std::uint8_t>& rest) {
  ByteReader reader(rest);
  const auto size = reader.number();
  if (!size || *size > reader.left()) return std::nullopt;
  const auto length = static_cast<std::size_t>(*size);
  const auto taken = rest.subspan(rest.size() - reader.left(), length);
  rest = rest.last(reader.left() - length);
  return taken;
}

/// The streams as one, each but the last behind its length.
Bytes together(const ShapeCode& code) {
  Bytes all;
  for (std::size_t i = 0; i + 1 < code.size(); ++i) ops::put_number(all, code[i].size());
  for (const Bytes& stream : code) append(all, stream);
  return all;
}

/// Cuts streams out of bytes by their lengths. False where they do not fit.
bool cut(std::span<const std::uint8_t> all, ShapeCode& code) {
  ByteReader reader(all);
  std::array<std::size_t, code_streams> size{};
  for (std::size_t i = 0; i + 1 < code.size(); ++i) {
    const auto length = reader.number();
    if (!length || *length > all.size()) return false;
    size[i] = static_cast<std::size_t>(*length);
  }
  std::span<const std::uint8_t> rest = all.last(reader.left());
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (i + 1 == code.size()) size[i] = rest.size();
    if (size[i] > rest.size()) return false;
    code[i].assign(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(size[i]));
    rest = rest.subspan(size[i]);
  }
  return true;
}

struct Body {
  Bytes bytes;
  std::uint8_t flags = 0;
};

/// The shorter of both ways.
Body body_of(const ShapeCode& code) {
  const Bytes whole = together(code);
  Body one{compressed(whole), 0};
  const bool failed = one.bytes.empty() || whole.size() > always + most_ratio * one.bytes.size();
  if (failed || whole.size() <= one.bytes.size()) one = {whole, stored_bit};
  if (one.flags == stored_bit && !failed) return one;
  Body apart{{}, apart_bit};
  for (const Bytes& stream : code) {
    const Bytes frame = compressed(stream);
    if (frame.empty() || stream.size() > always + most_ratio * frame.size()) return one;
    ops::put_number(apart.bytes, frame.size());
    append(apart.bytes, frame);
  }
  return apart.bytes.size() < one.bytes.size() ? apart : one;
}

}  // namespace

std::size_t compressed_size(std::span<const std::uint8_t> bytes) {
  return std::min(compressed(bytes).size(), bytes.size());
}

std::size_t compressed_size(const ShapeCode& code) { return body_of(code).bytes.size(); }

Result<std::vector<std::uint8_t>> pack_bytes(const PackFile& file) {
  return guarded({}, [&]() -> Result<Bytes> {
    Body body = body_of(file.code);
    Bytes out(magic.begin(), magic.end());
    out.push_back(code_version);
    out.push_back(static_cast<std::uint8_t>(file.kind));
    body.flags = static_cast<std::uint8_t>(body.flags | (file.y_down ? down_bit : 0) |
                                           (file.crs_wkt.empty() ? 0 : crs_bit) |
                                           (file.unit == Unit::unknown ? 0 : unit_bit));
    out.push_back(body.flags);
    if (file.unit != Unit::unknown) {
      const std::string_view unit = name_of(file.unit);
      ops::put_number(out, unit.size());
      out.insert(out.end(), unit.begin(), unit.end());
    }
    if (!file.crs_wkt.empty()) {
      const Bytes crs = compressed(
          {reinterpret_cast<const std::uint8_t*>(file.crs_wkt.data()), file.crs_wkt.size()});
      ops::put_number(out, crs.size());
      append(out, crs);
    }
    append(out, body.bytes);
    return out;
  });
}

Result<PackFile> unpack_bytes(std::span<const std::uint8_t> bytes) {
  return guarded({}, [&]() -> Result<PackFile> {
    constexpr std::size_t header = magic.size() + 3;
    if (bytes.size() < header || !std::equal(magic.begin(), magic.end(), bytes.begin()))
      return malformed("this is not a pack");
    if (bytes[3] != code_version)
      return Error{ErrorCode::unsupported, fmt::format("a pack of version {}", bytes[3]), {}};
    if (bytes[4] > static_cast<std::uint8_t>(PackKind::squares))
      return Error{ErrorCode::unsupported, "a pack of another kind", {}};
    PackFile file;
    file.kind = static_cast<PackKind>(bytes[4]);
    const std::uint8_t flags = bytes[5];
    file.y_down = (flags & down_bit) != 0;
    std::span<const std::uint8_t> rest = bytes.subspan(header);
    const auto next_frame = [&rest]() -> Result<Bytes> {
      const auto frame = take(rest);
      return frame ? expanded(*frame) : malformed("the pack ends early");
    };
    if ((flags & unit_bit) != 0) {
      const auto name = take(rest);
      const auto unit =
          name ? stored_unit({reinterpret_cast<const char*>(name->data()), name->size()})
               : std::nullopt;
      if (!unit) return malformed("the pack's unit is not known");
      file.unit = *unit;
    }
    if ((flags & crs_bit) != 0) {
      auto crs = next_frame();
      if (!crs) return std::move(crs).error();
      file.crs_wkt.assign(crs->begin(), crs->end());
    }
    if ((flags & apart_bit) != 0) {
      for (Bytes& stream : file.code) {
        auto expanded_stream = next_frame();
        if (!expanded_stream) return std::move(expanded_stream).error();
        stream = std::move(expanded_stream).value();
      }
      if (!rest.empty()) return malformed("the pack does not end with its last stream");
      return file;
    }
    Bytes whole;
    if ((flags & stored_bit) != 0) {
      whole.assign(rest.begin(), rest.end());
    } else {
      auto frame = expanded(rest);
      if (!frame) return std::move(frame).error();
      whole = std::move(frame).value();
    }
    if (!cut(whole, file.code)) return malformed("the pack's streams are longer than the pack");
    return file;
  });
}

Status write_pack(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  return write_text(path, {bytes.begin(), bytes.end()});
}

Result<PackFile> read_pack(const std::string& path) {
  const TextSource::Reading reading(path);
  return guarded(path, [&]() -> Result<PackFile> {
    constexpr std::size_t longest_pack = std::size_t{1} << 32U;
    Result<std::shared_ptr<TextSource>> source = TextSource::open(path);
    if (!source) return source.error();
    std::string text;
    (*source)->read_all(text, longest_pack);
    if ((*source)->failure()) return *(*source)->failure();
    return unpack_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  });
}

Result<Document<AxisItem>> native_of(const PackFile& file, std::vector<std::string>* notes) {
  auto axes = decode_axes(file.code);
  if (!axes) return std::move(axes).error();
  Document<AxisItem> native{file, {}};
  for (MedialAxis& axis : *axes) {
    AxisItem& item = native.items.emplace_back();
    auto shape = rebuild(axis);
    if (shape) {
      item.shape = std::move(shape).value();
    } else if (notes != nullptr) {
      notes->push_back(fmt::format("the boundary of shape {} could not be built: {}",
                                   native.items.size() - 1, shape.error().text));
    }
    item.axis = std::move(axis);
  }
  return native;
}

}  // namespace medial::io
