#include "cli/bench_lee.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>

#include "base/random.h"
#include "cli/bench_biarc.h"
#include "cli/commands.h"
#include "cli/plot.h"
#include "cli/terminal.h"
#include "medial/medial.h"
#include "methods/lee/lee.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace medial::cli {
namespace {

constexpr char lee_formats[] = ".svg .csv .json";
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

/// The corridors of a random spanning tree of a grid, 6 wide in cells of 10; each cell but the last
/// is open to the right or upwards. Walked along the wall.
Ring maze(std::size_t n) {
  constexpr double corners_per_cell = 1.75;
  const auto side = std::max<std::size_t>(
      2, static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / corners_per_cell)));
  enum : std::size_t { below, right, above, left };
  std::vector<std::array<bool, 4>> open(side * side, {false, false, false, false});
  Random random(1982);
  for (std::size_t cell = 0; cell + 1 < side * side; ++cell) {
    const bool last_column = cell % side + 1 == side, last_row = cell / side + 1 == side;
    const bool upwards = last_column || (!last_row && unit(random) < 0.5);
    open[cell][upwards ? above : right] = true;
    open[upwards ? cell + side : cell + 1][upwards ? below : left] = true;
  }
  Ring ring;
  std::size_t cell = 0, at = below;
  bool through_passage = false;
  do {
    const bool is_open = open[cell][at];
    if (is_open == through_passage) {
      const double x = 10 * static_cast<double>(cell % side);
      const double y = 10 * static_cast<double>(cell / side);
      ring.points.push_back(
          {x + (at == right || at == above ? 8 : 2), y + (at == above || at == left ? 8 : 2)});
    }
    if (is_open) {
      const std::array<std::size_t, 4> neighbour{cell - side, cell + 1, cell + side, cell - 1};
      cell = neighbour[at];
      at = (at + 3) % 4;
    } else {
      at = (at + 1) % 4;
    }
    through_passage = is_open;
  } while (cell != 0 || at != below);
  return ring;
}

/// A line of what Linux tells of this process, in bytes: VmRSS (resident), VmHWM (at most so far).
double status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(key + ":", 0) == 0) return 1024 * std::stod(line.substr(key.size() + 1));
  return 0;
}

/// What is resident at the most from here on, above what is now.
class PeakMemory {
 public:
  PeakMemory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    before_ = status_bytes("VmRSS");
    std::ofstream("/proc/self/clear_refs") << "5";
  }
  double bytes() const { return std::max(0.0, status_bytes("VmHWM") - before_); }

 private:
  double before_ = 0;
};

template <class Work>
double least_time(int rounds, const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < rounds; ++i) {
    const double start = processor_seconds();
    work();
    least = std::min(least, processor_seconds() - start);
  }
  return least;
}

LeeRow measure(const std::string& name, const Ring& ring, int rounds) {
  LeeRow row;
  row.shape = name;
  const auto shape = build_shape(std::vector<Ring>{ring});
  if (!shape) {
    row.failure = to_string(shape.error());
    return row;
  }
  row.vertices = shape->points.size();
  // The first time loads code, too.
  if (!compute(*shape, {.method = Method::lee, .threads = 1})) row.failure = "not computed";
  const PeakMemory memory;
  const auto axis = compute(*shape, {.method = Method::lee, .threads = 1});
  if (!axis) {
    row.failure = to_string(axis.error());
    return row;
  }
  row.elements = axis->sites.size();
  row.bytes = memory.bytes() / static_cast<double>(row.elements);
  const auto elements = static_cast<double>(row.elements);
  row.crossings = static_cast<double>(axis->statistics.queries) / elements;
  constexpr std::uint64_t most_verified = 2000000;
  if (row.vertices <= most_verified) {
    const Certificate certificate = verify(*shape, *axis);
    if (!certificate.passed) row.failure = certificate.failures.front();
  }
  const auto time_of = [&](Method method) {
    return least_time(rounds, [&] {
      if (!compute(*shape, {.method = method, .threads = 1})) row.failure = "not computed";
    });
  };
  row.lee = time_of(Method::lee);
  row.disks = time_of(Method::disks);
  std::vector<lee::Level> levels;
  if (!lee::run(*shape, {.method = Method::lee, .threads = 1}, &levels))
    row.failure = "not computed";
  for (const lee::Level& level : levels) row.levels.push_back(level.seconds);
  return row;
}

