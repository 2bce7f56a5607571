#include "ops/summits.h"

#include <optional>
#include <tuple>

#include "axis/curve.h"
#include "medial/centreline.h"
#include "medial/query.h"
#include "ops/routes.h"

namespace medial::ops {
namespace {

/// Where the radius along an edge exceeds that of both of its ends most.
std::optional<double> summit(const MedialAxis& axis, std::uint32_t index) {
  const Edge& edge = axis.edges[index];
  const double r0 = axis.nodes[edge.node[0]].disk.radius;
  const double r2 = axis.nodes[edge.node[1]].disk.radius;
  if (!(edge.control.radius > r0 && edge.control.radius > r2)) return std::nullopt;
  const double t = widest_place(axis, index).t, top = disk_at(axis, edge, t).radius;
  if (!(top > r0 && top > r2)) return std::nullopt;  // rounding
  return t;
}

void divide(MedialAxis& axis, std::uint32_t index, double t) {
  const Curve curve = curve_of(axis, axis.edges[index]);
  const auto node = static_cast<std::uint32_t>(axis.nodes.size());
  const std::uint32_t component = axis.nodes[axis.edges[index].node[0]].component;
  axis.nodes.push_back({curve.at(t), component, NodeKind::site_change});
  Edge second = axis.edges[index];
  Edge& first = axis.edges[index];
  first.node[1] = second.node[0] = node;
  std::tie(first.control, first.weight) = curve.control_between(0, t);
  std::tie(second.control, second.weight) = curve.control_between(t, 1);
  axis.edges.push_back(second);
}

}  // namespace

bool has_summits(const MedialAxis& axis) {
  for (std::uint32_t e = 0; e < axis.edges.size(); ++e)
    if (summit(axis, e)) return true;
  return false;
}

void divide_at_summits(MedialAxis& axis) {
  const auto count = static_cast<std::uint32_t>(axis.edges.size());
  for (std::uint32_t e = 0; e < count; ++e)
    if (const auto t = summit(axis, e)) divide(axis, e, *t);
}

}  // namespace medial::ops
