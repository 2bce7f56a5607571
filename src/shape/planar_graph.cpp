#include "medial/planar_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/arc.h"
#include "base/disjoint_sets.h"
#include "base/in_flight.h"
#include "base/predicates.h"
#include "shape/arc_sweep.h"
#include "shape/clean.h"
#include "shape/errors.h"
#include "shape/fill.h"
#include "shape/splice.h"
#include "shape/sweep.h"

namespace medial {
namespace {

/// Every edge becomes four half-edges of pieces at most, and several sites.
constexpr std::uint64_t most_planar_graph_points = std::numeric_limits<std::uint32_t>::max() / 32;

struct InputEdge {
  Vec2 from, to;
  double bulge = 0;
  VertexSource source;
  EdgeWeight weight = {};
};
struct InputPoint {
  Vec2 point;
  VertexSource source;
};

/// The edges and points of all chains, each for itself.
struct Input {
  std::vector<InputEdge> edges;
  std::vector<InputPoint> points;
};

Result<Input> input_of(std::span<const Chain> chains, std::span<const EdgeWeight> weights,
                       ShapeReport& report) {
  report.input_rings = chains.size();
  double largest = 0;
  for (const Chain& chain : chains) {
    report.input_points += chain.points.size();
    for (const Vec2 p : chain.points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  }
  if (report.input_points > most_planar_graph_points || chains.size() > most_planar_graph_points)
    return error_without_place(ErrorCode::too_large, "there are too many points");
  if (report.input_points == 0) return error_without_place(ErrorCode::empty, "there is no point");
  const double rounding = largest * std::numeric_limits<double>::epsilon();

  Input input;
  input.edges.reserve(report.input_points);
  for (std::uint32_t c = 0; c < chains.size(); ++c) {
    const Chain& chain = chains[c];
    const EdgeWeight weight = weights.empty() ? EdgeWeight{} : weights[c];
    const std::size_t edges_before = input.edges.size(), count = chain.points.size();
    const auto at = [&](std::size_t i) {
      return Vec2{chain.points[i].x + 0.0, chain.points[i].y + 0.0};  // makes -0 to 0
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      const VertexSource source{c, i};
      if (!std::isfinite(chain.points[i].x) || !std::isfinite(chain.points[i].y))
        return error_at(ErrorCode::not_finite, "a coordinate is not a finite number", source,
                        chain.points[i]);
      if (i + 1 == count && (!chain.closed || count == 1)) break;
      InputEdge edge{at(i), at(i + 1 == count ? 0 : i + 1),
                     i < chain.bulges.size() ? chain.bulges[i] : 0, source, weight};
      if (!std::isfinite(edge.bulge))
        return error_at(ErrorCode::not_finite, "a bulge is not a finite number", source, edge.from);
      if (edge.from == edge.to) {
        // A closed chain may end with its first point.
        if (i + 1 < count) ++report.repeated_points;
        continue;
      }
      // As in clean_arcs().
      if (std::abs(edge.bulge) / 2 * distance(edge.from, edge.to) <= rounding / 2) edge.bulge = 0;
      if (std::abs(edge.bulge) <= 1) {
        input.edges.push_back(edge);
        continue;
      }
      const Vec2 middle = apex({edge.from, edge.to, edge.bulge});
      const double half = std::clamp(half_bulge(edge.bulge), -1.0, 1.0);
      input.edges.push_back({edge.from, middle, half, source, weight});
      input.edges.push_back({middle, edge.to, half, source, weight});
    }
    if (count > 0 && input.edges.size() == edges_before) input.points.push_back({at(0), {c, 0}});
  }
  return input;
}

/// Drops edges and points that were there before. O(n log n).
void drop_repeated(Input& input, ShapeReport& report) {
  const auto key = [](const InputEdge& e) {
    const bool forward = lexicographic_less(e.from, e.to);
    const Vec2 a = forward ? e.from : e.to, b = forward ? e.to : e.from;
    return std::tuple(a.x, a.y, b.x, b.y, forward ? e.bulge : 0 - e.bulge);
  };
  std::stable_sort(input.edges.begin(), input.edges.end(),
                   [&](const InputEdge& a, const InputEdge& b) { return key(a) < key(b); });
  const auto end = std::unique(input.edges.begin(), input.edges.end(),
                               [&](const auto& a, const auto& b) { return key(a) == key(b); });
  report.repeated_edges += static_cast<std::uint64_t>(input.edges.end() - end);
  input.edges.erase(end, input.edges.end());
  std::sort(input.edges.begin(), input.edges.end(), [](const InputEdge& a, const InputEdge& b) {
    return std::pair(a.source.ring, a.source.vertex) < std::pair(b.source.ring, b.source.vertex);
  });
}

/// Every edge is an open chain of its own, and so is every point.
CleanRings cleaned_of(const Input& input) {
  CleanRings cleaned;
  cleaned.open = true;
  const std::size_t count = 2 * input.edges.size() + input.points.size();
  cleaned.points.reserve(count);
  cleaned.sources.reserve(count);
  cleaned.begin.reserve(input.edges.size() + input.points.size() + 1);
  const bool has_arcs = std::any_of(input.edges.begin(), input.edges.end(),
                                    [](const InputEdge& edge) { return edge.bulge != 0; });
  if (has_arcs) cleaned.bulges.reserve(count);
  cleaned.weights.reserve(count);
  const auto add = [&](Vec2 point, double bulge, EdgeWeight weight) {
    const auto ring = static_cast<std::uint32_t>(cleaned.begin.size() - 1);
    cleaned.sources.push_back({ring, 0});
    cleaned.points.push_back(point);
    cleaned.weights.push_back(weight);
    if (has_arcs) cleaned.bulges.push_back(bulge);
  };
  const auto begin = [&] {
    cleaned.begin.push_back(static_cast<std::uint32_t>(cleaned.points.size()));
  };
  for (const InputEdge& edge : input.edges) {
    begin();
    add(edge.from, edge.bulge, edge.weight);
    add(edge.to, 0, {});
  }
  for (const InputPoint& point : input.points) {
    begin();
    add(point.point, 0, {});
  }
  begin();
  return cleaned;
}

/// The plane graph of an outline's pieces while its faces are found: links between vertices, which
/// are numbered as places. A link is a piece as the sweep knows it, half-edge 2 l is link l from
/// its first end to its last one.
class Faces {
 public:
  Faces(const CleanRings& cleaned, const Sweep& sweep) : cleaned_(cleaned), sweep_(sweep) {
    number_places();
    make_links();
  }

  /// Finds loops and faces.
  void run() {
    sort_rays();
    find_loops();
    nest();
  }

  const CleanRings& cleaned_;
  const Sweep& sweep_;
  struct Link {
    std::uint32_t from, to;  ///< vertices of the outline
    double bulge;
    std::uint32_t edge;  ///< vertex that the outline's edge begins at
  };
  std::vector<Link> links;
  std::vector<std::uint32_t> place;       ///< of each vertex: the lowest vertex there
  std::vector<std::uint32_t> next;        ///< of each half-edge, in its loop
  std::vector<std::uint32_t> loop;        ///< of each half-edge
  std::vector<std::uint32_t> loop_start;  ///< a half-edge of each loop
  std::vector<std::uint32_t> face;        ///< of each loop
  std::vector<bool> hole;                 ///< of each loop
  std::vector<LonePoint> lone;            ///< by place
  std::uint32_t face_count = 1;

  std::uint32_t start(std::uint32_t half_edge) const {
    const Link& link = links[half_edge / 2];
    return place[half_edge % 2 == 0 ? link.from : link.to];
  }

 private:
  void number_places() {
    place.resize(cleaned_.points.size());
    for (std::uint32_t v = 0; v < place.size(); ++v) place[v] = v;
    for (std::size_t i = 0; i < sweep_.touches.size();) {
      std::size_t end = i + 1;
      std::uint32_t lowest = sweep_.touches[i].vertex;
      for (; end < sweep_.touches.size() && sweep_.touches[end].place == sweep_.touches[i].place;
           ++end)
        lowest = std::min(lowest, sweep_.touches[end].vertex);
      for (; i < end; ++i) place[sweep_.touches[i].vertex] = lowest;
    }
  }

  /// Links in the numbers of the sweep's pieces; those of vertices without an edge join nothing.
  void make_links() {
    const auto count = static_cast<std::uint32_t>(cleaned_.points.size());
    links.resize(count + sweep_.splits.size(), {no_index, no_index, 0, no_index});
    for (std::uint32_t v = 0; v < count; ++v) {
      const std::uint32_t to = cleaned_.next(v);
      if (to != no_index) links[v] = {v, to, cleaned_.bulges.empty() ? 0 : cleaned_.bulges[v], v};
    }
    // Splits of one edge come from left to right; each cuts its rightmost piece so far.
    std::vector<std::uint32_t> last;
    if (!sweep_.splits.empty()) last.resize(count, no_index);
    for (std::uint32_t s = 0; s < sweep_.splits.size(); ++s) {
      const Split& split = sweep_.splits[s];
      std::uint32_t& rightmost = last[split.edge];
      if (rightmost == no_index) rightmost = split.edge;
      Link& before = links[rightmost];
      Link& after = links[count + s];
      after = before;
      const bool rightward =
          lexicographic_less(cleaned_.points[before.from], cleaned_.points[before.to]);
      (rightward ? before.to : before.from) = split.vertex;
      (rightward ? after.from : after.to) = split.vertex;
      rightmost = count + s;
    }
  }

  bool is_link(std::uint32_t l) const { return links[l].from != no_index; }

  /// Half-edges that leave each place, counter-clockwise, beginning downward; then what follows
  /// each half-edge in its loop: at its end the next one clockwise from where it came.
  void sort_rays() {
    begin_.assign(cleaned_.points.size() + 1, 0);
    for (std::uint32_t h = 0; h < 2 * links.size(); ++h)
      if (is_link(h / 2)) ++begin_[start(h) + 1];
    for (std::size_t v = 0; v + 1 < begin_.size(); ++v) begin_[v + 1] += begin_[v];
    leaving_.resize(begin_.back());
    std::vector<std::uint32_t> filled(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t h = 0; h < 2 * links.size(); ++h)
      if (is_link(h / 2)) leaving_[filled[start(h)]++] = h;
    next.assign(2 * links.size(), no_index);
    for (std::uint32_t v = 0; v < cleaned_.points.size(); ++v) {
      const auto rays = std::span(leaving_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
      if (rays.size() > 1) {
        const Vec2 center = cleaned_.points[v];
        std::stable_sort(rays.begin(), rays.end(), [&](std::uint32_t a, std::uint32_t b) {
          const Ray ra = ray(a), rb = ray(b);
          const bool a_right = lexicographic_less(center, ra.far);
          const bool b_right = lexicographic_less(center, rb.far);
          return a_right != b_right ? a_right : turns_left(center, ra, rb);
        });
      }
      for (std::size_t i = 0; i < rays.size(); ++i)
        next[rays[i] ^ 1U] = rays[(i == 0 ? rays.size() : i) - 1];
    }
  }

  Ray ray(std::uint32_t half_edge) const {
    const Link& link = links[half_edge / 2];
    Ray result;
    const bool forward = half_edge % 2 == 0;
    result.far = cleaned_.points[forward ? link.to : link.from];
    result.bulge = forward ? link.bulge : -link.bulge;
    return result;
  }

  void find_loops() {
    loop.assign(2 * links.size(), no_index);
    for (std::uint32_t h = 0; h < loop.size(); ++h) {
      if (!is_link(h / 2) || loop[h] != no_index) continue;
      const auto number = static_cast<std::uint32_t>(loop_start.size());
      loop_start.push_back(h);
      for (std::uint32_t at = h; loop[at] == no_index; at = next[at]) loop[at] = number;
    }
  }

  /// The loop around a connected part of the graph is that of the highest half-edge at its leftmost
  /// place: nothing of the part lies above and to the left. All its other loops bound a face of
  /// their own. The part lies in the face above the piece that the sweep found below that place,
  /// which began further left.
  void nest() {
    DisjointSets parts(cleaned_.points.size());
    for (const Link& link : links)
      if (link.from != no_index) parts.join(place[link.from], place[link.to]);
    face.assign(loop_start.size(), no_index);
    hole.assign(loop_start.size(), false);
    std::vector<bool> placed(cleaned_.points.size());
    struct Outer {
      std::uint32_t loop, below;
    };
    std::vector<Outer> outer;
    // The first left end of a part, from left to right, is its leftmost place.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> points;  // place, piece below
    for (const LeftEnd& end : sweep_.left_ends) {
      const std::uint32_t at = place[end.vertex], part = parts.find(at);
      if (placed[part]) continue;
      placed[part] = true;
      if (begin_[at] == begin_[at + 1]) {
        points.emplace_back(at, end.below);
        continue;
      }
      const std::uint32_t around = loop[leaving_[begin_[at + 1] - 1]];
      hole[around] = true;
      outer.push_back({around, end.below});
    }
    for (std::uint32_t i = 0; i < loop_start.size(); ++i)
      if (!hole[i]) face[i] = face_count++;
    const auto face_above = [&](std::uint32_t below) {
      if (below == no_index) return 0U;
      const Link& link = links[below];
      const bool rightward =
          lexicographic_less(cleaned_.points[link.from], cleaned_.points[link.to]);
      return face[loop[2 * below + (rightward ? 0 : 1)]];
    };
    for (const Outer& part : outer) face[part.loop] = face_above(part.below);
    for (const auto& [at, below] : points) lone.push_back({at, face_above(below)});
  }

  std::vector<std::uint32_t> begin_;    ///< of each place: where its rays are in `leaving_`
  std::vector<std::uint32_t> leaving_;  ///< half-edges
};

/// Of a link the result's edge, and whether it is the edge's first and last piece.
struct Part {
  std::uint32_t edge = no_index;
  bool first = false, last = false;
};

/// Numbers the faces' loops as the result does.
void add_loops(const Faces& faces, const std::vector<Part>& parts, PlanarGraph& planar_graph) {
  planar_graph.face_count = faces.face_count;
  planar_graph.half_edges.reserve(2 * planar_graph.edges.size());
  for (std::size_t i = 0; i < faces.loop_start.size(); ++i) {
    planar_graph.loop_begin.push_back(static_cast<std::uint32_t>(planar_graph.half_edges.size()));
    planar_graph.face.push_back(faces.face[i]);
    planar_graph.hole.push_back(faces.hole[i]);
    std::uint32_t h = faces.loop_start[i];
    do {
      const Part& part = parts[h / 2];
      if (h % 2 == 0 ? part.first : part.last)
        planar_graph.half_edges.push_back(2 * part.edge + h % 2);
      h = faces.next[h];
    } while (h != faces.loop_start[i]);
  }
  planar_graph.loop_begin.push_back(static_cast<std::uint32_t>(planar_graph.half_edges.size()));
}

/// Numbers points and edges as the result does: without the places that are there for the sweep
/// only, where an arc has an upright tangent.
PlanarGraph assemble(const Input& input, const Faces& faces, const NodedRings* noded,
                     std::vector<EdgeWeight>* weights) {
  const CleanRings& cleaned = faces.cleaned_;
  const auto passing = [&](std::uint32_t v) { return noded != nullptr && noded->passing[v]; };
  const auto source_of_ring = [&](std::uint32_t ring) {
    if (noded != nullptr) ring = noded->rings[ring];
    return ring < input.edges.size() ? input.edges[ring].source
                                     : input.points[ring - input.edges.size()].source;
  };
  PlanarGraph planar_graph;
  std::vector<std::uint32_t> point(cleaned.points.size(), no_index);
  const auto add_point = [&](std::uint32_t v) {
    point[v] = static_cast<std::uint32_t>(planar_graph.points.size());
    planar_graph.points.push_back(noded != nullptr ? noded->originals[v] : cleaned.points[v]);
    VertexSource source = source_of_ring(cleaned.sources[v].ring);
    // The second vertex of an edge's own chain is the next one of the input's.
    if (v > cleaned.begin[cleaned.sources[v].ring] && noded == nullptr) ++source.vertex;
    planar_graph.point_sources.push_back(source);
  };
  const auto point_at = [&](std::uint32_t v) {
    const std::uint32_t at = faces.place[v];
    if (point[at] == no_index) add_point(at);
    return point[at];
  };
  std::vector<Part> parts(faces.links.size());
  for (std::uint32_t l = 0; l < faces.links.size(); ++l) {
    const Faces::Link& link = faces.links[l];
    if (link.from == no_index || passing(link.from)) continue;
    const auto number = static_cast<std::uint32_t>(planar_graph.edges.size());
    const double bulge = noded != nullptr ? noded->edge_bulges[link.edge] : 0;
    parts[l] = {number, true, false};
    std::uint32_t last = l;
    while (passing(faces.links[last].to)) {
      last = faces.links[last].to;  // links of noded outlines are their vertices' own
      parts[last].edge = number;
    }
    parts[last].last = true;
    const std::uint32_t from = point_at(link.from), to = point_at(faces.links[last].to);
    planar_graph.edges.push_back(
        {from, to, bulge, source_of_ring(cleaned.sources[link.edge].ring)});
    if (weights != nullptr) weights->push_back(noded->weights[link.edge]);
  }
  add_loops(faces, parts, planar_graph);
  for (const LonePoint& lone : faces.lone)
    planar_graph.lone_points.push_back({point_at(lone.point), lone.face});
  return planar_graph;
}

/// The error of the sweep, which names each edge as a chain of its own, in terms of the input.
Error in_terms_of_input(Error error, const Input& input) {
  if (!error.place.ring || *error.place.ring >= input.edges.size()) return error;
  const VertexSource source = input.edges[*error.place.ring].source;
  // "... the edge that starts at vertex 0 of ring N": N names the other edge.
  const std::string marker = " of ring ";
  const std::size_t at = error.text.rfind(marker);
  if (at != std::string::npos) {
    const std::uint64_t other = std::strtoull(error.text.c_str() + at + marker.size(), nullptr, 10);
    if (other < input.edges.size())
      error.text = text_of_edges(error.code, input.edges[other].source, "chain");
  }
  error.place.ring = source.ring;
  error.place.vertex = source.vertex;
  return error;
}

Result<PlanarGraph> build_once(const Input& input, const PlanarGraphOptions& options,
                               ShapeReport& report, std::vector<EdgeWeight>* weights) {
  CleanRings cleaned = cleaned_of(input);
  if (options.node_crossings || options.reach > 0) cleaned.bulges.resize(cleaned.points.size());
  if (!cleaned.bulges.empty()) {
    Result<SweptArcs> swept = sweep_arcs(cleaned, options.node_crossings, options.reach);
    if (!swept) return in_terms_of_input(std::move(swept).error(), input);
    report.touching_vertices = swept->sweep.place_count;
    report.split_edges = swept->split_edges;
    report.crossings = swept->crossings;
    report.repeated_edges += swept->repeated_edges;
    Faces faces(swept->noded.cleaned, swept->sweep);
    faces.run();
    return assemble(input, faces, &swept->noded, weights);
  }
  Result<Sweep> swept = sweep(cleaned);
  if (!swept) return in_terms_of_input(std::move(swept).error(), input);
  report.touching_vertices = swept->place_count;
  report.split_edges = swept->splits.size();
  Faces faces(cleaned, *swept);
  faces.run();
  return assemble(input, faces, nullptr, nullptr);
}

Result<PlanarGraph> build(std::span<const Chain> chains, const PlanarGraphOptions& options,
                          ShapeReport& report) {
  Result<Input> input = input_of(chains, {}, report);
  if (!input) return std::move(input).error();
  const std::uint64_t points = input->points.size();
  Result<PlanarGraph> planar_graph = build_once(*input, options, report, nullptr);
  if (!planar_graph && planar_graph.error().code == ErrorCode::overlap) {
    // Rare, so tested only now: duplicate edges.
    const std::size_t before = input->edges.size();
    drop_repeated(*input, report);
    if (input->edges.size() < before) planar_graph = build_once(*input, options, report, nullptr);
  }
  if (planar_graph) report.repeated_points += points - planar_graph->lone_points.size();
  return planar_graph;
}

}  // namespace

Result<PlanarGraph> build_planar_graph(std::span<const Chain> chains,
                                       const PlanarGraphOptions& options, ShapeReport* report) {
  try {
    ShapeReport counted;
    Result<PlanarGraph> planar_graph = build(chains, options, counted);
    if (report != nullptr) *report = counted;
    return planar_graph;
  } catch (...) {
    return error_in_flight();
  }
}

Result<WeightedGraph> build_weighted_graph(std::span<const Chain> chains,
                                           std::span<const EdgeWeight> weights, double reach,
                                           ShapeReport& report) {
  Result<Input> input = input_of(chains, weights, report);
  if (!input) return std::move(input).error();
  WeightedGraph result;
  Result<PlanarGraph> graph =
      build_once(*input, {.node_crossings = true, .reach = reach}, report, &result.weights);
  if (!graph) return std::move(graph).error();
  result.graph = std::move(graph).value();
  return result;
}

Box bounding_box(const PlanarGraph& planar_graph) {
  Box box{planar_graph.points[0], planar_graph.points[0]};
  for (const Vec2 p : planar_graph.points) box.add(p);
  for (const PlanarGraphEdge& edge : planar_graph.edges) {
    if (edge.bulge == 0) continue;
    const BulgeArc arc{planar_graph.points[edge.from], planar_graph.points[edge.to], edge.bulge};
    for (const Vec2 direction : {Vec2{1, 0}, Vec2{0, 1}})
      if (const auto p = parallel_point(arc, direction)) box.add(*p);
  }
  return box;
}

}  // namespace medial
