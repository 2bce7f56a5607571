#include "cli/bench_ridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "medial/error.h"
#include "medial/verify.h"
#include "methods/raster/ridge/ridge.h"

namespace medial::cli {
namespace {

/// The area of the shapes of which something else varies.
constexpr double usual_area = 30;

Options options_for(RidgeSearch search, RidgeRule rule, double step) {
  Options options;
  options.method = Method::ridge;
  options.threads = 1;
  options.resolution = step;
  options.ridge_search = search;
  options.ridge_rule = rule;
  options.ridge_collinear = rule == RidgeRule::difference ? 5 : 0;
  return options;
}

RidgeTimes measure(const Shape& shape, const Options& options, int rounds, MedialAxis& axis) {
  constexpr double never = std::numeric_limits<double>::infinity();
  RidgeTimes times{never, never, never, never};
  for (int round = 0; round < rounds; ++round) {
    ridge::Report report;
    axis = ridge::run(shape, options, &report);
    times.start = std::min(times.start, report.seconds_start);
    times.first = std::min(times.first, report.seconds_first);
    times.follow = std::min(times.follow, report.seconds_follow);
    times.thin = std::min(times.thin, report.seconds_thin);
    times.checked = report.queries;
    times.found = report.found;
    times.kept = report.kept;
  }
  return times;
}

bool same_pixels(const MedialAxis& a, const MedialAxis& b) {
  return std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(),
                    [](const Node& p, const Node& q) {
                      return p.disk.center == q.disk.center && p.disk.radius == q.disk.radius;
                    });
}

std::uint64_t concave_vertices(const Shape& shape) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Vec2 p = loop[j], q = loop[(j + 1) % loop.size()], r = loop[(j + 2) % loop.size()];
      if (cross(q - p, r - q) < 0) ++count;
    }
  }
  return count;
}

RidgeRow measure(RidgeRow row, const std::vector<Ring>& rings, const RidgeBenchOptions& options) {
  const auto shape = build_shape(rings);
  if (!shape) {
    row.refused = name_of(shape.error().code);
    return row;
  }
  row.edges = shape->points.size();
  row.area = area(*shape);
  row.concave = concave_vertices(*shape);
  const double step = 1 / options.per_unit;
  MedialAxis by_list, by_tree, by_crossing;
  row.list = measure(*shape, options_for(RidgeSearch::sorted_list, RidgeRule::difference, step),
                     options.rounds, by_list);
  row.tree = measure(*shape, options_for(RidgeSearch::tree, RidgeRule::difference, step),
                     options.rounds, by_tree);
  row.crossing = measure(*shape, options_for(RidgeSearch::tree, RidgeRule::crossing, step),
                         options.rounds, by_crossing);
  if (!same_pixels(by_list, by_tree)) row.failure = "the searches differ";
  for (const MedialAxis* axis : {&by_tree, &by_crossing}) {
    const Certificate certificate = verify(*shape, *axis);
    if (row.failure.empty() && certificate.cycles != certificate.holes)
      row.failure = fmt::format("{} cycles, {} holes", certificate.cycles, certificate.holes);
  }
  return row;
}

Ring scaled_to(Ring ring, double wanted) {
  double doubled = 0;
  for (std::size_t i = 0; i < ring.points.size(); ++i)
    doubled += cross(ring.points[i], ring.points[(i + 1) % ring.points.size()]);
  const double scale = std::sqrt(wanted / (0.5 * std::abs(doubled)));
  for (Vec2& p : ring.points) p = scale * p;
  return ring;
}

Ring regular(int edges) {
  Ring ring;
  for (int i = 0; i < edges; ++i) {
    const double angle = 2 * std::numbers::pi * i / edges;
    ring.points.push_back({std::cos(angle), std::sin(angle)});
  }
  return ring;
}

/// p seen in the mirror that is the line through a and b.
Vec2 reflected(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = (1 / distance(a, b)) * (b - a);
  const Vec2 foot = a + dot(p - a, along) * along;
  return 2 * foot - p;
}

}  // namespace

Ring regular_polygon_of_area(int edges, double area) { return scaled_to(regular(edges), area); }