double per_element_and_level(const LeeRow& row) {
  const auto n = static_cast<double>(row.elements);
  return row.elements < 2 ? 0 : 1e6 * row.lee / (n * std::log2(n));
}

std::string lee_table(const std::vector<LeeRow>& rows) {
  std::string text =
      "| shape | n | N | lee s | disks s | lee / disks | lee us/n | us/(N log2 N) | crossings/N | "
      "bytes/N | "
      "share of the last 4 merges' levels | verified |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- | --- |\n";
  for (const LeeRow& row : rows) {
    const double all = std::accumulate(row.levels.begin(), row.levels.end(), 0.0);
    std::string shares;
    for (std::size_t i = 0; i < std::min<std::size_t>(4, row.levels.size()); ++i)
      shares += fmt::format("{}{:.0f} %", i == 0 ? "" : ", ", 100 * row.levels[i] / all);
    if (row.levels.empty()) shares = "no merge";
    text += fmt::format(
        "| {} | {} | {} | {:.4f} | {:.4f} | {:.2f} | {:.3f} | {:.4f} | {:.2f} | {:.0f} | {} | {} "
        "|\n",
        row.shape, row.vertices, row.elements, row.lee, row.disks, row.lee / row.disks,
        1e6 * row.lee / static_cast<double>(std::max<std::uint64_t>(row.vertices, 1)),
        per_element_and_level(row), row.crossings, row.bytes, shares,
        row.failure.empty() ? "yes" : "NO: " + row.failure);
  }
  return text;
}

/// The rows of each shape, with the exponent of its time.
std::string fits(const std::vector<LeeRow>& rows) {
  std::string text = "| shape | lee ~ n^p | disks ~ n^p |\n| --- | ---: | ---: |\n";
  for (std::size_t i = 0; i < rows.size();) {
    std::vector<std::pair<double, double>> lee, disks;
    const std::string& name = rows[i].shape;
    for (; i < rows.size() && rows[i].shape == name; ++i) {
      if (rows[i].vertices < 1000 || !(rows[i].lee > 0) || !(rows[i].disks > 0)) continue;
      lee.emplace_back(static_cast<double>(rows[i].vertices), rows[i].lee);
      disks.emplace_back(static_cast<double>(rows[i].vertices), rows[i].disks);
    }
    if (lee.size() < 2) continue;
    text += fmt::format("| {} | {:.2f} | {:.2f} |\n", name, fitted_exponent(lee),
                        fitted_exponent(disks));
  }
  return text;
}

std::vector<Plot> plots(const std::vector<LeeRow>& rows) {
  Plot lee{"Lee's divide and conquer", "vertices", "seconds", {}};
  Plot disks{"The method disks", "vertices", "seconds", {}};
  for (const LeeRow& row : rows) {
    if (lee.series.empty() || lee.series.back().name != row.shape) {
      lee.series.push_back({row.shape, {}});
      disks.series.push_back({row.shape, {}});
    }
    if (!(row.lee > 0 && row.disks > 0)) continue;
    lee.series.back().points.emplace_back(static_cast<double>(row.vertices), row.lee);
    disks.series.back().points.emplace_back(static_cast<double>(row.vertices), row.disks);
  }
  return {lee, disks};
}

Json json_of(const LeeRow& row) {
  return {{"shape", row.shape},    {"vertices", row.vertices}, {"elements", row.elements},
          {"lee", row.lee},        {"disks", row.disks},       {"crossings", row.crossings},
          {"levels", row.levels},  {"bytes", row.bytes},       {"passed", row.failure.empty()},
          {"failure", row.failure}};
}

struct LeeArguments {
  std::string output;
  std::string figures;
  int largest = 6;
  int rounds = 3;
  bool quick = false, json = false, quiet = false;
};

