#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "base/threads.h"

namespace medial {

/// Asks the system to back an array that nobody has touched yet with large pages, if it is large:
/// it then takes a fraction of the time to fill for the first time. Advice only.
void prefer_large_pages(const void* begin, std::size_t bytes);

/// Informs the system that the content of an array is not needed any more: its pages can be used
/// for other arrays before it is freed, and where the allocator would keep it. Advice only; the
/// content is lost.
void give_back_pages(void* begin, std::size_t bytes);

/// Makes the system provide the pages of unused memory now. Of a vector, that lies beyond its size.
void touch_pages(void* begin, std::size_t bytes);

/// The same on all threads, of reserved elements: the system clears memory on the thread that
/// touches it first.
template <class T, class Allocator>
void touch_in_parallel(std::vector<T, Allocator>& elements, std::size_t begin, std::size_t end) {
  constexpr std::size_t grain = (std::size_t{1} << 18) / sizeof(T);
  parallel_ranges(end - begin, grain, [&](std::size_t from, std::size_t to) {
    touch_pages(elements.data() + begin + from, (to - from) * sizeof(T));
  });
}

/// reserve(), with large pages.
template <class T>
void reserve_large(std::vector<T>& elements, std::size_t count) {
  elements.reserve(count);
  prefer_large_pages(elements.data(), count * sizeof(T));
}

/// Frees all memory of a vector: to assign {} only clears it.
template <class T, class Allocator>
void free_memory(std::vector<T, Allocator>& elements) {
  std::vector<T, Allocator>().swap(elements);
}

/// Asks for large pages, and gives those of large arrays back as they are freed: smaller ones are
/// used again sooner than the system could clear others.
template <class T>
struct WorkAllocator : std::allocator<T> {
  using std::allocator<T>::allocator;
  template <class Other>
  struct rebind {
    using other = WorkAllocator<Other>;
  };
  T* allocate(std::size_t count) {
    T* const begin = std::allocator<T>::allocate(count);
    prefer_large_pages(begin, count * sizeof(T));
    return begin;
  }
  void deallocate(T* begin, std::size_t count) {
    constexpr std::size_t large = std::size_t{1} << 23;
    if (count * sizeof(T) >= large) give_back_pages(begin, count * sizeof(T));
    std::allocator<T>::deallocate(begin, count);
  }
};

/// A vector that is freed before the result is whole. An ordinary one would leave its memory with
/// the allocator, and the result would need more in addition.
template <class T>
using WorkVector = std::vector<T, WorkAllocator<T>>;

/// A vector of `count` equal elements, with large pages.
template <class T>
std::vector<T> large_vector(std::size_t count, const T& value = {}) {
  std::vector<T> elements;
  reserve_large(elements, count);
  elements.assign(count, value);
  return elements;
}

}  // namespace medial
