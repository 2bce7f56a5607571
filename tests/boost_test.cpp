// A third party's opinion (Lee, Corollary 3): inside a polygon the medial axis is the segment
// Voronoi diagram less the edges incident with reflex vertices. Boost.Polygon builds that diagram
// for integer coordinates; here its graph and ours must be the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

// Boost.Polygon compares numbers of different kinds, of which the compilers warn.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wdeprecated-enum-float-conversion"
#pragma GCC diagnostic ignored "-Wdeprecated-copy"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include <boost/polygon/polygon.hpp>
#include <boost/polygon/voronoi.hpp>
#pragma GCC diagnostic pop

#include "base/disjoint_sets.h"
#include "medial/medial.h"
#include "support/diagram_graph.h"
#include "support/random_shapes.h"

namespace medial::test {
namespace {

/// Positions agree to this fraction of the diagonal, and vertices nearer than it are one: Boost
/// splits a vertex of degree four into two that coincide.
constexpr double agreement = 1e-9;

/// A graph of disks, whichever program made it.
struct Graph {
  std::vector<Disk> nodes;
  std::vector<std::array<std::uint32_t, 2>> edges;
};

Graph graph_of(const MedialAxis& axis) {
  Graph graph;
  for (const Node& node : axis.nodes) graph.nodes.push_back(node.disk);
  for (const Edge& edge : axis.edges) graph.edges.push_back({edge.node[0], edge.node[1]});
  return graph;
}

bool inside(const Shape& shape, Vec2 p) {
  bool odd = false;
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 a = loop[k];
      const Vec2 b = loop[(k + 1) % loop.size()];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      if ((cross(b - a, p - a) > 0) == (b.y > a.y)) odd = !odd;
    }
  }
  return odd;
}

double distance_to_boundary(const Shape& shape, Vec2 p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 a = loop[k];
      const Vec2 d = loop[(k + 1) % loop.size()] - a;
      const double t = std::clamp(dot(p - a, d) / squared_norm(d), 0.0, 1.0);
      nearest = std::min(nearest, distance(p, a + t * d));
    }
  }
  return nearest;
}

/// The primary edges of Boost's diagram that run inside the shape. (A secondary edge separates a
/// segment from its own end: at a reflex vertex that is what Lee removes.)
Graph graph_of_boost(const Shape& shape) {
  using Point = boost::polygon::point_data<std::int32_t>;
  using Segment = boost::polygon::segment_data<std::int32_t>;
  std::vector<Segment> segments;
  const auto integer = [](Vec2 p) {
    return Point(static_cast<std::int32_t>(p.x), static_cast<std::int32_t>(p.y));
  };
  for (std::size_t i = 0; i < shape.loop_count(); ++i) {
    const auto loop = shape.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      segments.emplace_back(integer(loop[k]), integer(loop[(k + 1) % loop.size()]));
    }
  }
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(segments.begin(), segments.end(), &diagram);
  Graph graph;
  std::map<const void*, std::uint32_t> index;
  const auto node = [&](const auto* vertex) {
    const auto [at, fresh] = index.insert({vertex, static_cast<std::uint32_t>(graph.nodes.size())});
    if (fresh) {
      const Vec2 center{vertex->x(), vertex->y()};
      graph.nodes.push_back({center, distance_to_boundary(shape, center)});
    }
    return at->second;
  };
  for (const auto& edge : diagram.edges()) {
    if (!edge.is_primary() || !edge.is_finite() || &edge > edge.twin()) continue;
    const std::array<std::uint32_t, 2> ends{node(edge.vertex0()), node(edge.vertex1())};
    // An edge inside has at least one end off the boundary.
    const Disk& deeper = graph.nodes[ends[0]].radius > graph.nodes[ends[1]].radius
                             ? graph.nodes[ends[0]]
                             : graph.nodes[ends[1]];
    if (inside(shape, deeper.center)) graph.edges.push_back(ends);
  }
  return graph;
}

/// A place of a graph: all nodes that lie together, and how many edges leave them.
struct Place {
  Disk disk;
  std::size_t degree = 0;
};

std::vector<Place> places_of(const Graph& graph, double together) {
  DisjointSets sets(graph.nodes.size());
  const auto is_short = [&](const auto& edge) {
    return distance(graph.nodes[edge[0]].center, graph.nodes[edge[1]].center) <= together;
  };
  for (const auto& edge : graph.edges) {
    if (is_short(edge)) sets.join(edge[0], edge[1]);
  }
  std::map<std::uint32_t, std::size_t> degree;
  for (const auto& edge : graph.edges) {
    if (sets.find(edge[0]) == sets.find(edge[1]) && is_short(edge)) continue;
    ++degree[sets.find(edge[0])];
    ++degree[sets.find(edge[1])];
  }
  std::vector<Place> places;
  for (const auto& [node, count] : degree) {
    // Where convex corners touch, each is a leaf of ours; Boost has one vertex for them all.
    const bool corner = graph.nodes[node].radius <= together;
    for (std::size_t i = 0; i < (corner ? count : 1); ++i) {
      places.push_back({graph.nodes[node], corner ? 1 : count});
    }
  }
  return places;
}

