#include "shape/fill.h"

#include <optional>
#include <utility>

#include "shape/around.h"
#include "shape/errors.h"

namespace medial {
namespace {

bool is_filled(EdgeWeight count) { return (count.winding != 0) != count.odd; }

/// The weight on the left of a half-edge, given the weight on its right.
EdgeWeight across(EdgeWeight right, EdgeWeight edge, bool forward) {
  return {right.winding + (forward ? edge.winding : -edge.winding), right.odd != edge.odd};
}

/// Finds the half-edges of a graph with a filled face on their left only.
class Filling {
 public:
  explicit Filling(const WeightedGraph& weighted)
      : graph_(weighted.graph), weights_(weighted.weights) {
    const std::size_t count = 2 * graph_.edges.size();
    face_.resize(count);
    next_.resize(count);
    for (std::size_t i = 0; i < graph_.loop_count(); ++i) {
      const std::uint32_t begin = graph_.loop_begin[i], end = graph_.loop_begin[i + 1];
      for (std::uint32_t k = begin; k < end; ++k) {
        face_[graph_.half_edges[k]] = graph_.face[i];
        next_[graph_.half_edges[k]] = graph_.half_edges[k + 1 < end ? k + 1 : begin];
      }
    }
    count_faces();
  }

  bool bounds(std::uint32_t half_edge) const {
    return is_filled(*counts_[face_[half_edge]]) && !is_filled(*counts_[face_[half_edge ^ 1U]]);
  }

  /// The half-edge after another one along the boundary: the first one clockwise from it at its
  /// end.
  std::uint32_t after(std::uint32_t half_edge) const {
    std::uint32_t next = next_[half_edge];
    while (!bounds(next)) next = next_[next ^ 1U];
    return next;
  }

 private:
  /// Visits all faces from neighbour to neighbour, beginning with the unbounded one.
  void count_faces() {
    std::vector<std::vector<std::uint32_t>> around(graph_.face_count);
    for (std::uint32_t h = 0; h < face_.size(); ++h) around[face_[h]].push_back(h);
    counts_.resize(graph_.face_count);
    counts_[0] = EdgeWeight{};
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty()) {
      const std::uint32_t face = waiting.back();
      waiting.pop_back();
      for (const std::uint32_t h : around[face]) {
        std::optional<EdgeWeight>& other = counts_[face_[h ^ 1U]];
        if (other) continue;
        other = across(*counts_[face], weights_[h / 2], h % 2 != 0);
        waiting.push_back(face_[h ^ 1U]);
      }
    }
  }

  const PlanarGraph& graph_;
  const std::vector<EdgeWeight>& weights_;
  std::vector<std::uint32_t> face_, next_;  ///< of each half-edge
  std::vector<std::optional<EdgeWeight>> counts_;
};

FilledRings rings_of(const WeightedGraph& weighted) {
  const PlanarGraph& graph = weighted.graph;
  const Filling filling(weighted);
  FilledRings result;
  std::vector<bool> done(2 * graph.edges.size());
  for (std::uint32_t first = 0; first < done.size(); ++first) {
    if (done[first] || !filling.bounds(first)) continue;
    Ring& ring = result.rings.emplace_back();
    std::vector<VertexSource>& sources = result.sources.emplace_back();
    for (std::uint32_t h = first; !done[h]; h = filling.after(h)) {
      done[h] = true;
      ring.points.push_back(graph.points[start_of(graph, h)]);
      ring.bulges.push_back(bulge_of(graph, h));
      sources.push_back(graph.point_sources[start_of(graph, h)]);
    }
  }
  return result;
}

/// The planar graph with a growing touching distance, until rounding can separate all remaining
/// elements, as in with_planar_graph().
Result<WeightedGraph> noded(std::span<const Chain> chains, std::span<const EdgeWeight> weights,
                            double size, ShapeReport& report) {
  Result<WeightedGraph> graph = build_weighted_graph(chains, weights, 0, report);
  for (const double share : {0x1p-43, 0x1p-39, 0x1p-35, 0x1p-31}) {
    if (graph || graph.error().code == ErrorCode::not_finite) break;
    report = {};
    auto again = build_weighted_graph(chains, weights, share * size, report);
    if (again) graph = std::move(again);
  }
  return graph;
}

}  // namespace

Result<FilledRings> fill(std::span<const Ring> rings, ShapeReport& report) {
  std::vector<Chain> chains;
  std::vector<EdgeWeight> weights;
  Box box = Box::nothing();
  for (const Ring& ring : rings) {
    report.input_points += ring.points.size();
    const bool winding = ring.role == RingRole::winding;
    weights.push_back({winding ? 1 : 0, !winding});
    chains.push_back({ring.points, ring.bulges, true});
    for (const Vec2 p : ring.points) box.add(p);
  }
  report.input_rings += rings.size();
  ShapeReport found;
  const auto graph = noded(chains, weights, diagonal(box), found);
  if (!graph) return graph.error();
  report.crossings = found.crossings;
  report.split_edges = found.split_edges;
  FilledRings filled = rings_of(*graph);
  if (filled.rings.empty())
    return error_without_place(ErrorCode::no_area, "nothing is left: no area is enclosed");
  return filled;
}

}  // namespace medial
