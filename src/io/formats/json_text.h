#pragma once

// JSON written number by number: through a library's objects it takes several times as long.

#include <cmath>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/format.h"
#include "medial/document.h"

namespace medial::io {

/// A value; null for a number that is not finite. Texts become JSON strings, enumerations numbers.
template <class V>
void put_json(OutputStream& out, const V& value) {
  if constexpr (std::is_same_v<V, double>) {
    std::isfinite(value) ? out.put(value) : out.put("null");
  } else if constexpr (std::is_same_v<V, bool>) {
    out.put(value ? "true" : "false");
  } else if constexpr (std::is_enum_v<V>) {
    out.put(static_cast<std::uint32_t>(value));
  } else if constexpr (std::is_integral_v<V>) {
    out.put(value);
  } else {
    put_quoted(out, std::string_view(value));
  }
}

/// `before` as it is, then the value: such as ,"length":2.5
template <class V>
void put_member(OutputStream& out, std::string_view before, const V& value) {
  out.put(before);
  put_json(out, value);
}

/// Several members of one type: ,"x":1,"y":2
template <class V>
void put_members(OutputStream& out, std::initializer_list<std::pair<std::string_view, V>> members) {
  for (const auto& [name, value] : members) {
    out.put(",\"");
    out.put(name);
    put_member(out, "\":", value);
  }
}

/// Finite numbers in brackets: [1,2.5,3].
template <class... Values>
void put_row(OutputStream& out, Values... values) {
  char separator = '[';
  const auto one = [&](auto value) {
    out.put(separator);
    separator = ',';
    if constexpr (std::is_enum_v<decltype(value)>) {
      out.put(static_cast<std::uint32_t>(value));
    } else {
      out.put(value);
    }
  };
  (one(values), ...);
  out.put(']');
}

/// Brackets around what put(element) writes for each element, with `between` between, and `first`
/// in front where there is any.
template <class Range, class Put>
void put_list(OutputStream& out, const Range& range, const Put& put, std::string_view first = "",
              std::string_view between = ",") {
  out.put('[');
  std::string_view separator = first;
  for (const auto& element : range) {
    out.put(separator);
    separator = between;
    put(element);
  }
  out.put(']');
}

/// The same, an element per line.
template <class Range, class Put>
void put_lines(OutputStream& out, const Range& range, const Put& put) {
  put_list(out, range, put, "\n", ",\n");
}

/// 0 to count - 1, to be put with put_lines(). (clang 14 cannot read std::views::iota of g++ 12.)
inline std::vector<std::size_t> numbers_below(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

/// The items of a document, and the end of its file; or a part of them.
template <class Range, class Put>
void put_items(OutputStream& out, const Part& part, const Range& items, const Put& put) {
  if (part.begins) out.put('[');
  std::string_view separator = part.begins ? "\n" : ",\n";
  for (const auto& item : items) {
    out.put(separator);
    separator = ",\n";
    put(item);
  }
  if (part.ends) out.put("\n]}\n");
}
template <class Range, class Put>
void put_items(OutputStream& out, const Range& items, const Put& put) {
  put_items(out, Part{}, items, put);
}

inline void put_attributes(OutputStream& out, const Attributes& attributes) {
  put_list(out, attributes, [&](const auto& attribute) {
    out.put('[');
    put_quoted(out, attribute.first);
    out.put(',');
    put_quoted(out, attribute.second);
    out.put(']');
  });
}

}  // namespace medial::io
