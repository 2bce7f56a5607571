#include "io/axis_samples.h"

#include <algorithm>
#include <cmath>

#include "axis/steps.h"
#include "ops/disk_lines.h"

namespace medial::io {

namespace {

/// Whether the straight chord between the nodes stays within `chord` of an edge for certain: a
/// rational quadratic curve with weight w lies within w / (1 + w) of the control point's distance
/// from the chord's middle, in each of its coordinates taken together.
bool is_nearly_straight(const MedialAxis& axis, const Edge& edge, double chord) {
  const Disk& a = axis.nodes[edge.node[0]].disk;
  const Disk& b = axis.nodes[edge.node[1]].disk;
  const Vec2 aside = edge.control.center - midpoint(a.center, b.center);
  const double radius = edge.control.radius - (a.radius + 0.5 * (b.radius - a.radius));
  const double factor = edge.weight / (1 + edge.weight);
  return factor * (norm(aside) + std::fabs(radius)) <= chord;
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return distance(p, a + t * along);
}

}  // namespace

double chord_of(const AxisItem& item, const WriteOptions& options) {
  return options.chord * diagonal(bounding_box(item.shape));
}

void sample(const MedialAxis& axis, const Edge& edge, double chord, std::vector<Disk>& samples) {
  if (is_nearly_straight(axis, edge, chord)) {
    samples.assign({axis.nodes[edge.node[0]].disk, axis.nodes[edge.node[1]].disk});
  } else {
    samples = sample_by_chord(axis, edge, chord);
  }
}

std::vector<Disk> sample(const MedialAxis& axis, const Branch& branch, double chord) {
  std::vector<Disk> result;
  std::vector<Disk> samples;
  result.reserve(branch.steps.size() + 1);
  for (const Step& step : branch.steps) {
    const Edge& edge = axis.edges[step.edge];
    if (is_nearly_straight(axis, edge, chord)) {
      if (result.empty()) result.push_back(axis.nodes[tail_of(axis, step)].disk);
      result.push_back(axis.nodes[head_of(axis, step)].disk);
      continue;
    }
    samples = sample_by_chord(axis, edge, chord);
    if (!step.forward) std::ranges::reverse(samples);
    result.insert(result.end(), samples.begin() + (result.empty() ? 0 : 1), samples.end());
  }
  return result;
}

void line_of(const MedialAxis& axis, const Branch& branch, double chord, double simplify,
             std::vector<Vec2>& points) {
  if (simplify > 0) chord = std::min(chord, 0.5 * simplify);
  points.clear();
  for (const Disk& disk : sample(axis, branch, chord)) points.push_back(disk.center);
  if (!(simplify > 0)) return;
  std::vector<Vec2> kept;
  const auto excess = [&](std::uint32_t i, std::uint32_t first, std::uint32_t last) {
    return distance_to_segment(points[i], points[first], points[last]) - simplify + chord;
  };
  for (const std::uint32_t i : ops::simplified(static_cast<std::uint32_t>(points.size()), excess))
    kept.push_back(points[i]);
  // A cycle stays one, however small.
  if (branch.from != branch.to || kept.size() >= 4) points.swap(kept);
}

}  // namespace medial::io
