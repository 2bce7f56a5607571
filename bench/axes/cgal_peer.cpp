#include <CGAL/Segment_Delaunay_graph_2.h>
#include <CGAL/Segment_Delaunay_graph_filtered_traits_2.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#include <utility>
#include <vector>

#include "clock.h"
#include "peers.h"

namespace medial::bench {

PeerRun run_cgal(std::span<const Ring> rings) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<Kernel>;
  using Graph = CGAL::Segment_Delaunay_graph_2<Traits>;

  std::vector<Kernel::Point_2> points;
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  for (const Ring& ring : rings) {
    const std::size_t first = points.size();
    const std::size_t count = ring.points.size();
    for (std::size_t i = 0; i < count; ++i) {
      points.emplace_back(ring.points[i].x, ring.points[i].y);
      segments.emplace_back(first + i, first + (i + 1) % count);
    }
  }
  PeerRun run;
  const double start = processor_seconds();
  Graph graph;
  graph.insert_segments(points, segments.begin(), segments.end());
  run.seconds = processor_seconds() - start;
  run.vertices = graph.number_of_faces();
  return run;
}

std::string cgal_version() { return CGAL_VERSION_STR; }

}  // namespace medial::bench
