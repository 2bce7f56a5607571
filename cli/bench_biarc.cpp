#include "cli/bench_biarc.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cli/bench_shapes.h"
#include "cli/terminal.h"
#include "medial/compute.h"
#include "medial/error.h"
#include "medial/query.h"
#include "medial/shape.h"
#include "medial/verify.h"
#include "methods/biarc_dc/biarc_dc.h"

namespace medial::cli {
namespace {

using NamedContours = std::pair<std::string, std::vector<Contour>>;

/// Runs work() some times, or once where it fails; keeps the last result and the least times.
template <class Work>
auto timed(int rounds, Timing& least, const Work& work) {
  constexpr double never = std::numeric_limits<double>::infinity();
  least = {never, never};
  for (int round = 1;; ++round) {
    const Stopwatch wall;
    const double begin = processor_seconds();
    auto result = work();
    least.processor = std::min(least.processor, processor_seconds() - begin);
    least.wall = std::min(least.wall, wall.seconds());
    if (round >= rounds || !result) return result;
  }
}

std::uint64_t count(const MedialAxis& axis, NodeKind kind) {
  return static_cast<std::uint64_t>(
      std::count_if(axis.nodes.begin(), axis.nodes.end(),
                    [kind](const Node& node) { return node.kind == kind; }));
}

std::string failure_of(const Shape& shape, const MedialAxis& axis) {
  const Certificate certificate = verify(shape, axis);
  if (certificate.passed) return {};
  return certificate.failures.empty() ? "not verified" : certificate.failures.front();
}

/// The paper's own method beside `disks`: its time, and whether it finds the same graph.
void measure_published(const Shape& shape, const MedialAxis& axis, const BiarcOptions& limits,
                       BiarcRow& row) {
  if (shape.hole_count() > 0 || shape.component_count() > 1) {
    row.published_note = "simple shapes only";
  } else if (row.edges > limits.published_limit) {
    row.published_note = "left out, see --published-limit";
  }
  if (!row.published_note.empty()) return;
  Options options;
  options.method = Method::biarc_dc;
  options.threads = 1;
  Timing timing;
  const auto published = timed(1, timing, [&] { return compute(shape, options); });
  if (!published) {
    row.published_note = to_string(published.error());
    if (row.failure.empty()) row.failure = "biarc-dc: " + row.published_note;
    return;
  }
  row.published = timing;
  row.published_conquer = published->statistics.seconds_collect;
  biarc_dc::Report division;
  biarc_dc::run(shape, options, &division);  // the same again: the same seed
  row.base_cases.assign(division.base_cases.begin(), division.base_cases.end());

  const std::uint64_t leaves = count(*published, NodeKind::leaf);
  const double a = total_length(axis), b = total_length(*published);
  row.published_note = failure_of(shape, *published);
  if (row.published_note.empty() && leaves != row.leaves) {
    row.published_note = fmt::format("{} leaves, not {}", leaves, row.leaves);
  } else if (row.published_note.empty() && std::abs(a - b) > 1e-9 * a) {
    row.published_note = fmt::format("length off by {:.1e}", std::abs(a - b) / a);
  }
  if (row.failure.empty() && !row.published_note.empty()) {
    row.failure = "biarc-dc: " + row.published_note;
  }
}

BiarcRow measure(const NamedContours& input, double tolerance, const BiarcOptions& limits) {
  BiarcRow row;
  row.shape = input.first;
  row.tolerance = tolerance;
  ArcOptions arc_options;
  arc_options.tolerance = tolerance;
  arc_options.threads = 1;
  ArcReport report;
  const auto rings = timed(limits.rounds, row.conversion,
                           [&] { return approximate_by_arcs(input.second, arc_options, &report); });
  if (!rings) {
    row.failure = to_string(rings.error());
    return row;
  }
  row.error = report.largest_error * tolerance / report.tolerance;
  const auto shape = timed(limits.rounds, row.building, [&] { return build_shape(*rings); });
  if (!shape) {
    row.failure = to_string(shape.error());
    return row;
  }
  row.edges = shape->points.size();
  row.straight = row.edges;
  if (!shape->bulges.empty()) {
    row.straight =
        static_cast<std::uint64_t>(std::count(shape->bulges.begin(), shape->bulges.end(), 0.0));
  }
  Options options;
  options.threads = 1;
  const auto axis = timed(limits.rounds, row.axis, [&] { return compute(*shape, options); });
  if (!axis) {
    row.failure = to_string(axis.error());
    return row;
  }
  Options with_exact = options;
  with_exact.exact = true;
  Timing exact_timing;
  const auto exact =
      timed(limits.rounds, exact_timing, [&] { return compute(*shape, with_exact); });
  if (exact) {
    row.exact = exact_timing;
    row.exact_changes = exact->statistics.exact_changes;
  } else {
    row.exact_note = to_string(exact.error());
  }
  row.leaves = count(*axis, NodeKind::leaf);
  row.branchings = count(*axis, NodeKind::branching);
  row.failure = failure_of(*shape, *axis);
  if (limits.published) {
    measure_published(*shape, *axis, limits, row);
  } else {
    row.published_note = "left out";
  }
  return row;
}

/// A point of a piece, a line or a Bezier curve without weights, by de Casteljau.
Vec2 point_at(const Contour& contour, const CurvePiece& piece, double t) {
  std::array<Vec2, 4> work;
  std::copy_n(contour.points.begin() + piece.first, piece.degree + 1, work.begin());
  for (std::uint32_t level = piece.degree; level > 0; --level) {
    for (std::uint32_t i = 0; i < level; ++i) work[i] = work[i] + t * (work[i + 1] - work[i]);
  }
  return work[0];
}

double distance_to_chord(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 chord = b - a;
  const double t = std::clamp(dot(p - a, chord) / squared_norm(chord), 0.0, 1.0);
  return distance(p, a + t * chord);
}

/// The contours flattened with `chords` chords for every curve. `error` grows to the largest
/// distance found between a chord and its curve.
std::vector<Ring> flattened(const std::vector<Contour>& contours, int chords, double& error) {
  constexpr int samples = 16;
  std::vector<Ring> rings;
  for (const Contour& contour : contours) {
    Ring& ring = rings.emplace_back();
    ring.points.push_back(contour.points[0]);
    for (const CurvePiece& piece : contour.pieces) {
      const int count = piece.degree == 1 ? 1 : chords;
      for (int i = 0; i < count; ++i) {
        const Vec2 from = ring.points.back();
        const Vec2 to = point_at(contour, piece, (i + 1.0) / count);
        for (int j = 1; j < samples; ++j) {
          const Vec2 p = point_at(contour, piece, (i + static_cast<double>(j) / samples) / count);
          error = std::max(error, distance_to_chord(p, from, to));
        }
        ring.points.push_back(to);
      }
    }
  }
  return rings;
}

/// Fig. 13: arcs at a tolerance, and the polygon with as many edges or a few more.
PolygonComparison compare(const NamedContours& input, double tolerance) {
  PolygonComparison result;
  result.shape = input.first;
  BiarcOptions once;
  once.rounds = 1;
  once.published = false;
  const BiarcRow arcs = measure(input, tolerance, once);
  result.edges = arcs.edges;
  result.arc_leaves = arcs.leaves;
  result.arc_error = arcs.error;
  result.failure = arcs.failure;
  if (!result.failure.empty()) return result;
  for (int chords = 1;; ++chords) {
    double error = 0;
    const auto polygon = build_shape(flattened(input.second, chords, error));
    if (polygon && polygon->points.size() < result.edges) continue;
    const auto axis = polygon ? compute(*polygon) : polygon.error();
    if (!axis) {
      result.failure = to_string(axis.error());
      return result;
    }
    result.polygon_leaves = count(*axis, NodeKind::leaf);
    result.polygon_error = error / diagonal(bounding_box(*polygon));
    result.failure = failure_of(*polygon, *axis);
    return result;
  }
}

/// The shapes of the series by size, of about 10^exponent arcs at the tolerance 1e-6.
std::vector<NamedContours> shapes_of_size(int exponent) {
  const int step = exponent - 4;
  constexpr std::array tree_depths = {4, 7, 10};
  constexpr std::array snowflake_orders = {4, 6, 8};
  constexpr std::array lettering_lines = {7, 27, 97};
  const auto i = static_cast<std::size_t>(std::clamp(step, 0, 2));
  return {{"tree", tree(tree_depths[i])},
          {"snowflake", snowflake(snowflake_orders[i])},
          {"lettering", lettering(lettering_lines[i])}};
}

}  // namespace

std::vector<NamedContours> biarc_shapes() {
  return {{"tree", tree(5)},
          {"snowflake", snowflake(4)},
          {"lettering", lettering(8)},
          {"border", border(10)}};
}

bool BiarcReport::passed() const {
  const auto well = [](const auto& row) { return row.failure.empty(); };
  return std::all_of(by_tolerance.begin(), by_tolerance.end(), well) &&
         std::all_of(by_size.begin(), by_size.end(), well) &&
         std::all_of(polygons.begin(), polygons.end(), well);
}

BiarcReport run_biarc_experiments(const BiarcOptions& options,
                                  void (*progress)(const std::string&)) {
  BiarcReport report;
  for (const NamedContours& input : biarc_shapes()) {
    const std::size_t first = report.by_tolerance.size();
    for (int i = 1; i <= options.finest; ++i) {
      const double tolerance = std::pow(10, -2 - i);
      progress(fmt::format("{}, tolerance {:.0e}", input.first, tolerance));
      BiarcRow row = measure(input, tolerance, options);
      // Spiral biarcs keep the leaves whatever the tolerance (Section 2.4 of the paper).
      const std::uint64_t leaves =
          report.by_tolerance.size() > first ? report.by_tolerance[first].leaves : row.leaves;
      if (row.failure.empty() && row.leaves != leaves) {
        row.failure = fmt::format("{} leaves, {} at the first tolerance", row.leaves, leaves);
      }
      report.by_tolerance.push_back(std::move(row));
    }
  }
  for (std::size_t shape = 0; shape < 3; ++shape) {
    for (int exponent = 4; exponent <= options.largest; ++exponent) {
      NamedContours input = std::move(shapes_of_size(exponent)[shape]);
      progress(fmt::format("{} of about 1e{} arcs", input.first, exponent));
      report.by_size.push_back(measure(input, 1e-6, options));
    }
  }
  progress("arcs and polygons");
  for (double tolerance : {1e-3, 1e-4}) {
    report.polygons.push_back(compare({"lettering", lettering(1)}, tolerance));
    report.polygons.push_back(compare({"tree", tree(3)}, tolerance));
  }
  return report;
}

double fitted_exponent(const std::vector<std::pair<double, double>>& points) {
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (const auto& [x, y] : points) {
    const double u = std::log(x), v = std::log(y);
    sum_x += u;
    sum_y += v;
    sum_xx += u * u;
    sum_xy += u * v;
  }
  const auto n = static_cast<double>(points.size());
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

}  // namespace medial::cli
