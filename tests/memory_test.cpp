// Memory of work that is freed while the result is under way.

#include <gtest/gtest.h>

#ifdef __GLIBC__
#include <malloc.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>
#include <vector>

#include "base/memory.h"

namespace medial {
namespace {

std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(WorkMemory, GoesBackWhereTheAllocatorWouldKeepIt) {
#ifdef MEDIAL_SANITIZED
  GTEST_SKIP() << "sanitizers have an allocator of their own";
#endif
  constexpr std::size_t bytes = 24 << 20, most_left = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // as it is once an array of that size has been freed
  WorkVector<char> work(bytes, 'a');
  const std::vector<char> above(1 << 16, 'a');  // keeps the heap from shrinking
  const std::size_t before = resident_bytes();
  free_memory(work);
  EXPECT_LE(resident_bytes(), before - bytes + most_left);
  EXPECT_EQ(above.back(), 'a');
}

}  // namespace
}  // namespace medial
#endif
