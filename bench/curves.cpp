// medial_bench_curves: free-form boundaries to arcs, one thread: time per arc, number of arcs and
// certified error for tolerances from 1e-2 to 1e-9. Prints Markdown.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "clock.h"
#include "medial/contour.h"

namespace {

using namespace medial;

/// A closed uniform cubic spline like the outline of a leafy tree or a snowflake: `lobes` lobes
/// with smaller ones on them.
Contour star(int points, int lobes) {
  std::vector<Vec2> control;
  for (int i = 0; i < points + 3; ++i) {
    const double angle = 2 * std::numbers::pi * (i % points) / points;
    const double r = 1 + 0.3 * std::sin(lobes * angle) + 0.1 * std::cos(7 * lobes * angle);
    control.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  std::vector<double> knots(control.size() + 4);
  for (std::size_t i = 0; i < knots.size(); ++i) knots[i] = static_cast<double>(i);
  Contour contour;
  (void)contour.spline_to(3, knots, control);
  return contour;
}

/// Rounded letters O: two ellipses each.
std::vector<Contour> letters(int count) {
  std::vector<Contour> contours;
  for (int i = 0; i < count; ++i) {
    for (double size : {1.0, 0.6}) {
      Contour contour;
      contour.ellipse_to({2.5 * i, 0}, {size, 0}, {0, 1.4 * size}, 0.5, 0.5 + 2 * std::numbers::pi);
      contours.push_back(contour);
    }
  }
  return contours;
}

void measure(const char* name, const std::vector<Contour>& contours) {
  for (double tolerance = 1e-2; tolerance > 0.5e-9; tolerance /= 10) {
    ArcOptions options;
    options.tolerance = tolerance;
    options.threads = 1;
    ArcReport report;
    double best = 1e300;
    for (int round = 0; round < 5; ++round) {
      const double begin = bench::processor_seconds();
      const auto rings = approximate_by_arcs(contours, options, &report);
      if (!rings) return;
      best = std::min(best, bench::processor_seconds() - begin);
    }
    const auto arcs = static_cast<double>(report.arcs + report.segments);
    std::printf("| %s | %.0e | %.0f | %.3f | %.3f | %.2e |\n", name, tolerance, arcs, 1e3 * best,
                1e6 * best / arcs, report.largest_error);
  }
}

}  // namespace

int main() {
  std::puts("| shape | tolerance | arcs | milliseconds | microseconds an arc | certified error |");
  std::puts("| --- | ---: | ---: | ---: | ---: | ---: |");
  measure("tree, 20,000 cubics", {star(20000, 100)});
  measure("snowflake, 600 cubics", {star(600, 6)});
  measure("lettering, 500 ellipses", letters(250));
}
