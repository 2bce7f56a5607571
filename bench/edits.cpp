// medial_bench_edits: the time in which medial::Editor repairs an axis when one vertex moves,
// compared with computing the axis; one thread, processor time. Prints Markdown.
//
//   medial_bench_edits [EDITS] [SHARE]     (default: 2000 edits of each shape, 0.33)
//
// Random vertices move in random directions, by a random share of their shorter edge up to SHARE.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "axes/inputs.h"
#include "clock.h"
#include "medial/editor.h"
#include "support/generate.h"

namespace {

using namespace medial;

struct Row {
  std::vector<double> microseconds;
  std::size_t refused = 0, whole = 0, repaired = 0, edges = 0;

  double at(double share) const {
    const auto last = microseconds.size() - 1;
    return microseconds[static_cast<std::size_t>(share * static_cast<double>(last))];
  }
};

Row measure(Editor& editor, std::uint32_t vertices, std::size_t count, double share) {
  Row row;
  test::Random random(1);
  while (row.microseconds.size() < count) {
    const auto vertex = static_cast<std::uint32_t>(random.integer(0, vertices - 1));
    const Vec2 place = *editor.vertex(vertex);
    const double edge =
        std::min(distance(place, *editor.vertex((vertex + 1) % vertices)),
                 distance(place, *editor.vertex((vertex + vertices - 1) % vertices)));
    const double way = edge * share * random.unit(), angle = 2 * std::numbers::pi * random.unit();
    const Vec2 to = place + way * Vec2{std::cos(angle), std::sin(angle)};
    const double begin = bench::processor_seconds();
    const auto change = editor.move(vertex, to);
    row.microseconds.push_back(1e6 * (bench::processor_seconds() - begin));
    if (!change) {
      ++row.refused;
    } else if (change->everything) {
      ++row.whole;
    } else {
      ++row.repaired;
      row.edges += change->added_edges.size();
    }
  }
  std::sort(row.microseconds.begin(), row.microseconds.end());
  return row;
}

void report(const std::string& name, const std::vector<Ring>& rings, std::size_t count,
            double share) {
  const auto shape = build_shape(rings);
  Options options;
  options.threads = 1;
  const double begin = bench::processor_seconds();
  auto editor = shape ? Editor::make(*shape, options) : Result<Editor>(shape.error());
  const double seconds = bench::processor_seconds() - begin;
  if (!editor) {
    std::printf("%s: %s\n", name.c_str(), to_string(editor.error()).c_str());
    std::exit(1);
  }
  const auto vertices = static_cast<std::uint32_t>(shape->points.size());
  const Row row = measure(*editor, vertices, count, share);
  std::printf(
      "| %s | %u | %.1f | %.0f | %.0f | %.0f | %.0f | %zu | %zu | %.2f |\n", name.c_str(), vertices,
      static_cast<double>(row.edges) / static_cast<double>(std::max<std::size_t>(row.repaired, 1)),
      row.at(0.5), row.at(0.9), row.at(0.99), row.at(1), row.refused, row.whole, seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = static_cast<std::size_t>(argc > 1 ? std::atoll(argv[1]) : 2000);
  const double share = argc > 2 ? std::atof(argv[2]) : 0.33;
  std::printf(
      "| input | vertices | new edges per edit | median, µs | 90 %% | 99 %% | longest | refused | "
      "all computed | editor made, s |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const bench::Input& input : bench::inputs(false)) {
    if (input.family != bench::Family::coast) continue;
    if (const auto rings = input.rings()) report(input.name, *rings, count, share);
  }
  for (const std::size_t n : {std::size_t{10000}, std::size_t{100000}, std::size_t{1000000}}) {
    report("maze", test::maze(n), count, share);
    report("comb", test::comb(n / 4), count, share);
    report("blob", test::blob(n), count, share);
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / 4));
    report("square holes", test::hole_grid(side), count, share);
  }
}
