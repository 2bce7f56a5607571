#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "base/threads.h"

namespace medial {

/// Advises the system to back a large, untouched array by large pages, which makes the first writes
/// several times faster.
void prefer_large_pages(const void* begin, std::size_t bytes);

/// Advises the system that the content of an array is no longer needed, and loses the content.
/// Other arrays can use the pages even before the array is freed, or if the allocator would keep
/// them.
void give_back_pages(void* begin, std::size_t bytes);

/// Makes the system provide the pages of unused memory now, such as a vector's reserved memory.
void touch_pages(void* begin, std::size_t bytes);

/// The same for reserved elements, on all threads: the system clears memory on the thread that
/// first touches it.
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

/// Frees the memory of a vector; assigning {} would only clear it.
template <class T, class Allocator>
void free_memory(std::vector<T, Allocator>& elements) {
  std::vector<T, Allocator>().swap(elements);
}

/// An allocator that asks for large pages and returns those of large arrays to the system. Small
/// arrays are reused, which is faster than clearing new pages.
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

/// A vector that is freed before the result is complete. The allocator would keep the memory of a
/// std::vector, so the result would need additional memory.
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
