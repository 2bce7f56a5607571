// The steps that compare.py times in Python, in C++: the shape of coordinates, and its axis.
//
//   medial_python_steps POINTS    pairs of doubles; each line of standard input asks for a run
//
// Prints the processor time of each step, in seconds, and the length of the axis.

#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "medial/medial.h"

namespace {

double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  std::ifstream file(arguments[1], std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const auto* const first = reinterpret_cast<const medial::Vec2*>(bytes.data());
  const std::span<const medial::Vec2> points(first, bytes.size() / sizeof(medial::Vec2));
  medial::Options options;
  options.threads = 1;
  for (std::string line; std::getline(std::cin, line);) {
    const double begin = processor_time();
    const medial::Ring ring{{points.begin(), points.end()}, medial::RingRole::any, {}};
    const auto shape = medial::build_shape({&ring, 1});
    const double built = processor_time();
    if (!shape) return 2;
    const auto axis = medial::compute(*shape, options);
    const double computed = processor_time();
    if (!axis) return 2;
    std::printf("%.9f %.9f %.17g\n", built - begin, computed - built, medial::total_length(*axis));
    std::fflush(stdout);
  }
}
