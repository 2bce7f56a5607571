#include "shape/clean.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/predicates.h"
#include "shape/errors.h"

namespace medial {
namespace {

/// A vertex can become two sites, and each site can split an edge at most once.
constexpr std::uint64_t most_points = std::numeric_limits<std::uint32_t>::max() / 4;

/// Appends the points of a ring, each distinct from its neighbours.
std::optional<Error> append_distinct(const Ring& ring, std::uint32_t index, CleanRings& cleaned,
                                     ShapeReport& report) {
  std::span<const Vec2> points = ring.points;
  const std::size_t first = cleaned.points.size();
  if (points.size() > 1 && points.front() == points.back()) {
    points = points.first(points.size() - 1);
    ++report.closing_points;
  } else {
    ++report.unclosed_rings;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const VertexSource source{index, static_cast<std::uint32_t>(i)};
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) {
      return error_at(ErrorCode::not_finite, "a coordinate is not a finite number", source,
                      points[i]);
    }
    const Vec2 point{points[i].x + 0.0, points[i].y + 0.0};  // turns -0 into 0
    if (cleaned.points.size() > first && cleaned.points.back() == point) {
      ++report.repeated_points;
      continue;
    }
    cleaned.points.push_back(point);
    cleaned.sources.push_back(source);
  }
  while (cleaned.points.size() > first + 1 && cleaned.points.back() == cleaned.points[first]) {
    cleaned.points.pop_back();
    cleaned.sources.pop_back();
    ++report.repeated_points;
  }
  return std::nullopt;
}

/// Drops the vertices at which the ring is straight. Dropping a vertex changes no direction, so
/// every vertex can be tested with its neighbours in the full ring.
std::optional<Error> drop_collinear(std::uint32_t first, CleanRings& cleaned, ShapeReport& report) {
  std::vector<Vec2>& points = cleaned.points;
  const Vec2 start = points[first];
  const VertexSource source = cleaned.sources[first];
  const std::size_t end = points.size();
  Vec2 before = points[end - 1];
  std::size_t kept = first;
  bool turns = false;
  for (std::size_t i = first; i < end; ++i) {
    const Vec2 point = points[i];
    const Vec2 after = i + 1 < end ? points[i + 1] : start;
    const bool straight = orientation(before, point, after) == 0;
    turns = turns || !straight;
    if (straight && strictly_between(before, point, after)) {
      ++report.collinear_points;
    } else {
      points[kept] = point;
      cleaned.sources[kept] = cleaned.sources[i];
      ++kept;
    }
    before = point;
  }
  if (!turns) {
    return error_at(ErrorCode::no_area, "all points of the ring lie on one line", source, start);
  }
  points.resize(kept);
  cleaned.sources.resize(kept);
  return std::nullopt;
}

/// Appends a ring that has a bulge.
std::optional<Error> append_with_arcs(const Ring& ring, std::uint32_t index,
                                      const RingSurroundings& around, CleanRings& cleaned,
                                      ShapeReport& report) {
  std::vector<RingEdge> edges;
  edges.reserve(ring.points.size());
  std::size_t count = ring.points.size();
  if (count > 1 && ring.points.front() == ring.points.back()) {
    --count;
    ++report.closing_points;
  } else {
    ++report.unclosed_rings;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const VertexSource source{index, static_cast<std::uint32_t>(i)};
    const Vec2 point = ring.points[i];
    const double bulge = i < ring.bulges.size() ? ring.bulges[i] : 0;
    if (!std::isfinite(point.x) || !std::isfinite(point.y))
      return error_at(ErrorCode::not_finite, "a coordinate is not a finite number", source, point);
    if (!std::isfinite(bulge))
      return error_at(ErrorCode::not_finite, "a bulge is not a finite number", source, point);
    if (point == ring.points[i + 1 < count ? i + 1 : 0]) {
      ++report.repeated_points;
      continue;
    }
    edges.push_back({{point.x + 0.0, point.y + 0.0}, bulge, source});
  }
  const auto place = [&](ErrorCode code, const char* text) {
    if (ring.points.empty()) return error_of_ring(code, text, index);
    return error_at(code, text, {index, 0}, ring.points[0]);
  };
  if (edges.size() < 2)
    return place(ErrorCode::too_few_points, "the ring has fewer than two distinct points");
  clean_arcs(edges, around, report);
  for (const RingEdge& edge : edges) {
    if (!std::isfinite(edge.point.x) || !std::isfinite(edge.point.y)) {
      return error_at(ErrorCode::not_finite, "an arc is too large", edge.source, edge.point);
    }
  }
  const bool straight =
      std::all_of(edges.begin(), edges.end(), [](const RingEdge& edge) { return edge.bulge == 0; });
  if (edges.size() < 2 || (edges.size() == 2 && edges[0].bulge == -edges[1].bulge))
    return place(ErrorCode::no_area, "the ring encloses no area");
  cleaned.bulges.reserve(cleaned.points.capacity());
  cleaned.bulges.resize(cleaned.points.size(), 0);
  for (const RingEdge& edge : edges) {
    cleaned.points.push_back(edge.point);
    cleaned.sources.push_back(edge.source);
    cleaned.bulges.push_back(edge.bulge);
  }
  if (straight) {
    // All bulges were too small: treat it as a polygon.
    const std::size_t first = cleaned.points.size() - edges.size();
    if (auto error = drop_collinear(static_cast<std::uint32_t>(first), cleaned, report)) {
      return error;
    }
    cleaned.bulges.resize(cleaned.points.size());
  }
  return std::nullopt;
}

bool has_arcs(const Ring& ring) {
  return std::any_of(ring.bulges.begin(), ring.bulges.end(),
                     [](double bulge) { return bulge != 0; });
}

bool has_three_distinct(std::span<const Vec2> points) {
  return points.size() >= 3 && std::any_of(points.begin() + 2, points.end(), [&](Vec2 point) {
           return point != points[0] && point != points[1];
         });
}

/// The edges with finite numbers. Others are rejected later.
std::vector<BulgeArc> edges_of(std::span<const Ring> rings) {
  std::vector<BulgeArc> edges;
  for (const Ring& ring : rings) {
    const std::vector<Vec2>& points = ring.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 p = points[i], q = points[i + 1 < points.size() ? i + 1 : 0];
      const double bulge = i < ring.bulges.size() ? ring.bulges[i] : 0;
      if (std::isfinite(p.x + p.y + q.x + q.y + bulge)) edges.push_back({p, q, bulge});
    }
  }
  return edges;
}