/// Finds for every place of one graph a place of the other; returns a text about missing ones.
std::string missing(const std::vector<Place>& from, const std::vector<Place>& in, double near) {
  std::vector<bool> used(in.size(), false);
  for (const Place& place : from) {
    bool found = false;
    for (std::size_t i = 0; i < in.size() && !found; ++i) {
      if (used[i] || in[i].degree != place.degree ||
          distance(in[i].disk.center, place.disk.center) > near ||
          std::abs(in[i].disk.radius - place.disk.radius) > near) {
        continue;
      }
      used[i] = found = true;
    }
    if (!found) {
      return "no counterpart of degree " + std::to_string(place.degree) + " at (" +
             std::to_string(place.disk.center.x) + ", " + std::to_string(place.disk.center.y) +
             "), radius " + std::to_string(place.disk.radius);
    }
  }
  return "";
}

/// Empty where both agree.
std::string compare(const Rings& rings) {
  const auto shape = build_shape(rings);
  if (!shape) return "refused: " + to_string(shape.error());
  const auto axis = compute(*shape, {.threads = 1});
  if (!axis) return "not computed: " + to_string(axis.error());
  const double near = agreement * diagonal(bounding_box(*shape));
  const auto ours = places_of(graph_of(*axis), near);
  const auto theirs = places_of(graph_of_boost(*shape), near);
  if (const std::string lost = missing(theirs, ours, 2 * near); !lost.empty()) {
    return "ours lacks Boost's node: " + lost;
  }
  if (const std::string lost = missing(ours, theirs, 2 * near); !lost.empty()) {
    return "Boost's lacks our node: " + lost;
  }
  return "";
}

TEST(Boost, HasTheSameGraphOnFixedShapes) {
  EXPECT_EQ(compare(rectangle(5, 3)), "");
  EXPECT_EQ(compare(rectangle(4, 4)), "");
  EXPECT_EQ(compare(l_shape(2)), "");
  EXPECT_EQ(compare(t_shape(2)), "");
  EXPECT_EQ(compare(u_shape(2)), "");
  EXPECT_EQ(compare(cross_shape(2)), "");
  EXPECT_EQ(compare(comb(20)), "");
  EXPECT_EQ(compare(hole_grid(4)), "");
  EXPECT_EQ(compare(maze(300)), "");
}

class Integers : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Integers, HaveTheSameGraph) {
  const std::uint64_t count = shape_count(10);
  const std::uint64_t base = first_seed();
  int failed = 0;
  for (std::uint64_t i = GetParam(); i < count && failed < 3; i += 4) {
    const RandomShape shape = random_integer_shape(base + i);
    const std::string difference = compare(shape.rings);
    if (difference.empty()) continue;
    ++failed;
    ADD_FAILURE() << "random_integer_shape(" << base + i << "), " << shape.kind << ": "
                  << difference << "\n"
                  << to_wkt(shape.rings);
  }
}

/// Whether at least three sites, or two, one of which ends at the other, are as near to p as any:
/// Boost takes a segment's line for the segment now and then, and such a place is no node.
bool is_node(const PlanarGraph& planar_graph, Vec2 p, double near) {
  std::vector<double> distances;
  for (const Vec2 point : planar_graph.points) distances.push_back(distance(p, point));
  for (const PlanarGraphEdge& edge : planar_graph.edges) {
    const Vec2 from = planar_graph.points[edge.from], along = planar_graph.points[edge.to] - from;
    const double share = dot(p - from, along) / dot(along, along);
    if (std::abs(share - 0.5) <= 0.5 + agreement)
      distances.push_back(distance(p, from + share * along));
  }
  if (distances.size() < 3) return false;
  std::nth_element(distances.begin(), distances.begin() + 2, distances.end());
  return distances[2] <= *std::min_element(distances.begin(), distances.begin() + 2) + 2 * near;
}

