// medial_check_planar_graphs [COUNT [FIRST]]: the Voronoi diagrams of random planar graphs of
// points and segments beside CGAL's segment Delaunay graph, whose decisions are exact: the same
// edges, identified by the sites that they separate and by their ends. Exit status 1 where one
// differs.

#include <CGAL/Segment_Delaunay_graph_2.h>
#include <CGAL/Segment_Delaunay_graph_filtered_traits_2.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "support/diagram_graph.h"

namespace {

using namespace medial;
using Kernel = CGAL::Simple_cartesian<double>;
using Traits = CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<Kernel>;
using Graph = CGAL::Segment_Delaunay_graph_2<Traits>;

/// Names CGAL's sites as the planar graph's diagram does.
class SiteNames {
 public:
  explicit SiteNames(const PlanarGraph& planar_graph) {
    for (const Vec2 p : planar_graph.points) points_.emplace(std::pair(p.x, p.y), count_++);
    for (const PlanarGraphEdge& edge : planar_graph.edges)
      edges_.emplace(std::minmax({edge.from, edge.to}), count_++);
  }
  std::uint32_t operator()(const Graph::Site_2& site) const {
    if (site.is_point()) return at(site.point());
    return edges_.at(std::minmax({at(site.source()), at(site.target())}));
  }

 private:
  std::uint32_t at(const Kernel::Point_2& p) const { return points_.at({p.x(), p.y()}); }
  std::uint32_t count_ = 0;
  std::map<std::pair<double, double>, std::uint32_t> points_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges_;
};

/// None of fewer than three sites, whose graph has no faces.
std::optional<std::vector<test::SeparatingEdge>> edges_of_cgal(const PlanarGraph& planar_graph,
                                                               const Box& frame, double near) {
  std::vector<Kernel::Point_2> points;
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  for (const Vec2 p : planar_graph.points) points.emplace_back(p.x, p.y);
  for (const PlanarGraphEdge& edge : planar_graph.edges) segments.emplace_back(edge.from, edge.to);
  Graph graph;
  graph.insert(points.begin(), points.end());
  graph.insert_segments(points, segments.begin(), segments.end());
  if (graph.dimension() < 2) return std::nullopt;
  const SiteNames name(planar_graph);
  const auto place_of = [&](Graph::Face_handle face) {
    if (graph.is_infinite(face)) return test::nowhere;
    const Kernel::Point_2 p = graph.circumcenter(face);
    return Vec2{p.x(), p.y()};
  };
  test::EdgesInForm form(planar_graph, frame, near);
  for (auto edge = graph.finite_edges_begin(); edge != graph.finite_edges_end(); ++edge) {
    const auto [face, index] = *edge;
    const auto one = face->vertex(Graph::cw(index)), other = face->vertex(Graph::ccw(index));
    form.add(name(one->site()), name(other->site()), place_of(face),
             place_of(face->neighbor(index)));
  }
  return form.edges();
}

/// The number of edges compared, 0 where CGAL has none; -1 where they differ, which is printed.
long compare(std::uint64_t seed) {
  const auto planar_graph = build_planar_graph(test::random_integer_planar_graph(seed));
  if (!planar_graph) std::abort();
  const Box frame = test::enclosure_around(*planar_graph);
  const auto diagram = voronoi_diagram(*planar_graph, {.threads = 1}, frame);
  if (!diagram) {
    std::printf("planar graph %lu: %s\n", seed, to_string(diagram.error()).c_str());
    return -1;
  }
  const double near = 1e-9 * diagonal(frame);
  const auto ours = test::edges_in_form(*planar_graph, *diagram, near);
  const auto theirs = edges_of_cgal(*planar_graph, frame, near);
  if (!theirs) return 0;
  const std::string lost = test::missing_edge(*theirs, ours, 2 * near);
  const std::string more = test::missing_edge(ours, *theirs, 2 * near);
  if (lost.empty() && more.empty()) return static_cast<long>(ours.size());
  std::printf("planar graph %lu: CGAL's edge %s; our edge %s\n", seed, lost.c_str(), more.c_str());
  return -1;
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, std::uint64_t otherwise) {
    return argc > i ? std::strtoull(argv[i], nullptr, 10) : otherwise;
  };
  const std::uint64_t count = number(1, 1000), first = number(2, 0);
  std::uint64_t compared = 0, edges = 0, differ = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const long found = compare(seed);
    if (found > 0) ++compared, edges += static_cast<std::uint64_t>(found);
    if (found < 0) ++differ;
  }
  std::printf("%lu planar graphs with %lu edges are the same, %lu differ\n", compared, edges,
              differ);
  return differ == 0 ? 0 : 1;
}
