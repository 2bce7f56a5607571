#pragma once

#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "medial/shape.h"

namespace medial::test {

/// Reads a POLYGON or MULTIPOLYGON, EMPTY included, into rings with roles; nullopt if the text is
/// anything else. Just enough for tests: medial::io has the real reader.
class WktParser {
 public:
  explicit WktParser(std::string_view text) : rest_(text) {}

  std::optional<std::vector<Ring>> parse() {
    const bool multi = take_word("MULTIPOLYGON");
    if (!multi && !take_word("POLYGON")) return std::nullopt;
    const bool read =
        take_word("EMPTY") || (multi ? list([this] { return polygon(); }) : polygon());
    skip_space();
    if (!read || !rest_.empty()) return std::nullopt;
    return std::move(rings_);
  }

 private:
  void skip_space() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_[0]))) {
      rest_.remove_prefix(1);
    }
  }
  bool take_word(std::string_view word) {
    skip_space();
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  template <class Item>
  bool list(Item item) {
    if (!take_word("(")) return false;
    do {
      if (!item()) return false;
    } while (take_word(","));
    return take_word(")");
  }
  std::optional<double> number() {
    skip_space();
    double value = 0;
    const auto read = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (read.ec != std::errc{}) return std::nullopt;
    rest_.remove_prefix(static_cast<std::size_t>(read.ptr - rest_.data()));
    return value;
  }
  bool polygon() {
    if (take_word("EMPTY")) return true;
    RingRole role = RingRole::outer;
    return list([&] {
      Ring ring{.points = {}, .role = role};
      role = RingRole::hole;
      const bool read = take_word("EMPTY") || list([&] {
                          const auto x = number();
                          const auto y = number();
                          if (!x || !y) return false;
                          ring.points.push_back({*x, *y});
                          return true;
                        });
      rings_.push_back(std::move(ring));
      return read;
    });
  }

  std::string_view rest_;
  std::vector<Ring> rings_;
};

inline std::optional<std::vector<Ring>> rings_of_wkt(std::string_view text) {
  return WktParser(text).parse();
}

}  // namespace medial::test
