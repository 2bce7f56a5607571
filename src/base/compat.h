#pragma once

// Parts of C++20 that the core uses and that libc++ 13 (emscripten 3.1, clang 14) or 32-bit targets
// lack.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <version>

#ifdef __cpp_lib_to_chars
#include <charconv>
#endif

namespace medial {

/// std::bit_cast
template <class To, class From>
constexpr To bit_cast(const From& value) {
  return __builtin_bit_cast(To, value);
}

/// std::make_unique_for_overwrite for arrays: elements without initial values.
template <class Array>
std::unique_ptr<Array> uninitialized(std::size_t count) {
  return std::unique_ptr<Array>(new std::remove_extent_t<Array>[count]);
}

/// The elements between two iterators of an array.
template <class Iterator>
auto span_between(Iterator first, Iterator last) {
  return std::span(std::to_address(first), static_cast<std::size_t>(last - first));
}

/// The shortest digits that read back as the same number.
inline std::string shortest_text(double value) {
  std::array<char, 32> digits;
#ifdef __cpp_lib_to_chars
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return std::string(digits.data(), written.ptr);
#else
  for (int precision = 15; precision <= 17; ++precision) {
    std::snprintf(digits.data(), digits.size(), "%.*g", precision, value);
    if (std::strtod(digits.data(), nullptr) == value) break;
  }
  return digits.data();
#endif
}

#ifdef __cpp_lib_ranges
namespace ranges = std::ranges;
#else
/// The algorithms of std::ranges that the core uses.
namespace ranges {

template <class Range, class Predicate>
bool any_of(Range&& range, Predicate predicate) {
  return std::any_of(std::begin(range), std::end(range), predicate);
}
template <class Range, class Predicate>
bool all_of(Range&& range, Predicate predicate) {
  return std::all_of(std::begin(range), std::end(range), predicate);
}
template <class Range, class Predicate>
bool none_of(Range&& range, Predicate predicate) {
  return std::none_of(std::begin(range), std::end(range), predicate);
}
template <class Range, class Predicate>
auto find_if(Range&& range, Predicate predicate) {
  return std::find_if(std::begin(range), std::end(range), predicate);
}
template <class Range, class Predicate>
auto find_if_not(Range&& range, Predicate predicate) {
  return std::find_if_not(std::begin(range), std::end(range), predicate);
}
template <class Range>
void reverse(Range&& range) {
  std::reverse(std::begin(range), std::end(range));
}
template <class Range, class Out>
void copy(Range&& range, Out out) {
  std::copy(std::begin(range), std::end(range), out);
}

/// Compares two elements by their keys.
template <class Less, class Key>
auto by_key(Less less, Key key) {
  return [less, key](const auto& a, const auto& b) {
    return less(std::invoke(key, a), std::invoke(key, b));
  };
}
template <class Range, class Less = std::less<>, class Key = std::identity>
void sort(Range&& range, Less less = {}, Key key = {}) {
  std::sort(std::begin(range), std::end(range), by_key(less, key));
}
template <class Range, class Less = std::less<>, class Key = std::identity>
void stable_sort(Range&& range, Less less = {}, Key key = {}) {
  std::stable_sort(std::begin(range), std::end(range), by_key(less, key));
}
template <class Range, class Less = std::less<>, class Key = std::identity>
auto max_element(Range&& range, Less less = {}, Key key = {}) {
  return std::max_element(std::begin(range), std::end(range), by_key(less, key));
}
template <class Range, class Less = std::less<> >
void push_heap(Range&& range, Less less = {}) {
  std::push_heap(std::begin(range), std::end(range), less);
}
template <class Range, class Less = std::less<> >
void pop_heap(Range&& range, Less less = {}) {
  std::pop_heap(std::begin(range), std::end(range), less);
}
template <class Range, class Value, class Less = std::less<>, class Key = std::identity>
auto lower_bound(Range&& range, const Value& value, Less less = {}, Key key = {}) {
  return std::lower_bound(
      std::begin(range), std::end(range), value,
      [&](const auto& element, const Value& v) { return less(std::invoke(key, element), v); });
}
template <class Range, class Value, class Less = std::less<>, class Key = std::identity>
bool binary_search(Range&& range, const Value& value, Less less = {}, Key key = {}) {
  const auto found = ranges::lower_bound(range, value, less, key);
  return found != std::end(range) && !less(value, std::invoke(key, *found));
}

}  // namespace ranges
#endif

}  // namespace medial
