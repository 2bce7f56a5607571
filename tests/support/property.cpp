#include "support/property.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>

#include "base/disjoint_sets.h"
#include "medial/medial.h"

namespace medial::test {

namespace {

bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same(Vec2 a, Vec2 b) { return same(a.x, b.x) && same(a.y, b.y); }
bool same(const Disk& a, const Disk& b) {
  return same(a.center, b.center) && same(a.radius, b.radius);
}
bool same(const Site& a, const Site& b) {
  return same(a.start, b.start) && same(a.end, b.end) && a.ring == b.ring && a.vertex == b.vertex &&
         same(a.bulge, b.bulge);
}
bool same(const Node& a, const Node& b) {
  return same(a.disk, b.disk) && a.component == b.component && a.kind == b.kind;
}
bool same(const Edge& a, const Edge& b) {
  return a.node == b.node && a.site == b.site && same(a.control, b.control) &&
         same(a.weight, b.weight);
}

std::string in_words(const char* format, double a, double b) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

}  // namespace

bool identical(const MedialAxis& a, const MedialAxis& b) {
  const auto all_same = [](const auto& one, const auto& other) {
    return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                      [](const auto& x, const auto& y) { return same(x, y); });
  };
  return same(a.tolerance, b.tolerance) && all_same(a.sites, b.sites) &&
         all_same(a.nodes, b.nodes) && all_same(a.edges, b.edges);
}

Invariants invariants_of(const MedialAxis& axis, double diagonal) {
  // Twelve digits are common to all computations; nine leave room for the shape of the tie.
  const double together = 1e-9 * diagonal;
  DisjointSets sets(axis.nodes.size());
  const auto joins = [&](const Edge& edge) {
    const Node& from = axis.nodes[edge.node[0]];
    const Node& to = axis.nodes[edge.node[1]];
    return from.kind != NodeKind::leaf && to.kind != NodeKind::leaf &&
           distance(from.disk.center, to.disk.center) <= together;
  };
  for (const Edge& edge : axis.edges) {
    if (joins(edge)) sets.join(edge.node[0], edge.node[1]);
  }
  std::map<std::uint32_t, std::size_t> degree;
  for (const Edge& edge : axis.edges) {
    if (sets.find(edge.node[0]) == sets.find(edge.node[1]) && joins(edge)) continue;
    ++degree[sets.find(edge.node[0])];
    ++degree[sets.find(edge.node[1])];
  }
  Invariants result;
  for (const Node& node : axis.nodes) {
    if (node.kind == NodeKind::leaf) ++result.leaves;
    result.deepest = std::max(result.deepest, node.disk.radius);
  }
  for (const auto& [node, count] : degree) {
    if (count >= 3) ++result.branching;
  }
  result.length = total_length(axis);
  return result;
}

std::vector<std::string> check_axis(const Rings& rings) {
  const auto shape = build_shape(rings);
  if (!shape) return {"refused: " + to_string(shape.error())};
  const auto axis = compute(*shape, {.threads = 1});
  if (!axis) return {"not computed: " + to_string(axis.error())};
  const Certificate certificate = verify(*shape, *axis, {.threads = 1});
  if (certificate.passed) return {};
  std::vector<std::string> failures = certificate.failures;
  if (failures.empty()) failures.push_back("not passed, without a reason");
  return failures;
}

std::vector<std::string> check_threads(const Rings& rings) {
  const auto shape = build_shape(rings);
  if (!shape) return {"refused: " + to_string(shape.error())};
  std::optional<MedialAxis> first;
  for (const int threads : {1, 2, 8}) {
    auto axis = compute(*shape, {.threads = threads});
    if (!axis) return {"not computed: " + to_string(axis.error())};
    if (!first) {
      first = std::move(*axis);
    } else if (!identical(*first, *axis)) {
      return {"another result with " + std::to_string(threads) + " threads"};
    }
  }
  return {};
}

std::vector<std::string> check_symmetries(const RandomShape& shape) {
  std::vector<std::string> failures;
  Invariants first;
  double size = 0;
  for (const Symmetry& symmetry : symmetries()) {
    const auto fails = [&](const std::string& what) {
      failures.push_back(symmetry.name + ": " + what);
    };
    const bool exact = symmetry.exact && symmetry.dx == 0 && symmetry.scale() == 1;
    if (!exact && !shape.rigid) continue;
    // A shift rounds every coordinate to the spacing of doubles there.
    const double shift = std::max(std::abs(symmetry.dx), std::abs(symmetry.dy));
    if (shift > 100 * size * symmetry.scale() || shift > 100 * size) continue;
    const auto built = build_shape(transformed(shape.rings, symmetry));
    if (!built) {
      fails("refused: " + to_string(built.error()));
      continue;
    }
    const auto axis = compute(*built, {.threads = 1});
    if (!axis) {
      fails("not computed: " + to_string(axis.error()));
      continue;
    }
    const double scale = symmetry.scale();
    const double diameter = diagonal(bounding_box(*built));
    const Invariants now = invariants_of(*axis, diameter);
    if (size == 0) {  // the identity comes first
      size = diameter;
      first = now;
      continue;
    }
    if (std::abs(now.deepest - scale * first.deepest) > 1e-12 * scale * size) {
      fails(in_words("deepest radius %.17g instead of %.17g", now.deepest, scale * first.deepest));
    }
    if (now.leaves != first.leaves) {
      fails(in_words("%.0f leaves instead of %.0f", static_cast<double>(now.leaves),
                     static_cast<double>(first.leaves)));
    }
    if (!shape.rigid) continue;
    if (now.branching != first.branching) {
      fails(in_words("%.0f branching nodes instead of %.0f", static_cast<double>(now.branching),
                     static_cast<double>(first.branching)));
    }
    if (std::abs(now.length - scale * first.length) > 1e-9 * scale * first.length) {
      fails(in_words("length %.17g instead of %.17g", now.length, scale * first.length));
    }
  }
  return failures;
}

}  // namespace medial::test