std::vector<Ring> toothed_square(int holes) {
  constexpr double tooth = 0.5, height = 0.4, margin = 2, depth = 1;
  constexpr int places = 5, teeth_each = 3;
  // A tooth that stays before, between and after the places: no two long edges make one.
  constexpr double side = 2 * margin + (places * (teeth_each + 1) + 1) * tooth;
  std::vector<Ring> rings(1);
  int place = 0;
  for (int s = 0; s < 4; ++s) {
    // Along this side: x forward, y inward; sides counter-clockwise around the centre.
    const auto put = [s](double x, double y) {
      Vec2 p{x - 0.5 * side, y - 0.5 * side};
      for (int turn = 0; turn < s; ++turn) p = left_of(p);
      return p;
    };
    const auto add_teeth = [&](double x, int count) {
      for (int t = 0; t < count; ++t) {
        rings[0].points.push_back(put(x + t * tooth, 0));
        rings[0].points.push_back(put(x + (t + 0.5) * tooth, height));
      }
    };
    rings[0].points.push_back(put(0, 0));
    for (int k = 0; k < places; ++k, ++place) {
      const double before = margin + k * (teeth_each + 1) * tooth, x = before + tooth;
      const bool hole = place * holes / 20 != (place + 1) * holes / 20;  // spread evenly
      add_teeth(before, 1);
      if (hole)
        rings[0].points.push_back(put(x, 0));
      else
        add_teeth(x, teeth_each);
      if (!hole) continue;
      // A triangle with dents in two of its sides.
      const double c = x + 0.5 * teeth_each * tooth;
      Ring ring;
      for (const Vec2 p :
           {Vec2{-0.4, 0}, Vec2{0.4, 0}, Vec2{0.1, 0.25}, Vec2{0, 0.7}, Vec2{-0.1, 0.25}})
        ring.points.push_back(put(c + p.x, depth + p.y));
      rings.push_back(std::move(ring));
    }
    add_teeth(side - margin - tooth, 1);
    rings[0].points.push_back(put(side - margin, 0));
  }
  return rings;
}

Ring flipped_polygon(int sets, int run) {
  Ring ring = regular(20);
  std::vector<Vec2>& points = ring.points;
  for (int s = 0; s < sets; ++s) {
    const auto at = [&points](int i) -> Vec2& { return points[static_cast<std::size_t>(i % 20)]; };
    const int before = s * (run + 1);
    const Vec2 a = at(before), b = at(before + run + 1);
    for (int i = 1; i <= run; ++i) at(before + i) = reflected(at(before + i), a, b);
  }
  // The size of the whole polygon, not its area, is that of the others.
  const double scale = std::sqrt(usual_area / (10 * std::sin(2 * std::numbers::pi / 20)));
  for (Vec2& p : points) p = scale * p;
  return ring;
}

std::vector<RidgeRow> run_ridge_experiments(const RidgeBenchOptions& options,
                                            void (*progress)(const std::string&)) {
  std::vector<RidgeRow> rows;
  const auto add = [&](const char* series, double value, int run, const std::vector<Ring>& rings) {
    progress(fmt::format("{} {:g}", series, value));
    RidgeRow row;
    row.series = series;
    row.value = value;
    row.run = static_cast<std::uint64_t>(run);
    rows.push_back(measure(std::move(row), rings, options));
  };
  const int step = options.quick ? 20 : 1;
  for (int n = 3; n <= 70; n += step) add("edges", n, 0, {regular_polygon_of_area(n, usual_area)});
  for (int a = 3; a <= 70; a += step) add("area", a, 0, {regular_polygon_of_area(3, a)});
  for (int holes = 0; holes <= 20; holes += options.quick ? 10 : 1)
    add("holes", holes, 0, toothed_square(holes));
  add("concave", 0, 0, {flipped_polygon(0, 1)});
  for (int run = 1; run <= 9; ++run)
    for (int sets = 1; sets * (run + 1) <= 20; ++sets)
      add("concave", sets * run, run, {flipped_polygon(sets, run)});
  return rows;
}

double correlation(const std::vector<std::pair<double, double>>& points) {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
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
  return xy / std::sqrt(xx * yy);
}

}  // namespace medial::cli
