// medial_hashes: hashes of results, one line each. Exits with 1 where the number of threads changes
// one. `make serial` compares the lines with those of a build without threads.

#include <cstdint>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "medial/compute.h"
#include "medial/contour.h"
#include "medial/planar_graph.h"
#include "medial/raster.h"
#include "medial/shape.h"
#include "medial/verify.h"
#include "medial/voronoi.h"
#include "papers/shaked_bruckstein_1996/spline.h"
#include "support/generate.h"

namespace medial::test {
namespace {

/// FNV-1a, over the bits of numbers.
class Hash {
 public:
  template <class Number>
  void add(Number number) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(&number);
    for (std::size_t i = 0; i < sizeof number; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3;
  }
  void add(const Disk& disk) {
    add(disk.center.x);
    add(disk.center.y);
    add(disk.radius);
  }
  template <class Edge>
  void add_graph(std::span<const Node> nodes, std::span<const Edge> edges) {
    for (const Node& node : nodes) add(node.disk);
    for (const auto& edge : edges) {
      for (const std::uint32_t node : edge.node) add(node);
      for (const std::uint32_t site : edge.site) add(site);
      add(edge.control);
      add(edge.weight);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

Shape shape_of(const Rings& rings) { return build_shape(rings).value(); }

std::uint64_t hash_of_axis(const Rings& rings, Method method, int threads) {
  const Shape shape = shape_of(rings);
  Options options;
  options.method = method;
  options.threads = threads;
  const MedialAxis axis = compute(shape, options).value();
  Hash hash;
  hash.add_graph<Edge>(axis.nodes, axis.edges);
  VerifyOptions check;
  check.threads = threads;
  const Certificate certificate = verify(shape, axis, check);
  hash.add(certificate.largest_residual);
  hash.add(certificate.disks_area);
  return hash.value();
}

std::uint64_t hash_of_diagram(bool with_edges, int threads) {
  Random random(7);
  std::vector<Chain> chains;
  for (int i = 0; i < 3000; ++i) {
    const Vec2 at{random.between(0, 100), random.between(0, 100)};
    chains.push_back({{at}});
    if (with_edges) chains.back().points.push_back(at + Vec2{0.01, random.between(-0.01, 0.01)});
  }
  PlanarGraphOptions noding;
  noding.node_crossings = true;
  const PlanarGraph graph = build_planar_graph(chains, noding).value();
  Options options;
  options.threads = threads;
  const VoronoiDiagram diagram = voronoi_diagram(graph, options).value();
  Hash hash;
  hash.add_graph<VoronoiEdge>(diagram.nodes, diagram.edges);
  for (const std::uint32_t edge : diagram.face_edges) hash.add(edge);
  return hash.value();
}

std::uint64_t hash_of_distances(int threads) {
  Random random(3);
  Image image(700, 500);
  for (std::uint32_t y = 0; y < image.height(); ++y)
    for (std::uint32_t x = 0; x < image.width(); ++x) image.set(x, y, random.chance(0.99));
  DistanceOptions options;
  options.threads = threads;
  const DistanceMap map = distance_transform(image, options).value();
  Hash hash;
  for (const std::uint32_t squared : map.squared) hash.add(squared);
  return hash.value();
}

/// A smooth curve through the points of a blob, as arcs.
Rings arcs(int threads) {
  const Contour contour = papers::spline_through(blob(3000).front().points, 0.01);
  ArcOptions options;
  options.tolerance = 1e-5;
  options.threads = threads;
  return approximate_by_arcs(std::span(&contour, 1), options).value();
}

struct Line {
  std::string name;
  std::function<std::uint64_t(int)> hash;
};

std::vector<Line> lines() {
  const auto axis = [](std::string name, Rings rings, Method method) {
    return Line{std::move(name), [rings = std::move(rings), method](int threads) {
                  return hash_of_axis(rings, method, threads);
                }};
  };
  Random random(5);
  return {
      axis("maze", maze(40000), method::Disks{}),
      axis("holes", hole_grid(60), method::Disks{}),
      axis("star with holes", star_with_holes(random, 2000, 6), method::Disks{}),
      axis("blob", blob(20000), method::Disks{}),
      axis("comb by lee", comb(3000), method::Lee{}),
      axis("star by potential", {star(random, 40)}, method::Potential{}),
      {"arcs", [](int threads) { return hash_of_axis(arcs(threads), method::Disks{}, threads); }},
      {"points", [](int threads) { return hash_of_diagram(false, threads); }},
      {"segments", [](int threads) { return hash_of_diagram(true, threads); }},
      {"distances", [](int threads) { return hash_of_distances(threads); }}};
}

}  // namespace
}  // namespace medial::test

int main() {
  bool same = true;
  for (const auto& [name, hash] : medial::test::lines()) {
    const std::uint64_t value = hash(1);
    std::printf("%-20s %016llx\n", name.c_str(), static_cast<unsigned long long>(value));
    for (const int threads : {2, 5}) {
      if (hash(threads) == value) continue;
      std::printf("%s: another result with %d threads\n", name.c_str(), threads);
      same = false;
    }
  }
  return same ? 0 : 1;
}
