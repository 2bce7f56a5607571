#pragma once

// Variable-length integers: seven bits per byte, low bits first; the eighth bit marks that more
// bytes follow.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace medial::ops {

using Bytes = std::vector<std::uint8_t>;

inline void put_number(Bytes& out, std::uint64_t value) {
  constexpr std::uint64_t more = 0x80;
  while (value >= more) {
    out.push_back(static_cast<std::uint8_t>(value | more));
    value >>= 7U;
  }
  out.push_back(static_cast<std::uint8_t>(value));
}

/// Zigzag encoding: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
inline void put_signed(Bytes& out, std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  put_number(out, (bits << 1U) ^ (value < 0 ? ~std::uint64_t{0} : 0));
}

/// Reads encoded numbers. Returns nothing if the bytes run out or encode no number.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size() - at_; }
  std::optional<std::uint8_t> byte() {
    if (at_ == bytes_.size()) return std::nullopt;
    return bytes_[at_++];
  }
  std::optional<std::uint64_t> number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      if (at_ == bytes_.size()) return std::nullopt;
      const std::uint64_t byte = bytes_[at_++];
      if (shift == 63 && byte > 1) return std::nullopt;
      value |= (byte & 0x7FU) << shift;
      if (byte < 0x80U) return value;
    }
    return std::nullopt;
  }
  std::optional<std::int64_t> signed_number() {
    const auto bits = number();
    if (!bits) return std::nullopt;
    return static_cast<std::int64_t>((*bits >> 1U) ^ ((*bits & 1U) != 0 ? ~std::uint64_t{0} : 0));
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace medial::ops