/// The points at which rings have more than one vertex, except repeated points; sorted.
std::vector<Vec2> shared_points(std::span<const Ring> rings) {
  std::vector<Vec2> all, shared;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.points.size(); ++i)
      if (const Vec2 p = ring.points[i];
          std::isfinite(p.x + p.y) && p != ring.points[i + 1 < ring.points.size() ? i + 1 : 0])
        all.push_back(p);
  std::sort(all.begin(), all.end(), lexicographic_less);
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i] == all[i - 1] && (shared.empty() || shared.back() != all[i]))
      shared.push_back(all[i]);
  return shared;
}

}  // namespace

Result<CleanRings> clean(std::span<const Ring> rings, ShapeReport& report) {
  if (rings.empty()) return error_without_place(ErrorCode::empty, "there is no ring");
  report.input_rings = rings.size();
  for (const Ring& ring : rings) report.input_points += ring.points.size();
  if (report.input_points > most_points || rings.size() > most_points) {
    return error_without_place(ErrorCode::too_large, "there are too many points");
  }

  std::optional<QuarterMap> map;  // computed on demand
  std::optional<std::vector<Vec2>> shared;
  const RingSurroundings around{[&] {
                                  if (!map) map = best_map(edges_of(rings));
                                  return *map;
                                },
                                [&](Vec2 p) {
                                  if (!shared) shared = shared_points(rings);
                                  return std::binary_search(shared->begin(), shared->end(), p,
                                                            lexicographic_less);
                                }};
  CleanRings cleaned;
  cleaned.points.reserve(report.input_points);
  cleaned.sources.reserve(report.input_points);
  cleaned.begin.reserve(rings.size() + 1);
  for (std::uint32_t i = 0; i < rings.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(cleaned.points.size());
    cleaned.begin.push_back(first);
    if (has_arcs(rings[i])) {
      if (auto error = append_with_arcs(rings[i], i, around, cleaned, report)) return *error;
      continue;
    }
    if (auto error = append_distinct(rings[i], i, cleaned, report)) return *error;
    const std::span<const Vec2> points = std::span(cleaned.points).subspan(first);
    if (!has_three_distinct(points)) {
      const char* text = "the ring has fewer than three distinct points";
      if (points.empty()) return error_of_ring(ErrorCode::too_few_points, text, i);
      return error_at(ErrorCode::too_few_points, text, cleaned.sources[first], points[0]);
    }
    if (auto error = drop_collinear(first, cleaned, report)) return *error;
  }
  cleaned.begin.push_back(static_cast<std::uint32_t>(cleaned.points.size()));
  if (std::all_of(cleaned.bulges.begin(), cleaned.bulges.end(),
                  [](double bulge) { return bulge == 0; })) {
    cleaned.bulges.clear();
  } else {
    cleaned.bulges.resize(cleaned.points.size(), 0);
  }
  return cleaned;
}

}  // namespace medial
