#pragma once

#include <cstddef>
#include <vector>

namespace medial {

/// Asks the system to back an array that nobody has touched yet with large pages, if it is large:
/// it then takes a fraction of the time to fill for the first time. Advice only.
void prefer_large_pages(const void* begin, std::size_t bytes);

/// Informs the system that the content of an array is not needed any more: its pages can be used
/// for other arrays before it is freed, and where the allocator would keep it. Advice only; the
/// content is lost.
void give_back_pages(void* begin, std::size_t bytes);

/// reserve(), with large pages.
template <class T>
void reserve_large(std::vector<T>& elements, std::size_t count) {
  elements.reserve(count);
  prefer_large_pages(elements.data(), count * sizeof(T));
}

/// Frees all memory of a vector: to assign {} only clears it.
template <class T>
void free_memory(std::vector<T>& elements) {
  std::vector<T>().swap(elements);
}

/// A vector of `count` equal elements, with large pages.
template <class T>
std::vector<T> large_vector(std::size_t count, const T& value = {}) {
  std::vector<T> elements;
  reserve_large(elements, count);
  elements.assign(count, value);
  return elements;
}

}  // namespace medial
