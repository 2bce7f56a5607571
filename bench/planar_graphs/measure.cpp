// medial_bench_planar_graphs: the Voronoi diagram of random points and of random segments that do
// not cross, beside Boost.Polygon's and CGAL's Delaunay triangulation: seconds of processor time
// and on the clock, on one thread, and on some threads (the second argument, 2), which the peers
// have not. Of all but the long run of Boost the least of some: the system takes longer to give out
// memory that nobody has used for a while.

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "clock.h"
#include "medial/voronoi.h"

namespace {

using namespace medial;
using Point = boost::polygon::point_data<std::int32_t>;
using Segment = boost::polygon::segment_data<std::int32_t>;

/// Prints the least times of some runs.
template <class Work>
void tell(const char* what, int rounds, Work&& work) {
  double processor = std::numeric_limits<double>::infinity(), wall = processor;
  for (int round = 0; round < rounds; ++round) {
    const double processor_start = bench::processor_seconds(), start = bench::wall_seconds();
    work();
    wall = std::min(wall, bench::wall_seconds() - start);
    processor = std::min(processor, bench::processor_seconds() - processor_start);
  }
  std::printf("%-36s %8.3f s of processor time, %8.3f s\n", what, processor, wall);
}

void run_medial(const std::vector<Chain>& chains, int threads, int rounds) {
  std::optional<Result<PlanarGraph>> planar_graph;
  tell("medial build_soup", 1, [&] { planar_graph = build_planar_graph(chains); });
  if (!*planar_graph) std::exit(1);
  for (const int used : {1, threads}) {
    const std::string what = "medial voronoi_diagram, " + std::to_string(used) + " threads";
    tell(what.c_str(), rounds, [&] {
      if (!voronoi_diagram(**planar_graph, {.threads = used})) std::exit(1);
    });
  }
}

template <class Input>
void run_boost(const Input& input, int rounds) {
  tell("Boost.Polygon", rounds, [&] {
    boost::polygon::voronoi_diagram<double> diagram;
    boost::polygon::construct_voronoi(input.begin(), input.end(), &diagram);
  });
}

}  // namespace

int main(int argc, char** argv) {
  const auto side = static_cast<std::int32_t>(
      std::lround(std::sqrt(argc > 1 ? std::strtod(argv[1], nullptr) : 1e6)));
  const int threads = argc > 2 ? std::atoi(argv[2]) : 2;
  Random random(1);
  const auto uniform = [&] { return 0x1p-53 * static_cast<double>(random.next() >> 11U); };
  // A segment for each cell of a square grid, in its cell.
  const double cell = 2e9 / side;
  const auto inside = [&](std::int32_t i) {
    return static_cast<std::int32_t>(-1e9 + (i + 0.05 + 0.9 * uniform()) * cell);
  };
  const auto anywhere = [&] { return static_cast<std::int32_t>(-1e9 + 2e9 * uniform()); };
  std::vector<Segment> segments;
  std::vector<Point> points;
  std::vector<Chain> segment_chains, point_chains;
  std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_2> cgal_points;
  for (std::int32_t i = 0; i < side; ++i) {
    for (std::int32_t j = 0; j < side; ++j) {
      const Point from(inside(i), inside(j)), to(inside(i), inside(j));
      const Point p(anywhere(), anywhere());
      segments.emplace_back(from, to);
      points.push_back(p);
      segment_chains.push_back(
          {{{double(from.x()), double(from.y())}, {double(to.x()), double(to.y())}}});
      point_chains.push_back({{{double(p.x()), double(p.y())}}});
      cgal_points.emplace_back(p.x(), p.y());
    }
  }
  std::printf("%zu segments\n", segments.size());
  run_medial(segment_chains, threads, 3);
  run_boost(segments, 1);
  std::printf("%zu points\n", points.size());
  run_medial(point_chains, threads, 4);
  run_boost(points, 3);
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  tell("CGAL Delaunay triangulation", 4, [&] {
    const CGAL::Delaunay_triangulation_2<Kernel> triangulation(cgal_points.begin(),
                                                               cgal_points.end());
  });
}