/// The edges of Boost's diagram; nothing where one of its vertices is no node.
std::optional<std::vector<SeparatingEdge>> edges_of_boost(const PlanarGraph& planar_graph,
                                                          const Box& frame, double near) {
  using Point = boost::polygon::point_data<std::int32_t>;
  using Segment = boost::polygon::segment_data<std::int32_t>;
  const auto integer = [&](std::uint32_t point) {
    return Point(static_cast<std::int32_t>(planar_graph.points[point].x),
                 static_cast<std::int32_t>(planar_graph.points[point].y));
  };
  std::vector<Point> points;
  std::vector<Segment> segments;
  for (const LonePoint& lone : planar_graph.lone_points) points.push_back(integer(lone.point));
  for (const PlanarGraphEdge& edge : planar_graph.edges)
    segments.emplace_back(integer(edge.from), integer(edge.to));
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(points.begin(), points.end(), segments.begin(), segments.end(),
                                    &diagram);
  const auto site_of = [&](const auto& cell) {
    const auto source = static_cast<std::uint32_t>(cell.source_index());
    if (source < points.size()) return planar_graph.lone_points[source].point;
    const auto edge = source - static_cast<std::uint32_t>(points.size());
    if (cell.contains_segment())
      return static_cast<std::uint32_t>(planar_graph.points.size()) + edge;
    return cell.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT
               ? planar_graph.edges[edge].from
               : planar_graph.edges[edge].to;
  };
  const auto place_of = [](const auto* vertex) {
    return vertex ? Vec2{vertex->x(), vertex->y()} : nowhere;
  };
  for (const auto& vertex : diagram.vertices())
    if (!is_node(planar_graph, place_of(&vertex), near)) return std::nullopt;
  EdgesInForm form(planar_graph, frame, near);
  for (const auto& edge : diagram.edges())
    if (&edge < edge.twin())
      form.add(site_of(*edge.cell()), site_of(*edge.twin()->cell()), place_of(edge.vertex0()),
               place_of(edge.vertex1()));
  return form.edges();
}

/// A text about an edge that only one graph has, empty if there is none; none if Boost is wrong.
std::optional<std::string> compare_planar_graphs(const PlanarGraph& planar_graph) {
  const Box frame = enclosure_around(planar_graph);
  const auto diagram = voronoi_diagram(planar_graph, {.threads = 1}, frame);
  if (!diagram) return "not computed: " + to_string(diagram.error());
  const double near = agreement * diagonal(frame);
  const auto theirs = edges_of_boost(planar_graph, frame, near);
  if (!theirs) return std::nullopt;
  const auto ours = edges_in_form(planar_graph, *diagram, near);
  if (const std::string lost = missing_edge(*theirs, ours, 2 * near); !lost.empty())
    return "ours lacks Boost's edge " + lost;
  if (const std::string lost = missing_edge(ours, *theirs, 2 * near); !lost.empty())
    return "Boost's lacks our edge " + lost;
  return "";
}

TEST(Boost, HasTheSameGraphOnPlanarGraphs) {
  const std::uint64_t count = shape_count(13);
  std::uint64_t compared = 0;
  int failed = 0;
  for (std::uint64_t seed = 0; seed < count && failed < 3; ++seed) {
    const auto planar_graph = build_planar_graph(random_integer_planar_graph(seed));
    ASSERT_TRUE(planar_graph.ok());
    const auto difference = compare_planar_graphs(*planar_graph);
    if (!difference) continue;
    ++compared;
    if (difference->empty()) continue;
    ++failed;
    ADD_FAILURE() << "planar graph " << seed << ": " << *difference;
  }
  EXPECT_GT(compared, count - count / 50);
}

INSTANTIATE_TEST_SUITE_P(Random, Integers, testing::Range<std::uint64_t>(0, 4));

/// Boost's own examples: the count of points (none), the count of segments, the segments.
TEST(Boost, HasTheSameGraphOnItsOwnExamples) {
  const auto folder = test::data_folder() / "in_place/E_degenerate/boost_polygon";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no folder " << folder;
  int compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path());
    int points = 0;
    int segments = 0;
    file >> points >> segments;
    Rings rings;
    Vec2 last;
    bool polygons = points == 0;
    for (int i = 0; i < segments; ++i) {
      Vec2 from;
      Vec2 to;
      file >> from.x >> from.y >> to.x >> to.y;
      if (rings.empty() || from != last) rings.emplace_back();
      rings.back().points.push_back(from);
      last = to;
      if (to == rings.back().points.front()) last = {std::nan(""), 0};  // closed
    }
    ASSERT_TRUE(file) << entry.path();
    for (const Ring& ring : rings) polygons = polygons && ring.points.size() >= 3;
    // Some hold loose segments, or segments that leave the polygon: no input of ours.
    const auto shape = build_shape(rings);
    if (!polygons || !shape) continue;
    EXPECT_EQ(compare(rings), "") << entry.path();
    ++compared;
  }
  EXPECT_GE(compared, 6);
}

}  // namespace
}  // namespace medial::test
