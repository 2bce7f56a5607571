#pragma once

#include <ctime>

namespace medial::bench {

/// Seconds of processor time of this process, all threads together. On an idle machine this is what
/// a clock on the wall shows for one thread; on a busy one it leaves out the others' share.
inline double processor_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double wall_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace medial::bench
