// Lee (1982): the time of divide and conquer against the number of vertices, beside `disks`.

#include "papers/lee_1982/experiment.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "base/random.h"
#include "bench/peak_memory.h"
#include "cli/plot.h"
#include "medial/medial.h"
#include "methods/lee/lee.h"
#include "papers/table.h"
#include "tests/support/corridors.h"

namespace medial::papers {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

Ring around_origin(std::size_t n, const std::function<Vec2(double, std::size_t)>& point) {
  Ring ring;
  ring.points.reserve(n);
  for (std::size_t i = 0; i < n; ++i)
    ring.points.push_back(point(two_pi * static_cast<double>(i) / static_cast<double>(n), i));
  return ring;
}

/// Uniform in [0, 1).
double unit(Random& random) { return 0x1p-53 * static_cast<double>(random.next() >> 11); }

/// Star-shaped, its radius displaced at random and less at each halving of the angle.
Ring coast(std::size_t n) {
  std::size_t count = 1;
  while (count < n) count *= 2;
  std::vector<double> height(count + 1, 0);
  Random random(1982);
  constexpr double roughness = 0.62;
  double size = 0.5;
  for (std::size_t step = count; step > 1; step /= 2, size *= roughness)
    for (std::size_t i = step / 2; i < count; i += step)
      height[i] =
          0.5 * (height[i - step / 2] + height[i + step / 2]) + size * (2 * unit(random) - 1);
  return around_origin(n, [&](double angle, std::size_t i) {
    const double radius = std::exp(height[i * count / n]);
    return Vec2{radius * std::cos(angle), radius * std::sin(angle)};
  });
}

Ring blob(std::size_t n) {
  return around_origin(n, [](double angle, std::size_t) {
    const double radius = 1 + 0.3 * std::cos(5 * angle) + 0.05 * std::cos(13 * angle);
    return Vec2{radius * std::cos(angle), radius * std::sin(angle)};
  });
}

Ring convex(std::size_t n) {
  return around_origin(n, [](double angle, std::size_t) {
    return Vec2{2 * std::cos(angle), std::sin(angle)};
  });
}

Ring regular(std::size_t n) {
  return around_origin(n, [](double angle, std::size_t) {
    return Vec2{std::cos(angle), std::sin(angle)};
  });
}

/// The corridors of a random spanning tree: each cell but the last is open to the right or upwards.
Ring maze(std::size_t n) {
  constexpr double corners_per_cell = 1.75;
  const auto side = std::max<std::size_t>(
      2, static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / corners_per_cell)));
  enum : std::size_t { below, right, above, left };
  std::vector<test::OpenSides> open(side * side, test::OpenSides{});
  Random random(1982);
  for (std::size_t cell = 0; cell + 1 < side * side; ++cell) {
    const bool last_column = cell % side + 1 == side, last_row = cell / side + 1 == side;
    const bool upwards = last_column || (!last_row && unit(random) < 0.5);
    open[cell][upwards ? above : right] = true;
    open[upwards ? cell + side : cell + 1][upwards ? below : left] = true;
  }
  return {test::walls_of(open, side)};
}

/// One shape of one size.
struct Row {
  std::string shape;
  std::uint64_t vertices = 0;
  std::uint64_t elements = 0;  ///< segments and reflex vertices: the paper's N
  double lee = 0;              ///< seconds
  double disks = 0;            ///< seconds of the method disks
  double crossings = 0;        ///< of merge curves with Voronoi edges, an element
  std::vector<double> levels;  ///< seconds of the merges, from the last one down
  double bytes = 0;            ///< at the peak, of compute(), an element; 0 where unknown
  std::string failure;         ///< an error, or what verify() refused; empty: verified
};

Row measure(const std::string& name, const Ring& ring, int rounds) {
  const Options options{.method = method::Lee{}, .threads = 1};
  Row row;
  row.shape = name;
  const auto shape = build_shape(std::vector<Ring>{ring});
  if (!shape) {
    row.failure = to_string(shape.error());
    return row;
  }
  row.vertices = shape->points.size();
  // The first time loads code, too.
  if (!compute(*shape, options)) row.failure = "not computed";
  const bench::PeakMemory memory;
  const auto axis = compute(*shape, options);
  if (!axis) {
    row.failure = to_string(axis.error());
    return row;
  }
  if (axis->method != "lee") row.failure = "left to " + axis->method;
  row.elements = axis->sites.size();
  const auto elements = static_cast<double>(row.elements);
  row.bytes = memory.bytes() / elements;
  row.crossings = static_cast<double>(axis->statistics.queries) / elements;
  const Certificate certificate = verify(*shape, *axis);
  if (!certificate.passed) row.failure = certificate.failures.front();
  if (!timed(rounds, row.lee, [&] { return compute(*shape, options); }) ||
      !timed(rounds, row.disks, [&] { return compute(*shape, {.threads = 1}); }))
    row.failure = "not computed";
  std::vector<lee::Level> levels;
  if (!lee::run({*shape, options}, &levels)) row.failure = "not computed";
  for (const lee::Level& level : levels) row.levels.push_back(level.seconds);
  return row;
}

