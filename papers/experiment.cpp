#include "papers/experiment.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "medial/io/write.h"

namespace medial::papers {
namespace {

/// Sums of squares and products about the means.
struct Moments {
  explicit Moments(const Points& points) {
    double x = 0, y = 0;
    const auto n = static_cast<double>(points.size());
    for (const auto& [a, b] : points) {
      x += a / n;
      y += b / n;
    }
    for (const auto& [a, b] : points) {
      xx += (a - x) * (a - x);
      xy += (a - x) * (b - y);
      yy += (b - y) * (b - y);
    }
  }
  double xx = 0, xy = 0, yy = 0;
};

}  // namespace

void progress(const std::string& what) {
  if (isatty(STDERR_FILENO) != 0) fmt::print(stderr, "{}\n", what);
}

Status write(const Request& request, const std::string& name, const std::string& text) {
  return io::write_text((request.to / name).string(), text);
}

double fitted_exponent(const Points& points) {
  Points logarithms;
  for (const auto& [x, y] : points) logarithms.emplace_back(std::log(x), std::log(y));
  const Moments moments(logarithms);
  return moments.xy / moments.xx;
}

double correlation(const Points& points) {
  const Moments moments(points);
  return moments.xy / std::sqrt(moments.xx * moments.yy);
}

}  // namespace medial::papers
