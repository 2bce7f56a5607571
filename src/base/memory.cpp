#include "base/memory.h"

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace medial {

#if defined(__linux__)

namespace {

/// Calls madvise() for the whole pages of an array.
void advise(const void* begin, std::size_t bytes, int advice) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + page - 1) / page * page;
  const std::uintptr_t last = (address + bytes) / page * page;
  if (first >= last) return;
  void* const whole_pages = const_cast<char*>(static_cast<const char*>(begin)) + (first - address);
  // The advice may be ignored.
  static_cast<void>(::madvise(whole_pages, last - first, advice));
}

}  // namespace

void prefer_large_pages(const void* begin, std::size_t bytes) {
  constexpr std::size_t large = std::size_t{1} << 22;  // room for at least one page of 2 MiB
  if (bytes >= large) advise(begin, bytes, MADV_HUGEPAGE);
}

void give_back_pages(void* begin, std::size_t bytes) {
  constexpr std::size_t large = std::size_t{1} << 16;
  if (bytes >= large) advise(begin, bytes, MADV_DONTNEED);
}

#else

void prefer_large_pages(const void*, std::size_t) {}
void give_back_pages(void*, std::size_t) {}

#endif

void touch_pages(void* begin, std::size_t bytes) {
  constexpr std::size_t page = 4096;
  auto* const byte = static_cast<volatile char*>(begin);
  for (std::size_t i = 0; i < bytes; i += page) byte[i] = 0;
}

}  // namespace medial