/// Sizes 1e2 to 1e6 of each shape.
std::vector<Row> measure_all(const Request& request) {
  const std::array<std::pair<const char*, Ring (*)(std::size_t)>, 5> shapes = {
      {{"coast", coast}, {"maze", maze}, {"blob", blob}, {"convex", convex}, {"regular", regular}}};
  const std::size_t largest = request.quick ? 1000 : 1000000;
  std::vector<Row> rows;
  for (const auto& [name, ring] : shapes) {
    for (std::size_t n = 100; n <= largest; n *= 10) {
      progress(fmt::format("{} of {} vertices", name, n));
      rows.push_back(measure(name, ring(n), request.rounds));
    }
  }
  return rows;
}

/// "45 / 0 / 0 / 1 %": of all merges, the last one, the two before, the four before these, ...
std::string last_merges(const Row& row) {
  if (row.levels.empty()) return "no merge";
  const double all = std::accumulate(row.levels.begin(), row.levels.end(), 0.0);
  std::string shares;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, row.levels.size()); ++i)
    shares += fmt::format("{}{:.0f}", i == 0 ? "" : " / ", 100 * row.levels[i] / all);
  return shares + " %";
}

Table rows_table(const std::vector<Row>& rows) {
  Table table({{"shape"},
               {"n"},
               {"N"},
               {"lee s", "{:.4f}"},
               {"disks s", "{:.4f}"},
               {"lee / disks", "{:.2f}"},
               {"lee us/n", "{:.3f}"},
               {"us/(N log2 N)", "{:.4f}"},
               {"crossings/N", "{:.2f}"},
               {"bytes/N", "{:.0f}"},
               {"share of the last 4 merges' levels"},
               {"verified"}});
  for (const Row& row : rows) {
    const auto n = static_cast<double>(std::max<std::uint64_t>(row.vertices, 1));
    const auto elements = static_cast<double>(row.elements);
    table.add({row.shape, row.vertices, row.elements, row.lee, row.disks, row.lee / row.disks,
               1e6 * row.lee / n,
               row.elements < 2 ? 0 : 1e6 * row.lee / (elements * std::log2(elements)),
               row.crossings, row.bytes, last_merges(row),
               row.failure.empty() ? "yes" : "NO: " + row.failure});
  }
  return table;
}

/// The seconds of a method against the vertices of a shape, from `least` vertices on.
Points times_of(const std::vector<Row>& rows, const std::string& shape, double Row::*seconds,
                std::uint64_t least) {
  Points points;
  for (const Row& row : rows)
    if (row.shape == shape && row.vertices >= least && row.*seconds > 0)
      points.emplace_back(static_cast<double>(row.vertices), row.*seconds);
  return points;
}

std::string fits_table(const std::vector<Row>& rows) {
  constexpr std::uint64_t least = 1000;
  Table table({{"shape"}, {"lee ~ n^p", "{:.2f}"}, {"disks ~ n^p", "{:.2f}"}});
  for (const char* shape : {"coast", "maze", "blob", "convex", "regular"}) {
    const Points lee = times_of(rows, shape, &Row::lee, least);
    if (lee.size() < 2) continue;
    table.add(
        {shape, fitted_exponent(lee), fitted_exponent(times_of(rows, shape, &Row::disks, least))});
  }
  return table.markdown();
}

Status draw_plots(const Request& request, const std::vector<Row>& rows) {
  cli::Plot lee{"Lee's divide and conquer", "vertices", "seconds", {}};
  cli::Plot disks{"The method disks", "vertices", "seconds", {}};
  for (const char* shape : {"coast", "maze", "blob", "convex", "regular"}) {
    lee.series.push_back({shape, times_of(rows, shape, &Row::lee, 0)});
    disks.series.push_back({shape, times_of(rows, shape, &Row::disks, 0)});
  }
  return cli::write_plots((request.to / "plots.svg").string(), {lee, disks});
}

}  // namespace

Result<bool> run_lee_1982(const Request& request) {
  const Status drawn = draw_lee_figures(request);
  if (!drawn) return drawn.error();
  const std::vector<Row> rows = measure_all(request);
  const Table table = rows_table(rows);
  const std::string text = fmt::format(
      "Processor time of one thread, the least of {} round(s).\n\n{}\nFrom 1e3 vertices on:\n\n{}",
      request.rounds, table.markdown(), fits_table(rows));
  const Status written = in_order([&] { return write(request, "tables.md", text); },
                                  [&] { return write(request, "rows.csv", table.csv()); },
                                  [&] { return draw_plots(request, rows); });
  if (!written) return written.error();
  return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.failure.empty(); });
}

}  // namespace medial::papers
