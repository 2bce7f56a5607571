// medial_bench_soups: the Voronoi diagram of random points and of random segments that do not
// cross, beside Boost.Polygon's and CGAL's Delaunay triangulation; processor seconds on one thread,
// and seconds on some threads (the second argument, 2), which the peers have not. These come first:
// the system takes longer to give out memory that nobody has used for a while.

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <boost/polygon/polygon.hpp>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "base/random.h"
#include "clock.h"
#include "medial/voronoi.h"

namespace {

using namespace medial;
using bench::processor_seconds;
using Point = boost::polygon::point_data<std::int32_t>;
using Segment = boost::polygon::segment_data<std::int32_t>;

void tell(const char* what, double start) {
  std::printf("%-32s %8.3f s\n", what, processor_seconds() - start);
}

void run_medial(const std::vector<Chain>& chains, int threads) {
  double start = processor_seconds();
  const auto soup = build_soup(chains);
  if (!soup) std::exit(1);
  tell("medial build_soup", start);
  const double begin = bench::wall_seconds();
  if (!voronoi_diagram(*soup, {.threads = threads})) std::exit(1);
  std::printf("%-23s %d threads %8.3f s\n", "medial voronoi_diagram", threads,
              bench::wall_seconds() - begin);
  start = processor_seconds();
  if (!voronoi_diagram(*soup, {.threads = 1})) std::exit(1);
  tell("medial voronoi_diagram", start);
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
  run_medial(segment_chains, threads);
  {
    const double start = processor_seconds();
    boost::polygon::voronoi_diagram<double> diagram;
    boost::polygon::construct_voronoi(segments.begin(), segments.end(), &diagram);
    tell("Boost.Polygon", start);
  }
  std::printf("%zu points\n", points.size());
  run_medial(point_chains, threads);
  {
    const double start = processor_seconds();
    boost::polygon::voronoi_diagram<double> diagram;
    boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);
    tell("Boost.Polygon", start);
  }
  const double start = processor_seconds();
  CGAL::Delaunay_triangulation_2<CGAL::Exact_predicates_inexact_constructions_kernel> triangulation(
      cgal_points.begin(), cgal_points.end());
  tell("CGAL Delaunay triangulation", start);
}
