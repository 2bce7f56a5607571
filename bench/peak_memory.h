#pragma once

#include <algorithm>
#include <fstream>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace medial::bench {

/// The peak of resident memory from here on, above the memory that is resident now. Linux only;
/// elsewhere 0.
class PeakMemory {
 public:
  PeakMemory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    before_ = status_bytes("VmRSS");
    std::ofstream("/proc/self/clear_refs") << "5";  // sets VmHWM back to VmRSS
  }
  double bytes() const { return std::max(0.0, status_bytes("VmHWM") - before_); }

 private:
  /// A line of /proc/self/status in bytes.
  static double status_bytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
      if (line.rfind(key + ":", 0) == 0) return 1024 * std::stod(line.substr(key.size() + 1));
    return 0;
  }

  double before_ = 0;
};

}  // namespace medial::bench
