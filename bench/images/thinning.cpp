// Times thinning and distances of binary images (PBM) on one thread; compare.py reads what it
// prints.
//
//   medial_bench_images FAMILY ROUNDS IMAGE.pbm [RESULT.pbm]
//
// FAMILY is one of the brushfire's. Prints the least seconds of processor time of all rounds, for
// thinning and for the exact distances, and how many bytes the peak memory
// is above what was held before.

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "medial/io/read.h"
#include "medial/io/write.h"
#include "medial/raster.h"

namespace {

/// Seconds of processor time since `start`, another result of std::clock().
double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The largest memory this program has held, in bytes. (That of getrusage() is the caller's, where
/// it was larger, if this process was started by vfork().)
long peak_bytes() {
  long kilobytes = 0;
  if (std::FILE* file = std::fopen("/proc/self/status", "r")) {
    char line[256];
    while (std::fgets(line, sizeof line, file) != nullptr)
      if (std::sscanf(line, "VmHWM: %ld", &kilobytes) == 1) break;
    std::fclose(file);
  }
  return kilobytes * 1024L;
}

/// The memory this process holds now, in bytes.
long held_bytes() {
  long pages = 0, resident = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%ld %ld", &pages, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return resident * sysconf(_SC_PAGESIZE);
}

}  // namespace

int main(int count, char** words) {
  if (count < 4) return 2;
  const std::string what = words[1];
  const auto file = medial::io::read_image(words[3]);
  if (!file) {
    std::fprintf(stderr, "%s\n", medial::to_string(file.error()).c_str());
    return 2;
  }
  medial::DistanceOptions distances;
  distances.threads = 1;
  medial::BrushfireOptions fire;
  if (const auto family = medial::brushfire_from(what)) fire.family = *family;
  double thinning = 0, measuring = 0;
  const long before = held_bytes();
  for (int round = 0; round < std::atoi(words[2]); ++round) {
    if (what != "distance") {
      const auto start = std::clock();
      const auto axis = medial::thin(file->image, fire);
      if (!axis) return 2;
      const double seconds = seconds_since(start);
      thinning = round == 0 ? seconds : std::min(thinning, seconds);
    }
    const auto start = std::clock();
    if (!medial::distance_transform(file->image, distances)) return 2;
    const double seconds = seconds_since(start);
    measuring = round == 0 ? seconds : std::min(measuring, seconds);
  }
  std::printf("%.9g %.9g %ld\n", thinning, measuring, peak_bytes() - before);
  if (what != "distance" && count > 4) {
    const auto axis = medial::thin(file->image, fire);
    if (!axis || !medial::io::write_image(words[4], {}, *axis, *file)) return 2;
  }
}