Result<int> run_lee(const LeeArguments& arguments) {
  Status writable = check_output(arguments.output, {}, lee_formats, {}, false);
  if (!writable) return std::move(writable).error();
  if (!arguments.figures.empty()) {
    Status written = write_lee_figures(arguments.figures);
    if (!written) return std::move(written).error();
    return exit_success;
  }
  const bool shown = error_is_terminal() && !arguments.quiet;
  const std::vector<LeeRow> rows = run_lee_experiment(
      arguments.quick ? std::min(arguments.largest, 3) : arguments.largest,
      arguments.quick ? 1 : arguments.rounds,
      shown ? [](const std::string& name) { say("{}\n", name); } : [](const std::string&) {});
  Json all = Json::array();
  bool passed = true;
  std::string csv = "shape,vertices,elements,lee,disks,crossings,passed\n";
  for (const LeeRow& row : rows) {
    all.push_back(json_of(row));
    passed = passed && row.failure.empty();
    csv += fmt::format("{},{},{},{},{},{},{}\n", row.shape, row.vertices, row.elements, row.lee,
                       row.disks, row.crossings, row.failure.empty());
  }
  if (!arguments.output.empty()) {
    const std::string extension = std::filesystem::path(arguments.output).extension().string();
    Status written = extension == ".svg"   ? write_plots(arguments.output, plots(rows))
                     : extension == ".csv" ? io::write_text(arguments.output, csv)
                                           : io::write_text(arguments.output, all.dump(2) + "\n");
    if (!written) return std::move(written).error();
  }
  Status printed = arguments.json ? print(all) : print(lee_table(rows) + "\n" + fits(rows));
  if (!printed) return std::move(printed).error();
  return passed ? exit_success : exit_failed_verdict;
}

}  // namespace

std::vector<LeeRow> run_lee_experiment(int largest, int rounds,
                                       void (*progress)(const std::string&)) {
  const std::array<std::pair<const char*, Ring (*)(std::size_t)>, 5> shapes = {
      {{"coast", coast}, {"maze", maze}, {"blob", blob}, {"convex", convex}, {"regular", regular}}};
  std::vector<LeeRow> rows;
  for (const auto& [name, ring] : shapes) {
    std::size_t n = 100;
    for (int size = 2; size <= largest; ++size, n *= 10) {
      progress(fmt::format("{} of {} vertices", name, n));
      rows.push_back(measure(name, ring(n), rounds));
    }
  }
  return rows;
}

Command add_lee_bench(CLI::App& bench) {
  auto arguments = std::make_shared<LeeArguments>();
  CLI::App* lee = bench.add_subcommand(
      "lee",
      "Polygons by divide and conquer: Lee, Medial Axis Transformation of a Planar\n"
      "Shape (1982), against the number of vertices, beside the method disks.");
  lee->add_option("-o,--output", arguments->output,
                  fmt::format("Plots (.svg) or all numbers: {}", lee_formats))
      ->check(a_name())
      ->option_text("FILE");
  lee->add_option("--largest", arguments->largest, "Shapes of 1e2 to 10^N vertices (default: 6).")
      ->check(in_range(2, 7, true))
      ->option_text("N");
  lee->add_option("--rounds", arguments->rounds,
                  "The least time of so many rounds counts (default: 3).")
      ->check(in_range(1, 1000, true))
      ->option_text("N");
  lee->add_option("--figures", arguments->figures,
                  "Only write the paper's figures into this directory, as SVG.")
      ->option_text("DIRECTORY");
  lee->add_flag("--quick", arguments->quick, "One round of small shapes: does it run at all?");
  lee->add_flag("--json", arguments->json, "Print one JSON array instead of tables.");
  lee->add_flag("--quiet,-q", arguments->quiet, "No progress on standard error.");
  lee->footer(
      "Everything runs on one thread. Axes of up to 2,000,000 vertices are verified. Exit\n"
      "status 1: one was refused.\n"
      "\n"
      "Examples:\n"
      "  medial bench lee --quick\n"
      "  medial bench lee --largest 5 -o lee.svg\n"
      "  medial bench lee --figures figures");
  return {lee, [arguments] { return run_lee(*arguments); }};
}

}  // namespace medial::cli
