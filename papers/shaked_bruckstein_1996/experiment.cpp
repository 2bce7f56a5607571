// Shaked and Bruckstein (1996): the method on random smooth curves, beside the exact axis.

#include "papers/shaked_bruckstein_1996/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.h"
#include "medial/medial.h"
#include "methods/curve_axis/curve_axis.h"
#include "papers/shaked_bruckstein_1996/spline.h"
#include "papers/table.h"

namespace medial::papers {

namespace {

double between(Random& random, double low, double high) {
  return low + (high - low) * random.share();
}

/// A spline through points around the origin, at random distances.
Contour star(std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec2> corners;
  const int count = static_cast<int>(between(random, 8, 25));
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count, radius = between(random, 1, 3);
    corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return spline_through(corners, 1e3);
}

/// A spline through a circle with six waves of random phases.
Contour waves(std::uint64_t seed) {
  Random random(seed);
  std::vector<double> phases;
  for (int k = 0; k < 6; ++k) phases.push_back(between(random, 0, 2 * std::numbers::pi));
  std::vector<Vec2> corners;
  constexpr int count = 26;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    double radius = 1;
    for (int k = 2; k <= 7; ++k)
      radius += 0.42 / k * std::cos(k * angle + phases[static_cast<std::size_t>(k - 2)]);
    corners.push_back({4 * radius * std::cos(angle), 4 * radius * std::sin(angle)});
  }
  return spline_through(corners, 1e3);
}

/// A spline through a few points anywhere in a square; many cross themselves.
Contour scribble(std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec2> corners(static_cast<std::size_t>(between(random, 4, 9)));
  for (Vec2& corner : corners) corner = {between(random, 0, 10), between(random, 0, 10)};
  return spline_through(corners, 1e3);
}

struct Tally {
  std::uint64_t curves = 0, first = 0, later = 0, refused = 0, wrong = 0;
  std::uint64_t missing = 0;  ///< leaves and junctions of the exact axis without one here
  double distance = 0;        ///< of a node from the exact axis, a share of the size
};

/// The leaves and junctions of an axis that another one does not have within a distance.
std::uint64_t missing_from(const MedialAxis& other, const MedialAxis& axis, double within) {
  const auto counts = [](NodeKind kind) {
    return kind == NodeKind::leaf || kind == NodeKind::branching;
  };
  std::uint64_t missing = 0;
  for (const Node& node : axis.nodes) {
    const bool found = std::ranges::any_of(other.nodes, [&](const Node& one) {
      return counts(one.kind) && distance(one.disk.center, node.disk.center) <= within;
    });
    if (counts(node.kind) && !found) ++missing;
  }
  return missing;
}

/// Follows one curve and compares it; curves that cross themselves are left out.
void try_curve(const Contour& contour, Tally& tally) {
  const auto rings = approximate_by_arcs({&contour, 1}, {.tolerance = 1e-10});
  const auto shape = rings ? build_shape(*rings) : Result<Shape>(rings.error());
  if (!shape) return;
  ++tally.curves;
  const auto found = compute_curve_axis({&contour, 1});
  const auto exact = compute(*shape);
  if (!found || !exact) {
    ++tally.refused;
    return;
  }
  ++(found->rules.restarts == 0 ? tally.first : tally.later);
  tally.wrong += !verify(*shape, found->axis).passed;
  const Box box = bounding_box(*shape);
  const double size = distance(box.low, box.high);
  tally.missing += missing_from(found->axis, *exact, 1e-5 * size);
  const AxisLocator locator(*exact);
  for (const Node& node : found->axis.nodes)
    tally.distance = std::max(tally.distance, locator.nearest(node.disk.center).distance / size);
}

}  // namespace

Result<bool> run_shaked_bruckstein_1996(const Request& request) {
  Table table({{"curves"},
               {"simple"},
               {"first attempt"},
               {"with smaller steps"},
               {"refused"},
               {"not verified"},
               {"leaves and junctions missing"},
               {"largest distance", "{:.1e}"}});
  bool passed = true;
  const std::uint64_t count = request.quick ? 10 : 1000;
  for (const auto& [name, make] :
       {std::pair{"waves", &waves}, std::pair{"stars", &star}, std::pair{"scribbles", &scribble}}) {
    progress(fmt::format("{} {}", count, name));
    Tally tally;
    for (std::uint64_t seed = 1; seed <= count; ++seed) try_curve(make(seed), tally);
    table.add({std::string(name), tally.curves, tally.first, tally.later, tally.refused,
               tally.wrong, tally.missing, tally.distance});
    passed = passed && tally.wrong == 0;
  }
  const std::string text = fmt::format(
      "{} random curves of each kind, those that do not cross themselves: by how many the method\n"
      "ends at the first attempt, and how it differs from the exact axis (`disks` on arcs within\n"
      "1e-10 of the curve). Distances are relative to the diagonal.\n\n{}",
      count, table.markdown());
  const Status written = in_order([&] { return write(request, "tables.md", text); },
                                  [&] { return write(request, "curves.csv", table.csv()); },
                                  [&] { return draw_figures(request); });
  if (!written) return written.error();
  return passed;
}

}  // namespace medial::papers
